//! What was proved, as the page shows it, and the files that can be downloaded.

use super::drawing::place;
use super::input::Asked;
use crate::answer::Verdict;
use crate::arith::to_f64;
use crate::ask::{Answered, Checked, answered};
use crate::budget::{Budget, Effort};
use crate::case::Case;
use crate::diagnostic::Problem;
use crate::mesh::{Found, Model, Scheme, certify};
use crate::picture::{MarkStyle, Projection, mesh as mesh_picture};
use crate::prove::Findings;
use crate::report::document::Document;
use crate::report::math::Math;
use crate::report::reported::Reported;
use crate::report::text::{math_line, plain};
use crate::report::{claims, figures, findings, html, mesh as mesh_report, proof, summary, surface, words};
use crate::shape::Shape;
use crate::theorem::surface::SurfacePoint;
use crate::theorem::{Certified, Claim, PointReport, Required};
use serde_json::{Value, json};

/// How much is spent on an answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Spend {
    /// So little that the answer follows the pointer: tangents, and hardly a search.
    First,
    /// A part of a second: what the page shows while something is dragged.
    Quick,
    /// The budget of an effort.
    Whole(Effort),
}

impl Spend {
    /// The spending that a word of the page names.
    pub fn named(word: &str) -> Option<Self> {
        match word {
            "first" => Some(Self::First),
            "quick" => Some(Self::Quick),
            "normal" => Some(Self::Whole(Effort::Normal)),
            "hard" => Some(Self::Whole(Effort::Hard)),
            _ => None,
        }
    }

    fn word(self) -> &'static str {
        match self {
            Self::First => "first",
            Self::Quick => "quick",
            Self::Whole(effort) => effort.word(),
        }
    }

    /// The limits: steps of the search for cones, and work for each order of smoothness.
    fn budget(self) -> Budget {
        let (effort, limits) = match self {
            Self::First => (Effort::Quick, Some((6_000, 20_000))),
            Self::Quick => (Effort::Quick, Some((600_000, 1_000_000))),
            Self::Whole(effort) => (effort, None),
        };
        let mut budget = Budget::of(effort);
        if let Some((steps, order)) = limits {
            budget.cone_steps = steps;
            budget.orders.work = Some(order);
        }
        budget
    }
}

/// Something that was asked, with the answer.
pub struct Kept {
    asked: Asked,
    spend: Spend,
    found: What,
}

enum What {
    Case(Box<Answered>),
    Mesh(Box<Found>),
}

/// A file: its type, the name under which it is saved, and its content.
pub struct File {
    pub mime: &'static str,
    pub name: String,
    pub content: String,
}

impl Kept {
    /// Proves, and has the verdicts proved again by the checker if `check` says so.
    ///
    /// # Errors
    /// The [`Problem`] of the model, or of a certificate that the checker does not accept.
    pub fn prove(asked: Asked, spend: Spend, check: bool) -> Result<Self, Problem> {
        let budget = spend.budget();
        let found = match &asked {
            Asked::Case(question) => What::Case(Box::new(answered(question, check, &budget, &|| {})?)),
            Asked::Mesh { model, scheme, .. } => What::Mesh(Box::new(certify(model, *scheme, &budget, &|| {})?)),
        };
        Ok(Self { asked, spend, found })
    }

    /// The answer as the page shows it.
    pub fn value(&self) -> Value {
        let mut value = match (&self.asked, &self.found) {
            (Asked::Mesh { model, scheme, .. }, What::Mesh(found)) => mesh(model, *scheme, found),
            (_, What::Case(answered)) => match &answered.findings {
                Findings::Tangents { case, found } => tangents(case, found, answered),
                Findings::OverField { case, found } => tangents(case, found, answered),
                Findings::Vertices { .. } => vertices(answered),
            },
            (Asked::Case(_), What::Mesh(_)) => unreachable!("a mesh is found of a mesh only"),
        };
        value["effort"] = self.spend.word().into();
        value
    }

    /// A file of the answer; `None` where there is no such file.
    ///
    /// # Errors
    /// The [`Problem`] of what cannot be written: a certificate that the format has no rules for, a picture of nothing.
    pub fn file(&self, name: &str) -> Result<Option<File>, Problem> {
        let file = |mime, ending: &str, content| {
            let stem = match &self.asked {
                Asked::Case(question) => question.name().replace(|c: char| !c.is_ascii_alphanumeric(), "-"),
                Asked::Mesh { .. } => "mesh".to_owned(),
            };
            Ok(Some(File { mime, name: format!("{stem}{ending}"), content }))
        };
        match name {
            "case" => {
                let text = self.asked.text();
                let ending = match &self.asked {
                    Asked::Case(_) => ".toml",
                    Asked::Mesh { .. } if text.name.ends_with(".off") => ".off",
                    Asked::Mesh { .. } => ".obj",
                };
                file("text/plain; charset=utf-8", ending, text.text.to_string())
            }
            "report" => file("text/html; charset=utf-8", ".html", html::render(&self.report())),
            "picture" => file("image/svg+xml", ".svg", self.picture()?),
            "data" => file("application/json", ".json", format!("{:#}\n", self.data())),
            "certificate" | "expanded" => match &self.found {
                What::Case(answered) if name == "certificate" => {
                    file("application/json", "-certificate.json", answered.certificate()?.text())
                }
                What::Case(answered) => match beside(answered) {
                    Some(text) => file("text/plain; charset=utf-8", "-expanded.toml", text),
                    None => Ok(None),
                },
                What::Mesh(_) => Ok(None),
            },
            _ => match name.strip_prefix("point-").and_then(|number| number.parse().ok()) {
                Some(number) => match self.point(number) {
                    Some(document) => file("text/html; charset=utf-8", "-point.html", html::render(&document)),
                    None => Ok(None),
                },
                None => Ok(None),
            },
        }
    }

    fn report(&self) -> Document {
        match (&self.asked, &self.found) {
            (Asked::Mesh { model, scheme, .. }, What::Mesh(found)) => {
                mesh_report::document(model, scheme.name(), found, None, true)
            }
            (_, What::Case(answered)) => findings::proof(&answered.findings),
            (Asked::Case(_), What::Mesh(_)) => unreachable!("a mesh is found of a mesh only"),
        }
    }

    fn data(&self) -> Value {
        match (&self.asked, &self.found) {
            (Asked::Mesh { model, scheme, .. }, What::Mesh(found)) => {
                mesh_report::json(model, scheme.name(), found, None)
            }
            (_, What::Case(answered)) => answered.json(&Required::default(), false),
            (Asked::Case(_), What::Mesh(_)) => unreachable!("a mesh is found of a mesh only"),
        }
    }

    fn picture(&self) -> Result<String, Problem> {
        match (&self.asked, &self.found) {
            (Asked::Mesh { model, .. }, What::Mesh(found)) => mesh_picture::svg(model, found, &model.name)
                .ok_or_else(|| Problem::new("secant::picture", "the mesh is too large to be drawn")),
            (_, What::Case(answered)) => answered.picture(false),
            (Asked::Case(_), What::Mesh(_)) => unreachable!("a mesh is found of a mesh only"),
        }
    }

    /// The proof of one point.
    fn point(&self, number: usize) -> Option<Document> {
        match &self.found {
            What::Case(answered) => match &answered.findings {
                Findings::Tangents { case, found } => proof::point_document(case, found, number),
                Findings::OverField { case, found } => proof::point_document(case, found, number),
                Findings::Vertices { .. } => None,
            },
            What::Mesh(_) => None,
        }
    }
}

/// The case in which every operator is written out, where the checker reads that instead of the text.
fn beside(answered: &Answered) -> Option<String> {
    match &answered.findings {
        Findings::Tangents { case, .. } => case.beside(),
        Findings::OverField { case, .. } => case.flat.clone(),
        Findings::Vertices { .. } => None,
    }
}

fn claim(claim: &Claim, reason: Option<String>) -> Value {
    json!({
        "about": claims::label(&claim.what),
        "verdict": claim.verdict().word(),
        "text": claims::judged(claim),
        "reason": reason,
        "theorem": claim.statement().map(|s| s.name()),
    })
}

/// Whether the checker proved it again, and whether there are files of that.
fn checked(answered: &Answered, value: &mut Value) {
    let word = match answered.checked() {
        Checked::Yes => "yes",
        Checked::Part => "part",
        Checked::NoRule => "no-rule",
        Checked::NotAsked => "not-asked",
    };
    value["checked"] = word.into();
    value["certificate"] = matches!(answered.evidence, Some(Ok(_))).into();
    value["expanded"] = beside(answered).is_some().into();
}

fn tangents<E: Reported>(case: &Case<E>, found: &Certified<E>, answered: &Answered) -> Value {
    let required = Required::default();
    let data = findings::json(&answered.findings, &required, false);
    let drawn = E::drawn(&case.shape);
    let points: Vec<Value> = match &found.surface {
        Some(surface) => surface.points.iter().map(|p| on_surface(&drawn, p)).collect(),
        None => {
            let projection = Projection::of(&drawn);
            found.points.iter().map(|p| point(case, &projection, p)).collect()
        }
    };
    let exact = |k: usize| data["points"][k]["tangent"].clone();
    let points = points.into_iter().enumerate().map(|(k, mut point)| {
        if found.surface.is_none() {
            point["tangent"] = exact(k);
        }
        point
    });
    let mut value = json!({
        "verdict": required.verdict(&found.claims).word(),
        "overall": plain(&summary::overall_line(case, found, &required)),
        "claims": found.claims.iter().map(|c| claim(c, claims::reason(case, found, c))).collect::<Vec<_>>(),
        "limits": found.limits().iter().map(claims::limit).collect::<Vec<_>>(),
        "points": points.collect::<Vec<_>>(),
    });
    checked(answered, &mut value);
    value
}

fn style(style: MarkStyle) -> &'static str {
    match style {
        MarkStyle::Tangent => "tangent",
        MarkStyle::Cusp => "cusp",
        MarkStyle::Corner => "corner",
        MarkStyle::Refuted => "none",
        MarkStyle::Undecided => "undetermined",
    }
}

fn point<E: Reported>(case: &Case<E>, projection: &Projection, point: &PointReport<E>) -> Value {
    let mark = figures::mark(point);
    let parameter = point.branches.first().and_then(|b| proof::parameter(&case.shape, &b.address));
    json!({
        "name": words::point_name(&case.shape, point),
        "address": words::addresses(point).join(" = "),
        "parameter": parameter.map(|t| t.to_string()),
        "verdict": point.verdict.word(),
        "kind": point.kind.word(),
        "style": style(mark.style),
        "at": projection.point(&mark.at),
        "rays": mark.rays.iter().map(|ray| projection.direction(ray)).collect::<Vec<_>>(),
    })
}

fn on_surface(shape: &Shape, point: &SurfacePoint) -> Value {
    let image = point.image.as_ref().unwrap_or(&point.position);
    let at: Vec<f64> = image.iter().map(to_f64).collect();
    let plane = point.tangent.as_ref().map(|space| {
        let generators = space.to_f64();
        generators.iter().map(|v| place(shape, v)).collect::<Vec<_>>()
    });
    let (kind, style) = match point.verdict {
        Verdict::Proved => ("tangent plane", "tangent"),
        Verdict::Refuted => ("no tangent plane", "none"),
        Verdict::Undetermined => ("undetermined", "undetermined"),
    };
    json!({
        "name": surface::point_name(point),
        "address": point.branches.first().map(|b| b.address.to_string()),
        "parameter": point.parameter.as_ref().map(|t| math_line(&Math::vector(t))),
        "verdict": point.verdict.word(),
        "kind": kind,
        "style": style,
        "at": place(shape, &at),
        "plane": plane,
        "tangent": point.tangent.as_ref().map(|space| json!({ "text": plain(&surface::span(space)) })),
    })
}

fn vertices(answered: &Answered) -> Value {
    let findings = &answered.findings;
    let Findings::Vertices { found, .. } = findings else { unreachable!("findings at vertices") };
    let all = findings.claims();
    let mut value = json!({
        "verdict": findings.verdict().word(),
        "claims": all.iter().map(|c| claim(c, claims::reason_at_vertices(found, c))).collect::<Vec<_>>(),
        "limits": [],
        "points": [],
    });
    checked(answered, &mut value);
    value
}

fn mesh(model: &Model, scheme: Scheme, found: &Found) -> Value {
    let data = mesh_report::json(model, scheme.name(), found, None);
    let whole = |about: &str, verdict: Verdict, text: &str| json!({ "about": about, "verdict": verdict.word(), "text": text, "reason": null, "theorem": null });
    let points = found.vertices.iter().map(|v| {
        let limit = v.limit.as_ref();
        let verdict = if v.smooth == Verdict::Proved && !v.surrounded() { Verdict::Undetermined } else { v.smooth };
        let (kind, style) = match verdict {
            Verdict::Proved => ("C¹", "tangent"),
            Verdict::Refuted => ("not C¹", "none"),
            Verdict::Undetermined => ("undetermined", "undetermined"),
        };
        let decimals = |n: [f64; 3]| n.map(|x| format!("{x:.4}")).join(", ");
        json!({
            "name": mesh_report::place(v),
            "address": format!("line {}", v.line),
            "parameter": mesh_report::kind(v.kind),
            "verdict": verdict.word(),
            "kind": kind,
            "note": mesh_report::reason(v),
            "style": style,
            "at": limit.map(|l| l.near.map(crate::mesh::Float::mid)),
            "normal": limit.and_then(|l| l.unit),
            "tangent": limit.and_then(|l| l.unit).map(|n| json!({ "text": format!("normal ≈ ({})", decimals(n)) })),
        })
    });
    let [vertices, surface] = mesh_report::claim_words(found);
    json!({
        "verdict": found.regular().word(),
        "claims": [whole("vertices", found.smooth(), vertices), whole("surface", found.regular(), surface)],
        "bad": data["patches"]["bad"],
        "limits": [],
        "points": points.take(MOST_VERTICES).collect::<Vec<_>>(),
        "left_out": found.vertices.len().saturating_sub(MOST_VERTICES),
        "checked": "no-rule",
        "certificate": false,
        "expanded": false,
    })
}

/// Vertices of a mesh that the page lists.
const MOST_VERTICES: usize = 200;
