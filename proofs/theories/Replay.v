(** Verdicts about a case, and the theorems that a replay applies to its matrices. *)
From Coq Require Import Reals Lra Lia List QArith Qabs Qreals Bool FunctionalExtensionality.
From Secant Require Export Vec Automaton Leading Germ Rational Check.
Export ListNotations.
Open Scope R_scope.

(** ** Verdicts *)

(** Both branches lead to one point; the curve has one ray on each side, and they are opposite; or equal; or on two lines, so
    that no line is tangent to both sides. [b1] is the side before the point, [b2] the side after it. *)
Definition regular (A : automaton) P s b1 b2 (d : vec) :=
  point A P s b1 = point A P s b2 /\ half_tangent A P s b1 (scl (-1) d) /\ half_tangent A P s b2 d.
Definition cusp (A : automaton) P s b1 b2 (d : vec) :=
  point A P s b1 = point A P s b2 /\ half_tangent A P s b1 d /\ half_tangent A P s b2 d.
Definition corner (A : automaton) P s b1 b2 (d1 d2 : vec) :=
  point A P s b1 = point A P s b2 /\ half_tangent A P s b1 d1 /\ half_tangent A P s b2 d2 /\
  ~ exists d, 0 < nrm (N A) d /\ tangent_line A P s b1 d /\ tangent_line A P s b2 d.
(** No line is tangent to the germ of one branch. *)
Definition no_tangent (A : automaton) P s b := ~ exists d, 0 < nrm (N A) d /\ tangent_line A P s b d.

Lemma half_tangent_scale A P s b a d : 0 < a -> half_tangent A P s b (scl a d) -> half_tangent A P s b d.
Proof.
  intros Ha [H1 H2]. split; auto. intros eps He. destruct (H1 eps He) as (m0 & Hm). exists m0. intros m t Hle Ht Hx.
  destruct (Hm m t Hle Ht Hx) as (c & Hc & Hn). exists (c * a). split; [apply Rmult_lt_0_compat; auto|].
  replace (scl (c * a) d) with (scl c (scl a d)) by (extensionality i; unfold scl; ring). auto.
Qed.

Lemma tangent_line_scale A P s b a d : tangent_line A P s b (scl a d) -> tangent_line A P s b d.
Proof.
  intros [H1 H2]. split; auto. intros eps He. destruct (H1 eps He) as (m0 & Hm). exists m0. intros m t Hle Ht Hx.
  destruct (Hm m t Hle Ht Hx) as (c & Hc & Hn). exists (c * a). split; auto.
  replace (scl (c * a) d) with (scl c (scl a d)) by (extensionality i; unfold scl; ring). auto.
Qed.

(** ** What a replay hands over for a branch *)
Record evidence := {
  value : qvec;            (* the point of the cycle in its own cell *)
  lead : top;              (* the top of the spectrum *)
  power : nat; rate : Q;   (* the power of the operator that shrinks the complement at this rate *)
  low : Q; depth : nat;    (* a lower bound of the functional on the ring, and the words that prove it *)
  exit : list nat;         (* a word that leaves the cycle *)
  scale : Q                (* the image of the vector is this multiple of the direction *)
}.

Section Replay.
Variable case : system.
Notation A := (automaton_of case).
Notation N := (ambient case).
Variables (centres : list qvec) (radii : list Q).

Definition controlled := check_form case = true /\ contracting A /\ in_balls case centres radii /\
  forall e, (e < states A)%nat -> bary N (dim A e) (qv (centre centres e)).

Theorem controlled_ok theta fuel : check_contraction case theta centres radii fuel = true -> controlled.
Proof.
  intros H. pose proof H as H0. unfold check_contraction in H0. rewrite !andb_true_iff in H0. destruct H0 as [[H1 _] H2].
  destruct (check_contraction_ok case theta centres radii fuel H) as [H3 H4]. split; auto. split; auto. split; auto.
  intros e He. pose proof (forall_lt _ _ H2 e He) as H5. cbv beta in H5. rewrite !andb_true_iff in H5.
  apply qbary_ok. apply H5.
Qed.

Definition check_cycle (s : nat) (b : branch) (q : qvec) : bool :=
  let e := stw A s (prefix b) in
  (s <? states A) && check_letters case s (prefix b) && check_letters case e (cycle b) &&
  negb (length (cycle b) =? 0) && (stw A e (cycle b) =? e) &&
  qbary N (dim A e) q && qeqv N (qact N (qword case e (cycle b)) q) q.

Definition check_point (P : qmat) (s : nat) (b : branch) (q p : qvec) : bool :=
  check_cycle s b q && (length P <=? N) && qeqv N (qact N P (qact N (qword case s (prefix b)) q)) p.

Definition same_word (a b : list nat) : bool := (length a =? length b) && forallb (fun i => nth i a O =? nth i b O) (seq 0 (length a)).

Definition check_branch (P : qmat) (s : nat) (b : branch) (c : evidence) (d : qvec) : bool :=
  let e := stw A s (prefix b) in
  check_cycle s b (value c) && check_top case (dim A e) (qword case e (cycle b)) (lead c) (power c) (rate c) &&
  Qlt_bool 0 (low c) &&
  check_ring case centres radii (depth c) (Some (cycle b)) e (top_row (lead c)) (qdot N (top_row (lead c)) (value c) + low c) &&
  check_letters case e (exit c) && (length (exit c) =? length (cycle b)) && negb (same_word (exit c) (cycle b)) &&
  (length P <=? N) && (length d <=? N) && negb (Qeq_bool (scale c) 0) && Qlt_bool 0 (qnrm N d) &&
  qeqv N (qact N P (qact N (qword case s (prefix b)) (top_vector (lead c)))) (qscl N (scale c) d).

Lemma check_cycle_ok s b q : check_form case = true -> check_cycle s b q = true ->
  let e := stw A s (prefix b) in
  (s < states A)%nat /\ admw A s (prefix b) /\ admw A e (cycle b) /\ cycle b <> [] /\ stw A e (cycle b) = e /\
  bary N (dim A e) (qv q) /\ ((e < states A)%nat -> (dim A e <= N)%nat -> Ww A e (cycle b) (qv q) = qv q).
Proof.
  intros Hf H e. unfold check_cycle in H. rewrite !andb_true_iff in H.
  destruct H as [[[[[[H1 H2] H3] H4] H5] H6] H7]. apply Nat.ltb_lt in H1.
  apply check_letters_ok in H2, H3. apply Nat.eqb_eq in H5.
  split; auto. split; auto. split; auto. split.
  { intros H0. rewrite H0 in H4. discriminate. }
  split; auto. split; [apply qbary_ok; auto|]. intros He Hd.
  apply qeqv_ok in H7. rewrite qact_ok in H7 by apply qword_len. rewrite qword_ok in H7; auto.
  intros i Hi. apply qv_short. apply qbary_len in H6. fold e in H6. simpl in *. lia.
Qed.

Lemma same_word_refl w : same_word w w = true.
Proof.
  unfold same_word. rewrite Nat.eqb_refl. simpl. apply forallb_forall. intros; apply Nat.eqb_refl.
Qed.

Lemma begins_same a : forall b s, length a = length b -> begins b (app a s) -> a = b.
Proof.
  induction a as [|i a IH]; intros [|j b] s Hl H; simpl in *; try discriminate; auto.
  destruct H as [H1 H2]. f_equal; auto. apply (IH b s); auto.
Qed.

Lemma zeros_adm e : (e < states A)%nat -> contracting A -> adm A e (fun _ => O).
Proof.
  intros He Hsys k. assert (H : forall k e, (e < states A)%nat -> (st A e (fun _ => O) k < states A)%nat).
  { clear - Hsys. induction k; intros e He; auto. cbn [st]. apply IHk.
    destruct (wf A Hsys e He) as (_ & H1 & H2). apply (H2 O H1). }
  apply (wf A Hsys _ (H k e He)).
Qed.

Theorem check_point_ok P s b q p : controlled -> check_point P s b q p = true -> point A (qm P) s b = qv p.
Proof.
  intros (Hf & Hsys & _) H. unfold check_point in H. rewrite !andb_true_iff in H. destruct H as [[H1 H2] H3].
  pose proof (check_cycle_ok _ _ _ Hf H1) as Hcyc. cbv zeta in Hcyc. destruct Hcyc as (Hs & Hu & Hw & Hne & Hcl & Hq & Hfix).
  pose proof (stw_ok A Hsys _ s Hs Hu) as He. pose proof (dim_ok A (wf A Hsys) _ He) as Hd. specialize (Hfix He (proj2 Hd)).
  apply Nat.leb_le in H2. apply qeqv_ok in H3. rewrite !qact_ok in H3 by (auto; apply qword_len).
  rewrite qword_ok in H3; auto; [|intros i Hi; apply Hq; eapply Nat.le_trans; [apply Hd|exact Hi]].
  rewrite <- H3. unfold point. f_equal. rewrite (phi_app A Hsys); auto.
  - f_equal. apply (phi_per A Hsys s b (qv q)); auto.
  - apply adm_app. split; auto. apply (adm_per A Hsys s b (qv q)); auto.
Qed.

Lemma branch_ok P s b c d (sg : R -> Prop) : controlled -> check_branch P s b c d = true ->
  (exists m1, forall m x, (m1 <= m)%nat -> 0 < x -> sg (top_scale (lead c) m * x)) ->
  directed sg A (qm P) s b (scl (Q2R (scale c)) (qv d)).
Proof.
  intros (Hf & Hsys & Hball & Hcb) H Hsg. unfold check_branch in H. rewrite !andb_true_iff in H.
  destruct H as [[[[[[[[[[[H1 H2] H3] H4] H5] H6] H7] H8] H9] H10] H11] H12].
  pose proof (check_cycle_ok _ _ _ Hf H1) as Hcyc. cbv zeta in Hcyc. destruct Hcyc as (Hs & Hu & Hw & Hne & Hcl & Hq & Hfix).
  set (e := stw A s (prefix b)) in *.
  pose proof (stw_ok A Hsys _ s Hs Hu) as He. fold e in He. pose proof (dim_ok A (wf A Hsys) _ He) as Hd. specialize (Hfix He (proj2 Hd)).
  apply Q2R_lt in H3. rewrite Q2R_0 in H3. apply Nat.leb_le in H8, H9. apply Nat.eqb_eq in H6.
  apply check_letters_ok in H5. apply Q2R_lt in H11. rewrite Q2R_0, qnrm_ok in H11.
  assert (Hsc : Q2R (scale c) <> 0).
  { intros H0. rewrite negb_true_iff in H10. assert (Hqq : (scale c == 0)%Q) by (apply eqR_Qeq; rewrite Q2R_0; auto).
    apply Qeq_bool_iff in Hqq. congruence. }
  destruct (check_top_ok case (dim A e) (qword case e (cycle b)) (lead c) (power c) (rate c) (Ww A e (cycle b))) as [Hlead Hv]; auto.
  { apply Hd. }
  { apply qword_len. }
  { intros x Hx. apply qword_ok; auto. }
  { apply Ww_add. }
  { apply Ww_scl. }
  { intros x Hx. apply (Ww_flat A Hsys); auto. rewrite Hcl; auto. }
  assert (Hdir : act N (qm P) (Ww A s (prefix b) (qv (top_vector (lead c)))) = scl (Q2R (scale c)) (qv d)).
  { apply qeqv_ok in H12. rewrite !qact_ok in H12 by (auto; apply qword_len).
    rewrite qword_ok in H12; auto; [|intros i Hi; apply Hv; eapply Nat.le_trans; [apply Hd|exact Hi]].
    rewrite qscl_ok in H12 by auto. exact H12. }
  rewrite <- Hdir.
  apply (directed_intro A Hsys s b (qv (value c)) Hs Hu Hw Hne Hcl Hq Hfix (qm P)
    (qv (top_row (lead c))) (qv (top_vector (lead c))) (top_scale (lead c)) (Q2R (low c)) sg); auto.
  - intros t Ht Hb.
    destruct (check_ring_ok case centres radii (depth c) Hsys Hball Hcb _ e _ _ He H4 t Ht) as [(r & Hr & Hbr)|Hv'].
    + injection Hr as <-. contradiction.
    + rewrite dot_sub. rewrite Q2R_plus, qdot_ok in Hv'. apply Rplus_le_reg_l with (dot N (qv (top_row (lead c))) (qv (value c))). eapply Rle_trans; [exact Hv'|]. right. match goal with |- ?x = ?y + (?z - ?y2) => change y2 with y; change z with x end. ring.
  - exists (app (exit c) (fun _ => O)). split.
    + apply adm_app. split; auto. apply zeros_adm; auto.
      apply (stw_ok A Hsys); auto.
    + intros Hb. apply begins_same in Hb; auto. rewrite Hb, same_word_refl in H7. discriminate.
  - change (0 < nrm N (act N (qm P) (Ww A s (prefix b) (qv (top_vector (lead c)))))). rewrite Hdir, nrm_scl. apply Rmult_lt_0_compat; auto. apply Rabs_pos_lt; auto.
Qed.

(** Theorems 2 and 3 with the rule for rays: the ray of a positive eigenvalue. *)
Theorem half_tangent_ok P s b c d : controlled -> check_branch P s b c d = true ->
  Qlt_bool 0 (top_value (lead c)) && Qlt_bool 0 (scale c) = true -> half_tangent A (qm P) s b (qv d).
Proof.
  intros Hc H Hpos. rewrite andb_true_iff in Hpos. destruct Hpos as [Hl Hs].
  apply Q2R_lt in Hl, Hs. rewrite Q2R_0 in Hl, Hs. apply (half_tangent_scale _ _ _ _ (Q2R (scale c))); auto.
  apply branch_ok; auto. pose proof H as H0. unfold check_branch in H0. rewrite !andb_true_iff in H0.
  eapply top_scale_pos; eauto. apply H0.
Qed.

(** The line alone, whatever the sign. *)
Theorem tangent_line_ok P s b c d : controlled -> check_branch P s b c d = true -> tangent_line A (qm P) s b (qv d).
Proof.
  intros Hc H. apply (tangent_line_scale _ _ _ _ (Q2R (scale c))). apply branch_ok; auto. exists O. auto.
Qed.

Lemma neg_ok d : (length d <= N)%nat -> qv (qscl N (-1) d) = scl (-1) (qv d).
Proof. intros H. rewrite qscl_ok by auto. f_equal. unfold Q2R; simpl; lra. Qed.

Definition positive (c : evidence) : bool := Qlt_bool 0 (top_value (lead c)) && Qlt_bool 0 (scale c).

Theorem regular_ok P s b1 b2 c1 c2 p d : controlled ->
  check_point P s b1 (value c1) p && check_point P s b2 (value c2) p && positive c1 && positive c2 &&
  check_branch P s b1 c1 (qscl N (-1) d) && check_branch P s b2 c2 d = true ->
  regular A (qm P) s b1 b2 (qv d).
Proof.
  intros Hc H. rewrite !andb_true_iff in H. destruct H as [[[[[H1 H2] H3] H4] H5] H6].
  assert (Hd : (length d <= N)%nat).
  { unfold check_branch in H6. rewrite !andb_true_iff in H6. destruct H6 as [[[[_ H6] _] _] _]. apply Nat.leb_le; auto. }
  split; [|split].
  - rewrite (check_point_ok P s b1 _ p Hc H1), (check_point_ok P s b2 _ p Hc H2). reflexivity.
  - rewrite <- neg_ok by auto. apply (half_tangent_ok P s b1 c1); auto.
  - apply (half_tangent_ok P s b2 c2); auto.
Qed.

Theorem cusp_ok P s b1 b2 c1 c2 p d : controlled ->
  check_point P s b1 (value c1) p && check_point P s b2 (value c2) p && positive c1 && positive c2 &&
  check_branch P s b1 c1 d && check_branch P s b2 c2 d = true ->
  cusp A (qm P) s b1 b2 (qv d).
Proof.
  intros Hc H. rewrite !andb_true_iff in H. destruct H as [[[[[H1 H2] H3] H4] H5] H6]. split; [|split].
  - rewrite (check_point_ok P s b1 _ p Hc H1), (check_point_ok P s b2 _ p Hc H2). reflexivity.
  - apply (half_tangent_ok P s b1 c1); auto.
  - apply (half_tangent_ok P s b2 c2); auto.
Qed.

(** A minor that is not 0. *)
Definition independent (i j : nat) (d1 d2 : qvec) : bool :=
  (i <? N) && (j <? N) && negb (Qeq_bool (qnth d1 i * qnth d2 j) (qnth d1 j * qnth d2 i)).

Lemma independent_ok i j d1 d2 : independent i j d1 d2 = true ->
  (i < N)%nat /\ (j < N)%nat /\ qv d1 i * qv d2 j <> qv d1 j * qv d2 i.
Proof.
  unfold independent. rewrite !andb_true_iff, !Nat.ltb_lt. intros [[H1 H2] H3]. split; auto. split; auto.
  intros H. rewrite negb_true_iff in H3.
  assert (E : (qnth d1 i * qnth d2 j == qnth d1 j * qnth d2 i)%Q) by (apply eqR_Qeq; rewrite !Q2R_mult; exact H).
  apply Qeq_bool_iff in E. congruence.
Qed.

Theorem corner_ok P s b1 b2 c1 c2 p d1 d2 i j : controlled ->
  check_point P s b1 (value c1) p && check_point P s b2 (value c2) p && positive c1 && positive c2 &&
  check_branch P s b1 c1 d1 && check_branch P s b2 c2 d2 && independent i j d1 d2 = true ->
  corner A (qm P) s b1 b2 (qv d1) (qv d2).
Proof.
  intros Hc H. rewrite !andb_true_iff in H. destruct H as [[[[[[H1 H2] H3] H4] H5] H6] H7].
  apply independent_ok in H7. destruct H7 as (Hi & Hj & Hne).
  pose proof (half_tangent_ok P s b1 c1 d1 Hc H5 H3) as T1. pose proof (half_tangent_ok P s b2 c2 d2 Hc H6 H4) as T2.
  split; [|split; [auto|split; [auto|]]].
  - rewrite (check_point_ok P s b1 _ p Hc H1), (check_point_ok P s b2 _ p Hc H2). reflexivity.
  - apply (no_common_tangent A (qm P) s b1 b2 (qv d1) (qv d2) i j); auto; apply tangent_limit, half_tangent_line; auto.
Qed.
End Replay.
