//! Shapes that start somewhere: states of different dimensions, seen through control points.

mod automata;

use automata::{automaton, plans};
use proptest::prelude::*;
use secant::theorem::{PointReport, certify};

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, ..ProptestConfig::default() })]

    /// Positions belong to the start state, images to the control points, and everything else to no control point.
    #[test]
    fn random_automata_with_control_points_are_examined(plan in plans()) {
        let shape = automaton(&plan);
        let Ok(found) = certify(&shape, &[]) else { return Ok(()) };
        for p in &found.points {
            prop_assert_eq!(p.position.len(), plan.dims[0]);
            let image = shape.control.as_ref().map(|c| c.apply(&p.position));
            prop_assert_eq!(&p.image, &image);
        }
        let own = |p: &PointReport| p.image.is_none();
        prop_assert!(found.dense.iter().flat_map(|d| &d.upstairs).all(own));
    }
}
