//! Data for the script of a page: columns of all channels, errors, bounds, and moving parts.

use serde_json::{Map, Value, json};

use super::markup::{doubles, singles};
use super::thinned::{Errors, Thinned, is_wide};
use crate::plain::Tell;
use crate::report::pretty::list;
use drawing::{Lettering, MarkShape, Sketch};
use linkage::math::Vec2;
use linkage::mechanism::JointSide;
use linkage::trajectory::{Channel, Trajectory};
use prover::run::{ChannelProof, EngineProof, Proof};

/// Instants, channels, errors and bounds, as one object.
pub(super) fn of(proof: &Proof, errors: &[Errors], thinned: &Thinned, tell: Tell) -> Map<String, Value> {
    let reference = &proof.reference_trajectory;
    let at = |values: &[f64]| doubles(thinned.rows.iter().map(|&row| values[row]));
    let channels = reference.iter().map(|(own, values)| channel(own, values, &thinned.rows));
    let engines = proof.engines.iter().zip(errors).map(|(own, errors)| engine(own, reference, errors, thinned, tell));
    Map::from_iter([
        ("reference".to_string(), proof.reference.into()),
        ("instants".into(), thinned.all.into()),
        ("time".into(), at(reference.times()).into()),
        ("crank".into(), at(reference.inputs()).into()),
        ("channels".into(), channels.collect()),
        ("engines".into(), engines.collect()),
    ])
}

fn channel(channel: &Channel, values: &[f64], rows: &[usize]) -> Value {
    let values = rows.iter().map(|&row| values[row]);
    let is_wide = is_wide(channel);
    json!({
        "name": channel.to_string(), "unit": channel.kind.unit.symbol(), "quantity": channel.kind.quantity,
        "wide": is_wide, "values": if is_wide { doubles(values) } else { singles(values) },
    })
}

fn engine(proof: &EngineProof, reference: &Trajectory, errors: &Errors, thinned: &Thinned, tell: Tell) -> Value {
    let judged = |channel: &Channel| proof.channels.iter().find(|own| own.residual.channel == *channel);
    let channels = list(reference.channels().iter().zip(errors), |(channel, errors)| {
        let mut value = judged(channel).map_or_else(|| json!({}), |own| judgement(own, tell));
        if let Some(errors) = errors {
            value["errors"] = singles(thinned.rows.iter().map(|&row| errors[row])).into();
        }
        value
    });
    let doubt = thinned.rows.iter().enumerate().filter(|(_, row)| proof.kept.get(**row) == Some(&false));
    json!({
        "name": proof.info.name, "version": proof.info.version, "channels": channels,
        "unjudged": list(doubt, |(place, _)| place.into()),
    })
}

fn judgement(own: &ChannelProof, tell: Tell) -> Value {
    let residual = &own.residual;
    let reason = own.verdict.reason(tell);
    json!({
        "max": residual.max, "bound": own.bound, "scale": residual.scale, "order": own.convergence.observed,
        "verdict": own.verdict.word(), "reason": reason, "at": residual.worst_time, "left_out": own.left_out,
    })
}

/// The moving parts. Positions on links are in m, widths and the view in picture units.
/// A column is given by its index among the channels.
pub(super) fn motion(proof: &Proof, sketch: &Sketch, view: [f64; 4]) -> Value {
    let (mechanism, unit) = (&proof.scene.case.mechanism, sketch.unit);
    let channels = proof.reference_trajectory.channels();
    let column = |name: String| channels.iter().position(|own| own.to_string() == name);
    let columns = |word: &str, name: &str, suffixes: &[&str]| -> Option<Vec<usize>> {
        suffixes.iter().map(|suffix| column(format!("{word}.{name}.{suffix}"))).collect()
    };
    let links = list(mechanism.links().iter().skip(1), |link| {
        json!({
            "name": link.name, "centre": pair(link.mass_centre),
            "at": columns("link", &link.name, &["angle_rad", "x_m", "y_m"]),
            "rates": columns("link", &link.name, &["omega_rad_s", "vx_m_s", "vy_m_s"]),
            "points": list(&link.points, |point| json!([point.name, point.local.x, point.local.y])),
        })
    });
    let points = list(mechanism.moving_points(), |(name, own)| {
        json!({
            "name": name, "link": own.link.index(),
            "at": columns("point", name, &["x_m", "y_m"]), "velocity": columns("point", name, &["vx_m_s", "vy_m_s"]),
            "acceleration": columns("point", name, &["ax_m_s2", "ay_m_s2"]),
        })
    });
    let joints = list(mechanism.joints(), |joint| {
        json!({
            "name": joint.name, "kind": joint.kind.name(), "on": side(joint.second), "force": columns("joint", &joint.name, &["fx_N", "fy_N"]),
            "links": [mechanism.links()[joint.first.link].name, mechanism.links()[joint.second.link].name],
        })
    });
    let stretched = list(&sketch.stretched, |own| {
        let lines = own.marks.iter().filter_map(|mark| match &mark.shape {
            MarkShape::Line { points, .. } => Some(list(points, |at| pair(*at))),
            MarkShape::Circle { .. } | MarkShape::Arc { .. } => None,
        });
        let (ends, lines) = (own.ends.map(side), lines.collect::<Value>());
        json!({ "role": own.role.name(), "ends": ends, "width": own.width / unit, "lines": lines })
    });
    let labels = list(&sketch.labels, |label| {
        let names = match label.names {
            Lettering::Point => "point",
            Lettering::Link => "link",
            Lettering::MassCentre => "centre",
            Lettering::Motor => "motor",
        };
        json!({ "text": label.text, "names": names, "on": side(label.at) })
    });
    json!({
        "unit": unit, "size": mechanism.size(), "view": view, "links": links, "points": points, "joints": joints,
        "stretched": stretched, "labels": labels,
    })
}

pub(super) fn pair(at: Vec2) -> Value {
    json!([at.x, at.y])
}

/// The number of a link, and a point in its frame (m).
pub(super) fn side(side: JointSide) -> Value {
    json!([side.link.index(), side.local.x, side.local.y])
}
