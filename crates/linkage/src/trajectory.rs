//! The result of every solver: values of channels on a grid of times. All values of channels are finite.

pub mod channel;
mod reading;
mod unit;

use crate::sentences;
pub use channel::{CHANNELS, Channel, ChannelKind, Stage};
pub use reading::{
    ChannelSubject, OfDrive, OfFrame, OfFriction, OfJoint, OfLink, OfPoint, OfSlider, OfTransmission, Reading,
};
pub use unit::{Unit, shown_unit};

use crate::error::{Error, ErrorKind, Result};
use crate::input::{Input, InputValue};

/// Values of several channels on one common grid.
#[derive(Clone, Debug, PartialEq)]
pub struct Trajectory {
    times: Vec<f64>,
    /// The input that moves the mechanism.
    input: Input,
    inputs: Vec<f64>,
    channels: Vec<Channel>,
    columns: Vec<Vec<f64>>,
}

impl Trajectory {
    /// A trajectory from its grid and one column of values per channel.
    /// The grid has times (s) and values of the input (SI unit, in the scenario's convention).
    /// The input is assumed to be an angle; for other inputs see [`Trajectory::of_input`].
    ///
    /// # Errors
    /// [`ErrorKind::Numeric`] if a value is NaN or infinite (with its channel, time and crank angle).
    /// [`ErrorKind::Numeric`] also if the list of input values or a column differs in length from the list of times, or
    /// if channels and columns differ in number.
    pub fn new(times: Vec<f64>, inputs: Vec<f64>, channels: Vec<Channel>, columns: Vec<Vec<f64>>) -> Result<Self> {
        let rows = times.len();
        if inputs.len() != rows || channels.len() != columns.len() || columns.iter().any(|c| c.len() != rows) {
            return Err(Error::new(ErrorKind::Numeric, sentences::THE_COLUMNS_OF_A_TRAJECTORY));
        }
        for (channel, column) in channels.iter().zip(&columns) {
            if all_finite(column) {
                continue;
            }
            if let Some(row) = column.iter().position(|value| !value.is_finite()) {
                let at = Input::default().at(inputs[row]);
                return Err(Error::new(ErrorKind::Numeric, sentences::is_at(&channel, &column[row], &times[row], &at)));
            }
        }
        Ok(Trajectory { times, input: Input::Angle, inputs, channels, columns })
    }

    /// This trajectory, whose input values are values of `input`.
    #[must_use]
    pub fn of_input(self, input: Input) -> Self {
        Trajectory { input, ..self }
    }

    /// The input that moves the mechanism.
    #[must_use]
    pub fn input(&self) -> Input {
        self.input
    }

    /// The input in one row, formatted for messages.
    pub fn told(&self, row: usize) -> InputValue {
        self.input.at(self.inputs[row])
    }

    /// Times of the grid (s).
    #[must_use]
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// Values of the input on the grid (SI unit, in the scenario's convention): see [`Trajectory::input`].
    #[must_use]
    pub fn inputs(&self) -> &[f64] {
        &self.inputs
    }

    /// Channels, in the order of columns.
    #[must_use]
    pub fn channels(&self) -> &[Channel] {
        &self.channels
    }

    /// Values of one channel on the grid, in its SI unit.
    #[must_use]
    pub fn column(&self, channel: &Channel) -> Option<&[f64]> {
        let index = self.channels.iter().position(|own| own == channel)?;
        Some(&self.columns[index])
    }

    /// Does the same as [`Trajectory::column`], but first checks whether the channel is at position `index`.
    /// This check saves a search, because a channel has the same position in all trajectories of one case.
    #[must_use]
    pub fn column_near(&self, channel: &Channel, index: usize) -> Option<&[f64]> {
        if self.channels.get(index) == Some(channel) { Some(&self.columns[index]) } else { self.column(channel) }
    }

    /// Values of the channel called `name`, such as `joint.A.fx_N`, on the grid, in its SI unit.
    #[must_use]
    pub fn named(&self, name: &str) -> Option<&[f64]> {
        self.column(&Channel::named(name)?)
    }

    /// The trajectory reduced to the rows where `keep` is true.
    #[must_use]
    pub fn at_rows(&self, keep: &[bool]) -> Trajectory {
        self.part(keep, &|_| true)
    }

    /// The trajectory reduced to the channels in `wanted` and the rows where `keep` is true.
    #[must_use]
    pub fn part(&self, keep: &[bool], wanted: &dyn Fn(&Channel) -> bool) -> Trajectory {
        let thin = |values: &[f64]| -> Vec<f64> {
            values.iter().zip(keep).filter(|(_, kept)| **kept).map(|(value, _)| *value).collect()
        };
        let own = || self.iter().filter(|(channel, _)| wanted(channel));
        Trajectory {
            times: thin(&self.times),
            input: self.input,
            inputs: thin(&self.inputs),
            channels: own().map(|(channel, _)| channel.clone()).collect(),
            columns: own().map(|(_, values)| thin(values)).collect(),
        }
    }

    /// Channels with their values, in the order of columns.
    pub fn iter(&self) -> impl Iterator<Item = (&Channel, &[f64])> {
        self.channels.iter().zip(self.columns.iter().map(Vec::as_slice))
    }

    /// Returns the parts of the trajectory and copies no numbers. The parts are the times (s), the values of the input
    /// (SI) and the values of each channel in its SI unit, in the order of [`Trajectory::channels`].
    #[must_use]
    pub fn into_columns(mut self) -> Vec<Vec<f64>> {
        self.columns.splice(..0, [self.times, self.inputs]);
        self.columns
    }
}

/// Whether all numbers are finite.
/// A non-finite number times zero is NaN, so one sum of such products tests several numbers at once.
fn all_finite(values: &[f64]) -> bool {
    let (chunks, rest) = values.as_chunks::<8>();
    let mut sums = [0.0; 8];
    for chunk in chunks {
        for (sum, value) in sums.iter_mut().zip(chunk) {
            *sum += 0.0 * value;
        }
    }
    sums.iter().chain(rest).fold(0.0, |sum, value| sum + 0.0 * value) == 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nan_is_refused_with_channel_and_instant() {
        let channel = Channel::named("joint.A.fx_N").unwrap();
        let error = Trajectory::new(vec![0.0, 0.5], vec![0.0, 1.0], vec![channel], vec![vec![1.0, f64::NAN]]);
        let message = error.unwrap_err().to_string();
        assert!(message.contains("joint.A.fx_N is NaN at t = 0.500000 s, crank angle 57.2958 deg"), "{message}");
    }

    #[test]
    fn non_finite_values_are_found_at_any_position() {
        for wrong in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            for length in [1, 7, 8, 21] {
                let finite = vec![-f64::MAX; length];
                assert!(all_finite(&finite));
                for row in 0..length {
                    let mut values = finite.clone();
                    values[row] = wrong;
                    assert!(!all_finite(&values), "{wrong} at {row} of {length}");
                }
            }
        }
    }

    #[test]
    fn ragged_columns_are_refused() {
        let channel = Channel::named("drive.torque_N_m").unwrap();
        assert!(Trajectory::new(vec![0.0], vec![0.0], vec![channel], vec![vec![]]).is_err());
    }
}
