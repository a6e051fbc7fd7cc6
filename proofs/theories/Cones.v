(** Common cones (Theorem 6): both half-tangents at every point, and they are opposite except where two addresses meet.

    Positive matrices shrink the cones by Doeblin's condition on the normalised rays; no metric of Hilbert is needed. Pieces may
    run backwards. *)
From Coq Require Import Reals Lra Lia List Bool FunctionalExtensionality.
From Coquelicot Require Import Coquelicot.
From Secant Require Export Convex Order.
From Secant Require Import Vec Automaton Leading Germ.
Open Scope R_scope.

(** The hypotheses of Theorem 6: rays, positive matrices with entries of bounded ratio, the start and the end of each state and
    the chord between them, and pieces that meet. *)
Record common_cones (A : automaton) (rev : nat -> nat -> bool) (rays : nat -> nat) (ray : nat -> nat -> vec)
  (B : nat -> nat -> nat -> nat -> R) (kappa : R) (first last : nat -> vec) (weight : nat -> nat -> R) : Prop := {
  some_ray : forall e, (e < states A)%nat -> (0 < rays e)%nat;
  ratio_ok : 0 < kappa <= 1;
  positive : forall e i l j, (e < states A)%nat -> (i < deg A e)%nat -> (l < rays e)%nat ->
    (j < rays (dst A e i))%nat -> 0 < B e i l j;
  bounded_ratio : forall e i l j j', (e < states A)%nat -> (i < deg A e)%nat -> (l < rays e)%nat ->
    (j < rays (dst A e i))%nat -> (j' < rays (dst A e i))%nat -> kappa * B e i l j' <= B e i l j;
  images : forall e i j, (e < states A)%nat -> (i < deg A e)%nat -> (j < rays (dst A e i))%nat ->
    scl (orient (rev e i)) (act (N A) (mat A e i) (ray (dst A e i) j)) = comb (rays e) (fun l => B e i l j) (ray e);
  start_point : forall e, (e < states A)%nat -> bary (N A) (dim A e) (first e) /\ enters A rev first last e 0 = first e;
  end_point : forall e, (e < states A)%nat ->
    bary (N A) (dim A e) (last e) /\ leaves A rev first last e (deg A e - 1) = last e;
  pieces_meet : forall e i, (e < states A)%nat -> (S i < deg A e)%nat ->
    leaves A rev first last e i = enters A rev first last e (S i);
  weights : forall e j, (e < states A)%nat -> (j < rays e)%nat -> 0 <= weight e j;
  some_weight : forall e, (e < states A)%nat -> exists j, (j < rays e)%nat /\ 0 < weight e j;
  chord_in_cone : forall e, (e < states A)%nat -> sub (last e) (first e) = comb (rays e) (weight e) (ray e)
}.

Section Cones.
Variable A : automaton.
Notation N := (N A).
Notation T e i := (act N (mat A e i)).
Hypothesis sys : contracting A.
Variables (rev : nat -> nat -> bool) (rays : nat -> nat) (ray : nat -> nat -> vec) (B : nat -> nat -> nat -> nat -> R) (kappa : R).
Variables (first last : nat -> vec) (weight : nat -> nat -> R).
Hypothesis common : common_cones A rev rays ray B kappa first last weight.
Notation enters := (enters A rev first last).
Notation leaves := (leaves A rev first last).
Let rays_pos := some_ray _ _ _ _ _ _ _ _ _ common.
Let kappa_ok := ratio_ok _ _ _ _ _ _ _ _ _ common.
Let B_pos := positive _ _ _ _ _ _ _ _ _ common.
Let B_ratio := bounded_ratio _ _ _ _ _ _ _ _ _ common.
Let B_ok := images _ _ _ _ _ _ _ _ _ common.
Let first_ok := start_point _ _ _ _ _ _ _ _ _ common.
Let last_ok := end_point _ _ _ _ _ _ _ _ _ common.
Let meet := pieces_meet _ _ _ _ _ _ _ _ _ common.
Let weight_ok := weights _ _ _ _ _ _ _ _ _ common.
Let chord := chord_in_cone _ _ _ _ _ _ _ _ _ common.

Notation inC e := (in_cone (rays e) (ray e)).

Lemma dst_ok' e i : (e < states A)%nat -> (i < deg A e)%nat -> (dst A e i < states A)%nat.
Proof. intros He Hi. apply (wf A sys e He); auto. Qed.

(** Operators, with their signs, map cones into cones. *)
Lemma T_cone e i x : (e < states A)%nat -> (i < deg A e)%nat -> inC (dst A e i) x -> inC e (scl (orient (rev e i)) (T e i x)).
Proof.
  intros He Hi Hx D HD Hr. apply (Hx (fun x => D (scl (orient (rev e i)) (T e i x)))).
  - apply (preimage_T A (fun y => D (scl (orient (rev e i)) y))). apply preimage_scl; auto.
  - intros j Hj. rewrite B_ok by auto. apply comb_closed; auto. intros l Hl. left. apply B_pos; auto.
Qed.

(** What a piece makes of a difference, directed forward. *)
Lemma T_forward e i x y : (e < states A)%nat -> (i < deg A e)%nat ->
  (if rev e i then inC (dst A e i) (sub x y) else inC (dst A e i) (sub y x)) -> inC e (sub (T e i y) (T e i x)).
Proof.
  intros He Hi H. destruct (rev e i) eqn:E; apply T_cone in H; auto; rewrite E in H; unfold orient in H; rewrite act_sub in H.
  - replace (sub (T e i y) (T e i x)) with (scl (-1) (sub (T e i x) (T e i y))); auto. extensionality k; unfold sub, scl; ring.
  - replace (sub (T e i y) (T e i x)) with (scl 1 (sub (T e i y) (T e i x))); auto. extensionality k; unfold sub, scl; ring.
Qed.

Lemma chord_cone e : (e < states A)%nat -> inC e (sub (last e) (first e)).
Proof. intros He. rewrite chord by auto. apply in_cone_comb. intros; apply weight_ok; auto. Qed.

Lemma cone_add e x y : inC e x -> inC e y -> inC e (add x y).
Proof. apply (proj1 (proj2 (in_cone_closed (rays e) (ray e)))). Qed.

Lemma cone_0 e : inC e (fun _ => 0).
Proof. apply (in_cone_closed (rays e) (ray e)). Qed.

Lemma cone_same e x : inC e (sub x x).
Proof. replace (sub x x) with (fun _ : nat => 0) by (extensionality k; unfold sub; ring). apply cone_0. Qed.

(** One forward difference after the other. *)
Lemma cone_chain e y x z : inC e (sub y x) -> inC e (sub z y) -> inC e (sub z x).
Proof.
  intros H1 H2. replace (sub z x) with (add (sub z y) (sub y x)) by (extensionality k; unfold add, sub; ring). apply cone_add; auto.
Qed.

Lemma through e i : (e < states A)%nat -> (i < deg A e)%nat -> inC e (sub (leaves e i) (enters e i)).
Proof.
  intros He Hi. unfold Order.leaves, Order.enters. apply T_forward; auto. destruct (rev e i); apply chord_cone, dst_ok'; auto.
Qed.

(** From the start of one piece to the start of a later one. *)
Lemma starts e i n : (e < states A)%nat -> (i + n < deg A e)%nat -> inC e (sub (enters e (i + n)) (enters e i)).
Proof.
  intros He. induction n; intros Hn; [rewrite Nat.add_0_r; apply cone_same|].
  apply cone_chain with (y := enters e (i + n)); [apply IHn; lia|].
  rewrite Nat.add_succ_r, <- meet by (auto; lia). apply through; auto; lia.
Qed.

Lemma deg_pos e : (e < states A)%nat -> (0 < deg A e)%nat.
Proof. intros He. apply (wf A sys e He). Qed.

Lemma from_first e i : (e < states A)%nat -> (i < deg A e)%nat -> inC e (sub (enters e i) (first e)).
Proof. intros He Hi. rewrite <- (proj2 (first_ok e He)). apply (starts e 0 i); auto. Qed.

Lemma to_last e i : (e < states A)%nat -> (i < deg A e)%nat -> inC e (sub (last e) (leaves e i)).
Proof.
  intros He Hi. rewrite <- (proj2 (last_ok e He)). destruct (Nat.eq_dec i (deg A e - 1)) as [->|Hne]; [apply cone_same|].
  apply cone_chain with (y := enters e (deg A e - 1)); [|apply through; auto; lia].
  rewrite meet by (auto; lia). pose proof (starts e (S i) (deg A e - 1 - S i) He) as H.
  replace (S i + (deg A e - 1 - S i))%nat with (deg A e - 1)%nat in H by lia. apply H. lia.
Qed.

(** Every point of a cell comes after its start and before its end. *)
Lemma between e s : (e < states A)%nat -> adm A e s ->
  inC e (sub (phi A e s) (first e)) /\ inC e (sub (last e) (phi A e s)).
Proof.
  intros He Hs.
  assert (H : forall k e s, (e < states A)%nat -> adm A e s ->
    inC e (sub (W A e s k (first (st A e s k))) (first e)) /\ inC e (sub (last e) (W A e s k (first (st A e s k))))).
  { clear e s He Hs. induction k; simpl; intros e s He Hs; [split; [apply cone_same|apply chord_cone; auto]|].
    pose proof (Hs O) as Hs0. simpl in Hs0. pose proof (dst_ok' e (s O) He Hs0) as Hd.
    destruct (IHk (dst A e (s O)) (tl s) Hd (adm_tl A e s Hs)) as [H1 H2]. split.
    - apply cone_chain with (y := enters e (s O)); [apply from_first; auto|]. unfold Order.enters. apply T_forward; auto.
      destruct (rev e (s O)); auto.
    - apply cone_chain with (y := leaves e (s O)); [|apply to_last; auto]. unfold Order.leaves. apply T_forward; auto.
      destruct (rev e (s O)); auto. }
  destruct (in_cone_closed (rays e) (ray e)) as (_ & _ & _ & Hl).
  assert (Hlim : forall i, is_lim_seq (fun k => W A e s k (first (st A e s k)) i) (phi A e s i)).
  { intros i. apply (phi_from A sys); auto. intros; apply first_ok; auto. }
  split.
  - apply (Hl (fun k => sub (W A e s k (first (st A e s k))) (first e))); [intros; apply H; auto|].
    intros i. unfold sub. apply (is_lim_seq_minus' _ (fun _ => first e i)); [auto|apply is_lim_seq_const].
  - apply (Hl (fun k => sub (last e) (W A e s k (first (st A e s k))))); [intros; apply H; auto|].
    intros i. unfold sub. apply (is_lim_seq_minus' (fun _ => last e i)); [apply is_lim_seq_const|auto].
Qed.

(** Secants, directed forward, lie in the cone. *)
Lemma forward k : forall e s t, (e < states A)%nat -> adm A e s -> adm A e t -> (forall j, (j < k)%nat -> s j = t j) ->
  (if turned A rev e s k then (t k < s k)%nat else (s k < t k)%nat) -> inC e (sub (phi A e t) (phi A e s)).
Proof.
  destruct sys as (Hwf & K & th & c & r & Q1 & Q2 & Q3 & Q4).
  induction k; intros e s t He Hs Ht Heq Hlt;
    rewrite (phi_step A Hwf K th c r Q1 Q4 e s He Hs), (phi_step A Hwf K th c r Q1 Q4 e t He Ht);
    pose proof (Hs O) as Hs0; pose proof (Ht O) as Ht0; simpl in Hs0, Ht0;
    pose proof (dst_ok' e (s O) He Hs0) as Hd; pose proof (dst_ok' e (t O) He Ht0) as Hd'.
  - simpl in Hlt. apply cone_chain with (y := leaves e (s O)).
    { unfold Order.leaves. apply T_forward; auto. destruct (between _ _ Hd (adm_tl A e s Hs)). destruct (rev e (s O)); auto. }
    apply cone_chain with (y := enters e (t O)).
    { rewrite meet by (auto; lia). pose proof (starts e (S (s O)) (t O - S (s O)) He) as H.
      replace (S (s O) + (t O - S (s O)))%nat with (t O) in H by lia. apply H. auto. }
    unfold Order.enters. apply T_forward; auto. destruct (between _ _ Hd' (adm_tl A e t Ht)). destruct (rev e (t O)); auto.
  - simpl in Hlt. rewrite <- (Heq O) in * by lia. apply T_forward; auto.
    assert (Htl : forall j, (j < k)%nat -> tl s j = tl t j) by (intros j Hj; apply (Heq (S j)); lia).
    assert (Ht' : adm A (dst A e (s O)) (tl t)) by (rewrite (Heq O) by lia; apply adm_tl; auto).
    pose proof (adm_tl A e s Hs) as Hs'. destruct (rev e (s O)).
    + apply IHk; auto; [intros; symmetry; auto|]. rewrite <- (turned_same A rev k _ (tl s) (tl t)) by auto.
      destruct (turned A rev (dst A e (s O)) (tl s) k); exact Hlt.
    + apply IHk; auto. destruct (turned A rev (dst A e (s O)) (tl s) k); exact Hlt.
Qed.

(** The cones along one address, seen through control points on which a functional is positive. *)
Variables (P : matrix) (h : vec) (start : nat) (s : address).
Hypothesis start_ok : (start < states A)%nat.
Hypothesis s_ok : adm A start s.
Hypothesis view : forall j, (j < rays start)%nat -> 0 < dot N h (act N P (ray start j)).

Notation f k := (st A start s k).
Notation up k := (orient (turned A rev start s k)).
(** The cell of [k] letters, with its sign. *)
Definition cell (k : nat) (x : vec) : vec := scl (up k) (W A start s k x).
Definition gen (k j : nat) : vec := act N P (cell k (ray (f k) j)).
Definition hgt (k j : nat) : R := dot N h (gen k j).
Definition unit_ray (k j : nat) : vec := scl (/ hgt k j) (gen k j).

Lemma f_ok k : (f k < states A)%nat.
Proof. apply st_ok; auto. apply (wf A sys). Qed.

Lemma f_step k : f (S k) = dst A (f k) (s k) /\ (s k < deg A (f k))%nat.
Proof.
  split; [|apply (s_ok k)]. replace (S k) with (k + 1)%nat by lia. rewrite st_plus. simpl. rewrite drop_nth, Nat.add_0_r. reflexivity.
Qed.

Lemma W_last k x : W A start s (S k) x = W A start s k (T (f k) (s k) x).
Proof.
  replace (S k) with (k + 1)%nat by lia. rewrite (W_plus A k start s 1 x). f_equal. simpl.
  rewrite drop_nth, Nat.add_0_r. reflexivity.
Qed.

Lemma cell_last k x : cell (S k) x = cell k (scl (orient (rev (f k) (s k))) (T (f k) (s k) x)).
Proof.
  unfold cell. rewrite W_last, W_scl. replace (S k) with (k + 1)%nat by lia. rewrite turned_plus. simpl.
  rewrite drop_nth, Nat.add_0_r, xorb_false_r, orient_xorb. extensionality i; unfold scl; ring.
Qed.

Lemma cell_0 x : cell 0 x = x.
Proof. unfold cell, orient. simpl. extensionality i; unfold scl; ring. Qed.

Lemma cell_add k x y : cell k (add x y) = add (cell k x) (cell k y).
Proof. unfold cell. rewrite W_add. extensionality i; unfold add, scl; ring. Qed.

Lemma cell_scl k a x : cell k (scl a x) = scl a (cell k x).
Proof. unfold cell. rewrite W_scl. extensionality i; unfold scl; ring. Qed.

Lemma gen_step k j : (j < rays (f (S k)))%nat -> gen (S k) j = comb (rays (f k)) (fun l => B (f k) (s k) l j) (gen k).
Proof.
  intros Hj. destruct (f_step k) as [Hf Hs]. unfold gen. rewrite Hf in Hj |- *. rewrite cell_last.
  rewrite B_ok by (auto; apply f_ok).
  rewrite (comb_linear (cell k) _ _ _ (cell_add k) (cell_scl k)).
  rewrite (comb_linear (act N P) _ _ _ (act_add N P) (act_scl N P)). reflexivity.
Qed.

Lemma hgt_step k j : (j < rays (f (S k)))%nat -> hgt (S k) j = sum (rays (f k)) (fun l => B (f k) (s k) l j * hgt k l).
Proof. intros Hj. unfold hgt. rewrite gen_step, dot_comb by auto. reflexivity. Qed.

Lemma B_at k l j : (l < rays (f k))%nat -> (j < rays (f (S k)))%nat -> 0 < B (f k) (s k) l j.
Proof. intros Hl Hj. destruct (f_step k) as [Hf Hs]. apply B_pos; auto; [apply f_ok|rewrite <- Hf; auto]. Qed.

Lemma B_at_ratio k l j j' : (l < rays (f k))%nat -> (j < rays (f (S k)))%nat -> (j' < rays (f (S k)))%nat ->
  kappa * B (f k) (s k) l j' <= B (f k) (s k) l j.
Proof. intros Hl Hj Hj'. destruct (f_step k) as [Hf Hs]. rewrite Hf in *. apply B_ratio; auto. apply f_ok. Qed.

Lemma hgt_pos k : forall j, (j < rays (f k))%nat -> 0 < hgt k j.
Proof.
  induction k; intros j Hj; [unfold hgt, gen; rewrite cell_0; apply view; auto|]. rewrite hgt_step by auto. apply sum_pos; [apply rays_pos, f_ok|].
  intros l Hl. apply Rmult_lt_0_compat; [apply B_at; auto|auto].
Qed.

Definition share (k j l : nat) : R := B (f k) (s k) l j * hgt k l / hgt (S k) j.

Lemma unit_step k j : (j < rays (f (S k)))%nat -> unit_ray (S k) j = comb (rays (f k)) (share k j) (unit_ray k).
Proof.
  intros Hj. unfold unit_ray at 1. rewrite gen_step by auto. extensionality i. unfold scl, comb. rewrite <- sum_scal.
  apply sum_ext; intros l Hl. unfold share, unit_ray, scl. pose proof (hgt_pos k l Hl). pose proof (hgt_pos (S k) j Hj). field. lra.
Qed.

Lemma share_sum k j : (j < rays (f (S k)))%nat -> sum (rays (f k)) (share k j) = 1.
Proof.
  intros Hj. pose proof (hgt_pos (S k) j Hj) as H.
  rewrite (sum_ext _ _ (fun l => / hgt (S k) j * (B (f k) (s k) l j * hgt k l))) by (intros; unfold share; field; lra).
  rewrite sum_scal, <- hgt_step by auto. field. lra.
Qed.

Lemma share_pos k j l : (j < rays (f (S k)))%nat -> (l < rays (f k))%nat -> 0 <= share k j l.
Proof.
  intros Hj Hl. unfold share. pose proof (hgt_pos k l Hl). pose proof (hgt_pos (S k) j Hj). pose proof (B_at k l j Hl Hj).
  left. apply Rdiv_lt_0_compat; auto. apply Rmult_lt_0_compat; auto.
Qed.

Lemma share_ratio k j j' l : (j < rays (f (S k)))%nat -> (j' < rays (f (S k)))%nat -> (l < rays (f k))%nat ->
  kappa * kappa * share k j' l <= share k j l.
Proof.
  intros Hj Hj' Hl. pose proof (hgt_pos k l Hl) as H. pose proof (hgt_pos (S k) j Hj) as H1. pose proof (hgt_pos (S k) j' Hj') as H2.
  pose proof (B_at_ratio k l j j' Hl Hj Hj') as H3. pose proof (B_at k l j' Hl Hj') as H4.
  assert (H5 : kappa * hgt (S k) j <= hgt (S k) j').
  { rewrite !hgt_step by auto. rewrite <- sum_scal. apply sum_le; intros m Hm.
    pose proof (B_at_ratio k m j' j Hm Hj' Hj). pose proof (hgt_pos k m Hm). nra. }
  unfold share. apply Rmult_le_reg_r with (hgt (S k) j * hgt (S k) j'); [apply Rmult_lt_0_compat; auto|].
  replace (kappa * kappa * (B (f k) (s k) l j' * hgt k l / hgt (S k) j') * (hgt (S k) j * hgt (S k) j'))
    with ((kappa * B (f k) (s k) l j' * hgt k l) * (kappa * hgt (S k) j)) by (field; lra).
  replace (B (f k) (s k) l j * hgt k l / hgt (S k) j * (hgt (S k) j * hgt (S k) j'))
    with ((B (f k) (s k) l j * hgt k l) * hgt (S k) j') by (field; lra).
  apply Rmult_le_compat; [left; apply Rmult_lt_0_compat; [apply Rmult_lt_0_compat|]; lra|left; apply Rmult_lt_0_compat; lra| |auto].
  apply Rmult_le_compat_r; lra.
Qed.

Definition shrink : R := 1 - kappa * kappa.
Definition wide : R := sum (rays start) (fun j => sum (rays start) (fun j' => nrm N (sub (unit_ray 0 j) (unit_ray 0 j')))).

Lemma shrink_ok : 0 <= shrink < 1.
Proof. unfold shrink. pose proof kappa_ok. nra. Qed.

Lemma wide_ge0 : 0 <= wide.
Proof. apply sum_nonneg; intros; apply sum_nonneg; intros; apply nrm_ge0. Qed.

Lemma diameter k : forall j j', (j < rays (f k))%nat -> (j' < rays (f k))%nat ->
  nrm N (sub (unit_ray k j) (unit_ray k j')) <= shrink ^ k * wide.
Proof.
  induction k; intros j j' Hj Hj'.
  - simpl in *. rewrite Rmult_1_l. unfold wide.
    eapply Rle_trans; [|apply (sum_term (rays start) (fun j => sum (rays start) (fun j' => nrm N (sub (unit_ray 0 j) (unit_ray 0 j')))) j); auto;
      intros; apply sum_nonneg; intros; apply nrm_ge0].
    apply (sum_term (rays start) (fun j' => nrm N (sub (unit_ray 0 j) (unit_ray 0 j'))) j'); auto. intros; apply nrm_ge0.
  - rewrite !unit_step by auto. simpl. rewrite Rmult_assoc. apply doeblin; auto.
    + intros; apply share_pos; auto.
    + intros; apply share_ratio; auto.
    + apply share_sum; auto.
    + apply share_sum; auto.
Qed.

Lemma hull k n : forall j l, (j < rays (f (n + k)))%nat -> (l < rays (f k))%nat ->
  nrm N (sub (unit_ray (n + k) j) (unit_ray k l)) <= shrink ^ k * wide.
Proof.
  induction n; intros j l Hj Hl; [apply diameter; auto|]. simpl in *. rewrite unit_step by auto.
  replace (sub (comb (rays (f (n + k))) (share (n + k) j) (unit_ray (n + k))) (unit_ray k l))
    with (comb (rays (f (n + k))) (share (n + k) j) (fun l' => sub (unit_ray (n + k) l') (unit_ray k l))).
  - eapply Rle_trans; [apply (nrm_mean N _ _ _ (shrink ^ k * wide))|].
    + intros; apply share_pos; auto.
    + intros; apply IHn; auto.
    + rewrite share_sum by auto. lra.
  - extensionality i. unfold comb, sub.
    rewrite (sum_ext _ _ (fun l' => share (n + k) j l' * unit_ray (n + k) l' i - unit_ray k l i * share (n + k) j l')) by (intros; ring).
    rewrite sum_minus, sum_scal, share_sum by auto. ring.
Qed.

(** The ray to which the cones shrink. *)
Definition tangent : vec := fun i => real (Lim_seq (fun k => unit_ray k 0 i)).

Lemma zero_ray k : (0 < rays (f k))%nat.
Proof. apply rays_pos, f_ok. Qed.

Lemma tangent_lim i : (i < N)%nat -> is_lim_seq (fun k => unit_ray k 0 i) (tangent i).
Proof.
  intros Hi. unfold tangent. apply Lim_seq_correct'. apply ex_lim_seq_cauchy_corr. intros eps.
  pose proof shrink_ok as Hsh. pose proof wide_ge0 as Hw.
  destruct (pow_lt_1_zero shrink) with (y := eps / (2 * (wide + 1))) as (n & Hn).
  { rewrite Rabs_pos_eq; lra. }
  { apply Rdiv_lt_0_compat; [apply cond_pos|lra]. }
  specialize (Hn n (le_n n)). rewrite Rabs_pos_eq in Hn by (apply pow_le; lra).
  assert (Hnd : shrink ^ n * wide < eps / 2).
  { apply Rle_lt_trans with (shrink ^ n * (wide + 1)).
    - apply Rmult_le_compat_l; [apply pow_le; lra|lra].
    - apply Rlt_le_trans with (eps / (2 * (wide + 1)) * (wide + 1)); [apply Rmult_lt_compat_r; lra|right; field; lra]. }
  assert (Hone : forall k, (n <= k)%nat -> Rabs (unit_ray k 0 i - unit_ray n 0 i) < eps / 2).
  { intros k Hk. eapply Rle_lt_trans; [|exact Hnd]. replace k with ((k - n) + n)%nat by lia.
    eapply Rle_trans; [|apply (hull n (k - n) 0 0); apply zero_ray].
    apply (sum_term N (fun i => Rabs (sub (unit_ray ((k - n) + n) 0) (unit_ray n 0) i)) i); auto. intros; apply Rabs_pos. }
  exists n. intros k l Hk Hl.
  replace (unit_ray k 0 i - unit_ray l 0 i) with ((unit_ray k 0 i - unit_ray n 0 i) - (unit_ray l 0 i - unit_ray n 0 i)) by ring.
  eapply Rle_lt_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. pose proof (Hone k Hk). pose proof (Hone l Hl). lra.
Qed.

Lemma tangent_near k l : (l < rays (f k))%nat -> nrm N (sub (unit_ray k l) tangent) <= shrink ^ k * wide.
Proof.
  intros Hl. rewrite nrm_sub_sym. apply (lim_le (fun n => nrm N (sub (unit_ray (n + k) 0) (unit_ray k l)))).
  - intros n. apply hull; auto. apply zero_ray.
  - apply (lim_sum N (fun n i => Rabs (sub (unit_ray (n + k) 0) (unit_ray k l) i))). intros i Hi.
    apply (is_lim_seq_abs _ (sub tangent (unit_ray k l) i)). unfold sub.
    apply (is_lim_seq_minus' _ (fun _ => unit_ray k l i)); [|apply is_lim_seq_const].
    apply (is_lim_seq_incr_n (fun n => unit_ray n 0 i) k). apply tangent_lim; auto.
Qed.

Lemma tangent_height : dot N h tangent = 1.
Proof.
  assert (H : is_lim_seq (fun k => dot N h (unit_ray k 0)) (dot N h tangent)).
  { apply (lim_sum N (fun k i => h i * unit_ray k 0 i)). intros i Hi.
    apply (is_lim_seq_scal_l (fun k => unit_ray k 0 i) (h i) (tangent i)). apply tangent_lim; auto. }
  apply is_lim_seq_ext with (v := fun _ => 1) in H.
  - apply is_lim_seq_unique in H. rewrite Lim_seq_const in H. injection H; auto.
  - intros k. unfold unit_ray. rewrite dot_scl. fold (hgt k 0). field. pose proof (hgt_pos k 0 (zero_ray k)). lra.
Qed.

Lemma tangent_pos : 0 < nrm N tangent.
Proof.
  destruct (Rle_lt_or_eq_dec 0 (nrm N tangent) (nrm_ge0 N tangent)) as [|H]; auto. exfalso.
  pose proof tangent_height as H1. pose proof (dot_le N h tangent) as H2. rewrite <- H, H1, Rmult_0_r, Rabs_R1 in H2. lra.
Qed.

(** Vectors that are nearly multiples of the tangent. *)
Definition narrow (eps : R) (x : vec) :=
  nrm N (sub (act N P x) (scl (dot N h (act N P x)) tangent)) <= eps * dot N h (act N P x).

Lemma lim_act (M : matrix) (x : nat -> vec) (y : vec) i : (forall i, is_lim_seq (fun k => x k i) (y i)) ->
  is_lim_seq (fun k => act N M (x k) i) (act N M y i).
Proof.
  intros H. unfold act. apply (lim_sum N (fun n j => M i j * x n j)). intros j Hj.
  apply (is_lim_seq_scal_l (fun n => x n j) (M i j) (y j)). apply H.
Qed.

Lemma narrow_closed eps : closed_cone (narrow eps).
Proof.
  unfold narrow. split; [|split; [|split]].
  - assert (E : act N P (fun _ => 0) = fun _ => 0) by (extensionality i; apply sum_0; intros; ring).
    rewrite E. replace (dot N h (fun _ => 0)) with 0 by (symmetry; apply sum_0; intros; ring).
    rewrite Rmult_0_r. right. apply nrm_0. intros; unfold sub, scl; ring.
  - intros x y Hx Hy. rewrite act_add, dot_add.
    replace (sub (add (act N P x) (act N P y)) (scl (dot N h (act N P x) + dot N h (act N P y)) tangent))
      with (add (sub (act N P x) (scl (dot N h (act N P x)) tangent)) (sub (act N P y) (scl (dot N h (act N P y)) tangent)))
      by (extensionality i; unfold add, sub, scl; ring).
    eapply Rle_trans; [apply nrm_add|]. lra.
  - intros a x Ha Hx. rewrite act_scl, dot_scl.
    replace (sub (scl a (act N P x)) (scl (a * dot N h (act N P x)) tangent))
      with (scl a (sub (act N P x) (scl (dot N h (act N P x)) tangent))) by (extensionality i; unfold sub, scl; ring).
    rewrite nrm_scl, Rabs_pos_eq by auto. nra.
  - intros x y Hx Hl.
    assert (Hd : is_lim_seq (fun k => dot N h (act N P (x k))) (dot N h (act N P y))).
    { apply (lim_sum N (fun k i => h i * act N P (x k) i)). intros i Hi.
      apply (is_lim_seq_scal_l (fun k => act N P (x k) i) (h i) (act N P y i)). apply lim_act; auto. }
    apply (is_lim_seq_le (fun k => nrm N (sub (act N P (x k)) (scl (dot N h (act N P (x k))) tangent)))
      (fun k => eps * dot N h (act N P (x k)))
      (nrm N (sub (act N P y) (scl (dot N h (act N P y)) tangent))) (eps * dot N h (act N P y))); auto.
    + apply (lim_sum N (fun k i => Rabs (sub (act N P (x k)) (scl (dot N h (act N P (x k))) tangent) i))). intros i Hi.
      apply (is_lim_seq_abs _ (sub (act N P y) (scl (dot N h (act N P y)) tangent) i)). unfold sub, scl.
      apply is_lim_seq_minus'; [apply lim_act; auto|].
      apply (is_lim_seq_scal_r (fun k => dot N h (act N P (x k))) (tangent i) (dot N h (act N P y))). auto.
    + apply (is_lim_seq_scal_l _ eps (dot N h (act N P y))). auto.
Qed.

Lemma narrow_rays eps : 0 < eps -> exists m, forall j, (j < rays (f m))%nat -> narrow eps (cell m (ray (f m) j)).
Proof.
  intros He. pose proof shrink_ok as Hsh. pose proof wide_ge0 as Hw.
  destruct (pow_lt_1_zero shrink) with (y := eps / (wide + 1)) as (m & Hm).
  { rewrite Rabs_pos_eq; lra. }
  { apply Rdiv_lt_0_compat; lra. }
  specialize (Hm m (le_n m)). rewrite Rabs_pos_eq in Hm by (apply pow_le; lra).
  exists m. intros j Hj. pose proof (tangent_near m j Hj) as H. pose proof (hgt_pos m j Hj) as Hp.
  unfold narrow. fold (gen m j). fold (hgt m j).
  replace (sub (gen m j) (scl (hgt m j) tangent)) with (scl (hgt m j) (sub (unit_ray m j) tangent)).
  - rewrite nrm_scl, Rabs_pos_eq, Rmult_comm by lra. apply Rmult_le_compat_r; [lra|]. eapply Rle_trans; [exact H|].
    apply Rle_trans with (shrink ^ m * (wide + 1)); [apply Rmult_le_compat_l; [apply pow_le; lra|lra]|].
    apply Rle_trans with (eps / (wide + 1) * (wide + 1)); [apply Rmult_le_compat_r; lra|right; field; lra].
  - extensionality i. unfold unit_ray, sub, scl. field. lra.
Qed.

Lemma narrow_direction eps : 0 < eps -> exists e2, 0 < e2 /\ forall x, narrow e2 x -> 0 < nrm N (act N P x) ->
  exists c, 0 < c /\ nrm N (sub (act N P x) (scl c tangent)) <= eps * nrm N (act N P x).
Proof.
  intros He. pose proof tangent_pos as Ht. exists (Rmin (1 / 2) (eps / 2) * nrm N tangent).
  assert (Hmin : 0 < Rmin (1 / 2) (eps / 2)) by (apply Rmin_glb_lt; lra).
  split; [apply Rmult_lt_0_compat; auto|]. intros x Hx Hpos. unfold narrow in Hx.
  set (X := act N P x) in *. set (c := dot N h X) in *. set (e2 := Rmin (1 / 2) (eps / 2) * nrm N tangent) in *.
  assert (He2 : 0 < e2) by (apply Rmult_lt_0_compat; auto).
  assert (He3 : e2 <= 1 / 2 * nrm N tangent) by (apply Rmult_le_compat_r; [lra|apply Rmin_l]).
  assert (He4 : e2 <= eps / 2 * nrm N tangent) by (apply Rmult_le_compat_r; [lra|apply Rmin_r]).
  assert (Hc0 : 0 <= c).
  { pose proof (nrm_ge0 N (sub X (scl c tangent))). destruct (Rle_lt_dec 0 c); auto. assert (e2 * c < 0) by nra. lra. }
  assert (Hc : 0 < c).
  { destruct (Rle_lt_or_eq_dec 0 c Hc0) as [|H0]; auto. exfalso. rewrite <- H0 in Hx. rewrite Rmult_0_r in Hx.
    pose proof (nrm_back N X (scl 0 tangent)) as Hb. rewrite nrm_scl, Rabs_R0 in Hb. lra. }
  exists c. split; auto. eapply Rle_trans; [exact Hx|].
  assert (H1 : c * nrm N tangent <= nrm N X + e2 * c).
  { rewrite <- (Rabs_pos_eq c) at 1 by auto. rewrite <- nrm_scl.
    eapply Rle_trans; [apply (nrm_back N _ X)|]. rewrite nrm_sub_sym. lra. }
  assert (H2 : c * nrm N tangent / 2 <= nrm N X) by nra. nra.
Qed.

(** Theorem 6, the tangent at every point: the secants to both sides of the point of an address, directed forward, tend to one
    and the same ray, uniformly. *)
Theorem tangent_everywhere : 0 < nrm N tangent /\ forall eps, 0 < eps -> exists m, forall t, adm A start t ->
  (forall j, (j < m)%nat -> s j = t j) -> forall x, (ahead A rev start s t /\ x = act N P (sub (phi A start t) (phi A start s))) \/
    (ahead A rev start t s /\ x = act N P (sub (phi A start s) (phi A start t))) ->
  0 < nrm N x -> exists c, 0 < c /\ nrm N (sub x (scl c tangent)) <= eps * nrm N x.
Proof.
  split; [apply tangent_pos|]. intros eps He. destruct (narrow_direction eps He) as (e2 & He2 & Hdir).
  destruct (narrow_rays e2 He2) as (m & Hm). exists m. intros t Ht Heq x Hx Hpos.
  destruct sys as (Hwf & K & th & c & r & Q1 & Q2 & Q3 & Q4).
  destruct (W_same A m start s t (phi A (f m) (drop m t)) Heq) as [HW Hst].
  assert (Hs' : adm A (f m) (drop m s)) by (apply adm_drop; auto).
  assert (Ht' : adm A (f m) (drop m t)) by (rewrite Hst; apply adm_drop; auto).
  set (ps := phi A (f m) (drop m s)) in *. set (pt := phi A (f m) (drop m t)) in *.
  assert (Es : phi A start s = W A start s m ps) by apply (phi_W A Hwf K th c r Q1 Q4 m start s start_ok s_ok).
  assert (Et : phi A start t = W A start s m pt).
  { rewrite HW. unfold pt. rewrite Hst. apply (phi_W A Hwf K th c r Q1 Q4 m start t start_ok Ht). }
  (* What is ahead in the cell of [m] letters, or, where the cell runs backwards, behind. *)
  assert (Hin : forall a b pa pb, adm A (f m) (drop m a) -> adm A (f m) (drop m b) -> phi A (f m) (drop m a) = pa ->
    phi A (f m) (drop m b) = pb -> (forall j, (j < m)%nat -> s j = a j) -> (forall j, (j < m)%nat -> a j = b j) ->
    ahead A rev start a b -> narrow e2 (sub (W A start s m pb) (W A start s m pa))).
  { intros a b pa pb Ha Hb <- <- Hsa Hab (k & Hk1 & Hk2).
    assert (Hmk : (m <= k)%nat).
    { destruct (Nat.lt_ge_cases k m) as [Hlt|]; auto. rewrite (Hab k Hlt) in Hk2. destruct (turned A rev start a k); lia. }
    assert (Hj : forall j, (j < k - m)%nat -> drop m a j = drop m b j).
    { intros j Hj. rewrite !drop_nth. apply Hk1. lia. }
    replace k with (m + (k - m))%nat in Hk2 by lia. rewrite turned_plus in Hk2.
    rewrite (turned_same A rev m start a s) in Hk2 by (intros; symmetry; auto).
    destruct (W_same A m start s a (fun _ => 0) Hsa) as [_ Hsta]. rewrite <- Hsta in Hk2.
    rewrite <- (drop_nth m a), <- (drop_nth m b) in Hk2.
    assert (Hcone : forall y, inC (f m) y -> narrow e2 (cell m y)).
    { intros y Hy. apply (Hy (fun y => narrow e2 (cell m y))); auto. unfold cell.
      apply (preimage_W A m (fun y => narrow e2 (scl (up m) y))). apply preimage_scl, narrow_closed. }
    rewrite <- W_sub. destruct (turned A rev start s m) eqn:E.
    - replace (W A start s m (sub (phi A (f m) (drop m b)) (phi A (f m) (drop m a))))
        with (cell m (sub (phi A (f m) (drop m a)) (phi A (f m) (drop m b)))).
      + apply Hcone. apply (forward (k - m)); auto; [apply f_ok|intros; symmetry; auto|].
        rewrite <- (turned_same A rev (k - m) _ (drop m a)) by auto.
        destruct (turned A rev (f m) (drop m a) (k - m)); exact Hk2.
      + unfold cell. rewrite E, !W_sub. extensionality i; unfold sub, scl, orient; ring.
    - replace (W A start s m (sub (phi A (f m) (drop m b)) (phi A (f m) (drop m a))))
        with (cell m (sub (phi A (f m) (drop m b)) (phi A (f m) (drop m a)))).
      + apply Hcone. apply (forward (k - m)); auto; [apply f_ok|].
        destruct (turned A rev (f m) (drop m a) (k - m)); exact Hk2.
      + unfold cell. rewrite E. extensionality i; unfold scl, orient; ring. }
  destruct Hx as [[Hk ->]|[Hk ->]]; apply Hdir; auto; rewrite Es, Et.
  - apply (Hin s t); auto.
  - apply (Hin t s); auto. intros; symmetry; auto.
Qed.
End Cones.
