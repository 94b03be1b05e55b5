//! Everything except reactions that acts on the mechanism, row by row: loads, springs and dampers, drives, weights.

use crate::sentences;
use serde_json::{Value, json};

use super::data::{pair, side};
use super::markup::column;
use super::placed::Placed;
use crate::report::pretty::list;
use drawing::{Sketch, acting, tensions, weights};
use linkage::case::{Case, Seat};
use linkage::drive::{Load, Senses};
use linkage::mechanism::{GROUND, JointSide, LinkId, Mechanism};
use linkage::trajectory::{Channel, Trajectory};

/// Approximate number of single-precision values in a row.
pub(super) fn width(case: &Case) -> usize {
    2 * case.loads.len()
}

/// Everything that acts on the mechanism, for the script of a page.
/// Loads that depend on velocities are omitted if the velocities are unknown.
pub(super) fn of(case: &Case, sketch: &Sketch, placed: &Placed, rows: &[usize], reference: &Trajectory) -> Value {
    let is_known = |load: &Load| {
        let nature = load.nature();
        placed.knows(false) || (nature.senses == Senses::Nothing && !nature.is_viscous)
    };
    let states: Vec<_> = rows.iter().map(|&row| placed.state(case, row)).collect();
    let acting: Vec<_> = states.iter().map(|state| acting(case, sketch, &state.motions, &state.angles)).collect();
    let tensions: Vec<_> = states.iter().map(|state| tensions(case, &state.motions, &state.angles)).collect();
    let mechanism = &case.mechanism;
    let arrows = sketch.loads.iter().enumerate().filter(|(_, sign)| is_known(&case.loads[sign.load]));
    let arrows = list(arrows, |(index, sign)| {
        let columns = [0, 1].map(|axis| column(acting.iter().map(|own| own[index].force[axis])));
        let moment = column(acting.iter().map(|own| own[index].moment));
        let is_moment = columns.iter().all(|own| *own == 0.0);
        json!({
            "name": name(mechanism, &case.loads[sign.load]), "on": side(sign.at),
            "force": if is_moment { Value::Null } else { json!(columns) },
            "moment": if moment == 0.0 && !is_moment { Value::Null } else { moment },
        })
    });
    let count = tensions.first().map_or(0, Vec::len);
    let between = list((0..count).filter(|&index| is_known(&case.loads[tensions[0][index].load])), |index| {
        let load = &case.loads[tensions[0][index].load];
        let size = column(tensions.iter().map(|own| own[index].size));
        let ends = sketch.stretched.iter().find(|own| own.load == tensions[0][index].load);
        json!({ "name": name(mechanism, load), "size": size, "ends": ends.map(|own| own.ends.map(side)) })
    });
    let seats = case.seats();
    let drives = case.drives.with_moment().filter_map(|(number, drive)| {
        let joint = &mechanism.joints()[drive.joint];
        let is_its_moment = |channel: &Channel| seats.of(channel) == Some(Seat::Drive(number));
        // A drive is left out if the channels do not include its moment.
        let torque = reference.channels().iter().position(is_its_moment)?;
        let what = if drive.is_free() { sentences::MOMENT_OF_THE_MOTOR } else { "balancing moment" };
        let at = JointSide { link: drive.link, local: joint.on(drive.link).expect("a drive's joint is on its link") };
        let name = format!("{what} on {}", mechanism.links()[drive.link].name);
        Some(json!({ "name": name, "on": side(at), "torque": torque }))
    });
    let weights = list(weights(case), |own| {
        let name = sentences::weight_of(&mechanism.links()[own.at.link].name);
        json!({ "name": name, "on": side(own.at), "force": pair(own.force) })
    });
    json!({
        "arrows": arrows, "between": between, "drives": drives.collect::<Value>(), "weights": weights,
        "gravity": pair(case.gravity),
    })
}

/// A load in words, with its links and points.
fn name(mechanism: &Mechanism, load: &Load) -> String {
    let link = |link: LinkId| mechanism.links()[link].name.as_str();
    let sort = load.sort().replace('_', " ");
    let (points, links) = (load.points(), load.links());
    match (points.as_slice(), links.as_slice()) {
        ([at], _) => match point(mechanism, *at) {
            Some(point) => sentences::at_on(&sort, &point, &link(at.link)),
            None => format!("{sort} on {}", link(at.link)),
        },
        (&[start, end], _) => {
            let [start, end] = [start, end].map(|end| match (point(mechanism, end), end.link) {
                (Some(point), GROUND) => point.to_string(),
                (Some(point), on) => format!("{point} on {}", link(on)),
                (None, on) => link(on).to_string(),
            });
            sentences::from_to(&sort, &start, &end)
        }
        (_, &[first, second]) => sentences::between_and(&sort, &link(first), &link(second)),
        (_, on) => format!("{sort} on {}", link(on[0])),
    }
}

/// Name of the point or joint that lies at this position on a link.
fn point(mechanism: &Mechanism, at: JointSide) -> Option<&str> {
    let points = mechanism.links()[at.link].points.iter();
    let named = points.filter(|own| own.local == at.local).map(|own| own.name.as_str()).next();
    let joints = mechanism.joints().iter();
    named.or_else(|| joints.filter(|own| own.on(at.link) == Some(at.local)).map(|own| own.name.as_str()).next())
}
