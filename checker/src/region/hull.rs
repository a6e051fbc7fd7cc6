//! Hulls whose vertices move with the parameter.

use super::model::{self, Model, characteristic, dot, image, product, unit};
use super::polynomial::{End, Poly};
use crate::base::{Checked, Matrix, Node, Q, need, some, whole};
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

/// Most vertices of a hull, and pieces of an interval.
const MAX_VERTICES: usize = 400;
const MAX_PIECES: usize = 4000;

/// An eigenvector of a word, or a unit vector where the word is empty.
struct Seed {
    word: Vec<usize>,
    column: usize,
    scale: Q,
}

/// A hull that was checked on an interval.
pub struct Hull {
    /// The ends of the interval.
    pub from: Q,
    pub to: Q,
    /// The words whose spectral radius must be below 1.
    pub words: Vec<Vec<usize>>,
}

/// What an image is.
enum Image {
    Known,
    Inside,
}

/// Reads and checks a hull for matrices (by letter, rows of polynomials).
pub fn check(letters: &[Vec<Vec<Poly>>], node: &Node<'_>) -> Checked<Hull> {
    let [seeds, vertices, from, pieces] = node.fields("seeds vertices from pieces")?;
    let n = letters[0].len();
    let letter = |word: &Node<'_>| -> Checked<Vec<usize>> {
        let letters = letters.len();
        let word_read = word.word()?;
        word.need(word_read.iter().all(|l| *l < letters), "word", "a letter that does not exist")?;
        Ok(word_read)
    };
    let read_seed = |item: &Node<'_>| {
        let [word, column, scale] = item.fields("word column scale")?;
        Ok(Seed { word: letter(&word)?, column: column.index(n)?, scale: scale.rational()? })
    };
    let seeds = seeds.each(read_seed)?;
    let mut labels: Vec<(usize, Vec<usize>)> = Vec::new();
    for item in vertices.list()? {
        let [seed, word] = item.fields("seed word")?;
        let label = (seed.index(seeds.len())?, letter(&word)?);
        let new = !labels.contains(&label) && labels.len() < MAX_VERTICES;
        item.need(new, "hull", "a vertex that is listed twice, or too many")?;
        labels.push(label);
    }
    node.need(!labels.is_empty(), "hull", "a hull has vertices")?;
    let images: Vec<Vec<Image>> =
        labels.iter().map(|l| (0..letters.len()).map(|i| kind(&seeds, &labels, l, i)).collect()).collect();
    let (start, list) = (from.rational()?, pieces.list()?);
    pieces.need((1..=MAX_PIECES).contains(&list.len()), "hull", "from 1 to 4000 pieces are needed")?;
    let mut at = start.clone();
    for item in list {
        let [to, values, bases] = item.fields("to values bases")?;
        let to = to.rational()?;
        item.need(at < to, "hull", "the pieces of the interval come one after the other")?;
        let moving = Moving::new(letters, &at, &to);
        let points = item.at(moving.points(&seeds, &labels, &values))?;
        moving.inside(&points, &images, &bases)?;
        at = to;
    }
    let words = seeds.into_iter().map(|s| s.word).filter(|w| !w.is_empty()).collect();
    Ok(Hull { from: start, to: at, words })
}

/// By labels alone: the image closes the word of its seed, which is a vertex itself, is a vertex, or has to lie inside.
fn kind(seeds: &[Seed], labels: &[(usize, Vec<usize>)], (seed, word): &(usize, Vec<usize>), letter: usize) -> Image {
    let next = (*seed, [&[letter], word.as_slice()].concat());
    let closes = seeds[*seed].word == next.1 && labels.contains(&(*seed, Vec::new()));
    if closes || labels.contains(&next) { Image::Known } else { Image::Inside }
}

/// The matrices on a piece.
struct Moving {
    letters: Vec<Vec<Vec<Model>>>,
}

impl Moving {
    fn new(letters: &[Vec<Vec<Poly>>], from: &Q, to: &Q) -> Self {
        let two = whole(2);
        let p = Model::line(&((from + to) / &two), &((to - from) / &two), &Q::zero());
        let entry = |f: &Poly| model::value(f, &p);
        let matrix = |m: &Vec<Vec<Poly>>| m.iter().map(|row| row.iter().map(entry).collect()).collect();
        Self { letters: letters.iter().map(matrix).collect() }
    }

    fn size(&self) -> usize {
        self.letters[0].len()
    }

    fn unit_vector(&self, column: usize) -> Vec<Model> {
        (0..self.size()).map(|i| if i == column { Model::one() } else { Model::zero() }).collect()
    }

    /// A column of the adjugate of `λ − T_w`, `λ` within the line that is given: the characteristic polynomial has different signs
    /// below and above it at every parameter of the piece.
    fn eigenvector(&self, seed: &Seed, line: &Node<'_>) -> Checked<Vec<Model>> {
        let numbers = line.vector(3)?;
        let (mid, slope, rest) = (&numbers[0], &numbers[1], &numbers[2]);
        line.need(rest.is_positive(), "hull", "a positive distance is needed")?;
        let mut m = self.letters[seed.word[0]].clone();
        for l in &seed.word[1..] {
            m = product(&m, &self.letters[*l])?;
        }
        let chi = characteristic(&m)?;
        let at = |x: &Model| chi.iter().rev().fold(Model::zero(), |v, c| v.times(x).plus(c));
        let side = |shift: &Q| at(&Model::line(&(mid + shift), slope, &Q::zero())).sign();
        line.need(side(&-rest) * side(rest) == -1, "hull", "no eigenvalue is seen within the line")?;
        let lambda = Model::line(mid, slope, rest);
        let mut y = self.unit_vector(seed.column);
        let mut sum = y.clone();
        for power in (1..m.len()).rev() {
            y = image(&m, &y)?;
            y[seed.column] = y[seed.column].plus(&chi[power]);
            sum = sum.iter().zip(&y).map(|(s, x)| s.times(&lambda).plus(x)).collect();
        }
        Ok(sum)
    }

    /// The vertices.
    fn points(&self, seeds: &[Seed], labels: &[(usize, Vec<usize>)], values: &Node<'_>) -> Checked<Vec<Vec<Model>>> {
        let lines = values.exactly(seeds.iter().filter(|s| !s.word.is_empty()).count(), "hull")?;
        let (mut lines, mut starts) = (lines.iter(), Vec::new());
        for seed in seeds {
            let plain = if seed.word.is_empty() {
                self.unit_vector(seed.column)
            } else {
                let line = values.some(lines.next(), "hull", "an eigenvalue is missing")?;
                self.eigenvector(seed, line)?
            };
            let scale = Model::constant(&seed.scale);
            starts.push(plain.iter().map(|x| x.times(&scale)).collect::<Vec<Model>>());
        }
        let vertex = |(seed, word): &(usize, Vec<usize>)| {
            word.iter().rev().try_fold(starts[*seed].clone(), |v, l| image(&self.letters[*l], &v))
        };
        labels.iter().map(vertex).collect()
    }

    /// Every image that is neither a vertex nor a closing one is a combination of the vertices of its basis with `Σ|c| < 1`.
    fn inside(&self, points: &[Vec<Model>], images: &[Vec<Image>], bases: &Node<'_>) -> Checked<()> {
        let count = images.iter().flatten().filter(|i| matches!(i, Image::Inside)).count();
        // One basis at least shows that the vertices span.
        bases.need(count > 0, "hull", "no image lies inside")?;
        let list = bases.exactly(count, "hull")?;
        let (mut list, mut known): (_, Vec<(Vec<usize>, Inverse)>) = (list.iter(), Vec::new());
        for (v, row) in images.iter().enumerate() {
            for (letter, _) in row.iter().enumerate().filter(|(_, i)| matches!(i, Image::Inside)) {
                let item = bases.some(list.next(), "hull", "a basis is missing")?;
                let basis = item.indices(points.len())?;
                if known.iter().all(|(b, _)| *b != basis) {
                    known.push((basis.clone(), item.at(Inverse::new(points, &basis, self.size()))?));
                }
                let at = known.iter().position(|(b, _)| *b == basis);
                let at = item.some(at, "hull", "a basis is missing")?;
                let x = image(&self.letters[letter], &points[v])?;
                item.need(
                    known[at].1.holds(&x)?,
                    "hull",
                    format_args!("the image of vertex {v} under {letter} is not inside"),
                )?;
            }
        }
        Ok(())
    }
}

/// `Y` with `Y B = 1 − E`, `B` the vertices of a basis as columns.
struct Inverse {
    near: Vec<Vec<Model>>,
    error: Vec<Vec<Model>>,
    /// A bound of the sums of the rows of `E`, below 1.
    size: BigInt,
}

impl Inverse {
    fn new(points: &[Vec<Model>], basis: &[usize], n: usize) -> Checked<Self> {
        let distinct = basis.len() == n && (1..n).all(|k| basis[k - 1] < basis[k]);
        need(distinct, "hull", "as many vertices as coordinates, in order, are needed")?;
        // Rounded middles are enough to find an inverse that is checked below.
        let short = |x: &BigInt| Q::new(x >> (model::BITS - 48), BigInt::one() << 48);
        let rows: Vec<Vec<Q>> = (0..n).map(|i| basis.iter().map(|b| short(&points[*b][i].mid)).collect()).collect();
        let inverse = Matrix::from_rows(n, &rows).solve(&Matrix::identity(n))?;
        let inverse = some(inverse, "hull", "the vertices of a basis are dependent")?;
        let coarse = |q: Q| {
            let scaled: BigInt = q.numer() << 60;
            Q::new(scaled.div_floor(q.denom()), BigInt::one() << 60)
        };
        let near: Vec<Vec<Model>> =
            (0..n).map(|i| (0..n).map(|j| Model::constant(&coarse(inverse.at(i, j)))).collect()).collect();
        let mut error = Vec::new();
        for (i, row) in near.iter().enumerate() {
            let mut own = Vec::new();
            for (j, b) in basis.iter().enumerate() {
                let identity = if i == j { Model::one() } else { Model::zero() };
                own.push(identity.minus(&dot(row, &points[*b])?));
            }
            error.push(own);
        }
        let size = error.iter().map(|r| r.iter().map(Model::size).sum::<BigInt>()).fold(BigInt::zero(), BigInt::max);
        need(size < unit(), "hull", "the vertices of a basis are not seen to be independent")?;
        Ok(Self { near, error, size })
    }

    /// `c = z + E z + …` with `z = Y x`.
    fn holds(&self, x: &[Model]) -> Checked<bool> {
        let z = image(&self.near, x)?;
        let first = image(&self.error, &z)?;
        let largest = z.iter().map(Model::size).fold(BigInt::zero(), BigInt::max);
        // ε²/(1 − ε) times the largest, rounded up.
        let rest: BigInt = (&self.size * &self.size * largest) / (unit() * (unit() - &self.size)) + 1;
        let mut sum = Model::zero();
        for (a, b) in z.iter().zip(&first) {
            let mut c = a.plus(b);
            c.rest += &rest;
            sum = match c.sign() {
                1 => sum.plus(&c),
                -1 => sum.minus(&c),
                _ => sum.plus(&Model { mid: c.size(), ..Model::zero() }),
            };
        }
        Ok(sum.size() < unit())
    }
}

impl Hull {
    /// Whether the interval holds the part between two ends, with them.
    pub fn covers(&self, from: &End, to: &End) -> bool {
        self.from <= from.lo && to.hi <= self.to
    }
}
