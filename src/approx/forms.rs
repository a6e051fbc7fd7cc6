//! Proposals for quadratic forms that operators expand: semidefinite programs by a barrier method. Nothing here is a proof.
//!
//! Solvers of semidefinite programs need LAPACK, which would be the only library here that is not written in Rust; the programs are
//! small and dense, and a form that is merely feasible is enough.
#![allow(clippy::float_arithmetic, reason = "proposes forms, exact arithmetic checks them")]

use nalgebra::{Cholesky, DMatrix, DVector, Dyn, Schur};

type Dense = DMatrix<f64>;

/// An operator `T` from the space of `to` to that of `from`, row after row.
pub struct FormArrow {
    /// Where it leads.
    pub from: usize,
    /// Where it comes from.
    pub to: usize,
    /// The operator.
    pub map: Vec<f64>,
}

/// Forms `q` of signature (2, ·) with `Tᵗ q_from T − κ q_to` positive definite for all arrows, positive on some vectors.
pub struct FormProblem {
    /// The dimensions of the spaces.
    pub dims: Vec<usize>,
    /// By space: the scalar products of its basis, row after row.
    pub products: Vec<Vec<f64>>,
    /// The operators.
    pub arrows: Vec<FormArrow>,
    /// By space: vectors on which the form is to be positive.
    pub secants: Vec<Vec<Vec<f64>>>,
}

/// Forms, row after row, and the `κ` of all arrows.
#[derive(Debug, Clone)]
pub struct ProposedForms {
    /// By space.
    pub forms: Vec<Vec<f64>>,
    /// By arrow.
    pub ratios: Vec<f64>,
}

/// Most vectors that are taken of each space.
const SECANTS: usize = 150;
/// Arrows keep this part of the room that is kept on the vectors.
const ARROWS: f64 = 0.002;
/// Steps of the method.
const STEPS: usize = 100;
/// Where it begins, by how much it is sharpened each time, where a form with some room is good enough, and where it ends.
const SHARP: [f64; 4] = [1_000.0, 10.0, 10_000.0, 10_000_000.0];
/// The square of the length of Newton's step below which it is sharpened.
const NEAR: f64 = 3.0;

impl FormProblem {
    /// Forms for some choices of `κ` in the window between the third and the second growth, the likeliest first, or spaces that lead to
    /// one another for which there are none. They are looked for in orthonormal coordinates.
    pub fn proposals(&self) -> impl Iterator<Item = Result<ProposedForms, Vec<usize>>> {
        let normal = self.orthonormal();
        [0.5, 0.75, 0.25].into_iter().filter_map(move |part| {
            let (problem, factors) = normal.as_ref()?;
            let mut found = match problem.proposal(part) {
                Ok(found) => found,
                Err(component) => return Some(Err(component)),
            };
            for (form, l) in found.forms.iter_mut().zip(factors) {
                let back = l * Dense::from_column_slice(l.nrows(), l.nrows(), form) * l.transpose();
                // It is symmetric: columns are rows.
                *form = back.as_slice().to_vec();
            }
            Some(Ok(found))
        })
    }

    /// The same problem in the coordinates `Lᵗ v`, where `L Lᵗ` are the scalar products, and all `L`.
    fn orthonormal(&self) -> Option<(Self, Vec<Dense>)> {
        let square = |(&d, m): (&usize, &Vec<f64>)| Some(Dense::from_row_slice(d, d, m).cholesky()?.l());
        let factors: Vec<Dense> = self.dims.iter().zip(&self.products).map(square).collect::<Option<_>>()?;
        let arrow = |a: &FormArrow| {
            let map = Dense::from_row_slice(self.dims[a.from], self.dims[a.to], &a.map);
            // Rows of the new map are the columns of its transpose.
            let turned = factors[a.to].solve_lower_triangular(&(map.transpose() * &factors[a.from]))?;
            Some(FormArrow { from: a.from, to: a.to, map: turned.as_slice().to_vec() })
        };
        let secants =
            self.secants.iter().zip(&factors).map(|(all, l)| {
                all.iter().map(|v| l.tr_mul(&DVector::from_column_slice(v)).as_slice().to_vec()).collect()
            });
        let unit = |d: &usize| Dense::identity(*d, *d).as_slice().to_vec();
        let problem = Self {
            dims: self.dims.clone(),
            products: self.dims.iter().map(unit).collect(),
            arrows: self.arrows.iter().map(arrow).collect::<Option<_>>()?,
            secants: secants.collect(),
        };
        Some((problem, factors))
    }

    fn proposal(&self, part: f64) -> Result<ProposedForms, Vec<usize>> {
        let mut forms: Vec<Option<Dense>> = vec![None; self.dims.len()];
        let mut ratios = vec![0.0; self.arrows.len()];
        while let Some(component) = self.next_component(&forms) {
            self.of_component(&component, part, &mut forms, &mut ratios).ok_or(component)?;
        }
        // They are symmetric: columns are rows.
        let forms = forms.into_iter().flatten().map(|q| q.as_slice().to_vec()).collect();
        Ok(ProposedForms { forms, ratios })
    }

    fn of_component(
        &self,
        component: &[usize],
        part: f64,
        forms: &mut [Option<Dense>],
        ratios: &mut [f64],
    ) -> Option<()> {
        let ratio = self.window(component, part)?;
        let mut program = Program::new(self, component, ratio, forms);
        let x = program.solve()?;
        for (k, &s) in component.iter().enumerate() {
            forms[s] = Some(program.form(&x, k));
        }
        for (a, arrow) in self.arrows.iter().enumerate().filter(|(_, a)| component.contains(&a.from)) {
            ratios[a] = if component.contains(&arrow.to) { ratio } else { program.outer(&x, a)? };
        }
        Some(())
    }

    /// Spaces that lead to one another, all of whose other successors have their forms.
    fn next_component(&self, known: &[Option<Dense>]) -> Option<Vec<usize>> {
        let reached = |from: usize| {
            let mut seen = vec![from];
            let mut next = 0;
            while next < seen.len() {
                let here = seen[next];
                for arrow in self.arrows.iter().filter(|a| a.from == here) {
                    if known[arrow.to].is_none() && !seen.contains(&arrow.to) {
                        seen.push(arrow.to);
                    }
                }
                next += 1;
            }
            seen
        };
        let open: Vec<usize> = (0..self.dims.len()).filter(|&s| known[s].is_none()).collect();
        let mut component = open.into_iter().map(reached).min_by_key(Vec::len)?;
        component.sort_unstable();
        Some(component)
    }

    /// A number between the squares of the third and of the second largest modulus of all operators of the component that lead
    /// back to their space; `None` where there is no room.
    fn window(&self, component: &[usize], part: f64) -> Option<f64> {
        let (mut low, mut high) = (0.0_f64, 1.0_f64);
        for arrow in self.arrows.iter().filter(|a| a.from == a.to && component.contains(&a.from)) {
            let moduli = moduli(&arrow.map, self.dims[arrow.from])?;
            high = high.min(moduli.get(1)?.powi(2));
            low = low.max(moduli.get(2).copied().unwrap_or(0.0).powi(2));
        }
        let low = low.max(high / 64.0);
        // Eigenvalues that are equal differ by rounding.
        (low * 1.01 < high).then(|| short(low.powf(1.0 - part) * high.powf(part)))
    }
}

/// The number with 20 binary places, as it will be used.
fn short(x: f64) -> f64 {
    (x * 1_048_576.0).floor() / 1_048_576.0
}

fn moduli(map: &[f64], n: usize) -> Option<Vec<f64>> {
    let schur = Schur::try_new(DMatrix::from_row_slice(n, n, map), 1e-13, 60 * n.max(1))?;
    let mut moduli: Vec<f64> = schur.complex_eigenvalues().iter().map(|z| z.norm()).collect();
    moduli.sort_by(|a, b| b.total_cmp(a));
    Some(moduli)
}

/// What an arrow of the program asks for: `Tᵗ q T − κ q'` with `q'` a variable and `κ` a number, or the other way round.
struct Block {
    from: usize,
    map: Dense,
    to: To,
}

enum To {
    Inner(usize, f64),
    Outer { form: Dense, variable: usize, arrow: usize },
}

/// The largest `t` with `−1 ≤ q ≤ 1` for all forms, `q(v) ≥ t` on unit vectors, and `ARROWS t` in all blocks.
struct Program {
    dims: Vec<usize>,
    offsets: Vec<usize>,
    pairs: Vec<Vec<(usize, usize)>>,
    blocks: Vec<Block>,
    /// The unit vectors as columns.
    secants: Vec<Dense>,
    variables: usize,
}

impl Program {
    fn new(problem: &FormProblem, component: &[usize], ratio: f64, known: &[Option<Dense>]) -> Self {
        let dims: Vec<usize> = component.iter().map(|&s| problem.dims[s]).collect();
        let pairs: Vec<Vec<(usize, usize)>> =
            dims.iter().map(|&d| (0..d).flat_map(|i| (i..d).map(move |j| (i, j))).collect()).collect();
        let mut offsets = vec![0];
        for own in &pairs {
            offsets.push(offsets[offsets.len() - 1] + own.len());
        }
        let mut variables = offsets[offsets.len() - 1];
        let mut blocks = Vec::new();
        let place = |s: usize| component.iter().position(|k| *k == s);
        for (a, arrow) in problem.arrows.iter().enumerate() {
            let Some(from) = place(arrow.from) else { continue };
            let map = Dense::from_row_slice(problem.dims[arrow.from], problem.dims[arrow.to], &arrow.map);
            let to = match (place(arrow.to), &known[arrow.to]) {
                (Some(to), _) => To::Inner(to, ratio),
                (None, Some(form)) => {
                    variables += 1;
                    To::Outer { form: form.clone(), variable: variables - 1, arrow: a }
                }
                (None, None) => continue,
            };
            blocks.push(Block { from, map, to });
        }
        let secants = component.iter().map(|&s| unit_vectors(problem.dims[s], &problem.secants[s])).collect();
        Self { dims, offsets, pairs, blocks, secants, variables: variables + 1 }
    }

    fn form(&self, x: &[f64], s: usize) -> Dense {
        let mut q = Dense::zeros(self.dims[s], self.dims[s]);
        for (&(i, j), &value) in self.pairs[s].iter().zip(&x[self.offsets[s]..]) {
            q[(i, j)] = value;
            q[(j, i)] = value;
        }
        q
    }

    fn outer(&self, x: &[f64], wanted: usize) -> Option<f64> {
        self.blocks.iter().find_map(|b| match &b.to {
            To::Outer { variable, arrow, .. } if *arrow == wanted => Some(short(x[*variable])),
            _ => None,
        })
    }

    /// The matrix of a block, minus its part of `t`.
    fn matrix(&self, block: &Block, forms: &[Dense], x: &[f64]) -> Dense {
        let m = block.map.tr_mul(&forms[block.from]) * &block.map;
        let m = match &block.to {
            To::Inner(to, ratio) => m - *ratio * &forms[*to],
            To::Outer { form, variable, .. } => m - x[*variable] * form,
        };
        shifted(m, -ARROWS * x[self.variables - 1])
    }

    fn value(&self, x: &[f64], sharp: f64) -> Option<f64> {
        let forms: Vec<Dense> = (0..self.dims.len()).map(|s| self.form(x, s)).collect();
        let t = x[self.variables - 1];
        let mut sum = -sharp * t;
        let mut log = |m: Dense| -> Option<()> {
            sum -= m.cholesky()?.ln_determinant();
            Some(())
        };
        for block in &self.blocks {
            log(self.matrix(block, &forms, x))?;
        }
        for q in &forms {
            for sign in [1.0, -1.0] {
                log(shifted(sign * q, 1.0))?;
            }
        }
        for block in &self.blocks {
            if let To::Outer { variable, .. } = block.to {
                sum -= positive(x[variable])?.ln();
            }
        }
        for (q, vectors) in forms.iter().zip(&self.secants) {
            for value in values(q, vectors) {
                sum -= positive(value - t)?.ln();
            }
        }
        Some(sum)
    }

    /// Newton's step, and half of the square of its length.
    fn step(&self, x: &[f64], sharp: f64) -> Option<(Vec<f64>, f64)> {
        let n = self.variables;
        let forms: Vec<Dense> = (0..self.dims.len()).map(|s| self.form(x, s)).collect();
        let mut newton = Newton { program: self, slope: vec![0.0; n], bend: Dense::zeros(n, n) };
        newton.slope[n - 1] = -sharp;
        for block in &self.blocks {
            newton.block(block, &self.matrix(block, &forms, x).cholesky()?.inverse(), x);
        }
        for (s, q) in forms.iter().enumerate() {
            for sign in [1.0, -1.0] {
                let z = shifted(sign * q, 1.0).cholesky()?.inverse();
                newton.slope_of(s, -sign, &z);
                newton.bend_of(s, s, 1.0, &z);
            }
            newton.vectors(s, q, x[n - 1]);
        }
        let Newton { slope, bend, .. } = newton;
        // What is read lies on and below the diagonal.
        let factor: Cholesky<f64, Dyn> = bend.transpose().cholesky()?;
        let step: Vec<f64> = factor.solve(&DVector::from_column_slice(&slope)).iter().map(|d| -d).collect();
        let gain = -step.iter().zip(&slope).map(|(d, g)| d * g).sum::<f64>();
        Some((step, gain))
    }

    /// `None` where there is no form with room.
    fn solve(&mut self) -> Option<Vec<f64>> {
        let mut x = vec![0.0; self.variables];
        x[self.variables - 1] = -1.0;
        for block in &self.blocks {
            if let To::Outer { variable, .. } = block.to {
                x[variable] = ARROWS / 4.0;
            }
        }
        // A form that is 0 leaves −κ q' in an outer block.
        while self.value(&x, 1.0).is_none() {
            x[self.variables - 1] *= 2.0;
            (x[self.variables - 1] > -1e9).then_some(())?;
        }
        let count: usize = self.blocks.iter().map(|b| b.map.ncols() + 1).sum::<usize>()
            + 2 * self.dims.iter().sum::<usize>()
            + self.secants.iter().map(DMatrix::ncols).sum::<usize>();
        let mut sharp = SHARP[0];
        let mut steps = 0;
        loop {
            let before = self.value(&x, sharp)?;
            let (step, gain) = self.step(&x, sharp)?;
            let mut part = 1.0;
            let moved = loop {
                crate::stop::check();
                let next: Vec<f64> = x.iter().zip(&step).map(|(x, d)| x + part * d).collect();
                if self.value(&next, sharp).is_some_and(|v| v <= before - 0.1 * part * gain) {
                    break next;
                }
                part /= 2.0;
                (part > 1e-9).then_some(())?;
            };
            x = moved;
            steps += 1;
            if gain >= NEAR && steps < STEPS {
                continue;
            }
            let t = x[self.variables - 1];
            if t > 0.0 && sharp >= SHARP[2] {
                return Some(x);
            }
            // What is best is about `count / sharp` above at most.
            if steps >= STEPS || sharp >= SHARP[3] || t + 4.0 * count as f64 / sharp < 0.0 {
                return None;
            }
            sharp *= SHARP[1];
        }
    }
}

fn positive(x: f64) -> Option<f64> {
    (x > 0.0).then_some(x)
}

/// Some of the vectors, of length 1.
fn unit_vectors(dim: usize, all: &[Vec<f64>]) -> Dense {
    let step = all.len().div_ceil(SECANTS).max(1);
    let unit = |v: &Vec<f64>| DVector::from_column_slice(v).try_normalize(0.0);
    let columns: Vec<DVector<f64>> = all.iter().step_by(step).filter_map(unit).collect();
    Dense::from_fn(dim, columns.len(), |i, k| columns[k][i])
}

/// The values of a form on the columns.
fn values(q: &Dense, vectors: &Dense) -> Vec<f64> {
    let images = q * vectors;
    vectors.column_iter().zip(images.column_iter()).map(|(v, image)| v.dot(&image)).collect()
}

/// The matrix plus a multiple of the identity.
fn shifted(mut m: Dense, by: f64) -> Dense {
    (0..m.nrows()).for_each(|i| m[(i, i)] += by);
    m
}

/// The first and the second derivative of the barrier; of the second one only what lies on and above the diagonal.
struct Newton<'a> {
    program: &'a Program,
    slope: Vec<f64>,
    bend: Dense,
}

impl Newton<'_> {
    /// Adds `factor g` for the variables of a form.
    fn slope_of(&mut self, s: usize, factor: f64, g: &Dense) {
        let (program, from) = (self.program, self.program.offsets[s]);
        for (&(i, j), x) in program.pairs[s].iter().zip(&mut self.slope[from..]) {
            *x += factor * if i == j { g[(i, j)] } else { 2.0 * g[(i, j)] };
        }
    }

    /// Adds `factor tr(E a E' aᵗ)` for the unit forms `E` of `s` and `E'` of `r`, where `s ≥ r`.
    fn bend_of(&mut self, s: usize, r: usize, factor: f64, a: &Dense) {
        let (program, top, left) = (self.program, self.program.offsets[s], self.program.offsets[r]);
        for (p, &(i, j)) in program.pairs[s].iter().enumerate() {
            let own = if i == j { factor } else { 2.0 * factor };
            let width = if s == r { p + 1 } else { program.pairs[r].len() };
            let mut line = self.bend.view_mut((left, top + p), (width, 1));
            for (x, &(k, l)) in line.iter_mut().zip(&program.pairs[r]) {
                let both = a[(i, k)] * a[(j, l)] + a[(i, l)] * a[(j, k)];
                *x += if k == l { 0.5 * own * both } else { own * both };
            }
        }
    }

    /// Adds `factor tr(E a)` between the variables of a form and a later variable.
    fn beside(&mut self, s: usize, variable: usize, factor: f64, a: &Dense) {
        let (program, from) = (self.program, self.program.offsets[s]);
        let mut line = self.bend.view_mut((from, variable), (program.pairs[s].len(), 1));
        for (&(i, j), x) in program.pairs[s].iter().zip(line.iter_mut()) {
            *x += factor * if i == j { a[(i, j)] } else { 2.0 * a[(i, j)] };
        }
    }

    fn block(&mut self, block: &Block, z: &Dense, x: &[f64]) {
        let t = self.program.variables - 1;
        let from = block.from;
        let tz = &block.map * z;
        let g = &tz * block.map.transpose();
        self.slope_of(from, -1.0, &g);
        self.bend_of(from, from, 1.0, &g);
        self.beside(from, t, -ARROWS, &(&tz * tz.transpose()));
        let zz = z * z;
        self.slope[t] += ARROWS * z.trace();
        self.bend[(t, t)] += ARROWS * ARROWS * zz.trace();
        match &block.to {
            To::Inner(to, ratio) => {
                self.slope_of(*to, *ratio, z);
                self.bend_of(*to, *to, ratio * ratio, z);
                self.beside(*to, t, ARROWS * ratio, &zz);
                match from.cmp(to) {
                    std::cmp::Ordering::Equal => {
                        self.bend_of(from, from, -ratio, &tz);
                        self.bend_of(from, from, -ratio, &tz.transpose());
                    }
                    std::cmp::Ordering::Greater => self.bend_of(from, *to, -ratio, &tz),
                    std::cmp::Ordering::Less => self.bend_of(*to, from, -ratio, &tz.transpose()),
                }
            }
            To::Outer { form, variable, .. } => {
                let zf = z * form;
                let (value, zfz) = (x[*variable], &zf * z);
                self.slope[*variable] += zf.trace() - 1.0 / value;
                self.bend[(*variable, *variable)] += (&zf * &zf).trace() + 1.0 / (value * value);
                self.bend[(*variable, t)] += ARROWS * zfz.trace();
                let seen = &block.map * &zfz * block.map.transpose();
                self.beside(from, *variable, -1.0, &seen);
            }
        }
    }

    fn vectors(&mut self, s: usize, q: &Dense, t: f64) {
        let (program, from, last) = (self.program, self.program.offsets[s], self.program.variables - 1);
        let vectors = &program.secants[s];
        for (v, value) in vectors.column_iter().zip(values(q, vectors)) {
            let room = value - t;
            let one = |&(i, j): &(usize, usize)| if i == j { v[i] * v[j] / room } else { 2.0 * v[i] * v[j] / room };
            let row: Vec<f64> = program.pairs[s].iter().map(one).collect();
            for (p, &a) in row.iter().enumerate() {
                self.slope[from + p] -= a;
                let mut line = self.bend.view_mut((from, from + p), (p + 1, 1));
                line.iter_mut().zip(&row).for_each(|(x, b)| *x += a * b);
            }
            let mut line = self.bend.view_mut((from, last), (row.len(), 1));
            line.iter_mut().zip(&row).for_each(|(x, a)| *x -= a / room);
            self.slope[last] += 1.0 / room;
            self.bend[(last, last)] += 1.0 / (room * room);
        }
    }
}
