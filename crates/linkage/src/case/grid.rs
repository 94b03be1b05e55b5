//! The instants at which a solution is requested.

use crate::sentences;
use std::f64::consts::TAU;

use crate::drive::{Drive, Drives};
use crate::input::Input;
use crate::math::KeepNan;
use crate::math::statistics::ascending;

/// The instants at which a solution is requested.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Grid {
    /// Times (s), in any order.
    pub times: Vec<f64>,
    /// Input values at the times of the grid (SI unit, in the scenario's convention).
    pub inputs: Vec<f64>,
}

impl Grid {
    /// Returns the grid of the given times (s).
    #[must_use]
    pub fn of_times(drive: &Drive, times: Vec<f64>) -> Self {
        let inputs = times.iter().map(|&t| drive.at(t).value).collect();
        Grid { times, inputs }
    }

    /// Returns the grid of the given input values (SI unit, in the scenario's convention).
    /// For a free driving link the times depend on the forces, so they are unknown (NaN). [`Grid::check`] rejects this
    /// grid.
    #[must_use]
    pub fn of_inputs(drive: &Drive, inputs: Vec<f64>) -> Self {
        let time = |&angle: &f64| if drive.is_free() { f64::NAN } else { drive.time_of(angle) };
        let times = inputs.iter().map(time).collect();
        Grid { times, inputs }
    }

    /// Number of instants.
    #[must_use]
    pub fn len(&self) -> usize {
        self.times.len()
    }

    /// Whether the grid has no instants.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.times.is_empty()
    }

    /// Upper limit of the absolute input values of a grid, in turns.
    /// Solvers follow the assembly branch from the start to every input value of the grid.
    /// Above this limit, rounding removes the last digits of an angle.
    pub const MOST_TURNS: f64 = 1e5;

    /// Checks that all times and angles are finite and that all angles are within [`Grid::MOST_TURNS`].
    /// Also checks that the law of every drive is defined at all times.
    ///
    /// # Errors
    /// A message that names the fault.
    /// The faults are: crank angles in the grid of a free crank, an input that the law reaches never or more than once,
    /// a time outside the law of a drive, and inputs that are too large or not finite.
    pub fn check(&self, drives: &Drives) -> std::result::Result<(), String> {
        self.check_crank(drives.crank())?;
        let further = (2..).zip(drives.further()).filter(|(_, drive)| drive.constant_speed().is_none());
        for (number, drive) in further {
            let end = drive.end().unwrap_or(f64::INFINITY);
            if let Some(t) = self.beyond(end) {
                return Err(sentences::the_grid_leads_to_but_drive(&t, &number, &drive.law_name(), &end));
            }
        }
        Ok(())
    }

    /// The first time before t = 0 or after `end` (s).
    /// A time may exceed the end by a rounding error, so a relative excess of 1e-12 is allowed.
    fn beyond(&self, end: f64) -> Option<f64> {
        self.times.iter().copied().find(|&t| t < 0.0 || t > end * (1.0 + 1e-12))
    }

    fn check_crank(&self, drive: &Drive) -> std::result::Result<(), String> {
        let has_angles_alone =
            self.times.iter().all(|t| t.is_nan()) && self.inputs.iter().all(|input| input.is_finite());
        if drive.is_free() && !self.is_empty() && has_angles_alone {
            return Err(sentences::THE_MOTION_IS_FREE_WHEN_THE_CRANK.into());
        }
        if drive.constant_speed().is_none() {
            let name = drive.law_name();
            let unreached = self.times.iter().position(|t| t.is_nan());
            if let Some(row) = unreached.filter(|_| self.inputs.iter().all(|input| input.is_finite())) {
                let (input, (unit, _)) = (drive.input, drive.input.shown_in());
                let value = format_args!("{:.3} {unit}", input.shown(self.inputs[row]));
                return Err(sentences::the_drive_law_does_not_come(&name, &input.noun(), &value));
            }
            let end = drive.end().unwrap_or(f64::INFINITY);
            if let Some(t) = self.beyond(end) {
                return Err(sentences::the_grid_leads_to_but_the_drive(&t, &name, &end));
            }
        }
        let most = self.inputs.iter().fold(0.0, |most: f64, input| most.larger(input.abs())) / TAU;
        if most <= Self::MOST_TURNS && self.times.iter().chain(&self.inputs).all(|value| value.is_finite()) {
            return Ok(());
        }
        Err(sentences::the_grid_leads_turns_away(&format_args!("{most:.1e}"), &format_args!("{:e}", Self::MOST_TURNS)))
    }

    /// Rows of the grid, sorted by ascending time.
    #[must_use]
    pub fn ascending(&self) -> Vec<usize> {
        ascending(&self.times)
    }
}

/// An instant of the motion at which a value is valid or a picture is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum When {
    /// At a value of the input, such as a crank angle (SI unit, as the scenario measures the input).
    /// If forces determine the motion, the value is valid for the nominal motion.
    Crank(f64),
    /// At a time (s) of the motion of the scenario.
    Time(f64),
}

impl When {
    /// The input (SI unit), such as the crank angle, if the value is valid at an input.
    #[must_use]
    pub fn crank(self) -> Option<f64> {
        if let When::Crank(crank) = self { Some(crank) } else { None }
    }

    /// The time (s); `None` if the instant is given as a crank angle.
    #[must_use]
    pub fn time(self) -> Option<f64> {
        if let When::Time(time) = self { Some(time) } else { None }
    }

    /// The grid of this instant only.
    #[must_use]
    pub fn grid(self, drive: &Drive) -> Grid {
        match self {
            When::Crank(crank) => Grid::of_inputs(drive, vec![crank]),
            When::Time(time) => Grid::of_times(drive, vec![time]),
        }
    }

    /// The instant in words, for a scenario with this input.
    #[must_use]
    pub fn told(self, input: Input) -> String {
        match self {
            When::Crank(value) => format!("{:.3}", input.at(value)),
            When::Time(time) => format!("{time} s"),
        }
    }
}
