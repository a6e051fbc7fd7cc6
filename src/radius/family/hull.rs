//! Hulls whose vertices move with the parameter, and their check on an interval.

use super::Pencil;
use crate::algebraic::Root;
use crate::arith::{Integer, Rational, to_f64};
use crate::linalg::Matrix;
use crate::ring::{Field, Model, Models, Ordered, Ring};
use nalgebra::DMatrix;

/// Binary places of the check.
const BITS: u64 = 88;

/// Where a family of vertices begins.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Seed {
    /// An eigenvector of the product along a word: a multiple of a column of the adjugate of `λ − T_w`, for an eigenvalue `λ` that
    /// each piece names.
    Eigen {
        /// The word.
        word: Vec<usize>,
        /// The column.
        column: usize,
        /// The factor.
        scale: Rational,
    },
    /// A multiple of a unit vector.
    Axis {
        /// The coordinate.
        index: usize,
        /// The factor.
        scale: Rational,
    },
}

/// The image `±T_u v` of a seed `v`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Vertex {
    /// The seed.
    pub seed: usize,
    /// The word `u`.
    pub word: Vec<usize>,
}

/// What an image of a vertex is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Image {
    /// By definition the vertex with this index.
    Vertex(usize),
    /// The multiple `λ` of the seed.
    Closing,
    /// A point inside.
    Inside,
}

/// The labels of a hull.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Hull {
    /// The seeds.
    pub seeds: Vec<Seed>,
    /// The vertices.
    pub vertices: Vec<Vertex>,
    /// By vertex and letter what the image is.
    pub images: Vec<Vec<Image>>,
}

/// A closed interval of parameters on which the premises of a hull were checked.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Piece {
    /// The lower end.
    pub from: Rational,
    /// The upper end.
    pub to: Rational,
    /// For every seed that is an eigenvector a line and a distance: `λ` lies within the third number of the first plus the second
    /// times `t`, where `t` goes from -1 to 1 along the interval.
    pub values: Vec<[Rational; 3]>,
    /// For every image inside, by vertex and letter, as many vertices as there are coordinates, of which it is a combination.
    pub bases: Vec<Vec<usize>>,
}

/// A hull and the pieces of an interval on which it was checked, one beside the other.
#[derive(Debug, Clone)]
pub struct Cover {
    /// The hull.
    pub hull: Hull,
    /// The pieces, ascending.
    pub pieces: Vec<Piece>,
}

impl Cover {
    /// The ends of the interval.
    #[must_use]
    pub fn range(&self) -> (&Rational, &Rational) {
        (&self.pieces[0].from, &self.pieces[self.pieces.len() - 1].to)
    }

    /// Whether a parameter lies in the interval.
    #[must_use]
    pub fn contains(&self, p: &Root) -> bool {
        let (lo, hi) = self.range();
        let order = |q: &Rational| crate::algebraic::cmp_real(&Root::from_rational(q), p);
        order(lo).is_le() && order(hi).is_ge()
    }
}

/// What moves with the parameter, on one piece.
pub(super) struct Moving {
    pub field: Models,
    letters: Vec<Matrix<Model>>,
}

impl Moving {
    pub fn new(pencil: &Pencil, mid: &Rational, half: &Rational) -> Self {
        let field = Models::new(BITS);
        let p = field.parameter(mid, half);
        Self { field, letters: pencil.on(&field, &p) }
    }

    fn product(&self, word: &[usize]) -> Option<Matrix<Model>> {
        let (first, rest) = word.split_first()?;
        Some(rest.iter().fold(self.letters[*first].clone(), |m, &l| m.mul_over(&self.field, &self.letters[l])))
    }

    pub fn apply(&self, letter: usize, v: &[Model]) -> Vec<Model> {
        apply(&self.field, &self.letters[letter], v)
    }

    /// The product along a word with its characteristic polynomial; `None` of the empty word.
    pub fn along(&self, word: &[usize]) -> Option<Along> {
        let product = self.product(word)?;
        let chi = product.char_poly_over(&self.field);
        Some(Along { product, chi })
    }
}

/// The product along a word on one piece.
pub(super) struct Along {
    product: Matrix<Model>,
    chi: Vec<Model>,
}

impl Along {
    /// `λ` on the piece: for every parameter there is an eigenvalue of the product along the word within it. `None` where that does
    /// not show: the characteristic polynomial must have different signs below and above.
    pub fn eigenvalue(&self, k: &Models, [mid, slope, rest]: &[Rational; 3]) -> Option<Model> {
        let line = |shift: Rational| k.linear(&(mid + shift), slope, &Rational::from(0));
        let value = |x: &Model| self.chi.iter().rev().fold(k.zero(), |v, c| k.add(&k.mul(&v, x), c));
        let signs = [k.sign(&value(&line(-rest)))?, k.sign(&value(&line(rest.clone())))?];
        (*rest > 0 && signs[0] * signs[1] < 0).then(|| k.linear(mid, slope, rest))
    }

    /// The column of the adjugate of `λ − T_w`.
    pub fn eigenvector(&self, k: &Models, column: usize, value: &Model) -> Vec<Model> {
        self.product.adjugate_column_over(k, &self.chi, column, value)
    }
}

fn apply(k: &Models, m: &Matrix<Model>, v: &[Model]) -> Vec<Model> {
    let dot = |row: &[Model]| row.iter().zip(v).fold(k.zero(), |s, (a, b)| k.add(&s, &k.mul(a, b)));
    (0..m.rows()).map(|i| dot(m.row(i))).collect()
}

impl Hull {
    /// Whether the labels are what they say: vertices are different, an image that is a vertex has the letter before the word, and
    /// a closing image completes the word of its seed.
    #[must_use]
    pub fn is_labelled(&self, letters: usize) -> bool {
        let distinct = (0..self.vertices.len()).all(|k| !self.vertices[..k].contains(&self.vertices[k]));
        let of = |v: &Vertex, letter: usize| Vertex { seed: v.seed, word: [&[letter], v.word.as_slice()].concat() };
        let fits = |v: &Vertex, letter: usize, image: &Image| match image {
            Image::Inside => true,
            Image::Vertex(k) => self.vertices.get(*k) == Some(&of(v, letter)),
            // The eigenvector must be a vertex itself.
            Image::Closing => {
                let seed = Vertex { seed: v.seed, word: Vec::new() };
                let closes = matches!(&self.seeds[v.seed], Seed::Eigen { word, .. } if *word == of(v, letter).word);
                closes && self.vertices.contains(&seed)
            }
        };
        let known = self.vertices.iter().all(|v| v.seed < self.seeds.len());
        let images = self.vertices.iter().zip(&self.images);
        known
            && distinct
            && self.images.len() == self.vertices.len()
            && images.into_iter().all(|(v, row)| {
                row.len() == letters && row.iter().enumerate().all(|(letter, image)| fits(v, letter, image))
            })
    }

    /// The words of the seeds that are eigenvectors.
    pub fn words(&self) -> impl Iterator<Item = &[usize]> {
        self.seeds.iter().filter_map(|s| match s {
            Seed::Eigen { word, .. } => Some(word.as_slice()),
            Seed::Axis { .. } => None,
        })
    }

    /// The products along the words of the seeds that are eigenvectors.
    pub(super) fn along(&self, moving: &Moving) -> Option<Vec<Along>> {
        self.words().map(|w| moving.along(w)).collect()
    }

    /// The seeds on a piece.
    pub(super) fn starts(&self, moving: &Moving, along: &[Along], values: &[[Rational; 3]]) -> Option<Vec<Vec<Model>>> {
        let k = &moving.field;
        let mut lines = along.iter().zip(values);
        let start = |seed: &Seed| match seed {
            Seed::Eigen { column, scale, .. } => {
                let (along, line) = lines.next()?;
                let value = along.eigenvalue(k, line)?;
                let v = along.eigenvector(k, *column, &value);
                Some(v.iter().map(|x| k.mul(x, &k.rational(scale))).collect())
            }
            Seed::Axis { index, scale } => {
                let unit = |i: usize| if i == *index { k.rational(scale) } else { k.zero() };
                Some((0..moving.letters[0].rows()).map(unit).collect())
            }
        };
        self.seeds.iter().map(start).collect()
    }

    /// The images of the seeds that are the vertices: most of them are images of a vertex before.
    pub(super) fn spread<T: Clone>(&self, starts: &[T], apply: impl Fn(usize, &T) -> T) -> Vec<T> {
        let mut points: Vec<T> = Vec::new();
        for (k, v) in self.vertices.iter().enumerate() {
            let before = v.word.split_first().and_then(|(&letter, rest)| {
                let parent = self.vertices[..k].iter().position(|u| u.seed == v.seed && u.word == rest)?;
                Some(apply(letter, &points[parent]))
            });
            let whole = || v.word.iter().rev().fold(starts[v.seed].clone(), |x, &l| apply(l, &x));
            points.push(before.unwrap_or_else(whole));
        }
        points
    }

    /// Whether the premises hold on a piece: every image inside is a combination of vertices whose coefficients have a sum of
    /// moduli below 1. Then at each of its parameters at which the words of the seeds have spectral radius below 1, the joint
    /// spectral radius is below 1.
    ///
    /// # Cost
    /// An inverse of floats for every choice of vertices, and `O(n²)` models for every image.
    #[must_use]
    pub fn holds(&self, pencil: &Pencil, piece: &Piece) -> bool {
        let two = Rational::from(2);
        if piece.from >= piece.to || !self.is_labelled(pencil.letters()) || self.vertices.is_empty() {
            return false;
        }
        let (mid, half) = ((&piece.from + &piece.to) / &two, (&piece.to - &piece.from) / &two);
        let moving = Moving::new(pencil, &mid, &half);
        let starts = self.along(&moving).and_then(|along| self.starts(&moving, &along, &piece.values));
        starts.is_some_and(|starts| self.holds_from(&moving, &starts, piece))
    }

    /// The same for labels that are what they say, from the seeds on the piece.
    pub(super) fn holds_from(&self, moving: &Moving, starts: &[Vec<Model>], piece: &Piece) -> bool {
        let points = self.spread(starts, |letter, v| moving.apply(letter, v));
        let mut solvers: Vec<(Vec<usize>, Solver)> = Vec::new();
        let mut bases = piece.bases.iter();
        for (v, row) in self.images.iter().enumerate() {
            crate::stop::check();
            for (letter, image) in row.iter().enumerate() {
                if *image != Image::Inside {
                    continue;
                }
                let Some(basis) = bases.next() else { return false };
                let x = moving.apply(letter, &points[v]);
                let known = solvers.iter().position(|(b, _)| b == basis);
                let at = match known {
                    Some(at) => at,
                    None => match Solver::new(&moving.field, &points, basis) {
                        Some(solver) => {
                            solvers.push((basis.clone(), solver));
                            solvers.len() - 1
                        }
                        None => return false,
                    },
                };
                if !solvers[at].1.is_inside(&moving.field, &x) {
                    return false;
                }
            }
        }
        // A hull without an image inside spans all the same, or the argument is about a subspace.
        bases.next().is_none() && !solvers.is_empty()
    }
}

/// `B = [q_1 … q_n]` with a nearly inverse matrix `Y`: `Y B = 1 − E`.
struct Solver {
    near: Vec<Vec<Model>>,
    error: Vec<Vec<Model>>,
    /// A bound of the rows of `E`, in units.
    size: Integer,
}

impl Solver {
    /// `None` where the points are no basis on the whole piece, as far as this shows.
    fn new(k: &Models, points: &[Vec<Model>], basis: &[usize]) -> Option<Self> {
        let n = points.first()?.len();
        if basis.len() != n || basis.iter().any(|b| *b >= points.len()) {
            return None;
        }
        let floats = DMatrix::from_fn(n, n, |i, j| k.to_f64(&points[basis[j]][i]));
        let inverse = floats.try_inverse()?;
        let entry = |i: usize, j: usize| k.rational(&crate::radius::exact::grid(inverse[(i, j)]));
        let near: Vec<Vec<Model>> = (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect();
        let product = |i: usize, j: usize| {
            let column = &points[basis[j]];
            let sum = near[i].iter().zip(column).fold(k.zero(), |s, (a, b)| k.add(&s, &k.mul(a, b)));
            k.sub(&if i == j { k.one() } else { k.zero() }, &sum)
        };
        let error: Vec<Vec<Model>> = (0..n).map(|i| (0..n).map(|j| product(i, j)).collect()).collect();
        let row = |r: &Vec<Model>| r.iter().fold(Integer::from(0), |s, x| s + k.bound(x));
        let size = error.iter().map(row).fold(Integer::from(0), Integer::max);
        (size < k.unit()).then_some(Self { near, error, size })
    }

    /// Whether the coefficients `c` of a point have `Σ |c| < 1`: with `z = Y x`, `c = z + E z + …`.
    fn is_inside(&self, k: &Models, x: &[Model]) -> bool {
        let times = |rows: &[Vec<Model>], v: &[Model]| -> Vec<Model> {
            rows.iter().map(|r| r.iter().zip(v).fold(k.zero(), |s, (a, b)| k.add(&s, &k.mul(a, b)))).collect()
        };
        let z = times(&self.near, x);
        let first = times(&self.error, &z);
        let largest = z.iter().map(|c| k.bound(c)).fold(Integer::from(0), Integer::max);
        // The terms from E² z on: ε²/(1 − ε) times the largest coefficient.
        let square = Rational::from_integers(&self.size * &self.size, k.unit() * (k.unit() - &self.size));
        let rest = k.within(ceiling(&(square * Rational::from(largest))));
        let coefficient = |(z, f): (&Model, &Model)| k.add(&k.add(z, f), &rest);
        let size = |c: Model| match k.sign(&c) {
            Some(s) if s < 0 => k.neg(&c),
            Some(_) => c,
            None => Model { mid: k.bound(&c), ..k.zero() },
        };
        let sum = z.iter().zip(&first).map(coefficient).map(size).fold(k.zero(), |s, c| k.add(&s, &c));
        k.bound(&sum) < k.unit()
    }
}

fn ceiling(q: &Rational) -> Integer {
    malachite_base::num::arithmetic::traits::Ceiling::ceiling(q)
}

/// The middle values of vertices as floats.
pub(super) fn floats(k: &Models, points: &[Vec<Model>]) -> Vec<Vec<f64>> {
    let value = |x: &Model| to_f64(&Rational::from_integers(x.mid.clone(), k.unit()));
    points.iter().map(|q| q.iter().map(value).collect()).collect()
}
