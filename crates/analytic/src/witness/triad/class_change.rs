//! The class III group by exchange of the driving link.
//!
//! Two leads of the group are attached to the ground (the ground leads), and lead 3 to the crank.
//! If one ground lead is treated as the driver in place of the crank (the conditional driver), the mechanism is a chain
//! of class II dyads.
//! The first dyad consists of the base link and the ground lead that does not drive.
//! The second dyad consists of lead 3 and the crank.
//! The first dyad is placed in closed form.
//! The second dyad requires that the distance from the head F of lead 3 to the crank pin C equals the length of lead 3.
//! The crank angle alpha is therefore a function of the driving lead's angle theta. The true motion is the inverse
//! function.
//! For a given alpha, the second dyad closes at the theta with `|F(theta) - C(alpha)| = l_3`.
//! Newton's method with bisection finds this theta between bounds. With q = F - C
//!
//! `d alpha / d theta = (q . F') / (q . C')`, `omega_lead = omega_crank / (d alpha / d theta)`,
//!
//! and all other rates and the accelerations follow from the first and second derivatives along the same chain.
//! Background: I. I. Artobolevsky, Theory of Mechanisms and Machines, 4th ed., Nauka 1988.
//! No system of equations is solved.
//!
//! Dead points. At the limit positions of a ground lead d alpha / d theta is infinite: this lead cannot be the driver.
//! There are two kinds of limit positions.
//! In a limit position of the first kind, the base link is in line with the ground lead that does not drive.
//! The first dyad is then at its limit.
//! The driver is therefore chosen so that the first dyad is as far as possible from its limit.
//! In a limit position of the second kind, the crank and lead 3 are in line.
//! Both ground leads then stand still, and both are equally unsuitable as the driver.
//! The second dyad then changes from one of its two configurations to the other.
//! The closing condition of the second dyad holds for both configurations and is smooth in theta.
//! The method solves only this condition, for theta, and need not choose a configuration of the second dyad. Limit
//! positions of the second kind are therefore passed without difficulty.
//! A dead point of the group itself, q . F' = 0, cannot be passed.

mod chain;

use super::Triad;
use crate::sentences;
use chain::{Chain, Grounded, Place, along};
use linkage::case::Case;
use linkage::error::{Advice, Error, ErrorKind, Result};
use linkage::input::Input;
use linkage::math::{KeepNan, Vec2, cross, root, rotated, turned, unit};
use linkage::mechanism::{GROUND, LinkId};

/// Largest rotation of the crank between two poses (rad): one degree.
const TRACKING_STEP: f64 = std::f64::consts::PI / 180.0;
/// Largest number of times a failing step is halved. The smallest step is about a millionth of the step before halving.
const HALVINGS: u32 = 20;
/// Largest rotation of a link in one step (rad) that is accepted as a continuation of the branch.
const MAX_TURN: f64 = 0.3;
/// Newton's method ends if the last change is at most this value (rad).
const LAST_CHANGE: f64 = 1e-9;

/// Transfer functions of leads and base link at one crank angle, in the order of [`Triad::links`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transfer {
    /// Directions of the links' x axes.
    pub directions: [Vec2; 4],
    /// First transfer functions: derivatives of the links' angles with respect to the crank angle.
    pub first: [f64; 4],
    /// Second transfer functions (1/rad).
    pub second: [f64; 4],
    /// The conditional driver: 0, 1 or 2 as in [`Triad::leads`].
    pub driver: usize,
    /// Factor by which rounding errors of the angles can be amplified, at least 1.
    /// The factor is the inverse of the product of a sine and a cosine.
    /// The sine belongs to the angle between the base link and the ground lead that does not drive.
    /// The cosine belongs to the angle between lead 3 and the path of its head.
    pub condition: f64,
}

impl Transfer {
    /// Angular velocities (rad/s) and accelerations (rad/s^2) of leads and base link.
    /// `omega` and `alpha` are the crank's angular velocity and acceleration.
    #[must_use]
    pub fn rates(&self, omega: f64, alpha: f64) -> [[f64; 4]; 2] {
        let second = |k: usize| self.second[k] * omega * omega + self.first[k] * alpha;
        [self.first.map(|slope| slope * omega), [0, 1, 2, 3].map(second)]
    }
}

/// Follows the group over crank angles on one branch.
#[derive(Clone, Debug)]
pub struct ClassChange {
    input: Input,
    /// World angle of the x axis of the crank's frame when the drive's crank angle is zero (rad).
    zero: f64,
    names: String,
    /// World position of the crank's pivot, and the vector from the pivot to the crank pin in the crank's frame (m).
    pivot: Vec2,
    pin: Vec2,
    /// Indices of the ground leads and of lead 3 among the triad's leads.
    order: [usize; 3],
    grounded: [Grounded; 2],
    /// Head of lead 3 in the base link's frame, and length of lead 3 (m).
    third: Vec2,
    length: f64,
    /// Vectors from foot to head in the frames of the triad's leads, then the vector between the heads of the ground
    /// leads in the frame of the base link.
    locals: [Vec2; 4],
    crank: f64,
    /// World vectors from foot to head of the ground leads.
    spans: [Vec2; 2],
    last: Transfer,
    /// Sign of the group's determinant; zero before the first pose.
    branch: f64,
}

impl ClassChange {
    /// Starts at the start pose of the case.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] unless two leads of the group are attached to the ground and the third to a driving
    /// link that turns;
    /// [`ErrorKind::Geometry`] if the start pose is a dead point.
    pub fn new(case: &Case, triad: &Triad) -> Result<Self> {
        let (mechanism, drive) = (&case.mechanism, case.crank());
        let hung_on = |link: LinkId| (0..3).filter(move |&k| triad.leads[k].support.link == link);
        let grounds: Vec<usize> = hung_on(GROUND).collect();
        let driven: Vec<usize> = hung_on(drive.link).collect();
        let joint = &mechanism.joints()[drive.joint];
        let turns = joint.is_pin();
        let (&[a, b], &[c], true, Some(own)) = (&grounds[..], &driven[..], turns, joint.on(drive.link)) else {
            return Err(unsupported(case, triad));
        };
        let grounded = [a, b].map(|k| {
            let lead = triad.leads[k];
            Grounded { foot: lead.support.local, length: (lead.head - lead.foot).norm(), on_base: lead.on_base }
        });
        let spans = triad.leads.map(|lead| lead.head - lead.foot);
        let start = |link: LinkId| unit(case.start.0[link].angle);
        let last = Transfer {
            directions: triad.links().map(start),
            first: [0.0; 4],
            second: [0.0; 4],
            driver: a,
            condition: f64::INFINITY,
        };
        let mut change = ClassChange {
            input: drive.input,
            zero: drive.zero,
            names: names(case, triad),
            pivot: joint.other(drive.link).local,
            pin: triad.leads[c].support.local - own,
            order: [a, b, c],
            grounded,
            third: triad.leads[c].on_base,
            length: spans[c].norm(),
            locals: [spans[0], spans[1], spans[2], grounded[1].on_base - grounded[0].on_base],
            crank: drive.start,
            spans: [a, b].map(|k| rotated(last.directions[k], spans[k])),
            last,
            branch: 0.0,
        };
        change.step_to(drive.start, 0)?;
        Ok(change)
    }

    /// Transfer functions at the crank angle `crank` (rad, as the scenario states it).
    /// The branch is followed in small steps of the crank angle, from the crank angle of the previous call as far as
    /// `crank`.
    ///
    /// # Errors
    /// [`ErrorKind::Geometry`] if the branch has a dead point between the previous crank angle and `crank`.
    pub fn solve(&mut self, crank: f64) -> Result<&Transfer> {
        let from = self.crank;
        let parts = ((crank - from).abs() / TRACKING_STEP).ceil().larger(1.0);
        for part in 1..parts as usize {
            self.step_to(from + (crank - from) * (part as f64 / parts), HALVINGS)?;
        }
        self.step_to(crank, HALVINGS)?;
        Ok(&self.last)
    }

    fn step_to(&mut self, target: f64, halvings: u32) -> Result<()> {
        if self.try_step(target).is_some() {
            return Ok(());
        }
        if halvings == 0 {
            let (names, at) = (&self.names, self.input.at(target));
            return Err(Error::new(ErrorKind::Geometry, sentences::class_change_the_group_cannot(&names, &at))
                .at_input(at)
                .of_group(names)
                .help(Advice::ShortenGrid));
        }
        self.step_to((self.crank + target) / 2.0, halvings - 1)?;
        self.step_to(target, halvings - 1)
    }

    /// Returns the chain driven by the ground lead `driver`, in the configuration of the last pose, and the last pose
    /// itself.
    fn chain(&self, driver: usize) -> Option<(Chain, Place)> {
        let other = 1 - driver;
        let leads = [self.grounded[driver], self.grounded[other]];
        let head = |k: usize| self.grounded[k].foot + self.spans[k];
        let side = cross(self.grounded[other].foot - head(driver), head(other) - head(driver)).signum();
        let chain = Chain { leads, third: self.third, side };
        Some((chain, chain.place(self.spans[driver])?))
    }

    fn try_step(&mut self, target: f64) -> Option<()> {
        let both = [0, 1].map(|driver| self.chain(driver));
        let sine = |k: usize| both[k].map_or(0.0, |(_, place)| place.sine().abs());
        let driver = usize::from(sine(1) > sine(0));
        let (chain, before) = both[driver]?;
        let pin = rotated(unit(self.zero + target), self.pin);
        let closing = |place: &Place| place.third - (self.pivot + pin);
        let lead = self.order[driver];
        let change = target - self.crank;
        let expected = change * (self.last.first[lead] + 0.5 * change * self.last.second[lead]);
        let gap = |turn: f64| {
            let place = chain.place(rotated(unit(turn), before.driver))?;
            let q = closing(&place);
            Some((q.norm_squared() - self.length.powi(2), 2.0 * q.dot(&place.slopes().third[0])))
        };
        let turn = zero(gap, expected)?;
        let place = chain.place(rotated(unit(turn), before.driver))?;
        let found = self.transfer(driver, &place, closing(&place), pin);
        // q . F' times the area of the first dyad is the determinant of the group.
        // If the ground leads are exchanged, two columns of the determinant are exchanged, and its sign changes.
        let sense = if driver == 0 { 1.0 } else { -1.0 };
        let branch = (closing(&place).dot(&place.slopes().third[0]) * place.sine() * sense).signum();
        let near = |k: usize| {
            let (was, now) = (self.last.directions[k], found.directions[k]);
            was.dot(&now) > 0.0 && cross(was, now).abs() <= MAX_TURN
        };
        let rates = found.first.iter().chain(&found.second);
        if !((0..4).all(near) && rates.into_iter().all(|rate| rate.is_finite()) && branch * self.branch >= 0.0) {
            return None;
        }
        (self.crank, self.branch, self.last) = (target, branch, found);
        self.spans = if driver == 0 { [place.driver, place.other] } else { [place.other, place.driver] };
        Some(())
    }

    /// Transfer functions at a pose of the chain, with q = F - C and the crank's arm `pin`.
    fn transfer(&self, driver: usize, place: &Place, q: Vec2, pin: Vec2) -> Transfer {
        let slopes = place.slopes();
        let [f, ff] = slopes.third;
        let [c, cc] = [turned(pin), -pin];
        let first = q.dot(&c) / q.dot(&f);
        let q1 = f * first - c;
        let second = (q.dot(&cc) - q1.norm_squared() - q.dot(&ff) * first * first) / q.dot(&f);
        let q2 = ff * (first * first) + f * second - cc;
        let chained = |slope: [f64; 2]| [slope[0] * first, slope[1] * first * first + slope[0] * second];
        let [lead, other, third] = [self.order[driver], self.order[1 - driver], self.order[2]];
        let sense = if driver == 0 { 1.0 } else { -1.0 };
        let found = [
            (lead, place.driver, [first, second]),
            (other, place.other, chained(slopes.other)),
            (third, q, [cross(q, q1), cross(q, q2)].map(|value| value / q.norm_squared())),
            (3, place.base * sense, chained(slopes.base)),
        ];
        let meeting = q.dot(&f).abs() / (q.norm() * f.norm());
        let mut transfer = Transfer { driver: lead, condition: 1.0 / (place.sine().abs() * meeting), ..self.last };
        for (link, world, [first, second]) in found {
            transfer.directions[link] = along(self.locals[link], world);
            (transfer.first[link], transfer.second[link]) = (first, second);
        }
        transfer
    }
}

/// The error of a chain that cannot be placed.
struct Ended;

/// The zero next to `guess` (rad) of a function, found by Newton's method with bisection between bounds.
/// `gap` returns the value of the function and its derivative.
/// `None` if there is no zero within [`MAX_TURN`], or if the function is undefined between `guess` and the zero.
fn zero(gap: impl Fn(f64) -> Option<(f64, f64)>, guess: f64) -> Option<f64> {
    let (value, slope) = gap(guess)?;
    if value == 0.0 {
        return Some(guess);
    }
    let newton = value / slope;
    let width = -newton.signum() * (2.0 * newton.abs()).clamp(f64::EPSILON, MAX_TURN);
    let gap = |turn: f64| gap(turn).ok_or(Ended);
    let ahead = |turn: f64| gap(turn).map(|(value, _)| value);
    let [_, (beyond, _)] = root::widened((guess, value), width, MAX_TURN, ahead).ok()??;
    root::newton([guess, beyond], value < 0.0, guess, LAST_CHANGE, gap).ok()?
}

fn names(case: &Case, triad: &Triad) -> String {
    triad.links().map(|link| case.mechanism.links()[link].name.as_str()).join(", ")
}

fn unsupported(case: &Case, triad: &Triad) -> Error {
    let links = case.mechanism.links();
    let supports = triad.leads.map(|lead| links[lead.support.link].name.as_str()).join(", ");
    let (names, crank) = (names(case, triad), &links[case.crank().link].name);
    let message = sentences::class_change_asks_for_a_group(&crank, &names, &supports);
    Error::new(ErrorKind::Unsupported, message).help(sentences::USE_CRAMER_RULE_WHICH_TAKES)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_zero_is_found_where_plain_newton_diverges() {
        // From the guess 0.1, Newton's method on atan(20 x) goes to -0.18, then to 0.7, and diverges.
        let steep = |x: f64| Some(((20.0 * x).atan(), 20.0 / (1.0 + 400.0 * x * x)));
        assert!(zero(steep, 0.1).unwrap().abs() < f64::EPSILON);
        assert_eq!(zero(|x| Some((x * x + 1.0, 2.0 * x)), 0.1), None);
        assert_eq!(zero(|x| (x < 0.1).then_some((x - 0.2, 1.0)), 0.0), None);
        assert_eq!(zero(|_| Some((f64::NAN, f64::NAN)), 0.0), None);
    }
}
