//! A wrapper of an engine behaves like the wrapped engine, except for the changes that the wrapper declares.

use std::path::Path;

use super::solve;
use crate::common::shipped;
use linkage::case::Case;
use linkage::engine::{CachedEngine, Engine, Hook, Route, Settings, Wrapped};
use linkage::mechanism::JointId;
use linkage::solver::State;
use linkage::trajectory::ChannelSubject;
use prover::engines::{EngineName, is_built, with_step};
use syn::{Item, TraitItem};

/// Changes nothing.
#[derive(Clone)]
struct Idle;

impl Hook for Idle {
    fn answer(&self, _: &Case, _: usize, _: &mut State) {}
}

/// A wrapper that changes the first force of its engine.
#[derive(Clone)]
struct More(f64);

impl Hook for More {
    fn answer(&self, _: &Case, _: usize, state: &mut State) {
        state.forces[JointId(0)].x += self.0;
    }
}

/// Everything that an engine reports about itself for a case.
fn answers(engine: &dyn Engine, case: &Case) -> String {
    let facts = (engine.name(), engine.version(), engine.settings(), engine.controls_error(), engine.told());
    let routes = (engine.routes(), engine.own_routes(case), engine.sweeps(case), engine.overrun());
    let forces = (engine.statics(case).is_some(), engine.is_noise_measured());
    let of = case.channels().into_iter().map(|channel| {
        (engine.formal_order(case, channel.kind), engine.noise(case, channel.kind), engine.provides(&channel))
    });
    format!("{facts:?} {routes:?} {forces:?} {:?}", of.collect::<Vec<_>>())
}

#[test]
fn a_neutral_wrapper_does_not_change_an_engine() {
    for name in ["crank_rocker.toml", "double_pendulum.toml"] {
        let case = shipped(name).case;
        for engine in EngineName::ALL.into_iter().filter(|engine| is_built(*engine)) {
            let engine = with_step(engine, 2e-3).unwrap();
            let settings = engine.settings();
            let other = Settings { resolution: 0.5 * settings.resolution, sweeps: 64, ..settings };
            let ways = [
                settings,
                other,
                Settings { route: Route::Native, ..other },
                Settings { extrapolated: if engine.controls_error() { 0 } else { 2 }, ..other },
            ];
            for way in ways {
                let bare = engine.with(way);
                let wrapped = Wrapped { hook: Idle, inner: engine.with(settings) }.with(way);
                let kept = CachedEngine::new(wrapped.as_ref()).with(way);
                let expected = answers(bare.as_ref(), &case);
                assert_eq!(answers(wrapped.as_ref(), &case), expected, "{name}");
                assert_eq!(answers(kept.as_ref(), &case), expected, "{name}, kept");
            }
            let wrapped = Wrapped { hook: Idle, inner: engine.with(other) };
            let [own, theirs] = [solve(&wrapped, &case), solve(engine.with(other).as_ref(), &case)];
            assert!(own.iter().eq(theirs.iter()), "{name}, {}", engine.name());
        }
    }
}

/// In a plain and in an extrapolated motion, the change that the wrapper makes is applied exactly once.
#[test]
fn a_hook_applies_exactly_once_plain_and_extrapolated() {
    let case = shipped("crank_rocker.toml").case;
    let engine = with_step(EngineName::Rapier, 2e-3).unwrap();
    for extrapolated in [0, 2] {
        let way = Settings { extrapolated, sweeps: 64, ..engine.settings() };
        let kept = |engine: &dyn Engine| solve(CachedEngine::new(engine).with(way).as_ref(), &case);
        let right = kept(engine.as_ref());
        let wrong = kept(&Wrapped { hook: More(5.0), inner: engine.with(engine.settings()) });
        for ((channel, right), (_, wrong)) in right.iter().zip(wrong.iter()) {
            // Forces on the frame are sums of joint forces, so they are not compared.
            if channel.kind.subject != ChannelSubject::Frame {
                let more = if channel.to_string() == "joint.O.fx_N" { 5.0 } else { 0.0 };
                let is_once = right.iter().zip(wrong).all(|(right, wrong)| (wrong - right - more).abs() <= 1e-9);
                assert!(is_once, "{channel}, extrapolated {extrapolated}");
            }
        }
    }
}

/// In the traits of engines and solvers, a method has a default only if the default calls required methods.
/// A wrapper that forgets a required method therefore does not compile.
#[test]
fn engine_and_solver_have_only_derived_default_methods() {
    let defaults = |file: &str, name: &str| -> Vec<String> {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("crates/linkage/src").join(file);
        let items = syn::parse_file(&std::fs::read_to_string(path).unwrap()).unwrap().items;
        let found = items.into_iter().find_map(|item| match item {
            Item::Trait(found) if found.ident == name => Some(found.items),
            _ => None,
        });
        let methods = found.expect("the trait is there").into_iter().filter_map(|item| match item {
            TraitItem::Fn(method) => method.default.map(|_| method.sig.ident.to_string()),
            _ => None,
        });
        methods.collect()
    };
    assert_eq!(defaults("engine.rs", "Engine"), ["at", "rows"]);
    assert_eq!(defaults("solver.rs", "Solver"), ["each", "solve", "solve_with"]);
}
