//! Velocity and acceleration plans.
//!
//! All absolute vectors start in the pole; the plane motion of a rigid link, v_B = v_A + omega x AB and
//! a_B = a_A + alpha x AB - omega^2 AB, makes the vector between the ends of two of them the relative one. So the image of a link in the velocity
//! plan is the link itself, turned by 90 deg and enlarged omega times; in the acceleration plan it is turned by
//! 180 deg - atan2(alpha, omega^2) and enlarged sqrt(alpha^2 + omega^4) times (Mehmke's and Burmester's theorems).
//!
//! Each vector comes from the motion of its own link, none from the difference of two others: that the polygons close is a result.

use super::names::{Place, pair, pivot, places};
use super::scale::factor;
use super::scheme::Scheme;
use crate::case::{Case, Grid, Wanted};
use crate::error::{Error, ErrorKind, Result};
use crate::math::{Motion, Vec2, turned};
use crate::mechanism::{JointKind, Mechanism};
use crate::solver::{Solver, State};
use crate::trajectory::Stage;

/// Length (mm) that the longest vector of a plan is drawn with, at most.
const ROOM: f64 = 100.0;
/// A tangential part shorter than this on paper (mm) is none: the link turns uniformly.
const NOTHING: f64 = 1e-9;

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
}

/// One vector of a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Vector {
    /// Name as the field writes it: `v_B`, `v_BA`, `a_BA^n`, `a_BA^t`, `v_S2`.
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

    /// The vector called `name`.
    #[must_use]
    pub fn vector(&self, name: &str) -> Option<&Vector> {
        self.vectors.iter().find(|vector| vector.name == name)
    }

    /// The point of the plan called `letter`, from the pole (SI).
    #[must_use]
    pub fn tip(&self, letter: &str) -> Option<Vec2> {
        self.tips.iter().find(|tip| tip.letter == letter).map(|tip| tip.at)
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
    /// The plans of `case` at the crank angle `crank` (rad, as the scenario states it), from a solution by `solver`.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] for a crank angle too far away to be followed; those of the solver.
    pub fn at(case: &Case, solver: &dyn Solver, crank: f64) -> Result<Self> {
        Ok(Plans::of(case, &state_at(case, solver, crank)?, crank))
    }

    /// The plans of a state that holds motions up to accelerations.
    #[must_use]
    pub fn of(case: &Case, state: &State, crank: f64) -> Self {
        let all = places(&case.mechanism, &[Quantity::Velocity.pole(), Quantity::Acceleration.pole()]);
        let plan = |quantity| Builder::new(quantity, &case.mechanism, state, &all).plan();
        let scheme = Scheme::of(case, state, &all);
        Plans { crank, scheme, velocity: plan(Quantity::Velocity), acceleration: plan(Quantity::Acceleration) }
    }
}

/// The state of `case` at the crank angle `crank` (rad, as the scenario states it), up to accelerations.
///
/// # Errors
/// As [`Plans::at`].
pub fn state_at(case: &Case, solver: &dyn Solver, crank: f64) -> Result<State> {
    let grid = Grid::of_cranks(&case.drive, vec![crank]);
    grid.check()
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

/// A point of a link and its letter.
struct On<'a> {
    name: &'a str,
    letter: &'a str,
    local: Vec2,
    fixed: bool,
}

struct Builder<'a> {
    quantity: Quantity,
    mechanism: &'a Mechanism,
    state: &'a State,
    places: &'a [Place],
    tips: Vec<Tip>,
    vectors: Vec<Vector>,
}

impl<'a> Builder<'a> {
    fn new(quantity: Quantity, mechanism: &'a Mechanism, state: &'a State, places: &'a [Place]) -> Self {
        let pole = Tip { letter: quantity.pole().into(), kind: TipKind::Fixed, at: Vec2::zeros() };
        Builder { quantity, mechanism, state, places, tips: vec![pole], vectors: Vec::new() }
    }

    fn plan(mut self) -> Plan {
        self.absolute();
        for link in 1..self.mechanism.links().len() {
            self.relative(link);
        }
        self.joints();
        let longest = self.vectors.iter().map(|vector| vector.value.norm()).fold(0.0, f64::max);
        let scale = factor(longest, ROOM);
        if self.quantity == Quantity::Acceleration {
            self.split(scale);
        }
        Plan { quantity: self.quantity, scale, tips: self.tips, vectors: self.vectors }
    }

    fn of_point(&self, motion: &Motion, local: Vec2) -> Vec2 {
        match self.quantity {
            Quantity::Velocity => motion.point_velocity(local),
            Quantity::Acceleration => motion.point_acceleration(local),
        }
    }

    /// Vectors from the pole: of points, and of mass centres.
    fn absolute(&mut self) {
        let (pole, symbol, word) = (self.quantity.pole(), self.quantity.symbol(), self.quantity.word());
        for place in self.places {
            let value = self.of_point(&self.state.motions[place.side.link], place.side.local);
            let kind = if place.fixed { TipKind::Fixed } else { TipKind::Point };
            self.tips.push(Tip { letter: place.letter.clone(), kind, at: value });
            if place.fixed {
                continue;
            }
            let mut meaning = format!("{word} of {}", place.name);
            if let (Quantity::Velocity, Some((_, pivot))) = (self.quantity, pivot(self.mechanism, place.side.link)) {
                meaning += &format!(", perpendicular to {}", pair(&pivot, &place.name));
            }
            self.push(
                format!("{symbol}_{}", place.name),
                Part::Absolute,
                [pole, &place.letter],
                value,
                place.side.link,
                meaning,
            );
        }
        for (number, link) in self.mechanism.links().iter().enumerate().skip(1).filter(|(_, link)| link.mass > 0.0) {
            let mut letter = format!("s{number}");
            while self.tips.iter().any(|tip| tip.letter == letter) {
                letter.push('\'');
            }
            let value = self.of_point(&self.state.motions[number], link.mass_centre);
            self.tips.push(Tip { letter: letter.clone(), kind: TipKind::MassCentre, at: value });
            let meaning = format!("{word} of the mass centre of link {number} ({})", link.name);
            self.push(format!("{symbol}_S{number}"), Part::MassCentre, [pole, &letter], value, number, meaning);
        }
    }

    /// Vectors between the ends of a link's points.
    fn relative(&mut self, link: usize) {
        let (symbol, word) = (self.quantity.symbol(), self.quantity.word());
        let motion = &self.state.motions[link];
        for (from, to) in self.pairs(link).into_iter().filter(|(from, _)| !from.fixed) {
            let arm = motion.arm(to.local - from.local);
            let value = match self.quantity {
                Quantity::Velocity => turned(arm) * motion.omega,
                Quantity::Acceleration => turned(arm) * motion.alpha - arm * motion.omega.powi(2),
            };
            let line = pair(from.name, to.name);
            let mut meaning = format!("{word} of {} relative to {}", to.name, from.name);
            if self.quantity == Quantity::Velocity {
                meaning += &format!(", perpendicular to {line}");
            }
            let name = format!("{symbol}_{}", pair(to.name, from.name));
            self.push(name, Part::Relative, [from.letter, to.letter], value, link, meaning);
        }
    }

    /// What pairs add to the vectors of links: nothing by a revolute pair, whose two points move as one. A pair that slides
    /// adds its relative velocity, its relative acceleration and the Coriolis part 2 omega x v here.
    fn joints(&mut self) {
        for joint in self.mechanism.joints() {
            match joint.kind {
                JointKind::Revolute => {}
            }
        }
    }

    /// Normal and tangential parts of every relative acceleration, and of those about a pivot on the ground.
    fn split(&mut self, scale: f64) {
        let mut number = 0;
        for link in 1..self.mechanism.links().len() {
            let motion = &self.state.motions[link];
            for (from, to) in self.pairs(link) {
                let arm = motion.arm(to.local - from.local);
                let (normal, tangential) = (-arm * motion.omega.powi(2), turned(arm) * motion.alpha);
                let (of, line) = (pair(to.name, from.name), pair(from.name, to.name));
                let uniform = !(tangential.norm() / scale > NOTHING);
                let end = if uniform {
                    to.letter.to_string()
                } else {
                    number += 1;
                    let at =
                        self.tips.iter().find(|tip| tip.letter == from.letter).map_or(normal, |tip| tip.at + normal);
                    let mut letter = format!("n{number}");
                    while self.tips.iter().any(|tip| tip.letter == letter) {
                        letter.push('\'');
                    }
                    self.tips.push(Tip { letter: letter.clone(), kind: TipKind::Normal, at });
                    letter
                };
                let start = if from.fixed { self.quantity.pole() } else { from.letter };
                let toward = pair(to.name, from.name);
                let meaning = format!("normal part along {toward}, omega^2 l");
                self.push(format!("a_{of}^n"), Part::Normal, [start, &end], normal, link, meaning);
                if !uniform {
                    let meaning = format!("tangential part, alpha l, perpendicular to {line}");
                    self.push(format!("a_{of}^t"), Part::Tangential, [&end, to.letter], tangential, link, meaning);
                }
            }
        }
    }

    /// Pairs of points of a link: first its pivot on the ground with every other, then the moving ones among themselves.
    fn pairs(&self, link: usize) -> Vec<(On<'a>, On<'a>)> {
        let places = self.places;
        let pivot = pivot(self.mechanism, link);
        let own = self.mechanism.links()[link].points.iter();
        let moving: Vec<(&'a Place, Vec2)> = own
            .filter(|point| pivot.as_ref().is_none_or(|(local, _)| point.local != *local))
            .filter_map(|point| places.iter().find(|p| p.name == point.name && !p.fixed).map(|p| (p, point.local)))
            .collect();
        let on =
            |&(place, local): &(&'a Place, Vec2)| On { name: &place.name, letter: &place.letter, local, fixed: false };
        let base = pivot.as_ref().and_then(|(local, name)| {
            let place = places.iter().find(|place| place.fixed && place.name == *name)?;
            Some((place, *local))
        });
        let mut pairs = Vec::new();
        for to in &moving {
            pairs.extend(base.as_ref().map(|base| (On { fixed: true, ..on(base) }, on(to))));
        }
        for (index, from) in moving.iter().enumerate() {
            pairs.extend(moving[index + 1..].iter().map(|to| (on(from), on(to))));
        }
        pairs
    }

    fn push(&mut self, name: String, part: Part, [from, to]: [&str; 2], value: Vec2, link: usize, meaning: String) {
        let start = self.tips.iter().find(|tip| tip.letter == from).map_or_else(Vec2::zeros, |tip| tip.at);
        self.vectors.push(Vector { name, part, from: from.into(), to: to.into(), start, value, link, meaning });
    }
}
