//! The centres of a mechanism, with the part of the plane in which they are drawn.

use super::centres::{CentreLine, CentreOrigin, Centres, InstantCentre};
use super::scheme::Scheme;
use crate::sentences;
use drawing::paper::scale::factor;
use linkage::case::Case;
use linkage::math::centre::MotionCentre;
use linkage::math::{KeepNan, Vec2, corners};
use linkage::mechanism::LinkId;
use linkage::solver::State;

/// Largest width and height of the drawing on paper (mm).
const ROOM: [f64; 2] = [175.0, 210.0];
/// Largest distance of a drawn centre from the middle of the mechanism, divided by half the mechanism's diagonal.
/// Farther instant centres are drawn as arrows.
const NEAR: f64 = 2.2;
/// Margin around the drawing, divided by half the mechanism's diagonal.
const MARGIN: f64 = 0.12;

/// Drawing of the instant centres and acceleration centres.
#[derive(Clone, Debug, PartialEq)]
pub struct CentreSheet {
    /// The mechanism.
    pub scheme: Scheme,
    /// All centres.
    pub centres: Centres,
    /// Lower left and upper right corner of the drawn part of the plane (m).
    pub window: [Vec2; 2],
    /// Links whose centres are shown; all links if empty.
    pub(super) chosen: Vec<LinkId>,
}

impl CentreSheet {
    /// Finds the centres of a state, and a scale at which the near centres fit on paper.
    pub(super) fn of(case: &Case, state: &State, scheme: &Scheme) -> Self {
        let centres = Centres::of(&case.mechanism, &state.motions);
        let ends = scheme.guides.iter().flat_map(|guide| guide.ends);
        let own: Vec<Vec2> = scheme.points.iter().map(|(_, at)| *at).chain(ends).collect();
        let [low, high] = corners(own.iter().copied());
        let (middle, half) = ((low + high) / 2.0, (high - low).norm() / 2.0);
        let places = centres.instant.iter().map(|centre| centre.place);
        let places = places.chain(centres.acceleration.iter().map(|(_, place)| *place));
        let near = places.filter_map(|place| position(place).filter(|at| (at - middle).norm() <= NEAR * half));
        let [low, high] = corners(own.into_iter().chain(near));
        let margin = Vec2::repeat(MARGIN * half);
        let window = [low - margin, high + margin];
        let size = window[1] - window[0];
        let scale = factor(size.x, ROOM[0]).larger(factor(size.y, ROOM[1]));
        let mut scheme = scheme.clone();
        scheme.redraw(case, state, scale);
        CentreSheet { scheme, centres, window, chosen: Vec::new() }
    }

    /// Instant centres of the chosen links.
    pub fn instant(&self) -> impl Iterator<Item = &InstantCentre> {
        self.centres.instant.iter().filter(|centre| centre.links.iter().any(|link| self.is_chosen(*link)))
    }

    /// Acceleration centres of the chosen links.
    pub fn acceleration(&self) -> impl Iterator<Item = (LinkId, MotionCentre)> {
        self.centres.acceleration.iter().copied().filter(|(link, _)| self.is_chosen(*link))
    }

    fn is_chosen(&self, link: LinkId) -> bool {
        self.chosen.is_empty() || self.chosen.contains(&link)
    }
}

/// World position of a centre (m); `None` if the centre is not a single finite point.
pub fn position(place: MotionCentre) -> Option<Vec2> {
    match place {
        MotionCentre::At(at) => Some(at),
        MotionCentre::AtInfinity(_) | MotionCentre::Nowhere | MotionCentre::Everywhere => None,
    }
}

impl InstantCentre {
    /// Numbers of both links: `02`, or `2,10`.
    pub fn numbers(&self) -> String {
        numbers(self.links)
    }

    /// How the centre was found, in words.
    pub fn told(&self) -> String {
        match &self.origin {
            CentreOrigin::Pin(name) => sentences::pin(&name),
            CentreOrigin::Guide { name, .. } => sentences::across_the_guide(&name),
            CentreOrigin::Common(third) => sentences::both_centres_with_link_coincide(&third),
            CentreOrigin::Lines(lines) => lines.each_ref().map(|line| self.line(line)).join(" x "),
            CentreOrigin::Velocities => sentences::FROM_THE_VELOCITIES.into(),
        }
    }

    /// Name of a line on which the centre lies, such as `P01P14`.
    fn line(&self, line: &CentreLine) -> String {
        match line {
            CentreLine::Through(third) => {
                self.links.map(|own| format!("P{}", numbers([own.min(*third), own.max(*third)]))).concat()
            }
            CentreLine::Contact { name, .. } => sentences::line_of_action_of(&name),
        }
    }
}

fn numbers([first, second]: [LinkId; 2]) -> String {
    if second.index() < 10 { format!("{first}{second}") } else { format!("{first},{second}") }
}
