//! The signs that decide at a vertex: of the characteristic map, and of the function of one eigenvector.

use super::block::Vertex;
use super::field::{Enclosures, Field as _, Fixed};
use super::limit::Ring;
use super::net::{Net, Signs};
use super::ring::{Values, jacobian, patches};
use super::turning::{Rotation, Turning};
use crate::arith::Rational;
use crate::ring::{Field as _, Ring as _};

/// What is known of the characteristic map.
pub(super) struct Map {
    /// The signs of the Jacobian determinant on the patches of one sector.
    pub jacobian: Signs,
    /// A functional that is positive on the sector.
    pub half_plane: Option<(Rational, Rational)>,
}

/// The characteristic map on the patches of a sector, with this many halvings.
pub(super) fn map(field: &Enclosures, patches: &[Net<Turning<Fixed>>], halvings: usize) -> Map {
    let mut signs = Signs::default();
    for (index, patch) in patches.iter().enumerate() {
        signs.examine(field, index, jacobian(field, patch), halvings);
    }
    Map { jacobian: signs, half_plane: half_plane(field, patches, halvings) }
}

/// The same for a scheme without Bézier patches, from enclosures.
pub(super) fn map_on_ring(ring: &Ring, field: &Enclosures) -> Map {
    let (functional, unit) = ring.towards(field.to_f64(&field.twice_cosine()));
    let half_plane = (ring.functional(functional, false).strict() == Some(1)).then(|| {
        (Rational::from(functional.0) / Rational::from(unit), Rational::from(functional.1) / Rational::from(unit))
    });
    Map { jacobian: ring.jacobian(), half_plane }
}

/// The function of block 0 or n/2 on the ring.
pub(super) fn function(
    vertex: &Vertex,
    field: &Enclosures,
    values: &Values<Fixed>,
    k: usize,
) -> Option<Vec<Net<Fixed>>> {
    // ω = 1 in block 0, where nothing turns, and −1 in block n/2.
    let scalar = |p: &Turning<Fixed>| if k == 0 { field.add(&p.x, &p.y) } else { field.sub(&p.x, &p.y) };
    Some(patches(vertex, field, values)?.iter().map(|p| p.map(scalar)).collect())
}

/// The signs of a function on patches, with this many halvings.
pub(super) fn signs_of(field: &Enclosures, nets: Vec<Net<Fixed>>, halvings: usize) -> Signs {
    let mut signs = Signs::default();
    nets.into_iter().enumerate().for_each(|(index, net)| signs.examine(field, index, net, halvings));
    signs
}

/// The signs of the function of block 0 or n/2 of a scheme without Bézier patches, on the ring or on its innermost cells.
pub(super) fn function_on_ring(ring: &Ring, k: usize, innermost: bool) -> Signs {
    ring.functional((1, if k == 0 { 1 } else { -1 }), innermost)
}

/// A functional that is positive on the whole ring of a sector, proved on its Bernstein coefficients.
///
/// The ring then avoids 0, and its outer boundary, which leads from a point `P` to `ω P`, turns by an angle between −π and π,
/// which can only be that of `ω`: the whole boundary winds `k` times around 0.
fn half_plane(field: &Enclosures, patches: &[Net<Turning<Fixed>>], halvings: usize) -> Option<(Rational, Rational)> {
    let rotation = Rotation(field);
    let mut sum = rotation.zero();
    patches.iter().flat_map(|p| p.rows.iter().flatten()).for_each(|p| sum = rotation.add(&sum, p));
    // The scalar product with the sum of all points, in the metric of the true plane; rounded to a short fraction.
    let half = Rational::from_signeds(1, 2);
    let mixed = |a: &Fixed, b: &Fixed| {
        let value = field.add(a, &field.scale(&field.mul(&field.twice_cosine(), b), &half));
        let scaled = field.to_interval(&value).mid() * Rational::from(1 << 12);
        use malachite_base::num::arithmetic::traits::Floor;
        Rational::from(scaled.floor()) / Rational::from(1 << 12)
    };
    let g = (mixed(&sum.x, &sum.y), mixed(&sum.y, &sum.x));
    let mut signs = Signs::default();
    for (index, patch) in patches.iter().enumerate() {
        let values = patch.map(|p| field.add(&field.scale(&p.x, &g.0), &field.scale(&p.y, &g.1)));
        signs.examine(field, index, values, halvings);
    }
    (signs.strict() == Some(1)).then_some(g)
}
