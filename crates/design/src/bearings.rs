//! Largest reactions and moments over the grid's range, refined between samples, and the journal diameters that these
//! loads require.

use crate::sentences;
use linkage::math::{KeepNan, extremum};
use std::f64::consts::PI;

use analytic::PoseSolver;
use linkage::case::{Case, Friction};
use linkage::error::{Advice, Error, ErrorKind, Result};
use linkage::math::statistics::ends;
use linkage::mechanism::JointId;
use linkage::solver::State;
use linkage::trajectory::Stage;

/// Upper limit of the crank angle between two samples (rad).
/// The limit suffices because a reaction has only a few maxima per turn.
const SAMPLE_STEP: f64 = PI / 360.0;

/// Largest number of samples of one kind.
const MOST: f64 = 50_000.0;

/// An efficiency exists only if the work of the drives exceeds this multiple of the work of friction.
/// The factor allows for rounding errors of both sums.
const ROUNDING: f64 = 1.0 + 1e-9;

/// Largest magnitude of a quantity over the range, and the input of the drive at this magnitude.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// Largest magnitude (N; N m for a moment).
    pub value: f64,
    /// Crank angle (rad) or slide (m) at which the magnitude is largest, as the scenario defines this input.
    pub crank: f64,
}

/// Peaks of the reactions and moments of one case.
#[derive(Clone, Debug, PartialEq)]
pub struct Peaks {
    /// Magnitude of the reaction in each joint (N), one per joint in the mechanism's order.
    pub reactions: Vec<Peak>,
    /// Magnitude of the reaction moment in each joint (N m), one per joint; `None` for joints that transmit no moment.
    pub moments: Vec<Option<Peak>>,
    /// Magnitude of the shaking force (N).
    pub shaking_force: Peak,
    /// Magnitude of the balancing moment on the crank (N m), or of the driving force of a slide (N).
    pub balancing_moment: Peak,
    /// Magnitude of the moment (N m) or force (N) of every further drive.
    pub further_drives: Vec<Peak>,
    /// Magnitude of the force of each transmission along its line of action (N).
    pub transmissions: Vec<Peak>,
    /// The joints with friction, then the transmissions with losses.
    pub frictions: Vec<FrictionLoss>,
    /// Work of the drives over the range (J); negative if the mechanism drives them.
    pub drive_work: f64,
}

/// Friction of a joint, or losses of a transmission, over a range of crank angles.
#[derive(Clone, Debug, PartialEq)]
pub struct FrictionLoss {
    /// Name of the joint, or of the transmission with losses.
    pub name: String,
    /// Whether this entry describes the losses of a transmission.
    pub is_mesh: bool,
    /// Whether the friction is a force, in a prismatic joint.
    pub is_force: bool,
    /// Largest friction (N m or N). For a transmission: the largest moment on its first member.
    pub largest: f64,
    /// Work lost by the friction over the range (J), not negative.
    pub work: f64,
    /// Largest product of the normal force and the sliding speed of the contact (W); 0 for a transmission.
    /// Divided by the bearing area, this value is the product of bearing pressure and speed.
    pub pressure_speed: f64,
}

impl Peaks {
    /// Efficiency over the range: the fraction of the drives' work that is not lost by friction.
    /// `None` without friction, and if the work of the drives does not exceed the work lost by friction.
    pub fn efficiency(&self) -> Option<f64> {
        let lost: f64 = self.frictions.iter().map(|own| own.work).sum();
        (lost > 0.0 && self.drive_work > ROUNDING * lost).then(|| 1.0 - lost / self.drive_work)
    }
}

/// Smallest journal diameter (m) for the force `force` (N), the lever arm `lever` (m) and the bending stress `stress`
/// (Pa).
/// M = F l and sigma = 32 M / (pi d^3) give d = cbrt(32 F l / (pi sigma)).
pub fn journal_diameter(force: f64, lever: f64, stress: f64) -> f64 {
    (32.0 * force * lever / (PI * stress)).cbrt()
}

/// Computes the peaks over the range of crank angles that the case's grid spans.
///
/// # Errors
/// [`ErrorKind::Unsupported`] if the law of the drive has no unique time for a crank angle of the grid.
/// The errors of [`PoseSolver::solve`], for crank angles that the mechanism cannot reach.
pub fn over_range(case: &Case) -> Result<Peaks> {
    if case.grid.inputs.iter().any(|&crank| case.crank().time_of(crank).is_nan()) {
        let message = sentences::PEAKS_ARE_LOOKED_FOR_OVER;
        return Err(Error::new(ErrorKind::Unsupported, message).help(Advice::SolutionTable));
    }
    let mut poses = PoseSolver::new(case)?;
    let cranks = samples_of(case);
    let joints = case.mechanism.joints();
    let reaction = |joint: JointId| Box::new(move |state: &State| state.forces[joint].norm()) as Quantity;
    let mut quantities: Vec<Quantity> = joints.ids().map(reaction).collect();
    for (joint, _) in joints.entries().filter(|(_, joint)| joint.keeps_angle()) {
        quantities.push(Box::new(move |state| state.moments[joint].abs()));
    }
    quantities.push(Box::new(|state| state.shaking(case).0.norm()));
    for drive in 0..case.drives.len() {
        quantities.push(Box::new(move |state| state.torques[drive].abs()));
    }
    for transmission in case.mechanism.transmissions().ids() {
        quantities.push(Box::new(move |state| state.transmitted[transmission].abs()));
    }
    let mut samples = vec![Vec::with_capacity(cranks.len()); quantities.len()];
    let none = |friction: Friction| {
        let ((name, is_force), is_mesh) = (friction.name(), friction.is_mesh());
        FrictionLoss { name: name.into(), is_mesh, is_force, largest: 0.0, work: 0.0, pressure_speed: 0.0 }
    };
    let mut frictions: Vec<FrictionLoss> = case.frictions().map(none).collect();
    let mut drive_work = 0.0;
    for (number, &crank) in cranks.iter().enumerate() {
        let state = poses.solve_at(crank, Stage::BalancingMoment)?;
        // Work by the trapezium rule: power divided by the rate of the input, integrated over the input.
        let [before, after] = [number.saturating_sub(1), (number + 1).min(cranks.len() - 1)].map(|own| cranks[own]);
        let rate = case.state_in(&state.motions, &state.angles).rate;
        let span = if rate == 0.0 { 0.0 } else { (after - before) / 2.0 / rate };
        for (friction, own) in case.frictions().zip(&mut frictions) {
            let (effort, speed) = (friction.effort(&state.motions, state.reactions()), friction.rate(&state.motions));
            let normal = friction.normal(friction.reaction(state.reactions()), speed);
            let [_, on] = friction.act(effort, &state.motions);
            own.largest = own.largest.larger(on.force.norm() + on.moment.abs());
            own.work += (effort * speed).abs() * span.abs();
            own.pressure_speed = own.pressure_speed.larger(normal * speed.abs() * friction.contact());
        }
        drive_work += state.drive_power(case) * span.abs();
        for (column, quantity) in samples.iter_mut().zip(&quantities) {
            column.push(quantity(state));
        }
    }
    let refine = |(quantity, column): (&Quantity, &Vec<f64>)| refined(&mut poses, quantity, &cranks, column);
    let peaks = quantities.iter().zip(&samples).map(refine).collect::<Result<Vec<_>>>()?;
    let mut peaks = peaks.into_iter();
    let mut next = || peaks.next().expect("every quantity has a peak");
    Ok(Peaks {
        reactions: joints.iter().map(|_| next()).collect(),
        moments: joints.iter().map(|joint| joint.keeps_angle().then(&mut next)).collect(),
        shaking_force: next(),
        balancing_moment: next(),
        further_drives: case.drives.further().iter().map(|_| next()).collect(),
        transmissions: case.mechanism.transmissions().iter().map(|_| next()).collect(),
        frictions,
        drive_work,
    })
}

/// The inputs (rad or m) at which the quantities are computed, ascending: equal steps over the range of the grid, the
/// breakpoints of the loads' tables, and equal steps in time if the speed varies.
fn samples_of(case: &Case) -> Vec<f64> {
    let [from, to] = ends(case.grid.inputs.iter().copied());
    let steps = |range: f64, step: f64| (range / step).ceil().larger(1.0).smaller(MOST) as usize;
    let between =
        |[from, to]: [f64; 2], parts: usize| (0..=parts).map(move |k| from + (to - from) * (k as f64 / parts as f64));
    let mut found: Vec<f64> = between([from, to], steps(to - from, case.step(SAMPLE_STEP))).collect();
    for (knots, period) in case.load_knots() {
        for knot in knots {
            let first = ((from - knot) / period).ceil();
            let repeated = (0..).map(|k| knot + period * (first + f64::from(k)));
            found.extend(repeated.take_while(|knot| *knot <= to).take(MOST as usize));
        }
    }
    let crank = case.crank();
    if crank.constant_speed().is_none() {
        // The law proceeds by the angle `SAMPLE_STEP` of its shortest oscillation in each step.
        let times = ends(case.grid.times.iter().copied());
        let parts = steps((times[1] - times[0]) * crank.pace(), SAMPLE_STEP);
        found.extend(between(times, parts).map(|time| crank.at(time).value));
    }
    found.retain(|input| (from..=to).contains(input));
    found.sort_by(f64::total_cmp);
    found.dedup();
    found
}

/// Quantity whose peak is sought, as a function of the state.
type Quantity<'a> = Box<dyn Fn(&State) -> f64 + 'a>;

/// Finds the largest sample and refines it by golden-section search between the neighbouring samples.
fn refined(poses: &mut PoseSolver, quantity: &Quantity, cranks: &[f64], samples: &[f64]) -> Result<Peak> {
    let mut value = |crank: f64| -> Result<f64> { Ok(quantity(poses.solve_at(crank, Stage::BalancingMoment)?)) };
    let (crank, value) = extremum::greatest(cranks, samples, &mut value)?;
    Ok(Peak { value, crank })
}
