(** Common cones with joints: a curve whose joints of all states are smooth is G¹ (Theorem 6). *)
From Coq Require Import Reals Lra Lia List Bool FunctionalExtensionality.
From Coquelicot Require Import Coquelicot.
From Secant Require Export Arc.
From Secant Require Import Vec Automaton Leading Germ Replay.
Import ListNotations.
Open Scope R_scope.

(** Theorem 6: smooth joints of every state, in its own space or in what is seen of it. *)
Section Smooth.
Variable A : automaton.
Notation N := (N A).
Hypothesis sys : contracting A.
Variables (rev : nat -> nat -> bool) (rays : nat -> nat) (ray : nat -> nat -> vec) (B : nat -> nat -> nat -> nat -> R) (kappa : R).
Variables (first last : nat -> vec) (weight : nat -> nat -> R).
Hypothesis common : common_cones A rev rays ray B kappa first last weight.
Variables (P : matrix) (h : vec) (start : nat).
Hypothesis start_ok : (start < states A)%nat.
Hypothesis view : forall j, (j < rays start)%nat -> 0 < dot N h (act N P (ray start j)).

(** What is seen of each state, with a functional on it; no more is seen through any word. *)
Variables (R : nat -> matrix) (own : nat -> vec) (V : nat -> vec -> Prop).
Hypothesis own_view : forall e j, (e < states A)%nat -> (j < rays e)%nat -> 0 < dot N (own e) (act N (R e) (ray e j)).
Hypothesis V_sub : forall e x y, V e x -> V e y -> V e (sub x y).
Hypothesis V_scl : forall e a x, V e x -> V e (scl a x).
Hypothesis V_ray : forall e j, (e < states A)%nat -> (j < rays e)%nat -> V e (ray e j).
Hypothesis V_word : forall e s k x, (e < states A)%nat -> adm A e s -> V (st A e s k) x -> V e (W A e s k x).
Hypothesis covers : forall s k, adm A start s -> exists K, 0 < K /\
  forall x, V (st A start s k) x -> nrm N (act N P (W A start s k x)) <= K * nrm N (act N (R (st A start s k)) x).
Hypothesis smooth : forall e i, (e < states A)%nat -> (S i < deg A e)%nat ->
  exists b1 b2 d, sides_of A rev e i b1 b2 /\ regular A (R e) e b1 b2 d.
Notation f s k := (st A start s k).
Notation tg a := (tangent A rev ray P h start a).

Lemma cell_plus s k n x : cell A rev start s (k + n) x = cell A rev start s k (cell A rev (f s k) (drop k s) n x).
Proof.
  unfold cell. rewrite W_plus, W_scl, turned_plus, orient_xorb. extensionality i; unfold scl; ring.
Qed.

(** Rays that agree in what is seen of a state agree in all copies of the state. *)
Lemma copies_agree a b k : adm A start a -> adm A start b -> (forall j, (j < k)%nat -> a j = b j) ->
  let e := f a k in
  nrm N (sub (tangent A rev ray (R e) (own e) e (drop k a)) (tangent A rev ray (R e) (own e) e (drop k b))) = 0 ->
  nrm N (sub (tg a) (tg b)) = 0.
Proof.
  intros Ha Hb Heq e He0. pose proof (proj2 (W_same A k start a b (fun _ => 0) Heq)) as Hf. fold e in Hf.
  assert (He : (e < states A)%nat) by (apply (f_ok A sys start a start_ok Ha)).
  assert (Va : adm A e (drop k a)) by (apply adm_drop; auto). assert (Vb : adm A e (drop k b)) by (rewrite Hf; apply adm_drop; auto).
  set (own_hgt := fun c n => hgt A rev ray (R e) (own e) e c n 0).
  set (y := fun c n => scl (/ own_hgt c n) (cell A rev e c n (ray (st A e c n) 0))).
  assert (Hz : forall c n, adm A e c -> (0 < rays (st A e c n))%nat /\ (st A e c n < states A)%nat).
  { intros c n Hc. assert ((st A e c n < states A)%nat) by (apply (f_ok A sys e c He Hc)). split; auto.
    apply (some_ray _ _ _ _ _ _ _ _ _ common); auto. }
  assert (Hpos : forall c n, adm A e c -> 0 < own_hgt c n).
  { intros c n Hc. apply (hgt_pos A sys rev rays ray B kappa first last weight common (R e) (own e) e c He Hc); auto. apply Hz; auto. }
  assert (Hy : forall c n, adm A e c -> V e (y c n)).
  { intros c n Hc. apply V_scl. unfold cell. apply V_scl. apply V_word; auto. apply V_ray; apply Hz; auto. }
  (* What the start sees of these vectors. *)
  set (M := fun x => act N P (cell A rev start a k x)).
  assert (Madd : forall x z, M (add x z) = add (M x) (M z)) by (intros; unfold M; rewrite cell_add, act_add; auto).
  assert (Mscl : forall t x, M (scl t x) = scl t (M x)) by (intros; unfold M; rewrite cell_scl, act_scl; auto).
  assert (Msub : forall x z, M (sub x z) = sub (M x) (M z)) by (intros; rewrite !sub_add, Madd, Mscl; reflexivity).
  assert (Hk : exists K, 0 < K /\ forall x, V e x -> nrm N (M x) <= K * nrm N (act N (R e) x)).
  { destruct (covers a k Ha) as (K & HK & Hc). exists K. split; auto. intros x Hx. unfold M, cell. rewrite act_scl, nrm_scl.
    replace (Rabs (orient (turned A rev start a k))) with 1; [rewrite Rmult_1_l; apply Hc; exact Hx|].
    destruct (turned A rev start a k); unfold orient; [rewrite Rabs_left|rewrite Rabs_pos_eq]; lra. }
  destruct Hk as (K & HK & HM).
  assert (Hc : exists c, 0 < c /\ forall x, in_cone (rays e) (ray e) x -> c * dot N (own e) (act N (R e) x) <= dot N h (M x)).
  { set (g := fun j => dot N (own e) (act N (R e) (ray e j)) / dot N h (M (ray e j))).
    assert (Hh : forall j, (j < rays e)%nat -> 0 < dot N h (M (ray e j))).
    { intros j Hj. apply (hgt_pos A sys rev rays ray B kappa first last weight common P h start a start_ok Ha view k j Hj). }
    assert (Hg : forall j, (j < rays e)%nat -> 0 <= g j).
    { intros j Hj. left. apply Rdiv_lt_0_compat; auto. }
    pose proof (sum_nonneg (rays e) g Hg) as Hs. exists (/ (1 + sum (rays e) g)). split; [apply Rinv_0_lt_compat; lra|].
    assert (Hlin : forall x, dot N (own e) (act N (R e) x) <= (1 + sum (rays e) g) * dot N h (M x) ->
      / (1 + sum (rays e) g) * dot N (own e) (act N (R e) x) <= dot N h (M x)).
    { intros x Hx. apply Rmult_le_reg_l with (1 + sum (rays e) g); [lra|]. rewrite <- Rmult_assoc, Rinv_r, Rmult_1_l by lra. exact Hx. }
    intros x Hx. apply Hlin. set (C := 1 + sum (rays e) g) in *.
    apply (Hx (fun x => dot N (own e) (act N (R e) x) <= C * dot N h (M x))).
    - split; [|split; [|split]].
      + assert (E : (fun _ : nat => 0) = scl 0 (fun _ : nat => 0)) by (extensionality i; unfold scl; ring).
        rewrite E, Mscl, act_scl, !dot_scl. lra.
      + intros z z' H1 H2. rewrite Madd, act_add, !dot_add. lra.
      + intros t z Ht H1. rewrite Mscl, act_scl, !dot_scl. nra.
      + intros z z' H1 Hl.
        assert (Hd : forall (u : vec) (F : matrix) (G : vec -> vec), (forall i, is_lim_seq (fun m => G (z m) i) (G z' i)) ->
          is_lim_seq (fun m => dot N u (act N F (G (z m)))) (dot N u (act N F (G z')))).
        { intros u F G HG. apply (lim_sum N (fun m i => u i * act N F (G (z m)) i)). intros i Hi.
          apply (is_lim_seq_scal_l (fun m => act N F (G (z m)) i) (u i) (act N F (G z') i)). apply lim_act. exact HG. }
        apply (is_lim_seq_le (fun m => dot N (own e) (act N (R e) (z m))) (fun m => C * dot N h (M (z m)))
          (dot N (own e) (act N (R e) z')) (C * dot N h (M z'))); auto.
        * apply (Hd (own e) (R e) (fun x => x)). exact Hl.
        * apply (is_lim_seq_scal_l _ C (dot N h (M z'))). unfold M. apply (Hd h P (cell A rev start a k)). intros i. unfold cell, scl.
          apply (is_lim_seq_scal_l (fun m => W A start a k (z m) i) (orient (turned A rev start a k)) (W A start a k z' i)).
          apply (lim_W A a k start z z' Hl).
    - intros j Hj. apply Rle_trans with (g j * dot N h (M (ray e j))).
      + right. unfold g. field. pose proof (Hh j Hj). lra.
      + apply Rmult_le_compat_r; [left; auto|]. pose proof (sum_term (rays e) g j Hg Hj). unfold C. lra. }
  destruct Hc as (c & Hcpos & Hcone).
  assert (Hcell : forall d n, adm A e d -> in_cone (rays e) (ray e) (cell A rev e d n (ray (st A e d n) 0))).
  { intros d n Hd. assert (G : forall m x, in_cone (rays (st A e d m)) (ray (st A e d m)) x -> in_cone (rays e) (ray e) (cell A rev e d m x)).
    { induction m; intros x Hx.
      - rewrite cell_0 by auto. exact Hx.
      - rewrite cell_last by auto. apply IHm. destruct (f_step A e d He Hd m) as [Hf' Hs']. rewrite Hf' in Hx.
        apply (T_cone A rev rays ray B kappa first last weight common); auto. apply (f_ok A sys e d He Hd). }
    apply G. intros D HD Hr. apply Hr. apply Hz; auto. }
  assert (Hone : forall d n, adm A e d -> dot N (own e) (act N (R e) (y d n)) = 1).
  { intros d n Hd. unfold y. rewrite act_scl, dot_scl. fold (hgt A rev ray (R e) (own e) e d n 0).
    change (/ own_hgt d n * own_hgt d n = 1). field. pose proof (Hpos d n Hd). lra. }
  assert (Hlow : forall d n, adm A e d -> c <= dot N h (M (y d n))).
  { intros d n Hd. rewrite <- (Rmult_1_r c), <- (Hone d n Hd). apply Hcone.
    apply (proj1 (proj2 (proj2 (in_cone_closed (rays e) (ray e))))); auto. left. apply Rinv_0_lt_compat. apply Hpos; auto. }
  (* Unit rays at the start. *)
  assert (Hu : forall s, adm A start s -> (forall j, (j < k)%nat -> a j = s j) -> forall n,
    unit_ray A rev ray P h start s (k + n) 0 = scl (/ dot N h (M (y (drop k s) n))) (M (y (drop k s) n))).
  { intros s Hs Has n. pose proof (proj2 (W_same A k start a s (fun _ => 0) Has)) as Hfs. fold e in Hfs.
    assert (Hd : adm A e (drop k s)) by (rewrite Hfs; apply adm_drop; auto).
    assert (Eg : gen A rev ray P start s (k + n) 0 = scl (own_hgt (drop k s) n) (M (y (drop k s) n))).
    { unfold gen. rewrite cell_plus, st_plus, <- Hfs. unfold y. rewrite Mscl. unfold M.
      assert (Ec : forall x, cell A rev start s k x = cell A rev start a k x).
      { intros x. unfold cell. rewrite (turned_same A rev k start a s Has). destruct (W_same A k start a s x Has) as [-> _]. reflexivity. }
      rewrite Ec. extensionality i. unfold scl. field. pose proof (Hpos (drop k s) n Hd). lra. }
    unfold unit_ray, hgt. rewrite Eg, dot_scl. pose proof (Hpos (drop k s) n Hd) as Hp. pose proof (Hlow (drop k s) n Hd).
    extensionality i. unfold scl. field. split; lra. }
  assert (L1 : is_lim_seq (fun n => nrm N (act N (R e) (sub (y (drop k a) n) (y (drop k b) n)))) 0).
  { pose proof (unit_lim A sys rev rays ray B kappa first last weight common (R e) (own e) e He (fun j => own_view e j He) (drop k a) Va) as Q1.
    pose proof (unit_lim A sys rev rays ray B kappa first last weight common (R e) (own e) e He (fun j => own_view e j He) (drop k b) Vb) as Q2.
    pose proof (is_lim_seq_plus' _ _ _ _ Q1 Q2) as Q3. rewrite Rplus_0_r in Q3.
    refine (is_lim_seq_le_le (fun _ => 0) _ _ _ _ (is_lim_seq_const 0) Q3). intros n. split; [apply nrm_ge0|].
    assert (Eu : forall d, unit_ray A rev ray (R e) (own e) e d n 0 = act N (R e) (y d n)).
    { intros d. unfold unit_ray, gen, y. rewrite act_scl. reflexivity. }
    rewrite !Eu, act_sub. set (ta := tangent A rev ray (R e) (own e) e (drop k a)) in *. set (tb := tangent A rev ray (R e) (own e) e (drop k b)) in *.
    eapply Rle_trans; [apply (nrm_tri N _ ta)|]. apply Rplus_le_compat_l. rewrite (nrm_sub_sym N _ tb).
    eapply Rle_trans; [apply (nrm_tri N _ tb)|]. lra. }
  set (ua := fun n => unit_ray A rev ray P h start a (k + n) 0). set (ub := fun n => unit_ray A rev ray P h start b (k + n) 0).
  pose proof (unit_lim A sys rev rays ray B kappa first last weight common P h start start_ok view a Ha) as U1.
  pose proof (unit_lim A sys rev rays ray B kappa first last weight common P h start start_ok view b Hb) as U2.
  apply (is_lim_seq_incr_n _ k) in U1. apply (is_lim_seq_incr_n _ k) in U2.
  apply Rle_antisym; [|apply nrm_ge0].
  (* [|ua - ub| <= D |R (y - y')|] with a constant. *)
  assert (Hh : forall x, Rabs (dot N h x) <= nrm N h * nrm N x) by (intros; apply dot_le).
  pose proof (nrm_ge0 N h) as Hh0.
  set (q := fun n => nrm N (act N (R e) (sub (y (drop k a) n) (y (drop k b) n)))).
  set (vb := fun n => nrm N (sub (ub n) (tg b)) + nrm N (tg b)).
  assert (Hd : forall n, nrm N (sub (ua n) (ub n)) <= (1 + nrm N h * vb n) * (/ c * (K * q n))).
  { intros n. unfold ua, ub. rewrite (Hu a Ha (fun j _ => eq_refl) n), (Hu b Hb Heq n). set (z := M (y (drop k a) n)). set (z' := M (y (drop k b) n)).
    pose proof (Hlow (drop k a) n Va) as Lz. fold z in Lz. pose proof (Hlow (drop k b) n Vb) as Lz'. fold z' in Lz'.
    assert (Hzz : nrm N (sub z z') <= K * q n).
    { unfold z, z', q. rewrite <- Msub. apply HM. apply V_sub; apply Hy; auto. }
    assert (Hub : nrm N (scl (/ dot N h z') z') <= vb n).
    { unfold vb, ub. rewrite (Hu b Hb Heq n). fold z'. set (w := scl (/ dot N h z') z').
      replace w with (add (sub w (tg b)) (tg b)) at 1 by (extensionality i; unfold add, sub; ring). apply nrm_add. }
    replace (sub (scl (/ dot N h z) z) (scl (/ dot N h z') z')) with
      (add (scl (/ dot N h z) (sub z z')) (scl (/ dot N h z * dot N h (sub z' z)) (scl (/ dot N h z') z'))).
    2: { rewrite dot_sub. extensionality i. unfold add, sub, scl. field. split; lra. }
    assert (Hi : 0 < / dot N h z <= / c) by (split; [apply Rinv_0_lt_compat; lra|apply Rinv_le_contravar; lra]).
    assert (Hq : 0 <= K * q n) by (apply Rmult_le_pos; [lra|apply nrm_ge0]).
    eapply Rle_trans; [apply nrm_add|]. rewrite !(nrm_scl N _ (sub z z')). rewrite (nrm_scl N (/ dot N h z * _)).
    rewrite Rmult_plus_distr_r, Rmult_1_l. apply Rplus_le_compat.
    - rewrite Rabs_pos_eq by lra. apply Rmult_le_compat; [lra|apply nrm_ge0|lra|exact Hzz].
    - rewrite Rabs_mult, (Rabs_pos_eq (/ dot N h z)) by lra.
      replace (nrm N h * vb n * (/ c * (K * q n))) with (/ c * (nrm N h * (K * q n)) * vb n) by ring.
      apply Rmult_le_compat; [apply Rmult_le_pos; [lra|apply Rabs_pos]|apply nrm_ge0| |exact Hub].
      apply Rmult_le_compat; [lra|apply Rabs_pos|lra|]. eapply Rle_trans; [apply Hh|]. apply Rmult_le_compat_l; auto.
      rewrite nrm_sub_sym. exact Hzz. }
  apply (is_lim_seq_le (fun _ => nrm N (sub (tg a) (tg b)))
    (fun n => nrm N (sub (unit_ray A rev ray P h start a (n + k) 0) (tg a)) + ((1 + nrm N h * vb n) * (/ c * (K * q n)) + nrm N (sub (unit_ray A rev ray P h start b (n + k) 0) (tg b))))
    (nrm N (sub (tg a) (tg b))) 0).
  - intros n. specialize (Hd n). unfold ua, ub in Hd. rewrite (Nat.add_comm n k).
    set (A1 := unit_ray A rev ray P h start a (k + n) 0) in *. set (B1 := unit_ray A rev ray P h start b (k + n) 0) in *.
    eapply Rle_trans; [apply (nrm_tri N _ A1)|]. rewrite (nrm_sub_sym N (tg a) A1). apply Rplus_le_compat_l.
    eapply Rle_trans; [apply (nrm_tri N _ B1)|]. lra.
  - apply is_lim_seq_const.
  - replace 0 with (0 + ((1 + nrm N h * (0 + nrm N (tg b))) * (/ c * (K * 0)) + 0)) by ring.
    apply is_lim_seq_plus'; [exact U1|]. apply is_lim_seq_plus'; [|exact U2]. apply is_lim_seq_mult'.
    + apply is_lim_seq_plus'; [apply is_lim_seq_const|]. apply (is_lim_seq_scal_l _ (nrm N h) (0 + nrm N (tg b))).
      apply is_lim_seq_plus'; [|apply is_lim_seq_const]. unfold ub.
      apply (is_lim_seq_ext (fun n => nrm N (sub (unit_ray A rev ray P h start b (n + k) 0) (tg b)))); [|exact U2].
      intros n. rewrite (Nat.add_comm n k). reflexivity.
    + apply (is_lim_seq_scal_l _ (/ c) (K * 0)). apply (is_lim_seq_scal_l _ K 0). exact L1.
Qed.

(** Theorem 6: where the joints of all states are smooth the curve is G¹. *)
Theorem arc_g1 : g1 A rev P start.
Proof.
  assert (Hjoint : forall a b k, adm A start a -> adm A start b -> joint_of A rev start k a b -> nrm N (sub (tg a) (tg b)) = 0).
  { intros a b k Ha Hb Hj. pose proof Hj as (Heq & Hbk & H1 & H2). apply (copies_agree a b k); auto.
    pose proof (proj2 (W_same A k start a b (fun _ => 0) Heq)) as Hf.
    assert (He : (f a k < states A)%nat) by (apply (f_ok A sys start a start_ok Ha)).
    assert (Hdeg : (S (a k) < deg A (f a k))%nat) by (rewrite Hf, <- Hbk; apply (Hb k)).
    destruct (smooth (f a k) (a k) He Hdeg) as (b1 & b2 & d & Hs & Hreg).
    assert (Dk : forall s, drop k s O = s k) by (intros; rewrite drop_nth, Nat.add_0_r; reflexivity).
    assert (Dt : forall s, tl (drop k s) = drop (S k) s).
    { intros s. extensionality j. unfold tl. rewrite !drop_nth. f_equal. lia. }
    apply (joint_ray A sys rev rays ray B kappa first last weight common (R (f a k)) (own (f a k)) (f a k) He (fun j => own_view _ j He) _ _ O).
    - apply adm_drop; auto.
    - rewrite Hf. apply adm_drop; auto.
    - split; [intros j Hj'; lia|]. simpl. rewrite !Dk, !Dt. split; [exact Hbk|]. rewrite Hf in H2 |- * at 1. rewrite Hf. split; [rewrite <- Hf; exact H1|exact H2].
    - exists b1, b2, d. simpl. rewrite Dk. split; [exact Hs|]. destruct b1, b2. exact Hreg. }
  exists (fun a => tg a).
  split; [intros a m; apply (no_point A sys rev rays ray B kappa first last weight common P h start start_ok view)|].
  split; [intros a; apply (tangents A sys rev rays ray B kappa first last weight common P h start start_ok view)|]. split.
  - intros eps Heps. apply (tangent_continuous A sys rev rays ray B kappa first last weight common P h start start_ok view eps Heps).
  - intros a b Ha Hb Hpt. destruct (first_difference a b) as [->|(k & Hk1 & Hk2)].
    + apply nrm_0. intros; unfold sub; ring.
    + assert (Hoj : forall a b, adm A start a -> adm A start b -> (forall j, (j < k)%nat -> a j = b j) -> (a k < b k)%nat ->
        act N P (phi A start a) = act N P (phi A start b) -> joint_of A rev start k a b).
      { intros; apply (only_joints A sys rev rays ray B kappa first last weight common P h start start_ok view); auto. }
      destruct (Nat.lt_ge_cases (a k) (b k)) as [Hlt|Hge].
      * apply (Hjoint a b k); auto.
      * rewrite nrm_sub_sym. apply (Hjoint b a k); auto. apply Hoj; auto; [intros; symmetry; auto|lia].
Qed.
End Smooth.
