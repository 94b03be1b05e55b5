//! The mechanism reduced to its driving link: moment of inertia and moment of resistance as functions of the crank
//! angle.

use crate::sentences;
use std::f64::consts::{PI, TAU};

use num_integer::Integer;

use super::turn::FullTurn;
use crate::PoseSolver;
use crate::range::{Extent, Range, SingularityKind};
use linkage::case::{Case, Grid, Wanted};
use linkage::drive::{Course, Load};
use linkage::error::{Advice, Error, ErrorKind, Result};
use linkage::input::Input;
use linkage::math::{KeepNan, Motion, quadrature, root};
use linkage::mechanism::{Link, LinkId};
use linkage::solver::{Solver, State};
use linkage::trajectory::Stage;

/// Reduced moment of inertia (kg m^2): twice the kinetic energy divided by the square of the driving link's speed, I* =
/// sum of m (v / omega_1)^2 + J (omega / omega_1)^2.
#[must_use]
pub fn moment_of_inertia(case: &Case, motions: &[Motion]) -> f64 {
    let energy = |(body, motion): (&Link, &Motion)| {
        body.mass * motion.point_velocity(body.mass_centre).norm_squared() + body.inertia * motion.omega.powi(2)
    };
    let sum: f64 = case.mechanism.links().iter().zip(motions).skip(1).map(energy).sum();
    sum / motions[case.crank().link].omega.powi(2)
}

/// Reduced moment of resistance (N m): minus the power of gravity and loads divided by the driving link's angular
/// velocity.
/// The moment of resistance equals the moment with which the drive balances gravity and loads, counter-clockwise
/// positive. Where the drive must do work, the moment has the sign of the angular velocity.
#[must_use]
pub fn moment_of_resistance(case: &Case, state: &State) -> f64 {
    let power =
        |(body, motion): (&Link, &Motion)| case.gravity.dot(&motion.point_velocity(body.mass_centre)) * body.mass;
    let weights: f64 = case.mechanism.links().iter().zip(&state.motions).skip(1).map(power).sum();
    -(weights + case.load_power(&state.motions, &state.angles, state.reactions()))
        / state.motions[case.crank().link].omega
}

/// The period of the reduced quantities, and their kinks.
#[derive(Clone, Debug, PartialEq)]
pub struct Kinks {
    /// Crank angle (rad) after which the mechanism is back at its first pose, under the same loads.
    /// The period is usually one turn. The period can be several turns if the mechanism has higher groups, or if the
    /// table of a load covers several turns.
    /// `None` if the crank cannot turn fully.
    pub period: Option<f64>,
    /// Crank angles (rad) of the kinks. At a kink, a loaded link reverses and its load changes sense, or a load table
    /// has a breakpoint.
    /// The angles are ascending. The angles cover one period that begins at the start, or all crank angles that can be
    /// reached.
    pub cranks: Vec<f64>,
    /// Limits of the crank angles that can be reached (rad); `None` if there are no limits.
    pub limits: Option<[f64; 2]>,
    /// Whether at least one of the limits is a change point.
    pub meets: bool,
}

/// Largest number of turns in one period of the reduced quantities.
const MOST_TURNS: u32 = 1000;
/// Number of Newton steps that improve the accuracy of a crank angle from 1e-9 rad to the rounding error.
const POLISHING: usize = 3;

/// Extent of a crank's rotation. `reversals` contains the crank angles (rad) at which loads change their sense because
/// their links reverse.
struct Reach {
    turns: Option<u32>,
    limits: Option<[f64; 2]>,
    meets: bool,
    reversals: Vec<f64>,
}

impl Reach {
    fn by_range(case: &Case, sensed: &[LinkId]) -> Result<Self> {
        let range = Range::of(case)?;
        let (turns, limits, meets) = match range.extent {
            Extent::FullTurn(turns) => (Some(turns.unsigned_abs()), None, false),
            Extent::Limited(ends) => {
                (None, Some(ends.map(|end| end.crank)), ends.iter().any(|end| end.kind == SingularityKind::ChangePoint))
            }
        };
        let mut poses = PoseSolver::new(case)?;
        let mut reversals = Vec::new();
        for link in range.links.iter().filter(|link| sensed.contains(&link.link)) {
            for extreme in &link.extremes {
                // At a flat extreme, where `alpha` is zero too, Newton's steps are NaN or too long. The crank angle of
                // `range` is then kept.
                reversals.push(root::polished(extreme.crank, POLISHING, 1e-6, |crank| -> Result<(f64, f64)> {
                    let motion = &poses.solve(crank, 1.0, 0.0, Stage::Accelerations)?.motions[link.link];
                    Ok((motion.omega, motion.alpha))
                })?);
            }
        }
        Ok(Reach { turns, limits, meets, reversals })
    }
}

/// Kinks of the reduced quantities of a case.
///
/// # Errors
/// The errors of [`Range::of`].
/// [`ErrorKind::Unsupported`] for a drive that is not a crank, for friction, for loads against the motion of a point or
/// joint, and for tables whose common period with the mechanism exceeds a thousand turns.
pub fn kinks(case: &Case) -> Result<Kinks> {
    if case.crank().input != Input::Angle {
        let message = sentences::the_drive_moves_no_crank(&case.crank().input.noun());
        return Err(Error::new(ErrorKind::Unsupported, message).help(sentences::DRIVE_THE_MECHANISM_AT_A_CRANK));
    }
    if case.has_friction() {
        let message = sentences::THE_REDUCTION_KNOWS_NO_FRICTION;
        return Err(Error::new(ErrorKind::Unsupported, message).help(sentences::LET_THE_MOTION_BE_FREE));
    }
    if let Some(load) =
        case.loads.iter().find(|load| load.sensed_point().is_some() || load.joint().is_some() && load.has_sense())
    {
        let message = sentences::reduced_quantities_are_asked_for_but_a_load(&load.sort());
        return Err(Error::new(ErrorKind::Unsupported, message).help(sentences::GIVE_IT_AS_A_TABLE_OF_FORCES));
    }
    let is_sensed =
        |link: &LinkId| case.can_turn(*link) && case.loads.iter().any(|load| load.sensed_link() == Some(*link));
    let sensed: Vec<LinkId> = case.mechanism.links().ids().skip(1).filter(is_sensed).collect();
    let start = case.crank().start;
    let within = |crank: f64, period: f64| {
        let inside = (crank - start).rem_euclid(period);
        // Rounding may place a kink slightly before the start. A kink that rounding places before the start is set to
        // the start.
        start + if period - inside < 1e-12 { 0.0 } else { inside }
    };
    let Reach { turns, limits, meets, reversals: mut cranks } = match FullTurn::of(case, &sensed) {
        Some(full) => Reach { turns: Some(full.turns), limits: None, meets: false, reversals: full.reversals },
        None => Reach::by_range(case, &sensed)?,
    };
    if let Some(turns) = turns {
        cranks.iter_mut().for_each(|crank| *crank = within(*crank, TAU * f64::from(turns)));
    }
    let tables = || case.loads.iter().flat_map(Load::courses).filter_map(Course::knots);
    let mut all = turns;
    for own in case.loads.iter().flat_map(Load::courses).filter_map(Course::turns) {
        all = all.map(|all| all.lcm(&own));
        if let Some(turns) = all.filter(|&turns| turns > MOST_TURNS) {
            let message = sentences::mechanism_and_tables_of_loads(&turns, &MOST_TURNS);
            return Err(Error::new(ErrorKind::Unsupported, message).help(sentences::GIVE_THE_TABLES_TURNS_THAT_DIVIDE));
        }
    }
    if let (Some(turns), Some(all)) = (turns, all) {
        let copies = (1..all / turns).map(|copy| TAU * f64::from(copy * turns));
        let further: Vec<f64> = copies.flat_map(|by| cranks.iter().map(move |crank| crank + by)).collect();
        cranks.extend(further);
    }
    let period = all.map(|all| TAU * f64::from(all));
    for (knots, own) in tables() {
        let Some([from, to]) = period.map(|period| [start, start + period]).or(limits) else { continue };
        for &knot in &knots[1..] {
            let first = knot + ((from - knot) / own).ceil() * own;
            let copies = ((to - first) / own).floor().larger(-1.0) as i64;
            cranks.extend((0..=copies).map(|copy| first + own * copy as f64));
        }
    }
    if let Some(period) = period {
        cranks.iter_mut().for_each(|crank| *crank = within(*crank, period));
    }
    cranks.sort_by(f64::total_cmp);
    cranks.dedup_by(|a, b| (*a - *b).abs() < 1e-12);
    Ok(Kinks { period, cranks, limits, meets })
}

/// Means of the reduced quantities over one [period](Kinks::period). The period is usually one turn of the crank.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Means {
    /// Mean reduced moment of inertia (kg m^2).
    pub inertia: f64,
    /// Mean reduced moment of resistance (N m), with the sign of [`moment_of_resistance`].
    pub resistance: f64,
}

/// Longest panel of the quadrature (rad). Each panel has eight nodes.
/// The quadrature error is 1e-16 for a quantity whose nearest singularity is a tenth of a radian off the real axis.
const PANEL: f64 = PI / 90.0;

/// Means over one period at the drive's top speed. The given solver computes the motion. Gauss's rule is applied
/// between kinks.
///
/// # Errors
/// The errors of [`kinks`] and of the solver. [`ErrorKind::Geometry`] for mechanisms whose crank cannot turn fully.
pub fn means_over_turn(case: &Case, solver: &dyn Solver) -> Result<Means> {
    let found = kinks(case)?;
    let Some(period) = found.period else { return Err(no_turn(&found)) };
    let start = case.crank().start;
    let mut breaks = vec![start];
    breaks.extend(found.cranks.iter().filter(|&&kink| kink > start));
    breaks.push(start + period);
    let nodes = quadrature::composite(&breaks, PANEL);
    let cranks = nodes.iter().map(|&(crank, _)| crank).collect();
    let steady = case.nominal().at_top_speed();
    let turn = steady.on(Grid::of_inputs(steady.crank(), cranks))?.wanting(Wanted::of(&[Stage::Velocities]));
    let mut means = Means { inertia: 0.0, resistance: 0.0 };
    let mut visit = |row: usize, state: &State| {
        means.inertia += moment_of_inertia(&turn, &state.motions) * nodes[row].1 / period;
        means.resistance += moment_of_resistance(&turn, state) * nodes[row].1 / period;
        Ok(())
    };
    solver.each(&turn, &mut visit)?;
    Ok(means)
}

/// The error for a question about whole turns of a crank that cannot turn fully.
pub(crate) fn no_turn(kinks: &Kinks) -> Error {
    let reached = kinks.limits.map_or(String::new(), |[from, to]| {
        sentences::it_can_be_turned_from_to_deg(&from.to_degrees(), &to.to_degrees())
    });
    Error::new(ErrorKind::Geometry, sentences::means_over_a_turn_are_asked(&reached)).help(Advice::LookAtRange)
}

/// The error for a resistance that no speed of the motor balances.
pub fn no_steady_speed(resistance: f64) -> Error {
    let message = sentences::the_motor_has_no_stable_speed(&resistance);
    Error::new(ErrorKind::Numeric, message).help(sentences::CHOOSE_A_STRONGER_MOTOR_OR_A_LARGER)
}
