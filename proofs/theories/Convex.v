(** Combinations, closed cones, and means whose weights overlap (Doeblin). *)
From Coq Require Import Reals Lra Lia List FunctionalExtensionality.
From Coquelicot Require Import Coquelicot.
From Secant Require Import Vec Automaton.
Open Scope R_scope.

(** [sum_l c_l u_l]. *)
Definition comb (n : nat) (c : nat -> R) (u : nat -> vec) : vec := fun i => sum n (fun l => c l * u l i).

(** Closed convex cones. *)
Definition closed_cone (D : vec -> Prop) := D (fun _ => 0) /\ (forall x y, D x -> D y -> D (add x y)) /\
  (forall a x, 0 <= a -> D x -> D (scl a x)) /\
  (forall (x : nat -> vec) (y : vec), (forall k, D (x k)) -> (forall i, is_lim_seq (fun k => x k i) (y i)) -> D y).

(** The closed cone of finitely many rays. *)
Definition in_cone (n : nat) (ray : nat -> vec) (x : vec) :=
  forall D, closed_cone D -> (forall j, (j < n)%nat -> D (ray j)) -> D x.

Lemma comb_closed D n c u : closed_cone D -> (forall j, (j < n)%nat -> 0 <= c j) -> (forall j, (j < n)%nat -> D (u j)) -> D (comb n c u).
Proof.
  intros (H0 & Ha & Hs & Hl). unfold comb. induction n; intros Hc Hu; simpl; auto.
  assert (E : (fun i => sum n (fun l => c l * u l i) + c n * u n i) = add (fun i => sum n (fun l => c l * u l i)) (scl (c n) (u n)))
    by (extensionality i; reflexivity).
  rewrite E. apply Ha; auto.
Qed.

Lemma in_cone_comb n ray c : (forall j, (j < n)%nat -> 0 <= c j) -> in_cone n ray (comb n c ray).
Proof. intros Hc D HD Hr. apply comb_closed; auto. Qed.

Lemma in_cone_closed n ray : closed_cone (in_cone n ray).
Proof.
  split; [|split; [|split]].
  - intros D HD _. apply HD.
  - intros x y Hx Hy D HD Hr. pose proof HD as (_ & H1 & _). apply H1; [apply Hx|apply Hy]; auto.
  - intros a x Ha Hx D HD Hr. pose proof HD as (_ & _ & H2 & _). apply H2; auto. apply Hx; auto.
  - intros x y Hx Hy D HD Hr. pose proof HD as (_ & _ & _ & H3). apply (H3 x); auto. intros k. apply Hx; auto.
Qed.

Lemma comb_linear (L : vec -> vec) n c u : (forall x y, L (add x y) = add (L x) (L y)) ->
  (forall a x, L (scl a x) = scl a (L x)) -> L (comb n c u) = comb n c (fun l => L (u l)).
Proof.
  intros La Ls. unfold comb. induction n.
  - simpl. replace (fun _ : nat => 0) with (scl 0 (fun _ : nat => 0)) by (extensionality i; unfold scl; ring).
    rewrite Ls. extensionality i; unfold scl; ring.
  - change (fun i => sum (S n) (fun l => c l * u l i)) with (add (fun i => sum n (fun l => c l * u l i)) (scl (c n) (u n))).
    rewrite La, Ls, IHn. reflexivity.
Qed.

Lemma nrm_comb N n c u : nrm N (comb n c u) <= sum n (fun l => Rabs (c l) * nrm N (u l)).
Proof.
  induction n; simpl.
  - right. apply nrm_0. intros; reflexivity.
  - change (comb (S n) c u) with (add (comb n c u) (scl (c n) (u n))).
    eapply Rle_trans; [apply nrm_add|]. rewrite nrm_scl. lra.
Qed.

Lemma nrm_mean N n p u b : (forall l, (l < n)%nat -> 0 <= p l) -> (forall l, (l < n)%nat -> nrm N (u l) <= b) ->
  nrm N (comb n p u) <= sum n p * b.
Proof.
  intros Hp Hu. eapply Rle_trans; [apply nrm_comb|]. rewrite Rmult_comm, <- sum_scal. apply sum_le; intros l Hl.
  rewrite Rabs_pos_eq, Rmult_comm by auto. apply Rmult_le_compat_r; auto.
Qed.

Lemma dot_comb N h n c u : dot N h (comb n c u) = sum n (fun l => c l * dot N h (u l)).
Proof.
  induction n; simpl.
  - apply sum_0; intros; unfold comb; simpl; ring.
  - change (comb (S n) c u) with (add (comb n c u) (scl (c n) (u n))). rewrite dot_add, dot_scl, IHn. reflexivity.
Qed.

(** Doeblin: two means whose weights overlap are nearer to each other than what they are means of. *)
Lemma doeblin N n p r u a D : (forall l, (l < n)%nat -> 0 <= r l) -> (forall l, (l < n)%nat -> a * r l <= p l) ->
  sum n p = 1 -> sum n r = 1 -> (forall l l', (l < n)%nat -> (l' < n)%nat -> nrm N (sub (u l) (u l')) <= D) ->
  nrm N (sub (comb n p u) (comb n r u)) <= (1 - a) * D.
Proof.
  intros Hr Hp Sp Sr HD.
  replace (sub (comb n p u) (comb n r u))
    with (comb n (fun l => p l - a * r l) (fun l => comb n r (fun l' => sub (u l) (u l')))).
  - eapply Rle_trans; [apply (nrm_mean N n _ _ D)|].
    + intros l Hl. specialize (Hp l Hl). lra.
    + intros l Hl. eapply Rle_trans; [apply (nrm_mean N n r _ D); auto|]. rewrite Sr. lra.
    + rewrite sum_minus, sum_scal, Sp, Sr. lra.
  - extensionality i. unfold comb, sub.
    rewrite (sum_ext n _ (fun l => (p l - a * r l) * (u l i - sum n (fun l' => r l' * u l' i)))).
    + set (U := sum n (fun l' => r l' * u l' i)).
      rewrite (sum_ext n _ (fun l => (p l * u l i - a * (r l * u l i)) - (U * p l - (U * a) * r l))) by (intros; ring).
      rewrite !sum_minus, !sum_scal, Sp, Sr. fold U. ring.
    + intros l Hl. f_equal. rewrite (sum_ext n _ (fun l' => u l i * r l' - r l' * u l' i)) by (intros; ring).
      rewrite sum_minus, sum_scal, Sr. ring.
Qed.

Lemma sum_pos n f : (0 < n)%nat -> (forall j, (j < n)%nat -> 0 < f j) -> 0 < sum n f.
Proof.
  intros Hn H. destruct n; [lia|]. simpl. assert (0 <= sum n f) by (apply sum_nonneg; intros; left; apply H; lia).
  assert (0 < f n) by (apply H; lia). lra.
Qed.

Section Preimages.
Variable A : automaton.
Notation N := (N A).
Notation T e i := (act N (mat A e i)).

(** The preimage of a closed cone under an operator is one. *)
Lemma preimage_T D e i : closed_cone D -> closed_cone (fun x => D (T e i x)).
Proof.
  intros (H0 & H1 & H2 & H3). split; [|split; [|split]].
  - replace (T e i (fun _ => 0)) with (fun _ : nat => 0); auto. extensionality k. symmetry. apply sum_0; intros; ring.
  - intros y z Hy Hz. rewrite act_add. auto.
  - intros a y Ha Hy. rewrite act_scl. auto.
  - intros y z Hy Hz. apply (H3 (fun k => T e i (y k))); auto. intros k. unfold act.
    apply (lim_sum N (fun n j => mat A e i k j * y n j)). intros j Hj.
    apply (is_lim_seq_scal_l (fun n => y n j) (mat A e i k j) (z j)). apply Hz.
Qed.

Lemma preimage_scl D a : closed_cone D -> closed_cone (fun x => D (scl a x)).
Proof.
  intros (H0 & H1 & H2 & H3). split; [|split; [|split]].
  - replace (scl a (fun _ => 0)) with (fun _ : nat => 0); auto. extensionality k. unfold scl; ring.
  - intros y z Hy Hz. replace (scl a (add y z)) with (add (scl a y) (scl a z)) by (extensionality k; unfold add, scl; ring). auto.
  - intros b y Hb Hy. replace (scl a (scl b y)) with (scl b (scl a y)) by (extensionality k; unfold scl; ring). auto.
  - intros y z Hy Hz. apply (H3 (fun k => scl a (y k))); auto. intros k. unfold scl.
    apply (is_lim_seq_scal_l (fun n => y n k) a (z k)). apply Hz.
Qed.

Lemma preimage_W k : forall D e s, closed_cone D -> closed_cone (fun x => D (W A e s k x)).
Proof.
  induction k; simpl; intros D e s HD; auto.
  apply (IHk (fun y => D (T e (s O) y)) (dst A e (s O)) (tl s)). apply preimage_T; auto.
Qed.

Lemma drop_nth k : forall (s : address) j, drop k s j = s (k + j)%nat.
Proof. induction k; simpl; intros; auto. rewrite IHk. reflexivity. Qed.

Lemma W_same k : forall e s t x, (forall j, (j < k)%nat -> s j = t j) -> W A e s k x = W A e t k x /\ st A e s k = st A e t k.
Proof.
  induction k; simpl; intros e s t x H; auto. rewrite (H O) by lia.
  destruct (IHk (dst A e (t O)) (tl s) (tl t) x) as [H1 H2]; [intros j Hj; apply (H (S j)); lia|].
  rewrite H1, H2. auto.
Qed.
End Preimages.
