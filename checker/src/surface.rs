//! Certificates of the tangent planes of a surface (kind `surface`, docs/certificate.md, section 8.1).

mod apart;
mod branch;
mod chart;
mod cones;
mod derivative;
mod faces;
mod glue;
mod product;

use crate::base::{Accepted, Checked, Matrix, Node, Verdict, need, together};
use crate::claim::{Claim, Decided};
use crate::curve::{Address, Model, Root, case, injective, read_address};
use branch::{Bounds, independent};
use chart::Chart;
use product::Product;

/// A question of the case.
#[derive(PartialEq)]
enum Question {
    /// A claim, and the points it is about, by their numbers.
    Points(Claim, Vec<usize>),
    /// The dense set.
    Dense,
}

/// What is asked of a patch with parameters (its vertices, the dense set, the addresses) or of single branches, and the points
/// that are asked about, each with the addresses of the cells around it.
fn questions(
    model: &Model<'_>,
    chart: Option<&Chart>,
    addresses: Vec<Address>,
) -> Checked<(Vec<Question>, Vec<Vec<Address>>)> {
    let (start, mut asked, mut points) = (model.shape.start, Vec::new(), Vec::new());
    let mut number = |addresses: Vec<Address>| -> usize {
        let known = points.iter().position(|p| *p == addresses);
        match known {
            Some(known) => known,
            None => {
                points.push(addresses);
                points.len() - 1
            }
        }
    };
    if let Some(chart) = chart {
        let vertices = chart.vertices()?;
        let vertices = vertices.iter().map(|v| Ok(number(chart.addresses(start, v)?))).collect::<Checked<_>>()?;
        asked.extend([Question::Points(Claim::PlaneAtVertices, vertices), Question::Dense]);
        for address in addresses {
            let around = number(chart.addresses(start, &chart.locate(start, &address)?)?);
            asked.push(Question::Points(Claim::PlaneAt(address), vec![around]));
        }
        return Ok((asked, points));
    }
    let pieces = model.shape.states[start].pieces.iter().enumerate().filter(|(_, p)| p.target == start);
    let own = pieces.map(|(i, _)| Address { prefix: Vec::new(), cycle: vec![i] });
    for address in own.chain(addresses) {
        let branch = number(vec![address.clone()]);
        let question = Question::Points(Claim::PlaneOfBranch(address), vec![branch]);
        if !asked.contains(&question) {
            asked.push(question);
        }
    }
    Ok((asked, points))
}

/// Checks the proof of a certificate of the kind `surface`.
pub fn check(source: &str, node: &Node<'_>) -> Checked<Accepted> {
    let case = case::read(source, false)?;
    let every = node.get("every");
    let [contraction, product, further, points, dense] = match &every {
        None => {
            let [contraction, product, further, points, dense, _] =
                node.fields("contraction product further points dense answers")?;
            [contraction, product, further, points, dense]
        }
        Some(_) => {
            let [contraction, product, further, points, dense, _, _] =
                node.fields("contraction product further points dense every answers")?;
            [contraction, product, further, points, dense]
        }
    };
    let answers = node.field("answers")?;
    let shape = &case.shape;
    let model =
        if contraction.is_null() { Model::unenclosed(shape, &())? } else { Model::read(shape, &(), &contraction)? };
    let faces = Chart::read(source, shape)?;
    let chart = faces.as_ref().filter(|c| c.is_patch());
    let factors = if product.is_null() { Vec::new() } else { product.fields::<2>("first second")?.into() };
    let curves = factors.iter().map(product::curve).collect::<Checked<Vec<_>>>()?;
    let read = |chart| Product::read(shape, chart, &curves, &factors);
    let (cover, flat) = (!contraction.is_null(), curves.is_empty());
    let product = chart.filter(|_| !flat).map(read).transpose()?;
    let known = product.is_some() || (cover && flat);
    contraction.need(known, "contraction", "a reason is needed, or a patch with parameters that is a product")?;
    let surface = Surface { model: &model, product, cover };
    let mut addresses: Vec<Address> = Vec::new();
    for address in &case.examine {
        addresses.extend((!addresses.contains(address)).then(|| address.clone()));
    }
    for item in further.list()? {
        let address = read_address(&item)?;
        let new = address.normalise(shape, shape.start).as_ref() == Some(&address) && !addresses.contains(&address);
        item.need(new, "answers", "the address is not in its normal form, or was asked for before")?;
        addresses.push(address);
    }
    let (asked, places) = questions(&model, chart, addresses)?;
    let root = Root { state: shape.start, view: shape.view.clone() };
    let mut found_at: Vec<Decided> = Vec::new();
    for (item, place) in points.exactly(places.len(), "points")?.iter().zip(&places) {
        let check = || Ok(surface.point(&root, Some(place), item)?.1);
        let verdict = if item.is_null() { Verdict::Undetermined } else { check()? };
        found_at.push(Claim::PlaneOfCells(place.clone()).is(verdict));
    }
    dense.need(chart.is_some() || dense.is_null(), "dense", "a shape without parameters has no vertices inside")?;
    let every = every.map(|every| surface.every(&root, faces.as_ref(), &found_at, &every)).transpose()?;
    let planes = every == Some(Verdict::Proved);
    let mut found: Vec<Decided> = Vec::new();
    for (item, question) in answers.exactly(asked.len(), "answers")?.iter().zip(asked) {
        let decided = match (question, chart) {
            (Question::Points(claim, numbers), _) => claim.is(together(numbers.iter().map(|&k| found_at[k].verdict))),
            (Question::Dense, Some(chart)) => surface.dense_set(chart, &dense, planes)?,
            (Question::Dense, None) => {
                return item.reject("dense", "a shape without parameters has no vertices inside");
            }
        };
        item.follows("answers", decided.verdict.word())?;
        found.push(decided);
    }
    let verdict = together(found.iter().map(|d| d.verdict));
    found.extend(every.map(|verdict| Claim::PlaneTurns.is(verdict)));
    Ok(Accepted { case: case.name, verdict, claims: found, points: found_at })
}

/// A case with what is known of it.
struct Surface<'a> {
    model: &'a Model<'a>,
    product: Option<Product<'a>>,
    /// Whether the attractors are enclosed, so that there may be covers.
    cover: bool,
}

impl Surface<'_> {
    /// Checks a point, whose addresses may be known, and says what they are.
    fn point(&self, root: &Root, place: Option<&[Address]>, node: &Node<'_>) -> Checked<(Vec<Address>, Verdict)> {
        let [listed, rule, tangent, branches] = node.fields("addresses rule tangent branches")?;
        let addresses = listed.each(read_address)?;
        let known = place.is_none_or(|place| *place == addresses) && !addresses.is_empty();
        listed.need(known, "point", "these are not the addresses of the point")?;
        let model = self.model;
        if let ("product", Some(product)) = (rule.text()?, &self.product) {
            let basis = &model.spaces.of(root.state)?.basis;
            let seen = root.view.times(basis)?.rank()? == basis.cols && tangent.is_null();
            tangent.need(seen, "product", "the view must be injective, and no plane is given")?;
            let verdict = product.verdict(&addresses[0], &branches)?;
            return Ok((addresses, verdict));
        }
        rule.need(self.cover, "contraction", "without contraction only a product has points")?;
        let items = branches.exactly(addresses.len(), "point")?;
        let (mut found, mut position): (Vec<Option<Bounds>>, Option<Matrix>) = (Vec::new(), None);
        for (item, address) in items.iter().zip(&addresses) {
            let here = root.view.times(&model.shape.point(root.state, address)?)?;
            let same = *position.get_or_insert_with(|| here.clone()) == here;
            item.need(same, "point", "the cells around the point do not meet there")?;
            let check = || branch::check(model, root, address, item);
            found.push(if item.is_null() { None } else { Some(check()?) });
        }
        let verdict = conclude(rule.text()?, &tangent, root.view.rows, &found)?;
        Ok((addresses, verdict))
    }

    /// Whether the surface is G¹: a point without a tangent plane, or the curves of a product.
    fn every(&self, root: &Root, chart: Option<&Chart>, points: &[Decided], node: &Node<'_>) -> Checked<Verdict> {
        let chart = node.some(chart, "every", "a patch with parameters is needed")?;
        let by = node.tag("by")?;
        node.need(chart.is_patch() || by == "cones", "every", "the start is no patch")?;
        let found = match by {
            "derivative" => {
                node.need(self.cover, "contraction", "without contraction only a product has an answer")?;
                derivative::check(self.model, chart, node)?;
                Verdict::Proved
            }
            "cones" => {
                node.need(self.cover, "contraction", "without contraction only a product has an answer")?;
                cones::check(self.model, chart, node)?;
                Verdict::Proved
            }
            "point" => {
                let [_, _, point] = node.fields("by verdict point")?;
                let broken = points[point.index(points.len())?].verdict == Verdict::Refuted;
                point.need(broken, "every", "the point has a tangent plane like any other")?;
                Verdict::Refuted
            }
            "product" => {
                let [_, _, curves] = node.fields("by verdict curves")?;
                let product = curves.some(self.product.as_ref(), "every", "the patch is no product")?;
                let basis = &self.model.spaces.of(root.state)?.basis;
                let seen = root.view.times(basis)?.rank()? == basis.cols;
                curves.need(seen, "every", "the view must be injective")?;
                product.every(&curves)?
            }
            _ => return node.reject("every", "a point, a product, a derivative or cones are needed"),
        };
        let decided = found != Verdict::Undetermined;
        node.need(decided, "every", "this decides nothing")?;
        node.field("verdict")?.follows("every", found.word())?;
        Ok(found)
    }

    /// Theorem 5″: a vertex inside every face that is reached, in the visible quotient of that face. Planes at every point are planes at a
    /// dense set.
    fn dense_set(&self, chart: &Chart, node: &Node<'_>, planes: bool) -> Checked<Decided> {
        let model = self.model;
        if node.is_null() {
            let verdict = if planes { Verdict::Proved } else { Verdict::Undetermined };
            return Ok(Claim::PlaneDense { projected: false }.is(verdict));
        }
        for (e, item) in model.for_states(node, "dense")? {
            let space = model.spaces.of(e)?;
            let (addresses, verdict) =
                self.point(&Root { state: e, view: space.visible.times(&space.reading)? }, None, &item)?;
            let parameter = chart.locate(e, &addresses[0])?;
            let all = chart.is_inside(&parameter) && chart.addresses(e, &parameter)? == addresses;
            item.need(all, "dense", "these are not all addresses of a point inside the face")?;
            item.need(verdict == Verdict::Proved, "dense", "the face has no tangent plane there")?;
        }
        Ok(Claim::PlaneDense { projected: !injective(model, "dense")? }.is(Verdict::Proved))
    }
}

/// The conclusions: the tangent subspace, the sum of those of all branches, has more than two dimensions (`space`), exactly two
/// (`plane`), or less (`line`).
fn conclude(rule: &str, tangent: &Node<'_>, width: usize, found: &[Option<Bounds>]) -> Checked<Verdict> {
    let contains: Vec<_> = found.iter().flatten().flat_map(|b| &b.contains).collect();
    if rule == "space" {
        let more = tangent.is_null() && independent(&contains, 3)?;
        tangent.need(more, "space", "the directions are not seen to span more than a plane")?;
        return Ok(Verdict::Refuted);
    }
    let bounds: Vec<&Bounds> = found.iter().flatten().collect();
    need(bounds.len() == found.len(), "point", "every branch needs a certificate here")?;
    let dimension = if tangent.is_null() {
        tangent.need(bounds.len() == 1, "tangent", "the space that the branches have in common is needed")?;
        bounds[0].dimension
    } else {
        let space = tangent.matrix(width)?;
        tangent.need(space.echelon()?.0 == space, "tangent", "a basis in reduced echelon form is needed")?;
        for vector in bounds.iter().flat_map(|b| &b.within) {
            let holds = space.joined(&vector.transpose())?.is_none();
            tangent.need(holds, "tangent", "the tangent subspace of a branch does not lie in this space")?;
        }
        space.rows
    };
    let plane = dimension == 2 && independent(&contains, 2)?;
    tangent.need(
        if rule == "plane" { plane } else { dimension < 2 && rule == "line" },
        "tangent",
        "the rule is another",
    )?;
    Ok(if plane { Verdict::Proved } else { Verdict::Refuted })
}
