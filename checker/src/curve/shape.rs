//! Shapes and what is computed from them: addresses, ends of curves, adjacency, relevant spaces, visible quotients.

use crate::base::{Checked, MAX_LETTERS, Matrix, Q, Whole, charge, need, some, spend};
use num_bigint::BigInt;

/// What a state stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A point.
    Vertex,
    /// A curve; its pieces are in the order of the parameter.
    Edge,
    /// A set without order.
    Set,
}

/// A piece `op · A_target` of a state.
#[derive(Debug, Clone)]
pub struct Piece<T = BigInt> {
    /// The state whose attractor is mapped.
    pub target: usize,
    /// The operator.
    pub op: Matrix<T>,
    /// Whether it runs against the parameter.
    pub reversed: bool,
    /// What it takes of the parameter, where the case says so.
    pub share: Option<Q>,
}

/// A state of the automaton.
#[derive(Debug)]
pub struct State<T = BigInt> {
    /// What it stands for.
    pub kind: Kind,
    /// Number of barycentric coordinates.
    pub dim: usize,
    /// Its pieces, by letter.
    pub pieces: Vec<Piece<T>>,
    /// The boundary operators at the start and at the finish: vertex and matrix.
    pub ends: [Option<(usize, Matrix<T>)>; 2],
}

/// An operator of a shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Op {
    /// Of a piece of a state.
    Piece(usize, usize),
    /// The boundary operator at an end of a state.
    End(usize, End),
    /// Of a side of a face.
    Side(usize, usize),
}

/// An automaton of operators with a start state and a map into the space where the shape is looked at.
#[derive(Debug)]
pub struct Shape<T = BigInt> {
    /// The states.
    pub states: Vec<State<T>>,
    /// The start.
    pub start: usize,
    /// Control points (one column each), or the identity.
    pub view: Matrix<T>,
    /// The states that can be reached, breadth first.
    pub reachable: Vec<usize>,
}

/// An eventually periodic address.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Address {
    /// Letters before the cycle.
    pub prefix: Vec<usize>,
    /// The repeated letters.
    pub cycle: Vec<usize>,
}

impl std::fmt::Display for Address {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let commas = self.prefix.iter().chain(&self.cycle).any(|i| *i > 9);
        let join =
            |w: &[usize]| w.iter().map(ToString::to_string).collect::<Vec<_>>().join(if commas { "," } else { "" });
        let between = if commas && !self.prefix.is_empty() { "," } else { "" };
        // A comma says that letters are not single digits.
        let behind = if commas && self.prefix.len() + self.cycle.len() == 1 { "," } else { "" };
        write!(f, "{}{between}({}{behind})", join(&self.prefix), join(&self.cycle))
    }
}

impl Address {
    /// Reads `01(10)` or `3,12(0,4)`.
    pub fn parse(text: &str) -> Option<Self> {
        let body = text.trim().strip_suffix(')')?;
        let (prefix, cycle) = body.split_once('(')?;
        let commas = body.contains(',');
        let word = |part: &str| -> Option<Vec<usize>> {
            let part = part.trim().trim_end_matches(',');
            match (part.is_empty(), commas) {
                (true, _) => Some(Vec::new()),
                (_, true) => part.split(',').map(|s| s.trim().parse().ok()).collect(),
                _ => part.chars().map(|c| c.to_digit(10).map(|d| d as usize)).collect(),
            }
        };
        let (prefix, cycle) = (word(prefix)?, word(cycle)?);
        (!cycle.is_empty() && prefix.len() + cycle.len() <= MAX_LETTERS).then_some(Self { prefix, cycle })
    }

    /// The letter at a position of the infinite word.
    pub fn letter(&self, k: usize) -> usize {
        match self.prefix.get(k) {
            Some(letter) => *letter,
            None => self.cycle[(k - self.prefix.len()) % self.cycle.len()],
        }
    }

    /// The address whose sequence of (state, letter) pairs is written with the shortest prefix and the shortest period.
    pub fn normalise<T>(&self, shape: &Shape<T>, start: usize) -> Option<Self> {
        // After the prefix and one round of the cycle per state, the pairs repeat.
        let length = self.prefix.len() + self.cycle.len() * (shape.states.len() + 1);
        if length > 10 * MAX_LETTERS || !charge(10 * length, 0) {
            return None;
        }
        let mut pairs = Vec::new();
        let mut state = start;
        for k in 0..3 * length {
            let letter = self.letter(k);
            pairs.push((state, letter));
            state = shape.states[state].pieces.get(letter)?.target;
        }
        // The tail is twice as long as its shortest period can be, so that no shorter one passes by accident.
        let repeats = |from: usize, p: usize| (from..3 * length - p).all(|k| pairs[k] == pairs[k + p]);
        let period = (1..=length).find(|&p| repeats(length, p))?;
        let prefix = (0..=length).find(|&from| repeats(from, period))?;
        let letters = |range: std::ops::Range<usize>| pairs[range].iter().map(|p| p.1).collect();
        Some(Self { prefix: letters(0..prefix), cycle: letters(prefix..prefix + period) })
    }
}

/// An end of a curve; `Finish` is where its parameter ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum End {
    /// The start.
    Start,
    /// The finish.
    Finish,
}

impl End {
    /// The end of a piece that lies at this end of its state.
    pub fn in_piece<T>(self, piece: &Piece<T>) -> Self {
        match (self, piece.reversed) {
            (Self::Start, false) | (Self::Finish, true) => Self::Start,
            _ => Self::Finish,
        }
    }
}

impl<T: Whole> Shape<T> {
    /// A shape with these states.
    pub fn new(states: Vec<State<T>>, start: usize, view: Matrix<T>) -> Self {
        let (mut reachable, mut next) = (vec![start], 0);
        while next < reachable.len() {
            for piece in &states[reachable[next]].pieces {
                if !reachable.contains(&piece.target) {
                    reachable.push(piece.target);
                }
            }
            next += 1;
        }
        Self { states, start, view, reachable }
    }

    /// What can be reached from a state by at least one piece.
    pub fn below(&self, from: usize) -> Vec<usize> {
        let targets = |e: usize| self.states[e].pieces.iter().map(|p| p.target).collect::<Vec<_>>();
        let (mut found, mut open) = (Vec::new(), targets(from));
        while let Some(e) = open.pop() {
            if !found.contains(&e) {
                found.push(e);
                open.extend(targets(e));
            }
        }
        found
    }

    /// The pieces of all reachable states, with the state.
    pub fn pieces(&self) -> impl Iterator<Item = (usize, &Piece<T>)> {
        self.reachable.iter().flat_map(|&e| self.states[e].pieces.iter().map(move |p| (e, p)))
    }

    /// For each state a matrix without rows.
    pub fn no_rows(&self) -> Vec<Matrix<T>> {
        self.states.iter().map(|s| Matrix::empty(s.dim)).collect()
    }

    /// The states passed when a word is read.
    pub fn path(&self, from: usize, word: &[usize]) -> Checked<Vec<usize>> {
        let mut states = vec![from];
        for &letter in word {
            let piece = self.states[states[states.len() - 1]].pieces.get(letter);
            states.push(some(piece, "word", format_args!("letter {letter} of a word does not exist"))?.target);
        }
        Ok(states)
    }

    /// The product of the operators of a word and the state where it ends.
    pub fn product(&self, from: usize, word: &[usize]) -> Checked<(Matrix<T>, usize)> {
        let states = self.path(from, word)?;
        let mut product = Matrix::identity(self.states[from].dim);
        for (&e, &letter) in states.iter().zip(word) {
            product = product.times(&self.states[e].pieces[letter].op)?;
        }
        Ok((product, states[word.len()]))
    }

    /// `+1` or `-1`: the product of the orientations along a word.
    pub fn orientation(&self, from: usize, word: &[usize]) -> Checked<i32> {
        let states = self.path(from, word)?;
        Ok(word.iter().zip(&states).map(|(&i, &e)| if self.states[e].pieces[i].reversed { -1 } else { 1 }).product())
    }

    /// The product and the fixed point of a cycle, which must return to the state where it begins.
    pub fn cycle(&self, state: usize, word: &[usize]) -> Checked<(Matrix<T>, Matrix<T>)> {
        let (cycle, back) = self.product(state, word)?;
        need(back == state && !word.is_empty(), "word", "the cycle of an address does not return to its state")?;
        let fixed = some(cycle.fixed_point()?, "fixed-point", "a fixed point is not unique")?;
        Ok((cycle, fixed))
    }

    /// The point with an address.
    pub fn point(&self, from: usize, address: &Address) -> Checked<Matrix<T>> {
        let (prefix, state) = self.product(from, &address.prefix)?;
        prefix.times(&self.cycle(state, &address.cycle)?.1)
    }

    /// The address of an end of the curve of a state, through its outermost pieces for which `skip` is false.
    pub fn end_address(&self, state: usize, end: End, skip: &dyn Fn(usize, usize) -> bool) -> Option<Address> {
        let (mut seen, mut letters) = (Vec::new(), Vec::new());
        let (mut at, mut side) = (state, end);
        loop {
            if let Some(k) = seen.iter().position(|s| *s == (at, side)) {
                return Some(Address { prefix: letters[..k].to_vec(), cycle: letters[k..].to_vec() });
            }
            seen.push((at, side));
            let pieces = &self.states[at].pieces;
            let mut solid = (0..pieces.len()).filter(|&i| !skip(at, i));
            let letter = if side == End::Start { solid.next()? } else { solid.next_back()? };
            letters.push(letter);
            (at, side) = (pieces[letter].target, side.in_piece(&pieces[letter]));
        }
    }

    /// An end point of the curve of a state.
    pub fn end_point(&self, state: usize, end: End) -> Checked<Matrix<T>> {
        self.point(state, &some(self.end_address(state, end, &|_, _| false), "curve", "a state without pieces")?)
    }

    /// Rule `curve`: in every reachable edge state each piece begins where the one before ends, and the identities hold.
    pub fn check_curves(&self) -> Checked<()> {
        for &e in self.reachable.iter().filter(|&&e| self.states[e].kind == Kind::Edge) {
            for (j, pair) in self.states[e].pieces.windows(2).enumerate() {
                let end = |p: &Piece<T>, end: End| p.op.times(&self.end_point(p.target, end.in_piece(p))?);
                let meet = end(&pair[0], End::Finish)? == end(&pair[1], End::Start)?;
                need(meet, "curve", format_args!("pieces {j} and {} of state {e} do not meet", j + 1))?;
            }
            for [a, b, c, d] in self.identities(e)? {
                let holds = self.op(a)?.times(self.op(b)?)? == self.op(c)?.times(self.op(d)?)?;
                need(holds, "curve", format_args!("an identity of incidence or adjacency fails in state {e}"))?;
            }
        }
        Ok(())
    }

    /// The identities `a b = c d` of an edge state, where it has boundary operators: of incidence at the start and at the
    /// finish, then of adjacency.
    pub fn identities(&self, e: usize) -> Checked<Vec<[Op; 4]>> {
        let (pieces, mut all) = (&self.states[e].pieces, Vec::new());
        if self.states[e].kind != Kind::Edge {
            return Ok(all);
        }
        let own = |e: usize, end: End| Some((self.states[e].ends[end as usize].as_ref()?.0, Op::End(e, end)));
        let inner = |k: usize, end: End| own(pieces[k].target, end.in_piece(&pieces[k]));
        let why = "boundaries that should coincide are of different vertices";
        for (k, end) in [(0, End::Start), (pieces.len() - 1, End::Finish)] {
            let (Some((v, outside)), Some((w, inside))) = (own(e, end), inner(k, end)) else { continue };
            need(self.states[v].pieces[0].target == w, "curve", why)?;
            all.push([outside, Op::Piece(v, 0), Op::Piece(e, k), inside]);
        }
        for k in 1..pieces.len() {
            let ends = (inner(k - 1, End::Finish), inner(k, End::Start));
            let (Some((v, before)), Some((w, after))) = ends else { continue };
            need(v == w, "curve", why)?;
            all.push([Op::Piece(e, k - 1), before, Op::Piece(e, k), after]);
        }
        Ok(all)
    }

    /// The matrix of an operator.
    pub fn op(&self, op: Op) -> Checked<&Matrix<T>> {
        let found = match op {
            Op::Piece(state, letter) => self.states[state].pieces.get(letter).map(|p| &p.op),
            Op::End(state, end) => self.states[state].ends[end as usize].as_ref().map(|b| &b.1),
            Op::Side(..) => None,
        };
        some(found, "curve", "an operator that does not exist")
    }
}

/// The relevant space of a state and its visible quotient.
#[derive(Debug, Clone)]
pub struct Space<T = BigInt> {
    /// The point of the address that reads letter 0 for ever.
    pub base: Matrix<T>,
    /// A basis of `V_e` as columns; its transpose is in reduced echelon form.
    pub basis: Matrix<T>,
    /// The matrix that reads the coordinates of a vector of `V_e` in this basis.
    pub reading: Matrix<T>,
    /// Rows on coordinates of `V_e`, in reduced echelon form: coordinates of the visible quotient `W_e`.
    pub visible: Matrix<T>,
    /// The columns of their leading ones.
    pub leading: Vec<usize>,
    /// By letter, whether the piece is a single point.
    points: Vec<bool>,
}

/// The spaces of all reachable states.
pub struct Spaces<T = BigInt>(Vec<Option<Space<T>>>);

impl<T: Whole> Spaces<T> {
    /// The space of a reachable state.
    pub fn of(&self, state: usize) -> Checked<&Space<T>> {
        some(self.0.get(state).and_then(Option::as_ref), "word", "a state that cannot be reached")
    }

    /// Computes base points, relevant spaces by closure, and visible quotients (theory §3 and §9).
    pub fn new(shape: &Shape<T>) -> Checked<Self> {
        let (mut base, mut offsets, mut rows) = (shape.no_rows(), shape.no_rows(), shape.no_rows());
        for &e in &shape.reachable {
            let zero = Address { prefix: Vec::new(), cycle: vec![0] };
            base[e] = shape.point(e, &some(zero.normalise(shape, e), "word", "a state without pieces")?)?;
        }
        for (e, piece) in shape.pieces() {
            let offset = piece.op.times(&base[piece.target])?.minus(&base[e]);
            offsets[e] = offsets[e].stack(&offset.transpose());
        }
        let spans = close(shape, offsets, Way::Up, |_, p, span| span.times(&p.op.transpose()))?;
        rows[shape.start] = shape.view.clone();
        let rows = close(shape, rows, Way::Down, |_, p, row| row.times(&p.op))?;
        let mut spaces = vec![None; shape.states.len()];
        for &e in &shape.reachable {
            let (basis, pivots) = spans[e].echelon()?;
            let (basis, reading) = (basis.transpose(), Matrix::ones(pivots.len(), basis.cols, |i, j| pivots[i] == j));
            let (visible, leading) = rows[e].times(&basis)?.echelon()?;
            let is_point = |p: &Piece<T>| Ok(p.op.times(&spans[p.target].transpose())?.is_zero());
            let points = shape.states[e].pieces.iter().map(is_point).collect::<Checked<_>>()?;
            spaces[e] = Some(Space { base: base[e].clone(), basis, reading, visible, leading, points });
        }
        Ok(Self(spaces))
    }

    /// The linear part of an operator from the space of `from` to that of `to`, in the coordinates of the bases.
    pub fn linear(&self, op: &Matrix<T>, to: usize, from: usize) -> Checked<Matrix<T>> {
        self.of(to)?.reading.times(&op.times(&self.of(from)?.basis)?)
    }

    /// Whether a piece of a reachable state is a single point.
    pub fn is_point(&self, state: usize, letter: usize) -> Checked<bool> {
        some(self.of(state)?.points.get(letter).copied(), "word", "a letter that does not exist")
    }

    /// The pieces of a reachable state that are more than a point, ascending.
    pub fn solid(&self, state: usize) -> Checked<Vec<usize>> {
        let points = &self.of(state)?.points;
        Ok((0..points.len()).filter(|&k| !points[k]).collect())
    }

    /// The map between visible quotients that a piece of a state induces.
    pub fn on_visible(&self, state: usize, piece: &Piece<T>) -> Checked<Matrix<T>> {
        let (own, target) = (self.of(state)?, self.of(piece.target)?);
        let onto = own.visible.times(&self.linear(&piece.op, state, piece.target)?)?;
        // Rows of `onto` are combinations of the echelon rows of the target; the leading columns give the coefficients.
        let on_quotient = onto.columns(&target.leading);
        let acts = on_quotient.times(&target.visible)? == onto;
        need(acts, "visible", "an operator does not act on the visible quotients")?;
        Ok(on_quotient)
    }
}

/// Which way a family of spaces is carried along a piece.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// From the target of the piece to its state.
    Up,
    /// From its state to the target.
    Down,
}

/// The smallest family of row spaces (one for each reachable state, in echelon form) that holds a given one and the images of
/// its members, which `image` computes for a state, one of its pieces and the space that is carried.
pub fn close<T: Whole>(
    shape: &Shape<T>,
    mut family: Vec<Matrix<T>>,
    way: Way,
    image: impl Fn(usize, &Piece<T>, &Matrix<T>) -> Checked<Matrix<T>>,
) -> Checked<Vec<Matrix<T>>> {
    for &e in &shape.reachable {
        family[e] = family[e].echelon()?.0;
    }
    let mut grown = true;
    while std::mem::take(&mut grown) {
        for (e, piece) in shape.pieces() {
            spend(1, 0)?;
            let (from, to) = if way == Way::Up { (piece.target, e) } else { (e, piece.target) };
            if let Some((joined, _)) = family[to].joined(&image(e, piece, &family[from])?)? {
                (family[to], grown) = (joined, true);
            }
        }
    }
    Ok(family)
}
