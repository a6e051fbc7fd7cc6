//! Orders of smoothness of a mask: those of its scheme, where the case is one span of its curves.

use crate::case::{Case, Origin};
use crate::theorem::regularity::{MaskError, Regularity, regularity};
use crate::theorem::{Assertion, Claim, Measure, Reason, Required};
use std::borrow::Cow;

/// What is known of curves on longer polygons, where a case is a mask without control points, so that it shows one span only: a
/// span may be smoother than the curve that it is part of, as each span of a spline is. `None` for every other case.
///
/// # Cost
/// That of [`regularity`].
pub fn of_longer_polygons<E>(case: &Case<E>) -> Option<Result<Regularity, MaskError>> {
    match &case.scheme {
        Some(Origin::Mask(mask) | Origin::Filter(mask, _)) if case.shape.control.is_none() => {
            Some(regularity(mask.coefficients(), mask.arity(), &Default::default()))
        }
        _ => None,
    }
}

/// The claims that decide about what is required: of a mask without control points an order of smoothness is one of its scheme.
pub fn deciding_claims<'a, E>(case: &Case<E>, claims: &'a [Claim], required: &Required) -> Cow<'a, [Claim]> {
    let Some(found) = required.names_order().then(|| of_longer_polygons(case)).flatten() else {
        return Cow::Borrowed(claims);
    };
    let others = claims.iter().filter(|c| !c.what.is_of_parameter()).cloned();
    Cow::Owned(others.chain(orders(found.ok().as_ref())).collect())
}

/// The orders that are proved, and the next one.
fn orders(found: Option<&Regularity>) -> Vec<Claim> {
    let smooth = |order| Assertion::Smooth { order, over: Measure::Uniform };
    let proved = found.and_then(Regularity::smoothness);
    let next = proved.map_or(0, |k| k + 1);
    let refuted = found.is_some_and(|f| {
        f.smoothness_is_exact() && f.orders.iter().any(|o| o.order == next && o.smooth == Some(false))
    });
    let next = match refuted {
        true => Claim::refuted(smooth(next), None, Reason::Order(next)),
        false => Claim::open(smooth(next), Reason::Order(next)),
    };
    proved.map(|order| Claim::proved(smooth(order), None)).into_iter().chain([next]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answer::Verdict;

    #[test]
    fn one_span_of_a_spline_is_no_smoother_than_its_scheme() {
        let spans = Case::ask("chaikin").unwrap_or_else(|e| panic!("{e}"));
        let claims = [Claim::proved(Assertion::Polynomial(Measure::Uniform), None)];
        let verdict = |list: &str| {
            let required = Required::parse(list).unwrap_or_else(|e| panic!("{e}"));
            required.verdict(&deciding_claims(&spans, &claims, &required))
        };
        assert_eq!([verdict("c0"), verdict("c1")], [Verdict::Proved; 2]);
        assert_eq!([verdict("c2"), verdict("c3")], [Verdict::Refuted; 2]);
    }
}
