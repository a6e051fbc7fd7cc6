//! The whole certificate: contraction, points, answers, and the verdict that follows from them.

use crate::case::Case;
use crate::germ::Root;
use crate::json::Node;
use crate::matrix::Matrix;
use crate::points::{Place, Point, complete};
use crate::ring::Model;
use crate::shape::{Address, End, Kind};
use crate::spectrum::positive_definite;
use crate::{Accepted, Checked, Verdict, at, need, reject};
use num_traits::Signed;

/// What a case asks.
#[derive(Debug, PartialEq, Eq)]
enum Question {
    Ends,
    Joints,
    Address(Address),
    AnyPoint,
    EveryPoint,
}

/// The questions of a case: of a curve its end points and its joints, of a set the fixed points of the maps of the start state
/// to itself; then the addresses to examine, each once.
fn questions(case: &Case) -> Vec<Question> {
    let start = &case.shape.states[case.shape.start];
    let mut questions = Vec::new();
    if start.kind == Kind::Edge {
        questions = vec![Question::Ends, Question::Joints];
    } else {
        let own = (0..start.pieces.len()).filter(|&i| start.pieces[i].target == case.shape.start);
        questions.extend(own.map(|i| Question::Address(Address { prefix: Vec::new(), cycle: vec![i] })));
    }
    for address in case.examine.iter().cloned().map(Question::Address) {
        if !questions.contains(&address) {
            questions.push(address);
        }
    }
    questions
}

/// A question that the certificate adds: another address in its normal form, or, at the end, whether any point has a tangent.
fn further(case: &Case, item: &Node<'_>, asked: &[Question], last: bool) -> Checked<Question> {
    if item.tag("question")? == "any point" && last {
        return Ok(Question::AnyPoint);
    }
    if item.tag("question")? == "every point" && !asked.contains(&Question::EveryPoint) {
        return Ok(Question::EveryPoint);
    }
    let [_, of, _, _] = item.fields(["question", "address", "verdict", "points"])?;
    let address = crate::rules::read_address(&of)?;
    let normal = address.normalise(&case.shape, case.shape.start);
    let question = Question::Address(address.clone());
    of.refuse(
        normal.as_ref() != Some(&address) || asked.contains(&question),
        "answers",
        "the address is not in its normal form, or was asked for before",
    )?;
    Ok(question)
}

/// Checks the proof of a certificate of the kind `certify`.
pub fn check(case: &Case, node: &Node<'_>) -> Checked<Accepted> {
    let [contraction, points, answers] = node.fields(["contraction", "points", "answers"])?;
    let model = Model::read(&case.shape, &contraction)?;
    at(&contraction.place, case.shape.check_curves(&model.reachable))?;
    let root = Root { state: case.shape.start, view: case.shape.view.clone() };
    let mut checked = Vec::new();
    for item in points.list()? {
        let point = Point::check(&model, &root, &item)?;
        item.refuse(checked.iter().any(|p: &Point| p.place == point.place), "points", "the same point twice")?;
        checked.push(point);
    }
    let mut claims = Claims { model: &model, points: &checked, used: vec![false; checked.len()], lines: Vec::new() };
    let (items, mut asked) = (answers.list()?, questions(case));
    if items.len() < asked.len() {
        return reject("answers", &answers.place, format!("{} questions are asked", asked.len()));
    }
    for (k, item) in items.iter().enumerate().skip(asked.len()) {
        asked.push(further(case, item, &asked, k + 1 == items.len())?);
    }
    let mut together = None;
    for (item, question) in items.iter().zip(&asked) {
        let found = at(&item.place, claims.answer(item, question))?;
        if *question == Question::EveryPoint {
            continue;
        }
        together = Some(together.map_or(found, |t: Verdict| t.and(found)));
    }
    if let Some(k) = claims.used.iter().position(|used| !used) {
        return reject("points", &points.place, format!("point {k} answers no question"));
    }
    let together = together.unwrap_or(Verdict::Undetermined);
    let claims = claims.lines;
    let line = |p: &Point| format!("{}: {:?}, {}", p.verdict.word(), p.place, p.kind);
    Ok(Accepted { case: case.name.clone(), verdict: together, claims, points: checked.iter().map(line).collect() })
}

/// All operators are injective on the visible quotients; whether the map into the space where the shape is looked at is, too.
pub fn injective(model: &Model<'_>, rule: &str) -> Checked<bool> {
    let (shape, spaces) = (model.shape, &model.spaces);
    for &e in &model.reachable {
        for piece in &shape.states[e].pieces {
            let map = spaces.on_visible(e, piece)?;
            need(map.rank()? == map.cols, rule, &format!("an operator of state {e} is not injective"))?;
        }
    }
    let start = spaces.of(shape.start)?;
    Ok(shape.view.times(&start.basis)?.rank()? == start.visible.rows)
}

struct Claims<'a> {
    model: &'a Model<'a>,
    points: &'a [Point],
    used: Vec<bool>,
    lines: Vec<String>,
}

impl Claims<'_> {
    /// Checks the answer to a question.
    fn answer(&mut self, node: &Node<'_>, question: &Question) -> Checked<Verdict> {
        let (what, verdict, found) = match question {
            Question::Ends => {
                let [what, verdict, points] = node.fields(["question", "verdict", "points"])?;
                let ends = [Place::End(End::Start), Place::End(End::Finish)];
                let found = self.all(&points, &ends)?;
                self.lines.push(format!("{}: the curve has a tangent line at both end points", found.word()));
                (what.text()? == "ends", verdict, found)
            }
            Question::Address(address) => {
                let [what, of, verdict, points] = node.fields(["question", "address", "verdict", "points"])?;
                of.refuse(
                    crate::rules::read_address(&of)? != *address,
                    "answers",
                    "the case asks for another address here",
                )?;
                let found = self.all(&points, &[Place::of_address(self.model, address)?])?;
                let text = format!("a tangent line at the address {:?} ({:?})", address.prefix, address.cycle);
                self.lines.push(format!("{}: the shape has {text}", found.word()));
                (what.text()? == "address", verdict, found)
            }
            Question::Joints => {
                let [what, verdict, theorem, points, upstairs] =
                    node.fields(["question", "verdict", "theorem", "points", "upstairs"])?;
                let found = self.joints(&theorem, &points, &upstairs)?;
                (what.text()? == "joints", verdict, found)
            }
            Question::EveryPoint => {
                let found = crate::everywhere::check(self.model, self.points, node)?;
                if let Some(k) = found.witness {
                    self.used[k] = true;
                }
                self.lines.push(format!("{}: {}", found.verdict.word(), found.claim));
                (node.tag("question")? == "every point", node.field("verdict")?, found.verdict)
            }
            Question::AnyPoint => {
                let [what, verdict, products] = node.fields(["question", "verdict", "products"])?;
                self.similarities(&products)?;
                self.lines.push("refuted: some point of the shape has a tangent line".to_owned());
                (what.text()? == "any point", verdict, Verdict::Refuted)
            }
        };
        if !what || verdict.text()? != found.word() {
            return reject(
                "answers",
                &node.place,
                format!("another question, or what follows is \"{}\"", found.word()),
            );
        }
        Ok(found)
    }

    /// The points with the indices given.
    fn select(&mut self, node: &Node<'_>) -> Checked<Vec<usize>> {
        let items = node.list()?;
        let indices = items.iter().map(|n| n.index(self.points.len())).collect::<Checked<Vec<_>>>()?;
        node.refuse(indices.windows(2).any(|w| w[0] >= w[1]), "answers", "indices must ascend")?;
        indices.iter().for_each(|&k| self.used[k] = true);
        Ok(indices)
    }

    /// The verdict on "all these places have a tangent line" from some of them.
    fn all(&mut self, node: &Node<'_>, places: &[Place]) -> Checked<Verdict> {
        let chosen = self.select(node)?;
        node.refuse(
            chosen.iter().any(|&k| !places.contains(&self.points[k].place)),
            "answers",
            "a point that is not asked for",
        )?;
        let together = chosen.iter().map(|&k| self.points[k].verdict).reduce(Verdict::and);
        Ok(match together {
            Some(Verdict::Proved) if chosen.len() < places.len() => Verdict::Undetermined,
            Some(verdict) => verdict,
            None => Verdict::Undetermined,
        })
    }

    /// The joints: refuted by one of them; proved by Theorem 5 or 5′.
    fn joints(&mut self, theorem: &Node<'_>, points: &Node<'_>, upstairs: &Node<'_>) -> Checked<Verdict> {
        let chosen = self.select(points)?;
        let theorem_name = theorem.text()?;
        let items = upstairs.list()?;
        upstairs.refuse(!items.is_empty() && theorem_name != "5'", "joints", "only Theorem 5' uses joints upstairs")?;
        let place = |&k: &usize| self.points[k].joint(self.model, self.model.shape.start);
        let Some(listed) = chosen.iter().map(place).collect::<Option<Vec<_>>>() else {
            return reject("joints", &points.place, "a point that is no joint");
        };
        let mut verdict = chosen.iter().map(|&k| self.points[k].verdict).reduce(Verdict::and);
        let text = match (theorem_name, verdict) {
            ("none", Some(Verdict::Refuted)) => "every joint of every level",
            ("none", _) => {
                verdict = Some(Verdict::Undetermined);
                "every joint of every level"
            }
            ("5" | "5'", Some(Verdict::Proved)) => {
                complete(self.model, &listed, points, "joints")?;
                points.need(!listed.is_empty(), "joints", "there is no joint")?;
                at(&theorem.place, self.injective(theorem_name == "5"))?;
                if theorem_name == "5" {
                    "every joint of every level, a dense set"
                } else {
                    self.upstairs(&items, upstairs)?;
                    "the joints listed and every joint whose line upstairs is not killed, a dense set"
                }
            }
            _ => {
                return reject(
                    "joints",
                    &theorem.place,
                    "a theorem proves that joints have tangents; \"none\" otherwise",
                );
            }
        };
        let verdict = verdict.unwrap_or(Verdict::Undetermined);
        self.lines.push(format!("{}: the curve has a tangent line at {text}", verdict.word()));
        Ok(verdict)
    }

    /// The hypotheses of Theorem 5 (with the view) or 5′ (without it) on injectivity.
    fn injective(&self, with_view: bool) -> Checked<()> {
        let view = injective(self.model, "joints")?;
        need(view || !with_view, "joints", "the map into the space where the shape is looked at is not injective")
    }

    /// Theorem 5′: the joints in the visible quotients of their own states, and lines that span the quotients.
    fn upstairs(&self, items: &[Node<'_>], node: &Node<'_>) -> Checked<()> {
        let (shape, spaces) = (self.model.shape, &self.model.spaces);
        let mut listed = Vec::new();
        let mut spans = vec![Matrix::empty(0); shape.states.len()];
        for &e in &self.model.reachable {
            spans[e] = Matrix::empty(spaces.of(e)?.visible.rows);
        }
        for item in items {
            let (e, point) = Point::in_own_state(self.model, item, "joints")?;
            let joint = point.joint(self.model, e).filter(|j| !listed.contains(j));
            let new = point.verdict == Verdict::Proved && joint.is_some();
            item.need(new, "joints", "each first-level joint is proved once, in its own state")?;
            listed.extend(joint);
            if let Some(vector) = point.common {
                spans[e] = spans[e].stack(&vector.transpose()).echelon()?.0;
            }
        }
        complete(self.model, &listed, node, "joints")?;
        let images = |span: &Matrix, e: usize, k: usize| {
            span.times(&spaces.on_visible(e, &shape.states[e].pieces[k])?.transpose())
        };
        loop {
            let before: usize = spans.iter().map(|s| s.rows).sum();
            for &e in &self.model.reachable {
                for (k, piece) in shape.states[e].pieces.iter().enumerate() {
                    spans[e] = spans[e].stack(&images(&spans[piece.target], e, k)?).echelon()?.0;
                }
            }
            if spans.iter().map(|s| s.rows).sum::<usize>() == before {
                break;
            }
        }
        node.refuse(
            self.model.reachable.iter().any(|&e| spans[e].rows < spans[e].cols),
            "joints",
            "the tangent lines are not seen to span the visible quotients",
        )?;
        Ok(())
    }

    /// All maps are similarities for some scalar products on the relevant spaces, of dimension at least 2.
    fn similarities(&self, node: &Node<'_>) -> Checked<()> {
        let (shape, spaces) = (self.model.shape, &self.model.spaces);
        let items = node.list()?;
        node.refuse(
            items.len() != self.model.reachable.len(),
            "similarities",
            "one scalar product for each reachable state is needed",
        )?;
        let mut products: Vec<Matrix> = (0..shape.states.len()).map(|_| Matrix::identity(0)).collect();
        for (item, &e) in items.iter().zip(&self.model.reachable) {
            let n = spaces.of(e)?.basis.cols;
            item.refuse(n < 2, "similarities", "the relevant space has fewer than 2 dimensions")?;
            products[e] = positive_definite(item, n)?;
        }
        for &e in &self.model.reachable {
            for piece in &shape.states[e].pieces {
                let linear = spaces.linear(&piece.op, e, piece.target)?;
                let pulled = linear.transpose().times(&products[e])?.times(&linear)?;
                let own = &products[piece.target];
                let ratio = pulled.at(0, 0) / own.at(0, 0);
                let similar = ratio.is_positive() && pulled == own.scaled(&ratio);
                node.need(similar, "similarities", &format!("a map of state {e} is no similarity"))?;
            }
        }
        let start = spaces.of(shape.start)?;
        let injective = shape.view.times(&start.basis)?.rank()? == start.basis.cols;
        node.need(injective, "similarities", "the map into the space where the shape is looked at is not injective")
    }
}
