(** A curve with common cones is an arc: only the addresses of the joints meet, and at a smooth joint they have one ray. *)
From Coq Require Import Reals Lra Lia List Bool FunctionalExtensionality.
From Coquelicot Require Import Coquelicot.
From Secant Require Export Cones Extreme.
From Secant Require Import Vec Automaton Leading Germ Replay.
Import ListNotations.
Open Scope R_scope.

(** Branches that lead along the two sides of the joint of a piece and the next one. *)
Definition sides_of (A : automaton) (rev : nat -> nat -> bool) (e i : nat) (b1 b2 : branch) := round A e b1 /\ round A e b2 /\
  (exists x, app (prefix b1) (per (cycle b1)) = cons i x /\ extreme A rev (negb (rev e i)) (dst A e i) x) /\
  (exists x, app (prefix b2) (per (cycle b2)) = cons (S i) x /\ extreme A rev (rev e (S i)) (dst A e (S i)) x).

Section Arc.
Variable A : automaton.
Notation N := (N A).
Notation T e i := (act N (mat A e i)).
Hypothesis sys : contracting A.
Variables (rev : nat -> nat -> bool) (rays : nat -> nat) (ray : nat -> nat -> vec) (B : nat -> nat -> nat -> nat -> R) (kappa : R).
Variables (first last : nat -> vec) (weight : nat -> nat -> R).
Hypothesis common : common_cones A rev rays ray B kappa first last weight.
Variables (P : matrix) (h : vec) (start : nat).
Hypothesis start_ok : (start < states A)%nat.
Hypothesis view : forall j, (j < rays start)%nat -> 0 < dot N h (act N P (ray start j)).
Notation enters := (enters A rev first last).
Notation leaves := (leaves A rev first last).
Notation inC e := (in_cone (rays e) (ray e)).
Notation f s k := (st A start s k).
Notation turned := (turned A rev).
Notation sides := (sides_of A rev).

Lemma lim_W s k : forall e (x : nat -> vec) (y : vec), (forall i, is_lim_seq (fun m => x m i) (y i)) ->
  forall i, is_lim_seq (fun m => W A e s k (x m) i) (W A e s k y i).
Proof.
  revert s. induction k; simpl; intros s e x y H i; auto. unfold act.
  apply (lim_sum N (fun m j => mat A e (s O) i j * W A (dst A e (s O)) (tl s) k (x m) j)). intros j Hj.
  apply (is_lim_seq_scal_l (fun m => W A (dst A e (s O)) (tl s) k (x m) j) _ (W A (dst A e (s O)) (tl s) k y j)). apply IHk; auto.
Qed.

(** What the functional sees of a vector of the state after [k] letters. *)
Definition seen (s : address) (k : nat) (x : vec) : R := dot N h (act N P (cell A rev start s k x)).

Lemma seen_add s k x y : seen s k (add x y) = seen s k x + seen s k y.
Proof. unfold seen. rewrite cell_add, act_add, dot_add; auto. Qed.

Lemma seen_scl s k a x : seen s k (scl a x) = a * seen s k x.
Proof. unfold seen. rewrite cell_scl, act_scl, dot_scl; auto. Qed.

Lemma seen_chain s k y x z : seen s k (sub z x) = seen s k (sub z y) + seen s k (sub y x).
Proof. rewrite <- seen_add. f_equal. extensionality i; unfold add, sub; ring. Qed.

Lemma seen_last s k x : seen s (S k) x = seen s k (scl (orient (rev (f s k) (s k))) (T (f s k) (s k) x)).
Proof. unfold seen. rewrite cell_last; auto. Qed.

Lemma seen_same s t k x : (forall j, (j < k)%nat -> s j = t j) -> seen s k x = seen t k x.
Proof.
  intros H. unfold seen, cell. destruct (W_same A k start s t x H) as [-> _]. rewrite (turned_same A rev k start s t H). reflexivity.
Qed.

Lemma st_same s t k : (forall j, (j < k)%nat -> s j = t j) -> f s k = f t k.
Proof. intros H. apply (W_same A k start s t (fun _ => 0) H). Qed.

Lemma seen_comb s k n c u : seen s k (comb n c u) = sum n (fun l => c l * seen s k (u l)).
Proof.
  unfold seen. rewrite (comb_linear (cell A rev start s k)) by (intros; first [apply cell_add|apply cell_scl]; auto).
  rewrite (comb_linear (act N P)) by (intros; first [apply act_add|apply act_scl]). apply dot_comb.
Qed.

Section Along.
Variable s : address.
Hypothesis s_ok : adm A start s.

Lemma f_at k : (f s k < states A)%nat.
Proof. apply (f_ok A sys start s start_ok s_ok). Qed.

Lemma seen_ray k j : (j < rays (f s k))%nat -> 0 < seen s k (ray (f s k) j).
Proof. apply (hgt_pos A sys rev rays ray B kappa first last weight common P h start s start_ok s_ok view). Qed.

Lemma seen_image k i j : (i < deg A (f s k))%nat -> (j < rays (dst A (f s k) i))%nat ->
  0 < seen s k (scl (orient (rev (f s k) i)) (T (f s k) i (ray (dst A (f s k) i) j))).
Proof.
  intros Hi Hj. rewrite (images _ _ _ _ _ _ _ _ _ common) by (auto; apply f_at). rewrite seen_comb.
  apply sum_pos; [apply (some_ray _ _ _ _ _ _ _ _ _ common), f_at|]. intros l Hl.
  apply Rmult_lt_0_compat; [apply (Cones.positive _ _ _ _ _ _ _ _ _ common); auto; apply f_at|apply seen_ray; auto].
Qed.

(** Nothing of the cone is killed. *)
Lemma pointed k x : inC (f s k) x -> 0 <= seen s k x /\ (seen s k x = 0 -> nrm N x = 0).
Proof.
  intros Hx. set (n := rays (f s k)). set (g := fun j => nrm N (ray (f s k) j) / seen s k (ray (f s k) j)).
  assert (Hg : forall j, (j < n)%nat -> 0 <= g j).
  { intros j Hj. pose proof (seen_ray k j Hj). apply Rmult_le_pos; [apply nrm_ge0|left; apply Rinv_0_lt_compat; auto]. }
  set (C := 1 + sum n g). assert (HC : 1 <= C) by (unfold C; pose proof (sum_nonneg n g Hg); lra).
  assert (H : nrm N x <= C * seen s k x).
  { apply (Hx (fun x => nrm N x <= C * seen s k x)).
    - split; [|split; [|split]].
      + rewrite nrm_0 by (intros; reflexivity). replace (fun _ : nat => 0) with (scl 0 (fun _ : nat => 0)) by (extensionality i; unfold scl; ring).
        rewrite seen_scl. lra.
      + intros y z Hy Hz. rewrite seen_add. eapply Rle_trans; [apply nrm_add|]. lra.
      + intros a y Ha Hy. rewrite seen_scl, nrm_scl, Rabs_pos_eq by auto. nra.
      + intros y z Hy Hl.
        apply (is_lim_seq_le (fun m => nrm N (y m)) (fun m => C * seen s k (y m)) (nrm N z) (C * seen s k z)); auto.
        * apply (lim_sum N (fun m i => Rabs (y m i))). intros i Hi. apply (is_lim_seq_abs _ (z i)). auto.
        * apply (is_lim_seq_scal_l _ C (seen s k z)). unfold seen.
          apply (lim_sum N (fun m i => h i * act N P (cell A rev start s k (y m)) i)). intros i Hi.
          apply (is_lim_seq_scal_l (fun m => act N P (cell A rev start s k (y m)) i) (h i) (act N P (cell A rev start s k z) i)).
          apply lim_act. intros j. unfold cell, scl.
          apply (is_lim_seq_scal_l (fun m => W A start s k (y m) j) (orient (turned start s k)) (W A start s k z j)).
          apply (lim_W s k start y z Hl).
    - intros j Hj. apply Rle_trans with (g j * seen s k (ray (f s k) j)).
      + unfold g. right. field. pose proof (seen_ray k j Hj). lra.
      + apply Rmult_le_compat_r; [left; apply seen_ray; auto|].
        pose proof (sum_term n g j Hg Hj). unfold C. lra. }
  pose proof (nrm_ge0 N x). split; [nra|]. intros E. rewrite E in H. nra.
Qed.

(** A piece is no point. *)
Lemma seen_piece k i : (i < deg A (f s k))%nat -> 0 < seen s k (sub (leaves (f s k) i) (enters (f s k) i)).
Proof.
  intros Hi. set (e := f s k) in *. pose proof (f_at k) as He. fold e in He.
  assert (Hd : (dst A e i < states A)%nat) by (apply (dst_ok' A sys); auto).
  assert (E : sub (leaves e i) (enters e i) = scl (orient (rev e i)) (T e i (sub (last (dst A e i)) (first (dst A e i))))).
  { unfold Order.leaves, Order.enters. rewrite act_sub. destruct (rev e i); extensionality j; unfold scl, sub, orient; ring. }
  rewrite E, (chord_in_cone _ _ _ _ _ _ _ _ _ common) by auto.
  rewrite (comb_linear (T e i)) by (intros; first [apply act_add|apply act_scl]).
  replace (scl (orient (rev e i)) (comb (rays (dst A e i)) (weight (dst A e i)) (fun l => T e i (ray (dst A e i) l))))
    with (comb (rays (dst A e i)) (weight (dst A e i)) (fun l => scl (orient (rev e i)) (T e i (ray (dst A e i) l)))).
  - rewrite seen_comb. destruct (some_weight _ _ _ _ _ _ _ _ _ common _ Hd) as (j & Hj & Hw).
    eapply Rlt_le_trans; [|apply (sum_term _ (fun l => weight (dst A e i) l * seen s k (scl (orient (rev e i)) (T e i (ray (dst A e i) l)))) j)].
    + apply Rmult_lt_0_compat; [exact Hw|apply seen_image; auto].
    + intros l Hl. apply Rmult_le_pos; [apply (weights _ _ _ _ _ _ _ _ _ common); auto|left; apply seen_image; auto].
    + exact Hj.
  - extensionality j. unfold comb, scl. rewrite <- sum_scal. apply sum_ext; intros; ring.
Qed.

Notation at_ k := (phi A (f s k) (drop k s)).

Lemma drop_ok k : adm A (f s k) (drop k s).
Proof. apply adm_drop; auto. Qed.

Lemma at_step k : at_ k = T (f s k) (s k) (at_ (S k)).
Proof.
  destruct sys as (Hwf & K & th & c & r & Q1 & Q2 & Q3 & Q4).
  rewrite (phi_step A Hwf K th c r Q1 Q4 (f s k) (drop k s) (f_at k) (drop_ok k)).
  assert (E1 : drop k s O = s k) by (rewrite drop_nth, Nat.add_0_r; reflexivity).
  assert (E2 : tl (drop k s) = drop (S k) s).
  { extensionality j. unfold tl. rewrite !drop_nth. f_equal. lia. }
  rewrite E1, E2. destruct (f_step A start s start_ok s_ok k) as [-> _]. reflexivity.
Qed.

(** From the start of the cell to the point, or from the point to the end. *)
Definition rest (late : bool) (k : nat) : vec := if late then sub (last (f s k)) (at_ k) else sub (at_ k) (first (f s k)).

Lemma rest_cone late k : inC (f s k) (rest late k).
Proof.
  destruct (between A sys rev rays ray B kappa first last weight common (f s k) (drop k s) (f_at k) (drop_ok k)).
  unfold rest. destruct late; auto.
Qed.

(** The rest of a piece, as it is seen in the cell around it. *)
Lemma rest_out k : seen s (S k) (rest (negb (rev (f s k) (s k))) (S k)) = seen s k (sub (leaves (f s k) (s k)) (at_ k)).
Proof.
  rewrite seen_last. f_equal. rewrite (at_step k). destruct (f_step A start s start_ok s_ok k) as [Hf _].
  unfold rest, Order.leaves. rewrite Hf. destruct (rev (f s k) (s k)); simpl; rewrite act_sub; extensionality i; unfold scl, sub, orient; ring.
Qed.

Lemma rest_in k : seen s (S k) (rest (rev (f s k) (s k)) (S k)) = seen s k (sub (at_ k) (enters (f s k) (s k))).
Proof.
  rewrite seen_last. f_equal. rewrite (at_step k). destruct (f_step A start s start_ok s_ok k) as [Hf _].
  unfold rest, Order.enters. rewrite Hf. destruct (rev (f s k) (s k)); simpl; rewrite act_sub; extensionality i; unfold scl, sub, orient; ring.
Qed.

Lemma seen_starts k i n : (i + n < deg A (f s k))%nat -> 0 <= seen s k (sub (enters (f s k) (i + n)) (enters (f s k) i)).
Proof.
  intros H. apply pointed. apply (starts A sys rev rays ray B kappa first last weight common); auto. apply f_at.
Qed.

(** A point at which nothing is left has the last letter, and nothing is left in the cell of this letter. *)
Lemma rest_step late k : seen s k (rest late k) = 0 ->
  s k = (if late then (deg A (f s k) - 1)%nat else O) /\ seen s (S k) (rest (xorb late (rev (f s k) (s k))) (S k)) = 0.
Proof.
  intros H. set (e := f s k) in *. pose proof (f_at k) as He. fold e in He. pose proof (s_ok k) as Hs. fold e in Hs.
  pose proof (deg_pos A sys e He) as Hdeg. unfold rest in H. fold e in H. destruct late.
  - destruct (end_point _ _ _ _ _ _ _ _ _ common e He) as [_ El].
    assert (H1 : 0 <= seen s (S k) (rest (negb (rev e (s k))) (S k))) by (apply pointed, rest_cone).
    rewrite (seen_chain s k (leaves e (s k))) in H. pose proof (rest_out k) as Ho. fold e in Ho.
    assert (H2 : 0 <= seen s k (sub (last e) (leaves e (s k)))).
    { apply pointed. apply (to_last A sys rev rays ray B kappa first last weight common); auto. }
    rewrite xorb_true_l. split; [|lra].
    destruct (Nat.eq_dec (s k) (deg A e - 1)) as [|Hne]; auto. exfalso.
    assert (E : seen s k (sub (last e) (leaves e (s k))) = 0) by lra. rewrite <- El in E.
    rewrite (seen_chain s k (enters e (deg A e - 1))) in E. rewrite (pieces_meet _ _ _ _ _ _ _ _ _ common e (s k)) in E by (auto; lia).
    assert (Hi : (deg A e - 1 < deg A e)%nat) by lia. pose proof (seen_piece k (deg A e - 1) Hi) as H3. fold e in H3.
    pose proof (seen_starts k (S (s k)) (deg A e - 1 - S (s k))) as H4. fold e in H4.
    replace (S (s k) + (deg A e - 1 - S (s k)))%nat with (deg A e - 1)%nat in H4 by lia. specialize (H4 Hi). lra.
  - destruct (start_point _ _ _ _ _ _ _ _ _ common e He) as [_ Ef].
    assert (H1 : 0 <= seen s (S k) (rest (rev e (s k)) (S k))) by (apply pointed, rest_cone).
    rewrite (seen_chain s k (enters e (s k))) in H. pose proof (rest_in k) as Ho. fold e in Ho.
    assert (H2 : 0 <= seen s k (sub (enters e (s k)) (first e))).
    { apply pointed. apply (from_first A sys rev rays ray B kappa first last weight common); auto. }
    rewrite xorb_false_l. split; [|lra].
    destruct (Nat.eq_dec (s k) 0) as [|Hne]; auto. exfalso.
    assert (E : seen s k (sub (enters e (s k)) (first e)) = 0) by lra. rewrite <- Ef in E.
    rewrite (seen_chain s k (leaves e 0)) in E.
    pose proof (seen_piece k 0 Hdeg) as H3. fold e in H3.
    rewrite (pieces_meet _ _ _ _ _ _ _ _ _ common e 0%nat) in E, H3 by (auto; lia).
    pose proof (seen_starts k 1 (s k - 1)) as H4. fold e in H4. replace (1 + (s k - 1))%nat with (s k) in H4 by lia. specialize (H4 Hs). lra.
Qed.

Lemma rest_extreme late k : seen s k (rest late k) = 0 -> extreme A rev late (f s k) (drop k s).
Proof.
  intros H.
  assert (G : forall n, seen s (k + n) (rest (xorb late (turned (f s k) (drop k s) n)) (k + n)) = 0).
  { induction n.
    - rewrite Nat.add_0_r. simpl. rewrite xorb_false_r. exact H.
    - destruct (rest_step _ _ IHn) as [_ Hn]. rewrite Nat.add_succ_r.
      replace (turned (f s k) (drop k s) (S n)) with (xorb (turned (f s k) (drop k s) n) (rev (f s (k + n)) (s (k + n)%nat))).
      + rewrite <- xorb_assoc. exact Hn.
      + replace (S n) with (n + 1)%nat by lia. rewrite turned_plus. simpl. rewrite xorb_false_r, !drop_nth, Nat.add_0_r, st_plus. reflexivity. }
  intros n. destruct (rest_step _ _ (G n)) as [Hn _]. rewrite drop_nth, Hn, st_plus. reflexivity.
Qed.
End Along.

(** A curve with common cones does not meet itself: two addresses of one point are those of a joint. *)
Theorem only_joints s t k : adm A start s -> adm A start t -> (forall j, (j < k)%nat -> s j = t j) -> (s k < t k)%nat ->
  act N P (phi A start s) = act N P (phi A start t) -> joint_of A rev start k s t.
Proof.
  intros Hs Ht Heq Hlt Hpt. pose proof (st_same s t k Heq) as Hf. set (e := f s k) in *.
  pose proof (f_at s Hs k) as He. fold e in He. pose proof (Hs k) as Hsk. fold e in Hsk. pose proof (Ht k) as Htk. rewrite <- Hf in Htk.
  destruct sys as (Hwf & K & th & c & r & Q1 & Q2 & Q3 & Q4).
  set (ps := phi A e (drop k s)). set (pt := phi A e (drop k t)).
  assert (Hx : seen s k (sub pt ps) = 0).
  { unfold seen, cell. rewrite W_sub.
    assert (Es : W A start s k ps = phi A start s) by (symmetry; apply (phi_W A Hwf K th c r Q1 Q4 k start s start_ok Hs)).
    assert (Et : W A start s k pt = phi A start t).
    { destruct (W_same A k start s t pt Heq) as [-> _]. unfold pt. rewrite Hf. symmetry.
      apply (phi_W A Hwf K th c r Q1 Q4 k start t start_ok Ht). }
    rewrite Es, Et, act_scl, act_sub, Hpt, dot_scl. replace (sub (act N P (phi A start t)) (act N P (phi A start t))) with (scl 0 h)
      by (extensionality i; unfold sub, scl; ring). rewrite dot_scl. ring. }
  rewrite (seen_chain s k (enters e (t k))), (seen_chain s k (leaves e (s k)) ps (enters e (t k))) in Hx.
  assert (H1 : 0 <= seen s k (sub (leaves e (s k)) ps)).
  { pose proof (rest_out s Hs k) as E. fold e in E. fold ps in E. rewrite <- E. apply pointed; auto. apply rest_cone; auto. }
  assert (E3 : seen s k (sub pt (enters e (t k))) = seen t (S k) (rest t (rev e (t k)) (S k))).
  { pose proof (rest_in t Ht k) as E. rewrite <- Hf in E. rewrite E. apply seen_same; auto. }
  assert (H3 : 0 <= seen s k (sub pt (enters e (t k)))).
  { rewrite E3. apply pointed; auto. apply rest_cone; auto. }
  assert (H2 : 0 <= seen s k (sub (enters e (t k)) (leaves e (s k)))).
  { rewrite (pieces_meet _ _ _ _ _ _ _ _ _ common e (s k)) by (auto; lia). pose proof (seen_starts s Hs k (S (s k)) (t k - S (s k))) as H.
    replace (S (s k) + (t k - S (s k)))%nat with (t k) in H by lia. apply H. exact Htk. }
  assert (Et : t k = S (s k)).
  { destruct (Nat.eq_dec (t k) (S (s k))) as [|Hne]; auto. exfalso.
    assert (E : seen s k (sub (enters e (t k)) (leaves e (s k))) = 0) by lra.
    rewrite (pieces_meet _ _ _ _ _ _ _ _ _ common e (s k)) in E by (auto; lia).
    rewrite (seen_chain s k (leaves e (S (s k)))) in E.
    assert (Hi : (S (s k) < deg A e)%nat) by lia. pose proof (seen_piece s Hs k (S (s k)) Hi) as H4. fold e in H4.
    rewrite (pieces_meet _ _ _ _ _ _ _ _ _ common e (S (s k))) in E, H4 by (auto; lia).
    pose proof (seen_starts s Hs k (S (S (s k))) (t k - S (S (s k)))) as H5.
    replace (S (S (s k)) + (t k - S (S (s k))))%nat with (t k) in H5 by lia. specialize (H5 Htk). fold e in H5. lra. }
  split; [exact Heq|]. split; [exact Et|]. cbv zeta. fold e. split.
  - destruct (f_step A start s start_ok Hs k) as [Hd _]. fold e in Hd. rewrite <- Hd. apply rest_extreme; auto.
    pose proof (rest_out s Hs k) as E. fold e in E. fold ps in E. rewrite E. lra.
  - destruct (f_step A start t start_ok Ht k) as [Hd _]. rewrite <- Hf in Hd. rewrite <- Hd. apply rest_extreme; auto. lra.
Qed.

Notation tg a := (tangent A rev ray P h start a).

Lemma tangents a : adm A start a -> tangent_at A rev P start a (tg a).
Proof. intros Ha. apply (tangent_everywhere A sys rev rays ray B kappa first last weight common); auto. Qed.

(** The rays of both sides of a smooth joint are one. *)
Lemma joint_ray a b k : adm A start a -> adm A start b -> joint_of A rev start k a b ->
  (exists b1 b2 d, sides (f a k) (a k) b1 b2 /\ regular A P start (inside (letters k a) b1) (inside (letters k a) b2) d) ->
  nrm N (sub (tg a) (tg b)) = 0.
Proof.
  intros Ha Hb (Heq & Hbk & H1 & H2) (b1 & b2 & d & (R1 & R2 & (x1 & E1 & X1) & (x2 & E2 & X2)) & Hreg). cbv zeta in H1, H2. set (e := f a k) in *. pose proof (st_same a b k Heq) as Hf. fold e in Hf.
  pose proof (f_at a Ha k) as He. fold e in He. pose proof (Hb k) as Hdeg. rewrite <- Hf in Hdeg. rewrite Hbk in Hdeg, H2.
  destruct (letters_ok A k start a Ha) as (L1 & L2 & L3 & _). destruct (letters_ok A k start b Hb) as (M1 & M2 & M3 & _).
  assert (Hlet : letters k b = letters k a).
  { clear - Heq. revert a b Heq. induction k as [|k IH]; simpl; intros a b Heq; auto. rewrite (Heq O) by lia. f_equal.
    apply IH. intros j Hj. apply (Heq (S j)). lia. }
  rewrite Hlet in M1. fold e in R1, R2, X1, X2. set (u := letters k a) in *. fold e in L3.
  assert (Hcons : forall s, drop k s = cons (s k) (drop (S k) s)).
  { intros s. extensionality j. rewrite drop_nth. destruct j as [|j]; simpl; [f_equal; lia|].
    change (drop k (tl s) j) with (drop (S k) s j). rewrite drop_nth. f_equal. lia. }
  assert (Ea : a = app (prefix (inside u b1)) (per (cycle (inside u b1)))).
  { unfold inside; simpl prefix; simpl cycle. rewrite app_app, E1, (extreme_unique A rev _ _ _ _ X1 H1), <- Hcons. exact L1. }
  assert (Eb : b = app (prefix (inside u b2)) (per (cycle (inside u b2)))).
  { unfold inside; simpl prefix; simpl cycle. rewrite app_app, E2, (extreme_unique A rev _ _ _ _ X2 H2), <- Hbk, <- Hcons. exact M1. }
  destruct Hreg as (_ & Hd1 & Hd2). rewrite <- L3 in R1, R2.
  assert (Ta : turned start a (S k) = xorb (turned start a k) (rev e (a k))).
  { replace (S k) with (k + 1)%nat by lia. rewrite turned_plus. simpl. rewrite drop_nth, Nat.add_0_r, xorb_false_r. reflexivity. }
  assert (Tb : turned start b (S k) = xorb (turned start a k) (rev e (S (a k)))).
  { replace (S k) with (k + 1)%nat by lia. rewrite turned_plus. simpl.
    rewrite drop_nth, Nat.add_0_r, xorb_false_r, Hbk, <- Hf, (turned_same A rev k start a b Heq). reflexivity. }
  assert (X1' : extreme A rev (negb (rev e (a k))) (f a (S k)) (drop (S k) a)).
  { destruct (f_step A start a start_ok Ha k) as [-> _]. exact H1. }
  assert (X2' : extreme A rev (rev e (S (a k))) (f b (S k)) (drop (S k) b)).
  { destruct (f_step A start b start_ok Hb k) as [-> _]. rewrite <- Hf, Hbk. exact H2. }
  destruct (side_ray A rev P start _ a (S k) _ (tg a) _ sys start_ok (round_inside A start u b1 L2 R1) Ea Ha X1' (tangents a Ha) Hd1) as [P1 Q1].
  destruct (side_ray A rev P start _ b (S k) _ (tg b) _ sys start_ok (round_inside A start u b2 L2 R2) Eb Hb X2' (tangents b Hb) Hd2) as [P2 Q2].
  rewrite Ta in P1, Q1. rewrite Tb in P2, Q2. set (d2 := scl (orient (turned start a k)) d).
  assert (F1 : scl (orient (xorb (negb (rev e (a k))) (xorb (turned start a k) (rev e (a k))))) (scl (-1) d) = d2).
  { unfold d2. destruct (rev e (a k)), (turned start a k); simpl; unfold orient; extensionality i; unfold scl; ring. }
  assert (F2 : scl (orient (xorb (rev e (S (a k))) (xorb (turned start a k) (rev e (S (a k)))))) d = d2).
  { unfold d2. destruct (rev e (S (a k))), (turned start a k); simpl; unfold orient; extensionality i; unfold scl; ring. }
  rewrite F1 in P1, Q1. rewrite F2 in P2, Q2. clear P2.
  pose proof (tangent_height A sys rev rays ray B kappa first last weight common P h start a start_ok Ha view) as Va.
  pose proof (tangent_height A sys rev rays ray B kappa first last weight common P h start b start_ok Hb view) as Vb.
  assert (G : forall x, dot N h x = 1 -> nrm N (sub (scl (nrm N d2) x) (scl (nrm N x) d2)) = 0 ->
    nrm N d2 = nrm N x * dot N h d2 /\ forall i, (i < N)%nat -> nrm N d2 * x i = nrm N x * d2 i).
  { intros x Hx Hn. assert (Hi : forall i, (i < N)%nat -> nrm N d2 * x i = nrm N x * d2 i).
    { intros i Hi. pose proof (nrm_eq0 N _ i Hn Hi) as E. unfold sub, scl in E. lra. }
    split; auto. rewrite <- (Rmult_1_r (nrm N d2)) at 1. rewrite <- Hx, <- !dot_scl. apply sum_ext; intros i Hi'.
    unfold scl. rewrite Hi by auto. reflexivity. }
  destruct (G _ Va Q1) as [Na Ga]. destruct (G _ Vb Q2) as [Nb Gb].
  assert (Hnn : nrm N (tg a) = nrm N (tg b)).
  { assert (dot N h d2 <> 0) by (intros E; rewrite E in Na; lra). apply (Rmult_eq_reg_r (dot N h d2)); auto. lra. }
  apply nrm_0. intros i Hi. unfold sub. assert (E : nrm N d2 * tg a i = nrm N d2 * tg b i) by (rewrite Ga, Gb, Hnn by auto; reflexivity).
  apply Rmult_eq_reg_l in E; lra.
Qed.

(** The tangent depends continuously on the address. *)
Lemma tangent_continuous eps : 0 < eps -> exists m, forall a b, adm A start a -> adm A start b ->
  (forall j, (j < m)%nat -> a j = b j) -> nrm N (sub (tg a) (tg b)) <= eps.
Proof.
  intros Heps.
  set (w := fun j => scl (/ dot N h (act N P (ray start j))) (act N P (ray start j))).
  set (W0 := sum (rays start) (fun j => sum (rays start) (fun j' => nrm N (sub (w j) (w j'))))).
  assert (HW : 0 <= W0) by (apply sum_nonneg; intros; apply sum_nonneg; intros; apply nrm_ge0).
  assert (Hu : forall a j, unit_ray A rev ray P h start a 0 j = w j).
  { intros a j. unfold unit_ray, w, hgt, gen. simpl (st A start a 0). rewrite cell_0; auto. }
  assert (Hwide : forall a, wide A rev rays ray P h start a = W0).
  { intros a. unfold wide, W0. apply sum_ext; intros; apply sum_ext; intros. rewrite !Hu. reflexivity. }
  destruct (ratio_ok _ _ _ _ _ _ _ _ _ common) as [K1 K2].
  assert (Hsh : 0 <= shrink kappa < 1) by (unfold shrink; nra).
  destruct (pow_lt_1_zero (shrink kappa)) with (y := eps / (2 * (W0 + 1))) as (m & Hm).
  { rewrite Rabs_pos_eq; lra. }
  { apply Rdiv_lt_0_compat; lra. }
  specialize (Hm m (le_n m)). rewrite Rabs_pos_eq in Hm by (apply pow_le; lra).
  exists m. intros a b Ha Hb Heq.
  assert (Hz : (0 < rays (f a m))%nat) by (apply (some_ray _ _ _ _ _ _ _ _ _ common), f_at; auto).
  assert (Hz' : (0 < rays (f b m))%nat) by (rewrite <- (st_same a b m Heq); auto).
  pose proof (tangent_near A sys rev rays ray B kappa first last weight common P h start a start_ok Ha view m 0 Hz) as Na.
  pose proof (tangent_near A sys rev rays ray B kappa first last weight common P h start b start_ok Hb view m 0 Hz') as Nb.
  rewrite Hwide in Na, Nb.
  assert (E : unit_ray A rev ray P h start a m 0 = unit_ray A rev ray P h start b m 0).
  { unfold unit_ray, hgt, gen, cell. rewrite <- (st_same a b m Heq), (turned_same A rev m start a b Heq).
    destruct (W_same A m start a b (ray (f a m) 0) Heq) as [-> _]. reflexivity. }
  rewrite E in Na. eapply Rle_trans; [apply (nrm_tri N _ (unit_ray A rev ray P h start b m 0))|].
  rewrite (nrm_sub_sym N (tg a)).
  assert (Hp : shrink kappa ^ m * W0 <= eps / 2).
  { apply Rle_trans with (shrink kappa ^ m * (W0 + 1)); [apply Rmult_le_compat_l; [apply pow_le; lra|lra]|].
    apply Rle_trans with (eps / (2 * (W0 + 1)) * (W0 + 1)); [apply Rmult_le_compat_r; lra|right; field; lra]. }
  lra.
Qed.

Lemma unit_lim a : adm A start a -> is_lim_seq (fun n => nrm N (sub (unit_ray A rev ray P h start a n 0) (tg a))) 0.
Proof.
  intros Ha. destruct (ratio_ok _ _ _ _ _ _ _ _ _ common) as [K1 K2].
  assert (Hsh : 0 <= shrink kappa < 1) by (unfold shrink; nra).
  apply (is_lim_seq_le_le (fun _ => 0) _ (fun n => shrink kappa ^ n * wide A rev rays ray P h start a)).
  - intros n. split; [apply nrm_ge0|]. apply (tangent_near A sys rev rays ray B kappa first last weight common P h start a start_ok Ha view).
    apply (some_ray _ _ _ _ _ _ _ _ _ common), f_at; auto.
  - apply is_lim_seq_const.
  - replace 0 with (0 * wide A rev rays ray P h start a) by ring.
    apply (is_lim_seq_scal_r _ (wide A rev rays ray P h start a) 0). apply is_lim_seq_geom. rewrite Rabs_pos_eq; lra.
Qed.

(** The end of a state is the point of its last address, and its start that of the first one. *)
Lemma edge_word k : forall late e, (e < states A)%nat ->
  let x := edge A rev late e in let f := st A e x k in
  W A e x k (if xorb late (turned e x k) then last f else first f) = if late then last e else first e.
Proof.
  induction k; intros late e He; [simpl; rewrite xorb_false_r; reflexivity|].
  pose proof (deg_pos A sys e He) as Hdeg. set (i := if late then (deg A e - 1)%nat else O).
  assert (Hi : (i < deg A e)%nat) by (unfold i; destruct late; lia).
  specialize (IHk (xorb late (rev e i)) (dst A e i) (dst_ok' A sys e i He Hi)). cbv zeta in IHk |- *.
  change (tl (edge A rev late e)) with (edge A rev (xorb late (rev e i)) (dst A e i)).
  simpl. fold i. change (tl (edge A rev late e)) with (edge A rev (xorb late (rev e i)) (dst A e i)).
  rewrite <- xorb_assoc, IHk. unfold i. destruct late.
  - destruct (end_point _ _ _ _ _ _ _ _ _ common e He) as [_ <-]. unfold Order.leaves. destruct (rev e (deg A e - 1)); reflexivity.
  - destruct (start_point _ _ _ _ _ _ _ _ _ common e He) as [_ <-]. unfold Order.enters. destruct (rev e 0); reflexivity.
Qed.

Lemma edge_point late e i : (e < states A)%nat -> (i < N)%nat -> phi A e (edge A rev late e) i = (if late then last e else first e) i.
Proof.
  intros He Hi. set (x := edge A rev late e). pose proof (wf A sys) as Hwf.
  set (a := fun k => if xorb late (turned e x k) then last (st A e x k) else first (st A e x k)).
  assert (Hx : adm A e x) by (intros k; apply edge_adm; auto).
  assert (Hst : forall k, (st A e x k < states A)%nat) by (intros k; apply st_ok; auto).
  assert (L : is_lim_seq (fun k => W A e x k (a k) i) (phi A e x i)).
  { apply (base_points A sys e x a (sum (states A) (fun f => nrm N (last f) + nrm N (first f)))); auto.
    - intros k. unfold a. destruct (xorb late (turned e x k)); [apply (end_point _ _ _ _ _ _ _ _ _ common)|apply (start_point _ _ _ _ _ _ _ _ _ common)]; auto.
    - intros k. apply Rle_trans with (nrm N (last (st A e x k)) + nrm N (first (st A e x k))).
      + unfold a. pose proof (nrm_ge0 N (last (st A e x k))). pose proof (nrm_ge0 N (first (st A e x k))).
        destruct (xorb late (turned e x k)); lra.
      + apply (sum_term (states A) (fun f => nrm N (last f) + nrm N (first f)) (st A e x k)); auto.
        intros j _. pose proof (nrm_ge0 N (last j)). pose proof (nrm_ge0 N (first j)). lra. }
  apply is_lim_seq_ext with (v := fun _ => (if late then last e else first e) i) in L.
  - apply is_lim_seq_unique in L. rewrite Lim_seq_const in L. injection L; auto.
  - intros k. pose proof (edge_word k late e He) as E. cbv zeta in E. fold x in E. unfold a. rewrite E. reflexivity.
Qed.

(** No part of the curve is a point. *)
Lemma no_point a m : adm A start a -> exists t, adm A start t /\ (forall j, (j < m)%nat -> a j = t j) /\
  0 < nrm N (act N P (sub (phi A start t) (phi A start a))).
Proof.
  intros Ha. set (e := f a m). pose proof (f_at a Ha m) as He. fold e in He.
  destruct sys as (Hwf & K & th & c & r & Q1 & Q2 & Q3 & Q4). set (p := phi A e (drop m a)).
  assert (Hc : 0 < seen a m (sub (last e) (first e))).
  { rewrite (chord_in_cone _ _ _ _ _ _ _ _ _ common) by auto. rewrite seen_comb.
    destruct (some_weight _ _ _ _ _ _ _ _ _ common _ He) as (j & Hj & Hw).
    eapply Rlt_le_trans; [|apply (sum_term _ (fun l => weight e l * seen a m (ray e l)) j)]; auto.
    - apply Rmult_lt_0_compat; [exact Hw|apply seen_ray; auto].
    - intros l Hl. apply Rmult_le_pos; [apply (weights _ _ _ _ _ _ _ _ _ common); auto|left; apply seen_ray; auto]. }
  rewrite (seen_chain a m p) in Hc.
  assert (G : exists late : bool, seen a m (sub (if late then last e else first e) p) <> 0).
  { destruct (Req_dec (seen a m (sub (last e) p)) 0) as [E|E]; [exists false|exists true; exact E]. simpl. intros E2.
    replace (sub (first e) p) with (scl (-1) (sub p (first e))) in E2 by (extensionality i; unfold scl, sub; ring).
    rewrite seen_scl in E2. lra. }
  destruct G as (late & G). set (x := edge A rev late e).
  destruct (letters_ok A m start a Ha) as (L1 & L2 & L3 & L4). fold e in L3.
  assert (Hx : adm A e x) by (intros k; apply edge_adm; auto).
  assert (Ht : adm A start (app (letters m a) x)) by (apply adm_app; rewrite L3; auto).
  assert (Hll : length (letters m a) = m) by (clear; revert a; induction m; simpl; intros; auto).
  exists (app (letters m a) x). split; [exact Ht|]. split.
  { intros j Hj. transitivity (app (letters m a) (drop m a) j); [rewrite <- L1; reflexivity|].
    rewrite !app_nth, Hll. destruct (Nat.ltb_spec j m); [reflexivity|lia]. }
  assert (Et : phi A start (app (letters m a) x) = W A start a m (phi A e x)).
  { rewrite (phi_app A sys) by auto. rewrite L3, L4. reflexivity. }
  assert (Ea : phi A start a = W A start a m p) by apply (phi_W A Hwf K th c r Q1 Q4 m start a start_ok Ha).
  rewrite Et, Ea, <- W_sub.
  assert (Ex : phi A e x = if late then last e else first e).
  { extensionality i. destruct (Nat.lt_ge_cases i N) as [Hi|Hi]; [apply edge_point; auto|].
    destruct (dim_ok A Hwf e He) as [_ Hd]. destruct (phi_bary' A sys e x He Hx) as [Hz _]. rewrite Hz by lia.
    destruct late; symmetry; [apply (end_point _ _ _ _ _ _ _ _ _ common e He)|apply (start_point _ _ _ _ _ _ _ _ _ common e He)]; lia. }
  rewrite Ex. set (z := sub (if late then last e else first e) p) in *.
  destruct (Rle_lt_or_eq_dec 0 _ (nrm_ge0 N (act N P (W A start a m z)))) as [|E]; auto. exfalso. apply G.
  unfold seen, cell. rewrite act_scl, dot_scl. pose proof (dot_le N h (act N P (W A start a m z))) as D. rewrite <- E, Rmult_0_r in D.
  assert (E0 : dot N h (act N P (W A start a m z)) = 0).
  { pose proof (Rle_abs (dot N h (act N P (W A start a m z)))). pose proof (Rle_abs (- dot N h (act N P (W A start a m z)))) as D2.
    rewrite Rabs_Ropp in D2. lra. }
  rewrite E0. ring.
Qed.
End Arc.
