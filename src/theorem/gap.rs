//! Why branches, points, curves and surfaces are refuted or open, as data. The words are in [`crate::report::reasons`].

/// Why there are no points of the shape near the point of a branch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum NoGerm {
    /// The cell of the address is a single point.
    SinglePoint,
    /// The relevant space is 0.
    NoSpace,
    /// `L` is nilpotent, and no image of the ring holds the point.
    Isolated {
        /// Whether all points of the shape near it belong to the branch.
        shape: bool,
    },
}

/// Why it is not decided what follows at a branch, of a curve, a set or a surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum BranchGap {
    /// `L` is nilpotent and the ring passes through the point: its germ is that of finitely many pieces.
    NilpotentRing,
    /// `L` is nilpotent, and it is open whether the ring passes through the point.
    NilpotentOpen,
    /// `L` is nilpotent: the cells of the branch shrink to the point after finitely many turns (surfaces).
    NilpotentCells,
    /// The control points fold the directions of the largest modulus, or may fold them.
    Folded,
    /// A point of the ring falls into the generalised kernel.
    KernelPoint,
    /// The branch is not isolated.
    NotIsolated,
    /// Whether the branch is isolated is open.
    IsolationOpen,
    /// The ring condition is open; the cell is beside it.
    RingOpen,
    /// The ring condition fails, and what follows is open.
    RingFails,
}

/// Why a point of a curve or a set is refuted or open.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum PointGap {
    /// The tangent subspace has more than one dimension.
    Dimension,
    /// Directions that the tangent subspaces of the two sides are known to contain lie on different lines.
    Spread,
    /// The tangent lines of the two sides differ.
    SidesDiffer,
    /// What was found at one of its branches, by index.
    Branch(usize),
}

/// Why a point of a surface is refuted or open.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum PlaneGap {
    /// The tangent subspace has more than two dimensions.
    Dimension,
    /// The surface is a single point near this one.
    SinglePoint,
    /// The tangent subspace is a line.
    Line,
    /// The tangent subspaces of the branches are known, but not whether they agree.
    Agreement,
    /// What was found at one of its branches, by index.
    Branch(usize),
    /// The theorem on tensor products and the general one disagree.
    Contradiction,
    /// One of the two curves of a product has no tangent line there.
    ProductCurve,
}

/// Why G¹ is refuted or open.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum EveryGap {
    /// The first turn of the derivative of a polynomial curve.
    Turn,
    /// What breaks at a point, by its index in [`super::Certified::points`].
    Broken(usize),
    /// No functional was found that is positive on the projected cones.
    Unseen,
    /// A first-level joint is open.
    Joint,
    /// The cycle of the obstacle admits no strictly invariant cone.
    Obstacle,
    /// No common cone was found within the budget.
    NoCone,
}

/// Why it is open whether a surface is G¹.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum EverySurfaceGap {
    /// It has no parameters: it starts at no face, or its parts are not placed evenly.
    Unparametrised,
    /// It is no tensor product of two curves of one state each, none of whose pieces is a point.
    NoProduct,
    /// It is a tensor product that is seen through control points that are not injective on its relevant space.
    Folded,
    /// One of the two curves of a product, 0 or 1, of which it is not decided whether it is G¹.
    Curve(usize),
    /// There are too many coordinates for the derivative in the parameters.
    Large,
    /// Not all pieces that lead back to their face are of one size in the parameters, or two faces are divided differently along an
    /// edge that they share.
    Unequal,
    /// The joint spectral radius on the differences of the derivative is not seen to be below that size.
    Radius,
    /// The derivatives on the two sides of an edge differ at some point.
    Edge {
        /// The state inside which it is.
        state: usize,
        /// The pieces that share it.
        letters: [usize; 2],
    },
    /// The derivative is not seen to keep its rank under the control points.
    Rank,
    /// There are too many stars for cones around planes, or too many coordinates.
    LargeStars,
    /// No forms of signature (2, ·) were found that all stars expand from their children.
    NoForms {
        /// The cells of a star without one where it first occurs, as words from the start.
        star: Vec<Vec<usize>>,
    },
    /// The forms that were found are not seen to be positive on all secants between parts that do not meet.
    Secants,
    /// The control points, or the coordinates of the face, are not seen to keep the cones apart from 0.
    Folds,
    /// It is proved, and at a point there is no tangent plane.
    Contradiction,
}

/// What is wrong with the leading eigenvalues of a cycle, so that it has no strictly invariant cone.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Defect {
    /// No eigenvalue but 0.
    Nilpotent,
    /// Complex eigenvalues of largest modulus.
    Complex,
    /// Several eigenvalues of largest modulus.
    Several,
    /// A multiple eigenvalue of largest modulus.
    Multiple,
    /// A negative leading eigenvalue.
    Negative,
}

/// The row of the table of theory §5 for surfaces that describes the top of a spectrum.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum TopRow {
    /// There is no eigenvalue.
    Empty,
    /// The cell is a single point.
    SinglePoint,
    /// 0 is the only eigenvalue.
    Nilpotent,
    /// One real simple eigenvalue alone in its modulus.
    Simple,
    /// One complex pair, semisimple.
    Pair,
    /// A double real eigenvalue with two eigenvectors.
    Double,
    /// `λ` and `−λ`, both simple.
    Opposite,
    /// More than two eigenvectors of the largest modulus.
    ManyVectors,
    /// One longest Jordan block, of a real eigenvalue.
    Block,
    /// A complex pair with one longest Jordan block each.
    PairBlocks,
    /// Two longest Jordan blocks.
    TwoBlocks,
    /// More than two longest Jordan blocks.
    ManyBlocks,
}

/// Why the parameters of a surface are not used.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum NoChart {
    /// The sides of a face are not given.
    Sides {
        /// Its state.
        state: usize,
    },
    /// The cells of a face do not shrink in both directions.
    Shrinking {
        /// Its state.
        state: usize,
    },
    /// Opposite sides of a face are divided by different shares, or it has turned pieces beside sides that are divided by shares.
    Shares {
        /// Its state.
        state: usize,
    },
    /// A piece is not placed by a symmetry.
    Symmetry {
        /// The state that it divides.
        state: usize,
        /// Its letter.
        letter: usize,
    },
}
