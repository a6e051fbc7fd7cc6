//! Certificates of the tangent planes of a surface (kind `surface`, section 8.1 of the format).

use super::top::{elements, mirrored, top};
use super::{Certificate, Unsupported, address_json, branch, contraction, number, numbers, tree, unsupported};
use crate::answer::Answer;
use crate::arith::Rational;
use crate::case::Case;
use crate::jordan::{Eigenvalue, Spectrum};
use crate::linalg::Matrix;
use crate::shape::{Address, Contraction, Shape};
use crate::theorem::surface::{
    EverySurfaceBreak, EverySurfaceProof, ProductFactor, Rank, Spot, Surface, SurfaceBranch, SurfaceForms,
    SurfacePoint, SurfaceWitness,
};
use crate::theorem::{Assertion, Certified, Direction, Functional, PointReport, RingProof, Statement, Verdict};
use serde_json::{Value, json};

/// Letters by which the addresses of a point are told apart and put in order.
const LETTERS: usize = 4_000;

/// The certificate of what was found for a surface.
///
/// # Errors
/// [`Unsupported`] where the evidence for a decided claim has no rule in the format.
pub fn surface(case: &Case, found: &Certified, surface: &Surface) -> Result<Certificate, Unsupported> {
    let shape = &case.shape;
    let radii = found.states.iter().map(|r| (r.state, &r.radius));
    let by_product = matches!(found.contraction, Contraction::Product(_));
    let mut states = match by_product {
        true => Value::Null,
        false => contraction(
            shape,
            &found.contraction,
            radii,
            found.polygons.as_deref().map(|p| (p, found.polygon_weights.as_ref())),
        )?,
    };
    let injective = surface.dense.as_ref().is_some_and(|d| d.view_injective);
    let mut product = Product {
        factors: surface.factors.as_ref(),
        always: by_product,
        injective: injective && found.states.iter().all(|s| s.visible == s.relevant),
        needed: false,
        points: Default::default(),
    };
    if surface.simplex && !by_product {
        if found.polygons.is_some() {
            return unsupported("two kinds of enclosures", "contraction");
        }
        let Some(list) = states.as_array_mut() else { return unsupported("a system without states", "contraction") };
        list.iter_mut().for_each(|state| state["hull"] = json!("simplex"));
    }
    let parameters = surface.points.first().is_some_and(|p| p.parameter.is_some());
    if surface.points.iter().any(|p| parameters && p.spot == Spot::Branch) {
        return unsupported("a point with too many cells around it", "points");
    }
    let mut points = Vec::new();
    for p in &surface.points {
        points.push(if p.verdict == Verdict::Undetermined { Value::Null } else { point(shape, p, &mut product)? });
    }
    let mut dense = Value::Null;
    let (mut asked, mut answers): (Vec<&Address>, Vec<&str>) = (Vec::new(), Vec::new());
    for claim in &found.claims {
        if claim.what == Assertion::PlaneEverywhere {
            continue;
        }
        if let Some((address, _)) = claim.what.asked() {
            if asked.contains(&address) {
                continue;
            }
            asked.push(address);
        } else if claim.statement() == Some(Statement::PatchDerivative) {
            // Planes at every point are planes at a dense set.
            every_point(surface, &mut product)?;
        } else if matches!(claim.what, Assertion::DensePlanes { .. }) && claim.verdict() == Verdict::Proved {
            let vertices = surface.dense.iter().flat_map(|d| &d.vertices);
            dense = vertices.map(|(_, p)| point(shape, p, &mut product)).collect::<Result<_, _>>()?;
        }
        answers.push(claim.verdict().word());
    }
    if parameters && surface.dense.is_none() {
        return unsupported("a patch without vertices inside", "dense");
    }
    let own = case.examine.iter().map(|a| match a.normalise(shape, shape.start) {
        Ok(address) => Ok(address),
        Err(error) => unsupported(error.to_string(), "examine"),
    });
    let own: Vec<Address> = own.collect::<Result<_, _>>()?;
    let pieces = &shape.states[shape.start].pieces;
    let fixed = |a: &Address| {
        !parameters && a.prefix.is_empty() && a.cycle.len() == 1 && pieces[a.cycle[0]].target == shape.start
    };
    let further = asked.iter().filter(|a| !own.contains(a) && !fixed(a));
    let further: Vec<Value> = further.map(|a| address_json(a)).collect();
    let (every, left_out) = match every_point(surface, &mut product) {
        Ok(every) => (every, None),
        Err(why) => (None, Some(why)),
    };
    let product = product.json()?;
    let proof = match every {
        None => {
            json!({"contraction": states, "product": product, "further": further, "points": points, "dense": dense,
                   "answers": answers})
        }
        Some(every) => {
            json!({"contraction": states, "product": product, "further": further, "points": points, "dense": dense,
                   "every": every, "answers": answers})
        }
    };
    Ok(Certificate::new("surface", &case.name, found.verdict.word(), proof).without(left_out))
}

/// The answer about every point, which is no question of the case, so that the certificate of the others stands without it.
fn every_point(surface: &Surface, product: &mut Product) -> Result<Option<Value>, Unsupported> {
    Ok(Some(match &surface.every {
        Answer::Open(_) => return Ok(None),
        Answer::Refuted(EverySurfaceBreak::Point(index)) => {
            json!({"by": "point", "verdict": "refuted", "point": index})
        }
        Answer::Proved(EverySurfaceProof::Product(curves)) => {
            json!({"by": "product", "verdict": "proved", "curves": product.every([Some(&curves[0]), Some(&curves[1])])?})
        }
        Answer::Proved(EverySurfaceProof::Derivative(found)) => {
            let radius = super::regularity::radius(found.system.as_ref(), found.radius.as_ref(), "every point")?;
            let (length, cells) = match &found.cells {
                Some((length, cells)) => (json!(length), json!(cells)),
                None => (Value::Null, Value::Null),
            };
            json!({"by": "derivative", "verdict": "proved", "radius": radius, "length": length, "cells": cells})
        }
        Answer::Proved(EverySurfaceProof::Forms(_)) if product.always => {
            return unsupported("cones around planes where only a product contracts", "every point");
        }
        Answer::Proved(EverySurfaceProof::Forms(found)) => cones(found),
        Answer::Proved(EverySurfaceProof::Vertex { .. }) => {
            return unsupported("Theorem 7 beside a patch complex", "every point");
        }
        Answer::Refuted(EverySurfaceBreak::Curve { curves, curve, .. }) => {
            let of = |k: usize| (k == *curve).then(|| &curves[k]);
            json!({"by": "product", "verdict": "refuted", "curves": product.every([of(0), of(1)])?})
        }
    }))
}

/// Stars with their children, forms (upper triangles, row after row) and ratios.
fn cones(found: &SurfaceForms) -> Value {
    let star = |s: usize| {
        let cells = found.stars.list[s].cells.iter();
        let cells: Value = cells.map(|(face, corners)| json!({"face": face, "corners": corners})).collect();
        let children = found.stars.children[s].iter().enumerate();
        let children: Value = children
            .map(|(k, child)| {
                let ratio = found.ratios[s].get(k).map_or(Value::Null, number);
                json!({"star": child.star, "cells": child.cells, "ratio": ratio})
            })
            .collect();
        let q = &found.forms[s];
        let form: Value = (0..q.rows()).map(|i| numbers(&q.row(i)[i..])).collect();
        json!({"cells": cells, "form": form, "children": children})
    };
    let stars: Value = (0..found.stars.list.len()).map(star).collect();
    json!({"by": "cones", "verdict": "proved", "stars": stars})
}

fn name(b: &SurfaceBranch) -> String {
    format!("branch {}", b.address)
}

/// The curves of a tensor product, with the points of them that are needed.
struct Product<'a> {
    factors: Option<&'a [ProductFactor; 2]>,
    /// Whether all points are proved by it.
    always: bool,
    /// Whether the surface is seen through a map that is injective on its relevant space.
    injective: bool,
    /// Whether the curves are needed for the answer about every point.
    needed: bool,
    /// Places and certificates of points of each.
    points: [Vec<(Value, Value)>; 2],
}

impl Product<'_> {
    /// The indices of the points of the curves that decide a point of the surface.
    fn add(&mut self, p: &SurfacePoint) -> Result<[usize; 2], Unsupported> {
        let at = || name(&p.branches[0]);
        let (Some(evidence), Some(factors)) = (p.product.as_ref(), self.factors) else {
            return unsupported("a point without the theorem on tensor products", at());
        };
        if p.verdict != evidence.verdict || !self.injective {
            return unsupported("a tensor product seen through a map that is not injective", at());
        }
        Ok([self.index(0, &factors[0].shape, &evidence.first)?, self.index(1, &factors[1].shape, &evidence.second)?])
    }

    /// The index of a point of a curve, which is listed where it was not yet.
    fn index(&mut self, k: usize, curve: &Shape, report: &PointReport) -> Result<usize, Unsupported> {
        let (place, known) = (super::place_json(report), &mut self.points[k]);
        if let Some(index) = known.iter().position(|(p, _)| *p == place) {
            return Ok(index);
        }
        known.push((place.clone(), branch::point(curve, report, &place)?));
        Ok(known.len() - 1)
    }

    /// The answers about every point of the curves.
    fn every(&mut self, curves: [Option<&Certified>; 2]) -> Result<Vec<Value>, Unsupported> {
        let Some(factors) = self.factors else { return unsupported("a product without curves", "every point") };
        if !self.injective {
            return unsupported("a tensor product seen through a map that is not injective", "every point");
        }
        let mut answers = Vec::new();
        for (k, curve) in curves.into_iter().enumerate() {
            let (shape, me) = (&factors[k].shape, std::cell::RefCell::new(&mut *self));
            let position = |point: &PointReport| me.borrow_mut().index(k, shape, point);
            answers.push(match curve {
                None => Value::Null,
                Some(found) => match super::everywhere::answer(shape, found, &position)? {
                    Some(answer) => answer,
                    None => return unsupported("a curve of which nothing is decided", "every point"),
                },
            });
        }
        self.needed = true;
        Ok(answers)
    }

    fn json(&self) -> Result<Value, Unsupported> {
        let Some(factors) = self.factors.filter(|_| self.needed || !self.points[0].is_empty()) else {
            return Ok(Value::Null);
        };
        let curve = |k: usize| {
            let ProductFactor { shape, contraction: found, states, polygons } = &factors[k];
            let rows = |m: &Matrix| -> Value { (0..m.rows()).map(|i| numbers(m.row(i))).collect() };
            let operators: Value = shape.states[shape.start].pieces.iter().map(|p| rows(&p.op)).collect();
            let radii = states.iter().map(|(e, radius)| (*e, radius));
            let contraction = contraction(shape, found, radii, polygons.as_deref().map(|p| (p, None)))?;
            let points: Vec<&Value> = self.points[k].iter().map(|(_, point)| point).collect();
            Ok(json!({"operators": operators, "contraction": contraction, "points": points}))
        };
        Ok(json!({"first": curve(0)?, "second": curve(1)?}))
    }
}

/// A decided point.
fn point(shape: &Shape, p: &SurfacePoint, product: &mut Product) -> Result<Value, Unsupported> {
    let mut all: Vec<&SurfaceBranch> = p.branches.iter().collect();
    let letter = |Address { prefix, cycle }: &Address, k: usize| match k.checked_sub(prefix.len()) {
        None => prefix[k],
        Some(k) => cycle[k % cycle.len()],
    };
    all.sort_by_cached_key(|b| (0..LETTERS).map(|k| letter(&b.address, k)).collect::<Vec<_>>());
    let addresses: Vec<Value> = all.iter().map(|b| address_json(&b.address)).collect();
    if p.statement == Some(Statement::TensorProduct) || product.always {
        let indices = product.add(p)?;
        return Ok(json!({"addresses": addresses, "rule": "product", "tangent": null, "branches": indices}));
    }
    let sum = all.iter().fold(crate::theorem::surface::Subspace::default(), |s, b| s.join(&b.outcome.contains));
    let (rule, exact) = match (p.verdict, sum.rank()) {
        (Verdict::Proved, _) => ("plane", true),
        (_, Rank { at_least: 3.., .. }) => ("space", false),
        _ if p.dimension.exact => ("line", true),
        _ => return unsupported("a tangent subspace none of whose vectors is known", name(all[0])),
    };
    let rational: Option<Vec<Vec<Rational>>> = sum.generators.iter().map(Direction::rational).collect();
    let tangent = match rational {
        Some(rows) if exact => {
            let rows = Matrix::from_rows(p.branches[0].view.rows(), rows).echelon().rows;
            (0..rows.rows()).map(|i| numbers(rows.row(i))).collect()
        }
        None if exact && all.len() > 1 => return unsupported("an irrational plane of several branches", name(all[0])),
        _ => Value::Null,
    };
    let mut branches = Vec::new();
    for b in &all {
        branches.push(match certified(shape, b, exact) {
            Err(_) if !exact => Value::Null,
            found => found?,
        });
    }
    Ok(json!({"addresses": addresses, "rule": rule, "tangent": tangent, "branches": branches}))
}

/// The eigenvalue that stands for the top of a spectrum.
fn leading(spectrum: &Spectrum) -> Option<Eigenvalue> {
    let members = &spectrum.classes.first()?.members;
    members.iter().max_by_key(|m| spectrum.factor(**m).blocks[0]).copied()
}

fn certified(shape: &Shape, b: &SurfaceBranch, exact: bool) -> Result<Value, Unsupported> {
    let Some(lead) = leading(&b.spectrum) else { return unsupported("a germ that is a single point", name(b)) };
    let mut orbits = Vec::new();
    if let Some(SurfaceWitness::Points(points)) = &b.outcome.witness {
        for (address, offset) in points {
            let own = branch::orbit_top(&b.linear, offset, &(), &name(b))?;
            orbits.push(json!({"address": address_json(address), "own": own}));
        }
    }
    let bound = match (&b.outcome.ring, &b.outcome.depth) {
        _ if !exact || b.outcome.dimension.at_least == b.view.rank() => Value::Null,
        _ if !b.outcome.dimension.exact => return unsupported("a branch that is not decided", name(b)),
        (Some(proof), _) => by_leading(shape, b, proof, lead)?,
        (None, Some((depth, proof))) => by_group(shape, b, proof, *depth)?,
        _ => return unsupported("this evidence", name(b)),
    };
    Ok(json!({"top": top::<Rational>(&b.linear, &b.spectrum, lead, &name(b))?, "orbits": orbits, "bound": bound}))
}

/// The ring condition of the functionals that read leading coefficients.
fn by_leading(shape: &Shape, b: &SurfaceBranch, proof: &RingProof, lead: Eigenvalue) -> Result<Value, Unsupported> {
    let root = b.spectrum.root(lead);
    let imaginary = |f: &Functional| f.part == crate::theorem::Part::Imaginary;
    let place = |f: &Functional| f.root.clone().unwrap_or_else(|| root.clone());
    // Of a pair the certificate takes the root above the real axis.
    let below = |f: &Functional| imaginary(f) && place(f).enclosure(64).1.hi < 0;
    let mut functionals = Vec::new();
    for f in proof.functionals.iter().filter(|f| !imaginary(f)) {
        let own = place(f);
        functionals.push(elements(&if root.is_real() { mirrored(&f.row, own.same(root)) } else { f.row.clone() }));
    }
    let mut turned = proof.clone();
    for cell in turned.discharged.iter_mut().filter(|c| below(&proof.functionals[c.functional])) {
        cell.sign = -cell.sign;
    }
    Ok(json!({"by": "leading", "functionals": functionals, "cover": tree::cover(shape, &b.ring, &turned, None)?}))
}

/// The ring condition of all functionals of the first groups of eigenvalues, where they are rational.
fn by_group(shape: &Shape, b: &SurfaceBranch, proof: &RingProof, depth: usize) -> Result<Value, Unsupported> {
    let row = |f: &Functional| f.row.iter().map(crate::algebraic::Elem::is_rational).collect::<Option<Vec<_>>>();
    let rows: Option<Vec<Vec<Rational>>> = proof.functionals.iter().map(row).collect();
    let Some(rows) = rows else { return unsupported("irrational functionals of several moduli", name(b)) };
    let space = Matrix::from_rows(b.linear.rows(), rows.clone()).echelon();
    let images = &space.rows * &b.linear;
    let k = space.pivots.len();
    let inner = Spectrum::of(&Matrix::from_fn(k, k, |i, j| images[(i, space.pivots[j])].clone()));
    let Some(radius) = super::radius::below::<Rational>(&b.spectrum, depth, inner.char_poly.coeffs()) else {
        return unsupported("moduli this close", name(b));
    };
    let rows: Value = rows.iter().map(|r| numbers(r)).collect();
    let cover = tree::cover(shape, &b.ring, proof, None)?;
    Ok(json!({"by": "group", "radius": number(&radius), "rows": rows, "cover": cover}))
}
