//! Constants, computed once, of a case that consists of driving links, RRR dyads and higher groups on pins.

use super::bodies::{Action, Body, Reader};
use super::chains::Chain;
use super::loads::OF_LOAD;
use super::poses::Layout;
use crate::assur::groups::{SolutionPlan, Step};
use linkage::case::Case;
use linkage::drive::Load;
use linkage::input::Input;
use linkage::math::Vec2;
use linkage::mechanism::{AssemblyMode, DrivingLink, GROUND, Group, GroupKind, Mechanism};

/// Number of columns of a dyad in the working memory: two for its span r1, two for r2, one for r1 x r2, one for the
/// inverse of this product, and two for the position of the inner joint.
pub(super) const OF_DYAD: usize = 8;
/// First of the two columns of a dyad for the position of the inner joint.
pub(super) const POLE: usize = 6;

/// A driving link, which turns about a joint on the ground.
#[derive(Clone, Debug)]
pub(super) struct Driver {
    pub(super) ground: Vec2,
    pub(super) body: Body,
    /// Action of the joint on the ground.
    pub(super) reaction: Action,
}

/// One link of a dyad.
#[derive(Clone, Debug)]
pub(super) struct Arm {
    /// First column of the link at the other side of the outer joint (`None` for the ground), and the position of this
    /// joint on that link.
    pub(super) base: (Option<usize>, Vec2),
    /// Vector from outer to inner joint in the link's frame, divided by the square of its length (1/m).
    pub(super) inverse_span: Vec2,
    pub(super) squared: f64,
    pub(super) body: Body,
    /// Action of the outer joint on the link.
    pub(super) reaction: Action,
}

/// RRR dyad.
#[derive(Clone, Debug)]
pub(super) struct Dyad {
    pub(super) arms: [Arm; 2],
    /// Limits of d^2, where d is the distance between the outer joints: (l1 - l2)^2 and (l1 + l2)^2 (m^2).
    pub(super) range: [f64; 2],
    /// l1 l2 (m^2).
    pub(super) product: f64,
    /// One half, with the sign that the dyad's determinant has on the branch.
    pub(super) half: f64,
    /// Action of the inner joint on the first link.
    pub(super) inner: Action,
}

/// An Assur group.
#[derive(Clone, Debug)]
#[expect(clippy::large_enum_variant, reason = "groups are few, and each is read in every pose")]
pub(super) enum Part {
    Dyad(Dyad),
    Chain(Chain),
}

/// A case of driving links, RRR dyads and higher groups on pins.
#[derive(Clone, Debug)]
pub(super) struct Groups {
    pub(super) layout: Layout,
    pub(super) gravity: Vec2,
    pub(super) drivers: Vec<Driver>,
    /// Every group and its first column in the working memory. The columns before the first group are for the known
    /// forces on the links of one group.
    pub(super) parts: Vec<(Part, usize)>,
    /// Number of columns of the working memory.
    pub(super) columns: usize,
    /// Whether a link has a moment of resistance.
    pub(super) is_resisted: bool,
}

impl Groups {
    /// Returns the constants of a case. The plan must already have placed the start pose of the case.
    /// Returns `None` for a case that the caller must solve pose by pose. A case that must be solved pose by pose has
    /// at least one of the following:
    /// - a group that is neither an RRR dyad nor a higher group on pins with four or six links,
    /// - a transmission,
    /// - a driving link that is not a crank on the ground,
    /// - several drives, one of them with a varying speed,
    /// - a load that is not a moment of resistance.
    pub(super) fn of(case: &Case, plan: &SolutionPlan, layout: Layout) -> Option<Self> {
        let groups = &case.structure.groups;
        let simple = |load: &Load| load.resistance().is_some();
        let hinged = |driver: &DrivingLink| {
            driver.input == Input::Angle && case.mechanism.joints()[driver.joint].other(driver.link).link == GROUND
        };
        let is_plain = !case.goes_by_time() && case.mechanism.transmissions().is_empty();
        if !(is_plain && case.loads.iter().all(simple) && case.structure.drivers.iter().all(hinged)) {
            return None;
        }
        let mut settled = vec![false; case.mechanism.joints().len()];
        let mut parts = Vec::with_capacity(groups.len());
        for ((index, group), &mode) in groups.entries().zip(&case.modes).rev() {
            let reader = Reader { case, layout, settled: &settled };
            parts.push(match (&plan.steps()[index], group.kind) {
                (Step::Chain(chain), _) => Part::Chain(Chain::of(&reader, chain)?),
                (_, GroupKind::Rrr) => Part::Dyad(reader.dyad(group, mode)),
                (
                    _,
                    GroupKind::Rrp
                    | GroupKind::Rpr
                    | GroupKind::Rpp
                    | GroupKind::Prp
                    | GroupKind::Higher
                    | GroupKind::Driven,
                ) => {
                    return None;
                }
            });
            group.inner.iter().chain(&group.outer).for_each(|&joint| settled[joint] = true);
        }
        // The working memory begins with the known forces on the links of one group.
        let mut columns = OF_LOAD * case.structure.groups.iter().map(|group| group.links.len()).fold(1, usize::max);
        let place = |part: Part| {
            let first = columns;
            columns += match &part {
                Part::Dyad(_) => OF_DYAD,
                Part::Chain(chain) => chain.columns(),
            };
            (part, first)
        };
        let parts = parts.into_iter().rev().map(place).collect();
        let reader = Reader { case, layout, settled: &settled };
        let driver = |own: &DrivingLink| Driver {
            ground: case.mechanism.joints()[own.joint].other(own.link).local,
            body: reader.body(own.link),
            reaction: reader.action(own.joint, own.link),
        };
        let drivers = case.structure.drivers.iter().map(driver).collect();
        Some(Groups { layout, gravity: case.gravity, drivers, parts, columns, is_resisted: !case.loads.is_empty() })
    }

    /// Reads coordinates, masses and moments of inertia from the mechanism, whose structure is unchanged.
    pub(super) fn renumber(&mut self, mechanism: &Mechanism) {
        for driver in &mut self.drivers {
            driver.ground = driver.reaction.renumber(mechanism);
            driver.body.renumber(mechanism);
        }
        for (part, _) in &mut self.parts {
            match part {
                Part::Dyad(dyad) => dyad.renumber(mechanism),
                Part::Chain(_) => unreachable!("a case with a higher group is not renumbered"),
            }
        }
    }

    /// The driving links and the links of the dyads.
    #[inline(always)]
    pub(super) fn bodies(&self) -> impl Iterator<Item = &Body> {
        let of_dyads = self.parts.iter().filter_map(|(part, _)| match part {
            Part::Dyad(dyad) => Some(&dyad.arms),
            Part::Chain(_) => None,
        });
        self.drivers.iter().map(|driver| &driver.body).chain(of_dyads.flatten().map(|arm| &arm.body))
    }

    /// The higher groups and their first columns in the working memory.
    pub(super) fn chains(&self) -> impl Iterator<Item = (&Chain, usize)> {
        self.parts.iter().filter_map(|(part, first)| match part {
            Part::Chain(chain) => Some((chain, *first)),
            Part::Dyad(_) => None,
        })
    }
}

impl Reader<'_> {
    fn dyad(&self, group: &Group, mode: AssemblyMode) -> Dyad {
        let arm = |k: usize| {
            let (link, joint) = (group.links[k], group.outer[k]);
            let base = (self.base(joint, link), Vec2::zeros());
            let (body, reaction) = (self.body(link), self.action(joint, link));
            Arm { base, inverse_span: Vec2::zeros(), squared: 0.0, body, reaction }
        };
        let mut dyad = Dyad {
            arms: [arm(0), arm(1)],
            product: 0.0,
            range: [0.0; 2],
            half: if mode == AssemblyMode::Right { -0.5 } else { 0.5 },
            inner: self.action(group.inner[0], group.links[0]),
        };
        dyad.renumber(&self.case.mechanism);
        dyad
    }
}

impl Dyad {
    fn renumber(&mut self, mechanism: &Mechanism) {
        let on_second = self.inner.renumber(mechanism);
        for (arm, inner) in self.arms.iter_mut().zip([self.inner.place, on_second]) {
            arm.base.1 = arm.reaction.renumber(mechanism);
            arm.body.renumber(mechanism);
            let span = inner - arm.reaction.place;
            arm.squared = span.norm_squared();
            arm.inverse_span = span / arm.squared;
        }
        let lengths = [0, 1].map(|k| self.arms[k].squared.sqrt());
        self.product = lengths[0] * lengths[1];
        self.range = [(lengths[0] - lengths[1]).powi(2), (lengths[0] + lengths[1]).powi(2)];
    }
}
