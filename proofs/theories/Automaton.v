(** Automata of operators: addresses, contraction by words (Lemma 1), the address map, attractors and balls. *)
From Coq Require Import Reals Lra Lia List FunctionalExtensionality.
From Coquelicot Require Import Coquelicot.
From Secant Require Import Vec.
Open Scope R_scope.

Lemma pow_anti u m n : 0 <= u <= 1 -> (m <= n)%nat -> u ^ n <= u ^ m.
Proof.
  intros Hu Hmn. replace n with (m + (n - m))%nat by lia. rewrite pow_add.
  assert (0 <= u ^ m) by (apply pow_le; lra).
  assert (u ^ (n - m) <= 1) by (rewrite <- (pow1 (n - m)); apply pow_incr; lra). nra.
Qed.

(** What is below every term of a geometric sequence is not positive. *)
Lemma geometric_0 a b u : 0 <= b -> 0 <= u < 1 -> (forall n, a <= b * u ^ n) -> a <= 0.
Proof.
  intros Hb Hu H. destruct (Rle_lt_dec a 0) as [|Ha]; auto. exfalso.
  destruct (pow_lt_1_zero u) with (y := a / (b + 1)) as (n & Hn).
  { rewrite Rabs_pos_eq; lra. }
  { apply Rdiv_lt_0_compat; lra. }
  specialize (Hn n (le_n n)). rewrite Rabs_pos_eq in Hn by (apply pow_le; lra).
  specialize (H n). apply (Rmult_lt_compat_r (b + 1)) in Hn; [|lra].
  replace (a / (b + 1) * (b + 1)) with a in Hn by (field; lra).
  assert (0 <= u ^ n) by (apply pow_le; lra). lra.
Qed.

(** States [e < states] with operators [mat e i : R^(dim (dst e i)) -> R^(dim e)] for the letters [i < deg e]. *)
Record automaton := {
  N : nat;
  states : nat;
  dim : nat -> nat;
  deg : nat -> nat;
  dst : nat -> nat -> nat;
  mat : nat -> nat -> matrix
}.

(** Columns of coordinate sum 1, and shapes that fit. *)
Definition well_formed (A : automaton) := forall e, (e < states A)%nat ->
  (1 <= dim A e <= N A)%nat /\ (0 < deg A e)%nat /\
  forall i, (i < deg A e)%nat -> (dst A e i < states A)%nat /\
    (forall k j, (dim A e <= k)%nat -> mat A e i k j = 0) /\
    (forall j, (j < dim A (dst A e i))%nat -> sum (N A) (fun k => mat A e i k j) = 1).

Definition address := nat -> nat.
Definition tl (s : address) : address := fun k => s (S k).
Definition cons (i : nat) (s : address) : address := fun k => match k with O => i | S k => s k end.
Fixpoint drop (k : nat) (s : address) : address := match k with O => s | S k => drop k (tl s) end.

Lemma cons_tl s : cons (s O) (tl s) = s.
Proof. extensionality k; destruct k; reflexivity. Qed.

Section Automaton.
Variable A : automaton.
Notation N := (N A).
Notation nrm := (nrm N).
Notation T e i := (act N (mat A e i)).

(** The state after [k] letters, and the product of the first [k] operators. *)
Fixpoint st (e : nat) (s : address) (k : nat) : nat :=
  match k with O => e | S k => st (dst A e (s O)) (tl s) k end.
Fixpoint W (e : nat) (s : address) (k : nat) (x : vec) : vec :=
  match k with O => x | S k => T e (s O) (W (dst A e (s O)) (tl s) k x) end.
Definition adm (e : nat) (s : address) := forall k, (s k < deg A (st e s k))%nat.

(** The point of an address: the limit of [T_(s 0) ... T_(s (k-1)) e_0]. *)
Definition phi (e : nat) (s : address) : vec := fun i => real (Lim_seq (fun k => W e s k unit0 i)).

Lemma adm_tl e s : adm e s -> adm (dst A e (s O)) (tl s).
Proof. intros H k. exact (H (S k)). Qed.

Lemma adm_drop k : forall e s, adm e s -> adm (st e s k) (drop k s).
Proof. induction k; simpl; intros; auto. apply IHk, adm_tl; auto. Qed.

Lemma W_plus k : forall e s m x, W e s (k + m) x = W e s k (W (st e s k) (drop k s) m x).
Proof. induction k; simpl; intros; auto. rewrite IHk. reflexivity. Qed.

Lemma st_plus k : forall e s m, st e s (k + m) = st (st e s k) (drop k s) m.
Proof. induction k; simpl; intros; auto. Qed.

Lemma W_add k : forall e s x y, W e s k (add x y) = add (W e s k x) (W e s k y).
Proof. induction k; simpl; intros; auto. rewrite IHk. apply act_add. Qed.

Lemma W_scl k : forall e s a x, W e s k (scl a x) = scl a (W e s k x).
Proof. induction k; simpl; intros; auto. rewrite IHk. apply act_scl. Qed.

Lemma W_sub k e s x y : W e s k (sub x y) = sub (W e s k x) (W e s k y).
Proof. rewrite !sub_add, W_add, W_scl. reflexivity. Qed.

Hypothesis wf : well_formed A.

Lemma dim_ok e : (e < states A)%nat -> (1 <= dim A e <= N)%nat.
Proof. intros H; apply (wf e H). Qed.

Lemma T_sum e i x : (e < states A)%nat -> (i < deg A e)%nat ->
  (forall j, (dim A (dst A e i) <= j)%nat -> x j = 0) ->
  (forall k, (dim A e <= k)%nat -> T e i x k = 0) /\ sum N (T e i x) = sum N x.
Proof.
  intros He Hi Hx. destruct (wf e He) as (_ & _ & H). destruct (H i Hi) as (_ & Hrow & Hcol). split.
  - intros k Hk. apply sum_0; intros j _. rewrite Hrow by auto. ring.
  - unfold act. rewrite sum_swap. apply sum_ext; intros j Hj.
    destruct (Nat.lt_ge_cases j (dim A (dst A e i))).
    + rewrite (sum_ext N _ (fun k => x j * mat A e i k j)) by (intros; ring).
      rewrite sum_scal, Hcol by auto. ring.
    + rewrite Hx by auto. apply sum_0; intros; ring.
Qed.

Lemma T_flat e i x : (e < states A)%nat -> (i < deg A e)%nat ->
  flat N (dim A (dst A e i)) x -> flat N (dim A e) (T e i x).
Proof. intros He Hi [H1 H2]. destruct (T_sum e i x He Hi H1) as [H3 H4]. split; auto. rewrite H4; auto. Qed.

Lemma T_bary e i x : (e < states A)%nat -> (i < deg A e)%nat ->
  bary N (dim A (dst A e i)) x -> bary N (dim A e) (T e i x).
Proof. intros He Hi [H1 H2]. destruct (T_sum e i x He Hi H1) as [H3 H4]. split; auto. rewrite H4; auto. Qed.

Lemma dst_ok e s : (e < states A)%nat -> adm e s -> (dst A e (s O) < states A)%nat.
Proof. intros He Hs. destruct (wf e He) as (_ & _ & H). apply H, (Hs O). Qed.

Lemma st_ok k : forall e s, (e < states A)%nat -> adm e s -> (st e s k < states A)%nat.
Proof. induction k; simpl; intros; auto. apply IHk; [apply dst_ok|apply adm_tl]; auto. Qed.

Lemma W_flat k : forall e s x, (e < states A)%nat -> adm e s ->
  flat N (dim A (st e s k)) x -> flat N (dim A e) (W e s k x).
Proof.
  induction k; simpl; intros e s x He Hs Hx; auto.
  apply T_flat; [auto|apply (Hs O)|]. apply IHk; auto; [apply dst_ok|apply adm_tl]; auto.
Qed.

Lemma W_bary k : forall e s x, (e < states A)%nat -> adm e s ->
  bary N (dim A (st e s k)) x -> bary N (dim A e) (W e s k x).
Proof.
  induction k; simpl; intros e s x He Hs Hx; auto.
  apply T_bary; [auto|apply (Hs O)|]. apply IHk; auto; [apply dst_ok|apply adm_tl]; auto.
Qed.

(** One bound for all single operators. *)
Definition step : R := 1 + sum (states A) (fun e => sum (deg A e) (fun i => size N (mat A e i))).

Lemma step_ge1 : 1 <= step.
Proof.
  unfold step. assert (0 <= sum (states A) (fun e => sum (deg A e) (fun i => size N (mat A e i)))); [|lra].
  apply sum_nonneg; intros; apply sum_nonneg; intros; apply size_ge0.
Qed.

Lemma T_step e i x : (e < states A)%nat -> (i < deg A e)%nat -> nrm (T e i x) <= step * nrm x.
Proof.
  intros He Hi. eapply Rle_trans; [apply nrm_act|]. apply Rmult_le_compat_r; [apply nrm_ge0|].
  unfold step.
  assert (size N (mat A e i) <= sum (states A) (fun e => sum (deg A e) (fun i => size N (mat A e i)))); [|lra].
  apply Rle_trans with (sum (deg A e) (fun i => size N (mat A e i))).
  - apply (sum_term (deg A e) (fun i => size N (mat A e i)) i); auto. intros; apply size_ge0.
  - apply (sum_term (states A) (fun e => sum (deg A e) (fun i => size N (mat A e i))) e); auto.
    intros; apply sum_nonneg; intros; apply size_ge0.
Qed.

Lemma W_step k : forall e s x, (e < states A)%nat -> adm e s -> nrm (W e s k x) <= step ^ k * nrm x.
Proof.
  induction k; simpl; intros e s x He Hs; [lra|].
  eapply Rle_trans; [apply T_step; [auto|apply (Hs O)]|].
  rewrite Rmult_assoc. apply Rmult_le_compat_l; [pose proof step_ge1; lra|].
  apply IHk; [apply dst_ok|apply adm_tl]; auto.
Qed.

(** The hypotheses of Lemma 1, with balls of radius [r e] around [c e] that the words of the code map into one another:
    every address of [e] begins with a word, of between 1 and [K] letters, whose operator has a coefficient [t <= theta]. *)
Definition code (K : nat) (theta : R) (c : nat -> vec) (r : nat -> R) :=
  forall e s, (e < states A)%nat -> adm e s -> exists k t, (1 <= k <= K)%nat /\ 0 <= t <= theta /\
    (forall x, flat N (dim A (st e s k)) x -> nrm (W e s k x) <= t * nrm x) /\
    nrm (sub (W e s k (c (st e s k))) (c e)) + t * r (st e s k) <= r e.

Variables (K : nat) (theta : R) (c : nat -> vec) (r : nat -> R).
Hypothesis theta01 : 0 <= theta < 1.
Hypothesis r_ge0 : forall e, (e < states A)%nat -> 0 <= r e.
Hypothesis c_bary : forall e, (e < states A)%nat -> bary N (dim A e) (c e).
Hypothesis Hcode : code K theta c r.

Lemma root : exists u, 0 < u < 1 /\ theta <= u ^ K.
Proof.
  pose proof (pos_INR K) as HK0.
  pose (d := (1 - theta) / (INR K + 2)).
  assert (Hd : 0 < d) by (apply Rdiv_lt_0_compat; lra).
  assert (Hd1 : d * (INR K + 2) = 1 - theta) by (unfold d; field; lra).
  assert (Hd2 : d < 1) by nra.
  assert (Hpow : forall n, 1 - INR n * d <= (1 - d) ^ n).
  { induction n; [simpl; lra|]. rewrite S_INR. simpl.
    apply Rle_trans with ((1 - d) * (1 - INR n * d)); [|apply Rmult_le_compat_l; lra].
    assert (0 <= INR n * (d * d)) by (apply Rmult_le_pos; [apply pos_INR|apply Rmult_le_pos; lra]). lra. }
  exists (1 - d). split; [lra|]. pose proof (Hpow K). nra.
Qed.

(** Lemma 1: products of operators shrink differences at a geometric rate, uniformly on addresses. *)
Theorem contraction : exists C u, 0 < C /\ 0 < u < 1 /\ forall k e s x, (e < states A)%nat -> adm e s ->
  flat N (dim A (st e s k)) x -> nrm (W e s k x) <= C * u ^ k * nrm x.
Proof.
  destruct root as (u & Hu & HuK).
  assert (HK : 0 < u ^ K) by (apply pow_lt; lra).
  assert (HC : 0 < step ^ K / u ^ K).
  { apply Rdiv_lt_0_compat; auto. apply pow_lt. pose proof step_ge1; lra. }
  exists (step ^ K / u ^ K), u. split; [auto|]. split; [auto|].
  intros k. induction k as [k IH] using (well_founded_induction lt_wf). intros e s x He Hs Hx.
  destruct (Nat.lt_ge_cases k K) as [Hk|Hk].
  - eapply Rle_trans; [apply W_step; auto|]. apply Rmult_le_compat_r; [apply nrm_ge0|].
    apply Rle_trans with (step ^ K).
    + apply Rle_pow; [apply step_ge1|lia].
    + apply Rle_trans with (step ^ K / u ^ K * u ^ K); [right; field; lra|].
      apply Rmult_le_compat_l; [lra|]. apply pow_anti; [lra|lia].
  - destruct (Hcode e s He Hs) as (j & t & Hj & Ht & Hshrink & _).
    replace k with (j + (k - j))%nat in Hx |- * by lia.
    rewrite st_plus in Hx. rewrite W_plus.
    pose proof (st_ok j e s He Hs) as Hst. pose proof (adm_drop j e s Hs) as Hdrop.
    eapply Rle_trans; [apply Hshrink; apply W_flat; auto|].
    eapply Rle_trans; [apply Rmult_le_compat_l; [lra|]; apply IH; auto; lia|].
    rewrite pow_add. rewrite <- !Rmult_assoc. apply Rmult_le_compat_r; [apply nrm_ge0|].
    assert (t <= u ^ j) by (apply Rle_trans with (u ^ K); [lra|apply pow_anti; [lra|lia]]).
    assert (0 <= step ^ K / u ^ K * u ^ (k - j)) by (apply Rmult_le_pos; [lra|apply pow_le; lra]).
    replace (t * (step ^ K / u ^ K) * u ^ (k - j)) with (t * (step ^ K / u ^ K * u ^ (k - j))) by ring.
    replace (step ^ K / u ^ K * u ^ j * u ^ (k - j)) with (u ^ j * (step ^ K / u ^ K * u ^ (k - j))) by ring.
    apply Rmult_le_compat_r; auto.
Qed.

(** Differences of base points: the limits exist, and are independent of the base points. *)
Lemma Cauchy_estimate : exists D u, 0 < D /\ 0 < u < 1 /\ forall e s, (e < states A)%nat -> adm e s ->
  forall k m, nrm (sub (W e s (k + m) unit0) (W e s k unit0)) <= D * u ^ k.
Proof.
  destruct contraction as (C & u & HC & Hu & Hcon).
  pose (B := C * (step + 1)). assert (HB : 0 < B) by (unfold B; pose proof step_ge1; nra).
  exists (B / (1 - u)), u. split; [apply Rdiv_lt_0_compat; lra|]. split; [auto|].
  intros e s He Hs k m.
  assert (Hun : forall e, (e < states A)%nat -> nrm unit0 = 1).
  { intros f Hf. pose proof (dim_ok f Hf). unfold Vec.nrm. rewrite (sum_single _ _ 0%nat); [apply Rabs_R1|lia|].
    intros [|j]; [lia|]. intros; apply Rabs_R0. }
  assert (Hm : nrm (sub (W e s (k + m) unit0) (W e s k unit0)) <= B / (1 - u) * (u ^ k - u ^ (k + m))).
  { induction m.
    - rewrite Nat.add_0_r. replace (u ^ k - u ^ k) with 0 by ring. rewrite Rmult_0_r. right. apply nrm_0.
      intros; unfold sub; ring.
    - eapply Rle_trans; [apply (nrm_tri _ _ (W e s (k + m) unit0))|].
      replace (k + S m)%nat with ((k + m) + 1)%nat by lia.
      rewrite W_plus, <- W_sub.
      pose proof (st_ok (k + m) e s He Hs) as Hf. pose proof (adm_drop (k + m) e s Hs) as Hf'.
      assert (nrm (W e s (k + m) (sub (W (st e s (k + m)) (drop (k + m) s) 1 unit0) unit0)) <= B * u ^ (k + m)).
      { eapply Rle_trans; [apply Hcon; auto; apply bary_sub; [apply W_bary; auto|];
          apply bary_unit0, dim_ok; auto; apply st_ok; auto|].
        apply Rle_trans with (C * u ^ (k + m) * (step + 1)); [|unfold B; right; ring].
        apply Rmult_le_compat_l; [apply Rmult_le_pos; [lra|apply pow_le; lra]|].
        eapply Rle_trans; [apply nrm_sub|]. rewrite (Hun e He).
        pose proof (W_step 1 (st e s (k + m)) (drop (k + m) s) unit0 Hf Hf') as H1.
        rewrite (Hun e He) in H1. simpl (step ^ 1) in H1. lra. }
      apply Rle_trans with (B * u ^ (k + m) + B / (1 - u) * (u ^ k - u ^ (k + m))); [lra|].
      right. rewrite (pow_add u (k + m) 1). simpl. field; lra. }
  eapply Rle_trans; [exact Hm|]. apply Rmult_le_compat_l; [left; apply Rdiv_lt_0_compat; lra|].
  assert (0 < u ^ (k + m)) by (apply pow_lt; lra). lra.
Qed.

Lemma W_unit0_support e s k : (e < states A)%nat -> adm e s -> bary N (dim A e) (W e s k unit0).
Proof. intros He Hs. apply W_bary; auto. apply bary_unit0, dim_ok, st_ok; auto. Qed.

Theorem phi_limit e s i : (e < states A)%nat -> adm e s -> is_lim_seq (fun k => W e s k unit0 i) (phi e s i).
Proof.
  intros He Hs. unfold phi. apply Lim_seq_correct'. apply ex_lim_seq_cauchy_corr. intros eps.
  destruct Cauchy_estimate as (D & u & HD & Hu & Hest).
  destruct (pow_lt_1_zero u) with (y := eps / (2 * D)) as (n & Hn).
  { rewrite Rabs_pos_eq; lra. }
  { apply Rdiv_lt_0_compat; [apply cond_pos|lra]. }
  specialize (Hn n (le_n n)). rewrite Rabs_pos_eq in Hn by (apply pow_le; lra).
  assert (Hnd : D * u ^ n < eps / 2).
  { apply Rlt_le_trans with (D * (eps / (2 * D))); [apply Rmult_lt_compat_l; auto|right; field; lra]. }
  assert (Hone : forall k, (n <= k)%nat -> Rabs (W e s k unit0 i - W e s n unit0 i) < eps / 2).
  { intros k Hk. eapply Rle_lt_trans; [|exact Hnd].
    replace k with (n + (k - n))%nat by lia.
    eapply Rle_trans; [|apply (Hest e s He Hs n (k - n)%nat)]. apply (coord_le N (sub _ _) i).
    pose proof (dim_ok e He). intros j Hj. unfold sub.
    destruct (W_unit0_support e s (n + (k - n)) He Hs) as [H1 _]. destruct (W_unit0_support e s n He Hs) as [H2 _].
    rewrite H1, H2 by lia. ring. }
  exists n. intros k l Hk Hl.
  replace (W e s k unit0 i - W e s l unit0 i)
    with ((W e s k unit0 i - W e s n unit0 i) - (W e s l unit0 i - W e s n unit0 i)) by ring.
  eapply Rle_lt_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp.
  pose proof (Hone k Hk). pose proof (Hone l Hl). lra.
Qed.

Lemma lim_sum n (f : nat -> nat -> R) (l : nat -> R) : (forall j, (j < n)%nat -> is_lim_seq (fun k => f k j) (l j)) ->
  is_lim_seq (fun k => sum n (f k)) (sum n l).
Proof.
  induction n; simpl; intros H; [apply is_lim_seq_const|].
  apply (is_lim_seq_plus' (fun k => sum n (f k)) (fun k => f k n)); auto.
Qed.

Lemma lim_le (f : nat -> R) (l b : R) : (forall k, f k <= b) -> is_lim_seq f l -> l <= b.
Proof. intros H Hl. apply (is_lim_seq_le f (fun _ => b) l b H Hl (is_lim_seq_const b)). Qed.

(** The attractors [{phi e s}] fulfil the equation of the automaton. *)
Theorem phi_step e s : (e < states A)%nat -> adm e s -> phi e s = T e (s O) (phi (dst A e (s O)) (tl s)).
Proof.
  intros He Hs. extensionality i.
  assert (is_lim_seq (fun k => W e s (S k) unit0 i) (T e (s O) (phi (dst A e (s O)) (tl s)) i)).
  { simpl. apply (lim_sum N (fun k j => mat A e (s O) i j * W (dst A e (s O)) (tl s) k unit0 j)).
    intros j Hj. apply (is_lim_seq_scal_l _ (mat A e (s O) i j) (phi (dst A e (s O)) (tl s) j)).
    apply phi_limit; [apply dst_ok|apply adm_tl]; auto. }
  pose proof (phi_limit e s i He Hs) as H1. apply is_lim_seq_incr_1 in H1.
  apply is_lim_seq_unique in H. apply is_lim_seq_unique in H1. rewrite H in H1.
  injection H1; auto.
Qed.

Theorem phi_bary e s : (e < states A)%nat -> adm e s -> bary N (dim A e) (phi e s).
Proof.
  intros He Hs. split.
  - intros i Hi. pose proof (phi_limit e s i He Hs) as H.
    apply is_lim_seq_ext with (v := fun _ => 0) in H.
    + apply is_lim_seq_unique in H. rewrite Lim_seq_const in H. injection H; auto.
    + intros k. apply (W_unit0_support e s k He Hs); auto.
  - assert (H : is_lim_seq (fun k => sum N (W e s k unit0)) (sum N (phi e s))).
    { apply (lim_sum N (fun k j => W e s k unit0 j)). intros; apply phi_limit; auto. }
    apply is_lim_seq_ext with (v := fun _ => 1) in H.
    + apply is_lim_seq_unique in H. rewrite Lim_seq_const in H. injection H; auto.
    + intros k. apply (W_unit0_support e s k He Hs).
Qed.

Theorem phi_W k : forall e s, (e < states A)%nat -> adm e s -> phi e s = W e s k (phi (st e s k) (drop k s)).
Proof.
  induction k; simpl; intros e s He Hs; auto. rewrite phi_step by auto. f_equal.
  apply IHk; [apply dst_ok|apply adm_tl]; auto.
Qed.

Lemma phi_bounded : exists R0, 0 < R0 /\ forall e s, (e < states A)%nat -> adm e s -> nrm (sub (phi e s) (c e)) <= R0 /\
  nrm (phi e s) <= R0.
Proof.
  destruct Cauchy_estimate as (D & u & HD & Hu & Hest).
  pose (M := sum (states A) (fun e => nrm (c e))).
  assert (HM : 0 <= M) by (apply sum_nonneg; intros; apply nrm_ge0).
  assert (Hbig : forall e s, (e < states A)%nat -> adm e s -> nrm (phi e s) <= D + nrm unit0).
  { intros e s He Hs. apply (lim_le (fun k => nrm (W e s k unit0))).
    - intros k. eapply Rle_trans; [apply (nrm_back N _ unit0)|]. rewrite Rplus_comm. apply Rplus_le_compat_r.
      pose proof (Hest e s He Hs 0%nat k) as H. simpl in H. lra.
    - apply (lim_sum N (fun k j => Rabs (W e s k unit0 j))). intros j Hj.
      apply (is_lim_seq_abs _ (phi e s j)). apply phi_limit; auto. }
  exists (D + nrm unit0 + M). pose proof (nrm_ge0 N unit0). split; [lra|]. intros e s He Hs.
  pose proof (Hbig e s He Hs). split; [|lra]. eapply Rle_trans; [apply nrm_sub|].
  assert (nrm (c e) <= M); [|lra].
  apply (sum_term (states A) (fun e => nrm (c e)) e); auto. intros; apply nrm_ge0.
Qed.

(** The attractors lie in the balls. *)
Theorem ball e s : (e < states A)%nat -> adm e s -> nrm (sub (phi e s) (c e)) <= r e.
Proof.
  destruct phi_bounded as (R0 & HR0 & Hb).
  assert (Hn : forall n e s, (e < states A)%nat -> adm e s -> nrm (sub (phi e s) (c e)) <= r e + theta ^ n * R0).
  { induction n; intros f t Hf Ht.
    - simpl. pose proof (Hb f t Hf Ht). pose proof (r_ge0 f Hf). lra.
    - destruct (Hcode f t Hf Ht) as (k & a & Hk & Ha & Hshrink & Hball).
      pose proof (st_ok k f t Hf Ht) as Hg. pose proof (adm_drop k f t Ht) as Hgt.
      rewrite (phi_W k f t Hf Ht).
      eapply Rle_trans; [apply (nrm_tri _ _ (W f t k (c (st f t k))))|]. rewrite <- W_sub.
      assert (nrm (W f t k (sub (phi (st f t k) (drop k t)) (c (st f t k)))) <= a * (r (st f t k) + theta ^ n * R0)).
      { eapply Rle_trans; [apply Hshrink, bary_sub; [apply phi_bary|apply c_bary]; auto|].
        apply Rmult_le_compat_l; [lra|]. apply IHn; auto. }
      assert (a * (theta ^ n * R0) <= theta * (theta ^ n * R0)).
      { apply Rmult_le_compat_r; [apply Rmult_le_pos; [apply pow_le|]; lra|lra]. }
      simpl. lra. }
  intros He Hs. 
  assert (nrm (sub (phi e s) (c e)) - r e <= 0); [|lra].
  apply (geometric_0 _ R0 theta); [lra|auto|]. intros n. pose proof (Hn n e s He Hs). lra.
Qed.
End Automaton.

(** The attractor of a state, as a set of points. *)
Definition attractor (A : automaton) (e : nat) (x : vec) := exists s, adm A e s /\ x = phi A e s.

(** The hypotheses of Lemma 1. *)
Definition contracting (A : automaton) := well_formed A /\ exists K theta c r, 0 <= theta < 1 /\
  (forall e, (e < states A)%nat -> 0 <= r e) /\ (forall e, (e < states A)%nat -> bary (N A) (dim A e) (c e)) /\
  code A K theta c r.

Section Attractor.
Variable A : automaton.
Hypothesis sys : contracting A.

(** Lemma 1: the attractors exist, as sets that fulfil [A_e = U_i T_i A_(dst e i)]. *)
Theorem attractor_equation e x : (e < states A)%nat ->
  (attractor A e x <-> exists i y, (i < deg A e)%nat /\ attractor A (dst A e i) y /\ x = act (N A) (mat A e i) y).
Proof.
  destruct sys as (wf & K & th & c & r & H1 & H2 & H3 & H4). intros He. split.
  - intros (s & Hs & ->). exists (s O), (phi A (dst A e (s O)) (tl s)). split; [apply (Hs O)|]. split.
    + exists (tl s). split; auto. apply adm_tl; auto.
    + apply (phi_step A wf K th c r); auto.
  - intros (i & y & Hi & (s & Hs & ->) & ->). exists (cons i s).
    assert (Ha : adm A e (cons i s)) by (intros [|k]; [exact Hi|apply (Hs k)]).
    split; auto. symmetry. apply (phi_step A wf K th c r H1 H4 e (cons i s) He Ha).
Qed.

Lemma attractor_inhabited e : (e < states A)%nat -> exists x, attractor A e x.
Proof.
  destruct sys as (wf & _). intros He. exists (phi A e (fun _ => O)), (fun _ => O). split; auto.
  intros k. assert (H : forall k e, (e < states A)%nat -> (st A e (fun _ => O) k < states A)%nat).
  { clear k e He. induction k; simpl; intros e He; auto. apply IHk.
    destruct (wf e He) as (_ & H1 & H2). apply (H2 O H1). }
  apply (wf _ (H k e He)).
Qed.

(** The points do not depend on the base points: any points of coordinate sum 1, bounded by [B], do. *)
Theorem base_points e s (a : nat -> vec) B i : (e < states A)%nat -> adm A e s -> (i < N A)%nat ->
  (forall k, bary (N A) (dim A (st A e s k)) (a k)) -> (forall k, nrm (N A) (a k) <= B) ->
  is_lim_seq (fun k => W A e s k (a k) i) (phi A e s i).
Proof.
  destruct sys as (wf & K & th & c & r & H1 & H2 & H3 & H4). intros He Hs Hi Ha HB.
  destruct (contraction A wf K th c r H1 H4) as (C & u & HC & Hu & Hcon).
  destruct (phi_bounded A wf K th c r H1 H4) as (R0 & HR0 & Hb).
  assert (HB0 : 0 <= B) by (eapply Rle_trans; [apply (nrm_ge0 (N A) (a O))|apply HB]).
  assert (Hk : forall k, Rabs (W A e s k (a k) i - phi A e s i) <= C * (B + R0) * u ^ k).
  { intros k. apply Rle_trans with (nrm (N A) (sub (W A e s k (a k)) (phi A e s))).
    - apply (sum_term (N A) (fun j => Rabs (sub (W A e s k (a k)) (phi A e s) j)) i); auto. intros; apply Rabs_pos.
    - rewrite (phi_W A wf K th c r H1 H4 k e s He Hs), <- W_sub.
      pose proof (st_ok A wf k e s He Hs) as Hf. pose proof (adm_drop A k e s Hs) as Hd.
      eapply Rle_trans; [apply Hcon; auto; apply bary_sub; [apply Ha|apply (phi_bary A wf K th c r); auto]|].
      replace (C * (B + R0) * u ^ k) with (C * u ^ k * (B + R0)) by ring.
      apply Rmult_le_compat_l; [apply Rmult_le_pos; [lra|apply pow_le; lra]|].
      eapply Rle_trans; [apply nrm_sub|]. apply Rplus_le_compat; [apply HB|apply Hb; auto]. }
  apply is_lim_seq_spec. intros eps.
  destruct (pow_lt_1_zero u) with (y := eps / (C * (B + R0))) as (n & Hn).
  { rewrite Rabs_pos_eq; lra. }
  { apply Rdiv_lt_0_compat; [apply cond_pos|apply Rmult_lt_0_compat; lra]. }
  exists n. intros k Hnk. specialize (Hn k Hnk). rewrite Rabs_pos_eq in Hn by (apply pow_le; lra).
  eapply Rle_lt_trans; [apply Hk|].
  apply Rlt_le_trans with (C * (B + R0) * (eps / (C * (B + R0)))).
  - apply Rmult_lt_compat_l; auto. apply Rmult_lt_0_compat; lra.
  - right. field. lra.
Qed.
End Attractor.
