(** Words: prefixes, repetitions and periodic addresses, and the operators along a word. *)
From Coq Require Import Reals Lra Lia List FunctionalExtensionality.
From Coquelicot Require Import Coquelicot.
From Secant Require Import Vec Automaton Leading.
Import ListNotations.
Open Scope R_scope.

(** The address [w s]; [w^m s]; [w w w ...]. *)
Definition app (w : list nat) (s : address) : address := fold_right cons s w.
Definition rep (m : nat) (w : list nat) (s : address) : address := Nat.iter m (app w) s.
Definition per (w : list nat) : address := fun k => nth (k mod length w) w O.
Fixpoint begins (w : list nat) (s : address) : Prop :=
  match w with [] => True | i :: w => s O = i /\ begins w (tl s) end.

Lemma begins_dec w : forall s, {begins w s} + {~ begins w s}.
Proof.
  induction w as [|i w IH]; simpl; intros s; auto.
  destruct (Nat.eq_dec (s O) i); destruct (IH (tl s)); tauto.
Qed.

Lemma begins_app w : forall s, begins w s -> s = app w (drop (length w) s).
Proof.
  induction w as [|i w IH]; simpl; intros s H; auto. destruct H as [H1 H2].
  rewrite <- (IH (tl s) H2), <- H1. symmetry; apply cons_tl.
Qed.

Lemma begins_of_app w : forall s, begins w (app w s).
Proof. induction w as [|i w IH]; simpl; intros s; auto. split; auto. exact (IH s). Qed.

Lemma app_nth w : forall s k, app w s k = if k <? length w then nth k w O else s (k - length w)%nat.
Proof.
  induction w as [|i w IH]; simpl; intros s k.
  - rewrite Nat.sub_0_r; auto.
  - destruct k; simpl; auto. rewrite IH. reflexivity.
Qed.

Lemma per_app w : w <> [] -> per w = app w (per w).
Proof.
  intros Hw. assert (length w <> O) by (destruct w; simpl; congruence).
  extensionality k. rewrite app_nth. unfold per. destruct (Nat.ltb_spec k (length w)).
  - rewrite Nat.mod_small; auto.
  - f_equal. replace k with ((k - length w) + 1 * length w)%nat at 1 by lia. apply Nat.mod_add; auto.
Qed.

Lemma rep_app m w s : rep m w (app w s) = rep (S m) w s.
Proof. unfold rep. induction m; simpl; auto. rewrite IHm. reflexivity. Qed.

Lemma rep_rep m n w s : rep m w (rep n w s) = rep (m + n) w s.
Proof. unfold rep. induction m; simpl; auto. rewrite IHm. reflexivity. Qed.

Section Words.
Variable A : automaton.
Notation N := (N A).
Notation nrm := (nrm N).

Fixpoint stw (e : nat) (w : list nat) : nat := match w with [] => e | i :: w => stw (dst A e i) w end.
Fixpoint Ww (e : nat) (w : list nat) (x : vec) : vec :=
  match w with [] => x | i :: w => act N (mat A e i) (Ww (dst A e i) w x) end.
Fixpoint admw (e : nat) (w : list nat) : Prop :=
  match w with [] => True | i :: w => (i < deg A e)%nat /\ admw (dst A e i) w end.

Lemma Ww_add w : forall e x y, Ww e w (add x y) = add (Ww e w x) (Ww e w y).
Proof. induction w as [|i w IH]; simpl; intros; auto. rewrite IH. apply act_add. Qed.
Lemma Ww_scl w : forall e a x, Ww e w (scl a x) = scl a (Ww e w x).
Proof. induction w as [|i w IH]; simpl; intros; auto. rewrite IH. apply act_scl. Qed.
Lemma Ww_sub w e x y : Ww e w (sub x y) = sub (Ww e w x) (Ww e w y).
Proof. rewrite !sub_add, Ww_add, Ww_scl. reflexivity. Qed.

Lemma Ww_bound w : forall e, exists B, 1 <= B /\ forall x, nrm (Ww e w x) <= B * nrm x.
Proof.
  induction w as [|i w IH]; simpl; intros e.
  - exists 1. split; [lra|]. intros; lra.
  - destruct (IH (dst A e i)) as (B & HB & H). pose proof (size_ge0 N (mat A e i)) as Hs.
    exists ((1 + size N (mat A e i)) * B). split; [nra|]. intros x.
    eapply Rle_trans; [apply nrm_act|]. specialize (H x). pose proof (nrm_ge0 N x).
    pose proof (nrm_ge0 N (Ww (dst A e i) w x)). rewrite Rmult_assoc.
    apply Rle_trans with (size N (mat A e i) * (B * nrm x)); [apply Rmult_le_compat_l; auto|].
    apply Rmult_le_compat_r; [|lra]. apply Rmult_le_pos; lra.
Qed.

Lemma adm_app w : forall e s, adm A e (app w s) <-> admw e w /\ adm A (stw e w) s.
Proof.
  induction w as [|i w IH]; simpl; intros e s; [tauto|]. split.
  - intros H. pose proof (H O) as H0. simpl in H0. pose proof (proj1 (IH _ s) (adm_tl A e _ H)). tauto.
  - intros [[H1 H2] H3]. pose proof (proj2 (IH _ s) (conj H2 H3)) as H4. intros [|k]; [exact H1|apply (H4 k)].
Qed.

Lemma W_app w : forall e s k x, W A e (app w s) (length w + k) x = Ww e w (W A (stw e w) s k x).
Proof. induction w as [|i w IH]; simpl; intros; auto. f_equal. apply IH. Qed.

Lemma st_app w : forall e s k, st A e (app w s) (length w + k) = st A (stw e w) s k.
Proof. induction w as [|i w IH]; simpl; intros; auto. apply IH. Qed.

Hypothesis sys : contracting A.

Lemma wf : well_formed A.
Proof. apply sys. Qed.

Lemma stw_ok w : forall e, (e < states A)%nat -> admw e w -> (stw e w < states A)%nat.
Proof.
  induction w as [|i w IH]; simpl; intros e He H; auto. destruct H as [H1 H2]. apply IH; auto.
  apply (wf e He); auto.
Qed.

Lemma Ww_flat w : forall e x, (e < states A)%nat -> admw e w -> flat N (dim A (stw e w)) x -> flat N (dim A e) (Ww e w x).
Proof.
  induction w as [|i w IH]; simpl; intros e x He H Hx; auto. destruct H as [H1 H2].
  apply T_flat; auto; [apply wf|]. apply IH; auto. apply (wf e He); auto.
Qed.

Lemma phi_app w : forall e s, (e < states A)%nat -> adm A e (app w s) -> phi A e (app w s) = Ww e w (phi A (stw e w) s).
Proof.
  destruct sys as (Hwf & K & th & c & r & H1 & H2 & H3 & H4).
  induction w as [|i w IH]; simpl; intros e s He Hs; auto.
  rewrite (phi_step A Hwf K th c r H1 H4 e _ He Hs). f_equal. apply IH.
  - apply (Hwf e He). apply (Hs O).
  - apply (adm_tl A e _ Hs).
Qed.

Lemma phi_bary' e s : (e < states A)%nat -> adm A e s -> bary N (dim A e) (phi A e s).
Proof. destruct sys as (Hwf & K & th & c & r & H1 & H2 & H3 & H4). apply (phi_bary A Hwf K th c r); auto. Qed.
(** The limits of points of the states are the points of the addresses. *)
Lemma phi_from (a : nat -> vec) e s i : (forall e, (e < states A)%nat -> bary N (dim A e) (a e)) ->
  (e < states A)%nat -> adm A e s -> is_lim_seq (fun k => W A e s k (a (st A e s k)) i) (phi A e s i).
Proof.
  intros Ha He Hs. destruct (Nat.lt_ge_cases i N) as [Hi|Hi].
  - apply (base_points A sys e s (fun k => a (st A e s k)) (sum (states A) (fun f => nrm (a f)))); auto.
    + intros k. apply Ha. apply st_ok; auto. apply wf.
    + intros k. apply (sum_term (states A) (fun f => nrm (a f)) (st A e s k)).
      * intros; apply nrm_ge0.
      * apply st_ok; auto. apply wf.
  - assert (Hb : forall k, bary N (dim A e) (W A e s k (a (st A e s k)))).
    { intros k. apply W_bary; auto; [apply wf|]. apply Ha. apply st_ok; auto. apply wf. }
    pose proof (dim_ok A wf e He). destruct (phi_bary' e s He Hs) as [H1 _]. rewrite H1 by lia.
    apply is_lim_seq_ext with (u := fun _ => 0); [|apply is_lim_seq_const].
    intros k. symmetry. apply (Hb k). lia.
Qed.
End Words.
