//! Values that result from right values by a wrong rule: numerical derivatives, accelerations without the Coriolis
//! term, moments about another point.

use super::cause::{Arm, DataSlip, Over};
use super::question::{DiagnosisInput, Found, Rank};
use super::slips::Wrong;
use linkage::math::{KeepNan, largest_size};
use linkage::trajectory::{Channel, OfFrame, OfSlider, Reading, Trajectory, Unit};

/// Relative rounding error of a number. Differences magnify it.
const ROUNDED: f64 = 1e-12;
/// Values count as differences between rows only if the errors of these differences are at most this fraction of the
/// largest error of the values.
const BLURRED: f64 = 0.1;
/// A central difference uses two rows at equal distances before and after a row. This number is the largest distance
/// (rows).
const WIDEST: usize = 3;

/// All errors of calculation that explain channels (such as a missing Coriolis term), each with the explained channels.
pub(super) fn found(question: &DiagnosisInput, wrong: &[Wrong]) -> Vec<Found> {
    let mut causes = Vec::new();
    let mut put =
        |slip: DataSlip, rank: Rank, explained: Vec<Channel>| causes.push(Found::of_values(slip, rank, explained));
    let either = (1..=WIDEST).map(Over::Either);
    for over in either.chain([Over::Before, Over::Behind]) {
        let ruled: Vec<(&Wrong, (Channel, usize))> =
            wrong.iter().filter_map(|one| Some((one, differences(question, one, over)?))).collect();
        if let Some((_, (of, order))) = ruled.first().cloned() {
            let explained = ruled.iter().map(|(one, _)| one.channel.clone()).collect();
            put(DataSlip::Differences { of, order, over }, Rank::Change, explained);
        }
    }
    for joint in question.case.mechanism.joints() {
        let own = wrong.iter().filter(|one| lacks_coriolis(question, one, &joint.name) == Some(true));
        let explained: Vec<Channel> = own.map(|one| one.channel.clone()).collect();
        if !explained.is_empty() {
            put(DataSlip::NoCoriolis(joint.name.clone()), Rank::Change, explained);
        }
    }
    for one in wrong {
        if let Some(arm) = arm(question, one) {
            let rank = if matches!(arm, Arm::Constant(_)) { Rank::Fitted } else { Rank::Change };
            put(DataSlip::About(arm), rank, vec![one.channel.clone()]);
        }
    }
    causes
}

/// Finds the channel from which the values of `one` were obtained as differences between rows, and the order of the
/// derivative. Rows at the ends are left out: these rows have no neighbours on one side, and programs treat such rows
/// in different ways.
fn differences(question: &DiagnosisInput, one: &Wrong, over: Over) -> Option<(Channel, usize)> {
    let step = even(one.times)?;
    let (count, margin) = (one.times.len(), if let Over::Either(rows) = over { rows } else { 1 });
    let inner = margin..count.checked_sub(margin)?;
    if inner.len() < 2 * WIDEST {
        return None;
    }
    let largest = largest_size(&one.right.iter().zip(one.found).map(|(a, b)| a - b).collect::<Vec<f64>>());
    let of_column = |values: &[f64], order: usize, blur: f64| {
        let span = step * margin as f64;
        let rate = |row: usize| match (over, order) {
            (Over::Either(rows), 1) => (values[row + rows] - values[row - rows]) / (2.0 * span),
            (Over::Either(rows), _) => (values[row + rows] - 2.0 * values[row] + values[row - rows]) / (span * span),
            (Over::Before, _) => (values[row] - values[row - 1]) / step,
            (Over::Behind, _) => (values[row + 1] - values[row]) / step,
        };
        let known = one.bound + (ROUNDED * largest_size(values) + blur) / span.powi(order as i32);
        known <= BLURRED * largest
            && one.varies(&inner.clone().map(rate).collect::<Vec<f64>>())
            && inner.clone().all(|row| (rate(row) - one.found[row]).abs() <= known)
    };
    let orders = if matches!(over, Over::Either(_)) { 1..=2 } else { 1..=1 };
    for order in orders {
        for (channel, values) in question.reference.iter() {
            let rate = channel.rate();
            let rate = if order == 1 { rate } else { rate.and_then(|rate| rate.rate()) };
            // Takes differences of the reference's values, and also of the suspect's values if the suspect's channel
            // agrees. Differences of wrong positions are not tried, because rates that match wrong positions are not a
            // separate slip.
            let judged = question.judged.iter().find(|judged| judged.channel == *channel);
            let own = question.suspicious.column(channel).filter(|_| judged.is_some_and(|judged| !judged.disagrees));
            // The suspect differentiated numbers with all digits, at instants with all digits.
            let blur = judged.map_or(0.0, |judged| 4.0 * judged.bound);
            let is_it = || own.into_iter().chain([values]).any(|own| of_column(own, order, blur));
            if rate.as_ref() == Some(one.channel) && is_it() {
                return Some((channel.clone(), order));
            }
        }
    }
    None
}

/// The time between rows (s), if it is constant.
pub(crate) fn even(times: &[f64]) -> Option<f64> {
    let (first, last) = (times.first()?, times.last()?);
    let step = (last - first) / (times.len() - 1) as f64;
    let is_even = times.windows(2).all(|pair| (pair[1] - pair[0] - step).abs() <= 1e-6 * step);
    (step > 0.0 && is_even).then_some(step)
}

/// Whether the Coriolis term is missing in an acceleration: twice the guide's angular velocity times the block's speed
/// on the guide.
fn lacks_coriolis(question: &DiagnosisInput, one: &Wrong, joint: &str) -> Option<bool> {
    let mechanism = &question.case.mechanism;
    let joint = mechanism.joints().iter().find(|own| own.name == joint)?;
    let link = &mechanism.links()[joint.first.link].name;
    let axis = joint.axis_on(joint.first.link)?;
    let column = |name: &str| question.reference.named(name);
    let [angle, omega] = ["angle_rad", "omega_rad_s"].map(|suffix| column(&format!("link.{link}.{suffix}")));
    let [slide, speed] = ["slide_m", "slide_speed_m_s"].map(|suffix| column(&format!("joint.{}.{suffix}", joint.name)));
    let (angle, omega, speed) = (angle?, omega?, speed?);
    let (suffix, local) = (one.channel.kind.suffix, axis.y.atan2(axis.x));
    let term = |row: usize| {
        let size = 2.0 * omega[row] * speed[row];
        match (one.channel.kind.unit, slide) {
            (Unit::MetrePerSecondSquared, _) if suffix.starts_with("ax") => -size * (angle[row] + local).sin(),
            (Unit::MetrePerSecondSquared, _) if suffix.starts_with("ay") => size * (angle[row] + local).cos(),
            // The Coriolis term as an angular acceleration of the guide: divided by the block's position on the guide.
            (Unit::RadianPerSecondSquared, Some(slide)) => -size / slide[row],
            _ => 0.0,
        }
    };
    let values: Vec<f64> = (0..one.right.len()).map(|row| one.right[row] - term(row)).collect();
    let changes = (0..values.len()).any(|row| !(term(row).abs() <= one.bound));
    Some(changes && one.has_values_of(&values))
}

/// Vector from the right point of reference of a moment to the wrong point of reference.
fn arm(question: &DiagnosisInput, one: &Wrong) -> Option<Arm> {
    let reading = one.channel.kind.reading;
    if !matches!(reading, Reading::Slider(OfSlider::Moment) | Reading::Frame(OfFrame::Moment)) {
        return None;
    }
    let subject = one.channel.subject();
    let column = |suffix: &str| question.reference.named(&format!("{subject}.{suffix}"));
    let (x, y) = (column("fx_N")?, column("fy_N")?);
    // Moment about a second point: the moment about the first point minus the cross product of arm and force.
    let gaps: Vec<f64> = one.right.iter().zip(one.found).map(|(right, found)| right - found).collect();
    let is_it = |arm: &dyn Fn(usize) -> [f64; 2]| {
        let moment = |row: usize| arm(row)[0] * y[row] - arm(row)[1] * x[row];
        (0..gaps.len()).all(|row| (gaps[row] - moment(row)).abs() <= one.bound)
    };
    let places = places(question.reference);
    for (name, [at_x, at_y]) in &places {
        if is_it(&|row| [at_x[row], at_y[row]]) {
            return Some(Arm::Between(None, (*name).to_string()));
        }
        let other = places
            .iter()
            .find(|(_, [from_x, from_y])| is_it(&|row| [at_x[row] - from_x[row], at_y[row] - from_y[row]]));
        if let Some((from, _)) = other {
            return Some(Arm::Between(Some((*from).to_string()), (*name).to_string()));
        }
    }
    // Fits a constant arm by least squares.
    let sum = |of: &dyn Fn(usize) -> f64| (0..gaps.len()).map(of).sum::<f64>();
    let (xx, xy, yy) = (sum(&|row| x[row] * x[row]), sum(&|row| x[row] * y[row]), sum(&|row| y[row] * y[row]));
    let (of_x, of_y) = (sum(&|row| -x[row] * gaps[row]), sum(&|row| y[row] * gaps[row]));
    let determinant = xx * yy - xy * xy;
    let arm = [(of_y * xx + xy * of_x) / determinant, (of_x * yy + xy * of_y) / determinant];
    let is_known = determinant > 1e-9 * xx.larger(yy).powi(2) && gaps.len() > 2 * WIDEST;
    (is_known && is_it(&|_| arm)).then_some(Arm::Constant(arm))
}

/// All points with coordinates in a trajectory, by name.
fn places(of: &Trajectory) -> Vec<(String, [&[f64]; 2])> {
    let subjects = of.channels().iter().filter(|channel| channel.kind.suffix == "x_m").map(Channel::subject);
    let named = subjects.filter_map(|subject| {
        let [x, y] = ["x_m", "y_m"].map(|suffix| of.named(&format!("{subject}.{suffix}")));
        Some((subject, [x?, y?]))
    });
    named.collect()
}
