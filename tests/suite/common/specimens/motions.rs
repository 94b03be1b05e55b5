//! Motion of a specimen, with its grid: at constant speed, by a motion law, or free.

use std::f64::consts::TAU;
use std::fmt::Write;

use analytic::{AssurSolver, NewtonSolver};
use linkage::case::{Case, Wanted};
use linkage::error::{Error, ErrorKind};
use linkage::math::KeepNan;
use linkage::solver::{Solver, State};
use linkage::trajectory::Stage;

use super::super::sketch::RandomSource;
use super::super::spec::Spec;
use super::shapes::{Safe, short};

/// Upper limit of the crank's rotation from its start, for a motion by law or a free motion (rad).
const FARTHEST: f64 = 3.0 * TAU;

/// A motion at constant speed.
/// If the range is limited, the grid covers all or part of the range; otherwise the grid may cover more than one
/// revolution.
pub fn constant(random: &mut RandomSource, spec: &mut Spec, safe: Safe) -> &'static str {
    let (mut from, mut to) = (safe.from, safe.to);
    if safe.full {
        let span = TAU * random.number(0.3, 1.2);
        from = spec.start - span * random.number(0.0, 1.0);
        to = from + span;
    } else if random.yes() {
        from = spec.start - (spec.start - from) * random.number(0.2, 1.0);
        to = spec.start + (to - spec.start) * random.number(0.2, 1.0);
    }
    if spec.speed < 0.0 {
        (from, to) = (to, from);
    }
    let steps = 20 + random.index(100);
    spec.grid = (from, (to - from) / steps as f64, steps);
    "constant speed"
}

/// A motion law that starts at rest.
/// If the range of the crank is limited, the law moves the crank in the direction with the larger range.
/// If all angles are safe, the law moves the crank in the direction of the given speed.
/// The largest speed of the law is about the magnitude of the given speed.
pub fn law(random: &mut RandomSource, spec: &mut Spec, safe: Safe) -> &'static str {
    let (top, start) = (spec.speed.abs(), spec.start);
    let room = if safe.full {
        TAU * random.number(0.3, 1.0) * spec.speed.signum()
    } else {
        let [ahead, behind] = [safe.to - start, start - safe.from];
        0.95 * if ahead > behind { ahead } else { -behind }
    };
    let angle = room.abs();
    let mut keys = String::new();
    let (name, end) = match random.index(3) {
        0 => {
            let time = random.number(0.2, 0.8) * angle / top;
            let speed = top * room.signum();
            write!(keys, "law = \"ramp\"\nspeed_rad_s = {speed:?}\ntime_s = {time:?}").unwrap();
            ("ramp", angle / top + time / 2.0)
        }
        1 => {
            let time = 2.0 * angle / top;
            write!(keys, "law = \"cycloidal\"\nto_rad = {:?}\ntime_s = {time:?}", start + room).unwrap();
            ("cycloidal", time)
        }
        _ => {
            let (count, mut time, mut last) = (3 + random.index(4), 0.0, start);
            let mut points = vec![format!("{{ time_s = 0, angle_rad = {start:?} }}")];
            for k in 1..count {
                let share = (k as f64 + random.number(-0.4, 0.4)) / count as f64;
                let next = start + room * share;
                time += 1.5 * (next - last).abs() / top;
                last = next;
                points.push(format!("{{ time_s = {time:?}, angle_rad = {next:?} }}"));
            }
            write!(keys, "law = \"table\"\npoints = [{}]", points.join(", ")).unwrap();
            ("table", time)
        }
    };
    spec.other.drive = keys;
    spec.other.times = Some((end, 20 + random.index(100)));
    name
}

/// A free motion: released at rest, or started with a speed, or driven by a motor.
/// The motor's torque at the crank has the order of magnitude of `moment` (N m).
/// `moment` is the moment on the crank that inertia forces and weights cause at the nominal speed.
pub fn free(random: &mut RandomSource, spec: &mut Spec, moment: f64, falls: bool) -> &'static str {
    let speed = spec.speed;
    let kind = if falls { 0 } else { 1 + random.index(3) };
    let initial = match kind {
        1 => speed,
        3 => speed * random.number(0.1, 1.0),
        _ => 0.0,
    };
    spec.other.drive = format!("motion = \"free\"\nspeed_rad_s = {speed:?}\ninitial_speed_rad_s = {initial:?}");
    if kind >= 2 {
        let motor = motor(random, speed.abs(), moment);
        spec.other.sections.push_str(&motor);
    }
    ["let go", "from a speed", "motor from rest", "motor from a speed"][kind]
}

/// A motor for a crank with the nominal speed `speed`; its torque at the crank has the order of magnitude of `moment`.
fn motor(random: &mut RandomSource, speed: f64, moment: f64) -> String {
    let ratio = if random.yes() { 1.0 } else { random.number(2.0, 30.0) };
    let efficiency = if random.yes() { 1.0 } else { random.number(0.6, 1.0) };
    let torque = moment * random.number(0.3, 1.5) / ratio;
    let own = speed * ratio;
    let mut text = String::from("[motor]\n");
    let law = match random.index(4) {
        0 => format!("law = \"constant\"\ntorque_N_m = {torque:?}"),
        1 => {
            let slope = -torque / own * random.number(0.5, 1.0);
            format!("law = \"linear\"\ntorque_at_rest_N_m = {torque:?}\nslope_N_m_s = {slope:?}")
        }
        2 => format!(
            "law = \"kloss\"\nbreakdown_torque_N_m = {torque:?}\nsynchronous_speed_rad_s = {:?}\nbreakdown_slip = {:?}",
            own * random.number(1.0, 1.3),
            random.number(0.1, 0.5)
        ),
        _ => format!(
            "law = \"table\"\npoints = [{{ speed_rad_s = 0, torque_N_m = {torque:?} }}, {{ speed_rad_s = {:?}, \
             torque_N_m = {:?} }}, {{ speed_rad_s = {:?}, torque_N_m = 0 }}]",
            0.5 * own,
            0.8 * torque,
            1.2 * own
        ),
    };
    writeln!(text, "{law}\nratio = {ratio:?}\nefficiency = {efficiency:?}").unwrap();
    let inertia = moment / (speed * speed);
    if random.yes() {
        writeln!(text, "rotor_inertia_kg_m2 = {:?}", inertia * random.number(0.05, 1.0) / (ratio * ratio)).unwrap();
    }
    if random.yes() {
        writeln!(text, "output_inertia_kg_m2 = {:?}", inertia * random.number(0.05, 1.0)).unwrap();
    }
    text
}

/// Largest speed of the crank on the grid (rad/s), the first row outside `safe`, and the largest angle from the start
/// (rad).
/// The motion is not followed beyond the first row outside `safe`, because a singular pose may come next.
fn followed(case: &Case, safe: Safe) -> Result<(f64, Option<usize>, f64), String> {
    let case = case.wanting(Wanted::of(&[Stage::Positions, Stage::Velocities]));
    let link = case.crank().link;
    let begun = case.start.0[link].angle;
    let follow = |solver: &dyn Solver| -> linkage::Result<(f64, Option<usize>, f64)> {
        let (mut top, mut moved, mut left) = (0.0f64, 0.0f64, None);
        let mut look = |row: usize, state: &State| {
            let turned = state.angles[link] - begun;
            if !safe.has(case.crank().start + turned) {
                left = Some(row);
                return Err(Error::new(ErrorKind::Geometry, "left"));
            }
            top = top.larger(state.motions[link].omega.abs());
            moved = moved.larger(turned.abs());
            Ok(())
        };
        let solved = solver.each(&case, &mut look);
        if left.is_none() {
            solved?;
        }
        Ok((top, left, moved))
    };
    // A motion that only one side can solve is allowed, so side 2 is tried if side 1 does not support the motion.
    let mut found = follow(&AssurSolver);
    if found.as_ref().is_err_and(|error| error.kind() == ErrorKind::Unsupported) {
        found = follow(&NewtonSolver);
    }
    found.map_err(|error| short(error.message()))
}

/// Shortens the grid of a motion law or a free motion, so that the motion stays in the safe range.
/// Returns the crank's largest speed.
pub fn shortened(spec: &mut Spec, safe: Safe) -> Result<f64, String> {
    let mut last = String::from("it leaves the safe range at once");
    for _ in 0..8 {
        let (end, count) = spec.other.times.expect("a grid by time");
        let case = spec.scenario().map_err(|error| format!("scenario: {}", error.message()))?.case;
        match followed(&case, safe) {
            Ok((_, None, moved)) if moved > FARTHEST => {
                spec.other.times = Some((rounded(end * (0.8 * FARTHEST / moved).sqrt()), count));
            }
            Ok((top, None, moved)) if moved >= 0.1 => return Ok(top),
            Ok((_, None, _)) => return Err("it hardly moves".into()),
            Ok((_, Some(row), _)) if row > count / 4 => {
                spec.other.times = Some((rounded(end * (row as f64 - 1.5) / count as f64), count));
            }
            Ok(_) => spec.other.times = Some((rounded(end / 4.0), count)),
            Err(error) => {
                last = error;
                spec.other.times = Some((rounded(end / 2.0), count));
            }
        }
    }
    Err(last)
}

/// The value rounded down to three digits.
pub fn rounded(value: f64) -> f64 {
    let unit = 10f64.powf(value.abs().log10().floor() - 2.0);
    (value / unit).floor() * unit
}
