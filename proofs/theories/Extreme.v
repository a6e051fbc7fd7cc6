(** Tangents at addresses, addresses that end with the last or the first letters, and the ray of such an address at a joint. *)
From Coq Require Import Reals Lra Lia List Bool FunctionalExtensionality.
From Coquelicot Require Import Coquelicot.
From Secant Require Export Convex Order Levels.
From Secant Require Import Vec Automaton Leading Germ Replay.
Import ListNotations.
Open Scope R_scope.

(** At the point of an address there is one ray to which the secants of both sides, directed forward, tend uniformly: those to the
    points of the addresses that share [m] letters, before and after it in the order of the curve. [rev] says which pieces run
    backwards. *)
Definition tangent_at (A : automaton) (rev : nat -> nat -> bool) (P : matrix) (s : nat) (a : address) (d : vec) :=
  0 < nrm (N A) d /\
  forall eps, 0 < eps -> exists m, forall t, adm A s t -> (forall j, (j < m)%nat -> a j = t j) ->
  forall x, (ahead A rev s a t /\ x = act (N A) P (sub (phi A s t) (phi A s a))) \/
            (ahead A rev s t a /\ x = act (N A) P (sub (phi A s a) (phi A s t))) ->
  0 < nrm (N A) x -> exists c, 0 < c /\ nrm (N A) (sub x (scl c d)) <= eps * nrm (N A) x.

Definition tangent_at_every_address (A : automaton) (rev : nat -> nat -> bool) (P : matrix) (s : nat) :=
  forall a, adm A s a -> exists d, tangent_at A rev P s a d.

(** G¹: no part of the curve is a point; a tangent at every address, which depends continuously on the address (so on the
    parameter), and is the same for all addresses of one point. *)
Definition g1 (A : automaton) (rev : nat -> nat -> bool) (P : matrix) (s : nat) := exists tg : address -> vec,
  (forall a m, adm A s a -> exists t, adm A s t /\ (forall j, (j < m)%nat -> a j = t j) /\
    0 < nrm (N A) (act (N A) P (sub (phi A s t) (phi A s a)))) /\
  (forall a, adm A s a -> tangent_at A rev P s a (tg a)) /\
  (forall eps, 0 < eps -> exists m, forall a b, adm A s a -> adm A s b -> (forall j, (j < m)%nat -> a j = b j) ->
    nrm (N A) (sub (tg a) (tg b)) <= eps) /\
  (forall a b, adm A s a -> adm A s b -> act (N A) P (phi A s a) = act (N A) P (phi A s b) -> nrm (N A) (sub (tg a) (tg b)) = 0).

(** The last address of a state, in the order of the curve, where [late], and the first one otherwise. *)
Definition extreme (A : automaton) (rev : nat -> nat -> bool) (late : bool) (e : nat) (s : address) :=
  forall n, s n = if xorb late (turned A rev e s n) then (deg A (st A e s n) - 1)%nat else O.

(** Two addresses that meet in a joint: the letters differ by one, and each goes on to the end of its piece at which they meet. *)
Definition joint_of (A : automaton) (rev : nat -> nat -> bool) (s k : nat) (a b : address) :=
  (forall j, (j < k)%nat -> a j = b j) /\ b k = S (a k) /\
  let e := st A s a k in
  extreme A rev (negb (rev e (a k))) (dst A e (a k)) (drop (S k) a) /\ extreme A rev (rev e (b k)) (dst A e (b k)) (drop (S k) b).

(** Vectors near to which one and the same vectors are, up to positive factors. *)
Lemma one_ray n d1 d2 : 0 < nrm n d1 -> (forall eps, 0 < eps -> exists x c1 c2, 0 < nrm n x /\ 0 < c1 /\ 0 < c2 /\
  nrm n (sub x (scl c1 d1)) <= eps * nrm n x /\ nrm n (sub x (scl c2 d2)) <= eps * nrm n x) ->
  nrm n (sub (scl (nrm n d2) d1) (scl (nrm n d1) d2)) = 0.
Proof.
  intros H1 H. apply Rle_antisym; [|apply nrm_ge0]. set (p := nrm n d1) in *. set (q := nrm n d2).
  assert (Hq : 0 <= q) by apply nrm_ge0.
  apply Rnot_lt_le. intros Hpos. set (w := nrm n (sub (scl q d1) (scl p d2))) in *.
  set (eps := Rmin (1 / 2) (w / (40 * (p * q + 1)))).
  assert (Hpq : 0 <= p * q) by (apply Rmult_le_pos; lra).
  assert (He : 0 < eps) by (unfold eps; apply Rmin_glb_lt; [lra|apply Rdiv_lt_0_compat; lra]).
  assert (He1 : eps <= 1 / 2) by apply Rmin_l.
  assert (He2 : eps * (p * q + 1) <= w / 40).
  { apply Rle_trans with (w / (40 * (p * q + 1)) * (p * q + 1)); [apply Rmult_le_compat_r; [lra|apply Rmin_r]|right; field; lra]. }
  destruct (H eps He) as (x & c1 & c2 & Hx & Hc1 & Hc2 & A1 & A2). set (r := nrm n x) in *.
  (* [|r - c1 p| <= eps r], [|r - c2 q| <= eps r]. *)
  assert (B : forall c d, 0 < c -> nrm n (sub x (scl c d)) <= eps * r -> r - c * nrm n d <= eps * r /\ c * nrm n d - r <= eps * r).
  { intros c d Hc Hd. assert (E : nrm n (scl c d) = c * nrm n d) by (rewrite nrm_scl, Rabs_pos_eq; lra). rewrite <- E. split.
    - pose proof (nrm_back n x (scl c d)) as Hb. fold r in Hb. lra.
    - pose proof (nrm_back n (scl c d) x) as Hb. rewrite nrm_sub_sym in Hb. fold r in Hb. lra. }
  destruct (B c1 d1 Hc1 A1) as [B1 B2]. destruct (B c2 d2 Hc2 A2) as [B3 B4]. fold p in B1, B2. fold q in B3, B4.
  (* [c1 c2 (q d1 - p d2) = c2 q (c1 d1 - x) + (c2 q - c1 p) x + c1 p (x - c2 d2)]. *)
  assert (Hw : c1 * c2 * w <= c2 * q * (eps * r) + 2 * eps * r * r + c1 * p * (eps * r)).
  { unfold w. rewrite <- (Rabs_pos_eq (c1 * c2)) at 1 by (apply Rmult_le_pos; lra). rewrite <- nrm_scl.
    replace (scl (c1 * c2) (sub (scl q d1) (scl p d2))) with
      (add (add (scl (c2 * q) (sub (scl c1 d1) x)) (scl (c2 * q - c1 * p) x)) (scl (c1 * p) (sub x (scl c2 d2))))
      by (extensionality i; unfold add, sub, scl; ring).
    assert (Hs : Rabs (c2 * q - c1 * p) <= 2 * eps * r) by (apply Rabs_le; lra).
    eapply Rle_trans; [apply nrm_add|]. apply Rplus_le_compat; [eapply Rle_trans; [apply nrm_add|]; apply Rplus_le_compat|].
    - rewrite nrm_scl, Rabs_pos_eq by (apply Rmult_le_pos; lra). apply Rmult_le_compat_l; [apply Rmult_le_pos; lra|].
      rewrite nrm_sub_sym. exact A1.
    - rewrite nrm_scl. apply Rmult_le_compat_r; [unfold r in *; lra|exact Hs].
    - rewrite nrm_scl, Rabs_pos_eq by (apply Rmult_le_pos; lra). apply Rmult_le_compat_l; [apply Rmult_le_pos; lra|exact A2]. }
  assert (Hq0 : 0 < q) by (destruct (Rle_lt_or_eq_dec 0 q Hq) as [|E]; auto; rewrite <- E in B3; nra).
  (* [r <= 2 c1 p], [r <= 2 c2 q], and both products are at most [3/2 r]. *)
  assert (C1 : r <= 2 * (c1 * p)) by nra. assert (C2 : r <= 2 * (c2 * q)) by nra.
  assert (C3 : c1 * p <= 3 / 2 * r) by nra. assert (C4 : c2 * q <= 3 / 2 * r) by nra.
  assert (D : c1 * c2 * w <= 5 * eps * (r * r)).
  { eapply Rle_trans; [exact Hw|]. assert (0 <= eps * r) by (apply Rmult_le_pos; lra). nra. }
  assert (E : r * r <= 4 * (c1 * c2) * (p * q)).
  { apply Rle_trans with (2 * (c1 * p) * (2 * (c2 * q))); [apply Rmult_le_compat; lra|right; ring]. }
  assert (F : 0 < c1 * c2) by (apply Rmult_lt_0_compat; auto).
  assert (G : c1 * c2 * w <= c1 * c2 * (20 * (eps * (p * q)))).
  { eapply Rle_trans; [exact D|]. apply Rle_trans with (5 * eps * (4 * (c1 * c2) * (p * q))); [apply Rmult_le_compat_l; lra|right; ring]. }
  apply Rmult_le_reg_l in G; auto. assert (eps * (p * q) <= w / 40 - eps) by lra.
  assert (Hw2 : w <= 20 * (w / 40 - eps)) by lra. lra.
Qed.

(** A vector that is near to multiples of another one: that is not 0. *)
Lemma near_pos n x c d : 0 < nrm n x -> nrm n (sub x (scl c d)) <= 1 / 2 * nrm n x -> 0 < nrm n d.
Proof.
  intros Hx H. destruct (Rle_lt_or_eq_dec 0 (nrm n d) (nrm_ge0 n d)) as [|E]; auto. exfalso.
  pose proof (nrm_back n x (scl c d)) as Hb. rewrite nrm_scl, <- E, Rmult_0_r in Hb. lra.
Qed.

Lemma first_difference (a b : address) : a = b \/ exists k, (forall j, (j < k)%nat -> a j = b j) /\ a k <> b k.
Proof.
  destruct (LPO (fun n => a n <> b n)) as [(n & H)|H].
  - intros n. destruct (Nat.eq_dec (a n) (b n)); [right|left]; auto.
  - right. induction n as [n IH] using (well_founded_induction lt_wf).
    assert (Hd : forall m, (forall j, (j < m)%nat -> a j = b j) \/ exists j, (j < m)%nat /\ a j <> b j).
    { induction m as [|m [Hm|(j & Hj & Hn)]]; [left; intros; lia| |right; exists j; split; auto].
      destruct (Nat.eq_dec (a m) (b m)); [left|right; exists m; auto].
      intros j Hj. destruct (Nat.eq_dec j m) as [->|]; auto. apply Hm. lia. }
    destruct (Hd n) as [Hn|(j & Hj & Hn)]; [exists n; auto|apply (IH j Hj Hn)].
  - left. extensionality n. destruct (Nat.eq_dec (a n) (b n)); auto. destruct (H n); auto.
Qed.

Lemma rep_agree n w : forall x y j, (j < n * length w)%nat -> rep n w x j = rep n w y j.
Proof.
  induction n as [|n IH]; intros x y j Hj; [simpl in Hj; lia|]. simpl. rewrite !app_nth.
  destruct (Nat.ltb_spec j (length w)); auto. apply IH. simpl in Hj. lia.
Qed.

Section Extreme.
Variables (A : automaton) (rev : nat -> nat -> bool).

Lemma extreme_unique late e x y : extreme A rev late e x -> extreme A rev late e y -> x = y.
Proof.
  intros Hx Hy. extensionality n. induction n as [n IH] using (well_founded_induction lt_wf).
  rewrite (Hx n), (Hy n), (turned_same A rev n e x y), (proj2 (W_same A n e x y (fun _ => 0) IH)) by auto. reflexivity.
Qed.

(** The last address of a state, or the first one. *)
Fixpoint edge (late : bool) (e n : nat) : nat :=
  let i := if late then (deg A e - 1)%nat else O in
  match n with O => i | S n => edge (xorb late (rev e i)) (dst A e i) n end.

Lemma edge_extreme : forall n late e, edge late e n =
  if xorb late (turned A rev e (edge late e) n) then (deg A (st A e (edge late e) n) - 1)%nat else O.
Proof.
  induction n; intros late e; simpl; [rewrite xorb_false_r; reflexivity|].
  set (i := if late then (deg A e - 1)%nat else O). rewrite <- xorb_assoc. apply IHn.
Qed.

Lemma edge_adm : well_formed A -> forall k late e, (e < states A)%nat -> (edge late e k < deg A (st A e (edge late e) k))%nat.
Proof.
  intros Hwf. induction k; intros late e He; destruct (Hwf e He) as (_ & Hd & Ht).
  - simpl. destruct late; lia.
  - apply (IHk (xorb late (rev e (if late then (deg A e - 1)%nat else O)))). apply Ht. destruct late; lia.
Qed.

(** An address that ends with the last letters, or the first ones, comes after, or before, all that share what is before these. *)
Lemma extreme_order late start a n0 c k : adm A start a -> adm A start c ->
  extreme A rev late (st A start a n0) (drop n0 a) -> (n0 <= k)%nat -> (forall j, (j < k)%nat -> a j = c j) -> a k <> c k ->
  if xorb late (turned A rev start a n0) then ahead A rev start c a else ahead A rev start a c.
Proof.
  intros Ha Hc He Hk Heq Hne. pose proof (He (k - n0)%nat) as H. rewrite drop_nth in H.
  pose proof (turned_plus A rev n0 start a (k - n0)) as Ht. pose proof (st_plus A n0 start a (k - n0)) as Hs.
  replace (n0 + (k - n0))%nat with k in H, Ht, Hs by lia. rewrite <- Hs in H.
  pose proof (Hc k) as Hck. rewrite <- (proj2 (W_same A k start a c (fun _ => 0) Heq)) in Hck.
  assert (Heq' : forall j, (j < k)%nat -> c j = a j) by (intros; symmetry; auto).
  pose proof (turned_same A rev k start a c Heq) as Htc.
  destruct late, (turned A rev start a n0), (turned A rev (st A start a n0) (drop n0 a) (k - n0)) eqn:E; simpl in *;
    exists k; (split; [auto|]); rewrite <- ?Htc, ?Ht; lia.
Qed.
End Extreme.

(** A branch whose cycle leads back. *)
Definition round (A : automaton) (s : nat) (b : branch) :=
  admw A s (prefix b) /\ admw A (stw A s (prefix b)) (cycle b) /\ cycle b <> [] /\
  stw A (stw A s (prefix b)) (cycle b) = stw A s (prefix b).

Lemma admw_app A u v : forall s, admw A s (u ++ v) <-> admw A s u /\ admw A (stw A s u) v.
Proof. induction u as [|i u IH]; simpl; intros s; [tauto|]. rewrite IH. tauto. Qed.

Lemma round_inside A s u b : admw A s u -> round A (stw A s u) b -> round A s (inside u b).
Proof.
  intros Hu (H1 & H2 & H3 & H4). unfold round, inside; simpl. rewrite stw_app, admw_app. auto.
Qed.

(** The ray of an address that ends with the last letters, or the first ones, is that of its branch. *)
Lemma side_ray A rev P start b a n0 late d d' : contracting A -> (start < states A)%nat -> round A start b ->
  a = app (prefix b) (per (cycle b)) -> adm A start a -> extreme A rev late (st A start a n0) (drop n0 a) ->
  tangent_at A rev P start a d -> half_tangent A P start b d' -> let d2 := scl (orient (xorb late (turned A rev start a n0))) d' in
  0 < nrm (N A) d2 /\ nrm (N A) (sub (scl (nrm (N A) d2) d) (scl (nrm (N A) d) d2)) = 0.
Proof.
  intros Hsys Hst (R1 & R2 & R3 & R4) Ea Ha He [Hd Ht] [Hh1 Hh2] d2. set (z := xorb late (turned A rev start a n0)) in *.
  assert (H : forall eps, 0 < eps -> exists x c1 c2, 0 < nrm (N A) x /\ 0 < c1 /\ 0 < c2 /\
    nrm (N A) (sub x (scl c1 d)) <= eps * nrm (N A) x /\ nrm (N A) (sub x (scl c2 d2)) <= eps * nrm (N A) x).
  { intros eps Heps. destruct (Ht eps Heps) as (m1 & Hm1). destruct (Hh1 eps Heps) as (m0 & Hm0).
    set (M := (m0 + m1 + n0)%nat). destruct (Hh2 M) as (t & Hat & Hpos).
    set (c := app (prefix b) (rep M (cycle b) t)).
    assert (Hc : adm A start c) by (apply adm_app; split; auto; apply (adm_rep A start b); auto).
    assert (Hlen : (1 <= length (cycle b))%nat) by (destruct (cycle b); simpl; [congruence|lia]).
    assert (Hper : per (cycle b) = rep M (cycle b) (per (cycle b))).
    { clear - R3. induction M; simpl; auto. rewrite <- IHM. apply per_app; auto. }
    assert (Hac : forall j, (j < m1 + n0)%nat -> a j = c j).
    { intros j Hj. rewrite Ea, Hper. unfold c. rewrite !app_nth. destruct (Nat.ltb_spec j (length (prefix b))); auto.
      apply rep_agree. unfold M. nia. }
    assert (Hsec : secant A P start b M t = sub (act (N A) P (phi A start c)) (act (N A) P (phi A start a))).
    { unfold secant, point. rewrite Ea. reflexivity. }
    destruct (first_difference a c) as [E|(k & Hk1 & Hk2)].
    { exfalso. rewrite Hsec, <- E in Hpos. rewrite nrm_0 in Hpos; [lra|]. intros; unfold sub; ring. }
    assert (Hk : (m1 + n0 <= k)%nat) by (destruct (Nat.lt_ge_cases k (m1 + n0)) as [Hlt|]; auto; destruct Hk2; auto).
    pose proof (extreme_order A rev late start a n0 c k Ha Hc He ltac:(lia) Hk1 Hk2) as Ho. fold z in Ho.
    set (x := scl (orient z) (secant A P start b M t)).
    assert (Hx : nrm (N A) x = nrm (N A) (secant A P start b M t)).
    { unfold x. rewrite nrm_scl. destruct z; unfold orient; [rewrite Rabs_left|rewrite Rabs_pos_eq]; lra. }
    destruct (Hm1 c Hc) with (x := x) as (c1 & Hc1 & Hn1).
    - intros j Hj. apply Hac. lia.
    - unfold x. rewrite Hsec, !act_sub. destruct z; [right|left]; (split; [exact Ho|]); unfold orient;
        extensionality i; unfold scl, sub; ring.
    - rewrite Hx. auto.
    - destruct (Hm0 M t ltac:(unfold M; lia) Hat Hpos) as (c2 & Hc2 & Hn2). exists x, c1, c2. rewrite Hx at 1.
      split; auto. split; auto. split; auto. split; auto. rewrite Hx.
      replace (sub x (scl c2 d2)) with (scl (orient z) (sub (secant A P start b M t) (scl c2 d'))) by
        (unfold x, d2; extensionality i; unfold scl, sub; ring).
      rewrite nrm_scl. replace (Rabs (orient z)) with 1; [lra|].
      destruct z; unfold orient; [rewrite Rabs_left|rewrite Rabs_pos_eq]; lra. }
  split; [|apply one_ray; auto].
  destruct (H (1 / 2) ltac:(lra)) as (x & c1 & c2 & Hx & _ & _ & _ & Hn). apply (near_pos _ x c2); auto.
Qed.
