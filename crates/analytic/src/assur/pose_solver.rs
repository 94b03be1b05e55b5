//! Solves pose after pose by Assur groups: the fast part of side 1.

use crate::sentences;
use std::slice;

use super::forces::{Dry, Kinetostatics};
use super::gauges::Gauges;
use super::passing::{self, Passing, way_through};
use super::turns::{CLOSED_FORM_STEP, FOLLOWED_STEP, Turns};
use super::watch::Watch;
use crate::assur::groups::{Misfit, OutOfReach, SolutionPlan};
use linkage::case::Case;
use linkage::drive::{Load, Wrench};
use linkage::error::{Advice, Error, ErrorKind, Result};
use linkage::input::{Input, InputValue};
use linkage::math::Motion;
use linkage::mechanism::{LinkId, PerLink};
use linkage::solver::State;
use linkage::trajectory::Stage;
use linkage::work;

/// A link that starts at its dead centre shows its sense of rotation after the crank has turned by this angle (rad).
const NUDGE: f64 = 1e-7;
/// Largest number of times a failing step is halved. The shortest step is a millionth of the undivided step.
pub(super) const HALVINGS: u32 = 20;
/// Explanation of a singular pose.
const MEET: &str = sentences::THERE_THE_LINKS_OF_THE_GROUP;

/// Steps from crank angle to crank angle on one branch and solves the pose at each angle, without allocation.
/// If the first drive moves a slide, the functions take the slide (m) in place of a crank angle.
/// If several drives have separate laws, the crank angle does not determine the pose.
/// The solver then steps in time: its functions take a time (s) in place of a crank angle (rad).
#[derive(Debug)]
pub struct PoseSolver<'a> {
    pub(super) case: &'a Case,
    pub(super) plan: SolutionPlan,
    statics: Kinetostatics,
    pub(super) state: State,
    /// Whole turns of the links, if the caller or a load needs the links' angles.
    pub(super) turns: Option<Turns>,
    /// Angles, angular velocities or accelerations of all driving links, depending on the stage.
    pub(super) inputs: Vec<f64>,
    /// Angular velocities and accelerations of all driving links, for the solution in one pass.
    rates: [Vec<f64>; 2],
    /// Whether the caller requests positions, velocities and accelerations in one pass at the target.
    /// `omega` and `alpha` are the rates of the crank in this pass.
    /// `has_motions` is true if the motions at the present pose are known.
    in_one_pass: bool,
    pub(super) omega: f64,
    alpha: f64,
    pub(super) has_motions: bool,
    pub(super) crank: f64,
    /// World direction of the crank at crank angle zero (rad).
    zero: f64,
    step: f64,
    /// Whether the solver steps in time instead of the crank angle.
    by_time: bool,
    pub(super) gauges: Gauges,
    pub(super) watch: Watch,
    /// Change points; `None` unless the drive is set to pass change points.
    pub(super) passing: Option<Passing>,
}

impl<'a> PoseSolver<'a> {
    /// Starts at the start pose of the case, which fixes the branch.
    ///
    /// # Errors
    /// [`ErrorKind::Geometry`] if the start pose is singular or cannot be assembled.
    pub fn new(case: &'a Case) -> Result<Self> {
        let plan = SolutionPlan::of(&case.mechanism, &case.structure, &case.modes);
        let by_time = case.goes_by_time();
        let step = case.stride(if plan.is_closed_form() { CLOSED_FORM_STEP } else { FOLLOWED_STEP });
        let (statics, state) = (Kinetostatics::of(case, &plan), State::at_start(case));
        let inputs = vec![0.0; case.drives.len()];
        let gauges = Gauges::of(case, &plan, &state.motions);
        let watch = Watch::of(&plan, &gauges);
        let mut solver = PoseSolver {
            case,
            plan,
            statics,
            state,
            turns: None,
            rates: [inputs.clone(), inputs.clone()],
            inputs,
            in_one_pass: false,
            omega: 0.0,
            alpha: 0.0,
            has_motions: false,
            crank: if by_time { 0.0 } else { case.crank().start },
            zero: case.crank().coordinate(0.0),
            step,
            by_time,
            gauges,
            watch,
            passing: (case.crank().through && case.drives.further().is_empty()).then(|| Passing::new(1.0)),
        };
        solver.step_to(solver.crank, 0)?;
        if case.loads.iter().any(Load::needs_angles) {
            solver.turns = Some(Turns::from(&case.start, &solver.state.motions));
        }
        Ok(solver)
    }

    /// Like [`PoseSolver::new`], and counts the turns of all links.
    ///
    /// # Errors
    /// The errors of [`PoseSolver::new`].
    pub fn counting_turns(case: &'a Case) -> Result<Self> {
        let mut solver = PoseSolver::new(case)?;
        solver.turns = Some(Turns::from(&case.start, &solver.state.motions));
        Ok(solver)
    }

    /// Returns the solver for a crank that is known to rotate fully.
    /// If all poses have a closed form, the solver no longer searches for change points.
    /// Higher groups are solved from their last pose, so the solver still checks them for change points.
    pub(crate) fn turning_fully(mut self) -> Self {
        if self.plan.is_closed_form() && self.passing.is_none() {
            (self.gauges, self.watch) = (Gauges::none(), Watch::none());
        }
        self
    }

    /// The state at the crank angle `crank` (rad, as the scenario states it) for the crank's angular velocity `omega`
    /// (rad/s) and acceleration `alpha` (rad/s^2).
    /// The rates of further drives follow from their speed ratios at that crank angle.
    /// Only stages up to `deepest` are computed. The results of later stages keep the values of earlier calls.
    /// The links' angles also keep the values of earlier calls, unless the loads need them: see
    /// [`PoseSolver::with_angles`].
    ///
    /// # Errors
    /// [`ErrorKind::Geometry`] if the crank angle cannot be reached on the branch. The error states the group that
    /// fails and the crank angle.
    /// [`ErrorKind::Numeric`] if friction locks the mechanism or leaves the forces undetermined, or if reactions grow
    /// without bound at a change point.
    pub fn solve(&mut self, crank: f64, omega: f64, alpha: f64, deepest: Stage) -> Result<&State> {
        // The solution in one pass needs 1 / omega. One pass is therefore used only if omega is a normal number.
        self.in_one_pass = deepest >= Stage::Accelerations && omega.is_normal();
        (self.omega, self.alpha) = (omega, alpha);
        self.go_to(crank)?;
        self.state.passing = None;
        if self.passing.as_ref().is_some_and(|passing| passing.inside().is_some()) {
            return self.solve_passing(omega, alpha, deepest);
        }
        let has_motions = self.has_motions;
        if deepest >= Stage::Velocities && !has_motions {
            self.drive(omega);
            self.plan.velocities(&self.inputs, &mut self.state.motions);
        }
        if deepest >= Stage::Accelerations && !has_motions {
            self.find_rates(self.crank);
            let [omegas, alphas] = &self.rates;
            self.plan.accelerations([omegas, alphas], &mut self.state.motions);
        }
        if deepest >= Stage::Reactions {
            if self.turns.is_some() && !self.case.loads.is_empty() {
                self.with_angles();
            }
            self.statics.solve(self.case, &self.plan, &mut self.state)?;
        }
        Ok(&self.state)
    }

    /// Completes [`PoseSolver::solve`] near a change point.
    #[cold]
    fn solve_passing(&mut self, omega: f64, alpha: f64, deepest: Stage) -> Result<&State> {
        let begun: PerLink<Motion> = self.state.motions.clone();
        self.pass([omega, alpha], deepest, None)?;
        // The results of stages that are not requested keep the values of earlier calls.
        if deepest < Stage::Accelerations {
            for (motion, before) in self.state.motions.iter_mut().zip(&begun) {
                (motion.acceleration, motion.alpha) = (before.acceleration, before.alpha);
            }
        }
        Ok(&self.state)
    }

    /// Computes rates and reactions near a change point.
    /// `senses`, if given, contains [`Case::load_rate`] of every load.
    fn pass(&mut self, rates: [f64; 2], deepest: Stage, senses: Option<&[f64]>) -> Result<()> {
        if deepest >= Stage::Reactions && self.turns.is_some() && !self.case.loads.is_empty() {
            self.with_angles();
        }
        let (case, place) = (self.case, self.case.crank().coordinate(self.crank));
        let Some(window) = self.passing.as_ref().and_then(Passing::inside) else { return Ok(()) };
        window.rates(place, rates, &self.plan, &mut self.state.motions);
        self.state.passing = Some(window.condition);
        if deepest < Stage::Reactions {
            return Ok(());
        }
        // The loads at all neighbouring poses are computed with the links' senses of rotation at this pose.
        let own: Vec<f64> = match senses {
            Some(senses) => senses.to_vec(),
            None => self.load_rates(),
        };
        let mut loads = |motions: &[Motion], angles: &[f64], out: &mut [Wrench]| {
            let sensed = |index: usize, load: &Load, crank: f64| load.moment_in(own[index], crank);
            case.loads_with(motions, angles, sensed, out);
        };
        let found = window.reactions(place, rates, None, (case, &mut self.statics), &mut loads, &mut self.state);
        found.map_err(|_| passing::unbounded(self.case.told(self.crank)))
    }

    /// Like [`PoseSolver::solve`], for the instant at which the crank starts from rest with the acceleration `alpha`.
    /// Loads that depend on a link's sense of rotation act against the motion that begins.
    /// The sense of a link at its dead centre is taken from a slightly later pose.
    pub(crate) fn set_off(&mut self, crank: f64, alpha: f64, deepest: Stage) -> Result<&State> {
        let sense = 1f64.copysign(alpha);
        let mut begun: Vec<f64> = Vec::new();
        for ahead in [sense * NUDGE, 0.0] {
            if self.solve(crank + ahead, sense, 0.0, Stage::Velocities).is_ok() {
                begun = self.load_rates();
                break;
            }
        }
        self.solve(crank, 0.0, alpha, deepest)?;
        if self.state.passing.is_some() {
            self.pass([0.0, alpha], deepest, Some(&begun).filter(|begun| !begun.is_empty()).map(Vec::as_slice))?;
            return Ok(self.with_angles());
        }
        if deepest >= Stage::Reactions && !self.case.loads.is_empty() && !begun.is_empty() {
            self.with_angles();
            let sensed = |index: usize, load: &Load, crank: f64| load.moment_in(begun[index], crank);
            let mut loads = vec![Wrench::ZERO; self.case.mechanism.links().len()];
            self.case.loads_with(&self.state.motions, &self.state.angles, sensed, &mut loads);
            self.statics.solve_under(&loads, self.case, &self.plan, &mut self.state);
        }
        Ok(self.with_angles())
    }

    /// [`Case::load_rate`] of every load at the last pose.
    fn load_rates(&self) -> Vec<f64> {
        self.case.loads.iter().map(|load| self.case.load_rate(load, &self.state.motions)).collect()
    }

    /// Moves the mechanism from its present pose to the crank angle `target`, in small steps.
    #[inline]
    fn go_to(&mut self, target: f64) -> Result<()> {
        if (target - self.crank).abs() <= self.step && self.place(target).is_ok() {
            return Ok(());
        }
        self.go_far_to(target)
    }

    /// Moves the mechanism to `target` if one step is not enough.
    #[cold]
    fn go_far_to(&mut self, target: f64) -> Result<()> {
        self.skip_turns(target)?;
        self.follow_to(target)
    }

    /// Follows the branch to a crank angle in small steps.
    pub(super) fn follow_to(&mut self, target: f64) -> Result<()> {
        let from = self.crank;
        let parts = ((target - from).abs() / self.step).ceil();
        for part in 1..parts as usize {
            self.step_to(from + (target - from) * (part as f64 / parts), HALVINGS)?;
        }
        self.step_to(target, HALVINGS)
    }

    /// Sets the inputs to the coordinates of all drives at a crank angle.
    #[inline(always)]
    pub(super) fn turn(&mut self, crank: f64) {
        self.inputs[0] = self.zero + crank;
        if self.by_time {
            let all = self.inputs.iter_mut().zip(&self.case.drives);
            all.for_each(|(input, drive)| *input = drive.coordinate(drive.at(crank).value));
        } else if self.inputs.len() > 1 {
            turn_further(self.case, crank, &mut self.inputs[1..]);
        }
    }

    /// Writes the rates of all driving links to the inputs: `rate` for the crank, and `rate` times the speed ratio for
    /// each further driving link.
    #[inline]
    pub(super) fn drive(&mut self, rate: f64) {
        if self.by_time {
            let all = self.inputs.iter_mut().zip(&self.case.drives);
            all.for_each(|(input, drive)| *input = drive.at(self.crank).rate * rate);
        } else {
            drive(self.case, self.crank, rate, &mut self.inputs);
        }
    }

    /// Computes the rates and accelerations of all driven coordinates at a crank angle.
    fn find_rates(&mut self, crank: f64) {
        let [omegas, alphas] = &mut self.rates;
        if self.by_time {
            for ((omega, alpha), drive) in omegas.iter_mut().zip(alphas).zip(&self.case.drives) {
                let state = drive.at(crank);
                *omega = state.rate * self.omega;
                *alpha = state.acceleration * self.omega * self.omega + state.rate * self.alpha;
            }
        } else {
            drive(self.case, crank, self.omega, omegas);
            drive(self.case, crank, self.alpha, alphas);
        }
    }

    /// The state at an instant of the case's grid. The arguments and errors are the same as for [`PoseSolver::solve`].
    ///
    /// # Errors
    /// The errors of [`PoseSolver::solve`].
    pub fn solve_row(&mut self, row: usize, deepest: Stage) -> Result<&State> {
        let grid = &self.case.grid;
        self.solve_when(grid.times[row], grid.inputs[row], deepest)
    }

    /// The state at an input of the first drive, with the rates of all drives at that instant.
    /// The law of the first drive must reach the input at a unique time.
    ///
    /// # Errors
    /// The errors of [`PoseSolver::solve`].
    pub fn solve_at(&mut self, input: f64, deepest: Stage) -> Result<&State> {
        self.solve_when(self.case.crank().time_of(input), input, deepest)
    }

    /// The state at time `t` (s), at which the first drive has this input.
    fn solve_when(&mut self, t: f64, input: f64, deepest: Stage) -> Result<&State> {
        if self.by_time {
            return self.solve(t, 1.0, 0.0, deepest);
        }
        let drive = self.case.crank().at(t);
        self.solve(input, drive.rate, drive.acceleration, deepest)
    }

    /// The state for the configurations that [`crate::modes`] lists, at the time `t` (s).
    /// The first drive has this input at `t`.
    /// If the speed of the first drive varies, the state is computed for the top speed of this drive.
    /// Further drives keep their speed ratios to the first drive.
    /// If the drives have separate laws, each drive has the rates of its law at `t`.
    pub(crate) fn solve_place(&mut self, t: f64, input: f64, deepest: Stage) -> Result<&State> {
        let drive = self.case.crank();
        if self.by_time {
            return self.solve_when(t, input, deepest);
        }
        let omega = if self.case.is_steady() { drive.at(t).rate } else { drive.top_speed() };
        self.solve(input, omega, 0.0, deepest)
    }

    /// The solver for friction and losses; `None` if the case has neither.
    pub(super) fn dry(&mut self) -> Option<&mut Dry> {
        self.statics.dry()
    }

    /// Coordinates of all driven joints at the last pose.
    pub(crate) fn coordinates(&mut self) -> &[f64] {
        self.turn(self.crank);
        &self.inputs
    }

    /// Rates of all driven coordinates at the last pose.
    pub(crate) fn speeds(&mut self) -> &[f64] {
        self.find_rates(self.crank);
        &self.rates[0]
    }

    /// The input at a crank angle, for messages.
    fn told(&self, crank: f64) -> InputValue {
        self.case.told(if self.by_time { self.case.crank().at(crank).value } else { crank })
    }

    /// Takes a single step.
    #[inline]
    fn place(&mut self, target: f64) -> std::result::Result<(), OutOfReach> {
        self.turn(target);
        if let Some(passing) = &mut self.passing {
            let from = self.case.crank().coordinate(self.crank);
            let placed = passing.place([from, self.inputs[0]], &mut self.plan, &mut self.state.motions);
            placed.map_err(|reach| match reach.why {
                Misfit::Passed { crank } => {
                    OutOfReach { why: Misfit::Passed { crank: self.case.crank().from_coordinate(crank) }, ..reach }
                }
                Misfit::Span { .. }
                | Misfit::Guide { .. }
                | Misfit::Swing { .. }
                | Misfit::Parallel
                | Misfit::Singular
                | Misfit::Lost => reach,
            })?;
        } else {
            self.has_motions = self.in_one_pass;
            if self.in_one_pass {
                let mut rates = [slice::from_ref(&self.omega), slice::from_ref(&self.alpha)];
                if self.inputs.len() > 1 {
                    self.find_rates(target);
                    rates = self.rates.each_ref().map(Vec::as_slice);
                }
                self.plan.motions(&self.inputs, rates, &mut self.state.motions)?;
            } else {
                self.plan.positions(&self.inputs, &mut self.state.motions)?;
            }
            if !self.gauges.pass((target - self.crank).abs(), &self.plan) {
                self.pass_closely(target)?;
            }
            if self.watch.is_needed() {
                self.keep_clear(target).inspect_err(|_| self.gauges.take_back())?;
            }
        }
        self.crank = target;
        if let Some(turns) = &mut self.turns {
            turns.count(&self.state.motions);
        }
        Ok(())
    }

    /// Takes one step. If a group cannot be followed over this step, takes two steps of half the size instead.
    fn step_to(&mut self, target: f64, halvings: u32) -> Result<()> {
        work::spend(work::PLACED * self.case.structure.groups.len() as f64)?;
        match self.place(target) {
            Ok(()) => Ok(()),
            Err(OutOfReach { why: Misfit::Lost, .. }) if halvings > 0 => {
                self.step_to((self.crank + target) / 2.0, halvings - 1)?;
                self.step_to(target, halvings - 1)
            }
            Err(reach) => Err(self.unreachable(target, reach)),
        }
    }

    /// The last state with its links' angles (rad).
    /// If turns are [counted](PoseSolver::counting_turns), the angles include whole turns.
    /// If turns are not counted, only driving links with a given world angle have their present angles. All other
    /// links have their angles in the start pose.
    pub fn with_angles(&mut self) -> &State {
        if let Some(turns) = &self.turns {
            // Skip the frame, which does not turn, and a crank, whose angle is given as an input.
            let crank = self.case.crank();
            let is_given = |link: LinkId| crank.input == Input::Angle && link == crank.link;
            let links = self.state.angles.entries_mut().skip(1).filter(|(link, _)| !is_given(*link));
            links.for_each(|(link, angle)| *angle = turns.angle(link));
        }
        self.turn(self.crank);
        for (drive, &input) in self.case.drives.iter().zip(&self.inputs) {
            let angle = &mut self.state.angles[drive.link];
            *angle = drive.link_angle(input).unwrap_or(*angle);
        }
        &self.state
    }

    /// The last state, with its links' angles if requested: see [`PoseSolver::with_angles`].
    pub(crate) fn last(&mut self, angles: bool) -> &State {
        if angles { self.with_angles() } else { &self.state }
    }

    fn unreachable(&self, crank: f64, reach: OutOfReach) -> Error {
        let group = self.case.structure.groups[reach.group].names(&self.case.mechanism);
        let at = self.told(crank);
        let assembled = sentences::the_group_cannot_be_assembled(&group, &at);
        let message = match reach.why {
            Misfit::Span { distance, reach: [shortest, longest] } => {
                sentences::its_outer_joints_are_apart(&assembled, &distance, &shortest, &longest)
            }
            Misfit::Guide { distance, length } => sentences::its_rod_is_long_its_outer(&assembled, &length, &distance),
            Misfit::Swing { distance, shortest } => {
                sentences::its_outer_pins_are_apart(&assembled, &distance, &shortest)
            }
            Misfit::Parallel => sentences::its_two_axes_are_parallel(&assembled),
            Misfit::Singular => sentences::the_group_is_singular_at(&group, &at, &MEET),
            Misfit::Passed { crank } => {
                let at = self.told(crank);
                return Error::new(ErrorKind::Geometry, sentences::the_group_passes_a_change(&group, &at, &MEET))
                    .at_input(at)
                    .of_group(group)
                    .help(Advice::ShortenGrid)
                    .or_help(sentences::CHANGE_A_LENGTH_BY_A_LITTLE)
                    .or_help(way_through(self.case));
            }
            Misfit::Lost => sentences::the_group_cannot_be_followed(&group, &at),
        };
        let error = Error::new(ErrorKind::Geometry, message)
            .at_input(at)
            .of_group(group)
            .out_of_reach()
            .help(Advice::ShortenGrid)
            .or_help(sentences::CHECK_THE_LENGTHS);
        if matches!(reach.why, Misfit::Singular) { error.or_help(way_through(self.case)) } else { error }
    }
}

/// The rates of all driving links at a crank angle: the crank's `rate` times the speed ratios.
#[inline(always)]
fn drive(case: &Case, crank: f64, rate: f64, rates: &mut [f64]) {
    rates[0] = rate;
    if rates.len() > 1 {
        drive_further(case, crank, rate, &mut rates[1..]);
    }
}

#[inline(never)]
fn drive_further(case: &Case, crank: f64, rate: f64, rates: &mut [f64]) {
    let ratios = case.drives.ratios(case.crank().time_of(crank));
    rates.iter_mut().zip(ratios.skip(1)).for_each(|(own, ratio)| *own = rate * ratio);
}

/// The coordinates of the drives other than the first.
#[inline(never)]
fn turn_further(case: &Case, crank: f64, angles: &mut [f64]) {
    let t = case.crank().time_of(crank);
    for (angle, drive) in angles.iter_mut().zip(case.drives.further()) {
        *angle = drive.coordinate(drive.at(t).value);
    }
}
