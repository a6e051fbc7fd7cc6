//! The whole certificate: contraction, points, answers, and the verdict that follows from them.

use super::{Address, Case, End, Germ, Kind, Model, Piece, Place, Point, Root, Way};
use super::{arcs, close, complete, components, everywhere, frames, positive_definite, read_address};
use crate::base::{Accepted, Checked, Matrix, Node, Surd, Verdict, Whole, need, together};
use crate::claim::{Claim, Decided, Joints, Subject};
use crate::regularity::graph;
use num_bigint::BigInt;

/// The question whether the curve is G¹, answered by cones or by a point.
const EVERY: &str = "every point";
/// The question whether the curve is G¹, answered by Theorem 12.
const DERIVATIVE: &str = "every point by its derivative";
/// The same in a parameter of which the pieces take given shares.
const SHARES: &str = "every point by its derivative in shares";
/// The same, answered by Theorem 6″.
const ARCS: &str = "every point by polynomials";
/// The same, answered by Theorem 13.
const COMPONENTS: &str = "every point by components";
/// All of these.
const TURNS: [&str; 5] = [EVERY, DERIVATIVE, SHARES, ARCS, COMPONENTS];

/// The question about the joints whose lines are not killed, beside joints that are not all proved.
const NOT_KILLED: &str = "joints not killed";

/// Entries over which some rules are checked, or refused.
pub trait Derived: Whole {
    /// Theorem 6″.
    fn arcs(model: &Model<'_, Self>, degree: &Node<'_>, arcs: &Node<'_>) -> Checked<Verdict>;
    /// Theorem 13.
    fn components(model: &Model<'_, Self>, parts: &Node<'_>, seen: &Node<'_>) -> Checked<()>;
}

impl Derived for BigInt {
    fn arcs(model: &Model<'_>, degree: &Node<'_>, arcs: &Node<'_>) -> Checked<Verdict> {
        arcs::check(model, degree, arcs)
    }

    fn components(model: &Model<'_>, parts: &Node<'_>, seen: &Node<'_>) -> Checked<()> {
        components::check(model, parts, seen)
    }
}

impl Derived for Surd {
    fn arcs(_: &Model<'_, Self>, _: &Node<'_>, arcs: &Node<'_>) -> Checked<Verdict> {
        arcs.reject("arc", "arcs are checked over the rational numbers only")
    }

    fn components(_: &Model<'_, Self>, parts: &Node<'_>, _: &Node<'_>) -> Checked<()> {
        parts.reject("components", "components are checked over the rational numbers only")
    }
}

/// What a case asks: `ends`, `joints`, `address` (with the address), `every point` or `any point`.
type Question = (&'static str, Option<Address>);

/// The questions of a case: of a curve its end points and its joints, of a set the fixed points of the maps of the start state
/// to itself; then the addresses to examine, each once.
fn questions<T: Whole>(case: &Case<T>) -> Vec<Question> {
    let start = &case.shape.states[case.shape.start];
    let mut questions = Vec::new();
    if start.kind == Kind::Edge {
        questions = vec![("ends", None), ("joints", None)];
    } else {
        let own = (0..start.pieces.len()).filter(|&i| start.pieces[i].target == case.shape.start);
        questions.extend(own.map(|i| ("address", Some(Address { prefix: Vec::new(), cycle: vec![i] }))));
    }
    for address in case.examine.iter().cloned() {
        let question = ("address", Some(address));
        if !questions.contains(&question) {
            questions.push(question);
        }
    }
    questions
}

/// A question that the certificate adds: another address in its normal form, or, at the end, whether any point has a tangent.
fn further<T: Whole>(case: &Case<T>, item: &Node<'_>, asked: &[Question], last: bool) -> Checked<Question> {
    match item.tag("question")? {
        "any point" if last => return Ok(("any point", None)),
        NOT_KILLED
            if asked.iter().any(|(what, _)| *what == "joints") && asked.iter().all(|(what, _)| *what != NOT_KILLED) =>
        {
            return Ok((NOT_KILLED, None));
        }
        tag => {
            if let Some(turns) = TURNS.into_iter().find(|t| *t == tag && asked.iter().all(|(what, _)| what != t)) {
                return Ok((turns, None));
            }
        }
    }
    let [_, of, _, _] = item.fields("question address verdict points")?;
    let address = read_address(&of)?;
    let normal = address.normalise(&case.shape, case.shape.start).as_ref() == Some(&address);
    let question = ("address", Some(address));
    let new = normal && !asked.contains(&question);
    of.need(new, "answers", "the address is not in its normal form, or was asked for before")?;
    Ok(question)
}

/// The answer to one of the questions whether a curve is G¹.
fn every_point<T: Derived>(model: &Model<'_, T>, points: &[Point<T>], node: &Node<'_>) -> Checked<everywhere::Answer> {
    let verdict = match node.tag("question")? {
        EVERY => return everywhere::check(model, points, node),
        DERIVATIVE => {
            let [_, _, radius] = node.fields("question verdict radius")?;
            radius.at(graph(model, None, &radius))?;
            Verdict::Proved
        }
        SHARES => {
            let [_, _, shares, radius] = node.fields("question verdict shares radius")?;
            radius.at(graph(model, Some(&shares), &radius))?;
            Verdict::Proved
        }
        ARCS => {
            let [_, _, degree, arcs] = node.fields("question verdict degree arcs")?;
            arcs.at(T::arcs(model, &degree, &arcs))?
        }
        COMPONENTS => {
            let [_, _, parts, seen] = node.fields("question verdict parts seen")?;
            parts.at(T::components(model, &parts, &seen))?;
            Verdict::Proved
        }
        _ => return node.reject("answers", "this is no question about every point of a curve"),
    };
    let claims = vec![Claim::TangentTurns { rate: None }.is(verdict)];
    Ok(everywhere::Answer { witness: None, claims })
}

/// Whether a curve is G¹, by such an answer.
pub fn turns(model: &Model<'_>, points: &[Point], node: &Node<'_>) -> Checked<Verdict> {
    let found = every_point(model, points, node)?;
    let decided = found.claims.iter().find(|d| matches!(d.claim, Claim::TangentTurns { .. }));
    let verdict = node.some(decided, "answers", "nothing is said of every point")?.verdict;
    node.field("verdict")?.follows("answers", verdict.word())?;
    Ok(verdict)
}

/// Checks the proof of a certificate of the kind `certify`.
pub fn check<T: Derived>(case: &Case<T>, ground: &T::Ground, proof: [&Node<'_>; 3]) -> Checked<Accepted> {
    let [contraction, points, answers] = proof;
    let model = Model::read(&case.shape, ground, contraction)?;
    contraction.at(case.shape.check_curves())?;
    let root = Root { state: case.shape.start, view: case.shape.view.clone() };
    let mut checked: Vec<Point<T>> = Vec::new();
    for item in points.list()? {
        let point = Point::check(&model, &root, &item)?;
        item.need(checked.iter().all(|p| p.place != point.place), "points", "the same point twice")?;
        checked.push(point);
    }
    let mut claims = Claims { model: &model, points: &checked, used: vec![false; checked.len()], found: Vec::new() };
    let (items, mut asked) = (answers.list()?, questions(case));
    answers.need(items.len() >= asked.len(), "answers", format_args!("{} questions are asked", asked.len()))?;
    for (k, item) in items.iter().enumerate().skip(asked.len()) {
        asked.push(further(case, item, &asked, k + 1 == items.len())?);
    }
    let mut found = Vec::new();
    for (item, question) in items.iter().zip(&asked) {
        let verdict = item.at(claims.answer(item, question))?;
        found.extend((question.0 != NOT_KILLED && !TURNS.contains(&question.0)).then_some(verdict));
    }
    points.need(claims.used.iter().all(|used| *used), "points", "a point answers no question")?;
    let line = |p: &Point<T>| Claim::Point { place: p.place.clone(), kind: p.kind }.is(p.verdict);
    let points = checked.iter().map(line).collect();
    // A set none of whose maps leads back to it asks nothing; then nothing is proved.
    Ok(Accepted { case: case.name.clone(), verdict: together(found), claims: claims.found, points })
}

/// All operators are injective on the visible quotients; whether the map into the space where the shape is looked at is, too.
pub fn injective<T: Whole>(model: &Model<'_, T>, rule: &str) -> Checked<bool> {
    let Model { shape, spaces, .. } = model;
    for (e, piece) in shape.pieces() {
        let map = spaces.on_visible(e, piece)?;
        need(map.rank()? == map.cols, rule, format_args!("an operator of state {e} is not injective"))?;
    }
    let start = spaces.of(shape.start)?;
    Ok(shape.view.times(&start.basis)?.rank()? == start.visible.rows)
}

struct Claims<'a, T: Whole> {
    model: &'a Model<'a, T>,
    points: &'a [Point<T>],
    used: Vec<bool>,
    found: Vec<Decided>,
}

impl<'a, T: Derived> Claims<'a, T> {
    /// Checks the answer to a question.
    fn answer(&mut self, node: &Node<'_>, question: &Question) -> Checked<Verdict> {
        let mut more = Vec::new();
        let (stated, verdict, claim) = match question {
            ("ends", _) => {
                let [_, stated, points] = node.fields("question verdict points")?;
                let found = self.all(&points, &[Place::End(End::Start), Place::End(End::Finish)])?;
                (stated, found, Claim::TangentAtEnds)
            }
            (_, Some(address)) => {
                let [_, of, stated, points] = node.fields("question address verdict points")?;
                of.need(read_address(&of)? == *address, "answers", "the case asks for another address here")?;
                let found = self.all(&points, &[Place::of_address(self.model, self.model.shape.start, address)?])?;
                (stated, found, Claim::TangentAt { address: address.clone(), of: self.subject(address, found)? })
            }
            ("joints", _) => {
                let [_, stated, theorem, points, upstairs] = node.fields("question verdict theorem points upstairs")?;
                let (found, places) = self.joints([&theorem, &points, &upstairs])?;
                (stated, found, Claim::TangentAtJoints(places))
            }
            (what, None) if *what == NOT_KILLED => {
                let [_, stated, theorem, upstairs] = node.fields("question verdict theorem upstairs")?;
                self.not_killed(&theorem, &upstairs)?;
                (stated, Verdict::Proved, Claim::TangentAtJoints(Joints::OnlyNotKilled))
            }
            (what, None) if TURNS.contains(what) => {
                let mut found = every_point(self.model, self.points, node)?;
                found.witness.into_iter().for_each(|k| self.used[k] = true);
                more = found.claims.split_off(1);
                let first = found.claims.swap_remove(0);
                (node.field("verdict")?, first.verdict, first.claim)
            }
            (_, None) => {
                let [_, stated, products] = node.fields("question verdict products")?;
                self.similarities(&products)?;
                (stated, Verdict::Refuted, Claim::TangentSomewhere)
            }
        };
        let asked = node.tag("question")? == question.0 && stated.text()? == verdict.word();
        node.need(asked, "answers", format_args!("another question, or what follows is \"{}\"", verdict.word()))?;
        self.found.push(claim.is(verdict));
        self.found.append(&mut more);
        Ok(verdict)
    }

    /// What the claim about an address is about (theory §9, Branch and shape). Of a set every refutation by a branch is one of the
    /// whole set. What is proved of the germ of a branch, which every rule for a line proves to be isolated unless `Y` is a line,
    /// is proved of the set where everything near the point belongs to the branch: it has no prefix, different points are seen
    /// as different ones, and no piece that `L` collapses, which may pass through the point, was left out.
    fn subject(&self, address: &Address, verdict: Verdict) -> Checked<Subject> {
        let shape = self.model.shape;
        if shape.states[shape.start].kind == Kind::Edge {
            return Ok(Subject::Curve);
        }
        match verdict {
            Verdict::Refuted => return Ok(Subject::Set),
            Verdict::Undetermined => return Ok(Subject::Branch),
            Verdict::Proved => {}
        }
        let germ = Germ::new(self.model, &Root { state: shape.start, view: shape.view.clone() }, address)?;
        let nothing_aside = germ.dim() == 1 || !germ.collapses;
        let whole = address.prefix.is_empty() && germ.view.rank()? == germ.dim() && nothing_aside;
        Ok(if whole { Subject::Set } else { Subject::Branch })
    }

    /// The points with the indices given.
    fn select(&mut self, node: &Node<'_>) -> Checked<Vec<&'a Point<T>>> {
        let indices = node.indices(self.points.len())?;
        node.need(indices.windows(2).all(|w| w[0] < w[1]), "answers", "indices must ascend")?;
        indices.iter().for_each(|&k| self.used[k] = true);
        Ok(indices.iter().map(|&k| &self.points[k]).collect())
    }

    /// The verdict on "all these places have a tangent line" from some of them.
    fn all(&mut self, node: &Node<'_>, places: &[Place]) -> Checked<Verdict> {
        let chosen = self.select(node)?;
        let asked = chosen.iter().all(|p| places.contains(&p.place));
        node.need(asked, "answers", "a point that is not asked for")?;
        Ok(match together(chosen.iter().map(|p| p.verdict)) {
            Verdict::Proved if places.is_empty() || chosen.len() < places.len() => Verdict::Undetermined,
            found => found,
        })
    }

    /// The joints: refuted by one of them; proved by Theorem 5 or 5′. Says at which joints.
    fn joints(&mut self, [theorem, points, upstairs]: [&Node<'_>; 3]) -> Checked<(Verdict, Joints)> {
        let (model, name, items) = (self.model, theorem.text()?, upstairs.list()?);
        let chosen = self.select(points)?;
        let uses = matches!(name, "5'" | "11" | "11'");
        upstairs.need(items.is_empty() || uses, "joints", "this theorem uses no joints upstairs")?;
        let listed: Option<Vec<_>> = chosen.iter().map(|p| p.place.joint(model, model.shape.start)).collect();
        let listed = points.some(listed, "joints", "a point that is no joint")?;
        let together = chosen.iter().map(|p| p.verdict).min();
        if name == "none" {
            let refuted = together == Some(Verdict::Refuted);
            let verdict = if refuted { Verdict::Refuted } else { Verdict::Undetermined };
            return Ok((verdict, Joints::All));
        }
        // Frames list the joints of their own states; where those of the start are points as they are seen, none is listed here.
        let by_frames = matches!(name, "11" | "11'") && (chosen.is_empty() || together == Some(Verdict::Proved));
        let fits = by_frames || matches!(name, "5" | "5'") && together == Some(Verdict::Proved);
        theorem.need(fits, "joints", "a theorem proves that joints have tangents; \"none\" otherwise")?;
        if matches!(name, "11" | "11'") {
            let constant = frames::check(model, upstairs, name == "11")?;
            return Ok((
                Verdict::Proved,
                match (name, constant) {
                    ("11", false) => Joints::All,
                    ("11", true) => Joints::Seen,
                    _ => Joints::NotKilled,
                },
            ));
        }
        complete(model, &listed, points, "joints")?;
        theorem.at(self.injective(name == "5"))?;
        if name == "5" {
            return Ok((Verdict::Proved, Joints::All));
        }
        self.upstairs(&items, upstairs)?;
        Ok((Verdict::Proved, Joints::NotKilled))
    }

    /// Theorem 5′ or 11′ by itself: what is needed of the joints is upstairs, in the states where they are.
    fn not_killed(&self, theorem: &Node<'_>, upstairs: &Node<'_>) -> Checked<()> {
        let (name, items) = (theorem.text()?, upstairs.list()?);
        theorem.need(
            matches!(name, "5'" | "11'") && !items.is_empty(),
            "joints",
            "Theorem 5' or 11', with its joints",
        )?;
        if name == "11'" {
            return frames::check(self.model, upstairs, false).map(drop);
        }
        theorem.at(self.injective(false))?;
        self.upstairs(&items, upstairs)
    }

    /// The hypotheses of Theorem 5 (with the view) or 5′ (without it) on injectivity.
    fn injective(&self, with_view: bool) -> Checked<()> {
        let view = injective(self.model, "joints")?;
        need(view || !with_view, "joints", "the map into the space where the shape is looked at is not injective")
    }

    /// Theorem 5′: the joints in the visible quotients of their own states, and lines that span the quotients.
    fn upstairs(&self, items: &[Node<'_>], node: &Node<'_>) -> Checked<()> {
        let Model { shape, spaces, .. } = self.model;
        let (mut listed, mut spans) = (Vec::new(), shape.no_rows());
        for &e in &shape.reachable {
            spans[e] = Matrix::empty(spaces.of(e)?.visible.rows);
        }
        for item in items {
            let (e, point) = Point::in_own_state(self.model, item, "joints")?;
            let joint = point.place.joint(self.model, e).filter(|j| !listed.contains(j));
            let new = point.verdict == Verdict::Proved && joint.is_some();
            item.need(new, "joints", "each first-level joint is proved once, in its own state")?;
            listed.extend(joint);
            spans[e] = point.common.iter().fold(spans[e].clone(), |span, vector| span.stack(&vector.transpose()));
        }
        complete(self.model, &listed, node, "joints")?;
        let image = |e, p: &Piece<T>, span: &Matrix<T>| span.times(&spaces.on_visible(e, p)?.transpose());
        let spans = close(shape, spans, Way::Up, image)?;
        let all = shape.reachable.iter().all(|&e| spans[e].rows == spans[e].cols);
        node.need(all, "joints", "the tangent lines are not seen to span the visible quotients")
    }

    /// All maps are similarities for some scalar products on the relevant spaces, of dimension at least 2.
    fn similarities(&self, node: &Node<'_>) -> Checked<()> {
        let Model { shape, spaces, .. } = self.model;
        let mut products = shape.no_rows();
        for (e, item) in self.model.for_states(node, "similarities")? {
            let n = spaces.of(e)?.basis.cols;
            item.need(n >= 2, "similarities", "the relevant space has fewer than 2 dimensions")?;
            products[e] = positive_definite(&item, n, &self.model.ground)?;
        }
        for (e, piece) in shape.pieces() {
            let linear = spaces.linear(&piece.op, e, piece.target)?;
            let pulled = linear.transpose().times(&products[e])?.times(&linear)?;
            let own = &products[piece.target];
            // The first entry of a scalar product is positive.
            let (image, first) = (pulled.part(0..1, 0..1), own.part(0..1, 0..1));
            let similar = image.all_positive() && pulled.multiple(&first) == own.multiple(&image);
            node.need(similar, "similarities", format_args!("a map of state {e} is no similarity"))?;
        }
        let start = spaces.of(shape.start)?;
        let injective = shape.view.times(&start.basis)?.rank()? == start.basis.cols;
        node.need(injective, "similarities", "the map into the space where the shape is looked at is not injective")
    }
}
