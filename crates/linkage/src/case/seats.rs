//! The subjects of a case's channels and their locations in the mechanism.

use std::collections::BTreeMap;

use super::Case;
use crate::input::Input;
use crate::mechanism::{JointId, JointSide, LinkId, TransmissionId};
use crate::trajectory::{Channel, ChannelSubject, Stage};

/// Location of a channel's subject in the mechanism.
/// The location determines on which parts the channel's values depend.
/// A new kind of subject needs one of these locations in `Case::subjects`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Seat {
    /// The link with this number.
    Link(LinkId),
    /// A point of a link. If several links carry the point, the first of these links.
    Point(JointSide),
    /// The joint with this number.
    Joint(JointId),
    /// The drive with this number.
    Drive(usize),
    /// The transmission with this number.
    Transmission(TransmissionId),
    /// The whole frame.
    Frame,
}

/// Locations of all subjects of a case, by name.
#[derive(Debug)]
pub struct Seats<'a>(BTreeMap<(ChannelSubject, &'a str), Seat>);

impl Seats<'_> {
    /// Location of a channel's subject; `None` for a channel that the case does not have.
    #[must_use]
    pub fn of(&self, channel: &Channel) -> Option<Seat> {
        self.0.get(&(channel.kind.subject, channel.of.as_str())).copied()
    }
}

impl Case {
    /// All subjects of channels, in the order of columns: kind, name and location.
    pub(crate) fn subjects(&self) -> impl Iterator<Item = (ChannelSubject, &str, Seat)> {
        let (links, joints) = (self.mechanism.links(), self.mechanism.joints());
        let links =
            links.entries().skip(1).map(|(id, link)| (ChannelSubject::Link, link.name.as_str(), Seat::Link(id)));
        let points =
            self.mechanism.moving_points().map(|(name, side)| (ChannelSubject::Point, name, Seat::Point(side)));
        let sliders = joints.entries().filter(|(_, joint)| joint.slides());
        let sliders = sliders.map(|(id, joint)| (ChannelSubject::Slider, joint.name.as_str(), Seat::Joint(id)));
        let frame = std::iter::once((ChannelSubject::Frame, "", Seat::Frame));
        let moved = self.drives.with_moment().map(|(index, drive)| {
            let name = if index == 0 { "" } else { joints[drive.joint].name.as_str() };
            let subject = match (index, drive.input) {
                (0, Input::Angle | Input::Turn) => ChannelSubject::Drive,
                (_, Input::Angle | Input::Turn) => ChannelSubject::Motor,
                (0, Input::Slide) => ChannelSubject::Thrust,
                (_, Input::Slide) => ChannelSubject::FurtherThrust,
            };
            (subject, name, Seat::Drive(index))
        });
        let frictions = self.frictions().filter(|own| !own.is_mesh()).map(move |own| {
            let joint = &joints[own.joint];
            let subject = if joint.slides() { ChannelSubject::Guide } else { ChannelSubject::Journal };
            (subject, joint.name.as_str(), Seat::Joint(own.joint))
        });
        let joints = joints.entries().map(|(id, joint)| (ChannelSubject::Joint, joint.name.as_str(), Seat::Joint(id)));
        let transmissions = self.mechanism.transmissions().entries();
        let transmissions =
            transmissions.map(|(id, own)| (ChannelSubject::Transmission, own.name(), Seat::Transmission(id)));
        links.chain(points).chain(joints).chain(sliders).chain(frictions).chain(transmissions).chain(frame).chain(moved)
    }

    /// Joints whose reactions are requested, directly or as part of the force on the frame.
    #[must_use]
    pub fn wanted_reactions(&self) -> Vec<JointId> {
        let (joints, seats) = (self.mechanism.joints(), self.seats());
        let is_wanted = |joint: &JointId| match &self.only {
            None => self.wanted.deepest() >= Stage::Reactions,
            Some(only) => only.iter().any(|own| match seats.of(own) {
                Some(Seat::Joint(at)) => at == *joint && own.kind.stage >= Stage::Reactions,
                Some(Seat::Frame) => true,
                Some(Seat::Link(_) | Seat::Point(_) | Seat::Drive(_) | Seat::Transmission(_)) | None => false,
            }),
        };
        joints.ids().filter(is_wanted).collect()
    }

    /// Locations of all subjects of channels.
    #[must_use]
    pub fn seats(&self) -> Seats<'_> {
        Seats(self.subjects().map(|(subject, name, seat)| ((subject, name), seat)).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::Seat;
    use crate::fixtures::{four_bar, turning};
    use crate::trajectory::Channel;

    #[test]
    fn exactly_the_channels_of_a_case_have_a_seat() {
        let case = turning(four_bar());
        let seats = case.seats();
        for channel in case.all_channels() {
            let seat = seats.of(&channel).unwrap_or_else(|| panic!("{channel} has no seat"));
            let name = match seat {
                Seat::Link(link) => case.mechanism.links()[link].name.as_str(),
                Seat::Joint(joint) => case.mechanism.joints()[joint].name.as_str(),
                Seat::Point(side) => {
                    let points = &case.mechanism.links()[side.link].points;
                    points.iter().find(|point| point.local == side.local).map_or("", |point| &point.name)
                }
                Seat::Drive(_) | Seat::Transmission(_) | Seat::Frame => "",
            };
            assert_eq!(channel.of, name, "{channel}");
        }
        assert_eq!(seats.of(&Channel::named("link.nobody.angle_rad").unwrap()), None);
    }
}
