//! Friction up to self-locking.

use linkage::case::Case;
use linkage::drive::{Load, MotionLaw};
use linkage::error::Result;
use linkage::mechanism::{JointId, LinkId};

use crate::stress::{Setup, StressFamily};

/// Coefficient of friction in all contacts.
const COEFFICIENT: f64 = 0.1;

/// A wedge on a floor. A follower in a vertical guide drives the wedge by a shoe on the wedge's face.
/// Friction locks a wedge whose face is inclined to the floor by no more than a limiting angle.
/// The function makes a wedge whose face has (1 + 1 / `gain`) times the limiting angle.
/// The driving force is about `gain` times the driving force without friction.
fn wedge(gain: f64) -> Result<Setup> {
    let angle = 2.0 * COEFFICIENT.atan() * (1.0 + 1.0 / gain);
    let axis = std::f64::consts::PI - angle;
    let upright = std::f64::consts::FRAC_PI_2;
    let joints = [(0, [0, 1]), (1, [0, 2]), (2, [1, 3])];
    let mut builder = Case::builder()
        .ground(&[("F", [0.0, 0.0]), ("G", [0.3, 0.0])])
        .link("wedge", &[("W", [0.0, 0.0])])
        .link("follower", &[("P", [0.0, 0.0])])
        .link("shoe", &[("P", [0.0, 0.0])])
        .mass("wedge", 1.0, [0.0, 0.0], 1e-3)
        .mass("follower", 1.0, [0.0, 0.0], 1e-3)
        .mass("shoe", 0.1, [0.0, 0.0], 1e-4)
        .slider("floor", ("ground", "F"), ("wedge", "W"), [0.0, 0.0])
        .slider("guide", ("ground", "G"), ("follower", "P"), [upright, upright])
        .slider("face", ("wedge", "W"), ("shoe", "P"), [axis, 0.0])
        .pin("P", "shoe", "follower")
        .driven("guide", MotionLaw::Cycloidal { rise: 0.01, time: 1.0 })
        .load(Load::ResistingForce {
            at: linkage::mechanism::JointSide { link: LinkId(1), local: linkage::math::Vec2::zeros() },
            force: 100.0,
        })
        .times(&[0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8]);
    for (joint, links) in joints {
        let (joint, links) = (JointId(joint), links.map(LinkId));
        builder = builder.load(Load::Friction { joint, links, coefficient: COEFFICIENT, length: 0.0 });
    }
    Ok(Setup::usual(builder.build()?))
}

/// Family whose wedges approach self-locking.
pub(super) const FRICTION: StressFamily = StressFamily {
    name: "friction",
    dial: "angle at which friction locks the wedge, divided by the excess over this angle",
    title: "a wedge that is driven by its follower, up to 1e-4 of its self-locking angle",
    points: &[1.0, 10.0, 1e2, 1e3, 1e4],
    quick: &[1.0, 1e3],
    samples: 1,
    setup: |gain, _, _| wedge(gain),
};
