//! Numbers of an `[[oracle]]` at a time of the motion: they are read and compared with both analytic sides.
//! If the motion starts differently, the numbers are not valid and are omitted.

use std::path::Path;

use linkproof::{Options, prove};
use scenario::{Scenario, StartRequest, When};

use crate::common::disc::disc;

/// Rest of the file after the disc: a motor with `M = 4 - 0.1 omega`, from rest: omega = 40 (1 - exp(-0.1 t / 0.05)).
const MOTOR: &str = r#"
[motor]
law = "linear"
torque_at_rest_N_m = 4
slope_N_m_s = -0.1
ratio = 1

[start]
crank_deg = 0

[grid]
from_s = 0
to_s = 0.5
step_s = 0.05
"#;

fn speed(t: f64) -> f64 {
    40.0 * (1.0 - (-2.0 * t).exp())
}

fn read(text: &str, path: &Path) -> Scenario {
    Scenario::parse(text, path).unwrap_or_else(|error| panic!("{error}"))
}

fn told(t: &str, value: f64) -> String {
    let disc = disc(MOTOR);
    format!(
        "{disc}\n[[oracle]]\nname = \"closed form\"\nbasis = \"derived\"\nsource = \"closed form\"\n{t}\n\
         values = [{{ channel = \"link.disc.omega_rad_s\", value = {value:.8}, digits = 8 }}]\n"
    )
}

/// Verdicts, as words, on the `[[oracle]]` number of a scenario text, one per side.
fn verdicts(text: &str) -> Vec<&'static str> {
    let proof = prove(&read(text, Path::new("disc.toml")), &Options::default()).unwrap();
    let own = proof.checks.iter().filter(|check| check.family.contains("closed form"));
    own.map(|check| check.verdict.word()).collect()
}

/// The time 0.2345 s lies between two instants of the grid.
#[test]
fn a_number_at_a_time_may_lie_between_grid_instants() {
    let value = speed(0.2345);
    assert_eq!(verdicts(&told("time_s = 0.2345", value)), ["agree"; 2]);
    assert_eq!(verdicts(&told("time_ms = 234.5", value)), ["agree"; 2]);
    assert_eq!(verdicts(&told("time_s = 0.2345", value + 2e-8)), ["disagree"; 2]);
}

#[test]
fn a_prescribed_motion_accepts_numbers_at_a_time() {
    let prescribed = |text: String| text.replace("motion = \"free\"\n", "");
    let at = |time, angle: f64| prescribed(told(time, angle)).replace("disc.omega_rad_s", "disc.angle_rad");
    assert_eq!(verdicts(&at("time_s = 0.2", 4.0)), ["agree"; 2]);
    assert_eq!(verdicts(&at("time_s = 0.2", 4.1)), ["disagree"; 2]);
}

#[test]
fn tables_by_time_support_known_wrong_cells() {
    let directory = tempfile::tempdir().unwrap();
    let rows: String = [0.1, 0.25, 0.4].iter().map(|t| format!("{},{:.6}\n", 1e3 * t, speed(*t))).collect();
    std::fs::write(directory.path().join("run.csv"), format!("t_ms,omega\n{rows}450,99.5\n")).unwrap();
    let right = speed(0.45);
    let disc = disc(MOTOR);
    let text = format!(
        "{disc}\n[[oracle]]\nsource = \"closed form\"\nfile = \"run.csv\"\ntime = \"t_ms\"\n[oracle.columns]\n\
         omega = {{ channel = \"link.disc.omega_rad_s\", expect = [{{ time_s = 0.45, finding = \"misprint\", \
         right = {{ value = {right:.6}, digits = 6 }} }}] }}\n"
    );
    let scenario = read(&text, &directory.path().join("disc.toml"));
    let series = &scenario.oracles[0].series[0];
    let instants: Vec<When> = series.instants().collect();
    assert_eq!(instants, [0.1, 0.25, 0.4, 0.45].map(When::Time));
    let proof = prove(&scenario, &Options::default()).unwrap();
    let own = proof.checks.iter().filter(|check| check.family.contains("run.csv"));
    let words: Vec<&str> = own.map(|check| check.verdict.word()).collect();
    assert_eq!(words, ["agree", "expected", "agree", "expected"]);
}

/// If the start angle differs from the angle in the file, the motion differs, so a published time no longer names the
/// published pose.
#[test]
fn another_start_omits_numbers_at_a_time() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios/crank_rocker_runup.toml");
    let timed = |scenario: &Scenario| {
        let series = scenario.oracles.iter().flat_map(|oracle| &oracle.series);
        series.filter(|series| series.instants().any(|at| at.time().is_some())).count()
    };
    assert!(timed(&Scenario::load(&path).unwrap()) > 30);
    let asked = StartRequest { crank: Some(0.1), ..StartRequest::default() };
    assert_eq!(timed(&Scenario::load_as(&path, &asked).unwrap()), 0);
}
