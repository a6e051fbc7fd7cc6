(** Limit directions (theory.md, §2), and what half-tangents and tangent lines say of them. *)
From Coq Require Import Reals Lra Lia List FunctionalExtensionality.
From Secant Require Import Vec Automaton Leading Germ.
Open Scope R_scope.

Definition unit_vector (n : nat) (x : vec) : vec := scl (/ nrm n x) x.

(** Unit secants of addresses that share more and more turns accumulate at [d]. *)
Definition limit_direction (A : automaton) (P : matrix) (s : nat) (b : branch) (d : vec) :=
  forall eps m, 0 < eps -> exists n t, (m <= n)%nat /\ adm A (stw A s (prefix b)) t /\
    0 < nrm (N A) (secant A P s b n t) /\ nrm (N A) (sub (unit_vector (N A) (secant A P s b n t)) d) <= eps.

(** The same vector, up to coordinates that do not count. *)
Definition same (n : nat) (x y : vec) := nrm n (sub x y) = 0.

Section Directions.
Variable n : nat.

Lemma near_unit x d c eps : 0 < nrm n x -> 0 < nrm n d -> nrm n (sub x (scl c d)) <= eps * nrm n x ->
  nrm n (sub (unit_vector n x) (scl (if Rle_dec 0 c then 1 else -1) (unit_vector n d))) <= 2 * eps.
Proof.
  intros Hx Hd Hc. set (sg := if Rle_dec 0 c then 1 else -1).
  assert (Hsg : c = sg * Rabs c) by (unfold sg; destruct Rle_dec; [rewrite Rabs_pos_eq|rewrite Rabs_left]; lra).
  assert (Habs : Rabs sg = 1) by (unfold sg; destruct Rle_dec; [apply Rabs_R1|rewrite Rabs_left; lra]).
  assert (H1 : Rabs (Rabs c * nrm n d - nrm n x) <= eps * nrm n x).
  { apply Rabs_le. pose proof (nrm_back n x (scl c d)) as B1. pose proof (nrm_back n (scl c d) x) as B2.
    rewrite (nrm_sub_sym n (scl c d) x) in B2. rewrite nrm_scl in *. lra. }
  replace (sub (unit_vector n x) (scl sg (unit_vector n d))) with
    (add (scl (/ nrm n x) (sub x (scl c d))) (scl (sg * (Rabs c * nrm n d - nrm n x) / (nrm n x * nrm n d)) d)).
  - eapply Rle_trans; [apply nrm_add|]. rewrite !nrm_scl.
    assert (Hinv : 0 < / nrm n x) by (apply Rinv_0_lt_compat; auto).
    rewrite (Rabs_pos_eq (/ nrm n x)) by lra.
    assert (E1 : / nrm n x * nrm n (sub x (scl c d)) <= eps).
    { apply Rle_trans with (/ nrm n x * (eps * nrm n x)); [apply Rmult_le_compat_l; lra|right; field; lra]. }
    assert (E2 : Rabs (sg * (Rabs c * nrm n d - nrm n x) / (nrm n x * nrm n d)) * nrm n d <= eps).
    { unfold Rdiv. rewrite !Rabs_mult, Habs, Rabs_inv, Rabs_mult, (Rabs_pos_eq (nrm n x)), (Rabs_pos_eq (nrm n d)) by lra.
      apply Rle_trans with (1 * (eps * nrm n x) * / (nrm n x * nrm n d) * nrm n d); [|right; field; lra].
      apply Rmult_le_compat_r; [lra|]. apply Rmult_le_compat_r; [|lra].
      left. apply Rinv_0_lt_compat. apply Rmult_lt_0_compat; auto. }
    lra.
  - extensionality i. unfold unit_vector, add, sub, scl. rewrite Hsg at 1. field. lra.
Qed.

Lemma close_same x y k : 0 <= k -> (forall eps, 0 < eps -> nrm n (sub x y) <= k * eps) -> same n x y.
Proof.
  intros Hk H. unfold same. apply Rle_antisym; [|apply nrm_ge0].
  destruct (Rle_lt_dec (nrm n (sub x y)) 0) as [|Hp]; auto. exfalso.
  specialize (H (nrm n (sub x y) / (2 * (k + 1)))). 
  assert (0 < nrm n (sub x y) / (2 * (k + 1))) by (apply Rdiv_lt_0_compat; lra). specialize (H H0).
  assert (k * (nrm n (sub x y) / (2 * (k + 1))) <= (k + 1) * (nrm n (sub x y) / (2 * (k + 1)))) by (apply Rmult_le_compat_r; lra).
  assert ((k + 1) * (nrm n (sub x y) / (2 * (k + 1))) = nrm n (sub x y) / 2) by (field; lra). lra.
Qed.
End Directions.

(** A half-tangent: the germ has exactly one limit direction. *)
Theorem one_direction A P s b d d' : 0 < nrm (N A) d -> half_tangent A P s b d ->
  (limit_direction A P s b d' <-> same (N A) d' (unit_vector (N A) d)).
Proof.
  intros Hd [H1 H2].
  assert (Hu : forall x c eps, 0 < c -> 0 < nrm (N A) x -> nrm (N A) (sub x (scl c d)) <= eps * nrm (N A) x ->
    nrm (N A) (sub (unit_vector (N A) x) (unit_vector (N A) d)) <= 2 * eps).
  { intros x c eps Hc Hx Hn. pose proof (near_unit (N A) x d c eps Hx Hd Hn) as H. destruct (Rle_dec 0 c); [|lra].
    replace (scl 1 (unit_vector (N A) d)) with (unit_vector (N A) d) in H by (extensionality i; unfold scl; ring). auto. }
  split.
  - intros Hl. apply (close_same _ _ _ 3); [lra|]. intros eps He. destruct (H1 eps He) as (m & Hm).
    destruct (Hl eps m He) as (k & t & Hk & Ht & Hx & Hn). destruct (Hm k t Hk Ht Hx) as (c & Hc & Hcn).
    pose proof (Hu _ c eps Hc Hx Hcn). rewrite nrm_sub_sym in Hn.
    eapply Rle_trans; [apply (nrm_tri _ _ (unit_vector (N A) (secant A P s b k t)))|]. lra.
  - intros Hs eps m He. destruct (H1 (eps / 2)) as (m0 & Hm0); [lra|]. destruct (H2 (m + m0)%nat) as (t & Ht & Hx).
    exists (m + m0)%nat, t. split; [lia|]. split; auto. split; auto.
    destruct (Hm0 (m + m0)%nat t ltac:(lia) Ht Hx) as (c & Hc & Hcn). pose proof (Hu _ c _ Hc Hx Hcn).
    eapply Rle_trans; [apply (nrm_tri _ _ (unit_vector (N A) d))|]. unfold same in Hs. rewrite nrm_sub_sym in Hs. lra.
Qed.

(** A tangent line: every limit direction is one of the two unit vectors of the line. *)
Theorem two_directions A P s b d d' : 0 < nrm (N A) d -> tangent_line A P s b d -> limit_direction A P s b d' ->
  same (N A) d' (unit_vector (N A) d) \/ same (N A) d' (scl (-1) (unit_vector (N A) d)).
Proof.
  intros Hd [H1 _] Hl. set (u := unit_vector (N A) d). set (a := nrm (N A) (sub d' u)). set (b' := nrm (N A) (sub d' (scl (-1) u))).
  assert (Ha : 0 <= a) by apply nrm_ge0. assert (Hb : 0 <= b') by apply nrm_ge0.
  assert (Hsmall : forall eps, 0 < eps -> a <= 3 * eps \/ b' <= 3 * eps).
  { intros eps He. destruct (H1 eps He) as (m & Hm). destruct (Hl eps m He) as (k & t & Hk & Ht & Hx & Hn).
    destruct (Hm k t Hk Ht Hx) as (c & _ & Hcn). pose proof (near_unit (N A) _ d c eps Hx Hd Hcn) as H. fold u in H.
    rewrite nrm_sub_sym in Hn. destruct (Rle_dec 0 c); [left|right].
    - replace (scl 1 u) with u in H by (extensionality i; unfold scl; ring).
      unfold a. eapply Rle_trans; [apply (nrm_tri _ _ (unit_vector (N A) (secant A P s b k t)))|]. lra.
    - unfold b'. eapply Rle_trans; [apply (nrm_tri _ _ (unit_vector (N A) (secant A P s b k t)))|]. lra. }
  destruct (Req_dec a 0) as [|Ha0]; [left; auto|]. destruct (Req_dec b' 0) as [|Hb0]; [right; auto|]. exfalso.
  destruct (Hsmall (Rmin a b' / 6)) as [H|H].
  - assert (0 < Rmin a b') by (apply Rmin_glb_lt; lra). lra.
  - pose proof (Rmin_l a b'). lra.
  - pose proof (Rmin_r a b'). lra.
Qed.
