//! Kinematic diagram: the mechanism drawn to scale.

use super::names::{NamedPoint, pivot};
use super::singular::SingularPoint;
use super::sliding::Slide;
use drawing::paper::scale::factor;
use drawing::picture::LinkPlacement::Here;
use drawing::{Acting, Sketch, Travels, acting};
use linkage::case::Case;
use linkage::math::{KeepNan, Motion, Vec2, corners};
use linkage::mechanism::{LinkId, LinkPose};
use linkage::solver::State;

/// Largest width and height (mm) of the kinematic diagram on paper.
const ROOM: [f64; 2] = [150.0, 215.0];

/// Moving link of the diagram.
#[derive(Clone, Debug, PartialEq)]
pub struct SchemeLink {
    /// Link number: its index in the mechanism, with ground 0.
    pub number: LinkId,
    /// Name.
    pub name: String,
    /// World position of the link's pivot on the ground (m), if any.
    pub pivot: Option<Vec2>,
    /// Angular velocity (rad/s), counter-clockwise positive.
    pub omega: f64,
    /// Angular acceleration (rad/s^2), counter-clockwise positive.
    pub alpha: f64,
}

/// Guide of the diagram with its block.
#[derive(Clone, Debug, PartialEq)]
pub struct SchemeGuide {
    /// Unit vector along the guide (world).
    pub axis: Vec2,
    /// World position of the joint's point on the guide (m).
    pub origin: Vec2,
    /// World position of the sliding point (m).
    pub at: Vec2,
    /// Ends of the sliding point's travel along the guide, at the guide's present position (m, world).
    pub ends: [Vec2; 2],
    /// Names of the sliding point and of the coincident point on a moving guide's link; `None` for a fixed guide.
    pub under: Option<[String; 2]>,
}

/// The mechanism at one instant, ready to be drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Scheme {
    /// Scale factor mu_l (m/mm).
    pub scale: f64,
    /// Moving links.
    pub links: Vec<SchemeLink>,
    /// Named points and their world positions (m). The points of the ground come first.
    pub points: Vec<(String, Vec2)>,
    /// Guides, fixed and moving.
    pub guides: Vec<SchemeGuide>,
    /// Number of the driving link.
    pub driver: LinkId,
    /// Singular points of the mechanism's groups of class III and IV. Groups without a singular point are left out.
    pub singular: Vec<SingularPoint>,
    /// Sketch of the mechanism, in millimetres on paper.
    pub sketch: Sketch,
    /// Places of the links.
    pub places: Vec<drawing::picture::LinkPlacement>,
    /// Loads that act on the mechanism.
    pub acting: Vec<Acting>,
    /// Travel of the blocks on their guides.
    travels: Travels,
}

impl Scheme {
    /// Builds the diagram of a state.
    pub(super) fn of(
        case: &Case,
        state: &State,
        places: &[NamedPoint],
        slides: &[Slide],
        travels: &[[f64; 2]],
    ) -> Self {
        let mechanism = &case.mechanism;
        let points: Vec<(String, Vec2)> = places
            .iter()
            .map(|place| (place.named.name.clone(), state.motions[place.side.link].point(place.side.local)))
            .collect();
        let links = mechanism.links().entries().skip(1).map(|(number, link)| {
            let motion = &state.motions[number];
            SchemeLink {
                number,
                name: link.name.clone(),
                pivot: pivot(mechanism, number).map(|(local, _)| motion.point(local)),
                omega: motion.omega,
                alpha: motion.alpha,
            }
        });
        let links: Vec<SchemeLink> = links.collect();
        let guide = |(slide, travel): (&Slide, &[f64; 2])| {
            let motion = &state.motions[slide.guide.link];
            let axis = motion.arm(mechanism.joints()[slide.joint].axis_on(slide.guide.link)?);
            let origin = motion.point(slide.guide.local);
            Some(SchemeGuide {
                axis,
                origin,
                at: state.motions[slide.block.link].point(slide.block.local),
                ends: travel.map(|way| origin + axis * way),
                under: slide.under.as_ref().map(|under| [slide.place.named.name.clone(), under.name.clone()]),
            })
        };
        let guides: Vec<SchemeGuide> = slides.iter().zip(travels).filter_map(guide).collect();
        let all = mechanism.links().entries().zip(&state.motions).skip(1).flat_map(|((number, link), motion)| {
            let joints = mechanism.joints().iter().filter_map(move |joint| joint.on(number));
            let mass_centre = (link.mass > 0.0).then_some(link.mass_centre);
            let locals = link.points.iter().map(|point| point.local).chain(joints).chain(mass_centre);
            locals.map(|local| motion.point(local))
        });
        let all = all.chain(guides.iter().flat_map(|guide| guide.ends)).chain(points.iter().map(|(_, at)| *at));
        let [low, high] = corners(all);
        let scale = factor(high.x - low.x, ROOM[0]).larger(factor(high.y - low.y, ROOM[1]));
        // At a dead point of its group, a singular point cannot be computed and is not drawn.
        let singular = SingularPoint::all(case, &state.motions).into_iter().flatten().collect();
        let lengths = slides.iter().zip(travels);
        let mut travels = lengths.fold(Travels::none(mechanism), |all, (slide, travel)| all.with(slide.joint, *travel));
        // The pose shows which side of a cam touches its follower.
        travels.take_in(mechanism, |link, local| Some(state.motions[link].point(local)));
        let sketch = Sketch::of_case(case, &travels, scale);
        let acting = acting(case, &sketch, &state.motions, &state.angles);
        let pose = |(motion, &angle): (&Motion, &f64)| Here(LinkPose { origin: motion.origin, angle });
        let places = state.motions.iter().zip(&state.angles).map(pose).collect();
        Scheme { scale, links, points, guides, driver: case.crank().link, singular, sketch, places, acting, travels }
    }

    /// Draws the same state at another scale (m/mm).
    pub(super) fn redraw(&mut self, case: &Case, state: &State, scale: f64) {
        self.scale = scale;
        self.sketch = Sketch::of_case(case, &self.travels, scale);
        self.acting = acting(case, &self.sketch, &state.motions, &state.angles);
    }
}
