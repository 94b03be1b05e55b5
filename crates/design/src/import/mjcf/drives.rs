//! Drives. A joint with a heavy rotor keeps its speed, so it has a prescribed drive.
//! The remaining degrees of freedom become free drives at other joints.

use super::Model;
use crate::import::parts::{DrivePart, FRAME, PartPair};
use crate::import::write;
use crate::sentences;
use linkage::error::Result;
use linkage::input::Input;
use linkage::mechanism::{DrivenJoint, Structure};
use scenario::{Draft, StartRequest};
use std::path::Path;

/// Smallest inertia of a rotor that keeps its speed, divided by an estimate of the mechanism's moment of inertia.
/// The export writes rotors with a thousand times this inertia.
const HEAVY: f64 = 1e6;
/// Largest number of sets of free joints that are tried.
const MOST_CHOICES: usize = 500;

impl Model<'_> {
    /// Reads the prescribed drives, and chooses the joints of the free drives.
    pub(super) fn read_drives(&mut self) -> Result<()> {
        let size = self.parts.size();
        let inertia: f64 =
            self.parts.links.iter().filter_map(|link| link.mass).map(|own| own.inertia + own.mass * size * size).sum();
        let inertia = if inertia > 0.0 { inertia } else { size * size };
        let mut others = Vec::new();
        for at in 0..self.joints.len() {
            let own = &self.joints[at];
            let armature = self.file.number(own.node, "armature", 0.0)?;
            let least = HEAVY * if own.is_slide { inertia / (size * size) } else { inertia };
            if armature > least && own.rate != 0.0 {
                let joint = &self.parts.joints[own.number];
                let is_back = !own.is_slide && !joint.links.contains(&FRAME) && joint.links[0] == own.link;
                let speed = if is_back { -own.rate } else { own.rate };
                self.parts.drives.push(DrivePart {
                    joint: own.number,
                    speed,
                    turning: "rad_s",
                    travel: None,
                    free: None,
                });
            } else {
                others.push(at);
            }
        }
        let mobility = 3 * self.bodies.len() as i64 - 2 * self.parts.joints.len() as i64;
        let missing = usize::try_from(mobility - self.parts.drives.len() as i64).unwrap_or_default();
        let is_coupled = self.section("equality").any(|node| node.has_tag_name("tendon"));
        if missing > 0 && missing <= others.len() && !is_coupled {
            // Joints with a motor are tried first.
            // Other joints on the ground are tried next, because a crank is a link that a ground joint carries.
            others.sort_by_key(|&at| {
                (!self.has_motor(at), !self.parts.joints[self.joints[at].number].links.contains(&FRAME))
            });
            for at in self.free(&others, missing) {
                self.drive_freely(at)?;
            }
        }
        Ok(())
    }

    fn has_motor(&self, at: usize) -> bool {
        let name = self.joints[at].node.attribute("name").unwrap_or_default();
        let mut actuators = self.section("actuator").filter_map(|node| node.attribute("name"));
        actuators.any(|own| own.strip_prefix(name).is_some_and(|rest| rest.starts_with(".motor")))
    }

    /// The first set of `count` joints out of `from` that gives a valid structure together with the prescribed drives.
    fn free(&self, from: &[usize], count: usize) -> Vec<usize> {
        let text = write::text(&self.parts, "model", "", "");
        let Ok(draft) = Draft::parse(&text, Path::new("model"), &StartRequest::default()) else { return Vec::new() };
        let ids: Vec<_> = draft.mechanism.joints().ids().collect();
        let driven = |number: usize| -> Option<DrivenJoint> {
            let joint = &self.parts.joints[number];
            let input = match &joint.pair {
                PartPair::Slide { .. } => Input::Slide,
                PartPair::Pin(_) if joint.links.contains(&FRAME) => Input::Angle,
                PartPair::Pin(_) => Input::Turn,
            };
            Some(DrivenJoint { joint: *ids.get(number)?, input })
        };
        let given: Vec<DrivenJoint> = self.parts.drives.iter().filter_map(|drive| driven(drive.joint)).collect();
        let mut chosen: Vec<usize> = (0..count).collect();
        for _ in 0..MOST_CHOICES {
            let own = chosen.iter().filter_map(|&own| driven(self.joints[from[own]].number));
            let all: Vec<DrivenJoint> = given.iter().copied().chain(own).collect();
            if Structure::of(&draft.mechanism, &all).is_ok() {
                return chosen.iter().map(|&own| from[own]).collect();
            }
            // The next choice in lexicographic order.
            let Some(last) = (0..count).rev().find(|&k| chosen[k] < from.len() - count + k) else { break };
            let begin = chosen[last] + 1;
            (last..count).for_each(|k| chosen[k] = begin + k - last);
        }
        Vec::new()
    }

    fn drive_freely(&mut self, at: usize) -> Result<()> {
        let (number, link, own_rate, is_slide) =
            (self.joints[at].number, self.joints[at].link, self.joints[at].rate, self.joints[at].is_slide);
        let joint = &self.parts.joints[number];
        let base = if joint.links[0] == link { joint.links[1] } else { joint.links[0] };
        let of_drive =
            |link: usize| self.parts.drives.iter().any(|drive| self.parts.joints[drive.joint].links.contains(&link));
        // The input is the link's world angle if the joint is on the ground, or on a link of an earlier drive.
        let in_world = !is_slide && (base == FRAME || of_drive(base));
        let rate = match (in_world, joint.links[1] == link || is_slide) {
            (true, _) => self.omega(link),
            (false, true) => own_rate,
            (false, false) => -own_rate,
        };
        self.parts.told.push(sentences::the_joint_moves_freely(&joint.name));
        let motor = if base == FRAME && !is_slide { self.motor(at)? } else { None };
        let sense = motor.unwrap_or(if rate < 0.0 { -1.0 } else { 1.0 });
        let nominal = if rate.abs() >= 1.0 { rate.abs() } else { 1.0 };
        let free = Some((rate, in_world.then_some(link)));
        self.parts.drives.push(DrivePart {
            joint: number,
            speed: sense * nominal,
            turning: "rad_s",
            travel: None,
            free,
        });
        Ok(())
    }

    /// Angular velocity of a link at the start (rad/s).
    fn omega(&self, link: usize) -> f64 {
        let mut sum = 0.0;
        let mut at = link;
        while at != FRAME {
            let own = &self.joints[at - 1];
            sum += if own.is_slide { 0.0 } else { own.rate };
            at = self.bodies[at - 1].parent;
        }
        sum
    }

    /// Adds the motor of a joint. The law gives the torque on the crank, so the ratio is 1. Returns the sense of the
    /// torque at rest (+1 or -1), or `None` without a motor.
    fn motor(&mut self, at: usize) -> Result<Option<f64>> {
        let node = self.joints[at].node;
        let name = node.attribute("name").unwrap_or_default();
        let mut found = Vec::new();
        for own in self.section("actuator") {
            let kind = own.attribute("name").and_then(|own| own.strip_prefix(name)?.strip_prefix(".motor"));
            if let (Some(kind), Some(bias)) = (kind, self.file.numbers(own, "biasprm")?)
                && let [constant, _, slope] = bias[..]
            {
                found.push((kind.to_string(), constant, slope));
            }
        }
        let is =
            |kind: &str| found.iter().find(|(own, ..)| own == kind).map(|(_, constant, slope)| (*constant, *slope));
        let (constant, slope, efficiency) = match (is(""), is(".drives"), is(".brakes")) {
            (Some((constant, slope)), ..) => (constant, slope, 1.0),
            (None, Some(drives), Some(brakes)) => {
                let efficiency = (drives.0 / brakes.0).sqrt();
                (drives.0 / efficiency, drives.1 / efficiency, efficiency)
            }
            _ => return Ok(None),
        };
        let number = write::number;
        let mut keys: Vec<(String, String)> = vec![("ratio".into(), "1".into())];
        if slope == 0.0 {
            keys.push(("law".into(), write::quoted("constant")));
            keys.push(("torque_N_m".into(), number(constant.abs())));
        } else {
            keys.push(("law".into(), write::quoted("linear")));
            keys.push(("torque_at_rest_N_m".into(), number(constant.abs())));
            keys.push(("slope_N_m_s".into(), number(slope)));
        }
        if efficiency != 1.0 {
            keys.push(("efficiency".into(), number(efficiency)));
        }
        let rotor = self.file.number(node, "armature", 0.0)?;
        if rotor > 0.0 {
            keys.push(("rotor_inertia_kg_m2".into(), number(rotor)));
        }
        self.parts.tables.push(("[motor]", keys));
        Ok(Some(constant.signum()))
    }
}
