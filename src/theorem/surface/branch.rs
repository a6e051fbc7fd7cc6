//! One branch of a point of a surface: the table of theory §5 for dimension 2, and what follows where its ring condition
//! fails.

use super::place::Chart;
use super::span::Subspace;
use super::verdict::{SurfaceBranch, SurfaceOutcome, SurfaceWitness};
use super::winding::winding;
use crate::algebraic::Elem;
use crate::arith::Rational;
use crate::jordan::{Eigenvalue, Spectrum};
use crate::linalg::Matrix;
use crate::shape::{Address, CellKind, Complex};
use crate::theorem::branch::{Context, Local, isolation_functionals, krylov, power, restrict};
use crate::theorem::ring::{Functional, Part, Ring, RingAnswer, RingPiece, RingProof, Witness};
use crate::theorem::{BranchGap, Dimension, Statement, TopRow};

/// Cells of a piece of the ring on which a change of sign is looked for.
const SIGN_CELLS: usize = 80;
/// Deepest group of eigenvalues for which a ring condition is tried.
const MAX_DEPTH: usize = 4;
/// Witnesses that are collected.
const MAX_WITNESSES: usize = 4;

/// What all branches of a surface share.
pub struct Setting<'a> {
    /// Shape, spaces, enclosures and view.
    pub cx: Context<'a>,
    /// The boundaries of the faces.
    pub complex: &'a Complex,
    /// Their parameters, where the complex has them.
    pub chart: Option<&'a Chart<'a>>,
    /// Whether the theorem on products decides as well, so that large patches get a smaller budget here.
    pub quick: bool,
}

/// Examines the branch `address` from the root state.
///
/// Returns `None` where the fixed point of the cycle is not unique.
pub fn examine(setting: &Setting, address: &Address) -> Option<SurfaceBranch> {
    let Local { state, cycle_operator, fixed, transport, relevant, chart, linear, view, spectrum, ring } =
        Local::new(&setting.cx, address)?;
    let mut branch = SurfaceBranch {
        address: address.clone(),
        state,
        cycle_operator,
        fixed,
        transport,
        relevant,
        chart,
        linear,
        view,
        spectrum,
        ring,
        outcome: nothing(TopRow::Empty),
    };
    let seen: Vec<RingPiece> = branch.ring.iter().filter(|p| !p.collapses).cloned().collect();
    branch.outcome = Analysis { setting, branch: &branch, seen: &seen }.outcome();
    Some(branch)
}

fn nothing(row: TopRow) -> SurfaceOutcome {
    SurfaceOutcome {
        statement: None,
        row,
        contains: Subspace::default(),
        dimension: Dimension { at_least: 0, exact: false },
        at_most: None,
        ring: None,
        isolation: None,
        depth: None,
        witness: None,
        open: None,
    }
}

struct Analysis<'a> {
    setting: &'a Setting<'a>,
    branch: &'a SurfaceBranch,
    /// The ring without the pieces that collapse.
    seen: &'a [RingPiece],
}

/// The eigenvalues of the largest modulus with a longest block, each once.
struct Top {
    /// Length of the longest block.
    block: usize,
    /// Factors and the positions of their roots.
    members: Vec<(usize, Vec<usize>)>,
    /// The dimension of `U`.
    dimension: usize,
}

fn top(spectrum: &Spectrum) -> Option<Top> {
    let class = spectrum.classes.first()?;
    let block = class.members.iter().map(|m| spectrum.factors[m.factor].blocks[0]).max()?;
    let mut members: Vec<(usize, Vec<usize>)> = Vec::new();
    let mut dimension = 0;
    for m in class.members.iter().filter(|m| spectrum.factors[m.factor].blocks[0] == block) {
        dimension += spectrum.factors[m.factor].blocks.iter().filter(|b| **b == block).count();
        match members.iter_mut().find(|(f, _)| *f == m.factor) {
            Some((_, roots)) => roots.push(m.root),
            None => members.push((m.factor, vec![m.root])),
        }
    }
    Some(Top { block, members, dimension })
}

/// The row of the table that describes the top of the spectrum.
fn row(spectrum: &Spectrum, top: &Top) -> TopRow {
    let class = &spectrum.classes[0];
    let complex = class.members.iter().any(|m| !spectrum.root(*m).is_real());
    match (top.block, top.dimension, complex) {
        (1, 1, _) => TopRow::Simple,
        (1, 2, true) => TopRow::Pair,
        (1, 2, false) if class.members.len() == 1 => TopRow::Double,
        (1, 2, false) => TopRow::Opposite,
        (1, ..) => TopRow::ManyVectors,
        (_, 1, _) => TopRow::Block,
        (_, 2, true) => TopRow::PairBlocks,
        (_, 2, false) => TopRow::TwoBlocks,
        _ => TopRow::ManyBlocks,
    }
}

/// The functionals of one vector of a left chain at the listed roots: real and imaginary part of one of two conjugates.
fn functionals_at(spectrum: &Spectrum, factor: usize, roots: &[usize], vector: &[Elem], out: &mut Vec<Functional>) {
    for &r in roots {
        let root = &spectrum.factors[factor].roots[r];
        if !root.is_real() && root.conjugate().index() < r && roots.contains(&(r - 1)) {
            continue;
        }
        let part = |part| Functional { row: vector.to_vec(), root: Some(root.clone()), part, alpha: None };
        out.push(part(Part::Real));
        if !root.is_real() {
            out.push(part(Part::Imaginary));
        }
    }
}

/// The functionals that read the leading coefficient: the eigenvectors that end the longest left chains of the largest modulus.
///
/// None where the spectrum is empty.
#[must_use]
pub fn leading_functionals(spectrum: &Spectrum) -> Vec<Functional> {
    top(spectrum).map_or_else(Vec::new, |top| functionals_of(spectrum, &top))
}

fn functionals_of(spectrum: &Spectrum, top: &Top) -> Vec<Functional> {
    let mut out = Vec::new();
    for (f, roots) in &top.members {
        for chain in spectrum.factors[*f].left.iter().filter(|c| c.vectors.len() == top.block) {
            functionals_at(spectrum, *f, roots, &chain.vectors[0], &mut out);
        }
    }
    out
}

impl Analysis<'_> {
    fn spectrum(&self) -> &Spectrum {
        &self.branch.spectrum
    }

    fn ring(&self) -> Ring<'_> {
        let cx = &self.setting.cx;
        Ring {
            shape: cx.shape,
            base: &(),
            spaces: cx.spaces,
            balls: cx.balls,
            state: self.branch.state,
            fixed: &self.branch.fixed,
            chart: &self.branch.chart,
            pieces: self.seen,
        }
    }

    /// How many rows may be carried to cells.
    fn rows(&self) -> usize {
        let cells = self.setting.cx.budget.cells;
        if self.setting.quick { cells / 16 } else { cells }
    }

    fn decide(&self, functionals: &[Functional]) -> RingAnswer {
        let answer = self.ring().decide(functionals, self.rows());
        if self.branch.relevant > 2 || !matches!(answer, RingAnswer::Open { .. }) {
            return answer;
        }
        let cx = &self.setting.cx;
        match cx.hulls.get_or_init(|| cx.balls.with_hulls(cx.shape, cx.spaces)) {
            Some(hulls) => Ring { balls: hulls, ..self.ring() }.decide(functionals, self.rows()),
            None => answer,
        }
    }

    fn outcome(&self) -> SurfaceOutcome {
        let b = self.branch;
        if b.linear.rows() == 0 {
            return SurfaceOutcome {
                dimension: Dimension { at_least: 0, exact: true },
                at_most: Some(0),
                ..nothing(TopRow::SinglePoint)
            };
        }
        let Some(top) = top(self.spectrum()) else { return nothing(TopRow::Empty) };
        if self.spectrum().root(self.spectrum().classes[0].members[0]).is_zero() {
            let open = Some((BranchGap::NilpotentCells, None));
            return SurfaceOutcome { open, ..nothing(TopRow::Nilpotent) };
        }
        let contains = self.leading_directions(&top);
        let rank = contains.rank();
        let base = SurfaceOutcome {
            statement: Some(Statement::Corollary),
            row: row(self.spectrum(), &top),
            dimension: Dimension { at_least: rank.at_least, exact: false },
            contains,
            ..nothing(TopRow::Empty)
        };
        if rank.at_least >= 3 {
            return base;
        }
        let seen = b.view.rank();
        if rank.exact() == Some(seen) {
            // G U ⊂ D* ⊂ G Y, because all secants lie in G Y.
            let statement = Some(if seen == 1 { Statement::CorollaryLine } else { Statement::Corollary });
            let dimension = Dimension { at_least: seen, exact: true };
            return SurfaceOutcome { statement, dimension, at_most: Some(seen), ..base };
        }
        let functionals = functionals_of(self.spectrum(), &top);
        match self.decide_leading(&functionals) {
            (RingAnswer::Holds(proof), _) => self.condition_holds(&top, base, proof),
            (answer, witness) => self.condition_fails(&top, base, answer, witness),
        }
    }

    /// The ring condition of the leading functionals, or what shows that it fails: first what is cheap.
    fn decide_leading(&self, functionals: &[Functional]) -> (RingAnswer, Option<SurfaceWitness>) {
        let mut answer = self.ring().decide(functionals, self.setting.cx.budget.first_surface_cells());
        if matches!(answer, RingAnswer::Open { .. }) {
            if let Some(found) = self.path(functionals) {
                return (answer, Some(found));
            }
            answer = self.decide(functionals);
        }
        let witness = self.witness(functionals, &answer);
        (answer, witness)
    }

    /// `G U`: the eigenvectors that end the longest chains.
    fn leading_directions(&self, top: &Top) -> Subspace {
        span_of_ends(self.spectrum(), top, &self.branch.view)
    }

    /// Theorem 2 or 3: all limit directions lie in `U`, and span it.
    fn condition_holds(&self, top: &Top, base: SurfaceOutcome, proof: RingProof) -> SurfaceOutcome {
        let statement = if top.block == 1 { Statement::Theorem2 } else { Statement::Theorem3 };
        let injective = base.contains.rank().exact() == Some(top.dimension);
        let mut found = SurfaceOutcome { statement: Some(statement), ring: Some(proof), ..base };
        if injective {
            found.dimension = Dimension { at_least: top.dimension, exact: true };
            found.at_most = Some(top.dimension);
        } else {
            found.open = Some((BranchGap::Folded, None));
        }
        found
    }

    /// The ring condition fails or is open: isolation first, then what a witness gives.
    fn condition_fails(
        &self,
        top: &Top,
        base: SurfaceOutcome,
        answer: RingAnswer,
        witness: Option<SurfaceWitness>,
    ) -> SurfaceOutcome {
        let open = |base: SurfaceOutcome, reason, place| SurfaceOutcome { open: Some((reason, place)), ..base };
        let letters = |a: Address| -> Vec<usize> { a.prefix.into_iter().chain(a.cycle).collect() };
        let isolation = match self.decide(&isolation_functionals(&self.branch.linear, &())) {
            RingAnswer::Holds(proof) => proof,
            RingAnswer::Fails(Witness::Point { address, .. }) => {
                return open(base, BranchGap::KernelPoint, Some(letters(address)));
            }
            RingAnswer::Fails(_) => return open(base, BranchGap::NotIsolated, None),
            RingAnswer::Open { place } => {
                return open(base, BranchGap::IsolationOpen, Some(place));
            }
        };
        let Some(witness) = witness else {
            let place = match answer {
                RingAnswer::Open { place } => Some(place),
                _ => None,
            };
            return open(base, BranchGap::RingOpen, place);
        };
        let mut found = SurfaceOutcome { isolation: Some(isolation), ..base };
        found.statement = Some(Statement::Theorem4);
        match &witness {
            SurfaceWitness::Points(points) => {
                for (_, offset) in points {
                    if let Some(own) = self.own_directions(offset) {
                        found.contains = found.contains.join(&own);
                    }
                }
            }
            SurfaceWitness::SignChange(_) | SurfaceWitness::Winding(_) => {}
        }
        found.dimension.at_least = found.contains.rank().at_least;
        self.bound(top, &mut found, &witness);
        self.turned(top, &mut found, &witness);
        found.witness = Some(witness);
        if !found.dimension.exact && found.dimension.at_least < 3 && found.open.is_none() {
            found.open = Some((BranchGap::RingFails, None));
        }
        found
    }

    /// Theorems 4′ and 4″: a change of sign, or a path that winds around 0, gives a direction outside `U`, for blocks of any length. The
    /// branch is isolated, so that it is enough that `G` loses nothing of the eigenspaces of eigenvalues that are not 0.
    fn turned(&self, top: &Top, found: &mut SurfaceOutcome, witness: &SurfaceWitness) {
        let least = match witness {
            SurfaceWitness::SignChange(_) if top.dimension == 1 => 2,
            SurfaceWitness::Winding(_) if top.dimension == 2 => 3,
            _ => return,
        };
        let image = power(&self.branch.linear, self.branch.linear.rows());
        if found.dimension.at_least < least && (&self.branch.view * &image).rank() == image.rank() {
            found.dimension.at_least = least;
            found.statement = Some(if least == 3 { Statement::Theorem4Winding } else { Statement::Theorem4Sign });
            if least == 3 {
                found.open = None;
            }
        }
    }

    /// Upper bounds by Theorem 1, and directions that exist without a known point.
    fn bound(&self, top: &Top, found: &mut SurfaceOutcome, witness: &SurfaceWitness) {
        let injective = self.branch.view.rank() == self.branch.linear.rows();
        let known = matches!(witness, SurfaceWitness::Points(_));
        let classes = &self.spectrum().classes;
        let mut space = Subspace::default();
        let mut dimension = 0;
        for depth in 1..=MAX_DEPTH.min(classes.len()) {
            let class: &[Eigenvalue] = &classes[depth - 1].members;
            if self.spectrum().root(class[0]).is_zero() {
                break;
            }
            let (group, size) = self.generalised(class);
            space = space.join(&group);
            dimension += size;
            if depth == 1 && top.block == 1 {
                if !known && injective {
                    // A zero of π_1 on X gives a limit direction outside E_1, which is contained in D*.
                    found.dimension.at_least = found.dimension.at_least.max(dimension + 1);
                }
                continue;
            }
            let RingAnswer::Holds(proof) = self.decide(&self.all_functionals(depth)) else { continue };
            if depth == 1 && self.turns_over(top, witness) {
                // §6: the limit directions leave U but stay in E_1.
                found.statement = Some(Statement::Section6);
                if dimension == top.dimension + 1 {
                    found.contains = found.contains.join(&space);
                } else if injective {
                    found.dimension.at_least = found.dimension.at_least.max(top.dimension + 1);
                }
            }
            if depth == 2 && top.block == 1 && !known && self.is_irreducible(class) {
                // The unknown zero of π_1 has a component in E_2, whose hull is all of E_2.
                found.contains = found.contains.join(&group);
            }
            let rank = found.contains.rank();
            found.dimension.at_least = found.dimension.at_least.max(rank.at_least);
            // A direction that G kills could hide others.
            found.at_most = (space.rank().exact() == Some(dimension)).then_some(dimension);
            found.depth = Some((depth, proof));
            // The subspace lies in G (E_1 ⊕ … ⊕ E_depth): equal dimensions make both equal and G injective there.
            found.dimension.exact = rank.exact() == Some(dimension);
            return;
        }
        found.dimension.at_least = found.dimension.at_least.max(found.contains.rank().at_least);
    }

    /// Whether the witness shows that the leading coefficient changes its direction at a zero, for blocks of length 2 only
    /// (theory §6): a change of sign on a connected piece, or a path that winds around 0.
    fn turns_over(&self, top: &Top, witness: &SurfaceWitness) -> bool {
        let class = &self.spectrum().classes[0].members;
        let blocks = class.iter().flat_map(|m| self.spectrum().factor(*m).blocks.iter());
        top.block == 2
            && blocks.into_iter().all(|b| *b == 2)
            && match witness {
                SurfaceWitness::Points(_) => false,
                SurfaceWitness::SignChange(_) => top.dimension == 1,
                SurfaceWitness::Winding(_) => top.dimension == 2 && class.len() == 1,
            }
    }

    /// Whether every nonzero vector of the group of eigenvalues has the whole group as its cyclic hull.
    fn is_irreducible(&self, class: &[Eigenvalue]) -> bool {
        let simple = class.iter().all(|m| self.spectrum().factor(*m).multiplicity == 1);
        let pair = class.len() == 2 && class.iter().all(|m| !self.spectrum().root(*m).is_real());
        simple && (class.len() == 1 || pair)
    }

    /// `G E` of one group of eigenvalues, and the dimension of `E`.
    fn generalised(&self, class: &[Eigenvalue]) -> (Subspace, usize) {
        let mut space = Subspace::default();
        let mut dimension = 0;
        for (f, roots) in by_factor(class) {
            let factor = &self.spectrum().factors[f];
            dimension += factor.multiplicity * roots.len();
            let vectors: Vec<&[Elem]> = factor.right.iter().flat_map(|c| c.vectors.iter().map(Vec::as_slice)).collect();
            space = space.join(&Subspace::of_vectors(&self.branch.view, factor, &roots, &vectors));
        }
        (space, dimension)
    }

    /// The functionals of `π_depth`.
    fn all_functionals(&self, depth: usize) -> Vec<Functional> {
        let mut out = Vec::new();
        for class in &self.spectrum().classes[..depth] {
            for (f, roots) in by_factor(&class.members) {
                for chain in &self.spectrum().factors[f].left {
                    for vector in &chain.vectors {
                        functionals_at(self.spectrum(), f, &roots, vector, &mut out);
                    }
                }
            }
        }
        out
    }

    /// The directions of the top of the cyclic hull of a point of the ring.
    fn own_directions(&self, offset: &[Rational]) -> Option<Subspace> {
        let hull = krylov(&self.branch.linear, offset);
        let restricted = restrict(&self.branch.linear, &hull)?;
        let spectrum = Spectrum::of(&restricted);
        let own = top(&spectrum)?;
        if spectrum.root(spectrum.classes[0].members[0]).is_zero() {
            return None;
        }
        Some(span_of_ends(&spectrum, &own, &(&self.branch.view * &hull)))
    }

    /// Points where all leading functionals vanish, or a change of sign, or a winding path.
    fn witness(&self, functionals: &[Functional], answer: &RingAnswer) -> Option<SurfaceWitness> {
        match answer {
            RingAnswer::Fails(Witness::Point { address, offset }) => {
                let mut points = vec![(address.clone(), offset.clone())];
                self.more_points(functionals, &mut points);
                Some(SurfaceWitness::Points(points))
            }
            RingAnswer::Fails(witness) => Some(SurfaceWitness::SignChange(witness.clone())),
            RingAnswer::Open { .. } | RingAnswer::Holds(_) => None,
        }
    }

    fn path(&self, functionals: &[Functional]) -> Option<SurfaceWitness> {
        let Some(chart) = self.setting.chart else {
            // Without parameters only pieces that share points are known to be connected.
            let [only] = functionals else { return None };
            return self.ring().connected_sign_change(only).map(SurfaceWitness::SignChange);
        };
        match functionals {
            [only] => {
                // Faces are connected.
                let face = |p: &&RingPiece| self.setting.cx.shape.states[p.end].kind == CellKind::Face;
                let pieces: Vec<RingPiece> = self.seen.iter().filter(face).cloned().collect();
                let ring = Ring { pieces: &pieces, ..self.ring() };
                ring.sign_change_on_piece(only, SIGN_CELLS).map(SurfaceWitness::SignChange)
            }
            // The theorem on products needs no path.
            [_, _] if self.setting.quick => None,
            [a, b] => {
                let pair = [a.clone(), b.clone()];
                winding(chart, self.setting.complex, &self.ring(), &pair).map(SurfaceWitness::Winding)
            }
            _ => None,
        }
    }

    /// Further points with known addresses at which the functionals vanish.
    fn more_points(&self, functionals: &[Functional], points: &mut Vec<(Address, Vec<Rational>)>) {
        let ring = self.ring();
        let bound = ring.chart_bound();
        let approximations: Vec<_> = functionals.iter().map(|f| f.approximate(128)).collect();
        let errors: Vec<Rational> = approximations.iter().map(|(_, e)| e * &bound).collect();
        let rows: Vec<Vec<Rational>> = approximations.iter().map(|(row, _)| ring.row_on_points(row)).collect();
        let mut queue = ring.roots(&rows);
        for _ in 0..self.setting.cx.budget.witness_cells {
            let Some(node) = queue.pop_front() else { return };
            if let Some(Witness::Point { address, offset }) = ring.point_witness(functionals, &node, &errors)
                && !points.iter().any(|(_, known)| *known == offset)
            {
                points.push((address, offset));
            }
            if points.len() >= MAX_WITNESSES {
                return;
            }
            queue.extend(ring.children(&node));
        }
    }
}

/// The factors of a group of eigenvalues with the positions of their roots in it.
fn by_factor(class: &[Eigenvalue]) -> Vec<(usize, Vec<usize>)> {
    let mut out: Vec<(usize, Vec<usize>)> = Vec::new();
    for m in class {
        match out.iter_mut().find(|(f, _)| *f == m.factor) {
            Some((_, roots)) => roots.push(m.root),
            None => out.push((m.factor, vec![m.root])),
        }
    }
    out
}

fn span_of_ends(spectrum: &Spectrum, top: &Top, view: &Matrix) -> Subspace {
    let mut space = Subspace::default();
    for (f, roots) in &top.members {
        let factor = &spectrum.factors[*f];
        let ends: Vec<&[Elem]> =
            factor.right.iter().filter(|c| c.vectors.len() == top.block).map(|c| c.vectors[0].as_slice()).collect();
        space = space.join(&Subspace::of_vectors(view, factor, roots, &ends));
    }
    space
}
