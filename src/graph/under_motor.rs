//! Charts of the run-up of a machine under its motor, and of the difference between two calculations of the balancing
//! moment.

use super::curve::{Curve, Panel, curve, input_axis, time_axis};
use super::names::CurveName;
use super::source::Source;
use crate::sentences;
use analytic::AssurSolver;
use analytic::reduced::{ACCURACY, ReducedModel, means, motion};
use analytic::steady::Averaged;
use analytic::witness::power;
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::KeepNan;
use linkage::math::statistics::ascending;
use linkage::solver::{Sampler, Solver};
use std::f64::consts::TAU;

/// Duration of a run-up without chosen instants, in time constants; and its least duration, in turns at steady speed.
const CONSTANTS: f64 = 8.0;
const TURNS: f64 = 2.0;
/// Duration (s) of a run-up without a time constant, and number of intervals of every run-up without chosen instants.
const SECONDS: f64 = 0.5;
const INTERVALS: u32 = 800;

/// Speeds of the crank and of the motor over time, with the speeds of the averaged model.
/// If the scenario has a free motion, the curves are those of its solution. If its motion is prescribed, the run-up is
/// computed from rest.
///
/// # Errors
/// [`ErrorKind::Input`] without a motor. The errors of [`motion`].
pub(super) fn run_up(source: &Source, notes: &mut Vec<String>) -> Result<Vec<Panel>> {
    let case = source.scenario.case.nominal();
    let Some(motor) = source.scenario.case.crank().motor().cloned() else {
        let message = sentences::has_no_motor(&source.scenario.name);
        return Err(Error::new(ErrorKind::Input, message).help(sentences::ADD_A_MOTOR_TO_THE_DRIVE));
    };
    let model = ReducedModel::of(&case)?;
    let averaged = Averaged::over_turn(&model, &motor, &means::means_over_turn(&case, &AssurSolver)?);
    let (times, speeds) = match source.scenario.case.is_free() {
        true => solved(source),
        false => {
            let model_motion = motion(&model, 0.0, &instants(source, averaged), ACCURACY)?.0;
            model_motion.iter().map(|at| (at.t, at.omega)).unzip()
        }
    };
    let mut panels =
        vec![panel(&times, &speeds, averaged, case.crank().sense(), 1.0, sentences::ANGULAR_VELOCITY_OF_THE_CRANK_2)];
    panels.push(panel(
        &times,
        &speeds,
        averaged,
        case.crank().sense(),
        motor.ratio,
        sentences::ANGULAR_VELOCITY_OF_THE_MOTOR,
    ));
    if averaged.is_none() {
        notes.push(sentences::there_is_no_averaged_curve(&source.scenario.name));
    }
    Ok(panels)
}

/// Times and speeds of the crank in a free motion, from the first solver.
fn solved(source: &Source) -> (Vec<f64>, Vec<f64>) {
    let trajectory = &source.parties[0].1;
    let [_, rate, _] = source.case.input_channels();
    let columns: Vec<(&[f64], f64)> =
        rate.iter().filter_map(|(channel, sign)| Some((trajectory.column(channel)?, *sign))).collect();
    let at =
        |row: usize| (trajectory.times()[row], columns.iter().map(|(values, sign)| sign * values[row]).sum::<f64>());
    ascending(trajectory.times()).into_iter().map(at).unzip()
}

/// The instants of a run-up from rest.
fn instants(source: &Source, averaged: Option<Averaged>) -> Vec<f64> {
    let own = &source.scenario.case.grid.times;
    if source.chosen_instants {
        let mut times = own.clone();
        times.sort_by(f64::total_cmp);
        times.dedup();
        return times;
    }
    let long = averaged.map_or(SECONDS, |own| (CONSTANTS * own.time_constant).larger(TURNS * TAU / own.steady_speed));
    (0..=INTERVALS).map(|k| long * f64::from(k) / f64::from(INTERVALS)).collect()
}

/// The chart of the speed of a shaft that turns `ratio` times as fast as the crank.
fn panel(times: &[f64], speeds: &[f64], averaged: Option<Averaged>, sense: f64, ratio: f64, what: &str) -> Panel {
    let (axis, x_key) = time_axis();
    let name = CurveName::whole(what, "rad/s");
    let key = if ratio == 1.0 { "crank_omega_rad_s" } else { "motor_omega_rad_s" };
    let of = |who: &str, values: Vec<f64>| -> Curve {
        Curve { who: who.into(), ..curve(name.clone(), [&x_key, key], [times.to_vec(), values], 0.0) }
    };
    let own = of(sentences::EXACT_MODEL, speeds.iter().map(|omega| ratio * omega).collect());
    let closed = averaged.map(|model| {
        let first = speeds.first().copied().unwrap_or(0.0);
        let start = times.first().copied().unwrap_or(0.0);
        let steady = sense * model.steady_speed;
        let at = |t: &f64| ratio * (steady + (first - steady) * (-(t - start) / model.time_constant).exp());
        of(sentences::AVERAGED_MODEL, times.iter().map(at).collect())
    });
    Panel { x: axis, curves: [own].into_iter().chain(closed).collect(), equal: false }
}

/// The balancing moment from equilibrium minus the balancing moment from powers, divided by the largest moment.
///
/// # Errors
/// [`ErrorKind::Input`] for several drives, or without a balancing moment. The errors of the solver.
pub(super) fn delta(source: &Source) -> Result<Panel> {
    let case = &source.scenario.case;
    let case = case.wanting_only(&case.all_channels());
    let effort = case.drives.with_moment().next().filter(|_| case.drives.len() == 1);
    let channel = case.all_channels().into_iter().find(|own| own.kind.subject.is_drive() && own.of.is_empty());
    let (Some(_), Some(channel)) = (effort, channel) else {
        let message = sentences::has_no_balancing_moment_of_one_drive(&source.scenario.name);
        return Err(Error::new(ErrorKind::Input, message).help(sentences::TAKE_A_SCENARIO_WITH_ONE_DRIVE_2));
    };
    let mut sampler = Sampler::new(&case);
    let mut powers = vec![0.0; case.grid.times.len()];
    AssurSolver.each(&case, &mut |row, state| {
        powers[row] = power::balancing_moment(&case, state);
        sampler.put(&case, row, state);
        Ok(())
    })?;
    let trajectory = sampler.finish(&case)?;
    let moments = trajectory.column(&channel).unwrap_or_default();
    let size = moments.iter().fold(0.0f64, |most, own| most.larger(own.abs()));
    let share = |row: usize| if size > 0.0 { (moments[row] - powers[row]) / size } else { 0.0 };
    let order = ascending(trajectory.times());
    let (axis, x_key, x): (_, _, Vec<f64>) = match case.is_free() {
        true => {
            let (axis, key) = time_axis();
            (axis, key, order.iter().map(|&row| trajectory.times()[row]).collect())
        }
        false => {
            let input = case.crank().input;
            let (axis, key) = input_axis(input);
            (axis, key, order.iter().map(|&row| input.shown(trajectory.inputs()[row])).collect())
        }
    };
    let y = order.into_iter().map(share).collect();
    let name = CurveName::whole(sentences::RELATIVE_DIFFERENCE_OF_THE_BALANCING_MOMENT, "");
    Ok(Panel { x: axis, curves: vec![curve(name, [&x_key, "delta"], [x, y], 0.0)], equal: false })
}
