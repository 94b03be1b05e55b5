//! The reduction of a mechanism to its crank, the steady motion under its motor, and its flywheel.

use crate::sentences;
use serde_json::{Value, json};

use super::pretty::{list, pretty};
use crate::plain::cells::{table, trimmed};
use crate::plain::style::wrapped;
use analytic::reduced::means::Means;
use analytic::reduced::{RunUp, RunUpEnd};
use analytic::steady::course::{Extremes, ReducedRow};
use analytic::steady::regime::SpeedAtCrank;
use analytic::steady::{Averaged, Regime};
use design::drive::flywheel::Flywheel;
use design::drive::motor::{LARGEST_BREAKDOWN, MotorLimit};
use prover::numbers::{error, fixed, fixed_in, quantity};
use scenario::Scenario;

/// Data of a drive.
#[derive(Debug)]
pub(crate) struct Found {
    /// Means over a turn of the crank.
    pub(crate) means: Means,
    /// Extremes of the reduced moment of inertia and of the reduced moment of resistance.
    pub(crate) extremes: [Extremes; 2],
    /// Moment of inertia of motor and reducer, reduced to the crank (kg m^2).
    pub(crate) added: f64,
    /// The reduced quantities at the crank angles of the table.
    pub(crate) rows: Vec<ReducedRow>,
    /// Speeds of crank and motor by the averaged model, and the steady motion; `None` if there is no motor.
    pub(crate) steady: Option<([f64; 2], Regime)>,
    /// The averaged model, if it has a closed form.
    pub(crate) averaged: Option<Averaged>,
    /// The limits of the motor's law that the steady motion exceeds.
    pub(crate) limits: Vec<MotorLimit>,
    /// The required coefficient of non-uniformity, and the flywheel for it.
    pub(crate) flywheel: Option<(f64, Flywheel)>,
}

/// The drive as text; with `by_angle` also the table by crank angle.
pub(crate) fn text(scenario: &Scenario, found: &Found, by_angle: bool, width: usize) -> String {
    let mut text = format!("{}: {}\n\n", scenario.name, scenario.title);
    let names = [(sentences::REDUCED_MOMENT_OF_INERTIA, "kg m^2"), (sentences::REDUCED_MOMENT_OF_RESISTANCE, "N m")];
    let means = [found.means.inertia, found.means.resistance * scenario.case.crank().sense()];
    for (((name, unit), mean), extremes) in names.into_iter().zip(means).zip(&found.extremes) {
        let end = |(crank, value): (f64, f64)| {
            format!("{} at {}", quantity(value, unit), fixed_in(crank.to_degrees(), 4, "deg"))
        };
        say!(text, "{name}\n  mean      {}", quantity(mean, unit));
        say!(text, sentences::least_greatest(&end(extremes.least), &end(extremes.greatest)));
    }
    if found.added > 0.0 {
        say!(text, sentences::motor_and_reducer_on_the_crank(&quantity(found.added, "kg m^2")));
    }
    match &found.steady {
        None => text.push_str(sentences::NO_MOTOR_ADD_A_MOTOR_SECTION),
        Some(([crank, motor], regime)) => {
            say!(text, sentences::averaged_model_crank_rad_motor(&crank, &motor));
            let constant = found.averaged.as_ref().map(|averaged| format!(" {:.6} s", averaged.time_constant));
            let none = sentences::NONE_THE_MOTOR_LAW_IS_NOT_ONE_STRAIGHT;
            say!(text, sentences::time_constant(&constant.as_deref().unwrap_or(none)));
            say!(text, sentences::steady_motion(&of_regime(regime)));
            text += &told(&found.limits, width);
        }
    }
    if let Some((wanted, flywheel)) = &found.flywheel {
        say!(text, sentences::flywheel_for_a_non_uniformity(&wanted, &quantity(flywheel.inertia, "kg m^2")));
        say!(text, "{}", of_regime(&flywheel.regime));
    }
    if by_angle {
        say!(text, "\n{}", angles(found));
    }
    text
}

/// A sentence for each limit that the motor exceeds, in lines of at most `width` columns.
pub(crate) fn told(limits: &[MotorLimit], width: usize) -> String {
    let mut text = String::new();
    for limit in limits {
        let sentence = match limit {
            MotorLimit::AboveSynchronous { speed, synchronous } => {
                sentences::the_motor_turns_faster_than(&quantity(*speed, "rad/s"), &quantity(*synchronous, "rad/s"))
            }
            MotorLimit::BeyondBreakdown { speed, torque, share } => {
                let [speed, torque] = [quantity(*speed, "rad/s"), quantity(*torque, "N m")];
                sentences::the_linear_law_asks_for(&torque, share, &speed, &LARGEST_BREAKDOWN)
            }
            MotorLimit::BelowBreakdown { speed, breakdown } => {
                sentences::the_motor_turns_below_breakdown(&quantity(*speed, "rad/s"), &quantity(*breakdown, "rad/s"))
            }
        };
        say!(text, "{}", wrapped(&sentence, Some(width), 2));
    }
    text
}

/// The limits as JSON.
pub(crate) fn limits_json(limits: &[MotorLimit]) -> Value {
    list(limits, |limit| match limit {
        MotorLimit::AboveSynchronous { speed, synchronous } => {
            json!({"kind": "above_synchronous", "motor_rad_s": speed, "synchronous_rad_s": synchronous})
        }
        MotorLimit::BeyondBreakdown { speed, torque, share } => {
            json!({"kind": "beyond_breakdown", "motor_rad_s": speed, "torque_N_m": torque, "share_of_rated": share})
        }
        MotorLimit::BelowBreakdown { speed, breakdown } => {
            json!({"kind": "below_breakdown", "motor_rad_s": speed, "breakdown_rad_s": breakdown})
        }
    })
}

fn of_regime(regime: &Regime) -> String {
    let at = |at: &SpeedAtCrank| {
        format!("{} at {}", fixed_in(at.omega, 6, "rad/s"), fixed_in(at.crank.to_degrees(), 4, "deg"))
    };
    let mut text = sentences::mean_rad_period(&regime.mean_speed, &regime.period);
    say!(text, sentences::at_start_rad(&regime.start_speed));
    say!(text, sentences::slowest_fastest(&at(&regime.slowest), &at(&regime.fastest)));
    put!(text, "  non-uniformity {:.6}", regime.non_uniformity());
    text
}

fn angles(found: &Found) -> String {
    let rows = found.rows.iter().enumerate().map(|(index, row)| {
        let at = found.steady.as_ref().map(|(_, regime)| regime.samples[index]);
        let [omega, alpha] =
            at.map_or_else(|| ["-", "-"].map(String::from), |at| [at.omega, at.alpha].map(|own| fixed(own, 6)));
        let [inertia, slope] = [row.inertia, row.slope].map(|own| fixed(own, 6));
        [fixed(row.crank.to_degrees(), 3), inertia, slope, fixed(row.resistance, 6), omega, alpha]
    });
    let header = "crank\ndeg> | I*\nkg·m²> | dI*/dphi\nkg·m²> | resistance\nN·m> | omega\nrad/s> | alpha\nrad/s²>";
    trimmed(table(header).add_rows(rows))
}

/// The drive as JSON, schema 1.
pub(crate) fn json(scenario: &Scenario, found: &Found) -> String {
    let sense = scenario.case.crank().sense();
    let extremes = |extremes: &Extremes, mean: f64| {
        let end = |(crank, value): (f64, f64)| json!({"crank_rad": crank, "value": value});
        json!({"mean": mean, "least": end(extremes.least), "greatest": end(extremes.greatest)})
    };
    let at = |at: &SpeedAtCrank| json!({"crank_rad": at.crank, "omega_rad_s": at.omega, "alpha_rad_s2": at.alpha});
    let regime = |regime: &Regime| {
        json!({
            "period_s": regime.period, "turns": regime.turns, "mean_rad_s": regime.mean_speed,
            "at_start_rad_s": regime.start_speed, "slowest": at(&regime.slowest), "fastest": at(&regime.fastest),
            "non_uniformity": regime.non_uniformity(), "multiplier": regime.multiplier,
        })
    };
    let column = |of: fn(&ReducedRow) -> f64| found.rows.iter().map(of).collect::<Vec<f64>>();
    let mut by_angle = json!({
        "crank_rad": column(|row| row.crank), "inertia_kg_m2": column(|row| row.inertia),
        "inertia_slope_kg_m2": column(|row| row.slope), "resistance_N_m": column(|row| row.resistance),
    });
    if let Some((_, steady)) = &found.steady {
        by_angle["omega_rad_s"] = steady.samples.iter().map(|at| at.omega).collect();
        by_angle["alpha_rad_s2"] = steady.samples.iter().map(|at| at.alpha).collect();
    }
    let mut value = json!({
        "schema": 1, "scenario": scenario.name,
        "inertia_kg_m2": extremes(&found.extremes[0], found.means.inertia),
        "resistance_N_m": extremes(&found.extremes[1], sense * found.means.resistance),
        "motor_and_reducer_kg_m2": found.added,
        "averaged": found.steady.as_ref().map(|([crank, motor], _)| {
            let constant = found.averaged.map(|averaged| averaged.time_constant);
            json!({"crank_rad_s": crank, "motor_rad_s": motor, "time_constant_s": constant})
        }),
        "steady": found.steady.as_ref().map(|(_, steady)| regime(steady)),
        "flywheel": found.flywheel.as_ref().map(|(wanted, wheel)| {
            json!({"non_uniformity": wanted, "inertia_kg_m2": wheel.inertia, "steady": regime(&wheel.regime)})
        }),
        "by_angle": by_angle,
        "motor_limits": limits_json(&found.limits),
    });
    if found.steady.is_none() {
        value["steady_absent"] = Value::from(sentences::THE_SCENARIO_HAS_NO_MOTOR);
    }
    pretty(&value)
}

/// The text about a run-up: how it ended, the limits of the motor's law that it exceeds, and an empty line.
pub(crate) fn run_up(run_up: &RunUp, limits: &[MotorLimit], width: usize) -> String {
    let degrees = |crank: f64| fixed_in(crank.to_degrees(), 6, "deg");
    let mut text = match run_up.end {
        RunUpEnd::Reached => sentences::RUN_UP_FOLLOWED_TO_ITS_END.to_string(),
        RunUpEnd::Held(t, crank) => sentences::run_up_held_at_crank_angle(&t, &degrees(crank)),
        RunUpEnd::Limit(t, crank) => sentences::run_up_at_a_limit_of_rotation(&t, &degrees(crank)),
    };
    if let Some(residual) = run_up.power_residual() {
        put!(text, sentences::motor_against_reactions_of_the_largest(&error(residual)));
    }
    text.push('\n');
    text += &told(limits, width);
    text.push('\n');
    text
}
