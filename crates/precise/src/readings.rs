//! Channels at the instants, computed in full precision and rounded once.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use linkage::case::Case;
use linkage::error::Result;
use linkage::input::Input;
use linkage::math::angle::wrapped;
use linkage::mechanism::{JointId, JointSide, LinkId};
use linkage::trajectory::{
    Channel, OfDrive, OfFrame, OfFriction, OfJoint, OfLink, OfPoint, OfSlider, OfTransmission, Reading, Trajectory,
};

use super::equations::Whole;
use super::frame::{Frame, Snapshot, slide};
use super::scalar::Scalar;
use super::vector::Vector;

/// The trajectory of a case from its states, one state for each row of the grid.
pub(crate) fn trajectory<S: Scalar>(whole: &Whole<S>, instants: &[Snapshot<S>]) -> Result<Trajectory> {
    let case = whole.case;
    let readings = Readings::of(*whole);
    let channels = case.channels();
    let column = |channel: &Channel| {
        let read = |instant| readings.read(instant, channel).map_or(f64::NAN, S::value);
        let mut values: Vec<f64> = instants.iter().map(read).collect();
        if channel.kind.periodic {
            values.iter_mut().for_each(|angle| *angle = within_half_a_turn(channel, case, *angle));
            keep_turns(&mut values);
        }
        values
    };
    let columns = channels.iter().map(column).collect();
    let found = Trajectory::new(case.grid.times.clone(), case.grid.inputs.clone(), channels, columns)?;
    Ok(found.of_input(case.crank().input))
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

/// The angle of a link, between -pi and pi; [`keep_turns`] continues the angle from this value. The angle of the crank
/// is returned unchanged, with its whole turns.
fn within_half_a_turn(channel: &Channel, case: &Case, angle: f64) -> f64 {
    let crank = case.crank();
    let is_crank = crank.input == Input::Angle && case.mechanism.links()[crank.link].name == channel.of;
    if is_crank { angle } else { wrapped(angle) }
}

/// Reads the channels of a mechanism from its states.
#[derive(Debug)]
pub struct Readings<'a, S> {
    pub(crate) whole: Whole<'a, S>,
    links: BTreeMap<&'a str, LinkId>,
    /// Links and indices of points.
    points: BTreeMap<&'a str, (LinkId, usize)>,
    joints: BTreeMap<&'a str, JointId>,
}

impl<'a, S: Scalar> Readings<'a, S> {
    /// A reader of the channels of a mechanism.
    #[must_use]
    pub fn of(whole: Whole<'a, S>) -> Self {
        let mechanism = &whole.case.mechanism;
        let place = |(name, side): (&'a str, JointSide)| {
            let index = mechanism.links()[side.link].points.iter().position(|own| own.name == name)?;
            Some((name, (side.link, index)))
        };
        Readings {
            whole,
            links: mechanism.links().entries().map(|(index, link)| (link.name.as_str(), index)).collect(),
            points: mechanism.moving_points().filter_map(place).collect(),
            joints: mechanism.joints().entries().map(|(index, joint)| (joint.name.as_str(), index)).collect(),
        }
    }

    /// World coordinates (m) of a position that is given in the frame of a link (m).
    #[must_use]
    pub fn world(&self, instant: &Snapshot<S>, link: LinkId, [x, y]: [S; 2]) -> [S; 2] {
        let place = instant.frames[link].point(Vector { x, y });
        [place.x, place.y]
    }

    /// The value of a channel in a state; `None` for a channel that the mechanism does not have.
    #[must_use]
    pub fn read(&self, instant: &Snapshot<S>, channel: &Channel) -> Option<S> {
        let of = channel.of.as_str();
        let (case, numbers) = (self.whole.case, self.whole.numbers);
        Some(match channel.kind.reading {
            Reading::Link(reading) => {
                let link = *self.links.get(of)?;
                let frame = &instant.frames[link];
                let crank = &numbers.drives[0];
                match reading {
                    OfLink::Angle if crank.input == Input::Angle && link == crank.link => instant.crank,
                    OfLink::Angle => instant.angles[link],
                    OfLink::Omega => frame.omega,
                    OfLink::Alpha => frame.alpha,
                    OfLink::Centre(reading) => of_point(frame, numbers.links[link].centre, reading),
                }
            }
            Reading::Point(reading) => {
                let (link, index) = *self.points.get(of)?;
                of_point(&instant.frames[link], numbers.links[link].points[index], reading)
            }
            Reading::Joint(reading) => {
                let force = instant.forces[*self.joints.get(of)?];
                match reading {
                    OfJoint::ForceX => force.x,
                    OfJoint::ForceY => force.y,
                }
            }
            Reading::Slider(reading) => {
                let joint = *self.joints.get(of)?;
                let own = &case.mechanism.joints()[joint];
                let [slide, speed, acceleration] = slide(instant, own, &numbers.joints[joint]);
                match reading {
                    OfSlider::Slide => slide,
                    OfSlider::Speed => speed,
                    OfSlider::Acceleration => acceleration,
                    OfSlider::Moment => instant.moments[joint],
                }
            }
            Reading::Journal(OfFriction::Effort)
            | Reading::Guide(OfFriction::Effort)
            | Reading::Transmission(OfTransmission::Force) => return None,
            Reading::Frame(reading) => {
                let (force, moment) = self.whole.shaking(instant);
                match reading {
                    OfFrame::ForceX => force.x,
                    OfFrame::ForceY => force.y,
                    OfFrame::Moment => moment,
                }
            }
            Reading::Drive(OfDrive::Effort) | Reading::Thrust(OfDrive::Effort) => *instant.efforts.first()?,
            Reading::Motor(OfDrive::Effort) | Reading::FurtherThrust(OfDrive::Effort) => {
                let joint = *self.joints.get(of)?;
                let drive = numbers.drives.iter().position(|drive| drive.joint == joint)?;
                instant.efforts[drive]
            }
        })
    }
}

fn of_point<S: Scalar>(frame: &Frame<S>, local: Vector<S>, reading: OfPoint) -> S {
    match reading {
        OfPoint::X => frame.point(local).x,
        OfPoint::Y => frame.point(local).y,
        OfPoint::VelocityX => frame.point_velocity(local).x,
        OfPoint::VelocityY => frame.point_velocity(local).y,
        OfPoint::AccelerationX => frame.point_acceleration(local).x,
        OfPoint::AccelerationY => frame.point_acceleration(local).y,
    }
}
