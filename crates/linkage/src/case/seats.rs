//! Everything of a case that has channels, and where in the mechanism it sits.

use std::collections::BTreeMap;

use super::Case;
use crate::mechanism::Side;
use crate::trajectory::{Channel, Stage, Subject};

/// Where in a mechanism the subject of a channel sits. It says what its numbers depend on and what they tell about.
/// A new subject sits on one of these: see [`Case::seats`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Seat {
    /// On the link with this number.
    Link(usize),
    /// At a point, on the first link that carries it.
    Point(Side),
    /// In the joint with this number.
    Joint(usize),
    /// At the drive with this number.
    Drive(usize),
    /// On the whole frame.
    Frame,
}

/// The seats of all subjects of a case, by their names.
#[derive(Debug)]
pub struct Seats<'a>(BTreeMap<(Subject, &'a str), Seat>);

impl Seats<'_> {
    /// The seat of a channel's subject; `None` for a channel that the case does not have.
    #[must_use]
    pub fn of(&self, channel: &Channel) -> Option<Seat> {
        self.0.get(&(channel.kind.subject, channel.of.as_str())).copied()
    }
}

impl Case {
    /// Everything that has channels, in the order of columns: sort, number among its like, and name.
    /// Points are numbered as in [`Mechanism::moving_points`](crate::mechanism::Mechanism::moving_points).
    pub(crate) fn subjects(&self) -> impl Iterator<Item = (Subject, usize, &str)> {
        let links = self.mechanism.links().iter().enumerate().skip(1);
        let links = links.map(|(index, link)| (Subject::Link, index, link.name.as_str()));
        let points = self.mechanism.moving_points().enumerate().map(|(index, (name, _))| (Subject::Point, index, name));
        let joints = || self.mechanism.joints().iter().enumerate();
        let sliders = joints().filter(|(_, joint)| joint.slides());
        let sliders = sliders.map(|(index, joint)| (Subject::Slider, index, joint.name.as_str()));
        let joints = joints().map(|(index, joint)| (Subject::Joint, index, joint.name.as_str()));
        let frame = std::iter::once((Subject::Frame, 0, ""));
        let moved = self.drives.with_moment().map(|(index, drive)| match index {
            0 => (Subject::Drive, 0, ""),
            _ => (Subject::Motor, index, self.mechanism.joints()[drive.joint].name.as_str()),
        });
        links.chain(points).chain(joints).chain(sliders).chain(frame).chain(moved)
    }

    /// The joints whose reactions are wanted, by themselves or as part of the force on the frame.
    #[must_use]
    pub fn wanted_reactions(&self) -> Vec<usize> {
        let (joints, seats) = (self.mechanism.joints(), self.seats());
        let is_wanted = |joint: &usize| match &self.only {
            None => self.wanted.deepest() >= Stage::Reactions,
            Some(only) => only.iter().any(|own| match seats.of(own) {
                Some(Seat::Joint(at)) => at == *joint && own.kind.stage >= Stage::Reactions,
                Some(Seat::Frame) => true,
                Some(Seat::Link(_) | Seat::Point(_) | Seat::Drive(_)) | None => false,
            }),
        };
        (0..joints.len()).filter(is_wanted).collect()
    }

    /// Where everything that has channels sits.
    #[must_use]
    pub fn seats(&self) -> Seats<'_> {
        let points: Vec<Side> = self.mechanism.moving_points().map(|(_, side)| side).collect();
        let seat = |(subject, index, name)| {
            let seat = match subject {
                Subject::Link => Seat::Link(index),
                Subject::Point => Seat::Point(points[index]),
                Subject::Joint | Subject::Slider => Seat::Joint(index),
                Subject::Drive | Subject::Motor => Seat::Drive(index),
                Subject::Frame => Seat::Frame,
            };
            ((subject, name), seat)
        };
        Seats(self.subjects().map(seat).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::Seat;
    use crate::fixtures::{four_bar, turning};
    use crate::trajectory::Channel;

    #[test]
    fn every_channel_of_a_case_has_a_seat_and_no_other_has_one() {
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
                Seat::Drive(_) | Seat::Frame => "",
            };
            assert_eq!(channel.of, name, "{channel}");
        }
        assert_eq!(seats.of(&Channel::named("link.nobody.angle_rad").unwrap()), None);
    }
}
