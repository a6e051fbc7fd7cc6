(** Contraction by polytopes (Lemma 1′): pieces map the vertices of one polytope to combinations of the vertices of another that
    have a share in common. *)
From Coq Require Import Reals Lra Lia List QArith Qabs Qreals Bool FunctionalExtensionality.
From Coquelicot Require Import Coquelicot.
From Secant Require Export Replay Convex.
From Secant Require Import Vec Automaton Leading Words Cones.
Open Scope R_scope.

Section Polytopes.
Variable A : automaton.
Notation N := (N A).
Notation nrm := (nrm N).
Notation T e i := (act N (mat A e i)).
Hypothesis wf : well_formed A.

(** By state the vertices; by piece the weights of the images and what they have in common; coordinates in the vertices. *)
Variables (n : nat -> nat) (corner : nat -> nat -> vec) (p : nat -> nat -> nat -> nat -> R) (q : nat -> nat -> nat -> R).
Variables (inv : nat -> nat -> nat -> R) (theta : R).
Hypothesis theta_ok : 0 <= theta < 1.
Hypothesis some : forall e, (e < states A)%nat -> (0 < n e)%nat.
Hypothesis affine : forall e l, (e < states A)%nat -> (l < n e)%nat -> bary N (dim A e) (corner e l).
Hypothesis image : forall e i j, (e < states A)%nat -> (i < deg A e)%nat -> (j < n (dst A e i))%nat ->
  T e i (corner (dst A e i) j) = comb (n e) (p e i j) (corner e) /\ sum (n e) (p e i j) = 1 /\
  forall l, (l < n e)%nat -> 0 <= q e i l <= p e i j l.
Hypothesis share : forall e i, (e < states A)%nat -> (i < deg A e)%nat -> 1 - theta <= sum (n e) (q e i).
Hypothesis inverse : forall e k, (e < states A)%nat -> (k < dim A e)%nat ->
  comb (n e) (fun l => inv e l k) (corner e) = fun i => if Nat.eqb i k then 1 else 0.

Definition heavy (m : nat) (w : nat -> R) : R := sum m (fun l => Rabs (w l)).

Lemma heavy_ge0 m w : 0 <= heavy m w.
Proof. apply sum_nonneg; intros; apply Rabs_pos. Qed.

Lemma comb_comb m k (w : nat -> R) (a : nat -> nat -> R) u :
  comb m w (fun j => comb k (a j) u) = comb k (fun l => sum m (fun j => w j * a j l)) u.
Proof.
  extensionality i. unfold comb. rewrite (sum_ext m _ (fun j => sum k (fun l => w j * a j l * u l i))).
  - rewrite sum_swap. apply sum_ext; intros l Hl. rewrite (sum_ext m _ (fun j => u l i * (w j * a j l))) by (intros; ring).
    rewrite sum_scal. ring.
  - intros j Hj. rewrite <- sum_scal. apply sum_ext; intros; ring.
Qed.

(** A piece shrinks the weights of a difference. *)
Lemma piece_shrinks e i w : (e < states A)%nat -> (i < deg A e)%nat -> sum (n (dst A e i)) w = 0 ->
  exists w', T e i (comb (n (dst A e i)) w (corner (dst A e i))) = comb (n e) w' (corner e) /\ sum (n e) w' = 0 /\
    heavy (n e) w' <= theta * heavy (n (dst A e i)) w.
Proof.
  intros He Hi Hw. set (m := n (dst A e i)) in *. exists (fun l => sum m (fun j => w j * (p e i j l - q e i l))).
  assert (Hq : forall l, sum m (fun j => w j * (p e i j l - q e i l)) = sum m (fun j => w j * p e i j l)).
  { intros l. rewrite (sum_ext m _ (fun j => w j * p e i j l - q e i l * w j)) by (intros; ring).
    rewrite sum_minus, sum_scal, Hw. ring. }
  assert (Hp : forall j, (j < m)%nat -> sum (n e) (fun l => p e i j l - q e i l) = 1 - sum (n e) (q e i)).
  { intros j Hj. rewrite sum_minus. destruct (image e i j He Hi Hj) as (_ & -> & _). reflexivity. }
  split; [|split].
  - rewrite (comb_linear (T e i)) by (intros; first [apply act_add|apply act_scl]).
    transitivity (comb m w (fun j => comb (n e) (p e i j) (corner e))).
    + extensionality k. apply sum_ext; intros j Hj. destruct (image e i j He Hi Hj) as (-> & _). reflexivity.
    + rewrite comb_comb. extensionality k. apply sum_ext; intros l Hl. rewrite Hq. reflexivity.
  - rewrite sum_swap. rewrite (sum_ext m _ (fun j => (1 - sum (n e) (q e i)) * w j)).
    + rewrite sum_scal, Hw. ring.
    + intros j Hj. rewrite sum_scal, Hp by auto. ring.
  - unfold heavy. apply Rle_trans with (sum (n e) (fun l => sum m (fun j => Rabs (w j) * (p e i j l - q e i l)))).
    + apply sum_le; intros l Hl. eapply Rle_trans; [apply sum_abs|]. apply sum_le; intros j Hj. rewrite Rabs_mult.
      right. f_equal. apply Rabs_pos_eq. destruct (image e i j He Hi Hj) as (_ & _ & H). specialize (H l Hl). lra.
    + rewrite sum_swap, <- sum_scal. apply sum_le; intros j Hj. rewrite sum_scal, Hp by auto.
      rewrite Rmult_comm. apply Rmult_le_compat_r; [apply Rabs_pos|]. pose proof (share e i He Hi). lra.
Qed.

Lemma word_shrinks k : forall e s w, (e < states A)%nat -> adm A e s -> sum (n (st A e s k)) w = 0 ->
  exists w', W A e s k (comb (n (st A e s k)) w (corner (st A e s k))) = comb (n e) w' (corner e) /\ sum (n e) w' = 0 /\
    heavy (n e) w' <= theta ^ k * heavy (n (st A e s k)) w.
Proof.
  induction k; simpl; intros e s w He Hs Hw; [exists w; split; auto; split; auto; lra|].
  pose proof (Hs O) as Hs0. simpl in Hs0. assert (Hd : (dst A e (s O) < states A)%nat) by (apply (wf e He); auto).
  destruct (IHk (dst A e (s O)) (tl s) w Hd (adm_tl A e s Hs) Hw) as (w1 & E1 & S1 & B1).
  destruct (piece_shrinks e (s O) w1 He Hs0 S1) as (w2 & E2 & S2 & B2). exists w2. rewrite E1. split; auto. split; auto.
  eapply Rle_trans; [exact B2|]. rewrite Rmult_assoc. apply Rmult_le_compat_l; [lra|exact B1].
Qed.

Definition many : R := sum (states A) (fun e => sum (n e) (fun l => sum (dim A e) (fun k => Rabs (inv e l k)))).
Definition far : R := sum (states A) (fun e => sum (n e) (fun l => nrm (corner e l))).

Lemma in_corners e x : (e < states A)%nat -> flat N (dim A e) x ->
  exists w, x = comb (n e) w (corner e) /\ sum (n e) w = 0 /\ heavy (n e) w <= many * nrm x.
Proof.
  intros He [Hsup Hsum]. pose proof (dim_ok A wf e He) as Hdim. exists (fun l => sum (dim A e) (fun k => x k * inv e l k)).
  assert (E : comb (n e) (fun l => sum (dim A e) (fun k => x k * inv e l k)) (corner e) = x).
  { rewrite <- (comb_comb (dim A e) (n e) x (fun k l => inv e l k) (corner e)). extensionality i. unfold comb at 1.
    rewrite (sum_ext _ _ (fun k => x k * (if Nat.eqb i k then 1 else 0))) by (intros k Hk; rewrite inverse by auto; reflexivity).
    destruct (Nat.lt_ge_cases i (dim A e)) as [Hi|Hi].
    - rewrite (sum_single _ _ i Hi); [rewrite Nat.eqb_refl; ring|]. intros j Hj Hji.
      destruct (Nat.eqb_spec i j); [congruence|ring].
    - rewrite Hsup by auto. apply sum_0. intros k Hk. destruct (Nat.eqb_spec i k); [lia|ring]. }
  split; [auto|]. split.
  - transitivity (sum N (comb (n e) (fun l => sum (dim A e) (fun k => x k * inv e l k)) (corner e))); [|rewrite E; exact Hsum].
    unfold comb. rewrite (sum_swap N (n e)). apply sum_ext; intros l Hl. rewrite sum_scal.
    destruct (affine e l He Hl) as [_ ->]. ring.
  - unfold heavy. apply Rle_trans with (sum (n e) (fun l => sum (dim A e) (fun k => nrm x * Rabs (inv e l k)))).
    + apply sum_le; intros l Hl. eapply Rle_trans; [apply sum_abs|]. apply sum_le; intros k Hk. rewrite Rabs_mult.
      apply Rmult_le_compat_r; [apply Rabs_pos|]. apply (sum_term N (fun i => Rabs (x i)) k); [intros; apply Rabs_pos|lia].
    + rewrite (sum_ext (n e) _ (fun l => nrm x * sum (dim A e) (fun k => Rabs (inv e l k)))) by (intros; apply sum_scal).
      rewrite sum_scal, Rmult_comm. apply Rmult_le_compat_r; [apply nrm_ge0|].
      apply (sum_term (states A) (fun e => sum (n e) (fun l => sum (dim A e) (fun k => Rabs (inv e l k)))) e); auto.
      intros; apply sum_nonneg; intros; apply sum_nonneg; intros; apply Rabs_pos.
Qed.

Lemma near_corners e w : (e < states A)%nat -> nrm (comb (n e) w (corner e)) <= far * heavy (n e) w.
Proof.
  intros He. eapply Rle_trans; [apply nrm_comb|]. unfold heavy. rewrite <- sum_scal. apply sum_le; intros l Hl.
  rewrite Rmult_comm. apply Rmult_le_compat_r; [apply Rabs_pos|].
  apply Rle_trans with (sum (n e) (fun l => nrm (corner e l))).
  - apply (sum_term (n e) (fun l => nrm (corner e l)) l); auto. intros; apply nrm_ge0.
  - apply (sum_term (states A) (fun e => sum (n e) (fun l => nrm (corner e l))) e); auto.
    intros; apply sum_nonneg; intros; apply nrm_ge0.
Qed.

(** Lemma 1′: the system contracts. *)
Theorem polytopes_contract : contracting A.
Proof.
  assert (Hm : 0 <= many) by (apply sum_nonneg; intros; apply sum_nonneg; intros; apply sum_nonneg; intros; apply Rabs_pos).
  assert (Hf : 0 <= far) by (apply sum_nonneg; intros; apply sum_nonneg; intros; apply nrm_ge0).
  assert (Hfm : 0 <= far * many) by (apply Rmult_le_pos; auto).
  destruct (pow_lt_1_zero theta) with (y := 1 / (2 * (far * many + 1))) as (K0 & HK).
  { rewrite Rabs_pos_eq; lra. }
  { apply Rdiv_lt_0_compat; lra. }
  set (K := S K0). specialize (HK K ltac:(unfold K; lia)). rewrite Rabs_pos_eq in HK by (apply pow_le; lra).
  assert (HK2 : far * (theta ^ K * many) <= 1 / 2).
  { assert (0 <= theta ^ K) by (apply pow_le; lra). apply Rle_trans with (theta ^ K * (far * many + 1)); [nra|].
    apply Rle_trans with (1 / (2 * (far * many + 1)) * (far * many + 1)); [apply Rmult_le_compat_r; lra|right; field; lra]. }
  pose proof (step_ge1 A) as Hstep. assert (HSK : 0 <= step A ^ K) by (apply pow_le; lra).
  set (D := step A ^ K * nrm unit0 + nrm unit0).
  pose proof (nrm_ge0 N unit0) as Hu. assert (HD : 0 <= D) by (unfold D; assert (0 <= step A ^ K * nrm unit0) by (apply Rmult_le_pos; auto); lra).
  split; [exact wf|]. exists K, (1 / 2), (fun _ => unit0), (fun _ => 2 * D).
  split; [lra|]. split; [intros; lra|]. split; [intros e He; apply bary_unit0, dim_ok; auto|].
  intros e s He Hs. exists K, (1 / 2). split; [unfold K; lia|]. split; [lra|]. split.
  - intros x Hx. pose proof (st_ok A wf K e s He Hs) as Hst. destruct (in_corners _ x Hst Hx) as (w & Ew & Sw & Bw).
    destruct (word_shrinks K e s w He Hs Sw) as (w' & E' & S' & B'). rewrite Ew at 1. rewrite E'.
    eapply Rle_trans; [apply near_corners; auto|].
    apply Rle_trans with (far * (theta ^ K * (many * nrm x))).
    + apply Rmult_le_compat_l; auto. eapply Rle_trans; [exact B'|]. apply Rmult_le_compat_l; [apply pow_le; lra|exact Bw].
    + replace (far * (theta ^ K * (many * nrm x))) with (far * (theta ^ K * many) * nrm x) by ring.
      apply Rmult_le_compat_r; [apply nrm_ge0|exact HK2].
  - apply Rle_trans with (D + 1 / 2 * (2 * D)); [|lra]. apply Rplus_le_compat_r.
    eapply Rle_trans; [apply nrm_sub|]. unfold D. apply Rplus_le_compat_r. apply W_step; auto.
Qed.

Lemma word_convex k : forall e s, (e < states A)%nat -> adm A e s ->
  exists w, W A e s k (corner (st A e s k) O) = comb (n e) w (corner e) /\ sum (n e) w = 1 /\ forall l, (l < n e)%nat -> 0 <= w l.
Proof.
  induction k; simpl; intros e s He Hs.
  - pose proof (some e He) as Hn. exists (fun l => if Nat.eqb l 0 then 1 else 0). split; [|split].
    + extensionality i. unfold comb. rewrite (sum_single _ _ O Hn); [simpl; ring|]. intros [|j] Hj Hne; [congruence|simpl; ring].
    + rewrite (sum_single _ _ O Hn); [reflexivity|]. intros [|j] Hj Hne; [congruence|reflexivity].
    + intros [|l] _; simpl; lra.
  - pose proof (Hs O) as Hs0. simpl in Hs0. assert (Hd : (dst A e (s O) < states A)%nat) by (apply (wf e He); auto).
    destruct (IHk (dst A e (s O)) (tl s) Hd (adm_tl A e s Hs)) as (w & E & Sw & Pw). set (m := n (dst A e (s O))) in *.
    exists (fun l => sum m (fun j => w j * p e (s O) j l)). rewrite E. split; [|split].
    + rewrite (comb_linear (T e (s O))) by (intros; first [apply act_add|apply act_scl]). rewrite <- comb_comb.
      extensionality i. apply sum_ext; intros j Hj. destruct (image e (s O) j He Hs0 Hj) as (-> & _). reflexivity.
    + rewrite sum_swap. rewrite <- Sw. apply sum_ext; intros j Hj. rewrite sum_scal.
      destruct (image e (s O) j He Hs0 Hj) as (_ & -> & _). ring.
    + intros l Hl. apply sum_nonneg; intros j Hj. destruct (image e (s O) j He Hs0 Hj) as (_ & _ & H). specialize (H l Hl).
      apply Rmult_le_pos; [apply Pw; auto|lra].
Qed.

(** A ball that holds the vertices holds the attractor. *)
Theorem polytope_ball e c r : (e < states A)%nat -> (forall l, (l < n e)%nat -> nrm (sub (corner e l) c) <= r) ->
  forall s, adm A e s -> nrm (sub (phi A e s) c) <= r.
Proof.
  intros He Hr s Hs. apply (lim_le (fun k => nrm (sub (W A e s k (corner (st A e s k) O)) c))).
  - intros k. destruct (word_convex k e s He Hs) as (w & -> & Sw & Pw).
    replace (sub (comb (n e) w (corner e)) c) with (comb (n e) w (fun l => sub (corner e l) c)).
    + eapply Rle_trans; [apply (nrm_mean N (n e) w _ r Pw Hr)|]. rewrite Sw. lra.
    + extensionality i. unfold comb, sub. rewrite (sum_ext (n e) _ (fun l => w l * corner e l i - c i * w l)) by (intros; ring).
      rewrite sum_minus, sum_scal, Sw. ring.
  - apply (lim_sum N (fun k i => Rabs (sub (W A e s k (corner (st A e s k) O)) c i))). intros i Hi.
    apply (is_lim_seq_abs _ (sub (phi A e s) c i)). unfold sub.
    apply (is_lim_seq_minus' _ (fun _ => c i)); [|apply is_lim_seq_const].
    apply (phi_from A polytopes_contract (fun e => corner e O)); auto.
Qed.
End Polytopes.

(** By state vertices, and by piece the weights of the images of the vertices of its target, and weights that all have in common;
    by vertex a row of coordinates. *)
Record hulls := {
  corners : list (list qvec); images_of : list (list (list qvec)); shared : list (list qvec); inverses : list qmat; shrink_by : Q
}.

Section Replay.
Variable case : system.
Notation A := (automaton_of case).
Notation N := (ambient case).
Notation mt e i := (snd (piece case e i)).
Variables (centres : list qvec) (radii : list Q) (spaces : list qmat) (k : hulls).

Definition corner_list e := nth e (corners k) [].
Definition corner_at e l := nth l (corner_list e) [].
Definition weight_at e i j : qvec := nth j (nth i (nth e (images_of k) []) []) [].
Definition shared_at e i : qvec := nth i (nth e (shared k) []) [].
Definition inverse_at e : qmat := nth e (inverses k) [].
Definition blend e (w : nat -> Q) : qvec := tab N (fun i => qsum (length (corner_list e)) (fun l => w l * qnth (corner_at e l) i)%Q).

Definition check_polytope (e : nat) : bool :=
  let n := length (corner_list e) in
  (0 <? n) && forallb (fun l => qbary N (dim A e) (corner_at e l) &&
    Qle_bool (qnrm N (qsub N (corner_at e l) (centre centres e))) (radius radii e)) (seq 0 n) &&
  qbary N (dim A e) (centre centres e) &&
  forallb (fun i => qeqv N (blend e (fun l => qent (inverse_at e) l i)) (tab N (fun j => if j =? i then 1%Q else 0%Q))) (seq 0 (dim A e)) &&
  forallb (fun i => Qle_bool (1 - shrink_by k) (qsum n (qnth (shared_at e i))) &&
    forallb (fun j => qeqv N (qact N (mt e i) (corner_at (dst A e i) j)) (blend e (qnth (weight_at e i j))) &&
      Qeq_bool (qsum n (qnth (weight_at e i j))) 1 &&
      forallb (fun l => Qle_bool 0 (qnth (shared_at e i) l) && Qle_bool (qnth (shared_at e i) l) (qnth (weight_at e i j) l)) (seq 0 n))
    (seq 0 (length (corner_list (dst A e i))))) (seq 0 (deg A e)).

Definition check_hulls : bool :=
  check_form case && Qle_bool 0 (shrink_by k) && Qlt_bool (shrink_by k) 1 && forallb check_polytope (seq 0 (states A)) &&
  check_spaces case centres spaces.

Lemma blend_ok e w : (forall l, (l < length (corner_list e))%nat -> (length (corner_at e l) <= N)%nat) ->
  qv (blend e w) = comb (length (corner_list e)) (fun l => Q2R (w l)) (fun l => qv (corner_at e l)).
Proof.
  intros Hu. extensionality i. unfold qv, blend, comb. rewrite tab_nth. destruct (Nat.ltb_spec i N) as [Hi|Hi].
  - rewrite qsum_ok. apply sum_ext; intros. apply Q2R_mult.
  - rewrite Q2R_0. symmetry. apply sum_0. intros l Hl. rewrite nth_overflow by (specialize (Hu l Hl); lia). rewrite Q2R_0. ring.
Qed.

(** Lemma 1′, and balls that hold the polytopes. *)
Theorem controlled_hulls : check_hulls = true -> controlled case centres radii spaces.
Proof.
  unfold check_hulls. rewrite !andb_true_iff. intros [[[[Hf H0] H1] H] Hsp].
  destruct (check_form_ok case Hf) as [Hwf Hlen]. apply Q2R_le in H0. rewrite Q2R_0 in H0. apply Q2R_lt in H1. rewrite Q2R_1 in H1.
  set (n := fun e => length (corner_list e)).
  assert (C : forall e, (e < states A)%nat -> (0 < n e)%nat /\
    (forall l, (l < n e)%nat -> qbary N (dim A e) (corner_at e l) = true /\
      nrm N (sub (qv (corner_at e l)) (qv (centre centres e))) <= Q2R (radius radii e)) /\
    qbary N (dim A e) (centre centres e) = true /\
    (forall i, (i < dim A e)%nat -> comb (n e) (fun l => Q2R (qent (inverse_at e) l i)) (fun l => qv (corner_at e l)) =
      fun j => if Nat.eqb j i then 1 else 0) /\
    (forall i, (i < deg A e)%nat -> 1 - Q2R (shrink_by k) <= sum (n e) (fun l => Q2R (qnth (shared_at e i) l)) /\
      forall j, (j < n (dst A e i))%nat -> act N (mat A e i) (qv (corner_at (dst A e i) j)) =
        comb (n e) (fun l => Q2R (qnth (weight_at e i j) l)) (fun l => qv (corner_at e l)) /\
        sum (n e) (fun l => Q2R (qnth (weight_at e i j) l)) = 1 /\
        forall l, (l < n e)%nat -> 0 <= Q2R (qnth (shared_at e i) l) <= Q2R (qnth (weight_at e i j) l))).
  { intros e He. pose proof (forall_lt _ _ H e He) as G. unfold check_polytope in G. cbv zeta in G. rewrite !andb_true_iff in G.
    destruct G as [[[[G1 G2] G3] G4] G5]. apply Nat.ltb_lt in G1.
    destruct (dim_ok A Hwf e He) as [Hd1 Hd2].
    assert (Hc : forall l, (l < n e)%nat -> (length (corner_at e l) <= N)%nat).
    { intros l Hl. pose proof (forall_lt _ _ G2 l Hl) as G. cbv beta in G. rewrite andb_true_iff in G. destruct G as [G _].
      apply qbary_len in G. simpl in *. lia. }
    split; [exact G1|]. split; [|split; [exact G3|split]].
    - intros l Hl. pose proof (forall_lt _ _ G2 l Hl) as G. cbv beta in G. rewrite andb_true_iff in G. destruct G as [Ga Gb].
      split; auto. apply Q2R_le in Gb. rewrite qnrm_ok, qsub_ok in Gb; auto. apply qbary_len in G3. simpl in *. lia.
    - intros i Hi. pose proof (forall_lt _ _ G4 i Hi) as G. cbv beta in G. apply qeqv_ok in G. unfold n.
      rewrite <- (blend_ok e (fun l => qent (inverse_at e) l i)), G by auto.
      extensionality j. unfold qv. rewrite tab_nth. destruct (Nat.ltb_spec j N) as [Hj|Hj].
      + destruct (j =? i); [apply Q2R_1|apply Q2R_0].
      + destruct (Nat.eqb_spec j i); [simpl in *; lia|apply Q2R_0].
    - intros i Hi. pose proof (forall_lt _ _ G5 i Hi) as G. cbv beta in G. rewrite andb_true_iff in G. destruct G as [Ga Gb]. split.
      + apply Q2R_le in Ga. rewrite Q2R_minus, Q2R_1, qsum_ok in Ga. exact Ga.
      + intros j Hj. pose proof (forall_lt _ _ Gb j Hj) as G. cbv beta in G. rewrite !andb_true_iff in G. destruct G as [[Gc Gd] Ge].
        split; [|split].
        * apply qeqv_ok in Gc. rewrite qact_ok in Gc by (apply Hlen; auto). unfold n.
          rewrite <- (blend_ok e (qnth (weight_at e i j))) by auto. exact Gc.
        * apply Q2R_eq in Gd. rewrite qsum_ok, Q2R_1 in Gd. exact Gd.
        * intros l Hl. pose proof (forall_lt _ _ Ge l Hl) as G. cbv beta in G. rewrite andb_true_iff in G. destruct G as [Gf Gg].
          apply Q2R_le in Gf, Gg. rewrite Q2R_0 in Gf. auto. }
  assert (P1 : forall e, (e < states A)%nat -> (0 < n e)%nat) by (intros e He; apply (C e He)).
  assert (P2 : forall e l, (e < states A)%nat -> (l < n e)%nat -> bary N (dim A e) (qv (corner_at e l))).
  { intros e l He Hl. apply qbary_ok. destruct (C e He) as (_ & Cc & _). apply (Cc l Hl). }
  assert (P3 : forall e i j, (e < states A)%nat -> (i < deg A e)%nat -> (j < n (dst A e i))%nat ->
    act N (mat A e i) (qv (corner_at (dst A e i) j)) = comb (n e) (fun l => Q2R (qnth (weight_at e i j) l)) (fun l => qv (corner_at e l)) /\
    sum (n e) (fun l => Q2R (qnth (weight_at e i j) l)) = 1 /\
    forall l, (l < n e)%nat -> 0 <= Q2R (qnth (shared_at e i) l) <= Q2R (qnth (weight_at e i j) l)).
  { intros e i j He Hi Hj. destruct (C e He) as (_ & _ & _ & _ & Ci). apply (Ci i Hi); auto. }
  assert (P4 : forall e i, (e < states A)%nat -> (i < deg A e)%nat ->
    1 - Q2R (shrink_by k) <= sum (n e) (fun l => Q2R (qnth (shared_at e i) l))).
  { intros e i He Hi. destruct (C e He) as (_ & _ & _ & _ & Ci). apply (Ci i Hi). }
  assert (P5 : forall e i, (e < states A)%nat -> (i < dim A e)%nat ->
    comb (n e) (fun l => Q2R (qent (inverse_at e) l i)) (fun l => qv (corner_at e l)) = fun j => if Nat.eqb j i then 1 else 0).
  { intros e i He Hi. destruct (C e He) as (_ & _ & _ & Cv & _). apply Cv; auto. }
  split; [exact Hf|]. split; [|split; [|split; [intros e He; apply (C e He)|exact Hsp]]].
  - apply (polytopes_contract A Hwf n (fun e l => qv (corner_at e l)) (fun e i j l => Q2R (qnth (weight_at e i j) l))
      (fun e i l => Q2R (qnth (shared_at e i) l)) (fun e l i => Q2R (qent (inverse_at e) l i)) (Q2R (shrink_by k)) (conj H0 H1)); auto.
  - intros e s He Hs. apply (polytope_ball A Hwf n (fun e l => qv (corner_at e l)) (fun e i j l => Q2R (qnth (weight_at e i j) l))
      (fun e i l => Q2R (qnth (shared_at e i) l)) (fun e l i => Q2R (qent (inverse_at e) l i)) (Q2R (shrink_by k)) (conj H0 H1)); auto.
    intros l Hl. destruct (C e He) as (_ & Cc & _). apply (Cc l Hl).
Qed.
End Replay.
