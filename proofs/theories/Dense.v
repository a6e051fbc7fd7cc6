(** Replay of Theorem 5: the joints of all levels. *)
From Coq Require Import Reals Lra Lia List QArith Qabs Qreals Bool FunctionalExtensionality.
From Secant Require Export Replay Levels.
Open Scope R_scope.

Section Dense.
Variable case : system.
Notation A := (automaton_of case).
Notation N := (ambient case).
Variables (centres : list qvec) (radii : list Q) (spaces : list qmat).

(** [K] undoes [M] on the vectors that [S] does not change. *)
Definition check_inverse (S K M : qmat) : bool := (length K <=? N) && qeqm N (qmul N K (qmul N M S)) S.

Lemma check_inverse_ok S K M : (length M <= N)%nat -> check_inverse S K M = true ->
  injective_on N (fixed_by case S) (act N (qm M)).
Proof.
  unfold check_inverse. rewrite andb_true_iff, Nat.leb_le. intros HM [HK H].
  exists (/ (size N (qm K) + 1)). pose proof (size_ge0 N (qm K)). split; [apply Rinv_0_lt_compat; lra|]. intros x Hx.
  assert (E : act N (qm K) (act N (qm M) x) = x).
  { pose proof (qeqm_ok N _ _ x H) as E. rewrite !qmul_ok in E by auto. unfold fixed_by in Hx. simpl in Hx. rewrite !Hx in E. exact E. }
  assert (H2 : nrm N x <= size N (qm K) * nrm N (act N (qm M) x)) by (rewrite <- E at 1; apply nrm_act).
  apply Rmult_le_reg_l with (size N (qm K) + 1); [lra|]. rewrite <- Rmult_assoc, Rinv_r, Rmult_1_l by lra.
  pose proof (nrm_ge0 N (act N (qm M) x)). simpl in *. lra.
Qed.

(** Left inverses of all operators and of the control points. *)
Definition check_injective (P : qmat) (s : nat) (inverses : list (list qmat)) (net_inverse : qmat) : bool :=
  (length P <=? N) && check_inverse (space_of spaces s) net_inverse P &&
  forallb (fun e => forallb (fun i => check_inverse (space_of spaces (dst A e i)) (nth i (nth e inverses []) []) (snd (piece case e i)))
    (seq 0 (deg A e))) (seq 0 (states A)).

Lemma qm_qid : qm (qid N) = identity A.
Proof.
  extensionality i. extensionality j. unfold qm, qid, identity. rewrite tab_nth.
  change (Automaton.N A) with N. destruct (Nat.ltb_spec i N) as [Hi|Hi].
  - rewrite tab_nth. destruct (Nat.ltb_spec j N); destruct (Nat.eqb_spec i j); try lia; try apply Q2R_1; apply Q2R_0.
  - destruct (Nat.eqb_spec i j); destruct j; apply Q2R_0.
Qed.

Lemma neg_scl u s P d : act N P (Ww A s u (scl (-1) d)) = scl (-1) (act N P (Ww A s u d)).
Proof. rewrite Ww_scl, act_scl. reflexivity. Qed.

Theorem directed_levels P s f inverses net_inverse sg b q d : controlled case centres radii spaces ->
  (s < states A)%nat -> check_injective P s inverses net_inverse = true -> check_cycle case f b q = true ->
  directed sg A (qm (qid N)) f b d ->
  forall u, admw A s u -> stw A s u = f -> directed sg A (qm P) s (inside u b) (act N (qm P) (Ww A s u d)).
Proof.
  intros (Hf & Hsys & Hball & Hbase & Hspan) Hs Hi Hc Hd u Hu Hto. unfold check_injective in Hi. rewrite !andb_true_iff in Hi.
  destruct Hi as [[Hl Hn] Hi]. apply Nat.leb_le in Hl.
  destruct (check_form_ok case Hf) as [Hwf Hlen].
  pose proof (check_cycle_ok case f b q Hf Hc) as Hcyc. cbv zeta in Hcyc. destruct Hcyc as (Hfs & Hbu & Hbw & Hne & Hcl & Hq & Hfix).
  pose proof (stw_ok A Hsys _ f Hfs Hbu) as He. pose proof (dim_ok A Hwf _ He) as Hdm. specialize (Hfix He (proj2 Hdm)).
  apply (directed_inside A Hsys (qm P) s f u Hs Hu Hto (in_space case spaces f)); auto.
  - intros t t' Ht Ht'. apply (differences case centres spaces Hf Hsys Hbase Hspan); auto.
  - subst f. apply (seen_inj A Hsys (qm P) s (in_space case spaces)); auto.
    + intros e i x Hes Hie. apply (spaces_step case centres spaces Hf Hbase Hspan e i Hes Hie).
    + apply (check_inverse_ok _ net_inverse P); auto.
    + intros e i Hes Hie. pose proof (forall_lt _ _ Hi e Hes) as H1. cbv beta in H1. pose proof (forall_lt _ _ H1 i Hie) as H2.
      cbv beta in H2. apply (check_inverse_ok _ (nth i (nth e inverses []) [])); auto.
  - apply adm_app. split; auto. apply (adm_per A Hsys f b (qv q)); auto.
  - intros m t Ht. apply adm_app. split; auto. apply (adm_rep A f b); auto.
  - rewrite <- qm_qid. exact Hd.
Qed.

Lemma point_levels P s f b q u : controlled case centres radii spaces -> (s < states A)%nat -> check_cycle case f b q = true ->
  admw A s u -> stw A s u = f -> point A (qm P) s (inside u b) = act N (qm P) (Ww A s u (point A (qm (qid N)) f b)).
Proof.
  intros (Hf & Hsys & Hball & Hbase & Hspan) Hs Hc Hu Hto. destruct (check_form_ok case Hf) as [Hwf Hlen].
  pose proof (check_cycle_ok case f b q Hf Hc) as Hcyc. cbv zeta in Hcyc. destruct Hcyc as (Hfs & Hbu & Hbw & Hne & Hcl & Hq & Hfix).
  pose proof (stw_ok A Hsys _ f Hfs Hbu) as He. pose proof (dim_ok A Hwf _ He) as Hdm. specialize (Hfix He (proj2 Hdm)).
  assert (Hper : adm A f (app (prefix b) (per (cycle b)))).
  { apply adm_app. split; auto. apply (adm_per A Hsys f b (qv q)); auto. }
  unfold point, inside; simpl prefix; simpl cycle. rewrite app_app, (phi_app A Hsys u s); auto.
  - f_equal. rewrite Hto, qm_qid, act_identity; auto. intros i Hi. pose proof (phi_bary' A Hsys f (app (prefix b) (per (cycle b))) Hfs Hper) as [Hsup _]. apply Hsup. eapply Nat.le_trans; [apply (dim_ok A Hwf f Hfs)|exact Hi].
  - apply adm_app. rewrite Hto. auto.
Qed.

(** A smooth joint of a state is one, and a cusp is one, in every copy of the state inside the curve. *)
Theorem regular_levels P s f inverses net_inverse b1 b2 q1 q2 d : controlled case centres radii spaces ->
  (s <? states A) && check_injective P s inverses net_inverse && check_cycle case f b1 q1 && check_cycle case f b2 q2 = true ->
  regular A (qm (qid N)) f b1 b2 d ->
  forall u, admw A s u -> stw A s u = f -> regular A (qm P) s (inside u b1) (inside u b2) (act N (qm P) (Ww A s u d)).
Proof.
  intros Hc H (H1 & H2 & H3) u Hu Hto. rewrite !andb_true_iff in H. destruct H as [[[Hs Hi] Hc1] Hc2]. apply Nat.ltb_lt in Hs.
  split; [|split].
  - rewrite (point_levels P s f b1 q1 u), (point_levels P s f b2 q2 u), H1; auto.
  - rewrite <- neg_scl. apply (directed_levels P s f inverses net_inverse _ b1 q1); auto.
  - apply (directed_levels P s f inverses net_inverse _ b2 q2); auto.
Qed.

Theorem cusp_levels P s f inverses net_inverse b1 b2 q1 q2 d : controlled case centres radii spaces ->
  (s <? states A) && check_injective P s inverses net_inverse && check_cycle case f b1 q1 && check_cycle case f b2 q2 = true ->
  cusp A (qm (qid N)) f b1 b2 d ->
  forall u, admw A s u -> stw A s u = f -> cusp A (qm P) s (inside u b1) (inside u b2) (act N (qm P) (Ww A s u d)).
Proof.
  intros Hc H (H1 & H2 & H3) u Hu Hto. rewrite !andb_true_iff in H. destruct H as [[[Hs Hi] Hc1] Hc2]. apply Nat.ltb_lt in Hs.
  split; [|split].
  - rewrite (point_levels P s f b1 q1 u), (point_levels P s f b2 q2 u), H1; auto.
  - apply (directed_levels P s f inverses net_inverse _ b1 q1); auto.
  - apply (directed_levels P s f inverses net_inverse _ b2 q2); auto.
Qed.
End Dense.
