//! The values that a side found, with their errors.

use crate::sentences;
use formula::{Function, Operator, Rounded};
use linkage::case::Case;
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::KeepNan;
use linkage::trajectory::{Channel, OfJoint, OfLink, OfPoint, Reading, Trajectory};
use scenario::{Claim, Formula, MechanismFigure, PrintedChannel};

/// Columns of a trajectory, each with a sign. Their signed sum is the input, or one of its derivatives.
type InputColumns = Vec<(usize, f64)>;

/// A side's trajectory with the error of every value, by column and row (SI units).
#[derive(Clone)]
#[must_use]
pub struct KnownTrajectory<'a> {
    pub(super) trajectory: &'a Trajectory,
    error: &'a dyn Fn(usize, usize) -> f64,
    crank_name: &'a str,
    /// Columns whose signed sums are the rate and the acceleration of the input. `None` if a column is missing.
    crank: [Option<InputColumns>; 2],
    /// If forces determine the motion: columns whose signed sum is the input, which then has an integration error.
    /// `None` in a prescribed motion, and if a column is missing.
    angle: Option<InputColumns>,
    /// Figures of the whole mechanism, such as its mean reduced moment of inertia, in SI units.
    figures: &'a [(MechanismFigure, Rounded)],
    /// Smallest error assumed for every channel, in its SI unit; empty for no lower limit.
    least: &'a [f64],
}

/// One column, converted to the unit of a claim.
pub(super) struct Column<'a> {
    values: &'a [f64],
    error: Box<dyn Fn(usize) -> f64 + 'a>,
    /// The other component of the vector, if the claim is a magnitude.
    across: Option<Box<Column<'a>>>,
    /// Size of the claim's unit in the SI unit.
    factor: f64,
}

impl Column<'_> {
    pub(super) fn at(&self, row: usize) -> Rounded {
        let own = Rounded { value: self.values[row], error: (self.error)(row) };
        let si = match &self.across {
            None => own,
            Some(across) => {
                let square = |number| Rounded::pair(Operator::Times, number, number);
                let sum = Rounded::pair(Operator::Plus, square(own), square(across.at(row)));
                Rounded::call(Function::Sqrt, [sum, sum])
            }
        };
        match self.factor {
            1.0 => si,
            factor => Rounded::pair(Operator::Over, si, Rounded::nearly(factor)),
        }
    }
}

/// Returns the channels that are needed to judge a claim on a case, derivatives included.
#[must_use]
pub fn needed(claim: &Claim, case: &Case) -> Vec<Channel> {
    let mut all: Vec<Channel> = case.input_channels().into_iter().flatten().map(|(channel, _)| channel).collect();
    for (_, channel) in &claim.channels {
        all.extend(across(channel));
        let mut next = Some(channel.channel.clone());
        while let Some(channel) = next {
            next = channel.rate();
            all.push(channel);
        }
    }
    all
}

/// Returns the channels among which a diagnosis may find a missing term: angles of links, positions of mass centres and
/// points, and the first and second time derivatives of both.
/// Also returns every channel with the unit of a claim, because the author of the formula may have meant that channel.
#[must_use]
pub fn telling<'a>(case: &Case, claims: impl Iterator<Item = &'a Claim>) -> Vec<Channel> {
    let claimed: Vec<_> =
        claims.flat_map(|claim| claim.channels.iter().map(|(_, channel)| channel.channel.kind.unit)).collect();
    let is_motion = |channel: &Channel| matches!(channel.kind.reading, Reading::Link(_) | Reading::Point(_));
    let of = |channel: &Channel| is_motion(channel) || claimed.contains(&channel.kind.unit);
    case.all_channels().into_iter().filter(of).collect()
}

/// Returns the other component of a vector whose magnitude is claimed.
fn across(channel: &PrintedChannel) -> Option<Channel> {
    let is_other = |kind: &&'static linkage::trajectory::ChannelKind| kind.reading == Reading::Joint(OfJoint::ForceY);
    let kind = channel.magnitude.then(|| linkage::trajectory::CHANNELS.iter().find(is_other)).flatten()?;
    Some(Channel { of: channel.channel.of.clone(), kind })
}

impl<'a> KnownTrajectory<'a> {
    /// The trajectory of a case, together with the errors of its values. `error` returns the error of a value by column
    /// and row (SI units).
    pub fn new(case: &'a Case, trajectory: &'a Trajectory, error: &'a dyn Fn(usize, usize) -> f64) -> Self {
        let crank = &case.mechanism.links()[case.crank().link].name;
        let channels = trajectory.channels();
        let [coordinate, rate, second] = case.input_channels().map(|all| -> Option<InputColumns> {
            let column =
                |(channel, sign): &(Channel, f64)| Some((channels.iter().position(|own| own == channel)?, *sign));
            all.iter().map(column).collect()
        });
        let angle = case.is_free().then_some(coordinate).flatten();
        KnownTrajectory { trajectory, error, crank_name: crank, crank: [rate, second], angle, figures: &[], least: &[] }
    }

    /// Adds values of the whole mechanism, in SI units.
    pub fn with_figures(self, figures: &'a [(MechanismFigure, Rounded)]) -> Self {
        KnownTrajectory { figures, ..self }
    }

    /// Sets the smallest error assumed for every channel, in its SI unit.
    pub fn known_at_least(&'a self, least: &'a [f64]) -> Self {
        KnownTrajectory { least, ..self.clone() }
    }

    pub(super) fn len(&self) -> usize {
        self.trajectory.times().len()
    }

    /// Rows at which a formula is claimed to hold.
    pub(super) fn rows(&self, formula: &Formula) -> Vec<usize> {
        (0..self.len()).filter(|&row| formula.holds_at(self.trajectory.inputs()[row])).collect()
    }

    /// Names of the links other than the crank, each with the columns of the link's angle (rad), angular velocity and
    /// angular acceleration. Links without these three columns are left out.
    pub(super) fn links(&self) -> impl Iterator<Item = (&str, [&[f64]; 3])> {
        let channels = self.trajectory.channels();
        let column = |channel: &Channel| {
            let index = channels.iter().position(|own| own == channel)?;
            self.trajectory.column_near(channel, index)
        };
        channels.iter().filter_map(move |angle| {
            let is_angle = angle.kind.reading == Reading::Link(OfLink::Angle) && angle.of != self.crank_name;
            let omega = angle.rate().filter(|_| is_angle)?;
            let alpha = omega.rate()?;
            Some((angle.of.as_str(), [column(angle)?, column(&omega)?, column(&alpha)?]))
        })
    }

    /// All channels with their columns.
    pub(super) fn columns(&self) -> impl Iterator<Item = (&Channel, &[f64])> {
        let all = self.trajectory.channels().iter().enumerate();
        all.filter_map(|(index, own)| Some((own, self.trajectory.column_near(own, index)?)))
    }

    /// Channels and columns of velocities and accelerations of points and mass centres.
    pub(super) fn points(&self) -> impl Iterator<Item = (&Channel, &[f64])> {
        self.columns().filter(|(channel, _)| {
            let (Reading::Point(of) | Reading::Link(OfLink::Centre(of))) = channel.kind.reading else { return false };
            !matches!(of, OfPoint::X | OfPoint::Y)
        })
    }

    /// Input values of the formulas at an instant: the input itself (crank angle or slide), the time, and the
    /// input's rate and acceleration.
    pub(super) fn inputs(&self, row: usize) -> [Rounded; 4] {
        let of = |columns: &Option<InputColumns>| {
            let mut sum = Rounded::exact(0.0);
            for &(column, sign) in columns.as_ref()? {
                let value = self.trajectory.column_near(&self.trajectory.channels()[column], column)?[row];
                sum.value += sign * value;
                sum.error += (self.error)(column, row);
            }
            Some(sum)
        };
        let [omega, alpha] = self.crank.each_ref().map(|columns| of(columns).unwrap_or(Rounded::exact(f64::NAN)));
        [self.crank(row), Rounded::nearly(self.trajectory.times()[row]), omega, alpha]
    }

    /// Value of the input at an instant (rad or m, in the scenario's convention).
    pub fn crank(&self, row: usize) -> Rounded {
        let mut phi = Rounded::nearly(self.trajectory.inputs()[row]);
        let columns = self.angle.iter().flatten();
        phi.error += columns.map(|&(column, _)| (self.error)(column, row)).sum::<f64>();
        phi
    }

    /// Number of derivatives of a claim for which the side has channels. Values of the whole mechanism have no
    /// derivatives.
    ///
    /// # Errors
    /// If a channel or value of the claim itself is missing.
    pub(super) fn orders(&self, claim: &Claim) -> Result<usize> {
        self.channels(claim, 0)?;
        self.figures(claim)?;
        if claim.channels.is_empty() {
            return Ok(0);
        }
        let own = (1..=2).take_while(|&order| self.channels(claim, order).is_ok()).count();
        Ok(own.min(self.crank.iter().take_while(|column| column.is_some()).count()))
    }

    /// Values of the whole mechanism that a claim uses.
    pub(super) fn figures(&self, claim: &Claim) -> Result<Vec<Rounded>> {
        let of = |(name, figure): &(String, MechanismFigure)| {
            let found = self.figures.iter().find(|(own, _)| own == figure);
            found.map(|(_, number)| *number).ok_or_else(|| missing(name))
        };
        claim.figures.iter().map(of).collect()
    }

    /// Columns of a claim's channels, then the columns of the derivatives of these channels up to the order `orders`.
    pub(super) fn channels(&self, claim: &Claim, orders: usize) -> Result<Vec<Column<'_>>> {
        let mut all = Vec::with_capacity(claim.channels.len() * (orders + 1));
        let mut present: Vec<(Channel, &PrintedChannel)> =
            claim.channels.iter().map(|(_, printed)| (printed.channel.clone(), printed)).collect();
        for order in 0..=orders {
            for (channel, printed) in &mut present {
                if order > 0 {
                    *channel = channel.rate().filter(|_| !printed.magnitude).ok_or_else(|| missing(channel))?;
                }
                all.push(self.column(channel, printed)?);
            }
        }
        Ok(all)
    }

    fn column(&self, channel: &Channel, printed: &PrintedChannel) -> Result<Column<'_>> {
        let index = self.trajectory.channels().iter().position(|own| own == channel);
        let index = index.ok_or_else(|| missing(channel))?;
        let values = self.trajectory.column_near(channel, index).ok_or_else(|| missing(channel))?;
        let across = match across(printed) {
            Some(other) => Some(Box::new(self.column(&other, &PrintedChannel::plain(other.clone()))?)),
            None => None,
        };
        let (error, least) = (self.error, self.least.get(index).copied().unwrap_or(0.0));
        Ok(Column {
            values,
            error: Box::new(move |row| error(index, row).larger(least)),
            across,
            factor: printed.to_si(1.0),
        })
    }
}

fn missing(what: &dyn std::fmt::Display) -> Error {
    Error::new(ErrorKind::Input, sentences::was_not_asked_for(&what))
}

#[cfg(test)]
mod tests {
    use super::*;
    use fixtures::of_repository;
    use linkage::solver::Solver;

    /// The error of a value is the error at the instant, but at least the channel's smallest error in the unit of the
    /// claim.
    #[test]
    fn the_error_of_a_channel_is_at_least_its_limit() {
        let case = of_repository("scenarios/crank_rocker.toml").case;
        let claim = Claim::parse("link.rocker.angle_deg", &case).unwrap();
        let trajectory = analytic::AssurSolver.solve(&case).unwrap();
        let is_own = |channel: &Channel| *channel == claim.channels[0].1.channel;
        let error = |_: usize, row: usize| if row == 7 { 1e-3 } else { 1e-9 };
        let course = KnownTrajectory::new(&case, &trajectory, &error);
        let least: Vec<f64> =
            trajectory.channels().iter().map(|channel| if is_own(channel) { 1e-5 } else { 1.0 }).collect();
        for (course, usual) in [(course.known_at_least(&least), 1e-5), (course.known_at_least(&[]), 1e-9)] {
            for (row, found) in course.values(&claim).unwrap().into_iter().enumerate() {
                let wanted = if row == 7 { 1e-3f64 } else { usual }.to_degrees();
                assert!((found.error / wanted - 1.0).abs() < 1e-3, "{row}: {} {wanted}", found.error);
            }
        }
    }

    /// The magnitude is the root of the sum of squares of both components. The error follows from the errors of both
    /// components.
    #[test]
    fn a_magnitude_has_the_errors_of_its_components() {
        let case = of_repository("scenarios/crank_rocker.toml").case;
        let claim = Claim::parse("joint.A.f_N", &case).unwrap();
        let trajectory = analytic::AssurSolver.solve(&case).unwrap();
        let [x, y] = ["joint.A.fx_N", "joint.A.fy_N"].map(|name| trajectory.named(name).unwrap());
        let is_y = |channel: &Channel| channel.to_string() == "joint.A.fy_N";
        let y_alone = |column: usize, _: usize| if is_y(&trajectory.channels()[column]) { 1e-6 } else { 0.0 };
        let course = KnownTrajectory::new(&case, &trajectory, &y_alone);
        for (row, found) in course.values(&claim).unwrap().into_iter().enumerate() {
            let size = x[row].hypot(y[row]);
            assert!((found.value / size - 1.0).abs() < 1e-14, "{row}: {} {size}", found.value);
            let error = 1e-6 * y[row].abs() / size;
            assert!((error..2.0 * error + 1e-9).contains(&found.error), "{row}: {} {error}", found.error);
        }
    }
}
