//! Points whose paths are drawn, by their names.

use super::media::PictureOptions;
use crate::sentences;
use linkage::error::{Error, ErrorKind};
use linkage::mechanism::{JointSide, LinkId, Mechanism};

/// First part of the name of a mass centre: `link.coupler` is the mass centre of the coupler, as in channel names.
const OF_LINK: &str = "link.";

/// A point of a link, with its name in pictures.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct NamedPoint {
    pub(super) name: String,
    pub(super) side: JointSide,
}

/// The points whose paths are requested.
#[derive(Clone, Debug, Default)]
pub(super) struct RequestedPoints {
    /// Points whose paths are drawn into the picture.
    pub(super) traced: Vec<NamedPoint>,
    /// Joints whose paths are drawn, except paths that are circles about a pivot.
    pub(super) joints: Vec<NamedPoint>,
    /// Points whose paths are drawn enlarged.
    pub(super) enlarged: Vec<NamedPoint>,
    /// An error for each requested name that does not exist.
    pub(super) unknown: Vec<Error>,
}

impl RequestedPoints {
    /// The points whose names are requested, and with `all_traces` also all moving points: in `joints` if they are at
    /// joints, otherwise in `traced`. If several positions are requested, but neither `traces` nor `all_traces`, all
    /// moving points are in `traced`.
    pub(super) fn of(mechanism: &Mechanism, wish: &PictureOptions) -> Self {
        let [traces, enlarged, ..] = wish.keys();
        let mut unknown = Vec::new();
        let mut all = |names: &[String], key: &str| {
            let found = names.iter().map(|name| named(mechanism, name));
            let (points, errors): (Vec<_>, Vec<_>) = found.partition(std::result::Result::is_ok);
            unknown.extend(errors.into_iter().filter_map(std::result::Result::err).map(|error| error.key(key)));
            points.into_iter().flatten().collect::<Vec<NamedPoint>>()
        };
        let (named, enlarged) = (all(&wish.traces, traces), all(&wish.enlarged, enlarged));
        let is_every = wish.positions.is_some() && !wish.all_traces && wish.traces.is_empty();
        let is_joint = |at: JointSide| mechanism.joints().iter().any(|joint| joint.on(at.link) == Some(at.local));
        let moving = mechanism.moving_points().filter(|_| is_every || wish.all_traces);
        let moving = moving.map(|(name, side)| NamedPoint { name: name.into(), side });
        let (mut traced, joints): (Vec<_>, Vec<_>) = moving.partition(|own| is_every || !is_joint(own.side));
        traced.extend(named);
        RequestedPoints { traced, joints, enlarged, unknown }
    }
}

/// The point or the mass centre with this name.
fn named(mechanism: &Mechanism, name: &str) -> Result<NamedPoint, Error> {
    let mut points = mechanism.moving_points();
    let point = points.find(|(own, _)| *own == name).map(|(_, side)| side);
    let link = name.strip_prefix(OF_LINK).and_then(|link| mechanism.link_named(link));
    let centre = link
        .filter(|&link| has_centre(mechanism, link))
        .map(|link| JointSide { link, local: mechanism.links()[link].mass_centre });
    let side = point.or(centre).ok_or_else(|| {
        let points = mechanism.moving_points().map(|(own, _)| own.to_string());
        let centres = mechanism.links().ids().filter(|&link| has_centre(mechanism, link));
        let centres = centres.map(|link| format!("{OF_LINK}{}", mechanism.links()[link].name));
        let names: Vec<String> = points.chain(centres).collect();
        let message = sentences::no_point_that_moves_is_called(&name);
        Error::new(ErrorKind::Input, message).help(sentences::name_one_of(&names.join(", ")))
    })?;
    Ok(NamedPoint { name: name.into(), side })
}

/// Whether a link moves and has a mass centre.
fn has_centre(mechanism: &Mechanism, link: LinkId) -> bool {
    link.index() > 0 && mechanism.links()[link].mass > 0.0
}
