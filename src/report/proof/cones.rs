//! The cones of Theorem 6 and their images, over any field.

use super::super::document::{Block, Line, Table, Tone, formula, line, words};
use super::super::math::Math;
use super::super::radius::decimal;
use super::super::reported::{Reported, entries, vector};
use super::super::words::count;
use super::evidence::Evidence;
use super::matrix;
use crate::arith::Rational;
use crate::case::Case;
use crate::linalg::Matrix;
use crate::statement::Statement;
use crate::theorem::Certified;
use crate::theorem::cone::{Cone, ConeMap};
use malachite_base::num::arithmetic::traits::Pow;

/// Most rays that are printed.
const MAX_RAYS: usize = 12;
/// Wider matrices of coefficients are not printed: about so many characters fit a line.
const MAX_WIDTH: usize = 54;
/// Numbers of at most so many characters are written exactly.
const SHORT: usize = 16;
/// Binary digits of the enclosures from which bounds are taken.
const BITS: u64 = 100;

/// Cones, the maps between them, and the functional that is positive on what is seen of that of the start.
pub(super) struct Cones<'a, E> {
    pub cones: &'a [Cone<E>],
    pub maps: &'a [ConeMap<E>],
    pub view: Option<&'a [E]>,
}

/// `G_e` with the name of its state.
fn indexed<E>(case: &Case<E>, state: usize, letter: &str) -> Math {
    let name = Math::Word(case.shape.states[state].name.clone());
    Math::parse(&format!("{letter}_@"), &mut std::iter::once(name))
}

impl<E: Reported> Cones<'_, E> {
    /// Whether the rays are few enough to be printed.
    fn printed(&self) -> bool {
        self.cones.iter().all(|c| c.rays.cols() <= MAX_RAYS)
    }

    /// The cones and their rays.
    pub(super) fn rays(&self, case: &Case<E>) -> Vec<Block> {
        let mut blocks = Vec::new();
        for own in self.cones {
            let of = if case.shape.states.len() > 1 {
                format!(" of state {}", case.shape.states[own.state].name)
            } else {
                String::new()
            };
            let mut head = words(format!("The cone{of} is that of {}", count(own.rays.cols(), "ray")));
            if self.printed() {
                head.extend(words(", the columns of"));
                blocks.push(Block::Paragraph(head));
                blocks.push(matrix(indexed(case, own.state, "G"), &own.rays));
            } else {
                head.extend(words("."));
                blocks.push(Block::Paragraph(head));
            }
        }
        blocks
    }

    /// What was verified of the hypotheses of Theorem 6; for Theorem 6′ most of it stands under its hypothesis *cones*.
    pub(super) fn evidence(&self, case: &Case<E>, found: &Certified<E>, statement: Statement) -> Evidence {
        let slow = statement == Statement::Theorem6Slow;
        let name = |plain: &'static str| if slow { "cones" } else { plain };
        let mut evidence = Evidence::of(statement);
        let meet = "every piece begins where the one before ends, as in the table of identities above.";
        evidence.push(name("meet"), Tone::Good, words(meet));
        for own in self.cones {
            let indexed = |letter: &str| indexed(case, own.state, letter);
            let relevant = found.states.iter().find(|s| s.state == own.state).map_or(own.rays.rank(), |s| s.relevant);
            evidence.push(
                "cones",
                Tone::Good,
                line("$@$ has the rank $@=\\dim V$.", [indexed("G"), Math::count(relevant)]),
            );
            let positive: Vec<E> = (0..own.rays.cols()).map(|j| E::dot(&own.functional, &own.rays.column(j))).collect();
            let mut text = line("$@@>0$ for ", [indexed("f"), indexed("G")]);
            text.extend(line("$@=@$", [indexed("f"), vector(&own.functional)]));
            if self.printed() {
                text.extend(line(": $@@=@$", [indexed("f"), indexed("G"), vector(&positive)]));
            }
            evidence.push("cones", Tone::Good, text);
            let mut text = line(
                "the chord, end minus start, is $@=@@$",
                [vector(&own.rays.apply(&own.chord)), indexed("G"), indexed("y")],
            );
            let coefficients = if self.printed() { " with $@=@≥0$." } else { " with $@≥0$." };
            let mut values = vec![indexed("y")];
            if self.printed() {
                values.push(vector(&own.chord));
            }
            text.extend(line(coefficients, values));
            evidence.push(name("chords"), Tone::Good, text);
        }
        let images = if slow {
            "$ε_i T_i G_δ=G_e B_i$ with $B_i≥0$, without zero columns, for every piece, as below."
        } else {
            "$ε_i T_i G_δ=G_e B_i$ with $B_i>0$ for every piece, as below."
        };
        evidence.push(name("positive"), Tone::Good, line(images, []));
        let control = case.shape.control.is_some();
        let tone = if self.view.is_none() && control { Tone::Open } else { Tone::Good };
        evidence.push(name("view"), tone, self.view(control));
        evidence
    }

    fn view(&self, control: bool) -> Line {
        match (self.view, control) {
            (Some(h), _) => line("$h P G>0$ for the start state and $h=@$.", [vector(h)]),
            (None, false) => words("there are no control points."),
            (None, true) => {
                words("no functional h was found, so that the conclusions are about the curve before the projection.")
            }
        }
    }

    /// The matrices of coefficients: small ones with their entries, of others the size.
    pub(super) fn images(&self, case: &Case<E>) -> Vec<Block> {
        let several = case.shape.states.len() > 1;
        let fits = self.maps.iter().all(|m| width(&m.matrix) <= MAX_WIDTH);
        let rows = self.maps.iter().map(|m| {
            let mut row = vec![words(m.letter.to_string()), words(m.sign.to_string().replace('-', "−"))];
            if several {
                row.insert(0, words(case.shape.states[m.state].name.clone()));
            }
            row.push(if fits {
                formula(entries(&m.matrix))
            } else {
                line("$@×@$", [Math::count(m.matrix.rows()), Math::count(m.matrix.cols())])
            });
            row.push(formula(least(&m.matrix)));
            row
        });
        let what = if fits { "$B_i$" } else { "size of $B_i$" };
        let mut header = vec![words("piece"), line("$ε_i$", []), line(what, []), words("smallest entry")];
        if several {
            header.insert(0, words("state"));
        }
        let table = Block::Table(Table { caption: Line::new(), header, rows: rows.collect() });
        let summary = line("The images of the cones, $ε_i T_i G_δ=G_e B_i$:", []);
        let mut blocks = vec![Block::Details { summary, blocks: vec![table] }];
        if !fits || !self.printed() {
            blocks.push(Block::text(
                "Numbers that are not printed here are in the output of `secant certify CASE --json`, under `every_point.cone`.",
                [],
            ));
        }
        blocks
    }
}

/// About how many characters a row of a matrix takes, fractions being stacked.
fn width<E: Reported>(m: &Matrix<E>) -> usize {
    let cell = |x: &E| match x.rational() {
        Some(q) => q.numerator_ref().to_string().len().max(q.denominator_ref().to_string().len()),
        None => x.to_string().len(),
    };
    (0..m.cols()).map(|j| (0..m.rows()).map(|i| cell(&m[(i, j)])).max().unwrap_or(0) + 2).sum()
}

/// The smallest entry of a matrix, rounded downwards where it is long or irrational.
fn least<E: Reported>(m: &Matrix<E>) -> Math {
    let Some(least) = (0..m.rows()).flat_map(|i| m.row(i)).min() else { return Math::count(0) };
    let below = least.enclosure(BITS).lo;
    let keeps_sign = |places: &u64| below >= Rational::from(1) / Rational::from(10).pow(*places);
    let long = least.rational().is_none_or(|x| x.to_string().len() > SHORT);
    match [6, 12, 24].into_iter().find(keeps_sign) {
        Some(places) if long => {
            let digits = Math::Digits(decimal(&below, false, places));
            Math::parse("≥@", &mut std::iter::once(digits))
        }
        _ => least.math(),
    }
}
