use super::Shape;
use crate::linalg::{Entry, Matrix, Products};
use std::fmt;
use thiserror::Error;

/// An eventually periodic address `prefix (cycle)^ω` (theory §1, §3).
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Address {
    /// Letters before the cycle.
    pub prefix: Vec<usize>,
    /// The repeated letters; not empty.
    pub cycle: Vec<usize>,
}

/// Why an address cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum AddressError {
    /// Not of the form `01(10)`.
    #[error(
        "`{0}` is not an address; write the letters and then the repeated ones in brackets, as in `0(1)` or `3,12(0,4)`"
    )]
    Malformed(String),
    /// A letter that the state does not have.
    #[error("letter {letter} at position {position} does not exist: state `{state}` has pieces 0 to {last}")]
    Letter {
        /// The letter.
        letter: usize,
        /// Its position, from 0.
        position: usize,
        /// The state in which it was read.
        state: String,
        /// The last letter of that state.
        last: usize,
    },
}

impl Address {
    /// The address `(cycle)^ω`.
    #[must_use]
    pub fn periodic(cycle: Vec<usize>) -> Self {
        Self { prefix: Vec::new(), cycle }
    }

    /// Reads `01(10)`: one digit a letter, or letters separated by commas.
    ///
    /// # Errors
    /// [`AddressError::Malformed`].
    pub fn parse(text: &str) -> Result<Self, AddressError> {
        let malformed = || AddressError::Malformed(text.to_owned());
        let body = text.trim().strip_suffix(')').ok_or_else(malformed)?;
        let (prefix, cycle) = body.split_once('(').ok_or_else(malformed)?;
        let commas = body.contains(',');
        let word = |part: &str| -> Option<Vec<usize>> {
            let part = part.trim().trim_end_matches(',');
            if part.is_empty() {
                return Some(Vec::new());
            }
            if commas {
                part.split(',').map(|s| s.trim().parse().ok()).collect()
            } else {
                part.chars().map(|c| c.to_digit(10).map(|d| d as usize)).collect()
            }
        };
        let (prefix, cycle) = (word(prefix).ok_or_else(malformed)?, word(cycle).ok_or_else(malformed)?);
        if cycle.is_empty() || prefix.len() + cycle.len() > 10_000 {
            return Err(malformed());
        }
        Ok(Self { prefix, cycle })
    }

    /// The same address, written so that the cycle returns to its own state: the cycle is a true loop of the
    /// automaton from `start`, as short as possible, and the prefix as short as possible.
    ///
    /// # Errors
    /// [`AddressError::Letter`] where a letter does not exist.
    pub fn normalise<E: Entry>(&self, shape: &Shape<E>, start: usize) -> Result<Self, AddressError> {
        let letter = |k: usize| {
            if k < self.prefix.len() { self.prefix[k] } else { self.cycle[(k - self.prefix.len()) % self.cycle.len()] }
        };
        let mut state = start;
        let mut seen: Vec<(usize, usize)> = Vec::new();
        let mut letters = Vec::new();
        let loop_start = loop {
            let k = letters.len();
            if k >= self.prefix.len() {
                let key = (state, (k - self.prefix.len()) % self.cycle.len());
                if let Some(at) = seen.iter().position(|s| *s == key) {
                    break self.prefix.len() + at;
                }
                seen.push(key);
            }
            let i = letter(k);
            let pieces = &shape.states[state].pieces;
            if i >= pieces.len() {
                let state = shape.states[state].name.clone();
                return Err(AddressError::Letter { letter: i, position: k, state, last: pieces.len() - 1 });
            }
            letters.push(i);
            state = pieces[i].target;
        };
        let states = shape.path(start, &letters);
        let cycle = &letters[loop_start..];
        let period = (1..=cycle.len())
            .find(|&p| {
                cycle.len() % p == 0
                    && (0..cycle.len()).all(|k| {
                        cycle[k] == cycle[(k + p) % cycle.len()]
                            && states[loop_start + k] == states[loop_start + (k + p) % cycle.len()]
                    })
            })
            .map_or(cycle.len(), |p| p);
        let mut cycle = cycle[..period].to_vec();
        let mut prefix = letters[..loop_start].to_vec();
        // Fold trailing prefix letters into the cycle while both the letter and the state agree.
        while let Some(&last) = prefix.last() {
            let before = states[prefix.len() - 1];
            let in_cycle = states[prefix.len() - 1 + period];
            if last == cycle[period - 1] && before == in_cycle {
                prefix.pop();
                cycle.rotate_right(1);
            } else {
                break;
            }
        }
        Ok(Self { prefix, cycle })
    }
}

impl fmt::Display for Address {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let commas = self.prefix.iter().chain(&self.cycle).any(|&i| i > 9);
        if commas {
            let join = |w: &[usize]| w.iter().map(ToString::to_string).collect::<Vec<_>>().join(",");
            let sep = if self.prefix.is_empty() { "" } else { "," };
            let tail = if self.prefix.len() + self.cycle.len() == 1 { "," } else { "" };
            write!(f, "{}{sep}({}{tail})", join(&self.prefix), join(&self.cycle))
        } else {
            write!(f, "{}({})", word_text(&self.prefix), word_text(&self.cycle))
        }
    }
}

/// A word `u v^k`, `k ≥ 3`, as `u`, `v` and `k`: the `v` at the end for which the repetition is longest, and the shortest of
/// these.
#[must_use]
pub fn repetition(word: &[usize]) -> Option<(&[usize], &[usize], usize)> {
    let n = word.len();
    let periodic = |period: usize| (0..n - period).rev().take_while(|&k| word[k] == word[k + period]).count() + period;
    let best =
        (1..=n / 3).map(|period| (periodic(period), period)).max_by_key(|&(length, p)| (length / p * p, n - p))?;
    let (times, period) = (best.0 / best.1, best.1);
    (times >= 3).then(|| (&word[..n - times * period], &word[n - period..], times))
}

/// Longest word that is always written letter by letter.
const LONG: usize = 24;

/// A cell in words: long words that end in a repetition are written with a power, as in `0 1^2000`.
#[must_use]
pub fn cell_text(word: &[usize]) -> String {
    match repetition(word) {
        Some((head, cycle, times)) if word.len() > LONG && head.len() + cycle.len() < word.len() / 2 => {
            let cycle = if cycle.len() == 1 { word_text(cycle) } else { format!("({})", word_text(cycle)) };
            let head = if head.is_empty() { String::new() } else { format!("{} ", cell_text(head)) };
            format!("{head}{cycle}^{times}")
        }
        _ => word_text(word),
    }
}

/// A word written as one digit a letter, or with commas where a letter needs two digits.
#[must_use]
pub fn word_text(word: &[usize]) -> String {
    let sep = if word.iter().any(|&i| i > 9) { "," } else { "" };
    word.iter().map(ToString::to_string).collect::<Vec<_>>().join(sep)
}

/// Most short cycles of a state whose fixed points are computed.
const MAX_CYCLES: usize = 40;

impl<E: Entry> Shape<E> {
    /// The states passed when `word` is read from `start`: `word.len() + 1` of them.
    ///
    /// # Panics
    /// If a letter does not exist.
    #[must_use]
    pub fn path(&self, start: usize, word: &[usize]) -> Vec<usize> {
        let mut states = vec![start];
        for &i in word {
            let state = states[states.len() - 1];
            states.push(self.states[state].pieces[i].target);
        }
        states
    }

    /// The product `T_{w1} … T_{wk}` read from `start`, and the state where the word ends.
    ///
    /// # Panics
    /// If a letter does not exist.
    #[must_use]
    pub fn product(&self, start: usize, word: &[usize]) -> (Matrix<E>, usize) {
        let mut state = start;
        let mut product = Matrix::identity(self.states[start].dim);
        for &i in word {
            let piece = &self.states[state].pieces[i];
            product = &product * &piece.op;
            state = piece.target;
        }
        (product, state)
    }

    /// The operators of all pieces, by state and letter, for products of many words.
    #[must_use]
    pub fn scaled_operators(&self) -> Vec<Vec<E::Product>> {
        self.states.iter().map(|s| s.pieces.iter().map(|p| <E::Product>::of(&p.op)).collect()).collect()
    }

    /// The fixed points of the words of one and two letters that lead back to a state; none of those that are not unique.
    #[must_use]
    pub fn short_cycles(&self, state: usize) -> Vec<(Address, Vec<E>)> {
        let letters = |e: usize| 0..self.states[e].pieces.len();
        let target = |e: usize, i: usize| self.states[e].pieces[i].target;
        let one = letters(state).filter(|&i| target(state, i) == state).map(|i| vec![i]);
        let two = letters(state)
            .flat_map(|i| letters(target(state, i)).map(move |j| (i, j)))
            .filter(|&(i, j)| i != j && target(target(state, i), j) == state)
            .map(|(i, j)| vec![i, j]);
        let mut found = Vec::new();
        for word in one.chain(two).take(MAX_CYCLES) {
            let address = Address::periodic(word);
            if let Some(point) = self.point(state, &address) {
                found.push((address, point));
            }
        }
        found
    }

    /// The point with a normalised address: `T_prefix q` with `q` the fixed point of `T_cycle`.
    ///
    /// Returns `None` where the fixed point is not unique (the system does not contract).
    ///
    /// # Panics
    /// If a letter does not exist.
    #[must_use]
    pub fn point(&self, start: usize, address: &Address) -> Option<Vec<E>> {
        let (prefix, state) = self.product(start, &address.prefix);
        let (cycle, _) = self.product(state, &address.cycle);
        Some(prefix.apply(&fixed_point(&cycle)?))
    }
}

/// The unique fixed point with coordinate sum 1 of a square operator with column sums 1, if unique.
#[must_use]
pub fn fixed_point<E: Entry>(operator: &Matrix<E>) -> Option<Vec<E>> {
    let n = operator.rows();
    let kernel = (operator - &Matrix::identity(n)).kernel();
    if kernel.cols() != 1 {
        return None;
    }
    let v = kernel.column(0);
    let sum = E::sum(v.iter());
    v.iter().map(|x| x.over(&sum)).collect()
}
