//! Random mechanisms of all five kinds of dyads; every run has the same mechanisms.

use std::cell::RefCell;
use std::collections::BTreeMap;

pub use lab::specimens::dyads::{DEAD, DyadSpecimen, REACH, SORTS, chain, dyad, sample, sort};
use linkage::math::KeepNan;
use linkage::mechanism::{Group, LinkPose};
use proptest::test_runner::TestCaseError;

use super::assert_within;
use super::dial::accepts;
use super::sketch::RandomSource;

/// Checks that the requested assembly mode gives the drawn pose.
fn starts_as_drawn(sample: &DyadSpecimen, drawn: &[LinkPose]) {
    for (found, drawn) in sample.scenario.case.start.0.iter().zip(drawn) {
        let turn = linkage::math::angle::wrapped(found.angle - drawn.angle);
        let off = (found.origin - drawn.origin).norm().larger(turn.abs());
        // The bound allows for the rounding error accumulated along the dyads.
        assert_within!(off, 1e-13 * sample.condition.powi(2), "{off:e}\n{}", sample.spec.toml());
    }
}

/// Runs `check` on `count` random mechanisms of one to three dyads of all kinds.
pub fn for_each(count: u32, check: impl Fn(&DyadSpecimen) -> Result<(), TestCaseError>) {
    for_each_of(&SORTS, 3, count, check);
}

/// Runs `check` on `count` random mechanisms of one to `most` dyads of the given kinds.
/// The numbers of dyads follow each other in turn; for mechanisms with a single dyad, so do the kinds.
pub fn for_each_of(
    allowed: &[[bool; 3]],
    most: usize,
    count: u32,
    check: impl Fn(&DyadSpecimen) -> Result<(), TestCaseError>,
) {
    let mut random = RandomSource::from_seed(5);
    let (mut checked, mut drawn, mut sorts) = (0, 0, BTreeMap::new());
    while checked < count {
        drawn += 1;
        assert!(drawn < 100 * count, "only {checked} of {drawn} mechanisms keep away from dead points");
        let dyads = 1 + checked as usize % most;
        let kind = checked as usize / most % allowed.len();
        let (spec, poses) = chain(&mut random, if dyads == 1 { &allowed[kind..=kind] } else { allowed }, dyads);
        let Some(sample) = sample(spec) else { continue };
        starts_as_drawn(&sample, &poses);
        let groups: &[Group] = &sample.scenario.case.structure.groups;
        assert_eq!(groups.len(), dyads, "{}", sample.spec.toml());
        groups.iter().for_each(|group| *sorts.entry(group.pairs()).or_insert(0) += 1);
        check(&sample).unwrap_or_else(|error| panic!("{error}\n{}", sample.spec.toml()));
        checked += 1;
    }
    println!("{checked} of {drawn} mechanisms: {sorts:?}; {}", worst());
    assert!((count as usize) < most * allowed.len() || sorts.len() == allowed.len(), "{sorts:?}");
}

thread_local! {
    /// For each quantity, the largest ratio of a value to its bound in this test.
    static WORST: RefCell<BTreeMap<String, f64>> = const { RefCell::new(BTreeMap::new()) };
}

fn worst() -> String {
    let all = |worst: &BTreeMap<String, f64>| worst.iter().map(|(what, share)| format!("{what} {share:.3}")).collect();
    WORST.with_borrow(|worst| -> Vec<String> { all(worst) }).join(", ")
}

/// Fails if [`accepts`] does not accept `value` within `bound`; the message states both numbers.
pub fn within(what: &str, value: f64, bound: f64) -> Result<(), TestCaseError> {
    WORST.with_borrow_mut(|worst| {
        let most = worst.entry(what.into()).or_insert(0.0f64);
        *most = most.larger(value / bound);
    });
    if accepts(value, bound) {
        Ok(())
    } else {
        Err(TestCaseError::fail(format!("{what}: {value:.3e} is beyond {bound:.3e}")))
    }
}
