//! The part of a spectrum with the largest modulus, proved without factorisation.

use crate::base::{
    Checked, Enclosed, Field, Interval, Matrix, Node, Q, Whole, bits, has_root_near, roots_in_disc, spend, values,
    whole,
};
use num_bigint::BigInt;
use num_traits::{Signed, Zero, pow};

/// A Jordan chain `v_1, v_2, …` with `(L − sθ) v_1 = 0` and `(L − sθ) v_{j+1} = v_j`.
pub struct Chain {
    /// `s = ±1`.
    pub sign: i32,
    /// The vectors, over the field.
    pub vectors: Vec<Matrix>,
}

/// The eigenvalues outside a disc, all of one modulus, with their whole generalised eigenspaces.
pub enum Top<T = BigInt> {
    /// `±θ` for a real number `θ`, with a Jordan basis.
    Real {
        /// The field of `θ`.
        field: Field,
        /// The chains.
        chains: Vec<Chain>,
    },
    /// Complex conjugate eigenvalues with one Jordan block each.
    Pair {
        /// A square that holds the root of `m` of one of them: its real and its imaginary side.
        square: [Interval; 2],
        /// Its eigenvector over `Q[x]/(m)`.
        vector: Matrix,
        /// This algebra.
        field: Field,
    },
    /// An invariant subspace over the field of the case on which `L` is a conformal map for some scalar product; its basis as rows.
    Conformal(Matrix<T>),
}

/// The radius, and how many roots of the characteristic polynomial have a larger modulus; none has this one.
pub fn outside<T: Whole>(chi: &Matrix<T>, radius: &Node<'_>) -> Checked<(Q, usize)> {
    let (r, n) = (radius.rational()?, chi.cols - 1);
    radius.need(r.is_positive(), "disc", "the radius must be positive")?;
    spend(3 * chi.cols, chi.bits() + bits(&r) * n as u64)?;
    // Multiples of a_k r^k: a_k p^k q^(n - k).
    let scaled = |(k, a): (usize, &T)| a.multiple(&(pow(r.numer().clone(), k) * pow(r.denom().clone(), n - k)));
    let inside = roots_in_disc(&T::short(chi.data.iter().enumerate().map(scaled).collect())?)?;
    let inside = radius.some(inside, "disc", "the recursion of Schur and Cohn is not regular for this radius")?;
    // A top without eigenvalues would have nothing to prove.
    radius.need(inside < n, "disc", "no eigenvalue lies outside the disc")?;
    Ok((r, n - inside))
}

/// `M v − s λ v` for a vector over the field of `λ`.
pub fn residual<T: Whole>(field: &Field, matrix: &Matrix<T>, sign: i32, v: &Matrix) -> Checked<Matrix> {
    Ok(field.applied(matrix, v)?.plus(&whole(-i64::from(sign)), &v.times(&field.by_value)?))
}

/// Reads the vectors of a Jordan chain of the eigenvalue `s λ`.
pub fn chain<T: Whole>(
    list: &Node<'_>,
    matrix: &Matrix<T>,
    field: &Field,
    sign: i32,
    rule: &str,
) -> Checked<Vec<Matrix>> {
    let mut vectors: Vec<Matrix> = Vec::new();
    for item in list.list()? {
        let v = field.vector(&item, matrix.rows)?;
        let residual = residual(field, matrix, sign, &v)?;
        let continues = match vectors.last() {
            None => residual.is_zero(),
            Some(before) => residual == *before,
        };
        item.need(continues, rule, "the vector does not continue the Jordan chain")?;
        vectors.push(v);
    }
    list.need(!vectors.is_empty(), rule, "a chain is not empty")?;
    Ok(vectors)
}

impl<T: Whole> Top<T> {
    /// Reads and checks the evidence for the top of the spectrum of `linear`.
    pub fn read(node: &Node<'_>, linear: &Matrix<T>, ground: &T::Ground) -> Checked<Self> {
        let read = match node.tag("top")? {
            "real" => Self::real(node, linear, ground),
            "pair" => Self::pair(node, linear, ground),
            "conformal" => Self::conformal(node, linear, ground),
            _ => node.reject("format", "unknown kind of top"),
        };
        node.at(read)
    }

    fn real(node: &Node<'_>, linear: &Matrix<T>, ground: &T::Ground) -> Checked<Self> {
        let [_, radius, polynomial, interval, list] = node.fields("top radius polynomial interval chains")?;
        let (r, count) = outside(&linear.characteristic()?, &radius)?;
        let field = T::field(&polynomial, &interval, ground)?;
        let beyond = field.value[0] > r || field.value[1] < -&r;
        interval.need(beyond, "top-real", "the eigenvalue must lie outside the disc")?;
        let mut chains = Vec::new();
        for item in list.list()? {
            let [sign, vectors] = item.fields("sign vectors")?;
            let sign = match sign.text()? {
                "+" => 1,
                "-" => -1,
                _ => return sign.reject("format", "a sign is \"+\" or \"-\""),
            };
            chains.push(Chain { sign, vectors: chain(&vectors, linear, &field, sign, "top-real")? });
        }
        let all = chains.iter().map(|c| c.vectors.len()).sum::<usize>() == count;
        list.need(all, "top-real", format_args!("{count} eigenvalues lie outside the disc"))?;
        for s in [1, -1] {
            let starts = chains.iter().filter(|c| c.sign == s).map(|c| field.enclose(&c.vectors[0]));
            let independent = match &starts.collect::<Checked<Vec<_>>>()?[..] {
                [] => true,
                [v] => v.is_nonzero(),
                [v, w] => v.not_parallel(w),
                _ => false,
            };
            list.need(independent, "top-real", "the eigenvectors are not seen to be independent")?;
        }
        Ok(Self::Real { field, chains })
    }

    fn pair(node: &Node<'_>, linear: &Matrix<T>, ground: &T::Ground) -> Checked<Self> {
        let [_, radius, polynomial, centre, error, list] = node.fields("top radius polynomial centre error vectors")?;
        let (r, count) = outside(&linear.characteristic()?, &radius)?;
        let (c, e) = (centre.vector(2)?, error.rational()?);
        let (x, y, far) = (&c[0], &c[1], &r + &e);
        let around = |v: &Q| [v - &e, v + &e];
        let near = |m: &[Q]| {
            node.need(e.is_positive(), "top-pair", "the distance from the centre is positive")?;
            let near = has_root_near(&Matrix::new(1, m.len(), m), &c, &e)?;
            error.need(near, "top-pair", "no root is seen to lie within this distance of the centre")?;
            Ok([around(x), around(y)])
        };
        let (field, square, value) = T::plane(&polynomial, ground, near)?;
        // Of a root in a disc around the centre more is known than of a number in a rectangle.
        let least = |[lo, hi]: &Interval| if lo.is_positive() { lo.clone() } else { (-hi).max(Q::zero()) };
        let (re, im) = (least(&value[0]), least(&value[1]));
        let fits = match field.by_alpha {
            None => *y > e && x * x + y * y > &far * &far,
            Some(_) => im.is_positive() && &re * &re + &im * &im > &r * &r,
        };
        node.need(fits, "top-pair", "an eigenvalue outside the disc and off the real axis is needed")?;
        let vectors = chain(&list, linear, &field, 1, "top-pair")?;
        let vector = vectors[0].clone();
        let [re, im] = values(&vector, &square[0], &square[1])?;
        let all = 2 * vectors.len() == count && (re.is_nonzero() || im.is_nonzero());
        list.need(all, "top-pair", format_args!("{count} eigenvalues lie outside the disc, or the vector may be 0"))?;
        Ok(Self::Pair { square, vector, field })
    }

    fn conformal(node: &Node<'_>, linear: &Matrix<T>, ground: &T::Ground) -> Checked<Self> {
        let [_, radius, basis, gram, square] = node.fields("top radius basis gram square")?;
        let (r, count) = outside(&linear.characteristic()?, &radius)?;
        let e: Matrix<T> = basis.entries(linear.rows, ground)?;
        let (echelon, pivots) = e.echelon()?;
        let fits = echelon == e && e.rows == count;
        basis.need(fits, "top-conformal", format_args!("{count} rows in reduced echelon form are needed"))?;
        let images = e.times(&linear.transpose())?;
        // Rows are images of basis vectors: this is the transpose of L on the space.
        let inner = images.columns(&pivots);
        basis.need(inner.times(&e)? == images, "top-conformal", "the space is not invariant")?;
        let (h, c) =
            (positive_definite(&gram, e.rows, ground)?, Matrix::fractions(1, 1, &[T::entry(&square, ground)?]));
        let beyond = c.plus(&-(&r * &r), &Matrix::identity(1)).all_positive();
        let stretches = beyond && inner.times(&h)?.times(&inner.transpose())? == h.multiple(&c);
        square.need(stretches, "top-conformal", "the map does not stretch the scalar product by this factor")?;
        Ok(Self::Conformal(e))
    }

    /// The eigenvectors that end the longest chains, or the one that stands for real and imaginary part.
    fn longest(&self) -> Vec<&Matrix> {
        match self {
            Self::Real { chains, .. } => {
                let longest = chains.iter().map(|c| c.vectors.len()).max();
                let ending = chains.iter().filter(|c| Some(c.vectors.len()) == longest);
                ending.map(|c| &c.vectors[0]).collect()
            }
            Self::Pair { vector, .. } => vec![vector],
            Self::Conformal(_) => Vec::new(),
        }
    }

    /// Enclosures of real vectors that span the real and imaginary parts of the images of these vectors under `view`.
    pub fn directions(&self, view: &Matrix<T>) -> Checked<Vec<Enclosed>> {
        let image = |field: &Field, v: &Matrix| field.applied(view, v);
        Ok(match self {
            Self::Real { field, .. } => {
                self.longest().into_iter().map(|v| field.enclose(&image(field, v)?)).collect::<Checked<_>>()?
            }
            Self::Pair { square, vector, field } => values(&image(field, vector)?, &square[0], &square[1])?.into(),
            Self::Conformal(basis) => {
                let column = |i: usize| Ok(T::enclosed(&view.times(&basis.row(i).transpose())?));
                (0..basis.rows).map(column).collect::<Checked<_>>()?
            }
        })
    }
}

impl Top {
    /// The image under `view` of the same vectors, by their coefficients: over the field, over `Q[x]/(m)`, or rational.
    pub fn ends(&self, view: &Matrix) -> Checked<Vec<Matrix>> {
        match self {
            Self::Conformal(basis) => (0..basis.rows).map(|i| view.times(&basis.row(i).transpose())).collect(),
            _ => self.longest().into_iter().map(|v| view.times(v)).collect(),
        }
    }
}

/// Reads a symmetric matrix whose elimination without exchanges has positive pivots only.
pub fn positive_definite<T: Whole>(node: &Node<'_>, n: usize, ground: &T::Ground) -> Checked<Matrix<T>> {
    let matrix: Matrix<T> = node.entries(n, ground)?;
    node.need(matrix.rows == n && matrix.transpose() == matrix, "gram", "a symmetric matrix is needed")?;
    node.need(matrix.is_positive(true)?, "gram", "the matrix is not positive definite")?;
    Ok(matrix)
}

/// Whether some two of the vectors have a 2x2 minor that is certainly not 0.
pub fn span_a_plane(vectors: &[Enclosed]) -> bool {
    (0..vectors.len()).any(|k| vectors[..k].iter().any(|w| vectors[k].not_parallel(w)))
}
