//! Collects the states of a run into the columns of a trajectory.

use std::cell::LazyCell;
use std::collections::BTreeMap;

use super::state::State;
use crate::case::{Case, Seat};
use crate::error::Result;
use crate::math::{Motion, Vec2};
use crate::mechanism::{JointId, JointSide, LinkId, TransmissionId};
use crate::trajectory::channel::rows;
use crate::trajectory::{
    Channel, ChannelSubject, OfDrive, OfFrame, OfFriction, OfJoint, OfLink, OfPoint, OfSlider, OfTransmission, Stage,
    Trajectory,
};

/// Number of rows that are collected before they are written to their columns.
/// Each column is a separate block of memory. With this buffer each column is accessed only once per eight rows.
const BLOCK: usize = 8;

/// Collects states into the columns of a trajectory, row by row in any order.
/// The sampler uses only the links, points, joints and drives that have requested channels.
#[derive(Debug)]
pub struct Sampler {
    links: Vec<(LinkId, Mask)>,
    points: Vec<(JointSide, Mask)>,
    joints: Vec<(JointId, Mask)>,
    sliders: Vec<(JointId, Mask)>,
    /// Joints with friction.
    frictions: Vec<(JointId, ChannelSubject, Mask)>,
    transmissions: Vec<(TransmissionId, Mask)>,
    frame: Mask,
    /// The drives with requested channels, in the order of the case's drives.
    drives: Vec<(usize, ChannelSubject, Mask)>,
    channels: Vec<Channel>,
    columns: Vec<Vec<f64>>,
    rows: Vec<usize>,
    /// Values of the latest rows, which are not in the columns yet.
    block: Vec<f64>,
    /// The values of the rows `rows[..kept]` are already in the columns.
    kept: usize,
    /// The input at every instant of the grid, in the scenario's convention.
    /// The input comes from the grid or, for a free motion, from the states.
    inputs: Vec<f64>,
}

/// The requested channels of one subject, given by their rows in the table of channels.
#[derive(Clone, Copy, Debug, Default)]
struct Mask {
    /// One bit for each row of the table of channels: 1 if the row is requested.
    rows: u16,
    /// Whether the rows include rates or accelerations.
    beyond_positions: bool,
}

impl Mask {
    fn add(&mut self, row: usize, stage: Stage) {
        self.rows |= 1 << row;
        self.beyond_positions |= stage > Stage::Positions;
    }

    fn is_empty(self) -> bool {
        self.rows == 0
    }
}

/// For every subject with requested channels: the mask of these channels. The key is kind and name of the subject.
fn masks(channels: &[Channel]) -> BTreeMap<(ChannelSubject, &str), Mask> {
    let mut masks: BTreeMap<(ChannelSubject, &str), Mask> = BTreeMap::new();
    for channel in channels {
        let mask = masks.entry((channel.kind.subject, channel.of.as_str())).or_default();
        mask.add(channel.kind.row(), channel.kind.stage);
    }
    masks
}

impl Sampler {
    /// Storage for all rows and requested channels of a case.
    #[must_use]
    pub fn new(case: &Case) -> Self {
        let channels = case.channels();
        let columns = vec![vec![f64::NAN; case.grid.len()]; channels.len()];
        let mut sampler = Sampler {
            links: Vec::new(),
            points: Vec::new(),
            joints: Vec::new(),
            sliders: Vec::new(),
            frictions: Vec::new(),
            transmissions: Vec::new(),
            frame: Mask::default(),
            drives: Vec::new(),
            block: vec![f64::NAN; BLOCK * channels.len()],
            channels: Vec::new(),
            columns,
            rows: Vec::with_capacity(case.grid.len()),
            kept: 0,
            inputs: case.grid.inputs.clone(),
        };
        let masks = masks(&channels);
        for (subject, name, seat) in case.subjects() {
            let Some(&mask) = masks.get(&(subject, name)) else { continue };
            match seat {
                Seat::Link(link) => sampler.links.push((link, mask)),
                Seat::Point(side) => sampler.points.push((side, mask)),
                Seat::Joint(joint) if subject == ChannelSubject::Slider => sampler.sliders.push((joint, mask)),
                Seat::Joint(joint) if matches!(subject, ChannelSubject::Journal | ChannelSubject::Guide) => {
                    sampler.frictions.push((joint, subject, mask));
                }
                Seat::Joint(joint) => sampler.joints.push((joint, mask)),
                Seat::Transmission(id) => sampler.transmissions.push((id, mask)),
                Seat::Frame => sampler.frame = mask,
                Seat::Drive(drive) => sampler.drives.push((drive, subject, mask)),
            }
        }
        Sampler { channels, ..sampler }
    }

    /// Stores a state in a row. The values have the order of [`Case::channels`].
    pub fn put(&mut self, case: &Case, row: usize, state: &State) {
        if self.rows.len() == self.kept + BLOCK {
            self.keep();
        }
        let (at, width) = (self.rows.len() - self.kept, self.channels.len());
        self.rows.push(row);
        if case.is_free() {
            self.inputs[row] = case.input_in(&state.motions, &state.angles);
        }
        let mut out = Row { values: &mut self.block[at * width..][..width] };
        for &(index, mask) in &self.links {
            let motion = &state.motions[index];
            let centre = BodyPoint::of(motion, case.mechanism.links()[index].mass_centre, mask);
            out.put(&rows::LINK, mask, |of| match of {
                OfLink::Angle => state.angles[index],
                OfLink::Omega => motion.omega,
                OfLink::Alpha => motion.alpha,
                OfLink::Centre(of) => centre.read(of),
            });
        }
        for (side, mask) in &self.points {
            let point = BodyPoint::of(&state.motions[side.link], side.local, *mask);
            out.put(&rows::POINT, *mask, |of| point.read(of));
        }
        for &(index, mask) in &self.joints {
            let force = &state.forces[index];
            out.put(&rows::JOINT, mask, |of| match of {
                OfJoint::ForceX => force.x,
                OfJoint::ForceY => force.y,
            });
        }
        for &(index, mask) in &self.sliders {
            let slide = state.slide(&case.mechanism.joints()[index]).expect("the joint slides");
            out.put(&rows::SLIDER, mask, |of| match of {
                OfSlider::Slide => slide[0],
                OfSlider::Speed => slide[1],
                OfSlider::Acceleration => slide[2],
                OfSlider::Moment => state.moments[index],
            });
        }
        for &(joint, subject, mask) in &self.frictions {
            let read = |of| match of {
                OfFriction::Effort => {
                    let own = case.frictions().find(|own| own.joint == joint && !own.is_mesh());
                    own.map_or(0.0, |own| own.effort(&state.motions, state.reactions()))
                }
            };
            if subject == ChannelSubject::Guide {
                out.put(&rows::GUIDE, mask, read);
            } else {
                out.put(&rows::JOURNAL, mask, read);
            }
        }
        for &(index, mask) in &self.transmissions {
            out.put(&rows::TRANSMISSION, mask, |of| match of {
                OfTransmission::Force => state.transmitted[index],
            });
        }
        if !self.frame.is_empty() {
            // The shaking force is computed only once, and only if a requested row uses it.
            let shaking = LazyCell::new(|| state.shaking(case));
            out.put(&rows::FRAME, self.frame, |of| match of {
                OfFrame::ForceX => shaking.0.x,
                OfFrame::ForceY => shaking.0.y,
                OfFrame::Moment => shaking.1,
            });
        }
        for &(index, subject, mask) in &self.drives {
            let read = |of| match of {
                OfDrive::Effort => state.torques[index],
            };
            match subject {
                ChannelSubject::Motor => out.put(&rows::MOTOR, mask, read),
                ChannelSubject::Thrust => out.put(&rows::THRUST, mask, read),
                ChannelSubject::FurtherThrust => out.put(&rows::FURTHER_THRUST, mask, read),
                ChannelSubject::Link
                | ChannelSubject::Point
                | ChannelSubject::Joint
                | ChannelSubject::Slider
                | ChannelSubject::Journal
                | ChannelSubject::Guide
                | ChannelSubject::Transmission
                | ChannelSubject::Frame
                | ChannelSubject::Drive => out.put(&rows::DRIVE, mask, read),
            }
        }
        debug_assert!(out.values.is_empty(), "as many values as channels");
    }

    /// Moves the buffered rows into the columns.
    fn keep(&mut self) {
        let width = self.channels.len();
        let rows = &self.rows[self.kept..];
        for (channel, column) in self.columns.iter_mut().enumerate() {
            for (values, &row) in self.block.chunks_exact(width).zip(rows) {
                column[row] = values[channel];
            }
        }
        self.kept = self.rows.len();
    }

    /// The trajectory on the case's grid.
    ///
    /// # Errors
    /// If a value is missing, NaN or infinite.
    pub fn finish(mut self, case: &Case) -> Result<Trajectory> {
        self.keep();
        let trajectory = Trajectory::new(case.grid.times.clone(), self.inputs, self.channels, self.columns)?;
        Ok(trajectory.of_input(case.crank().input))
    }

    /// The trajectory of the rows stored so far, in the order of storing.
    /// `None` if there are no rows, or if a number is not finite.
    #[must_use]
    pub fn so_far(mut self, case: &Case) -> Option<Trajectory> {
        self.keep();
        if self.rows.is_empty() {
            return None;
        }
        let stored = |values: &[f64]| self.rows.iter().map(|&row| values[row]).collect::<Vec<f64>>();
        let columns = self.columns.iter().map(|column| stored(column)).collect();
        let trajectory =
            Trajectory::new(stored(&case.grid.times), stored(&self.inputs), self.channels, columns).ok()?;
        Some(trajectory.of_input(case.crank().input))
    }
}

/// The part of a row of values that is not filled yet. Values are filled in the order of channels.
struct Row<'a> {
    values: &'a mut [f64],
}

impl Row<'_> {
    /// Stores the requested quantities of a subject. `read` returns the value of each quantity.
    #[inline(always)]
    fn put<Of: Copy, const N: usize>(&mut self, rows: &[(Of, Stage); N], mask: Mask, read: impl Fn(Of) -> f64) {
        let mut put = 0;
        // The loop over quantities is unrolled. Every quantity is then a constant, so the compiler removes the `match`
        // in `read`.
        macro_rules! each {
            ($condition:ident: $($row:literal)*) => {{
                const { assert!(N <= [$($row),*].len(), "every row of a subject is put") };
                $(if $row < N && $condition!($row) {
                    self.values[put] = read(rows[$row].0);
                    put += 1;
                })*
            }};
        }
        if mask.rows == const { (1 << N) - 1 } {
            assert!(self.values.len() >= N, "as many values as channels");
            macro_rules! always {
                ($row:literal) => {
                    true
                };
            }
            each!(always: 0 1 2 3 4 5 6 7 8 9 10 11);
        } else {
            macro_rules! wanted {
                ($row:literal) => {
                    mask.rows & (1 << $row) != 0
                };
            }
            each!(wanted: 0 1 2 3 4 5 6 7 8 9 10 11);
        }
        self.values = &mut std::mem::take(&mut self.values)[put..];
    }
}

/// Position (m), velocity (m/s) and acceleration (m/s^2) of a body point. Velocity and acceleration are computed only
/// if requested.
struct BodyPoint([Vec2; 3]);

impl BodyPoint {
    #[inline]
    fn of(motion: &Motion, local: Vec2, mask: Mask) -> Self {
        let arm = motion.arm(local);
        let position = motion.origin + arm;
        match mask.beyond_positions {
            true => BodyPoint([position, motion.velocity_beyond(arm), motion.acceleration_beyond(arm)]),
            false => BodyPoint([position, Vec2::zeros(), Vec2::zeros()]),
        }
    }

    #[inline]
    fn read(&self, of: OfPoint) -> f64 {
        let BodyPoint([position, velocity, acceleration]) = self;
        match of {
            OfPoint::X => position.x,
            OfPoint::Y => position.y,
            OfPoint::VelocityX => velocity.x,
            OfPoint::VelocityY => velocity.y,
            OfPoint::AccelerationX => acceleration.x,
            OfPoint::AccelerationY => acceleration.y,
        }
    }
}
