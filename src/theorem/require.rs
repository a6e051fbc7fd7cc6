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
    /// `C^k` in the parameter for every k.
    Polynomial,
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
            Self::Polynomial => f.write_str("polynomial"),
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
            Self::Polynomial(_) => Topic::Polynomial,
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
    topics: Vec<Wanted>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Wanted {
    topic: Topic,
    /// Whether it must be proved; otherwise it only decides where it is refuted.
    strict: bool,
    /// Whether it was named, so that it must be claimed of the shape; otherwise it decides as far as a shape has it.
    named: bool,
}

/// What `tangents` stands for.
const TANGENTS: [Topic; 4] = [Topic::Ends, Topic::Joints, Topic::Dense, Topic::Points];

impl Default for Required {
    /// The tangents at the ends, the joints, a dense set and the points asked for, as far as a shape has them; and a cusp or a
    /// corner inside, of which none of these claims speaks.
    fn default() -> Self {
        let inside = Wanted { topic: Topic::Inside, strict: false, named: false };
        Self { topics: tangents().chain([inside]).collect() }
    }
}

fn tangents() -> impl Iterator<Item = Wanted> {
    TANGENTS.into_iter().map(|topic| Wanted { topic, strict: true, named: false })
}

impl Required {
    /// Reads a list such as `ends,dense,g1,c2`; a topic with `?` behind it decides only where it is refuted, and `tangents`
    /// stands for `ends,joints,dense,points` as far as a shape has them. Where all four are named they mean the same.
    ///
    /// # Errors
    /// The word that is not known.
    ///
    /// ```
    /// use secant::theorem::Required;
    /// assert_eq!(Required::parse("ends,g1?")?.to_string(), "ends,g1?");
    /// assert_eq!(Required::parse("tangents")?, Required::parse("points,ends,joints,dense")?);
    /// assert!(Required::parse("smooth").is_err() && Required::parse("").is_err());
    /// # Ok::<(), secant::theorem::UnknownTopic>(())
    /// ```
    pub fn parse(text: &str) -> Result<Self, UnknownTopic> {
        let mut named: Vec<Wanted> = Vec::new();
        let mut all = false;
        for word in text.split(',').map(str::trim) {
            let (name, strict) = word.strip_suffix('?').map_or((word, true), |name| (name, false));
            if name == "tangents" && strict {
                all = true;
                continue;
            }
            let topic = Topic::parse(&name.to_lowercase()).ok_or_else(|| UnknownTopic(word.to_owned()))?;
            let again = named.iter_mut().find(|w| w.topic == topic);
            match again {
                Some(wanted) => wanted.strict |= strict,
                None => named.push(Wanted { topic, strict, named: true }),
            }
        }
        all |= TANGENTS.iter().all(|t| named.iter().any(|w| w.topic == *t && w.strict));
        if !all {
            return Ok(Self { topics: named });
        }
        named.retain(|w| !TANGENTS.contains(&w.topic));
        // Beside them this is the default.
        named.iter_mut().for_each(|w| w.named = w.strict || w.topic != Topic::Inside);
        Ok(Self { topics: tangents().chain(named).collect() })
    }

    /// The verdict on all that is required: refuted if one of it is refuted, proved if all of it is proved. What was named and
    /// is not claimed of the shape is undetermined; so is a list of which nothing is claimed.
    #[must_use]
    pub fn verdict(&self, claims: &[Claim]) -> Verdict {
        let all = claims.iter().filter(|c| c.what.topic().is_none()).map(Claim::verdict);
        self.judged(all.collect(), |topic| about(claims, topic).map(|found| found.0))
    }

    /// The verdict where nothing is claimed but that the surface is C¹ at the vertices of a mesh, and that it is regular and C¹
    /// at every point. An order above 1 is refuted with C¹, and never proved.
    #[must_use]
    pub fn at_vertices(&self, vertices: Verdict, every: Verdict) -> Verdict {
        if self.is_of_all_tangents() {
            return every;
        }
        let found = |topic| match topic {
            Topic::Joints => Some(vertices),
            Topic::G1 | Topic::C(1) => Some(every),
            Topic::C(0) if every == Verdict::Proved => Some(every),
            Topic::C(k) if k > 1 && every == Verdict::Refuted => Some(every),
            _ => None,
        };
        self.judged(Vec::new(), found)
    }

    /// Whether an order of smoothness is named.
    #[must_use]
    pub fn names_order(&self) -> bool {
        self.topics.iter().any(|w| matches!(w.topic, Topic::C(_)))
    }

    /// Whether nothing is named but what a shape has anyway.
    #[must_use]
    pub fn is_of_all_tangents(&self) -> bool {
        self.topics.iter().all(|w| !w.named)
    }

    fn judged(&self, mut verdicts: Vec<Verdict>, found: impl Fn(Topic) -> Option<Verdict>) -> Verdict {
        for wanted in &self.topics {
            match found(wanted.topic) {
                Some(Verdict::Undetermined) if !wanted.strict => {}
                Some(verdict) => verdicts.push(verdict),
                None if wanted.named && wanted.strict => verdicts.push(Verdict::Undetermined),
                None => {}
            }
        }
        Verdict::all(verdicts.len(), verdicts)
    }

    /// The claims from which the verdict follows: those of it, of all that decide.
    #[must_use]
    pub fn deciding<'a>(&self, claims: &'a [Claim]) -> Vec<&'a Claim> {
        let verdict = self.verdict(claims);
        let mut chosen: Vec<usize> = (0..claims.len()).filter(|k| claims[*k].what.topic().is_none()).collect();
        for wanted in &self.topics {
            let open = verdict == Verdict::Undetermined && !wanted.strict;
            let found = about(claims, wanted.topic).filter(|found| found.0 == verdict && !open);
            chosen.extend(found.into_iter().flat_map(|found| found.1));
        }
        let decides = |(k, c): &(usize, &Claim)| chosen.contains(k) && c.verdict() == verdict;
        claims.iter().enumerate().filter(decides).map(|(_, c)| c).collect()
    }
}

/// What is found about a topic, and by which claims; `None` where nothing is claimed.
fn about(claims: &[Claim], topic: Topic) -> Option<(Verdict, Vec<usize>)> {
    if let Topic::C(order) = topic {
        return of_order(claims, order);
    }
    if topic == Topic::Inside {
        return of_inside(claims);
    }
    let of = |wanted: Topic| {
        let own: Vec<usize> = (0..claims.len()).filter(|k| claims[*k].what.topic() == Some(wanted)).collect();
        (!own.is_empty()).then(|| (Verdict::all(own.len(), own.iter().map(|k| claims[*k].verdict())), own))
    };
    // Where all joints are decided together, they are the dense set.
    of(topic).or_else(|| if topic == Topic::Joints { of(Topic::Dense) } else { None })
}

/// What is known of the points that are neither ends nor joints: refuted at one of them, or G¹ at all.
fn of_inside(claims: &[Claim]) -> Option<(Verdict, Vec<usize>)> {
    let k = claims.iter().position(|c| c.what == Assertion::G1)?;
    let verdict = match claims[k].verdict() {
        Verdict::Proved => Verdict::Proved,
        Verdict::Refuted if claims[k].reason() == Some(&Reason::InsidePoint) => Verdict::Refuted,
        _ => Verdict::Undetermined,
    };
    Some((verdict, vec![k]))
}

/// Whether the curve is `C^order`, by what is claimed of smaller and larger orders.
fn of_order(claims: &[Claim], order: usize) -> Option<(Verdict, Vec<usize>)> {
    let mut open = Vec::new();
    for (k, claim) in claims.iter().enumerate() {
        let at = match claim.what {
            Assertion::Smooth { order, .. } => order,
            Assertion::Polynomial(_) => usize::MAX,
            _ => continue,
        };
        match claim.verdict() {
            Verdict::Proved if at >= order => return Some((Verdict::Proved, vec![k])),
            Verdict::Refuted if at <= order => return Some((Verdict::Refuted, vec![k])),
            _ => open.push(k),
        }
    }
    (!open.is_empty()).then_some((Verdict::Undetermined, open))
}

impl fmt::Display for Required {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (k, wanted) in self.topics.iter().enumerate() {
            let comma = if k > 0 { "," } else { "" };
            write!(f, "{comma}{}{}", wanted.topic, if wanted.strict { "" } else { "?" })?;
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
            ("inside?,points,ends,dense,joints", Proved),
            ("points,ends,dense,joints", Proved),
            ("g1,tangents", Undetermined),
            ("c2,tangents", Refuted),
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
    fn what_decides_is_what_the_verdict_follows_from() {
        let all = claims();
        let deciding = |list: &str| {
            let required = Required::parse(list).unwrap_or_else(|e| panic!("{e}"));
            required.deciding(&all).iter().map(|c| c.what.topic()).collect::<Vec<_>>()
        };
        assert_eq!(deciding("c0"), [Some(Topic::C(1))]);
        assert_eq!(deciding("c7,ends"), [Some(Topic::C(2))]);
        assert_eq!(deciding("joints"), [Some(Topic::Dense)]);
        assert_eq!(deciding("points"), []);
        // Of a cusp at a joint `inside?` says nothing.
        let cusp = [
            Claim::refuted(Assertion::DenseJoints, None, Reason::EveryPoint),
            Claim::refuted(Assertion::G1, None, Reason::EveryPoint),
        ];
        let decided = Required::default().deciding(&cusp).iter().map(|c| c.what.topic()).collect::<Vec<_>>();
        assert_eq!(decided, [Some(Topic::Dense)]);
        let every = [Claim::proved(Assertion::G1, None), Claim::proved(Assertion::Polynomial(Measure::Uniform), None)];
        let required = Required::parse("inside,c7").unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(required.deciding(&every).len(), 2);
    }

    #[test]
    fn of_vertices_only_c1_is_claimed() {
        use Verdict::{Proved, Refuted, Undetermined};
        let at = |list: &str, every| Required::parse(list).map(|r| r.at_vertices(Proved, every));
        for (list, proved, refuted) in [
            ("ends,joints,dense,points,inside?", Proved, Refuted),
            ("tangents", Proved, Refuted),
            ("c1", Proved, Refuted),
            ("g1,c0", Proved, Refuted),
            ("c0", Proved, Undetermined),
            ("joints", Proved, Proved),
            ("c2", Undetermined, Refuted),
            ("c1,dense", Undetermined, Refuted),
            ("c2?", Undetermined, Refuted),
        ] {
            assert_eq!((at(list, Proved), at(list, Refuted)), (Ok(proved), Ok(refuted)), "{list}");
        }
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
