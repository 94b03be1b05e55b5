//! Changes loads: puts a load on different links, moves a load's points or multiplies a load by a factor.

use super::{Acts, Load, LoadPart, LoadRole, On};
use crate::drive::Course;
use crate::math::Vec2;
use crate::mechanism::{JointId, JointSide, LinkId};

impl Load {
    /// Numbers of the one or two links on which the load acts. A load that depends on a motion depends on the motion of
    /// these links.
    #[must_use]
    pub fn links(&self) -> Vec<LinkId> {
        match self.nature().on {
            On::Link(link) => vec![link],
            On::Point(at) => vec![at.link],
            On::Points(ends) => ends.map(|end| end.link).to_vec(),
            On::Links(links) | On::Joint(_, links) => links.to_vec(),
        }
    }

    /// Points at which the load acts; empty for a moment.
    #[must_use]
    pub fn points(&self) -> Vec<JointSide> {
        match self.nature().on {
            On::Point(at) => vec![at],
            On::Points(ends) => ends.to_vec(),
            On::Link(_) | On::Links(_) | On::Joint(..) => Vec::new(),
        }
    }

    /// Returns this load in a mechanism with new numbers of links and joints.
    #[must_use]
    pub fn renumbered(&self, number: impl Fn(LinkId) -> LinkId, of_joint: impl Fn(JointId) -> JointId) -> Load {
        let mut load = self.clone();
        if let Load::Friction { joint, .. }
        | Load::SlideForce { joint, .. }
        | Load::SlideSpring { joint, .. }
        | Load::SlideDamper { joint, .. } = &mut load
        {
            *joint = of_joint(*joint);
        }
        for part in load.parts() {
            match part {
                LoadPart::Link(link) | LoadPart::Point(JointSide { link, .. }) => *link = number(*link),
                LoadPart::Number { .. } | LoadPart::Courses { .. } | LoadPart::Acts(_) | LoadPart::Follows(_) => {}
            }
        }
        load
    }

    /// Moves the point with the index `number` in [`Load::points`] to the position `local` on its link (m).
    pub fn put_point(&mut self, number: usize, local: Vec2) {
        let mut points = self.parts().into_iter().filter_map(|part| match part {
            LoadPart::Point(side) => Some(side),
            LoadPart::Link(_)
            | LoadPart::Number { .. }
            | LoadPart::Courses { .. }
            | LoadPart::Acts(_)
            | LoadPart::Follows(_) => None,
        });
        if let Some(side) = points.nth(number) {
            side.local = local;
        }
    }

    /// Free length, free slide or free angle, with its unit (m or rad); `None` for a load that has no free length,
    /// slide or angle.
    pub fn rest(&mut self) -> Option<(&mut f64, &'static str)> {
        self.parts().into_iter().find_map(|part| match part {
            LoadPart::Number { role: LoadRole::Rest { unit }, name: _, value } => Some((value, unit)),
            LoadPart::Number { .. } | LoadPart::Courses { .. } => None,
            LoadPart::Link(_) | LoadPart::Point(_) | LoadPart::Acts(_) | LoadPart::Follows(_) => None,
        })
    }

    /// Whether all numbers are valid: finite, and not negative where negative numbers are excluded.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        self.clone().parts().into_iter().all(|part| match part {
            LoadPart::Point(side) => side.local.iter().all(|value| value.is_finite()),
            LoadPart::Number { role, name: _, value } => {
                value.is_finite() && (!matches!(role, LoadRole::Size | LoadRole::Extent) || *value >= 0.0)
            }
            LoadPart::Courses { name: _, values } => values.iter().all(Course::is_sound),
            LoadPart::Link(_) | LoadPart::Acts(_) | LoadPart::Follows(_) => true,
        })
    }

    /// Loads that together equal this load multiplied by `factor`.
    /// For the factor 0 the list is empty. A negative factor reverses the load.
    /// In a spring or damper the factor multiplies the stiffness or damping, but not the free length or angle.
    /// `None` if no combination of loads has this effect.
    /// For example, a reversed resisting force would drive its point, and no load acts in this way.
    #[must_use]
    pub fn times(&self, factor: f64) -> Option<Vec<Load>> {
        if factor == 0.0 {
            return Some(Vec::new());
        }
        if let (&Load::Resistance { link, moment }, true) = (self, factor < 0.0) {
            // A reversed resistance drives its link. Two moments replace the reversed resistance, one for each sense of
            // rotation.
            let acting = |acts, moment| Load::Moment { link, moment: Course::Constant(moment), acts };
            let size = -factor * moment;
            return Some(vec![acting(Acts::CounterClockwise, size), acting(Acts::Clockwise, -size)]);
        }
        let mut load = self.clone();
        for part in load.parts() {
            match part {
                LoadPart::Number { role: LoadRole::Size, .. } if factor < 0.0 => return None,
                LoadPart::Number { role: LoadRole::Size | LoadRole::Amount, name: _, value } => *value *= factor,
                LoadPart::Courses { name: _, values } => values.iter_mut().for_each(|own| *own = own.times(factor)),
                LoadPart::Number { role: LoadRole::Rest { .. } | LoadRole::Extent, .. } => {}
                LoadPart::Link(_) | LoadPart::Point(_) | LoadPart::Acts(_) | LoadPart::Follows(_) => {}
            }
        }
        Some(vec![load])
    }
}
