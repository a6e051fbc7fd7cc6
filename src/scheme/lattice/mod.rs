//! Masks on lattices: `p'_a = Σ_b m(a − Mb) p_b` on `Z^s`, for a dilation `M`.

mod dilation;
mod named;
mod patch;
mod terms;

pub use dilation::Dilation;
pub use named::{BoxSpline, lattice_names, named_mask};
pub use patch::lattice_patch;
pub use terms::Terms;

use super::SchemeError;
use crate::arith::{ParseNumberError, Rational};
use std::fmt::Write as _;
use thiserror::Error;

/// Why there is no mask on a lattice.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum LatticeError {
    /// A dilation that is not square.
    #[error("a dilation is a square matrix of 1 to 4 rows of whole numbers, such as [[1,1],[1,-1]]")]
    Square,
    /// An entry of a dilation that is too large.
    #[error("the entries of a dilation are from -{0} to {0}")]
    Entry(i64),
    /// A determinant that is too small or too large.
    #[error("the determinant of the dilation is {found} in modulus, but must be from 2 to {most}")]
    Index {
        /// The modulus found.
        found: i64,
        /// The largest.
        most: i64,
    },
    /// Eigenvalues of different moduli, or a Jordan block.
    #[error(
        "the eigenvalues of this dilation have different moduli, or it is not diagonalisable; the statement on masks is about \
         dilations that are similarities in suitable coordinates"
    )]
    Similarity,
    /// A dilation that cannot be read.
    #[error("`{0}` is no dilation: write [[1,1],[1,-1]], quincunx, sqrt3, or a whole number")]
    Text(String),
    /// A patch of a mask that has none.
    #[error("only masks in two variables whose dilation is a multiple of the unit matrix have patches over squares")]
    Patch,
    /// No coefficient.
    #[error("the mask is zero")]
    Zero,
    /// A mask with too many coefficients.
    #[error("the mask has {found} coefficients; at most {most} are handled")]
    Large {
        /// The number found.
        found: usize,
        /// The largest number.
        most: usize,
    },
    /// A mask and a dilation of different dimensions.
    #[error("the mask has {mask} variables, but the dilation {dilation} dimensions")]
    Dimensions {
        /// Of the mask.
        mask: usize,
        /// Of the dilation.
        dilation: usize,
    },
    /// Coefficients that do not sum to 1 on a coset.
    #[error(
        "the coefficients at the points {coset} + M Z^s sum to {sum}, not to 1: the weights of a new point must sum to 1"
    )]
    SumRule {
        /// A point of the coset.
        coset: String,
        /// The sum.
        sum: Rational,
    },
    /// Something about the parameters of a named mask.
    #[error("{0}")]
    Parameter(String),
    /// A number that cannot be read.
    #[error("{0}")]
    Number(#[from] ParseNumberError),
    /// A symbol or a scheme that cannot be read.
    #[error(transparent)]
    Scheme(#[from] SchemeError),
}

/// Most coefficients.
pub const MAX_COEFFICIENTS: usize = 1024;

/// A mask with its dilation; its coefficients sum to 1 on every coset.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LatticeMask {
    terms: Terms,
    dilation: Dilation,
    splines: Option<BoxSpline>,
}

impl LatticeMask {
    /// The mask with these coefficients.
    ///
    /// # Errors
    /// [`LatticeError`].
    pub fn new(terms: Terms, dilation: Dilation) -> Result<Self, LatticeError> {
        if terms.variables() != dilation.dimensions() {
            return Err(LatticeError::Dimensions { mask: terms.variables(), dilation: dilation.dimensions() });
        }
        if terms.is_empty() {
            return Err(LatticeError::Zero);
        }
        if terms.len() > MAX_COEFFICIENTS {
            return Err(LatticeError::Large { found: terms.len(), most: MAX_COEFFICIENTS });
        }
        let mut sums = vec![Rational::from(0); dilation.index()];
        for (a, c) in terms.iter() {
            sums[dilation.coset(a)] += c;
        }
        if let Some((digit, sum)) = dilation.digits().iter().zip(sums).find(|(_, sum)| *sum != 1) {
            return Err(LatticeError::SumRule { coset: point(digit), sum });
        }
        Ok(Self { terms, dilation, splines: None })
    }

    /// Reads a symbol such as `(1+x)^2*(1+y)^2*(1+x*y)^2/16`; the dilation is twice the unit matrix where none is given.
    ///
    /// # Errors
    /// [`LatticeError`].
    ///
    /// # Examples
    /// ```
    /// use secant::scheme::{Dilation, LatticeMask};
    /// let loop_mask = LatticeMask::parse("(1+x)^2*(1+y)^2*(1+x*y)^2/16", None)?;
    /// assert_eq!(loop_mask.terms().len(), 19);
    /// let quincunx = LatticeMask::parse("(1+x)^2*(1+y)^2/8", Some(Dilation::parse("quincunx")?))?;
    /// assert_eq!(quincunx.dilation().index(), 2);
    /// # Ok::<(), secant::scheme::LatticeError>(())
    /// ```
    pub fn parse(text: &str, dilation: Option<Dilation>) -> Result<Self, LatticeError> {
        let variables = match &dilation {
            Some(m) => m.dimensions(),
            None if text.contains("z3") || (text.contains('z') && !text.contains("z1")) => 3,
            None => 2,
        };
        let dilation = dilation.map_or_else(|| Dilation::scalar(variables, 2), Ok)?;
        Self::new(Terms::parse(text, variables)?, dilation)
    }

    /// The same mask, known to be that of a box spline.
    fn of_splines(self, splines: BoxSpline) -> Self {
        Self { splines: Some(splines), ..self }
    }

    /// The same mask, where it is that of the box spline with these directions.
    ///
    /// # Errors
    /// [`LatticeError::Parameter`] where it is another, or has another dilation than twice the unit matrix.
    pub fn with_directions(self, directions: Vec<Vec<i64>>) -> Result<Self, LatticeError> {
        let spline = named::spline(directions)?;
        // A shift of the mask shifts the limit function.
        let start = |m: &Self| m.terms.corners().map(|(low, _)| low);
        let (Some(own), Some(other)) = (start(&self), start(&spline)) else { return Err(LatticeError::Zero) };
        let moved = spline.terms.iter().map(|(a, c)| {
            let a = a.iter().zip(&own).zip(&other).map(|((x, p), q)| x + p - q).collect();
            (a, c.clone())
        });
        if spline.dilation != self.dilation || Terms::new(own.len(), moved) != self.terms {
            return Err(LatticeError::Parameter(
                "the mask is not that of the box spline with these directions".to_owned(),
            ));
        }
        Ok(Self { splines: spline.splines, ..self })
    }

    /// The coefficients.
    #[must_use]
    pub fn terms(&self) -> &Terms {
        &self.terms
    }

    /// The dilation.
    #[must_use]
    pub fn dilation(&self) -> &Dilation {
        &self.dilation
    }

    /// The directions, where the mask was made as that of a box spline.
    #[must_use]
    pub fn box_spline(&self) -> Option<&BoxSpline> {
        self.splines.as_ref()
    }

    /// The coefficient at `a − Mb`.
    #[must_use]
    pub fn weight(&self, a: &[i64], b: &[i64]) -> Option<&Rational> {
        let moved: Vec<i64> = a.iter().zip(self.dilation.apply(b)).map(|(x, y)| x - y).collect();
        self.terms.get(&moved)
    }

    /// The case file of the mask: its coefficients as a grid (docs/case-format.md).
    #[must_use]
    pub fn case_text(&self, name: &str) -> String {
        let rows: Vec<String> = self.dilation.rows().iter().map(|r| format!("{r:?}")).collect();
        let mut out = format!("name = {name:?}\n\n[mask]\ndilation = [{}]\n{}", rows.join(", "), self.grid_text());
        if let Some(splines) = &self.splines {
            let _ = writeln!(out, "directions = {:?}", splines.directions);
        }
        out
    }

    /// The lines of a case with the coefficients.
    pub(in crate::scheme) fn grid_text(&self) -> String {
        let Some((low, high)) = self.terms.corners() else { return String::new() };
        format!("origin = {low:?}\ngrid = {}\n", self.grid(&low, &high, &mut Vec::new()))
    }

    fn grid(&self, low: &[i64], high: &[i64], at: &mut Vec<i64>) -> String {
        let k = at.len();
        if k == low.len() {
            return format!("\"{}\"", self.terms.get(at).map_or_else(|| "0".to_owned(), ToString::to_string));
        }
        let mut parts = Vec::new();
        for x in low[k]..=high[k] {
            at.push(x);
            parts.push(self.grid(low, high, at));
            at.pop();
        }
        let (before, between) = if k == 0 { ("\n  ", ",\n  ") } else { ("", ", ") };
        format!("[{before}{}{}]", parts.join(between), if k == 0 { ",\n" } else { "" })
    }
}

/// A point of the lattice as it is written.
#[must_use]
pub fn point(a: &[i64]) -> String {
    let parts: Vec<String> = a.iter().map(ToString::to_string).collect();
    format!("({})", parts.join(", "))
}
