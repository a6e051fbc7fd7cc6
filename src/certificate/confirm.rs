//! What the checker says of a certificate, compared with what was found.

use super::{Certificate, Unsupported, Written, certificate, flat_certificate};
use crate::case::Case;
use crate::shape::Spaces;
use crate::theorem::{About, Assertion, Certified, Parameter, Verdict};
use secant_check::{Accepted, Decided, Joints, Subject};
use thiserror::Error;

/// Why a decided verdict was not proved again.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum Doubt {
    /// It has no certificate.
    #[error(transparent)]
    Unsupported(#[from] Unsupported),
    /// The checker does not accept its certificate.
    #[error("the certificate is not accepted: {0}")]
    Rejected(#[from] secant_check::Rejected),
    /// The checker comes to another verdict.
    #[error("the certificate proves \"{0}\", which is not the verdict found")]
    Differs(&'static str),
    /// The checker proves another claim than the one that is printed.
    #[error("the certificate proves another claim: {0}")]
    Claims(String),
}

/// Writes the certificate and has it checked by `secant-check` against the text of the case.
///
/// # Errors
/// [`Doubt`] where there is no certificate, or the checker does not accept it with the same verdict.
///
/// # Cost
/// That of [`certificate`] and of [`secant_check::check`].
pub fn confirm(case: &Case, found: &Certified) -> Result<Certificate, Doubt> {
    let Some(surface) = &found.surface else { return confirm_flat(case, found) };
    let certificate = certificate(case, found)?;
    let accepted = accepted(&case.checked_text(), &certificate)?;
    if !same_verdict(found.verdict, accepted.verdict) {
        return Err(Doubt::Differs(accepted.verdict.word()));
    }
    same_every_plane(surface.every.verdict(), &certificate, &accepted)?;
    Ok(certificate)
}

/// The same for a curve or a set, also over a number field.
///
/// # Errors
/// As [`confirm`].
///
/// # Cost
/// As [`confirm`].
pub fn confirm_flat<E: Written>(case: &Case<E>, found: &Certified<E>) -> Result<Certificate, Doubt> {
    let certificate = flat_certificate(case, found)?;
    let accepted = match accepted(&E::text(case), &certificate) {
        Err(Doubt::Rejected(rejected)) if E::IRRATIONAL && matches!(&*rejected.rule, "case" | "numbers") => {
            let what = "numbers that the checker does not read".to_owned();
            return Err(Unsupported { what, place: rejected.place }.into());
        }
        answer => answer?,
    };
    if !same_verdict(found.verdict, accepted.verdict) {
        return Err(Doubt::Differs(accepted.verdict.word()));
    }
    same_claims(found, &certificate, &accepted)?;
    Ok(certificate)
}

/// Whether the checker says of every point of a surface what was found, where the certificate has it.
fn same_every_plane(found: Verdict, certificate: &Certificate, accepted: &Accepted) -> Result<(), Doubt> {
    let known = |d: &&Decided| d.claim == secant_check::Claim::PlaneTurns;
    let said = accepted.claims.iter().find(known);
    if certificate.json()["proof"]["every"].is_null() && said.is_none() {
        return Ok(());
    }
    match said {
        Some(said) if same_verdict(found, said.verdict) => Ok(()),
        Some(said) => Err(Doubt::Claims(said.to_string())),
        None => Err(Doubt::Claims("nothing about every point".to_owned())),
    }
}

/// Whether the checker's claims about curves and sets say of what secant's claims are said: the verdicts are those of the
/// certificate, which it has compared.
///
/// Of the joints that were examined only a refutation is a claim of its own; what is proved of them is in the list of points.
fn same_claims<E: Written>(found: &Certified<E>, certificate: &Certificate, accepted: &Accepted) -> Result<(), Doubt> {
    let alone = secant_check::Claim::TangentAtJoints(Joints::OnlyNotKilled);
    let beside = accepted.claims.iter().any(|d| d.claim == alone);
    for claim in found.claims.iter().filter(|c| c.verdict() != Verdict::Undetermined) {
        let expected = match &claim.what {
            Assertion::TangentAt { address, about, .. } => {
                let address = secant_check::Address { prefix: address.prefix.clone(), cycle: address.cycle.clone() };
                let of = match about {
                    About::Curve => Subject::Curve,
                    About::Shape => Subject::Set,
                    About::Branch => Subject::Branch,
                };
                secant_check::Claim::TangentAt { address, of }
            }
            Assertion::TangentAtEnds => secant_check::Claim::TangentAtEnds,
            Assertion::ExaminedJoints if claim.verdict() == Verdict::Refuted => {
                secant_check::Claim::TangentAtJoints(Joints::All)
            }
            Assertion::ExaminedJoints => continue,
            what if what.is_of_dense_joints() && certificate.leaves_out_joints() => continue,
            Assertion::UnkilledJoints | Assertion::ProjectedJoints if beside => alone.clone(),
            Assertion::DenseJoints => secant_check::Claim::TangentAtJoints(Joints::All),
            Assertion::SeenJoints => secant_check::Claim::TangentAtJoints(Joints::Seen),
            Assertion::UnkilledJoints | Assertion::ProjectedJoints => {
                secant_check::Claim::TangentAtJoints(Joints::NotKilled)
            }
            Assertion::SomePoint => secant_check::Claim::TangentSomewhere,
            // The certificate's answers about single points carry these.
            _ => continue,
        };
        let known = |d: &Decided| d.claim == expected && same_verdict(claim.verdict(), d.verdict);
        if !accepted.claims.iter().any(known) {
            let said: Vec<String> = accepted.claims.iter().map(ToString::to_string).collect();
            return Err(Doubt::Claims(format!("{}, not {expected}", said.join("; "))));
        }
    }
    Ok(())
}

/// The claims about the parameter that the checker proves or refutes, as they were found, from a certificate of the
/// orders of smoothness; none where that has no rule for the evidence.
///
/// # Errors
/// [`Doubt`] where the checker does not accept the certificate.
///
/// # Cost
/// That of the certificate and of [`secant_check::check`].
pub fn confirm_orders<E: Written>(case: &Case<E>, found: &Certified<E>) -> Result<Vec<Assertion>, Doubt> {
    let (Some(Parameter::Orders(orders)), Some(spaces)) = (&found.parameter, Spaces::new(&case.shape)) else {
        return Ok(Vec::new());
    };
    let Ok(certificate) = super::regularity_certificate(case, &spaces, &found.contraction, orders) else {
        return Ok(Vec::new());
    };
    let accepted = match accepted(&E::text(case), &certificate) {
        Err(Doubt::Unsupported(_)) => return Ok(Vec::new()),
        Err(Doubt::Rejected(rejected)) if E::IRRATIONAL && matches!(&*rejected.rule, "case" | "numbers") => {
            return Ok(Vec::new());
        }
        answer => answer?,
    };
    let mut again = Vec::new();
    for claim in found.claims.iter().filter(|c| c.what.is_of_parameter() && c.verdict() != Verdict::Undetermined) {
        let proved = accepted.claims.iter().any(|d| {
            let same = match (&claim.what, &d.claim) {
                (Assertion::Smooth { order, .. }, secant_check::Claim::Smooth { order: k }) => order == k,
                (Assertion::Polynomial(_), secant_check::Claim::Polynomial) => true,
                (Assertion::Exponent(..), secant_check::Claim::Exponent { order, .. }) => *order == orders.smoothness(),
                (Assertion::Exponent(Some(found), _), secant_check::Claim::ExponentBetween { low, high }) => {
                    found.lo.to_string() == low.to_string() && found.hi.to_string() == high.to_string()
                }
                _ => false,
            };
            same && same_verdict(claim.verdict(), d.verdict)
        });
        if proved {
            again.push(claim.what.clone());
        }
    }
    Ok(again)
}

/// Has a certificate checked by `secant-check` against the text of what it is about.
///
/// # Errors
/// [`Doubt`] where the checker does not accept it.
///
/// # Cost
/// That of [`secant_check::check`].
pub fn checked(source: &str, certificate: Certificate) -> Result<Certificate, Doubt> {
    accepted(source, &certificate)?;
    Ok(certificate)
}

/// Whether the checker comes to the same verdict.
pub(super) fn same_verdict(own: Verdict, checked: secant_check::Verdict) -> bool {
    match own {
        Verdict::Proved => checked == secant_check::Verdict::Proved,
        Verdict::Refuted => checked == secant_check::Verdict::Refuted,
        Verdict::Undetermined => checked == secant_check::Verdict::Undetermined,
    }
}

/// What the checker says. Where its budget does not last, nothing was found to be wrong: there is just no second proof.
pub(super) fn accepted(source: &str, certificate: &Certificate) -> Result<Accepted, Doubt> {
    match secant_check::check_while(source, &certificate.text(), crate::stop::check) {
        Err(rejected) if rejected.rule == "limit" => {
            let what = "evidence that takes so much arithmetic".to_owned();
            Err(Unsupported { what, place: rejected.place }.into())
        }
        answer => Ok(answer?),
    }
}
