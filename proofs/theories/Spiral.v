(** Refutation by a complex pair: where one dominates on the space that the secants to one point stay in, neighbouring secants of
    these enclose an area that does not shrink against their lengths, and no line is tangent. *)
From Coq Require Import Reals Lra Lia List QArith Qabs Qreals Bool FunctionalExtensionality.
From Secant Require Export Refute.
Open Scope R_scope.

Section Recurrence.
Variables (a D : R) (x : nat -> R).
Hypothesis turning : a * a < 4 * D.
Hypothesis step : forall m, x (S (S m)) = a * x (S m) - D * x m.

Lemma D_pos : 0 < D.
Proof. pose proof (Rle_0_sqr a) as H. unfold Rsqr in H. lra. Qed.

(** The form [x'^2 - a x x' + D x^2] is multiplied by [D] in every step. *)
Lemma form_step m : x (S m) * x (S m) - a * x m * x (S m) + D * x m * x m =
  D ^ m * (x 1%nat * x 1%nat - a * x 0%nat * x 1%nat + D * x 0%nat * x 0%nat).
Proof.
  induction m; [simpl; ring|]. rewrite step. change (D ^ S m) with (D * D ^ m). match goal with |- _ = ?d * ?e * ?h =>
    transitivity (d * (e * h)); [|ring] end. rewrite <- IHm. ring.
Qed.

Lemma spiral_bound : exists K, 0 < K /\ forall m, Rabs (x m) <= K * sqrt D ^ m.
Proof.
  set (h := x 1%nat * x 1%nat - a * x 0%nat * x 1%nat + D * x 0%nat * x 0%nat).
  pose (k := D - a * a / 4). assert (Hk : 0 < k) by (unfold k; lra).
  pose proof D_pos as HD.
  assert (Hpow : forall m, 0 < sqrt D ^ m) by (intros; apply pow_lt, sqrt_lt_R0; auto).
  assert (Hsq : forall m, (sqrt D ^ m) * (sqrt D ^ m) = D ^ m).
  { intros m. rewrite <- Rpow_mult_distr, sqrt_sqrt by lra. reflexivity. }
  assert (Hform : forall m, k * (x m * x m) <= D ^ m * h).
  { intros m. unfold h. rewrite <- form_step. unfold k. pose proof (Rle_0_sqr (x (S m) - a / 2 * x m)) as H. unfold Rsqr in H. nra. }
  assert (Hh : 0 <= h) by (pose proof (Hform O) as H; simpl in H; nra).
  exists (1 + h / k). assert (Hhk : 0 <= h / k) by (apply Rmult_le_pos; [auto|left; apply Rinv_0_lt_compat; auto]).
  split; [lra|]. intros m. apply Rsqr_incr_0_var; [|apply Rmult_le_pos; [lra|left; auto]].
  rewrite <- Rsqr_abs. unfold Rsqr. replace ((1 + h / k) * sqrt D ^ m * ((1 + h / k) * sqrt D ^ m))
    with ((1 + h / k) * (1 + h / k) * D ^ m) by (rewrite <- Hsq; ring).
  assert (H1 : x m * x m <= D ^ m * (h / k)).
  { apply Rmult_le_reg_l with k; auto. replace (k * (D ^ m * (h / k))) with (D ^ m * h) by (field; lra). auto. }
  assert (0 < D ^ m) by (apply pow_lt; auto). nra.
Qed.
End Recurrence.

Section Pair.
Variable N : nat.
Notation nrm := (nrm N).
Variables (L : vec -> vec) (F : vec -> vec) (Q : matrix) (y : vec) (a D b : R) (k : nat) (eta : R) (i j : nat).
Notation pw m := (Nat.iter m L).
Notation short := (fun x : vec => forall i, (N <= i)%nat -> x i = 0).
Hypothesis L_add : forall x y, L (add x y) = add (L x) (L y).
Hypothesis L_scl : forall a x, L (scl a x) = scl a (L x).
Hypothesis L_short : forall x, short x -> short (L x).
Hypothesis b_ge1 : 1 <= b.
Hypothesis L_b : forall x, short x -> nrm (L x) <= b * nrm x.
Hypothesis y_short : short y.
Hypothesis F_short : short (F y).
Hypothesis turning : a * a < 4 * D.
Hypothesis pair : forall m, pw (S (S m)) (F y) = sub (scl a (pw (S m) (F y))) (scl D (pw m (F y))).
Variable rest : vec -> Prop.
Hypothesis rest_short : forall x, rest x -> short x.
Hypothesis rest_L : forall x, rest x -> rest (L x).
Hypothesis rest_y : rest (sub y (F y)).
Hypothesis k_pos : (0 < k)%nat.
Hypothesis eta_ok : 0 <= eta.
Hypothesis eta_small : eta * eta < D ^ k.
Hypothesis gap : forall x, rest x -> nrm (pw k x) <= eta * nrm x.
Hypothesis i_ok : (i < N)%nat.
Hypothesis j_ok : (j < N)%nat.
Definition minor (u v : vec) := u i * v j - u j * v i.
Notation z m := (act N Q (pw m y)).
Notation p m := (act N Q (pw m (F y))).
Hypothesis seen : minor (p 0) (p 1) <> 0.

Lemma minor_le u v : Rabs (minor u v) <= 2 * (nrm u * nrm v).
Proof.
  assert (H : forall x l, (l < N)%nat -> Rabs (x l) <= nrm x).
  { intros x l Hl. apply (sum_term N (fun j => Rabs (x j)) l); auto. intros; apply Rabs_pos. }
  unfold minor. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp, !Rabs_mult.
  pose proof (H u i i_ok). pose proof (H u j j_ok). pose proof (H v i i_ok). pose proof (H v j j_ok).
  pose proof (Rabs_pos (u i)). pose proof (Rabs_pos (u j)). pose proof (Rabs_pos (v i)). pose proof (Rabs_pos (v j)). nra.
Qed.

Lemma area m : minor (p m) (p (S m)) = D ^ m * minor (p 0) (p 1).
Proof.
  induction m; [simpl; ring|]. rewrite (pair m). rewrite act_sub, !act_scl.
  change (D ^ S m) with (D * D ^ m). rewrite Rmult_assoc, <- IHm. unfold minor, sub, scl. ring.
Qed.

Lemma pair_bound : exists K, 0 < K /\ forall m, nrm (p m) <= K * sqrt D ^ m.
Proof.
  assert (H : forall n, (n <= N)%nat -> exists K, 0 < K /\ forall m, sum n (fun l => Rabs (p m l)) <= K * sqrt D ^ m).
  { induction n as [|n IH]; intros Hn.
    - exists 1. split; [lra|]. intros m. simpl. assert (0 <= sqrt D ^ m) by (apply pow_le, sqrt_pos). lra.
    - destruct IH as (K1 & HK1 & H1); [lia|].
      destruct (spiral_bound a D (fun m => p m n) turning) as (K2 & HK2 & H2).
      { intros m. rewrite pair, act_sub, !act_scl. reflexivity. }
      exists (K1 + K2). split; [lra|]. intros m. simpl. specialize (H1 m). specialize (H2 m). simpl in H2. lra. }
  apply (H N). auto.
Qed.

(** The minors of neighbouring secants are not small against their lengths. *)
Lemma spiral_apart : exists K m0, 0 < K /\ forall m, (m0 <= m)%nat ->
  nrm (z m) <= K * sqrt D ^ m /\ Rabs (minor (p 0) (p 1)) / 2 * D ^ m <= Rabs (minor (z m) (z (S m))).
Proof.
  set (w0 := Rabs (minor (p 0) (p 1))). assert (Hw : 0 < w0) by (apply Rabs_pos_lt; auto).
  destruct pair_bound as (K & HK & HB). pose proof (D_pos a D turning) as HD. pose (rho := sqrt D).
  assert (Hr : 0 < rho) by (apply sqrt_lt_R0; auto). assert (Hrr : rho * rho = D) by (apply sqrt_sqrt; lra).
  pose (S0 := 1 + size N Q). assert (HS : 1 <= S0) by (unfold S0; pose proof (size_ge0 N Q); lra).
  pose (n0 := nrm (sub y (F y)) + 1). assert (Hn0 : 1 <= n0) by (unfold n0; pose proof (nrm_ge0 N (sub y (F y))); lra).
  pose (e := Rmin 1 (w0 / (4 * (2 * K + 1) * (1 + rho)))).
  assert (Hden : 0 < 4 * (2 * K + 1) * (1 + rho)) by nra.
  assert (He : 0 < e) by (unfold e; apply Rmin_glb_lt; [lra|apply Rdiv_lt_0_compat; auto]).
  assert (He1 : e <= 1) by apply Rmin_l.
  assert (He2 : e * (4 * (2 * K + 1) * (1 + rho)) <= w0).
  { apply Rle_trans with (w0 / (4 * (2 * K + 1) * (1 + rho)) * (4 * (2 * K + 1) * (1 + rho))).
    - apply Rmult_le_compat_r; [lra|apply Rmin_r].
    - right. field. nra. }
  assert (Heta : 0 <= eta < rho ^ k).
  { split; auto. apply Rsqr_incrst_0; auto; [|apply pow_le; lra]. unfold Rsqr.
    rewrite <- Rpow_mult_distr, Hrr. auto. }
  destruct (smaller N short L b L_short b_ge1 L_b rest k rho eta rest_short rest_L k_pos Hr Heta gap) with (eps := e / (S0 * n0)) as (m0 & Hm0).
  { apply Rdiv_lt_0_compat; auto. nra. }
  assert (Hz : forall m, (m0 <= m)%nat -> nrm (sub (z m) (p m)) <= e * rho ^ m).
  { intros m Hm. replace (sub (z m) (p m)) with (act N Q (pw m (sub y (F y)))).
    - eapply Rle_trans; [apply nrm_act|]. pose proof (Hm0 m Hm _ rest_y) as H1. pose proof (nrm_ge0 N (pw m (sub y (F y)))).
      assert (Hp : 0 < rho ^ m) by (apply pow_lt; auto).
      apply Rle_trans with (S0 * (e / (S0 * n0) * rho ^ m * n0)).
      + apply Rmult_le_compat; [apply size_ge0|auto|unfold S0; lra|]. eapply Rle_trans; [exact H1|].
        apply Rmult_le_compat_l; [|unfold n0; lra]. apply Rmult_le_pos; [|lra]. left. apply Rdiv_lt_0_compat; auto. nra.
      + right. field. split; lra.
    - rewrite <- act_sub. f_equal. rewrite !sub_add, (pw_add L L_add), (pw_scl L L_scl). reflexivity. }
  exists (K + 1), m0. split; [lra|]. intros m Hm. assert (Hp : 0 < rho ^ m) by (apply pow_lt; auto).
  assert (Hzm : forall m, (m0 <= m)%nat -> nrm (z m) <= (K + 1) * rho ^ m).
  { intros l Hl. pose proof (nrm_back N (z l) (p l)) as H1. pose proof (Hz l Hl). pose proof (HB l). fold rho in H0.
    assert (0 < rho ^ l) by (apply pow_lt; auto). nra. }
  split; [apply Hzm; auto|].
  assert (E : minor (z m) (z (S m)) = minor (p m) (p (S m)) + (minor (sub (z m) (p m)) (z (S m)) + minor (p m) (sub (z (S m)) (p (S m))))).
  { unfold minor, sub. ring. }
  assert (H1 : Rabs (minor (sub (z m) (p m)) (z (S m))) <= 2 * (e * rho ^ m * ((K + 1) * rho ^ S m))).
  { eapply Rle_trans; [apply minor_le|]. apply Rmult_le_compat_l; [lra|].
    apply Rmult_le_compat; [apply nrm_ge0|apply nrm_ge0|apply Hz; auto|apply Hzm; lia]. }
  assert (H2 : Rabs (minor (p m) (sub (z (S m)) (p (S m)))) <= 2 * (K * rho ^ m * (e * rho ^ S m))).
  { eapply Rle_trans; [apply minor_le|]. apply Rmult_le_compat_l; [lra|].
    apply Rmult_le_compat; [apply nrm_ge0|apply nrm_ge0|apply HB|apply Hz; lia]. }
  assert (HDm : rho ^ m * rho ^ m = D ^ m) by (rewrite <- Rpow_mult_distr, Hrr; reflexivity).
  assert (HDp : 0 < D ^ m) by (apply pow_lt; auto).
  assert (H3 : Rabs (minor (p m) (p (S m))) = D ^ m * w0).
  { rewrite area, Rabs_mult, (Rabs_pos_eq (D ^ m)) by lra. reflexivity. }
  assert (H4 : Rabs (minor (p m) (p (S m))) <= Rabs (minor (z m) (z (S m))) + (2 * (e * rho ^ m * ((K + 1) * rho ^ S m)) + 2 * (K * rho ^ m * (e * rho ^ S m)))).
  { replace (minor (p m) (p (S m))) with (minor (z m) (z (S m)) + - (minor (sub (z m) (p m)) (z (S m)) + minor (p m) (sub (z (S m)) (p (S m))))) by (rewrite E; ring).
    eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. apply Rplus_le_compat_l. eapply Rle_trans; [apply Rabs_triang|]. lra. }
  replace (2 * (e * rho ^ m * ((K + 1) * rho ^ S m)) + 2 * (K * rho ^ m * (e * rho ^ S m)))
    with (D ^ m * (e * (2 * (2 * K + 1) * rho))) in H4 by (rewrite <- HDm; simpl; ring).
  rewrite H3 in H4. assert (H5 : e * (2 * (2 * K + 1) * rho) <= w0 / 2) by nra. nra.
Qed.
End Pair.

Lemma minor_parallel N i j x x' d c c' eps : (i < N)%nat -> (j < N)%nat -> 0 <= eps <= 1 ->
  nrm N (sub x (scl c d)) <= eps * nrm N x -> nrm N (sub x' (scl c' d)) <= eps * nrm N x' ->
  Rabs (minor i j x x') <= 6 * (eps * (nrm N x * nrm N x')).
Proof.
  intros Hi Hj He H1 H2.
  assert (E : minor i j x x' = minor i j (sub x (scl c d)) x' + minor i j (scl c d) (sub x' (scl c' d))).
  { unfold minor, sub, scl. ring. }
  rewrite E. eapply Rle_trans; [apply Rabs_triang|].
  pose proof (minor_le N i j Hi Hj (sub x (scl c d)) x') as B1.
  pose proof (minor_le N i j Hi Hj (scl c d) (sub x' (scl c' d))) as B2.
  pose proof (nrm_back N (scl c d) x) as B3. rewrite nrm_sub_sym in B3.
  pose proof (nrm_ge0 N x). pose proof (nrm_ge0 N x'). pose proof (nrm_ge0 N (scl c d)).
  pose proof (nrm_ge0 N (sub x' (scl c' d))).
  assert (B4 : nrm N (sub x (scl c d)) * nrm N x' <= eps * nrm N x * nrm N x') by (apply Rmult_le_compat_r; auto).
  assert (B5 : nrm N (scl c d) <= 2 * nrm N x) by nra.
  assert (B6 : nrm N (scl c d) * nrm N (sub x' (scl c' d)) <= 2 * nrm N x * (eps * nrm N x')) by (apply Rmult_le_compat; auto).
  nra.
Qed.

(** A second point of the attractor, and a projection [plane] to a plane on which [L^2 = trace L - norm]. *)
Record spiral_evidence := {
  around : branch; around_value : qvec;
  around_stays : qmat; around_chart : chart;
  plane : qmat; trace : Q; norm : Q; plane_power : nat; plane_rate : Q; minor_of : nat * nat
}.

Section Replay.
Variable case : system.
Notation A := (automaton_of case).
Notation N := (ambient case).
Variables (centres : list qvec) (radii : list Q) (spaces : list qmat).

Definition check_spiral (P : qmat) (s : nat) (b : branch) (q : qvec) (c : spiral_evidence) : bool :=
  let e := stw A s (prefix b) in
  let M := qword case e (cycle b) in
  let L := turn (around_chart c) in let F := plane c in let x := offset case e (around c) (around_value c) q in
  let p := qact N F (qact N (coordinates (around_chart c)) x) in
  let p0 := qact N (seen (around_chart c)) p in let p1 := qact N (seen (around_chart c)) (qact N L p) in
  let i := fst (minor_of c) in let j := snd (minor_of c) in
  check_cycle case s b q && check_cycle case e (around c) (around_value c) && (length q <=? N) &&
  qeqv N (qact N (around_stays c) x) x && qeqm N (qmul N (around_stays c) (qmul N M (around_stays c))) (qmul N M (around_stays c)) &&
  check_chart case (around_stays c) P (qword case s (prefix b)) M (around_chart c) &&
  (length F <=? N) && qeqm N (qmul N F L) (qmul N L F) && qeqm N (qmul N F F) F &&
  qeqm N (qmul N L (qmul N L F)) (qsubm N (qsclm N (trace c) (qmul N L F)) (qsclm N (norm c) F)) &&
  Qlt_bool (trace c * trace c) (4 * norm c) && (0 <? plane_power c) && Qle_bool 0 (plane_rate c) &&
  Qlt_bool (plane_rate c * plane_rate c) (qpow (plane_power c) (norm c)) &&
  Qle_bool (qcolumn N (qmul N (qmpow N (plane_power c) L) (qsubm N (qid N) F))) (plane_rate c) &&
  (i <? N) && (j <? N) && negb (Qeq_bool (qnth p0 i * qnth p1 j - qnth p0 j * qnth p1 i) 0).

Theorem spiral_ok P s b q c : controlled case centres radii spaces -> check_spiral P s b q c = true -> no_tangent A (qm P) s b.
Proof.
  intros Hcase H. pose proof Hcase as (Hf & Hsys & Hball & Hbase & Hspan). unfold check_spiral in H. rewrite !andb_true_iff in H.
  destruct H as [[[[[[[[[[[[[[[[[H1 H2] H3] H4] H5] H6] H7] H8] H9] H10] H11] H12] H13] H14] H15] H16] H17] H18].
  set (e := stw A s (prefix b)) in *. set (M := qword case e (cycle b)) in *. set (x := offset case e (around c) (around_value c) q) in *.
  set (F := plane c) in *. set (L := turn (around_chart c)) in *. set (C := coordinates (around_chart c)) in *.
  apply Nat.leb_le in H3, H7. apply Nat.ltb_lt in H12, H16, H17.
  pose proof (check_cycle_ok case s b q Hf H1) as Hcyc. cbv zeta in Hcyc. destruct Hcyc as (Hs & Hu & Hw & Hne & Hcl & Hq & Hfix).
  pose proof (stw_ok A Hsys _ s Hs Hu) as He. pose proof (dim_ok A (wf A Hsys) _ He) as Hd. specialize (Hfix He (proj2 Hd)).
  destruct (offset_ok case centres radii spaces s b q (around c) (around_value c) Hcase H1 H2 H3) as (Hadm & Hx).
  fold e in Hw, Hcl, Hq, Hfix, He, Hd.
  set (t := app (prefix (around c)) (per (cycle (around c)))).
  fold e t in Hadm, Hx. fold x in Hx.
  assert (Hlen : (length C <= N)%nat /\ (length L <= N)%nat /\ (length (seen (around_chart c)) <= N)%nat /\ (length (around_stays c) <= N)%nat).
  { unfold check_chart in H6. rewrite !andb_true_iff, !Nat.leb_le in H6. unfold L, C. tauto. }
  destruct Hlen as (Hl1 & Hl2 & Hl3 & Hl4).
  assert (HVx : fixed_by case (around_stays c) (qv x)).
  { unfold fixed_by. simpl. rewrite <- qact_ok by auto. apply (qeqv_ok N); auto. }
  assert (HVL : forall y, fixed_by case (around_stays c) y -> fixed_by case (around_stays c) (Ww A e (cycle b) y)).
  { exact (stays_ok case centres radii spaces s b q (around_stays c) Hcase H1 Hl4 H5). }
  set (Lc := act N (qm L)). set (Fc := act N (qm F)). set (y := act N (qm C) (qv x)).
  assert (Hml : forall X Y, (length (qmul N X Y) <= N)%nat) by (intros; unfold qmul; rewrite tab_length; auto).
  assert (Hsl : forall a X, (length (qsclm N a X) <= N)%nat) by (intros; unfold qsclm; rewrite tab_length; auto).
  assert (HFL : forall z, Fc (Lc z) = Lc (Fc z)).
  { intros z. unfold Fc, Lc. rewrite <- !qmul_ok by auto. apply qeqm_ok; auto. }
  assert (HFF : forall z, Fc (Fc z) = Fc z).
  { intros z. unfold Fc. rewrite <- qmul_ok by auto. apply qeqm_ok; auto. }
  assert (HLL : forall z, Lc (Lc (Fc z)) = sub (scl (Q2R (trace c)) (Lc (Fc z))) (scl (Q2R (norm c)) (Fc z))).
  { intros z. pose proof (qeqm_ok N _ _ z H10) as E. rewrite !qmul_ok in E by auto. rewrite qsubm_ok, !qsclm_ok in E by auto.
    rewrite qmul_ok in E by auto. exact E. }
  apply Q2R_lt in H11. rewrite !Q2R_mult in H11. replace (Q2R 4) with 4 in H11 by (unfold Q2R; simpl; lra).
  apply Q2R_le in H13. rewrite Q2R_0 in H13. apply Q2R_lt in H14. rewrite Q2R_mult, qpow_ok in H14.
  assert (Hsz : forall z, Lc (scl 0 z) = scl 0 (Lc z)) by (intros; apply act_scl).
  assert (Hshort : forall z, short case (act N (qm L) z)) by (intros; apply short_act; auto).
  set (i := fst (minor_of c)) in *. set (j := snd (minor_of c)) in *.
  destruct (spiral_apart N Lc Fc (qm (seen (around_chart c))) y (Q2R (trace c)) (Q2R (norm c)) (1 + size N (qm L)) (plane_power c) (Q2R (plane_rate c)) i j)
    with (rest := fun z => short case z /\ Fc z = scl 0 z) as (K & m0 & HK & Hap); auto.
  { intros; apply act_add. }
  { intros; apply act_scl. }
  { intros; apply Hshort; auto. }
  { pose proof (size_ge0 N (qm L)). lra. }
  { intros z _. pose proof (nrm_act N (qm L) z). pose proof (nrm_ge0 N z). unfold Lc. lra. }
  { intros m. assert (Em : forall m, Nat.iter m Lc (Fc y) = Fc (Nat.iter m Lc y)).
    { induction m0 as [|m0 IH]; simpl; auto. rewrite IH, HFL. reflexivity. }
    simpl. rewrite Em. apply HLL. }
  { intros z [Hz _]. exact Hz. }
  { intros z [Hz1 Hz2]. split; [apply Hshort|]. rewrite HFL, Hz2. apply Hsz. }
  { split; [intros l Hl; unfold sub; rewrite (short_act case C (qv x) Hl1 l Hl : y l = 0), (short_act case F y H7 l Hl : Fc y l = 0); ring|].
    unfold Fc at 1. rewrite act_sub. fold Fc. change (act N (qm F) (Fc y)) with (Fc (Fc y)). rewrite HFF.
    change (act N (qm F) y) with (Fc y). extensionality l; unfold sub, scl; ring. }
  { intros z [Hz1 Hz2]. unfold Lc. rewrite <- qmpow_ok by auto.
    replace (act N (qm (qmpow N (plane_power c) L)) z)
      with (act N (qm (qmul N (qmpow N (plane_power c) L) (qsubm N (qid N) F))) z).
    - eapply Rle_trans; [apply qcolumn_ok|]. apply Rmult_le_compat_r; [apply nrm_ge0|apply Q2R_le; auto].
    - rewrite qmul_ok by apply qmpow_len. f_equal. rewrite qsubm_ok; auto; [|unfold qid; rewrite tab_length; auto].
      rewrite qid_ok by auto. change (act N (qm F) z) with (Fc z). rewrite Hz2. extensionality l; unfold sub, scl; ring. }
  { apply nonzero in H18. rewrite Q2R_minus, !Q2R_mult in H18. simpl. intros H0. apply H18.
    assert (E0 : qv (qact N (seen (around_chart c)) (qact N F (qact N C x))) = act N (qm (seen (around_chart c))) (Fc y)).
    { rewrite !qact_ok by auto. reflexivity. }
    assert (E1 : qv (qact N (seen (around_chart c)) (qact N L (qact N F (qact N C x)))) = act N (qm (seen (around_chart c))) (Lc (Fc y))).
    { rewrite !qact_ok by auto. reflexivity. }
    rewrite <- E0, <- E1 in H0. exact H0. }
  intros (d & Hd0 & Ht & _). fold (sqrt (Q2R (norm c))) in *.
  set (w0 := Rabs (minor i j (act N (qm (seen (around_chart c))) (Nat.iter 0 Lc (Fc y))) (act N (qm (seen (around_chart c))) (Nat.iter 1 Lc (Fc y))))) in *.
  assert (HD : 0 < Q2R (norm c)) by (apply (D_pos (Q2R (trace c))); auto).
  set (rho := sqrt (Q2R (norm c))) in *. assert (Hr : 0 < rho) by (apply sqrt_lt_R0; auto).
  assert (Hrr : rho * rho = Q2R (norm c)) by (apply sqrt_sqrt; lra).
  assert (Hw0 : 0 < w0).
  { apply Rabs_pos_lt. simpl. apply nonzero in H18. rewrite Q2R_minus, !Q2R_mult in H18. intros H0. apply H18.
    assert (E0 : qv (qact N (seen (around_chart c)) (qact N F (qact N C x))) = act N (qm (seen (around_chart c))) (Fc y)).
    { rewrite !qact_ok by auto. reflexivity. }
    assert (E1 : qv (qact N (seen (around_chart c)) (qact N L (qact N F (qact N C x)))) = act N (qm (seen (around_chart c))) (Lc (Fc y))).
    { rewrite !qact_ok by auto. reflexivity. }
    rewrite <- E0, <- E1 in H0. exact H0. }
  assert (Hden : 0 < 24 * (K * K * rho)) by (apply Rmult_lt_0_compat; [lra|apply Rmult_lt_0_compat; [apply Rmult_lt_0_compat; auto|auto]]).
  pose (eps := Rmin 1 (w0 / (24 * (K * K * rho)))).
  assert (He0 : 0 < eps) by (unfold eps; apply Rmin_glb_lt; [lra|apply Rdiv_lt_0_compat; auto]).
  assert (He1 : eps <= 1) by apply Rmin_l.
  assert (He3 : eps * (24 * (K * K * rho)) <= w0).
  { apply Rle_trans with (w0 / (24 * (K * K * rho)) * (24 * (K * K * rho))); [apply Rmult_le_compat_r; [lra|apply Rmin_r]|right; field].
    split; lra. }
  destruct (Ht eps He0) as (m1 & Hm1). set (m := (m0 + m1)%nat).
  assert (Hsec : forall m, secant A (qm P) s b m t = act N (qm (seen (around_chart c))) (Nat.iter m Lc y)).
  { intros l. rewrite (secant_eq A Hsys s b (qv q) Hs Hu Hw Hne Hcl Hq Hfix (qm P) l t Hadm). fold e.
    change (Automaton.N A) with N. rewrite Hx. apply (chart_ok case (around_stays c) P s (prefix b) (cycle b) (around_chart c)); auto. }
  destruct (Hap m ltac:(unfold m; lia)) as [Hz Harea]. destruct (Hap (S m) ltac:(unfold m; lia)) as [Hz' _].
  rewrite <- !Hsec in *. set (z := secant A (qm P) s b m t) in *. set (z' := secant A (qm P) s b (S m) t) in *.
  assert (Hpow : 0 < rho ^ m) by (apply pow_lt; auto).
  assert (Hsq : rho ^ m * rho ^ m = Q2R (norm c) ^ m) by (rewrite <- Rpow_mult_distr, Hrr; reflexivity).
  assert (Hmin : Rabs (minor i j z z') <= 6 * (eps * (nrm N z * nrm N z'))).
  { assert (Hzero : nrm N z * nrm N z' = 0 -> Rabs (minor i j z z') <= 6 * (eps * (nrm N z * nrm N z'))).
    { intros H0. pose proof (minor_le N i j H16 H17 z z') as Hl. rewrite H0 in *. lra. }
    destruct (Rle_lt_or_eq_dec 0 (nrm N z) (nrm_ge0 N z)) as [Pz|Pz]; [|apply Hzero; rewrite <- Pz; ring].
    destruct (Rle_lt_or_eq_dec 0 (nrm N z') (nrm_ge0 N z')) as [Pz'|Pz']; [|apply Hzero; rewrite <- Pz'; ring].
    destruct (Hm1 m t ltac:(unfold m; lia) Hadm Pz) as (c1 & _ & Hc1).
    destruct (Hm1 (S m) t ltac:(unfold m; lia) Hadm Pz') as (c2 & _ & Hc2).
    apply (minor_parallel N i j z z' d c1 c2 eps); auto; lra. }
  assert (Hprod : nrm N z * nrm N z' <= K * rho ^ m * (K * rho ^ S m)) by (apply Rmult_le_compat; auto; apply nrm_ge0).
  assert (Hlast : w0 / 2 * Q2R (norm c) ^ m <= 6 * (eps * (K * rho ^ m * (K * rho ^ S m)))).
  { eapply Rle_trans; [exact Harea|]. eapply Rle_trans; [exact Hmin|]. apply Rmult_le_compat_l; [lra|]. apply Rmult_le_compat_l; lra. }
  replace (6 * (eps * (K * rho ^ m * (K * rho ^ S m)))) with (eps * (24 * (K * K * rho)) / 4 * Q2R (norm c) ^ m) in Hlast
    by (rewrite <- Hsq; simpl; field).
  assert (Hdp : 0 < Q2R (norm c) ^ m) by (apply pow_lt; auto).
  apply Rmult_le_reg_r in Hlast; auto. lra.
Qed.
End Replay.
