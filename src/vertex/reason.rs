//! What was found at a vertex and why, as data. The words are in [`crate::report::vertex_reasons`].

use crate::scheme::SchemeError;
use crate::statement::Statement;

/// What a verdict at one valence rests on, or what is missing. A `length` is that of the longest Jordan blocks of the largest
/// eigenvalues, a `block` a frequency.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum VertexReason {
    /// Nothing was examined yet.
    Unexamined,
    /// A Fourier block cannot be used.
    Block(SchemeError),
    /// There is no second eigenvalue.
    NoSecond,
    /// The largest eigenvalues were not separated: real parts and blocks.
    Close(Vec<(f64, usize)>),
    /// No bounds of the regular rule were found (Lemma 4).
    RegularRule,
    /// The leading vectors span three dimensions or more.
    Span {
        /// The length.
        length: usize,
        /// How many.
        dimension: usize,
    },
    /// The two leading eigenvectors are the same in every second sector.
    Sectors,
    /// At valence 2 both leading vectors are in block 1.
    TwoFaces,
    /// Two leading vectors of a kind that is not covered.
    Uncovered {
        /// The length.
        length: usize,
    },
    /// Besides 1, counted once, an eigenvalue has modulus 1 or more.
    NoLimit,
    /// Besides 1, counted once, an eigenvalue is not proved to be smaller than 1 in modulus.
    LimitOpen,
    /// One eigenvector leads, and its function on the ring has no zero.
    Line {
        /// The length.
        length: usize,
        /// Its block.
        block: usize,
    },
    /// One eigenvector of block 0 leads, and its function has no zero on a closed path around the vertex.
    Path {
        /// The length.
        length: usize,
    },
    /// One eigenvector leads, and its function on the ring has a zero.
    LineZero {
        /// The length.
        length: usize,
        /// Its block.
        block: usize,
    },
    /// One eigenvector leads; whether its function has a zero on the ring is open.
    LineOpen {
        /// The length.
        length: usize,
        /// Its block.
        block: usize,
    },
    /// The leading Jordan blocks live in a block other than 1; whether their ring avoids 0 is open.
    RingOpen {
        /// The block.
        block: usize,
    },
    /// The leading eigenvectors live in a block other than 1.
    Winding {
        /// The length.
        length: usize,
        /// The block.
        block: usize,
        /// How often the ring winds around the vertex, where it avoids 0.
        times: Option<usize>,
    },
    /// No bounds of the derivatives on the ring were found (Lemma 4).
    Derivatives {
        /// The length.
        length: usize,
    },
    /// The characteristic map is regular and winds once around 0.
    Regular {
        /// The length.
        length: usize,
    },
    /// The Jacobian determinant changes its sign.
    Fold,
    /// The sign of the Jacobian determinant is open somewhere.
    JacobianOpen,
    /// A statement on vertices of the border.
    Border(BorderGround),
    /// The signs that such a statement asks for are open.
    BorderOpen,
    /// No half-plane through 0 holds the ring of one sector.
    HalfPlane,
}

/// What a verdict on a fan of faces at the border rests on, or would.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BorderGround {
    /// The characteristic map is affine.
    Affine,
    /// It is regular and maps the fan into a wedge.
    Map,
    /// A Jordan block of 1/2.
    Jordan,
    /// One face at a smooth border.
    OneFace,
    /// Two inner modes go before the border: the normals inside tend to another one than those on the border.
    Modes,
    /// An inner mode goes before the two sides of a corner.
    Sides,
}

impl BorderGround {
    /// The statement of which the verdict is an instance.
    #[must_use]
    pub fn statement(self) -> Statement {
        match self {
            Self::Affine | Self::Map => Statement::BorderVertex,
            Self::Jordan => Statement::BorderJordan,
            Self::OneFace => Statement::BorderOneFace,
            Self::Modes | Self::Sides => Statement::BorderRefuted,
        }
    }
}

/// A condition of the proof for all valences at once (Theorem 9).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Requirement {
    /// λ is an eigenvalue of block 1.
    Eigenvalue,
    /// What a positive polynomial says of other eigenvalues, from the row of the rule.
    Row(&'static str),
    /// The eigenvalues that do not depend on the frequency are smaller than λ.
    Constants,
    /// The characteristic map is known as a rational function of the parameter.
    Known,
    /// No denominator of the Bézier points vanishes.
    Denominators,
    /// The Bernstein coefficients of the Jacobian determinant are positive.
    Jacobian,
    /// The ring of a sector lies in an open half-plane through 0.
    HalfPlane,
}
