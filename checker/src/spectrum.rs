//! The part of a spectrum with the largest modulus, proved without factorisation.

use crate::json::Node;
use crate::matrix::{Matrix, dot};
use crate::number::{Q, whole};
use crate::poly::{Complex, Field, Interval, Poly, combine, complex_values, roots_in_disc, weighted};
use crate::{Rejected, reject};
use num_traits::{One, Signed, Zero};

/// A Jordan chain `v_1, v_2, …` with `(L − sθ) v_1 = 0` and `(L − sθ) v_{j+1} = v_j`.
pub struct Chain {
    /// `s = ±1`.
    pub sign: i32,
    /// The vectors, over the field.
    pub vectors: Vec<Vec<Poly>>,
}

/// The eigenvalues outside a disc, all of one modulus, with their whole generalised eigenspaces.
pub enum Top {
    /// `±θ` for a real number `θ`, with a Jordan basis.
    Real {
        /// The field of `θ`.
        field: Field,
        /// The chains.
        chains: Vec<Chain>,
    },
    /// A pair of simple complex conjugate eigenvalues.
    Pair {
        /// A box that holds one of them.
        value: Complex,
        /// The columns of `adj(x − L)`: every nonzero one is an eigenvector where `x` is a simple eigenvalue.
        adjugate: Vec<Matrix>,
    },
    /// A rational invariant subspace on which `L` is a conformal map for some scalar product.
    Conformal {
        /// A basis, as rows.
        basis: Matrix,
    },
}

/// The coefficients of `χ(r z)`, `r > 0`, and how many roots of `χ` have a modulus above `r`; none has modulus `r`.
fn outside(linear: &Matrix, radius: &Node<'_>) -> Result<(Q, usize), Rejected> {
    let r = radius.rational()?;
    if !r.is_positive() {
        return reject("disc", &radius.place, "the radius must be positive");
    }
    let mut power = Q::one();
    let mut scaled = Vec::new();
    for c in linear.characteristic()? {
        scaled.push(&c * &power);
        power *= &r;
    }
    match roots_in_disc(&scaled)? {
        Some(inside) => Ok((r, linear.rows - inside)),
        None => reject("disc", &radius.place, "the recursion of Schur and Cohn is not regular for this radius"),
    }
}

impl Top {
    /// Reads and checks the evidence for the top of the spectrum of `linear`.
    pub fn read(node: &Node<'_>, linear: &Matrix) -> Result<Self, Rejected> {
        crate::at(
            &node.place,
            match node.tag("top")? {
                "real" => Self::real(node, linear),
                "pair" => Self::pair(node, linear),
                "conformal" => Self::conformal(node, linear),
                _ => node.malformed("unknown kind of top"),
            },
        )
    }

    fn real(node: &Node<'_>, linear: &Matrix) -> Result<Self, Rejected> {
        let [_, radius, polynomial, interval, chains] =
            node.fields(["top", "radius", "polynomial", "interval", "chains"])?;
        let (r, count) = outside(linear, &radius)?;
        let field = Field::read(&polynomial, &interval)?;
        if field.interval.lo <= r && field.interval.hi >= -&r {
            return reject("top-real", &interval.place, "the eigenvalue must lie outside the disc");
        }
        let mut read = Vec::new();
        for chain in chains.list()? {
            read.push(Self::chain(&chain, linear, &field)?);
        }
        if read.iter().map(|c| c.vectors.len()).sum::<usize>() != count {
            return reject("top-real", &chains.place, format!("{count} eigenvalues lie outside the disc"));
        }
        for s in [1, -1] {
            let first = |c: &&Chain| c.sign == s;
            let starts: Vec<&[Poly]> = read.iter().filter(first).map(|c| c.vectors[0].as_slice()).collect();
            if !independent(&field, &starts)? {
                return reject("top-real", &chains.place, "the eigenvectors are not seen to be independent");
            }
        }
        Ok(Self::Real { field, chains: read })
    }

    fn chain(node: &Node<'_>, linear: &Matrix, field: &Field) -> Result<Chain, Rejected> {
        let [sign, vectors] = node.fields(["sign", "vectors"])?;
        let s = match sign.text()? {
            "+" => 1,
            "-" => -1,
            _ => return sign.malformed("a sign is \"+\" or \"-\""),
        };
        let items = vectors.list()?;
        let read = items.iter().map(|v| field.vector(v, linear.rows)).collect::<Result<Vec<_>, _>>()?;
        if read.is_empty() {
            return vectors.malformed("a chain is not empty");
        }
        let theta = field.reduce(vec![Q::zero(), whole(s)])?;
        for (k, v) in read.iter().enumerate() {
            for i in 0..linear.rows {
                let image = combine(&weighted(linear.row(i), v)?, &-Q::one(), &field.times(&theta, &v[i])?);
                if image != if k == 0 { Poly::new() } else { read[k - 1][i].clone() } {
                    return reject(
                        "top-real",
                        &vectors.place,
                        format!("vector {k} does not continue the Jordan chain"),
                    );
                }
            }
        }
        Ok(Chain { sign: s as i32, vectors: read })
    }

    fn pair(node: &Node<'_>, linear: &Matrix) -> Result<Self, Rejected> {
        let [_, radius, centre, error] = node.fields(["top", "radius", "centre", "error"])?;
        let (r, count) = outside(linear, &radius)?;
        let [c, e] = [centre.vector(2)?, vec![error.rational()?]];
        let (x, y, e) = (&c[0], &c[1], &e[0]);
        let far = &r + e;
        if count != 2 || !e.is_positive() || y <= e || x * x + y * y <= &far * &far {
            return reject(
                "top-pair",
                &node.place,
                "two eigenvalues outside the disc and off the real axis are needed",
            );
        }
        // A polynomial p of degree n has a root within n |p(c)/p'(c)| of c.
        let chi = linear.characteristic()?;
        let derivative: Poly = chi.iter().enumerate().skip(1).map(|(k, a)| a * whole(k as i64)).collect();
        let at = (Interval::point(x), Interval::point(y));
        let square = |p: &[Q]| complex_values(p, &at).map(|(re, im)| &re.lo * &re.lo + &im.lo * &im.lo);
        let n = whole(linear.rows as i64);
        let slope = square(&derivative)?;
        if slope.is_zero() || &n * &n * square(&chi)? > e * e * slope {
            return reject("top-pair", &error.place, "no eigenvalue is seen to lie within this distance of the centre");
        }
        let around = |v: &Q| Interval { lo: v - e, hi: v + e };
        let mut adjugate = vec![Matrix::identity(linear.rows)];
        for k in 1..linear.rows {
            let next = linear.times(&adjugate[k - 1])?.plus(&chi[linear.rows - k], &Matrix::identity(linear.rows));
            adjugate.push(next);
        }
        adjugate.reverse();
        Ok(Self::Pair { value: (around(x), around(y)), adjugate })
    }

    fn conformal(node: &Node<'_>, linear: &Matrix) -> Result<Self, Rejected> {
        let [_, radius, basis, gram, square] = node.fields(["top", "radius", "basis", "gram", "square"])?;
        let (r, count) = outside(linear, &radius)?;
        let items = basis.list()?;
        let rows = items.iter().map(|v| v.vector(linear.rows)).collect::<Result<Vec<_>, _>>()?;
        let e = Matrix::from_rows(linear.rows, &rows);
        let (echelon, pivots) = e.echelon()?;
        if echelon != e || e.rows != count {
            return reject("top-conformal", &basis.place, format!("{count} rows in reduced echelon form are needed"));
        }
        let images = e.times(&linear.transpose())?;
        let on_basis = Matrix::from_fn(e.rows, e.rows, |i, k| images.at(i, pivots[k]).clone());
        if on_basis.times(&e)? != images {
            return reject("top-conformal", &basis.place, "the space is not invariant");
        }
        let h = positive_definite(&gram, e.rows)?;
        let c = square.rational()?;
        // Rows are images of basis vectors: on_basis is the transpose of L on the space.
        let stretched = on_basis.times(&h)?.times(&on_basis.transpose())?;
        if c <= &r * &r || stretched != h.plus(&(&c - Q::one()), &h) {
            return reject(
                "top-conformal",
                &square.place,
                "the map does not stretch the scalar product by this factor",
            );
        }
        Ok(Self::Conformal { basis: e })
    }

    /// Enclosures of real vectors that span the image under `view` of the eigenvectors that end the longest chains.
    pub fn directions(&self, view: &Matrix) -> Result<Vec<Vec<Interval>>, Rejected> {
        match self {
            Self::Real { field, chains } => {
                let longest = chains.iter().map(|c| c.vectors.len()).max().unwrap_or(0);
                let ending = chains.iter().filter(|c| c.vectors.len() == longest);
                ending.map(|c| seen(field, view, &c.vectors[0])).collect()
            }
            Self::Pair { value, adjugate } => {
                let mut spanning = Vec::new();
                for j in 0..view.cols {
                    let (mut re, mut im) = (Vec::new(), Vec::new());
                    for i in 0..view.rows {
                        let entry = |m: &Matrix| dot(view.row(i), &m.column(j));
                        let p = adjugate.iter().map(entry).collect::<Result<Vec<_>, _>>()?;
                        let (x, y) = complex_values(&p, value)?;
                        re.push(x);
                        im.push(y);
                    }
                    spanning.extend([re, im]);
                }
                Ok(spanning)
            }
            Self::Conformal { basis } => {
                let images = basis.times(&view.transpose())?;
                Ok((0..images.rows).map(|i| images.row(i).iter().map(Interval::point).collect()).collect())
            }
        }
    }
}

/// Reads a symmetric matrix whose elimination without exchanges has positive pivots only.
pub fn positive_definite(node: &Node<'_>, n: usize) -> Result<Matrix, Rejected> {
    let items = node.list()?;
    let mut rows = items.iter().map(|v| v.vector(n)).collect::<Result<Vec<_>, _>>()?;
    let matrix = Matrix::from_rows(n, &rows);
    if rows.len() != n || matrix.transpose() != matrix {
        return reject("gram", &node.place, "a symmetric matrix is needed");
    }
    for k in 0..n {
        crate::number::spend(n * n, rows.iter().map(|r| crate::number::size(r)).max().unwrap_or(0))?;
        if !rows[k][k].is_positive() {
            return reject("gram", &node.place, "the matrix is not positive definite");
        }
        let pivot = rows[k].clone();
        for row in rows.iter_mut().skip(k + 1) {
            let factor = &row[k] / &pivot[k];
            row.iter_mut().zip(&pivot).for_each(|(x, p)| *x -= &factor * p);
        }
    }
    Ok(matrix)
}

/// Enclosures of the coordinates of `view · v`.
pub fn seen(field: &Field, view: &Matrix, v: &[Poly]) -> Result<Vec<Interval>, Rejected> {
    (0..view.rows).map(|i| field.enclose(&weighted(view.row(i), v)?)).collect()
}

/// Whether some two of the vectors have a 2x2 minor that is certainly not 0.
pub fn span_a_plane(vectors: &[Vec<Interval>]) -> bool {
    (0..vectors.len()).any(|k| vectors[..k].iter().any(|w| not_parallel(&vectors[k], w)))
}

/// Whether two vectors have a 2x2 minor that is certainly not 0.
pub fn not_parallel(a: &[Interval], b: &[Interval]) -> bool {
    let minor = |i: usize, j: usize| a[i].times(&b[j]).minus(&a[j].times(&b[i])).sign() != 0;
    (0..a.len()).any(|i| (0..i).any(|j| minor(i, j)))
}

/// Whether none, one or two vectors are certainly independent at `θ`; more are not read.
fn independent(field: &Field, vectors: &[&[Poly]]) -> Result<bool, Rejected> {
    let values = |v: &[Poly]| v.iter().map(|x| field.enclose(x)).collect::<Result<Vec<_>, _>>();
    Ok(match vectors {
        [] => true,
        [v] => values(v)?.iter().any(|x| x.sign() != 0),
        [v, w] => not_parallel(&values(v)?, &values(w)?),
        _ => false,
    })
}
