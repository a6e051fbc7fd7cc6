//! The exact spectrum around a vertex where all weights are rational: eigenvalues that are equal in several blocks, or have Jordan
//! blocks.

use super::ball::Ball;
use super::case::Scheme;
use super::mesh::{Centre, Mesh, Net, Place, Spline, locate};
use super::rule::{Rule, beside};
use crate::base::{Checked, Matrix, Q, need, reject, roots_in_disc, some, whole};
use num_traits::{One, Signed, Zero};

/// The operator of one step on the centre, where that is a point, and on the first rings of all sectors.
pub struct Operator {
    places: Vec<Place>,
    valence: usize,
    /// 1 where the centre is a point.
    before: usize,
    /// The rings.
    pub rings: i64,
    matrix: Matrix,
}

/// The eigenvectors that end the longest chains of the leading eigenvalue.
pub struct Leading {
    /// How long these are.
    pub length: usize,
    /// The eigenvectors, as rows in echelon form, and their pivots.
    vectors: Matrix,
    pivots: Vec<usize>,
}

/// `2cos(2πm/n)`, where it is rational.
fn twice_cosine(m: usize, n: usize) -> Checked<Q> {
    let twelfths = 12 * m;
    need(twelfths.is_multiple_of(n), "vertex", "the weights are irrational at this valence")?;
    Ok(whole(match (twelfths / n) % 12 {
        0 => 2,
        2 | 10 => 1,
        3 | 9 => 0,
        4 | 8 => -1,
        6 => -2,
        _ => return reject("vertex", "the weights are irrational at this valence"),
    }))
}

/// The weights at a central vertex: its own, and those of all edge neighbours and of all opposite corners together.
fn at_vertex(centre: &Centre, n: usize) -> Checked<[Q; 3]> {
    match centre {
        Centre::Vertex(weights) => Ok(weights.clone()),
        Centre::Loop => {
            let inner = whole(3) / whole(8) + twice_cosine(1, n)? / whole(8);
            let edges = whole(5) / whole(8) - &inner * &inner;
            Ok([Q::one() - &edges, edges, Q::zero()])
        }
        Centre::Face(_) | Centre::Frequency(_) => reject("vertex", "a face has no weights at a vertex"),
    }
}

/// The weights in a central face.
fn in_face(centre: &Centre, n: usize) -> Checked<Vec<Q>> {
    match centre {
        Centre::Face(weights) => Ok(weights.clone()),
        Centre::Frequency(f) => {
            let weight = |j: usize| {
                let own = if j == 0 { whole(1) / whole(4) } else { Q::zero() };
                Ok(own + (whole(3) + twice_cosine(f * j % n, n)?) / whole(4 * n as i64))
            };
            (0..n).map(weight).collect()
        }
        Centre::Vertex(_) | Centre::Loop => reject("vertex", "a vertex has no weights of a face"),
    }
}

impl Operator {
    /// The operator of a scheme with rational weights; the mesh is that of the same scheme and valence.
    pub fn new(scheme: &Scheme, mesh: &Mesh) -> Checked<Self> {
        let n = mesh.valence();
        let rings = if matches!(scheme, Scheme::Spline(..)) { 2 } else { 3 };
        let places = mesh.places(rings);
        let before = usize::from(!mesh.dual());
        let size = before + n * places.len();
        let mut all = Self { places, valence: n, before, rings, matrix: Matrix::zeros(0, size) };
        let mut rows: Vec<Vec<Q>> = Vec::new();
        if before == 1 {
            rows.push(all.row(0, &all.centre(scheme)?)?);
        }
        for sector in 0..n {
            for place in &all.places {
                rows.push(all.row(sector, &all.terms(scheme, *place)?)?);
            }
        }
        let sums: Vec<Q> = rows.iter().map(|row| row.iter().sum()).collect();
        need(sums.iter().all(Q::is_one), "vertex", "the weights do not add up to 1")?;
        all.matrix = Matrix::from_rows(size, &rows);
        Ok(all)
    }

    fn row(&self, sector: usize, terms: &[(Option<(Place, i64)>, Q)]) -> Checked<Vec<Q>> {
        let mut row = vec![Q::zero(); self.before + self.valence * self.places.len()];
        for (old, weight) in terms {
            let column = match old {
                None => {
                    need(self.before == 1, "vertex", "the centre is no point")?;
                    0
                }
                Some((place, turn)) => {
                    let known = self.places.iter().position(|p| p == place);
                    let known = some(known, "vertex", "a point outside the rings")?;
                    let turned = (sector as i64 + turn).rem_euclid(self.valence as i64) as usize;
                    self.before + turned * self.places.len() + known
                }
            };
            row[column] += weight;
        }
        Ok(row)
    }

    /// The stencil of the centre.
    fn centre(&self, scheme: &Scheme) -> Checked<Vec<(Option<(Place, i64)>, Q)>> {
        let n = self.valence;
        match scheme {
            Scheme::Spline(_, centre) => {
                let [own, edges, corners] = at_vertex(&centre(n), n)?;
                let around = |place: Place, weight: Q| {
                    let each = weight / whole(n as i64);
                    (0..n as i64).map(move |s| (Some((place, s)), each.clone())).collect::<Vec<_>>()
                };
                let mut all = vec![(None, own)];
                all.extend(around((1, 0), edges));
                if !corners.is_zero() {
                    all.extend(around((1, 1), corners));
                }
                Ok(all)
            }
            Scheme::Rule(Rule::Butterfly { modified: false, .. }) => Ok(vec![(None, Q::one())]),
            Scheme::Rule(_) => reject("vertex", "the weights of this rule are looked at in blocks only"),
        }
    }

    /// The stencil of a new point of sector 0.
    fn terms(&self, scheme: &Scheme, place: Place) -> Checked<Vec<(Option<(Place, i64)>, Q)>> {
        match scheme {
            Scheme::Spline(Spline::Biquadratic | Spline::Quadratic, centre) if place == (0, 0) => {
                let weights = in_face(&centre(self.valence), self.valence)?;
                need(weights.len() == self.valence, "vertex", "one weight for each corner is needed")?;
                Ok(weights.into_iter().enumerate().map(|(j, w)| (Some(((0, 0), j as i64)), w)).collect())
            }
            Scheme::Spline(spline, _) => {
                let located = |q: Place| locate(*spline == Spline::Quartic, self.before == 0, q);
                Ok(spline.terms(place).into_iter().map(|(q, w)| (located(q), w)).collect())
            }
            Scheme::Rule(rule @ Rule::Butterfly { modified: false, .. }) => {
                let lattice = rule.lattice();
                let old = lattice.mask.iter().map(|(k, weight)| ((place.0 - k.0, place.1 - k.1), weight));
                let met = old.filter(|((a, b), _)| a.rem_euclid(2) == 0 && b.rem_euclid(2) == 0);
                met.map(|((a, b), w)| Ok((beside(true, place, (a / 2, b / 2))?, w.clone()))).collect()
            }
            Scheme::Rule(_) => reject("vertex", "the weights of this rule are looked at in blocks only"),
        }
    }

    /// Proves that `value` is the only eigenvalue of modulus `radius` or more but a simple 1, and returns the eigenvectors that end
    /// its longest chains.
    pub fn leading(&self, value: &Q, radius: &Q) -> Checked<Leading> {
        let size = self.matrix.rows;
        let fits = radius.is_positive() && value.abs() > *radius && value.abs() < Q::one();
        need(fits, "vertex", "the eigenvalue lies between the bound and 1")?;
        let polynomial = self.matrix.characteristic()?;
        let mut scale = Q::one();
        let mut scaled = Vec::new();
        for k in 0..=size {
            scaled.push(polynomial.at(0, k) * &scale);
            scale *= radius;
        }
        let inside = roots_in_disc(&Matrix::new(1, size + 1, &scaled).data)?;
        let inside =
            some(inside, "vertex", "eigenvalues of the modulus of the bound, or one that is not seen to be smaller")?;
        let step = self.matrix.minus(&Matrix::identity(size).scaled(value));
        let (mut power, mut dimensions) = (Matrix::identity(size), vec![0]);
        loop {
            power = power.times(&step)?.reduced();
            let dimension = size - power.rank()?;
            if dimensions.last() == Some(&dimension) {
                break;
            }
            dimensions.push(dimension);
        }
        let length = dimensions.len() - 1;
        need(length > 0, "vertex", "this is no eigenvalue")?;
        need(size - inside == dimensions[length] + 1, "vertex", "other eigenvalues are not smaller than the bound")?;
        // (S − λ)^(L−1) on the kernel of (S − λ)^L.
        let kernel = step.power(length)?.kernel()?;
        let (vectors, pivots) = kernel.times(&step.power(length - 1)?.transpose())?.echelon()?;
        need(pivots.len() == dimensions[length] - dimensions[length - 1], "vertex", "chains of this number end")?;
        Ok(Leading { length, vectors: vectors.reduced(), pivots })
    }

    /// The entries of a vector moved by one sector.
    fn turned(&self, vector: &Matrix) -> Matrix {
        let (count, before) = (self.places.len(), self.before);
        let from = |k: usize| if k < before { k } else { before + (k - before + count) % (self.valence * count) };
        vector.columns(&(0..vector.cols).map(from).collect::<Vec<_>>())
    }

    /// The net of a leading eigenvector, which is alone (block 0), or with one other spans the blocks `k` and `n − k`.
    pub fn net(&self, mesh: &Mesh, leading: &Leading) -> Checked<Net> {
        let n = self.valence;
        let turned = self.turned(&leading.vectors).columns(&leading.pivots);
        let k = match leading.pivots.len() {
            1 => {
                need(turned.at(0, 0).is_one(), "vertex", "the eigenvector is not the same in all sectors")?;
                0
            }
            2 => {
                // The rotation has the eigenvalues e^(±2πik/n): x² − t x + 1 with t = 2cos(2πk/n) rational.
                let (a, b, c, d) = (turned.at(0, 0), turned.at(0, 1), turned.at(1, 0), turned.at(1, 1));
                let order = match (whole(1) == &a * &d - &b * &c, (a + d).to_string().as_str()) {
                    (true, "-1") => 3,
                    (true, "0") => 4,
                    (true, "1") => 6,
                    _ => return reject("vertex", "the eigenvectors do not belong to two conjugate blocks"),
                };
                need(n.is_multiple_of(order), "vertex", "no block has these eigenvectors")?;
                n / order
            }
            _ => return reject("vertex", "the eigenvectors are too many for one function on the ring"),
        };
        let at = |column: usize| leading.vectors.at(0, column);
        let values = self.places.iter().enumerate().map(|(p, place)| {
            let entry = |s: usize| at(self.before + s * self.places.len() + p);
            let value = match k {
                0 => Ball::real(&entry(0)),
                // Of the two blocks the second falls out of the sum.
                _ => (0..n)
                    .fold(Ball::zero(), |sum, s| sum.plus(&Ball::real(&entry(s)).times(mesh.power(-((k * s) as i64))))),
            };
            (*place, value)
        });
        let centre = if k == 0 && self.before == 1 { Ball::real(&at(0)) } else { Ball::zero() };
        Ok(Net { frequency: k, centre, values: values.collect() })
    }
}

impl Leading {
    /// How many there are.
    pub fn count(&self) -> usize {
        self.pivots.len()
    }
}
