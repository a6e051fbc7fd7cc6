(** Replay of Theorem 6: a tangent at every point of a curve, from cones with rational rays; G¹ where all joints are smooth. *)
From Coq Require Import Reals Lra Lia List QArith Qabs Qreals Bool FunctionalExtensionality.
From Secant Require Export Replay Dense Smooth.
Open Scope R_scope.

(** The pieces of a list that run backwards, by state and letter. *)
Definition listed (backwards : list (list bool)) (e i : nat) : bool := nth i (nth e backwards []) false.

(** By state: rays, images of the rays by pieces as combinations, the start and the end point, the chord as a combination; the
    ratio of entries in one row of the matrices; a functional that is positive on what is seen of the rays of the start. *)
Record cones := {
  rays_of : list (list qvec); maps_of : list (list qmat); firsts : list qvec; lasts : list qvec; chords : list qvec;
  ratio : Q; seen_by : qvec
}.

Section Everywhere.
Variable case : system.
Notation A := (automaton_of case).
Notation N := (ambient case).
Notation mt e i := (snd (piece case e i)).
Variables (centres : list qvec) (radii : list Q) (spaces : list qmat) (backwards : list (list bool)) (k : cones).
Notation rev := (listed backwards).

Definition ray_list e := nth e (rays_of k) [].
Definition ray_at e j := nth j (ray_list e) [].
Definition map_at e i := nth i (nth e (maps_of k) []) [].
Definition first_at e := nth e (firsts k) [].
Definition last_at e := nth e (lasts k) [].
Definition chord_at e := nth e (chords k) [].
Definition enters_at e i := qact N (mt e i) (if rev e i then last_at (dst A e i) else first_at (dst A e i)).
Definition leaves_at e i := qact N (mt e i) (if rev e i then first_at (dst A e i) else last_at (dst A e i)).
Definition turn_at e i : Q := if rev e i then (-1)%Q else 1%Q.

Definition qcomb (n : nat) (c : nat -> Q) (u : nat -> qvec) : qvec := tab N (fun i => qsum n (fun l => c l * qnth (u l) i)%Q).

Lemma qcomb_ok n c u : (forall l, (l < n)%nat -> (length (u l) <= N)%nat) ->
  qv (qcomb n c u) = comb n (fun l => Q2R (c l)) (fun l => qv (u l)).
Proof.
  intros Hu. extensionality i. unfold qv, qcomb, comb. rewrite tab_nth. destruct (Nat.ltb_spec i N) as [Hi|Hi].
  - rewrite qsum_ok. apply sum_ext; intros. apply Q2R_mult.
  - rewrite Q2R_0. symmetry. apply sum_0. intros l Hl. rewrite nth_overflow by (specialize (Hu l Hl); lia). rewrite Q2R_0. ring.
Qed.

Definition check_state (e : nat) : bool :=
  let n := length (ray_list e) in let g := (deg A e - 1)%nat in
  (0 <? n) && forallb (fun j => length (ray_at e j) <=? N) (seq 0 n) &&
  qbary N (dim A e) (first_at e) && qbary N (dim A e) (last_at e) &&
  qeqv N (enters_at e 0%nat) (first_at e) && qeqv N (leaves_at e g) (last_at e) &&
  forallb (fun i => qeqv N (leaves_at e i) (enters_at e (S i))) (seq 0 g) &&
  forallb (fun j => Qle_bool 0 (qnth (chord_at e) j)) (seq 0 n) && existsb (fun j => Qlt_bool 0 (qnth (chord_at e) j)) (seq 0 n) &&
  qeqv N (qsub N (last_at e) (first_at e)) (qcomb n (qnth (chord_at e)) (ray_at e)) &&
  forallb (fun i => forallb (fun j =>
      qeqv N (qscl N (turn_at e i) (qact N (mt e i) (ray_at (dst A e i) j))) (qcomb n (fun l => qent (map_at e i) l j) (ray_at e)) &&
      forallb (fun l => Qlt_bool 0 (qent (map_at e i) l j)) (seq 0 n))
    (seq 0 (length (ray_list (dst A e i)))) &&
    forallb (fun l => let bound := Qred (ratio k * qmax (map (qent (map_at e i) l) (seq 0 (length (ray_list (dst A e i)))))) in
      forallb (fun j => Qle_bool bound (qent (map_at e i) l j)) (seq 0 (length (ray_list (dst A e i))))) (seq 0 n)) (seq 0 (deg A e)).

Definition check_cones (P : qmat) (s : nat) : bool :=
  (s <? states A) && (length P <=? N) && Qlt_bool 0 (ratio k) && Qle_bool (ratio k) 1 &&
  forallb check_state (seq 0 (states A)) &&
  forallb (fun j => Qlt_bool 0 (qdot N (seen_by k) (qact N P (ray_at s j)))) (seq 0 (length (ray_list s))).

Definition given_cones (h : vec) (P : matrix) (s : nat) : Prop := contracting A /\ (s < states A)%nat /\
  common_cones A rev (fun e => length (ray_list e)) (fun e j => qv (ray_at e j)) (fun e i l j => Q2R (qent (map_at e i) l j))
    (Q2R (ratio k)) (fun e => qv (first_at e)) (fun e => qv (last_at e)) (fun e j => Q2R (qnth (chord_at e) j)) /\
  forall j, (j < length (ray_list s))%nat -> 0 < dot N h (act N P (qv (ray_at s j))).

Lemma given_cones_ok P s : controlled case centres radii spaces -> check_cones P s = true -> given_cones (qv (seen_by k)) (qm P) s.
Proof.
  intros (Hf & Hsys & _) H. unfold check_cones in H. rewrite !andb_true_iff in H.
  destruct H as [[[[[H1 H2] H3] H4] H5] H6]. apply Nat.ltb_lt in H1. apply Nat.leb_le in H2.
  apply Q2R_lt in H3. rewrite Q2R_0 in H3. apply Q2R_le in H4. rewrite Q2R_1 in H4.
  destruct (check_form_ok case Hf) as [Hwf Hlen].
  assert (Hst : forall e, (e < states A)%nat -> check_state e = true) by (intros e He; apply (forall_lt _ _ H5 e He)).
  clear H5. unfold check_state in Hst.
  pose (into := enters A rev (fun e => qv (first_at e)) (fun e => qv (last_at e))).
  pose (out := leaves A rev (fun e => qv (first_at e)) (fun e => qv (last_at e))).
  assert (C : forall e, (e < states A)%nat ->
    (0 < length (ray_list e))%nat /\
    (forall j, (j < length (ray_list e))%nat -> (length (ray_at e j) <= N)%nat) /\
    (bary N (dim A e) (qv (first_at e)) /\ into e 0%nat = qv (first_at e)) /\
    (bary N (dim A e) (qv (last_at e)) /\ out e (deg A e - 1)%nat = qv (last_at e)) /\
    (forall i, (S i < deg A e)%nat -> out e i = into e (S i)) /\
    (forall j, (j < length (ray_list e))%nat -> 0 <= Q2R (qnth (chord_at e) j)) /\
    (exists j, (j < length (ray_list e))%nat /\ 0 < Q2R (qnth (chord_at e) j)) /\
    sub (qv (last_at e)) (qv (first_at e)) = comb (length (ray_list e)) (fun l => Q2R (qnth (chord_at e) l)) (fun l => qv (ray_at e l)) /\
    (forall i j, (i < deg A e)%nat -> (j < length (ray_list (dst A e i)))%nat ->
      scl (orient (rev e i)) (act N (mat A e i) (qv (ray_at (dst A e i) j))) = comb (length (ray_list e)) (fun l => Q2R (qent (map_at e i) l j)) (fun l => qv (ray_at e l)) /\
      forall l, (l < length (ray_list e))%nat -> 0 < Q2R (qent (map_at e i) l j) /\
        forall j', (j' < length (ray_list (dst A e i)))%nat -> Q2R (ratio k) * Q2R (qent (map_at e i) l j') <= Q2R (qent (map_at e i) l j))).
  { intros e He. pose proof (Hst e He) as H. cbv beta zeta in H. rewrite !andb_true_iff in H.
    destruct H as [[[[[[[[[[G1 G2] G3] G4] G5] G6] G7] G8] Gs] G9] G10]. apply Nat.ltb_lt in G1.
    pose proof (deg_pos A Hsys e He) as Hdeg. simpl in Hdeg.
    assert (Gr : forall j, (j < length (ray_list e))%nat -> (length (ray_at e j) <= N)%nat).
    { intros j Hj. apply Nat.leb_le. apply (forall_lt _ _ G2 j Hj). }
    assert (Ha : forall i x, (i < deg A e)%nat -> qv (qact N (mt e i) x) = act N (mat A e i) (qv x)).
    { intros i x Hi. apply qact_ok. apply Hlen; auto. }
    assert (Gb : (length (first_at e) <= N)%nat /\ (length (last_at e) <= N)%nat).
    { pose proof (qeqv_len _ _ _ G5). pose proof (qeqv_len _ _ _ G6). tauto. }
    assert (Hinto : forall i, (i < deg A e)%nat -> into e i = qv (enters_at e i)).
    { intros i Hi. unfold enters_at. rewrite Ha by auto. unfold into, enters. destruct (rev e i); reflexivity. }
    assert (Hout : forall i, (i < deg A e)%nat -> out e i = qv (leaves_at e i)).
    { intros i Hi. unfold leaves_at. rewrite Ha by auto. unfold out, leaves. destruct (rev e i); reflexivity. }
    split; [auto|]. split; [auto|].
    split; [split; [apply qbary_ok; auto|rewrite Hinto by auto; apply (qeqv_ok N); auto]|].
    split; [split; [apply qbary_ok; auto|rewrite Hout by (simpl; lia); apply (qeqv_ok N); auto]|].
    split.
    { intros i Hi. rewrite Hinto, Hout by lia. apply (qeqv_ok N). apply (forall_lt _ _ G7 i). simpl in *; lia. }
    split.
    { intros j Hj. pose proof (forall_lt _ _ G8 j Hj) as G. apply Q2R_le in G. rewrite Q2R_0 in G. auto. }
    split.
    { apply existsb_exists in Gs. destruct Gs as (j & Hj & G). apply in_seq in Hj. exists j. split; [lia|].
      apply Q2R_lt in G. rewrite Q2R_0 in G. exact G. }
    split.
    { rewrite <- (qsub_ok N) by tauto. rewrite <- (qcomb_ok _ (qnth (chord_at e))) by auto. apply (qeqv_ok N); auto. }
    intros i j Hi Hj. pose proof (forall_lt _ _ G10 i Hi) as G. cbv beta in G. rewrite andb_true_iff in G. destruct G as [G Gr'].
    pose proof (forall_lt _ _ G j Hj) as G'. cbv beta in G'. rewrite andb_true_iff in G'. destruct G' as [Ga Gc]. split.
    { replace (orient (rev e i)) with (Q2R (turn_at e i)) by (unfold turn_at, orient; destruct (rev e i); unfold Q2R; simpl; lra).
      rewrite <- Ha by auto. rewrite <- (qscl_ok N) by (unfold qact; rewrite tab_length; auto). rewrite <- (qcomb_ok _ (fun l => qent (map_at e i) l j)) by auto. apply (qeqv_ok N); auto. }
    intros l Hl. pose proof (forall_lt _ _ Gc l Hl) as Gd. cbv beta in Gd.
    split; [apply Q2R_lt in Gd; rewrite Q2R_0 in Gd; auto|]. intros j' Hj'.
    pose proof (forall_lt _ _ Gr' l Hl) as Ge. cbv beta zeta in Ge. pose proof (forall_lt _ _ Ge j Hj) as Gf. cbv beta in Gf.
    apply Q2R_le in Gf. rewrite Q2R_red, Q2R_mult in Gf. eapply Rle_trans; [|exact Gf]. apply Rmult_le_compat_l; [lra|].
    apply qmax_ok. apply in_map_iff. exists j'. split; auto. apply in_seq. lia. }
  split; [exact Hsys|]. split; [exact H1|]. split.
  - constructor; auto.
    + intros e He. apply (C e He).
    + intros e i l j He Hi Hl Hj. destruct (C e He) as (_ & _ & _ & _ & _ & _ & _ & _ & Cb). apply (Cb i j Hi Hj); auto.
    + intros e i l j j' He Hi Hl Hj Hj'. destruct (C e He) as (_ & _ & _ & _ & _ & _ & _ & _ & Cb). apply (Cb i j Hi Hj); auto.
    + intros e i j He Hi Hj. destruct (C e He) as (_ & _ & _ & _ & _ & _ & _ & _ & Cb). apply (Cb i j Hi Hj).
    + intros e He. apply (C e He).
    + intros e He. apply (C e He).
    + intros e i He Hi. destruct (C e He) as (_ & _ & _ & _ & Cm & _). apply Cm; auto.
    + intros e j He Hj. destruct (C e He) as (_ & _ & _ & _ & _ & Cw & _). apply Cw; auto.
    + intros e He. apply (C e He).
    + intros e He. apply (C e He).
  - intros j Hj. pose proof (forall_lt _ _ H6 j Hj) as G. cbv beta in G. apply Q2R_lt in G.
    rewrite Q2R_0, qdot_ok, qact_ok in G by auto. exact G.
Qed.

Theorem cones_ok P s : controlled case centres radii spaces -> check_cones P s = true -> tangent_at_every_address A rev (qm P) s.
Proof.
  intros Hc H. destruct (given_cones_ok P s Hc H) as (Hsys & Hs & Hcommon & Hview). intros a Ha.
  eexists. apply (tangents A Hsys _ _ _ _ _ _ _ _ Hcommon (qm P) _ s Hs Hview a Ha).
Qed.

(** The letters of a word are those of the last address ([late]), or of the first one; where it leads. *)
Fixpoint track (late : bool) (e : nat) (w : list nat) : option (bool * nat) :=
  match w with
  | [] => Some (late, e)
  | i :: w => if i =? (if late then deg A e - 1 else 0) then track (xorb late (rev e i)) (dst A e i) w else None
  end.

Definition extreme_upto (n : nat) (late : bool) (e : nat) (x : address) :=
  forall j, (j < n)%nat -> x j = if xorb late (turned A rev e x j) then (deg A (st A e x j) - 1)%nat else O.

Lemma track_upto w : forall n late e late' e' x, track late e w = Some (late', e') -> extreme_upto n late' e' x ->
  extreme_upto (length w + n) late e (app w x).
Proof.
  induction w as [|i w IH]; simpl; intros n late e late' e' x H Hx; [injection H as -> ->; exact Hx|].
  match type of H with (if ?c then _ else _) = _ => destruct c eqn:Hi; [apply Nat.eqb_eq in Hi|discriminate] end.
  specialize (IH _ _ _ _ _ _ H Hx). intros [|j] Hj; simpl.
  - rewrite xorb_false_r. exact Hi.
  - rewrite <- xorb_assoc. apply (IH j). lia.
Qed.

Lemma track_round w late late' e : w <> [] -> track late e w = Some (late', e) -> track late' e w = Some (late, e) ->
  extreme A rev late e (per w).
Proof.
  intros Hw H1 H2. assert (G : forall n, extreme_upto n late e (per w) /\ extreme_upto n late' e (per w)).
  { induction n as [|n [G1 G2]]; [split; intros j Hj; lia|]. assert (Hl : (1 <= length w)%nat) by (destruct w; simpl; [congruence|lia]).
    rewrite (per_app w Hw). split.
    - intros j Hj. apply (track_upto w n late e late' e (per w) H1 G2). lia.
    - intros j Hj. apply (track_upto w n late' e late e (per w) H2 G1). lia. }
  intros n. apply (proj1 (G (S n))). lia.
Qed.

(** The branch goes on from the letter [i] of [e] to the last address, or to the first one, of this piece. *)
Definition check_side (late : bool) (e i : nat) (b : branch) : bool :=
  let w := cycle b in let f := stw A e (prefix b) in
  check_letters case e (prefix b) && check_letters case f w && negb (length w =? 0) && (stw A f w =? f) &&
  match (match prefix b with [] => w | _ => prefix b end) with
  | [] => false
  | j :: p => (j =? i) &&
    match track late (dst A e i) p with
    | Some (l0, e0) =>
      match track l0 e0 w with
      | Some (l1, e1) => (e1 =? e0) && match track l1 e0 w with Some (l2, e2) => Bool.eqb l2 l0 && (e2 =? e0) | None => false end
      | None => false
      end
    | None => false
    end
  end.

Lemma check_side_ok late e i b : check_side late e i b = true ->
  round A e b /\ exists x, app (prefix b) (per (cycle b)) = cons i x /\ extreme A rev late (dst A e i) x.
Proof.
  unfold check_side. rewrite !andb_true_iff, negb_true_iff. intros [[[[H1 H2] H3] H4] H5]. apply Nat.eqb_eq in H4. apply Nat.eqb_neq in H3.
  assert (Hw : cycle b <> []) by (intros E; rewrite E in H3; simpl in H3; lia).
  split; [split; [apply check_letters_ok; auto|split; [apply check_letters_ok; auto|auto]]|].
  assert (E : exists j p, app (prefix b) (per (cycle b)) = cons j (app p (per (cycle b))) /\
    (match prefix b with [] => cycle b | _ => prefix b end) = j :: p).
  { destruct (prefix b) as [|j p]; [|exists j, p; split; reflexivity]. destruct (cycle b) as [|j p] eqn:Ec; [congruence|].
    exists j, p. split; auto. simpl app at 1. rewrite (per_app (j :: p)) at 1 by congruence. reflexivity. }
  destruct E as (j & p & E1 & E2). rewrite E2 in H5. rewrite andb_true_iff in H5. destruct H5 as [Hj H5]. apply Nat.eqb_eq in Hj. subst j.
  exists (app p (per (cycle b))). split; auto.
  destruct (track late (dst A e i) p) as [[l0 e0]|] eqn:T0; [|discriminate].
  destruct (track l0 e0 (cycle b)) as [[l1 e1]|] eqn:T1; [|discriminate]. rewrite andb_true_iff in H5. destruct H5 as [He H5].
  apply Nat.eqb_eq in He. subst e1. destruct (track l1 e0 (cycle b)) as [[l2 e2]|] eqn:T2; [|discriminate].
  rewrite andb_true_iff in H5. destruct H5 as [Hl He]. apply Nat.eqb_eq in He. apply eqb_prop in Hl. subst e2 l2.
  pose proof (track_round (cycle b) l0 l1 e0 Hw T1 T2) as Hx.
  intros n. apply (track_upto p (S n) late (dst A e i) l0 e0 (per (cycle b)) T0); [|lia]. intros m _. apply Hx.
Qed.

(** Joints, by state and left piece, with branches along both sides that are smooth in what is seen of the state. *)
Definition joints_of := list (nat * nat * (branch * branch)).

Fixpoint all_smooth (views : list qmat) (joints : joints_of) : Prop :=
  match joints with
  | [] => True
  | (e, _, (b1, b2)) :: rest => (exists d, regular A (qm (view_of views e)) e b1 b2 d) /\ all_smooth views rest
  end.

Definition check_joined (joints : joints_of) : bool :=
  forallb (fun e => forallb (fun i => existsb (fun j => (fst (fst j) =? e) && (snd (fst j) =? i) &&
      check_side (negb (rev e i)) e i (fst (snd j)) && check_side (rev e (S i)) e (S i) (snd (snd j))) joints)
    (seq 0 (deg A e - 1))) (seq 0 (states A)).

Lemma all_smooth_in views joints e i b1 b2 : all_smooth views joints -> In (e, i, (b1, b2)) joints ->
  exists d, regular A (qm (view_of views e)) e b1 b2 d.
Proof.
  induction joints as [|[[e' i'] [b1' b2']] joints IH]; simpl; [tauto|]. intros [H1 H2] [E|Hin]; [|apply IH; auto].
  injection E as -> -> -> ->. exact H1.
Qed.

(** What is seen of each state: a functional on it that is positive on the rays; and matrices that make of it what the start sees of
    the state, and what is seen of the state around a piece. *)
Record sights := { own_rows : list qvec; into_start : qmat; into_state : list (list qmat) }.

Definition check_covered (S R G X : qmat) : bool :=
  (length S <=? N) && (length R <=? N) && (length G <=? N) && (length X <=? N) && qeqm N (qmul N X (qmul N R S)) (qmul N G S).

Lemma check_covered_ok S R G X x : check_covered S R G X = true -> fixed_by case S x ->
  act N (qm G) x = act N (qm X) (act N (qm R) x).
Proof.
  unfold check_covered. rewrite !andb_true_iff, !Nat.leb_le. intros [[[[H1 H2] H3] H4] H5] Hx. unfold fixed_by in Hx. simpl in Hx.
  pose proof (qeqm_ok N _ _ x H5) as E. rewrite !qmul_ok, !Hx in E by auto. auto.
Qed.

Definition check_sights (P : qmat) (s : nat) (views : list qmat) (g : sights) : bool :=
  check_covered (space_of spaces s) (view_of views s) P (into_start g) &&
  forallb (fun e => (length (view_of views e) <=? N) &&
    forallb (fun j => qeqv N (qact N (space_of spaces e) (ray_at e j)) (ray_at e j) &&
      Qlt_bool 0 (qdot N (nth e (own_rows g) []) (qact N (view_of views e) (ray_at e j)))) (seq 0 (length (ray_list e))) &&
    forallb (fun i => check_covered (space_of spaces (dst A e i)) (view_of views (dst A e i)) (qmul N (view_of views e) (mt e i))
      (nth i (nth e (into_state g) []) [])) (seq 0 (deg A e))) (seq 0 (states A)).

(** Nothing more is seen through any word. *)
Lemma sights_word views (g : sights) : controlled case centres radii spaces ->
  (forall e i, (e < states A)%nat -> (i < deg A e)%nat -> exists X : matrix, forall x, fixed_by case (space_of spaces (dst A e i)) x ->
    act N (qm (view_of views e)) (act N (mat A e i) x) = act N X (act N (qm (view_of views (dst A e i))) x)) ->
  forall n e a, (e < states A)%nat -> adm A e a -> exists K, 0 < K /\ forall x, fixed_by case (space_of spaces (st A e a n)) x ->
    nrm N (act N (qm (view_of views e)) (W A e a n x)) <= K * nrm N (act N (qm (view_of views (st A e a n))) x).
Proof.
  intros (Hf & Hsys & Hball & Hbase & Hspan) Hstep. induction n; simpl; intros e a He Ha; [exists 1; split; [lra|intros; lra]|].
  pose proof (Ha O) as Ha0. simpl in Ha0. assert (Hd : (dst A e (a O) < states A)%nat) by (apply (wf A Hsys e He); auto).
  destruct (IHn (dst A e (a O)) (tl a) Hd (adm_tl A e a Ha)) as (K & HK & Hn). destruct (Hstep e (a O) He Ha0) as (X & HX).
  pose proof (size_ge0 N X) as Hs. exists ((size N X + 1) * K). split; [apply Rmult_lt_0_compat; lra|]. intros x Hx.
  destruct (letters_ok A n (dst A e (a O)) (tl a) (adm_tl A e a Ha)) as (_ & L2 & L3 & L4).
  simpl. rewrite HX.
  - eapply Rle_trans; [apply nrm_act|]. rewrite Rmult_assoc. apply Rmult_le_compat; [exact Hs|apply nrm_ge0|lra|apply Hn; exact Hx].
  - rewrite <- L4. apply (space_word case centres spaces Hf Hsys Hbase Hspan); auto. rewrite L3. exact Hx.
Qed.

(** Theorem 6: the curve is G¹. *)
Theorem g1_ok P s views (g : sights) joints : controlled case centres radii spaces -> check_cones P s = true ->
  check_sights P s views g = true -> check_joined joints = true -> all_smooth views joints -> g1 A rev (qm P) s.
Proof.
  intros Hc H Hg Hj Hsm. destruct (given_cones_ok P s Hc H) as (Hsys & Hs & Hcommon & Hview).
  pose proof Hc as (Hf & _ & Hball & Hbase & Hspan). unfold check_sights in Hg. rewrite andb_true_iff in Hg. destruct Hg as [Hg0 Hg].
  assert (C : forall e, (e < states A)%nat -> (length (view_of views e) <= N)%nat /\
    (forall j, (j < length (ray_list e))%nat -> fixed_by case (space_of spaces e) (qv (ray_at e j)) /\
      0 < dot N (qv (nth e (own_rows g) [])) (act N (qm (view_of views e)) (qv (ray_at e j)))) /\
    forall i, (i < deg A e)%nat -> exists X : matrix, forall x, fixed_by case (space_of spaces (dst A e i)) x ->
      act N (qm (view_of views e)) (act N (mat A e i) x) = act N X (act N (qm (view_of views (dst A e i))) x)).
  { intros e He. pose proof (forall_lt _ _ Hg e He) as G. cbv beta in G. rewrite !andb_true_iff, Nat.leb_le in G. destruct G as [[G1 G2] G3].
    split; [exact G1|]. split.
    - intros j Hj'. pose proof (forall_lt _ _ G2 j Hj') as G. cbv beta in G. rewrite andb_true_iff in G. destruct G as [Ga Gb]. split.
      + apply qeqv_ok in Ga. rewrite qact_ok in Ga; [exact Ga|].
        pose proof Hspan as Hsp. unfold check_spaces in Hsp. pose proof (forall_lt _ _ Hsp e He) as G. cbv beta in G.
        rewrite andb_true_iff in G. apply Nat.leb_le. apply G.
      + apply Q2R_lt in Gb. rewrite Q2R_0, qdot_ok, qact_ok in Gb by auto. exact Gb.
    - intros i Hi. pose proof (forall_lt _ _ G3 i Hi) as G. cbv beta in G. exists (qm (nth i (nth e (into_state g) []) [])). intros x Hx.
      rewrite <- (check_covered_ok _ _ _ _ x G Hx). rewrite qmul_ok by auto. reflexivity. }
  apply (arc_g1 A Hsys _ _ _ _ _ _ _ _ Hcommon (qm P) (qv (seen_by k)) s Hs Hview (fun e => qm (view_of views e))
    (fun e => qv (nth e (own_rows g) [])) (fun e x => fixed_by case (space_of spaces e) x)).
  - intros e j He Hj'. apply (C e He); auto.
  - intros; apply fixed_sub; auto.
  - intros; apply fixed_scl; auto.
  - intros e j He Hj'. apply (C e He); auto.
  - intros e a n x He Ha Hx. destruct (letters_ok A n e a Ha) as (_ & L2 & L3 & L4). rewrite <- L4.
    apply (space_word case centres spaces Hf Hsys Hbase Hspan); auto. rewrite L3. exact Hx.
  - intros a n Ha. destruct (sights_word views g Hc (fun e i He Hi => proj2 (proj2 (C e He)) i Hi) n s a Hs Ha) as (K & HK & Hn).
    pose proof (size_ge0 N (qm (into_start g))) as Hsz. exists ((size N (qm (into_start g)) + 1) * K).
    split; [apply Rmult_lt_0_compat; lra|]. intros x Hx.
    destruct (letters_ok A n s a Ha) as (_ & L2 & L3 & L4).
    rewrite (check_covered_ok _ _ _ _ _ Hg0).
    + eapply Rle_trans; [apply nrm_act|]. rewrite Rmult_assoc. apply Rmult_le_compat; [exact Hsz|apply nrm_ge0|lra|apply Hn; exact Hx].
    + rewrite <- L4. apply (space_word case centres spaces Hf Hsys Hbase Hspan); auto. rewrite L3. exact Hx.
  - intros e i He Hi. pose proof (forall_lt _ _ Hj e He) as H1. cbv beta in H1.
    pose proof (forall_lt _ _ H1 i ltac:(simpl in *; lia)) as H2. cbv beta in H2. apply existsb_exists in H2.
    destruct H2 as ([[e' i'] [b1 b2]] & Hin & H3). simpl in H3. rewrite !andb_true_iff in H3. destruct H3 as [[[E1 E2] S1] S2].
    apply Nat.eqb_eq in E1, E2. subst e' i'. apply check_side_ok in S1, S2. destruct S1 as [R1 X1]. destruct S2 as [R2 X2].
    destruct (all_smooth_in views joints e i b1 b2 Hsm Hin) as (d & Hd). exists b1, b2, d. split; [|exact Hd].
    split; [exact R1|]. split; [exact R2|]. split; [exact X1|exact X2].
Qed.
End Everywhere.
