//! Velocity and acceleration plans.
//!
//! All absolute vectors start in the pole.
//! For the plane motion of a rigid link, v_B = v_A + omega x AB and a_B = a_A + alpha x AB - omega^2 AB.
//! The vector between the ends of two absolute vectors is therefore the relative vector.
//! The image of a link in the velocity plan is the link turned by 90 deg and scaled by omega.
//! In the acceleration plan, the image is the link turned by 180 deg - atan2(alpha, omega^2) and scaled by
//! sqrt(alpha^2 + omega^4).
//! Both statements about images are theorems, by Mehmke and Burmester.
//!
//! A point A that slides on a moving guide of link 3 coincides with a point A3 of that link.
//! In the guide's axes, the position of A along the guide is s(t).
//! Differentiation in fixed axes gives v_A = v_A3 + s' e and a_A = a_A3 + 2 omega x (s' e) + s'' e.
//! Here e is the guide's unit vector and omega the guide's angular velocity (Coriolis 1835).
//!
//! Every vector is computed from the motion of a link, except those along a guide: s' e and s'' e are computed from the
//! solved s' and s''.
//! The program never computes a vector as the difference of two others. That the polygons close is therefore a result
//! and not an assumption.

use super::builder::Builder;
use super::centre_sheet::CentreSheet;
use super::names::{Named, NamedPoint, places};
use super::scheme::Scheme;
use super::sliding::{Slide, slides, travels};
use super::vectors::{PlanTurn, Quantity, VectorPlan};
use crate::sentences;
use linkage::case::{Case, Grid, Wanted, When};
use linkage::drive::Drives;
use linkage::error::{Error, ErrorKind, Result};
use linkage::input::Input;
use linkage::math::Vec2;
use linkage::mechanism::{LinkId, Mechanism};
use linkage::solver::{Solver, State};
use linkage::trajectory::Stage;

/// Kinematic diagram, velocity plan and acceleration plan of one instant.
#[derive(Clone, Debug, PartialEq)]
pub struct Plans {
    /// Value of the input (SI unit, as the scenario defines it).
    pub crank: f64,
    /// What the input measures.
    pub input: Input,
    /// Kinematic diagram.
    pub scheme: Scheme,
    /// Velocity plan.
    pub velocity: VectorPlan,
    /// Acceleration plan.
    pub acceleration: VectorPlan,
    /// Instant centres and acceleration centres, if requested.
    pub centres: Option<CentreSheet>,
    /// Points, each with the links that contain it.
    points: Vec<(Named, Vec<LinkId>)>,
}

impl Plans {
    /// Draws the plans of a state with motions up to accelerations.
    /// `solver` finds the travel of the sliders on the case's grid.
    /// The travel determines the length of the guides in the kinematic diagram.
    pub fn of(case: &Case, solver: &dyn Solver, state: &State, crank: f64) -> Self {
        let planner = Planner::of(&case.mechanism);
        let travels = travels(case, solver, state, &planner.slides);
        let scheme = Scheme::of(case, state, &planner.places, &planner.slides, &travels);
        let links = case.mechanism.links().entries();
        let carriers = |name: &str| {
            let carry = links.clone().filter(|(_, link)| link.points.iter().any(|point| point.name == name));
            carry.map(|(number, _)| number).collect()
        };
        let names = planner.places.iter().map(|place| &place.named);
        let points = names.map(|named| (named.clone(), carriers(&named.name))).collect();
        let [mut velocity, acceleration] = Quantity::ALL.map(|quantity| planner.plan(quantity, state));
        velocity.add_singular(&scheme.singular);
        Plans { crank, input: case.crank().input, scheme, velocity, acceleration, centres: None, points }
    }

    /// Adds all instant centres and acceleration centres of the state.
    #[must_use]
    pub fn with_centres(mut self, case: &Case, state: &State) -> Plans {
        self.centres = Some(CentreSheet::of(case, state, &self.scheme));
        self
    }

    /// Keeps only the vectors of the points and links in `names`.
    /// For a point, its vectors are kept; for a link, the vectors of all its points and of its mass centre.
    /// If `names` contains links, only these links keep their instant centres and acceleration centres.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] for a name of neither a point nor a link.
    pub fn only(mut self, names: &[String]) -> Result<Plans> {
        let mut letters: Vec<String> = Vec::new();
        for name in names {
            let link = self.scheme.links.iter().find(|link| link.name == *name).map(|link| link.number);
            let has = |(own, links): &&(Named, Vec<LinkId>)| {
                own.name == *name || link.is_some_and(|link| links.contains(&link))
            };
            let before = letters.len();
            letters.extend(self.points.iter().filter(has).map(|(own, _)| own.letter.clone()));
            letters.extend(link.map(|link| format!("s{link}")));
            if let Some(sheet) = &mut self.centres {
                sheet.chosen.extend(link);
            }
            if letters.len() == before {
                let points = self.points.iter().map(|(own, _)| own.name.as_str());
                let all: Vec<&str> = points.chain(self.scheme.links.iter().map(|link| link.name.as_str())).collect();
                return Err(Error::new(ErrorKind::Input, sentences::no_point_and_no_link_is_called(&name))
                    .help(sentences::name_some_of(&all.join(", "))));
            }
        }
        self.velocity.keep(&letters);
        self.acceleration.keep(&letters);
        Ok(self)
    }

    /// Turns the velocity plan by 90 deg against the rotation of the driving link.
    /// The sides of a link's velocity image are then parallel to the sides of the link.
    /// In the turned plan, the velocity of the crank pin is parallel to the crank.
    /// If the driving link does not turn, the plan is turned clockwise.
    #[must_use]
    pub fn turned(mut self) -> Plans {
        let driver = self.scheme.links.iter().find(|link| link.number == self.scheme.driver);
        let is_back = driver.is_some_and(|link| link.omega < 0.0);
        self.velocity.turn = if is_back { PlanTurn::CounterClockwise } else { PlanTurn::Clockwise };
        self
    }
}

/// Plans of a mechanism at any state. The letters and the prismatic joints are determined once for all states.
#[derive(Debug)]
pub struct Planner<'a> {
    mechanism: &'a Mechanism,
    places: Vec<NamedPoint>,
    slides: Vec<Slide>,
}

impl<'a> Planner<'a> {
    /// Creates the planner of a mechanism.
    pub fn of(mechanism: &'a Mechanism) -> Self {
        let mut places = places(mechanism, &Quantity::ALL.map(Quantity::pole));
        let slides = slides(mechanism, &mut places);
        Planner { mechanism, places, slides }
    }

    /// Names of points, each with its letter.
    pub fn letters(&self) -> impl Iterator<Item = (&str, &str)> {
        self.places.iter().map(|place| (place.named.name.as_str(), place.named.letter.as_str()))
    }

    /// Returns the plan of a state with motions up to `quantity`.
    pub fn plan(&self, quantity: Quantity, state: &State) -> VectorPlan {
        Builder::new(quantity, self.mechanism, state, &self.places, &self.slides).plan()
    }
}

/// A grid of one instant. The motion laws of all drives must be defined at this instant.
///
/// # Errors
/// [`ErrorKind::Input`] as for [`state_at`].
pub fn grid_at(drives: &Drives, when: When) -> Result<Grid> {
    let grid = when.grid(drives.crank());
    grid.check(drives).map_err(|message| {
        let input = drives.crank().input;
        let (noun, unit) = (input.noun(), input.shown_in().0.replace("deg", "degrees"));
        Error::new(ErrorKind::Input, message).help(sentences::give_a_number_in(&noun, &unit))
    })?;
    Ok(grid)
}

/// A mechanism is at rest if all its speeds are below this fraction of the speeds at the drives' top speed. Such speeds
/// are rounding errors of a law that reverses at this instant.
const REST: f64 = 1e-12;

/// Computes the state of `case` at an instant, up to accelerations. Speeds of a mechanism at rest are exactly zero.
///
/// # Errors
/// [`ErrorKind::Input`] for an instant too far away to be reached step by step, for a time outside the laws of motion,
/// and for a crank angle that the law of motion reaches never or several times.
/// The errors of the solver.
pub fn state_at(case: &Case, solver: &dyn Solver, when: When) -> Result<State> {
    let grid = grid_at(&case.drives, when)?;
    let wanted = Wanted::of(&[Stage::Positions, Stage::Velocities, Stage::Accelerations]);
    let case = case.on(grid)?.wanting(wanted);
    let mut found = State::at_start(&case);
    let mut visit = |_: usize, state: &State| {
        found = state.clone();
        Ok(())
    };
    solver.each(&case, &mut visit)?;
    let size = case.mechanism.size();
    let least = REST * case.drives.top_speed(size);
    if found.motions.iter().all(|own| own.omega.abs() <= least && own.velocity.norm() <= least * size) {
        found.motions.iter_mut().for_each(|own| (own.omega, own.velocity) = (0.0, Vec2::zeros()));
    }
    Ok(found)
}
