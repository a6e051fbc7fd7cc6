//! Trees of words: contraction codes, and covers of a ring by cells on which a functional keeps its sign (theory §1, §7).

use crate::germ::{Germ, Position};
use crate::json::{Json, Node};
use crate::matrix::{Matrix, difference, dot};
use crate::number::{Q, spend, whole};
use crate::poly::{Field, Interval, Poly};
use crate::shape::{Shape, Spaces};
use crate::{Rejected, at, reject};
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

/// Integers over a common denominator.
struct Scaled {
    numerators: Vec<BigInt>,
    denominator: BigInt,
}

impl Scaled {
    fn new(numbers: &[Q]) -> Self {
        let denominator = numbers.iter().fold(BigInt::one(), |l, x| l.lcm(x.denom()));
        let numerators = numbers.iter().map(|x| x.numer() * (&denominator / x.denom())).collect();
        Self { numerators, denominator }
    }

    /// The identity as rows over the denominator 1.
    fn identity(n: usize) -> Vec<Self> {
        let row = |i: usize| (0..n).map(|j| BigInt::from(u8::from(i == j))).collect();
        (0..n).map(|i| Self { numerators: row(i), denominator: BigInt::one() }).collect()
    }

    /// The scalar product with a column of integers over a denominator.
    fn at(&self, column: &[BigInt], denominator: &BigInt) -> Q {
        let sum: BigInt = self.numerators.iter().zip(column).map(|(a, b)| a * b).sum();
        Q::new(sum, &self.denominator * denominator)
    }

    fn bits(&self) -> u64 {
        self.numerators.iter().map(BigInt::bits).max().unwrap_or(0)
    }
}

/// A shape with all that holds for its states, once contraction is proved.
pub struct Model<'a> {
    /// The shape.
    pub shape: &'a Shape,
    /// Its reachable states, breadth first.
    pub reachable: Vec<usize>,
    /// Their spaces.
    pub spaces: Spaces,
    radius: Vec<Q>,
    hulls: Vec<Scaled>,
    operators: Vec<Vec<Scaled>>,
    bases: Vec<Scaled>,
}

/// The largest `½ Σ_k |t_ki − t_kj|`: the norm of an operator, given by its rows, on zero-sum vectors.
fn dobrushin(rows: &[Scaled]) -> Q {
    let columns = rows.first().map_or(0, |r| r.numerators.len());
    let distance =
        |i: usize, j: usize| rows.iter().map(|r| (&r.numerators[i] - &r.numerators[j]).abs()).sum::<BigInt>();
    let pairs = (0..columns).flat_map(|i| (0..i).map(move |j| (i, j)));
    match (pairs.map(|(i, j)| distance(i, j)).max(), rows.first()) {
        (Some(largest), Some(row)) => Q::new(largest, &row.denominator * 2),
        _ => Q::zero(),
    }
}

fn norm(v: &[Q]) -> Q {
    v.iter().map(Signed::abs).sum()
}

/// `max − min`.
fn oscillation(row: &[Q]) -> Q {
    match (row.iter().max(), row.iter().min()) {
        (Some(hi), Some(lo)) => hi - lo,
        _ => Q::zero(),
    }
}

/// A row on the points of the germ's state that vanishes at its fixed point, and by how much it may be wrong on its attractor.
pub struct Functional {
    row: Scaled,
    error: Q,
}

/// A cell of a cover.
pub struct Cell {
    /// On which side of the germ's point it lies.
    pub position: Position,
    /// The index of the functional.
    pub functional: usize,
    /// Its sign there.
    pub sign: i32,
}

impl<'a> Model<'a> {
    /// Rule `contraction`: for each reachable state a complete prefix code of words with `τ < 1` (Lemma 1), and a radius
    /// with `radius_e ≥ ‖T_w q − q_e‖ + τ(T_w) radius` for all its words, so that a ball around `q_e` holds the attractor.
    pub fn read(shape: &'a Shape, node: &Node<'_>) -> Result<Self, Rejected> {
        let reachable = shape.reachable();
        let spaces = at(&node.place, Spaces::new(shape, &reachable))?;
        let items = node.list()?;
        if items.len() != reachable.len() {
            return reject("contraction", &node.place, "one entry for each reachable state is needed, breadth first");
        }
        let mut radius = vec![Q::zero(); shape.states.len()];
        let mut codes = Vec::new();
        for (item, &e) in items.iter().zip(&reachable) {
            let [state, bound, code, hull] = item.fields(["state", "radius", "code", "hull"])?;
            if state.index(shape.states.len())? != e {
                return reject("contraction", &state.place, format!("state {e} is expected here"));
            }
            radius[e] = bound.rational()?;
            if !matches!(code.value, Json::List(_)) {
                return reject("contraction", &code.place, "the empty word does not contract");
            }
            codes.push((e, code, hull));
        }
        let per_state = |s: &crate::shape::State| s.pieces.iter().map(|p| Scaled::new(p.op.entries())).collect();
        let operators = shape.states.iter().map(per_state).collect();
        let base = |e: usize| Scaled::new(spaces.of(e).map_or(&[], |s| &s.base));
        let bases = (0..shape.states.len()).map(base).collect();
        let hulls = (0..shape.states.len()).map(|_| Scaled::new(&[])).collect();
        let mut model = Self { shape, reachable, spaces, radius, hulls, operators, bases };
        let mut vertices = vec![Vec::new(); shape.states.len()];
        for (e, code, hull) in &codes {
            at(&code.place, model.contracts(*e, *e, &Scaled::identity(shape.states[*e].dim), code.value))?;
            if !matches!(hull.value, Json::Null) {
                let [points, _] = hull.fields(["points", "images"])?;
                for point in points.list()? {
                    vertices[*e].push(point.vector(shape.states[*e].dim)?);
                }
                model.hulls[*e] = Scaled::new(&vertices[*e].concat());
            }
        }
        for (e, _, hull) in codes.iter().filter(|(_, _, hull)| !matches!(hull.value, Json::Null)) {
            at(&hull.place, model.hull_maps_into(*e, &vertices, hull))?;
        }
        Ok(model)
    }

    /// Rule `hull`: the image of each vertex of the target's hull under each piece is a convex combination of vertices, so
    /// that the hulls, mapped into themselves by a contracting system, hold the attractors.
    fn hull_maps_into(&self, e: usize, vertices: &[Vec<Vec<Q>>], hull: &Node<'_>) -> Result<(), Rejected> {
        let [_, images] = hull.fields(["points", "images"])?;
        let (images, pieces) = (images.list()?, &self.shape.states[e].pieces);
        if images.len() != pieces.len() || vertices[e].iter().any(|v| !v.iter().sum::<Q>().is_one()) {
            return reject("hull", "", "one list of images for each piece, and points of coordinate sum 1, are needed");
        }
        for (piece, of_piece) in pieces.iter().zip(&images) {
            let of_piece = of_piece.list()?;
            if of_piece.len() != vertices[piece.target].len() || of_piece.is_empty() {
                return reject("hull", "", "one image for each vertex of the target's hull is needed");
            }
            for (vertex, combination) in vertices[piece.target].iter().zip(&of_piece) {
                let mut rest = piece.op.apply(vertex)?;
                let mut total = Q::zero();
                for term in combination.list()? {
                    let [index, weight] = term.fields(["vertex", "weight"])?;
                    let (k, weight) = (index.index(vertices[e].len())?, weight.rational()?);
                    if !weight.is_positive() {
                        return reject("hull", &term.place, "weights are positive");
                    }
                    spend(rest.len(), crate::number::size(&rest) + crate::number::bits(&weight))?;
                    rest.iter_mut().zip(&vertices[e][k]).for_each(|(x, v)| *x -= &weight * v);
                    total += weight;
                }
                if !total.is_one() || rest.iter().any(|x| !x.is_zero()) {
                    return reject("hull", &combination.place, "the image is not this convex combination");
                }
            }
        }
        Ok(())
    }

    /// Checks a tree below a word from `from` to `end`, given by the rows of its product (over one denominator).
    fn contracts(&self, from: usize, end: usize, product: &[Scaled], tree: &Json) -> Result<(), Rejected> {
        match tree {
            Json::List(children) if children.len() == self.shape.states[end].pieces.len() => {
                for (letter, child) in children.iter().enumerate() {
                    let pushed =
                        product.iter().map(|row| self.pushed(row, end, letter)).collect::<Result<Vec<_>, _>>()?;
                    self.contracts(from, self.shape.states[end].pieces[letter].target, &pushed, child)?;
                }
                Ok(())
            }
            Json::Text(leaf) if leaf == "." => {
                let bits = product.iter().map(Scaled::bits).max().unwrap_or(0);
                spend(product.len() * self.shape.states[end].dim * self.shape.states[end].dim, bits)?;
                let tau = dobrushin(product);
                let image: Vec<Q> = product
                    .iter()
                    .map(|row| row.at(&self.bases[end].numerators, &self.bases[end].denominator))
                    .collect();
                let shift = difference(&image, &self.spaces.of(from)?.base);
                if tau >= Q::one() {
                    return reject("contraction", "", "a word of the code does not contract");
                }
                if norm(&shift) + tau * &self.radius[end] > self.radius[from] {
                    return reject("contraction", "", "the ball of this radius does not hold the image of a ball");
                }
                Ok(())
            }
            _ => reject("contraction", "", "a code is a tree with one child for each letter and \".\" at its leaves"),
        }
    }

    /// A functional on the germ's quotient, given over a number field, as a row on points.
    pub fn functional(&self, germ: &Germ, field: &Field, row: &[Poly]) -> Result<Functional, Rejected> {
        let mut middle = Vec::new();
        let mut error = Q::zero();
        for (k, entry) in row.iter().enumerate() {
            let values = field.enclose(entry)?;
            middle.push((&values.lo + &values.hi) / whole(2));
            // |chart_k (x − q)| is at most osc(chart_k) times the radius, because both points lie in the ball.
            error += (&values.hi - &values.lo) / whole(2) * oscillation(germ.chart.row(k)) * &self.radius[germ.state];
        }
        self.row(germ, &middle, error)
    }

    /// A rational functional on the germ's quotient.
    pub fn rational_functional(&self, germ: &Germ, row: &[Q]) -> Result<Functional, Rejected> {
        self.row(germ, row, Q::zero())
    }

    fn row(&self, germ: &Germ, on_quotient: &[Q], error: Q) -> Result<Functional, Rejected> {
        let row = Matrix::from_rows(on_quotient.len(), &[on_quotient.to_vec()]).times(&germ.chart)?;
        let at_fixed = dot(row.row(0), &germ.fixed)?;
        let row: Vec<Q> = row.row(0).iter().map(|x| x - &at_fixed).collect();
        Ok(Functional { row: Scaled::new(&row), error })
    }

    fn pushed(&self, row: &Scaled, state: usize, letter: usize) -> Result<Scaled, Rejected> {
        let (op, cols) = (&self.operators[state][letter], self.shape.states[state].pieces[letter].op.cols);
        spend(row.numerators.len() * cols, row.bits().max(op.bits()))?;
        let entry = |j: usize| row.numerators.iter().enumerate().map(|(i, x)| x * &op.numerators[i * cols + j]).sum();
        Ok(Scaled { numerators: (0..cols).map(entry).collect(), denominator: &row.denominator * &op.denominator })
    }

    /// A row moved into the cell of a word, and the state where the word ends.
    fn moved(&self, from: usize, row: &Functional, word: &[usize]) -> Result<(Functional, usize), Rejected> {
        let mut state = from;
        let mut moved = Scaled { numerators: row.row.numerators.clone(), denominator: row.row.denominator.clone() };
        for &letter in word {
            moved = self.pushed(&moved, state, letter)?;
            state = self.shape.states[state].pieces[letter].target;
        }
        Ok((Functional { row: moved, error: row.error.clone() }, state))
    }

    fn enclose(&self, row: &Scaled, error: &Q, state: usize) -> Result<Interval, Rejected> {
        let base = &self.bases[state];
        spend(4 * row.numerators.len(), row.bits().max(base.bits()))?;
        let centre = row.at(&base.numerators, &base.denominator);
        let spread = match (row.numerators.iter().max(), row.numerators.iter().min()) {
            (Some(hi), Some(lo)) => Q::new(hi - lo, &row.denominator * 2) * &self.radius[state] + error,
            _ => error.clone(),
        };
        let mut bound = Interval { lo: &centre - &spread, hi: centre + spread };
        let hull = &self.hulls[state];
        let mut values: Vec<BigInt> = Vec::new();
        for vertex in hull.numerators.chunks(row.numerators.len().max(1)) {
            spend(row.numerators.len(), row.bits().max(hull.bits()))?;
            values.push(row.numerators.iter().zip(vertex).map(|(a, b)| a * b).sum());
        }
        if let (Some(lo), Some(hi)) = (values.iter().min(), values.iter().max()) {
            let value = |x: &BigInt| Q::new(x.clone(), &row.denominator * &hull.denominator);
            bound.lo = bound.lo.max(value(lo) - error);
            bound.hi = bound.hi.min(value(hi) + error);
        }
        Ok(bound)
    }

    /// Rule `cover`: every piece of the ring that is seen is cut into cells on each of which one of the functionals has one
    /// strict sign. The pieces come in the order of the ring (of one part of it, where `part` is given); leaves are `"+0"`,
    /// `"-0"`, `"+1"`, ….
    pub fn cover(
        &self,
        germ: &Germ,
        functionals: &[Functional],
        part: Option<Position>,
        node: &Node<'_>,
    ) -> Result<Vec<Cell>, Rejected> {
        let items = node.list()?;
        let pieces: Vec<_> = germ.ring.iter().filter(|p| part.is_none_or(|part| p.position == part)).collect();
        if items.len() != pieces.len() {
            return reject("cover", &node.place, format!("{} pieces of the ring are seen here", pieces.len()));
        }
        let mut cells = Vec::new();
        for (item, piece) in items.iter().zip(pieces) {
            let [word, tree] = item.fields(["piece", "cells"])?;
            if word.word()? != piece.word {
                return reject(
                    "cover",
                    &word.place,
                    format!("the piece {:?} of the ring is expected here", piece.word),
                );
            }
            let rows = functionals.iter().map(|f| Ok(self.moved(germ.state, f, &piece.word)?.0));
            let rows = rows.collect::<Result<Vec<_>, Rejected>>()?;
            at(&tree.place, self.covers(&rows, piece.end, piece.position, tree.value, &mut cells))?;
        }
        Ok(cells)
    }

    fn covers(
        &self,
        rows: &[Functional],
        state: usize,
        position: Position,
        tree: &Json,
        cells: &mut Vec<Cell>,
    ) -> Result<(), Rejected> {
        match tree {
            Json::List(children) if children.len() == self.shape.states[state].pieces.len() => {
                for (letter, child) in children.iter().enumerate() {
                    let target = self.shape.states[state].pieces[letter].target;
                    let push = |f: &Functional| {
                        Ok(Functional { row: self.pushed(&f.row, state, letter)?, error: f.error.clone() })
                    };
                    let pushed = rows.iter().map(push).collect::<Result<Vec<_>, Rejected>>()?;
                    self.covers(&pushed, target, position, child, cells)?;
                }
                Ok(())
            }
            Json::Text(leaf) => {
                for (k, f) in rows.iter().enumerate() {
                    for (wanted, name) in [(1, "+"), (-1, "-")] {
                        if *leaf == format!("{name}{k}") {
                            if self.enclose(&f.row, &f.error, state)?.sign() != wanted {
                                return reject("cover", "", "a functional does not keep the sign of its cell");
                            }
                            cells.push(Cell { position, functional: k, sign: wanted });
                            return Ok(());
                        }
                    }
                }
                reject("cover", "", "a leaf is a sign and the index of a functional, such as \"+0\"")
            }
            _ => reject("cover", "", "cells form a tree with one child for each letter"),
        }
    }
}
