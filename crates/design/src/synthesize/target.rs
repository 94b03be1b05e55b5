//! Applies a task to another mechanism: chooses the output, sets the crank's speed, and computes accelerations of the
//! output.

use crate::sentences;
use std::f64::consts::{PI, TAU};

use crate::synthesize::task::{OutputQuantity, Task};
use analytic::PoseSolver;
use linkage::case::{Case, Grid};
use linkage::drive::{DriveMotion, MotionLaw};
use linkage::error::{Error, ErrorKind, Result};
use linkage::input::Input;
use linkage::math::extremum;
use linkage::mechanism::{GROUND, Link, LinkId};
use linkage::solver::State;
use linkage::trajectory::Stage;
use scenario::Scenario;

/// Upper limit of the crank angle between two samples of an acceleration (rad).
const SAMPLE_STEP: f64 = PI / 360.0;

/// Names of the output in mechanisms that do not use the names of the task.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct OutputNames {
    /// Names of output links. The first name that occurs in the mechanism is used.
    pub links: Vec<String>,
    /// Names of working points, or of output points. The first name that occurs in the mechanism is used.
    pub points: Vec<String>,
}

/// The task with the mechanism of `scenario` instead of the task's drawing. The two structures may differ.
///
/// The output link is the first one found by these rules:
/// - a link with a name in `names.links`, in the order of this list;
/// - the link with the name that the task uses;
/// - in the last group, the link with a pin on the ground, if there is just one such link.
///
/// The working point is the first one found by these rules:
/// - a point of the output link with a name in `names.points`, in the order of this list;
/// - the point with the name that the task uses, if the output link has the name that the task uses;
/// - the point of the output link at which there is no joint, if there is just one such point.
///
/// If the output is a coordinate, the output point is the first one found by these rules:
/// - a point of a moving link with a name in `names.points`, in the order of this list;
/// - the point of a moving link with the name that the task uses;
/// - the point of a moving link at which there is no joint, if there is just one such point in the mechanism.
///
/// # Errors
/// [`ErrorKind::Input`] if these rules leave the output undecided.
/// [`ErrorKind::Unsupported`] for several drives, and for a drive that does not turn a crank.
pub fn in_mechanism(task: &Task, scenario: &Scenario, names: &OutputNames) -> Result<Task> {
    let case = &scenario.case;
    let unsupported = |message: String, help: &str| Err(Error::new(ErrorKind::Unsupported, message).help(help));
    if !case.drives.further().is_empty() {
        let message = sentences::has_several_drives(&scenario.name);
        return unsupported(message, sentences::TAKE_A_SCENARIO_WITH_ONE_DRIVE);
    }
    if case.crank().input == Input::Slide {
        let message = sentences::drives_a_slide(&scenario.name);
        return unsupported(message, sentences::TAKE_A_SCENARIO_WITH_A_CRANK);
    }
    let output = match task.output {
        OutputQuantity::Angle { link, point } => {
            let own = &task.case.mechanism.links()[link];
            let link = output_link(scenario, names, &own.name)?;
            let wanted = point.filter(|_| case.mechanism.links()[link].name == own.name);
            OutputQuantity::Angle {
                link,
                point: working_point(case, link, names, wanted.map(|at| &own.points[at].name)),
            }
        }
        OutputQuantity::Coordinate { link, point, along } => {
            let own = &task.case.mechanism.links()[link].points[point].name;
            let (link, point) = output_point(scenario, names, own)?;
            OutputQuantity::Coordinate { link, point, along }
        }
    };
    Ok(Task { case: case.clone(), starts: scenario.starts.clone(), output, ..task.clone() })
}

/// The moving links, with their numbers.
fn moving(case: &Case) -> impl Iterator<Item = (LinkId, &Link)> {
    case.mechanism.links().entries().filter(|(link, _)| *link != GROUND)
}

fn output_link(scenario: &Scenario, names: &OutputNames, own: &str) -> Result<LinkId> {
    let case = &scenario.case;
    let named = |name: &str| moving(case).find(|(_, link)| link.name == name).map(|(link, _)| link);
    if let Some(found) = names.links.iter().map(String::as_str).chain([own]).find_map(named) {
        return Ok(found);
    }
    let on_ground = |link: LinkId| {
        case.mechanism
            .joints()
            .iter()
            .any(|joint| joint.is_pin() && joint.on(link).is_some() && joint.other(link).link == GROUND)
    };
    let last = case.structure.groups.iter().last().map_or(&[][..], |group| &group.links[..]);
    let rockers: Vec<LinkId> = last.iter().copied().filter(|&link| on_ground(link)).collect();
    match rockers[..] {
        [only] => Ok(only),
        _ => {
            let all: Vec<&str> = moving(case).map(|(_, link)| link.name.as_str()).collect();
            let message = sentences::no_output_link_is_called(&scenario.name, &own);
            Err(Error::new(ErrorKind::Input, message).help(sentences::name_the_output_link(&all.join(", "))))
        }
    }
}

/// Whether a joint lies at a point of a link.
fn is_joined(case: &Case, link: LinkId, point: usize) -> bool {
    let local = case.mechanism.links()[link].points[point].local;
    case.mechanism.joints().iter().any(|joint| joint.on(link) == Some(local))
}

/// The working point of a link: the point with the first name of `names` that occurs on the link.
/// If no name occurs, the working point is the point `own`, or else the link's only point without a joint.
fn working_point(case: &Case, link: LinkId, names: &OutputNames, own: Option<&String>) -> Option<usize> {
    let points = &case.mechanism.links()[link].points;
    let named = |name: &String| points.iter().position(|point| point.name == *name);
    names.points.iter().chain(own).find_map(named).or_else(|| {
        let mut free = (0..points.len()).filter(|&point| !is_joined(case, link, point));
        free.next().filter(|_| free.next().is_none())
    })
}

/// The output point of a task that follows a coordinate.
fn output_point(scenario: &Scenario, names: &OutputNames, own: &String) -> Result<(LinkId, usize)> {
    let case = &scenario.case;
    let all = || moving(case).flat_map(|(id, link)| (0..link.points.len()).map(move |point| (id, point)));
    let called = |&(link, point): &(LinkId, usize)| case.mechanism.links()[link].points[point].name.as_str();
    let named = |name: &String| all().find(|at| called(at) == name);
    let mut free = all().filter(|&(link, point)| !is_joined(case, link, point));
    let only = free.next().filter(|_| free.next().is_none());
    names.points.iter().chain([own]).find_map(named).or(only).ok_or_else(|| {
        let mut names: Vec<String> = all().map(|at| called(&at).to_string()).collect();
        names.dedup();
        let message = sentences::no_output_point_is_called(&scenario.name, &own);
        Error::new(ErrorKind::Input, message).help(sentences::name_the_output_point(&names.join(", ")))
    })
}

/// The case over one turn from crank angle zero, with the crank at the constant speed `speed` (rad/s, positive).
/// The crank keeps its sense of rotation. A motor is left out.
///
/// # Errors
/// The errors of [`Case::new`].
pub fn at_speed(case: &Case, speed: f64) -> Result<Case> {
    let sense = case.crank().sense();
    case.with(|parts| {
        let crank = parts.drives.crank_mut();
        crank.motion = DriveMotion::Prescribed { law: MotionLaw::ConstantSpeed(sense * speed), motor: None };
        parts.grid = Grid::of_inputs(crank, vec![0.0, sense * TAU]);
    })
}

/// Largest accelerations of an output over one turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutputAccelerations {
    /// Angular acceleration of the output link (rad/s^2). `None` if the output is a coordinate.
    pub angular: Option<f64>,
    /// Acceleration of the working point, or of the output point (m/s^2). `None` if the output has neither point.
    pub point: Option<f64>,
}

impl OutputAccelerations {
    /// The largest accelerations of the output of `task`, at the crank speed of the task's case.
    /// The maxima are also searched between the samples.
    ///
    /// # Errors
    /// The errors of [`PoseSolver::solve`].
    pub fn of(task: &Task) -> Result<Self> {
        let case = &task.case;
        let mut poses = PoseSolver::new(case)?;
        let parts = (TAU / SAMPLE_STEP).round();
        let turns: Vec<f64> = (0..=parts as usize).map(|row| TAU * (row as f64 / parts)).collect();
        let mut largest = |quantity: &dyn Fn(&State) -> f64| -> Result<f64> {
            let mut value = |turn: f64| Ok(quantity(poses.solve_at(task.turning() * turn, Stage::Accelerations)?));
            let samples = turns.iter().map(|&turn| value(turn)).collect::<Result<Vec<f64>>>()?;
            Ok(extremum::greatest(&turns, &samples, &mut value)?.1)
        };
        let (link, point) = task.output.working_point();
        let angular = match task.output {
            OutputQuantity::Angle { .. } => Some(largest(&|state| state.motions[link].alpha.abs())?),
            OutputQuantity::Coordinate { .. } => None,
        };
        let point = point.map(|point| {
            let local = case.mechanism.links()[link].points[point].local;
            largest(&|state| state.motions[link].point_acceleration(local).norm())
        });
        Ok(OutputAccelerations { angular, point: point.transpose()? })
    }
}
