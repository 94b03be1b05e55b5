//! Free motion of the whole mechanism: J q'' = gamma + E alpha.
//! The unknown accelerations alpha of the free driving links are found by embedding.
//!
//! V = J^-1 E has one column per drive. Then q'' = a0 + V alpha.
//! V^T J^T lambda = E^T lambda are the moments of the drives, which motor and rotor determine.
//! The equations for alpha are (V^T M V + added) alpha = T + V^T (Q - M a0).
//! T is the moment of the motor, and `added` the moment of inertia of rotor and reducer, both on the first drive.
//! The multipliers then are the reactions (Haug 1989, section 6.6, as in `solver`).
//! See docs/numerics/forces.md.

use super::friction::Freedom;
use super::passing::Passing;
use super::steps::TRACKING_STEP;
use super::system::System;
use crate::motion::side::{Held, Inputs, Side, embed, loads_held};
use crate::sentences;
use linkage::drive::Wrench;
use linkage::error::Result;
use linkage::math::dense::Lu;
use linkage::math::{KeepNan, Vec2};
use linkage::mechanism::{self, GROUND, JointId, LinkId};
use linkage::solver::State;
use linkage::trajectory::Stage;

/// Largest accepted difference between a corrected and a predicted coordinate in one tracking step.
/// Angles are in rad; positions are divided by the mechanism's size.
const JUMP: f64 = 10.0 * TRACKING_STEP;

/// A system whose free driving links move under forces.
pub(super) struct Embedded<'a> {
    system: System<'a>,
    free: Vec<usize>,
    /// Columns V of all drives, one after the other.
    columns: Vec<f64>,
    /// a0.
    rest: Vec<f64>,
    /// Q - M a0.
    force: Vec<f64>,
    matrix: Lu,
    right: Vec<f64>,
    /// The argument `held` of the last call of `accelerate` in a window around a change point.
    held: Option<Held>,
    passing: Option<Passing>,
}

impl<'a> Embedded<'a> {
    /// The equations of a system at its start pose. `passing` is the path of the mechanism through change points.
    pub(super) fn new(system: System<'a>, passing: Option<Passing>) -> Self {
        let n = system.q.len();
        let drives = system.inputs.len();
        let free: Vec<usize> = system.case.drives.free().map(|(index, _)| index).collect();
        let mut embedded = Embedded {
            columns: vec![0.0; n * drives],
            rest: vec![0.0; n],
            force: vec![0.0; n],
            matrix: Lu::new(free.len()),
            right: vec![0.0; free.len()],
            held: None,
            passing,
            free,
            system,
        };
        embedded.find_columns();
        embedded
    }

    fn find_columns(&mut self) {
        let n = self.system.q.len();
        let first = self.system.case.mechanism.row_of_drive(0);
        for (index, column) in self.columns.chunks_mut(n).enumerate() {
            column.fill(0.0);
            column[first + index] = 1.0;
            self.system.jacobian.solve(column);
        }
    }

    /// Follows the branch to the given angles of the driving links, in small steps.
    fn go_to(&mut self, angles: &[f64]) -> Result<()> {
        if let Some(passing) = &mut self.passing {
            passing.go_to(&mut self.system, angles[0])?;
            self.columns.copy_from_slice(&passing.spot.slope);
            return Ok(());
        }
        let from: Vec<f64> = self.system.inputs.iter().map(|input| input.value).collect();
        let farthest = from.iter().zip(angles).fold(0.0f64, |most, (a, b)| most.larger((b - a).abs()));
        let parts = (farthest / TRACKING_STEP).ceil().larger(1.0);
        let n = self.system.q.len();
        for part in 1..=parts as usize {
            let share = part as f64 / parts;
            let system = &mut self.system;
            for (index, (&from, &to)) in from.iter().zip(angles).enumerate() {
                let target = if share < 1.0 { from + (to - from) * share } else { to };
                let turn = target - system.inputs[index].value;
                for (q, rate) in system.q.iter_mut().zip(&self.columns[index * n..]) {
                    *q += turn * rate;
                }
                system.inputs[index].value = target;
            }
            system.predicted.copy_from_slice(&system.q);
            system.correct()?;
            self.check_branch()?;
            self.system.check_singular()?;
            self.find_columns();
        }
        Ok(())
    }

    fn check_branch(&self) -> Result<()> {
        let system = &self.system;
        system.check_signs()?;
        let size = system.case.mechanism.size();
        for (index, (q, predicted)) in system.q.iter().zip(&system.predicted).enumerate() {
            let allowed = JUMP * if index % 3 == 2 { 1.0 } else { size };
            if !((q - predicted).abs() <= allowed) {
                return Err(system.lost(sentences::THE_SOLUTION_HAS_JUMPED_TO_ANOTHER));
            }
        }
        Ok(())
    }

    fn set_rates(&mut self, inputs: &Inputs) {
        for (own, (&omega, &alpha)) in
            self.system.inputs.iter_mut().zip(inputs.speeds.iter().zip(&inputs.accelerations))
        {
            (own.rate, own.acceleration) = (omega, alpha);
        }
        match &self.passing {
            Some(passing) => passing.rates(&mut self.system, inputs.speeds[0], inputs.accelerations[0]),
            None => self.system.differentiate(),
        }
    }
}

impl Side for Embedded<'_> {
    fn accelerate(&mut self, inputs: &mut Inputs, held: &Held) -> Result<()> {
        self.go_to(&inputs.angles)?;
        for &index in &self.free {
            inputs.accelerations[index] = 0.0;
        }
        self.set_rates(inputs);
        self.rest.copy_from_slice(&self.system.second);
        self.system.find_loads(|case, motions, angles, out| loads_held(case, motions, angles, held, out));
        let (case, n) = (self.system.case, self.system.q.len());
        for (link, body) in case.mechanism.links().entries().skip(1) {
            let i = 3 * (link.index() - 1);
            let Wrench { force, moment } = self.system.loads[link];
            self.force[i] = body.mass * (case.gravity.x - self.rest[i]) + force.x;
            self.force[i + 1] = body.mass * (case.gravity.y - self.rest[i + 1]) + force.y;
            self.force[i + 2] = moment - body.inertia * self.rest[i + 2];
        }
        self.matrix.clear();
        for (row, &drive) in self.free.iter().enumerate() {
            let column = &self.columns[drive * n..][..n];
            self.right[row] = column.iter().zip(&self.force).map(|(v, f)| v * f).sum();
            for (other, &second) in self.free.iter().enumerate() {
                let beside = &self.columns[second * n..][..n];
                let mass = |i: usize| {
                    let link = &case.mechanism.links()[LinkId(1 + i / 3)];
                    if i % 3 == 2 { link.inertia } else { link.mass }
                };
                let sum = (0..n).map(|i| mass(i) * column[i] * beside[i]).sum();
                self.matrix.add(row, other, sum);
            }
            if drive == 0 {
                self.right[row] += held.motor;
                self.matrix.add(row, row, held.added);
            }
        }
        embed(&mut self.matrix, &mut self.right, &self.free, inputs)?;
        self.set_rates(inputs);
        if self.passing.as_ref().is_some_and(|passing| passing.inside().is_some()) {
            self.held = Some(held.clone());
        }
        if self.system.has_friction {
            self.system.multipliers();
            self.system.rub(Some(&Freedom { columns: &self.columns, free: &self.free, held }))?;
            for &index in &self.free {
                inputs.accelerations[index] = self.system.inputs[index].acceleration;
            }
        }
        Ok(())
    }

    fn spin(&mut self, inputs: &Inputs, link: LinkId) -> Result<f64> {
        self.go_to(&inputs.angles)?;
        self.set_rates(inputs);
        Ok(self.link_rates(link)[0])
    }

    fn velocity(&mut self, inputs: &Inputs, at: mechanism::JointSide) -> Result<Vec2> {
        self.spin(inputs, at.link)?;
        Ok(self.system.velocity(at))
    }

    fn acceleration(&self, at: mechanism::JointSide) -> Vec2 {
        self.system.motion(at.link).0.point_acceleration(at.local)
    }

    fn joint_ends(&self, joint: JointId) -> [LinkId; 2] {
        let joint = &self.system.case.mechanism.joints()[joint];
        [joint.first.link, joint.second.link]
    }

    fn joint_rates(&mut self, joint: JointId) -> [f64; 2] {
        for link in self.joint_ends(joint).into_iter().filter(|link| *link != GROUND) {
            self.system.motions[link] = self.system.motion(link).0;
        }
        self.system.case.mechanism.joints()[joint].rates(&self.system.motions)
    }

    fn link_rates(&self, link: LinkId) -> [f64; 2] {
        let theta = 3 * (link.index() - 1) + 2;
        [self.system.rate[theta], self.system.second[theta]]
    }

    fn fill(&mut self, _: &Inputs, state: &mut State) -> Result<()> {
        if self.system.stage >= Stage::Reactions {
            let beside = self.passing.as_ref().filter(|passing| passing.inside().is_some());
            match (beside, &self.held) {
                (Some(passing), Some(held)) => {
                    let shaft = Some([held.motor, held.added]);
                    passing.multipliers(&mut self.system, shaft, &mut |case, motions, angles, out| {
                        loads_held(case, motions, angles, held, out);
                    })?;
                }
                // With friction, the multipliers were computed together with the accelerations.
                _ if self.system.has_friction => {}
                (Some(_), None) | (None, _) => self.system.multipliers(),
            }
        }
        self.system.fill(state);
        state.passing = self.passing.as_ref().and_then(Passing::condition);
        Ok(())
    }
}
