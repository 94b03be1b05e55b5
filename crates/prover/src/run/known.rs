//! Uncertainty of the analytic sides, which is a part of every bound.
//! Rounding errors follow from the condition number of the pose.
//! Integration errors follow from a further run of each side with a tighter tolerance.
//! See docs/numerics/bounds.md.

use super::dependence::Dependence;
use super::each_side::{EachSide, Reference};
use super::observe::pose_of;
use super::problem::built;
use super::sensitivity;
use crate::bounds::{largest_difference, magnitudes_by};
use analytic::range::conditions;
use linkage::case::Case;
use linkage::error::Result;
use linkage::math::statistics::share;
use linkage::math::{KeepNan, largest_size};
use linkage::mechanism::GroupId;
use linkage::solver::{Solver, State};
use linkage::trajectory::{Channel, Stage, Trajectory, Unit};

/// Relative error assumed for an analytic side in well-conditioned poses. The value is chosen, not measured.
/// The error grows from positions to forces, because derivatives and the solution for forces multiply rounding errors
/// by the condition number of the pose. In well-conditioned poses the condition number is at most some tens.
pub(super) fn usual(stage: Stage) -> f64 {
    match stage {
        Stage::Positions => 1e-12,
        Stage::Velocities | Stage::Accelerations => 1e-11,
        Stage::Reactions | Stage::BalancingMoment => 1e-10,
    }
}

/// Power of the condition number with which the rounding error of a stage grows.
fn power(stage: Stage) -> i32 {
    match stage {
        Stage::Positions => 1,
        Stage::Velocities => 2,
        Stage::Accelerations | Stage::Reactions | Stage::BalancingMoment => 3,
    }
}

/// Rounding error of a position in a pose of condition number 1, in units in the last place.
const ULPS: f64 = 16.0;

/// Factor on the difference between a side's run and its run with a tighter tolerance: the product is the assumed
/// integration error. A factor is needed because the tighter run also has an error. Errors of 3.2 times the difference
/// were measured when the integrator's steps still crossed the knots of a load's table; now the steps end at the knots.
const SAFETY: f64 = 4.0;

/// Relative rounding error of a stage in a pose of this condition number.
pub(super) fn of_condition(stage: Stage, condition: f64) -> f64 {
    ULPS * f64::EPSILON * condition.powi(power(stage))
}

/// Factor on rounding errors due to distant mass centres, at least 1. For one link, the factor is a ratio of two
/// lengths: the largest distance between its points including the mass centre, and the largest distance without the
/// mass centre.
/// Side 2 calculates with the positions of mass centres.
/// The position of a joint is therefore as uncertain as the last digit of the joint's distance from the mass centre.
/// For angles, this uncertainty is divided by the distance between the joints.
/// The factor covers the links of `groups` and the driving links.
fn lever(case: &Case, groups: &[GroupId]) -> f64 {
    let own = groups.iter().flat_map(|&group| case.structure.groups[group].links.iter().copied());
    let (mut size, mut farthest) = (0.0f64, 0.0f64);
    for link in own.chain(case.drives.iter().map(|drive| drive.link)) {
        let link = &case.mechanism.links()[link];
        (size, farthest) = (size.larger(link.size()), farthest.larger(link.extent()));
    }
    if size > 0.0 { (farthest / size).larger(1.0) } else { 1.0 }
}

/// Rounding error of the positions from which a group is assembled. The unit is one unit in the last place of the
/// positions' distance from the origin.
/// On each analytic side, four positions contribute: two outer joints, the inner joint and an origin.
/// Each coordinate has a root mean square rounding error of 0.3 units. The errors of the sixteen coordinates of both
/// sides are independent, so the root mean square of their sum is 1.2 units.
/// The constant is more than three times this value.
const PLACES: f64 = 4.0;

/// Rounding error of the positions of groups, divided by [`ULPS`] and by the machine epsilon (m), and the length of the
/// shortest link (m). The length of a link is the largest distance between its pins. The position of a group is known
/// only to the last digit of the group's distance from the origin. For angles, the error is divided by the shortest
/// length. The errors of successive groups are independent, so their sum grows with the square root of the number of
/// groups.
fn placed(case: &Case, groups: &[GroupId]) -> [f64; 2] {
    let (mut far, mut arm) = (0.0f64, f64::INFINITY);
    for group in groups.iter().map(|&group| &case.structure.groups[group]) {
        let joints = || group.inner.iter().chain(&group.outer).map(|&joint| &case.mechanism.joints()[joint]);
        far =
            joints().map(|joint| case.start.0[joint.first.link].point(joint.first.local).norm()).fold(far, f64::larger);
        for &link in &group.links {
            let pins: Vec<_> = joints().filter(|joint| joint.is_pin()).filter_map(|joint| joint.on(link)).collect();
            let apart = pins.iter().flat_map(|a| pins.iter().map(move |b| (a - b).norm())).fold(0.0, f64::larger);
            // A link with one pin is left out, because it gets its angle from other links.
            arm = if apart > 0.0 { arm.smaller(apart) } else { arm };
        }
    }
    [PLACES / ULPS * (groups.len() as f64).sqrt() * far, arm]
}

/// Allowed errors of the analytic sides, channel by channel.
/// Each error is relative to the numbers from which the channel is computed.
/// A dead centre of one group therefore does not enlarge the errors of other groups.
pub(super) struct Known {
    /// Size of the numbers in every channel, in the channel's unit.
    pub(super) magnitudes: Vec<f64>,
    /// The side that serves as the reference.
    reference: Reference,
    /// Sensitivity of a free motion to the forces, channel by channel. The bound contains the relative rounding error
    /// of the forces times this sensitivity. The list is empty for a prescribed motion.
    pub(super) sensitivity: Vec<f64>,
    /// Integration error of each side in every channel, in the channel's unit; zeros for a prescribed motion.
    integration: EachSide<Vec<f64>>,
    /// The groups that channels depend on.
    dependence: Dependence,
    /// Condition number of the pose at every instant, for every set of groups.
    /// In a motion under forces, each entry is the largest condition number up to its instant. The list is empty until
    /// the condition numbers are needed.
    conditions: Vec<Vec<f64>>,
    /// Factor on the rounding error of every channel. The factor takes account of distant mass centres ([`lever`]) and
    /// of a distant origin ([`placed`]).
    levers: Vec<f64>,
    /// Absolute value of the input at every instant of a prescribed motion (rad or m). Both sides receive the input
    /// rounded to a double.
    turned: Vec<f64>,
    /// Whether a channel is an angle.
    /// The rounding error of an angle is relative to the angle with all its revolutions, so it already covers the
    /// rounding error of the crank angle.
    is_angle: Vec<bool>,
}

impl Known {
    /// Known errors of both sides' trajectories, with side 1 as the reference.
    ///
    /// # Errors
    /// The errors of the tighter runs.
    #[cfg(test)]
    pub(super) fn of(case: &Case, [first, second]: [&Trajectory; 2]) -> Result<Self> {
        let sides: EachSide<(&dyn Solver, &Trajectory)> =
            EachSide::new((&analytic::TIGHT_ASSUR, first), (&analytic::TIGHT_NEWTON, second));
        Known::beside(case, Reference::Assur, &analytic::AssurSolver, sides)
    }

    /// Known errors of both sides' trajectories, for any reference.
    /// Each trajectory comes with the solver of its tighter run. `solver` is the solver of the reference.
    ///
    /// # Errors
    /// The errors of the tighter runs.
    pub(super) fn beside(
        case: &Case,
        reference: Reference,
        solver: &dyn Solver,
        sides: EachSide<(&dyn Solver, &Trajectory)>,
    ) -> Result<Self> {
        let own = sides[reference].1;
        let sensitivity = sensitivity::of(case, solver, own)?;
        let integration = |(tight, trajectory): (&dyn Solver, &Trajectory)| -> Result<Vec<f64>> {
            if !case.is_free() {
                return Ok(vec![0.0; trajectory.channels().len()]);
            }
            let tight = tight.solve(case)?;
            let of = |((channel, ours), (_, theirs)): ((&Channel, &[f64]), (_, &[f64]))| {
                SAFETY * largest_difference(ours, theirs, channel.kind.periodic)
            };
            let rounding = sensitivity.iter().map(|change| ULPS * f64::EPSILON * change);
            Ok(trajectory.iter().zip(tight.iter()).map(of).zip(rounding).map(|(error, more)| error + more).collect())
        };
        let integration = EachSide::tried(|side| integration(sides[side]))?;
        let dependence = Dependence::of(case, own.channels());
        let magnitudes = magnitudes_by(own, &dependence.of, &|from, to| dependence.feeds(from, to));
        // A natural size that is only rounding error is replaced by a natural size from the case's data. Example: a
        // velocity is zero, and the channels contain no coordinate from which its natural size could follow.
        let sizes = built(case);
        let sized = magnitudes.into_iter().zip(own.channels());
        // The angular acceleration of a wheel is a sum of terms of the size omega^2, which cancel if the ratio of the
        // speeds is constant.
        let turning = |channel: &Channel| -> f64 {
            let is_geared =
                !case.mechanism.transmissions().is_empty() && channel.kind.unit == Unit::RadianPerSecondSquared;
            let rates = own.iter().filter(|(rate, _)| rate.kind.unit == Unit::RadianPerSecond && rate.of == channel.of);
            if is_geared { rates.map(|(_, values)| largest_size(values).powi(2)).fold(0.0, f64::larger) } else { 0.0 }
        };
        let sized = sized.map(|(size, channel)| (size.larger(turning(channel)), channel));
        let magnitudes: Vec<f64> = sized.map(|(size, channel)| sizes.unless(size, channel.kind.unit)).collect();
        let turned = match case.is_free() {
            true => Vec::new(),
            false => case.grid.inputs.iter().map(|crank| crank.abs()).collect(),
        };
        let is_angle = own.channels().iter().map(|channel| channel.kind.unit == Unit::Radian).collect();
        let of_sets: Vec<_> = dependence.sets.iter().map(|set| (lever(case, set), placed(case, set))).collect();
        let all = own.channels().iter().zip(&dependence.of).zip(&magnitudes);
        let lever_of = |((channel, &set), &magnitude): ((&Channel, &usize), &f64)| {
            let (lever, [places, arm]) = of_sets[set];
            // A coordinate already contains the distance from the origin, so this distance does not enlarge the
            // relative bound.
            let over = if channel.kind.unit == Unit::Metre { arm.larger(magnitude) } else { arm };
            lever.larger(places / over)
        };
        let levers = all.map(lever_of).collect();
        let conditions = Vec::new();
        Ok(Known { reference, sensitivity, magnitudes, integration, dependence, conditions, levers, turned, is_angle })
    }

    /// Measures the condition number of every pose.
    /// The condition numbers are needed if the errors of the sides exceed the rounding error of well-conditioned poses.
    ///
    /// # Errors
    /// The errors of the solver.
    pub(super) fn measure(&mut self, case: &Case, solver: &dyn Solver) -> Result<()> {
        let sets = &self.dependence.sets;
        let mut worst = vec![1.0; sets.len()];
        let mut all = vec![Vec::new(); case.grid.len()];
        let mut visit = |row: usize, state: &State| {
            let pose = pose_of(state);
            let own = conditions(&case.mechanism, &case.structure.groups, &pose);
            for (set, worst) in sets.iter().zip(&mut worst) {
                let own: f64 = match state.passing.filter(|_| !set.is_empty()) {
                    // At a change point, the condition number of the passage is used. The condition number of the pose
                    // is unbounded there, but no side calculates in that pose.
                    Some(passing) => passing,
                    None => set.iter().map(|&group| own[group]).product(),
                };
                // In a motion under forces, lost accuracy is never regained, so the largest condition number so far is
                // used.
                *worst = if case.is_free() { worst.larger(own) } else { own };
            }
            all[row].clone_from(&worst);
            Ok(())
        };
        solver.each(case, &mut visit)?;
        self.conditions = all;
        Ok(())
    }

    /// Integration error of a side in a channel, in the channel's unit; zero in a prescribed motion.
    pub(super) fn integration(&self, side: Reference, channel: usize) -> f64 {
        self.integration[side][channel]
    }

    /// Relative rounding error allowed in a channel of a stage at an instant.
    fn rounding(&self, stage: Stage, channel: usize, row: usize) -> f64 {
        let set = self.dependence.of[channel];
        let condition = self.conditions.get(row).map_or(1.0, |sets| sets[set]);
        // The crank angle is rounded before the sides begin. This rounding acts like any other error of a position.
        let turned = self.turned.get(row).filter(|_| !self.is_angle[channel]);
        let turned = turned.map_or(0.0, |turned| f64::EPSILON * turned * condition.powi(power(stage)));
        usual(stage).larger(self.levers[channel] * of_condition(stage, condition)) + turned
    }

    /// Relative difference allowed between the sides in a channel of a stage at an instant.
    pub(super) fn apart(&self, stage: Stage, channel: usize, row: usize) -> f64 {
        let [first, second] = self.integration.pair();
        let integration = first[channel] + second[channel];
        self.rounding(stage, channel, row) + share(integration, self.magnitudes[channel])
    }

    /// Known error of a side's value in a channel at an instant, in the channel's unit.
    pub(super) fn at(&self, side: Reference, stage: Stage, channel: usize, row: usize) -> f64 {
        self.rounding(stage, channel, row) * self.magnitudes[channel] + self.integration[side][channel]
    }

    /// Largest difference allowed between the sides in a channel over the run, in the channel's unit.
    pub(super) fn between(&self, stage: Stage, channel: usize) -> f64 {
        self.error(stage, channel) + self.integration[self.reference.other()][channel]
    }

    /// Largest error allowed for the reference in a channel over the run, in the channel's unit.
    pub(super) fn error(&self, stage: Stage, channel: usize) -> f64 {
        let rows = 0..self.conditions.len().max(self.turned.len()).max(1);
        let rounding = rows.map(|row| self.rounding(stage, channel, row)).fold(0.0, f64::larger);
        rounding * self.magnitudes[channel] + self.integration[self.reference][channel]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use analytic::{AssurSolver, NewtonSolver};
    use fixtures::of_repository;
    use linkage::case::{Grid, Wanted};
    use scenario::Scenario;

    /// In a motion under forces, accuracy that is lost in one pose remains lost. In a prescribed motion, the accuracy
    /// at an instant depends only on the pose at this instant.
    #[test]
    fn in_free_motion_the_worst_condition_so_far_counts() {
        let falls = |name: &str| {
            let case = of_repository(&format!("scenarios/{name}")).case;
            let sides: [&dyn Solver; 2] = [&AssurSolver, &NewtonSolver];
            let [own, other] = sides.map(|side| side.solve(&case).unwrap());
            let mut known = Known::of(&case, [&own, &other]).unwrap();
            known.measure(&case, &AssurSolver).unwrap();
            let worst = |row: &Vec<f64>| row.iter().copied().fold(1.0, f64::larger);
            let all: Vec<f64> = known.conditions.iter().map(worst).collect();
            all.windows(2).any(|pair| pair[1] < pair[0])
        };
        assert!(falls("crank_rocker.toml"));
        assert!(!falls("crank_rocker_runup.toml"));
    }

    /// In a motion under forces, both integrations have errors.
    /// The allowed difference of the sides includes both integration errors, but the rounding error only once.
    #[test]
    fn the_allowed_difference_includes_the_errors_of_both_sides() {
        let case = of_repository("scenarios/crank_rocker_runup.toml").case;
        let sides: [&dyn Solver; 2] = [&AssurSolver, &NewtonSolver];
        let [own, other] = sides.map(|side| side.solve(&case).unwrap());
        let known = Known::of(&case, [&own, &other]).unwrap();
        let mut seen = 0;
        for (channel, kind) in own.channels().iter().map(|channel| channel.kind).enumerate() {
            let [first, second] = Reference::ALL.map(|side| known.integration(side, channel));
            let rounding = known.at(Reference::Assur, kind.stage, channel, 0) - first;
            let apart = known.apart(kind.stage, channel, 0) * known.magnitudes[channel];
            let wanted = rounding + first + second;
            assert!((apart - wanted).abs() <= 1e-9 * wanted, "{}: {apart:e} {wanted:e}", own.channels()[channel]);
            seen += usize::from(first + second > 1e-3 * rounding && first > 0.0 && second > 0.0);
        }
        assert!(seen > 10, "{seen} channels have an error of their integration");
    }

    /// Each derivative multiplies the rounding error by the condition number once more. For forces, the power is the
    /// same as for accelerations.
    #[test]
    fn rounding_grows_with_a_power_of_the_condition() {
        let grown = Stage::ALL.map(|stage| of_condition(stage, 2e3) / of_condition(stage, 1e3));
        assert_eq!(grown, [2.0, 4.0, 8.0, 8.0, 8.0]);
    }

    /// Side 2 calculates from mass centres, so positions on a link are as uncertain as the last digit of their distance
    /// from the mass centre.
    #[test]
    fn a_distant_mass_centre_amplifies_rounding() {
        let Scenario { text, path, .. } = of_repository("scenarios/crank_rocker.toml");
        let of = |text: &str| lever(&Scenario::parse(text, &path).unwrap().case, &[GroupId(0)]);
        let far = text[..text.find("[[oracle]]").unwrap()]
            .replace("x_mm = 250, y_mm = 0 } # S3", "x_mm = 2500, y_mm = 0 } # S3");
        assert_eq!(of(&text), 1.0);
        // The mass centre is 2.5 m from the joints, and the coupler is 0.347 m long. The factor is the ratio of these
        // lengths.
        assert!((7.0..7.5).contains(&of(&far)), "{}", of(&far));
    }

    /// At a change point the condition number of the pose is unbounded, but the condition number of the passage through
    /// the pose is finite.
    /// A relative error of a millionth at the change point exceeds the allowed difference and is detected.
    #[test]
    fn numbers_at_a_change_point_are_known_to_a_millionth() {
        let case = of_repository("tests/outside/scenarios/parallel_cranks_passing.toml").case;
        let cranks = [80.0, 120.0, 180.0, 240.0].map(f64::to_radians).to_vec();
        let motion = Wanted::of(&[Stage::Positions, Stage::Velocities, Stage::Accelerations]);
        let case = case.on(Grid::of_inputs(case.crank(), cranks)).unwrap().wanting(motion);
        let sides: [&dyn Solver; 2] = [&AssurSolver, &NewtonSolver];
        let [own, other] = sides.map(|side| side.solve(&case).unwrap());
        let mut known = Known::of(&case, [&own, &other]).unwrap();
        known.measure(&case, &AssurSolver).unwrap();
        for (index, channel) in own.channels().iter().enumerate() {
            let apart = known.apart(channel.kind.stage, index, 2);
            assert!(apart < 1e-6, "{channel}: {apart:e}");
        }
        assert!(known.conditions[2].iter().any(|condition| *condition > 1.0), "{:?}", known.conditions);
    }

    /// Four-bar linkages in a row, each driving the next, from the position `from` (m), at some crank angles (rad).
    fn row(count: usize, from: f64, cranks: &[f64]) -> Case {
        use std::fmt::Write as _;
        let mut text = String::from("format = 1\nname = \"row\"\ntitle = \"row\"\n[ground.points]\n");
        let (mut links, mut joints, mut groups) = (String::new(), String::new(), String::new());
        for own in 0..=count {
            let length = 0.5 * (1.0 + 2e-3 * (own as f64).sin());
            writeln!(text, "O{own} = {{ x_m = {}, y_m = 0 }}", from + own as f64).unwrap();
            let mut link = |name: &str, points: [&str; 2], length: f64| {
                let [a, b] = points;
                let at = |x: f64| format!("{{ x_m = {x}, y_m = 0 }}");
                let (start, centre, end) = (at(0.0), at(length / 2.0), at(length));
                writeln!(links, "[links.{name}]\nmass_kg = 5\ninertia_kg_m2 = 0.1\nmass_centre = {centre}").unwrap();
                writeln!(links, "[links.{name}.points]\n{a} = {start}\n{b} = {end}").unwrap();
            };
            let mut joint = |name: &str, point: &str, pair: [&str; 2]| {
                writeln!(joints, "[[joints]]\nname = \"{name}\"\npoint = \"{point}\"").unwrap();
                writeln!(joints, "type = \"revolute\"\nlinks = {pair:?}").unwrap();
            };
            let [crank, rod, pin, end] = ["c", "r", "O", "A"].map(|kind| format!("{kind}{own}"));
            link(&crank, [&pin, &end], length);
            joint(&pin, &pin, ["ground", &crank]);
            if let Some(before) = own.checked_sub(1) {
                let [driving, start] = ["c", "A"].map(|kind| format!("{kind}{before}"));
                link(&rod, [&start, &end], 1.0);
                joint(&format!("B{own}"), &start, [&driving, &rod]);
                joint(&end, &end, [&rod, &crank]);
                writeln!(groups, "[[start.groups]]\nlinks = [{rod:?}, {crank:?}]\nmode = \"left\"").unwrap();
            }
        }
        let drive = "[drive]\njoint = \"O0\"\nspeed_rad_s = 1\n[start]\ncrank_deg = 60\n";
        let text = format!("{text}{links}{joints}{drive}{groups}[grid]\nfrom_deg = 60\nto_deg = 120\nstep_deg = 30\n");
        let case = Scenario::parse(&text, std::path::Path::new("row.toml")).unwrap().case;
        case.on(Grid::of_inputs(case.crank(), cranks.to_vec())).unwrap()
    }

    /// Symptom: at 90 deg, where the condition number is 1, the sides disagreed for four-bars in a row and for a single
    /// four-bar far from the origin.
    /// Positions are known to the last digit of their distance from the origin, and each four-bar adds its rounding
    /// error.
    #[test]
    fn rounding_grows_with_distance_and_number_of_four_bars() {
        let motion = Wanted::of(&[Stage::Positions, Stage::Velocities, Stage::Accelerations]);
        let mut beyond = 0;
        for (count, from) in [(1, 1e5), (20, 0.0), (20, 1e3), (20, 1e5)] {
            let case = row(count, from, &[85.0, 90.0, 95.0].map(f64::to_radians)).wanting(motion);
            let sides: [&dyn Solver; 2] = [&AssurSolver, &NewtonSolver];
            let [own, other] = sides.map(|side| side.solve(&case).unwrap());
            let mut known = Known::of(&case, [&own, &other]).unwrap();
            known.measure(&case, &AssurSolver).unwrap();
            for (index, channel) in own.channels().iter().enumerate() {
                let (stage, values) = (channel.kind.stage, [&own, &other].map(|of| of.column(channel).unwrap()[1]));
                let apart = known.apart(stage, index, 1);
                let relative = share((values[0] - values[1]).abs(), known.magnitudes[index]);
                assert!(relative <= apart, "{count} from {from} m, {channel}: {relative:e} {apart:e}");
                beyond += usize::from(relative > usual(stage));
                // A relative error of 1e-7 is detected at any distance from the origin. At 1e5 m, the last digit of a
                // position is 1.5e-11 m.
                assert!(apart < 1e-7, "{count} from {from} m, {channel}: {apart:e}");
                // A coordinate already contains the distance from the origin, so the distance does not enlarge the
                // relative bound of the coordinate.
                let coordinate = channel.kind.unit == Unit::Metre;
                assert!(!coordinate || apart < 1.1e-12, "{count} from {from} m, {channel}: {apart:e}");
            }
        }
        assert!(beyond > 0, "no row needs more than what is usual");
    }
}
