//! Channels at the instants, computed in full precision and rounded once.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use linkage::case::Case;
use linkage::error::Result;
use linkage::math::angle::wrapped;
use linkage::mechanism::{GROUND, Joint, JointId, JointSide, LinkId};
use linkage::trajectory::{
    Channel, OfDrive, OfFrame, OfFriction, OfJoint, OfLink, OfPoint, OfSlider, OfTransmission, Reading, Trajectory,
};

use super::Long;
use super::frame::{Frame, Snapshot};
use super::vector::Vector;

/// The trajectory of a case from its instants, one for each row of the grid.
pub(crate) fn trajectory(case: &Case, instants: &[Snapshot]) -> Result<Trajectory> {
    let places = Places::of(case);
    let channels = case.channels();
    let column = |channel: &Channel| {
        let mut values: Vec<f64> = instants.iter().map(|instant| places.read(case, instant, channel)).collect();
        if channel.kind.periodic {
            keep_turns(&mut values);
        }
        values
    };
    let columns = channels.iter().map(column).collect();
    Trajectory::new(case.grid.times.clone(), case.grid.inputs.clone(), channels, columns)
}

/// Adds whole turns to the values of an angle. Afterwards the angle changes by less than half a turn from one instant
/// to the next.
fn keep_turns(values: &mut [f64]) {
    for row in 1..values.len() {
        let turns = ((values[row - 1] - values[row]) / TAU).round();
        // If no whole turns are needed, nothing is added, because the addition could cause a rounding error.
        if turns != 0.0 {
            values[row] += turns * TAU;
        }
    }
}

/// Links, points and joints by name.
struct Places<'a> {
    links: BTreeMap<&'a str, LinkId>,
    points: BTreeMap<&'a str, JointSide>,
    joints: BTreeMap<&'a str, JointId>,
}

impl<'a> Places<'a> {
    fn of(case: &'a Case) -> Self {
        let (links, joints) = (case.mechanism.links(), case.mechanism.joints());
        Places {
            links: links.entries().map(|(index, link)| (link.name.as_str(), index)).collect(),
            points: case.mechanism.moving_points().collect(),
            joints: joints.entries().map(|(index, joint)| (joint.name.as_str(), index)).collect(),
        }
    }

    fn read(&self, case: &Case, instant: &Snapshot, channel: &Channel) -> f64 {
        let of = channel.of.as_str();
        match channel.kind.reading {
            Reading::Link(reading) => {
                let link = self.links[of];
                let frame = &instant.frames[link];
                match reading {
                    OfLink::Angle if link == case.crank().link => instant.crank.rounded(),
                    OfLink::Angle => angle(frame.direction),
                    OfLink::Omega => frame.omega.rounded(),
                    OfLink::Alpha => frame.alpha.rounded(),
                    OfLink::Centre(reading) => of_point(frame, case.mechanism.links()[link].mass_centre, reading),
                }
            }
            Reading::Point(reading) => {
                let side = self.points[of];
                of_point(&instant.frames[side.link], side.local, reading)
            }
            Reading::Joint(reading) => {
                let force = instant.forces[self.joints[of]];
                match reading {
                    OfJoint::ForceX => force.x.rounded(),
                    OfJoint::ForceY => force.y.rounded(),
                }
            }
            Reading::Slider(reading) => {
                let joint = self.joints[of];
                let [slide, speed, acceleration] = slide(instant, &case.mechanism.joints()[joint]);
                match reading {
                    OfSlider::Slide => slide.rounded(),
                    OfSlider::Speed => speed.rounded(),
                    OfSlider::Acceleration => acceleration.rounded(),
                    OfSlider::Moment => instant.moments[joint].rounded(),
                }
            }
            Reading::Journal(OfFriction::Effort) | Reading::Guide(OfFriction::Effort) => {
                unreachable!("loads are refused")
            }
            Reading::Transmission(OfTransmission::Force) => unreachable!("transmissions are refused"),
            Reading::Frame(reading) => {
                let (force, moment) = shaking(case, instant);
                match reading {
                    OfFrame::ForceX => force.x.rounded(),
                    OfFrame::ForceY => force.y.rounded(),
                    OfFrame::Moment => moment.rounded(),
                }
            }
            Reading::Drive(OfDrive::Effort)
            | Reading::Motor(OfDrive::Effort)
            | Reading::Thrust(OfDrive::Effort)
            | Reading::FurtherThrust(OfDrive::Effort) => instant.torque.rounded(),
        }
    }
}

/// Angle of a direction (rad), within half a turn: an approximate angle in doubles plus the remainder.
fn angle(direction: Vector) -> f64 {
    let rough = direction.y.rounded().atan2(direction.x.rounded());
    let rest = direction.rotated_back(Vector::unit(Long::of(rough)));
    wrapped((Long::of(rough) + rest.y).rounded())
}

fn of_point(frame: &Frame, local: linkage::math::Vec2, reading: OfPoint) -> f64 {
    match reading {
        OfPoint::X => frame.point(local).x,
        OfPoint::Y => frame.point(local).y,
        OfPoint::VelocityX => frame.point_velocity(local).x,
        OfPoint::VelocityY => frame.point_velocity(local).y,
        OfPoint::AccelerationX => frame.point_acceleration(local).x,
        OfPoint::AccelerationY => frame.point_acceleration(local).y,
    }
    .rounded()
}

/// Slide along the first link's axis, with the first and second derivative of the slide.
/// The slide is computed from the motion of the second point relative to the rotating first link.
fn slide(instant: &Snapshot, joint: &Joint) -> [Long; 3] {
    let [first, second] = [joint.first, joint.second].map(|side| (&instant.frames[side.link], side.local));
    let axis = first.0.arm(joint.axis_on(joint.first.link).unwrap_or_default());
    let gap = second.0.point(second.1) - first.0.point(first.1);
    let gap_rate = second.0.point_velocity(second.1) - first.0.point_velocity(first.1);
    let gap_second = second.0.point_acceleration(second.1) - first.0.point_acceleration(first.1);
    let (omega, alpha, two) = (first.0.omega, first.0.alpha, Long::of(2.0));
    // The axis rotates with the first link, so the derivatives of axis . gap also contain the rates of the axis.
    let turned = axis.turned();
    let second_rate =
        axis.dot(gap_second) + two * omega * turned.dot(gap_rate) + (turned * alpha - axis * (omega * omega)).dot(gap);
    [axis.dot(gap), axis.dot(gap_rate) + omega * turned.dot(gap), second_rate]
}

/// Force that joints and drive exert on the ground, and the moment of this force about the origin.
fn shaking(case: &Case, instant: &Snapshot) -> (Vector, Long) {
    let (mut force, mut moment) = (Vector::ZERO, -instant.torque);
    for (index, joint) in case.mechanism.joints().entries() {
        let sign = match (joint.first.link, joint.second.link) {
            (GROUND, _) => -Long::ONE,
            (_, GROUND) => Long::ONE,
            _ => continue,
        };
        let place = instant.frames[joint.second.link].point(joint.second.local);
        let own = instant.forces[index] * sign;
        force = force + own;
        moment = moment + place.cross(own) + instant.moments[index] * sign;
    }
    (force, moment)
}
