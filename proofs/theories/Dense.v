(** Replay of Theorem 5: the joints of all levels. *)
From Coq Require Import Reals Lra Lia List QArith Qabs Qreals Bool FunctionalExtensionality.
From Secant Require Export Replay Quadratic Levels.
Open Scope R_scope.

Section Dense.
Variable case : system.
Notation A := (automaton_of case).
Notation N := (ambient case).
Variables (centres : list qvec) (radii : list Q) (spaces : list qmat).

Definition view_of (views : list qmat) (e : nat) : qmat := nth e views [].

(** Of the vectors that [S] does not change [G] shows as much as [R]: each is a multiple of the other. *)
Definition check_shown (S R G : qmat) (k : qmat * qmat) : bool :=
  (length S <=? N) && (length R <=? N) && (length G <=? N) && (length (fst k) <=? N) && (length (snd k) <=? N) &&
  qeqm N (qmul N (fst k) (qmul N R S)) (qmul N G S) && qeqm N (qmul N (snd k) (qmul N G S)) (qmul N R S).

Lemma check_shown_ok S R G k (g : vec -> vec) : (forall x, fixed_by case S x -> g x = act N (qm G) x) -> check_shown S R G k = true ->
  comparable N (fixed_by case S) (act N (qm R)) g.
Proof.
  unfold check_shown. rewrite !andb_true_iff, !Nat.leb_le. intros Hg [[[[[[HS HR] HG] HC] HD] H1] H2]. destruct k as [C D]. cbn [fst snd] in *.
  pose proof (size_ge0 N (qm C)). pose proof (size_ge0 N (qm D)).
  exists (/ (size N (qm D) + 1)), (size N (qm C) + 1). split; [apply Rinv_0_lt_compat; lra|]. split; [lra|]. intros x Hx.
  rewrite Hg by auto. unfold fixed_by in Hx. simpl in Hx.
  pose proof (qeqm_ok N _ _ x H1) as E1. pose proof (qeqm_ok N _ _ x H2) as E2. rewrite !qmul_ok, !Hx in E1, E2 by auto. split.
  - apply Rmult_le_reg_l with (size N (qm D) + 1); [lra|]. rewrite <- Rmult_assoc, Rinv_r, Rmult_1_l by lra.
    rewrite <- E2. eapply Rle_trans; [apply nrm_act|]. apply Rmult_le_compat_r; [apply nrm_ge0|simpl; lra].
  - rewrite <- E1. eapply Rle_trans; [apply nrm_act|]. apply Rmult_le_compat_r; [apply nrm_ge0|simpl; lra].
Qed.

(** The control points show what the view of the start does, and every piece what the view of its target does. *)
Definition check_views (P : qmat) (s : nat) (views : list qmat) (pairs : list (list (qmat * qmat))) (net_pair : qmat * qmat) : bool :=
  check_shown (space_of spaces s) (view_of views s) P net_pair &&
  forallb (fun e => (length (view_of views e) <=? N) && forallb (fun i =>
      check_shown (space_of spaces (dst A e i)) (view_of views (dst A e i)) (qmul N (view_of views e) (snd (piece case e i))) (nth i (nth e pairs []) ([], [])))
    (seq 0 (deg A e))) (seq 0 (states A)).

Lemma views_ok P s views pairs net_pair f u : controlled case centres radii spaces -> (s < states A)%nat ->
  check_views P s views pairs net_pair = true -> admw A s u -> stw A s u = f ->
  comparable N (fixed_by case (space_of spaces f)) (act N (qm (view_of views f))) (fun x => act N (qm P) (Ww A s u x)).
Proof.
  intros (Hf & Hsys & Hball & Hbase & Hspan) Hs H Hu <-. unfold check_views in H. rewrite andb_true_iff in H. destruct H as [Hn Hi].
  apply (seen_shown A Hsys (qm P) s (fun e => fixed_by case (space_of spaces e)) (fun e => qm (view_of views e))); auto.
  - intros e i x Hes Hie. apply (spaces_step case centres spaces Hf Hbase Hspan e i Hes Hie).
  - apply (check_shown_ok _ _ P net_pair); auto.
  - intros e i Hes Hie. pose proof (forall_lt _ _ Hi e Hes) as H1. cbv beta in H1. rewrite andb_true_iff, Nat.leb_le in H1. destruct H1 as [Hv H1].
    pose proof (forall_lt _ _ H1 i Hie) as H2. cbv beta in H2.
    apply (check_shown_ok _ _ (qmul N (view_of views e) (snd (piece case e i))) (nth i (nth e pairs []) ([], []))); auto.
    intros x _. symmetry. apply qmul_ok; auto.
Qed.

Lemma fixed_sub S x y : fixed_by case S x -> fixed_by case S y -> fixed_by case S (sub x y).
Proof. unfold fixed_by. intros Hx Hy. rewrite act_sub, Hx, Hy. reflexivity. Qed.

Lemma fixed_scl S a x : fixed_by case S x -> fixed_by case S (scl a x).
Proof. unfold fixed_by. intros Hx. rewrite act_scl, Hx. reflexivity. Qed.

Theorem directed_levels P s f views pairs net_pair sg b q d : controlled case centres radii spaces ->
  (s < states A)%nat -> check_views P s views pairs net_pair = true -> check_cycle case f b q = true ->
  fixed_by case (space_of spaces f) d -> directed sg A (qm (view_of views f)) f b (act N (qm (view_of views f)) d) ->
  forall u, admw A s u -> stw A s u = f -> directed sg A (qm P) s (inside u b) (act N (qm P) (Ww A s u d)).
Proof.
  intros Hcase Hs Hi Hc Hfix Hd u Hu Hto. pose proof Hcase as (Hf & Hsys & Hball & Hbase & Hspan).
  destruct (check_form_ok case Hf) as [Hwf Hlen].
  pose proof (check_cycle_ok case f b q Hf Hc) as Hcyc. cbv zeta in Hcyc. destruct Hcyc as (Hfs & Hbu & Hbw & Hne & Hcl & Hq & Hfq).
  pose proof (stw_ok A Hsys _ f Hfs Hbu) as He. pose proof (dim_ok A Hwf _ He) as Hdm. specialize (Hfq He (proj2 Hdm)).
  apply (directed_inside A Hsys (qm P) (qm (view_of views f)) s f u Hs Hu Hto (fixed_by case (space_of spaces f))); auto.
  - intros; apply fixed_sub; auto.
  - intros; apply fixed_scl; auto.
  - intros t t' Ht Ht'. apply (differences case centres spaces Hf Hsys Hbase Hspan); auto.
  - apply (views_ok P s views pairs net_pair); auto.
  - apply adm_app. split; auto. apply (adm_per A Hsys f b (qv q)); auto.
  - intros m t Ht. apply adm_app. split; auto. apply (adm_rep A f b); auto.
Qed.

(** Branches that lead to one point of what is seen of a state lead to one point of every copy. *)
Lemma points_levels P s f views pairs net_pair b1 b2 q1 q2 : controlled case centres radii spaces ->
  (s < states A)%nat -> check_views P s views pairs net_pair = true -> check_cycle case f b1 q1 = true -> check_cycle case f b2 q2 = true ->
  point A (qm (view_of views f)) f b1 = point A (qm (view_of views f)) f b2 ->
  forall u, admw A s u -> stw A s u = f -> point A (qm P) s (inside u b1) = point A (qm P) s (inside u b2).
Proof.
  intros Hcase Hs Hi Hc1 Hc2 Hp u Hu Hto. pose proof Hcase as (Hf & Hsys & Hball & Hbase & Hspan).
  destruct (check_form_ok case Hf) as [Hwf Hlen].
  assert (Hper : forall b q, check_cycle case f b q = true -> (f < states A)%nat /\ adm A f (app (prefix b) (per (cycle b)))).
  { intros b q Hc. pose proof (check_cycle_ok case f b q Hf Hc) as Hcyc. cbv zeta in Hcyc. destruct Hcyc as (Hfs & Hbu & Hbw & Hne & Hcl & Hq & Hfq).
    pose proof (stw_ok A Hsys _ f Hfs Hbu) as He. pose proof (dim_ok A Hwf _ He) as Hdm. specialize (Hfq He (proj2 Hdm)).
    split; auto. apply adm_app. split; auto. apply (adm_per A Hsys f b (qv q)); auto. }
  destruct (Hper b1 q1 Hc1) as [Hfs H1]. destruct (Hper b2 q2 Hc2) as [_ H2].
  destruct (views_ok P s views pairs net_pair f u Hcase Hs Hi Hu Hto) as (k & K & Hk & HK & Hcmp).
  pose proof (differences case centres spaces Hf Hsys Hbase Hspan f _ _ Hfs H1 H2) as Hv.
  destruct (Hcmp _ Hv) as [_ C2]. rewrite act_sub in C2. unfold point in Hp. simpl in Hp. rewrite Hp in C2.
  assert (Hl : (length P <= N)%nat).
  { unfold check_views, check_shown in Hi. rewrite !andb_true_iff, !Nat.leb_le in Hi. tauto. }
  unfold point, inside; simpl prefix; simpl cycle. rewrite !app_app, !(phi_app A Hsys u s); auto; try (apply adm_app; rewrite Hto; auto).
  rewrite Hto. set (y1 := act N (qm P) (Ww A s u (phi A f (app (prefix b1) (per (cycle b1)))))).
  set (y2 := act N (qm P) (Ww A s u (phi A f (app (prefix b2) (per (cycle b2)))))).
  assert (E : nrm N (sub y1 y2) <= 0).
  { unfold y1, y2. rewrite <- act_sub, <- Ww_sub. eapply Rle_trans; [exact C2|].
    match goal with |- K * nrm N (sub ?z ?z) <= 0 => replace (sub z z) with (scl 0 z) by (extensionality i; unfold sub, scl; ring) end.
    rewrite nrm_scl, Rabs_R0. lra. }
  change (y1 = y2). extensionality i. destruct (Nat.lt_ge_cases i N) as [Hin|Hout].
  - pose proof (sum_term N (fun j => Rabs (sub y1 y2 j)) i (fun j _ => Rabs_pos _) Hin) as B. cbv beta in B.
    assert (B2 : Rabs (sub y1 y2 i) <= 0) by (eapply Rle_trans; [exact B|exact E]).
    pose proof (Rle_abs (sub y1 y2 i)). pose proof (Rle_abs (- sub y1 y2 i)) as B3. rewrite Rabs_Ropp in B3. unfold sub in *. lra.
  - unfold y1, y2, act. rewrite !sum_0; auto; intros; rewrite qm_short by lia; ring.
Qed.

(** A smooth joint of what is seen of a state is one, and a cusp is one, in every copy of the state inside the curve. *)
Theorem regular_levels P s f views pairs net_pair b1 b2 q1 q2 d d' : controlled case centres radii spaces ->
  (s <? states A) && check_views P s views pairs net_pair && check_cycle case f b1 q1 && check_cycle case f b2 q2 = true ->
  fixed_by case (space_of spaces f) d /\ act N (qm (view_of views f)) d = d' -> regular A (qm (view_of views f)) f b1 b2 d' ->
  forall u, admw A s u -> stw A s u = f -> regular A (qm P) s (inside u b1) (inside u b2) (act N (qm P) (Ww A s u d)).
Proof.
  intros Hc H [Hfix <-] (H1 & H2 & H3) u Hu Hto. rewrite !andb_true_iff in H. destruct H as [[[Hs Hi] Hc1] Hc2]. apply Nat.ltb_lt in Hs.
  split; [|split].
  - apply (points_levels P s f views pairs net_pair b1 b2 q1 q2); auto.
  - rewrite <- act_scl, <- Ww_scl. apply (directed_levels P s f views pairs net_pair _ b1 q1); auto; [apply fixed_scl; auto|].
    rewrite act_scl. exact H2.
  - apply (directed_levels P s f views pairs net_pair _ b2 q2); auto.
Qed.

Theorem cusp_levels P s f views pairs net_pair b1 b2 q1 q2 d d' : controlled case centres radii spaces ->
  (s <? states A) && check_views P s views pairs net_pair && check_cycle case f b1 q1 && check_cycle case f b2 q2 = true ->
  fixed_by case (space_of spaces f) d /\ act N (qm (view_of views f)) d = d' -> cusp A (qm (view_of views f)) f b1 b2 d' ->
  forall u, admw A s u -> stw A s u = f -> cusp A (qm P) s (inside u b1) (inside u b2) (act N (qm P) (Ww A s u d)).
Proof.
  intros Hc H [Hfix <-] (H1 & H2 & H3) u Hu Hto. rewrite !andb_true_iff in H. destruct H as [[[Hs Hi] Hc1] Hc2]. apply Nat.ltb_lt in Hs.
  split; [|split].
  - apply (points_levels P s f views pairs net_pair b1 b2 q1 q2); auto.
  - apply (directed_levels P s f views pairs net_pair _ b1 q1); auto.
  - apply (directed_levels P s f views pairs net_pair _ b2 q2); auto.
Qed.

(** A vector of the space of a state, and what is seen of it. *)
Definition check_lift (f : nat) (views : list qmat) (d d' : qvec) : bool :=
  (length (space_of spaces f) <=? N) && (length (view_of views f) <=? N) &&
  qeqv N (qact N (space_of spaces f) d) d && qeqv N (qact N (view_of views f) d) d'.

Lemma lift_ok f views d d' : check_lift f views d d' = true ->
  fixed_by case (space_of spaces f) (qv d) /\ act N (qm (view_of views f)) (qv d) = qv d'.
Proof.
  unfold check_lift. rewrite !andb_true_iff, !Nat.leb_le. intros [[[H1 H2] H3] H4]. apply qeqv_ok in H3, H4.
  rewrite qact_ok in H3, H4 by auto. auto.
Qed.
Lemma lift_pair_ok f views r d d' : check_lift f views (fst d) (fst d') && check_lift f views (snd d) (snd d') = true ->
  fixed_by case (space_of spaces f) (vval r d) /\ act N (qm (view_of views f)) (vval r d) = vval r d'.
Proof.
  rewrite andb_true_iff. intros [H1 H2]. apply lift_ok in H1, H2. destruct H1 as [F1 E1]. destruct H2 as [F2 E2].
  unfold fixed_by in *. simpl in F1, F2. unfold vval. rewrite !act_add, !act_scl, E1, E2. split; auto.
  simpl. rewrite F1, F2. reflexivity.
Qed.
(** Copies of these branches of states come as near as one likes to the point of every address. *)
Definition joints_dense (P : qmat) (s : nat) (joints : list (nat * (branch * qvec))) : Prop :=
  forall a eps, adm A s a -> 0 < eps -> exists u j, In j joints /\ admw A s u /\ stw A s u = fst j /\
    nrm N (sub (point A (qm P) s (inside u (fst (snd j)))) (act N (qm P) (phi A s a))) <= eps.

(** From every state a word leads to a state that has one. *)
Definition check_ways (s : nat) (joints : list (nat * (branch * qvec))) (ways : list (list nat)) : bool :=
  (s <? states A) && forallb (fun j => check_cycle case (fst j) (fst (snd j)) (snd (snd j))) joints &&
  forallb (fun e => let w := nth e ways [] in check_letters case e w && existsb (fun j => fst j =? stw A e w) joints) (seq 0 (states A)).

Theorem joints_dense_ok P s joints ways : controlled case centres radii spaces -> check_ways s joints ways = true -> joints_dense P s joints.
Proof.
  intros (Hf & Hsys & _) H a eps Ha Heps. unfold check_ways in H. rewrite !andb_true_iff in H. destruct H as [[Hs Hj] Hw]. apply Nat.ltb_lt in Hs.
  rewrite forallb_forall in Hj.
  destruct (copies_dense A Hsys (qm P) s (fun f t => exists j, In j joints /\ f = fst j /\ t = app (prefix (fst (snd j))) (per (cycle (fst (snd j))))) Hs)
    with (a := a) (eps := eps) as (u & t & Hu & (j & J1 & J2 & J3) & Hn); auto.
  - intros e He. pose proof (forall_lt _ _ Hw e He) as H1. cbv beta zeta in H1. rewrite andb_true_iff in H1. destruct H1 as [H1 H2].
    apply check_letters_ok in H1. apply existsb_exists in H2. destruct H2 as (j & J1 & J2). apply Nat.eqb_eq in J2.
    exists (nth e ways []), (app (prefix (fst (snd j))) (per (cycle (fst (snd j))))). split; [exact H1|]. split; [|exists j; auto].
    pose proof (check_cycle_ok case _ _ _ Hf (Hj j J1)) as Hcyc. cbv zeta in Hcyc. destruct Hcyc as (Hfs & Hbu & Hbw & Hne & Hcl & Hq & Hfq).
    pose proof (stw_ok A Hsys _ (fst j) Hfs Hbu) as He2. pose proof (dim_ok A (wf A Hsys) _ He2) as Hdm. specialize (Hfq He2 (proj2 Hdm)).
    rewrite <- J2. apply adm_app. split; auto. apply (adm_per A Hsys (fst j) (fst (snd j)) (qv (snd (snd j)))); auto.
  - exists u, j. split; auto. split; auto. split; auto. unfold point, inside. simpl prefix. simpl cycle. rewrite app_app, <- J3, <- act_sub. exact Hn.
Qed.
End Dense.
