(** Branches, rings, germs, and the direction that proves: half-tangents from a ring condition. *)
From Coq Require Import Reals Lra Lia List FunctionalExtensionality.
From Coquelicot Require Import Coquelicot.
From Secant Require Export Words.
From Secant Require Import Vec Automaton Leading.
Import ListNotations.
Open Scope R_scope.

(** A branch [u w w w ...] of the attractor of a state. *)
Record branch := { prefix : list nat; cycle : list nat }.

(** The point of the branch, seen through the control points [P]. *)
Definition point (A : automaton) (P : matrix) (s : nat) (b : branch) : vec :=
  act (N A) P (phi A s (app (prefix b) (per (cycle b)))).

(** The secant from the point of the branch to the point with the address [u w^m t]. *)
Definition secant (A : automaton) (P : matrix) (s : nat) (b : branch) (m : nat) (t : address) : vec :=
  sub (act (N A) P (phi A s (app (prefix b) (rep m (cycle b) t)))) (point A P s b).

(** The secants of the germ of a branch tend to multiples of [d], uniformly: for every [eps], those of the addresses that share
    [m] turns of the cycle deviate by at most [eps] times their length from [c d], where the factor [c] is one that [sg] allows
    for the rest of the address. The germ is no single point. *)
Definition directed_by (sg : address -> R -> Prop) (A : automaton) (P : matrix) (s : nat) (b : branch) (d : vec) :=
  (forall eps, 0 < eps -> exists m0, forall m t, (m0 <= m)%nat -> adm A (stw A s (prefix b)) t ->
     0 < nrm (N A) (secant A P s b m t) ->
     exists c, sg t c /\ nrm (N A) (sub (secant A P s b m t) (scl c d)) <= eps * nrm (N A) (secant A P s b m t)) /\
  (forall m, exists t, adm A (stw A s (prefix b)) t /\ 0 < nrm (N A) (secant A P s b m t)).

Definition directed (sg : R -> Prop) := directed_by (fun _ => sg).

(** One limit ray; one limit line. *)
Definition half_tangent := directed (fun c => 0 < c).
Definition tangent_line := directed (fun c => True).

(** The order of addresses: the first letter that differs decides. *)
Definition before (s t : address) := exists k, (forall j, (j < k)%nat -> s j = t j) /\ (s k < t k)%nat.

(** One limit ray on each side of a point inside a cell: [d] for what comes after it, [-d] for what comes before. The rest of an
    address decides on which side it is ([before_turns]). *)
Definition passes (A : automaton) (P : matrix) (s : nat) (b : branch) :=
  directed_by (fun t c => (before (per (cycle b)) t -> 0 < c) /\ (before t (per (cycle b)) -> c < 0)) A P s b.

Lemma before_app w s t : before (app w s) (app w t) <-> before s t.
Proof.
  induction w as [|i w IH]; simpl; [tauto|]. rewrite <- IH. split; intros (k & H1 & H2).
  - destruct k as [|k]; [unfold cons in H2; lia|]. exists k. split; [intros j Hj; apply (H1 (S j)); lia|exact H2].
  - exists (S k). split; [intros [|j] Hj; [reflexivity|apply H1; lia]|exact H2].
Qed.

Lemma before_turns u w m t : w <> [] ->
  (before (app u (per w)) (app u (rep m w t)) <-> before (per w) t) /\
  (before (app u (rep m w t)) (app u (per w)) <-> before t (per w)).
Proof.
  intros Hw. rewrite !before_app. induction m as [|m [IH1 IH2]]; simpl; [tauto|].
  rewrite (per_app w Hw) at 1. rewrite before_app, IH1. split; [tauto|].
  rewrite (per_app w Hw) at 1. rewrite before_app. exact IH2.
Qed.

(** [d] or [-d] is a limit direction of the germ (up to length). *)
Definition limit_line (A : automaton) (P : matrix) (s : nat) (b : branch) (d : vec) :=
  forall eps m, 0 < eps -> exists n t, (m <= n)%nat /\ adm A (stw A s (prefix b)) t /\
    0 < nrm (N A) (secant A P s b n t) /\
    exists c, nrm (N A) (sub (secant A P s b n t) (scl c d)) <= eps * nrm (N A) (secant A P s b n t).

Lemma tangent_limit A P s b d : tangent_line A P s b d -> limit_line A P s b d.
Proof.
  intros [H1 H2] eps m Heps. destruct (H1 eps Heps) as (m0 & Hm0). destruct (H2 (m + m0)%nat) as (t & Ht & Hpos).
  exists (m + m0)%nat, t. split; [lia|]. split; auto. split; auto.
  destruct (Hm0 (m + m0)%nat t ltac:(lia) Ht Hpos) as (c & _ & Hc). exists c; auto.
Qed.

(** A limit direction lies on the tangent line. *)
Theorem limit_parallel A P s b d d1 : tangent_line A P s b d -> limit_line A P s b d1 -> 0 < nrm (N A) d ->
  forall i j, (i < N A)%nat -> (j < N A)%nat -> d1 i * d j = d1 j * d i.
Proof.
  intros [Ht _] Hl Hd i j Hi Hj. set (n := nrm (N A)) in *.
  assert (Hco : forall x k, (k < N A)%nat -> Rabs (x k) <= n x).
  { intros x k Hk. apply (sum_term (N A) (fun k => Rabs (x k)) k); auto. intros; apply Rabs_pos. }
  pose (h := fun x : vec => d1 i * x j - d1 j * x i). pose (H := 2 * n d1 + 1).
  assert (Hn1 : 0 <= n d1) by apply nrm_ge0.
  assert (HhH : forall x, Rabs (h x) <= H * n x).
  { intros x. unfold h, H. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp, !Rabs_mult.
    pose proof (Hco d1 i Hi). pose proof (Hco d1 j Hj). pose proof (Hco x i Hi). pose proof (Hco x j Hj).
    pose proof (Rabs_pos (d1 i)). pose proof (Rabs_pos (d1 j)). pose proof (Rabs_pos (x i)). pose proof (Rabs_pos (x j)).
    nra. }
  destruct (Req_dec (h d) 0) as [H0|H0]; [unfold h in H0; lra|exfalso].
  assert (Hhd : 0 < Rabs (h d)) by (apply Rabs_pos_lt; auto).
  pose (eps := Rmin (1 / 2) (Rabs (h d) / (8 * (H * n d)))).
  assert (HHn : 0 < H * n d) by (apply Rmult_lt_0_compat; unfold H; lra).
  assert (Heps : 0 < eps) by (unfold eps; apply Rmin_glb_lt; [lra|apply Rdiv_lt_0_compat; lra]).
  assert (He1 : eps <= 1 / 2) by apply Rmin_l.
  assert (He2 : eps * (H * n d) <= Rabs (h d) / 8).
  { apply Rle_trans with (Rabs (h d) / (8 * (H * n d)) * (H * n d)).
    - apply Rmult_le_compat_r; [lra|apply Rmin_r].
    - right. field. assert (0 < H) by (unfold H; lra). split; lra. }
  destruct (Ht eps Heps) as (m & Hm). destruct (Hl eps m Heps) as (k & t & Hk & Hadm & Hpos & c1 & Hc1).
  destruct (Hm k t Hk Hadm Hpos) as (c & _ & Hc). set (x := secant A P s b k t) in *.
  fold n in Hc, Hc1, Hpos.
  assert (Hx1 : Rabs (h x) <= H * (eps * n x)).
  { replace (h x) with (h (sub x (scl c1 d1))) by (unfold h, sub, scl; ring).
    eapply Rle_trans; [apply HhH|]. apply Rmult_le_compat_l; [unfold H; lra|auto]. }
  assert (Hx2 : Rabs c * Rabs (h d) <= Rabs (h x) + H * (eps * n x)).
  { rewrite <- Rabs_mult. replace (c * h d) with (h x - h (sub x (scl c d))) by (unfold h, sub, scl; ring).
    eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. apply Rplus_le_compat_l.
    eapply Rle_trans; [apply HhH|]. apply Rmult_le_compat_l; [unfold H; lra|auto]. }
  assert (Hx3 : n x <= Rabs c * n d + eps * n x).
  { unfold n. rewrite <- nrm_scl. eapply Rle_trans; [apply (nrm_back _ _ (scl c d))|]. fold n. lra. }
  assert (Hx4 : n x <= 2 * (Rabs c * n d)) by nra.
  assert (Hc0 : 0 < Rabs c).
  { destruct (Rle_lt_or_eq_dec 0 (Rabs c) (Rabs_pos c)) as [|Hc0]; auto. rewrite <- Hc0 in Hx4. lra. }
  assert (Hx5 : Rabs c * Rabs (h d) <= 2 * H * eps * (2 * (Rabs c * n d))).
  { apply Rle_trans with (2 * H * eps * n x); [lra|]. apply Rmult_le_compat_l; auto.
    apply Rmult_le_pos; [unfold H; lra|lra]. }
  assert (Hx6 : Rabs (h d) <= 4 * (eps * (H * n d))).
  { apply Rmult_le_reg_l with (Rabs c); auto. eapply Rle_trans; [exact Hx5|]. right; ring. }
  lra.
Qed.

(** Refutation: two limit directions on different lines, at branches of one point. *)
Theorem no_common_tangent A P s b1 b2 d1 d2 i j :
  limit_line A P s b1 d1 -> limit_line A P s b2 d2 -> (i < N A)%nat -> (j < N A)%nat ->
  d1 i * d2 j <> d1 j * d2 i ->
  ~ exists d, 0 < nrm (N A) d /\ tangent_line A P s b1 d /\ tangent_line A P s b2 d.
Proof.
  intros H1 H2 Hi Hj Hne (d & Hd & Ht1 & Ht2).
  pose proof (limit_parallel A P s b1 d d1 Ht1 H1 Hd) as E1.
  pose proof (limit_parallel A P s b2 d d2 Ht2 H2 Hd) as E2.
  assert (exists k, (k < N A)%nat /\ d k <> 0) as (k & Hk & Hdk).
  { destruct (some_coordinate (N A) d Hd) as (k & Hk & Hdk). exists k; auto. }
  apply Hne. pose proof (E1 i k Hi Hk) as A1. pose proof (E1 j k Hj Hk) as A2.
  pose proof (E2 i k Hi Hk) as A3. pose proof (E2 j k Hj Hk) as A4.
  apply (Rmult_eq_reg_r (d k * d k)); [|apply Rmult_integral_contrapositive_currified; auto].
  replace (d1 i * d2 j * (d k * d k)) with ((d1 i * d k) * (d2 j * d k)) by ring.
  replace (d1 j * d2 i * (d k * d k)) with ((d1 j * d k) * (d2 i * d k)) by ring.
  rewrite A1, A2, A3, A4. ring.
Qed.

Lemma half_tangent_line A P s b d : half_tangent A P s b d -> tangent_line A P s b d.
Proof.
  intros [H1 H2]. split; auto. intros eps He. destruct (H1 eps He) as (m0 & Hm). exists m0. intros m t Hle Ht Hx.
  destruct (Hm m t Hle Ht Hx) as (c & _ & Hc). exists c; auto.
Qed.

Section Branch.
Variable A : automaton.
Notation N := (N A).
Notation nrm := (nrm N).
Hypothesis sys : contracting A.
Variables (s : nat) (b : branch) (q : vec).
Notation u := (prefix b).
Notation w := (cycle b).
Notation e := (stw A s (prefix b)).
Hypothesis s_ok : (s < states A)%nat.
Hypothesis u_ok : admw A s u.
Hypothesis w_ok : admw A e w.
Hypothesis w_ne : w <> [].
Hypothesis closed : stw A e w = e.
Hypothesis q_bary : bary N (dim A e) q.
Hypothesis q_fix : Ww A e w q = q.
Notation V := (flat N (dim A e)).
Notation L := (Ww A e w).
Notation pw m := (Nat.iter m L).

Lemma e_ok : (e < states A)%nat.
Proof. apply (stw_ok A sys); auto. Qed.

Lemma pw_sub m x y : pw m (sub x y) = sub (pw m x) (pw m y).
Proof. rewrite !sub_add, (pw_add L (Ww_add A w e)), (pw_scl L (Ww_scl A w e)). reflexivity. Qed.

Lemma pw_q m : pw m q = q.
Proof. induction m; simpl; auto. rewrite IHm; auto. Qed.

Lemma adm_rep m t : adm A e t -> adm A e (rep m w t).
Proof. intros Ht. induction m; simpl; auto. apply adm_app. split; auto. rewrite closed. exact IHm. Qed.

Lemma adm_unrep m t : adm A e (rep m w t) -> adm A e t.
Proof. induction m; simpl; auto. intros H. apply adm_app in H. rewrite closed in H. apply IHm, H. Qed.

Lemma phi_rep m t : adm A e t -> phi A e (rep m w t) = pw m (phi A e t).
Proof.
  intros Ht. induction m; simpl; auto. rewrite (phi_app A sys).
  - rewrite closed. f_equal. exact IHm.
  - apply e_ok.
  - apply (adm_rep (S m)); auto.
Qed.

Lemma pw_W m t x : W A e (rep m w t) (m * length w) x = pw m x.
Proof.
  induction m; simpl; auto. rewrite W_app, closed. f_equal. exact IHm.
Qed.

Lemma st_rep m t : st A e (rep m w t) (m * length w) = e.
Proof. induction m; simpl; auto. rewrite st_app, closed. exact IHm. Qed.

Lemma pw_contracts : exists C v, 0 < C /\ 0 < v < 1 /\ forall m x, V x -> nrm (pw m x) <= C * v ^ m * nrm x.
Proof.
  destruct sys as (Hwf & K & th & c & r & H1 & H2 & H3 & H4).
  destruct (contraction A Hwf K th c r H1 H4) as (C & v & HC & Hv & Hcon).
  exists C, v. split; auto. split; auto. intros m x Hx.
  destruct (attractor_inhabited A sys e e_ok) as (y & t & Ht & _).
  rewrite <- (pw_W m t). eapply Rle_trans; [apply Hcon; [apply e_ok|apply adm_rep; auto|rewrite st_rep; auto]|].
  apply Rmult_le_compat_r; [apply nrm_ge0|]. apply Rmult_le_compat_l; [lra|]. apply pow_anti; [lra|].
  assert (length w <> O) by (pose proof w_ne; destruct w; simpl; congruence). nia.
Qed.

Lemma reach : exists R1, 0 < R1 /\ forall t, adm A e t -> nrm (sub (phi A e t) q) <= R1.
Proof.
  destruct sys as (Hwf & K & th & c & r & H1 & H2 & H3 & H4).
  destruct (phi_bounded A Hwf K th c r H1 H4) as (R0 & HR0 & Hb).
  exists (R0 + nrm q). pose proof (nrm_ge0 N q). split; [lra|]. intros t Ht.
  eapply Rle_trans; [apply nrm_sub|]. destruct (Hb e t e_ok Ht). lra.
Qed.

Lemma all_turns t : (forall n, exists t', adm A e t' /\ t = rep n w t') -> phi A e t = q.
Proof.
  intros H. assert (Ht : adm A e t) by (destruct (H O) as (t' & H1 & ->); exact H1).
  destruct pw_contracts as (C & v & HC & Hv & Hcon). destruct reach as (R1 & HR1 & HR).
  assert (H0 : nrm (sub (phi A e t) q) = 0).
  { apply Rle_antisym; [|apply nrm_ge0]. apply (geometric_0 _ (C * R1) v); [nra|lra|]. intros n.
    destruct (H n) as (t' & Ht' & ->). rewrite phi_rep by auto. rewrite <- (pw_q n), <- pw_sub.
    eapply Rle_trans; [apply Hcon, bary_sub; auto; apply phi_bary'; auto; apply e_ok|].
    replace (C * R1 * v ^ n) with (C * v ^ n * R1) by ring.
    apply Rmult_le_compat_l; [apply Rmult_le_pos; [lra|apply pow_le; lra]|auto]. }
  extensionality i. destruct (Nat.lt_ge_cases i N) as [Hi|Hi].
  - pose proof (nrm_eq0 N _ i H0 Hi) as H1. unfold sub in H1. lra.
  - pose proof (dim_ok A (wf A sys) e e_ok). destruct (phi_bary' A sys e t e_ok Ht) as [Hsup _].
    rewrite Hsup by lia. symmetry. apply q_bary. lia.
Qed.

Lemma adm_per : adm A e (per w).
Proof.
  assert (H : forall m, exists t, per w = rep m w t).
  { induction m as [|m (t & IH)]; [exists (per w); reflexivity|]. exists t. simpl. rewrite <- IH. apply per_app; auto. }
  (* The k-th letter lies within the first k+1 turns, which are admissible whatever follows. *)
  intros k. destruct (attractor_inhabited A sys e e_ok) as (y & t & Ht & _).
  pose proof (adm_rep (S k) t Ht k) as Hk.
  assert (Hlen : (length w >= 1)%nat) by (pose proof w_ne; destruct w; simpl; [congruence|lia]).
  assert (Heq : forall n a c j, (j < n * length w)%nat -> rep n w a j = rep n w c j).
  { induction n as [|n IH]; intros a c j Hj; [simpl in Hj; lia|]. simpl. rewrite !app_nth.
    destruct (Nat.ltb_spec j (length w)); auto. apply IH. simpl in Hj. lia. }
  assert (Hst : forall n f a c, (forall j, (j < n)%nat -> a j = c j) -> st A f a n = st A f c n).
  { induction n as [|n IH]; intros f a c Hac; auto. simpl. rewrite (Hac O) by lia. apply IH.
    intros j Hj. apply (Hac (S j)). lia. }
  destruct (H (S k)) as (t' & Ht').
  assert (Hag : forall j, (j <= k)%nat -> per w j = rep (S k) w t j).
  { intros j Hj. rewrite Ht'. apply Heq. simpl. nia. }
  rewrite (Hag k) by lia. rewrite (Hst k e (per w) (rep (S k) w t)); [exact Hk|].
  intros j Hj. apply Hag. lia.
Qed.

Lemma phi_per : phi A e (per w) = q.
Proof.
  apply all_turns. intros n. exists (per w). split; [apply adm_per|].
  induction n; simpl; auto. rewrite <- IHn. apply per_app; auto.
Qed.

(** Every address makes infinitely many turns, or finitely many and then leaves the cycle. *)
Lemma turns t : adm A e t ->
  (forall n, exists t', adm A e t' /\ t = rep n w t') \/ exists n t', adm A e t' /\ ~ begins w t' /\ t = rep n w t'.
Proof.
  intros Ht. pose (f := fun t => drop (length w) t).
  assert (Hn : forall n, (forall k, (k < n)%nat -> begins w (Nat.iter k f t)) -> t = rep n w (Nat.iter n f t)).
  { induction n; intros H; auto. rewrite <- rep_app. simpl.
    unfold f at 1. rewrite <- (begins_app w (Nat.iter n f t)) by (apply H; lia). apply IHn. intros; apply H; lia. }
  destruct (LPO (fun n => ~ begins w (Nat.iter n f t))) as [(n & H)|H].
  - intros n. destruct (begins_dec w (Nat.iter n f t)); [right|left]; tauto.
  - right. assert (exists k, ~ begins w (Nat.iter k f t) /\ forall j, (j < k)%nat -> begins w (Nat.iter j f t)) as (k & Hk & Hj).
    { induction n as [n IH] using (well_founded_induction lt_wf).
      assert (Hdec : forall m, (forall j, (j < m)%nat -> begins w (Nat.iter j f t)) \/ exists j, (j < m)%nat /\ ~ begins w (Nat.iter j f t)).
      { induction m as [|m [Hm|(j & Hm & Hj)]].
        - left; intros; lia.
        - destruct (begins_dec w (Nat.iter m f t)); [left|right; exists m; auto].
          intros j Hj. destruct (Nat.eq_dec j m) as [->|]; auto. apply Hm; lia.
        - right; exists j; split; auto. }
      destruct (Hdec n) as [Hall|(j & Hj & Hnj)]; [exists n; auto|apply (IH j Hj Hnj)]. }
    exists k, (Nat.iter k f t). split; [apply (adm_unrep k); rewrite <- (Hn k Hj); auto|]. auto.
  - left. intros n. exists (Nat.iter n f t).
    assert (Hb : forall k, begins w (Nat.iter k f t)).
    { intros k. destruct (begins_dec w (Nat.iter k f t)); auto. destruct (H k); auto. }
    rewrite <- (Hn n) by auto. split; auto. apply (adm_unrep n). rewrite <- (Hn n); auto.
Qed.

Variable P : matrix.
Notation G x := (act N P (Ww A s u x)).

Lemma secant_eq m t : adm A e t -> secant A P s b m t = G (pw m (sub (phi A e t) q)).
Proof.
  intros Ht. unfold secant, point.
  rewrite (phi_app A sys u s (rep m w t)), (phi_app A sys u s (per w)); auto.
  - rewrite phi_rep, phi_per, <- act_sub, <- Ww_sub by auto. rewrite pw_sub, pw_q. reflexivity.
  - apply adm_app. split; auto. apply adm_per.
  - apply adm_app. split; auto. apply adm_rep; auto.
Qed.

Lemma secant_rep m n t : secant A P s b m (rep n w t) = secant A P s b (m + n) t.
Proof. unfold secant. rewrite rep_rep. reflexivity. Qed.

(** A chart of the germ: coordinates in which a turn and what is seen are linear maps of their own. It may leave out what is
    not seen, and what the differences of the attractor do not reach. *)
Section Chart.
Variables (C Q : matrix) (Lc : vec -> vec) (Y : vec -> Prop) (within : address -> Prop).
Notation y t := (act N C (sub (phi A e t) q)).
Hypothesis chart_Y : forall t, adm A e t -> within t -> Y (y t).
Hypothesis chart_G : forall m t, adm A e t -> within t -> G (pw m (sub (phi A e t) q)) = act N Q (Nat.iter m Lc (y t)).

Lemma seen_bound : exists S, 1 <= S /\ forall x, nrm (act N Q x) <= S * nrm x.
Proof.
  exists (1 + size N Q). pose proof (size_ge0 N Q). split; [lra|]. intros x.
  pose proof (nrm_act N Q x). pose proof (nrm_ge0 N x). lra.
Qed.

(** The corollary that refutes without the ring condition: one point of the attractor with a leading part. *)
Theorem limit_intro (pi : vec -> vec) (scale : nat -> R) t :
  leads N Y Lc pi scale -> adm A e t -> within t -> 0 < nrm (act N Q (pi (y t))) ->
  limit_line A P s b (act N Q (pi (y t))).
Proof.
  intros Hlead Ht HV Hseen eps m Heps. set (x := y t) in *. set (d := act N Q (pi x)) in *.
  destruct seen_bound as (S & HS & HG).
  pose (e2 := Rmin (1 / 2) (eps / 2) * nrm d).
  assert (Hmin : 0 < Rmin (1 / 2) (eps / 2)) by (apply Rmin_glb_lt; lra).
  assert (He2 : 0 < e2) by (apply Rmult_lt_0_compat; auto).
  pose proof (nrm_ge0 N x) as Hx0.
  destruct (Hlead (e2 / (S * (nrm x + 1)))) as (m0 & Hm0).
  { apply Rdiv_lt_0_compat; auto. apply Rmult_lt_0_compat; lra. }
  exists (m + m0)%nat, t. split; [lia|]. split; auto. rewrite secant_eq, chart_G by auto. fold x.
  destruct (Hm0 (m + m0)%nat ltac:(lia)) as (Hsm & Hl). specialize (Hl x (chart_Y t Ht HV)).
  set (n := (m + m0)%nat) in *. assert (Hk : 0 < Rabs (scale n)) by (apply Rabs_pos_lt; auto).
  set (z := act N Q (Nat.iter n Lc x)) in *.
  assert (H2 : nrm (sub z (scl (scale n) d)) <= e2 * Rabs (scale n)).
  { unfold d, z. rewrite <- act_scl, <- act_sub. eapply Rle_trans; [apply HG|].
    apply Rle_trans with (S * (e2 / (S * (nrm x + 1)) * Rabs (scale n) * (nrm x + 1))).
    - apply Rmult_le_compat_l; [lra|]. eapply Rle_trans; [exact Hl|]. apply Rmult_le_compat_l; [|lra].
      apply Rmult_le_pos; [|lra]. left. apply Rdiv_lt_0_compat; auto. apply Rmult_lt_0_compat; lra.
    - right. field. lra. }
  assert (H3 : Rabs (scale n) * nrm d <= nrm z + e2 * Rabs (scale n)).
  { rewrite <- nrm_scl. eapply Rle_trans; [apply (nrm_back N _ z)|]. rewrite nrm_sub_sym. lra. }
  assert (He3 : e2 <= 1 / 2 * nrm d) by (apply Rmult_le_compat_r; [lra|apply Rmin_l]).
  assert (He4 : e2 <= eps / 2 * nrm d) by (apply Rmult_le_compat_r; [lra|apply Rmin_r]).
  assert (H4 : Rabs (scale n) * nrm d / 2 <= nrm z) by nra.
  split; [nra|]. exists (scale n). eapply Rle_trans; [exact H2|]. nra.
Qed.

(** Theorems 2 and 3 with the rule for rays: the ring condition [|g y| >= delta > 0] on all addresses that do not begin with
    the cycle, for an operator that leads to [v]. *)
Variables (g v : vec) (scale : nat -> R) (delta : R) (sg : address -> R -> Prop).
Hypothesis everywhere : forall t, adm A e t -> within t.
Hypothesis leading : leads N Y Lc (fun x => scl (dot N g x) v) scale.
Hypothesis delta_pos : 0 < delta.
Hypothesis ring : forall t, adm A e t -> ~ begins w t -> delta <= Rabs (dot N g (y t)).
Hypothesis escape : exists t, adm A e t /\ ~ begins w t.
Hypothesis seen : 0 < nrm (act N Q v).
Hypothesis signs : exists m1, forall m t, (m1 <= m)%nat -> adm A e t -> ~ begins w t -> sg t (scale m * dot N g (y t)).
Hypothesis turned : forall n t c, sg t c -> sg (rep n w t) c.

Lemma ring_power eps : 0 < eps -> exists m0, forall m t, (m0 <= m)%nat -> adm A e t -> ~ begins w t ->
  0 < nrm (secant A P s b m t) /\
  exists c, sg t c /\ nrm (sub (secant A P s b m t) (scl c (act N Q v))) <= eps * nrm (secant A P s b m t).
Proof.
  intros Heps. destruct reach as (R0 & HR0 & HR). destruct seen_bound as (S & HS & HG).
  set (d := act N Q v) in *.
  pose (R1 := size N C * R0 + 1). assert (HR1 : 0 < R1) by (unfold R1; pose proof (size_ge0 N C); nra).
  pose (e2 := Rmin (1 / 2) (eps / 2) * nrm d).
  assert (Hmin : 0 < Rmin (1 / 2) (eps / 2)) by (apply Rmin_glb_lt; lra).
  assert (He2 : 0 < e2) by (apply Rmult_lt_0_compat; auto).
  destruct (leading (e2 * delta / (S * R1))) as (m0 & Hm0).
  { apply Rdiv_lt_0_compat; apply Rmult_lt_0_compat; lra. }
  destruct signs as (m1 & Hm1). exists (m0 + m1)%nat. intros m t Hm Ht Hb.
  destruct (Hm0 m) as (Hsm & Hlead); [lia|].
  rewrite secant_eq, chart_G by auto. set (x := y t) in *.
  pose proof (ring t Ht Hb) as Hring. fold x in Hring.
  pose proof (Hlead x (chart_Y t Ht (everywhere t Ht))) as H1.
  replace (scl (scale m) (scl (dot N g x) v)) with (scl (scale m * dot N g x) v) in H1
    by (extensionality i; unfold scl; ring).
  assert (Hxr : nrm x <= R1).
  { unfold x, R1. eapply Rle_trans; [apply nrm_act|]. pose proof (HR t Ht). pose proof (size_ge0 N C).
    assert (size N C * nrm (sub (phi A e t) q) <= size N C * R0) by (apply Rmult_le_compat_l; auto). lra. }
  set (k := scale m * dot N g x) in *. set (z := act N Q (Nat.iter m Lc x)) in *.
  assert (Hk : Rabs (scale m) * delta <= Rabs k).
  { unfold k. rewrite Rabs_mult. apply Rmult_le_compat_l; [apply Rabs_pos|auto]. }
  assert (Hsm' : 0 < Rabs (scale m)) by (apply Rabs_pos_lt; auto).
  assert (H2 : nrm (sub z (scl k d)) <= e2 * Rabs k).
  { unfold z, d. rewrite <- act_scl, <- act_sub. eapply Rle_trans; [apply HG|].
    apply Rle_trans with (S * (e2 * delta / (S * R1) * Rabs (scale m) * R1)).
    - apply Rmult_le_compat_l; [lra|]. eapply Rle_trans; [exact H1|]. apply Rmult_le_compat_l; auto.
      apply Rmult_le_pos; [|lra]. left. apply Rdiv_lt_0_compat; apply Rmult_lt_0_compat; lra.
    - replace (S * (e2 * delta / (S * R1) * Rabs (scale m) * R1)) with (e2 * (Rabs (scale m) * delta)) by (field; lra).
      apply Rmult_le_compat_l; lra. }
  assert (H3 : Rabs k * nrm d <= nrm z + e2 * Rabs k).
  { rewrite <- nrm_scl. eapply Rle_trans; [apply (nrm_back N _ z)|]. rewrite nrm_sub_sym. lra. }
  assert (Hkp : 0 < Rabs k) by (assert (0 < Rabs (scale m) * delta) by (apply Rmult_lt_0_compat; auto); lra).
  assert (He3 : e2 <= 1 / 2 * nrm d) by (apply Rmult_le_compat_r; [lra|apply Rmin_l]).
  assert (He4 : e2 <= eps / 2 * nrm d) by (apply Rmult_le_compat_r; [lra|apply Rmin_r]).
  assert (H4 : Rabs k * nrm d / 2 <= nrm z) by nra.
  split; [nra|]. exists k. split; [apply (Hm1 m t); auto; lia|].
  eapply Rle_trans; [exact H2|]. nra.
Qed.

Theorem directed_intro : directed_by sg A P s b (act N Q v).
Proof.
  split.
  - intros eps Heps. destruct (ring_power eps Heps) as (m0 & Hm0). exists m0. intros m t Hm Ht Hpos.
    destruct (turns t Ht) as [H|(n & t' & Ht' & Hb & ->)].
    + exfalso. rewrite secant_eq, (all_turns t H) in Hpos by auto.
      rewrite (nrm_0 N (G _)) in Hpos; [lra|]. intros i Hi.
      replace (sub q q) with (scl 0 q) by (extensionality j; unfold sub, scl; ring).
      rewrite (pw_scl L (Ww_scl A w e)), Ww_scl, act_scl. unfold scl. ring.
    + rewrite secant_rep. destruct (Hm0 (m + n)%nat t' ltac:(lia) Ht' Hb) as (_ & c & Hc & Hn). exists c. split; auto.
  - intros m. destruct (ring_power 1 Rlt_0_1) as (m0 & Hm0). destruct escape as (t & Ht & Hb).
    exists (rep m0 w t). split; [apply adm_rep; auto|]. rewrite secant_rep. apply Hm0; auto. lia.
Qed.
End Chart.

(** More than one turn at a time: what the germ tends to along some of its turns. *)
Lemma limit_several (r : nat) d : (0 < r)%nat ->
  limit_line A P s {| prefix := u; cycle := concat (repeat w r) |} d -> limit_line A P s b d.
Proof.
  intros Hr H eps m Heps. destruct (H eps m Heps) as (n & t & Hn & Ht & Hx & c & Hc). simpl in Ht.
  assert (E : forall t, app (concat (repeat w r)) t = rep r w t).
  { clear. intros t. induction r as [|r IH]; simpl; auto. rewrite <- IH. unfold app. rewrite fold_right_app. reflexivity. }
  assert (E2 : forall n t, rep n (concat (repeat w r)) t = rep (n * r) w t).
  { intros n0 t0. induction n0 as [|n0 IH]; auto. change (rep (S n0) (concat (repeat w r)) t0)
      with (app (concat (repeat w r)) (rep n0 (concat (repeat w r)) t0)). rewrite E, IH, rep_rep. reflexivity. }
  assert (E3 : per (concat (repeat w r)) = per w).
  { extensionality i. unfold per.
    assert (Hlw : length w <> O) by (pose proof w_ne; destruct w; simpl; congruence).
    assert (Hl : length (concat (repeat w r)) = (r * length w)%nat).
    { clear. induction r as [|r IH]; simpl; auto. rewrite app_length, IH. reflexivity. }
    assert (Hn2 : forall k j, (j < k * length w)%nat -> nth j (concat (repeat w k)) O = nth (j mod length w) w O).
    { intros k. induction k as [|k IH]; simpl; intros j Hj; [lia|]. destruct (Nat.lt_ge_cases j (length w)).
      - rewrite app_nth1, Nat.mod_small by auto. reflexivity.
      - rewrite app_nth2 by auto. rewrite IH by lia. f_equal.
        replace j with ((j - length w) + 1 * length w)%nat at 2 by lia. symmetry. apply Nat.mod_add; auto. }
    rewrite Hl. rewrite Hn2 by (apply Nat.mod_upper_bound; nia). f_equal.
    rewrite (Nat.mul_comm r). rewrite Nat.mod_mul_r by lia.
    rewrite (Nat.mul_comm (length w)), Nat.mod_add by auto. apply Nat.mod_mod; auto. }
  assert (Es : forall t, secant A P s {| prefix := u; cycle := concat (repeat w r) |} n t = secant A P s b (n * r) t).
  { intros t0. unfold secant, point. simpl. rewrite E2, E3. reflexivity. }
  rewrite Es in Hx, Hc. exists (n * r)%nat, t. split; [nia|]. split; auto. split; auto. exists c; auto.
Qed.
End Branch.
