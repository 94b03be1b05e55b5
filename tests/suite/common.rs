//! Mechanisms for the integration tests, written as scenario text, so that tests use the same input as a user.

pub mod chain;
pub mod damage;
pub mod dial;
pub mod disc;
pub mod entries;
pub mod expected;
pub mod four_link;
pub mod higher;
#[cfg(target_os = "linux")]
pub mod hostile;
pub mod loads;
pub mod many;
pub mod parquet;
pub mod random;
pub mod sliders;
pub mod specimens;

pub(crate) use dial::assert_within;
pub use lab::specimens::{sketch, spec};
use linkage::case::{Case, Grid};
use linkage::math::Vec2;
use linkage::mechanism::LinkId;
use linkage::solver::{Solver, State};
use scenario::Scenario;

/// Number of random mechanisms, faults or inputs that a test draws: `ordinary` times `LINKPROOF_DRAWS`.
/// An ordinary run already covers every kind of mechanism, fault or input; the factor only adds examples.
pub fn draws(ordinary: usize) -> usize {
    ordinary * std::env::var("LINKPROOF_DRAWS").map_or(1, |times| times.parse().expect("LINKPROOF_DRAWS: a number"))
}

/// Whether tests draw more examples than in an ordinary run.
pub fn by_night() -> bool {
    draws(1) > 1
}

/// A scenario of the repository.
pub fn shipped(name: &str) -> Scenario {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios").join(name);
    Scenario::load(&path).unwrap_or_else(|error| panic!("{error}"))
}

/// The end of a shipped scenario's text: numbers from a foreign program.
/// The foreign numbers are valid only for the unchanged case, so a test that changes the text must omit them.
pub fn from_outside(text: &str) -> &str {
    &text[text.find("# Not published").expect("numbers from outside stand last")..]
}

/// Names of the Rapier engines.
/// The list contains the engines in single precision only in builds with the feature `f32`.
pub fn rapiers() -> Vec<&'static str> {
    let single = |name: &&str| cfg!(feature = "f32") || !name.ends_with("-f32");
    ["rapier", "rapier-f32", "impulse", "impulse-f32"].into_iter().filter(single).collect()
}

/// The states that a solver computes at the given times (s), in their order.
pub fn states(solver: &dyn Solver, case: &Case, times: &[f64]) -> linkage::Result<Vec<State>> {
    let case = case.on(Grid::of_times(case.crank(), times.to_vec())).unwrap();
    let mut found: Vec<Option<State>> = vec![None; times.len()];
    let mut keep = |row: usize, state: &State| {
        found[row] = Some(state.clone());
        Ok(())
    };
    solver.each(&case, &mut keep)?;
    Ok(found.into_iter().map(|state| state.expect("every row is visited")).collect())
}

/// Position of a link's mass centre.
pub fn centre(case: &Case, state: &State, link: LinkId) -> Vec2 {
    state.motions[link].point(case.mechanism.links()[link].mass_centre)
}

/// Velocity of a link's mass centre.
pub fn centre_velocity(case: &Case, state: &State, link: LinkId) -> Vec2 {
    state.motions[link].point_velocity(case.mechanism.links()[link].mass_centre)
}

/// Acceleration of a link's mass centre.
pub fn centre_acceleration(case: &Case, state: &State, link: LinkId) -> Vec2 {
    state.motions[link].point_acceleration(case.mechanism.links()[link].mass_centre)
}
