(** Eigenvalues of degree 2 of rational matrices: numbers [x + y r] with the root [r] of a rational, their signs by an interval that
    holds [r], and the theorems of [Replay] for eigenvectors with such coordinates. *)
From Coq Require Import Reals Lra Lia List QArith Qabs Qreals Bool FunctionalExtensionality.
From Secant Require Export Replay.
Open Scope R_scope.

(** A rational and an interval that holds its root. *)
Record root := { radicand : Q; below : Q; above : Q }.
Definition root_of (d : root) : R := sqrt (Q2R (radicand d)).
Definition check_root (d : root) : bool :=
  Qle_bool 0 (below d) && Qle_bool (below d) (above d) && Qle_bool (below d * below d) (radicand d) && Qle_bool (radicand d) (above d * above d).

Definition pair := (Q * Q)%type.
Definition vpair := (qvec * qvec)%type.

Section Root.
Variable d : root.
Notation r := (root_of d).

(** The meaning of pairs. *)
Definition val (x : pair) : R := Q2R (fst x) + r * Q2R (snd x).
Definition vval (x : vpair) : vec := add (qv (fst x)) (scl r (qv (snd x))).

Definition left_end (x : pair) : Q := (fst x + below d * snd x)%Q.
Definition right_end (x : pair) : Q := (fst x + above d * snd x)%Q.
(** The least and the most that a pair can be. *)
Definition least (x : pair) : Q := if Qle_bool (left_end x) (right_end x) then left_end x else right_end x.
Definition positive_pair (x : pair) : bool := Qlt_bool 0 (left_end x) && Qlt_bool 0 (right_end x).
Definition negative_pair (x : pair) : bool := Qlt_bool (left_end x) 0 && Qlt_bool (right_end x) 0.
Definition nonzero_pair (x : pair) : bool := positive_pair x || negative_pair x.
Definition times (x y : pair) : pair := (fst x * fst y + radicand d * (snd x * snd y), fst x * snd y + snd x * fst y)%Q.
Definition minus (x y : pair) : pair := (fst x - fst y, snd x - snd y)%Q.
Definition entry (x : vpair) (i : nat) : pair := (qnth (fst x) i, qnth (snd x) i).

Hypothesis ok : check_root d = true.

Lemma root_ok : Q2R (below d) <= r <= Q2R (above d) /\ r * r = Q2R (radicand d) /\ 0 <= Q2R (below d).
Proof.
  pose proof ok as H. unfold check_root in H. rewrite !andb_true_iff in H. destruct H as [[[H1 H2] H3] H4].
  apply Q2R_le in H1, H2, H3, H4. rewrite Q2R_0 in H1. rewrite Q2R_mult in H3, H4.
  assert (Hd : 0 <= Q2R (radicand d)) by nra.
  split; [|split; [apply sqrt_sqrt; auto|auto]].
  split; unfold root_of.
  - rewrite <- (sqrt_square (Q2R (below d))) by auto. apply sqrt_le_1; auto. nra.
  - rewrite <- (sqrt_square (Q2R (above d))) by lra. apply sqrt_le_1; auto. nra.
Qed.

Lemma val_between x : Rmin (Q2R (left_end x)) (Q2R (right_end x)) <= val x <= Rmax (Q2R (left_end x)) (Q2R (right_end x)).
Proof.
  destruct root_ok as [[H1 H2] _]. unfold left_end, right_end, val. rewrite !Q2R_plus, !Q2R_mult.
  set (b := Q2R (snd x)). set (a := Q2R (fst x)). destruct (Rle_dec 0 b).
  - rewrite Rmin_left, Rmax_right by nra. nra.
  - rewrite Rmin_right, Rmax_left by nra. nra.
Qed.

Lemma positive_ok x : positive_pair x = true -> 0 < val x.
Proof.
  unfold positive_pair. rewrite andb_true_iff. intros [H1 H2]. apply Q2R_lt in H1, H2. rewrite Q2R_0 in H1, H2.
  pose proof (val_between x). assert (0 < Rmin (Q2R (left_end x)) (Q2R (right_end x))) by (apply Rmin_glb_lt; auto). lra.
Qed.

Lemma negative_ok x : negative_pair x = true -> val x < 0.
Proof.
  unfold negative_pair. rewrite andb_true_iff. intros [H1 H2]. apply Q2R_lt in H1, H2. rewrite Q2R_0 in H1, H2.
  pose proof (val_between x). assert (Rmax (Q2R (left_end x)) (Q2R (right_end x)) < 0) by (apply Rmax_lub_lt; auto). lra.
Qed.

Lemma nonzero_ok x : nonzero_pair x = true -> val x <> 0.
Proof.
  unfold nonzero_pair. rewrite orb_true_iff. intros [H|H]; [apply positive_ok in H|apply negative_ok in H]; lra.
Qed.

Lemma times_ok x y : val (times x y) = val x * val y.
Proof.
  destruct root_ok as (_ & Hr & _). unfold val, times. simpl. rewrite !Q2R_plus, !Q2R_mult.
  replace (Q2R (radicand d)) with (r * r) by auto. ring.
Qed.

Lemma minus_ok x y : val (minus x y) = val x - val y.
Proof. unfold val, minus. simpl. rewrite !Q2R_minus. ring. Qed.

Lemma entry_ok x i : val (entry x i) = vval x i.
Proof. reflexivity. Qed.

(** A number that the modulus of a pair is not below. *)
Definition modulus (x : pair) : Q := if positive_pair x then least x else Qopp (if Qle_bool (left_end x) (right_end x) then right_end x else left_end x).

Lemma modulus_ok x : nonzero_pair x = true -> 0 < Q2R (modulus x) <= Rabs (val x).
Proof.
  intros H. pose proof (val_between x) as Hb. unfold modulus. destruct (positive_pair x) eqn:Ep.
  - pose proof (positive_ok x Ep) as Hv. rewrite (Rabs_pos_eq (val x)) by lra.
    unfold positive_pair in Ep. rewrite andb_true_iff in Ep. destruct Ep as [E1 E2]. apply Q2R_lt in E1, E2. rewrite Q2R_0 in E1, E2.
    unfold least. destruct (Qle_bool (left_end x) (right_end x)) eqn:E.
    + apply Q2R_le in E. rewrite Rmin_left in Hb by lra. lra.
    + assert (E' : Q2R (right_end x) < Q2R (left_end x)) by (apply Q2R_lt; unfold Qlt_bool; rewrite E; reflexivity).
      rewrite Rmin_right in Hb by lra. lra.
  - unfold nonzero_pair in H. rewrite Ep in H. simpl in H. pose proof (negative_ok x H) as Hv. rewrite (Rabs_left (val x)) by lra.
    unfold negative_pair in H. rewrite andb_true_iff in H. destruct H as [E1 E2]. apply Q2R_lt in E1, E2. rewrite Q2R_0 in E1, E2.
    destruct (Qle_bool (left_end x) (right_end x)) eqn:E; rewrite Q2R_opp.
    + apply Q2R_le in E. rewrite Rmax_right in Hb by lra. lra.
    + assert (E' : Q2R (right_end x) < Q2R (left_end x)) by (apply Q2R_lt; unfold Qlt_bool; rewrite E; reflexivity).
      rewrite Rmax_left in Hb by lra. lra.
Qed.

Section Vectors.
Variable N : nat.

(** [x = y z] and [x = l y] for vectors. *)
Definition is_multiple (x : vpair) (l : pair) (y : vpair) : bool :=
  qeqv N (fst x) (qadd N (qscl N (fst l) (fst y)) (qscl N (radicand d * snd l) (snd y))) &&
  qeqv N (snd x) (qadd N (qscl N (fst l) (snd y)) (qscl N (snd l) (fst y))).

Lemma is_multiple_ok x l y : (length (fst y) <= N)%nat -> (length (snd y) <= N)%nat -> is_multiple x l y = true ->
  vval x = scl (val l) (vval y).
Proof.
  intros H1 H2 H. unfold is_multiple in H. rewrite andb_true_iff in H. destruct H as [Ha Hb]. apply qeqv_ok in Ha, Hb.
  assert (Hl : forall a z, (length (qscl N a z) <= N)%nat) by (intros; unfold qscl; rewrite tab_length; auto).
  rewrite qadd_ok, !qscl_ok in Ha, Hb by auto. rewrite Q2R_mult in Ha.
  destruct root_ok as (_ & Hr & _). unfold vval. rewrite Ha, Hb. extensionality i. unfold add, scl, val. rewrite <- Hr. ring.
Qed.

Lemma act_val M x : (length M <= N)%nat -> act N (qm M) (vval x) = vval (qact N M (fst x), qact N M (snd x)).
Proof. intros HM. unfold vval. simpl. rewrite act_add, act_scl, !qact_ok by auto. reflexivity. Qed.

Lemma dot_val g x : dot N (vval g) x = dot N (qv (fst g)) x + r * dot N (qv (snd g)) x.
Proof.
  unfold vval, dot, add, scl. rewrite <- sum_scal, <- sum_plus. apply sum_ext; intros; ring.
Qed.

(** The rational between. *)
Definition middle : Q := ((below d + above d) / 2)%Q.
Definition spread : Q := ((above d - below d) / 2)%Q.

Lemma middle_ok : Rabs (r - Q2R middle) <= Q2R spread.
Proof.
  destruct root_ok as [[H1 H2] _]. unfold middle, spread. rewrite !half, Q2R_plus, Q2R_minus. apply Rabs_le. lra.
Qed.

Definition mid_vec (g : vpair) : qvec := qadd N (fst g) (qscl N middle (snd g)).

Lemma mid_vec_ok g x : (length (fst g) <= N)%nat -> (length (snd g) <= N)%nat ->
  dot N (vval g) x = dot N (qv (mid_vec g)) x + (r - Q2R middle) * dot N (qv (snd g)) x.
Proof.
  destruct g as [g0 g1]. cbn [fst snd]. intros H1 H2. unfold mid_vec. cbn [fst snd]. rewrite dot_val. cbn [fst snd]. rewrite qadd_ok, qscl_ok by (auto; unfold qscl; rewrite tab_length; auto).
  unfold dot, add, scl. rewrite <- !sum_scal, <- !sum_plus. apply sum_ext; intros; ring.
Qed.
End Vectors.
End Root.

(** What a replay hands over for a branch with an eigenvalue of degree 2. *)
Record quadratic := {
  q_value : qvec; q_view : chart;
  q_root : root; q_lead : pair; q_row : vpair; q_vector : vpair;
  q_power : nat; q_rate : Q; q_low : Q; q_depth : nat; q_exit : list nat;
  q_scale : pair
}.

Section Replay.
Variable case : system.
Notation A := (automaton_of case).
Notation N := (ambient case).
Variables (centres : list qvec) (radii : list Q) (spaces : list qmat).

Definition check_lead (M : qmat) (d : root) (lam : pair) (g v : vpair) (k : nat) (eta : Q) : bool :=
  let Mk := qmpow N k M in
  let w0 := qact N Mk (fst v) in let w1 := qact N Mk (snd v) in
  let plain := less case Mk [(fst g, w0); (snd g, qscl N (radicand d) w1)] in
  let rooted := less case [] [(snd g, w0); (fst g, w1)] in
  (length M <=? N) && check_root d && nonzero_pair d lam && (0 <? k) && Qle_bool 0 eta && Qlt_bool eta (qpow k (modulus d lam)) &&
  (length (fst g) <=? N) && (length (snd g) <=? N) && (length (fst v) <=? N) && (length (snd v) <=? N) &&
  is_multiple d N (qact N M (fst v), qact N M (snd v)) lam v && is_multiple d N (qrow N (fst g) M, qrow N (snd g) M) lam g &&
  Qeq_bool (qdot N (fst g) (fst v) + radicand d * qdot N (snd g) (snd v)) 1 &&
  Qeq_bool (qdot N (fst g) (snd v) + qdot N (snd g) (fst v)) 0 &&
  Qle_bool (qcolumn N (tab N (fun i => tab N (fun j => Qred (qent plain i j + middle d * qent rooted i j)))) + spread d * qcolumn N rooted) eta.

Lemma less_all M l x : (length M <= N)%nat ->
  act N (qm (less case M l)) x = sub (act N (qm M) x) (fold_right (fun gv y => add (scl (dot N (qv (fst gv)) x) (fun i => if (i <? N)%nat then qv (snd gv) i else 0)) y) (fun _ => 0) l).
Proof.
  intros HM. extensionality i. unfold sub, act. destruct (Nat.lt_ge_cases i N) as [Hi|Hi].
  - rewrite (sum_ext N _ (fun j => Q2R (fold_right (fun gv x => Qred (x - qnth (snd gv) i * qnth (fst gv) j)) (qent M i j) l) * x j)).
    + induction l as [|gv l IH]; [cbn [fold_right]; unfold qm, qent; ring|]. cbn [fold_right].
      rewrite (sum_ext N _ (fun j => Q2R (fold_right (fun gv x => Qred (x - qnth (snd gv) i * qnth (fst gv) j)) (qent M i j) l) * x j
        - Q2R (qnth (snd gv) i) * (qv (fst gv) j * x j))).
      * rewrite sum_minus, sum_scal, IH. unfold add, scl, dot. destruct (Nat.ltb_spec i N); [|lia]. unfold qv, qnth. ring.
      * intros j Hj. rewrite Q2R_red, Q2R_minus, Q2R_mult. unfold qv, qnth. ring.
    + intros j Hj. unfold qm, less. rewrite tab_nth. destruct (Nat.ltb_spec i N); [|lia]. rewrite tab_nth.
      destruct (Nat.ltb_spec j N); [|lia]. reflexivity.
  - rewrite !sum_0; [|intros; rewrite qm_short by lia; ring|intros; rewrite qm_short; [ring|unfold less; rewrite tab_length; lia]].
    match goal with |- 0 = 0 - ?f => enough (E : f = 0) by (rewrite E; ring) end.
    induction l as [|gv l IH]; [reflexivity|]. cbn [fold_right]. unfold add at 1. rewrite IH. unfold scl. destruct (Nat.ltb_spec i N); [lia|]. ring.
Qed.

Theorem check_lead_ok M d lam g v k eta : check_lead M d lam g v k eta = true ->
  leads N (short case) (act N (qm M)) (fun x => scl (dot N (vval d g) x) (vval d v)) (fun m => val d lam ^ m).
Proof.
  intros H. unfold check_lead in H. cbv zeta in H. rewrite !andb_true_iff in H.
  destruct H as [[[[[[[[[[[[[[HM Hroot] Hlam] Hk] H0] Heta] Hg0] Hg1] Hv0] Hv1] Hv] Hg] H11] H12] Hgap].
  apply Nat.leb_le in HM, Hg0, Hg1, Hv0, Hv1. apply Nat.ltb_lt in Hk. apply Q2R_le in H0. rewrite Q2R_0 in H0.
  apply Q2R_lt in Heta. rewrite qpow_ok in Heta. apply Q2R_eq in H11, H12. rewrite Q2R_1 in H11. rewrite Q2R_0 in H12.
  rewrite Q2R_plus, Q2R_mult, !qdot_ok in H11. rewrite Q2R_plus, !qdot_ok in H12.
  pose proof (modulus_ok d Hroot lam Hlam) as Hmod. destruct (root_ok d Hroot) as (_ & Hr & _).
  set (r := root_of d) in *. set (L := act N (qm M)).
  assert (Hshv : short case (vval d v)).
  { intros i Hi. unfold vval, add, scl. rewrite !qv_short by lia. ring. }
  assert (HLv : L (vval d v) = scl (val d lam) (vval d v)).
  { unfold L. rewrite act_val by auto. apply (is_multiple_ok d Hroot N); auto. }
  assert (HgL : forall x, dot N (vval d g) (L x) = val d lam * dot N (vval d g) x).
  { intros x. unfold L. rewrite dot_val, <- !qrow_ok.
    rewrite <- (dot_val d N (qrow N (fst g) M, qrow N (snd g) M)).
    rewrite (is_multiple_ok d Hroot N _ lam g Hg0 Hg1 Hg). unfold dot, scl. rewrite <- sum_scal. apply sum_ext; intros; ring. }
  assert (Hdadd : forall a b x, dot N (add a b) x = dot N a x + dot N b x).
  { intros. unfold dot, add. rewrite <- sum_plus. apply sum_ext; intros; ring. }
  assert (Hgv : dot N (vval d g) (vval d v) = 1).
  { rewrite dot_val. unfold vval. rewrite !dot_add, !dot_scl. fold r. rewrite <- H11, <- Hr.
    replace 0 with (Q2R 0) in H12 by apply Q2R_0. rewrite Q2R_0 in H12. nra. }
  apply (leads_simple N (short case) L (1 + size N (qm M))) with (k := k) (eta := Q2R eta); auto.
  - intros x y Hx Hy i Hi. unfold add. rewrite Hx, Hy by auto. ring.
  - intros a x Hx i Hi. unfold scl. rewrite Hx by auto. ring.
  - intros; apply act_add.
  - intros; apply act_scl.
  - intros; apply short_act; auto.
  - pose proof (size_ge0 N (qm M)). lra.
  - intros x _. pose proof (nrm_act N (qm M) x). pose proof (nrm_ge0 N x). unfold L. lra.
  - apply (nonzero_ok d Hroot); auto.
  - split; auto. eapply Rlt_le_trans; [exact Heta|]. apply pow_incr. split; lra.
  - intros x Hx Hgx. set (Mk := qmpow N k M) in *.
    set (w0 := qact N Mk (fst v)) in *. set (w1 := qact N Mk (snd v)) in *.
    set (plain := less case Mk [(fst g, w0); (snd g, qscl N (radicand d) w1)]) in *.
    set (rooted := less case [] [(snd g, w0); (fst g, w1)]) in *.
    set (mixed := tab N (fun i => tab N (fun j => Qred (qent plain i j + middle d * qent rooted i j)))) in *.
    apply Q2R_le in Hgap. rewrite Q2R_plus, Q2R_mult in Hgap.
    assert (HMk : (length Mk <= N)%nat) by apply qmpow_len.
    assert (Hw : (length w0 <= N)%nat /\ (length w1 <= N)%nat) by (unfold w0, w1, qact; rewrite !tab_length; auto).
    assert (Hcut : forall l, (length l <= N)%nat -> (fun i => if (i <? N)%nat then qv l i else 0) = qv l).
    { intros l Hl. extensionality i. destruct (Nat.ltb_spec i N); auto. symmetry. apply qv_short. lia. }
    assert (Ep : act N (qm plain) x = sub (act N (qm Mk) x) (add (scl (dot N (qv (fst g)) x) (qv w0)) (scl (dot N (qv (snd g)) x) (scl (Q2R (radicand d)) (qv w1))))).
    { unfold plain. rewrite less_all by auto. f_equal. cbn [fold_right fst snd]. rewrite !Hcut by (try apply Hw; unfold qscl; rewrite tab_length; auto).
      rewrite qscl_ok by apply Hw. extensionality i. unfold add. ring. }
    assert (Er : act N (qm rooted) x = scl (-1) (add (scl (dot N (qv (snd g)) x) (qv w0)) (scl (dot N (qv (fst g)) x) (qv w1)))).
    { unfold rooted. rewrite less_all by (simpl; lia). cbn [fold_right fst snd]. rewrite !Hcut by apply Hw.
      assert (E0 : forall i, act N (qm []) x i = 0).
      { intros i. apply sum_0. intros j Hj. rewrite qm_short by (simpl; lia). ring. }
      extensionality i. unfold sub, add, scl. rewrite E0. ring. }
    assert (Em : act N (qm mixed) x = add (act N (qm plain) x) (scl (Q2R (middle d)) (act N (qm rooted) x))).
    { extensionality i. unfold add, scl, act. rewrite <- sum_scal, <- sum_plus. apply sum_ext; intros j Hj.
      destruct (Nat.lt_ge_cases i N) as [Hi|Hi].
      - unfold qm at 1, mixed. rewrite tab_nth. destruct (Nat.ltb_spec i N); [|lia]. rewrite tab_nth. destruct (Nat.ltb_spec j N); [|lia].
        rewrite Q2R_red, Q2R_plus, Q2R_mult. unfold qm, qent. ring.
      - rewrite !qm_short; [ring|unfold rooted, less|unfold plain, less|unfold mixed]; rewrite tab_length; lia. }
    assert (E : Nat.iter k L x = add (act N (qm mixed) x) (scl (r - Q2R (middle d)) (act N (qm rooted) x))).
    { unfold L. rewrite <- qmpow_ok by auto. fold Mk. rewrite Em, Ep, Er. rewrite dot_val in Hgx. fold r in Hgx.
      assert (Hg0x : dot N (qv (fst g)) x = - (r * dot N (qv (snd g)) x)) by lra. rewrite Hg0x.
      extensionality i. unfold add, sub, scl. rewrite <- Hr. ring. }
    rewrite E. eapply Rle_trans; [apply nrm_add|]. rewrite nrm_scl.
    pose proof (qcolumn_ok N mixed x) as B1. pose proof (qcolumn_ok N rooted x) as B2. pose proof (middle_ok d Hroot) as B3. fold r in B3.
    pose proof (nrm_ge0 N x). pose proof (nrm_ge0 N (act N (qm rooted) x)). pose proof (Rabs_pos (r - Q2R (middle d))).
    assert (Rabs (r - Q2R (middle d)) * nrm N (act N (qm rooted) x) <= Q2R (spread d) * (Q2R (qcolumn N rooted) * nrm N x))
      by (apply Rmult_le_compat; auto).
    nra.
Qed.

(** How far the functional may be from the rational one between. *)
Definition slack (e : nat) (c : quadratic) : Q :=
  let h1 := qrow N (snd (q_row c)) (coordinates (q_view c)) in
  (spread (q_root c) * (qosc (dim A e) h1 * (radius radii e + qnrm N (qsub N (centre centres e) (q_value c)))))%Q.

Definition check_quadratic (m : mode) (P : qmat) (s : nat) (b : branch) (c : quadratic) (dir : vpair) : bool :=
  let e := stw A s (prefix b) in let d := q_root c in
  let h := qrow N (mid_vec d N (q_row c)) (coordinates (q_view c)) in
  check_cycle case s b (q_value c) && check_chart case (space_of spaces e) P (qword case s (prefix b)) (qword case e (cycle b)) (q_view c) &&
  check_lead (turn (q_view c)) d (q_lead c) (q_row c) (q_vector c) (q_power c) (q_rate c) &&
  Qlt_bool (slack e c) (q_low c) &&
  check_far case centres radii (q_depth c) m (Some (cycle b)) e h (qdot N h (q_value c)) (q_low c) &&
  (check_letters case e (q_exit c) && (length (q_exit c) =? length (cycle b)) && negb (same_word (q_exit c) (cycle b))) &&
  (length (fst dir) <=? N) && (length (snd dir) <=? N) && nonzero_pair d (q_scale c) &&
  existsb (fun i => nonzero_pair d (entry dir i)) (seq 0 N) &&
  is_multiple d N (qact N (seen (q_view c)) (fst (q_vector c)), qact N (seen (q_view c)) (snd (q_vector c))) (q_scale c) dir.

Definition upward (c : quadratic) : bool := positive_pair (q_root c) (q_lead c) && positive_pair (q_root c) (q_scale c).

Theorem quadratic_ok m P s b c dir : controlled case centres radii spaces -> check_quadratic m P s b c dir = true ->
  m = Apart \/ upward c = true -> directed_by (factor m (cycle b)) A (qm P) s b (vval (q_root c) dir).
Proof.
  intros Hcon H Hpos. pose proof Hcon as (Hf & Hsys & Hball & Hbase & Hspan). unfold check_quadratic in H. cbv zeta in H.
  rewrite (andb_true_iff _ (is_multiple _ _ _ _ _)) in H. destruct H as [H Hmul].
  rewrite (andb_true_iff _ (existsb _ _)) in H. destruct H as [H Hex].
  rewrite (andb_true_iff _ (nonzero_pair _ _)) in H. destruct H as [H Hsc].
  rewrite (andb_true_iff _ (length (snd dir) <=? _)) in H. destruct H as [H Hd1].
  rewrite (andb_true_iff _ (length (fst dir) <=? _)) in H. destruct H as [H Hd0].
  rewrite (andb_true_iff _ (_ && negb _)) in H. destruct H as [H Hexit].
  rewrite (andb_true_iff _ (check_far _ _ _ _ _ _ _ _ _ _)) in H. destruct H as [H Hfar].
  rewrite (andb_true_iff _ (Qlt_bool _ _)) in H. destruct H as [H Hlow].
  rewrite (andb_true_iff _ (check_lead _ _ _ _ _ _ _)) in H. destruct H as [H Hlead].
  rewrite andb_true_iff in H. destruct H as [Hcyc Hchart].
  apply Nat.leb_le in Hd0, Hd1.
  assert (Hcb : forall e, (e < states A)%nat -> bary N (dim A e) (qv (centre centres e))) by (intros; apply qbary_ok; auto).
  pose proof (check_cycle_ok case s b _ Hf Hcyc) as Hc. cbv zeta in Hc. destruct Hc as (Hs & Hu & Hw & Hne & Hcl & Hq & Hfix).
  set (e := stw A s (prefix b)) in *.
  pose proof (stw_ok A Hsys _ s Hs Hu) as He. fold e in He. pose proof (dim_ok A (wf A Hsys) _ He) as Hd.
  assert (Hl : check_root (q_root c) = true /\ (length (fst (q_row c)) <= N)%nat /\ (length (snd (q_row c)) <= N)%nat).
  { unfold check_lead in Hlead. cbv zeta in Hlead. rewrite !andb_true_iff, !Nat.leb_le in Hlead. tauto. }
  destruct Hl as (Hroot & Hg0 & Hg1). set (d := q_root c) in *.
  assert (Hch : (length (coordinates (q_view c)) <= N)%nat /\ (length (seen (q_view c)) <= N)%nat).
  { unfold check_chart in Hchart. rewrite !andb_true_iff, !Nat.leb_le in Hchart. tauto. }
  apply Q2R_lt in Hlow.
  apply (branch_core case centres radii spaces m P s b (q_value c) (q_view c) (q_exit c) (vval d (q_row c)) (vval d (q_vector c)) (vval d dir)
    (fun k => val d (q_lead c) ^ k) (val d (q_scale c)) (Q2R (q_low c) - Q2R (slack e c)) Hcon Hcyc Hchart (check_lead_ok _ _ _ _ _ _ _ Hlead)); auto.
  - lra.
  - intros t Ht. fold e in Ht. fold e. set (x := sub (phi A e t) (qv (q_value c))).
    set (h1 := qrow N (snd (q_row c)) (coordinates (q_view c))).
    assert (Herr : Rabs ((root_of d - Q2R (middle d)) * dot N (qv (snd (q_row c))) (act N (qm (coordinates (q_view c))) x)) <= Q2R (slack e c)).
    { rewrite Rabs_mult, <- qrow_ok. fold h1. unfold slack. fold h1. fold d. rewrite !Q2R_mult, Q2R_plus, qnrm_ok.
      assert (Hflat : flat N (dim A e) x) by (apply bary_sub; auto; apply phi_bary'; auto).
      assert (Hxn : nrm N x <= Q2R (radius radii e) + nrm N (qv (qsub N (centre centres e) (q_value c)))).
      { pose proof (Hball e t He Ht). pose proof (nrm_tri N (phi A e t) (qv (centre centres e)) (qv (q_value c))) as Ht3.
        rewrite qsub_ok; [unfold x; lra| |].
        - pose proof (qbary_len _ _ _ (Hbase e He)). simpl in *. lia.
        - unfold check_cycle in Hcyc. rewrite !andb_true_iff in Hcyc. destruct Hcyc as [[_ Hcyc] _]. apply qbary_len in Hcyc. fold e in Hcyc. simpl in *. lia. }
      pose proof (qosc_bound N (dim A e) h1 x (proj2 Hd) Hflat) as B1. pose proof (qosc_ge0 (dim A e) h1) as B2.
      pose proof (middle_ok d Hroot) as B3. apply Rmult_le_compat; [apply Rabs_pos|apply Rabs_pos|exact B3|].
      eapply Rle_trans; [exact B1|]. apply Rmult_le_compat_l; auto. }
    pose proof (check_far_ok case centres radii (q_depth c) Hsys Hball Hcb m _ e _ _ _ He Hfar t Ht) as Hf2.
    rewrite qdot_ok, <- dot_sub in Hf2. fold x in Hf2. rewrite qrow_ok in Hf2.
    rewrite mid_vec_ok by auto. set (z := dot N (qv (mid_vec d N (q_row c))) (act N (qm (coordinates (q_view c))) x)) in *.
    match goal with |- far _ _ _ (_ + ?y) _ => set (err := y) in * end.
    change (Rabs err <= Q2R (slack e c)) in Herr. clearbody err.
    pose proof (Rle_abs err). pose proof (Rle_abs (- err)) as Hn. rewrite Rabs_Ropp in Hn.
    destruct Hf2 as [Hf2|Hf2]; [left; exact Hf2|right]. destruct m; simpl in *.
    + lra.
    + lra.
    + pose proof (Rabs_triang_inv z (- err)) as Hti. rewrite Rabs_Ropp in Hti. replace (z - - err) with (z + err) in Hti by ring. lra.
    + destruct Hf2 as (rr & Hr1 & [[Ho1 Ho2]|[Ho1 Ho2]]); exists rr; split; auto; [left|right]; split; auto; lra.
  - rewrite act_val by apply Hch. apply (is_multiple_ok d Hroot N); auto.
  - apply (nonzero_ok d Hroot); auto.
  - apply existsb_exists in Hex. destruct Hex as (i & Hi & Hnz). apply in_seq in Hi. apply (nonzero_ok d Hroot) in Hnz. rewrite entry_ok in Hnz.
    assert (B : Rabs (vval d dir i) <= nrm N (vval d dir)).
    { apply (sum_term N (fun j => Rabs (vval d dir j)) i); [intros; apply Rabs_pos|lia]. }
    apply Rabs_pos_lt in Hnz. lra.
  - destruct Hpos as [Hm|Hpos]; [left; exact Hm|right]. unfold upward in Hpos. rewrite andb_true_iff in Hpos. destruct Hpos as [Hp1 Hp2].
    apply (positive_ok d Hroot) in Hp1, Hp2. split; [intros k _; apply pow_lt|]; auto.
Qed.

Theorem quadratic_ray_ok P s b c dir : controlled case centres radii spaces -> check_quadratic Above P s b c dir && upward c = true ->
  half_tangent A (qm P) s b (vval (q_root c) dir).
Proof. rewrite andb_true_iff. intros Hc [H Hu]. apply (quadratic_ok Above P s b c dir); auto. Qed.

Theorem quadratic_passes_ok P s b c dir : controlled case centres radii spaces -> check_quadratic Sides P s b c dir && upward c = true ->
  passes A (qm P) s b (vval (q_root c) dir).
Proof. rewrite andb_true_iff. intros Hc [H Hu]. apply (quadratic_ok Sides P s b c dir); auto. Qed.

Theorem quadratic_line_ok P s b c dir : controlled case centres radii spaces -> check_quadratic Apart P s b c dir = true ->
  tangent_line A (qm P) s b (vval (q_root c) dir).
Proof. intros Hc H. apply (quadratic_ok Apart P s b c dir); auto. Qed.

Definition opposite (x : vpair) : vpair := (qscl N (-1) (fst x), qscl N (-1) (snd x)).

Lemma opposite_ok d x : (length (fst x) <= N)%nat -> (length (snd x) <= N)%nat -> vval d (opposite x) = scl (-1) (vval d x).
Proof.
  intros H1 H2. unfold vval, opposite. simpl. rewrite !qscl_ok by auto. replace (Q2R (-1)) with (-1) by (unfold Q2R; simpl; lra).
  extensionality i. unfold add, scl. ring.
Qed.

Definition same_root (a b : root) : bool := Qeq_bool (radicand a) (radicand b).

Lemma same_root_ok a b x : same_root a b = true -> vval a x = vval b x.
Proof. intros H. apply Q2R_eq in H. unfold vval, root_of. rewrite H. reflexivity. Qed.

Theorem quadratic_regular_ok P s b1 b2 c1 c2 p dir : controlled case centres radii spaces ->
  check_point case P s b1 (q_value c1) p && check_point case P s b2 (q_value c2) p && upward c1 && upward c2 && same_root (q_root c1) (q_root c2) &&
  (length (fst dir) <=? N) && (length (snd dir) <=? N) && check_quadratic Above P s b1 c1 (opposite dir) && check_quadratic Above P s b2 c2 dir = true ->
  regular A (qm P) s b1 b2 (vval (q_root c2) dir).
Proof.
  intros Hc H. rewrite (andb_true_iff _ (check_quadratic _ _ _ b2 _ _)) in H. destruct H as [H H8].
  rewrite (andb_true_iff _ (check_quadratic _ _ _ b1 _ _)) in H. destruct H as [H H7]. rewrite !andb_true_iff in H.
  destruct H as [[[[[[H1 H2] H3] H4] Hr] H5] H6]. apply Nat.leb_le in H5, H6. split; [|split].
  - rewrite (check_point_ok case centres radii spaces P s b1 _ p Hc H1), (check_point_ok case centres radii spaces P s b2 _ p Hc H2). reflexivity.
  - rewrite <- opposite_ok, <- (same_root_ok (q_root c1)) by auto. apply (quadratic_ok Above P s b1 c1); auto.
  - apply (quadratic_ok Above P s b2 c2); auto.
Qed.

Theorem quadratic_cusp_ok P s b1 b2 c1 c2 p dir : controlled case centres radii spaces ->
  check_point case P s b1 (q_value c1) p && check_point case P s b2 (q_value c2) p && upward c1 && upward c2 && same_root (q_root c1) (q_root c2) &&
  check_quadratic Above P s b1 c1 dir && check_quadratic Above P s b2 c2 dir = true ->
  cusp A (qm P) s b1 b2 (vval (q_root c2) dir).
Proof.
  intros Hc H. rewrite (andb_true_iff _ (check_quadratic _ _ _ b2 _ _)) in H. destruct H as [H H8].
  rewrite (andb_true_iff _ (check_quadratic _ _ _ b1 _ _)) in H. destruct H as [H H7]. rewrite !andb_true_iff in H.
  destruct H as [[[[H1 H2] H3] H4] Hr]. split; [|split].
  - rewrite (check_point_ok case centres radii spaces P s b1 _ p Hc H1), (check_point_ok case centres radii spaces P s b2 _ p Hc H2). reflexivity.
  - rewrite <- (same_root_ok (q_root c1)) by auto. apply (quadratic_ok Above P s b1 c1); auto.
  - apply (quadratic_ok Above P s b2 c2); auto.
Qed.

Definition minor_pair (d : root) (i j : nat) (x y : vpair) : pair := minus (times d (entry x i) (entry y j)) (times d (entry x j) (entry y i)).

Theorem quadratic_corner_ok P s b1 b2 c1 c2 p d1 d2 i j : controlled case centres radii spaces ->
  check_point case P s b1 (q_value c1) p && check_point case P s b2 (q_value c2) p && upward c1 && upward c2 && same_root (q_root c1) (q_root c2) &&
  check_root (q_root c2) && (i <? N) && (j <? N) && nonzero_pair (q_root c2) (minor_pair (q_root c2) i j d1 d2) &&
  check_quadratic Above P s b1 c1 d1 && check_quadratic Above P s b2 c2 d2 = true ->
  corner A (qm P) s b1 b2 (vval (q_root c2) d1) (vval (q_root c2) d2).
Proof.
  intros Hc H. rewrite (andb_true_iff _ (check_quadratic _ _ _ b2 _ _)) in H. destruct H as [H H8].
  rewrite (andb_true_iff _ (check_quadratic _ _ _ b1 _ _)) in H. destruct H as [H H7]. rewrite !andb_true_iff in H.
  destruct H as [[[[[[[[H1 H2] H3] H4] Hr] Hroot] Hi] Hj] Hm]. apply Nat.ltb_lt in Hi, Hj.
  assert (T1 : half_tangent A (qm P) s b1 (vval (q_root c2) d1)).
  { rewrite <- (same_root_ok (q_root c1)) by auto. apply (quadratic_ok Above P s b1 c1); auto. }
  assert (T2 : half_tangent A (qm P) s b2 (vval (q_root c2) d2)) by (apply (quadratic_ok Above P s b2 c2); auto).
  split; [|split; [exact T1|split; [exact T2|]]].
  - rewrite (check_point_ok case centres radii spaces P s b1 _ p Hc H1), (check_point_ok case centres radii spaces P s b2 _ p Hc H2). reflexivity.
  - apply (no_common_tangent A (qm P) s b1 b2 (vval (q_root c2) d1) (vval (q_root c2) d2) i j); auto; try (apply tangent_limit, half_tangent_line; auto).
    apply (nonzero_ok (q_root c2) Hroot) in Hm. unfold minor_pair in Hm.
    rewrite minus_ok, !times_ok, !entry_ok in Hm by auto. lra.
Qed.
End Replay.
