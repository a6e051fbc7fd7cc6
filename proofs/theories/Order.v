(** The order of addresses along a curve, where pieces may run backwards, and where the curve enters and leaves a piece. *)
From Coq Require Import Reals Lra Lia List Bool FunctionalExtensionality.
From Secant Require Import Vec Automaton Leading Germ.
Open Scope R_scope.

(** The sign of a piece, [-1] for one that runs backwards. *)
Definition orient (turned : bool) : R := if turned then -1 else 1.

Lemma orient_xorb a b : orient (xorb a b) = orient a * orient b.
Proof. destruct a, b; unfold orient; simpl; ring. Qed.

Section Order.
Variables (A : automaton) (rev : nat -> nat -> bool).

(** Whether the cell of the first [k] letters of an address runs backwards. *)
Fixpoint turned (e : nat) (s : address) (k : nat) : bool :=
  match k with O => false | S k => xorb (rev e (s O)) (turned (dst A e (s O)) (tl s) k) end.

(** The second address comes after the first on the curve: the first letter that differs decides, the other way round in a cell
    that runs backwards. *)
Definition ahead (e : nat) (s t : address) := exists k, (forall j, (j < k)%nat -> s j = t j) /\
  if turned e s k then (t k < s k)%nat else (s k < t k)%nat.

Lemma turned_same k : forall e s t, (forall j, (j < k)%nat -> s j = t j) -> turned e s k = turned e t k.
Proof.
  induction k; simpl; intros e s t H; auto. rewrite (H O) by lia. f_equal. apply IHk. intros j Hj. apply (H (S j)). lia.
Qed.

Lemma turned_plus k : forall e s m, turned e s (k + m) = xorb (turned e s k) (turned (st A e s k) (drop k s) m).
Proof. induction k; simpl; intros; [destruct (turned e s m); auto|]. rewrite IHk, xorb_assoc. reflexivity. Qed.

Lemma ahead_before e s t : (forall f i, rev f i = false) -> (ahead e s t <-> before s t).
Proof.
  intros H. assert (Hn : forall k f a, turned f a k = false) by (induction k; simpl; intros; auto; rewrite H, IHk; auto).
  unfold ahead, before. split; intros (k & H1 & H2); exists k; [rewrite Hn in H2|rewrite Hn]; auto.
Qed.
End Order.

(** Where the curve enters and leaves a piece, with the start and the end of each state. *)
Definition enters (A : automaton) (rev : nat -> nat -> bool) (first last : nat -> vec) (e i : nat) : vec :=
  act (N A) (mat A e i) (if rev e i then last (dst A e i) else first (dst A e i)).
Definition leaves (A : automaton) (rev : nat -> nat -> bool) (first last : nat -> vec) (e i : nat) : vec :=
  act (N A) (mat A e i) (if rev e i then first (dst A e i) else last (dst A e i)).
