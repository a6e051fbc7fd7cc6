(** Replay of Theorem 6: a tangent at every point of a curve, from cones with rational rays. *)
From Coq Require Import Reals Lra Lia List QArith Qabs Qreals Bool FunctionalExtensionality.
From Secant Require Export Replay Cones.
Open Scope R_scope.

(** At the point of every address there is one ray to which the secants of both sides, directed forward, tend uniformly: those
    to the points of the addresses that share [m] letters, before and after it in the order of the curve. *)
Definition tangent_at_every_address (A : automaton) (P : matrix) (s : nat) :=
  forall a, adm A s a -> exists d, 0 < nrm (N A) d /\
    forall eps, 0 < eps -> exists m, forall t, adm A s t -> (forall j, (j < m)%nat -> a j = t j) ->
    forall x, (before a t /\ x = act (N A) P (sub (phi A s t) (phi A s a))) \/
              (before t a /\ x = act (N A) P (sub (phi A s a) (phi A s t))) ->
    0 < nrm (N A) x -> exists c, 0 < c /\ nrm (N A) (sub x (scl c d)) <= eps * nrm (N A) x.

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
Variables (centres : list qvec) (radii : list Q) (spaces : list qmat) (k : cones).

Definition ray_list e := nth e (rays_of k) [].
Definition ray_at e j := nth j (ray_list e) [].
Definition map_at e i := nth i (nth e (maps_of k) []) [].
Definition first_at e := nth e (firsts k) [].
Definition last_at e := nth e (lasts k) [].
Definition chord_at e := nth e (chords k) [].

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
  qeqv N (qact N (mt e 0%nat) (first_at (dst A e 0))) (first_at e) && qeqv N (qact N (mt e g) (last_at (dst A e g))) (last_at e) &&
  forallb (fun i => qeqv N (qact N (mt e i) (last_at (dst A e i))) (qact N (mt e (S i)) (first_at (dst A e (S i))))) (seq 0 g) &&
  forallb (fun j => Qle_bool 0 (qnth (chord_at e) j)) (seq 0 n) &&
  qeqv N (qsub N (last_at e) (first_at e)) (qcomb n (qnth (chord_at e)) (ray_at e)) &&
  forallb (fun i => forallb (fun j =>
      qeqv N (qact N (mt e i) (ray_at (dst A e i) j)) (qcomb n (fun l => qent (map_at e i) l j) (ray_at e)) &&
      forallb (fun l => Qlt_bool 0 (qent (map_at e i) l j)) (seq 0 n))
    (seq 0 (length (ray_list (dst A e i)))) &&
    forallb (fun l => let bound := Qred (ratio k * qmax (map (qent (map_at e i) l) (seq 0 (length (ray_list (dst A e i)))))) in
      forallb (fun j => Qle_bool bound (qent (map_at e i) l j)) (seq 0 (length (ray_list (dst A e i))))) (seq 0 n)) (seq 0 (deg A e)).

Definition check_cones (P : qmat) (s : nat) : bool :=
  (s <? states A) && (length P <=? N) && Qlt_bool 0 (ratio k) && Qle_bool (ratio k) 1 &&
  forallb check_state (seq 0 (states A)) &&
  forallb (fun j => Qlt_bool 0 (qdot N (seen_by k) (qact N P (ray_at s j)))) (seq 0 (length (ray_list s))).

Theorem cones_ok P s : controlled case centres radii spaces -> check_cones P s = true -> tangent_at_every_address A (qm P) s.
Proof.
  intros (Hf & Hsys & _) H. unfold check_cones in H. rewrite !andb_true_iff in H.
  destruct H as [[[[[H1 H2] H3] H4] H5] H6]. apply Nat.ltb_lt in H1. apply Nat.leb_le in H2.
  apply Q2R_lt in H3. rewrite Q2R_0 in H3. apply Q2R_le in H4. rewrite Q2R_1 in H4.
  destruct (check_form_ok case Hf) as [Hwf Hlen].
  assert (Hst : forall e, (e < states A)%nat -> check_state e = true) by (intros e He; apply (forall_lt _ _ H5 e He)).
  clear H5. unfold check_state in Hst.
  assert (C : forall e, (e < states A)%nat ->
    (0 < length (ray_list e))%nat /\
    (forall j, (j < length (ray_list e))%nat -> (length (ray_at e j) <= N)%nat) /\
    (bary N (dim A e) (qv (first_at e)) /\ act N (mat A e 0) (qv (first_at (dst A e 0))) = qv (first_at e)) /\
    (bary N (dim A e) (qv (last_at e)) /\ act N (mat A e (deg A e - 1)) (qv (last_at (dst A e (deg A e - 1)))) = qv (last_at e)) /\
    (forall i, (S i < deg A e)%nat -> act N (mat A e i) (qv (last_at (dst A e i))) = act N (mat A e (S i)) (qv (first_at (dst A e (S i))))) /\
    (forall j, (j < length (ray_list e))%nat -> 0 <= Q2R (qnth (chord_at e) j)) /\
    sub (qv (last_at e)) (qv (first_at e)) = comb (length (ray_list e)) (fun l => Q2R (qnth (chord_at e) l)) (fun l => qv (ray_at e l)) /\
    (forall i j, (i < deg A e)%nat -> (j < length (ray_list (dst A e i)))%nat ->
      act N (mat A e i) (qv (ray_at (dst A e i) j)) = comb (length (ray_list e)) (fun l => Q2R (qent (map_at e i) l j)) (fun l => qv (ray_at e l)) /\
      forall l, (l < length (ray_list e))%nat -> 0 < Q2R (qent (map_at e i) l j) /\
        forall j', (j' < length (ray_list (dst A e i)))%nat -> Q2R (ratio k) * Q2R (qent (map_at e i) l j') <= Q2R (qent (map_at e i) l j))).
  { intros e He. pose proof (Hst e He) as H. cbv beta zeta in H. rewrite !andb_true_iff in H.
    destruct H as [[[[[[[[[G1 G2] G3] G4] G5] G6] G7] G8] G9] G10]. apply Nat.ltb_lt in G1.
    pose proof (deg_pos A Hsys e He) as Hdeg. simpl in Hdeg.
    assert (Gr : forall j, (j < length (ray_list e))%nat -> (length (ray_at e j) <= N)%nat).
    { intros j Hj. apply Nat.leb_le. apply (forall_lt _ _ G2 j Hj). }
    assert (Ha : forall i x, (i < deg A e)%nat -> qv (qact N (mt e i) x) = act N (mat A e i) (qv x)).
    { intros i x Hi. apply qact_ok. apply Hlen; auto. }
    assert (Gb : (length (first_at e) <= N)%nat /\ (length (last_at e) <= N)%nat).
    { pose proof (qeqv_len _ _ _ G5). pose proof (qeqv_len _ _ _ G6). tauto. }
    split; [auto|]. split; [auto|].
    split; [split; [apply qbary_ok; auto|rewrite <- Ha by auto; apply (qeqv_ok N); auto]|].
    split; [split; [apply qbary_ok; auto|rewrite <- Ha by (simpl; lia); apply (qeqv_ok N); auto]|].
    split.
    { intros i Hi. rewrite <- !Ha by lia. apply (qeqv_ok N). apply (forall_lt _ _ G7 i). lia. }
    split.
    { intros j Hj. pose proof (forall_lt _ _ G8 j Hj) as G. apply Q2R_le in G. rewrite Q2R_0 in G. auto. }
    split.
    { rewrite <- (qsub_ok N) by tauto. rewrite <- (qcomb_ok _ (qnth (chord_at e))) by auto. apply (qeqv_ok N); auto. }
    intros i j Hi Hj. pose proof (forall_lt _ _ G10 i Hi) as G. cbv beta in G. rewrite andb_true_iff in G. destruct G as [G Gr'].
    pose proof (forall_lt _ _ G j Hj) as G'. cbv beta in G'. rewrite andb_true_iff in G'. destruct G' as [Ga Gc]. split.
    { rewrite <- Ha by auto. rewrite <- (qcomb_ok _ (fun l => qent (map_at e i) l j)) by auto. apply (qeqv_ok N); auto. }
    intros l Hl. pose proof (forall_lt _ _ Gc l Hl) as Gd. cbv beta in Gd.
    split; [apply Q2R_lt in Gd; rewrite Q2R_0 in Gd; auto|]. intros j' Hj'.
    pose proof (forall_lt _ _ Gr' l Hl) as Ge. cbv beta zeta in Ge. pose proof (forall_lt _ _ Ge j Hj) as Gf. cbv beta in Gf.
    apply Q2R_le in Gf. rewrite Q2R_red, Q2R_mult in Gf. eapply Rle_trans; [|exact Gf]. apply Rmult_le_compat_l; [lra|].
    apply qmax_ok. apply in_map_iff. exists j'. split; auto. apply in_seq. lia. }
  intros a Ha.
  eexists. apply (tangent_everywhere A Hsys (fun e => length (ray_list e)) (fun e j => qv (ray_at e j))
    (fun e i l j => Q2R (qent (map_at e i) l j)) (Q2R (ratio k)) (fun e => qv (first_at e)) (fun e => qv (last_at e))
    (fun e j => Q2R (qnth (chord_at e) j))) with (h := qv (seen_by k)); auto.
  - intros e He. apply (C e He).
  - intros e i l j He Hi Hl Hj. destruct (C e He) as (_ & _ & _ & _ & _ & _ & _ & Cb). apply (Cb i j Hi Hj); auto.
  - intros e i l j j' He Hi Hl Hj Hj'. destruct (C e He) as (_ & _ & _ & _ & _ & _ & _ & Cb). apply (Cb i j Hi Hj); auto.
  - intros e i j He Hi Hj. destruct (C e He) as (_ & _ & _ & _ & _ & _ & _ & Cb). apply (Cb i j Hi Hj).
  - intros e He. apply (C e He).
  - intros e He. apply (C e He).
  - intros e i He Hi. destruct (C e He) as (_ & _ & _ & _ & Cm & _). apply Cm; auto.
  - intros e j He Hj. destruct (C e He) as (_ & _ & _ & _ & _ & Cw & _). apply Cw; auto.
  - intros e He. apply (C e He).
  - intros j Hj. pose proof (forall_lt _ _ H6 j Hj) as G. cbv beta in G. apply Q2R_lt in G.
    rewrite Q2R_0, qdot_ok, qact_ok in G by auto. exact G.
Qed.
End Everywhere.
