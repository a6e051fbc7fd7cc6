(** Checkers: computations with rational numbers from which the hypotheses of the theorems follow. *)
From Coq Require Import Reals Lra Lia List QArith Qabs Qreals Bool FunctionalExtensionality.
From Secant Require Import Vec Automaton Leading Germ Rational.
Import ListNotations.
Open Scope R_scope.

(** A case: the number of coordinates that is enough for all states and for the control points, and for each state its
    dimension and its pieces, each a target and a matrix, row by row. *)
Record system := { ambient : nat; table : list (nat * list (nat * qmat)) }.

Definition pieces (S : system) (e : nat) := snd (nth e (table S) (O, [])).
Definition piece (S : system) (e i : nat) := nth i (pieces S e) (O, []).

Definition automaton_of (S : system) : automaton := {|
  N := ambient S;
  states := length (table S);
  dim := fun e => fst (nth e (table S) (O, []));
  deg := fun e => length (pieces S e);
  dst := fun e i => fst (piece S e i);
  mat := fun e i => qm (snd (piece S e i))
|}.

Section Check.
Variable case : system.
Notation A := (automaton_of case).
Notation N := (ambient case).
Notation mt e i := (snd (piece case e i)).

Definition check_form : bool :=
  forallb (fun e => (1 <=? dim A e) && (dim A e <=? N) && (0 <? deg A e) &&
    forallb (fun i => (dst A e i <? states A) && (length (mt e i) <=? dim A e) &&
      forallb (fun j => Qeq_bool (qsum N (fun k => qent (mt e i) k j)) 1) (seq 0 (dim A (dst A e i))))
      (seq 0 (deg A e))) (seq 0 (states A)).

Lemma check_form_ok : check_form = true -> well_formed A /\
  forall e i, (e < states A)%nat -> (i < deg A e)%nat -> (length (mt e i) <= N)%nat.
Proof.
  intros H.
  assert (H0 : forall e, (e < states A)%nat -> (1 <= dim A e <= N)%nat /\ (0 < deg A e)%nat /\ forall i, (i < deg A e)%nat ->
    (dst A e i < states A)%nat /\ (length (mt e i) <= dim A e)%nat /\
    forall j, (j < dim A (dst A e i))%nat -> Qeq_bool (qsum N (fun k => qent (mt e i) k j)) 1 = true).
  { intros e He. pose proof (forall_lt _ _ H e He) as H1. cbv beta in H1. rewrite !andb_true_iff in H1.
    destruct H1 as [[[H1 H2] H3] H4]. apply Nat.leb_le in H1, H2. apply Nat.ltb_lt in H3.
    split; [split; auto|]. split; auto. intros i Hi. pose proof (forall_lt _ _ H4 i Hi) as H5. cbv beta in H5.
    rewrite !andb_true_iff in H5. destruct H5 as [[H5 H6] H7]. apply Nat.ltb_lt in H5. apply Nat.leb_le in H6.
    split; auto. split; auto. intros j Hj. apply (forall_lt _ _ H7 j Hj). }
  split.
  - intros e He. destruct (H0 e He) as (H1 & H2 & H3). split; [exact H1|]. split; [exact H2|]. intros i Hi.
    destruct (H3 i Hi) as (H4 & H5 & H6). split; auto. split.
    + intros k j Hk. apply qm_short. lia.
    + intros j Hj. specialize (H6 j Hj). apply Q2R_eq in H6. rewrite qsum_ok, Q2R_1 in H6. exact H6.
  - intros e i He Hi. destruct (H0 e He) as (H1 & _ & H3). destruct (H3 i Hi) as (_ & H4 & _). simpl in *. lia.
Qed.

(** Lemma 1 and the balls: words are lengthened until they shrink enough, at most [fuel] times. *)
Section Contraction.
Variables (theta : Q) (centres : list qvec) (radii : list Q).
Definition centre e := nth e centres [].
Definition radius e := nth e radii 0%Q.

Fixpoint check_word (fuel e0 e : nat) (M : qmat) : bool :=
  let t := qtau N (dim A e) M in
  (Qle_bool t theta && Qle_bool (qnrm N (qsub N (qact N M (centre e)) (centre e0)) + t * radius e) (radius e0)) ||
  match fuel with
  | O => false
  | S f => forallb (fun i => check_word f e0 (dst A e i) (qmul N M (mt e i))) (seq 0 (deg A e))
  end.

Definition check_contraction (fuel : nat) : bool :=
  check_form && Qlt_bool theta 1 &&
  forallb (fun e => qbary N (dim A e) (centre e) && Qle_bool 0 (radius e) &&
    forallb (fun i => check_word fuel e (dst A e i) (mt e i)) (seq 0 (deg A e))) (seq 0 (states A)).

Lemma check_word_ok fuel : well_formed A -> (forall e, (e < states A)%nat -> (length (centre e) <= N)%nat) ->
  forall e0 e M, (e0 < states A)%nat -> (e < states A)%nat -> (length M <= N)%nat -> check_word fuel e0 e M = true ->
  forall s, adm A e s -> exists k t, (k <= fuel)%nat /\ 0 <= t <= Q2R theta /\
    (forall x, flat N (dim A (st A e s k)) x -> nrm N (act N (qm M) (W A e s k x)) <= t * nrm N x) /\
    nrm N (sub (act N (qm M) (W A e s k (qv (centre (st A e s k))))) (qv (centre e0))) + t * Q2R (radius (st A e s k))
      <= Q2R (radius e0).
Proof.
  intros Hwf Hc. induction fuel as [|f IH]; intros e0 e M He0 He HM H s Hs; simpl in H; rewrite orb_true_iff in H;
    (destruct H as [H|H]; [
      rewrite andb_true_iff in H; destruct H as [H1 H2]; exists O, (Q2R (qtau N (dim A e) M));
      split; [lia|]; split; [split; [apply qtau_ge0|apply Q2R_le; auto]|]; split;
      [intros x Hx; apply qtau_bound; auto; apply (dim_ok A Hwf e He)|
       apply Q2R_le in H2; rewrite Q2R_plus, Q2R_mult, qnrm_ok, qsub_ok, qact_ok in H2; auto;
       unfold qact; rewrite tab_length; auto]|]); [discriminate|].
  pose proof (Hs O) as Hs0. pose proof (forall_lt _ _ H (s O) Hs0) as H1. cbv beta in H1.
  destruct (Hwf e He) as (_ & _ & Hd). destruct (Hd (s O) Hs0) as (Hd1 & _).
  destruct (IH e0 (dst A e (s O)) (qmul N M (mt e (s O))) He0 Hd1) with (s := tl s) as (k & t & Hk & Ht & Hx & Hb); auto.
  - unfold qmul. rewrite tab_length. auto.
  - apply adm_tl; auto.
  - exists (S k), t. split; [lia|]. split; auto. split.
    + intros x Hx'. simpl. specialize (Hx x Hx'). rewrite qmul_ok in Hx by auto. exact Hx.
    + simpl. rewrite qmul_ok in Hb by auto. exact Hb.
Qed.

Definition in_balls := forall e s, (e < states A)%nat -> adm A e s ->
  nrm N (sub (phi A e s) (qv (centre e))) <= Q2R (radius e).

Theorem check_contraction_ok fuel : check_contraction fuel = true -> contracting A /\ in_balls.
Proof.
  unfold check_contraction. rewrite !andb_true_iff. intros [[H1 H2] H3].
  destruct (check_form_ok H1) as [Hwf Hlen].
  assert (H : forall e, (e < states A)%nat -> qbary N (dim A e) (centre e) = true /\ 0 <= Q2R (radius e) /\
    forall i, (i < deg A e)%nat -> check_word fuel e (dst A e i) (mt e i) = true).
  { intros e He. pose proof (forall_lt _ _ H3 e He) as H. cbv beta in H. rewrite !andb_true_iff in H.
    destruct H as [[H4 H5] H6]. split; auto. split; [apply Q2R_le in H5; rewrite Q2R_0 in H5; auto|].
    intros i Hi. apply (forall_lt _ _ H6 i Hi). }
  assert (Hth : Q2R theta < 1) by (apply Q2R_lt in H2; rewrite Q2R_1 in H2; auto).
  assert (Hcl : forall e, (e < states A)%nat -> (length (centre e) <= N)%nat).
  { intros e He. destruct (H e He) as (Hb & _). apply qbary_len in Hb. destruct (dim_ok A Hwf e He). simpl in *. lia. }
  assert (Hcode : code A (S fuel) (Rmax 0 (Q2R theta)) (fun e => qv (centre e)) (fun e => Q2R (radius e))).
  { intros e s He Hs. pose proof (Hs O) as Hs0. destruct (Hwf e He) as (_ & _ & Hd). destruct (Hd (s O) Hs0) as (Hd1 & _).
    destruct (H e He) as (_ & _ & Hw).
    destruct (check_word_ok fuel Hwf Hcl e (dst A e (s O)) (mt e (s O)) He Hd1 (Hlen e _ He Hs0) (Hw _ Hs0) (tl s))
      as (k & t & Hk & Ht & Hx & Hb); [apply adm_tl; auto|].
    exists (S k), t. split; [lia|]. split; [|split; auto].
    split; [lra|]. eapply Rle_trans; [apply Ht|apply Rmax_r]. }
  assert (Hm : 0 <= Rmax 0 (Q2R theta) < 1) by (split; [apply Rmax_l|apply Rmax_lub_lt; lra]).
  assert (Hcb : forall e, (e < states A)%nat -> bary N (dim A e) (qv (centre e))).
  { intros e He. apply qbary_ok. apply (H e He). }
  assert (Hr : forall e, (e < states A)%nat -> 0 <= Q2R (radius e)) by (intros e He; apply (H e He)).
  split.
  - split; auto. exists (S fuel), (Rmax 0 (Q2R theta)), (fun e => qv (centre e)), (fun e => Q2R (radius e)).
    split; [exact Hm|]. split; [exact Hr|]. split; [exact Hcb|exact Hcode].
  - intros e s He Hs.
    apply (ball A Hwf (S fuel) (Rmax 0 (Q2R theta)) (fun e => qv (centre e)) (fun e => Q2R (radius e))); auto.
Qed.

(** Lower bounds of a functional on the addresses that do not begin with a word. *)
Definition next (rest : option (list nat)) (i : nat) : option (list nat) :=
  match rest with Some (a :: r) => if a =? i then Some r else None | _ => None end.

Fixpoint check_ring (fuel : nat) (rest : option (list nat)) (e : nat) (h : qvec) (low : Q) : bool :=
  match rest with Some [] => true | _ =>
    Qle_bool low (qdot N h (centre e) - qosc (dim A e) h * radius e) ||
    match fuel with
    | O => false
    | S f => forallb (fun i => check_ring f (next rest i) (dst A e i) (qrow N h (mt e i)) low) (seq 0 (deg A e))
    end
  end.

Lemma check_ring_ok fuel : contracting A -> in_balls -> (forall e, (e < states A)%nat -> bary N (dim A e) (qv (centre e))) ->
  forall rest e h low, (e < states A)%nat -> check_ring fuel rest e h low = true -> forall s, adm A e s ->
  (exists r, rest = Some r /\ begins r s) \/ Q2R low <= dot N (qv h) (phi A e s).
Proof.
  intros Hsys Hball Hcb.
  assert (Hleaf : forall e h low s, (e < states A)%nat -> adm A e s ->
    Qle_bool low (qdot N h (centre e) - qosc (dim A e) h * radius e) = true -> Q2R low <= dot N (qv h) (phi A e s)).
  { intros e h low s He Hs H. apply Q2R_le in H. rewrite Q2R_minus, Q2R_mult, qdot_ok in H.
    pose proof (Hball e s He Hs) as Hb. pose proof (dim_ok A (wf A Hsys) e He) as Hd.
    pose proof (qosc_bound N (dim A e) h (sub (phi A e s) (qv (centre e))) (proj2 Hd)
      (bary_sub _ _ _ _ (phi_bary' A Hsys e s He Hs) (Hcb e He))) as Ho.
    rewrite dot_sub in Ho. pose proof (qosc_ge0 (dim A e) h).
    assert (Q2R (qosc (dim A e) h) * nrm N (sub (phi A e s) (qv (centre e))) <= Q2R (qosc (dim A e) h) * Q2R (radius e))
      by (apply Rmult_le_compat_l; auto).
    pose proof (Rle_abs (- (dot N (qv h) (phi A e s) - dot N (qv h) (qv (centre e))))) as Ha. rewrite Rabs_Ropp in Ha.
    simpl in *. lra. }
  induction fuel as [|f IH]; intros rest e h low He H s Hs.
  - destruct rest as [[|a r]|]; [left; exists []; simpl; auto| |];
      right; apply Hleaf; auto; simpl in H; rewrite orb_false_r in H; auto.
  - assert (Hstep : Qle_bool low (qdot N h (centre e) - qosc (dim A e) h * radius e) = true \/
      (forallb (fun i => check_ring f (next rest i) (dst A e i) (qrow N h (mt e i)) low) (seq 0 (deg A e)) = true)
      \/ rest = Some []).
    { destruct rest as [[|a r]|]; auto; simpl in H; rewrite orb_true_iff in H; tauto. }
    destruct Hstep as [H1|[H1|H1]]; [right; apply Hleaf; auto| |subst; left; exists []; simpl; auto].
    pose proof (Hs O) as Hs0. pose proof (forall_lt _ _ H1 (s O) Hs0) as H2. cbv beta in H2.
    assert (Hd : (dst A e (s O) < states A)%nat) by (apply (dst_ok A (wf A Hsys)); auto).
    destruct (IH (next rest (s O)) (dst A e (s O)) (qrow N h (mt e (s O))) low Hd H2 (tl s)) as [(r & Hr & Hb)|Hv];
      [apply adm_tl; auto| |].
    + left. destruct rest as [[|a r']|]; simpl in Hr; try discriminate.
      destruct (Nat.eqb_spec a (s O)); [|discriminate]. injection Hr as <-. exists (a :: r'). split; auto. split; auto.
    + right. rewrite qrow_ok in Hv.
      destruct Hsys as (Hwf & K & th & c & r & Q1 & Q2 & Q3 & Q4).
      rewrite (phi_step A Hwf K th c r Q1 Q4 e s He Hs). exact Hv.
Qed.
End Contraction.

(** Words. *)
Fixpoint qword (e : nat) (w : list nat) : qmat :=
  match w with [] => qid N | i :: w => qmul N (mt e i) (qword (dst A e i) w) end.
Fixpoint check_letters (e : nat) (w : list nat) : bool :=
  match w with [] => true | i :: w => (i <? deg A e) && check_letters (dst A e i) w end.

Lemma check_letters_ok w : forall e, check_letters e w = true -> admw A e w.
Proof.
  induction w as [|i w IH]; simpl; intros e H; auto. rewrite andb_true_iff in H. destruct H as [H1 H2].
  split; [apply Nat.ltb_lt in H1; exact H1|]. apply IH; auto.
Qed.

Lemma qword_len e w : (length (qword e w) <= N)%nat.
Proof. destruct w; simpl; [unfold qid|unfold qmul]; rewrite tab_length; auto. Qed.

Lemma qword_ok w : check_form = true -> forall e x, (e < states A)%nat -> admw A e w ->
  (forall i, (N <= i)%nat -> x i = 0) -> act N (qm (qword e w)) x = Ww A e w x.
Proof.
  intros Hf. destruct (check_form_ok Hf) as [Hwf Hlen].
  induction w as [|i w IH]; intros e x He Hw Hx; simpl.
  - apply qid_ok; auto.
  - destruct Hw as [Hi Hw]. rewrite qmul_ok by (apply Hlen; auto). rewrite IH; auto. apply (Hwf e He); auto.
Qed.

(** The top of the spectrum on the cycle: a simple eigenvalue, or a block of length 2. *)
Inductive top :=
  | Simple (lam : Q) (g v : qvec)
  | Block (lam : Q) (g1 g2 v1 v2 : qvec).
Definition top_value (t : top) := match t with Simple l _ _ | Block l _ _ _ _ => l end.
Definition top_row (t : top) := match t with Simple _ g _ => g | Block _ _ g2 _ _ => g2 end.
Definition top_vector (t : top) := match t with Simple _ _ v => v | Block _ _ _ v1 _ => v1 end.

(** [g M = a] on vectors of sum 0. *)
Definition eqrow (n : nat) (a b : qvec) : bool := Qeq_bool (qosc n (qsub N a b)) 0.
(** [M - sum_i (M v_i) g_i]. *)
Definition less (M : qmat) (l : list (qvec * qvec)) : qmat :=
  tab N (fun i => tab N (fun j => fold_right (fun gv x => Qred (x - qnth (snd gv) i * qnth (fst gv) j)) (qent M i j) l)).

Definition check_top (n : nat) (M : qmat) (t : top) (k : nat) (eta : Q) : bool :=
  (0 <? k) && Qlt_bool eta (qpow k (Qabs (top_value t))) && Qle_bool 0 eta && negb (Qeq_bool (top_value t) 0) &&
  match t with
  | Simple lam g v =>
      qflat N n v && (length g <=? N) && qeqv N (qact N M v) (qscl N lam v) && eqrow n (qrow N g M) (qscl N lam g) &&
      Qeq_bool (qdot N g v) 1 && Qle_bool (qtau N n (less (qmpow N k M) [(g, qact N (qmpow N k M) v)])) eta
  | Block lam g1 g2 v1 v2 =>
      qflat N n v1 && qflat N n v2 && (length g1 <=? N) && (length g2 <=? N) &&
      qeqv N (qact N M v1) (qscl N lam v1) && qeqv N (qact N M v2) (qadd N (qscl N lam v2) v1) &&
      eqrow n (qrow N g2 M) (qscl N lam g2) && eqrow n (qrow N g1 M) (qadd N (qscl N lam g1) g2) &&
      Qeq_bool (qdot N g1 v1) 1 && Qeq_bool (qdot N g1 v2) 0 && Qeq_bool (qdot N g2 v1) 0 && Qeq_bool (qdot N g2 v2) 1 &&
      Qle_bool (qtau N n (less (qmpow N k M) [(g1, qact N (qmpow N k M) v1); (g2, qact N (qmpow N k M) v2)])) eta
  end.

Lemma eqrow_ok n a b x : (n <= N)%nat -> (length a <= N)%nat -> (length b <= N)%nat -> eqrow n a b = true ->
  flat N n x -> dot N (qv a) x = dot N (qv b) x.
Proof.
  intros Hn Ha Hb H Hx. apply Q2R_eq in H. rewrite Q2R_0 in H.
  pose proof (qosc_bound N n (qsub N a b) x Hn Hx) as Ho. rewrite H, Rmult_0_l, qsub_ok in Ho by auto.
  assert (Hd : dot N (sub (qv a) (qv b)) x = dot N (qv a) x - dot N (qv b) x).
  { unfold dot, sub. rewrite <- sum_minus. apply sum_ext; intros; ring. }
  rewrite Hd in Ho. pose proof (Rabs_pos (dot N (qv a) x - dot N (qv b) x)).
  destruct (Req_dec (dot N (qv a) x - dot N (qv b) x) 0); [lra|]. apply Rabs_pos_lt in H1. lra.
Qed.

Lemma less_ok M l x : (length M <= N)%nat -> (forall gv, In gv l -> dot N (qv (fst gv)) x = 0) ->
  act N (qm (less M l)) x = act N (qm M) x.
Proof.
  intros HM Hl. extensionality i. unfold act. destruct (Nat.lt_ge_cases i N) as [Hi|Hi].
  - rewrite (sum_ext N _ (fun j => Q2R (fold_right (fun gv x => Qred (x - qnth (snd gv) i * qnth (fst gv) j)) (qent M i j) l) * x j)).
    + induction l as [|gv l IH]; [reflexivity|]. cbn [fold_right].
      rewrite (sum_ext N _ (fun j => Q2R (fold_right (fun gv x => Qred (x - qnth (snd gv) i * qnth (fst gv) j)) (qent M i j) l) * x j
        - Q2R (qnth (snd gv) i) * (qv (fst gv) j * x j))).
      * rewrite sum_minus, sum_scal. pose proof (Hl gv (or_introl eq_refl)) as H0. unfold dot in H0. rewrite H0, IH; [ring|].
        intros; apply Hl; right; auto.
      * intros j Hj. rewrite Q2R_red, Q2R_minus, Q2R_mult. unfold qv, qnth. ring.
    + intros j Hj. unfold qm, less. rewrite tab_nth. destruct (Nat.ltb_spec i N); [|lia]. rewrite tab_nth.
      destruct (Nat.ltb_spec j N); [|lia]. reflexivity.
  - rewrite !sum_0; auto; intros; rewrite qm_short; try lra; [lia|unfold less; rewrite tab_length; lia].
Qed.

Definition top_scale (t : top) : nat -> R :=
  match t with Simple lam _ _ => fun m => Q2R lam ^ m | Block lam _ _ _ _ => block_scale (Q2R lam) end.

Theorem check_top_ok n M t k eta L :
  (n <= N)%nat -> (length M <= N)%nat ->
  (forall x, (forall i, (N <= i)%nat -> x i = 0) -> act N (qm M) x = L x) ->
  (forall x y, L (add x y) = add (L x) (L y)) -> (forall a x, L (scl a x) = scl a (L x)) ->
  (forall x, flat N n x -> flat N n (L x)) ->
  check_top n M t k eta = true ->
  leads N (flat N n) L (fun x => scl (dot N (qv (top_row t)) x) (qv (top_vector t))) (top_scale t) /\
  flat N n (qv (top_vector t)).
Proof.
  intros Hn HM HL La Ls LV H. unfold check_top in H. rewrite !andb_true_iff in H.
  destruct H as [[[[H1 H2] H3] H4] H5]. apply Nat.ltb_lt in H1.
  apply Q2R_lt in H2. rewrite qpow_ok, Q2R_abs in H2. apply Q2R_le in H3. rewrite Q2R_0 in H3.
  assert (Hlam : Q2R (top_value t) <> 0).
  { intros H0. rewrite negb_true_iff in H4. assert (Hq : (top_value t == 0)%Q) by (apply eqR_Qeq; rewrite Q2R_0; auto).
    apply Qeq_bool_iff in Hq. congruence. }
  assert (Hb : forall x, flat N n x -> nrm N (L x) <= (1 + size N (qm M)) * nrm N x).
  { intros x [Hx _]. rewrite <- HL by (intros; apply Hx; lia). pose proof (nrm_act N (qm M) x). pose proof (nrm_ge0 N x). lra. }
  assert (Hb1 : 1 <= 1 + size N (qm M)) by (pose proof (size_ge0 N (qm M)); lra).
  assert (HLV : forall x, flat N n x -> act N (qm M) x = L x) by (intros x [Hx _]; apply HL; intros; apply Hx; lia).
  assert (Hpw : forall x, flat N n x -> act N (qm (qmpow N k M)) x = Nat.iter k L x).
  { intros x Hx. rewrite qmpow_ok; auto; [|intros; apply Hx; lia]. clear - HLV Hx LV.
    assert (H : Nat.iter k (act N (qm M)) x = Nat.iter k L x /\ flat N n (Nat.iter k L x)); [|apply H].
    induction k as [|k [IH1 IH2]]; simpl; auto. rewrite IH1. auto. }
  assert (Hgap : forall x l, flat N n x -> (forall gv, In gv l -> dot N (qv (fst gv)) x = 0) ->
    Qle_bool (qtau N n (less (qmpow N k M) l)) eta = true -> nrm N (Nat.iter k L x) <= Q2R eta * nrm N x).
  { intros x l Hx Hl Hq. apply Q2R_le in Hq. rewrite <- Hpw, <- (less_ok _ l) by (auto; apply qmpow_len).
    eapply Rle_trans; [apply (qtau_bound N n); auto|]. apply Rmult_le_compat_r; [apply nrm_ge0|auto]. }
  assert (Hrow : forall g h x, (length h <= N)%nat -> eqrow n (qrow N g M) h = true -> flat N n x ->
    dot N (qv g) (L x) = dot N (qv h) x).
  { intros g h x Hh Hq Hx. rewrite <- HLV, <- qrow_ok by auto. apply (eqrow_ok n); auto. unfold qrow. rewrite tab_length. auto. }
  assert (Hdscl : forall a g x, (length g <= N)%nat -> dot N (qv (qscl N a g)) x = Q2R a * dot N (qv g) x).
  { intros a g x Hg. rewrite qscl_ok by auto. unfold dot, scl. rewrite <- sum_scal. apply sum_ext; intros; ring. }
  assert (Htab : forall (f : nat -> Q), (length (tab N f) <= N)%nat) by (intros; rewrite tab_length; auto).
  destruct t as [lam g v|lam g1 g2 v1 v2]; simpl in *; rewrite ?andb_true_iff in H5.
  - destruct H5 as [[[[[Hv Hg] Hvec] Hgr] Hgv] Hq]. pose proof (qflat_len _ _ _ Hv) as Hvl. apply qflat_ok in Hv.
    apply Nat.leb_le in Hg. apply qeqv_ok in Hvec. rewrite qact_ok, HLV, qscl_ok in Hvec by (auto; lia).
    apply Q2R_eq in Hgv. rewrite qdot_ok, Q2R_1 in Hgv.
    split; auto. apply (leads_simple N (flat N n) L (1 + size N (qm M))) with (k := k) (eta := Q2R eta); auto.
    + intros; apply flat_add; auto.
    + intros; apply flat_scl; auto.
    + intros x Hx. rewrite (Hrow g (qscl N lam g)); auto. apply Htab.
    + intros x Hx Hgx. apply (Hgap x _ Hx) in Hq; auto. intros gv [<-|[]]; auto.
  - destruct H5 as [[[[[[[[[[[[Hv1 Hv2] Hg1] Hg2] Hvec1] Hvec2] Hgr2] Hgr1] H11] H12] H21] H22] Hq].
    pose proof (qflat_len _ _ _ Hv1) as Hl1. pose proof (qflat_len _ _ _ Hv2) as Hl2.
    apply qflat_ok in Hv1, Hv2. apply Nat.leb_le in Hg1, Hg2. apply qeqv_ok in Hvec1, Hvec2.
    rewrite qact_ok, HLV, qscl_ok in Hvec1 by (auto; lia).
    rewrite qact_ok, HLV, qadd_ok, qscl_ok in Hvec2 by (auto; try apply Htab; lia).
    apply Q2R_eq in H11, H12, H21, H22. rewrite qdot_ok in H11, H12, H21, H22. rewrite Q2R_1 in H11, H22. rewrite Q2R_0 in H12, H21.
    split; auto.
    apply (leads_block N (flat N n) L (1 + size N (qm M))) with (g1 := qv g1) (v2 := qv v2) (k := k) (eta := Q2R eta); auto.
    + intros; apply flat_add; auto.
    + intros; apply flat_scl; auto.
    + intros x Hx. rewrite (Hrow g2 (qscl N lam g2)); auto. apply Htab.
    + intros x Hx. rewrite (Hrow g1 (qadd N (qscl N lam g1) g2)); auto; [|apply Htab].
      rewrite qadd_ok by (auto; apply Htab). rewrite <- Hdscl by auto. unfold dot, add. rewrite <- sum_plus.
      apply sum_ext; intros; ring.
    + intros x Hx Hx1 Hx2. apply (Hgap x _ Hx) in Hq; auto. intros gv [<-|[<-|[]]]; auto.
Qed.

Lemma top_scale_pos n M t k eta : check_top n M t k eta = true -> 0 < Q2R (top_value t) ->
  exists m1, forall m c, (m1 <= m)%nat -> 0 < c -> 0 < top_scale t m * c.
Proof.
  intros _ Hl. exists 1%nat. intros m c Hm Hc. apply Rmult_lt_0_compat; auto. destruct t; simpl in *.
  - apply pow_lt; auto.
  - unfold block_scale. apply Rdiv_lt_0_compat; auto. apply Rmult_lt_0_compat; [apply (lt_INR 0); lia|apply pow_lt; auto].
Qed.
End Check.
