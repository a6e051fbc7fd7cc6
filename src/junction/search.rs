//! The first member that passes: patterns from the shortest, powers from the highest.

use super::place::{factors, increasing, precise, room};
use super::{Junction, JunctionError, Member, Pattern, Placed, Side};
use crate::algebraic::Root;
use crate::arith::Rational;

/// What the designer asks for; what is left open is chosen.
#[derive(Debug, Clone, Default)]
pub struct Wish {
    /// The pieces of the intermediate curve.
    pub pattern: Option<Pattern>,
    /// Its number of points; those of both ends where it is left open.
    pub points: Option<usize>,
    /// Its free rows; computed where there are none.
    pub rows: Vec<Vec<Rational>>,
    /// Values of sliders.
    pub settings: Vec<(String, Rational)>,
}

/// A member that was tried and did not pass.
#[derive(Debug, Clone)]
pub struct Attempt {
    /// The pattern.
    pub pattern: Pattern,
    /// The highest power that it was to reproduce.
    pub degree: usize,
    /// The largest eigenvalue that positions do not see, where there was a member.
    pub largest: Option<Root>,
    /// What it had to stay below.
    pub threshold: Rational,
}

/// What was found.
#[derive(Debug, Clone)]
pub struct Found {
    /// The member; `None` where none passed.
    pub member: Option<Member>,
    /// What was tried before.
    pub tried: Vec<Attempt>,
}

/// Most pieces beside `I` that are tried.
const MAX_PIECES: usize = 16;
/// How many longer patterns are tried where the positions have room.
const LONGER: usize = 4;

/// Looks for a junction of two schemes.
///
/// # Errors
/// [`JunctionError`] where what was asked for does not fit the schemes. That no member passes is no error.
///
/// # Cost
/// A few exact spectra of the size of the intermediate curve.
///
/// # Examples
/// ```
/// use secant::junction::{Side, Wish, search};
/// use secant::scheme::bspline;
///
/// let quadratic = Side::of("quadratic", &bspline(2, 2)?.curve()?)?;
/// let cubic = Side::of("cubic", &bspline(3, 2)?.curve()?)?;
/// let member = search(&quadratic, &cubic, &Wish::default())?.member.expect("these can be joined");
/// assert_eq!(member.junction.pattern.to_string(), "a,I,b");
/// assert!(member.check.passes);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn search(a: &Side, b: &Side, wish: &Wish) -> Result<Found, JunctionError> {
    // Rows of the designer are about the schemes as they are.
    let several = if wish.rows.is_empty() { same_arity(a, b) } else { None };
    let useful = several.filter(|(left, right)| left.powers().len().min(right.powers().len()) > 1);
    let (left, right) = match useful {
        Some(powers) => powers,
        None => (a.clone(), b.clone()),
    };
    let powers = [left.powers(), right.powers()];
    let common = powers[0].len().min(powers[1].len()) - 1;
    let both = [powers[0].as_slice(), powers[1].as_slice()];
    let family = |pattern: Pattern| {
        let points = match wish.points {
            Some(points) => points,
            None => left.shared + right.shared,
        };
        Junction::new(left.clone(), right.clone(), pattern, points)
    };
    let equal = left.arity() == right.arity() && common > 0;
    if let Some(pattern) = wish.pattern {
        let junction = family(pattern)?;
        if !wish.rows.is_empty() || junction.free() == 0 {
            return given(&junction, wish, equal.then_some((both, common)));
        }
        let mut tried = Vec::new();
        let member = tried_out(&junction, equal.then_some((both, common)), wish, &mut tried)?;
        return Ok(Found { member, tried });
    }
    if !wish.rows.is_empty() {
        return Err(JunctionError::Rows("rows belong to a pattern, which is not given".to_owned()));
    }
    let mut tried = Vec::new();
    let mut left_over = LONGER;
    for pieces in 2..=MAX_PIECES {
        let pattern = Pattern { left: pieces / 2, right: pieces - pieces / 2 };
        let Ok(junction) = family(pattern) else { continue };
        if equal && !room(&junction, both).1 {
            continue;
        }
        let found = tried_out(&junction, equal.then_some((both, common)), wish, &mut tried)?;
        if found.is_some() {
            return Ok(Found { member: found, tried });
        }
        let Some(rest) = left_over.checked_sub(usize::from(equal)) else { break };
        left_over = rest;
    }
    Ok(Found { member: None, tried })
}

type Powers<'a> = ([&'a [Vec<Rational>]; 2], usize);

/// The members of one family, from the highest power, or from positions that only increase.
fn tried_out(
    junction: &Junction,
    powers: Option<Powers<'_>>,
    wish: &Wish,
    tried: &mut Vec<Attempt>,
) -> Result<Option<Member>, JunctionError> {
    let places: Vec<(usize, Rational, Option<Placed>)> = match powers {
        Some((powers, common)) => {
            let whole = precise(junction, powers, common);
            let share = Rational::from(1) / Rational::from(junction.left.arity());
            (1..=common).rev().map(|d| (d, share.clone(), whole.as_ref().map(|p| p.up_to(d)))).collect()
        }
        None => {
            let all = factors(&junction.left, &junction.right);
            all.into_iter().map(|s| (1, s.clone(), increasing(junction, &s))).collect()
        }
    };
    for (degree, threshold, placed) in places {
        let member = match &placed {
            Some(placed) => Member::canonical(junction, placed, &wish.settings)?,
            None => None,
        };
        let largest = match member {
            Some(member) if member.check.passes => return Ok(Some(member)),
            Some(member) => member.check.rest.first().and_then(|c| c.first()).cloned(),
            None => None,
        };
        tried.push(Attempt { pattern: junction.pattern, degree, largest, threshold });
    }
    Ok(None)
}

/// The member with the rows of the designer, or the only one; it has to contract, no more.
fn given(junction: &Junction, wish: &Wish, powers: Option<Powers<'_>>) -> Result<Found, JunctionError> {
    if let Some((name, _)) = wish.settings.first() {
        return Err(JunctionError::Slider { name: name.clone(), known: "the rows are given".to_owned() });
    }
    let array = junction.array(&wish.rows)?;
    let placed = powers.and_then(|(powers, common)| {
        let whole = precise(junction, powers, common)?;
        let holds = |d: &usize| {
            let placed = whole.up_to(*d);
            (0..array.rows()).all(|r| placed.agrees(r, array.row(r)))
        };
        (1..=common).rev().find(holds).map(|d| whole.up_to(d))
    });
    let member = Member::given(junction, placed, wish.rows.clone())?;
    if member.check.contracts {
        return Ok(Found { member: Some(member), tried: Vec::new() });
    }
    let largest = member.check.rest.first().and_then(|c| c.first()).cloned();
    let failed = Attempt { pattern: junction.pattern, degree: 0, largest, threshold: Rational::from(1) };
    Ok(Found { member: None, tried: vec![failed] })
}

/// Both schemes with the same number of pieces, of several steps where that is needed.
fn same_arity(a: &Side, b: &Side) -> Option<(Side, Side)> {
    (1..=6).find_map(|i| {
        let left = a.iterated(i).or_else(|| (i == 1).then(|| a.clone()))?;
        (1..=6).find_map(|j| {
            let right = b.iterated(j).or_else(|| (j == 1).then(|| b.clone()))?;
            (left.arity() == right.arity()).then(|| (left.clone(), right))
        })
    })
}
