(** Vectors of R^N with the 1-norm, operators given by matrices, and Dobrushin's coefficient.

    A vector is a function on the naturals of which only the first [N] values count for the norm. All states of an
    automaton live in one R^N, in its first coordinates; the others are 0. *)
From Coq Require Import Reals Lra Lia FunctionalExtensionality.
Open Scope R_scope.

Definition vec := nat -> R.
Definition matrix := nat -> nat -> R.

Fixpoint sum (n : nat) (f : nat -> R) : R :=
  match n with O => 0 | S k => sum k f + f k end.

Lemma sum_ext n f g : (forall i, (i < n)%nat -> f i = g i) -> sum n f = sum n g.
Proof. induction n; simpl; intros H; auto. rewrite IHn, (H n); auto. Qed.

Lemma sum_0 n f : (forall i, (i < n)%nat -> f i = 0) -> sum n f = 0.
Proof. induction n; simpl; intros H; auto. rewrite IHn, (H n); auto; lra. Qed.

Lemma sum_plus n f g : sum n (fun i => f i + g i) = sum n f + sum n g.
Proof. induction n; simpl; [lra|rewrite IHn; lra]. Qed.

Lemma sum_scal n a f : sum n (fun i => a * f i) = a * sum n f.
Proof. induction n; simpl; [lra|rewrite IHn; lra]. Qed.

Lemma sum_minus n f g : sum n (fun i => f i - g i) = sum n f - sum n g.
Proof. induction n; simpl; [lra|rewrite IHn; lra]. Qed.

Lemma sum_le n f g : (forall i, (i < n)%nat -> f i <= g i) -> sum n f <= sum n g.
Proof. induction n; simpl; intros H; [lra|]. apply Rplus_le_compat; auto. Qed.

Lemma sum_nonneg n f : (forall i, (i < n)%nat -> 0 <= f i) -> 0 <= sum n f.
Proof. intros H. rewrite <- (sum_0 n (fun _ => 0)) by auto. apply sum_le; auto. Qed.

Lemma sum_term n f i : (forall j, (j < n)%nat -> 0 <= f j) -> (i < n)%nat -> f i <= sum n f.
Proof.
  induction n; simpl; intros H Hi; [lia|].
  destruct (Nat.eq_dec i n) as [->|].
  - assert (0 <= sum n f) by (apply sum_nonneg; auto). lra.
  - assert (f i <= sum n f) by (apply IHn; auto; lia). assert (0 <= f n) by auto. lra.
Qed.

Lemma sum_abs n f : Rabs (sum n f) <= sum n (fun i => Rabs (f i)).
Proof.
  induction n; simpl; [rewrite Rabs_R0; lra|].
  eapply Rle_trans; [apply Rabs_triang|]. lra.
Qed.

Lemma sum_swap n m f : sum n (fun i => sum m (fun j => f i j)) = sum m (fun j => sum n (fun i => f i j)).
Proof.
  induction n; simpl.
  - symmetry. apply sum_0; auto.
  - rewrite IHn, <- sum_plus. reflexivity.
Qed.

Lemma sum_single n f i : (i < n)%nat -> (forall j, (j < n)%nat -> j <> i -> f j = 0) -> sum n f = f i.
Proof.
  induction n; simpl; intros Hi H; [lia|].
  destruct (Nat.eq_dec i n) as [->|].
  - rewrite sum_0; [lra|]. intros; apply H; lia.
  - rewrite IHn, (H n); try lia; [lra|]. intros; apply H; lia.
Qed.

Definition add (x y : vec) : vec := fun i => x i + y i.
Definition sub (x y : vec) : vec := fun i => x i - y i.
Definition scl (a : R) (x : vec) : vec := fun i => a * x i.
(** The first unit vector. *)
Definition unit0 : vec := fun i => match i with O => 1 | _ => 0 end.

Section Norm.
Variable N : nat.

Definition nrm (x : vec) : R := sum N (fun i => Rabs (x i)).
Definition dot (g x : vec) : R := sum N (fun j => g j * x j).
Definition act (A : matrix) (x : vec) : vec := fun i => sum N (fun j => A i j * x j).

Lemma nrm_ge0 x : 0 <= nrm x.
Proof. apply sum_nonneg; intros; apply Rabs_pos. Qed.

Lemma nrm_add x y : nrm (add x y) <= nrm x + nrm y.
Proof. unfold nrm, add. rewrite <- sum_plus. apply sum_le; intros; apply Rabs_triang. Qed.

Lemma nrm_scl a x : nrm (scl a x) = Rabs a * nrm x.
Proof. unfold nrm, scl. rewrite <- sum_scal. apply sum_ext; intros; apply Rabs_mult. Qed.

Lemma sub_add x y : sub x y = add x (scl (-1) y).
Proof. extensionality i; unfold sub, add, scl; ring. Qed.

Lemma nrm_sub x y : nrm (sub x y) <= nrm x + nrm y.
Proof.
  rewrite sub_add. eapply Rle_trans; [apply nrm_add|]. rewrite nrm_scl, Rabs_left by lra. lra.
Qed.

Lemma nrm_sub_sym x y : nrm (sub x y) = nrm (sub y x).
Proof. apply sum_ext; intros; unfold sub; apply Rabs_minus_sym. Qed.

Lemma nrm_tri x y z : nrm (sub x z) <= nrm (sub x y) + nrm (sub y z).
Proof.
  replace (sub x z) with (add (sub x y) (sub y z)) by (extensionality i; unfold sub, add; ring).
  apply nrm_add.
Qed.

Lemma nrm_back x y : nrm x <= nrm y + nrm (sub x y).
Proof.
  replace x with (add y (sub x y)) at 1 by (extensionality i; unfold sub, add; ring).
  apply nrm_add.
Qed.

Lemma coord_le x i : (forall j, (N <= j)%nat -> x j = 0) -> Rabs (x i) <= nrm x.
Proof.
  intros H. destruct (Nat.lt_ge_cases i N).
  - apply (sum_term N (fun j => Rabs (x j)) i); auto. intros; apply Rabs_pos.
  - rewrite H, Rabs_R0 by auto. apply nrm_ge0.
Qed.

Lemma nrm_0 x : (forall i, (i < N)%nat -> x i = 0) -> nrm x = 0.
Proof. intros H. apply sum_0; intros i Hi. rewrite H, Rabs_R0; auto. Qed.

Lemma nrm_eq0 x i : nrm x = 0 -> (i < N)%nat -> x i = 0.
Proof.
  intros H Hi. assert (Rabs (x i) <= nrm x).
  { apply (sum_term N (fun j => Rabs (x j)) i); auto. intros; apply Rabs_pos. }
  destruct (Req_dec (x i) 0); auto. assert (0 < Rabs (x i)) by (apply Rabs_pos_lt; auto). lra.
Qed.

Lemma some_coordinate x : 0 < nrm x -> exists i, (i < N)%nat /\ x i <> 0.
Proof.
  unfold nrm. generalize N as n. induction n; simpl; intros H; [lra|].
  destruct (Req_dec (x n) 0) as [H0|H0]; [|exists n; split; [lia|auto]].
  rewrite H0, Rabs_R0, Rplus_0_r in H. destruct (IHn H) as (i & Hi & Hx). exists i; split; [lia|auto].
Qed.

Lemma act_add A x y : act A (add x y) = add (act A x) (act A y).
Proof. extensionality i. unfold act, add. rewrite <- sum_plus. apply sum_ext; intros; ring. Qed.

Lemma act_scl A a x : act A (scl a x) = scl a (act A x).
Proof. extensionality i. unfold act, scl. rewrite <- sum_scal. apply sum_ext; intros; ring. Qed.

Lemma act_sub A x y : act A (sub x y) = sub (act A x) (act A y).
Proof. rewrite !sub_add, act_add, act_scl. reflexivity. Qed.

Lemma dot_add g x y : dot g (add x y) = dot g x + dot g y.
Proof. unfold dot, add. rewrite <- sum_plus. apply sum_ext; intros; ring. Qed.

Lemma dot_scl g a x : dot g (scl a x) = a * dot g x.
Proof. unfold dot, scl. rewrite <- sum_scal. apply sum_ext; intros; ring. Qed.

Lemma dot_sub g x y : dot g (sub x y) = dot g x - dot g y.
Proof. rewrite sub_add, dot_add, dot_scl. ring. Qed.

(** A crude bound of an operator on all of R^N. *)
Definition size (A : matrix) : R := sum N (fun j => sum N (fun k => Rabs (A k j))).

Lemma size_ge0 A : 0 <= size A.
Proof. apply sum_nonneg; intros; apply sum_nonneg; intros; apply Rabs_pos. Qed.

Lemma nrm_act A x : nrm (act A x) <= size A * nrm x.
Proof.
  unfold nrm at 1, act.
  apply Rle_trans with (sum N (fun i => sum N (fun j => Rabs (A i j) * Rabs (x j)))).
  - apply sum_le; intros i Hi. eapply Rle_trans; [apply sum_abs|].
    apply sum_le; intros. rewrite Rabs_mult; lra.
  - rewrite sum_swap. unfold size. rewrite Rmult_comm, <- sum_scal. apply sum_le; intros j Hj.
    rewrite <- sum_scal. apply sum_le; intros i Hi.
    rewrite Rmult_comm. apply Rmult_le_compat_r; [apply Rabs_pos|].
    apply (sum_term N (fun j => Rabs (x j)) j); auto. intros; apply Rabs_pos.
Qed.

Lemma dot_le g x : Rabs (dot g x) <= nrm g * nrm x.
Proof.
  unfold dot. eapply Rle_trans; [apply sum_abs|].
  unfold nrm at 1. rewrite Rmult_comm, <- sum_scal. apply sum_le; intros j Hj.
  rewrite Rabs_mult, Rmult_comm. apply Rmult_le_compat_r; [apply Rabs_pos|].
  apply (sum_term N (fun j => Rabs (x j)) j); auto. intros; apply Rabs_pos.
Qed.

(** [Z_n]: vectors of sum 0 in the first [n] coordinates; [BI^n]: vectors of sum 1. *)
Definition flat (n : nat) (x : vec) := (forall i, (n <= i)%nat -> x i = 0) /\ sum N x = 0.
Definition bary (n : nat) (x : vec) := (forall i, (n <= i)%nat -> x i = 0) /\ sum N x = 1.

Lemma bary_sub n x y : bary n x -> bary n y -> flat n (sub x y).
Proof.
  intros [H1 H2] [H3 H4]. split; unfold sub.
  - intros. rewrite H1, H3 by auto. ring.
  - rewrite sum_minus, H2, H4. ring.
Qed.

Lemma flat_add n x y : flat n x -> flat n y -> flat n (add x y).
Proof.
  intros [H1 H2] [H3 H4]. split; unfold add.
  - intros. rewrite H1, H3 by auto. ring.
  - rewrite sum_plus, H2, H4. ring.
Qed.

Lemma flat_scl n a x : flat n x -> flat n (scl a x).
Proof.
  intros [H1 H2]. split; unfold scl.
  - intros. rewrite H1 by auto. ring.
  - rewrite sum_scal, H2. ring.
Qed.

Lemma flat_sub n x y : flat n x -> flat n y -> flat n (sub x y).
Proof. intros. rewrite sub_add. apply flat_add; auto. apply flat_scl; auto. Qed.

Lemma bary_unit0 n : (1 <= n <= N)%nat -> bary n unit0.
Proof.
  intros Hn. split.
  - intros [|i] Hi; [lia|reflexivity].
  - rewrite (sum_single _ _ 0%nat); auto; [lia|]. intros [|j]; [lia|reflexivity].
Qed.

Lemma top_value n h : (0 < n)%nat -> exists a, (a < n)%nat /\ forall j, (j < n)%nat -> h j <= (h a : R).
Proof.
  induction n; intros Hn; [lia|]. destruct n.
  - exists 0%nat. split; [lia|]. intros j Hj. replace j with 0%nat by lia. lra.
  - destruct IHn as (a & Ha & H); [lia|]. destruct (Rle_lt_dec (h a) (h (S n))).
    + exists (S n). split; [lia|]. intros j Hj. destruct (Nat.eq_dec j (S n)) as [->|]; [lra|].
      eapply Rle_trans; [apply H; lia|auto].
    + exists a. split; [lia|]. intros j Hj. destruct (Nat.eq_dec j (S n)) as [->|]; [lra|]. apply H; lia.
Qed.

(** A functional on [Z_n] is at most half its oscillation. *)
Lemma osc_bound n h t x : (n <= N)%nat -> 0 <= t ->
  (forall i j, (i < n)%nat -> (j < n)%nat -> h i - h j <= 2 * t) -> flat n x -> Rabs (dot h x) <= t * nrm x.
Proof.
  intros Hn Ht Hosc [Hx Hs].
  assert (exists m, forall j, (j < n)%nat -> Rabs (h j - m) <= t) as (m & Hm).
  { destruct (Nat.eq_dec n 0) as [->|]; [exists 0; intros; lia|].
    destruct (top_value n h) as (a & Ha & Ha'); [lia|].
    destruct (top_value n (fun i => - h i)) as (b & Hb & Hb'); [lia|].
    exists ((h a + h b) / 2). intros j Hj. pose proof (Hosc a b Ha Hb). pose proof (Ha' j Hj).
    pose proof (Hb' j Hj). simpl in *. apply Rabs_le. lra. }
  replace (dot h x) with (sum N (fun j => (h j - m) * x j)).
  - eapply Rle_trans; [apply sum_abs|]. unfold nrm. rewrite <- sum_scal. apply sum_le; intros j Hj.
    rewrite Rabs_mult. destruct (Nat.lt_ge_cases j n).
    + apply Rmult_le_compat_r; [apply Rabs_pos|auto].
    + rewrite Hx, Rabs_R0 by auto. lra.
  - rewrite (sum_ext N _ (fun j => h j * x j - m * x j)) by (intros; ring).
    rewrite sum_minus, sum_scal, Hs. unfold dot. ring.
Qed.

(** Dobrushin's coefficient: [tau(A) <= t]. *)
Definition tau_le (n : nat) (A : matrix) (t : R) :=
  forall i j, (i < n)%nat -> (j < n)%nat -> sum N (fun k => Rabs (A k i - A k j)) <= 2 * t.

Lemma tau_bound n A t x : (n <= N)%nat -> 0 <= t -> tau_le n A t -> flat n x -> nrm (act A x) <= t * nrm x.
Proof.
  intros Hn Ht HA Hx.
  pose (s := fun k => if Rle_dec 0 (act A x k) then 1 else -1).
  assert (Hs : forall k, Rabs (s k) = 1) by (intro k; unfold s; destruct Rle_dec; [apply Rabs_pos_eq|rewrite Rabs_left]; lra).
  replace (nrm (act A x)) with (Rabs (dot (fun j => sum N (fun k => s k * A k j)) x)).
  - apply (osc_bound n); auto. intros i j Hi Hj. rewrite <- sum_minus.
    eapply Rle_trans; [apply Rle_abs|]. eapply Rle_trans; [apply sum_abs|].
    eapply Rle_trans; [|apply (HA i j Hi Hj)]. apply sum_le; intros k Hk.
    replace (s k * A k i - s k * A k j) with (s k * (A k i - A k j)) by ring.
    rewrite Rabs_mult, Hs. lra.
  - replace (dot (fun j => sum N (fun k => s k * A k j)) x) with (nrm (act A x)).
    + apply Rabs_pos_eq, nrm_ge0.
    + unfold dot. rewrite (sum_ext N _ (fun j => sum N (fun k => s k * (A k j * x j)))).
      * rewrite sum_swap. apply sum_ext; intros k Hk. rewrite sum_scal. unfold s, act.
        destruct Rle_dec; [rewrite Rabs_pos_eq by auto|rewrite Rabs_left by lra]; ring.
      * intros j Hj. rewrite Rmult_comm, <- sum_scal. apply sum_ext; intros; ring.
Qed.

End Norm.
