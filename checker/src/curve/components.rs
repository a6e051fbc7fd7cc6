//! Every point of a curve by its components: states with cones, loops that approach their fixed point along one eigenvector, and
//! states that are passed once (Theorem 13).

use super::everywhere::{Cones, MAX_WINDOW};
use super::frames::{ordered, sight};
use super::{Address, Kind, Leading, Model, Place, Point, Root};
use crate::base::{Checked, Matrix, Node, Verdict, whole};

/// The states that are proved so far.
struct Parts<'a> {
    model: &'a Model<'a>,
    /// By state.
    done: Vec<bool>,
    /// By state with cones: the rays, one a row; others have none.
    rays: Vec<Matrix>,
}

/// Checks the parts, each behind those that it needs, and why no tangent is lost where the curve is looked at.
pub fn check(model: &Model<'_>, parts: &Node<'_>, seen: &Node<'_>) -> Checked<()> {
    let shape = model.shape;
    let curves = shape.reachable.iter().all(|&e| shape.states[e].kind == Kind::Edge);
    parts.need(curves, "components", "only of a curve it is asked whether it is G¹")?;
    let none = Matrix::empty(1);
    let mut found = Parts { model, done: vec![false; shape.states.len()], rays: vec![none; shape.states.len()] };
    for item in parts.list()? {
        item.at(match item.tag("part")? {
            "cones" => found.cones(&item),
            "loop" => found.turning(&item),
            "transient" => found.transient(&item),
            _ => item.reject("format", "unknown part of a curve"),
        })?;
    }
    parts.need(found.done[shape.start], "components", "the start is not among the states that are proved")?;
    if seen.is_null() {
        let space = model.spaces.of(shape.start)?;
        let injective = shape.view.times(&space.basis)?.rank()? == space.basis.cols;
        return seen.need(
            injective,
            "components",
            "the map into the space where the curve is looked at is not injective",
        );
    }
    let [cones, maps, code] = seen.fields("cones maps code")?;
    let cones = cones.at(Cones::read(model, &shape.reachable, &cones, &maps))?;
    sight(model, (shape.start, &shape.view), &cones, &code).map(drop)
}

impl Parts<'_> {
    /// A state that is not proved yet.
    fn state(&self, node: &Node<'_>) -> Checked<usize> {
        let e = node.index(self.model.shape.states.len())?;
        let new = self.model.shape.reachable.contains(&e) && !self.done[e];
        node.need(new, "components", "a state that is not reached, or was proved before")?;
        Ok(e)
    }

    /// The state with its whole relevant space in sight.
    fn root(&self, e: usize) -> Checked<Root> {
        Ok(Root { state: e, view: self.model.spaces.of(e)?.reading.clone() })
    }

    /// A regular point for each first-level joint of some states, each seen in its relevant space, in their order; there are some.
    fn regular(&self, states: &[usize], node: &Node<'_>) -> Checked<()> {
        let mut wanted = self.model.joints()?;
        wanted.retain(|(e, ..)| states.contains(e));
        node.need(!wanted.is_empty(), "components", "states without joints")?;
        for (item, (e, left, right)) in node.exactly(wanted.len(), "components")?.iter().zip(wanted) {
            let point = Point::check(self.model, &self.root(e)?, item)?;
            let place = Place::Joint { path: Vec::new(), left, right };
            let why = format_args!("the joint of the pieces {left} and {right} of state {e}, regular, is needed here");
            let regular = point.verdict == Verdict::Proved && point.kind == "regular";
            item.need(point.place == place && regular, "components", why)?;
        }
        Ok(())
    }

    /// Theorem 6 or 6′ for all states that a state on a cycle reaches.
    fn cones(&mut self, node: &Node<'_>) -> Checked<()> {
        let [_, state, cones, maps, window, slow, joints] = node.fields("part state cones maps window slow joints")?;
        let states = ordered(self.model, &self.model.shape.below(self.state(&state)?));
        let found = cones.at(Cones::read(self.model, &states, &cones, &maps))?;
        slow.at(found.shrink(window.index(MAX_WINDOW + 1)?, &slow))?;
        self.regular(&states, &joints)?;
        for e in states {
            self.done[e] = true;
            self.rays[e] = found.rays[e].clone();
        }
        state.need(self.done[state.index(self.done.len())?], "components", "a state that does not come back to itself")
    }

    /// Exactly one piece leads back, forwards; the others lead to states with cones, whose rays have positive leading coefficients,
    /// or all negative ones, and are not killed on the way to the fixed point, which is regular or an end with one ray.
    fn turning(&mut self, node: &Node<'_>) -> Checked<()> {
        let [_, state, letter, top, functional, joints, fixed] =
            node.fields("part state letter top functional joints fixed")?;
        let (e, model) = (self.state(&state)?, self.model);
        let pieces = &model.shape.states[e].pieces;
        let back = letter.index(pieces.len())?;
        letter.need(
            pieces[back].target == e && !pieces[back].reversed,
            "components",
            "the piece does not lead back",
        )?;
        state.need(pieces.len() > 1, "components", "there are no other pieces")?;
        let space = model.spaces.of(e)?;
        let linear = model.spaces.linear(&pieces[back].op, e, e)?;
        let falls = linear.power(space.basis.cols)?;
        let leading = Leading::read(&top, &linear, &model.ground)?;
        top.need(leading.eigenvalue_sign() > 0, "components", "the leading eigenvalue must be positive")?;
        let (row, _) = leading.row(&linear, &functional)?;
        let mut signs = Vec::new();
        for piece in pieces.iter().enumerate().filter(|(i, _)| *i != back).map(|(_, p)| p) {
            let rays = &self.rays[piece.target];
            let cones = rays.rows > 0 && piece.target != e && !model.shape.below(piece.target).contains(&e);
            node.need(cones, "components", "a piece leads to a state without cones, or to one that leads back")?;
            let inner = model.spaces.linear(&piece.op, e, piece.target)?;
            let kept = falls.times(&inner)?.rank()? == inner.cols;
            node.need(kept, "components", "a direction of a piece is killed on its way")?;
            let turn = whole(if piece.reversed { -1 } else { 1 });
            let images = rays.times(&piece.op.transpose())?.times(&space.reading.transpose())?.scaled(&turn);
            for k in 0..images.rows {
                let value = leading.field.applied(&images.row(k), &row)?;
                signs.push(leading.field.sign(&value)?);
            }
        }
        let one = signs.first().is_some_and(|s| *s != 0) && signs.iter().all(|s| *s == signs[0]);
        functional.need(one, "components", "the leading coefficients of the rays do not have one strict sign")?;
        self.regular(&[e], &joints)?;
        let point = Point::check(model, &self.root(e)?, &fixed)?;
        let own = Place::of_address(model, e, &Address { prefix: Vec::new(), cycle: vec![back] })?;
        let smooth = point.verdict == Verdict::Proved && matches!(point.kind, "regular" | "half-tangent");
        fixed.need(point.place == own && smooth, "components", "the fixed point, regular or an end, is needed here")?;
        self.done[e] = true;
        Ok(())
    }

    /// No piece leads back, all operators are injective, and all pieces lead to states that are proved.
    fn transient(&mut self, node: &Node<'_>) -> Checked<()> {
        let [_, state, joints] = node.fields("part state joints")?;
        let (e, model) = (self.state(&state)?, self.model);
        state.need(!model.shape.below(e).contains(&e), "components", "a piece leads back to the state")?;
        for piece in &model.shape.states[e].pieces {
            let basis = &model.spaces.of(piece.target)?.basis;
            let injective = basis.cols > 0 && piece.op.times(basis)?.rank()? == basis.cols;
            node.need(self.done[piece.target] && injective, "components", "a piece is not proved, or not injective")?;
        }
        self.regular(&[e], &joints)?;
        self.done[e] = true;
        Ok(())
    }
}
