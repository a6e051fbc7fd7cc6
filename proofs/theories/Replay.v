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

Lemma directed_scale (sg sg' : address -> R -> Prop) A P s b a d : (forall t c, sg t c -> sg' t (c * a)) ->
  directed_by sg A P s b (scl a d) -> directed_by sg' A P s b d.
Proof.
  intros Ha [H1 H2]. split; auto. intros eps He. destruct (H1 eps He) as (m0 & Hm). exists m0. intros m t Hle Ht Hx.
  destruct (Hm m t Hle Ht Hx) as (c & Hc & Hn). exists (c * a). split; auto.
  replace (scl (c * a) d) with (scl c (scl a d)) by (extensionality i; unfold scl; ring). auto.
Qed.

(** ** What a replay hands over for a branch *)
Record chart := {
  coordinates : qmat;      (* of a difference from the point, in the cell of the cycle *)
  turn : qmat;             (* one turn of the cycle in these coordinates *)
  seen : qmat              (* what is seen of them *)
}.

Record evidence := {
  value : qvec;            (* the point of the cycle in its own cell *)
  view : chart;
  lead : top;              (* the top of the spectrum in the chart *)
  power : nat; rate : Q;   (* the power of a turn that shrinks the complement at this rate *)
  low : Q; depth : nat;    (* a bound of the functional on the ring, and the words that prove it *)
  exit : list nat;         (* a word that leaves the cycle *)
  scale : Q                (* the image of the vector is this multiple of the direction *)
}.

Section Replay.
Variable case : system.
Notation A := (automaton_of case).
Notation N := (ambient case).
Variables (centres : list qvec) (radii : list Q) (spaces : list qmat).

(** The automaton contracts, balls hold the attractors, and spaces their differences. *)
Definition controlled := check_form case = true /\ contracting A /\ in_balls case centres radii /\
  (forall e, (e < states A)%nat -> qbary N (dim A e) (centre centres e) = true) /\ check_spaces case centres spaces = true.

Theorem controlled_ok theta fuel : check_contraction case theta centres radii fuel && check_spaces case centres spaces = true -> controlled.
Proof.
  rewrite andb_true_iff. intros [H HS]. pose proof H as H0. unfold check_contraction in H0. rewrite !andb_true_iff in H0. destruct H0 as [[H1 _] H2].
  destruct (check_contraction_ok case theta centres radii fuel H) as [H3 H4]. split; auto. split; auto. split; auto. split; auto.
  intros e He. pose proof (forall_lt _ _ H2 e He) as H5. cbv beta in H5. rewrite !andb_true_iff in H5. apply H5.
Qed.

Definition check_cycle (s : nat) (b : branch) (q : qvec) : bool :=
  let e := stw A s (prefix b) in
  (s <? states A) && check_letters case s (prefix b) && check_letters case e (cycle b) &&
  negb (length (cycle b) =? 0) && (stw A e (cycle b) =? e) &&
  qbary N (dim A e) q && qeqv N (qact N (qword case e (cycle b)) q) q.

Definition check_point (P : qmat) (s : nat) (b : branch) (q p : qvec) : bool :=
  check_cycle s b q && (length P <=? N) && qeqv N (qact N P (qact N (qword case s (prefix b)) q)) p.

Definition same_word (a b : list nat) : bool := (length a =? length b) && forallb (fun i => nth i a O =? nth i b O) (seq 0 (length a)).

(** The coordinates of [c] are right on the vectors that [S] does not change, for the turn [M] seen through [P U]. *)
Definition check_chart (S P U M : qmat) (c : chart) : bool :=
  (length (coordinates c) <=? N) && (length (turn c) <=? N) && (length (seen c) <=? N) && (length P <=? N) && (length S <=? N) &&
  qeqm N (qmul N (coordinates c) (qmul N M S)) (qmul N (turn c) (qmul N (coordinates c) S)) &&
  qeqm N (qmul N P (qmul N U S)) (qmul N (seen c) (qmul N (coordinates c) S)).

Definition check_branch (m : mode) (P : qmat) (s : nat) (b : branch) (c : evidence) (d : qvec) : bool :=
  let e := stw A s (prefix b) in
  let h := qrow N (top_row (lead c)) (coordinates (view c)) in
  check_cycle s b (value c) && check_chart (space_of spaces e) P (qword case s (prefix b)) (qword case e (cycle b)) (view c) &&
  check_top case (turn (view c)) (lead c) (power c) (rate c) && Qlt_bool 0 (low c) &&
  check_far case centres radii (depth c) m (Some (cycle b)) e h (qdot N h (value c)) (low c) &&
  check_letters case e (exit c) && (length (exit c) =? length (cycle b)) && negb (same_word (exit c) (cycle b)) &&
  (length d <=? N) && negb (Qeq_bool (scale c) 0) && Qlt_bool 0 (qnrm N d) &&
  qeqv N (qact N (seen (view c)) (top_vector (lead c))) (qscl N (scale c) d).

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
  intros (Hf & Hsys & _ & _) H. unfold check_point in H. rewrite !andb_true_iff in H. destruct H as [[H1 H2] H3].
  pose proof (check_cycle_ok _ _ _ Hf H1) as Hcyc. cbv zeta in Hcyc. destruct Hcyc as (Hs & Hu & Hw & Hne & Hcl & Hq & Hfix).
  pose proof (stw_ok A Hsys _ s Hs Hu) as He. pose proof (dim_ok A (wf A Hsys) _ He) as Hd. specialize (Hfix He (proj2 Hd)).
  apply Nat.leb_le in H2. apply qeqv_ok in H3. rewrite !qact_ok in H3 by (auto; apply qword_len).
  rewrite qword_ok in H3; auto; [|intros i Hi; apply Hq; eapply Nat.le_trans; [apply Hd|exact Hi]].
  rewrite <- H3. unfold point. f_equal. rewrite (phi_app A Hsys); auto.
  - f_equal. apply (phi_per A Hsys s b (qv q)); auto.
  - apply adm_app. split; auto. apply (adm_per A Hsys s b (qv q)); auto.
Qed.

Lemma nonzero x : negb (Qeq_bool x 0) = true -> Q2R x <> 0.
Proof.
  intros H H0. rewrite negb_true_iff in H. assert (E : (x == 0)%Q) by (apply eqR_Qeq; rewrite Q2R_0; auto).
  apply Qeq_bool_iff in E. congruence.
Qed.

Definition fixed_by (S : qmat) (x : vec) := act N (qm S) x = x.

Lemma chart_ok S P s u w c : check_form case = true -> contracting A -> (s < states A)%nat -> admw A s u ->
  admw A (stw A s u) w -> stw A (stw A s u) w = stw A s u ->
  (forall x, fixed_by S x -> fixed_by S (Ww A (stw A s u) w x)) ->
  check_chart S P (qword case s u) (qword case (stw A s u) w) c = true -> forall m x, fixed_by S x ->
  act N (qm P) (Ww A s u (Nat.iter m (Ww A (stw A s u) w) x)) =
  act N (qm (seen c)) (Nat.iter m (act N (qm (turn c))) (act N (qm (coordinates c)) x)).
Proof.
  intros Hf Hsys Hs Hu Hw Hcl HL H. unfold check_chart in H. rewrite !andb_true_iff, !Nat.leb_le in H.
  destruct H as [[[[[[H1 H2] H3] H4] H5] H6] H7]. set (e := stw A s u) in *.
  assert (He : (e < states A)%nat) by (apply (stw_ok A Hsys); auto).
  assert (Hsh : forall x, fixed_by S x -> forall i, (N <= i)%nat -> x i = 0).
  { intros x Hx i Hi. rewrite <- Hx. apply (short_act case S x H5 i Hi). }
  assert (Hml : forall X Y, (length (qmul N X Y) <= N)%nat) by (intros; unfold qmul; rewrite tab_length; auto).
  assert (Hturn : forall x, fixed_by S x -> act N (qm (coordinates c)) (Ww A e w x) = act N (qm (turn c)) (act N (qm (coordinates c)) x)).
  { intros x Hx. pose proof (qeqm_ok N _ _ x H6) as E. rewrite !qmul_ok, Hx in E by (auto; apply qword_len).
    rewrite (qword_ok case w Hf) in E by auto. exact E. }
  assert (Hseen : forall x, fixed_by S x -> act N (qm P) (Ww A s u x) = act N (qm (seen c)) (act N (qm (coordinates c)) x)).
  { intros x Hx. pose proof (qeqm_ok N _ _ x H7) as E. rewrite !qmul_ok, Hx in E by (auto; apply qword_len).
    rewrite (qword_ok case u Hf) in E by auto. exact E. }
  intros m x Hx. assert (Hmm : fixed_by S (Nat.iter m (Ww A e w) x) /\
    act N (qm (coordinates c)) (Nat.iter m (Ww A e w) x) = Nat.iter m (act N (qm (turn c))) (act N (qm (coordinates c)) x)).
  { clear - Hx HL Hturn. induction m as [|m [I1 I2]]; simpl; auto. split; [apply HL; auto|]. rewrite Hturn, I2 by auto. reflexivity. }
  destruct Hmm as [M1 M2]. rewrite Hseen, M2 by auto. reflexivity.
Qed.

(** What the factors of secants may be, by the mode, for eigenvalues and multiples that are positive. *)
Definition factor (m : mode) (w : list nat) (t : address) (c : R) : Prop :=
  match m with
  | Above => 0 < c | Below => c < 0 | Apart => True
  | Sides => (before (per w) t -> 0 < c) /\ (before t (per w) -> c < 0)
  end.

Lemma before_irrefl s t : before s t -> before t s -> False.
Proof.
  intros (k & H1 & H2) (l & H3 & H4). destruct (Nat.lt_trichotomy k l) as [H|[->|H]].
  - rewrite H3 in H2 by auto. lia.
  - lia.
  - rewrite H1 in H4 by auto. lia.
Qed.

Lemma per_nth w j : (j < length w)%nat -> per w j = nth j w O.
Proof. intros H. unfold per. rewrite Nat.mod_small; auto. Qed.

Lemma follows_before w t : follows w t -> before (per w) t.
Proof.
  intros (k & H1 & H2 & H3). exists k. rewrite per_nth by auto. split; auto. intros j Hj. rewrite per_nth, H2 by lia. reflexivity.
Qed.

Lemma precedes_before w t : precedes w t -> before t (per w).
Proof.
  intros (k & H1 & H2 & H3). exists k. rewrite per_nth by auto. split; auto. intros j Hj. rewrite per_nth, H2 by lia. reflexivity.
Qed.

(** Theorems 2 and 3 for a functional [g] and a vector [v] to which the turns lead, with the factors [sc]. *)
Lemma branch_core m P s b q view exit (g v d : vec) (sc : nat -> R) (a low : R) : controlled ->
  let e := stw A s (prefix b) in
  check_cycle s b q = true ->
  check_chart (space_of spaces e) P (qword case s (prefix b)) (qword case e (cycle b)) view = true ->
  leads N (short case) (act N (qm (turn view))) (fun x => scl (dot N g x) v) sc -> 0 < low ->
  (forall t, adm A e t -> far m (Some (cycle b)) t (dot N g (act N (qm (coordinates view)) (sub (phi A e t) (qv q)))) low) ->
  check_letters case e exit && (length exit =? length (cycle b)) && negb (same_word exit (cycle b)) = true ->
  act N (qm (seen view)) v = scl a d -> a <> 0 -> 0 < nrm N d ->
  m = Apart \/ ((forall k, (1 <= k)%nat -> 0 < sc k) /\ 0 < a) ->
  directed_by (factor m (cycle b)) A (qm P) s b d.
Proof.
  intros (Hf & Hsys & Hball & Hbase & Hspan) e H1 H2 Hlead Hlow Hring H6 Hdir Ha Hd0 Hpos.
  rewrite !andb_true_iff in H6. destruct H6 as [[H6 H7] H8].
  pose proof (check_cycle_ok _ _ _ Hf H1) as Hcyc. cbv zeta in Hcyc. destruct Hcyc as (Hs & Hu & Hw & Hne & Hcl & Hq & Hfix).
  fold e in Hw, Hcl, Hq, Hfix.
  pose proof (stw_ok A Hsys _ s Hs Hu) as He. fold e in He. pose proof (dim_ok A (wf A Hsys) _ He) as Hd. specialize (Hfix He (proj2 Hd)).
  apply Nat.eqb_eq in H7. apply check_letters_ok in H6. set (C := qm (coordinates view)) in *.
  set (x := fun t => sub (phi A e t) (qv q)).
  assert (Hlen : (length (coordinates view) <= N)%nat /\ (length (seen view) <= N)%nat).
  { unfold check_chart in H2. rewrite !andb_true_iff, !Nat.leb_le in H2. tauto. }
  assert (Hin : forall t, adm A e t -> fixed_by (space_of spaces e) (x t)).
  { intros t Ht. unfold x. rewrite <- (phi_per A Hsys s b (qv q) Hs Hu Hw Hne Hcl Hq Hfix).
    apply (differences case centres spaces Hf Hsys Hbase Hspan); auto.
    apply (adm_per A Hsys s b (qv q)); auto. }
  assert (Hfar : forall t, adm A e t -> ~ begins (cycle b) t -> match m with
    | Above => low <= dot N g (act N C (x t)) | Below => dot N g (act N C (x t)) <= - low
    | Apart => low <= Rabs (dot N g (act N C (x t)))
    | Sides => (before (per (cycle b)) t /\ low <= dot N g (act N C (x t))) \/
        (before t (per (cycle b)) /\ dot N g (act N C (x t)) <= - low) end).
  { intros t Ht Hb. destruct (Hring t Ht) as [(r & Hr & Hbr)|Hr]; [injection Hr as <-; contradiction|].
    destruct m; auto. destruct Hr as (r & Hr & Hor). injection Hr as <-.
    destruct Hor as [[Ho1 Ho2]|[Ho1 Ho2]]; [left|right]; split; auto; [apply follows_before|apply precedes_before]; auto. }
  pose (sg := fun t k => m = Apart \/ factor m (cycle b) t k).
  apply (directed_scale sg _ _ _ _ _ a).
  { intros t k [->|Hk]; [exact I|]. destruct Hpos as [->|[_ Hsc]]; [exact I|]. destruct m; simpl in *; auto.
    - apply Rmult_lt_0_compat; auto.
    - nra.
    - destruct Hk as [K1 K2]. split; intros Hbf; [apply Rmult_lt_0_compat; auto|]. specialize (K2 Hbf). nra. }
  rewrite <- Hdir.
  apply (directed_intro A Hsys s b (qv q) Hs Hu Hw Hne Hcl Hq Hfix (qm P) C (qm (seen view))
    (act N (qm (turn view))) (short case) (fun _ => True)) with (g := g) (scale := sc) (delta := low); auto.
  - intros t Ht _. apply short_act. apply Hlen.
  - intros k t Ht _. apply (chart_ok (space_of spaces e) P s (prefix b) (cycle b) view); auto; [|apply Hin; auto].
    intros y Hy. apply (space_word case centres spaces Hf Hsys Hbase Hspan); auto.
    fold e. rewrite Hcl. exact Hy.
  - intros t Ht Hb. fold e. fold (x t). pose proof (Hfar t Ht Hb) as Hx.
    pose proof (Rle_abs (dot N g (act N C (x t)))). pose proof (Rle_abs (- dot N g (act N C (x t)))) as Ha'.
    rewrite Rabs_Ropp in Ha'. change (low <= Rabs (dot N g (act N C (x t)))).
    clear - Hx H Ha'. destruct m; [lra|lra|exact Hx|destruct Hx as [[_ Hx]|[_ Hx]]; lra].
  - exists (app exit (fun _ => O)). split.
    + apply adm_app. split; auto. apply zeros_adm; auto. apply (stw_ok A Hsys); auto.
    + intros Hb. apply begins_same in Hb; auto. rewrite Hb, same_word_refl in H8. discriminate.
  - change (0 < nrm N (act N (qm (seen view)) v)). rewrite Hdir, nrm_scl.
    apply Rmult_lt_0_compat; auto. apply Rabs_pos_lt; auto.
  - exists 1%nat. intros k t Hk Ht Hb. destruct Hpos as [->|[Hl _]]; [left; auto|right].
    pose proof (Hl k Hk) as Hp.
    fold e. fold (x t). pose proof (Hfar t Ht Hb) as Hx. set (z := dot N g (act N C (x t))) in *.
    change (dot (Automaton.N A) g (act (Automaton.N A) C (x t))) with z.
    destruct m; simpl in *; auto.
    + apply Rmult_lt_0_compat; lra.
    + nra.
    + destruct Hx as [[Hb1 Hx]|[Hb1 Hx]]; split; intros Hb2; try (exfalso; apply (before_irrefl _ _ Hb1 Hb2)); [apply Rmult_lt_0_compat; lra|nra].
  - intros n t k [->|Hk]; [left; auto|right]. destruct m; simpl in *; auto.
    pose proof (before_turns [] (cycle b) n t Hne) as [B1 B2]. simpl in B1, B2. rewrite B1, B2. exact Hk.
Qed.

Theorem branch_ok m P s b c d : controlled -> check_branch m P s b c d = true ->
  m = Apart \/ Qlt_bool 0 (top_value (lead c)) && Qlt_bool 0 (scale c) = true ->
  directed_by (factor m (cycle b)) A (qm P) s b (qv d).
Proof.
  intros Hcon H Hpos. pose proof Hcon as (Hf & Hsys & Hball & Hbase & Hspan). unfold check_branch in H. rewrite !andb_true_iff in H.
  destruct H as [[[[[[[[[[[H1 H2] H3] H4] H5] H6] H7] H8] H9] H10] H11] H12].
  assert (Hcb : forall e, (e < states A)%nat -> bary N (dim A e) (qv (centre centres e))) by (intros; apply qbary_ok; auto).
  pose proof (check_cycle_ok _ _ _ Hf H1) as Hcyc. cbv zeta in Hcyc. destruct Hcyc as (Hs & Hu & _).
  pose proof (stw_ok A Hsys _ s Hs Hu) as He.
  apply Q2R_lt in H4, H11. rewrite Q2R_0 in H4, H11. rewrite qnrm_ok in H11. apply Nat.leb_le in H9. apply nonzero in H10.
  apply (branch_core m P s b (value c) (view c) (exit c) (qv (top_row (lead c))) (qv (top_vector (lead c))) (qv d)
    (top_scale (lead c)) (Q2R (scale c)) (Q2R (low c)) Hcon H1 H2 (check_top_ok case _ _ _ _ H3) H4); auto.
  - intros t Ht. rewrite <- qrow_ok, dot_sub, <- (qdot_ok N _ (value c)).
    apply (check_far_ok case centres radii (depth c) Hsys Hball Hcb m _ (stw A s (prefix b))); auto.
  - rewrite !andb_true_iff. auto.
  - apply qeqv_ok in H12. assert (Hl : (length (seen (view c)) <= N)%nat).
    { unfold check_chart in H2. rewrite !andb_true_iff, !Nat.leb_le in H2. tauto. }
    rewrite qact_ok, qscl_ok in H12 by auto. exact H12.
  - destruct Hpos as [Hm|Hpos]; [left; exact Hm|right]. rewrite andb_true_iff in Hpos. destruct Hpos as [Hl Hsc].
    apply Q2R_lt in Hl, Hsc. rewrite Q2R_0 in Hl, Hsc. split; auto. intros k Hk. apply top_scale_pos; auto.
Qed.

(** The ray of a positive eigenvalue. *)
Theorem half_tangent_ok P s b c d : controlled -> check_branch Above P s b c d = true ->
  Qlt_bool 0 (top_value (lead c)) && Qlt_bool 0 (scale c) = true -> half_tangent A (qm P) s b (qv d).
Proof. intros Hc H Hpos. apply (branch_ok Above P s b c d); auto. Qed.

(** One ray on each side. *)
Theorem passes_ok P s b c d : controlled -> check_branch Sides P s b c d = true ->
  Qlt_bool 0 (top_value (lead c)) && Qlt_bool 0 (scale c) = true -> passes A (qm P) s b (qv d).
Proof. intros Hc H Hpos. apply (branch_ok Sides P s b c d); auto. Qed.

(** The line alone, whatever the signs. *)
Theorem tangent_line_ok P s b c d : controlled -> check_branch Apart P s b c d = true -> tangent_line A (qm P) s b (qv d).
Proof. intros Hc H. apply (branch_ok Apart P s b c d); auto. Qed.

Lemma neg_ok d : (length d <= N)%nat -> qv (qscl N (-1) d) = scl (-1) (qv d).
Proof. intros H. rewrite qscl_ok by auto. f_equal. unfold Q2R; simpl; lra. Qed.

Definition positive (c : evidence) : bool := Qlt_bool 0 (top_value (lead c)) && Qlt_bool 0 (scale c).

Theorem regular_ok P s b1 b2 c1 c2 p d : controlled ->
  check_point P s b1 (value c1) p && check_point P s b2 (value c2) p && positive c1 && positive c2 &&
  check_branch Above P s b1 c1 (qscl N (-1) d) && check_branch Above P s b2 c2 d = true ->
  regular A (qm P) s b1 b2 (qv d).
Proof.
  intros Hc H. rewrite !andb_true_iff in H. destruct H as [[[[[H1 H2] H3] H4] H5] H6].
  assert (Hd : (length d <= N)%nat).
  { unfold check_branch in H6. rewrite !andb_true_iff in H6. apply Nat.leb_le; apply H6. }
  split; [|split].
  - rewrite (check_point_ok P s b1 _ p Hc H1), (check_point_ok P s b2 _ p Hc H2). reflexivity.
  - rewrite <- neg_ok by auto. apply (half_tangent_ok P s b1 c1); auto.
  - apply (half_tangent_ok P s b2 c2); auto.
Qed.

Theorem cusp_ok P s b1 b2 c1 c2 p d : controlled ->
  check_point P s b1 (value c1) p && check_point P s b2 (value c2) p && positive c1 && positive c2 &&
  check_branch Above P s b1 c1 d && check_branch Above P s b2 c2 d = true ->
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
  check_branch Above P s b1 c1 d1 && check_branch Above P s b2 c2 d2 && independent i j d1 d2 = true ->
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
