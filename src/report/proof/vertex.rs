//! The proof-style report on extraordinary vertices: the claim, the scheme, the words that are used, the statements, and the
//! evidence for every valence.

use super::super::document::{Block, Document, Inline, Line, code, line, words};
use super::super::vertex::{evidence_by_valence, ranges, summary_by_valence, twice};
use super::super::words::mark;
use super::{Quoted, references};
use crate::case::VertexCase;
use crate::scheme::mesh_rules;
use crate::statement::Statement;
use crate::theorem::Verdict;
use crate::vertex::{AtValence, Every, overall};

/// The whole proof for the valences examined, and for all valences where they were asked for, as a document.
#[must_use]
pub fn vertex_document(case: &VertexCase, found: &[AtValence], every: Option<&Every>) -> Document {
    let mut seen = Quoted::default();
    let mut blocks = statement(case, found, every);
    blocks.extend(scheme(case));
    blocks.extend(definitions());
    let quotes: Vec<Block> = cited(found, every).into_iter().filter_map(|id| seen.once_id(id)).collect();
    if !quotes.is_empty() {
        blocks.push(Block::heading(2, "The statements"));
        blocks.extend(quotes);
    }
    blocks.push(Block::heading(2, "Summary"));
    blocks.extend(summary_by_valence(case, found, every));
    blocks.extend(evidence_by_valence(case, found));
    blocks.push(Block::heading(2, "Certificate"));
    let mut facts =
        vec![("case file, SHA-256".to_owned(), code(crate::certificate::sha256(case.text.text.as_bytes())))];
    match crate::certificate::vertex_certificate(case, found) {
        Some(certificate) => {
            facts.push(("certificate, SHA-256".to_owned(), code(crate::certificate::sha256(certificate.text()))));
            facts.push(("checker".to_owned(), words(format!("{}.", twice(found)))));
        }
        None => facts.push(("certificate".to_owned(), words(format!("none: {}.", twice(found))))),
    }
    blocks.push(Block::Facts(facts));
    blocks.extend(references(&seen));
    Document { title: case.title.clone(), blocks }
}

fn statement(case: &VertexCase, found: &[AtValence], every: Option<&Every>) -> Vec<Block> {
    let mut blocks = vec![Block::heading(2, "Statement")];
    let mut text = words("Of the scheme of the case ");
    text.push(Inline::Code(case.name.clone()));
    text.extend(line(" around a vertex of valence $n$ (a face with $n$ corners, if the scheme is dual):", []));
    blocks.push(Block::Paragraph(text));
    if let Some(source) = &case.source {
        blocks.push(Block::Paragraph(words(format!("Source of the case: {source}."))));
    }
    let claim = "for almost all control points the surface is a C¹ manifold at the vertex";
    let mut items: Vec<Line> = Vec::new();
    if let Some(every) = every {
        let verdict = if every.proved() { Verdict::Proved } else { Verdict::Undetermined };
        let mut item = vec![mark(verdict)];
        item.extend(line(&format!(": {claim}, at every valence $n≥{}$", every.from), []));
        items.push(item);
    }
    for verdict in [Verdict::Proved, Verdict::Refuted, Verdict::Undetermined] {
        let list: Vec<usize> = found.iter().filter(|f| f.smooth == verdict).map(|f| f.valence).collect();
        if list.is_empty() {
            continue;
        }
        let said = match verdict {
            Verdict::Proved => claim.to_owned(),
            Verdict::Refuted => claim.replace(" is a ", " is not a "),
            Verdict::Undetermined => format!("whether {claim}"),
        };
        let mut item = vec![mark(verdict)];
        item.extend(words(format!(": {said}, at {}", ranges(&list))));
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
        let names = info.parameters.iter().map(|p| p.name);
        let given: Vec<String> = names.filter_map(|name| Some(format!("{name} = {}", value_of(case, name)?))).collect();
        if !given.is_empty() {
            facts.push(("weights given".to_owned(), code(given.join(", "))));
        }
    } else {
        facts.push(("rule".to_owned(), words(case.scheme.clone())));
    }
    vec![Block::heading(2, "The scheme"), Block::Facts(facts)]
}

/// What the file writes after `name =`.
fn value_of(case: &VertexCase, name: &str) -> Option<String> {
    let values = case.text.text.lines().filter_map(|l| l.trim().strip_prefix(name)?.trim_start().strip_prefix('='));
    values.map(|v| v.split('#').next().unwrap_or_default().trim().trim_matches('"').to_owned()).next()
}

fn definitions() -> Vec<Block> {
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
        "**Tangent plane** means that all limit directions of secants at the vertex span a plane; C¹, that near the vertex the surface is a graph over that plane \
         with normals that converge.",
    ];
    vec![Block::heading(2, "Definitions"), Block::List(items.iter().map(|t| line(t, [])).collect())]
}

/// The statements that the reasons name, in the order of the theory.
fn cited(found: &[AtValence], every: Option<&Every>) -> Vec<Statement> {
    let says = |what: &str| found.iter().any(|f| f.reason.contains(what));
    let planes = found.iter().any(|f| f.plane == Verdict::Proved && f.winding.is_some());
    let listed = [
        (Statement::Theorem2, says("(Theorem 2)") || planes),
        (Statement::Theorem3, says("(Theorem 3)")),
        (Statement::Corollary, says("corollary")),
        (Statement::Lemma3, planes || every.is_some()),
        (Statement::Lemma4, says("(Lemma 4)") || found.iter().any(|f| !f.polynomial && f.jacobian.is_some())),
        (Statement::Theorem7, says("(Theorem 7)") || every.is_some()),
        (Statement::Theorem8, says("(Theorem 8)")),
        (Statement::Theorem9, every.is_some_and(Every::proved)),
    ];
    listed.into_iter().filter(|(_, used)| *used).map(|(s, _)| s).collect()
}
