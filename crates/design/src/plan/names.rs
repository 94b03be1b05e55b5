//! Letters of the plans.
//! Points A and B get the letters a and b, the mass centre of link 2 gets s2, and the end of a normal part gets n1.
//! The pole has a reserved letter.

use linkage::math::Vec2;
use linkage::mechanism::{GROUND, Joint, JointSide, LinkId, Mechanism};

/// Name of the singular point of a group in drawings, and its letter in plans.
/// The letter S is not used, because S with a number is the name of a mass centre.
pub const SINGULAR: [&str; 2] = ["Σ", "σ"];

/// Name in the mechanism with its letter in the plans.
#[derive(Clone, Debug, PartialEq)]
pub struct Named {
    /// Name.
    pub name: String,
    /// Letter.
    pub letter: String,
}

/// Named point of the mechanism. A point of several links is listed once.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedPoint {
    /// Name and letter.
    pub named: Named,
    /// A link that contains the point, and the point's position on this link (m).
    /// A link on a ground pivot or in a fixed guide is preferred.
    pub side: JointSide,
    /// Whether the point belongs to the ground.
    pub fixed: bool,
}

/// Position on `link` of its revolute joint with the ground (m), and the name of this pivot.
pub fn pivot(mechanism: &Mechanism, link: LinkId) -> Option<(Vec2, String)> {
    let mut pins = mechanism.joints().iter().filter(|joint| joint.is_pin());
    let joint = pins.find(|joint| joint.on(link).is_some() && joint.other(link).link == GROUND)?;
    let (own, ground) = (joint.on(link)?, joint.other(link).local);
    let named = mechanism.links()[GROUND].points.iter().find(|point| point.local == ground);
    Some((own, named.map_or_else(|| joint.name.clone(), |point| point.name.clone())))
}

/// Prismatic joint that guides `link` on the ground.
pub fn fixed_guide(mechanism: &Mechanism, link: LinkId) -> Option<&Joint> {
    let mut sliding = mechanism.joints().iter().filter(|joint| joint.slides());
    sliding.find(|joint| joint.on(link).is_some() && joint.other(link).link == GROUND)
}

/// Returns all named points, those of the ground first, each with a unique letter.
pub fn places(mechanism: &Mechanism, poles: &[&str]) -> Vec<NamedPoint> {
    let mut taken: Vec<String> = poles.iter().map(ToString::to_string).collect();
    let mut named = |name: &str| {
        let letter = primed(name.to_lowercase(), |letter| taken.iter().any(|other| other == letter));
        taken.push(letter.clone());
        Named { name: name.into(), letter }
    };
    let fixed = mechanism.links()[GROUND].points.iter();
    let fixed = fixed.map(|point| (&point.name, JointSide { link: GROUND, local: point.local }));
    let mut all: Vec<_> = fixed.map(|(name, side)| NamedPoint { named: named(name), side, fixed: true }).collect();
    for (name, first) in mechanism.moving_points() {
        let carriers = mechanism.links().entries().skip(1).filter_map(|(link, body)| {
            body.points.iter().find(|point| point.name == name).map(|point| JointSide { link, local: point.local })
        });
        let led =
            |side: &JointSide| pivot(mechanism, side.link).is_some() || fixed_guide(mechanism, side.link).is_some();
        let side = carriers.into_iter().find(led).unwrap_or(first);
        all.push(NamedPoint { named: named(name), side, fixed: false });
    }
    all
}

/// Appends primes to `name` until the name is not `taken`.
pub fn primed(mut name: String, taken: impl Fn(&str) -> bool) -> String {
    while taken(&name) {
        name.push('\'');
    }
    name
}

/// Joins two names. Single letters give `BA`; longer names need a comma, as in `P3,P2`.
pub fn pair(a: &str, b: &str) -> String {
    let single = |name: &str| name.chars().count() == 1;
    if single(a) && single(b) { format!("{a}{b}") } else { format!("{a},{b}") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fixtures::{four_bar, link, mechanism};

    #[test]
    fn points_and_pole_have_distinct_letters() {
        let letters = |all: Vec<NamedPoint>| all.into_iter().map(|place| place.named.letter).collect::<Vec<_>>();
        assert_eq!(letters(places(&four_bar(), &["p"])), ["o", "c", "a", "b"]);
        let links = vec![
            link("ground", &[("O", 0.0, 0.0)]),
            link("crank", &[("O", 0.0, 0.0), ("P", 1.0, 0.0), ("p", 2.0, 0.0)]),
        ];
        let own = mechanism(links, &[("O", "O", "ground", "crank")]).unwrap();
        assert_eq!(letters(places(&own, &["p"])), ["o", "p'", "p''"]);
    }

    #[test]
    fn a_shared_point_belongs_to_the_link_hinged_to_the_ground() {
        let all = places(&four_bar(), &["p"]);
        assert_eq!(all.iter().map(|place| place.side.link.index()).collect::<Vec<_>>(), [0, 0, 1, 3]);
    }
}
