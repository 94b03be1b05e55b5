//! Reactions of the group by its singular Assur point.
//!
//! The force on a lead at its foot has a component across the lead and a component along the lead.
//! The moments on the lead about its head give the component across the lead, `N_n = -M_head / l`.
//! The forces along two leads pass through the intersection S of their lines, the singular Assur point.
//! The moments about S on the base link and these two leads contain one unknown: the force along the third lead.
//! The equilibrium of the base link and these two leads also gives the forces along the first two leads.
//! The equilibrium of each lead gives the reaction at its head.
//! Background: I. I. Artobolevsky, Theory of Mechanisms and Machines, 4th ed., Nauka 1988.
//! There are three Assur points, one for each pair of leads.
//! The method uses the pair of leads whose lines are nearest to perpendicular.
//! The Assur point of parallel leads is at infinity.

use super::{KnownResultant, Places, Reactions, singular};
use crate::sentences;
use linkage::error::Result;
use linkage::math::{Vec2, cross, turned};

/// The Assur point of two leads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AssurPoint {
    /// The two leads whose lines meet at the Assur point, then the third lead.
    pub leads: [usize; 3],
    /// World position of the Assur point (m); infinite or NaN if all leads are parallel.
    pub place: Vec2,
    /// Sine of the angle between the lines of the two leads, from 0 to 1.
    pub sine: f64,
}

/// Unit vectors from head to foot.
fn lines(places: &Places) -> [Vec2; 3] {
    [0, 1, 2].map(|k| (places.feet[k] - places.heads[k]).normalize())
}

/// The best conditioned of the three Assur points.
#[must_use]
pub fn best(places: &Places) -> AssurPoint {
    let along = lines(places);
    let [first, second, third] = [[0, 1, 2], [1, 2, 0], [2, 0, 1]].map(|leads| {
        let [i, j, _] = leads;
        let sine = cross(along[i], along[j]);
        let reach = cross(places.heads[j] - places.heads[i], along[j]) / sine;
        AssurPoint { leads, place: places.heads[i] + along[i] * reach, sine: sine.abs() }
    });
    let better = |a: AssurPoint, b: AssurPoint| if b.sine > a.sine { b } else { a };
    better(better(first, second), third)
}

/// Reactions (N) for the positions of the joints and the known forces on leads and base link.
///
/// # Errors
/// [`ErrorKind::Numeric`](linkage::ErrorKind::Numeric) at a dead point of the group.
pub fn reactions(places: &Places, known: &[KnownResultant; 4]) -> Result<Reactions> {
    let along = lines(places);
    let across = [0, 1, 2].map(|k| {
        let length = (places.feet[k] - places.heads[k]).norm();
        turned(along[k]) * (-known[k].about(places.heads[k]) / length)
    });
    let point = best(places);
    let ([i, j, k], pole) = (point.leads, point.place);
    // The base link and the leads i and j are treated as one body: the moments of all actions on this body are summed.
    // `third` is the force of lead k on the base link, without the unknown component along the lead.
    let third = across[k] + known[k].force;
    let with_two = |pole: Vec2| {
        let at_feet: f64 = [i, j].map(|lead| cross(places.feet[lead] - pole, across[lead])).iter().sum();
        let own: f64 = [i, j, 3].map(|link| known[link].about(pole)).iter().sum();
        at_feet + own + cross(places.heads[k] - pole, third)
    };
    let axial_k = -with_two(pole) / cross(places.heads[k] - pole, along[k]);
    let rest = across[i] + across[j] + known[i].force + known[j].force + known[3].force + third + along[k] * axial_k;
    let sine = cross(along[i], along[j]);
    let mut feet = across;
    feet[i] += along[i] * (-cross(rest, along[j]) / sine);
    feet[j] += along[j] * (-cross(along[i], rest) / sine);
    feet[k] += along[k] * axial_k;
    let heads = [0, 1, 2].map(|lead| feet[lead] + known[lead].force);
    let finite = feet.iter().chain(&heads).all(|force| force.x.is_finite() && force.y.is_finite());
    if finite { Ok(Reactions { feet, heads }) } else { Err(singular(sentences::SINGULAR_ASSUR_POINT)) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use linkage::ErrorKind;

    fn known(force: Vec2, at: Vec2) -> KnownResultant {
        KnownResultant { force, moment: 0.0, at }
    }

    /// A beam of length 2 on two vertical leads and one horizontal lead at its left end. The forces were calculated by
    /// hand.
    fn beam() -> Places {
        let at = Vec2::new;
        Places {
            feet: [at(0.0, -1.0), at(2.0, -1.0), at(-1.0, 0.0)],
            heads: [at(0.0, 0.0), at(2.0, 0.0), at(0.0, 0.0)],
        }
    }

    #[test]
    fn a_beam_on_two_parallel_leads_is_carried_by_the_law_of_the_lever() {
        let rest = known(Vec2::zeros(), Vec2::zeros());
        let load = known(Vec2::new(3.0, -8.0), Vec2::new(0.5, 0.0));
        let found = reactions(&beam(), &[rest, rest, rest, load]).unwrap();
        let expected = [Vec2::new(0.0, 6.0), Vec2::new(0.0, 2.0), Vec2::new(-3.0, 0.0)];
        // The tolerance allows for the rounding errors of a few operations on numbers below ten.
        let near = |found: [Vec2; 3]| found.iter().zip(expected).all(|(own, known)| (own - known).norm() < 1e-14);
        assert!(near(found.feet) && near(found.heads), "{found:?}");
        assert_eq!(best(&beam()).sine, 1.0);
    }

    #[test]
    fn a_load_on_a_lead_is_shared_by_its_foot_and_its_head() {
        let rest = known(Vec2::zeros(), Vec2::zeros());
        let side = known(Vec2::new(4.0, 0.0), Vec2::new(2.0, -0.25));
        let found = reactions(&beam(), &[rest, side, rest, rest]).unwrap();
        assert!((found.feet[1] - Vec2::new(-1.0, 0.0)).norm() < 1e-14, "{:?}", found.feet);
        assert!((found.heads[1] - Vec2::new(3.0, 0.0)).norm() < 1e-14, "{:?}", found.heads);
        assert!((found.feet[2] - Vec2::new(-3.0, 0.0)).norm() < 1e-14, "{:?}", found.feet);
    }

    #[test]
    fn concurrent_or_parallel_leads_are_an_error() {
        let load = known(Vec2::new(1.0, 2.0), Vec2::new(0.25, 0.25));
        let mut places = beam();
        places.heads[1] = Vec2::new(0.0, 0.0);
        for places in [places, Places { feet: places.heads.map(|at| at - Vec2::new(0.0, 1.0)), ..beam() }] {
            assert_eq!(reactions(&places, &[load; 4]).unwrap_err().kind(), ErrorKind::Numeric);
        }
    }
}
