//! Random mechanisms with a higher group, alone or together with dyads.
//! Some of the groups have prismatic joints.

use linkage::math::Vec2;

use super::random::{SORTS, dyad, sort};
use super::sketch::{DrawnJoint, RandomSource, SpecimenSketch};
use super::spec::{Ask, Spec, Start};

/// End of a joint: on a link of the group, on the crank or on the ground.
#[derive(Clone, Copy, Debug)]
pub enum End {
    Own(usize),
    Crank,
    Ground,
}
use End::{Crank, Ground, Own};

/// A group: number of links, class and joints.
/// In the list of joints, the outer joint of each lead comes directly before the inner joint of this lead.
#[derive(Debug)]
pub struct Topology {
    pub name: &'static str,
    pub links: usize,
    pub class: usize,
    pub joints: &'static [[End; 2]],
}

/// Class III, order 3: base 0 on the leads 1, 2, 3.
pub const CLASS_3: Topology = Topology {
    name: "class III of order 3",
    links: 4,
    class: 3,
    joints: &[
        [Crank, Own(1)],
        [Own(1), Own(0)],
        [Ground, Own(2)],
        [Own(2), Own(0)],
        [Ground, Own(3)],
        [Own(3), Own(0)],
    ],
};

/// Class IV, order 2: a quadrilateral 0-1-2-3 whose links 0 and 2 are ternary.
pub const CLASS_4: Topology = Topology {
    name: "class IV of order 2",
    links: 4,
    class: 4,
    joints: &[
        [Crank, Own(0)],
        [Own(0), Own(1)],
        [Own(1), Own(2)],
        [Own(2), Own(3)],
        [Own(3), Own(0)],
        [Ground, Own(2)],
    ],
};

/// Class III, order 4: two bases 0 and 1, joined to each other, with two leads each.
pub const CLASS_3_ORDER_4: Topology = Topology {
    name: "class III of order 4",
    links: 6,
    class: 3,
    joints: &[
        [Crank, Own(2)],
        [Own(2), Own(0)],
        [Ground, Own(3)],
        [Own(3), Own(0)],
        [Own(0), Own(1)],
        [Ground, Own(4)],
        [Own(4), Own(1)],
        [Ground, Own(5)],
        [Own(5), Own(1)],
    ],
};

/// Class IV, order 3: a quadrilateral 0-1-2-3. Link 0 is joined to the crank, links 1 and 2 to the leads 4 and 5.
pub const CLASS_4_ORDER_3: Topology = Topology {
    name: "class IV of order 3",
    links: 6,
    class: 4,
    joints: &[
        [Crank, Own(0)],
        [Own(0), Own(1)],
        [Own(1), Own(2)],
        [Own(2), Own(3)],
        [Own(3), Own(0)],
        [Ground, Own(4)],
        [Own(4), Own(1)],
        [Ground, Own(5)],
        [Own(5), Own(2)],
    ],
};

/// A group, and the choice of its joints that are prismatic.
#[derive(Debug)]
pub struct Family {
    pub topology: &'static Topology,
    pub slides: &'static [usize],
}

/// Every kind of higher group that is tested.
pub const FAMILIES: [Family; 18] = {
    const fn of(topology: &'static Topology, slides: &'static [usize]) -> Family {
        Family { topology, slides }
    }
    [
        of(&CLASS_3, &[]),
        // A slider lead has a prismatic outer joint, a swivel lead a prismatic inner joint. In this order:
        // One slider lead, on the crank or on the ground; one swivel lead, on the crank or on the ground.
        // Two slider leads, or a swivel lead and a slider lead; three slider leads; three swivel leads.
        // A lead on the ground with two prismatic joints, which prevents rotation of the base.
        of(&CLASS_3, &[0]),
        of(&CLASS_3, &[2]),
        of(&CLASS_3, &[1]),
        of(&CLASS_3, &[3]),
        of(&CLASS_3, &[2, 4]),
        of(&CLASS_3, &[1, 2]),
        of(&CLASS_3, &[0, 2, 4]),
        of(&CLASS_3, &[1, 3, 5]),
        of(&CLASS_3, &[2, 3]),
        of(&CLASS_4, &[]),
        of(&CLASS_4, &[0]),
        of(&CLASS_4, &[1]),
        of(&CLASS_4, &[4]),
        of(&CLASS_3_ORDER_4, &[]),
        of(&CLASS_3_ORDER_4, &[2, 4]),
        of(&CLASS_4_ORDER_3, &[]),
        of(&CLASS_4_ORDER_3, &[3, 5]),
    ]
};

/// Surroundings of the group.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Among {
    Alone,
    /// The group is joined to the second link of a dyad instead of the crank.
    BehindADyad,
    /// A dyad of any kind joins two links of the group, or one link of the group and the ground.
    CarryingADyad,
}

/// Largest distance between the approximate and the true positions (m).
const ROUGH: f64 = 0.01;

/// A mechanism with a group of this family.
/// Approximate positions of the group's joints define the start of the mechanism.
pub fn mechanism(
    random: &mut RandomSource,
    family: &Family,
    among: Among,
) -> (Spec, Vec<linkage::mechanism::LinkPose>) {
    let mut sketch = SpecimenSketch::new(random, [0.02, 0.05]);
    sketch.spec.grid = (sketch.spec.start - 0.25, 0.05, 10);
    let mut driver = 1;
    if among == Among::BehindADyad {
        let slides = sort(sketch.random, &SORTS);
        driver = dyad(&mut sketch, slides, [1, 0])[1];
    }
    let own = links(&mut sketch, family, driver);
    if among == Among::CarryingADyad {
        let slides = sort(sketch.random, &SORTS);
        let [a, b] = [own[sketch.random.index(2)], own[2 + sketch.random.index(2)]];
        let other = if sketch.random.yes() { b } else { 0 };
        dyad(&mut sketch, slides, [a, other]);
    }
    sketch.finish()
}

/// Draws the group, joined to `driver`, and states how it starts.
fn links(sketch: &mut SpecimenSketch, family: &Family, driver: usize) -> Vec<usize> {
    let place =
        |sketch: &mut SpecimenSketch| Vec2::new(sketch.random.number(-0.5, 0.5), sketch.random.number(-0.5, 0.5));
    let mut own = Vec::new();
    for _ in 0..family.topology.links {
        let at = place(sketch);
        own.push(sketch.link(at));
    }
    let index = |end: End| match end {
        Own(link) => own[link],
        Crank => driver,
        Ground => 0,
    };
    let mut near = Vec::new();
    for (k, &[a, b]) in family.topology.joints.iter().enumerate() {
        let is_on_crank = matches!(a, Crank) && driver == 1;
        let at = if is_on_crank { sketch.crank_end() } else { place(sketch) };
        let slides = family.slides.contains(&k);
        let name = sketch.next_joint();
        let DrawnJoint { places, .. } = sketch.join(slides, index(a), index(b), at);
        for ((end, place), side) in [a, b].into_iter().zip(places).zip(["A", "B"]) {
            if matches!(end, Own(_)) && (slides || side == "B") {
                let point = if slides { format!("{side}{name}") } else { name.clone() };
                near.push((point, place + sketch.random.vector(0.0, ROUGH)));
            }
        }
    }
    let links = own.iter().map(|&link| sketch.name(link)).collect();
    sketch.spec.starts.push(Start { links, ask: Ask::Near(near) });
    own
}
