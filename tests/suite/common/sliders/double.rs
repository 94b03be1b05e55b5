//! Dyads with two prismatic joints.

use linkage::math::{Vec2, cross, rotated, turned, unit};
use linkage::mechanism::{AssemblyMode, LinkPose};

use super::{
    BLOCK_AXIS, BLOCK_PLACE, CRANK, Exact, GUIDE, PIN, SLIDER_AXIS, SPEED, Sample, TURN, along, case, crank, joint,
    link,
};

const YOKE_AXIS: f64 = 0.2;
const SLOT_AXIS: f64 = 1.4;
const YOKE_GUIDE: Vec2 = Vec2::new(0.1, 0.05);
const SLOT: Vec2 = Vec2::new(0.03, -0.02);

/// RPP: crank of 0.1 m, block on the crank pin.
/// The block slides in the oblique slot of a yoke, and the yoke slides on the ground.
///
/// The block's joint point Q = A + const stays on the slot.
/// With the slot's normal m this gives s = m . (Q - G - slot) / m . g.
/// The derivatives of s follow from those of A.
pub fn scotch_yoke() -> Sample {
    let links = vec![
        link("ground", &[("O", Vec2::zeros()), ("G", YOKE_GUIDE)], [0.0; 4]),
        crank(),
        link("block", &[("A", Vec2::zeros()), ("Q", BLOCK_PLACE)], [0.5, 0.01, 0.005, 1e-3]),
        link("yoke", &[("Y", Vec2::zeros()), ("D", SLOT), ("E", Vec2::new(0.1, 0.2))], [2.5, 0.05, 0.08, 0.03]),
    ];
    let joints = vec![
        joint("O", PIN, (0, Vec2::zeros()), (1, Vec2::zeros())),
        joint("A", PIN, (1, Vec2::new(CRANK, 0.0)), (2, Vec2::zeros())),
        joint("slot", along(SLOT_AXIS, BLOCK_AXIS), (3, SLOT), (2, BLOCK_PLACE)),
        joint("guide", along(GUIDE, YOKE_AXIS), (0, YOKE_GUIDE), (3, Vec2::zeros())),
    ];
    let exact = |crank: f64| {
        let yoke = GUIDE - YOKE_AXIS;
        let block = yoke + SLOT_AXIS - BLOCK_AXIS;
        let tip = unit(crank) * CRANK;
        let (m, g) = (turned(unit(yoke + SLOT_AXIS)), unit(GUIDE));
        let place = tip + rotated(unit(block), BLOCK_PLACE) - YOKE_GUIDE - rotated(unit(yoke), SLOT);
        let slide = [place, turned(tip) * SPEED, -tip * SPEED * SPEED].map(|v| m.dot(&v) / m.dot(&g));
        Exact { slide, angle: [block, 0.0, 0.0] }
    };
    let start = 0.7;
    let pose = vec![
        LinkPose::GROUND,
        LinkPose { origin: Vec2::zeros(), angle: start },
        LinkPose { origin: unit(start) * CRANK, angle: exact(start).angle[0] },
        LinkPose { origin: YOKE_GUIDE + unit(GUIDE) * exact(start).slide[0], angle: GUIDE - YOKE_AXIS },
    ];
    let case = case(links, joints, AssemblyMode::Only, start, start + TURN, pose);
    Sample { name: "Scotch yoke", case, exact, joint: "guide", link: "block" }
}

const LINE: Vec2 = Vec2::new(0.1, 0.15);
const CRANK_AXIS: f64 = 0.15;
const CRANK_PLACE: Vec2 = Vec2::new(0.05, 0.02);

/// PRP: block sliding on the crank, pinned to a slider on the ground.
///
/// The pin B = L + s g lies h beside the crank's axis e.
/// From n . (L + s g) = h follows s = (h - n . L) / n . g.
/// With n' = -w e, the derivatives of n . B = h are s' n . g = w e . B and s'' n . g = 2 w s' e . g + w^2 n . B.
pub fn slotted_crank() -> Sample {
    let links = vec![
        link("ground", &[("O", Vec2::zeros()), ("L", LINE)], [0.0; 4]),
        link("crank", &[("O", Vec2::zeros()), ("D", CRANK_PLACE), ("E", Vec2::new(0.3, 0.1))], [0.8, 0.1, 0.03, 8e-3]),
        link("block", &[("B", Vec2::zeros()), ("Q", BLOCK_PLACE)], [0.5, 0.01, 0.005, 1e-3]),
        link("slider", &[("B", Vec2::zeros()), ("F", Vec2::new(0.05, 0.03))], [2.5, 0.02, 0.03, 5e-3]),
    ];
    let joints = vec![
        joint("O", PIN, (0, Vec2::zeros()), (1, Vec2::zeros())),
        joint("slot", along(CRANK_AXIS, BLOCK_AXIS), (1, CRANK_PLACE), (2, BLOCK_PLACE)),
        joint("B", PIN, (2, Vec2::zeros()), (3, Vec2::zeros())),
        joint("guide", along(SLIDER_AXIS, GUIDE), (3, Vec2::zeros()), (0, LINE)),
    ];
    let exact = |crank: f64| {
        let (e, g) = (unit(crank + CRANK_AXIS), unit(GUIDE));
        let n = turned(e);
        let h = rotated(unit(-CRANK_AXIS), CRANK_PLACE).y - rotated(unit(-BLOCK_AXIS), BLOCK_PLACE).y;
        let s = (h - n.dot(&LINE)) / n.dot(&g);
        let pin = LINE + g * s;
        let speed = SPEED * e.dot(&pin) / n.dot(&g);
        let second = (2.0 * SPEED * speed * e.dot(&g) + SPEED * SPEED * n.dot(&pin)) / n.dot(&g);
        // The slide is measured from the slider, the joint's first link, to the ground.
        Exact { slide: [-s, -speed, -second], angle: [crank + CRANK_AXIS - BLOCK_AXIS, SPEED, 0.0] }
    };
    let start = 1.2;
    let pin = LINE - unit(GUIDE) * exact(start).slide[0];
    let pose = vec![
        LinkPose::GROUND,
        LinkPose { origin: Vec2::zeros(), angle: start },
        LinkPose { origin: pin, angle: exact(start).angle[0] },
        LinkPose { origin: pin, angle: GUIDE - SLIDER_AXIS },
    ];
    let case = case(links, joints, AssemblyMode::Only, start, 2.4, pose);
    Sample { name: "slotted crank", case, exact, joint: "guide", link: "block" }
}

const SHAFTS: Vec2 = Vec2::new(0.03, 0.04);
const DISC_AXIS: f64 = 0.8;
const OUTPUT_AXIS: f64 = -0.35;

/// RPP with rotation: an Oldham coupling.
/// The centre of the disc moves at twice the speed of the crank on a circle whose diameter is the distance of the
/// shafts.
/// The position of the centre is M = C/2 + |C|/2 unit(2 phi - arg C), and the slide on the crank is e . M = e . C.
pub fn oldham() -> Sample {
    let far = Vec2::new(0.0, 0.1);
    let links = vec![
        link("ground", &[("O", Vec2::zeros()), ("C", SHAFTS)], [0.0; 4]),
        link("crank", &[("O", Vec2::zeros()), ("E", Vec2::new(CRANK, 0.0))], [0.8, 0.03, 0.01, 2e-3]),
        link("disc", &[("M", Vec2::zeros()), ("F", far)], [1.5, 0.004, 0.006, 5e-3]),
        link("output", &[("C", Vec2::zeros()), ("H", far)], [1.0, 0.02, -0.01, 4e-3]),
    ];
    let joints = vec![
        joint("O", PIN, (0, Vec2::zeros()), (1, Vec2::zeros())),
        joint("slot", along(CRANK_AXIS, DISC_AXIS), (1, Vec2::zeros()), (2, Vec2::zeros())),
        joint("groove", along(OUTPUT_AXIS, DISC_AXIS + TURN / 4.0), (3, Vec2::zeros()), (2, Vec2::zeros())),
        joint("C", PIN, (3, Vec2::zeros()), (0, SHAFTS)),
    ];
    let exact = |crank: f64| {
        let e = unit(crank + CRANK_AXIS);
        let slide = [e.dot(&SHAFTS), cross(e, SHAFTS) * SPEED, -e.dot(&SHAFTS) * SPEED * SPEED];
        let disc = crank + CRANK_AXIS - DISC_AXIS;
        Exact { slide, angle: [disc + DISC_AXIS + TURN / 4.0 - OUTPUT_AXIS, SPEED, 0.0] }
    };
    let start = 0.7;
    let disc = unit(start + CRANK_AXIS) * exact(start).slide[0];
    let pose = vec![
        LinkPose::GROUND,
        LinkPose { origin: Vec2::zeros(), angle: start },
        LinkPose { origin: disc, angle: start + CRANK_AXIS - DISC_AXIS },
        LinkPose { origin: SHAFTS, angle: exact(start).angle[0] },
    ];
    let case = case(links, joints, AssemblyMode::Only, start, start + TURN, pose);
    Sample { name: "Oldham coupling", case, exact, joint: "slot", link: "output" }
}
