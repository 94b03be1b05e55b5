//! Proofs in tests: the macro and its settings.

use std::cell::RefCell;
use std::panic::{self, AssertUnwindSafe};
use std::path::Path;

use linkproof::parts::{EngineName, Error};
use linkproof::testing::{AssertProven, Proving};
use linkproof::{Options, assert_proven};

use crate::cli::tools::Place;
use crate::common::assert_within;

const CRANK_ROCKER: &str = "scenarios/crank_rocker.toml";

fn of(file: &str) -> Proving {
    Proving::of(Path::new(env!("CARGO_MANIFEST_DIR")).join(file))
}

thread_local! {
    static FAILED_AT: RefCell<Option<(String, u32)>> = const { RefCell::new(None) };
}

/// The message of a failing test, and the file and line of the failure.
fn failure(test: impl FnOnce()) -> (String, (String, u32)) {
    let before = panic::take_hook();
    panic::set_hook(Box::new(move |info| {
        let place = info.location().map(|place| (place.file().to_string(), place.line()));
        FAILED_AT.with_borrow_mut(|at| *at = place);
        before(info);
    }));
    let payload = panic::catch_unwind(AssertUnwindSafe(test)).expect_err("the test must fail");
    let message = payload.downcast_ref::<String>().expect("a message").clone();
    (message, FAILED_AT.take().expect("a place"))
}

#[test]
fn an_agreement_returns_its_proof() {
    let proof = assert_proven!("scenarios/crank_rocker.toml", only = ["link.rocker.positions"]);
    assert_eq!(proof.scenario, "crank_rocker");
    let asked = |channel: &linkproof::parts::ChannelProof| channel.residual.channel.of == "rocker";
    assert!(!proof.engine().channels.is_empty() && proof.engine().channels.iter().all(asked));
    // The macro gets several options, and the value of `set` has two parts; the length of the crank is a parameter.
    let place = Place::new();
    place.edited("formulas/slider_crank_centric.toml", "short.toml", &[("A = { x_mm = 40,", "A = { x_mm = \"r_mm\",")]);
    let file = place.path("scenarios/short.toml");
    let short = assert_proven!(file, set = ("r_mm", 30.0), only = ["point.B.x_m"], cranks = [0.0, 1.0],);
    let stretched = short.reference_trajectory.named("point.B.x_m").unwrap()[0];
    assert_within!((stretched - 0.19).abs(), 1e-12);
}

#[test]
fn a_disagreement_fails_at_the_test_line_with_the_report() {
    let place = Place::new();
    let wrong = "[[formula]]\nname = \"w\"\nexpression = \"phi\"\nchannel = \"link.crank.omega_rad_s\"\n";
    let path = place.path(CRANK_ROCKER);
    let text = std::fs::read_to_string(&path).unwrap();
    std::fs::write(&path, format!("{text}\n{wrong}")).unwrap();
    let line = line!() + 1;
    let (message, at) = failure(|| drop(assert_proven!(&path, only = ["velocities"])));
    assert_eq!(at, (file!().to_string(), line));
    let (first, report) = message.split_once("\n\n").unwrap();
    assert_eq!(first, "crank_rocker is not proven: disagree");
    let proof = Proving::of(&path).only(["velocities"]).prove().unwrap();
    assert_eq!(report, proof.report());
    assert!(report.contains("DISAGREE: ") && report.contains("is not link.crank.omega_rad_s"), "{report}");
    let line = line!() + 1;
    let (again, at) = failure(|| drop(proof.assert()));
    assert_eq!((again, at), (message, (file!().to_string(), line)));
}

#[test]
fn an_inconclusive_proof_fails() {
    let coarse = of(CRANK_ROCKER).with(Options::default().step(0.02)).only(["positions"]);
    let (message, _) = failure(|| drop(coarse.assert()));
    assert!(message.starts_with("crank_rocker is not proven: inconclusive\n\n"), "{message}");
    assert!(message.contains("choose a smaller time step") && !message.contains("--dt"), "{message}");
}

#[test]
fn an_invalid_scenario_fails_with_its_file_position() {
    let place = Place::new();
    place.edited("pendulum.toml", "broken.toml", &[("joint = \"O\"", "joint = \"Q\"")]);
    let (message, _) = failure(|| drop(Proving::of(place.path("scenarios/broken.toml")).assert()));
    for word in ["error: ", "joint \"Q\"", "broken.toml:", "help: "] {
        assert!(message.contains(word), "{word}: {message}");
    }
}

#[test]
fn settings_apply_to_the_proof() {
    let times = of(CRANK_ROCKER).times([0.0, 0.1]).only(["positions"]).prove().unwrap();
    assert_eq!(times.reference_trajectory.times(), [0.0, 0.1]);
    let cranks = of(CRANK_ROCKER).cranks([1.0, 2.0]).only(["positions"]).start(1.0).prove().unwrap();
    assert_eq!((cranks.reference_trajectory.inputs(), cranks.reference_trajectory.times()[0]), (&[1.0, 2.0][..], 0.0));
    let rocker = |proving: Proving| {
        let proof = proving.only(["link.rocker.angle_rad"]).cranks([0.5]).prove().unwrap();
        proof.reference_trajectory.named("link.rocker.angle_rad").unwrap()[0]
    };
    assert!((rocker(of(CRANK_ROCKER)) - rocker(of(CRANK_ROCKER).mode("coupler,rocker=right"))).abs() > 0.1);
    let engines = Options::default().engine(EngineName::Impulse).engine(EngineName::Rapier);
    let both = of(CRANK_ROCKER).with(engines).only(["link.rocker.angle_rad"]).assert();
    assert_eq!(both.engines.iter().map(|engine| engine.info.name).collect::<Vec<_>>(), ["impulse", "rapier"]);
    // A step that is fine enough for one tolerance is too coarse for a tighter tolerance.
    let step = || of(CRANK_ROCKER).with(Options::default().step(1e-3)).only(["link.rocker.angle_rad"]);
    assert_eq!(step().assert().verdict.word(), "agree");
    assert_eq!(step().tolerance(1e-6).prove().unwrap().verdict.word(), "inconclusive");
}

#[test]
fn invalid_settings_are_refused_with_a_remedy() {
    let refused = |proving: Proving, word: &str| {
        let error: Error = proving.prove().unwrap_err();
        assert!(error.message().contains(word) && error.way_out().is_some(), "{error}");
    };
    refused(of("scenarios/missing.toml"), "missing.toml cannot be read");
    refused(of(CRANK_ROCKER).only(["positons"]), "positons");
    refused(of(CRANK_ROCKER).set("a_mm", 30.0), "a_mm");
    refused(of(CRANK_ROCKER).mode("coupler,wheel=left"), "wheel");
    refused(of(CRANK_ROCKER).cranks([]), "empty");
    refused(of(CRANK_ROCKER).times([0.0, 0.0]), "are the same");
    refused(of(CRANK_ROCKER).times([f64::NAN]), "NaN");
    for share in [0.0, 1.0, f64::NAN] {
        refused(of(CRANK_ROCKER).tolerance(share), "fraction of a channel's scale");
    }
}
