//! Loads of another amount.

use super::{Acts, Load};
use crate::drive::Course;

impl Load {
    /// Loads that together act as this one times `factor`: none for 0; a negative factor turns the load round.
    /// Of a spring or damper the stiffness or damping is multiplied, not its free length or angle.
    /// `None` where no loads act so: a resisting force cannot drive.
    #[must_use]
    pub fn times(&self, factor: f64) -> Option<Vec<Load>> {
        if factor == 0.0 {
            return Some(Vec::new());
        }
        let one = match self.clone() {
            Load::Resistance { link, moment } if factor < 0.0 => {
                // What resists, turned round, drives: a moment for either sense.
                let acting = |acts, moment| Load::Moment { link, moment: Course::Constant(moment), acts };
                let size = -factor * moment;
                return Some(vec![acting(Acts::CounterClockwise, size), acting(Acts::Clockwise, -size)]);
            }
            Load::ResistingForce { .. } if factor < 0.0 => return None,
            Load::Resistance { link, moment } => Load::Resistance { link, moment: factor * moment },
            Load::ResistingForce { at, force } => Load::ResistingForce { at, force: factor * force },
            Load::Moment { link, moment, acts } => Load::Moment { link, moment: moment.times(factor), acts },
            Load::Force { at, force, follows } => {
                Load::Force { at, force: force.map(|course| course.times(factor)), follows }
            }
            Load::Spring { ends, stiffness, free_length } => {
                Load::Spring { ends, stiffness: factor * stiffness, free_length }
            }
            Load::Damper { ends, damping } => Load::Damper { ends, damping: factor * damping },
            Load::TorsionSpring { links, stiffness, free_angle } => {
                Load::TorsionSpring { links, stiffness: factor * stiffness, free_angle }
            }
            Load::TorsionDamper { links, damping } => Load::TorsionDamper { links, damping: factor * damping },
        };
        Some(vec![one])
    }
}
