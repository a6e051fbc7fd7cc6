(** Powers of an operator with one real dominant eigenvalue: simple (Theorem 2), or with one Jordan block of length 2
    (Theorem 3). The spectral gap is a bound of one power on an invariant complement, so no normal form is needed. *)
From Coq Require Import Reals Lra Lia FunctionalExtensionality.
From Secant Require Import Vec.
Open Scope R_scope.

Lemma iter_plus m n (f : vec -> vec) x : Nat.iter (m + n) f x = Nat.iter m f (Nat.iter n f x).
Proof. induction m; simpl; auto. rewrite IHm; auto. Qed.

Lemma iter_S n (f : vec -> vec) x : Nat.iter (S n) f x = f (Nat.iter n f x).
Proof. reflexivity. Qed.

Lemma nat_above x : exists n, x < INR n.
Proof.
  destruct (archimed x) as [H _]. exists (Z.to_nat (up x)). rewrite INR_IZR_INZ.
  assert (H1 : (up x <= Z.of_nat (Z.to_nat (up x)))%Z) by lia. apply IZR_le in H1. lra.
Qed.

Section Leading.
Variable N : nat.
Notation nrm := (nrm N).
Notation dot := (dot N).
Variable V : vec -> Prop.
Variable L : vec -> vec.
Variable b : R.
Hypothesis V_add : forall x y, V x -> V y -> V (add x y).
Hypothesis V_scl : forall a x, V x -> V (scl a x).
Hypothesis L_add : forall x y, L (add x y) = add (L x) (L y).
Hypothesis L_scl : forall a x, L (scl a x) = scl a (L x).
Hypothesis L_V : forall x, V x -> V (L x).
Hypothesis b_ge1 : 1 <= b.
Hypothesis L_b : forall x, V x -> nrm (L x) <= b * nrm x.

Notation pw m := (Nat.iter m L).

Lemma pw_add m x y : pw m (add x y) = add (pw m x) (pw m y).
Proof. induction m; simpl; auto. rewrite IHm. apply L_add. Qed.

Lemma pw_scl m a x : pw m (scl a x) = scl a (pw m x).
Proof. induction m; simpl; auto. rewrite IHm. apply L_scl. Qed.

Lemma pw_V m x : V x -> V (pw m x).
Proof. intros; induction m; simpl; auto. Qed.

Lemma pw_b m x : V x -> nrm (pw m x) <= b ^ m * nrm x.
Proof.
  intros Hx. induction m; simpl; [lra|]. eapply Rle_trans; [apply L_b, pw_V; auto|].
  rewrite Rmult_assoc. apply Rmult_le_compat_l; [lra|auto].
Qed.

(** [L^m x = s_m (pi(x) + o(1))], uniformly on bounded sets of [V]. *)
Definition leads (pi : vec -> vec) (s : nat -> R) :=
  forall eps, 0 < eps -> exists m0, forall m, (m0 <= m)%nat -> s m <> 0 /\
    forall x, V x -> nrm (sub (pw m x) (scl (s m) (pi x))) <= eps * Rabs (s m) * nrm x.

Section Gap.
Variable F : vec -> Prop.
Variables (k : nat) (rho eta : R).
Hypothesis F_V : forall x, F x -> V x.
Hypothesis F_L : forall x, F x -> F (L x).
Hypothesis k_pos : (0 < k)%nat.
Hypothesis rho_pos : 0 < rho.
Hypothesis eta_ok : 0 <= eta < rho ^ k.
Hypothesis gap : forall x, F x -> nrm (pw k x) <= eta * nrm x.

Lemma pw_F m x : F x -> F (pw m x).
Proof. intros; induction m; simpl; auto. Qed.

Lemma pw_gap n x : F x -> nrm (pw (n * k) x) <= eta ^ n * nrm x.
Proof.
  intros Hx. induction n; simpl; [lra|].
  rewrite iter_plus. eapply Rle_trans; [apply gap, pw_F; auto|].
  rewrite Rmult_assoc. apply Rmult_le_compat_l; [lra|auto].
Qed.

Lemma smaller eps : 0 < eps -> exists m0, forall m, (m0 <= m)%nat -> forall x, F x ->
  nrm (pw m x) <= eps * rho ^ m * nrm x.
Proof.
  intros He. pose (r0 := Rmin 1 rho).
  assert (Hr0 : 0 < r0 <= 1) by (unfold r0; split; [apply Rmin_glb_lt; lra|apply Rmin_l]).
  assert (Hr1 : r0 <= rho) by apply Rmin_r.
  assert (Hrk : 0 < r0 ^ k) by (apply pow_lt; lra).
  assert (Hbk : 0 < b ^ k) by (apply pow_lt; lra).
  assert (Hk : 0 < rho ^ k) by (apply pow_lt; lra).
  assert (Hkap : 0 <= eta / rho ^ k < 1).
  { split; [apply Rmult_le_pos; [lra|left; apply Rinv_0_lt_compat; auto]|].
    apply Rmult_lt_reg_r with (rho ^ k); auto. unfold Rdiv. rewrite Rmult_assoc, Rinv_l; lra. }
  destruct (pow_lt_1_zero (eta / rho ^ k)) with (y := eps * r0 ^ k / b ^ k) as (q0 & Hq0).
  { rewrite Rabs_pos_eq; lra. }
  { apply Rdiv_lt_0_compat; auto. apply Rmult_lt_0_compat; auto. }
  exists (k * q0)%nat. intros m Hm x Hx.
  pose (q := (m / k)%nat). pose (r := (m mod k)%nat).
  assert (Hmq : m = (r + q * k)%nat) by (unfold q, r; rewrite (Nat.div_mod m k) at 1; lia).
  assert (Hr : (r < k)%nat) by (apply Nat.mod_upper_bound; lia).
  assert (Hq : (q0 <= q)%nat) by (unfold q; apply Nat.div_le_lower_bound; lia).
  specialize (Hq0 q Hq). rewrite Rabs_pos_eq in Hq0 by (apply pow_le; lra).
  rewrite Hmq, iter_plus. eapply Rle_trans; [apply pw_b, F_V, pw_F; auto|].
  apply Rle_trans with (b ^ k * (eta ^ q * nrm x)).
  { apply Rmult_le_compat; [apply pow_le; lra|apply nrm_ge0|apply Rle_pow; [lra|lia]|apply pw_gap; auto]. }
  rewrite <- Rmult_assoc. apply Rmult_le_compat_r; [apply nrm_ge0|].
  rewrite pow_add, (Nat.mul_comm q k), pow_mult.
  replace (eta ^ q) with ((eta / rho ^ k) ^ q * (rho ^ k) ^ q)
    by (rewrite <- Rpow_mult_distr; f_equal; field; lra).
  rewrite <- !Rmult_assoc. apply Rmult_le_compat_r; [apply pow_le; lra|].
  apply Rle_trans with (eps * r0 ^ k).
  - apply (Rmult_lt_compat_l (b ^ k)) in Hq0; auto.
    replace (b ^ k * (eps * r0 ^ k / b ^ k)) with (eps * r0 ^ k) in Hq0 by (field; lra). lra.
  - apply Rmult_le_compat_l; [lra|]. apply Rle_trans with (r0 ^ r); [|apply pow_incr; lra].
    replace k with (r + (k - r))%nat by lia. rewrite pow_add.
    assert (0 <= r0 ^ r) by (apply pow_le; lra).
    assert (r0 ^ (k - r) <= 1) by (rewrite <- (pow1 (k - r)); apply pow_incr; lra). nra.
Qed.
End Gap.

Lemma pw_v lam v m : L v = scl lam v -> pw m v = scl (lam ^ m) v.
Proof.
  intros Lv. induction m; simpl.
  - extensionality i; unfold scl; ring.
  - rewrite IHm, L_scl, Lv. extensionality i; unfold scl; ring.
Qed.

(** One real eigenvalue with a projection [pi] to eigenvectors, and smaller powers on the complement. *)
Section Semisimple.
Variables (lam : R) (pi : vec -> vec) (k : nat) (eta Bp : R).
Hypothesis lam_ne : lam <> 0.
Hypothesis pi_V : forall x, V x -> V (pi x).
Hypothesis L_pi : forall x, V x -> L (pi x) = scl lam (pi x).
Hypothesis pi_L : forall x, V x -> pi (L x) = scl lam (pi x).
Hypothesis pi_rest : forall x, V x -> pi (sub x (pi x)) = scl 0 x.
Hypothesis pi_b : forall x, V x -> nrm (pi x) <= Bp * nrm x.
Hypothesis k_pos : (0 < k)%nat.
Hypothesis eta_ok : 0 <= eta < Rabs lam ^ k.
Hypothesis gap : forall x, V x -> pi x = scl 0 x -> nrm (pw k x) <= eta * nrm x.

Theorem leads_semisimple : leads pi (fun m => lam ^ m).
Proof.
  intros eps Heps. pose (B := 1 + Rabs Bp).
  assert (HB : 1 <= B) by (unfold B; pose proof (Rabs_pos Bp); lra).
  pose (F := fun x => V x /\ pi x = scl 0 x).
  destruct (smaller F k (Rabs lam) eta) with (eps := eps / B) as (m0 & Hm0); auto.
  { intros x [H _]; auto. }
  { intros x [H1 H2]; split; auto. rewrite pi_L, H2 by auto. extensionality i; unfold scl; ring. }
  { apply Rabs_pos_lt; auto. }
  { intros x [H1 H2]; auto. }
  { apply Rdiv_lt_0_compat; lra. }
  exists m0. intros m Hm. split; [apply pow_nonzero; auto|]. intros x Hx.
  pose (y := sub x (pi x)).
  assert (Hy : F y).
  { split; unfold y; [rewrite sub_add; auto|]. rewrite pi_rest by auto. extensionality i; unfold scl; ring. }
  replace (sub (pw m x) (scl (lam ^ m) (pi x))) with (pw m y).
  - eapply Rle_trans; [apply Hm0; auto|].
    assert (Hny : nrm y <= B * nrm x).
    { unfold y. eapply Rle_trans; [apply nrm_sub|]. pose proof (pi_b x Hx). pose proof (Rle_abs Bp).
      pose proof (nrm_ge0 N x). unfold B. nra. }
    rewrite RPow_abs.
    apply Rle_trans with (eps / B * Rabs (lam ^ m) * (B * nrm x)); [|right; field; lra].
    apply Rmult_le_compat_l; auto. apply Rmult_le_pos; [|apply Rabs_pos].
    left; apply Rdiv_lt_0_compat; lra.
  - unfold y. rewrite !sub_add, pw_add, !pw_scl, (pw_v lam (pi x)) by auto. extensionality i; unfold add, scl; ring.
Qed.
End Semisimple.

(** One simple real eigenvalue with the functional [g] and the vector [v]. *)
Section Simple.
Variables (lam : R) (g v : vec) (k : nat) (eta : R).
Hypothesis lam_ne : lam <> 0.
Hypothesis Lv : L v = scl lam v.
Hypothesis Vv : V v.
Hypothesis gL : forall x, V x -> dot g (L x) = lam * dot g x.
Hypothesis gv : dot g v = 1.
Hypothesis k_pos : (0 < k)%nat.
Hypothesis eta_ok : 0 <= eta < Rabs lam ^ k.
Hypothesis gap : forall x, V x -> dot g x = 0 -> nrm (pw k x) <= eta * nrm x.

Theorem leads_simple : leads (fun x => scl (dot g x) v) (fun m => lam ^ m).
Proof.
  apply (leads_semisimple lam (fun x => scl (dot g x) v) k eta (nrm g * nrm v)); auto.
  - intros x Hx. rewrite L_scl, Lv. extensionality i; unfold scl; ring.
  - intros x Hx. rewrite gL by auto. extensionality i; unfold scl; ring.
  - intros x Hx. rewrite dot_sub, dot_scl, gv. extensionality i; unfold scl; ring.
  - intros x Hx. rewrite nrm_scl. pose proof (dot_le N g x). pose proof (nrm_ge0 N v). nra.
  - intros x Hx H. apply gap; auto.
    assert (H1 : dot g (scl (dot g x) v) = dot g (scl 0 x)) by (rewrite H; reflexivity).
    rewrite !dot_scl, gv in H1. lra.
Qed.
End Simple.

(** One Jordan block of length 2: [L v1 = lam v1], [L v2 = lam v2 + v1], with dual functionals. *)
Section Block.
Variables (lam : R) (g1 g2 v1 v2 : vec) (k : nat) (eta : R).
Hypothesis lam_ne : lam <> 0.
Hypothesis Lv1 : L v1 = scl lam v1.
Hypothesis Lv2 : L v2 = add (scl lam v2) v1.
Hypothesis Vv1 : V v1.
Hypothesis Vv2 : V v2.
Hypothesis g2L : forall x, V x -> dot g2 (L x) = lam * dot g2 x.
Hypothesis g1L : forall x, V x -> dot g1 (L x) = lam * dot g1 x + dot g2 x.
Hypothesis g11 : dot g1 v1 = 1.
Hypothesis g12 : dot g1 v2 = 0.
Hypothesis g21 : dot g2 v1 = 0.
Hypothesis g22 : dot g2 v2 = 1.
Hypothesis k_pos : (0 < k)%nat.
Hypothesis eta_ok : 0 <= eta < Rabs lam ^ k.
Hypothesis gap : forall x, V x -> dot g1 x = 0 -> dot g2 x = 0 -> nrm (pw k x) <= eta * nrm x.

Definition block_scale (m : nat) := INR m * lam ^ m / lam.

Lemma pw_v2 m : pw m v2 = add (scl (lam ^ m) v2) (scl (block_scale m) v1).
Proof.
  induction m.
  - simpl. extensionality i; unfold add, scl, block_scale; simpl. field; auto.
  - rewrite iter_S, IHm, L_add, !L_scl, Lv1, Lv2. extensionality i; unfold add, scl, block_scale.
    rewrite S_INR. simpl. field; auto.
Qed.

Theorem leads_block : leads (fun x => scl (dot g2 x) v1) block_scale.
Proof.
  intros eps Heps. pose (B1 := nrm g1 * nrm v1 + nrm g2 * nrm v2). pose (B := 1 + B1).
  assert (HB1 : 0 <= B1) by (unfold B1; apply Rplus_le_le_0_compat; apply Rmult_le_pos; apply nrm_ge0).
  pose (F := fun x => V x /\ dot g1 x = 0 /\ dot g2 x = 0).
  destruct (smaller F k (Rabs lam) eta) with (eps := 1) as (m0 & Hm0); auto.
  { intros x [H _]; auto. }
  { intros x (H1 & H2 & H3); repeat split; auto; [rewrite g1L, H2, H3 by auto; ring|rewrite g2L, H3 by auto; ring]. }
  { apply Rabs_pos_lt; auto. }
  { intros x (H1 & H2 & H3); auto. }
  { lra. }
  assert (Hlam : 0 < Rabs lam) by (apply Rabs_pos_lt; auto).
  destruct (nat_above (Rabs lam * (B1 + B) / eps)) as (n0 & Hn0).
  exists (S (m0 + n0)). intros m Hm.
  assert (HmR : INR n0 < INR m) by (apply lt_INR; lia).
  assert (Hpos : 0 < INR m) by (apply (lt_INR 0); lia).
  assert (Hs : Rabs (block_scale m) = INR m * Rabs lam ^ m / Rabs lam).
  { unfold block_scale, Rdiv. rewrite !Rabs_mult, Rabs_inv, RPow_abs, (Rabs_pos_eq (INR m)); lra. }
  split.
  { unfold block_scale. apply Rmult_integral_contrapositive_currified; [|apply Rinv_neq_0_compat; auto].
    apply Rmult_integral_contrapositive_currified; [lra|apply pow_nonzero; auto]. }
  intros x Hx.
  pose (y := sub x (add (scl (dot g1 x) v1) (scl (dot g2 x) v2))).
  pose (z := add (scl (dot g1 x) v1) (scl (dot g2 x) v2)).
  assert (Hy : F y).
  { repeat split; unfold y; [rewrite sub_add; auto| |];
      rewrite dot_sub, dot_add, !dot_scl, ?g11, ?g12, ?g21, ?g22; ring. }
  assert (Hz : nrm z <= B1 * nrm x).
  { unfold z. eapply Rle_trans; [apply nrm_add|]. rewrite !nrm_scl.
    pose proof (dot_le N g1 x). pose proof (dot_le N g2 x). unfold B1.
    pose proof (nrm_ge0 N v1). pose proof (nrm_ge0 N v2). nra. }
  assert (Hny : nrm y <= B * nrm x).
  { unfold y. eapply Rle_trans; [apply nrm_sub|]. fold z. unfold B. lra. }
  replace (sub (pw m x) (scl (block_scale m) (scl (dot g2 x) v1))) with (add (scl (lam ^ m) z) (pw m y)).
  - eapply Rle_trans; [apply nrm_add|]. rewrite nrm_scl, <- RPow_abs, Hs.
    pose proof (Hm0 m ltac:(lia) y Hy) as Hym.
    assert (Hp : 0 < Rabs lam ^ m) by (apply pow_lt; auto).
    apply Rle_trans with (Rabs lam ^ m * ((B1 + B) * nrm x)).
    { assert (Rabs lam ^ m * nrm z <= Rabs lam ^ m * (B1 * nrm x)) by (apply Rmult_le_compat_l; lra).
      assert (Rabs lam ^ m * nrm y <= Rabs lam ^ m * (B * nrm x)) by (apply Rmult_le_compat_l; lra). lra. }
    replace (eps * (INR m * Rabs lam ^ m / Rabs lam) * nrm x)
      with (Rabs lam ^ m * ((INR m * eps / Rabs lam) * nrm x)) by (field; lra).
    apply Rmult_le_compat_l; [lra|]. apply Rmult_le_compat_r; [apply nrm_ge0|].
    apply Rmult_le_reg_r with (Rabs lam / eps); [apply Rdiv_lt_0_compat; lra|].
    replace (INR m * eps / Rabs lam * (Rabs lam / eps)) with (INR m) by (field; lra).
    replace ((B1 + B) * (Rabs lam / eps)) with (Rabs lam * (B1 + B) / eps) by (field; lra). lra.
  - unfold y. rewrite !sub_add, !pw_add, !pw_scl, !pw_add, !pw_scl, pw_v2, (pw_v lam v1 m Lv1).
    unfold z. extensionality i; unfold add, scl; ring.
Qed.
End Block.
End Leading.
