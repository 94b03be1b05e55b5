//! The result of `tune`, compared with all settings of a space by the cost model.
//! The tests use a part of the space; `benches/tune.rs` uses the whole space.

use lab::tune::{Tuning, WantedAccuracy, price_of, tune};
use linkage::engine::Engine;
use prover::engines::EngineName;
use prover::run::Options;
use scenario::Scenario;

use super::exhaustive::{Space, cheaper, error_of, truth};

/// Upper limit of the ratio of the result's cost to the lowest cost.
pub const FACTOR: f64 = 1.5;

/// Tunes by the cost model.
pub fn tuned(scenario: &Scenario, within: f64, channels: &[&str], options: &Options) -> linkage::Result<Tuning> {
    let wish = WantedAccuracy { within, channels: channels.iter().map(|name| name.to_string()).collect() };
    let mut price = |engine: &dyn Engine, run: &mut dyn FnMut() -> linkage::Result<()>| {
        run()?;
        Ok(price_of(&scenario.case, engine))
    };
    tune(scenario, &wish, options, &mut price, &mut |_| {})
}

/// Tunes all Rapier engines.
/// The test computes the error of the result again, against the analytic solution, which `tune` does not use.
/// The test also computes the cost of the result again, with the cost model.
/// An exhaustive search then finds the cheapest settings whose cost is below the cost of the result divided by `below`.
/// The cost of the result may be at most [`FACTOR`] times the cost of these settings.
pub fn near_the_cheapest(scenario: &Scenario, within: f64, below: f64, space: &Space) {
    let name = &scenario.name;
    let engines = prover::engines::all(1e-3).into_iter().filter(|engine| !engine.controls_error());
    let named = engines.filter_map(|engine| EngineName::named(engine.name()));
    let options = named.fold(Options::default(), Options::engine);
    let found = tuned(scenario, within, &[], &options).unwrap_or_else(|error| panic!("{name}: {error}"));
    let best = prover::engines::named(found.best.engine, 1e-3).unwrap().with(found.best.settings);
    let verified = error_of(scenario, &truth(scenario), best.as_ref());
    assert!(verified <= within, "{name}: {verified:e} with {:?}", found.best);
    let promised = found.best.verified;
    assert!((verified - promised).abs() <= 1e-6 * within, "{name}: {verified:e}, promised {promised:e}");
    let expected = price_of(&scenario.case, best.as_ref());
    assert!((found.best.price / expected - 1.0).abs() <= 1e-12, "{name}: {:?}, {expected}", found.best);

    let mut price = |engine: &dyn Engine| price_of(&scenario.case, engine);
    let (met, runs) = cheaper(scenario, within, found.cheapest.price / below, space, &mut price);
    let cheapest = met.last().map_or(found.cheapest.price / below, |met| met.price);
    let ratio = found.cheapest.price / cheapest;
    println!(
        "{name} within {within:e}: {ratio:.2} of the cheapest or less, {:?}, {} runs and {runs}, expected {:.1e}",
        found.best, found.runs, found.predicted
    );
    let told = met.last().map(|met| (met.engine.name(), met.engine.settings(), met.error));
    assert!(ratio <= FACTOR, "{name}: {ratio} times the cheapest: {:?}, cheapest {told:?}", found.cheapest);
    assert!(found.best.is_proven && found.best.price >= found.cheapest.price, "{name}: {:?}", found.best);
}
