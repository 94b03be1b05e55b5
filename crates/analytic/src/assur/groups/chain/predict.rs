//! Prediction of a group's unknowns after the next step, from its last steps.

/// Number of steps that a prediction uses.
const MEMORY: usize = 5;

/// Copies one number per driving link. The usual case of one driving link is treated separately.
#[inline(always)]
pub(super) fn copy(from: &[f64], to: &mut [f64]) {
    match (from, &mut *to) {
        ([one], [own]) => *own = *one,
        (from, to) => to.copy_from_slice(from),
    }
}

/// Changes of the unknowns from pose to pose.
#[derive(Clone, Debug)]
pub(super) struct Memory {
    /// For each unknown: its change in the last step, and the first to fourth backward differences of this change.
    /// The differences are zero if too few steps are known.
    /// `equal_steps` is the number of successive equal steps up to the last step.
    /// `last_step` is the last step (rad of the driving angles).
    differences: Vec<[f64; MEMORY]>,
    equal_steps: usize,
    last_step: Vec<f64>,
    /// Changes of the unknowns so far in the present step, and whether the present step equals the last step.
    present: Vec<f64>,
    is_repeated: bool,
}

impl Memory {
    pub(super) fn of(unknowns: usize, drives: usize) -> Self {
        Memory {
            differences: vec![[0.0; MEMORY]; unknowns],
            equal_steps: 0,
            last_step: vec![f64::NAN; drives],
            present: vec![0.0; unknowns],
            is_repeated: false,
        }
    }

    /// Forgets the last step.
    pub(super) fn forget(&mut self) {
        self.last_step.fill(f64::NAN);
    }

    /// Forgets the last step and the number of equal steps.
    pub(super) fn start_anew(&mut self) {
        self.forget();
        self.equal_steps = 0;
    }

    /// Begins a step of the driving angles. Returns whether this step equals the last step.
    /// If the steps are equal, the changes of the unknowns are extrapolated from the last steps; otherwise they are
    /// zero.
    /// The extrapolation assumes that the backward difference of the next higher order is zero.
    /// The next change is then the sum of the last change and all its differences.
    pub(super) fn predict(&mut self, step: &[f64]) -> bool {
        let same = |(step, last): (&f64, &f64)| (step - last).abs() <= 1e-6 * step.abs();
        self.is_repeated = step.iter().zip(&self.last_step).all(same);
        if self.is_repeated {
            for (present, [change, first, second, third, fourth]) in self.present.iter_mut().zip(&self.differences) {
                *present = change + (first + (second + (third + fourth)));
            }
        } else {
            self.present.fill(0.0);
        }
        self.is_repeated
    }

    /// Change of an unknown in the present step so far.
    #[inline]
    pub(super) fn change(&self, unknown: usize) -> f64 {
        self.present[unknown]
    }

    /// Subtracts corrections of the unknowns from their changes in the present step.
    #[inline]
    pub(super) fn correct(&mut self, corrections: &[f64]) {
        self.present.iter_mut().zip(corrections).for_each(|(present, correction)| *present -= correction);
    }

    /// Whether every unknown has changed by at most `bound` in the present step.
    #[inline]
    pub(super) fn is_within(&self, bound: f64) -> bool {
        self.present.iter().all(|change| change.abs() <= bound)
    }

    /// Stores the present step for the next prediction.
    pub(super) fn remember(&mut self, step: &[f64]) {
        self.equal_steps = if self.is_repeated { self.equal_steps + 1 } else { 1 };
        // Differences of unequal or unknown steps are zero.
        let orders = self.equal_steps.min(MEMORY);
        for (differences, &present) in self.differences.iter_mut().zip(&self.present) {
            let [a, b, c, d, _] = *differences;
            let first = present - a;
            let second = first - b;
            let third = second - c;
            *differences = [present, first, second, third, third - d];
            if orders < MEMORY {
                differences[orders..].fill(0.0);
            }
        }
        copy(step, &mut self.last_step);
    }
}
