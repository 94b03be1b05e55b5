//! All engines: one line each.

use linkage::engine::Engine;

/// Every engine, the default first, each with its own default settings: those with a fixed step at the time step `step` (s), those
/// that control their error at an accuracy of their own.
#[must_use]
pub fn all(step: f64) -> Vec<Box<dyn Engine>> {
    let rapier = rapier_twin::Rapier::all(step).into_iter().map(|engine| Box::new(engine) as Box<dyn Engine>);
    #[cfg(feature = "simbody")]
    let rapier =
        rapier.chain([Box::new(simbody_twin::Simbody::new(simbody_twin::Simbody::ACCURACY)) as Box<dyn Engine>]);
    rapier.collect()
}

/// Whether the current thread is inside a step of an engine whose panic is caught and becomes an error: for the panic
/// hook of a program, which may stay silent then.
#[must_use]
pub fn panic_is_caught() -> bool {
    rapier_twin::is_guarded()
}

/// The engine called `name`, as [`all`] has it.
#[must_use]
pub fn named(name: &str, step: f64) -> Option<Box<dyn Engine>> {
    all(step).into_iter().find(|engine| engine.name() == name)
}
