//! One step on a fan of faces at the border: its eigenvectors, exactly or enclosed, and signs on the patches of its ring.

use super::border::Fan;
use super::fan::Ground;
use super::patch::{Combination, bezier, combined, control};
use super::refine::{Kind, Level, Space};
use super::scheme::Scheme;
use super::topology::Topology;
use crate::arith::{Integer, Rational, ratio};
use crate::budget::Budget;
use crate::linalg::Matrix;
use crate::ring::{Field as _, Fixed, Ordered as _, Rationals, Ring as _};
use crate::vertex::block::{Block, Vertex};
use crate::vertex::field::Enclosures;
use crate::vertex::net::{Net, Signs};
use crate::vertex::ring::{RINGS, Values};
use crate::vertex::top::{leading_values, top};
use crate::vertex::turning::Rotation;
use std::collections::BTreeMap;

/// What a patch of the ring has on the border.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Touch {
    /// Its side in the first variable.
    Row,
    /// Its side in the second variable.
    Column,
    /// Its first corner.
    First,
    /// Of a triangle its third corner.
    Last,
    /// Nothing.
    Nothing,
}

impl Touch {
    /// Whether a coefficient belongs to the part on the border.
    fn has<E>(self, net: &Net<E>, r: usize, s: usize) -> bool {
        match self {
            Self::Row => r == 0,
            Self::Column => s == 0,
            Self::First => (r, s) == (0, 0),
            Self::Last => r + 1 == net.rows.len(),
            Self::Nothing => false,
        }
    }

    /// The net of a polynomial that vanishes on the border, with exact zeros there.
    fn cleared(self, k: &Enclosures, mut net: Net<Fixed>) -> Net<Fixed> {
        for r in 0..net.rows.len() {
            for s in 0..net.rows[r].len() {
                if self.has(&net, r, s) {
                    net.rows[r][s] = k.zero();
                }
            }
        }
        net
    }
}

/// Rational combinations of the points of a fan.
struct Combos(usize);

impl Space for Combos {
    type P = Option<Vec<Rational>>;

    fn unknown(&self) -> Self::P {
        None
    }

    fn sum(&self, terms: &[(i64, &Self::P)], over: i64) -> Self::P {
        let mut sum = vec![Rational::from(0); self.0];
        for (w, p) in terms {
            sum.iter_mut().zip(p.as_ref()?).for_each(|(s, x)| *s += x * ratio(*w, over));
        }
        Some(sum)
    }

    fn blend(&self, own: &Self::P, ring: &[&Self::P]) -> Self::P {
        // Vertices inside a fan are regular: 5/8 and 3/8.
        let mut terms = vec![(10, own)];
        terms.extend(ring.iter().map(|p| (1, *p)));
        if ring.len() == 6 { self.sum(&terms, 16) } else { None }
    }
}

/// Enclosures of numbers.
struct Enclosed<'a>(&'a Enclosures);

impl Space for Enclosed<'_> {
    type P = Fixed;

    fn unknown(&self) -> Fixed {
        Fixed { lo: Integer::from(-1) << 1024_u64, hi: Integer::from(1) << 1024_u64 }
    }

    fn sum(&self, terms: &[(i64, &Fixed)], over: i64) -> Fixed {
        let k = self.0;
        terms.iter().fold(k.zero(), |s, (w, p)| k.add(&s, &k.scale(p, &ratio(*w, over))))
    }

    fn blend(&self, _: &Fixed, _: &[&Fixed]) -> Fixed {
        self.unknown()
    }
}

/// A fan with three rings of points, and one step on it.
pub struct Step {
    fan: Fan,
    level: Level,
    /// Sector and place in its lattice of each point; the last spoke begins a sector of its own.
    places: Vec<(usize, usize, usize)>,
    numbers: BTreeMap<(usize, usize, usize), usize>,
    matrix: Option<Matrix>,
}

impl Step {
    pub fn of(fan: Fan) -> Self {
        let far = |i: usize, j: usize| if fan.triangles { i + j } else { i.max(j) };
        let mut places = vec![(0, 0, 0)];
        for s in 0..fan.faces {
            for j in 0..=RINGS {
                places.extend((1..=RINGS).filter(|i| far(*i, j) <= RINGS).map(|i| (s, i, j)));
            }
        }
        places.extend((1..=RINGS).map(|i| (fan.faces, i, 0)));
        let numbers: BTreeMap<_, _> = places.iter().enumerate().map(|(k, p)| (*p, k)).collect();
        let mut step = Self { fan, level: Level::of(empty(), Vec::new()), places, numbers, matrix: None };
        let mut faces = Vec::new();
        for s in 0..fan.faces {
            for (a, b) in (0..RINGS).flat_map(|b| (0..RINGS).map(move |a| (a, b))) {
                faces.extend(step.cells(s, a, b));
            }
        }
        let kind = |(s, i, j): &(usize, usize, usize)| match (*i, *j) {
            (0, _) if fan.smooth => Kind::Smooth(fan.faces as u32),
            (0, _) => Kind::Corner(fan.faces as u32),
            (i, j) if far(i, j) == RINGS => Kind::Unknown,
            (_, 0) if *s == 0 || *s == fan.faces => Kind::Smooth(if fan.triangles { 3 } else { 2 }),
            _ => Kind::Inside(if fan.triangles { 6 } else { 4 }),
        };
        let kinds = step.places.iter().map(kind).collect();
        let joined = Topology::joined(step.places.len(), faces.iter().map(Vec::as_slice));
        step.level = Level::of(joined.expect("a fan is a surface"), kinds);
        step.matrix = step.stencils();
        step
    }

    fn number(&self, s: usize, i: usize, j: usize) -> Option<usize> {
        let place = match (i, j) {
            (0, 0) => (0, 0, 0),
            (0, j) => (s + 1, j, 0),
            (i, j) => (s, i, j),
        };
        self.numbers.get(&place).copied()
    }

    /// The faces in a cell of the lattice of a sector.
    fn cells(&self, s: usize, a: usize, b: usize) -> Vec<Vec<u32>> {
        let face = |all: &[(usize, usize)]| -> Option<Vec<u32>> {
            all.iter().map(|(i, j)| self.number(s, *i, *j).map(|n| n as u32)).collect()
        };
        let (p, q, r, d) = ((a, b), (a + 1, b), (a, b + 1), (a + 1, b + 1));
        let all = if self.fan.triangles { vec![face(&[p, q, r]), face(&[q, d, r])] } else { vec![face(&[p, q, d, r])] };
        all.into_iter().flatten().collect()
    }

    /// One step: the new point at each place.
    fn stencils(&self) -> Option<Matrix> {
        let count = self.places.len();
        let unit = |k: usize| Some((0..count).map(|j| ratio(i64::from(j == k), 1)).collect());
        let old: Vec<Option<Vec<Rational>>> = (0..count).map(unit).collect();
        let new = self.level.points(&Combos(count), self.fan.triangles, &old);
        let t = &self.level.topology;
        let ends = |c: u32| {
            let (a, b) = (t.vertex[c as usize], t.vertex[t.next(c) as usize]);
            (a.min(b), a.max(b))
        };
        let edges: BTreeMap<(u32, u32), usize> = t.edges.iter().enumerate().map(|(e, [c, _])| (ends(*c), e)).collect();
        let row = |(s, i, j): &(usize, usize, usize)| -> Option<Vec<Rational>> {
            let old = |i: usize, j: usize| self.number(*s, i, j).map(|n| n as u32);
            let (i, j, a, b) = (*i, *j, i / 2, j / 2);
            let edge = |p: u32, q: u32| Some(t.vertices() + edges.get(&(p.min(q), p.max(q)))?);
            let index = match (i % 2, j % 2) {
                (0, 0) => old(a, b)? as usize,
                (1, 0) => edge(old(a, b)?, old(a + 1, b)?)?,
                (0, 1) => edge(old(a, b)?, old(a, b + 1)?)?,
                _ if self.fan.triangles => edge(old(a + 1, b)?, old(a, b + 1)?)?,
                _ => t.vertices() + t.edges.len() + t.face[t.corner_of(&self.cells(*s, a, b)[0])? as usize] as usize,
            };
            new.get(index)?.clone()
        };
        let rows: Option<Vec<Vec<Rational>>> = self.places.iter().map(row).collect();
        Some(Matrix::from_rows(count, rows?))
    }

    /// Whether the values of a function on the points make an eigenvector of 1/2, up to a multiple of another one:
    /// `S x = x/2 + κ y`.
    fn halves(&self, x: &[Rational], kappa: &Rational, y: &[Rational]) -> Option<()> {
        let image = self.matrix.as_ref()?.apply(x);
        let wanted = x.iter().zip(y).map(|(x, y)| x * ratio(1, 2) + kappa * y);
        image.into_iter().eq(wanted).then_some(())
    }

    /// The values of `first` and `second` in the lattice vectors of the first spoke and the next, continued by turning the lattice.
    fn linear(&self, first: i64, second: i64) -> Vec<Rational> {
        let turned =
            |s: usize| (0..s).fold((first, second), |(a, b), _| if self.fan.triangles { (b, b - a) } else { (b, -a) });
        let value = |(s, i, j): &(usize, usize, usize)| {
            let (a, b) = turned(*s);
            ratio(a * *i as i64 + b * *j as i64, 1)
        };
        self.places.iter().map(value).collect()
    }

    /// Linear functions are eigenvectors of 1/2.
    pub fn affine(&self) -> Option<()> {
        let zero = vec![ratio(0, 1); self.places.len()];
        [(1, 0), (0, 1)].into_iter().try_for_each(|(a, b)| self.halves(&self.linear(a, b), &ratio(0, 1), &zero))
    }

    /// The function with the values of a spoke on one spoke, opposite ones or 0 on the other, of which
    /// `S x = x/2 + κ y`, and `κ`.
    fn along(&self, last: i64, y: &[Rational]) -> Option<(Vec<Rational>, Rational)> {
        let matrix = self.matrix.as_ref()?;
        let fixed = |(s, i, j): &(usize, usize, usize)| match (*s, *i, *j) {
            (_, 0, _) => Some(ratio(0, 1)),
            (0, i, 0) => Some(ratio(i as i64, 1)),
            (s, i, 0) if s == self.fan.faces => Some(ratio(last * i as i64, 1)),
            _ => None,
        };
        let known: Vec<Option<Rational>> = self.places.iter().map(fixed).collect();
        let unknown: Vec<usize> = (0..known.len()).filter(|k| known[*k].is_none()).collect();
        let half = |i: usize, j: usize| &matrix[(i, j)] - if i == j { ratio(1, 2) } else { ratio(0, 1) };
        // (S − 1/2) x − κ y = 0, with κ as the last unknown.
        let count = known.len();
        let left = Matrix::from_fn(count, unknown.len() + 1, |i, j| match unknown.get(j) {
            Some(u) => half(i, *u),
            None => -&y[i],
        });
        let right = Matrix::from_fn(count, 1, |i, _| {
            (0..count).fold(ratio(0, 1), |s, j| known[j].as_ref().map_or(s.clone(), |x| s - half(i, j) * x))
        });
        let solved = left.solve_over(&Rationals, &right)??;
        let mut x: Vec<Rational> = known.into_iter().map(|v| v.map_or(ratio(0, 1), |x| x)).collect();
        unknown.iter().enumerate().for_each(|(j, u)| x[*u] = solved[(j, 0)].clone());
        let kappa = solved[(unknown.len(), 0)].clone();
        self.halves(&x, &kappa, y).map(|()| (x, kappa))
    }

    /// The corner of the regular half plane: `S x_0 = x_0/2 + κ y` with `κ > 0`, `y` the distance from its side.
    pub fn corner(&self) -> Option<()> {
        let zero = vec![ratio(0, 1); self.places.len()];
        let y = self.linear(0, 1);
        self.halves(&y, &ratio(0, 1), &zero)?;
        let (_, kappa) = self.along(0, &y)?;
        (kappa > 0).then_some(())
    }

    /// The second inner mode where it belongs to 1/2: 0 on the border.
    fn second(&self) -> Option<Vec<Rational>> {
        let matrix = self.matrix.as_ref()?;
        let outer = |(s, i, j): &(usize, usize, usize)| *i == 0 || (*j == 0 && (*s == 0 || *s == self.fan.faces));
        let inner: Vec<usize> = (0..self.places.len()).filter(|k| !outer(&self.places[*k])).collect();
        let half = Matrix::from_fn(inner.len(), inner.len(), |i, j| {
            &matrix[(inner[i], inner[j])] - if i == j { ratio(1, 2) } else { ratio(0, 1) }
        });
        let kernel = half.kernel_over(&Rationals)?;
        if kernel.cols() != 1 {
            return None;
        }
        let mut y = vec![ratio(0, 1); self.places.len()];
        inner.iter().enumerate().for_each(|(j, u)| y[*u] = kernel[(j, 0)].clone());
        Some(y)
    }

    /// The leading inner mode: 0 on the border, positive inside; that of the valence of the reflected fan.
    fn first(&self, k: &Enclosures, budget: &Budget) -> Option<Vec<Fixed>> {
        let bits = budget.places[0];
        let scheme = if self.fan.triangles { Scheme::Loop } else { Scheme::CatmullClark };
        let vertex = Vertex::new(&scheme.rule().ok()?, 2 * self.fan.faces, RINGS).ok()?;
        let blocks: Vec<Block> = vertex.frequencies().map(|f| vertex.block(f)).collect::<Result<_, _>>().ok()?;
        let top = top(&vertex, &blocks, bits).ok()?;
        let values: Values<Fixed> = leading_values(&vertex, &blocks, &top, 1, bits)?;
        let rotation = Rotation(k);
        let real = rotation.inv(&values.orbits[vertex.orbit((1, 0))?])?;
        let value = |(s, i, j): &(usize, usize, usize)| -> Option<Fixed> {
            if *i == 0 || (*j == 0 && (*s == 0 || *s == self.fan.faces)) {
                return Some(k.zero());
            }
            let own = rotation.mul(&values.orbits[vertex.orbit((*i, *j))?], &real);
            // x + y ω has the imaginary part y sin(π/k).
            Some(rotation.turn(&own, *s as i64).y)
        };
        self.places.iter().map(value).collect()
    }

    /// The control points of the patches of the ring, and what they have on the border.
    fn ring(&self) -> Option<Vec<(Vec<Combination>, Touch)>> {
        let t = &self.level.topology;
        let mut all = Vec::new();
        for s in 0..self.fan.faces {
            let up = |a: usize, b: usize, which: usize| self.cells(s, a, b).into_iter().nth(which);
            let cells = if self.fan.triangles {
                [up(1, 0, 0), up(0, 0, 1), up(0, 1, 0)]
            } else {
                [up(1, 0, 0), up(1, 1, 0), up(0, 1, 0)]
            };
            for (k, cell) in cells.into_iter().enumerate() {
                let face = t.face[t.corner_of(&cell?)? as usize] as usize;
                let last = s + 1 == self.fan.faces;
                let touch = match k {
                    0 if s == 0 => Touch::Row,
                    1 if s == 0 && self.fan.triangles => Touch::First,
                    1 if last && self.fan.triangles => Touch::Last,
                    2 if last => Touch::Column,
                    _ => Touch::Nothing,
                };
                all.push((control(&self.level, face, self.fan.triangles)?, touch));
            }
        }
        Some(all)
    }

    /// The Bézier nets of a function on the ring. What vanishes on the border has exact zeros there.
    fn nets(&self, k: &Enclosures, values: &[Fixed], vanishes: bool) -> Option<Vec<Net<Fixed>>> {
        let space = Enclosed(k);
        let net = |(points, touch): (Vec<Combination>, Touch)| {
            let own: Vec<Fixed> = points.iter().map(|p| combined(&space, values, p)).collect();
            let net = bezier(&space, self.fan.triangles, &own);
            if vanishes { touch.cleared(k, net) } else { net }
        };
        Some(self.ring()?.into_iter().map(net).collect())
    }

    /// The signs of the statements about smooth vertices of the border.
    pub fn smooth(&self, ground: Ground, budget: &Budget) -> Option<()> {
        let k = Enclosures::of_angle(1, 2 * self.fan.faces, budget.places[0]);
        let zero = vec![ratio(0, 1); self.places.len()];
        let enclosed = |v: &[Rational]| v.iter().map(|x| k.rational(x)).collect::<Vec<Fixed>>();
        let y = self.nets(&k, &self.first(&k, budget)?, true)?;
        self.positive(&k, &y)?;
        let x = if ground == Ground::Map {
            self.along(-1, &zero)?.0
        } else {
            let second = self.second()?;
            let (x, kappa) = self.along(-1, &second)?;
            let turn: Vec<Rational> = second.iter().map(|v| v * &kappa).collect();
            let nets = self.nets(&k, &enclosed(&turn), true)?;
            for ((a, b), (_, touch)) in nets.iter().zip(&y).zip(self.ring()?) {
                // Both vanish along the border, so that their differentials are parallel there.
                not_negative(&k, touch.cleared(&k, jacobian(&k, a, b)), budget.halvings)?;
            }
            // x + s y_2 serves as well as x: the one that is orthogonal to y_2, and some κ y_2 more.
            let dot = |a: &[Rational]| a.iter().zip(&second).fold(ratio(0, 1), |s, (x, y)| s + x * y);
            let share = dot(&x) / dot(&second);
            let own = x.iter().zip(&second).zip(&turn);
            own.map(|((x, y), more)| x - y * &share + more * ratio(SHEAR, 1)).collect()
        };
        let x = self.nets(&k, &enclosed(&x), false)?;
        let mut signs = Signs::default();
        for (index, (a, b)) in x.iter().zip(&y).enumerate() {
            signs.examine(&k, index, jacobian(&k, a, b), budget.halvings);
        }
        (signs.strict() == Some(1)).then_some(())
    }

    /// All Bernstein coefficients off the border are positive.
    fn positive(&self, k: &Enclosures, nets: &[Net<Fixed>]) -> Option<()> {
        let all = nets.iter().zip(self.ring()?).all(|(net, (_, touch))| {
            let rows = net.rows.iter().enumerate();
            let mut all = rows.flat_map(|(r, row)| row.iter().enumerate().map(move |(s, c)| (r, s, c)));
            all.all(|(r, s, c)| touch.has(net, r, s) || k.sign(c) == Some(1))
        });
        all.then_some(())
    }
}

/// The multiple of `κ y_2` that is added to `x`.
const SHEAR: i64 = 8;

/// `da ∧ db`, but for a positive factor.
fn jacobian(k: &Enclosures, a: &Net<Fixed>, b: &Net<Fixed>) -> Net<Fixed> {
    let ((au, av), (bu, bv)) = (a.derivatives(k), b.derivatives(k));
    Net::difference_of_products(k, (&au, &bv), (&av, &bu))
}

/// Whether a polynomial is nowhere negative: its Bernstein coefficients are not, after halvings.
fn not_negative(k: &Enclosures, net: Net<Fixed>, depth: usize) -> Option<()> {
    let mut stack = vec![(net, 0)];
    while let Some((net, level)) = stack.pop() {
        if net.rows.iter().flatten().all(|c| c.lo >= 0) {
            continue;
        }
        if level == depth {
            return None;
        }
        let (left, right) = net.halves(k);
        stack.extend([(left.turned(), level + 1), (right.turned(), level + 1)]);
    }
    Some(())
}

fn empty() -> Topology {
    Topology::joined(0, std::iter::empty()).expect("nothing is joined")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_jordan_blocks() {
        // With y = 1 at the neighbours inside, κ is 1/12 and 1/16, of corners and of smooth vertices.
        for (triangles, smooth, faces, kappa) in
            [(false, false, 2, 12), (true, false, 3, 16), (false, true, 4, 12), (true, true, 6, 16)]
        {
            let step = Step::of(Fan { triangles, smooth, faces });
            let (y, last) = if smooth { (step.second().unwrap(), -1) } else { (step.linear(0, 1), 0) };
            let own = &y[step.number(1, 1, 0).unwrap()];
            let (_, found) = step.along(last, &y).unwrap();
            assert_eq!(crate::arith::abs(&(found * own)), ratio(1, kappa), "{triangles} {smooth}");
        }
        // One quadrangle: 1/4 has a chain of two.
        let step = Step::of(Fan { triangles: false, smooth: true, faces: 1 });
        let net = |f: &dyn Fn(i64, i64) -> Rational| -> Vec<Rational> {
            step.places
                .iter()
                .map(|(s, i, j)| if *s == 0 { f(*i as i64, *j as i64) } else { f(0, *i as i64) })
                .collect()
        };
        let matrix = step.matrix.as_ref().unwrap();
        let product = net(&|i, j| ratio(i * j, 1));
        assert_eq!(matrix.apply(&product), product.iter().map(|x| x * ratio(1, 4)).collect::<Vec<_>>());
        let phi = |i: i64, j: i64| match (i, j) {
            (i, 0) => ratio(3 * i * i - 1, 3),
            (0, j) => ratio(3 * j * j - 1, 3),
            _ => ratio(4, 3),
        };
        let (first, image) = (net(&phi), matrix.apply(&net(&phi)));
        for (place, wanted) in [((0, 0, 0), ratio(-1, 12)), ((0, 1, 0), ratio(1, 6)), ((0, 1, 1), ratio(7, 12))] {
            let at = step.numbers[&place];
            assert_eq!((&image[at], &image[at]), (&wanted, &(&first[at] * ratio(1, 4) + &product[at] * ratio(1, 4))));
        }
    }
}
