//! One member of a family of joined surfaces: its free stencils, and what is known of the pieces of the intermediate face in itself.

use super::family::{Free, SurfaceJunction};
use super::grid::{Grid, refined};
use super::{FaceSide, SurfaceError};
use crate::arith::{Rational, to_f64};
use crate::junction::member::{least, least_weighted, nearness};
use crate::junction::place::{Placed, precise};
use crate::junction::{JunctionError, Pattern};
use crate::linalg::{Matrix, dot};
use crate::radius::{Options, System, joint_radius};

/// How the free stencils are found.
#[derive(Debug, Clone)]
pub enum Choice {
    /// The stencil of the curve across the border times a row along it, which carries powers from one scheme to the other; the free
    /// rows of the curve may be given.
    SemiTensor(Vec<Vec<Rational>>),
    /// The least weighted norm of each stencil, among those that reproduce polynomials of a total degree.
    Least,
    /// Stencils of the designer.
    Given(Vec<Vec<Rational>>),
}

/// What is asked of a junction.
#[derive(Debug, Clone)]
pub struct Plan {
    /// The pieces of the intermediate face across the border.
    pub pattern: Option<Pattern>,
    /// How its stencils are found.
    pub choice: Choice,
}

/// What is known of the pieces of the intermediate face in itself.
#[derive(Debug, Clone)]
pub struct SurfaceCheck {
    /// The dimension of the vectors that positions do not see; of all vectors of sum 0 where stencils do not reproduce positions.
    pub dim: usize,
    /// An upper bound of the joint spectral radius of these pieces there.
    pub bound: Option<Rational>,
    /// What it has to stay below: the size of the pieces, or 1.
    pub threshold: Rational,
    /// Whether it does.
    pub passes: bool,
}

/// A member.
#[derive(Debug, Clone)]
pub struct SurfaceMember {
    /// The family.
    pub family: SurfaceJunction,
    /// Its free stencils, on the points of the edge across the border or of the face.
    pub stencils: Vec<Vec<Rational>>,
    /// The positions `u`, `v` of the points of the intermediate face, where both schemes reproduce some.
    pub positions: Option<[Vec<Rational>; 2]>,
    /// Whether all new points reproduce them.
    pub precise: bool,
    /// The degree up to which polynomials are asked for.
    pub degree: usize,
    /// What is known of it.
    pub check: SurfaceCheck,
}

/// What was found, and what did not pass: pattern, degree, bound.
#[derive(Debug, Clone)]
pub struct SurfaceFound {
    /// The member; `None` where none passed.
    pub member: Option<SurfaceMember>,
    /// Patterns and degrees that did not pass, with the bound that was found.
    pub tried: Vec<(Pattern, usize, Option<Rational>)>,
}

/// Patterns by length, the numbers of pieces on the left first.
const PATTERNS: [[usize; 2]; 8] = [[1, 0], [0, 1], [1, 1], [2, 1], [1, 2], [2, 2], [2, 3], [3, 3]];
/// The search for a bound: about a second.
const WORK: u64 = 1_000_000_000;
/// Relative widths of bounds that are good enough, at first and where that does not decide.
const WIDTHS: [f64; 2] = [0.25, 0.02];

/// Looks for a junction of two face schemes.
///
/// # Errors
/// [`SurfaceError`] where what was asked for does not fit the schemes. That no member passes is no error.
///
/// # Cost
/// One joint spectral radius for every member that is tried.
///
/// # Examples
/// ```
/// use secant::arith::ratio;
/// use secant::junction::surface::{Choice, FaceSide, Plan, find};
/// use secant::junction::{Pattern, Side};
/// use secant::scheme::bspline;
///
/// let side = |degree| Side::of("spline", &bspline(degree, 2).unwrap().curve().unwrap()).unwrap();
/// let doo_sabin = FaceSide::new("doo-sabin", side(2), side(2))?;
/// let catmull_clark = FaceSide::new("catmull-clark", side(3), side(3))?;
/// let row = vec![ratio(0, 1), ratio(1, 4), ratio(3, 16), ratio(1, 2), ratio(1, 16)];
/// let plan = Plan { pattern: Some(Pattern { left: 1, right: 0 }), choice: Choice::SemiTensor(vec![row]) };
/// let member = find(&doo_sabin, &catmull_clark, &plan)?.member.expect("these can be joined");
/// assert_eq!((member.family.points(), member.family.parameters(), member.check.dim), ([18, 13], 24, 15));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn find(left: &FaceSide, right: &FaceSide, plan: &Plan) -> Result<SurfaceFound, SurfaceError> {
    let mut found = SurfaceFound { member: None, tried: Vec::new() };
    let asked = plan.pattern.map(|p| [p.left, p.right]);
    let free = match &plan.choice {
        Choice::SemiTensor(rows) => rows.is_empty(),
        Choice::Least => true,
        Choice::Given(_) => false,
    };
    if asked.is_none() && !free {
        return Err(SurfaceError::Stencil("stencils and rows belong to a pattern, which is not given".to_owned()));
    }
    for [k, m] in asked.map_or_else(|| PATTERNS.to_vec(), |one| vec![one]) {
        let family = SurfaceJunction::new(left, right, Pattern { left: k, right: m })?;
        for member in family.members(&plan.choice)? {
            let member = member?;
            // What the designer asks for only has to contract.
            if member.check.passes {
                found.member = Some(member);
                return Ok(found);
            }
            found.tried.push((family.across.pattern, member.degree, member.check.bound));
        }
    }
    Ok(found)
}

/// Values of powers on the points of a vertex and of a cell, by kind.
struct Powers {
    across: [Vec<Vec<Rational>>; 2],
    along: [Vec<Vec<Rational>>; 2],
}

impl SurfaceJunction {
    /// The members of a choice, from the highest degree.
    fn members(&self, choice: &Choice) -> Result<Vec<Result<SurfaceMember, SurfaceError>>, SurfaceError> {
        let powers = Powers {
            across: [self.left.across.powers(), self.right.across.powers()],
            along: [self.left.along.powers(), self.right.along.powers()],
        };
        let common = |p: &[Vec<Vec<Rational>>; 2]| p[0].len().min(p[1].len()) - 1;
        let (across, along) = (common(&powers.across), common(&powers.along));
        let placed = match across {
            0 => None,
            degree => precise(&self.across, [&powers.across[0], &powers.across[1]], degree),
        };
        let positions = placed.as_ref().filter(|_| along > 0).map(|p| self.positions(p, &powers));
        if let Choice::Given(stencils) = choice {
            return Ok(vec![self.member(stencils.clone(), positions, 1)]);
        }
        let (Some(placed), Some(_)) = (placed, &positions) else { return Ok(Vec::new()) };
        let top = across.min(along);
        let degrees: Vec<usize> = match choice {
            Choice::SemiTensor(rows) if !rows.is_empty() => vec![top],
            _ => (1..=top).rev().collect(),
        };
        let mut members = Vec::new();
        for degree in degrees {
            let placed = placed.up_to(degree);
            let stencils = match choice {
                Choice::SemiTensor(rows) => self.semi_tensor(&placed, &powers, rows)?,
                _ => self.least(&placed, &powers),
            };
            if let Some(stencils) = stencils {
                members.push(self.member(stencils, positions.clone(), degree));
            }
        }
        Ok(members)
    }

    /// The positions `u` and `v` of the points of the intermediate face.
    fn positions(&self, placed: &Placed, powers: &Powers) -> [Vec<Rational>; 2] {
        let points = self.face.points();
        let u = points.iter().map(|(c, _)| placed.positions()[*c].clone());
        let v = points.iter().map(|(c, r)| powers.along[self.face.kind(*c)][1][*r].clone());
        [u.collect(), v.collect()]
    }

    /// The positions `u` and `v` of the points of the joined surface, the border between its first two columns at `u = 0`, where both schemes
    /// reproduce some.
    #[must_use]
    pub fn all_positions(&self) -> Option<[Vec<Rational>; 2]> {
        let along = [self.left.along.powers(), self.right.along.powers()];
        let across = [self.left.across.powers(), self.right.across.powers()];
        if along.iter().chain(&across).any(|p| p.len() < 2) {
            return None;
        }
        let (n, m) = (self.left.across.points(), self.right.across.points());
        let one = Rational::from(1);
        let column = |c: usize| if c < n { &across[0][1][c] - &one } else { &across[1][1][c - n] + self.length() };
        let whole = Grid::new(self.heights, [n, m], super::strip::ROWS);
        let row = |kind: usize, r: usize| {
            let (step, top) = (self.heights.step(kind), self.heights.cell[kind]);
            let cell = (r / step.max(1)).min(super::strip::ROWS - 1);
            let inside = (r - cell * step).min(top - 1);
            &along[kind][1][inside] + Rational::from(cell)
        };
        let points = whole.points();
        let u = points.iter().map(|(c, _)| column(*c)).collect();
        let v = points.iter().map(|(c, r)| row(whole.kind(*c), *r)).collect();
        Some([u, v])
    }

    /// The row of a free point on the points of its own kind along the border.
    fn rule(&self, free: &Free) -> Vec<Rational> {
        refined(&self.side(self.net.kind(free.column)).along, free.at_vertex).row(free.row).to_vec()
    }

    /// The values of powers along the border at a free point.
    fn values(&self, free: &Free, powers: &Powers) -> Vec<Rational> {
        let rule = self.rule(free);
        powers.along[self.net.kind(free.column)].iter().map(|q| dot(&rule, &q[..rule.len()])).collect()
    }

    /// Stencils of the curve across the border times rows along it.
    fn semi_tensor(
        &self,
        placed: &Placed,
        powers: &Powers,
        given: &[Vec<Rational>],
    ) -> Result<Option<Vec<Vec<Rational>>>, SurfaceError> {
        let forced = self.across.forced()?;
        let open: Vec<usize> = (0..forced.len()).filter(|c| forced[*c].is_none()).collect();
        let rows: Option<Vec<Vec<Rational>>> = match given {
            [] => open.iter().map(|c| least(placed, *c)).collect(),
            rows => {
                self.across.array(rows)?;
                Some(rows.to_vec())
            }
        };
        let Some(rows) = rows else { return Ok(None) };
        let mut stencils = Vec::new();
        for free in &self.free {
            let Some(at) = open.iter().position(|c| *c == free.column) else { return Ok(None) };
            let Some(stencil) = self.product(free, &rows[at], powers, placed.degree()) else { return Ok(None) };
            stencils.push(stencil);
        }
        Ok(Some(stencils))
    }

    /// A row across the border times a row along it on the columns of each kind.
    fn product(&self, free: &Free, across: &[Rational], powers: &Powers, degree: usize) -> Option<Vec<Rational>> {
        let domain = self.domain(free);
        let along = [self.row_along(free, 0, powers, degree), self.row_along(free, 1, powers, degree)];
        let entry = |(c, r): (usize, usize)| match (&across[c], &along[domain.kind(c)]) {
            (x, _) if *x == 0 => Some(Rational::from(0)),
            (x, Some(row)) => Some(x * &row[r]),
            (_, None) => None,
        };
        domain.points().into_iter().map(entry).collect()
    }

    /// The row of a free point on the points of a kind along the border: the rule of its own scheme; of the other scheme's points those that
    /// the stencil may use, with the highest powers that these can carry.
    fn row_along(&self, free: &Free, kind: usize, powers: &Powers, degree: usize) -> Option<Vec<Rational>> {
        let domain = self.domain(free);
        let column = (0..domain.width()).find(|c| domain.kind(*c) == kind)?;
        let usable: Vec<usize> = free.support.iter().filter(|p| p.0 == column).map(|p| p.1).collect();
        if kind == self.net.kind(free.column) {
            let rule = self.rule(free);
            return (0..rule.len()).all(|r| rule[r] == 0 || usable.contains(&r)).then_some(rule);
        }
        let (values, q) = (self.values(free, powers), &powers.along[kind]);
        let weights: Vec<Rational> = usable.iter().map(|r| nearness(&[&q[1][*r] - &values[1]])).collect();
        let carried = |d: usize| {
            let c = Matrix::from_fn(d + 1, usable.len(), |i, j| q[i][usable[j]].clone());
            least_weighted(&c, &weights, &values[..=d])
        };
        let found = (1..=degree).rev().find_map(carried)?;
        let mut row = vec![Rational::from(0); domain.height(column)];
        usable.iter().zip(found).for_each(|(r, x)| row[*r] = x);
        Some(row)
    }

    /// Stencils of the least weighted norm that reproduce polynomials of a total degree.
    fn least(&self, placed: &Placed, powers: &Powers) -> Option<Vec<Vec<Rational>>> {
        let degree = placed.degree();
        let powers_of: Vec<(usize, usize)> = (0..=degree).flat_map(|i| (0..=degree - i).map(move |j| (i, j))).collect();
        let stencil = |free: &Free| {
            let (domain, target) = (self.domain(free), &placed.targets[free.column]);
            let values = self.values(free, powers);
            let of = |(c, r): (usize, usize), (i, j): (usize, usize)| {
                &placed.values[(i, c)] * &powers.along[domain.kind(c)][j][r]
            };
            let c = Matrix::from_fn(powers_of.len(), free.support.len(), |k, p| of(free.support[p], powers_of[k]));
            let wanted: Vec<Rational> = powers_of.iter().map(|(i, j)| &target[*i] * &values[*j]).collect();
            let weight = |p: &(usize, usize)| nearness(&[of(*p, (1, 0)) - &target[1], of(*p, (0, 1)) - &values[1]]);
            let weights: Vec<Rational> = free.support.iter().map(weight).collect();
            let row = least_weighted(&c, &weights, &wanted)?;
            let mut all = vec![Rational::from(0); domain.len()];
            free.support.iter().zip(row).for_each(|((c, r), x)| all[domain.index(*c, *r)] = x);
            Some(all)
        };
        self.free.iter().map(stencil).collect()
    }

    fn member(
        &self,
        stencils: Vec<Vec<Rational>>,
        positions: Option<[Vec<Rational>; 2]>,
        degree: usize,
    ) -> Result<SurfaceMember, SurfaceError> {
        let net = self.array(&stencils, false)?;
        let precise = positions.as_ref().is_some_and(|p| self.reproduces(&net, p));
        let check = self.check(&net, positions.as_ref().filter(|_| precise))?;
        Ok(SurfaceMember { family: self.clone(), stencils, positions, precise, degree, check })
    }

    /// Whether all refined points lie where affine functions have them: at `(A x + b)`, in every window of a piece.
    fn reproduces(&self, net: &Matrix, positions: &[Vec<Rational>; 2]) -> bool {
        let share = Rational::from(1) / Rational::from(self.arity());
        let (k, face) = (self.across.pattern.left, &self.face);
        let (first, _) = self.across.windows()[k];
        let values: Vec<[Rational; 2]> =
            (0..net.rows()).map(|r| [0, 1].map(|d: usize| dot(net.row(r), &positions[d]))).collect();
        // Within the copies of the face in itself; the other columns are those of the schemes, or free points beside these.
        let inside = (0..self.arity()).all(|row| {
            let window = self.net.window(first, face, row);
            (0..2).all(|d| {
                let shift = |i: usize| &values[window[i]][d] - &share * &positions[d][i];
                (1..window.len()).all(|i| shift(i) == shift(0))
            })
        });
        inside && self.scheme_windows(&share, &values)
    }

    /// The same within the pieces of both schemes.
    fn scheme_windows(&self, share: &Rational, values: &[[Rational; 2]]) -> bool {
        let pattern = self.across.pattern;
        self.across.windows().into_iter().enumerate().filter(|(i, _)| *i != pattern.left).all(|(i, (first, _))| {
            let kind = usize::from(i > pattern.left);
            let side = self.side(kind);
            let width = side.across.points();
            let part = Grid::new(self.heights, if kind == 0 { [width, 0] } else { [0, width] }, 1);
            let (u, v) = (side.across.powers(), side.along.powers());
            (0..self.arity()).all(|row| {
                let window = self.net.window(first, &part, row);
                let own: Vec<[&Rational; 2]> = part.points().iter().map(|(c, r)| [&u[1][*c], &v[1][*r]]).collect();
                (0..2).all(|d| {
                    let shift = |i: usize| &values[window[i]][d] - share * own[i][d];
                    (1..window.len()).all(|i| shift(i) == shift(0))
                })
            })
        })
    }

    /// The pieces of the intermediate face in itself, on what positions do not see.
    fn check(&self, net: &Matrix, positions: Option<&[Vec<Rational>; 2]>) -> Result<SurfaceCheck, SurfaceError> {
        let n = self.face.len();
        let mut rows = vec![vec![Rational::from(1); n]];
        rows.extend(positions.iter().flat_map(|p| p.iter().cloned()));
        let kernel = Matrix::from_rows(n, rows).kernel();
        let (first, _) = self.across.windows()[self.across.pattern.left];
        let mut on_kernel = Vec::new();
        for row in 0..self.arity() {
            let window = self.net.window(first, &self.face, row);
            let op = Matrix::from_fn(n, n, |i, j| net[(window[j], i)].clone());
            let image = kernel.solve(&(&op * &kernel));
            on_kernel.push(image.ok_or_else(|| SurfaceError::Stencil("positions are not kept".to_owned()))?);
        }
        let threshold = match positions {
            Some(_) => Rational::from(1) / Rational::from(self.arity()),
            None => Rational::from(1),
        };
        let system = System::plain(&on_kernel).map_err(|e| JunctionError::Rows(e.to_string()))?;
        let mut bound: Option<Rational> = None;
        let below = |bound: &Option<Rational>| bound.as_ref().is_some_and(|b| *b < threshold);
        for width in WIDTHS {
            let options = Options { work: Some(WORK), width, longest: 8, ..Options::default() };
            let radius = joint_radius(&system, &options).map_err(|e| JunctionError::Rows(e.to_string()))?;
            bound = radius.upper.or(bound);
            let above = radius.lower.as_ref().is_some_and(|lower| lower.is_at_least(&threshold));
            if below(&bound) || above {
                break;
            }
        }
        let passes = below(&bound);
        Ok(SurfaceCheck { dim: kernel.cols(), bound, threshold, passes })
    }
}

impl SurfaceCheck {
    /// The bound as a decimal, for people.
    #[must_use]
    pub fn about(&self) -> Option<f64> {
        self.bound.as_ref().map(to_f64)
    }
}
