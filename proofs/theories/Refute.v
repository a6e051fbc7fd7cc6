(** Refutations: two limit directions of one germ (the corollary on [U], and the null component of Theorem 4), from two points
    of the attractor whose coordinates are known. *)
From Coq Require Import Reals Lra Lia List QArith Qabs Qreals Bool FunctionalExtensionality.
From Secant Require Export Replay.
Open Scope R_scope.

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

(** A second point of the attractor, by its address, and the subspace that its secants stay in: vectors that the matrix
    [space] does not change; there [proj] is a projection to eigenvectors that dominates. *)
Record direction_evidence := {
  tail : branch; tail_value : qvec;
  space : qmat; proj : qmat; eigen : Q; turns_power : nat; turns_rate : Q;
  multiple : Q
}.

Section Refute.
Variable case : system.
Notation A := (automaton_of case).
Notation N := (ambient case).
Variables (centres : list qvec) (radii : list Q).

Definition offset (e : nat) (c : direction_evidence) (q : qvec) : qvec :=
  qsub N (qact N (qword case e (prefix (tail c))) (tail_value c)) q.

Definition check_limit (P : qmat) (s : nat) (b : branch) (q : qvec) (c : direction_evidence) (d : qvec) : bool :=
  let e := stw A s (prefix b) in
  let M := qword case e (cycle b) in
  let V := space c in let F := qmul N (proj c) V in
  check_cycle case s b q && check_cycle case e (tail c) (tail_value c) &&
  (length V <=? N) && (length (proj c) <=? N) && (length P <=? N) && (length d <=? N) && (length q <=? N) &&
  qeqv N (qact N V (offset e c q)) (offset e c q) &&
  qeqm N (qmul N V (qmul N M V)) (qmul N M V) && qeqm N (qmul N V F) F &&
  qeqm N (qmul N M F) (qsclm N (eigen c) F) && qeqm N (qmul N (proj c) (qmul N M V)) (qsclm N (eigen c) F) &&
  qeqm N (qmul N (proj c) F) F &&
  negb (Qeq_bool (eigen c) 0) && (0 <? turns_power c) && Qle_bool 0 (turns_rate c) &&
  Qlt_bool (turns_rate c) (qpow (turns_power c) (Qabs (eigen c))) &&
  Qle_bool (qcolumn N (qmul N (qmpow N (turns_power c) M) (qsubm N V F))) (turns_rate c) &&
  negb (Qeq_bool (multiple c) 0) && Qlt_bool 0 (qnrm N d) &&
  qeqv N (qact N P (qact N (qword case s (prefix b)) (qact N (proj c) (offset e c q)))) (qscl N (multiple c) d).

Lemma limit_line_scale P s b a d : limit_line A P s b (scl a d) -> limit_line A P s b d.
Proof.
  intros H eps m He. destruct (H eps m He) as (n & t & Hn & Ht & Hp & c & Hc). exists n, t. split; auto. split; auto.
  split; auto. exists (c * a). replace (scl (c * a) d) with (scl c (scl a d)) by (extensionality i; unfold scl; ring). auto.
Qed.

Lemma nonzero x : negb (Qeq_bool x 0) = true -> Q2R x <> 0.
Proof.
  intros H H0. rewrite negb_true_iff in H. assert (E : (x == 0)%Q) by (apply eqR_Qeq; rewrite Q2R_0; auto).
  apply Qeq_bool_iff in E. congruence.
Qed.

Theorem limit_ok P s b q c d : controlled case centres radii -> check_limit P s b q c d = true ->
  limit_line A (qm P) s b (qv d).
Proof.
  intros (Hf & Hsys & Hball & Hcb) H. unfold check_limit in H. rewrite !andb_true_iff in H.
  destruct H as [[[[[[[[[[[[[[[[[[[[H1 H2] H3] H4] H5] H6] H7] H8] H9] H10] H11] H12] H13] H14] H15] H16] H17] H18] H19] H20] H21].
  set (e := stw A s (prefix b)) in *. set (M := qword case e (cycle b)) in *. set (x := offset e c q) in *.
  set (V := space c) in *. set (pr := proj c) in *.
  apply Nat.leb_le in H3, H4, H5, H6, H7. apply Nat.ltb_lt in H15.
  pose proof (check_cycle_ok case s b q Hf H1) as Hcyc. cbv zeta in Hcyc. destruct Hcyc as (Hs & Hu & Hw & Hne & Hcl & Hq & Hfix).
  pose proof (stw_ok A Hsys _ s Hs Hu) as He. pose proof (dim_ok A (wf A Hsys) _ He) as Hd. specialize (Hfix He (proj2 Hd)).
  pose proof (check_cycle_ok case e (tail c) (tail_value c) Hf H2) as Hcyc. cbv zeta in Hcyc.
  destruct Hcyc as (_ & Hu2 & Hw2 & Hne2 & Hcl2 & Hq2 & Hfix2).
  pose proof (stw_ok A Hsys _ e He Hu2) as He2. pose proof (dim_ok A (wf A Hsys) _ He2) as Hd2. specialize (Hfix2 He2 (proj2 Hd2)).
  fold e in Hw, Hcl, Hq, Hfix, He, Hd.
  assert (Hadm : adm A e (app (prefix (tail c)) (per (cycle (tail c))))).
  { apply adm_app. split; auto. apply (adm_per A Hsys e (tail c) (qv (tail_value c))); auto. }
  assert (Hx : sub (phi A e (app (prefix (tail c)) (per (cycle (tail c))))) (qv q) = qv x).
  { unfold x, offset. rewrite qsub_ok; auto; [|unfold qact; rewrite tab_length; auto].
    rewrite qact_ok by apply qword_len. f_equal. rewrite (phi_app A Hsys); auto.
    rewrite (phi_per A Hsys e (tail c) (qv (tail_value c))); auto.
    symmetry. apply qword_ok; auto. intros i Hi. apply Hq2. eapply Nat.le_trans; [apply Hd2|exact Hi]. }
  pose (V' := fun y : vec => act N (qm V) y = y).
  assert (Hsup : forall y, V' y -> forall i, (N <= i)%nat -> y i = 0).
  { intros y Hy i Hi. rewrite <- Hy. unfold act. apply sum_0; intros. rewrite qm_short by lia. ring. }
  assert (HM : forall y, V' y -> act N (qm M) y = Ww A e (cycle b) y).
  { intros y Hy. apply qword_ok; auto. }
  assert (HMl : (length M <= N)%nat) by apply qword_len.
  assert (Hml : forall X Y, (length (qmul N X Y) <= N)%nat) by (intros; unfold qmul; rewrite tab_length; auto).
  assert (HF : forall y, V' y -> act N (qm (qmul N pr V)) y = act N (qm pr) y).
  { intros y Hy. rewrite qmul_ok by auto. rewrite Hy. reflexivity. }
  assert (HMV : forall y, V' y -> act N (qm (qmul N M V)) y = Ww A e (cycle b) y).
  { intros y Hy. rewrite qmul_ok by auto. rewrite Hy. auto. }
  assert (HVL : forall y, V' y -> V' (Ww A e (cycle b) y)).
  { intros y Hy. unfold V'. rewrite <- (HMV y Hy), <- qmul_ok by auto. rewrite (HMV y Hy).
    rewrite <- (HMV y Hy). apply qeqm_ok; auto. }
  assert (HVp : forall y, V' y -> V' (act N (qm pr) y)).
  { intros y Hy. unfold V'. rewrite <- (HF y Hy), <- qmul_ok by auto. apply qeqm_ok; auto. }
  assert (Hlam : Q2R (eigen c) <> 0) by (apply nonzero; auto).
  assert (Hpow : forall k y, V' y -> act N (qm (qmpow N k M)) y = Nat.iter k (Ww A e (cycle b)) y /\ V' (Nat.iter k (Ww A e (cycle b)) y)).
  { intros k y Hy. rewrite qmpow_ok; auto. induction k as [|k [IH1 IH2]]; simpl; auto. rewrite IH1. auto. }
  assert (Hleads : leads N V' (Ww A e (cycle b)) (act N (qm pr)) (fun m => Q2R (eigen c) ^ m)).
  { apply (leads_semisimple N V' (Ww A e (cycle b)) (1 + size N (qm M))) with (k := turns_power c) (eta := Q2R (turns_rate c)) (Bp := size N (qm pr)); auto.
    - intros y z Hy Hz. unfold V'. rewrite act_add, Hy, Hz. reflexivity.
    - intros a y Hy. unfold V'. rewrite act_scl, Hy. reflexivity.
    - intros; apply Ww_add.
    - intros; apply Ww_scl.
    - pose proof (size_ge0 N (qm M)). lra.
    - intros y Hy. rewrite <- HM by auto. pose proof (nrm_act N (qm M) y). pose proof (nrm_ge0 N y). lra.
    - intros y Hy. rewrite <- (HM _ (HVp y Hy)), <- (HF y Hy), <- qmul_ok, <- qsclm_ok by auto. apply qeqm_ok; auto.
    - intros y Hy. rewrite <- (HMV y Hy), <- qmul_ok, <- (HF y Hy), <- qsclm_ok by auto. apply qeqm_ok; auto.
    - intros y Hy. rewrite act_sub. replace (act N (qm pr) (act N (qm pr) y)) with (act N (qm pr) y).
      + extensionality i; unfold sub, scl; ring.
      + rewrite <- (HF y Hy) at 2. rewrite <- qmul_ok by auto. rewrite <- (HF y Hy). symmetry. apply qeqm_ok; auto.
    - intros y Hy. apply nrm_act.
    - split; [apply Q2R_le in H16; rewrite Q2R_0 in H16; auto|]. apply Q2R_lt in H17. rewrite qpow_ok, Q2R_abs in H17. auto.
    - intros y Hy H0. destruct (Hpow (turns_power c) y Hy) as [E _]. rewrite <- E.
      replace (act N (qm (qmpow N (turns_power c) M)) y)
        with (act N (qm (qmul N (qmpow N (turns_power c) M) (qsubm N V (qmul N pr V)))) y).
      + eapply Rle_trans; [apply qcolumn_ok|]. apply Rmult_le_compat_r; [apply nrm_ge0|apply Q2R_le; auto].
      + rewrite qmul_ok by apply qmpow_len. f_equal. rewrite qsubm_ok by auto. rewrite Hy, (HF y Hy), H0.
        extensionality i; unfold sub, scl; ring. }
  assert (HVx : V' (qv x)).
  { unfold V'. rewrite <- qact_ok by auto. apply (qeqv_ok N); auto. }
  assert (Hdir : act N (qm P) (Ww A s (prefix b) (act N (qm pr) (qv x))) = scl (Q2R (multiple c)) (qv d)).
  { apply qeqv_ok in H21. rewrite !qact_ok in H21 by (auto; apply qword_len).
    rewrite qword_ok in H21 by (auto; apply Hsup; apply HVp; auto). rewrite qscl_ok in H21 by auto. exact H21. }
  apply (limit_line_scale _ _ _ (Q2R (multiple c))). rewrite <- Hdir, <- Hx.
  apply (limit_intro A Hsys s b (qv q) Hs Hu Hw Hne Hcl Hq Hfix (qm P) V' (act N (qm pr)) (fun m => Q2R (eigen c) ^ m)); auto.
  - unfold e in Hx. rewrite Hx. exact HVx.
  - unfold e in Hx. rewrite Hx. change (0 < nrm N (act N (qm P) (Ww A s (prefix b) (act N (qm pr) (qv x))))).
    rewrite Hdir, nrm_scl. apply Rmult_lt_0_compat; [apply Rabs_pos_lt, nonzero; auto|].
    apply Q2R_lt in H20. rewrite Q2R_0, qnrm_ok in H20. auto.
Qed.

(** Two limit directions on different lines: no line is tangent to the germ. *)
Theorem no_tangent_ok P s b q c1 c2 d1 d2 i j : controlled case centres radii ->
  check_limit P s b q c1 d1 && check_limit P s b q c2 d2 && independent case i j d1 d2 = true -> no_tangent A (qm P) s b.
Proof.
  intros Hc H (d & Hd & Ht). rewrite !andb_true_iff in H. destruct H as [[H1 H2] H3].
  apply independent_ok in H3. destruct H3 as (Hi & Hj & Hne).
  apply (no_common_tangent A (qm P) s b b (qv d1) (qv d2) i j); auto;
    [apply (limit_ok P s b q c1)|apply (limit_ok P s b q c2)|exists d]; auto.
Qed.
End Refute.
