//! Joints of shapes that start somewhere: frames, all joints or a dense set of them (Theorems 11, 11′ and 11″).

use super::everywhere::Cones;
use super::{Kind, Model, Place, Point, Root};
use crate::base::{Checked, Matrix, Node, Verdict, Whole, need, some, spend};

/// Most frames.
const MAX_FRAMES: usize = 200;

/// A state, and rows on the coordinates of its relevant space in reduced echelon form, whose kernel is what is not seen.
#[derive(Clone)]
struct Frame<T: Whole> {
    state: usize,
    rows: Matrix<T>,
}

impl<T: Whole> PartialEq for Frame<T> {
    fn eq(&self, other: &Self) -> bool {
        self.state == other.state && self.rows == other.rows
    }
}

/// Checks one FRAME for each frame, in the order in which they are found; of folded frames with cones alone where `every` joint
/// is claimed. Says whether some cell is a single point where it is looked at.
pub fn check<T: Whole>(model: &Model<'_, T>, node: &Node<'_>, every: bool) -> Checked<bool> {
    let shape = model.shape;
    let curves = shape.reachable.iter().all(|&e| shape.states[e].kind == Kind::Edge);
    node.need(curves, "frames", "only curves have joints")?;
    let view = shape.view.times(&model.spaces.of(shape.start)?.basis)?;
    let mut open = vec![Frame { state: shape.start, rows: view.echelon()?.0 }];
    node.need(open[0].rows.rows > 0, "frames", "the curve is a single point where it is looked at")?;
    let (items, mut joints, mut constant) = (node.list()?, 0, false);
    let mut next = 0;
    while next < open.len() {
        let item = node.some(items.get(next), "frames", "a frame is missing")?;
        let frame = open[next].clone();
        let (count, behind) = item.at(frame.check(model, item, every))?;
        for exit in behind {
            if exit.rows.rows == 0 {
                constant |= model.spaces.of(exit.state)?.basis.cols > 0;
            } else if !open.contains(&exit) {
                open.push(exit);
            }
        }
        need(open.len() <= MAX_FRAMES, "limit", "too many frames")?;
        (joints, next) = (joints + count, next + 1);
    }
    node.need(items.len() == open.len() && joints > 0, "frames", "there are other frames, or no joints")?;
    Ok(constant)
}

/// The states in an order that does not depend on the frame: breadth first from the start.
pub fn ordered<T: Whole>(model: &Model<'_, T>, states: &[usize]) -> Vec<usize> {
    model.shape.reachable.iter().copied().filter(|e| states.contains(e)).collect()
}

impl<T: Whole> Frame<T> {
    /// The frame behind a piece.
    fn behind(&self, model: &Model<'_, T>, letter: usize) -> Checked<Self> {
        let piece = &model.shape.states[self.state].pieces[letter];
        let linear = model.spaces.linear(&piece.op, self.state, piece.target)?;
        Ok(Self { state: piece.target, rows: self.rows.times(&linear)?.echelon()?.0 })
    }

    /// The frame behind a word.
    fn along(&self, model: &Model<'_, T>, word: &[usize]) -> Checked<Self> {
        let mut at = self.clone();
        for &letter in word {
            let exists = letter < model.shape.states[at.state].pieces.len();
            need(exists, "word", "a letter of a word does not exist")?;
            at = at.behind(model, letter)?;
        }
        Ok(at)
    }

    /// The joints of the state, as pairs of neighbours among the pieces that are more than a point where they are looked at.
    fn joints(&self, model: &Model<'_, T>) -> Checked<Vec<(usize, usize)>> {
        let mut kept = Vec::new();
        for letter in 0..model.shape.states[self.state].pieces.len() {
            if self.behind(model, letter)?.rows.rows > 0 {
                kept.push(letter);
            }
        }
        Ok(kept.windows(2).map(|w| (w[0], w[1])).collect())
    }

    /// The smallest family with these rows that is carried along the pieces between the states.
    fn family(&self, model: &Model<'_, T>, states: &[usize]) -> Checked<Vec<Self>> {
        let none = |&state: &usize| Ok(Self { state, rows: Matrix::empty(model.spaces.of(state)?.basis.cols) });
        let mut family = states.iter().map(none).collect::<Checked<Vec<_>>>()?;
        let own = family.iter_mut().find(|f| f.state == self.state);
        some(own, "frames", "a frame outside its own states")?.rows = self.rows.clone();
        let mut grown = true;
        while std::mem::take(&mut grown) {
            for k in 0..family.len() {
                for letter in 0..model.shape.states[family[k].state].pieces.len() {
                    spend(1, 0)?;
                    let image = family[k].behind(model, letter)?;
                    let Some(to) = family.iter_mut().find(|f| f.state == image.state) else { continue };
                    if let Some((joined, _)) = to.rows.joined(&image.rows)? {
                        (to.rows, grown) = (joined, true);
                    }
                }
            }
        }
        Ok(family)
    }

    /// A component is seen through its own quotient, and its operators are injective there.
    fn is_good(&self, model: &Model<'_, T>, family: &[Self]) -> Checked<bool> {
        let of = |state: usize| family.iter().find(|f| f.state == state);
        if of(self.state).is_none_or(|own| own.rows.rows != self.rows.rows) {
            return Ok(false);
        }
        for frame in family {
            for letter in 0..model.shape.states[frame.state].pieces.len() {
                let image = frame.behind(model, letter)?;
                if of(image.state).is_some_and(|to| to.rows.rows != image.rows.rows) {
                    return Ok(false);
                }
            }
        }
        Ok(true)
    }

    /// Checks `{"state", "joints", "cones"}`: how many joints there are, and the frames behind this one.
    fn check(&self, model: &Model<'_, T>, node: &Node<'_>, every: bool) -> Checked<(usize, Vec<Self>)> {
        let [state, joints, cones] = node.fields("state joints cones")?;
        let shape = model.shape;
        let same = state.index(shape.states.len())? == self.state;
        state.need(same, "frames", format_args!("the frame of state {} is expected here", self.state))?;
        let ahead = model.shape.below(self.state);
        let mut own = Vec::new();
        for &e in &ahead {
            if model.shape.below(e).contains(&self.state) {
                own.push(e);
            }
        }
        let own = ordered(model, &own);
        let component = if own.is_empty() { vec![self.clone()] } else { self.family(model, &own)? };
        if own.is_empty() || self.is_good(model, &component)? {
            cones.need(cones.is_null(), "frames", "only a folded frame needs cones")?;
            let (count, _) = examined(model, &component, &joints)?;
            let mut exits = Vec::new();
            for frame in &component {
                for (letter, piece) in shape.states[frame.state].pieces.iter().enumerate() {
                    if !own.contains(&piece.target) {
                        exits.push(frame.behind(model, letter)?);
                    }
                }
            }
            return Ok((count, exits));
        }
        let states = ordered(model, &ahead);
        let family = self.family(model, &states)?;
        let (count, lines) = examined(model, &family, &joints)?;
        if cones.is_null() {
            node.need(!every, "frames", "a folded frame has joints that are not decided without cones")?;
            node.at(spans(model, &family, lines))?;
        } else {
            cones.at(self.in_sight(model, &states, &cones))?;
        }
        Ok((count, Vec::new()))
    }

    /// Theorem 11″: cones that hold all chords, a complete prefix code below which they are seen, and the joints above it.
    fn in_sight(&self, model: &Model<'_, T>, states: &[usize], node: &Node<'_>) -> Checked<()> {
        let [cones, maps, code, above] = node.fields("cones maps code above")?;
        let found = cones.at(Cones::read(model, states, &cones, &maps))?;
        let root = Root { state: self.state, view: self.rows.times(&model.spaces.of(self.state)?.reading)? };
        let inner = sight(model, (self.state, &root.view), &found, &code)?;
        let mut listed = Vec::new();
        for item in above.list()? {
            let [point] = item.fields("point")?;
            let point = Point::check(model, &root, &point)?;
            let Place::Joint { path, left, right } = &point.place else {
                return item.reject("frames", "a joint is needed here");
            };
            item.need(point.verdict == Verdict::Proved, "frames", "the joint is not proved")?;
            listed.push((path.clone(), *left, *right));
        }
        for word in inner {
            for (left, right) in self.along(model, &word)?.joints(model)? {
                let there = listed.contains(&(word.clone(), left, right));
                above.need(
                    there,
                    "frames",
                    format_args!("the joint of pieces {left} and {right} of {word:?} is missing"),
                )?;
            }
        }
        Ok(())
    }
}

/// A complete prefix code of words from a state, each with a functional that is positive on the cone of its state as it is seen
/// through the view: the words that have longer ones in the code.
pub fn sight<T: Whole>(
    model: &Model<'_, T>,
    (from, view): (usize, &Matrix<T>),
    cones: &Cones<'_, T>,
    node: &Node<'_>,
) -> Checked<Vec<Vec<usize>>> {
    let mut words = Vec::new();
    for item in node.list()? {
        let [word, functional] = item.fields("word functional")?;
        words.push((word.word()?, functional));
    }
    let (mut inner, mut open, mut leaves) = (Vec::new(), vec![Vec::new()], 0);
    while let Some(word) = open.pop() {
        let (product, end) = model.shape.product(from, &word)?;
        if let Some((_, row)) = words.iter().find(|(w, _)| *w == word) {
            let images = view.times(&product)?.times(&cones.rays[end].transpose())?;
            let functional: Matrix<T> = row.column(images.rows, &model.ground)?;
            let values = functional.transpose().times(&images)?;
            let positive = values.cols > 0 && values.all_positive();
            row.need(positive, "frames", format_args!("the functional is not positive on the cone of {word:?}"))?;
            leaves += 1;
            continue;
        }
        let longer = words.iter().any(|(w, _)| w.len() > word.len() && w.starts_with(&word));
        node.need(longer, "frames", format_args!("no word of the code begins like {word:?}, or is its beginning"))?;
        open.extend((0..model.shape.states[end].pieces.len()).map(|letter| [word.as_slice(), &[letter]].concat()));
        inner.push(word);
    }
    node.need(leaves == words.len(), "frames", "a word of the code goes on behind another one")?;
    Ok(inner)
}

/// Every first-level joint of each member is proved, once, in its own state seen through the rows: how many there are, and by
/// member their rational lines.
fn examined<T: Whole>(model: &Model<'_, T>, family: &[Frame<T>], node: &Node<'_>) -> Checked<(usize, Vec<Matrix<T>>)> {
    let mut wanted = Vec::new();
    for frame in family {
        wanted.extend(frame.joints(model)?.into_iter().map(|(left, right)| (frame.state, left, right)));
    }
    let mut lines: Vec<Matrix<T>> = family.iter().map(|f| Matrix::empty(f.rows.rows)).collect();
    for (item, &(e, left, right)) in node.exactly(wanted.len(), "frames")?.iter().zip(&wanted) {
        let [state, point] = item.fields("state point")?;
        let k = some(family.iter().position(|f| f.state == e), "frames", "another state")?;
        let view = family[k].rows.times(&model.spaces.of(e)?.reading)?;
        let point = Point::check(model, &Root { state: e, view }, &point)?;
        let place = Place::Joint { path: Vec::new(), left, right };
        let fits = state.index(model.shape.states.len())? == e && point.place == place;
        item.need(
            fits,
            "frames",
            format_args!("the joint of pieces {left} and {right} of state {e} is expected here"),
        )?;
        item.need(point.verdict == Verdict::Proved, "frames", "the joint is not proved")?;
        if let Some(vector) = &point.common {
            lines[k] = lines[k].stack(&vector.transpose());
        }
    }
    Ok((wanted.len(), lines))
}

/// The lines and their images span all quotients.
fn spans<T: Whole>(model: &Model<'_, T>, family: &[Frame<T>], lines: Vec<Matrix<T>>) -> Checked<()> {
    let mut spans = lines.iter().map(|m| Ok(m.echelon()?.0)).collect::<Checked<Vec<_>>>()?;
    let mut grown = true;
    while std::mem::take(&mut grown) {
        for (k, frame) in family.iter().enumerate() {
            for piece in &model.shape.states[frame.state].pieces {
                spend(1, 0)?;
                let target = family.iter().position(|f| f.state == piece.target);
                let j = some(target, "frames", "a state outside the family")?;
                let onto = frame.rows.times(&model.spaces.linear(&piece.op, frame.state, piece.target)?)?;
                // Rows of `onto` are combinations of the echelon rows of the target.
                let leading = family[j].rows.echelon()?.1;
                let map = onto.columns(&leading);
                need(map.times(&family[j].rows)? == onto, "frames", "an operator does not act on the quotients")?;
                if let Some((joined, _)) = spans[k].joined(&spans[j].times(&map.transpose())?)? {
                    (spans[k], grown) = (joined, true);
                }
            }
        }
    }
    let all = family.iter().zip(&spans).all(|(f, span)| span.rows == f.rows.rows);
    need(all, "frames", "the tangent lines are not seen to span the quotients")
}
