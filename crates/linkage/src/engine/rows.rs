//! The states of a whole run in one block of memory, reduced to the numbers that the requested channels need.
//!
//! A [`State`] has six separate lists, with memory for every stage.
//! In a run of many instants, the overhead of separate states would exceed the memory of the numbers.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::case::Case;
use crate::error::Result;
use crate::math::Vec2;
use crate::mechanism::JointId;
use crate::solver::{Progress, Solver, State};
use crate::trajectory::Stage;

/// States by row of the grid.
#[derive(Debug)]
pub struct Rows {
    layout: Layout,
    values: Vec<f64>,
    /// For every row: whether the run has reached the row.
    reached: Vec<bool>,
    /// [`State::passing`] by row, for the few rows in which this field is not `None`.
    passing: BTreeMap<usize, f64>,
}

/// Selects the numbers of a state that are stored.
#[derive(Clone, Debug)]
struct Layout {
    links: usize,
    velocities: bool,
    accelerations: bool,
    /// Number of joints whose forces are stored.
    joints: usize,
    /// The joints that transmit a moment, if forces are stored.
    sliding: Vec<JointId>,
    /// Number of transmissions whose forces are stored.
    transmissions: usize,
    /// Number of drives whose forces are stored.
    drives: usize,
}

impl Layout {
    /// Layout of the numbers that the requested channels of a case need.
    /// If forces are stored, velocities and accelerations are also stored, because forces depend on the whole motion.
    /// Velocities are also stored if a load depends on a sense of motion.
    fn of(case: &Case) -> Self {
        let deepest = case.wanted.deepest();
        let with_forces = deepest >= Stage::Reactions;
        let has_sense = case.has_sense();
        let joints = case.mechanism.joints();
        let slides = |&index: &JointId| joints[index].slides();
        Layout {
            links: case.mechanism.links().len() - 1,
            velocities: has_sense || deepest >= Stage::Velocities,
            accelerations: deepest >= Stage::Accelerations,
            joints: if with_forces { joints.len() } else { 0 },
            sliding: if with_forces { joints.ids().filter(slides).collect() } else { Vec::new() },
            transmissions: if with_forces { case.mechanism.transmissions().len() } else { 0 },
            drives: if with_forces { case.drives.len() } else { 0 },
        }
    }

    /// Number of values per state.
    fn width(&self) -> usize {
        let rates = usize::from(self.velocities) + usize::from(self.accelerations);
        self.links * (5 + 3 * rates) + 2 * self.joints + self.sliding.len() + self.transmissions + self.drives
    }
}

impl Rows {
    /// Allocates all rows of a case. Each row is marked as not reached.
    #[must_use]
    pub fn new(case: &Case) -> Self {
        let layout = Layout::of(case);
        let rows = case.grid.len();
        let values = vec![0.0; rows * layout.width()];
        Rows { layout, values, reached: vec![false; rows], passing: BTreeMap::new() }
    }

    /// Memory of one row of a case (bytes).
    #[must_use]
    pub fn bytes_of_row(case: &Case) -> usize {
        Layout::of(case).width() * size_of::<f64>() + size_of::<bool>()
    }

    /// Whether the run has reached the row with this index.
    #[must_use]
    pub fn has(&self, row: usize) -> bool {
        self.reached[row]
    }

    /// Stores the state of a row.
    pub fn put(&mut self, row: usize, state: &State) {
        let Layout { velocities, accelerations, joints, sliding, transmissions, drives, links: _ } = &self.layout;
        let width = self.layout.width();
        let mut left = self.values[row * width..][..width].iter_mut();
        let mut put = |value: f64| *left.next().expect("as many numbers as the layout has") = value;
        let mut put_pair = |pair: Vec2| [pair.x, pair.y].into_iter().for_each(&mut put);
        for motion in &state.motions[1..] {
            put_pair(motion.origin);
            put_pair(motion.direction);
            if *velocities {
                put_pair(motion.velocity);
            }
            if *accelerations {
                put_pair(motion.acceleration);
            }
        }
        state.forces.iter().take(*joints).for_each(|&force| put_pair(force));
        for (motion, &angle) in state.motions.iter().zip(&state.angles).skip(1) {
            put(angle);
            if *velocities {
                put(motion.omega);
            }
            if *accelerations {
                put(motion.alpha);
            }
        }
        sliding.iter().for_each(|&joint| put(state.moments[joint]));
        state.transmitted.iter().take(*transmissions).for_each(|&force| put(force));
        state.torques[..*drives].iter().for_each(|&torque| put(torque));
        self.reached[row] = true;
        self.passing.extend(state.passing.map(|condition| (row, condition)));
    }

    /// Copies the stored row into `state`, a state of the same case, and returns `true`.
    /// If the run has not reached the row, returns `false` and leaves `state` unchanged.
    pub fn get(&self, row: usize, state: &mut State) -> bool {
        if !self.reached[row] {
            return false;
        }
        let Layout { velocities, accelerations, joints, sliding, transmissions, drives, links: _ } = &self.layout;
        let width = self.layout.width();
        let mut left = self.values[row * width..][..width].iter().copied();
        let mut get = || left.next().expect("as many numbers as the layout has");
        let mut get_pair = || Vec2::new(get(), get());
        for motion in &mut state.motions[1..] {
            motion.origin = get_pair();
            motion.direction = get_pair();
            if *velocities {
                motion.velocity = get_pair();
            }
            if *accelerations {
                motion.acceleration = get_pair();
            }
        }
        state.forces.iter_mut().take(*joints).for_each(|force| *force = get_pair());
        for (motion, angle) in state.motions.iter_mut().zip(&mut state.angles).skip(1) {
            *angle = get();
            if *velocities {
                motion.omega = get();
            }
            if *accelerations {
                motion.alpha = get();
            }
        }
        sliding.iter().for_each(|&joint| state.moments[joint] = get());
        state.transmitted.iter_mut().take(*transmissions).for_each(|force| *force = get());
        state.torques[..*drives].iter_mut().for_each(|torque| *torque = get());
        state.passing = self.passing.get(&row).copied();
        true
    }

    /// Collects the states of a whole run of a solver.
    ///
    /// # Errors
    /// The errors of [`Solver::sweep`].
    pub(super) fn of_solver<S: Solver + ?Sized>(solver: &S, case: &Case, progress: Progress) -> Result<Arc<Rows>> {
        let (rows, outcome) = Rows::of_run(case, |visit| solver.sweep(case, visit, progress));
        outcome.map(|()| Arc::new(rows))
    }

    /// Collects the states that `sweep` visits. If the run fails, returns the states visited so far with the error.
    pub(super) fn of_run(
        case: &Case,
        sweep: impl FnOnce(&mut dyn FnMut(usize, &State) -> Result<()>) -> Result<()>,
    ) -> (Self, Result<()>) {
        let mut rows = Rows::new(case);
        let mut keep = |row: usize, state: &State| {
            rows.put(row, state);
            Ok(())
        };
        let outcome = sweep(&mut keep);
        (rows, outcome)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::{Grid, Wanted};
    use crate::fixtures;

    /// A four-bar at two instants.
    fn instants() -> Case {
        let case = fixtures::turning(fixtures::four_bar());
        case.on(Grid::of_times(case.crank(), vec![0.0, 0.1])).unwrap()
    }

    /// A state whose numbers are all different.
    fn numbered(case: &Case) -> State {
        let mut state = State::at_rest(case);
        let mut next = 0.0;
        let mut number = || {
            next += 1.0;
            next
        };
        for (motion, angle) in state.motions.iter_mut().zip(&mut state.angles).skip(1) {
            let mut pair = || Vec2::new(number(), number());
            (motion.origin, motion.direction, motion.velocity, motion.acceleration) = (pair(), pair(), pair(), pair());
            (motion.omega, motion.alpha, *angle) = (number(), number(), number());
        }
        state.forces.iter_mut().for_each(|force| *force = Vec2::new(number(), number()));
        state.torques.iter_mut().for_each(|torque| *torque = number());
        state
    }

    #[test]
    fn only_stored_states_are_returned_bit_for_bit() {
        let case = instants();
        let state = numbered(&case);
        let mut rows = Rows::new(&case);
        rows.put(1, &state);
        let mut back = State::at_rest(&case);
        assert!(!rows.get(0, &mut back) && rows.get(1, &mut back));
        assert_eq!(format!("{back:?}"), format!("{state:?}"));
    }

    #[test]
    fn positions_alone_need_two_fifths_of_the_memory() {
        let case = instants();
        let positions = case.with(|parts| parts.wanted = Wanted::of(&[Stage::Positions])).unwrap();
        assert!(5 * Rows::bytes_of_row(&positions) <= 2 * Rows::bytes_of_row(&case));
        let state = numbered(&positions);
        let (rows, _) = Rows::of_run(&positions, |visit| visit(0, &state));
        let mut back = State::at_rest(&positions);
        assert!(rows.get(0, &mut back));
        for (own, other) in back.motions.iter().zip(&state.motions).skip(1) {
            assert_eq!((own.origin, own.direction, own.omega), (other.origin, other.direction, 0.0));
        }
        assert_eq!(back.angles, state.angles);
    }
}
