//! Compares the reference with published methods for class III groups of order 3, pose by pose.

use super::checks::rounding;
use crate::bounds::{Check, Verdict};
use crate::sentences;
use analytic::witness::triad::class_change::ClassChange;
use analytic::witness::triad::{Triad, assur_point, cramer, linear_system};
use linkage::case::Case;
use linkage::drive::InputState;
use linkage::error::{Error, ErrorKind, Result};
use linkage::input::Input;
use linkage::math::statistics::share;
use linkage::math::{KeepNan, cross};
use linkage::solver::{Solver, State};
use linkage::trajectory::Stage;

/// A difference of at most this fraction of the quantity's largest value counts as rounding.
/// The same fraction bounds the difference between the forces of the two analytic sides: the linear systems of the
/// methods are as large as the linear systems of the sides.
const BOUND: f64 = 1e-10;

/// The compared quantities: directions, angular velocities, angular accelerations, forces.
#[derive(Clone, Copy)]
enum Quantity {
    Angle,
    Omega,
    Alpha,
    Force,
}

/// For every quantity, the largest difference between a method and the reference, and the input (SI) at this
/// difference.
#[derive(Default)]
struct Worst {
    differences: [(f64, f64); 4],
    input: Input,
    failure: Option<Error>,
}

impl Worst {
    fn put(&mut self, quantity: Quantity, difference: f64, crank: f64) {
        let worst = &mut self.differences[quantity as usize];
        // A NaN is recorded, and no later difference replaces it.
        if !(difference <= worst.0) && !worst.0.is_nan() {
            *worst = (difference, crank);
        }
    }

    /// The method's result, or `None` if the method failed. The first error is stored.
    fn answer<T>(&mut self, answer: Result<T>) -> Option<T> {
        match answer {
            Ok(answer) => Some(answer),
            Err(error) => {
                self.failure.get_or_insert(error);
                None
            }
        }
    }

    fn check(self, family: &str, detail: &str, scales: [f64; 4]) -> Check {
        let differences = self.differences.into_iter().zip(scales);
        let shares = differences.map(|((difference, crank), scale)| (share(difference, scale), crank));
        let (value, crank) = shares.max_by(|a, b| a.0.abs().total_cmp(&b.0.abs())).unwrap_or_default();
        let tolerance = rounding(BOUND, sentences::TWO_METHODS_WITHOUT_A_COMMON);
        let check = Check::new(family, value, tolerance, "").of(detail);
        let mut check = check.located(|| format!("at {:.3}", self.input.at(crank)));
        if let Some(error) = self.failure {
            check.verdict = Verdict::Inconclusive { reason: error.message().into(), advice: error.advice().to_vec() };
        }
        check
    }
}

/// One group, and the methods by which the reference is checked on it.
struct Watch {
    triad: Triad,
    scales: [f64; 4],
    cramer: Worst,
    /// `None` if the group's geometry does not allow the method of class change.
    change: Option<(ClassChange, Worst)>,
    assur_point: Worst,
    linear: Worst,
}

impl Watch {
    fn of(case: &Case, triad: Triad) -> Result<Self> {
        let worst = || Worst { input: case.crank().input, ..Worst::default() };
        let change = match ClassChange::new(case, &triad) {
            Ok(change) => Some((change, worst())),
            Err(error) if error.kind() == ErrorKind::Unsupported => None,
            Err(error) => return Err(error),
        };
        let [cramer, assur_point, linear] = [(); 3].map(|()| worst());
        Ok(Watch { triad, scales: [1.0, 0.0, 0.0, 0.0], cramer, change, assur_point, linear })
    }

    fn see(&mut self, case: &Case, row: usize, state: &State) {
        let deepest = case.wanted.deepest();
        let drive = crank_of(case, row, state);
        let crank = drive.value;
        let links = self.triad.links();
        let mut grow = |quantity: Quantity, value: f64| {
            let scale = &mut self.scales[quantity as usize];
            *scale = scale.larger(value.abs());
        };
        grow(Quantity::Omega, drive.rate);
        grow(Quantity::Alpha, drive.rate * drive.rate);
        for link in links {
            grow(Quantity::Omega, state.motions[link].omega);
            grow(Quantity::Alpha, state.motions[link].alpha);
        }
        let rates = |worst: &mut Worst, [first, second]: [[f64; 4]; 2]| {
            for (k, link) in links.into_iter().enumerate() {
                let motion = &state.motions[link];
                if deepest >= Stage::Velocities {
                    worst.put(Quantity::Omega, (first[k] - motion.omega).abs(), crank);
                }
                if deepest >= Stage::Accelerations {
                    worst.put(Quantity::Alpha, (second[k] - motion.alpha).abs(), crank);
                }
            }
        };
        if deepest >= Stage::Velocities
            && let Some(found) = self.cramer.answer(cramer::rates(&self.triad, &state.motions))
        {
            rates(&mut self.cramer, found);
        }
        if let Some((change, worst)) = &mut self.change
            && let Some(found) = worst.answer(change.solve(crank).copied())
        {
            for (link, direction) in links.into_iter().zip(found.directions) {
                let own = state.motions[link].direction;
                worst.put(Quantity::Angle, cross(own, direction).atan2(own.dot(&direction)).abs(), crank);
            }
            rates(worst, found.rates(drive.rate, drive.acceleration));
        }
        // Forces are not compared at the start of a free motion. At this instant, loads already oppose the motion that
        // begins, although all rates are still zero.
        let setting_off = case.is_free() && drive.rate == 0.0;
        if deepest >= Stage::Reactions && !setting_off {
            let known = self.triad.known(case, state);
            let places = self.triad.places(&state.motions);
            for (worst, found) in [
                (&mut self.assur_point, assur_point::reactions(&places, &known)),
                (&mut self.linear, linear_system::reactions(&places, &known)),
            ] {
                let Some(found) = worst.answer(found) else { continue };
                for (joint, force) in self.triad.joint_forces(&case.mechanism, &found) {
                    grow(Quantity::Force, state.forces[joint].norm());
                    worst.put(Quantity::Force, (force - state.forces[joint]).norm(), crank);
                }
            }
        }
    }

    fn checks(self, detail: &str, deepest: Stage) -> Vec<Check> {
        let mut checks = Vec::new();
        let mut add = |family: &str, worst: Worst| checks.push(worst.check(family, detail, self.scales));
        if deepest >= Stage::Velocities {
            add(sentences::CLASS_III_BY_CRAMER_RULE, self.cramer);
        }
        if let Some((_, worst)) = self.change {
            add(sentences::CLASS_III_BY_CLASS_CHANGE, worst);
        }
        if deepest >= Stage::Reactions {
            add(sentences::CLASS_III_REACTIONS_BY_THE_SINGULAR, self.assur_point);
            add(sentences::CLASS_III_REACTIONS_BY_THE_GROUP, self.linear);
        }
        checks
    }
}

/// Whether the case has groups to which published methods apply.
pub(super) fn apply(case: &Case) -> bool {
    case.wanted.deepest() >= Stage::Velocities && !Triad::all(case).is_empty()
}

/// Checks the reference by the published methods, for every class III group of order 3 with revolute joints.
/// Empty if the case has no such group.
pub fn checks(case: &Case, reference: &dyn Solver) -> Result<Vec<Check>> {
    let watches: Result<Vec<Watch>> = Triad::all(case).into_iter().map(|triad| Watch::of(case, triad)).collect();
    let mut watches = watches?;
    let mut visit = |row: usize, state: &State| {
        // The methods are not used at a change point, because their equations are singular there.
        if state.passing.is_none() {
            watches.iter_mut().for_each(|watch| watch.see(case, row, state));
        }
        Ok(())
    };
    reference.each(case, &mut visit)?;
    let several = watches.len() > 1;
    let of_one = |watch: Watch| {
        let base = &case.mechanism.links()[watch.triad.base].name;
        watch.checks(if several { base } else { "" }, case.wanted.deepest())
    };
    Ok(watches.into_iter().flat_map(of_one).collect())
}

/// The crank's state at an instant: from the law of the drive, or from `state` if forces determine the motion.
fn crank_of(case: &Case, row: usize, state: &State) -> InputState {
    let drive = case.crank();
    if !case.is_free() {
        return InputState { value: case.grid.inputs[row], ..drive.at(case.grid.times[row]) };
    }
    case.state_in(&state.motions, &state.angles)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// If a method fails, only the instants before the failure are judged.
    /// The first error of the method is reported as the reason, even if the instants before the failure agree.
    #[test]
    fn a_failed_method_is_inconclusive() {
        for before in [0.0, 1e-3] {
            let mut worst = Worst::default();
            worst.put(Quantity::Force, before, 0.0);
            for reason in ["singular at 1 rad", "singular at 2 rad"] {
                let error = Error::new(ErrorKind::Numeric, reason).help("move the pin");
                assert!(worst.answer::<()>(Err(error)).is_none());
            }
            let Verdict::Inconclusive { reason, advice } = worst.check("a method", "", [1.0; 4]).verdict else {
                panic!("{before}: not inconclusive")
            };
            assert_eq!((reason.as_str(), advice.len()), ("singular at 1 rad", 1), "{before}");
        }
    }

    /// A NaN at any instant is kept as the largest difference. The check of the method then does not agree.
    #[test]
    fn a_method_with_nan_at_one_instant_disagrees() {
        for values in [[f64::NAN, 0.0, 1e-13], [0.0, f64::NAN, 1e-13], [1e-13, 0.0, f64::NAN], [-f64::NAN, 0.0, 0.0]] {
            let mut worst = Worst::default();
            for (row, value) in values.into_iter().enumerate() {
                worst.put(Quantity::Force, value, row as f64);
                worst.put(Quantity::Angle, 1e-14, row as f64);
            }
            let check = worst.check("a method", "", [1.0; 4]);
            assert_eq!(check.verdict.word(), "disagree", "{values:?}");
        }
        let mut worst = Worst::default();
        worst.put(Quantity::Force, 1e-13, 0.0);
        assert_eq!(worst.check("a method", "", [1.0; 4]).verdict.word(), "agree");
        // In any quantity, an error of 1e-9 of the largest value must be detected.
        for quantity in [Quantity::Angle, Quantity::Omega, Quantity::Alpha, Quantity::Force] {
            let mut worst = Worst::default();
            worst.put(quantity, 1e-9, 0.0);
            assert_eq!(worst.check("a method", "", [1.0; 4]).verdict.word(), "disagree");
        }
    }
}
