//! Which claims decide: the topics of claims, and a list of those that are required.

use super::claim::{Assertion, Claim, Reason};
use crate::answer::Verdict;
use std::fmt;
use thiserror::Error;

/// What a claim is about, as it is named in `--require`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Topic {
    /// The end points of a curve.
    Ends,
    /// The joints of a curve that were examined, or the vertices of a surface.
    Joints,
    /// A dense set of points.
    Dense,
    /// The points of a curve that are neither ends nor joints: refuted where one of them refutes G¹.
    Inside,
    /// Every point of a curve or a surface: G¹.
    G1,
    /// `C^k` in the parameter.
    C(usize),
    /// The Hölder exponent, about which nothing can be required.
    Exponent,
    /// The points that were asked for.
    Points,
}

impl Topic {
    /// Reads `ends`, `joints`, `dense`, `inside`, `g1`, `c1`, `c2`, …, or `points`.
    #[must_use]
    pub fn parse(word: &str) -> Option<Self> {
        Some(match word {
            "ends" => Self::Ends,
            "joints" => Self::Joints,
            "dense" => Self::Dense,
            "inside" => Self::Inside,
            "g1" => Self::G1,
            "points" => Self::Points,
            _ => {
                let digits = word.strip_prefix('c').filter(|d| d.len() < 4 && d.bytes().all(|b| b.is_ascii_digit()))?;
                Self::C(digits.parse().ok()?)
            }
        })
    }
}

impl fmt::Display for Topic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Ends => f.write_str("ends"),
            Self::Joints => f.write_str("joints"),
            Self::Dense => f.write_str("dense"),
            Self::Inside => f.write_str("inside"),
            Self::G1 => f.write_str("g1"),
            Self::C(k) => write!(f, "c{k}"),
            Self::Exponent => f.write_str("exponent"),
            Self::Points => f.write_str("points"),
        }
    }
}

impl Assertion {
    /// What it is about; `None` where it is about all that could be asked.
    #[must_use]
    pub fn topic(&self) -> Option<Topic> {
        Some(match self {
            Self::Tangents
            | Self::C1AtVertex { .. }
            | Self::C1AtBorder { .. }
            | Self::PlaneAtVertex { .. }
            | Self::C1AtVertices { .. } => return None,
            Self::TangentAtEnds => Topic::Ends,
            Self::ExaminedJoints | Self::PlaneAtVertices => Topic::Joints,
            Self::TangentDense
            | Self::DenseJoints
            | Self::ProjectedJoints
            | Self::SeenJoints
            | Self::UnkilledJoints
            | Self::DensePlanes { .. } => Topic::Dense,
            Self::G1 | Self::PlaneEverywhere => Topic::G1,
            Self::Smooth { order, .. } => Topic::C(*order),
            // Every order is smaller than this one.
            Self::Polynomial(_) => Topic::C(usize::MAX),
            Self::TangentAt { .. } | Self::PlaneAt { .. } | Self::SomePoint => Topic::Points,
            Self::Exponent(..) => Topic::Exponent,
        })
    }

    /// Whether it is one of the tangents that were examined: neither about every point nor about the parameter.
    #[must_use]
    pub fn is_of_tangents(&self) -> bool {
        !matches!(
            self,
            Self::G1 | Self::PlaneEverywhere | Self::Smooth { .. } | Self::Polynomial(_) | Self::Exponent(..)
        )
    }

    /// Whether it is about the curve in its parameter.
    #[must_use]
    pub fn is_of_parameter(&self) -> bool {
        matches!(self, Self::Smooth { .. } | Self::Polynomial(_) | Self::Exponent(..))
    }
}

/// A word that names no claim.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("`{0}` is no claim: name ends, joints, dense, points, inside, g1, c1, c2, …, or tangents")]
pub struct UnknownTopic(String);

/// The claims that decide about a case, and with it about the exit code.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Required {
    topics: Vec<(Topic, bool)>,
    named: bool,
}

impl Default for Required {
    /// The tangents at the ends, the joints, a dense set and the points asked for, as far as a shape has them; and a cusp or a
    /// corner inside, of which none of these claims speaks.
    fn default() -> Self {
        let topics = vec![
            (Topic::Ends, true),
            (Topic::Joints, true),
            (Topic::Dense, true),
            (Topic::Points, true),
            (Topic::Inside, false),
        ];
        Self { topics, named: false }
    }
}

impl Required {
    /// Reads a list such as `ends,dense,g1,c2`; a topic with `?` behind it decides only where it is refuted, and `tangents`
    /// stands for `ends,joints,dense,points` as far as a shape has them.
    ///
    /// # Errors
    /// The word that is not known.
    ///
    /// ```
    /// use secant::theorem::Required;
    /// assert_eq!(Required::parse("ends,g1?")?.to_string(), "ends,g1?");
    /// assert!(Required::parse("smooth").is_err() && Required::parse("").is_err());
    /// # Ok::<(), secant::theorem::UnknownTopic>(())
    /// ```
    pub fn parse(text: &str) -> Result<Self, UnknownTopic> {
        if text.trim() == Self::default().to_string() {
            return Ok(Self::default());
        }
        if text.trim() == "tangents" {
            let mut topics = Self::default().topics;
            topics.retain(|(topic, _)| *topic != Topic::Inside);
            return Ok(Self { topics, named: false });
        }
        let mut topics = Vec::new();
        for word in text.split(',').map(str::trim) {
            let (name, strict) = word.strip_suffix('?').map_or((word, true), |name| (name, false));
            let topic = Topic::parse(&name.to_lowercase()).ok_or_else(|| UnknownTopic(word.to_owned()))?;
            topics.push((topic, strict));
        }
        Ok(Self { topics, named: true })
    }

    /// The verdict on all that is required: refuted if one of it is refuted, proved if all of it is proved. What was named and
    /// is not claimed of the shape is undetermined; so is a list of which nothing is claimed.
    #[must_use]
    pub fn verdict(&self, claims: &[Claim]) -> Verdict {
        let mut verdicts: Vec<Verdict> =
            claims.iter().filter(|c| c.what.topic().is_none()).map(Claim::verdict).collect();
        for (topic, strict) in &self.topics {
            let found = about(claims, *topic);
            match found {
                Some(Verdict::Undetermined) if !strict => {}
                Some(verdict) => verdicts.push(verdict),
                None if self.named && *strict => verdicts.push(Verdict::Undetermined),
                None => {}
            }
        }
        Verdict::all(verdicts.len(), verdicts)
    }

    /// Whether a claim is one of those that decide.
    #[must_use]
    pub fn counts(&self, claim: &Claim) -> bool {
        let topic = claim.what.topic();
        topic.is_none()
            || self.topics.iter().any(|(t, strict)| {
                let same = Some(*t) == topic
                    || *t == Topic::Joints && topic == Some(Topic::Dense)
                    || *t == Topic::Inside && topic == Some(Topic::G1) && breaks_inside(claim);
                same && (*strict || claim.verdict() == Verdict::Refuted)
            })
    }
}

/// What is found about a topic; `None` where nothing is claimed.
fn about(claims: &[Claim], topic: Topic) -> Option<Verdict> {
    if let Topic::C(order) = topic {
        return of_order(claims, order);
    }
    if topic == Topic::Inside {
        return of_inside(claims);
    }
    let of = |wanted: Topic| {
        let own: Vec<Verdict> = claims.iter().filter(|c| c.what.topic() == Some(wanted)).map(Claim::verdict).collect();
        (!own.is_empty()).then(|| Verdict::all(own.len(), own))
    };
    // Where all joints are decided together, they are the dense set.
    of(topic).or_else(|| if topic == Topic::Joints { of(Topic::Dense) } else { None })
}

/// Whether a claim refutes G¹ at a point that is neither an end nor a joint.
fn breaks_inside(claim: &Claim) -> bool {
    claim.verdict() == Verdict::Refuted && claim.reason() == Some(&Reason::InsidePoint)
}

/// What is known of the points that are neither ends nor joints: refuted at one of them, or G¹ at all.
fn of_inside(claims: &[Claim]) -> Option<Verdict> {
    let claim = claims.iter().find(|c| c.what == Assertion::G1)?;
    Some(match claim.verdict() {
        Verdict::Proved => Verdict::Proved,
        Verdict::Refuted if breaks_inside(claim) => Verdict::Refuted,
        _ => Verdict::Undetermined,
    })
}

/// Whether the curve is `C^order`, by what is claimed of smaller and larger orders.
fn of_order(claims: &[Claim], order: usize) -> Option<Verdict> {
    let mut known = None;
    for claim in claims {
        let at = match claim.what {
            Assertion::Smooth { order, .. } => order,
            Assertion::Polynomial(_) => usize::MAX,
            _ => continue,
        };
        known = known.or(Some(Verdict::Undetermined));
        match claim.verdict() {
            Verdict::Proved if at >= order => return Some(Verdict::Proved),
            Verdict::Refuted if at <= order => return Some(Verdict::Refuted),
            _ => {}
        }
    }
    known
}

impl fmt::Display for Required {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (k, (topic, strict)) in self.topics.iter().enumerate() {
            let comma = if k > 0 { "," } else { "" };
            write!(f, "{comma}{topic}{}", if *strict { "" } else { "?" })?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::super::claim::Measure;
    use super::*;

    fn claims() -> Vec<Claim> {
        let order = |order| Assertion::Smooth { order, over: Measure::Uniform };
        vec![
            Claim::proved(Assertion::TangentAtEnds, None),
            Claim::proved(Assertion::DenseJoints, None),
            Claim::open(Assertion::G1, Reason::EveryPoint),
            Claim::proved(order(1), None),
            Claim::refuted(order(2), None, Reason::Order(2)),
        ]
    }

    fn verdict(list: &str, claims: &[Claim]) -> Verdict {
        Required::parse(list).map(|r| r.verdict(claims)).unwrap_or_else(|e| panic!("{e}"))
    }

    #[test]
    fn what_is_required_decides() {
        use Verdict::{Proved, Refuted, Undetermined};
        let all = claims();
        assert_eq!(Required::default().verdict(&all), Proved);
        for (list, expected) in [
            ("ends,joints,dense", Proved),
            ("tangents", Proved),
            ("g1", Undetermined),
            ("ends,g1?", Proved),
            ("c1", Proved),
            ("c0,c1", Proved),
            ("c2", Refuted),
            ("c7", Refuted),
            ("points", Undetermined),
        ] {
            assert_eq!(verdict(list, &all), expected, "{list}");
        }
        // An order between one that holds and one that is open.
        let open = [
            Claim::proved(Assertion::Smooth { order: 1, over: Measure::Uniform }, None),
            Claim::open(Assertion::Smooth { order: 2, over: Measure::Uniform }, Reason::Order(2)),
        ];
        assert_eq!((verdict("c2", &open), verdict("c3", &open)), (Undetermined, Undetermined));
        assert_eq!(verdict("c9", &[Claim::proved(Assertion::Polynomial(Measure::Uniform), None)]), Proved);
    }

    #[test]
    fn nothing_claimed_is_no_success() {
        assert_eq!(Required::default().verdict(&[]), Verdict::Undetermined);
        assert_eq!(verdict("g1?", &claims()), Verdict::Undetermined);
        let tangents = Claim::proved(Assertion::TangentAtEnds, None);
        for (reason, expected) in [(Reason::InsidePoint, Verdict::Refuted), (Reason::EveryPoint, Verdict::Proved)] {
            let claims = [tangents.clone(), Claim::refuted(Assertion::G1, None, reason)];
            assert_eq!(Required::default().verdict(&claims), expected);
            assert_eq!(verdict("tangents", &claims), Verdict::Proved);
            assert_eq!(verdict("ends,g1?", &claims), Verdict::Refuted);
        }
    }
}
