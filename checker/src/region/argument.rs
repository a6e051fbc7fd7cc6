//! Arguments about a curve with a parameter on a part of its range: signs of polynomials that have no zero there.

use super::curve::Family;
use super::polynomial::{End, Poly, is_free, minus, trimmed, value};
use super::symbolic::{
    Rows, adjugate, apply, at, characteristic, column, determinant, dot, identity, plus, product, scaled, times,
};
use crate::base::{Checked, Node, Q, disjoint_cycles, need, reject, some, whole};
use num_traits::{One, Signed};

/// Longest window of factors, and most words in it.
const MAX_WINDOW: usize = 6;
const MAX_WORDS: usize = 400;

/// A part of the range on which signs are asked for.
pub struct Here<'a> {
    pub from: &'a End,
    pub to: &'a End,
    pub point: bool,
}

impl Here<'_> {
    /// The sign on all of the part; on an interval a polynomial that may vanish inside has none.
    fn sign(&self, f: &Poly) -> Checked<i32> {
        let of = |v: &Q| if v.is_positive() { 1 } else { -i32::from(v.is_negative()) };
        if f.is_empty() {
            return Ok(0);
        }
        if self.point {
            if self.from.is_root_of(f)? {
                return Ok(0);
            }
            need(self.from.is_far_from(f)?, "sign", "a sign at the point is not seen")?;
            return Ok(of(&value(f, &self.from.lo)));
        }
        need(is_free(f, self.from, self.to)?, "sign", "a polynomial may vanish inside the part")?;
        Ok(of(&value(f, &((&self.from.hi + &self.to.lo) / whole(2)))))
    }

    fn is_not_zero(&self, v: &[Poly]) -> Checked<bool> {
        Ok(self.sign(&dot(v, v)?)? != 0)
    }

    /// Whether two vectors that are not 0 are multiples of each other on all of the part; an error where neither is seen.
    fn parallel(&self, a: &[Poly], b: &[Poly]) -> Checked<bool> {
        for i in 0..a.len() {
            for j in 0..i {
                let minor = minus(&times(&a[i], &b[j])?, &times(&a[j], &b[i])?);
                if self.sign(&minor)? != 0 {
                    return Ok(false);
                }
            }
        }
        Ok(true)
    }
}

/// The leading eigenvalue of a word and a positive multiple of the projection to its eigenvector.
struct Leading {
    positive: bool,
    projection: Rows,
}

/// A known line at an end.
struct Line {
    ray: Vec<Poly>,
    positive: bool,
    row: Vec<Poly>,
    forward: i32,
}

/// One argument on one part.
pub struct Argument<'a> {
    family: &'a Family,
    here: Here<'a>,
    chord: Vec<Poly>,
}

fn turned(v: &[Poly], sign: i32) -> Vec<Poly> {
    v.iter().map(|f| scaled(f, &whole(i64::from(sign)))).collect()
}

impl<'a> Argument<'a> {
    /// The relevant space is that of all differences, and no piece is a point.
    pub fn new(family: &'a Family, here: Here<'a>, span: &Node<'_>) -> Checked<Self> {
        for f in &family.sums {
            need(here.sign(f)? != 0, "chord", "an end may be no point")?;
        }
        let own = Self { family, here, chord: family.chord.clone() };
        need(own.here.is_not_zero(&own.chord)?, "chord", "the chord may be 0")?;
        for m in &family.linear {
            need(own.here.is_not_zero(&m.concat())?, "chord", "a piece may be a point")?;
        }
        let n = family.linear[0].len();
        let words = span.each(Node::word)?;
        span.need(words.len() == n, "span", "as many words as dimensions are needed")?;
        let mut images = Vec::new();
        for word in &words {
            span.need(word.iter().all(|l| *l < family.linear.len()), "span", "a letter that does not exist")?;
            images.push(word.iter().rev().try_fold(own.chord.clone(), |v, l| apply(&family.linear[*l], &v))?);
        }
        span.need(own.here.sign(&determinant(&images)?)? != 0, "span", "images of the chord may be dependent")?;
        Ok(own)
    }

    fn along(&self, word: &[usize]) -> Checked<Rows> {
        word.iter().try_fold(identity(self.chord.len()), |m, l| product(&m, &self.family.linear[*l]))
    }

    fn turn(&self, word: &[usize]) -> i32 {
        word.iter().map(|l| if self.family.reversed[*l] { -1 } else { 1 }).product()
    }

    /// The eigenvalue that is given, if it is simple and larger than all others in modulus on the part.
    fn leading(&self, word: &[usize], value: &Node<'_>) -> Checked<Leading> {
        let value_read = trimmed(value.each(Node::rational)?);
        let (chi, all) = characteristic(&self.along(word)?)?;
        value.need(at(&chi, &value_read)?.is_empty(), "lead", "no eigenvalue")?;
        let sign = self.here.sign(&value_read)?;
        value.need(sign != 0, "lead", "the eigenvalue may be 0")?;
        let mut psi: Vec<Poly> = Vec::new();
        for c in chi[1..].iter().rev() {
            let next = match psi.last() {
                None => c.clone(),
                Some(p) => plus(&times(p, &value_read)?, c),
            };
            psi.push(next);
        }
        psi.reverse();
        let (mut power, mut rest) = (vec![Q::one()], Vec::new());
        for c in &psi {
            rest.push(times(c, &power)?);
            power = times(&power, &value_read)?;
        }
        // Schur, Cohn, Jury for ψ(λ y).
        while rest.len() > 1 {
            let (first, last) = (rest[0].clone(), rest[rest.len() - 1].clone());
            let gap = minus(&times(&last, &last)?, &times(&first, &first)?);
            value.need(self.here.sign(&gap)? > 0, "lead", "another eigenvalue may be as large")?;
            let n = rest.len() - 1;
            let step =
                |k: usize| -> Checked<Poly> { Ok(minus(&times(&last, &rest[k])?, &times(&first, &rest[n - k])?)) };
            rest = (1..=n).map(step).collect::<Checked<_>>()?;
        }
        let side = self.here.sign(&at(&psi, &value_read)?)?;
        value.need(side != 0, "lead", "the eigenvalue may be double")?;
        let projection = adjugate(&all, &value_read)?.iter().map(|row| turned(row, side)).collect();
        Ok(Leading { positive: sign > 0, projection })
    }

    /// The line at an end, from the leading eigenvalue of its cycle.
    fn line(&self, end: usize, values: &[Node<'_>]) -> Checked<Line> {
        let germ = &self.family.germs[end];
        let lead = self.leading(&germ.cycle, &values[end])?;
        let through = self.along(&germ.prefix)?;
        let forward = if germ.at_start { 1 } else { -1 };
        let letters = self.family.linear.len();
        let mut sum: Vec<Poly> = vec![Vec::new(); self.chord.len()];
        let mut differences = vec![turned(&self.chord, forward)];
        for k in 0..letters - 1 {
            let l = if germ.at_start { k } else { letters - 1 - k };
            let step = turned(&apply(&self.family.linear[l], &self.chord)?, forward * self.turn(&[l]));
            sum = sum.iter().zip(&step).map(|(a, b)| plus(a, b)).collect();
            differences.push(sum.clone());
        }
        for a in &differences {
            let local = apply(&lead.projection, a)?;
            if local.iter().all(Vec::is_empty) || !self.here.is_not_zero(&local)? {
                continue;
            }
            for (k, x) in local.iter().enumerate() {
                let sign = self.here.sign(x)?;
                if sign != 0 {
                    let (row, ray) = (turned(&lead.projection[k], sign), apply(&through, &local)?);
                    need(self.here.is_not_zero(&ray)?, "lead", "the line may be killed")?;
                    return Ok(Line { ray, positive: lead.positive, row, forward });
                }
            }
        }
        reject("lead", "no difference is seen to have a leading coefficient")
    }

    /// The leading eigenvalues of an end are a pair that is not real; only in the plane.
    fn spiral(&self, end: usize) -> Checked<()> {
        let germ = &self.family.germs[end];
        let (chi, _) = characteristic(&self.along(&germ.cycle)?)?;
        need(chi.len() == 3, "spiral", "not in the plane")?;
        let four = scaled(&chi[0], &whole(4));
        let gap = minus(&times(&chi[1], &chi[1])?, &four);
        need(self.here.sign(&gap)? < 0, "spiral", "the eigenvalues may be real")?;
        let through = determinant(&self.along(&germ.prefix)?)?;
        need(self.here.sign(&through)? != 0, "spiral", "a direction may be killed")
    }

    /// The rays of both sides of a joint, into the pieces.
    fn joint(&self, k: usize, lines: &[Line; 2]) -> Checked<[(Vec<Poly>, bool); 2]> {
        need(k + 1 < self.family.linear.len(), "joint", "a joint that does not exist")?;
        let side = |letter: usize, finish: bool| -> Checked<(Vec<Poly>, bool)> {
            let line = &lines[usize::from(finish != self.family.reversed[letter])];
            let ray = apply(&self.family.linear[letter], &line.ray)?;
            need(self.here.is_not_zero(&ray)?, "joint", "a line may be killed")?;
            Ok((ray, line.positive))
        };
        Ok([side(k, true)?, side(k + 1, false)?])
    }

    /// Rays of a cone that every piece maps into itself and that holds the chord; by letter, which coefficients are positive.
    fn cone(&self, rays: &[Vec<Poly>]) -> Checked<Vec<Vec<Vec<bool>>>> {
        let n = self.chord.len();
        need(rays.len() == n && rays.iter().all(|r| r.len() == n), "cone", "as many rays as dimensions are needed")?;
        let cone: Rows = (0..n).map(|i| (0..n).map(|j| rays[j][i].clone()).collect()).collect();
        let det = self.here.sign(&determinant(&cone)?)?;
        need(det != 0, "cone", "the rays may be dependent")?;
        // adj(−G) = (−1)^(n−1) adj(G).
        let turn = if n.is_multiple_of(2) { -det } else { det };
        let inverse: Rows = adjugate(&characteristic(&cone)?.1, &[])?.iter().map(|row| turned(row, turn)).collect();
        for c in apply(&inverse, &self.chord)? {
            need(self.here.sign(&c)? >= 0, "cone", "the chord may leave the cone")?;
        }
        let mut patterns = Vec::new();
        for (l, m) in self.family.linear.iter().enumerate() {
            let b = product(&product(&inverse, m)?, &cone)?;
            let sign = |f: &Poly| -> Checked<i32> { Ok(self.here.sign(f)? * self.turn(&[l])) };
            let signs = b.iter().map(|row| row.iter().map(sign).collect()).collect::<Checked<Vec<Vec<i32>>>>()?;
            need(signs.iter().flatten().all(|s| *s >= 0), "cone", format_args!("piece {l} may leave the cone"))?;
            let pattern: Vec<Vec<bool>> = signs.iter().map(|row| row.iter().map(|s| *s > 0).collect()).collect();
            let kept = (0..n).all(|j| pattern.iter().any(|row| row[j]));
            need(kept, "cone", format_args!("piece {l} may kill a ray"))?;
            patterns.push(pattern);
        }
        Ok(patterns)
    }

    /// Every address meets positive products again and again, or ends in one of the cycles, which pull all rays to one.
    fn shrinks(
        &self,
        rays: &[Vec<Poly>],
        patterns: &[Vec<Vec<bool>>],
        window: usize,
        cycles: &Node<'_>,
    ) -> Checked<()> {
        cycles.need((1..=MAX_WINDOW).contains(&window), "cycles", "a window from 1 to 6 is needed")?;
        let idle = idle_cycles(&idle_words(patterns, window)?)?;
        for (item, word) in cycles.exactly(idle.len(), "cycles")?.iter().zip(&idle) {
            let [own, value] = item.fields("word value")?;
            own.need(own.word()? == *word, "cycles", "another cycle is expected here")?;
            let lead = item.at(self.leading(word, &value))?;
            item.need(lead.positive == (self.turn(word) > 0), "cycles", "the cycle turns the cone round")?;
            let mut pulled = false;
            for row in &lead.projection {
                let signs = rays.iter().map(|r| self.here.sign(&dot(row, r)?)).collect::<Checked<Vec<i32>>>();
                // One row that reads the coefficient is enough; others may be 0 somewhere.
                if let Ok(signs) = signs
                    && signs[0] != 0
                {
                    pulled |= signs.iter().all(|s| *s == signs[0]);
                }
            }
            item.need(pulled, "cycles", "a ray may not be pulled")?;
        }
        Ok(())
    }

    fn injective(&self) -> Checked<()> {
        for m in &self.family.linear {
            need(self.here.sign(&determinant(m)?)? != 0, "injective", "a piece may not be injective")?;
        }
        Ok(())
    }

    /// Checks one argument; `claim` and `why` as they are named in the certificate. Whether it proves the claim; otherwise it
    /// refutes it.
    pub fn holds(&self, claim: &str, why: &str, fact: &Node<'_>) -> Checked<bool> {
        let [_, _, _, _, places, values, rays, cycles] = fact.fields("claim verdict why span at values rays cycles")?;
        let (places, values) = (places.word()?, values.exactly(2, "values")?);
        let place = |k: usize| some(places.get(k).copied(), "at", "a number is missing");
        let side = |k: usize| {
            let side = place(k)?;
            need(side < 2, "at", "0 or 1 is needed").map(|()| side)
        };
        let about = match why {
            "corner" => claim == "g1" || claim == "joints",
            "spiral" => claim == "g1" || claim == "ends",
            "alternates" | "cusp" | "jumps" => claim == "g1",
            "in-cone" => claim == "ends" || claim == "joints",
            "cones" => true,
            _ => return fact.reject("why", "an argument that does not exist"),
        };
        fact.need(about, "why", "this argument is about another claim")?;
        match why {
            "spiral" => self.spiral(side(0)?)?,
            "alternates" => {
                fact.need(!self.line(side(0)?, &values)?.positive, "why", "the eigenvalue is positive")?;
            }
            "corner" => {
                let [(a, _), (b, _)] = self.joint(place(0)?, &self.lines(&values)?)?;
                fact.need(!self.here.parallel(&a, &b)?, "why", "the lines agree")?;
            }
            "cusp" => {
                let joint = self.joint(place(0)?, &self.lines(&values)?)?;
                fact.need(self.turns(&joint)? == Some(1), "why", "the rays may not agree")?;
            }
            "jumps" => {
                let joint = self.joint(place(0)?, &self.lines(&values)?)?;
                self.jumps(&joint[side(1)?].0, &cycles)?;
            }
            _ => {
                let entry = |f: &Node<'_>| -> Checked<Poly> { Ok(trimmed(f.each(Node::rational)?)) };
                let rays = rays.each(|r| r.each(entry))?;
                if why == "cones" {
                    self.common_cones(&rays, place(0)?, &values, &cycles)?;
                } else {
                    self.in_cone(&rays, claim == "joints", &values)?;
                }
                if claim == "joints" {
                    self.injective()?;
                }
                return Ok(true);
            }
        }
        Ok(false)
    }

    fn lines(&self, values: &[Node<'_>]) -> Checked<[Line; 2]> {
        Ok([self.line(0, values)?, self.line(1, values)?])
    }

    /// 1 where the rays of a joint agree, −1 where they are opposite; nothing where an eigenvalue is negative or the lines differ.
    fn turns(&self, [(a, up), (b, on)]: &[(Vec<Poly>, bool); 2]) -> Checked<Option<i32>> {
        let known = *up && *on && self.here.parallel(a, b)?;
        if known { self.here.sign(&dot(a, b)?).map(Some) } else { Ok(None) }
    }

    /// A cycle that keeps a direction, which is not the one to which it pulls.
    fn jumps(&self, line: &[Poly], cycles: &Node<'_>) -> Checked<()> {
        let cycle = cycles.exactly(1, "cycles")?;
        let [word, value] = cycle[0].fields("word value")?;
        let letters = word.word()?;
        let known = !letters.is_empty() && letters.iter().all(|l| *l < self.family.linear.len());
        word.need(known, "cycles", "a letter that does not exist")?;
        let lead = self.leading(&letters, &value)?;
        let image = apply(&self.along(&letters)?, line)?;
        let kept = self.here.is_not_zero(&image)? && self.here.parallel(&image, line)?;
        word.need(kept, "cycles", "the direction is not kept by the cycle")?;
        for c in 0..line.len() {
            let v = column(&lead.projection, c);
            if !v.iter().all(Vec::is_empty) && self.here.is_not_zero(&v)? {
                return word.need(!self.here.parallel(&v, line)?, "cycles", "the direction is that of the cycle");
            }
        }
        word.reject("cycles", "the cycle has no direction")
    }

    /// On the cone no leading coefficient of an end is negative; where joints are asked for, the lines of each agree.
    fn in_cone(&self, rays: &[Vec<Poly>], joints: bool, values: &[Node<'_>]) -> Checked<()> {
        let lines = self.lines(values)?;
        self.cone(rays)?;
        for line in &lines {
            need(line.positive, "why", "an eigenvalue is negative")?;
            for r in rays {
                let sign = self.here.sign(&dot(&line.row, r)?)? * line.forward;
                need(sign >= 0, "why", "a leading coefficient may be negative on the cone")?;
            }
        }
        for k in 0..if joints { self.family.linear.len() - 1 } else { 0 } {
            let [(a, _), (b, _)] = self.joint(k, &lines)?;
            need(self.here.parallel(&a, &b)?, "why", "the lines of a joint differ")?;
        }
        Ok(())
    }

    /// Cones that shrink, and regular joints.
    fn common_cones(&self, rays: &[Vec<Poly>], window: usize, values: &[Node<'_>], cycles: &Node<'_>) -> Checked<()> {
        let lines = self.lines(values)?;
        self.shrinks(rays, &self.cone(rays)?, window, cycles)?;
        for k in 0..self.family.linear.len() - 1 {
            let regular = self.turns(&self.joint(k, &lines)?)? == Some(-1);
            need(regular, "why", "a joint is not seen to be regular")?;
        }
        Ok(())
    }
}

type Word = (Vec<usize>, Vec<Vec<Vec<bool>>>);

fn times_patterns(a: &[Vec<bool>], b: &[Vec<bool>]) -> Vec<Vec<bool>> {
    let n = a.len();
    (0..n).map(|i| (0..n).map(|j| (0..n).any(|k| a[i][k] && b[k][j])).collect()).collect()
}

/// All words of `length` letters whose factors have no positive product.
fn idle_words(patterns: &[Vec<Vec<bool>>], length: usize) -> Checked<Vec<Vec<usize>>> {
    let mut words: Vec<Word> = vec![(Vec::new(), Vec::new())];
    for _ in 0..length {
        let mut longer = Vec::new();
        for (word, ends) in words {
            for (letter, step) in patterns.iter().enumerate() {
                let mut next: Vec<_> = ends.iter().map(|end| times_patterns(end, step)).collect();
                next.push(step.clone());
                if !next.iter().any(|m| m.iter().flatten().all(|x| *x)) {
                    longer.push(([word.as_slice(), &[letter]].concat(), next));
                }
            }
        }
        need(longer.len() <= MAX_WORDS, "limit", "too many words without a positive factor")?;
        words = longer;
    }
    Ok(words.into_iter().map(|(word, _)| word).collect())
}

/// The cycles of the graph of overlapping words, which must not meet; each from its first word on.
fn idle_cycles(words: &[Vec<usize>]) -> Checked<Vec<Vec<usize>>> {
    let follows = |a: &Vec<usize>, b: &Vec<usize>| a[1..] == b[..b.len() - 1];
    let next = |a| (0..words.len()).filter(|&k| follows(a, &words[k])).collect();
    let next: Vec<Vec<usize>> = words.iter().map(next).collect();
    let cycles = some(disjoint_cycles(&next), "cycles", "two cycles without positive products meet")?;
    Ok(cycles.iter().map(|cycle| cycle.iter().map(|k| words[*k][0]).collect()).collect())
}
