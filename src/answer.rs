//! The three answers, alone ([`Verdict`]) and with what they rest on ([`Answer`]).
//!
//! Many answers together are one answer: refuted if one is refuted, proved if every one of those that there have to be is there
//! and proved. How many there have to be is said by the caller, so that one that got lost, or none at all, is no success.

use std::fmt;

/// The three answers, from the worst to the best.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Verdict {
    /// The claim fails, with a witness.
    Refuted,
    /// Not decided; the reason and the place are given.
    Undetermined,
    /// The claim holds, by a numbered statement whose hypotheses were decided exactly.
    Proved,
}

impl Verdict {
    /// All three, from the worst to the best.
    pub const ALL: [Self; 3] = [Self::Refuted, Self::Undetermined, Self::Proved];

    /// `proved`, `refuted` or `undetermined`.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Proved => "proved",
            Self::Refuted => "refuted",
            Self::Undetermined => "undetermined",
        }
    }

    /// The verdict of a word that [`Verdict::word`] gives; `None` for every other.
    #[must_use]
    pub fn of_word(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|v| v.word() == word)
    }

    /// The verdict on "both": refuted if one is refuted, proved if both are.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        self.min(other)
    }

    /// The verdict on all of `count` claims: refuted if one is refuted, proved if there are `count` of them, all proved.
    /// Of no claims it is undetermined.
    ///
    /// ```
    /// use secant::answer::Verdict::{self, Proved, Refuted, Undetermined};
    /// assert_eq!(Verdict::all(2, [Proved, Proved]), Proved);
    /// assert_eq!(Verdict::all(2, [Proved]), Undetermined);
    /// assert_eq!(Verdict::all(3, [Undetermined, Refuted]), Refuted);
    /// assert_eq!(Verdict::all(0, []), Undetermined);
    /// ```
    #[must_use]
    pub fn all(count: usize, verdicts: impl IntoIterator<Item = Self>) -> Self {
        let (mut seen, mut worst) = (0_usize, Self::Proved);
        for verdict in verdicts {
            seen += 1;
            worst = worst.and(verdict);
        }
        if count == 0 || seen != count { worst.and(Self::Undetermined) } else { worst }
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}

/// An answer with what it rests on: a proof, a refutation, or what is missing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Answer<P, R, G> {
    /// It holds, and this proves it.
    Proved(P),
    /// It fails, and this refutes it.
    Refuted(R),
    /// It is not decided, and this is missing.
    Open(G),
}

impl<P, R, G> Answer<P, R, G> {
    /// The answer without what it rests on.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        match self {
            Self::Proved(_) => Verdict::Proved,
            Self::Refuted(_) => Verdict::Refuted,
            Self::Open(_) => Verdict::Undetermined,
        }
    }

    /// The answer on "both": a refutation of one refutes both; otherwise what is missing of one is missing of both. Of two
    /// refutations, or of two gaps, it is that of `self`.
    #[must_use]
    pub fn and<Q>(self, other: Answer<Q, R, G>) -> Answer<(P, Q), R, G> {
        match (self, other) {
            (Self::Refuted(r), _) | (_, Answer::Refuted(r)) => Answer::Refuted(r),
            (Self::Open(g), _) | (_, Answer::Open(g)) => Answer::Open(g),
            (Self::Proved(p), Answer::Proved(q)) => Answer::Proved((p, q)),
        }
    }

    /// The answer on all of `count` answers, as [`Verdict::all`]: the first refutation, or else the first gap, or else
    /// `missing` where there are not exactly `count` of them or `count` is 0.
    ///
    /// ```
    /// use secant::answer::Answer;
    /// type A = Answer<u8, &'static str, &'static str>;
    /// assert_eq!(A::all(2, [A::Proved(1), A::Proved(2)], "lost"), Answer::Proved(vec![1, 2]));
    /// assert_eq!(A::all(2, [A::Proved(1)], "lost"), Answer::Open("lost"));
    /// assert_eq!(A::all(0, [], "lost"), Answer::Open("lost"));
    /// assert_eq!(A::all(3, [A::Open("gap"), A::Refuted("no")], "lost"), Answer::Refuted("no"));
    /// ```
    pub fn all(count: usize, answers: impl IntoIterator<Item = Self>, missing: G) -> Answer<Vec<P>, R, G> {
        let (mut proofs, mut gap) = (Vec::new(), None);
        for answer in answers {
            match answer {
                Self::Refuted(r) => return Answer::Refuted(r),
                Self::Open(g) => gap = gap.or(Some(g)),
                Self::Proved(p) => proofs.push(p),
            }
        }
        match gap {
            Some(gap) => Answer::Open(gap),
            None if count == 0 || proofs.len() != count => Answer::Open(missing),
            None => Answer::Proved(proofs),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    type Small = Answer<u8, u8, u8>;

    fn answers() -> [Small; 3] {
        [Answer::Refuted(1), Answer::Open(2), Answer::Proved(3)]
    }

    #[test]
    fn both_is_the_worse() {
        for a in answers() {
            for b in answers() {
                assert_eq!(a.and(b).verdict(), a.verdict().min(b.verdict()));
                assert_eq!(a.and(b).verdict(), Verdict::all(2, [a.verdict(), b.verdict()]));
                assert_eq!(Small::all(2, [a, b], 0).verdict(), a.and(b).verdict());
            }
        }
    }

    #[test]
    fn too_few_or_too_many_are_no_success() {
        for count in [0, 1, 3] {
            assert_eq!(Verdict::all(count, [Verdict::Proved; 2]), Verdict::Undetermined);
            assert_eq!(Small::all(count, [Answer::Proved(3); 2], 9), Answer::Open(9));
        }
        assert_eq!(Verdict::all(0, []), Verdict::Undetermined);
        assert_eq!(Verdict::all(5, [Verdict::Refuted]), Verdict::Refuted);
    }

    #[test]
    fn words_are_read_back() {
        assert!(Verdict::ALL.iter().all(|v| Verdict::of_word(v.word()) == Some(*v)));
        assert_eq!(Verdict::of_word("Proved"), None);
    }
}
