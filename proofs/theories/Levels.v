(** All levels (Theorem 5): where the operators are injective on the differences of the attractors, what is found of the branches
    of a state holds at all of its copies inside the attractor of the start state. *)
From Coq Require Import Reals Lra Lia List FunctionalExtensionality.
From Secant Require Import Vec Automaton Leading Germ.
Import ListNotations.
Open Scope R_scope.

(** [P] shrinks vectors of [V] by no more than a factor. *)
Definition injective_on (N : nat) (V : vec -> Prop) (G : vec -> vec) :=
  exists k, 0 < k /\ forall x, V x -> k * nrm N x <= nrm N (G x).

(** A branch behind a longer prefix. *)
Definition inside (u : list nat) (b : branch) : branch := {| prefix := u ++ prefix b; cycle := cycle b |}.

Lemma app_app u v s : app (u ++ v) s = app u (app v s).
Proof. unfold app. rewrite fold_right_app. reflexivity. Qed.

Section Levels.
Variable A : automaton.
Notation N := (N A).
Notation nrm := (nrm N).
Hypothesis sys : contracting A.

Lemma stw_app u : forall e v, stw A e (u ++ v) = stw A (stw A e u) v.
Proof. induction u as [|i u IH]; simpl; intros; auto. Qed.

(** The identity, as a matrix. *)
Definition identity : matrix := fun i j => if Nat.eqb i j then if Nat.ltb i N then 1 else 0 else 0.

Lemma act_identity x : (forall i, (N <= i)%nat -> x i = 0) -> act N identity x = x.
Proof.
  intros Hx. extensionality i. unfold act. destruct (Nat.lt_ge_cases i N) as [Hi|Hi].
  - rewrite (sum_single N _ i Hi).
    + unfold identity. rewrite Nat.eqb_refl. destruct (Nat.ltb_spec i N); [ring|lia].
    + intros j Hj Hne. unfold identity. destruct (Nat.eqb_spec i j); [lia|ring].
  - rewrite Hx by auto. apply sum_0; intros j Hj. unfold identity. destruct (Nat.eqb_spec i j); [lia|ring].
Qed.

Variables (P : matrix) (s f : nat) (u : list nat).
Hypothesis s_ok : (s < states A)%nat.
Hypothesis u_ok : admw A s u.
Hypothesis to_f : stw A s u = f.
Notation G x := (act N P (Ww A s u x)).
Variable V : vec -> Prop.
Hypothesis V_diff : forall t t', adm A f t -> adm A f t' -> V (sub (phi A f t) (phi A f t')).
Hypothesis inj : injective_on N V (fun x => G x).

Lemma f_ok : (f < states A)%nat.
Proof. rewrite <- to_f. apply (stw_ok A sys); auto. Qed.

Lemma phi_support e t i : (e < states A)%nat -> adm A e t -> (N <= i)%nat -> phi A e t i = 0.
Proof.
  intros He Ht Hi. destruct (phi_bary' A sys e t He Ht) as [H _]. apply H.
  pose proof (dim_ok A (wf A sys) e He). lia.
Qed.

Lemma secant_inside b m t : adm A (stw A f (prefix b)) t -> admw A f (prefix b) ->
  adm A f (app (prefix b) (rep m (cycle b) t)) -> adm A f (app (prefix b) (per (cycle b))) ->
  secant A P s (inside u b) m t = G (secant A identity f b m t) /\ V (secant A identity f b m t).
Proof.
  intros Ht Hb H1 H2. pose proof f_ok as Hf. unfold secant, point, inside; simpl. rewrite !app_app.
  rewrite (phi_app A sys u s (app _ (rep _ _ _))), (phi_app A sys u s (app _ (per _))); auto;
    try (apply adm_app; rewrite to_f; auto).
  rewrite to_f, !act_identity by (intros; apply phi_support; auto). split.
  - rewrite <- act_sub, <- Ww_sub. reflexivity.
  - apply V_diff; auto.
Qed.

Theorem directed_inside sg b d : admw A f (prefix b) -> adm A f (app (prefix b) (per (cycle b))) ->
  (forall m t, adm A (stw A f (prefix b)) t -> adm A f (app (prefix b) (rep m (cycle b) t))) ->
  directed sg A identity f b d -> directed sg A P s (inside u b) (G d).
Proof.
  intros Hb Hper Hrep [H1 H2]. destruct inj as (k & Hk & Hinj). destruct (Ww_bound A u s) as (B & HB & HuB).
  pose (S := size N P * B + 1). assert (HS : 1 <= S) by (unfold S; pose proof (size_ge0 N P); nra).
  assert (HG : forall x, nrm (G x) <= S * nrm x).
  { intros x. eapply Rle_trans; [apply nrm_act|]. pose proof (HuB x). pose proof (size_ge0 N P). pose proof (nrm_ge0 N x).
    apply Rle_trans with (size N P * (B * nrm x)); [apply Rmult_le_compat_l; auto|]. unfold S. nra. }
  assert (Hst : stw A s (prefix (inside u b)) = stw A f (prefix b)) by (simpl; rewrite stw_app, to_f; auto).
  split.
  - intros eps Heps. destruct (H1 (eps * k / S)) as (m0 & Hm0).
    { apply Rdiv_lt_0_compat; [apply Rmult_lt_0_compat; auto|lra]. }
    exists m0. intros m t Hm Ht Hpos. rewrite Hst in Ht.
    destruct (secant_inside b m t Ht Hb (Hrep m t Ht) Hper) as [E Hfl]. rewrite E in *.
    assert (Hx : 0 < nrm (secant A identity f b m t)).
    { pose proof (HG (secant A identity f b m t)). pose proof (nrm_ge0 N (secant A identity f b m t)). nra. }
    destruct (Hm0 m t Hm Ht Hx) as (c & Hc & Hn). exists c. split; auto.
    rewrite <- act_scl, <- Ww_scl, <- act_sub, <- Ww_sub. eapply Rle_trans; [apply HG|].
    apply Rle_trans with (S * (eps * k / S * nrm (secant A identity f b m t))); [apply Rmult_le_compat_l; [lra|auto]|].
    replace (S * (eps * k / S * nrm (secant A identity f b m t))) with (eps * (k * nrm (secant A identity f b m t)))
      by (field; lra).
    apply Rmult_le_compat_l; [lra|]. apply Hinj; auto.
  - intros m. destruct (H2 m) as (t & Ht & Hpos). exists t. rewrite Hst. split; auto.
    destruct (secant_inside b m t Ht Hb (Hrep m t Ht) Hper) as [E Hfl]. rewrite E.
    pose proof (Hinj _ Hfl). assert (0 < k * nrm (secant A identity f b m t)) by (apply Rmult_lt_0_compat; auto). lra.
Qed.
End Levels.

Section Injective.
Variable A : automaton.
Notation N := (N A).
Notation nrm := (nrm N).
Hypothesis sys : contracting A.
Variable P : matrix.
Variable s : nat.
Variable V : nat -> vec -> Prop.
Hypothesis V_step : forall e i x, (e < states A)%nat -> (i < deg A e)%nat -> V (dst A e i) x -> V e (act N (mat A e i) x).
Hypothesis net_inj : injective_on N (V s) (act N P).
Hypothesis ops_inj : forall e i, (e < states A)%nat -> (i < deg A e)%nat -> injective_on N (V (dst A e i)) (act N (mat A e i)).

Lemma V_word u : forall e x, (e < states A)%nat -> admw A e u -> V (stw A e u) x -> V e (Ww A e u x).
Proof.
  induction u as [|i u IH]; simpl; intros e x He Hu Hx; auto. destruct Hu as [Hi Hu]. apply V_step; auto.
  apply IH; auto. apply (wf A sys e He); auto.
Qed.

Lemma words_inj u : forall e, (e < states A)%nat -> admw A e u ->
  injective_on N (V (stw A e u)) (Ww A e u).
Proof.
  induction u as [|i u IH]; intros e He Hu; simpl.
  - exists 1. split; [lra|]. intros; lra.
  - destruct Hu as [Hi Hu]. destruct (wf A sys e He) as (_ & _ & Hd). destruct (Hd i Hi) as (Hd1 & _).
    destruct (IH (dst A e i) Hd1 Hu) as (k & Hk & H). destruct (ops_inj e i He Hi) as (k' & Hk' & H').
    exists (k' * k). split; [apply Rmult_lt_0_compat; auto|]. intros x Hx. rewrite Rmult_assoc.
    eapply Rle_trans; [apply Rmult_le_compat_l; [lra|apply H; auto]|]. apply H'. apply V_word; auto.
Qed.

Lemma seen_inj u : (s < states A)%nat -> admw A s u ->
  injective_on N (V (stw A s u)) (fun x => act N P (Ww A s u x)).
Proof.
  intros Hs Hu. destruct (words_inj u s Hs Hu) as (k & Hk & H). destruct net_inj as (k' & Hk' & H').
  exists (k' * k). split; [apply Rmult_lt_0_compat; auto|]. intros x Hx. rewrite Rmult_assoc.
  eapply Rle_trans; [apply Rmult_le_compat_l; [lra|apply H; auto]|]. apply H'. apply V_word; auto.
Qed.
End Injective.
