//! Subdivision around one vertex (for dual schemes: in a face) of a mesh that is regular elsewhere, one Fourier block at a time.
//!
//! Points of a sector have places `(i, j)` in its lattice: `i` steps along its first spoke and `j` along the next one (quadrangles
//! and triangles), or the cell `[i, i+1] × [j, j+1]` (dual). In block `k` the value in sector `s` is `ω^ks` times that in sector 0.

use super::ball::{Ball, Balls, dot};
use super::limit::distance;
use super::rule::{Stencils, Terms};
use crate::base::{Checked, Matrix, Q, need, reject, whole};
use num_traits::{One, Signed, Zero};
use std::collections::BTreeMap;

/// Most sectors.
pub const MAX_VALENCE: usize = 1024;

/// The splines that the schemes are away from the vertex.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Spline {
    /// Catmull and Clark: bicubic.
    Bicubic,
    /// Loop: the quartic box spline on triangles.
    Quartic,
    /// Doo and Sabin: biquadratic, dual.
    Biquadratic,
    /// Two steps of the midedge scheme: the quadratic box spline of Zwart and Powell, dual.
    Quadratic,
}

/// The weights at the centre.
#[derive(Debug, Clone)]
pub enum Centre {
    /// Of a vertex: its own, and those of all its edge neighbours and of all opposite corners together.
    Vertex([Q; 3]),
    /// Loop's `5/8 − (3/8 + cos(2π/n)/4)²` for all edge neighbours together.
    Loop,
    /// Of the corners of a face, from the own one on.
    Face(Vec<Q>),
    /// `δ_j/4 + (3 + 2cos(2πfj/n))/(4n)` in a face.
    Frequency(usize),
}

/// A place of the lattice.
pub type Place = (i64, i64);

/// What a scheme is around its centre.
enum Around {
    /// A spline away from it.
    Spline(Spline, Centre),
    /// Stencils.
    Stencils(Stencils),
}

/// A scheme at one valence.
pub struct Mesh {
    around: Around,
    /// `ω^0, …, ω^(n−1)`, `ω = e^(2πi/n)`.
    powers: Vec<Ball>,
}

/// A net of one block on some rings: the value at the centre, and at the places of sector 0.
pub struct Net {
    /// The frequency.
    pub frequency: usize,
    /// At the centre; 0 in the blocks other than 0, and without meaning for dual schemes.
    pub centre: Ball,
    /// At the places.
    pub values: BTreeMap<Place, Ball>,
}

/// The powers of `e^(2πi/n)`, from an approximation `w`: some root of `z^n − 1` lies within `|w^n − 1| / |w|^(n−1)` of `w`, because
/// `f'/f = Σ 1/(z − z_k)`; if the imaginary parts of its powers below `n/2` are positive, it is the first one.
pub fn powers(n: usize, w: &(Q, Q)) -> Checked<Vec<Ball>> {
    let near = Ball::new(&w.0, &w.1);
    need(near.at_most() < whole(2), "vertex", "this is no root of unity")?;
    let before = (1..n).fold(Ball::real(&Q::one()), |p, _| p.times(&near));
    let off = before.times(&near).minus(&Ball::real(&Q::one())).at_most();
    need(before.at_least().is_positive(), "vertex", "no root of unity is seen near this number")?;
    let root = near.widened(&(off / before.at_least()));
    let mut all = vec![Ball::real(&Q::one())];
    for m in 1..n {
        all.push(all[m - 1].times(&root));
        need(2 * m >= n || all[m].imaginary_sign() == 1, "vertex", "this is not the first root of unity")?;
    }
    Ok(all)
}

fn outside<T>() -> Checked<T> {
    reject("vertex", "a point outside the rings")
}

impl Spline {
    /// The old places of a new point in the regular mesh.
    pub fn terms(self, (i, j): Place) -> Vec<(Place, Q)> {
        let old = (-2..=3).flat_map(|a| (-2..=3).map(move |b| (a, b)));
        let reached = old.filter(|(a, b)| (i - 2 * a).abs() <= 2 && (j - 2 * b).abs() <= 2);
        let term = |q: Place| (q, self.mask((i - 2 * q.0, j - 2 * q.1)));
        reached.map(term).filter(|(_, weight)| !weight.is_zero()).collect()
    }

    /// The weight of the old point `q` in the new point `q`·2 + `offset`.
    fn mask(self, (i, j): Place) -> Q {
        let far = |x: i64| usize::from(!(0..=1).contains(&x));
        let (weight, of) = match self {
            Self::Bicubic => {
                let row = [1, 4, 6, 4, 1];
                (row[(i + 2) as usize] * row[(j + 2) as usize], 64)
            }
            Self::Quartic => match i.abs().max(j.abs()).max((i + j).abs()) {
                0 => (10, 16),
                1 => (6, 16),
                2 if i == 0 || j == 0 || i + j == 0 => (1, 16),
                2 => (2, 16),
                _ => (0, 16),
            },
            Self::Biquadratic if i < -1 || j < -1 => (0, 16),
            Self::Quadratic if i < -1 || j < -1 => (0, 4),
            Self::Biquadratic => ([9, 3, 1][far(i) + far(j)], 16),
            Self::Quadratic => ([2, 1, 0][far(i) + far(j)], 4),
        };
        whole(weight) / whole(of)
    }
}

/// The place of sector 0 and the number of sectors by which a place of the continued lattice is turned against it; `None` for
/// the centre.
pub fn locate(triangles: bool, dual: bool, (mut i, mut j): Place) -> Option<(Place, i64)> {
    let (mut turn, first) = (0, i64::from(!dual));
    while i < first || j < 0 {
        (i, j, turn) = match (dual, j < 0) {
            (false, _) if (i, j) == (0, 0) => return None,
            (false, false) if i == 0 => (j, 0, turn + 1),
            (false, true) => (-j, if triangles { i + j } else { i }, turn - 1),
            (false, false) => (if triangles { i + j } else { j }, -i, turn + 1),
            (true, true) => (-1 - j, i, turn - 1),
            (true, false) => (j, -1 - i, turn + 1),
        };
    }
    Some(((i, j), turn))
}

impl Mesh {
    /// The scheme with these weights; the powers are those of [`powers`].
    pub fn new(spline: Spline, centre: Centre, powers: Vec<Ball>) -> Checked<Self> {
        let n = powers.len();
        let fits = match &centre {
            Centre::Vertex(weights) => weights.iter().sum::<Q>().is_one(),
            Centre::Face(w) => w.len() == n && Matrix::new(n, 1, w).is_affine() && (1..n).all(|j| w[j] == w[n - j]),
            Centre::Frequency(f) => f % n != 0,
            Centre::Loop => true,
        };
        need(fits, "vertex", "the weights at the centre do not add up to 1, or have no mirror symmetry")?;
        Ok(Self { around: Around::Spline(spline, centre), powers })
    }

    /// A scheme given by stencils; the powers are those of [`powers`].
    pub fn of_stencils(stencils: Stencils, powers: Vec<Ball>) -> Self {
        Self { around: Around::Stencils(stencils), powers }
    }

    /// The valence.
    pub fn valence(&self) -> usize {
        self.powers.len()
    }

    /// Whether the centre is a face.
    pub fn dual(&self) -> bool {
        matches!(self.around, Around::Spline(Spline::Biquadratic | Spline::Quadratic, _))
    }

    /// Whether the faces around the centre are triangles.
    pub fn triangles(&self) -> bool {
        match &self.around {
            Around::Spline(spline, _) => *spline == Spline::Quartic,
            Around::Stencils(stencils) => stencils.lattice.triangles,
        }
    }

    /// `ω^turn`.
    pub fn power(&self, turn: i64) -> &Ball {
        &self.powers[turn.rem_euclid(self.powers.len() as i64) as usize]
    }

    /// The place of sector 0, and its turn, of a place of the continued lattice.
    fn locate(&self, place: Place) -> Option<(Place, i64)> {
        locate(self.triangles(), self.dual(), place)
    }

    /// The places of sector 0 on the first rings.
    pub fn places(&self, rings: i64) -> Vec<Place> {
        let inside = |(i, j): &Place| match (self.triangles(), self.dual()) {
            (true, _) => *i > 0 && i + j <= rings,
            (_, false) => *i > 0,
            (_, true) => *i < rings && *j < rings,
        };
        (0..=rings).flat_map(|i| (0..=rings).map(move |j| (i, j))).filter(inside).collect()
    }

    /// The old points of a new point, with their weights; `None` is the centre. The mesh is regular around all points but the
    /// centre, so the mask holds in the lattice continued over the spokes.
    pub fn stencil(&self, (i, j): Place) -> Checked<Terms> {
        match &self.around {
            Around::Spline(spline, _) => {
                let term = |(q, weight): (Place, Q)| (self.locate(q), Ball::real(&weight));
                Ok(spline.terms((i, j)).into_iter().map(term).collect())
            }
            Around::Stencils(stencils) => stencils.at((i, j)),
        }
    }

    /// The weights of the new centre, by place, for all sectors together, its own first.
    fn centre_row(&self, places: &[Place]) -> Checked<Vec<Ball>> {
        let mut row = vec![Ball::zero(); 1 + places.len()];
        match &self.around {
            Around::Spline(spline, centre) => {
                let [own, edges, corners] = self.vertex(centre);
                row[0] = own;
                for (weight, place) in row[1..].iter_mut().zip(places) {
                    match *place {
                        (1, 0) => *weight = edges.clone(),
                        (1, 1) if *spline == Spline::Bicubic => *weight = corners.clone(),
                        _ => {}
                    }
                }
            }
            Around::Stencils(stencils) => {
                for (old, weight) in &stencils.centre {
                    let column = match old {
                        None => 0,
                        Some((q, _)) => match places.iter().position(|p| p == q) {
                            Some(known) => 1 + known,
                            None => return outside(),
                        },
                    };
                    row[column] = row[column].plus(weight);
                }
            }
        }
        Ok(row)
    }

    /// The transform of the weights in the central face.
    fn face(&self, centre: &Centre, k: usize) -> Ball {
        let n = self.valence();
        match centre {
            Centre::Frequency(f) => {
                let met = [*f, n - f % n].iter().filter(|g| *g % n == k % n).count() as i64;
                Ball::real(&((whole(1 + met) + if k == 0 { whole(3) } else { Q::zero() }) / whole(4)))
            }
            Centre::Face(weights) => {
                let weights: Vec<Ball> = weights.iter().map(Ball::real).collect();
                dot(&weights, (0..n).map(|j| self.power((j * k) as i64)))
            }
            _ => Ball::zero(),
        }
    }

    /// The weights at the centre of a spline on a vertex: its own, and those of all neighbours and of all opposite corners together.
    pub fn at_centre(&self) -> [Ball; 3] {
        match &self.around {
            Around::Spline(_, centre) => self.vertex(centre),
            // Nothing is made of them.
            Around::Stencils(_) => [Ball::zero(), Ball::zero(), Ball::zero()],
        }
    }

    /// The weights at a central vertex.
    fn vertex(&self, centre: &Centre) -> [Ball; 3] {
        match centre {
            Centre::Vertex(weights) => weights.each_ref().map(Ball::real),
            _ => {
                let cosine = self.power(1).plus(self.power(-1)).times(&Ball::real(&(Q::one() / whole(8))));
                let inner = cosine.plus(&Ball::real(&(whole(3) / whole(8))));
                let edges = Ball::real(&(whole(5) / whole(8))).minus(&inner.times(&inner));
                [Ball::real(&Q::one()).minus(&edges), edges, Ball::zero()]
            }
        }
    }

    /// The block `k` on the first rings, which one step determines from themselves; in block 0 of schemes with a central vertex
    /// this comes first.
    pub fn block(&self, k: usize, rings: i64) -> Checked<Balls> {
        let places = self.places(rings);
        let mut rows: Balls = Vec::new();
        if k == 0 && !self.dual() {
            rows.push(self.centre_row(&places)?);
        }
        let before = rows.len();
        for (own, place) in places.iter().enumerate() {
            let mut row = vec![Ball::zero(); before + places.len()];
            if let Around::Spline(Spline::Biquadratic | Spline::Quadratic, centre) = &self.around
                && *place == (0, 0)
            {
                row[own] = self.face(centre, k);
                rows.push(row);
                continue;
            }
            for (old, weight) in self.stencil(*place)? {
                let Some((q, turn)) = old else {
                    if before == 1 {
                        row[0] = row[0].plus(&weight);
                    }
                    continue;
                };
                let Some(known) = places.iter().position(|p| *p == q) else { return outside() };
                let column = before + known;
                row[column] = row[column].plus(&weight.times(self.power(turn * k as i64)));
            }
            rows.push(row);
        }
        Ok(rows)
    }

    /// The net of an eigenvector on the first rings continued to more of them: a point is its stencil, divided by the eigenvalue. New
    /// points of these rings depend on earlier ones only.
    pub fn continued(&self, eigenvalue: &Ball, mut net: Net, rings: i64) -> Checked<Net> {
        let inverse = eigenvalue.inverse()?;
        let mut places = self.places(rings);
        let triangles = self.triangles();
        places.sort_by_key(|p| distance(triangles, *p));
        for place in places {
            if !net.values.contains_key(&place) {
                let terms = self.stencil(place)?;
                let old = terms.iter().map(|(old, _)| self.at(&net, *old)).collect::<Checked<Vec<_>>>()?;
                let value = dot(&old, terms.iter().map(|(_, weight)| weight)).times(&inverse);
                net.values.insert(place, value);
            }
        }
        Ok(net)
    }

    /// The value at a place, `None` for the centre.
    pub fn at(&self, net: &Net, old: Option<(Place, i64)>) -> Checked<Ball> {
        let Some((place, turn)) = old else { return Ok(net.centre.clone()) };
        match net.values.get(&place) {
            Some(value) => Ok(value.times(self.power(turn * net.frequency as i64))),
            None => outside(),
        }
    }

    /// `Σ weight · value / divisor` over places of the continued lattice.
    pub fn combined(&self, net: &Net, terms: &[(Place, i64)], divisor: i64) -> Checked<Ball> {
        let mut sum = Ball::zero();
        for (place, weight) in terms {
            let weight = Ball::real(&(whole(*weight) / whole(divisor)));
            sum = sum.plus(&self.at(net, self.locate(*place))?.times(&weight));
        }
        Ok(sum)
    }
}
