//! From branches to points: which branches a point has, and what follows for it (theory §3, §5, §9).

use super::{Address, End, Found, Kind, Line, Model, Root, read_address, rules};
use crate::base::{Checked, Field, MAX_PIECES, Matrix, Node, Verdict, Whole, need, reject, some};
use num_bigint::BigInt;

/// Where a point sits.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Place {
    /// An end of the start curve.
    End(End),
    /// The joint of two pieces of the state that a path reaches.
    Joint {
        /// The path.
        path: Vec<usize>,
        /// The piece before.
        left: usize,
        /// The piece after.
        right: usize,
    },
    /// A point inside a curve, with one branch.
    Inside(Address),
    /// A point of a set, with the branch that is asked for.
    OfSet(Address),
}

/// Which points a branch describes: the earlier ones (at the finish of a curve), the later ones (at a start), or both.
type Side = Option<End>;

/// A branch: its side, and what its certificate proves, where it has one.
type Branch = (Side, Option<Found>);

/// A checked point.
pub struct Point<T = BigInt> {
    /// Where it sits.
    pub place: Place,
    /// Whether it has a tangent line.
    pub verdict: Verdict,
    /// Its kind, such as `cusp`.
    pub kind: &'static str,
    /// A vector of its tangent line over the field of the case, where the certificate gives one.
    pub common: Option<Matrix<T>>,
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::End(End::Start) => f.write_str("left end"),
            Self::End(End::Finish) => f.write_str("right end"),
            Self::Joint { path, left, right } if path.is_empty() => write!(f, "joint of the pieces {left} and {right}"),
            Self::Joint { path, left, right } => {
                let path: Vec<String> = path.iter().map(usize::to_string).collect();
                write!(f, "joint of the pieces {left} and {right} along the path {}", path.join(","))
            }
            Self::Inside(address) => write!(f, "point {address} inside"),
            Self::OfSet(address) => write!(f, "branch {address} of the set"),
        }
    }
}

impl Place {
    /// Reads a place.
    pub fn read(node: &Node<'_>) -> Checked<Self> {
        Ok(match node.tag("at")? {
            "left end" => node.fields("at").map(|[_]| Self::End(End::Start))?,
            "right end" => node.fields("at").map(|[_]| Self::End(End::Finish))?,
            "joint" => {
                let [_, path, left, right] = node.fields("at path left right")?;
                Self::Joint { path: path.word()?, left: left.index(MAX_PIECES)?, right: right.index(MAX_PIECES)? }
            }
            "inside" => node.fields("at address").and_then(|[_, a]| Ok(Self::Inside(read_address(&a)?)))?,
            "of set" => node.fields("at address").and_then(|[_, a]| Ok(Self::OfSet(read_address(&a)?)))?,
            _ => return node.reject("format", "unknown place of a point"),
        })
    }

    /// The branches of the point: for a curve through the outermost pieces that are more than a point.
    fn branches<T: Whole>(&self, model: &Model<'_, T>, root: &Root<T>) -> Checked<Vec<(Side, Address)>> {
        match self {
            Self::End(end) => Ok(vec![(Some(*end), end_branch(model, &[], root.state, *end)?)]),
            Self::Joint { path, left, right } => {
                let why = "the path ends nowhere, or the pieces are no neighbours that are more than points";
                let joint = some(self.joint(model, root.state), "joint", why)?;
                let listed = model.joints_of(joint.0)?.contains(&joint);
                need(listed || meet(model, root, path, joint)?, "joint", why)?;
                let state = joint.0;
                let branch = |letter: usize, end: End| {
                    let piece = &model.shape.states[state].pieces[letter];
                    end_branch(model, &[path, &[letter][..]].concat(), piece.target, end.in_piece(piece))
                };
                let (before, after) = (branch(*left, End::Finish)?, branch(*right, End::Start)?);
                let forward = model.shape.orientation(root.state, path)? > 0;
                let (first, second) = if forward { (before, after) } else { (after, before) };
                Ok(vec![(Some(End::Finish), first), (Some(End::Start), second)])
            }
            Self::Inside(address) | Self::OfSet(address) => {
                let normal = address.normalise(model.shape, root.state).as_ref() == Some(address);
                let here = normal && Self::of_address(model, root.state, address)? == *self;
                need(here, "place", "the address is not in its normal form, or that of another kind of point")?;
                Ok(vec![(None, address.clone())])
            }
        }
    }

    /// The state and the two pieces of a joint.
    pub fn joint<T: Whole>(&self, model: &Model<'_, T>, root: usize) -> Option<(usize, usize, usize)> {
        let Self::Joint { path, left, right } = self else { return None };
        Some((*model.shape.path(root, path).ok()?.last()?, *left, *right))
    }

    /// The place of the point with a normalised address from a state: an end, a joint, a point inside, or a point of a set.
    pub fn of_address<T: Whole>(model: &Model<'_, T>, root: usize, address: &Address) -> Checked<Self> {
        let shape = model.shape;
        let states = shape.path(root, &address.prefix)?;
        let state = states[states.len() - 1];
        let cycle = shape.path(state, &address.cycle)?;
        if states.iter().chain(&cycle).any(|&e| shape.states[e].kind != Kind::Edge) {
            return Ok(Self::OfSet(address.clone()));
        }
        let mut end = if is_end(model, state, &address.cycle, End::Start)? {
            End::Start
        } else if is_end(model, state, &address.cycle, End::Finish)? {
            End::Finish
        } else {
            return Ok(Self::Inside(address.clone()));
        };
        for (k, &letter) in address.prefix.iter().enumerate().rev() {
            let pieces = &shape.states[states[k]].pieces;
            end = end.in_piece(&pieces[letter]);
            if model.spaces.is_point(states[k], letter)? {
                let solid = model.spaces.solid(states[k])?;
                // All of the piece is one point: an end of the state, or between two pieces, where no branch shows it.
                end = match (solid.iter().any(|i| *i < letter), solid.iter().any(|i| *i > letter)) {
                    (false, true) => End::Start,
                    (true, false) => End::Finish,
                    _ => return Ok(Self::Inside(address.clone())),
                };
            }
            let meets = |&(_, l, r): &(_, usize, usize)| if end == End::Start { r == letter } else { l == letter };
            if let Some((_, left, right)) = model.joints_of(states[k])?.into_iter().find(meets) {
                return Ok(Self::Joint { path: address.prefix[..k].to_vec(), left, right });
            }
        }
        Ok(Self::End(end))
    }
}

impl<T: Whole> Model<'_, T> {
    /// All first-level joints: the reachable states, and the pairs of neighbours among their pieces that are more than points.
    pub fn joints(&self) -> Checked<Vec<(usize, usize, usize)>> {
        let all = self.shape.reachable.iter().map(|&e| self.joints_of(e)).collect::<Checked<Vec<_>>>()?;
        Ok(all.concat())
    }

    fn joints_of(&self, e: usize) -> Checked<Vec<(usize, usize, usize)>> {
        Ok(self.spaces.solid(e)?.windows(2).map(|w| (e, w[0], w[1])).collect())
    }
}

/// Whether all first-level joints are among these.
pub fn complete<T: Whole>(
    model: &Model<'_, T>,
    listed: &[(usize, usize, usize)],
    node: &Node<'_>,
    rule: &str,
) -> Checked<()> {
    match model.joints()?.into_iter().find(|joint| !listed.contains(joint)) {
        None => Ok(()),
        Some((e, left, right)) => {
            node.reject(rule, format_args!("the joint of the pieces {left} and {right} of state {e} is missing"))
        }
    }
}

/// Whether all pieces between two, which are more than points, are single points where they are looked at.
fn meet<T: Whole>(
    model: &Model<'_, T>,
    root: &Root<T>,
    path: &[usize],
    (e, left, right): (usize, usize, usize),
) -> Checked<bool> {
    let pieces = &model.shape.states[e].pieces;
    if left >= right || right >= pieces.len() || model.spaces.is_point(e, left)? || model.spaces.is_point(e, right)? {
        return Ok(false);
    }
    let seen = root.view.times(&model.shape.product(root.state, path)?.0)?;
    for piece in &pieces[left + 1..right] {
        if !seen.times(&piece.op)?.times(&model.spaces.of(piece.target)?.basis)?.is_zero() {
            return Ok(false);
        }
    }
    Ok(true)
}

fn end_branch<T: Whole>(model: &Model<'_, T>, path: &[usize], state: usize, end: End) -> Checked<Address> {
    let solid = model.shape.reachable.iter().map(|&e| Ok((e, model.spaces.solid(e)?))).collect::<Checked<Vec<_>>>()?;
    // Pieces of states that are not reached are none.
    let skip = |e: usize, letter: usize| !solid.iter().any(|(of, letters)| *of == e && letters.contains(&letter));
    let address = some(model.shape.end_address(state, end, &skip), "end", "a curve all of whose pieces are points")?;
    Ok(Address { prefix: [path, &address.prefix].concat(), ..address })
}

/// Whether the fixed point of a cycle is this end of its cell: nothing but points lies on that side, for two turns.
fn is_end<T: Whole>(model: &Model<'_, T>, state: usize, cycle: &[usize], end: End) -> Checked<bool> {
    let (mut at, mut side) = (state, end);
    for letter in cycle.iter().chain(cycle) {
        let pieces = &model.shape.states[at].pieces;
        let outside = |i: &usize| if side == End::Start { i < letter } else { i > letter };
        if model.spaces.solid(at)?.iter().any(outside) {
            return Ok(false);
        }
        side = side.in_piece(&pieces[*letter]);
        at = pieces[*letter].target;
    }
    Ok(true)
}

impl<T: Whole> Point<T> {
    /// Reads `{"state", "point"}`: a first-level joint, seen in the visible quotient of its own state, which is returned.
    pub fn in_own_state(model: &Model<'_, T>, node: &Node<'_>, rule: &str) -> Checked<(usize, Self)> {
        let [state, point] = node.fields("state point")?;
        let e = state.index(model.shape.states.len())?;
        let space = state.at(model.spaces.of(e))?;
        let point = Self::check(model, &Root { state: e, view: space.visible.times(&space.reading)? }, &point)?;
        let first = matches!(&point.place, Place::Joint { path, .. } if path.is_empty());
        node.need(first, rule, "a first-level joint is needed here")?;
        Ok((e, point))
    }

    /// Reads a point and checks what its certificate says.
    pub fn check(model: &Model<'_, T>, root: &Root<T>, node: &Node<'_>) -> Checked<Self> {
        let [at, verdict, kind, rule, common, branches] = node.fields("place verdict kind rule common branches")?;
        let place = Place::read(&at)?;
        let addresses = at.at(place.branches(model, root))?;
        let mut found: Vec<Branch> = Vec::new();
        for ((side, address), item) in addresses.iter().zip(&branches.exactly(addresses.len(), "point")?) {
            let seen = if item.is_null() { None } else { Some(rules::check(model, root, address, item)?) };
            found.push((*side, seen));
        }
        let point = node.at(conclude(place, rule.text()?, (&common, root.view.rows, &model.ground), &found))?;
        verdict.follows("point", point.verdict.word())?;
        kind.follows("point", point.kind)?;
        Ok(point)
    }
}

/// The conclusions: `plane` (a branch has more than one dimension), `line` (all branches have the same line), `differ` (the
/// two branches have different lines, or their tangent subspaces contain different lines).
fn conclude<T: Whole>(
    place: Place,
    rule: &str,
    (common, size, ground): (&Node<'_>, usize, &T::Ground),
    found: &[Branch],
) -> Checked<Point<T>> {
    need(!found.is_empty(), "point", "a point has branches")?;
    // `plane` and `differ` are about the branches that have a certificate; `line` is about all.
    let given: Vec<&Found> = found.iter().flat_map(|(_, found)| found).collect();
    let refuted = |place, kind| Ok(Point { place, verdict: Verdict::Refuted, kind, common: None });
    match (rule, &given[..]) {
        ("plane", [Found::Plane]) if common.is_null() => refuted(place, "none"),
        ("plane", _) => reject("plane", "one branch with a plane, and nothing else, is needed"),
        ("differ", [Found::Line(a) | Found::Direction(a), Found::Line(b) | Found::Direction(b)])
            if common.is_null() =>
        {
            need(a.differs(b), "differ", "the two lines are not seen to be different")?;
            // A line that is only contained has no rays.
            refuted(place, if a.left.len() == 1 && b.right.len() == 1 { "corner" } else { "none" })
        }
        ("differ", _) => reject("differ", "two branches with a line each, and nothing else, are needed"),
        ("line", _) => {
            let line = |(side, found): &'_ Branch| match found {
                Some(Found::Line(line)) => Ok((*side, line.clone())),
                _ => reject("point", "every branch needs a proved line"),
            };
            let lines: Vec<(Side, Line)> = found.iter().map(line).collect::<Checked<_>>()?;
            let (relations, common) = relations(common, size, ground, &lines)?;
            let (mut left, mut right) = (Vec::new(), Vec::new());
            for ((side, line), factor) in lines.iter().zip(relations) {
                left.extend(line.left.iter().filter(|_| *side != Some(End::Start)).map(|s| s * factor));
                right.extend(line.right.iter().filter(|_| *side != Some(End::Finish)).map(|s| s * factor));
            }
            let kind = kind(&place, &left, &right);
            Ok(Point { place, verdict: Verdict::Proved, kind, common })
        }
        _ => reject("point", "the rule is \"line\", \"differ\" (two branches) or \"plane\""),
    }
}

/// For each line the ray on which a common vector lies, as a sign; the vector is returned where it is one over the field of the
/// case. Of a single line `common` may be `null`; otherwise it is such a vector, or a list with one algebraic number for each coordinate,
/// each the root of a polynomial in an interval, as elements of the fields of the lines.
fn relations<T: Whole>(
    common: &Node<'_>,
    dimension: usize,
    ground: &T::Ground,
    lines: &[(Side, Line)],
) -> Checked<(Vec<i32>, Option<Matrix<T>>)> {
    let shared = |ray| common.some(ray, "line", "the lines are not seen to have this vector in common");
    if common.is_null() {
        return Ok((vec![shared((lines.len() == 1).then_some(1))?], None));
    }
    let mut vectors: Vec<Matrix> = lines.iter().map(|(_, line)| Matrix::empty(line.field.degree())).collect();
    let own = T::common(common, dimension, ground)?;
    for item in if own.is_none() { common.exactly(dimension, "format")? } else { Vec::new() } {
        let [polynomial, interval, elements] = item.fields("polynomial interval elements")?;
        let number = Field::read(&polynomial, &interval)?;
        let elements = elements.exactly(lines.len(), "format")?;
        for ((vector, element), (_, line)) in vectors.iter_mut().zip(elements).zip(lines) {
            let x = line.field.element(&element)?;
            element.need(line.field.is_root(&number, &x)?, "line", "the element is not this root")?;
            *vector = vector.stack(&x);
        }
    }
    let mut signs = Vec::new();
    for ((_, line), vector) in lines.iter().zip(vectors) {
        let vector = match &own {
            Some(v) => line.field.embedded(v)?,
            None => vector,
        };
        signs.push(shared(line.along(&vector)?)?);
    }
    Ok((signs, own))
}

/// The kind from the rays of the two sides.
fn kind(place: &Place, left: &[i32], right: &[i32]) -> &'static str {
    match (left, right) {
        ([_, _], _) | (_, [_, _]) => "oscillating",
        ([_], []) | ([], [_]) if matches!(place, Place::End(_) | Place::OfSet(_)) => "half-tangent",
        ([a], [b]) if a == b => "cusp",
        ([_], [_]) => "regular",
        _ => "none",
    }
}
