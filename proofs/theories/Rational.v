(** Rational vectors and matrices as lists, what they mean, and computations with them that are proved right. *)
From Coq Require Import Reals Lra Lia List QArith Qabs Qreals Bool FunctionalExtensionality.
From Secant Require Import Vec.
Import ListNotations.
Open Scope R_scope.
Arguments Qred : simpl never.
Arguments Qmult : simpl never.
Arguments Qplus : simpl never.
Arguments Q2R : simpl never.

Definition qvec := list Q.
Definition qmat := list (list Q).

(** The meaning of a list of numbers, and of a list of rows. *)
Definition qv (l : qvec) : vec := fun i => Q2R (nth i l 0%Q).
Definition qm (M : qmat) : matrix := fun i j => Q2R (nth j (nth i M []) 0%Q).

Lemma Q2R_red x : Q2R (Qred x) = Q2R x.
Proof. apply Qeq_eqR, Qred_correct. Qed.

Lemma Q2R_0 : Q2R 0 = 0.
Proof. unfold Q2R; simpl; lra. Qed.

Lemma Q2R_1 : Q2R 1 = 1.
Proof. unfold Q2R; simpl; lra. Qed.

Lemma Q2R_abs x : Q2R (Qabs x) = Rabs (Q2R x).
Proof.
  destruct (Qlt_le_dec x 0) as [H|H].
  - rewrite (Qeq_eqR _ _ (Qabs_neg x (Qlt_le_weak _ _ H))), Q2R_opp.
    apply Qlt_Rlt in H. rewrite Q2R_0 in H. rewrite Rabs_left; auto.
  - rewrite (Qeq_eqR _ _ (Qabs_pos x H)). apply Qle_Rle in H. rewrite Q2R_0 in H. rewrite Rabs_pos_eq; auto.
Qed.

Lemma Q2R_le x y : Qle_bool x y = true -> Q2R x <= Q2R y.
Proof. intros H. apply Qle_Rle, Qle_bool_iff, H. Qed.

Lemma Q2R_eq x y : Qeq_bool x y = true -> Q2R x = Q2R y.
Proof. intros H. apply Qeq_eqR, Qeq_bool_iff, H. Qed.

Definition Qlt_bool (x y : Q) : bool := negb (Qle_bool y x).
Lemma Q2R_lt x y : Qlt_bool x y = true -> Q2R x < Q2R y.
Proof.
  unfold Qlt_bool. intros H. apply Qlt_Rlt, Qnot_le_lt. intros H1. apply Qle_bool_iff in H1.
  rewrite H1 in H. discriminate.
Qed.

Fixpoint qpow (k : nat) (x : Q) : Q := match k with O => 1%Q | S k => Qred (x * qpow k x) end.
Lemma qpow_ok k x : Q2R (qpow k x) = Q2R x ^ k.
Proof. induction k; simpl; [apply Q2R_1|]. rewrite Q2R_red, Q2R_mult, IHk. reflexivity. Qed.

Fixpoint qsum (n : nat) (f : nat -> Q) : Q := match n with O => 0%Q | S k => Qred (qsum k f + f k) end.
Lemma qsum_ok n f : Q2R (qsum n f) = sum n (fun i => Q2R (f i)).
Proof. induction n; simpl; [apply Q2R_0|]. rewrite Q2R_red, Q2R_plus, IHn. reflexivity. Qed.

Definition tab {B} (n : nat) (f : nat -> B) : list B := map f (seq 0 n).
Lemma tab_nth {B} n (f : nat -> B) i d : nth i (tab n f) d = if i <? n then f i else d.
Proof.
  unfold tab. destruct (Nat.ltb_spec i n).
  - rewrite nth_indep with (d' := f O) by (rewrite map_length, seq_length; auto).
    rewrite map_nth, seq_nth by auto. reflexivity.
  - apply nth_overflow. rewrite map_length, seq_length. auto.
Qed.
Lemma tab_length {B} n (f : nat -> B) : length (tab n f) = n.
Proof. unfold tab. rewrite map_length, seq_length. reflexivity. Qed.

Lemma forall_lt n (f : nat -> bool) : forallb f (seq 0 n) = true -> forall i, (i < n)%nat -> f i = true.
Proof. intros H i Hi. rewrite forallb_forall in H. apply H, in_seq. lia. Qed.

Lemma qv_short l i : (length l <= i)%nat -> qv l i = 0.
Proof. intros H. unfold qv. rewrite nth_overflow by auto. apply Q2R_0. Qed.

Lemma qm_short M i j : (length M <= i)%nat -> qm M i j = 0.
Proof. intros H. unfold qm. rewrite (nth_overflow M) by auto. destruct j; apply Q2R_0. Qed.

Definition qmax (l : list Q) : Q := fold_right (fun x y => if Qle_bool x y then y else x) 0%Q l.
Lemma qmax_ok l x : In x l -> Q2R x <= Q2R (qmax l).
Proof.
  induction l as [|y l IH]; simpl; [tauto|].
  destruct (Qle_bool y (qmax l)) eqn:E.
  - apply Q2R_le in E. intros [->|H]; auto.
  - assert (H1 : Q2R (qmax l) < Q2R y) by (apply Q2R_lt; unfold Qlt_bool; rewrite E; reflexivity).
    intros [->|H]; [lra|]. specialize (IH H). lra.
Qed.
Lemma qmax_ge0 l : 0 <= Q2R (qmax l).
Proof.
  induction l as [|y l IH]; simpl; [rewrite Q2R_0; lra|].
  destruct (Qle_bool y (qmax l)) eqn:E; auto.
  assert (H1 : Q2R (qmax l) < Q2R y) by (apply Q2R_lt; unfold Qlt_bool; rewrite E; reflexivity). lra.
Qed.

Section Dimension.
Variable N : nat.

Definition qnth (l : qvec) (i : nat) : Q := nth i l 0%Q.
Definition qent (M : qmat) (i j : nat) : Q := nth j (nth i M []) 0%Q.

Definition qscl (a : Q) (x : qvec) : qvec := tab N (fun i => Qred (a * qnth x i)).
Definition qadd (x y : qvec) : qvec := tab N (fun i => Qred (qnth x i + qnth y i)).
Definition qsub (x y : qvec) : qvec := tab N (fun i => Qred (qnth x i - qnth y i)).
Definition qdot (x y : qvec) : Q := qsum N (fun i => qnth x i * qnth y i)%Q.
Definition qnrm (x : qvec) : Q := qsum N (fun i => Qabs (qnth x i)).
Definition qact (M : qmat) (x : qvec) : qvec := tab N (fun i => qsum N (fun j => qent M i j * qnth x j)%Q).
Definition qrow (h : qvec) (M : qmat) : qvec := tab N (fun j => qsum N (fun i => qnth h i * qent M i j)%Q).
Definition qmul (A B : qmat) : qmat := tab N (fun i => tab N (fun j => qsum N (fun k => qent A i k * qent B k j)%Q)).
Definition qid : qmat := tab N (fun i => tab N (fun j => if i =? j then 1%Q else 0%Q)).
Definition qeqv (x y : qvec) : bool :=
  (length x <=? N) && (length y <=? N) && forallb (fun i => Qeq_bool (qnth x i) (qnth y i)) (seq 0 N).

Ltac in_or_out i := extensionality i; unfold qv, qscl, qadd, qsub, qact; rewrite tab_nth; destruct (Nat.ltb_spec i N) as [Hin|Hout].

Lemma qscl_ok a x : (length x <= N)%nat -> qv (qscl a x) = scl (Q2R a) (qv x).
Proof.
  intros Hx. in_or_out i; unfold scl.
  - rewrite Q2R_red, Q2R_mult. reflexivity.
  - rewrite (nth_overflow x) by lia. rewrite Q2R_0. ring.
Qed.

Lemma qadd_ok x y : (length x <= N)%nat -> (length y <= N)%nat -> qv (qadd x y) = add (qv x) (qv y).
Proof.
  intros Hx Hy. in_or_out i; unfold add.
  - rewrite Q2R_red, Q2R_plus. reflexivity.
  - rewrite (nth_overflow x), (nth_overflow y) by lia. rewrite Q2R_0. ring.
Qed.

Lemma qsub_ok x y : (length x <= N)%nat -> (length y <= N)%nat -> qv (qsub x y) = sub (qv x) (qv y).
Proof.
  intros Hx Hy. in_or_out i; unfold sub.
  - rewrite Q2R_red, Q2R_minus. reflexivity.
  - rewrite (nth_overflow x), (nth_overflow y) by lia. rewrite Q2R_0. ring.
Qed.

Lemma qdot_ok x y : Q2R (qdot x y) = dot N (qv x) (qv y).
Proof. unfold qdot, dot. rewrite qsum_ok. apply sum_ext; intros. apply Q2R_mult. Qed.

Lemma qnrm_ok x : Q2R (qnrm x) = nrm N (qv x).
Proof. unfold qnrm, nrm. rewrite qsum_ok. apply sum_ext; intros. apply Q2R_abs. Qed.

Lemma qact_ok M x : (length M <= N)%nat -> qv (qact M x) = act N (qm M) (qv x).
Proof.
  intros HM. in_or_out i; unfold act.
  - rewrite qsum_ok. apply sum_ext; intros. apply Q2R_mult.
  - rewrite Q2R_0. symmetry. apply sum_0; intros. rewrite qm_short by lia. ring.
Qed.

Lemma qrow_ok h M x : dot N (qv (qrow h M)) x = dot N (qv h) (act N (qm M) x).
Proof.
  unfold dot, act. rewrite (sum_ext N _ (fun j => sum N (fun i => qv h i * (qm M i j * x j)))).
  - rewrite sum_swap. apply sum_ext; intros i Hi. apply sum_scal.
  - intros j Hj. unfold qv at 1, qrow. rewrite tab_nth. destruct (Nat.ltb_spec j N); [|lia].
    rewrite qsum_ok, Rmult_comm, <- sum_scal. apply sum_ext; intros i Hi. rewrite Q2R_mult.
    unfold qv, qm, qnth, qent. ring.
Qed.

Lemma qmul_ok A B x : (length A <= N)%nat -> act N (qm (qmul A B)) x = act N (qm A) (act N (qm B) x).
Proof.
  intros HA. extensionality i. unfold act. destruct (Nat.lt_ge_cases i N) as [Hi|Hi].
  - rewrite (sum_ext N (fun j => qm A i j * _) (fun k => sum N (fun j => qm A i k * (qm B k j * x j)))).
    + rewrite sum_swap. apply sum_ext; intros j Hj. unfold qm at 1, qmul. rewrite tab_nth.
      destruct (Nat.ltb_spec i N); [|lia]. rewrite tab_nth. destruct (Nat.ltb_spec j N); [|lia].
      rewrite qsum_ok, Rmult_comm, <- sum_scal. apply sum_ext; intros k Hk. rewrite Q2R_mult.
      unfold qm, qent. ring.
    + intros k Hk. symmetry. apply sum_scal.
  - rewrite !sum_0; auto; intros; rewrite qm_short; try lra; [lia|unfold qmul; rewrite tab_length; lia].
Qed.

Lemma qid_ok x : (forall i, (N <= i)%nat -> x i = 0) -> act N (qm qid) x = x.
Proof.
  intros Hx. extensionality i. unfold act. destruct (Nat.lt_ge_cases i N) as [Hi|Hi].
  - rewrite (sum_single N _ i Hi).
    + unfold qm, qid. rewrite tab_nth. destruct (Nat.ltb_spec i N); [|lia]. rewrite tab_nth.
      destruct (Nat.ltb_spec i N); [|lia]. rewrite Nat.eqb_refl, Q2R_1. ring.
    + intros j Hj Hne. unfold qm, qid. rewrite tab_nth. destruct (Nat.ltb_spec i N); [|lia]. rewrite tab_nth.
      destruct (Nat.ltb_spec j N); [|lia]. destruct (Nat.eqb_spec i j); [lia|]. rewrite Q2R_0. ring.
  - rewrite Hx by auto. apply sum_0; intros. rewrite qm_short; [lra|]. unfold qid. rewrite tab_length. auto.
Qed.

Lemma qeqv_ok x y : qeqv x y = true -> qv x = qv y.
Proof.
  unfold qeqv. rewrite !andb_true_iff, !Nat.leb_le. intros [[Hx Hy] H]. extensionality i.
  destruct (Nat.lt_ge_cases i N) as [Hi|Hi].
  - apply Q2R_eq. apply (forall_lt N _ H i Hi).
  - rewrite !qv_short by lia. reflexivity.
Qed.

Lemma qeqv_len x y : qeqv x y = true -> (length x <= N)%nat /\ (length y <= N)%nat.
Proof. unfold qeqv. rewrite !andb_true_iff, !Nat.leb_le. tauto. Qed.

(** Half the oscillation of a functional, and Dobrushin's coefficient. *)
Definition qosc (n : nat) (h : qvec) : Q :=
  qmax (flat_map (fun i => map (fun j => Qred ((qnth h i - qnth h j) / 2)) (seq 0 n)) (seq 0 n)).
Definition qtau (n : nat) (M : qmat) : Q :=
  qmax (flat_map (fun i => map (fun j => Qred (qsum N (fun k => Qabs (qent M k i - qent M k j)) / 2)) (seq 0 i)) (seq 0 n)).

Lemma qosc_ge0 n h : 0 <= Q2R (qosc n h).
Proof. apply qmax_ge0. Qed.

Lemma qtau_ge0 n M : 0 <= Q2R (qtau n M).
Proof. apply qmax_ge0. Qed.

Lemma half x : Q2R (x / 2) = Q2R x / 2.
Proof. unfold Qdiv. rewrite Q2R_mult. unfold Q2R at 2; simpl. lra. Qed.

Lemma qosc_ok n h i j : (i < n)%nat -> (j < n)%nat -> qv h i - qv h j <= 2 * Q2R (qosc n h).
Proof.
  intros Hi Hj. assert (H : In (Qred ((qnth h i - qnth h j) / 2)) (flat_map (fun i => map (fun j => Qred ((qnth h i - qnth h j) / 2)) (seq 0 n)) (seq 0 n))).
  { apply in_flat_map. exists i. split; [apply in_seq; lia|]. apply in_map_iff. exists j. split; auto. apply in_seq; lia. }
  apply qmax_ok in H. rewrite Q2R_red, half, Q2R_minus in H. unfold qosc, qv. unfold qnth at 1 2 in H. lra.
Qed.

Lemma qosc_bound n h x : (n <= N)%nat -> flat N n x -> Rabs (dot N (qv h) x) <= Q2R (qosc n h) * nrm N x.
Proof. intros Hn Hx. apply (osc_bound N n); auto; [apply qosc_ge0|]. intros; apply qosc_ok; auto. Qed.

Lemma qtau_ok n M : tau_le N n (qm M) (Q2R (qtau n M)).
Proof.
  assert (H1 : forall i j, (j < i)%nat -> (i < n)%nat -> sum N (fun k => Rabs (qm M k i - qm M k j)) <= 2 * Q2R (qtau n M)).
  { intros i j Hj Hi.
    assert (H : In (Qred (qsum N (fun k => Qabs (qent M k i - qent M k j)) / 2)) (flat_map (fun i => map (fun j => Qred (qsum N (fun k => Qabs (qent M k i - qent M k j)) / 2)) (seq 0 i)) (seq 0 n))).
    { apply in_flat_map. exists i. split; [apply in_seq; lia|]. apply in_map_iff. exists j. split; auto. apply in_seq; lia. }
    apply qmax_ok in H. rewrite Q2R_red, half, qsum_ok in H.
    rewrite (sum_ext N _ (fun k => Rabs (qm M k i - qm M k j))) in H.
    - unfold qtau. lra.
    - intros k Hk. rewrite Q2R_abs, Q2R_minus. reflexivity. }
  intros i j Hi Hj. destruct (Nat.lt_trichotomy i j) as [H|[->|H]]; auto.
  - rewrite (sum_ext N _ (fun k => Rabs (qm M k j - qm M k i))); auto. intros; apply Rabs_minus_sym.
  - rewrite sum_0; [pose proof (qtau_ge0 n M); lra|]. intros. rewrite Rminus_diag_eq, Rabs_R0; auto.
Qed.

Lemma qtau_bound n M x : (n <= N)%nat -> flat N n x -> nrm N (act N (qm M) x) <= Q2R (qtau n M) * nrm N x.
Proof. intros Hn Hx. apply (tau_bound N n); auto; [apply qtau_ge0|apply qtau_ok]. Qed.

Definition qbary (n : nat) (x : qvec) : bool := (length x <=? n) && Qeq_bool (qsum N (qnth x)) 1.
Definition qflat (n : nat) (x : qvec) : bool := (length x <=? n) && Qeq_bool (qsum N (qnth x)) 0.

Lemma qbary_ok n x : qbary n x = true -> bary N n (qv x).
Proof.
  unfold qbary. rewrite andb_true_iff, Nat.leb_le. intros [H1 H2]. split.
  - intros; apply qv_short; lia.
  - apply Q2R_eq in H2. rewrite qsum_ok, Q2R_1 in H2. exact H2.
Qed.

Lemma qflat_ok n x : qflat n x = true -> flat N n (qv x).
Proof.
  unfold qflat. rewrite andb_true_iff, Nat.leb_le. intros [H1 H2]. split.
  - intros; apply qv_short; lia.
  - apply Q2R_eq in H2. rewrite qsum_ok, Q2R_0 in H2. exact H2.
Qed.

Lemma qbary_len n x : qbary n x = true -> (length x <= n)%nat.
Proof. unfold qbary. rewrite andb_true_iff, Nat.leb_le. tauto. Qed.
Lemma qflat_len n x : qflat n x = true -> (length x <= n)%nat.
Proof. unfold qflat. rewrite andb_true_iff, Nat.leb_le. tauto. Qed.

(** Powers of a matrix. *)
Fixpoint qmpow (k : nat) (M : qmat) : qmat := match k with O => qid | S k => qmul M (qmpow k M) end.

Lemma qmpow_ok k M x : (length M <= N)%nat -> (forall i, (N <= i)%nat -> x i = 0) ->
  act N (qm (qmpow k M)) x = Nat.iter k (act N (qm M)) x.
Proof.
  intros HM Hx. induction k; simpl; [apply qid_ok; auto|]. rewrite qmul_ok, IHk by auto. reflexivity.
Qed.

Lemma qmpow_len k M : (length (qmpow k M) <= N)%nat.
Proof. destruct k; simpl; [unfold qid|unfold qmul]; rewrite tab_length; auto. Qed.
End Dimension.

Section Columns.
Variable N : nat.

(** The norm of an operator: its largest column. *)
Definition qcolumn (M : qmat) : Q := qmax (map (fun j => qsum N (fun k => Qabs (qent M k j))) (seq 0 N)).

Lemma qcolumn_ok M x : nrm N (act N (qm M) x) <= Q2R (qcolumn M) * nrm N x.
Proof.
  unfold nrm at 1, act.
  apply Rle_trans with (sum N (fun i => sum N (fun j => Rabs (qm M i j) * Rabs (x j)))).
  - apply sum_le; intros i Hi. eapply Rle_trans; [apply sum_abs|]. apply sum_le; intros. rewrite Rabs_mult; lra.
  - rewrite sum_swap. unfold nrm. rewrite <- sum_scal. apply sum_le; intros j Hj.
    rewrite (sum_ext N _ (fun i => Rabs (x j) * Rabs (qm M i j))) by (intros; ring). rewrite sum_scal, Rmult_comm.
    apply Rmult_le_compat_r; [apply Rabs_pos|].
    assert (H : In (qsum N (fun k => Qabs (qent M k j))) (map (fun j => qsum N (fun k => Qabs (qent M k j))) (seq 0 N))).
    { apply in_map_iff. exists j. split; auto. apply in_seq. lia. }
    apply qmax_ok in H. rewrite qsum_ok in H. eapply Rle_trans; [|exact H]. right.
    apply sum_ext; intros. rewrite Q2R_abs. reflexivity.
Qed.

Definition qsubm (A B : qmat) : qmat := tab N (fun i => tab N (fun j => Qred (qent A i j - qent B i j))).
Definition qsclm (a : Q) (A : qmat) : qmat := tab N (fun i => tab N (fun j => Qred (a * qent A i j))).
Definition qeqm (A B : qmat) : bool :=
  (length A <=? N) && (length B <=? N) &&
  forallb (fun i => forallb (fun j => Qeq_bool (qent A i j) (qent B i j)) (seq 0 N)) (seq 0 N).

Lemma qsubm_ok A B x : (length A <= N)%nat -> (length B <= N)%nat ->
  act N (qm (qsubm A B)) x = sub (act N (qm A) x) (act N (qm B) x).
Proof.
  intros HA HB. extensionality i. unfold sub, act. rewrite <- sum_minus. apply sum_ext; intros j Hj.
  destruct (Nat.lt_ge_cases i N) as [Hi|Hi].
  - unfold qm at 1, qsubm. rewrite tab_nth. destruct (Nat.ltb_spec i N); [|lia]. rewrite tab_nth.
    destruct (Nat.ltb_spec j N); [|lia]. rewrite Q2R_red, Q2R_minus. unfold qm, qent. ring.
  - rewrite !qm_short; try lia; [ring|]. unfold qsubm. rewrite tab_length. lia.
Qed.

Lemma qsclm_ok a A x : (length A <= N)%nat -> act N (qm (qsclm a A)) x = scl (Q2R a) (act N (qm A) x).
Proof.
  intros HA. extensionality i. unfold scl, act. rewrite <- sum_scal. apply sum_ext; intros j Hj.
  destruct (Nat.lt_ge_cases i N) as [Hi|Hi].
  - unfold qm at 1, qsclm. rewrite tab_nth. destruct (Nat.ltb_spec i N); [|lia]. rewrite tab_nth.
    destruct (Nat.ltb_spec j N); [|lia]. rewrite Q2R_red, Q2R_mult. unfold qm, qent. ring.
  - rewrite !qm_short; try lia; [ring|]. unfold qsclm. rewrite tab_length. lia.
Qed.

Lemma qeqm_ok A B x : qeqm A B = true -> act N (qm A) x = act N (qm B) x.
Proof.
  unfold qeqm. rewrite !andb_true_iff, !Nat.leb_le. intros [[HA HB] H]. extensionality i. unfold act.
  apply sum_ext; intros j Hj. destruct (Nat.lt_ge_cases i N) as [Hi|Hi].
  - pose proof (forall_lt _ _ H i Hi) as H1. cbv beta in H1. pose proof (forall_lt _ _ H1 j Hj) as H2. cbv beta in H2.
    apply Q2R_eq in H2. unfold qm. unfold qent in H2. rewrite H2. ring.
  - rewrite !qm_short by lia. ring.
Qed.
End Columns.
