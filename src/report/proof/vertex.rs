//! The proof-style report on extraordinary vertices: the claim, the scheme, the words that are used, the statements, and the
//! evidence for every valence.

use super::super::document::{Block, Document, Inline, Line, Table, Tone, code, formula, line, words};
use super::super::math::Math;
use super::super::radius::interval;
use super::super::values::{decimal_math, outward};
use super::super::vertex::{at, functional, places, summary_by_valence, twice};
use super::super::words::{count, mark, short_bound};
use super::evidence::Evidence;
use super::{Quoted, references};
use crate::arith::Rational;
use crate::case::VertexCase;
use crate::scheme::mesh_rules;
use crate::statement::Statement;
use crate::theorem::Verdict;
use crate::vertex::regular::Regular;
use crate::vertex::{AtValence, BorderGround, Eigenvector, Every, Ground, Size, VertexReason, overall};

/// The whole proof for the valences examined, and for all valences where they were asked for, as a document.
#[must_use]
pub fn vertex_document(case: &VertexCase, found: &[AtValence], every: Option<&Every>) -> Document {
    let mut seen = Quoted::default();
    let mut blocks = statement(case, found, every);
    blocks.push(Block::heading(2, "Summary"));
    blocks.extend(summary_by_valence(case, found, every));
    blocks.extend(certificate(case, found));
    let first_page = blocks.len();
    blocks.extend(scheme(case));
    blocks.extend(definitions(case.border.is_some()));
    blocks.extend(statements(case, found, every, &mut seen));
    for f in found {
        blocks.extend(at(case, f));
        blocks.extend(evidence(case, f));
    }
    blocks.extend(references(&seen));
    let mut document = Document { title: case.title.clone(), blocks };
    document.insert_contents(first_page);
    document
}

/// The statements in full, and the ticks of those that are not about one valence.
fn statements(case: &VertexCase, found: &[AtValence], every: Option<&Every>, seen: &mut Quoted) -> Vec<Block> {
    let listed = cited(case, found, every);
    if listed.is_empty() {
        return Vec::new();
    }
    let mut blocks = vec![Block::heading(2, "The statements")];
    blocks.extend(listed.iter().filter_map(|s| seen.once_id(*s)));
    if listed.contains(&Statement::Lemma4) {
        blocks.push(named(Statement::Lemma4));
        blocks.push(lemma_4(case, Evidence::of(Statement::Lemma4)).block());
    }
    if listed.contains(&Statement::Lemma4Prime) {
        blocks.push(named(Statement::Lemma4Prime));
        let factors = "$N=2$, and the mask was divided by $(1+z^u)(1+z^v)$ for all pairs of directions without a rest.";
        let inside = "checked for every second difference in every part of the cell.";
        let evidence = Evidence::of(Statement::Lemma4Prime).holds("factors", factors, []);
        blocks.push(evidence.holds("inside", inside, []).block());
    }
    if every.is_some_and(Every::proved) {
        let scheme = format!("it is {}; the conditions of the proof are computed again in the summary.", case.scheme);
        blocks.push(named(Statement::Theorem9));
        blocks.push(Evidence::of(Statement::Theorem9).holds("scheme", &scheme, []).block());
    }
    blocks
}

fn certificate(case: &VertexCase, found: &[AtValence]) -> Vec<Block> {
    let mut facts =
        vec![("case file, SHA-256".to_owned(), code(crate::certificate::sha256(case.text.text.as_bytes())))];
    match crate::certificate::vertex_certificate(case, found) {
        Ok(certificate) => {
            facts.push(("certificate, SHA-256".to_owned(), code(crate::certificate::sha256(certificate.text()))));
            facts.push(("checker".to_owned(), words(format!("{}.", twice(found)))));
        }
        Err(why) => facts.push(("certificate".to_owned(), words(format!("none: {why}; {}.", twice(found))))),
    }
    vec![Block::heading(2, "Certificate"), Block::Facts(facts)]
}

fn statement(case: &VertexCase, found: &[AtValence], every: Option<&Every>) -> Vec<Block> {
    let mut blocks = vec![Block::heading(2, "Statement")];
    if let Some(source) = &case.source {
        blocks.push(Block::Paragraph(words(format!("Source of the case: {source}."))));
    }
    let mut text = words("Of the scheme of the case ");
    text.push(Inline::Code(case.name.clone()));
    let around = match case.border {
        None => " around a vertex of valence $n$ (a face with $n$ corners, if the scheme is dual):",
        Some(true) => " at a vertex with $k$ faces, where the border is a smooth curve:",
        Some(false) => " at a vertex with $k$ faces that is a corner of the border:",
    };
    text.extend(line(around, []));
    blocks.push(Block::Paragraph(text));
    let (is, is_not) = match case.border {
        None => ("the surface is a C¹ manifold", "the surface is not a C¹ manifold"),
        Some(_) => ("the surface is C¹ up to its border", "the surface is not C¹ up to its border"),
    };
    let claim = |what: &str| {
        format!("for almost all control points {what} at the vertex, with its parametrisation by the mesh")
    };
    let mut items: Vec<Line> = Vec::new();
    if let Some(every) = every {
        let verdict = if every.proved() { Verdict::Proved } else { Verdict::Undetermined };
        let mut item = vec![mark(verdict)];
        item.extend(line(&format!(": {}, at every valence $n≥{}$", claim(is), every.from), []));
        items.push(item);
    }
    for verdict in [Verdict::Proved, Verdict::Refuted, Verdict::Undetermined] {
        let list: Vec<&AtValence> = found.iter().filter(|f| f.smooth == verdict).collect();
        if list.is_empty() {
            continue;
        }
        let said = match verdict {
            Verdict::Proved => claim(is),
            // What is proved is the opposite for almost all control points, which is more than that the claim is false.
            Verdict::Refuted => claim(is_not),
            Verdict::Undetermined => format!("whether {}", claim(is)),
        };
        let mut item = vec![mark(verdict)];
        item.extend(words(format!(": {said}, at {}", places(&list))));
        items.push(item);
    }
    blocks.push(Block::List(items));
    let mut all = words("Verdict on all valences together: ");
    all.push(mark(overall(found, every)));
    all.extend(words(". Signs and comparisons are exact; decimals are for reading."));
    blocks.push(Block::Paragraph(all));
    blocks
}

/// The name of the rule, what it is, and what the file says.
fn scheme(case: &VertexCase) -> Vec<Block> {
    let mut facts = Vec::new();
    if let Some(info) = mesh_rules().iter().find(|r| r.name == case.scheme) {
        facts.push(("rule".to_owned(), words(format!("{}: {}", info.name, info.summary))));
        facts.push(("source of the rule".to_owned(), words(info.source)));
        let weights: Vec<String> =
            case.rule.weights().iter().map(|(name, value)| format!("{name} = {value}")).collect();
        if !weights.is_empty() {
            facts.push(("weights".to_owned(), code(weights.join(", "))));
        }
    } else {
        facts.push(("rule".to_owned(), words(case.scheme.clone())));
    }
    vec![Block::heading(2, "The scheme"), Block::Facts(facts)]
}

fn definitions(border: bool) -> Vec<Block> {
    let items = [
        "$K$ is the closed **ring** of patches that one step leaves around the smaller copy of the neighbourhood of the vertex. The surface near the vertex \
         consists of the rings that belong to $K$ after $0, 1, 2, …$ steps, and the vertex.",
        "Turning by one sector commutes with the subdivision matrix, which therefore splits into **Fourier blocks** $k=0,…,n-1$: in sector $s$ the values are \
         $ω^s v$ with $ω=e^{2πik/n}$. The blocks $k$ and $n-k$ are complex conjugates. Below, $c=\\cos(2πk/n)$.",
        "The **leading** eigenvalues are those of the largest modulus below 1 whose Jordan blocks are as long as the longest of that modulus; $U$ is the span \
         of the eigenvectors that end the chains of these blocks.",
        "Where the leading eigenvalue $λ$ is real and has one such Jordan block in each of the Fourier blocks $k$ and $n-k$, $0<k<n/2$, the **characteristic map** \
         $Ψ:K→ℝ^2$ has the two eigenvectors as control points. Its values are written $x+y ω$ with real $x, y$. **Regular** means that its Jacobian determinant has one \
         strict sign on $K$; **injective**, that its continuation to all smaller copies of $K$ is.",
        "**Tangent plane** means that all limit directions of secants at the vertex span a plane, $\\dim D^*=2$. C¹ means that a neighbourhood of the vertex in the \
         mesh is mapped one to one to the graph of a C¹ function over that plane: it is said of the surface with its parametrisation by the mesh, not of the set of its \
         points.",
        "**For almost all control points** means: for all for which the leading coefficients, $\\dim U$ points of space, span a subspace of the largest possible \
         dimension (at most 3).",
        "Theorems 2 and 3 and the corollary are about the branch of the vertex: a point of the surface is a row of weights of the control points, $V$ is spanned by the \
         differences of these rows, $L$ is the transposed subdivision matrix on $V$, $X$ the set of the rows of the ring minus that of the vertex, $E_1$ the eigenspace of \
         the largest modulus, $π_1$ the projection to it, which reads $Ψ$ (or the function of the only leading eigenvector), and $D^*$ the span of all limit directions \
         of secants. The branch is isolated if no row of $X$ is killed by a power of $L$.",
    ];
    // A fan has no Fourier blocks, and its statements say what its characteristic map is.
    let used = |text: &&&str| {
        !border || !["Fourier", "**leading**", "Theorems 2 and 3"].iter().any(|word| text.contains(word))
    };
    let items = items.iter().filter(used).map(|t| line(t, [])).collect();
    vec![Block::heading(2, "Definitions"), Block::List(items)]
}

/// The statements that are applied, in the order of the theory.
fn cited(case: &VertexCase, found: &[AtValence], every: Option<&Every>) -> Vec<Statement> {
    let mut out: Vec<Statement> = found.iter().flat_map(AtValence::statements).collect();
    if every.is_some_and(Every::proved) {
        out.extend([Statement::Lemma3, Statement::Theorem7, Statement::Theorem9]);
    }
    if out.contains(&Statement::Lemma4) && Regular::of(&case.rule).is_some_and(|r| r.shrinks.by_factors) {
        out.push(Statement::Lemma4Prime);
    }
    out.sort_unstable();
    out.dedup();
    out
}

/// What was verified at one valence, statement by statement.
fn evidence(case: &VertexCase, f: &AtValence) -> Vec<Block> {
    let mut blocks = Vec::new();
    // Lemma 4 is about the regular rule, not about the valence: it stands with the statements.
    for statement in f.statements().into_iter().filter(|s| *s != Statement::Lemma4) {
        blocks.push(named(statement));
        let found = match statement {
            Statement::Theorem2 | Statement::Theorem3 => branch(f, statement),
            Statement::Corollary => not_nilpotent(f, Evidence::of(statement)),
            Statement::Lemma3 => half_plane(f, frequency(f, Evidence::of(statement))),
            Statement::Theorem7 => half_plane(f, regular(f, leading(f, setting(f, Evidence::of(statement))))),
            Statement::Theorem8 => obstruction(case, f, setting(f, Evidence::of(statement))),
            Statement::CurvatureSize => curvature(f, Evidence::of(statement)),
            Statement::NoLimit => no_limit(f, Evidence::of(statement)),
            Statement::BorderVertex | Statement::BorderJordan | Statement::BorderOneFace | Statement::BorderRefuted => {
                on_border(case, f, statement)
            }
            other => Evidence::of(other),
        };
        blocks.push(found.block());
    }
    if let Some(vector) = f.eigenvector.as_ref().filter(|_| !f.statements().is_empty()) {
        blocks.push(eigenvector(vector));
    }
    blocks
}

/// A vertex on the border, which has the rules of the scheme of the case.
fn on_border(case: &VertexCase, f: &AtValence, statement: Statement) -> Evidence {
    let mut evidence = Evidence::of(statement);
    let rules = format!("the scheme is {}; a step on the fan was built from them.", case.scheme);
    evidence.push("rules", Tone::Good, words(rules));
    if statement != Statement::BorderOneFace {
        evidence = evidence.holds("fan", "$k=@$.", [Math::count(f.valence)]);
    }
    let map = match f.reason {
        VertexReason::Border(BorderGround::Affine) => Some(
            "two linear functions on three rings of points are eigenvectors of 1/2, exactly; the characteristic map is \
             affine, with a constant determinant.",
        ),
        VertexReason::Border(BorderGround::Jordan) => Some(
            "on three rings of points, exactly: $y$, linear, is an eigenvector of 1/2, and there is a function $x$ with $S \
             x=x/2+κy$ and $κ>0$.",
        ),
        VertexReason::Border(BorderGround::Map) => Some(
            "the eigenvectors were computed on three rings of points, exactly or in enclosures, and all Bernstein \
             coefficients on the ring have the signs, but for exact zeros on the border.",
        ),
        _ => None,
    };
    if let Some(map) = map {
        evidence.push("map", Tone::Good, line(map, []));
    }
    evidence.push("coefficients", Tone::Good, words("for almost all control points."));
    evidence
}

/// The name of a statement before its ticks.
fn named(statement: Statement) -> Block {
    Block::Paragraph(vec![Inline::Strong(statement.name().to_owned())])
}

/// The centre and the points of sector 0 of the leading eigenvector, rounded.
fn eigenvector(vector: &Eigenvector) -> Block {
    let number = |x: &Rational| formula(decimal_math(x, 6));
    let row = |name: String, (x, y): &(Rational, Rational)| vec![words(name), number(x), number(y)];
    let mut rows = vec![row("centre".to_owned(), &vector.centre)];
    rows.extend(vector.points.iter().map(|((i, j), value)| row(format!("({i}, {j})"), value)));
    let header = vec![words("place in sector 0"), line("$x≈$", []), line("$y≈$", [])];
    let table = Block::Table(Table { caption: Line::new(), header, rows });
    let summary = words(format!(
        "The leading eigenvector in block {}, values x + y ω (ω = 1 in block 0), rounded from enclosures; signs are decided on the enclosures:",
        vector.frequency
    ));
    Block::Details { summary, blocks: vec![table] }
}

/// The enclosure of the leading eigenvalue, rounded outwards, or its value.
fn modulus(f: &AtValence) -> Line {
    match &f.top {
        Some(top) => match &top.rational {
            Some(q) => line("$λ=@$", [Math::number(q)]),
            None => {
                let (lo, hi) = outward(&top.enclosure);
                line("$λ∈[@,@]$", [lo, hi])
            }
        },
        None => words("no eigenvalue is known"),
    }
}

fn setting(f: &AtValence, mut evidence: Evidence) -> Evidence {
    let Some(top) = &f.top else { return evidence };
    let (plus, minus) = (top.members.iter().any(|m| !m.negative), top.members.iter().any(|m| m.negative));
    let (before, after) = match (plus, minus) {
        (true, true) => ("eigenvalues of largest modulus are ", " and $-λ$"),
        (_, false) => ("eigenvalue of largest modulus is ", ""),
        (false, true) => ("eigenvalue of largest modulus is $-λ$ with ", ""),
    };
    let mut text = line(&format!("the scheme is symmetric by construction; besides 1, counted once, the {before}"), []);
    text.extend(modulus(f));
    text.extend(line(
        &format!("{after}, in the blocks listed, below 1 in modulus, and all others are at most $@$ in modulus."),
        [short_bound(&top.others)],
    ));
    evidence.push("setting", Tone::Good, text);
    evidence
}

fn not_nilpotent(f: &AtValence, mut evidence: Evidence) -> Evidence {
    if f.top.is_some() {
        let mut text = modulus(f);
        text.extend(words(", which is not 0."));
        evidence.push("not-nilpotent", Tone::Good, text);
    }
    evidence
}

fn leading(f: &AtValence, evidence: Evidence) -> Evidence {
    let Some(top) = &f.top else { return evidence };
    let (length, dimension) = top.longest(f.valence);
    evidence.holds(
        "leading",
        "$ℓ+1=@$; blocks of this size and modulus are in the Fourier blocks 1 and $n-1$ only, one in each ($\\dim U=@$).",
        [Math::count(length), Math::count(dimension)],
    )
}

fn regular(f: &AtValence, mut evidence: Evidence) -> Evidence {
    if let Some(signs) = f.jacobian.as_ref().filter(|s| s.strict().is_some()) {
        let by = if f.polynomial { "all Bernstein coefficients of it have" } else { "its enclosures by Lemma 4 have" };
        let text = format!(
            "{by} one strict sign on each of {}, at most {} halved or refined.",
            count(signs.pieces, "piece"),
            count(signs.depth, "time")
        );
        evidence.push("regular", Tone::Good, words(text));
    }
    evidence
}

fn curvature(f: &AtValence, mut evidence: Evidence) -> Evidence {
    let Some(c) = f.curvature.as_ref().filter(|_| f.polynomial) else { return evidence };
    let text = "Theorem 7 proves it C¹, with blocks of size 1 and $λ>0$; the rings are piecewise polynomial.";
    evidence = evidence.holds("setting", text, []);
    let blocks = crate::report::curvature::blocks(c, f.valence);
    let ratio = match c.size {
        Size::Vanishing => "ρ/λ² is below 1".to_owned(),
        _ => format!("ρ/λ² lies in {}, and its longest Jordan blocks have size {}", interval(&c.ratio), c.power + 1),
    };
    evidence.push("rest", Tone::Good, words(format!("{ratio}; Fourier blocks with one: {blocks}.")));
    evidence
}

fn half_plane(f: &AtValence, mut evidence: Evidence) -> Evidence {
    if let Some((a, b)) = &f.half_plane {
        let by = if f.polynomial {
            "at all control points of the patches of a sector"
        } else {
            "on a sector, by enclosures"
        };
        let text = format!("{} > 0 {by}, in coordinates x + y ω.", functional(a, b));
        evidence.push("half-plane", Tone::Good, words(text));
    }
    evidence
}

fn frequency(f: &AtValence, evidence: Evidence) -> Evidence {
    match f.frequency {
        Some(k) => evidence.holds("setting", "$k=@$, $n=@$.", [Math::count(k), Math::count(f.valence)]),
        None => evidence,
    }
}

/// Theorem 2 or 3 at the vertex: a plane, or a line.
fn branch(f: &AtValence, statement: Statement) -> Evidence {
    let mut evidence = not_nilpotent(f, Evidence::of(statement));
    let Some(top) = &f.top else { return evidence };
    let (length, dimension) = top.longest(f.valence);
    let name = if statement == Statement::Theorem2 { "semisimple" } else { "blocks" };
    let text = "the longest Jordan blocks of the largest modulus have the size @, and $\\dim U=@$.";
    evidence = evidence.holds(name, text, [Math::count(length), Math::count(dimension)]);
    if f.plane == Verdict::Proved {
        evidence =
            evidence.holds("ring", "$0∉Ψ(K)$, by the half-plane that holds the image of a sector (Lemma 3).", []);
    } else if f.ground == Some(Ground::Line) {
        evidence = evidence.holds("ring", "the function of the eigenvector has one strict sign on the ring.", []);
    }
    evidence
}

fn obstruction(case: &VertexCase, f: &AtValence, mut evidence: Evidence) -> Evidence {
    let dimension = f.top.as_ref().map_or(0, |top| top.longest(f.valence).1);
    let text = match f.ground {
        Some(Ground::Winding(k)) => match f.winding {
            Some(w) => format!("(a): k = {k}, and by Lemma 3 the ring winds {w} times around 0."),
            None => format!("(a): k = {k}, and the eigenvectors are semisimple."),
        },
        Some(Ground::Sectors) => "(b): both leading eigenvectors are in the blocks 0 and n/2.".to_owned(),
        Some(Ground::Fold) => {
            let signs = f.jacobian.as_ref();
            let place = |at: Option<&(usize, (Rational, Rational))>| at.and_then(|at| f.lattice(&case.rule, at));
            let found = signs.and_then(|s| Some((place(s.positive.as_ref())?, place(s.negative.as_ref())?)));
            match found {
                Some(((u, v), (x, y))) => format!(
                    "(c): in the lattice of a sector the Jacobian determinant is positive at ({u}, {v}) and negative at ({x}, {y})."
                ),
                None => return evidence,
            }
        }
        Some(Ground::Span) => format!("(d): the dimension of U is {dimension}."),
        Some(Ground::Line) => "(e): the dimension of U is 1, and the function of the eigenvector has one strict sign on the ring.".to_owned(),
        Some(Ground::Path) => {
            "(e): the dimension of U is 1, the eigenvalue is in block 0, and the function has one strict sign on a closed path around the vertex."
                .to_owned()
        }
        Some(Ground::Regular | Ground::NoLimit) | None => return evidence,
    };
    evidence.push("obstruction", Tone::Good, words(text));
    evidence
}

/// Lemma 4 with the numbers of the regular rule.
fn lemma_4(case: &VertexCase, evidence: Evidence) -> Evidence {
    let Some(r) = Regular::of(&case.rule) else { return evidence };
    let (slope, value) = r.bounds();
    let by =
        if r.shrinks.by_factors { "by the factors of the mask (Lemma 4′)" } else { "by all words of this length" };
    let mut evidence = evidence
        .holds("rule", "$N=@$; steps keep linear functions (checked).", [Math::Number(Rational::from(r.factor))])
        .holds("points", "$Ω$ has @ points.", [Math::count(r.points.len())]);
    if r.holds_across() {
        evidence = evidence.holds("across", "the corners of the cells across the edges are among them.", []);
    }
    evidence.holds(
        "shrinks",
        &format!("$k=@$, $R≤@$ {by}; so $e_1≤@$ and $e_0≤@$."),
        [Math::count(r.shrinks.length), short_bound(&r.shrinks.to), short_bound(&slope), short_bound(&value)],
    )
}

fn no_limit(f: &AtValence, mut evidence: Evidence) -> Evidence {
    let mut text = modulus(f);
    text.extend(words(", which is at least 1 in modulus."));
    evidence.push("modulus", Tone::Good, text);
    evidence.holds("rings", "it holds for all rules that are examined here (docs/theory.md §10.1).", [])
}
