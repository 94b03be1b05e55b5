//! Every option that takes a number refuses an invalid value before anything is run.

use super::tools::Place;

/// Names that the help texts use for decimal numbers as option values.
const DECIMAL: [&str; 16] = [
    "S",
    "DEG",
    "SHARE",
    "MM",
    "MPA",
    "RPM",
    "GB",
    "STEPS",
    "ACCURACY",
    "FACTOR",
    "KG_PER_M",
    "K",
    "NUMBER",
    "X,Y",
    "X,Y,DEG",
    "CRANK,ROCKER",
];

const COMMANDS: [&str; 19] = [
    "run",
    "check",
    "solve",
    "tune",
    "mutate",
    "bench",
    "inspect",
    "bearings",
    "drive",
    "plan",
    "diagram",
    "stress",
    "export",
    "synthesize crank-rocker",
    "synthesize slider-crank",
    "synthesize function",
    "synthesize motion",
    "synthesize path",
    "synthesize search",
];

/// The options of a command with their value names, as in its help.
fn options(place: &Place, command: &str) -> Vec<(String, String)> {
    let help = place.ok(&format!("{command} --help"));
    let option = |line: &str| {
        let (option, value) = line.trim().strip_prefix("--")?.split_once(" <")?;
        Some((format!("--{option}"), value.split('>').next()?.to_string()))
    };
    help.lines().filter_map(option).collect()
}

#[test]
fn every_option_refuses_invalid_numbers() {
    let place = Place::new();
    let mut tried = 0;
    for command in COMMANDS {
        for (option, value) in options(&place, command) {
            if !DECIMAL.contains(&value.as_str()) {
                continue;
            }
            for wrong in ["nan", "inf", "-inf", "1e999", "soon", "30,5"] {
                if ["X,Y", "CRANK,ROCKER"].contains(&value.as_str()) && wrong == "30,5" {
                    continue;
                }
                let found = format!("'{wrong}' for '{option} <{value}>'");
                place.refused(&format!("{command} {option}={wrong}"), &[&found, "expected "]);
            }
            tried += 1;
        }
        // Options that take a count, or a number of threads (where 0 may mean all).
        for (option, _) in options(&place, command).iter().filter(|(_, value)| value == "N") {
            for wrong in ["-1", "2.5", "many"] {
                place.refused(&format!("{command} {option}={wrong}"), &[option, wrong]);
            }
        }
    }
    assert!(tried >= 25, "{tried}");
}

#[test]
fn numbers_out_of_range_are_refused() {
    let place = Place::new();
    for arguments in [
        "run FILE --dt 0",
        "run FILE --dt -1",
        "run FILE --budget 0",
        "run FILE --budget -5",
        "run FILE --memory 0",
        "run FILE --accuracy 0",
        "run FILE --sweeps 0",
        "run FILE --substeps 0",
        "tune FILE --within 1",
        "tune FILE --within 0",
        "bench FILE --out out --rounds 0",
        "check FILE phi --channel link.crank.angle_rad --error 0",
        "drive FILE --catalogue motors.toml --efficiency 1.1",
        "drive FILE --catalogue motors.toml --synchronous-rpm 0",
        "run FILE --crank-deg nan",
        "run FILE --crank-deg 0:inf:1",
        "run FILE --crank-deg 0:360",
        "run FILE --crank-deg 0:360:0",
        "run FILE --crank-deg 0:360:-1",
        "run FILE --times 1:0:0.1",
        "run FILE --times=",
        "run FILE --set a=nan",
    ] {
        place.refused(&arguments.replace("FILE", "scenarios/crank_rocker.toml"), &[]);
    }
}
