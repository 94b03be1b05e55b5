//! Reactions of the group from all its equations of equilibrium at once.
//!
//! There are twelve unknowns: x and y of the forces at the three feet and the three heads.
//! Each of the four links has three equations: forces along x, forces along y, and moments.
//! The moments on a lead are taken about the lead's head, the moments on the base link about the first head.
//! All moments are divided by a length, so that all rows have the unit of force.
//! All links are solved together, without any order.

use super::{KnownResultant, Places, Reactions, singular};
use crate::sentences;
use linkage::error::Result;
use linkage::math::dense::Lu;
use linkage::math::{KeepNan, Vec2, cross};

/// Reactions (N) for the positions of the joints and the known forces on leads and base link.
///
/// # Errors
/// [`ErrorKind::Numeric`](linkage::ErrorKind::Numeric) at a dead point of the group.
pub fn reactions(places: &Places, known: &[KnownResultant; 4]) -> Result<Reactions> {
    let mut system = System { matrix: Lu::new(12), right: [0.0; 12] };
    let Places { feet, heads } = places;
    for lead in 0..3 {
        let length = (feet[lead] - heads[lead]).norm();
        system.known(lead, &known[lead], heads[lead], length);
        system.force(lead, lead, 1.0, (feet[lead] - heads[lead]) / length);
        system.force(lead, 3 + lead, -1.0, Vec2::zeros());
    }
    let length = (heads[1] - heads[0]).norm().larger((heads[2] - heads[0]).norm());
    system.known(3, &known[3], heads[0], length);
    for lead in 0..3 {
        system.force(3, 3 + lead, 1.0, (heads[lead] - heads[0]) / length);
    }
    if !system.matrix.factor() {
        return Err(singular(sentences::LINEAR_SYSTEM_OF_THE_GROUP));
    }
    system.matrix.solve(&mut system.right);
    let force = |unknown: usize| Vec2::new(system.right[2 * unknown], system.right[2 * unknown + 1]);
    if !system.right.iter().all(|value| value.is_finite()) {
        return Err(singular(sentences::LINEAR_SYSTEM_OF_THE_GROUP));
    }
    Ok(Reactions { feet: [0, 1, 2].map(force), heads: [3, 4, 5].map(force) })
}

struct System {
    matrix: Lu,
    right: [f64; 12],
}

impl System {
    /// Adds the known forces on a link to the right-hand side.
    fn known(&mut self, link: usize, known: &KnownResultant, pole: Vec2, length: f64) {
        let values = [known.force.x, known.force.y, known.about(pole) / length];
        (0..3).for_each(|row| self.right[3 * link + row] = -values[row]);
    }

    /// Adds `sign` times the force number `unknown` to the equations of a link.
    /// `arm` is the vector from the link's pole to the point of application of the force, divided by the length by
    /// which the moments of the link are divided.
    fn force(&mut self, link: usize, unknown: usize, sign: f64, arm: Vec2) {
        for (column, axis) in [(2 * unknown, Vec2::new(sign, 0.0)), (2 * unknown + 1, Vec2::new(0.0, sign))] {
            for (row, value) in [axis.x, axis.y, cross(arm, axis)].into_iter().enumerate() {
                self.matrix.add(3 * link + row, column, value);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forces_and_moments_balance_on_every_link() {
        let at = Vec2::new;
        let places = Places {
            feet: [at(0.0, -1.0), at(2.5, -1.0), at(-1.0, 0.5)],
            heads: [at(0.0, 0.0), at(2.0, 0.0), at(0.0, 1.0)],
        };
        let known =
            [1.0, -2.0, 0.5, 4.0].map(|x| KnownResultant { force: at(x, 1.0 - x), moment: 0.3 * x, at: at(x, x * x) });
        let Reactions { feet, heads } = reactions(&places, &known).unwrap();
        for k in 0..3 {
            let moment = known[k].about(places.heads[k]) + cross(places.feet[k] - places.heads[k], feet[k]);
            // The tolerance allows for the rounding errors of forces of a few tens of newtons in a well-shaped group.
            assert!((feet[k] + known[k].force - heads[k]).norm() < 1e-13 && moment.abs() < 1e-13);
        }
        let pole = at(7.0, -3.0);
        let moment: f64 = (0..3).map(|k| cross(places.heads[k] - pole, heads[k])).sum::<f64>() + known[3].about(pole);
        assert!((heads.iter().sum::<Vec2>() + known[3].force).norm() < 1e-13 && moment.abs() < 1e-12, "{moment}");
    }
}
