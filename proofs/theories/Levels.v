(** All levels (Theorem 5): where the operators are injective on what is seen of the differences of the attractors, what is found of
    the branches of a state holds at all of its copies inside the attractor of the start state. *)
From Coq Require Import Reals Lra Lia List FunctionalExtensionality.
From Secant Require Import Vec Automaton Leading Germ.
Import ListNotations.
Open Scope R_scope.

(** Of the vectors of [V] the map [G] shows as much as [R]. *)
Definition comparable (N : nat) (V : vec -> Prop) (R G : vec -> vec) :=
  exists k K, 0 < k /\ 0 < K /\ forall x, V x -> k * nrm N (R x) <= nrm N (G x) <= K * nrm N (R x).

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

Variables (P R : matrix) (s f : nat) (u : list nat).
Hypothesis s_ok : (s < states A)%nat.
Hypothesis u_ok : admw A s u.
Hypothesis to_f : stw A s u = f.
Notation G x := (act N P (Ww A s u x)).
Variable V : vec -> Prop.
Hypothesis V_sub : forall x y, V x -> V y -> V (sub x y).
Hypothesis V_scl : forall a x, V x -> V (scl a x).
Hypothesis V_diff : forall t t', adm A f t -> adm A f t' -> V (sub (phi A f t) (phi A f t')).
Hypothesis shown : comparable N V (act N R) (fun x => G x).

(** The secant before anything is seen of it. *)
Definition difference b m t := sub (phi A f (app (prefix b) (rep m (cycle b) t))) (phi A f (app (prefix b) (per (cycle b)))).

Lemma secant_inside b m t : adm A (stw A f (prefix b)) t -> admw A f (prefix b) ->
  adm A f (app (prefix b) (rep m (cycle b) t)) -> adm A f (app (prefix b) (per (cycle b))) ->
  secant A P s (inside u b) m t = G (difference b m t) /\ secant A R f b m t = act N R (difference b m t) /\ V (difference b m t).
Proof.
  intros Ht Hb H1 H2. unfold secant, point, inside, difference; simpl. rewrite !app_app.
  rewrite (phi_app A sys u s (app _ (rep _ _ _))), (phi_app A sys u s (app _ (per _))); auto;
    try (apply adm_app; rewrite to_f; auto).
  rewrite to_f. split; [|split].
  - rewrite <- act_sub, <- Ww_sub. reflexivity.
  - rewrite <- act_sub. reflexivity.
  - apply V_diff; auto.
Qed.

Theorem directed_inside sg b d : admw A f (prefix b) -> adm A f (app (prefix b) (per (cycle b))) ->
  (forall m t, adm A (stw A f (prefix b)) t -> adm A f (app (prefix b) (rep m (cycle b) t))) -> V d ->
  directed sg A R f b (act N R d) -> directed sg A P s (inside u b) (G d).
Proof.
  intros Hb Hper Hrep Hd [H1 H2]. destruct shown as (k & K & Hk & HK & Hcmp).
  assert (Hst : stw A s (prefix (inside u b)) = stw A f (prefix b)) by (simpl; rewrite stw_app, to_f; auto).
  split.
  - intros eps Heps. destruct (H1 (eps * k / K)) as (m0 & Hm0).
    { apply Rdiv_lt_0_compat; [apply Rmult_lt_0_compat; auto|auto]. }
    exists m0. intros m t Hm Ht Hpos. rewrite Hst in Ht.
    destruct (secant_inside b m t Ht Hb (Hrep m t Ht) Hper) as (E & E' & Hv). rewrite E in *.
    set (x := difference b m t) in *. destruct (Hcmp x Hv) as [C1 C2].
    assert (Hx : 0 < nrm (secant A R f b m t)).
    { rewrite E'. pose proof (nrm_ge0 N (act N R x)). destruct (Rle_lt_or_eq_dec _ _ H) as [|H0]; auto. rewrite <- H0 in C2. lra. }
    destruct (Hm0 m t Hm Ht Hx) as (c & Hc & Hn). rewrite E' in Hn. exists c. split; auto.
    rewrite <- act_scl, <- Ww_scl, <- act_sub, <- Ww_sub.
    destruct (Hcmp (sub x (scl c d)) (V_sub _ _ Hv (V_scl c d Hd))) as [_ C4]. eapply Rle_trans; [exact C4|].
    rewrite act_sub, act_scl. apply Rle_trans with (K * (eps * k / K * nrm (act N R x))); [apply Rmult_le_compat_l; [lra|auto]|].
    replace (K * (eps * k / K * nrm (act N R x))) with (eps * (k * nrm (act N R x))) by (field; lra).
    apply Rmult_le_compat_l; [lra|auto].
  - intros m. destruct (H2 m) as (t & Ht & Hpos). exists t. rewrite Hst. split; auto.
    destruct (secant_inside b m t Ht Hb (Hrep m t Ht) Hper) as (E & E' & Hv). rewrite E. rewrite E' in Hpos.
    destruct (Hcmp _ Hv) as [C1 _]. assert (0 < k * nrm (act N R (difference b m t))) by (apply Rmult_lt_0_compat; auto). lra.
Qed.
End Levels.

Section Shown.
Variable A : automaton.
Notation N := (N A).
Notation nrm := (nrm N).
Hypothesis sys : contracting A.
Variable P : matrix.
Variable s : nat.
Variable V : nat -> vec -> Prop.
Variable R : nat -> matrix.
Hypothesis V_step : forall e i x, (e < states A)%nat -> (i < deg A e)%nat -> V (dst A e i) x -> V e (act N (mat A e i) x).
Hypothesis net_shown : comparable N (V s) (act N (R s)) (act N P).
Hypothesis ops_shown : forall e i, (e < states A)%nat -> (i < deg A e)%nat ->
  comparable N (V (dst A e i)) (act N (R (dst A e i))) (fun x => act N (R e) (act N (mat A e i) x)).

Lemma V_word u : forall e x, (e < states A)%nat -> admw A e u -> V (stw A e u) x -> V e (Ww A e u x).
Proof.
  induction u as [|i u IH]; simpl; intros e x He Hu Hx; auto. destruct Hu as [Hi Hu]. apply V_step; auto.
  apply IH; auto. apply (wf A sys e He); auto.
Qed.

Lemma comparable_trans (V1 V2 : vec -> Prop) (R1 R2 G1 : vec -> vec) (T : vec -> vec) : (forall x, V2 x -> V1 (T x)) ->
  comparable N V1 R1 G1 -> comparable N V2 R2 (fun x => R1 (T x)) -> comparable N V2 R2 (fun x => G1 (T x)).
Proof.
  intros HT (k1 & K1 & Hk1 & HK1 & H1) (k2 & K2 & Hk2 & HK2 & H2). exists (k1 * k2), (K1 * K2).
  split; [apply Rmult_lt_0_compat; auto|]. split; [apply Rmult_lt_0_compat; auto|]. intros x Hx.
  destruct (H1 (T x) (HT x Hx)) as [A1 A2]. destruct (H2 x Hx) as [B1 B2]. rewrite !Rmult_assoc. split.
  - eapply Rle_trans; [apply Rmult_le_compat_l; [lra|exact B1]|exact A1].
  - eapply Rle_trans; [exact A2|apply Rmult_le_compat_l; [lra|exact B2]].
Qed.

Lemma words_shown u : forall e, (e < states A)%nat -> admw A e u ->
  comparable N (V (stw A e u)) (act N (R (stw A e u))) (fun x => act N (R e) (Ww A e u x)).
Proof.
  induction u as [|i u IH]; intros e He Hu; simpl.
  - exists 1, 1. split; [lra|]. split; [lra|]. intros; lra.
  - destruct Hu as [Hi Hu]. destruct (wf A sys e He) as (_ & _ & Hd). destruct (Hd i Hi) as (Hd1 & _).
    apply (comparable_trans (V (dst A e i)) _ (act N (R (dst A e i))) _ (fun x => act N (R e) (act N (mat A e i) x)) (Ww A (dst A e i) u)); auto.
    intros x Hx. apply V_word; auto.
Qed.

Lemma seen_shown u : (s < states A)%nat -> admw A s u ->
  comparable N (V (stw A s u)) (act N (R (stw A s u))) (fun x => act N P (Ww A s u x)).
Proof.
  intros Hs Hu. apply (comparable_trans (V s) _ (act N (R s)) _ (act N P) (Ww A s u)); auto; [|apply words_shown; auto].
  intros x Hx. apply V_word; auto.
Qed.
End Shown.

(** Density: near the point of every address there are copies of chosen branches, where every state leads to a state that has one. *)
Section Density.
Variable A : automaton.
Notation N := (N A).
Notation nrm := (nrm N).
Hypothesis sys : contracting A.

Fixpoint letters (k : nat) (a : address) : list nat := match k with O => [] | S k => a O :: letters k (tl a) end.

Lemma letters_ok k : forall e a, adm A e a ->
  a = app (letters k a) (drop k a) /\ admw A e (letters k a) /\ stw A e (letters k a) = st A e a k /\ forall x, Ww A e (letters k a) x = W A e a k x.
Proof.
  induction k; intros e a Ha; simpl.
  - split; [reflexivity|]. auto.
  - destruct (IHk _ _ (adm_tl A e a Ha)) as (H1 & H2 & H3 & H4). split; [|split; [split; [apply (Ha O)|exact H2]|split; [exact H3|]]].
    + rewrite <- (cons_tl a) at 1. f_equal. exact H1.
    + intros x. rewrite H4. reflexivity.
Qed.

Lemma phi_far : exists B, 0 < B /\ forall e s t, (e < states A)%nat -> adm A e s -> adm A e t -> nrm (sub (phi A e s) (phi A e t)) <= B.
Proof.
  destruct sys as (Hwf & K & th & c & r & H1 & H2 & H3 & H4). exists (1 + 2 * sum (states A) r).
  assert (Hr : 0 <= sum (states A) r) by (apply sum_nonneg; auto). split; [lra|]. intros e s t He Hs Ht.
  pose proof (ball A Hwf K th c r H1 H2 H3 H4 e s He Hs) as B1. pose proof (ball A Hwf K th c r H1 H2 H3 H4 e t He Ht) as B2.
  pose proof (sum_term (states A) r e H2 He) as B3.
  replace (sub (phi A e s) (phi A e t)) with (sub (sub (phi A e s) (c e)) (sub (phi A e t) (c e))) by (extensionality i; unfold sub; ring).
  eapply Rle_trans; [apply nrm_sub|]. lra.
Qed.

Theorem copies_dense (P : matrix) (s : nat) (at_state : nat -> address -> Prop) : (s < states A)%nat ->
  (forall e, (e < states A)%nat -> exists w t, admw A e w /\ adm A (stw A e w) t /\ at_state (stw A e w) t) ->
  forall a eps, adm A s a -> 0 < eps -> exists u t, admw A s u /\ at_state (stw A s u) t /\
    nrm (act N P (sub (phi A s (app u t)) (phi A s a))) <= eps.
Proof.
  intros Hs Hways a eps Ha Heps. destruct phi_far as (B & HB & Hfar). pose proof sys as (Hwf & K & th & c & r & H1 & H2 & H3 & H4).
  destruct (contraction A Hwf K th c r H1 H4) as (C & v & HC & Hv & Hcon).
  set (S0 := size N P + 1). assert (HS : 0 < S0) by (unfold S0; pose proof (size_ge0 N P); lra).
  destruct (pow_lt_1_zero v) with (y := eps / (S0 * C * B)) as (k & Hk).
  { rewrite Rabs_pos_eq; lra. }
  { apply Rdiv_lt_0_compat; auto. repeat apply Rmult_lt_0_compat; auto. }
  specialize (Hk k (le_n k)). rewrite Rabs_pos_eq in Hk by (apply pow_le; lra).
  destruct (letters_ok k s a Ha) as (L1 & L2 & L3 & L4). set (w := letters k a) in *.
  pose proof (st_ok A Hwf k s a Hs Ha) as He. destruct (Hways _ He) as (x & t & X1 & X2 & X3).
  rewrite <- L3 in *. exists (w ++ x), t. rewrite (stw_app A w). split; [|split; [exact X3|]].
  - clear - L2 X1. revert s L2 X1. induction w as [|i w IH]; simpl; intros s L2 X1; auto. destruct L2. split; auto.
  - assert (E1 : phi A s (app (w ++ x) t) = Ww A s w (phi A (stw A s w) (app x t))).
    { rewrite app_app. apply (phi_app A sys); auto. apply adm_app. split; auto. apply adm_app. auto. }
    assert (Hd : adm A (stw A s w) (drop k a)) by (rewrite L3; apply adm_drop; auto).
    assert (E2 : phi A s a = Ww A s w (phi A (stw A s w) (drop k a))).
    { rewrite L1 at 1. apply (phi_app A sys); auto. apply adm_app. auto. }
    assert (Hx : adm A (stw A s w) (app x t)) by (apply adm_app; auto).
    rewrite E1, E2, <- Ww_sub. set (y := sub (phi A (stw A s w) (app x t)) (phi A (stw A s w) (drop k a))).
    assert (Hy : nrm y <= B) by (apply Hfar; auto).
    assert (Hflat : flat N (dim A (st A s a k)) y).
    { rewrite <- L3. apply bary_sub; apply (phi_bary' A sys); auto. }
    pose proof (Hcon k s a y Hs Ha Hflat) as Hc. rewrite <- L4 in Hc. fold w in Hc.
    assert (Hpow : 0 <= v ^ k) by (apply pow_le; lra). pose proof (nrm_ge0 N y). pose proof (nrm_ge0 N (Ww A s w y)).
    eapply Rle_trans; [apply nrm_act|]. apply Rle_trans with (S0 * (C * v ^ k * B)).
    + apply Rmult_le_compat; [apply size_ge0|auto|unfold S0; lra|]. eapply Rle_trans; [exact Hc|].
      apply Rmult_le_compat_l; auto. apply Rmult_le_pos; lra.
    + replace (S0 * (C * v ^ k * B)) with (v ^ k * (S0 * C * B)) by ring.
      assert (HX : 0 < S0 * C * B) by (repeat apply Rmult_lt_0_compat; auto). set (X := S0 * C * B) in *.
      apply (Rmult_lt_compat_r X) in Hk; auto. replace (eps / X * X) with eps in Hk by (field; lra). lra.
Qed.
End Density.
