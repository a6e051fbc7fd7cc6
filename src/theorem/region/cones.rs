//! Cones with as many rays as dimensions, which may run with the parameter.

use super::argue::{Arguments, EndGerm, Joint};
use super::curve::{apply, outline};
use super::fact::{CurveClaim, Fact, Why};
use super::signs::{Signs, adjugate, determinant, dot, scaled};
use super::symbol::Symbol;
use crate::answer::Verdict;
use crate::arith::Rational;
use crate::linalg::Matrix;
use crate::shape::Spaces;
use crate::theorem::cone::{CommonCone, ConeAnswer, ConeMap, common_cone};
use crate::theorem::slow::{self, MAX_WINDOW};

/// Steps of a search for constant rays.
const CONE_STEPS: usize = 20_000_000;

/// Which cones are tried, in this order.
#[derive(Debug, Clone, Copy)]
pub(super) enum Rays {
    /// The rays at both ends, in the plane.
    Ends,
    /// The steps from each coordinate to the next.
    Steps,
    /// The axes.
    Axes,
    /// The leading eigenvectors of the outermost pieces one after the other, in the plane.
    Pairs,
    /// Constant rays of a member, by linear programs.
    Found,
}

impl Rays {
    pub const ALL: [Self; 5] = [Self::Ends, Self::Steps, Self::Axes, Self::Pairs, Self::Found];
}

impl<P: Symbol> Arguments<'_, P> {
    /// Rays of a cone, as many as dimensions.
    pub(super) fn rays(
        &self,
        at: &impl Signs<P>,
        kind: Rays,
        germs: &[EndGerm<P>; 2],
        chord: &[P],
    ) -> Option<Vec<Vec<P>>> {
        let (n, last) = (self.family.dim(), self.family.linear.len() - 1);
        let constant = |k: i64| P::number(Rational::from(k));
        let entries = |entry: &dyn Fn(usize, usize) -> i64| -> Vec<Vec<P>> {
            (0..n).map(|k| (0..n).map(|i| constant(entry(k, i))).collect()).collect()
        };
        match kind {
            Rays::Ends => match germs {
                [EndGerm::Line { ray: a, .. }, EndGerm::Line { ray: b, .. }] if n == 2 => {
                    Some(vec![a.clone(), scaled(b, -1)])
                }
                _ => None,
            },
            Rays::Steps => Some(entries(&|k: usize, i: usize| i64::from(i == k) - i64::from(i + 1 == k))),
            Rays::Axes => Some(entries(&|k: usize, i: usize| i64::from(i == k))),
            Rays::Pairs => {
                let ray = |word: [usize; 2]| at.primitive(&apply(&self.leading(at, &word)?.projection, chord));
                if n == 2 { Some(vec![ray([0, last])?, ray([last, 0])?]) } else { None }
            }
            Rays::Found => {
                if !at.is_around() || self.searches.get() == 0 {
                    return None;
                }
                self.searches.set(self.searches.get() - 1);
                let shape = self.family.shape(|f| at.near(f));
                shape.check_curves().ok()?;
                let spaces = Spaces::new(&shape)?;
                let Some(ConeAnswer::Proved(found)) = common_cone(&shape, &spaces, CONE_STEPS) else { return None };
                let rays = &found.cones.first()?.rays;
                let ray = |j: usize| rays.column(j)[1..].iter().map(|q| P::number(q.clone())).collect();
                (rays.cols() == n).then(|| (0..n).map(ray).collect())
            }
        }
    }

    /// What follows from a cone.
    pub(super) fn in_cone(
        &self,
        at: &impl Signs<P>,
        rays: &[Vec<P>],
        chord: &[P],
        germs: &[EndGerm<P>; 2],
        joints: &[Joint<P>],
    ) -> Vec<Fact<P>> {
        let Some(patterns) = self.invariant(at, rays, chord) else { return Vec::new() };
        let mut facts = Vec::new();
        let weak = at.clone();
        // Every difference from an end goes on within the cone, so that the leading coefficient stays positive.
        let end = |germ: &EndGerm<P>| match germ {
            EndGerm::Line { row, positive: true, forward, .. } => {
                rays.iter().all(|r| weak.sign(&dot(row, r)) * forward >= 0)
            }
            _ => false,
        };
        let ends = germs.iter().all(end);
        let lines =
            joints.iter().all(|j| matches!((&j.left, &j.right), (Some((a, _)), Some((b, _))) if weak.parallel(a, b)));
        let injective = self.family.linear.iter().all(|m| weak.sign(&determinant(m)) != 0);
        if ends {
            facts.extend(Fact::of(&weak, CurveClaim::Ends, Verdict::Proved, Why::InCone));
            if lines && injective {
                facts.extend(Fact::of(&weak, CurveClaim::Joints, Verdict::Proved, Why::InCone));
            }
        }
        let strict = at.clone();
        let regular = joints.iter().all(|j| match (&j.left, &j.right) {
            (Some((a, true)), Some((b, true))) => strict.parallel(a, b) && strict.sign(&dot(a, b)) < 0,
            _ => false,
        });
        let shrinks = regular.then(|| self.shrinks(&strict, rays, &patterns)).flatten();
        let weak_facts = facts.len();
        if let Some((window, cycles)) = &shrinks {
            let slow = *window > 1 || !cycles.is_empty();
            facts.extend(Fact::of(&strict, CurveClaim::G1, Verdict::Proved, Why::Cones { slow }));
            if !ends {
                facts.extend(Fact::of(&strict, CurveClaim::Ends, Verdict::Proved, Why::Cones { slow }));
            }
            if !(ends && lines) && self.family.linear.iter().all(|m| strict.sign(&determinant(m)) != 0) {
                facts.extend(Fact::of(&strict, CurveClaim::Joints, Verdict::Proved, Why::Cones { slow }));
            }
        }
        for (k, fact) in facts.iter_mut().enumerate() {
            fact.evidence.rays = rays.to_vec();
            if let (Some((window, cycles)), true) = (&shrinks, k >= weak_facts) {
                (fact.evidence.window, fact.evidence.cycles) = (*window, cycles.clone());
            }
        }
        facts
    }

    /// `ε T_i G = G B_i` with `B_i ≥ 0`, without columns 0, and the chord in the cone: which entries are positive, by letter.
    fn invariant(&self, at: &impl Signs<P>, rays: &[Vec<P>], chord: &[P]) -> Option<Vec<Matrix>> {
        let n = chord.len();
        let cone = Matrix::from_fn(n, n, |i, j| rays[j][i].clone());
        let det = at.sign(&determinant(&cone));
        if det == 0 {
            return None;
        }
        let chi = cone.char_poly_over(&P::ring());
        // adj(−G) = (−1)^(n−1) adj(G).
        let turned = if n.is_multiple_of(2) { -det } else { det };
        let inverse = adjugate(&cone, &chi, &P::nought()).map(|f| f.multiple(&Rational::from(turned)));
        if apply(&inverse, chord).iter().any(|c| at.sign(c) < 0) {
            return None;
        }
        let mut patterns = Vec::new();
        for (l, m) in self.family.linear.iter().enumerate() {
            let b = inverse.mul_over(&P::ring(), m).mul_over(&P::ring(), &cone);
            let mut signs = Matrix::zero(n, n);
            for i in 0..n {
                for j in 0..n {
                    let sign = at.sign(&b[(i, j)]) * self.family.sign(&[l]);
                    if sign < 0 {
                        return None;
                    }
                    signs[(i, j)] = Rational::from(sign);
                }
            }
            if (0..n).any(|j| signs.column(j).iter().all(|x| *x == 0)) {
                return None;
            }
            patterns.push(signs);
        }
        Some(patterns)
    }

    /// Why the cones shrink to rays along every address: the window, and the cycles without positive products.
    fn shrinks(
        &self,
        at: &impl Signs<P>,
        rays: &[Vec<P>],
        patterns: &[Matrix],
    ) -> Option<(usize, Vec<(Vec<usize>, P)>)> {
        let map = |(letter, m): (usize, &Matrix)| ConeMap {
            state: 0,
            letter,
            sign: self.family.sign(&[letter]),
            matrix: m.clone(),
        };
        let maps: Vec<ConeMap> = patterns.iter().enumerate().map(map).collect();
        let cone = CommonCone { cones: Vec::new(), maps, view: None, window: 1, slow: Vec::new(), rate: None };
        let shape = outline(&self.family.reversed);
        (1..=MAX_WINDOW).find_map(|window| {
            let cycles = slow::cycles(&cone, &shape, window)?;
            let own = cycles.into_iter().map(|(_, word)| Some((word.clone(), self.pulls(at, rays, &word)?)));
            Some((window, own.collect::<Option<Vec<_>>>()?))
        })
    }

    /// The leading eigenvalue of a cycle that pulls all rays to one.
    fn pulls(&self, at: &impl Signs<P>, rays: &[Vec<P>], word: &[usize]) -> Option<P> {
        let lead = self.leading(at, word)?;
        if lead.positive != (self.family.sign(word) > 0) {
            return None;
        }
        let images: Vec<Vec<P>> = rays.iter().map(|r| apply(&lead.projection, r)).collect();
        // The images are multiples of one vector; a ray of a longer chain may lie on it itself.
        let first = images.iter().find(|v| v.iter().any(|x| !x.vanishes()))?;
        let (k, sign) = first.iter().enumerate().map(|(k, x)| (k, at.sign(x))).find(|(_, s)| *s != 0)?;
        let pulled = |(ray, image): (&Vec<P>, &Vec<P>)| {
            if image.iter().all(P::vanishes) {
                return at.parallel(ray, first) && at.sign(&dot(ray, first)) > 0;
            }
            at.sign(&image[k]) == sign
        };
        rays.iter().zip(&images).all(pulled).then_some(lead.value)
    }
}
