//! Schemes turned into shapes: masks, named curves, tensor products, mesh rules at extraordinary vertices, imports.

mod border;
mod curves;
mod error;
mod fractint;
mod interpolation;
mod irrational;
mod json;
mod lattice;
mod laurent;
mod mask;
mod mesh;
mod ordered;
mod own;
mod patch;
mod refine;
mod registry;
mod rule;
mod rules;
mod sector;
mod spans;
mod symbol;
mod tensor;
mod text;
mod univariate;
mod vertex;
mod wavelets;

pub use border::{BorderError, BorderScheme, BorderSide, MAX_COLUMN, NamedSide, averaged_border};
pub use curves::{
    PlaneMap, arrowhead, bezier, corner_cutting, dragon, fern, hilbert, koch, lebesgue, levy, minkowski_sausage,
    okamoto, peano, plane_shape, sierpinski, takagi, terdragon,
};
pub use error::SchemeError;
pub use fractint::{FractintEntry, parse_fractint};
pub use interpolation::{Interpolation, MAX_INTERPOLATION, Matching, product_surface};
use irrational::daubechies_texts;
pub use irrational::{FieldLocalMatrix, FieldMask, daubechies, field_local_matrix};
pub use json::parse_json;
pub use lattice::{
    BoxSpline, Dilation, LatticeError, LatticeMask, Terms, lattice_names, lattice_patch, named_mask, point,
};
pub use laurent::{Laurent, MAX_WIDTH};
pub use mask::{MAX_ARITY, MAX_DIMENSION, Mask, Normalisation};
pub use mesh::Sector;
pub use ordered::{Ordered, PointOrder, ordered};
pub use own::{Centre as OwnCentre, Element, Formula, OwnRule, Term};
pub use patch::{disc, disc_complex, patch};
pub use registry::{Parameter, SchemeInfo, build, build_with_vertices, list, mask, mask_family};
pub use rule::{AllValences, MeshRule, RuleInfo, Spline, Split, rational_cosine};
pub(crate) use rule::{Corners, Lattice};
pub use rules::{mesh_rule, mesh_rules};
pub use sector::{Place, SectorStencils, Weight, cosine_stencils, disc_places, sector_stencils};
pub use spans::{Ends, clamped_knots, of_spans, over_knots, windows};
pub use tensor::{MAX_COORDINATES, kronecker, tensor};
pub use text::{Heading, case_text, complex_text};
pub use univariate::{
    MAX_DEGREE, bspline, dubuc_deslauriers, four_point, hormann_sabin, ternary_four_point, ternary_three_point,
};
pub use vertex::{LocalMatrix, MAX_POINTS, MAX_VALENCE, local_matrix, local_matrix_of};
pub use wavelets::{Family, wavelet_mask, wavelet_names};
