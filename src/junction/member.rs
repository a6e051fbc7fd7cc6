//! One member of a family of junctions: its free rows by the least weighted norm, what is left to the designer, and the check.

use super::{Junction, JunctionError, Placed};
use crate::algebraic::Root;
use crate::arith::{Rational, abs};
use crate::jordan::modulus_classes;
use crate::linalg::{Matrix, dot};
use std::cmp::Ordering;

/// A direction in which a free row may be moved without changing what it reproduces.
#[derive(Debug, Clone)]
pub struct Slider {
    /// `tau` where there is one slider, otherwise `tau1`, `tau2`, …
    pub name: String,
    /// Which of the free rows.
    pub free: usize,
    /// The direction.
    pub direction: Vec<Rational>,
}

/// What is known of the piece `I -> I`.
#[derive(Debug, Clone)]
pub struct Check {
    /// The eigenvalues of its operator by modulus, 1 among them.
    pub eigenvalues: Vec<Vec<Root>>,
    /// Those on the vectors that positions do not see; all but 1 where there are no positions.
    pub rest: Vec<Vec<Root>>,
    /// What these have to stay below: the factor of the positions, or 1.
    pub threshold: Rational,
    /// Whether they do.
    pub passes: bool,
    /// Whether the joined curve contracts.
    pub contracts: bool,
    /// Whether the operators of all pieces are injective.
    pub injective: bool,
}

/// A member.
#[derive(Debug, Clone)]
pub struct Member {
    /// The family.
    pub junction: Junction,
    /// Positions and powers that it reproduces, where there are some.
    pub placed: Option<Placed>,
    /// Its free rows.
    pub free: Vec<Vec<Rational>>,
    /// All rows.
    pub array: Matrix,
    /// What may be changed.
    pub sliders: Vec<Slider>,
    /// What is known of it.
    pub check: Check,
}

impl Member {
    /// The member with the least weighted norms; `None` where a row cannot take its values.
    pub(super) fn canonical(
        junction: &Junction,
        placed: &Placed,
        settings: &[(String, Rational)],
    ) -> Result<Option<Self>, JunctionError> {
        let forced = junction.forced()?;
        let open: Vec<usize> = (0..forced.len()).filter(|r| forced[*r].is_none()).collect();
        let rows: Option<Vec<Vec<Rational>>> = open.iter().map(|r| least(placed, *r)).collect();
        let Some(mut free) = rows else { return Ok(None) };
        let sliders = sliders(placed, &open);
        for (name, value) in settings {
            let moved: Vec<&Slider> = sliders.iter().filter(|s| s.name == *name || name == "tau").collect();
            if moved.is_empty() {
                let names: Vec<&str> = sliders.iter().map(|s| s.name.as_str()).collect();
                let known = if names.is_empty() {
                    "there is none".to_owned()
                } else {
                    format!("there are {}", names.join(", "))
                };
                return Err(JunctionError::Slider { name: name.clone(), known });
            }
            for slider in moved {
                free[slider.free].iter_mut().zip(&slider.direction).for_each(|(x, z)| *x += value * z);
            }
        }
        Self::checked(junction, Some(placed.clone()), free, sliders).map(Some)
    }

    /// A member with given rows.
    pub(super) fn given(
        junction: &Junction,
        placed: Option<Placed>,
        free: Vec<Vec<Rational>>,
    ) -> Result<Self, JunctionError> {
        Self::checked(junction, placed, free, Vec::new())
    }

    fn checked(
        junction: &Junction,
        placed: Option<Placed>,
        free: Vec<Vec<Rational>>,
        sliders: Vec<Slider>,
    ) -> Result<Self, JunctionError> {
        let array = junction.array(&free)?;
        let check = Check::of(junction, &array, placed.as_ref());
        Ok(Self { junction: junction.clone(), placed, free, array, sliders, check })
    }
}

/// The row of least weighted norm for a new point, with weights that fall off with the distance from it.
pub(super) fn least(placed: &Placed, row: usize) -> Option<Vec<Rational>> {
    let (positions, target) = (placed.positions(), &placed.targets[row]);
    let weights: Vec<Rational> = positions.iter().map(|x| nearness(&[x - &target[1]])).collect();
    if placed.values.rank() < placed.values.rows() {
        return None;
    }
    least_weighted(&placed.values, &weights, target)
}

/// `1/(1/4 + |d|²)`.
pub(super) fn nearness(away: &[Rational]) -> Rational {
    let quarter = Rational::from(1) / Rational::from(4);
    Rational::from(1) / away.iter().fold(quarter, |sum, d| sum + d * d)
}

/// The row `r = W Cᵀ (C W Cᵀ)⁻¹ t` of least `Σ r_i²/w_i` under `C r = t`; `None` where there is none.
pub(super) fn least_weighted(c: &Matrix, weights: &[Rational], target: &[Rational]) -> Option<Vec<Rational>> {
    let weighted = Matrix::from_fn(c.cols(), c.rows(), |i, d| &c[(d, i)] * &weights[i]);
    let target = Matrix::from_columns(target.len(), &[target.to_vec()]);
    let factors = (c * &weighted).solve(&target)?.column(0);
    let row = weighted.apply(&factors);
    (c.apply(&row) == target.column(0)).then_some(row)
}

/// For each free row the direction that comes nearest to its nearest point, where there is any.
fn sliders(placed: &Placed, open: &[usize]) -> Vec<Slider> {
    let c = &placed.values;
    let Some(inverse) = (c * &c.transpose()).inverse() else { return Vec::new() };
    let n = c.cols();
    let direction = |row: usize| {
        let mut order: Vec<usize> = (0..n).collect();
        let away = |i: &usize| abs(&(&placed.positions()[*i] - &placed.targets[row][1]));
        order.sort_by(|i, j| away(i).cmp(&away(j)).then(i.cmp(j)));
        order.into_iter().find_map(|i| {
            let factors = inverse.apply(&c.column(i));
            let own = |j: usize| Rational::from(u8::from(i == j)) - dot(&factors, &c.column(j));
            let z: Vec<Rational> = (0..n).map(own).collect();
            z.iter().any(|x| *x != 0).then_some(z)
        })
    };
    let found: Vec<(usize, Vec<Rational>)> =
        open.iter().enumerate().filter_map(|(k, r)| Some((k, direction(*r)?))).collect();
    let single = found.len() == 1;
    let name = |k: usize| if single { "tau".to_owned() } else { format!("tau{}", k + 1) };
    found.into_iter().map(|(free, direction)| Slider { name: name(free), free, direction }).collect()
}

impl Check {
    fn of(junction: &Junction, array: &Matrix, placed: Option<&Placed>) -> Self {
        let operators = junction.operators(array);
        let own = &operators[junction.pattern.left];
        let n = junction.points;
        let all = Matrix::from_rows(n, vec![vec![Rational::from(1); n]]);
        let rest_of = |rows: &Matrix| {
            let kernel = rows.kernel();
            kernel.solve(&(own * &kernel)).map(|m| modulus_classes(&m))
        };
        // Columns sum to 1, so that vectors of sum 0 stay such.
        let differences = rest_of(&all);
        let below = |classes: &[Vec<Root>], bound: &Rational| {
            classes.first().and_then(|c| c.first()).is_none_or(|r| r.cmp_modulus_rational(bound) == Ordering::Less)
        };
        let contracts = differences.as_ref().is_some_and(|d| below(d, &Rational::from(1)));
        let apart = placed.and_then(|p| Some((rest_of(&p.up_to(1).values)?, p.shrinks.clone())));
        let (rest, threshold) = match (apart, differences) {
            (Some(found), _) => found,
            (None, Some(all)) => (all, Rational::from(u8::from(placed.is_none()))),
            // No space of differences that is mapped to itself: nothing passes.
            (None, None) => (Vec::new(), Rational::from(0)),
        };
        let passes = contracts && below(&rest, &threshold);
        let injective = operators.iter().all(|t| t.rank() == t.cols());
        Self { eigenvalues: modulus_classes(own), rest, threshold, passes, contracts, injective }
    }
}
