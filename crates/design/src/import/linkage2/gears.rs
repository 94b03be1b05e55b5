//! Gears and chains.

use super::build::Builder;
use crate::import::parts::{FRAME, PartPair};
use crate::import::write::{degrees, number, quoted};
use crate::sentences;
use linkage::error::Result;

impl Builder<'_> {
    /// Adds the transmissions.
    pub(super) fn gears(&mut self) -> Result<()> {
        for index in 0..self.elements.ratios.len() {
            let ratio = &self.elements.ratios[index];
            let line = self.file.line(ratio.node);
            let wheel = |id: &str| {
                let at = self.elements.links.iter().position(|link| link.id == id)?;
                Some((self.bodies[at]?, *self.elements.links[at].connectors.first()?))
            };
            let [(first, one), (second, two)] = &ratio.wheels[..] else {
                return Err(self.file.wrong(ratio.node, sentences::THE_RATIO_NEEDS_TWO_WHEELS.into()));
            };
            let found = wheel(first).zip(wheel(second));
            let carrier = |axles: [usize; 2]| {
                let [a, b] = axles.map(|axle| &self.members[axle]);
                let wheels = found.map(|((first, _), (second, _))| [first, second]);
                let is_wheel = |link: usize| wheels.is_some_and(|own| own.contains(&link));
                a.iter().copied().find(|link| b.contains(link) && !is_wheel(*link))
            };
            let Some((((first, a), (second, b)), carrier)) =
                found.and_then(|own| Some((own, carrier([own.0.1, own.1.1])?)))
            else {
                self.parts.told.push(sentences::the_wheels_have_no_carrier(&line));
                continue;
            };
            let joint = self.parts.joints.iter().position(|joint| {
                joint.links.contains(&carrier)
                    && joint.links.contains(&second)
                    && matches!(joint.pair, PartPair::Pin(_))
            });
            let Some(joint) = joint else {
                self.parts.told.push(sentences::the_wheels_have_no_carrier(&line));
                continue;
            };
            let own = &self.parts.joints[joint];
            let [from, to] = own.links.map(|link| self.parts.links[link].pose.angle);
            let name = |link: usize| quoted(&self.parts.links[link].name);
            let mut keys: Vec<(String, String)> = vec![
                ("name".into(), quoted(&format!("ratio_{}", index + 1))),
                ("type".into(), quoted(if ratio.is_chain { "belt" } else { "gears" })),
                ("links".into(), format!("[{}, {}]", name(first), name(second))),
            ];
            if carrier != FRAME {
                keys.push(("carrier".into(), name(carrier)));
            }
            if ratio.is_chain {
                // If the file gives no radii, any radii with the right ratio give the same motion.
                let apart = (self.elements.connectors[a].place - self.elements.connectors[b].place).norm();
                let scale = if ratio.has_radii { 1.0 } else { apart / (4.0 * (one + two)) };
                let radii = [one, two].map(|size| number(size * scale)).join(", ");
                keys.push((format!("radii_{}", self.parts.units.length), format!("[{radii}]")));
            } else {
                keys.push(("teeth".into(), format!("[{}, {}]", number(*one), number(*two))));
            }
            keys.push(("start_joint".into(), quoted(&own.name)));
            keys.push(("start_deg".into(), degrees(to - from)));
            self.parts.tables.push(("[[transmissions]]", keys));
        }
        Ok(())
    }
}
