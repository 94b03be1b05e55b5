//! The generator of random correct mechanisms and its promises.
//! If a proof fails on such a mechanism, the fault lies in the proof.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use analytic::{AssurSolver, NewtonSolver};
use linkage::error::ErrorKind;
use linkage::solver::Solver;
use scenario::Scenario;

use crate::common::specimens::specimen;

/// Tests one specimen of every shape.
/// The same seed gives the same text, and another seed a different text.
/// Both analytic sides solve each specimen, unless they report that they do not support its motion.
#[test]
fn specimens_follow_from_their_seed_and_can_be_solved() {
    let (mut free, mut sorts) = (0, BTreeSet::new());
    for index in 0..10 {
        let mut dropped = BTreeMap::new();
        let own = specimen(3, index, &mut dropped);
        let text = own.toml(true);
        if index < 3 {
            assert_eq!(text, specimen(3, index, &mut dropped).toml(true));
            assert_ne!(text, specimen(4, index, &mut dropped).toml(true));
        }
        assert!(text.ends_with('\n') && text.contains("\ndt_s = ") && !own.toml(false).contains("dt_s"), "{text}");
        let scenario = Scenario::parse(&text, Path::new("specimen.toml")).unwrap_or_else(|error| panic!("{error}"));
        let case = &scenario.case;
        free += usize::from(case.is_free());
        sorts.insert(own.sort.split(',').next().unwrap().to_string());
        // The size is the extent of the largest link; a mass centre may lie beyond this extent.
        let size = case.mechanism.size();
        assert!((0.9e-3..40.0).contains(&size), "{index}: {size} m");
        let solved = [&AssurSolver as &dyn Solver, &NewtonSolver].map(|solver| solver.solve(case));
        assert!(solved.iter().any(Result::is_ok), "{index}: {:?}\n{text}", solved[0].as_ref().err());
        for error in solved.into_iter().filter_map(Result::err) {
            assert_eq!(error.kind(), ErrorKind::Unsupported, "{index}: {error}\n{text}");
        }
    }
    assert!((1..=8).contains(&free) && sorts.len() >= 6, "{free} of 10 are free; {sorts:?}");
}
