//! Tensor products by their own theorem (theory §9).

use super::branch::Setting;
use super::span::Subspace;
use super::verdict::{ProductEvidence, ProductFactor, SurfacePoint};
use crate::algebraic::Elem;
use crate::arith::Rational;
use crate::budget::Budget;
use crate::jordan::Over;
use crate::linalg::Matrix;
use crate::shape::{Address, Balls, CellKind, Complex, Contraction, Layout, ProductContraction, Shape, Spaces, norm1};
use crate::theorem::{
    Certified, Context, Dimension, Direction, PlaneGap, PointReport, Statement, Verdict, Viewpoint, point,
    rational_contraction,
};
use std::cell::{OnceCell, RefCell};
use std::collections::BTreeMap;

/// A curve ready for examining points, with those examined so far.
struct Factor {
    shape: Shape,
    contraction: Contraction,
    spaces: Spaces,
    balls: Balls,
    hulls: OnceCell<Option<Balls>>,
    known: RefCell<BTreeMap<Address, Option<PointReport>>>,
    budget: Budget,
}

impl Factor {
    /// `None` where the curve is none, a cell of it may be a point, or it is not known to contract. (Where a cell is a point the curve
    /// is constant along it, and the tangent subspace of the product is that of the other curve.)
    fn new(shape: &Shape, budget: &Budget) -> Option<Self> {
        shape.check().ok()?;
        let (found, _) = rational_contraction(shape, budget).ok()?;
        shape.check_curves().ok()?;
        let spaces = Spaces::new(shape)?;
        shape.solid_cells(&spaces)?;
        let balls = Balls::of(shape, &spaces, &found)?;
        Some(Self {
            shape: shape.clone(),
            contraction: found,
            spaces,
            balls,
            hulls: OnceCell::new(),
            known: RefCell::default(),
            budget: budget.clone(),
        })
    }

    /// A point of the curve, its 1-norm, and the radius of a ball about it that holds the curve.
    fn ball(&self) -> (&[Rational], Rational, &Rational) {
        let base = &self.spaces.of(self.shape.start).base;
        (base, norm1(base), self.balls.radius(self.shape.start))
    }

    fn context(&self) -> Context<'_> {
        let Self { shape, spaces, balls, hulls, budget, .. } = self;
        Context { shape, base: &(), spaces, balls, hulls, from: Viewpoint::start(shape), budget }
    }

    fn evidence(&self) -> ProductFactor {
        let radius = |e: usize| (e, self.balls.radius(e).clone());
        ProductFactor {
            shape: self.shape.clone(),
            contraction: self.contraction.clone(),
            states: self.shape.reachable().into_iter().map(radius).collect(),
            polygons: self.context().polygons(),
        }
    }

    fn point(&self, address: &Address) -> Option<PointReport> {
        let address = address.normalise(&self.shape, self.shape.start).ok()?;
        if let Some(known) = self.known.borrow().get(&address) {
            return known.clone();
        }
        let cx = self.context();
        let found = point::address_spec(&cx, &address).and_then(|spec| point::examine_point(&cx, &spec));
        self.known.borrow_mut().insert(address, found.clone());
        found
    }
}

/// The two curves of a product.
pub struct Product {
    first: Factor,
    second: Factor,
}

impl Product {
    /// The curves that a patch is the product of, where they can be examined.
    pub fn of(complex: &Complex, budget: &Budget) -> Option<Self> {
        let (first, second) = factors(complex)?;
        Some(Self { first: Factor::new(&first, budget)?, second: Factor::new(&second, budget)? })
    }

    /// Both curves, and why they contract.
    pub fn factors(&self) -> [ProductFactor; 2] {
        [self.first.evidence(), self.second.evidence()]
    }

    /// What is found of every point of both curves; `None` where one of them is refused.
    pub fn everywhere(&self) -> Option<[Certified; 2]> {
        let certify = |f: &Factor| crate::theorem::certify_within(&f.shape, &[], &f.budget).ok();
        let first = certify(&self.first)?;
        let ops = |f: &Factor| f.shape.states[f.shape.start].pieces.iter().map(|p| p.op.clone()).collect::<Vec<_>>();
        let same = ops(&self.first) == ops(&self.second);
        let second = if same { first.clone() } else { certify(&self.second)? };
        Some([first, second])
    }

    /// Why the product contracts, and a ball that holds it: `|x ⊗ y − a ⊗ b| ≤ |x − a| |y| + |a| |y − b|`.
    pub fn contraction(&self) -> ProductContraction {
        let ((a, size, r), (b, other, s)) = (self.first.ball(), self.second.ball());
        ProductContraction {
            factors: Box::new([self.first.contraction.clone(), self.second.contraction.clone()]),
            centre: a.iter().flat_map(|x| b.iter().map(move |y| x * y)).collect(),
            radius: r * (other + s) + size * s,
        }
    }

    /// The theorem at the point with an address; `view` is the matrix of the control points (or the identity).
    fn point(&self, address: &Address, view: &Matrix) -> Option<ProductEvidence> {
        let (s, t) = parts(address, self.first.shape.states[self.first.shape.start].pieces.len());
        Some(conclude(self.first.point(&s)?, self.second.point(&t)?, view))
    }
}

/// The two curves of a patch that is a tensor product of two curves of one state each, `p(u, v) = a(u) ⊗ b(v)`.
///
/// Column sums of 1 make the factors unique: `A` has the sums over the blocks of rows of `A ⊗ B`, in any column of a block.
/// Returns `None` where the patch is no such product, or a factor is no curve.
#[must_use]
pub fn factors(complex: &Complex) -> Option<(Shape, Shape)> {
    let shape = &complex.shape;
    let [start] = shape.reachable()[..] else { return None };
    let state = &shape.states[start];
    let face = complex.faces.get(&start)?;
    let Layout::Quad { columns, rows } = face.layout else { return None };
    let plain = |p: &Vec<usize>| p.iter().enumerate().all(|(k, c)| k == *c);
    if !face.placement.iter().all(plain) || state.pieces.len() != columns * rows {
        return None;
    }
    (2..state.dim).filter(|n| state.dim.is_multiple_of(*n)).find_map(|n| {
        let ops: Vec<(Matrix, Matrix)> =
            state.pieces.iter().map(|p| split(&p.op, n, state.dim / n)).collect::<Option<_>>()?;
        let product =
            |(k, (a, b)): (usize, &(Matrix, Matrix))| *a == ops[k % columns].0 && *b == ops[k - k % columns].1;
        if !ops.iter().enumerate().all(product) {
            return None;
        }
        let first = (0..columns).map(|i| ops[i].0.clone()).collect();
        let second = (0..rows).map(|j| ops[j * columns].1.clone()).collect();
        let curve = |ops| Shape::single(CellKind::Edge, ops);
        let (a, b) = (curve(first), curve(second));
        (a.check_curves().is_ok() && b.check_curves().is_ok()).then_some((a, b))
    })
}

/// The factors of a Kronecker product of an `n x n` and an `m x m` matrix with column sums 1.
fn split(op: &Matrix, n: usize, m: usize) -> Option<(Matrix, Matrix)> {
    if (op.rows(), op.cols()) != (n * m, n * m) {
        return None;
    }
    let sum = |terms: &mut dyn Iterator<Item = usize>, at: &dyn Fn(usize) -> (usize, usize)| {
        terms.fold(Rational::from(0), |s, k| s + &op[at(k)])
    };
    let a = Matrix::from_fn(n, n, |i, j| sum(&mut (0..m), &|k| (i * m + k, j * m)));
    let b = Matrix::from_fn(m, m, |i, j| sum(&mut (0..n), &|k| (k * m + i, j)));
    let product = |r: usize, c: usize| &a[(r / m, c / m)] * &b[(r % m, c % m)];
    let fits = (0..n * m).all(|r| (0..n * m).all(|c| op[(r, c)] == product(r, c)));
    fits.then_some((a, b))
}

/// The addresses of the two parameters of an address of a product with `columns` pieces along the first one.
fn parts(address: &Address, columns: usize) -> (Address, Address) {
    let part = |of: &dyn Fn(usize) -> usize| Address {
        prefix: address.prefix.iter().map(|&l| of(l)).collect(),
        cycle: address.cycle.iter().map(|&l| of(l)).collect(),
    };
    (part(&|l| l % columns), part(&|l| l / columns))
}

/// The theorem on tensor products at the point with an address, for the product of two curves that start at one state each;
/// `view` is the matrix of the control points (or the identity).
///
/// Returns `None` where a curve is not certified: it does not contract, is a point, or the address is not decided.
#[must_use]
pub fn product_point(first: &Shape, second: &Shape, address: &Address, view: &Matrix) -> Option<ProductEvidence> {
    let budget = Budget::default();
    Product { first: Factor::new(first, &budget)?, second: Factor::new(second, &budget)? }.point(address, view)
}

fn conclude(a: PointReport, b: PointReport, view: &Matrix) -> ProductEvidence {
    let mut evidence = ProductEvidence { verdict: Verdict::Undetermined, tangent: None, first: a, second: b };
    let (a, b) = (&evidence.first, &evidence.second);
    if let (Some(x), Some(y)) = (&a.tangent, &b.tangent) {
        let line = |d: &Direction, coords: Vec<Elem>| Direction {
            root: d.root.clone(),
            coords: crate::theorem::branch::apply(view, &coords, Over { modulus: d.root.minpoly(), alpha: None }),
        };
        let along = x.coords.iter().flat_map(|e| b.position.iter().map(move |q| e.scale(q))).collect();
        let up = a.position.iter().flat_map(|q| y.coords.iter().map(move |e| e.scale(q))).collect();
        let plane = Subspace { generators: vec![line(x, along), line(y, up)] }.reduced();
        if plane.rank().exact() == Some(2) {
            evidence.verdict = Verdict::Proved;
            evidence.tangent = Some(plane);
        }
    } else if (a.verdict == Verdict::Refuted || b.verdict == Verdict::Refuted) && view.rank() == view.cols() {
        evidence.verdict = Verdict::Refuted;
    }
    evidence
}

/// Adds the theorem on tensor products to a point; it decides where the general one does not, and must agree where it does.
pub fn add(point: &mut SurfacePoint, product: &Product, setting: &Setting) {
    let Some(address) = point.branches.first().map(|b| b.address.clone()) else { return };
    let Some(evidence) = product.point(&address, setting.cx.from.map()) else { return };
    let decided = |v: Verdict| v != Verdict::Undetermined;
    let agree = match (&point.tangent, &evidence.tangent) {
        (Some(a), Some(b)) => a.same(b) != Some(false),
        _ => !(decided(point.verdict) && decided(evidence.verdict)) || point.verdict == evidence.verdict,
    };
    if !agree {
        point.verdict = Verdict::Undetermined;
        point.reason = Some(PlaneGap::Contradiction);
    } else if !decided(point.verdict) && decided(evidence.verdict) {
        point.verdict = evidence.verdict;
        point.statement = Some(Statement::TensorProduct);
        point.reason = None;
        if evidence.verdict == Verdict::Proved {
            point.dimension = Dimension { at_least: 2, exact: true };
            point.tangent.clone_from(&evidence.tangent);
        } else {
            point.dimension.at_least = point.dimension.at_least.max(3);
            point.reason = Some(PlaneGap::ProductCurve);
        }
    }
    point.product = Some(evidence);
}
