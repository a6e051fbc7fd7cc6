//! All rings around an extraordinary vertex: from some ring on the net is so close to the characteristic map that the surface is
//! immersed in the plane of the leading coefficients (theory, “A whole mesh”).

use super::near::{Near, PLACES, Point, difference, dot};
use super::patch::{Patch, places};
use crate::base::{Checked, Q, need, spend, whole};
use crate::vertex::Leading;
use crate::vertex::ball::Ball;
use crate::vertex::mesh::{Place, locate};
use num_traits::One;

/// The rings of points of a net.
pub const RINGS: i64 = 3;
/// The longest power of the subdivision matrix that is looked at.
const POWERS: usize = 160;
/// How often patches of the characteristic map are halved: what leaves most room is taken.
const HALVINGS: [usize; 2] = [4, 8];
/// Rings that are looked at one by one at most.
const MAX_RINGS: usize = 64;
/// How often a patch is halved at most.
pub const DEPTH: usize = 11;

/// The patches of the ring of a sector, by their first corner, and of triangles the sign of their sides.
const CELLS: [(Place, i64); 3] = [((1, 0), 1), ((1, 1), 1), ((0, 1), 1)];
const TRIANGLES: [(Place, i64); 3] = [((1, 0), 1), ((1, 1), -1), ((0, 1), 1)];

/// What the rings around all vertices of one valence have in common.
pub struct Tail {
    valence: usize,
    triangles: bool,
    places: Vec<Place>,
    /// The centre and the points of sector 0 after a step; of other sectors they are turned.
    rows: Vec<Vec<(Option<(usize, i64)>, Near)>>,
    /// `1/λ`.
    inverse: Near,
    /// The limit point.
    mean: Vec<Near>,
    /// The leading coefficient, divided by the valence.
    left: Vec<[Near; 2]>,
    /// The map of which this coefficient is that of the plane.
    map: Vec<[Near; 2]>,
    /// A net this close to the map, in each point, is so in all later rings that these are immersed, in units.
    close: i128,
}

fn real(x: &Q) -> Near {
    Near::of(&Ball::real(x))[0]
}

/// The leading coefficient of the neighbours and, of quadrangles, the opposite corners, in sector `s`: a left eigenvector of block 1.
pub fn coefficient(leading: &Leading, s: usize) -> [Ball; 2] {
    let turn = |k: usize| leading.mesh.power(-(k as i64));
    if leading.mesh.triangles() {
        return [turn(s).clone(), Ball::zero()];
    }
    let alpha = leading.value.times(&Ball::real(&whole(16))).minus(&Ball::real(&whole(4)));
    [turn(s).times(&alpha), turn(s).plus(turn(s + 1))]
}

/// The limit point: the weights of the vertex, of its neighbours together, and of the opposite corners together.
pub fn mean(leading: &Leading) -> Checked<[Ball; 3]> {
    let n = leading.mesh.valence() as i64;
    if leading.mesh.triangles() {
        let share = leading.mesh.at_centre()[1].times(&Ball::real(&whole(8)));
        let inverse = share.plus(&Ball::real(&whole(3))).inverse()?;
        return Ok([inverse.times(&Ball::real(&whole(3))), inverse.times(&share), Ball::zero()]);
    }
    Ok([n, 4, 1].map(|w| Ball::real(&(whole(w) / whole(n + 5)))))
}

impl Tail {
    /// The bounds at a valence.
    pub fn new(leading: &Leading) -> Checked<Self> {
        let mesh = &leading.mesh;
        let (n, triangles) = (mesh.valence(), mesh.triangles());
        let places = mesh.places(RINGS);
        let size = 1 + n * places.len();
        let mut tail = Self {
            valence: n,
            triangles,
            rows: Vec::new(),
            inverse: Near::of(&leading.value.inverse()?)[0],
            mean: vec![Near::ZERO; size],
            left: vec![[Near::ZERO; 2]; size],
            map: vec![[Near::ZERO; 2]; size],
            places,
            close: 0,
        };
        tail.functionals(leading)?;
        tail.matrix(leading)?;
        let growth = tail.growth()?;
        let mut room = None;
        for depth in HALVINGS {
            room = room.max(tail.room(depth)?);
        }
        let Some(room) = room else {
            return crate::base::reject("limit", "no room around the characteristic map is seen");
        };
        let close = real(&Q::new(room.into(), num_bigint::BigInt::one() << PLACES)).over(growth);
        need(close.sign() == 1, "limit", "no room around the characteristic map is seen")?;
        tail.close = close.middle() - close.error();
        Ok(tail)
    }

    /// The places of a sector, in the order of a net.
    pub fn places(&self) -> &[Place] {
        &self.places
    }

    fn index(&self, sector: i64, place: usize) -> usize {
        1 + sector.rem_euclid(self.valence as i64) as usize * self.places.len() + place
    }

    /// The number of a place of the continued lattice, and its turn; `None` for the centre.
    fn known(&self, place: Place) -> Checked<Option<(usize, i64)>> {
        let Some((place, turn)) = locate(self.triangles, false, place) else { return Ok(None) };
        let known = self.places.iter().position(|p| *p == place);
        Ok(Some((crate::base::some(known, "vertex", "a point outside the rings")?, turn)))
    }

    fn functionals(&mut self, leading: &Leading) -> Checked<()> {
        let n = self.valence;
        let part = Ball::real(&(Q::one() / whole(n as i64)));
        let [own, edges, corners] = mean(leading)?;
        self.mean[0] = Near::of(&own)[0];
        let mut scale = Ball::zero();
        let ends = [(1, 0), (1, 1)].map(|p| self.places.iter().position(|q| *q == p));
        for s in 0..n {
            let pairs = ends.iter().zip(coefficient(leading, s)).zip([&edges, &corners]);
            for ((end, weight), share) in pairs.take(if self.triangles { 1 } else { 2 }) {
                let Some(place) = *end else { return crate::base::reject("vertex", "a point outside the rings") };
                let (at, weight) = (self.index(s as i64, place), weight.times(&part));
                self.mean[at] = Near::of(&share.times(&part))[0];
                self.left[at] = Near::of(&weight);
                let value = mesh_value(leading, self.places[place], s)?;
                scale = scale.plus(&weight.times(&value));
            }
        }
        // A(map) = 2, so that the coefficients of its real and imaginary part are those of a and b.
        let scale = scale.inverse()?.times(&Ball::real(&whole(2)));
        for s in 0..n {
            for (p, place) in self.places.iter().enumerate() {
                self.map[1 + s * self.places.len() + p] = Near::of(&mesh_value(leading, *place, s)?.times(&scale));
            }
        }
        Ok(())
    }

    fn matrix(&mut self, leading: &Leading) -> Checked<()> {
        let n = self.valence;
        let part = Ball::real(&(Q::one() / whole(n as i64)));
        let [own, edges, corners] = leading.mesh.at_centre();
        let mut centre = vec![(None, Near::of(&own)[0])];
        for (place, weight) in [((1, 0), edges), ((1, 1), corners)].into_iter().take(if self.triangles { 1 } else { 2 })
        {
            let Some((place, _)) = self.known(place)? else { continue };
            centre.extend((0..n as i64).map(|s| (Some((place, s)), Near::of(&weight.times(&part))[0])));
        }
        self.rows.push(centre);
        for place in &self.places {
            let term = |(old, weight): (Option<(Place, i64)>, Ball)| {
                let old = match old {
                    None => None,
                    Some((place, turn)) => {
                        let known = self.places.iter().position(|p| *p == place);
                        Some((crate::base::some(known, "vertex", "a point outside the rings")?, turn))
                    }
                };
                Ok((old, Near::of(&weight)[0]))
            };
            let row = leading.mesh.stencil(*place)?.into_iter().map(term).collect::<Checked<_>>()?;
            self.rows.push(row);
        }
        Ok(())
    }

    /// The old points of the new point of a number, with their weights.
    fn row(&self, point: usize) -> impl Iterator<Item = (usize, Near)> + '_ {
        let count = self.places.len();
        let (own, sector) = if point == 0 { (0, 0) } else { (1 + (point - 1) % count, ((point - 1) / count) as i64) };
        self.rows[own].iter().map(move |(old, weight)| match old {
            None => (0, *weight),
            Some((place, turn)) => (self.index(sector + turn, *place), *weight),
        })
    }

    /// `sup |S^j r| / λ^j |r|`, maximum norm, over the nets without limit point and leading coefficient: once such a norm is at most
    /// 1, those before it are all. By symmetry the rows of the centre and of one sector do.
    fn growth(&self) -> Checked<Near> {
        let size = self.map.len();
        let project = |i: usize| -> Vec<Near> {
            let entry = |k: usize| {
                let ([x, y], [a, b]) = (self.map[i], self.left[k]);
                let own = if i == k { Near::ONE } else { Near::ZERO };
                own.minus(self.mean[k]).minus(x.times(a)).plus(y.times(b))
            };
            (0..size).map(entry).collect()
        };
        let mut rows: Vec<Vec<Near>> = (0..=self.places.len()).map(project).collect();
        let mut growth = 0;
        for power in 0..POWERS {
            let mut most = 0_i128;
            for row in &rows {
                let all = row.iter().map(|x| x.at_most()).sum::<Option<i128>>();
                most = most.max(crate::base::some(all, "limit", "no common bound of all rings is seen")?);
            }
            growth = growth.max(most);
            if power > 0 && most <= 1 << PLACES {
                return Ok(real(&Q::new(growth.into(), num_bigint::BigInt::one() << PLACES)));
            }
            spend(10 * size * rows.len(), 128)?;
            for row in &mut rows {
                let mut next = vec![Near::ZERO; size];
                for (i, x) in row.iter().enumerate() {
                    for (k, weight) in self.row(i) {
                        next[k] = next[k].plus(x.times(weight));
                    }
                }
                *row = next.into_iter().map(|x| x.times(self.inverse)).collect();
            }
        }
        crate::base::reject("limit", "no common bound of all rings is seen")
    }

    /// The patches of the ring of a sector.
    fn patches(&self, sector: usize, point: &dyn Fn(usize) -> Point) -> Checked<Vec<Patch>> {
        let cells = if self.triangles { TRIANGLES } else { CELLS };
        let patch = |((a, b), sign): &(Place, i64)| {
            let at = |(i, j): (i64, i64)| {
                let known = self.known((a + sign * i, b + sign * j))?;
                Ok(point(match known {
                    Some((place, turn)) => self.index(sector as i64 + turn, place),
                    None => 0,
                }))
            };
            let points = places(self.triangles).into_iter().map(at).collect::<Checked<Vec<_>>>()?;
            Ok(Patch::new(self.triangles, &points))
        };
        cells.iter().map(patch).collect()
    }

    fn room(&self, depth: usize) -> Checked<Option<i128>> {
        let mut least = Some(i128::MAX);
        for patch in self.patches(0, &|k| [self.map[k][0], self.map[k][1], Near::ZERO])? {
            least = match (least, patch.room(depth)?) {
                (Some(a), Some(b)) => Some(a.min(b)),
                _ => None,
            };
        }
        Ok(least)
    }

    /// The net after a step. Points beyond the second ring need not be known before.
    fn step(&self, net: &[Point]) -> Vec<Point> {
        let new = |i: usize| {
            std::array::from_fn(|k| self.row(i).fold(Near::ZERO, |sum, (j, weight)| sum.plus(weight.times(net[j][k]))))
        };
        (0..net.len()).map(new).collect()
    }

    /// Demands that all rings are immersed: each of the first ones, and all later ones by one bound. The net has the centre, then sector
    /// by sector the places of three rings, of which the third is not used.
    pub fn are_immersed(&self, net: &[Point]) -> Checked<()> {
        need(net.len() == self.map.len(), "vertex", "the net has the points of three rings")?;
        let net = self.step(net);
        let centre: Point =
            std::array::from_fn(|k| net.iter().zip(&self.mean).fold(Near::ZERO, |s, (p, w)| s.plus(p[k].times(*w))));
        let moved: Vec<Point> = net.iter().map(|p| difference(p, &centre)).collect();
        let most = moved.iter().flatten().map(|x| x.at_most()).try_fold(0, |m: i128, x| Some(m.max(x?)));
        let most = crate::base::some(most.filter(|m| *m > 0), "limit", "a point around a vertex is not known")?;
        // The largest coordinate becomes about 1/16.
        let by = (most.leading_zeros() as usize + PLACES).saturating_sub(131) as u32;
        let mut net: Vec<Point> = moved.iter().map(|p| p.map(|x| x.enlarged(by))).collect();
        let sum = |part: &dyn Fn(usize) -> Near| -> Point {
            std::array::from_fn(|k| net.iter().enumerate().fold(Near::ZERO, |s, (i, p)| s.plus(p[k].times(part(i)))))
        };
        let (a, b) = (sum(&|i| self.left[i][0]), sum(&|i| self.left[i][1].negative()));
        let (aa, ab, bb) = (dot(&a, &a), dot(&a, &b), dot(&b, &b));
        let size = aa.times(bb).minus(ab.times(ab));
        need(size.sign() == 1, "limit", "the leading coefficients are not seen to be independent")?;
        let off = |(p, [x, y]): (&Point, &[Near; 2])| {
            let (u, v) = (dot(p, &a), dot(p, &b));
            let first = bb.times(u).minus(ab.times(v)).over(size).minus(*x).at_most();
            let second = aa.times(v).minus(ab.times(u)).over(size).minus(*y).at_most();
            Some([first?, second?])
        };
        for _ in 0..MAX_RINGS {
            spend(50 * net.len(), 128)?;
            // Lengths are compared by their squares.
            let near = |both: Option<[i128; 2]>| both.is_some_and(|[x, y]| x * x + y * y < self.close * self.close);
            if net.iter().zip(&self.map).map(off).all(near) {
                return Ok(());
            }
            for sector in 0..self.valence {
                for patch in self.patches(sector, &|k| net[k])? {
                    need(patch.is_regular(DEPTH)?, "limit", "a ring around a vertex is not seen to be immersed")?;
                }
            }
            net = self.step(&net).into_iter().map(|p| p.map(|x| x.times(self.inverse))).collect();
        }
        crate::base::reject("limit", "the rings around a vertex are under no common bound")
    }
}

/// The value of the eigenvector at a place of a sector.
fn mesh_value(leading: &Leading, place: Place, sector: usize) -> Checked<Ball> {
    leading.mesh.at(&leading.net, Some((place, sector as i64)))
}
