//! Bounds of a joint spectral radius: a disc that holds an eigenvalue of a product, and a norm for every diagonal block.

use crate::base::{
    Accepted, Checked, Ground, Json, MAX_COORDINATES, MAX_LETTERS, Matrix, Node, Q, Surd, Verdict, Whole, absolute,
    bits, file, fraction, has_root_near, index, list, matrix, need, spend, whole, word,
};
use crate::claim::{Claim, Decided};
use crate::curve::positive_definite;
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

/// Matrices `dim(from) x dim(to)` between the spaces of states.
pub struct System<T = BigInt> {
    /// The name of the file.
    pub name: String,
    /// The dimension of the space of every state.
    pub dims: Vec<usize>,
    /// The arrows: from, to, matrix.
    pub arrows: Vec<(usize, usize, Matrix<T>)>,
}

/// Reads a file of matrices (a set, or an automaton of them), as `docs/radius.md` describes.
fn matrix_list<T: Whole>(source: &str, ground: &T::Ground) -> Checked<System<T>> {
    file(source, "name matrices states arrows", |node| {
        let mut matrices: Vec<Matrix<T>> = Vec::new();
        for item in node.field("matrices")?.list()? {
            for x in item.each(Node::list)?.iter().flatten() {
                let endless = matches!(x.value, Json::Number(text) if text.contains('n'));
                x.need(!endless, "case", "numbers of matrices are integers, decimals or texts")?;
            }
            matrices.push(matrix(&item, ground)?);
        }
        // A file without a name is one with an empty name.
        let name = match word(node, "name")? {
            Some(name) => name.to_owned(),
            None => String::new(),
        };
        node.need(!matrices.is_empty(), "case", "no matrix")?;
        let (dims, arrows) = if node.get("states").is_none() && node.get("arrows").is_none() {
            (vec![matrices[0].rows], matrices.into_iter().map(|m| (0, 0, m)).collect::<Vec<_>>())
        } else {
            let dims = node.field("states")?.each(|v| index(v, MAX_COORDINATES + 1))?;
            let arrow = |arrow: &Node<'_>| {
                let parts = arrow.exactly(3, "format")?;
                let matrix = &matrices[index(&parts[2], matrices.len())?];
                Ok((index(&parts[0], dims.len())?, index(&parts[1], dims.len())?, matrix.clone()))
            };
            let arrows = node.field("arrows")?.each(arrow)?;
            (dims, arrows)
        };
        let fits = |(from, to, m): &(usize, usize, Matrix<T>)| (m.rows, m.cols) == (dims[*from], dims[*to]);
        node.need(!arrows.is_empty() && arrows.iter().all(fits), "case", "no arrow, or a matrix of the wrong size")?;
        Ok(System { name, dims, arrows })
    })
}

/// Checks the proof of a certificate of the kind `jsr`.
pub fn check(text: &str, node: &Node<'_>) -> Checked<Accepted> {
    let Some(field) = node.get("field") else {
        let system = matrix_list::<BigInt>(text, &())?;
        return accepted(system.name.clone(), bounds(&system, &(), node)?);
    };
    let [_, lower, upper, bases, blocks] = node.fields("field lower upper bases blocks")?;
    let ground = Ground::read(&field)?;
    let system = matrix_list::<Surd>(text, &ground)?;
    accepted(system.name.clone(), bounded(&system, &ground, [lower, upper, bases, blocks])?)
}

fn accepted(name: String, Bounds { lower, upper, blocks }: Bounds) -> Checked<Accepted> {
    let claim = Claim::Radius(lower, upper).is(Verdict::Proved);
    Ok(Accepted { case: name, verdict: Verdict::Proved, claims: vec![claim], points: blocks })
}

/// What is proved of a radius.
pub struct Bounds {
    /// It is at least this.
    pub lower: Q,
    /// It is at most this.
    pub upper: Q,
    /// Those of the blocks.
    pub blocks: Vec<Decided>,
}

/// Checks `{"lower", "upper", "bases", "blocks"}` for a system.
pub fn bounds<T: Whole>(system: &System<T>, ground: &T::Ground, node: &Node<'_>) -> Checked<Bounds> {
    bounded(system, ground, node.fields("lower upper bases blocks")?)
}

fn bounded<T: Whole>(system: &System<T>, ground: &T::Ground, fields: [Node<'_>; 4]) -> Checked<Bounds> {
    let [lower, upper, bases, blocks] = fields;
    // Where all spaces are 0 the radius is 0, and there are no blocks; without states or arrows there is nothing to bound.
    need(!system.dims.is_empty() && !system.arrows.is_empty(), "block", "a system has states and arrows")?;
    let lo = if lower.is_null() { Q::zero() } else { lower.at(below(system, &lower))? };
    let hi = upper.rational()?;
    // The matrices in the bases.
    let frames = read_bases(system, ground, &bases)?;
    let mut arrows = Vec::new();
    for (from, to, m) in &system.arrows {
        arrows.push((*from, *to, frames[*from].1.times(&m.times(&frames[*to].0)?)?));
    }
    let (mut lines, mut used) = (Vec::new(), vec![0_usize; system.dims.len()]);
    for item in blocks.list()? {
        let [dims, bound, norm] = item.fields("dims bound norm")?;
        let (dims, bound) = (dims.indices(usize::MAX)?, bound.rational()?);
        let fits = dims.len() == used.len() && dims.iter().any(|d| *d > 0) && !bound.is_negative() && bound <= hi;
        item.need(fits, "block", "one size for each state, not all 0, and a bound up to the upper one, are needed")?;
        let start = used.clone();
        used.iter_mut().zip(&dims).for_each(|(u, d)| *u = u.saturating_add(*d));
        let room = used.iter().zip(&system.dims).all(|(u, d)| u <= d);
        item.need(room, "block", "the blocks have more dimensions than the spaces")?;
        // Nothing of the images of this block and those before lies after it.
        let nothing =
            |(from, to, m): &(usize, usize, Matrix<T>)| m.part(used[*from]..m.rows, start[*to]..used[*to]).is_zero();
        let triangular = arrows.iter().all(nothing);
        item.need(triangular, "block", "the matrices are not block upper triangular in these bases")?;
        let diagonal = |(from, to, m): &(usize, usize, Matrix<T>)| {
            (*from, *to, m.part(start[*from]..used[*from], start[*to]..used[*to]))
        };
        let block = System { name: String::new(), arrows: arrows.iter().map(diagonal).collect(), dims };
        lines.push(norm.at(block.check(ground, &norm, &bound))?);
    }
    blocks.need(used == system.dims, "block", "the blocks do not fill the spaces")?;
    upper.need(lo <= hi, "block", "the bounds contradict each other")?;
    Ok(Bounds { lower: lo, upper: hi, blocks: lines })
}

/// A basis of every state (columns) and its inverse.
fn read_bases<T: Whole>(
    system: &System<T>,
    ground: &T::Ground,
    node: &Node<'_>,
) -> Checked<Vec<(Matrix<T>, Matrix<T>)>> {
    let mut bases = Vec::new();
    for (item, &dim) in node.exactly(system.dims.len(), "format")?.iter().zip(&system.dims) {
        let basis = item.entries(dim, ground)?.transpose();
        item.need(basis.cols == dim, "format", format_args!("{dim} vectors are needed here"))?;
        let inverse = item.some(basis.solve(&Matrix::identity(dim))?, "block", "the vectors are no basis")?;
        bases.push((basis, inverse));
    }
    Ok(bases)
}

/// A closed path whose product has an eigenvalue of modulus `bound^length` or more: a root of a `pair`, or one in a disc.
fn below<T: Whole>(system: &System<T>, node: &Node<'_>) -> Checked<Q> {
    if node.get("pair").is_some() {
        let [word, pair, bound] = node.fields("word pair bound")?;
        let (letters, product) = path(system, &word)?;
        let bound = bound.rational()?;
        need(!bound.is_negative(), "word", "a bound from 0 on is needed")?;
        node.at(has_pair(&product, &pair.vector(2)?, &power(&bound, letters)?))?;
        return Ok(bound);
    }
    in_a_disc(system, node)
}

/// Whether a root of `x² + bx + c` is an eigenvalue, where both have a modulus `√|c|` of at least `reach`: they are conjugate, or
/// opposite.
fn has_pair<T: Whole>(product: &Matrix<T>, pair: &[Q], reach: &Q) -> Checked<()> {
    let (c, b) = (&pair[0], &pair[1]);
    let level = b.is_zero() || b * b < c * whole(4);
    need(level, "word", "the two numbers do not have the same modulus")?;
    let value = product.times(product)?.plus(b, product).plus(c, &Matrix::identity(product.rows));
    need(value.rank()? < product.rows, "word", "neither number is an eigenvalue")?;
    need(reach * reach <= c.abs(), "word", "the bound is above the eigenvalue")
}

/// The length and the product of a closed path in a space that is not 0.
fn path<T: Whole>(system: &System<T>, word: &Node<'_>) -> Checked<(usize, Matrix<T>)> {
    let word = word.indices(system.arrows.len())?;
    need((1..=MAX_LETTERS).contains(&word.len()), "word", "a word of 1 to 1000 letters is needed")?;
    let arrow = |k: usize| &system.arrows[word[k]];
    let closed = (0..word.len()).all(|k| arrow(k).1 == arrow((k + 1) % word.len()).0);
    need(closed, "word", "the arrows form no closed path")?;
    let product = (1..word.len()).try_fold(arrow(0).2.clone(), |p, k| p.times(&arrow(k).2))?;
    // Of a space 0 there are no eigenvalues.
    need(product.rows > 0, "word", "the path begins in a space without dimensions")?;
    Ok((word.len(), product))
}

/// A disc around `z` in which the product has an eigenvalue, because `n |χ(z)| <= error |χ'(z)|`; the modulus is at least
/// `|z| − error >= bound^length`.
fn in_a_disc<T: Whole>(system: &System<T>, node: &Node<'_>) -> Checked<Q> {
    let [word, centre, error, bound] = node.fields("word centre error bound")?;
    let (letters, product) = path(system, &word)?;
    let (centre, e, bound) = (centre.vector(2)?, error.rational()?, bound.rational()?);
    need(!e.is_negative() && !bound.is_negative(), "word", "numbers from 0 on are needed")?;
    let near = has_root_near(&product.characteristic()?, &centre, &e)?;
    error.need(near, "word", "no eigenvalue is seen in this disc")?;
    let reach = power(&bound, letters)? + &e;
    let above = &reach * &reach <= &centre[0] * &centre[0] + &centre[1] * &centre[1];
    need(above, "word", "the bound is above the eigenvalue")?;
    Ok(bound)
}

fn power(x: &Q, exponent: usize) -> Checked<Q> {
    spend(exponent, bits(x).saturating_mul(exponent as u64))?;
    Ok(num_traits::pow(x.clone(), exponent))
}

/// An upper bound of a modulus; where the number is not real about `2^-100` above it.
fn modulus(re: &Q, im: &Q) -> Checked<Q> {
    if im.is_zero() {
        return Ok(re.abs());
    }
    let square = re * re + im * im;
    spend(16, bits(&square) + 256)?;
    let scale = BigInt::one() << 100u32;
    let scaled = (square * Q::from_integer(&scale * &scale)).ceil().to_integer();
    Ok(Q::new(scaled.sqrt() + BigInt::one(), scale))
}

/// A rational number in the field of the entries.
fn rational<T: Whole>(x: &Q) -> Matrix<T> {
    Matrix::fractions(1, 1, &[fraction(x)])
}

/// `Σ |x|` over all entries.
fn norm<T: Whole>(m: &Matrix<T>) -> Matrix<T> {
    Matrix { rows: 1, cols: 1, data: vec![m.size()], den: m.den.clone() }
}

/// The greater of two numbers.
fn greater<T: Whole>(a: Matrix<T>, b: Matrix<T>) -> Matrix<T> {
    if a.minus(&b).has_negative() { b } else { a }
}

/// A polytope: all combinations `Σ c q` of its points with `Σ|c| <= 1`. Scalars are real (`width` 1) or complex (`width` 2); a
/// vector has a column for the real and one for the imaginary parts. Numbers are matrices with one entry.
struct Polytope<'g, T: Whole> {
    ground: &'g T::Ground,
    width: usize,
    /// With the state of each.
    points: Vec<(usize, Matrix<T>)>,
}

impl<'g, T: Whole> Polytope<'g, T> {
    fn read(node: &Node<'_>, width: usize, dims: &[usize], ground: &'g T::Ground) -> Checked<Self> {
        let read = |item: &Node<'_>| {
            let [state, coordinates] = item.fields("state coordinates")?;
            let state = state.index(dims.len())?;
            if width == 1 {
                return Ok((state, coordinates.column(dims[state], ground)?));
            }
            let complex = |x: &Node<'_>| x.vector(width);
            let entries =
                coordinates.exactly(dims[state], "format")?.iter().map(complex).collect::<Checked<Vec<_>>>()?;
            Ok((state, Matrix::lifted(&Matrix::from_rows(width, &entries))))
        };
        Ok(Self { ground, width, points: node.each(read)? })
    }

    /// Reads a combination of points of a state and takes it off a vector; says what is left, `Σ|c|` (rounded upwards where they
    /// are complex), and whether a real part is negative.
    fn rest(&self, mut vector: Matrix<T>, node: &Node<'_>, state: usize) -> Checked<(Matrix<T>, Matrix<T>, bool)> {
        let (mut total, mut negative) = (Matrix::zeros(1, 1), false);
        for item in node.list()? {
            let parts = item.exactly(1 + self.width, "format")?;
            let (at, point) = &self.points[parts[0].index(self.points.len())?];
            item.need(*at == state, "inclusion", "a point of another state")?;
            // Rows times this matrix are multiplied by the scalar.
            let (factor, modulus) = if self.width == 1 {
                let c = Matrix::fractions(1, 1, &[T::entry(&parts[1], self.ground)?]);
                (c.clone(), norm(&c))
            } else {
                let (re, im) = (parts[1].rational()?, parts[2].rational()?);
                let size = rational(&modulus(&re, &im)?);
                (Matrix::lifted(&Matrix::new(2, 2, &[re.clone(), im.clone(), -im, re])), size)
            };
            negative |= factor.part(0..1, 0..1).has_negative();
            spend(64, total.bits() + modulus.bits())?;
            total = total.plus(&Q::one(), &modulus).reduced();
            vector = vector.minus(&point.times(&factor)?);
        }
        Ok((vector, total, negative))
    }

    /// By state, `K` with all unit vectors in `K Q`: they are combinations but for rests whose 1-norm is below 1.
    fn interiors(&self, node: &Node<'_>, dims: &[usize]) -> Checked<Vec<Matrix<T>>> {
        let mut found: Vec<Option<Matrix<T>>> = dims.iter().map(|d| (*d == 0).then(|| Matrix::zeros(1, 1))).collect();
        for item in node.list()? {
            let [state, units] = item.fields("state units")?;
            let s = state.index(dims.len())?;
            let units = units.list()?;
            item.need(units.len() == dims[s], "interior", "one combination for each axis is needed")?;
            let (mut largest, mut error) = (Matrix::zeros(1, 1), Matrix::zeros(1, 1));
            for (axis, unit) in units.iter().enumerate() {
                let x = Matrix::ones(dims[s], self.width, |i, j| i == axis && j == 0);
                let (rest, total, _) = self.rest(x, unit, s)?;
                error = greater(error, norm(&rest));
                largest = greater(largest, total);
            }
            let room = Matrix::identity(1).minus(&error);
            item.need(room.all_positive(), "interior", "the combinations are too far from the axes")?;
            let inverse = item.some(room.solve(&Matrix::identity(1))?, "interior", "no inverse")?;
            found[s] = Some(largest.times(&inverse)?.reduced());
        }
        node.some(found.into_iter().collect(), "interior", "a state without combinations of the axes")
    }

    /// Whether all points are nonnegative, and every coordinate of every state is positive at one of them.
    fn is_positive(&self, dims: &[usize]) -> bool {
        let at = |s: usize, i: usize| self.points.iter().any(|(at, p)| *at == s && p.data[i].sgn() > 0);
        let reached = dims.iter().enumerate().all(|(s, &d)| (0..d).all(|i| at(s, i)));
        reached && self.points.iter().all(|(_, p)| !p.has_negative())
    }
}

/// A diagonal block: the arrows between its parts of the states.
impl<T: Whole> System<T> {
    /// Checks that the norm shows that products of `k` matrices are at most a constant times `bound^k`; says so.
    fn check(&self, ground: &T::Ground, node: &Node<'_>, bound: &Q) -> Checked<Decided> {
        let norm = self.norm(ground, node, bound)?;
        Ok(Claim::Block { dims: self.dims.clone(), norm, bound: bound.clone() }.is(Verdict::Proved))
    }

    /// The same, with the name of the norm.
    fn norm(&self, ground: &T::Ground, node: &Node<'_>, bound: &Q) -> Checked<&'static str> {
        match node.tag("norm")? {
            "zero" => {
                let [_] = node.fields("norm")?;
                need(self.arrows.iter().all(|a| a.2.is_zero()), "zero", "a matrix of the block is not 0")?;
                Ok("zero")
            }
            "symmetric" => self.polytope(ground, node, "symmetric", bound),
            "monotone" => self.polytope(ground, node, "monotone", bound),
            "balanced" => self.polytope(ground, node, "balanced", bound),
            "quadratic" => self.quadratic(ground, node, bound),
            "tree" => self.tree(node, bound),
            "transposed" => {
                let [_, of] = node.fields("norm of")?;
                match of.at(self.transposed().norm(ground, &of, bound))? {
                    "symmetric" => Ok("symmetric, of the transposed matrices"),
                    "monotone" => Ok("monotone, of the transposed matrices"),
                    "balanced" => Ok("balanced, of the transposed matrices"),
                    "tree" => Ok("tree, of the transposed matrices"),
                    _ => node.reject("transposed", "of a polytope or a tree of the transposed matrices"),
                }
            }
            _ => node.reject("format", "unknown kind of norm"),
        }
    }

    /// The transposed matrices with the arrows turned round: their products are the transposes of those of the reversed words, so
    /// the radius is the same.
    fn transposed(&self) -> Self {
        let turned = |(from, to, m): &(usize, usize, Matrix<T>)| (*to, *from, m.transpose());
        Self { name: String::new(), dims: self.dims.clone(), arrows: self.arrows.iter().map(turned).collect() }
    }

    /// `T Q ⊂ bound Q` for a polytope `Q` of real or complex combinations, or (monotone) for what lies below one with `c >= 0`,
    /// everything being nonnegative.
    fn polytope(&self, ground: &T::Ground, node: &Node<'_>, kind: &'static str, bound: &Q) -> Checked<&'static str> {
        let [_, points, inclusions, axes] = node.fields("norm points inclusions axes")?;
        let monotone = kind == "monotone";
        let hull = Polytope::read(&points, if kind == "balanced" { 2 } else { 1 }, &self.dims, ground)?;
        let interior = if monotone {
            let positive = hull.is_positive(&self.dims) && self.arrows.iter().all(|a| !a.2.has_negative());
            points.need(positive, "monotone", "something is negative, or a coordinate is nowhere positive")?;
            vec![Matrix::zeros(1, 1); self.dims.len()]
        } else {
            hull.interiors(&axes, &self.dims)?
        };
        spend(hull.points.len() * self.arrows.len(), 0)?;
        let mut seen = vec![vec![false; self.arrows.len()]; hull.points.len()];
        for item in inclusions.list()? {
            let [point, arrow, terms] = item.fields("point arrow terms")?;
            let (k, a) = (point.index(hull.points.len())?, arrow.index(self.arrows.len())?);
            let (from, to, matrix) = &self.arrows[a];
            let (state, point) = &hull.points[k];
            item.need(to == state, "inclusion", "the arrow does not end in the state of the point")?;
            let (rest, total, negative) = hull.rest(matrix.times(point)?, &terms, *from)?;
            let under = !monotone || !negative && !rest.data.iter().any(|x| x.sgn() > 0);
            item.need(under, "inclusion", "the image does not lie below the combination")?;
            let far = total.plus(&Q::one(), &interior[*from].times(&norm(&rest))?);
            item.need(
                !rational(bound).minus(&far).has_negative(),
                "inclusion",
                "the image lies outside the multiple of the polytope",
            )?;
            seen[k][a] = true;
        }
        for (k, (state, _)) in hull.points.iter().enumerate() {
            let missing = |a: &usize| !seen[k][*a] && self.arrows[*a].1 == *state && !self.arrows[*a].2.is_zero();
            let first = (0..self.arrows.len()).find(missing);
            let which = first.iter().map(usize::to_string).collect::<String>();
            let why = format_args!("the image of point {k} under arrow {which} is missing");
            inclusions.need(first.is_none(), "inclusion", why)?;
        }
        Ok(kind)
    }

    /// Positive definite forms with `Tᵗ P T <= square P`, `square <= bound²`.
    fn quadratic(&self, ground: &T::Ground, node: &Node<'_>, bound: &Q) -> Checked<&'static str> {
        let [_, forms, square] = node.fields("norm forms square")?;
        let square = square.rational()?;
        // A space 0 has one form.
        let mut read: Vec<Option<Matrix<T>>> =
            self.dims.iter().map(|d| (*d == 0).then(|| Matrix::identity(0))).collect();
        for item in forms.list()? {
            let [state, form] = item.fields("state form")?;
            let s = state.index(self.dims.len())?;
            read[s] = Some(positive_definite(&form, self.dims[s], ground)?);
        }
        let read: Vec<Matrix<T>> = forms.some(read.into_iter().collect(), "quadratic", "a state without a form")?;
        need(square <= bound * bound, "quadratic", "the bound is below the root of the square")?;
        for (from, to, m) in &self.arrows {
            let image = m.transpose().times(&read[*from])?.times(m)?;
            let shrinks = read[*to].scaled(&square).minus(&image).is_positive(false)?;
            need(shrinks, "quadratic", "a matrix expands the form")?;
        }
        Ok("quadratic")
    }

    /// Complete prefix codes of words whose norms are at most `bound^length`, for weighted sums of absolute values.
    fn tree(&self, node: &Node<'_>, bound: &Q) -> Checked<&'static str> {
        let [_, codes] = node.fields("norm codes")?;
        let mut weights: Vec<Option<Vec<Q>>> = self.dims.iter().map(|d| (*d == 0).then(Vec::new)).collect();
        let mut words: Vec<Vec<Vec<usize>>> = vec![Vec::new(); self.dims.len()];
        for item in codes.list()? {
            let [state, w, list] = item.fields("state weights words")?;
            let s = state.index(self.dims.len())?;
            let w = w.vector(self.dims[s])?;
            item.need(w.iter().all(Signed::is_positive), "tree", "weights are positive")?;
            weights[s] = Some(w);
            for word in list.list()? {
                let letters = word.indices(self.arrows.len())?;
                // The empty word has norm 1 whatever the matrices are: it would be a code that proves every bound.
                word.need((1..=MAX_LETTERS).contains(&letters.len()), "tree", "words have 1 to 1000 letters")?;
                words[s].push(letters);
            }
            words[s].sort();
        }
        let weights = codes.some(weights.into_iter().collect(), "tree", "a state without a code")?;
        let code = Code { block: self, weights, bound };
        for from in (0..self.dims.len()).filter(|&from| self.dims[from] > 0) {
            codes.at(code.descend(&words[from], 0, from, from, &Matrix::identity(self.dims[from])))?;
        }
        Ok("tree")
    }
}

/// Prefix codes of paths through a block, with the weights of the norms in all states.
struct Code<'a, T> {
    block: &'a System<T>,
    weights: Vec<Vec<Q>>,
    bound: &'a Q,
}

impl<T: Whole> Code<'_, T> {
    /// Every path from `from` begins with one of the words (which ascend), and these are short enough. All of them begin with
    /// the word of this depth that leads to `at` with this product.
    fn descend(&self, words: &[Vec<usize>], depth: usize, from: usize, at: usize, product: &Matrix<T>) -> Checked<()> {
        if words.first().is_some_and(|w| w.len() == depth) {
            let most = power(self.bound, depth)?;
            let mut within = words.len() == 1;
            for j in 0..product.cols {
                let column = product.columns(&[j]).transpose();
                let sizes = Matrix { data: column.data.iter().map(absolute).collect(), ..column };
                let weights = Matrix::lifted(&Matrix::new(product.rows, 1, &self.weights[from]));
                let room = rational(&(&most * &self.weights[at][j])).minus(&sizes.times(&weights)?);
                within &= !room.has_negative();
            }
            return need(
                within,
                "tree",
                format_args!("the word {} is too long, or a word begins with it", list(&words[0])),
            );
        }
        if product.is_zero() && depth > 0 {
            // What follows is 0, whatever the code says about it.
            return Ok(());
        }
        need(!words.is_empty(), "tree", "a path begins with no word of the code")?;
        let mut used = 0;
        for (a, (start, to, m)) in self.block.arrows.iter().enumerate() {
            if *start == at && self.block.dims[*to] > 0 {
                let begin = |letter: usize| words.partition_point(|w| w[depth] < letter);
                let longer = &words[begin(a)..begin(a + 1)];
                used += longer.len();
                self.descend(longer, depth + 1, from, *to, &product.times(m)?)?;
            }
        }
        need(used == words.len(), "tree", "a word of the code is no path")
    }
}
