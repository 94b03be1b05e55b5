//! Differences between two trajectories, channel by channel.
//! See docs/numerics/bounds.md.

use crate::sentences;
use std::collections::BTreeMap;

use linkage::math::{KeepNan, largest_size};

use linkage::error::{Error, ErrorKind, Result};
use linkage::input::Input;
use linkage::math::statistics::{differences, half_range, quantile, rms, share, sorted_sizes};
use linkage::trajectory::{Channel, Trajectory, Unit};

/// A channel's scale is at least this fraction of the natural size of its quantity (both are defined at [`scales`]).
/// A nearly constant coordinate inherits errors from neighbouring coordinates, so its small motion is no measure of its
/// errors.
const SMALLEST_SHARE: f64 = 1e-3;

/// The scale of a rate, a force or a moment is at least this fraction of its largest value.
const SMALLEST_OWN_SHARE: f64 = 0.1;

/// Distribution of the absolute differences in one channel.
#[derive(Clone, Debug, PartialEq)]
pub struct Residual {
    /// The channel.
    pub channel: Channel,
    /// Scale of the channel over the run, in its unit: see [`scales`].
    pub scale: f64,
    /// Largest absolute difference, in the channel's unit.
    pub max: f64,
    /// Root of the mean square of the differences.
    pub rms: f64,
    /// Three quarters of the absolute differences are below this value.
    pub q75: f64,
    /// 99 of 100 absolute differences are below this value.
    pub q99: f64,
    /// Time of the largest difference (s).
    pub worst_time: f64,
    /// Value of the input at the largest difference (SI).
    pub worst_crank: f64,
    /// Kind of the input whose value is `worst_crank`.
    pub input: Input,
}

impl Residual {
    /// Largest absolute difference divided by the channel's scale; 0 if there is no difference.
    #[must_use]
    pub fn share(&self) -> f64 {
        share(self.max, self.scale)
    }
}

/// A force counts as rounding if it is at most this fraction of the largest force.
/// The forces that the analytic sides compute have errors of at most a tenth of this limit.
/// Any value counts as rounding if it is at most this fraction of its quantity's natural size in `Built`.
const VANISHING: f64 = 1e-9;

/// Scale of every channel: half the range of its values over the run.
/// The scale is at least a thousandth of the natural size of the quantity.
/// For a rate, a force or a moment the scale is also at least a tenth of the largest value.
/// A constant rate, force or moment therefore has a scale that is proportional to its value.
/// A coordinate has no such lower limit from its largest value, because the origin of a coordinate is arbitrary.
///
/// The natural size of coordinates is the largest half range among the quantity's channels.
/// The natural size of a quantity that is not a coordinate is the largest value of its channels.
/// The natural size is at least the value that follows from the crank's motion and the sizes of coordinates and forces.
/// A quantity that is zero in the whole mechanism therefore has a scale too.
///
/// On a grid of one instant the range of every channel is zero.
/// On such a grid the scale is the natural size: one radian for angles, half the extent of all coordinates for lengths.
#[must_use]
pub fn scales(trajectory: &Trajectory) -> Vec<f64> {
    scales_beyond(&vec![0.0; trajectory.channels().len()], trajectory, &Built::default())
}

/// Scales as in `scales`, for a trajectory with known `errors` (in the units of its channels). The values of a rate, a
/// force or a moment are rounding if they are zero within the error at every instant. Reasons for such values are a
/// constant speed, a link that only translates, a joint that guides nothing, or a parallelogram. The scale of such a
/// channel is a tenth of the natural size of its quantity, just as the scale of a constant channel is a tenth of the
/// channel's value.
///
/// A natural size that is no larger than the rounding error of the size in `built` is replaced by the size in `built`.
/// This is the case, for example, for the forces of a balanced rotor without gravity, and for the rates of a mechanism
/// in equilibrium.
#[must_use]
pub(crate) fn scales_beyond(errors: &[f64], trajectory: &Trajectory, built: &Built) -> Vec<f64> {
    let is_instant = trajectory.times().len() == 1;
    let coordinates = || trajectory.iter().filter(|(channel, _)| channel.kind.unit == Unit::Metre);
    let extent = half_range(&coordinates().flat_map(|(_, values)| values.iter().copied()).collect::<Vec<f64>>());
    let half = |(channel, values): (&Channel, &[f64])| match is_instant && channel.kind.unit == Unit::Metre {
        true => extent,
        false => half_range(values),
    };
    let halves: Vec<f64> = trajectory.iter().map(half).collect();
    let largest = trajectory.iter().map(|(channel, values)| match is_coordinate(channel) {
        true => 0.0,
        false => largest_size(values),
    });
    let own: Vec<[f64; 2]> = halves.iter().copied().zip(largest).map(|(half, largest)| [half, largest]).collect();
    let sizes = own.iter().map(|[half, largest]| half.larger(*largest));
    let (turn, share) = if is_instant { (1.0, 1.0) } else { (half_range(trajectory.inputs()), SMALLEST_SHARE) };
    let sizes = Sizes::of(trajectory, trajectory.channels().iter().zip(sizes));
    let of = |(index, channel): (usize, &Channel)| {
        let [half, largest] = own[index];
        let natural = built.unless(sizes.natural(channel, turn), channel.kind.unit);
        let natural = natural.larger(sizes.of_translation(channel));
        let vanishes = !is_coordinate(channel) && largest <= errors[index];
        let share = if vanishes { share.larger(SMALLEST_OWN_SHARE) } else { share };
        half.larger(SMALLEST_OWN_SHARE * largest).larger(share * natural)
    };
    trajectory.channels().iter().enumerate().map(of).collect()
}

/// Natural sizes that follow from the data of a case, whichever links move.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Built {
    /// Size of the mechanism (m).
    pub(crate) length: f64,
    /// Speed of the fastest drive (rad/s); for a free link, its nominal speed.
    pub(crate) speed: f64,
    /// The larger of two forces (N): the weight of all links, and their mass times the acceleration
    /// `speed`^2 `length`.
    pub(crate) force: f64,
}

impl Built {
    /// Natural size of a quantity with this unit, from the data in `self`.
    /// The natural size of angles and of their derivatives is proportional to the rotation `turn` (rad).
    fn of(&self, unit: Unit, turn: f64) -> f64 {
        let Built { length, speed, force } = *self;
        match unit {
            Unit::Radian => turn,
            Unit::RadianPerSecond => speed * turn,
            Unit::RadianPerSecondSquared => speed * speed * turn,
            Unit::Metre => length,
            Unit::MetrePerSecond => speed * length,
            Unit::MetrePerSecondSquared => speed * speed * length,
            Unit::Newton => force,
            Unit::NewtonMetre => force * length,
        }
    }

    /// Returns `size`. If `size` is only a rounding error of the natural size that follows from the case's data,
    /// returns that natural size instead.
    pub(crate) fn unless(&self, size: f64, unit: Unit) -> f64 {
        let own = self.of(unit, 1.0);
        if size <= VANISHING * own { own } else { size }
    }
}

/// Whether a channel is a position or an angle: the origin is then arbitrary, so the magnitude of the values has no
/// meaning.
fn is_coordinate(channel: &Channel) -> bool {
    matches!(channel.kind.unit, Unit::Radian | Unit::Metre)
}

/// For every channel, the size to which its rounding error is proportional.
/// The size is the largest absolute value among the channels of the quantity.
/// The size is at least the value that follows from a rotation of one radian and the largest coordinates and forces.
#[must_use]
pub fn magnitudes(trajectory: &Trajectory) -> Vec<f64> {
    let sizes = largest_sizes(trajectory);
    let all = Sizes::of(trajectory, trajectory.channels().iter().zip(sizes));
    trajectory.channels().iter().map(|channel| all.rounded_with(channel)).collect()
}

/// Sizes as in `magnitudes`, but separate for each set of channels.
/// `sets[channel]` is the set of a channel. `feeds(from, to)` tells whether numbers of the set `to` are computed from
/// channels of the set `from`.
pub(crate) fn magnitudes_by(trajectory: &Trajectory, sets: &[usize], feeds: &dyn Fn(usize, usize) -> bool) -> Vec<f64> {
    let largest = largest_sizes(trajectory);
    let count = 1 + sets.iter().copied().max().unwrap_or(0);
    let mut members: Vec<Vec<usize>> = vec![Vec::new(); count];
    for (channel, &set) in sets.iter().enumerate() {
        members[set].push(channel);
    }
    let of_set = |own: &Vec<usize>| {
        Sizes::of(trajectory, own.iter().map(|&channel| (&trajectory.channels()[channel], largest[channel])))
    };
    let own: Vec<Sizes> = members.iter().map(of_set).collect();
    let sizes_of = |set: usize| {
        let fed = own.iter().enumerate().filter(|&(from, _)| feeds(from, set));
        fed.fold(Sizes::of(trajectory, std::iter::empty()), |all, (_, own)| all.with(own))
    };
    let all: Vec<Sizes> = (0..count).map(sizes_of).collect();
    trajectory.channels().iter().zip(sets).map(|(channel, &set)| all[set].rounded_with(channel)).collect()
}

fn largest_sizes(trajectory: &Trajectory) -> Vec<f64> {
    trajectory.iter().map(|(_, values)| largest_size(values)).collect()
}

/// Sizes of the values in a selection of channels.
struct Sizes {
    of_quantity: BTreeMap<&'static str, f64>,
    /// Largest sizes of coordinates and forces, and the mean speed of the crank.
    largest: Built,
    /// Largest velocity (m/s) and acceleration (m/s^2) of a point.
    of_points: [f64; 2],
}

impl Sizes {
    fn of<'a>(trajectory: &Trajectory, own: impl Iterator<Item = (&'a Channel, f64)>) -> Self {
        let span = half_range(trajectory.times());
        let speed = if span > 0.0 { half_range(trajectory.inputs()) / span } else { 0.0 };
        let mut sizes =
            Sizes { of_quantity: BTreeMap::new(), largest: Built { speed, ..Built::default() }, of_points: [0.0; 2] };
        for (channel, size) in own {
            let of_quantity = sizes.of_quantity.entry(channel.kind.quantity).or_insert(0.0);
            *of_quantity = of_quantity.larger(size);
            let (Built { length, force, .. }, [velocity, acceleration]) = (&mut sizes.largest, &mut sizes.of_points);
            let largest = match channel.kind.unit {
                Unit::Metre => length,
                Unit::Newton => force,
                Unit::MetrePerSecond => velocity,
                Unit::MetrePerSecondSquared => acceleration,
                Unit::Radian | Unit::RadianPerSecond | Unit::RadianPerSecondSquared | Unit::NewtonMetre => continue,
            };
            *largest = largest.larger(size);
        }
        sizes
    }

    /// For each kind of size, the larger of the values in `self` and `other`.
    fn with(mut self, other: &Sizes) -> Self {
        for (quantity, size) in &other.of_quantity {
            let own = self.of_quantity.entry(quantity).or_insert(0.0);
            *own = own.larger(*size);
        }
        self.largest.length = self.largest.length.larger(other.largest.length);
        self.largest.force = self.largest.force.larger(other.largest.force);
        self.of_points = [0, 1].map(|order| self.of_points[order].larger(other.of_points[order]));
        self
    }

    /// Size of the numbers from which a channel is computed.
    /// The force on the frame is the sum of the joint forces. The joint forces may cancel, but their rounding errors
    /// remain.
    fn rounded_with(&self, channel: &Channel) -> f64 {
        let own = self.natural(channel, 1.0);
        if channel.kind.unit == Unit::Newton { own.larger(self.largest.force) } else { own }
    }

    /// Size of an angular rate in a mechanism in which no link turns: the rates of points divided by the largest
    /// coordinate. Zero for other channels, and if a link turns.
    fn of_translation(&self, channel: &Channel) -> f64 {
        let order = match channel.kind.unit {
            Unit::RadianPerSecond => 0,
            Unit::RadianPerSecondSquared => 1,
            Unit::Radian | Unit::Metre | Unit::MetrePerSecond | Unit::MetrePerSecondSquared => return 0.0,
            Unit::Newton | Unit::NewtonMetre => return 0.0,
        };
        let own = self.of_quantity.get(channel.kind.quantity).copied().unwrap_or(0.0);
        let size = share(self.of_points[order], self.largest.length);
        if size.is_finite() && own <= VANISHING * size { size } else { 0.0 }
    }

    /// The largest size of the channel's quantity.
    /// This size is at least the size that follows from the crank's speed, the crank's rotation `turn` (rad) and the
    /// sizes of coordinates and forces.
    fn natural(&self, channel: &Channel, turn: f64) -> f64 {
        let own = self.of_quantity.get(channel.kind.quantity).copied().unwrap_or(0.0);
        // The size of a force is its largest value. If this value is only rounding error, `largest` gives the size.
        // An example is the shaking force of a balanced mechanism: it is only the rounding error of the joint forces.
        match channel.kind.unit == Unit::Newton && !(own <= VANISHING * self.largest.force) {
            true => own.larger(0.0),
            false => own.larger(self.largest.of(channel.kind.unit, turn)),
        }
    }
}

/// `other` minus `reference`, channel by channel, for the channels that both trajectories have.
/// Angles that differ by a constant number of whole revolutions describe the same motion.
/// The whole revolutions between the first samples are therefore subtracted.
///
/// # Errors
/// If the grids differ.
pub fn difference(reference: &Trajectory, other: &Trajectory) -> Result<Trajectory> {
    if reference.times() != other.times() {
        return Err(Error::new(ErrorKind::Input, sentences::THE_TWO_TRAJECTORIES_STAND_ON_DIFFERENT)
            .help(sentences::COMPARE_ONLY_TRAJECTORIES_THAT_WERE_SOLVED));
    }
    let (mut channels, mut columns) = (Vec::new(), Vec::new());
    for (index, (channel, ours)) in reference.iter().enumerate() {
        let Some(theirs) = other.column_near(channel, index) else { continue };
        channels.push(channel.clone());
        columns.push(differences(ours, theirs, channel.kind.periodic));
    }
    let all = Trajectory::new(reference.times().to_vec(), reference.inputs().to_vec(), channels, columns)?;
    Ok(all.of_input(reference.input()))
}

/// Residuals of all channels that both trajectories have, on the reference's scales.
///
/// # Errors
/// If the grids differ.
pub fn residuals(reference: &Trajectory, other: &Trajectory) -> Result<Vec<Residual>> {
    residuals_on(&scales(reference), reference, other)
}

/// Residuals of all channels that both trajectories have. `scales` holds one scale for each channel of the reference.
///
/// # Errors
/// If the grids differ.
pub fn residuals_on(scales: &[f64], reference: &Trajectory, other: &Trajectory) -> Result<Vec<Residual>> {
    let errors = difference(reference, other)?;
    let shared = reference.channels().iter().zip(scales).filter(|(channel, _)| other.column(channel).is_some());
    Ok(errors
        .iter()
        .zip(shared)
        .map(|((channel, values), (_, &scale))| of_values(channel, values, scale, &errors))
        .collect())
}

fn of_values(channel: &Channel, values: &[f64], scale: f64, errors: &Trajectory) -> Residual {
    let worst = (0..values.len()).max_by(|&a, &b| values[a].abs().total_cmp(&values[b].abs())).unwrap_or(0);
    let sorted = sorted_sizes(values);
    Residual {
        channel: channel.clone(),
        scale,
        max: sorted.last().copied().unwrap_or(0.0),
        rms: rms(values),
        q75: quantile(&sorted, 0.75),
        q99: quantile(&sorted, 0.99),
        worst_time: errors.times().get(worst).copied().unwrap_or(0.0),
        worst_crank: errors.inputs().get(worst).copied().unwrap_or(0.0),
        input: errors.input(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use linkage::math::statistics::largest_difference;
    use std::f64::consts::TAU;

    fn trajectory(rows: &[(&str, Vec<f64>)]) -> Trajectory {
        let n = rows[0].1.len();
        let times: Vec<f64> = (0..n).map(|k| k as f64).collect();
        let channels = rows.iter().map(|(name, _)| Channel::named(name).unwrap()).collect();
        Trajectory::new(times.clone(), times, channels, rows.iter().map(|(_, v)| v.clone()).collect()).unwrap()
    }

    #[test]
    fn constant_whole_turns_are_ignored_but_a_lost_turn_is_not() {
        let a = trajectory(&[("link.a.angle_rad", vec![0.0, 1.0, 2.0])]);
        let b = trajectory(&[("link.a.angle_rad", vec![TAU, 1.0 + TAU, 2.0])]);
        let residual = &residuals(&a, &b).unwrap()[0];
        assert!((residual.max - TAU).abs() < 1e-12);
        assert_eq!(residual.worst_time, 2.0);
    }

    #[test]
    fn a_nearly_constant_channel_takes_the_scale_of_its_family() {
        let a = trajectory(&[("joint.A.fx_N", vec![-500.0, 500.0]), ("joint.A.fy_N", vec![1.0, 1.0])]);
        assert_eq!(scales(&a), [500.0, 0.5]);
        // The scale of a constant force follows from its own value.
        let b = trajectory(&[("joint.A.fx_N", vec![-500.0, 500.0]), ("joint.A.fy_N", vec![30.0, 30.0])]);
        assert_eq!(scales(&b), [500.0, 3.0]);
    }

    #[test]
    fn the_magnitude_of_a_frame_force_is_that_of_its_summands() {
        let all = trajectory(&[("joint.A.fx_N", vec![2e9, -1e9]), ("frame.fx_N", vec![3.0, 4.0])]);
        assert_eq!(magnitudes(&all), [2e9, 2e9]);
        assert_eq!(magnitudes_by(&all, &[0, 0], &|_, _| true), [2e9, 2e9]);
        // The magnitudes of another set count for a channel only if the channel's set is computed from that set.
        assert_eq!(magnitudes_by(&all, &[0, 1], &|from, to| from == to), [2e9, 4.0]);
        assert_eq!(magnitudes_by(&all, &[0, 1], &|from, to| from <= to), [2e9, 2e9]);
        // The scale of the channel, however, is half the channel's own range.
        assert_eq!(scales(&all), [1.5e9, 0.5]);
        // If the channel's own range is only rounding, it does not determine the scale. An example is the shaking force
        // of a balanced mechanism.
        let balanced = trajectory(&[("joint.A.fx_N", vec![2e9, -1e9]), ("frame.fx_N", vec![0.0, 1e-7])]);
        assert_eq!(scales(&balanced), [1.5e9, 2e6]);
    }

    #[test]
    fn scales_of_a_single_instant_come_from_the_mechanism() {
        let a = trajectory(&[
            ("link.a.angle_rad", vec![0.3]),
            ("link.a.x_m", vec![-2.0]),
            ("point.P.y_m", vec![4.0]),
            ("link.a.omega_rad_s", vec![5.0]),
            ("link.b.omega_rad_s", vec![0.0]),
        ]);
        assert_eq!(scales(&a), [1.0, 3.0, 3.0, 5.0, 5.0]);
    }

    #[test]
    fn zero_channels_take_scales_from_the_crank_and_forces() {
        // In two seconds the crank rotates by 2 rad at one radian per second, so the half range of the crank angle is 1
        // rad.
        let a = trajectory(&[
            ("link.a.alpha_rad_s2", vec![0.0, 0.0, 0.0]),
            ("joint.A.fx_N", vec![-500.0, 500.0, 0.0]),
            ("link.a.x_m", vec![-2.0, 2.0, 0.0]),
            ("drive.torque_N_m", vec![0.0, 0.0, 0.0]),
        ]);
        assert_eq!(scales(&a), [0.1, 500.0, 2.0, 100.0]);
        assert_eq!(magnitudes(&a), [1.0, 500.0, 2.0, 1000.0]);
    }

    #[test]
    fn without_any_scale_nominal_values_of_the_case_are_used() {
        let still = Trajectory::new(
            vec![0.0, 1.0],
            vec![2.0; 2],
            ["link.a.angle_rad", "link.a.omega_rad_s", "point.P.ax_m_s2", "joint.A.fx_N", "drive.torque_N_m"]
                .map(|name| Channel::named(name).unwrap())
                .to_vec(),
            [1.0, 0.0, 1e-12, 0.0, 0.0].map(|value| vec![value; 2]).to_vec(),
        )
        .unwrap();
        let built = Built { length: 0.5, speed: 4.0, force: 30.0 };
        let found = scales_beyond(&[1e-10; 5], &still, &built);
        assert_eq!(found, [1e-3, 0.1 * 4.0, 0.1 * 16.0 * 0.5, 0.1 * 30.0, 0.1 * 15.0]);
        // Even a very small natural size remains unchanged if it is larger than the rounding error of the natural size
        // from the case's data.
        assert_eq!([3e-9, 4e-8, 1.0].map(|own| built.unless(own, Unit::Newton)), [30.0, 4e-8, 1.0]);
    }

    /// The crank rotates by 6 rad in 4 s, coordinates reach 3 m, and forces reach 500 N. The natural size of each
    /// quantity whose channels are all zero follows from this rotation, this time, and these coordinates and forces.
    #[test]
    fn sizes_of_zero_channels_follow_from_the_crank() {
        let names =
            ["link.a.angle_rad", "link.a.omega_rad_s", "link.a.alpha_rad_s2", "point.P.vx_m_s", "point.P.ax_m_s2"];
        let channel = |name: &str| Channel::named(name).unwrap();
        let sized = [("point.P.x_m", [-3.0, 3.0]), ("joint.A.fx_N", [-500.0, 500.0])];
        let channels = names.iter().map(|name| channel(name)).chain(sized.iter().map(|(name, _)| channel(name)));
        let moment = [channel("drive.torque_N_m")];
        let columns = vec![vec![0.0; 2]; names.len()].into_iter().chain(sized.map(|(_, values)| values.to_vec()));
        let all = Trajectory::new(
            vec![0.0, 4.0],
            vec![1.0, 7.0],
            channels.chain(moment).collect(),
            columns.chain([vec![0.0; 2]]).collect(),
        )
        .unwrap();
        let (turn, speed, length, force) = (3.0, 1.5, 3.0, 500.0);
        let natural = [turn, speed * turn, speed * speed * turn, speed * length, speed * speed * length];
        // The scale of an angle follows from its range, not from its value.
        let shares = [1e-3, 0.1, 0.1, 0.1, 0.1];
        let wanted = natural.iter().zip(shares).map(|(size, share)| share * size);
        let wanted = wanted.chain([length, force, 0.1 * force * length]);
        for (own, wanted) in scales(&all).iter().zip(wanted) {
            approx::assert_relative_eq!(*own, wanted, max_relative = 1e-14);
        }
    }

    #[test]
    fn channels_that_only_one_side_has_are_left_out() {
        let a = trajectory(&[("joint.A.fx_N", vec![0.0, 2.0]), ("joint.B.fx_N", vec![0.0, 2.0])]);
        let b = trajectory(&[("joint.B.fx_N", vec![0.5, 2.0])]);
        let found = residuals(&a, &b).unwrap();
        assert_eq!(found.len(), 1);
        assert_eq!((found[0].max, found[0].q75, found[0].scale), (0.5, 0.375, 1.0));
        assert_eq!(found[0].share(), 0.5);
    }

    #[test]
    fn a_residual_has_its_instant_and_statistics() {
        let own = |values: [f64; 5]| {
            let channels = vec![Channel::named("joint.A.fx_N").unwrap()];
            let (times, cranks) = (vec![0.0, 0.1, 0.2, 0.3, 0.4], vec![5.0, 6.0, 7.0, 8.0, 9.0]);
            Trajectory::new(times, cranks, channels, vec![values.to_vec()]).unwrap()
        };
        let found = &residuals(&own([0.0; 5]), &own([1.0, -7.0, 2.0, 3.0, 5.0])).unwrap()[0];
        assert_eq!((found.max, found.worst_time, found.worst_crank), (7.0, 0.1, 6.0));
        // The values are 1, 2, 3, 5 and 7. `q75` is the fourth of these values; the mean square is (1 + 49 + 4 + 9 +
        // 25) / 5.
        assert_eq!((found.q75, found.rms), (5.0, 17.6f64.sqrt()));
        assert!((found.q99 - 6.92).abs() < 1e-12, "{}", found.q99);
    }

    #[test]
    fn a_zero_residual_without_scale_has_share_zero() {
        let still = trajectory(&[("joint.A.fx_N", vec![0.0, 0.0])]);
        let found = residuals(&still, &still).unwrap();
        assert_eq!((found[0].scale, found[0].share()), (0.0, 0.0));
    }

    #[test]
    fn differences_are_other_minus_reference_and_keep_nan() {
        let a = trajectory(&[("joint.A.fx_N", vec![1.0, 2.0])]);
        let b = trajectory(&[("joint.A.fx_N", vec![1.5, 1.0])]);
        assert_eq!(difference(&a, &b).unwrap().iter().next().unwrap().1, [0.5, -1.0]);
        for place in 0..3 {
            let mut values = [3.0, 2.0, 1.0];
            values[place] = f64::NAN;
            assert!(largest_difference(&[0.0; 3], &values, false).is_nan(), "{place}");
        }
    }

    #[test]
    fn different_grids_are_refused() {
        let a = trajectory(&[("joint.A.fx_N", vec![0.0, 2.0])]);
        let b = trajectory(&[("joint.A.fx_N", vec![0.0, 2.0, 3.0])]);
        assert!(residuals(&a, &b).is_err());
    }
}
