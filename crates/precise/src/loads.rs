//! Loads, implemented independently of `linkage::drive::Load::act`.

use std::f64::consts::TAU;

use linkage::case::Case;
use linkage::drive::Acts;
use linkage::math::angle::wrapped;
use linkage::mechanism::{JointId, LinkId};

use super::frame::{Snapshot, Wrench, slide};
use super::load_numbers::LoadNumbers;
use super::numbers::CaseNumbers;
use super::scalar::Scalar;
use super::vector::Vector;

/// An angular velocity below this fraction of the largest one counts as rounding error. The speed of a point counts as
/// rounding error below this fraction of the largest angular velocity times the mechanism's size.
const STANDSTILL: f64 = 1e-12;

/// The resultants of all loads on every link, the ground included. `input` is the input of the first drive.
pub(crate) fn loads<S: Scalar>(case: &Case, numbers: &CaseNumbers<S>, at: &Snapshot<S>, input: S) -> Vec<Wrench<S>> {
    let mut on = vec![(Vector::ZERO, S::ZERO); at.frames.len()];
    let mut sum = Sum { case, numbers, at, on: &mut on };
    for load in &numbers.loads {
        sum.add(load, input);
    }
    on
}

/// The resultants of the loads added so far, and the state on which loads depend.
struct Sum<'a, S> {
    case: &'a Case,
    numbers: &'a CaseNumbers<S>,
    at: &'a Snapshot<S>,
    on: &'a mut Vec<Wrench<S>>,
}

impl<S: Scalar> Sum<'_, S> {
    fn force(&mut self, link: LinkId, force: Vector<S>, place: Vector<S>) {
        let own = &mut self.on[link];
        *own = (own.0 + force, own.1 + place.cross(force));
    }

    fn moment(&mut self, link: LinkId, moment: S) {
        self.on[link].1 = self.on[link].1 + moment;
    }

    /// Adds a force along the line through two points: `share` times the vector between the points. A positive `share`
    /// pulls the points together.
    fn pull(&mut self, links: [LinkId; 2], ends: [Vector<S>; 2], share: S) {
        let force = (ends[1] - ends[0]) * share;
        self.force(links[0], force, ends[0]);
        self.force(links[1], -force, ends[1]);
    }

    /// Adds a moment on the first link and the opposite moment on the second link.
    fn twist(&mut self, links: [LinkId; 2], moment: S) {
        self.moment(links[0], moment);
        self.moment(links[1], -moment);
    }

    /// Adds a force on the second link of a prismatic joint, along the joint's axis, and the opposite force on the
    /// first link.
    fn along(&mut self, joint: JointId, force: S) {
        let own = &self.case.mechanism.joints()[joint];
        let numbers = &self.numbers.joints[joint];
        let axis = self.at.frames[own.first.link].arm(numbers.guides.map_or(Vector::X, |[first, _]| first));
        let place = self.at.frames[own.second.link].point(numbers.places[1]);
        self.force(own.second.link, axis * force, place);
        self.force(own.first.link, -(axis * force), place);
    }

    /// Largest absolute angular velocity of all links (rad/s).
    fn fastest(&self) -> f64 {
        self.at.frames.iter().map(|frame| frame.omega.value().abs()).fold(0.0, |a, b| if a < b { b } else { a })
    }

    /// Sense of a speed (1 or -1); 0 if the speed may be a rounding error. `length` is the mechanism's size for a speed
    /// in m/s, and 1 for an angular velocity.
    fn sense(&self, speed: S, length: f64) -> f64 {
        let speed = speed.value();
        if speed.abs() > STANDSTILL * self.fastest() * length { speed.signum() } else { 0.0 }
    }

    fn ends(&self, links: [LinkId; 2], places: [Vector<S>; 2]) -> [[Vector<S>; 2]; 2] {
        let frames = links.map(|link| &self.at.frames[link]);
        [[0, 1].map(|k| frames[k].point(places[k])), [0, 1].map(|k| frames[k].point_velocity(places[k]))]
    }

    fn slide(&self, joint: JointId) -> [S; 3] {
        slide(self.at, &self.case.mechanism.joints()[joint], &self.numbers.joints[joint])
    }

    fn add(&mut self, load: &LoadNumbers<S>, input: S) {
        match load {
            LoadNumbers::Resistance { link, moment } => {
                if self.case.can_turn(*link) {
                    let sense = self.sense(self.at.frames[*link].omega, 1.0);
                    self.moment(*link, -*moment * S::of(sense));
                }
            }
            LoadNumbers::Moment { link, moment, acts } => {
                let omega = self.at.frames[*link].omega;
                let does_act = *acts == Acts::Always || self.case.can_turn(*link) && acts.has(self.sense(omega, 1.0));
                if does_act {
                    self.moment(*link, moment.at(input));
                }
            }
            LoadNumbers::Force { link, place, force, follows } => {
                let frame = &self.at.frames[*link];
                let [x, y] = force.each_ref().map(|own| own.at(input));
                let force = if *follows { frame.arm(Vector { x, y }) } else { Vector { x, y } };
                self.force(*link, force, frame.point(*place));
            }
            LoadNumbers::ResistingForce { link, place, force } => {
                let frame = &self.at.frames[*link];
                let (velocity, at) = (frame.point_velocity(*place), frame.point(*place));
                let speed = velocity.norm();
                if self.sense(speed, self.case.mechanism.size()) != 0.0 {
                    self.force(*link, velocity * (-*force / speed), at);
                }
            }
            LoadNumbers::Spring { links, places, stiffness, free_length } => {
                let [ends, _] = self.ends(*links, *places);
                let length = (ends[1] - ends[0]).norm();
                if length.value() > 0.0 {
                    self.pull(*links, ends, *stiffness * (length - *free_length) / length);
                }
            }
            LoadNumbers::Damper { links, places, damping } => {
                let [ends, velocities] = self.ends(*links, *places);
                let gap = ends[1] - ends[0];
                if gap.dot(gap).value() > 0.0 {
                    let rate = gap.dot(velocities[1] - velocities[0]) / gap.dot(gap);
                    self.pull(*links, ends, *damping * rate);
                }
            }
            LoadNumbers::TorsionSpring { links, stiffness, free_angle, acts } => {
                let [first, second] = *links;
                let begun = self.case.start.0[second].angle - self.case.start.0[first].angle;
                // By definition, the twist of the spring at t = 0 is in (-pi, pi], so the whole turns of the start pose
                // are subtracted.
                let turns = ((wrapped(begun) - begun) / TAU).round();
                let twist = self.at.angles[second] - self.at.angles[first] + S::TURN * S::of(turns) - *free_angle;
                if acts.has(twist.value()) {
                    self.twist(*links, *stiffness * twist);
                }
            }
            LoadNumbers::TorsionDamper { links, damping } => {
                let [first, second] = links.map(|link| self.at.frames[link].omega);
                self.twist(*links, *damping * (second - first));
            }
            LoadNumbers::SlideForce { joint, force, acts } => {
                let rate = self.slide(*joint)[1];
                if *acts == Acts::Always || acts.has(self.sense(rate, self.case.mechanism.size())) {
                    self.along(*joint, force.at(input));
                }
            }
            LoadNumbers::SlideSpring { joint, stiffness, free_slide, acts } => {
                let stretch = self.slide(*joint)[0] - *free_slide;
                if acts.has(stretch.value()) {
                    self.along(*joint, -*stiffness * stretch);
                }
            }
            LoadNumbers::SlideDamper { joint, damping } => {
                let rate = self.slide(*joint)[1];
                self.along(*joint, -*damping * rate);
            }
            LoadNumbers::Friction => {}
        }
    }
}
