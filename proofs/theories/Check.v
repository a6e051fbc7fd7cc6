(** Checkers: computations with rational numbers from which the hypotheses of the theorems follow. *)
From Coq Require Import Reals Lra Lia List QArith Qabs Qreals Bool FunctionalExtensionality.
From Coquelicot Require Import Coquelicot.
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

(** A computation that succeeds does not go on. *)
Lemma or_lazy (a b : bool) : (if a then true else b) = true <-> a = true \/ b = true.
Proof. destruct a; simpl; intuition discriminate. Qed.

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
  if Qle_bool t theta && Qle_bool (qnrm N (qsub N (qact N M (centre e)) (centre e0)) + t * radius e) (radius e0) then true else
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
  intros Hwf Hc. induction fuel as [|f IH]; intros e0 e M He0 He HM H s Hs; simpl in H; rewrite or_lazy in H;
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

(** The spaces of the differences of the attractors, as the vectors that a matrix does not change. *)
Section Spaces.
Variable spaces : list qmat.
Definition space_of e := nth e spaces [].
Definition in_space e (x : vec) := act N (qm (space_of e)) x = x.

Definition check_spaces : bool := forallb (fun e =>
  (length (space_of e) <=? N) && forallb (fun i => let d := dst A e i in
    qeqm N (qmul N (space_of e) (qmul N (mt e i) (space_of d))) (qmul N (mt e i) (space_of d)) &&
    let off := qsub N (qact N (mt e i) (centre d)) (centre e) in qeqv N (qact N (space_of e) off) off)
  (seq 0 (deg A e))) (seq 0 (states A)).

Lemma in_space_sub e x y : in_space e x -> in_space e y -> in_space e (sub x y).
Proof. unfold in_space. intros Hx Hy. rewrite act_sub, Hx, Hy. reflexivity. Qed.

Lemma in_space_add e x y : in_space e x -> in_space e y -> in_space e (add x y).
Proof. unfold in_space. intros Hx Hy. rewrite act_add, Hx, Hy. reflexivity. Qed.

Hypothesis form : check_form = true.
Hypothesis sys : contracting A.
Hypothesis based : forall e, (e < states A)%nat -> qbary N (dim A e) (centre e) = true.
Hypothesis spanned : check_spaces = true.

Lemma spaces_step e i : (e < states A)%nat -> (i < deg A e)%nat -> (length (space_of e) <= N)%nat /\
  (forall x, in_space (dst A e i) x -> in_space e (act N (mat A e i) x)) /\
  in_space e (sub (act N (mat A e i) (qv (centre (dst A e i)))) (qv (centre e))).
Proof.
  intros He Hi. destruct (check_form_ok form) as [Hwf Hlen]. pose proof (Hlen e i He Hi) as Hl.
  pose proof (forall_lt _ _ spanned e He) as H. cbv beta in H. rewrite andb_true_iff in H. destruct H as [H1 H2].
  apply Nat.leb_le in H1. pose proof (forall_lt _ _ H2 i Hi) as H3. cbv beta zeta in H3. rewrite andb_true_iff in H3.
  destruct H3 as [H3 H4]. split; [exact H1|]. split.
  - intros x Hx. unfold in_space in *. pose proof (qeqm_ok N _ _ x H3) as E. rewrite !qmul_ok, Hx in E by auto. exact E.
  - pose proof (qeqv_ok N _ _ H4) as E. rewrite qact_ok in E by auto.
    assert (Hd : (dst A e i < states A)%nat) by (apply (Hwf e He); auto).
    pose proof (qbary_len _ _ _ (based e He)). pose proof (qbary_len _ _ _ (based _ Hd)).
    pose proof (dim_ok A Hwf e He). rewrite qsub_ok in E; [|unfold qact; rewrite tab_length; auto|simpl in *; lia].
    rewrite qact_ok in E by auto. exact E.
Qed.

Lemma space_word w : forall e x, (e < states A)%nat -> admw A e w -> in_space (stw A e w) x -> in_space e (Ww A e w x).
Proof.
  induction w as [|i w IH]; simpl; intros e x He Hw Hx; auto. destruct Hw as [Hi Hw].
  apply (spaces_step e i He Hi). apply IH; auto. apply (wf A sys e He); auto.
Qed.

Theorem spaces_ok e s : (e < states A)%nat -> adm A e s -> in_space e (sub (phi A e s) (qv (centre e))).
Proof.
  assert (H : forall k e s, (e < states A)%nat -> adm A e s -> in_space e (sub (W A e s k (qv (centre (st A e s k)))) (qv (centre e)))).
  { induction k; simpl; intros f t Hf Ht.
    - replace (sub (qv (centre f)) (qv (centre f))) with (scl 0 (qv (centre f))) by (extensionality j; unfold sub, scl; ring).
      unfold in_space. rewrite act_scl. extensionality j; unfold scl; ring.
    - pose proof (Ht O) as Ht0. simpl in Ht0. destruct (spaces_step f (t O) Hf Ht0) as (_ & H1 & H2).
      pose proof (IHk (dst A f (t O)) (tl t) ltac:(apply (wf A sys f Hf); auto) (adm_tl A f t Ht)) as H3.
      apply H1 in H3. rewrite act_sub in H3. pose proof (in_space_add f _ _ H3 H2) as H4.
      match goal with |- in_space f ?y => replace y with
        (add (sub (act N (mat A f (t O)) (W A (dst A f (t O)) (tl t) k (qv (centre (st A (dst A f (t O)) (tl t) k)))))
                  (act N (mat A f (t O)) (qv (centre (dst A f (t O))))))
             (sub (act N (mat A f (t O)) (qv (centre (dst A f (t O))))) (qv (centre f))))
        by (extensionality j; unfold add, sub; simpl; ring) end. exact H4. }
  intros He Hs. set (x := fun k => sub (W A e s k (qv (centre (st A e s k)))) (qv (centre e))).
  assert (Hlim : forall i, is_lim_seq (fun k => x k i) (sub (phi A e s) (qv (centre e)) i)).
  { intros i. unfold x, sub. apply (is_lim_seq_minus' _ (fun _ => qv (centre e) i)); [|apply is_lim_seq_const].
    apply (phi_from A sys (fun e => qv (centre e))); auto. intros f Hf. apply qbary_ok. apply based; auto. }
  unfold in_space. extensionality i.
  assert (H1 : is_lim_seq (fun k => x k i) (act N (qm (space_of e)) (sub (phi A e s) (qv (centre e))) i)).
  { apply is_lim_seq_ext with (u := fun k => act N (qm (space_of e)) (x k) i); [intros k; exact (f_equal (fun v => v i) (H k e s He Hs))|].
    unfold act. apply (lim_sum N (fun k j => qm (space_of e) i j * x k j)). intros j Hj.
    apply (is_lim_seq_scal_l (fun k => x k j) (qm (space_of e) i j) (sub (phi A e s) (qv (centre e)) j)). apply Hlim. }
  pose proof (is_lim_seq_unique _ _ (Hlim i)) as E1. pose proof (is_lim_seq_unique _ _ H1) as E2.
  rewrite E1 in E2. injection E2; auto.
Qed.

Lemma differences e s t : (e < states A)%nat -> adm A e s -> adm A e t -> in_space e (sub (phi A e s) (phi A e t)).
Proof.
  intros He Hs Ht. pose proof (in_space_sub e _ _ (spaces_ok e s He Hs) (spaces_ok e t He Ht)) as H.
  match goal with |- in_space e ?y => replace y with (sub (sub (phi A e s) (qv (centre e))) (sub (phi A e t) (qv (centre e))))
    by (extensionality j; unfold sub; ring) end. exact H.
Qed.
End Spaces.

(** A functional on the addresses that do not begin with a word: above a number by a bound; below it; either of the two; or
    above it after the word and below it before the word, in the order of addresses. *)
Inductive mode := Above | Below | Apart | Sides.

Definition next (rest : option (list nat)) (i : nat) : option (list nat) :=
  match rest with Some (a :: r) => if a =? i then Some r else None | _ => None end.
Definition turned_to (m : mode) (rest : option (list nat)) (i : nat) : mode :=
  match m, rest with Sides, Some (a :: _) => if a <? i then Above else if i <? a then Below else Sides | _, _ => m end.

Definition check_cell (m : mode) (e : nat) (h : qvec) (mid low : Q) : bool :=
  let at_centre := (qdot N h (centre e) - mid)%Q in let r := (qosc (dim A e) h * radius e)%Q in
  let over := Qle_bool low (at_centre - r) in let under := Qle_bool (at_centre + r) (- low) in
  match m with Above => over | Below => under | Apart => over || under | Sides => false end.

Fixpoint check_far (fuel : nat) (m : mode) (rest : option (list nat)) (e : nat) (h : qvec) (mid low : Q) : bool :=
  match rest with Some [] => true | _ =>
    if check_cell m e h mid low then true else
    match fuel with
    | O => false
    | S f => forallb (fun i => check_far f (turned_to m rest i) (next rest i) (dst A e i) (qrow N h (mt e i)) mid low) (seq 0 (deg A e))
    end
  end.

(** The first letters agree with the word, then one is larger (smaller). *)
Definition follows (w : list nat) (s : address) := exists k, (k < length w)%nat /\ (forall j, (j < k)%nat -> s j = nth j w O) /\ (nth k w O < s k)%nat.
Definition precedes (w : list nat) (s : address) := exists k, (k < length w)%nat /\ (forall j, (j < k)%nat -> s j = nth j w O) /\ (s k < nth k w O)%nat.

Definition far (m : mode) (rest : option (list nat)) (s : address) (x low : R) : Prop :=
  (exists r, rest = Some r /\ begins r s) \/
  match m with
  | Above => low <= x | Below => x <= - low | Apart => low <= Rabs x
  | Sides => exists r, rest = Some r /\ ((follows r s /\ low <= x) \/ (precedes r s /\ x <= - low))
  end.

Lemma far_cons m rest s x low : far (turned_to m rest (s O)) (next rest (s O)) (tl s) x low -> far m rest s x low.
Proof.
  intros [(r & Hr & Hb)|H].
  - left. destruct rest as [[|a r']|]; simpl in Hr; try discriminate.
    destruct (Nat.eqb_spec a (s O)); [|discriminate]. injection Hr as <-. exists (a :: r'). split; auto. split; auto.
  - right. destruct m; simpl in H; auto. destruct rest as [[|a r]|]; simpl in H;
      try (destruct H as (r' & Hr & _); discriminate).
    exists (a :: r). split; auto. destruct (Nat.ltb_spec a (s O)); [|destruct (Nat.ltb_spec (s O) a)].
    + left. split; auto. exists O. simpl. split; [lia|]. split; [intros; lia|auto].
    + right. split; auto. exists O. simpl. split; [lia|]. split; [intros; lia|auto].
    + assert (Ea : a = s O) by lia. destruct H as (r' & Hr & H). destruct (Nat.eqb_spec a (s O)); [|discriminate]. injection Hr as <-.
      assert (Hs : forall k, (forall j, (j < k)%nat -> tl s j = nth j r O) -> forall j, (j < S k)%nat -> s j = nth j (a :: r) O).
      { intros k Hk [|j] Hj; [simpl; auto|]. apply (Hk j). lia. }
      destruct H as [[(k & K1 & K2 & K3) K4]|[(k & K1 & K2 & K3) K4]]; [left|right]; split; auto; exists (S k);
        (split; [simpl; lia|split; [apply Hs; auto|exact K3]]).
Qed.

Lemma check_far_ok fuel : contracting A -> in_balls -> (forall e, (e < states A)%nat -> bary N (dim A e) (qv (centre e))) ->
  forall m rest e h mid low, (e < states A)%nat -> check_far fuel m rest e h mid low = true -> forall s, adm A e s ->
  far m rest s (dot N (qv h) (phi A e s) - Q2R mid) (Q2R low).
Proof.
  intros Hsys Hball Hcb.
  assert (Hleaf : forall m rest e h mid low s, (e < states A)%nat -> adm A e s -> check_cell m e h mid low = true ->
    far m rest s (dot N (qv h) (phi A e s) - Q2R mid) (Q2R low)).
  { intros m rest e h mid low s He Hs H.
    pose proof (Hball e s He Hs) as Hb. pose proof (dim_ok A (wf A Hsys) e He) as Hd.
    pose proof (qosc_bound N (dim A e) h (sub (phi A e s) (qv (centre e))) (proj2 Hd)
      (bary_sub _ _ _ _ (phi_bary' A Hsys e s He Hs) (Hcb e He))) as Ho.
    rewrite dot_sub in Ho. pose proof (qosc_ge0 (dim A e) h).
    assert (Hr : Q2R (qosc (dim A e) h) * nrm N (sub (phi A e s) (qv (centre e))) <= Q2R (qosc (dim A e) h) * Q2R (radius e))
      by (apply Rmult_le_compat_l; auto).
    set (x := dot N (qv h) (phi A e s)) in *.
    pose proof (Rle_abs (x - dot N (qv h) (qv (centre e)))) as Ha1.
    pose proof (Rle_abs (- (x - dot N (qv h) (qv (centre e))))) as Ha2. rewrite Rabs_Ropp in Ha2.
    assert (Hover : Qle_bool low (qdot N h (centre e) - mid - qosc (dim A e) h * radius e) = true -> Q2R low <= x - Q2R mid).
    { intros Hq. apply Q2R_le in Hq. rewrite !Q2R_minus, Q2R_mult, qdot_ok in Hq. simpl in *. lra. }
    assert (Hunder : Qle_bool (qdot N h (centre e) - mid + qosc (dim A e) h * radius e) (- low) = true -> x - Q2R mid <= - Q2R low).
    { intros Hq. apply Q2R_le in Hq. rewrite Q2R_plus, Q2R_minus, Q2R_opp, Q2R_mult, qdot_ok in Hq. simpl in *. lra. }
    right. unfold check_cell in H. destruct m; auto; [|discriminate].
    rewrite orb_true_iff in H. destruct H as [H|H].
    - apply Hover in H. pose proof (Rle_abs (x - Q2R mid)). simpl in *. lra.
    - apply Hunder in H. pose proof (Rle_abs (- (x - Q2R mid))) as Ha3. rewrite Rabs_Ropp in Ha3. simpl in *. lra. }
  induction fuel as [|f IH]; intros m rest e h mid low He H s Hs; simpl in H.
  - destruct rest as [[|a r]|]; [left; exists []; simpl; auto| |]; rewrite or_lazy in H; (destruct H as [H|H]; [|discriminate]); apply Hleaf; auto.
  - assert (Hstep : rest = Some [] \/ check_cell m e h mid low = true \/
      forallb (fun i => check_far f (turned_to m rest i) (next rest i) (dst A e i) (qrow N h (mt e i)) mid low) (seq 0 (deg A e)) = true).
    { destruct rest as [[|a r]|]; auto; rewrite or_lazy in H; tauto. }
    destruct Hstep as [->|[H1|H1]]; [left; exists []; simpl; auto|apply Hleaf; auto|].
    pose proof (Hs O) as Hs0. simpl in Hs0. pose proof (forall_lt _ _ H1 (s O) Hs0) as H2. cbv beta in H2.
    assert (Hd : (dst A e (s O) < states A)%nat) by (apply (dst_ok A (wf A Hsys)); auto).
    apply far_cons. destruct Hsys as (Hwf & K & th & c & r & Q1 & Q2 & Q3 & Q4).
    rewrite (phi_step A Hwf K th c r Q1 Q4 e s He Hs).
    pose proof (IH _ _ _ _ _ _ Hd H2 (tl s) (adm_tl A e s Hs)) as H3. rewrite qrow_ok in H3. exact H3.
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

(** [M - sum_i (M v_i) g_i]. *)
Definition less (M : qmat) (l : list (qvec * qvec)) : qmat :=
  tab N (fun i => tab N (fun j => fold_right (fun gv x => Qred (x - qnth (snd gv) i * qnth (fst gv) j)) (qent M i j) l)).

Definition check_top (M : qmat) (t : top) (k : nat) (eta : Q) : bool :=
  (length M <=? N) && (0 <? k) && Qlt_bool eta (qpow k (Qabs (top_value t))) && Qle_bool 0 eta && negb (Qeq_bool (top_value t) 0) &&
  match t with
  | Simple lam g v =>
      (length v <=? N) && (length g <=? N) && qeqv N (qact N M v) (qscl N lam v) && qeqv N (qrow N g M) (qscl N lam g) &&
      Qeq_bool (qdot N g v) 1 && Qle_bool (qcolumn N (less (qmpow N k M) [(g, qact N (qmpow N k M) v)])) eta
  | Block lam g1 g2 v1 v2 =>
      (length v1 <=? N) && (length v2 <=? N) && (length g1 <=? N) && (length g2 <=? N) &&
      qeqv N (qact N M v1) (qscl N lam v1) && qeqv N (qact N M v2) (qadd N (qscl N lam v2) v1) &&
      qeqv N (qrow N g2 M) (qscl N lam g2) && qeqv N (qrow N g1 M) (qadd N (qscl N lam g1) g2) &&
      Qeq_bool (qdot N g1 v1) 1 && Qeq_bool (qdot N g1 v2) 0 && Qeq_bool (qdot N g2 v1) 0 && Qeq_bool (qdot N g2 v2) 1 &&
      Qle_bool (qcolumn N (less (qmpow N k M) [(g1, qact N (qmpow N k M) v1); (g2, qact N (qmpow N k M) v2)])) eta
  end.

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

(** Vectors with [N] coordinates. *)
Definition short (y : vec) := forall i, (N <= i)%nat -> y i = 0.

Lemma short_act M y : (length M <= N)%nat -> short (act N (qm M) y).
Proof. intros HM i Hi. unfold act. apply sum_0; intros. rewrite qm_short by lia. ring. Qed.

Lemma short_qv l : (length l <= N)%nat -> short (qv l).
Proof. intros Hl i Hi. apply qv_short. lia. Qed.

Theorem check_top_ok M t k eta : check_top M t k eta = true ->
  leads N short (act N (qm M)) (fun x => scl (dot N (qv (top_row t)) x) (qv (top_vector t))) (top_scale t).
Proof.
  intros H. unfold check_top in H. rewrite !andb_true_iff in H.
  destruct H as [[[[[HM H1] H2] H3] H4] H5]. apply Nat.leb_le in HM. apply Nat.ltb_lt in H1.
  apply Q2R_lt in H2. rewrite qpow_ok, Q2R_abs in H2. apply Q2R_le in H3. rewrite Q2R_0 in H3.
  assert (Hlam : Q2R (top_value t) <> 0).
  { intros H0. rewrite negb_true_iff in H4. assert (Hq : (top_value t == 0)%Q) by (apply eqR_Qeq; rewrite Q2R_0; auto).
    apply Qeq_bool_iff in Hq. congruence. }
  set (L := act N (qm M)).
  assert (Hb : forall x, short x -> nrm N (L x) <= (1 + size N (qm M)) * nrm N x).
  { intros x _. pose proof (nrm_act N (qm M) x). pose proof (nrm_ge0 N x). unfold L. lra. }
  assert (Hb1 : 1 <= 1 + size N (qm M)) by (pose proof (size_ge0 N (qm M)); lra).
  assert (Hadd : forall x y, short x -> short y -> short (add x y)).
  { intros x y Hx Hy i Hi. unfold add. rewrite Hx, Hy by auto. ring. }
  assert (Hscl : forall a x, short x -> short (scl a x)).
  { intros a x Hx i Hi. unfold scl. rewrite Hx by auto. ring. }
  assert (HLV : forall x, short x -> short (L x)) by (intros; apply short_act; auto).
  assert (Hgap : forall x l, short x -> (forall gv, In gv l -> dot N (qv (fst gv)) x = 0) ->
    Qle_bool (qcolumn N (less (qmpow N k M) l)) eta = true -> nrm N (Nat.iter k L x) <= Q2R eta * nrm N x).
  { intros x l Hx Hl Hq. apply Q2R_le in Hq. unfold L. rewrite <- qmpow_ok, <- (less_ok _ l) by (auto; apply qmpow_len).
    eapply Rle_trans; [apply qcolumn_ok|]. apply Rmult_le_compat_r; [apply nrm_ge0|auto]. }
  assert (Hrow : forall g h x, qeqv N (qrow N g M) h = true -> dot N (qv g) (L x) = dot N (qv h) x).
  { intros g h x Hq. apply qeqv_ok in Hq. unfold L. rewrite <- qrow_ok, Hq. reflexivity. }
  assert (Hdscl : forall a g x, (length g <= N)%nat -> dot N (qv (qscl N a g)) x = Q2R a * dot N (qv g) x).
  { intros a g x Hg. rewrite qscl_ok by auto. unfold dot, scl. rewrite <- sum_scal. apply sum_ext; intros; ring. }
  assert (Htab : forall (f : nat -> Q), (length (tab N f) <= N)%nat) by (intros; rewrite tab_length; auto).
  assert (Ladd : forall x y, L (add x y) = add (L x) (L y)) by (intros; apply act_add).
  assert (Lscl : forall a x, L (scl a x) = scl a (L x)) by (intros; apply act_scl).
  destruct t as [lam g v|lam g1 g2 v1 v2]; simpl in *; rewrite ?andb_true_iff in H5.
  - destruct H5 as [[[[[Hv Hg] Hvec] Hgr] Hgv] Hq]. apply Nat.leb_le in Hv, Hg.
    apply qeqv_ok in Hvec. rewrite qact_ok, qscl_ok in Hvec by auto. apply Q2R_eq in Hgv. rewrite qdot_ok, Q2R_1 in Hgv.
    apply (leads_simple N short L (1 + size N (qm M))) with (k := k) (eta := Q2R eta); auto.
    + apply short_qv; auto.
    + intros x Hx. rewrite (Hrow g (qscl N lam g)); auto.
    + intros x Hx Hgx. apply (Hgap x _ Hx) in Hq; auto. intros gv [<-|[]]; auto.
  - destruct H5 as [[[[[[[[[[[[Hv1 Hv2] Hg1] Hg2] Hvec1] Hvec2] Hgr2] Hgr1] H11] H12] H21] H22] Hq].
    apply Nat.leb_le in Hv1, Hv2, Hg1, Hg2. apply qeqv_ok in Hvec1, Hvec2.
    rewrite qact_ok, qscl_ok in Hvec1 by auto. rewrite qact_ok, qadd_ok, qscl_ok in Hvec2 by (auto; apply Htab).
    apply Q2R_eq in H11, H12, H21, H22. rewrite qdot_ok in H11, H12, H21, H22. rewrite Q2R_1 in H11, H22. rewrite Q2R_0 in H12, H21.
    apply (leads_block N short L (1 + size N (qm M))) with (g1 := qv g1) (v2 := qv v2) (k := k) (eta := Q2R eta); auto.
    + apply short_qv; auto.
    + apply short_qv; auto.
    + intros x Hx. rewrite (Hrow g2 (qscl N lam g2)); auto.
    + intros x Hx. rewrite (Hrow g1 (qadd N (qscl N lam g1) g2)); auto.
      rewrite qadd_ok by (auto; apply Htab). rewrite <- Hdscl by auto. unfold dot, add. rewrite <- sum_plus.
      apply sum_ext; intros; ring.
    + intros x Hx Hx1 Hx2. apply (Hgap x _ Hx) in Hq; auto. intros gv [<-|[<-|[]]]; auto.
Qed.

Lemma top_scale_pos t m : 0 < Q2R (top_value t) -> (1 <= m)%nat -> 0 < top_scale t m.
Proof.
  intros Hl Hm. destruct t; simpl in *.
  - apply pow_lt; auto.
  - unfold block_scale. apply Rdiv_lt_0_compat; auto. apply Rmult_lt_0_compat; [apply (lt_INR 0); lia|apply pow_lt; auto].
Qed.
End Check.
