//! Velocity and acceleration plans.
//!
//! All absolute vectors start in the pole; the plane motion of a rigid link, v_B = v_A + omega x AB and
//! a_B = a_A + alpha x AB - omega^2 AB, makes the vector between the ends of two of them the relative one. So the image of a link in the velocity
//! plan is the link itself, turned by 90 deg and enlarged omega times; in the acceleration plan it is turned by
//! 180 deg - atan2(alpha, omega^2) and enlarged sqrt(alpha^2 + omega^4) times (Mehmke's and Burmester's theorems).
//!
//! A point A that slides on a moving guide of link 3 lies over a point A3 of that link. In the axes of the guide it moves along it by s(t); differentiated
//! in resting axes, v_A = v_A3 + s' e and a_A = a_A3 + 2 omega x (s' e) + s'' e with the guide's unit vector e and angular velocity omega (Coriolis 1835).
//!
//! Each vector comes from the motion of its own link, those along a guide from the slide, none from the difference of two others: that the polygons
//! close is a result.

use super::builder::Builder;
use super::names::places;
use super::scheme::Scheme;
use super::sliding::{slides, travels};
use linkage::case::{Case, Grid, Wanted};
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::Vec2;
use linkage::solver::{Solver, State};
use linkage::trajectory::Stage;

/// What a plan shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Velocities (m/s).
    Velocity,
    /// Accelerations (m/s^2).
    Acceleration,
}

impl Quantity {
    /// SI unit.
    #[must_use]
    pub fn unit(self) -> &'static str {
        match self {
            Quantity::Velocity => "m/s",
            Quantity::Acceleration => "m/s^2",
        }
    }

    /// Symbol of its vectors: v or a.
    #[must_use]
    pub fn symbol(self) -> &'static str {
        match self {
            Quantity::Velocity => "v",
            Quantity::Acceleration => "a",
        }
    }

    /// Letter of its pole: p or π.
    #[must_use]
    pub fn pole(self) -> &'static str {
        match self {
            Quantity::Velocity => "p",
            Quantity::Acceleration => "π",
        }
    }

    /// The word for it.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Quantity::Velocity => "velocity",
            Quantity::Acceleration => "acceleration",
        }
    }
}

/// Sort of the end of a vector.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TipKind {
    /// The pole itself, or a point of the ground, which lies in it.
    Fixed,
    /// A named point of the mechanism.
    Point,
    /// A mass centre: s and the number of its link.
    MassCentre,
    /// The end of a normal part: n and a running number.
    Normal,
    /// A point of a moving guide's link under a sliding point: letter of that point and number of the link, a3.
    Coincident,
    /// The end of a Coriolis part: k and a running number.
    Coriolis,
}

/// A point of a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Tip {
    /// Its letter.
    pub letter: String,
    /// Its sort.
    pub kind: TipKind,
    /// Vector from the pole (SI).
    pub at: Vec2,
}

/// Sort of a vector.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// Absolute, of a named point.
    Absolute,
    /// Absolute, of a mass centre.
    MassCentre,
    /// Relative, of two points of one link.
    Relative,
    /// Normal part of an acceleration: omega^2 l, from the point towards the other.
    Normal,
    /// Tangential part of an acceleration: alpha l, perpendicular to the line of both points.
    Tangential,
    /// Along a moving guide: velocity or acceleration of a sliding point relative to the guide's link.
    Sliding,
    /// Coriolis part of the acceleration of a point that slides on a turning guide: 2 omega x v, across the guide.
    Coriolis,
}

/// One vector of a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Vector {
    /// Name as the field writes it: `v_B`, `v_BA`, `a_BA^n`, `a_BA^t`, `v_S2`; `v_A3`, `v_A,A3`, `a_A,A3^cor`, `a_A,A3^r` where A slides on link 3.
    pub name: String,
    /// Sort.
    pub part: Part,
    /// Letter where it starts.
    pub from: String,
    /// Letter where it ends.
    pub to: String,
    /// Where it starts, from the pole (SI).
    pub start: Vec2,
    /// Components in world axes (SI).
    pub value: Vec2,
    /// Number of the link whose motion it comes from.
    pub link: usize,
    /// What it is, in words.
    pub meaning: String,
}

/// A velocity or acceleration plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// What it shows.
    pub quantity: Quantity,
    /// Scale factor mu_v ((m/s)/mm) or mu_a ((m/s^2)/mm).
    pub scale: f64,
    /// Ends of vectors; the pole first.
    pub tips: Vec<Tip>,
    /// All vectors.
    pub vectors: Vec<Vector>,
}

impl Plan {
    /// Length of a vector on paper (mm).
    #[must_use]
    pub fn paper(&self, vector: &Vector) -> f64 {
        vector.value.norm() / self.scale
    }
}

/// Kinematic diagram, velocity plan and acceleration plan of one instant.
#[derive(Clone, Debug, PartialEq)]
pub struct Plans {
    /// Crank angle (rad, as the scenario states it).
    pub crank: f64,
    /// The mechanism.
    pub scheme: Scheme,
    /// The velocity plan.
    pub velocity: Plan,
    /// The acceleration plan.
    pub acceleration: Plan,
}

impl Plans {
    /// The plans of a state that holds motions up to accelerations. `solver` finds how far sliders travel on the case's grid: so long are
    /// the guides in the kinematic diagram.
    #[must_use]
    pub fn of(case: &Case, solver: &dyn Solver, state: &State, crank: f64) -> Self {
        let mut all = places(&case.mechanism, &[Quantity::Velocity.pole(), Quantity::Acceleration.pole()]);
        let slides = slides(&case.mechanism, &mut all);
        let plan = |quantity| Builder::new(quantity, &case.mechanism, state, &all, &slides).plan();
        let travels = travels(case, solver, state, &slides);
        let scheme = Scheme::of(case, state, &all, &slides, &travels);
        Plans { crank, scheme, velocity: plan(Quantity::Velocity), acceleration: plan(Quantity::Acceleration) }
    }
}

/// The state of `case` at the crank angle `crank` (rad, as the scenario states it), up to accelerations.
///
/// # Errors
/// [`ErrorKind::Input`] for a crank angle too far away to be followed; those of the solver.
pub fn state_at(case: &Case, solver: &dyn Solver, crank: f64) -> Result<State> {
    let grid = Grid::of_cranks(&case.drive, vec![crank]);
    grid.check(&case.drive)
        .map_err(|message| Error::new(ErrorKind::Input, message).help("give a crank angle in degrees, as 70 or -30"))?;
    let wanted = Wanted::of(&[Stage::Positions, Stage::Velocities, Stage::Accelerations]);
    let case = Case { wanted, ..case.on(grid) };
    let mut found = State::at_start(&case);
    let mut visit = |_: usize, state: &State| {
        found = state.clone();
        Ok(())
    };
    solver.sweep(&case, &mut visit, &mut |_| {})?;
    Ok(found)
}
