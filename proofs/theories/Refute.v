(** Refutations: two limit directions of one germ (the corollary on [U], and the null component of Theorem 4), from two points
    of the attractor whose coordinates are known. *)
From Coq Require Import Reals Lra Lia List QArith Qabs Qreals Bool FunctionalExtensionality.
From Secant Require Export Replay.
Open Scope R_scope.


(** A second point of the attractor, by its address, and a space that the secants to it stay in: vectors that the matrix
    [stays] does not change. In the chart [proj] is a projection to eigenvectors that dominates. *)
Record direction_evidence := {
  tail : branch; tail_value : qvec;
  stays : qmat; along : chart;
  proj : qmat; eigen : Q; turns_power : nat; turns_rate : Q;
  multiple : Q
}.

Section Refute.
Variable case : system.
Notation A := (automaton_of case).
Notation N := (ambient case).
Variables (centres : list qvec) (radii : list Q) (spaces : list qmat).

(** The secant to the point of the address [b], whose periodic part has the value [v]. *)
Definition offset (e : nat) (b : branch) (v q : qvec) : qvec := qsub N (qact N (qword case e (prefix b)) v) q.

Lemma offset_ok s b q other v : controlled case centres radii spaces -> let e := stw A s (prefix b) in
  let t := app (prefix other) (per (cycle other)) in
  check_cycle case s b q = true -> check_cycle case e other v = true -> (length q <= N)%nat ->
  adm A e t /\ sub (phi A e t) (qv q) = qv (offset e other v q).
Proof.
  intros (Hf & Hsys & _) e t H1 H2 H3.
  pose proof (check_cycle_ok case s b q Hf H1) as Hcyc. cbv zeta in Hcyc. destruct Hcyc as (Hs & Hu & _).
  pose proof (stw_ok A Hsys _ s Hs Hu) as He.
  pose proof (check_cycle_ok case e other v Hf H2) as Hcyc. cbv zeta in Hcyc.
  destruct Hcyc as (_ & Hu2 & Hw2 & Hne2 & Hcl2 & Hq2 & Hfix2).
  pose proof (stw_ok A Hsys _ e He Hu2) as He2. pose proof (dim_ok A (wf A Hsys) _ He2) as Hd2. specialize (Hfix2 He2 (proj2 Hd2)).
  assert (Hadm : adm A e t).
  { apply adm_app. split; auto. apply (adm_per A Hsys e other (qv v)); auto. }
  split; auto.
  unfold offset, t. rewrite qsub_ok; auto; [|unfold qact; rewrite tab_length; auto].
  rewrite qact_ok by apply qword_len. f_equal. rewrite (phi_app A Hsys); auto.
  rewrite (phi_per A Hsys e other (qv v)); auto.
  symmetry. apply qword_ok; auto. intros i Hi. apply Hq2. eapply Nat.le_trans; [apply Hd2|exact Hi].
Qed.

(** A space that a cycle keeps, as vectors that a matrix does not change. *)
Lemma stays_ok s b q K : controlled case centres radii spaces -> let e := stw A s (prefix b) in let M := qword case e (cycle b) in
  check_cycle case s b q = true -> (length K <= N)%nat -> qeqm N (qmul N K (qmul N M K)) (qmul N M K) = true ->
  forall y, fixed_by case K y -> fixed_by case K (Ww A e (cycle b) y).
Proof.
  intros (Hf & Hsys & _) e M H1 Hl H y Hy.
  pose proof (check_cycle_ok case s b q Hf H1) as Hcyc. cbv zeta in Hcyc. destruct Hcyc as (Hs & Hu & Hw & _).
  pose proof (stw_ok A Hsys _ s Hs Hu) as He. fold e in Hw, He.
  unfold fixed_by in *. pose proof (qeqm_ok N _ _ y H) as E. rewrite !qmul_ok in E by (auto; apply qword_len).
  simpl in *. rewrite !Hy in E. unfold M in E. rewrite (qword_ok case (cycle b) Hf) in E; auto.
  intros i Hi. rewrite <- Hy. apply (short_act case K y Hl i Hi).
Qed.

Definition check_limit (P : qmat) (s : nat) (b : branch) (q : qvec) (c : direction_evidence) (d : qvec) : bool :=
  let e := stw A s (prefix b) in
  let M := qword case e (cycle b) in
  let L := turn (along c) in let F := proj c in let y := qact N (coordinates (along c)) (offset e (tail c) (tail_value c) q) in
  check_cycle case s b q && check_cycle case e (tail c) (tail_value c) && (length q <=? N) && (length d <=? N) &&
  qeqv N (qact N (stays c) (offset e (tail c) (tail_value c) q)) (offset e (tail c) (tail_value c) q) && qeqm N (qmul N (stays c) (qmul N M (stays c))) (qmul N M (stays c)) &&
  check_chart case (stays c) P (qword case s (prefix b)) M (along c) &&
  (length F <=? N) && qeqm N (qmul N L F) (qsclm N (eigen c) F) && qeqm N (qmul N F L) (qsclm N (eigen c) F) && qeqm N (qmul N F F) F &&
  negb (Qeq_bool (eigen c) 0) && (0 <? turns_power c) && Qle_bool 0 (turns_rate c) &&
  Qlt_bool (turns_rate c) (qpow (turns_power c) (Qabs (eigen c))) &&
  Qle_bool (qcolumn N (qmul N (qmpow N (turns_power c) L) (qsubm N (qid N) F))) (turns_rate c) &&
  negb (Qeq_bool (multiple c) 0) && Qlt_bool 0 (qnrm N d) &&
  qeqv N (qact N (seen (along c)) (qact N F y)) (qscl N (multiple c) d).

Lemma limit_line_scale P s b a d : limit_line A P s b (scl a d) -> limit_line A P s b d.
Proof.
  intros H eps m He. destruct (H eps m He) as (n & t & Hn & Ht & Hp & c & Hc). exists n, t. split; auto. split; auto.
  split; auto. exists (c * a). replace (scl (c * a) d) with (scl c (scl a d)) by (extensionality i; unfold scl; ring). auto.
Qed.

Theorem limit_ok P s b q c d : controlled case centres radii spaces -> check_limit P s b q c d = true ->
  limit_line A (qm P) s b (qv d).
Proof.
  intros Hcase H. pose proof Hcase as (Hf & Hsys & Hball & Hbase & Hspan). unfold check_limit in H. rewrite !andb_true_iff in H.
  destruct H as [[[[[[[[[[[[[[[[[[H1 H2] H3] H4] H5] H6] H7] H8] H9] H10] H11] H12] H13] H14] H15] H16] H17] H18] H19].
  set (e := stw A s (prefix b)) in *. set (M := qword case e (cycle b)) in *. set (x := offset e (tail c) (tail_value c) q) in *.
  set (F := proj c) in *. set (L := turn (along c)) in *.
  apply Nat.leb_le in H3, H4, H8. apply Nat.ltb_lt in H13.
  pose proof (check_cycle_ok case s b q Hf H1) as Hcyc. cbv zeta in Hcyc. destruct Hcyc as (Hs & Hu & Hw & Hne & Hcl & Hq & Hfix).
  pose proof (stw_ok A Hsys _ s Hs Hu) as He. pose proof (dim_ok A (wf A Hsys) _ He) as Hd. specialize (Hfix He (proj2 Hd)).
  destruct (offset_ok s b q (tail c) (tail_value c) Hcase H1 H2 H3) as (Hadm & Hx).
  fold e in Hw, Hcl, Hq, Hfix, He, Hd.
  set (t := app (prefix (tail c)) (per (cycle (tail c)))).
  fold e t in Hadm, Hx. fold x in Hx.
  assert (Hlen : (length (coordinates (along c)) <= N)%nat /\ (length L <= N)%nat /\ (length (seen (along c)) <= N)%nat /\ (length (stays c) <= N)%nat).
  { unfold check_chart in H7. rewrite !andb_true_iff, !Nat.leb_le in H7. unfold L. tauto. }
  destruct Hlen as (Hl1 & Hl2 & Hl3 & Hl4).
  assert (HVx : fixed_by case (stays c) (qv x)).
  { unfold fixed_by. simpl. rewrite <- qact_ok by auto. apply (qeqv_ok N); auto. }
  assert (HVL : forall y, fixed_by case (stays c) y -> fixed_by case (stays c) (Ww A e (cycle b) y)).
  { exact (stays_ok s b q (stays c) Hcase H1 Hl4 H6). }
  assert (Hlam : Q2R (eigen c) <> 0) by (apply nonzero; auto).
  set (Lc := act N (qm L)).
  assert (HFL : forall y, act N (qm F) (Lc y) = scl (Q2R (eigen c)) (act N (qm F) y)).
  { intros y. unfold Lc. rewrite <- qmul_ok, <- qsclm_ok by auto. apply qeqm_ok; auto. }
  assert (HLF : forall y, Lc (act N (qm F) y) = scl (Q2R (eigen c)) (act N (qm F) y)).
  { intros y. unfold Lc. rewrite <- qmul_ok, <- qsclm_ok by auto. apply qeqm_ok; auto. }
  assert (HFF : forall y, act N (qm F) (act N (qm F) y) = act N (qm F) y).
  { intros y. rewrite <- qmul_ok by auto. apply qeqm_ok; auto. }
  assert (Hleads : leads N (short case) Lc (act N (qm F)) (fun m => Q2R (eigen c) ^ m)).
  { apply (leads_semisimple N (short case) Lc (1 + size N (qm L))) with (k := turns_power c) (eta := Q2R (turns_rate c)) (Bp := size N (qm F)); auto.
    - intros y z Hy Hz i Hi. unfold add. rewrite Hy, Hz by auto. ring.
    - intros a y Hy i Hi. unfold scl. rewrite Hy by auto. ring.
    - intros; apply act_add.
    - intros; apply act_scl.
    - intros; apply short_act; auto.
    - pose proof (size_ge0 N (qm L)). lra.
    - intros y _. pose proof (nrm_act N (qm L) y). pose proof (nrm_ge0 N y). unfold Lc. lra.
    - intros; apply short_act; auto.
    - intros y _. rewrite act_sub, HFF. extensionality i; unfold sub, scl; ring.
    - intros y _. apply nrm_act.
    - split; [apply Q2R_le in H14; rewrite Q2R_0 in H14; auto|]. apply Q2R_lt in H15. rewrite qpow_ok, Q2R_abs in H15. auto.
    - intros y Hy H0. unfold Lc. rewrite <- qmpow_ok by auto.
      replace (act N (qm (qmpow N (turns_power c) L)) y)
        with (act N (qm (qmul N (qmpow N (turns_power c) L) (qsubm N (qid N) F))) y).
      + eapply Rle_trans; [apply qcolumn_ok|]. apply Rmult_le_compat_r; [apply nrm_ge0|apply Q2R_le; auto].
      + rewrite qmul_ok by apply qmpow_len. f_equal. rewrite qsubm_ok; auto; [|unfold qid; rewrite tab_length; auto].
        rewrite qid_ok by auto. rewrite H0. extensionality i; unfold sub, scl; ring. }
  assert (Hdir : act N (qm (seen (along c))) (act N (qm F) (act N (qm (coordinates (along c))) (qv x))) = scl (Q2R (multiple c)) (qv d)).
  { apply qeqv_ok in H19. rewrite !qact_ok, qscl_ok in H19 by auto. exact H19. }
  apply (limit_line_scale _ _ _ (Q2R (multiple c))). rewrite <- Hdir, <- Hx.
  apply (limit_intro A Hsys s b (qv q) Hs Hu Hw Hne Hcl Hq Hfix (qm P) (qm (coordinates (along c))) (qm (seen (along c)))
    Lc (short case) (fun t' => t' = t)) with (scale := fun m => Q2R (eigen c) ^ m); auto.
  - intros t' Ht' _. apply short_act; auto.
  - intros k t' Ht' ->. fold e. change (Automaton.N A) with N. rewrite Hx.
    apply (chart_ok case (stays c) P s (prefix b) (cycle b) (along c)); auto.
  - fold e. change (Automaton.N A) with N. rewrite Hx, Hdir, nrm_scl. apply Rmult_lt_0_compat; [apply Rabs_pos_lt; auto; apply nonzero; auto|].
    apply Q2R_lt in H18. rewrite Q2R_0, qnrm_ok in H18. auto.
Qed.

(** The same, where several turns are taken for one. *)
Definition turned (r : nat) (b : branch) : branch := {| prefix := prefix b; cycle := concat (repeat (cycle b) r) |}.

Theorem limit_turned P s b q r c d : controlled case centres radii spaces ->
  (0 <? r) && check_cycle case s b q && check_limit P s (turned r b) q c d = true -> limit_line A (qm P) s b (qv d).
Proof.
  intros Hc H. rewrite !andb_true_iff in H. destruct H as [[H0 H1] H2]. apply Nat.ltb_lt in H0.
  pose proof (limit_ok P s (turned r b) q c d Hc H2) as Hl. destruct Hc as (Hf & Hsys & _).
  pose proof (check_cycle_ok case s b q Hf H1) as Hcyc. cbv zeta in Hcyc. destruct Hcyc as (Hs & Hu & Hw & Hne & Hcl & Hq & Hfix).
  pose proof (stw_ok A Hsys _ s Hs Hu) as He. pose proof (dim_ok A (wf A Hsys) _ He) as Hd.
  apply (limit_several A s b (qv q)) with (r := r); auto. apply Hfix; [exact He|exact (proj2 Hd)].
Qed.

(** Two limit directions on different lines: no line is tangent to the germ. *)
Theorem no_tangent_ok P s b q r1 r2 c1 c2 d1 d2 i j : controlled case centres radii spaces ->
  ((0 <? r1) && check_cycle case s b q && check_limit P s (turned r1 b) q c1 d1) &&
  ((0 <? r2) && check_cycle case s b q && check_limit P s (turned r2 b) q c2 d2) && independent case i j d1 d2 = true ->
  no_tangent A (qm P) s b.
Proof.
  intros Hc H (d & Hd & Ht). rewrite andb_true_iff in H. destruct H as [H H3]. rewrite andb_true_iff in H. destruct H as [H1 H2].
  apply independent_ok in H3. destruct H3 as (Hi & Hj & Hne).
  apply (no_common_tangent A (qm P) s b b (qv d1) (qv d2) i j); auto;
    [apply (limit_turned P s b q r1 c1)|apply (limit_turned P s b q r2 c2)|exists d]; auto.
Qed.
End Refute.
