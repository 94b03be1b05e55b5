//! Side 1 for several degrees of freedom: Jourdain's principle with the transfer functions of every driving link, group
//! by group.
//!
//! Here v_j and w_j are the first transfer functions of a link's mass centre and angle if only driving link j moves.
//! Then A_ij = sum of m v_i . v_j + J w_i w_j, and A alpha = T + sum of v_i . (F - m a0) + w_i (M - J alpha0).
//! Here a0 and alpha0 are the accelerations of the link if no free driving link accelerates.
//! See docs/numerics/forces.md.

use super::forces::{Dry, Kinetostatics};
use super::passing::{self, Passing};
use super::pose_solver::HALVINGS;
use super::turns::{CLOSED_FORM_STEP, FOLLOWED_STEP, Turns};
use crate::assur::groups::{Misfit, OutOfReach, SolutionPlan};
use crate::motion::side::{Held, Inputs, Side, embed, loads_held};
use crate::sentences;
use linkage::case::Case;
use linkage::drive::Wrench;
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::dense::Lu;
use linkage::math::{KeepNan, Motion, Vec2};
use linkage::mechanism::{self, GROUND, GroupId, JointId, LinkId};
use linkage::solver::State;
use linkage::trajectory::Stage;
use linkage::work;

/// The equations of motion of a case by its Assur groups.
pub(crate) struct TransferSide<'a> {
    case: &'a Case,
    plan: SolutionPlan,
    statics: Kinetostatics,
    state: State,
    turns: Turns,
    /// Largest rotation of a driving link (rad) between two poses.
    step: f64,
    /// Angles of the driving links at the last pose.
    at: Vec<f64>,
    target: Vec<f64>,
    unit: Vec<f64>,
    /// Indices of the free drives.
    free: Vec<usize>,
    /// First transfer functions of every link's mass centre and angle: all links for the first free driving link, then
    /// all links for each further free driving link.
    transfer: Vec<(Vec2, f64)>,
    matrix: Lu,
    right: Vec<f64>,
    loads: Vec<Wrench>,
    /// Change points; `None` with several driving links or with friction, where change points cannot be passed.
    passing: Option<Passing>,
    /// Clearances of the groups at the last pose; used only if `passing` is `None`.
    sines: Vec<Option<f64>>,
    /// The argument `held` of the last call of `accelerate` in a window around a change point.
    held: Option<Held>,
    /// Solver for friction and losses; `None` if the case has neither.
    dry: Option<Dry>,
}

impl<'a> TransferSide<'a> {
    /// Starts at the start pose of a case. `share` is the ratio of the widths of the windows around change points to
    /// their usual widths.
    ///
    /// # Errors
    /// [`ErrorKind::Geometry`] if the start pose is singular.
    pub(crate) fn new(case: &'a Case, share: f64) -> Result<Self> {
        let plan = SolutionPlan::of(&case.mechanism, &case.structure, &case.modes);
        let step = if plan.is_closed_form() { CLOSED_FORM_STEP } else { FOLLOWED_STEP };
        let (statics, state) = (Kinetostatics::of(case, &plan), State::at_start(case));
        let free: Vec<usize> = case.drives.free().map(|(index, _)| index).collect();
        let at: Vec<f64> = case.drives.iter().map(|drive| drive.coordinate(drive.start)).collect();
        let turns = Turns::from(&case.start, &state.motions);
        let mut side = TransferSide {
            case,
            plan,
            statics,
            state,
            turns,
            step,
            target: at.clone(),
            unit: vec![0.0; at.len()],
            at,
            transfer: vec![(Vec2::zeros(), 0.0); free.len() * case.mechanism.links().len()],
            matrix: Lu::new(free.len()),
            right: vec![0.0; free.len()],
            free,
            loads: vec![Wrench::ZERO; case.mechanism.links().len()],
            passing: case.passes().then(|| Passing::new(share)),
            sines: Vec::new(),
            held: None,
            dry: Dry::of(case),
        };
        side.place().map_err(|reach| side.out_of_reach(reach))?;
        Ok(side)
    }

    /// Places the mechanism at the target angles.
    fn place(&mut self) -> std::result::Result<(), OutOfReach> {
        match &mut self.passing {
            Some(passing) => {
                passing.place([self.at[0], self.target[0]], &mut self.plan, &mut self.state.motions)?;
            }
            None => {
                self.plan.positions(&self.target, &mut self.state.motions)?;
                self.keep_clear()?;
            }
        }
        self.turns.count(&self.state.motions);
        self.at.copy_from_slice(&self.target);
        Ok(())
    }

    /// Refuses a step over a change point, where a clearance falls to zero and rises again.
    /// In a step over a change point, extrapolation from the end of the step, with the slope at the end, gives a
    /// negative clearance at the beginning.
    /// A step in which the clearance only comes near zero is refused too.
    /// If the refused step is divided, its parts pass the pose of smallest clearance without being refused.
    fn keep_clear(&mut self) -> std::result::Result<(), OutOfReach> {
        for ((step, target), at) in self.unit.iter_mut().zip(&self.target).zip(&self.at) {
            *step = target - at;
        }
        self.plan.velocities(&self.unit, &mut self.state.motions);
        let passed = self.plan.clearances(&self.state.motions).zip(&self.sines).position(|(now, before)| {
            now.zip(*before).is_some_and(|(now, before)| now.sine - now.rate < 0.0 && before > 0.0)
        });
        if let Some(group) = passed {
            let crank = self.case.crank().from_coordinate(self.target[0]);
            return Err(OutOfReach { group: GroupId(group), why: Misfit::Passed { crank } });
        }
        self.sines.clear();
        self.sines.extend(self.plan.clearances(&self.state.motions).map(|now| now.map(|now| now.sine)));
        Ok(())
    }

    /// Computes the velocities at the last pose.
    fn velocities(&mut self, omegas: &[f64]) {
        match self.passing.as_ref().and_then(Passing::inside) {
            Some(window) => window.rates(self.at[0], [omegas[0], 0.0], &self.plan, &mut self.state.motions),
            None => self.plan.velocities(omegas, &mut self.state.motions),
        }
    }

    /// Computes the accelerations at the last pose. The velocities at this pose must be known.
    fn accelerations(&mut self, omegas: &[f64], alphas: &[f64]) {
        match self.passing.as_ref().and_then(Passing::inside) {
            Some(window) => window.rates(self.at[0], [omegas[0], alphas[0]], &self.plan, &mut self.state.motions),
            None => self.plan.accelerations([omegas, alphas], &mut self.state.motions),
        }
    }

    /// Follows the branch to these angles of the driving links, in small steps.
    fn go_to(&mut self, angles: &[f64]) -> Result<()> {
        let farthest = self.at.iter().zip(angles).fold(0.0f64, |most, (a, b)| most.larger((b - a).abs()));
        let parts = (farthest / self.step).ceil().larger(1.0) as usize;
        let from = self.at.clone();
        for part in 1..=parts {
            let way = [&from, angles];
            self.step_to(way, [part - 1, part].map(|part| part as f64 / parts as f64), HALVINGS)?;
        }
        Ok(())
    }

    /// Moves from the fraction `before` of a path to the fraction `share`.
    /// If a group cannot be followed, takes two steps of half the size.
    fn step_to(&mut self, way: [&[f64]; 2], [before, share]: [f64; 2], halvings: u32) -> Result<()> {
        work::spend(work::PLACED * self.case.structure.groups.len() as f64)?;
        for ((target, &from), &to) in self.target.iter_mut().zip(way[0]).zip(way[1]) {
            *target = if share < 1.0 { from + (to - from) * share } else { to };
        }
        match self.place() {
            Ok(()) => Ok(()),
            Err(OutOfReach { why: Misfit::Lost | Misfit::Passed { .. }, .. }) if halvings > 0 => {
                let middle = (before + share) / 2.0;
                self.step_to(way, [before, middle], halvings - 1)?;
                self.step_to(way, [middle, share], halvings - 1)
            }
            Err(reach) => Err(self.out_of_reach(reach)),
        }
    }

    fn out_of_reach(&self, reach: OutOfReach) -> Error {
        let group = self.case.structure.groups[reach.group].names(&self.case.mechanism);
        let at = self.case.told(self.case.crank().from_coordinate(self.target[0]));
        let message = match reach.why {
            Misfit::Lost => sentences::the_group_cannot_be_followed(&group, &at),
            Misfit::Singular | Misfit::Passed { .. } => sentences::the_group_is_singular_at_two(&group, &at),
            Misfit::Span { .. } | Misfit::Guide { .. } | Misfit::Swing { .. } | Misfit::Parallel => {
                sentences::the_group_cannot_be_assembled(&group, &at)
            }
        };
        Error::new(ErrorKind::Geometry, message)
            .at_input(at)
            .of_group(group)
            .help(sentences::LET_THE_GRID_END_BEFORE_THE_MOTION)
    }

    /// Computes the angles of all links, including whole turns.
    fn find_angles(&mut self, driving: &[f64]) {
        self.state.angles.iter_mut().zip(self.turns.angles()).for_each(|(angle, found)| *angle = found);
        for (drive, &input) in self.case.drives.iter().zip(driving) {
            let angle = &mut self.state.angles[drive.link];
            *angle = drive.link_angle(input).unwrap_or(*angle);
        }
    }

    /// Solves for the accelerations of the free driving links and of all links, under the present loads.
    fn embed(&mut self, inputs: &mut Inputs, held: &Held) -> Result<()> {
        for &index in &self.free {
            inputs.accelerations[index] = 0.0;
        }
        self.accelerations(&inputs.speeds, &inputs.accelerations);
        let links = self.case.mechanism.links();
        self.matrix.clear();
        for i in 0..self.free.len() {
            let of_i = &self.transfer[i * links.len()..][..links.len()];
            let mut right = 0.0;
            for (link, body) in links.entries().filter(|&(link, _)| link != GROUND) {
                let motion = &self.state.motions[link];
                let (velocity, omega) = of_i[link];
                let force = (self.case.gravity - motion.point_acceleration(body.mass_centre)) * body.mass;
                let load = self.loads[link];
                right += velocity.dot(&(force + load.force)) + omega * (load.moment - body.inertia * motion.alpha);
                for j in 0..self.free.len() {
                    let (other, spin) = self.transfer[j * links.len() + link.index()];
                    self.matrix.add(i, j, body.mass * velocity.dot(&other) + body.inertia * omega * spin);
                }
            }
            if self.free[i] == 0 {
                right += held.motor;
                self.matrix.add(i, i, held.added);
            }
            self.right[i] = right;
        }
        embed(&mut self.matrix, &mut self.right, &self.free, inputs)?;
        self.accelerations(&inputs.speeds, &inputs.accelerations);
        Ok(())
    }

    fn find_transfer(&mut self) {
        let links = self.case.mechanism.links();
        let mut unit = std::mem::take(&mut self.unit);
        for k in 0..self.free.len() {
            unit.fill(0.0);
            unit[self.free[k]] = 1.0;
            self.velocities(&unit);
            for (link, body) in links.entries() {
                let motion = &self.state.motions[link];
                self.transfer[k * links.len() + link.index()] = (motion.point_velocity(body.mass_centre), motion.omega);
            }
        }
        self.unit = unit;
    }
}

impl Side for TransferSide<'_> {
    fn accelerate(&mut self, inputs: &mut Inputs, held: &Held) -> Result<()> {
        self.go_to(&inputs.angles)?;
        self.find_transfer();
        self.velocities(&inputs.speeds);
        if self.passing.as_ref().is_some_and(|passing| passing.inside().is_some()) {
            self.held = Some(held.clone());
        }
        if !self.case.loads.is_empty() || self.dry.is_some() {
            self.find_angles(&inputs.angles);
            loads_held(self.case, &self.state.motions, &self.state.angles, held, &mut self.loads);
        }
        let Some(mut dry) = self.dry.take() else { return self.embed(inputs, held) };
        let (loads, mut state) = (self.loads.clone(), State::at_rest(self.case));
        for (sense, friction) in dry.senses.iter_mut().zip(self.case.frictions()) {
            *sense = held.senses[friction.index];
        }
        let found = dry.settle(self.case, &mut state, &mut |efforts, state| {
            self.loads.copy_from_slice(&loads);
            self.case.add_friction(efforts, &self.state.motions, &mut self.loads);
            self.embed(inputs, held)?;
            self.statics.solve_under(&self.loads, self.case, &self.plan, &mut self.state);
            state.clone_from(&self.state);
            Ok(())
        });
        self.dry = Some(dry);
        found
    }

    fn spin(&mut self, inputs: &Inputs, link: LinkId) -> Result<f64> {
        self.go_to(&inputs.angles)?;
        self.velocities(&inputs.speeds);
        Ok(self.state.motions[link].omega)
    }

    fn velocity(&mut self, inputs: &Inputs, at: mechanism::JointSide) -> Result<Vec2> {
        self.spin(inputs, at.link)?;
        Ok(self.state.motions[at.link].point_velocity(at.local))
    }

    fn acceleration(&self, at: mechanism::JointSide) -> Vec2 {
        self.state.motions[at.link].point_acceleration(at.local)
    }

    fn joint_ends(&self, joint: JointId) -> [LinkId; 2] {
        let joint = &self.case.mechanism.joints()[joint];
        [joint.first.link, joint.second.link]
    }

    fn joint_rates(&mut self, joint: JointId) -> [f64; 2] {
        self.case.mechanism.joints()[joint].rates(&self.state.motions)
    }

    fn link_rates(&self, link: LinkId) -> [f64; 2] {
        let motion = &self.state.motions[link];
        [motion.omega, motion.alpha]
    }

    fn fill(&mut self, inputs: &Inputs, state: &mut State) -> Result<()> {
        self.find_angles(&inputs.angles);
        let window = self.passing.as_ref().and_then(Passing::inside);
        self.state.passing = window.map(|window| window.condition);
        if let (Some(window), Some(held)) = (window, &self.held)
            && self.case.wanted.deepest() >= Stage::Reactions
        {
            let case = self.case;
            let mut loads = |motions: &[Motion], angles: &[f64], out: &mut [Wrench]| {
                loads_held(case, motions, angles, held, out);
            };
            let rates = [inputs.speeds[0], inputs.accelerations[0]];
            let found = window.reactions(
                self.at[0],
                rates,
                Some([held.motor, held.added]),
                (case, &mut self.statics),
                &mut loads,
                &mut self.state,
            );
            found.map_err(|_| passing::unbounded(case.told(case.crank().from_coordinate(self.at[0]))))?;
        } else if self.case.wanted.deepest() >= Stage::Reactions {
            self.statics.solve_under(&self.loads, self.case, &self.plan, &mut self.state);
        }
        state.clone_from(&self.state);
        Ok(())
    }
}
