//! The input of every solver: mechanism, drives, loads, start pose, grid of instants and requested channels.

mod builder;
mod check;
mod driven_at;
mod friction;
mod grid;
mod numbers;
mod only;
mod parts;
mod scene;
mod seats;
mod turning;

use std::collections::BTreeSet;
use std::ops::Deref;

use crate::Result;
use crate::drive::load::sense_of;
use crate::drive::{Action, Course, Drive, InputState, Load, LoadState, Motor, Senses, Wrench};
use crate::input::{Input, InputValue};
use crate::math::{KeepNan, Motion, Vec2};
use crate::mechanism::{GROUND, Joint, JointId, JointSide, Link, LinkId};
use crate::trajectory::{CHANNELS, Channel, ChannelSubject, OfLink, Reading, Stage};

pub use builder::CaseBuilder;
pub use friction::{Friction, FrictionSeat, JointReactions};
pub use grid::{Grid, When};
pub use numbers::{CaseNumber, load_places};
pub use parts::{CaseParts, Wanted};
pub use scene::{LeftOut, Scene};
pub use seats::{Seat, Seats};

/// An angular velocity below this fraction of the largest angular velocity of any link counts as rounding error.
/// A link with such an angular velocity has no sense of rotation.
pub const STANDSTILL: f64 = 1e-12;

/// A complete, checked problem that any solver accepts.
///
/// The parts are accessible as fields, for example `case.mechanism`.
/// A case is immutable: a method such as [`Case::with`] returns a new case, changed and checked.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    parts: CaseParts,
    /// For every link, one link that represents its class. The angles of all links in a class differ only by constants.
    classes: Vec<LinkId>,
    /// A joint at or below this speed (rad/s) counts as standing still.
    /// The limit is the rounding error of the drives' top speeds.
    standstill: f64,
}

impl Deref for Case {
    type Target = CaseParts;

    #[inline]
    fn deref(&self) -> &CaseParts {
        &self.parts
    }
}

impl Case {
    /// Checks the parts and returns their case.
    ///
    /// # Errors
    /// Every error names the faulty part by its key.
    /// [`ErrorKind::Input`](crate::ErrorKind::Input) if drives, loads, start pose or modes do not belong to the
    /// mechanism.
    /// [`ErrorKind::Input`](crate::ErrorKind::Input) also if a number in one of these parts is NaN, infinite or out of
    /// range.
    /// [`ErrorKind::Input`](crate::ErrorKind::Input) also if the structure does not match mechanism and drives.
    /// [`ErrorKind::Geometry`](crate::ErrorKind::Geometry) if a joint is open in the start pose, a driven joint is
    /// not at the start coordinate of its drive, or a crank has no length.
    /// [`ErrorKind::Unsupported`](crate::ErrorKind::Unsupported) for an input that the driven joint does not have, and
    /// for a combination of drives that this version does not solve.
    /// The errors of [`Structure::of`](crate::mechanism::Structure::of) and [`Grid::check`] are passed on.
    pub fn new(parts: CaseParts) -> Result<Case> {
        check::all(&parts)?;
        let classes = turning::classes(&parts);
        Ok(Case::made(parts, classes))
    }

    fn made(parts: CaseParts, classes: Vec<LinkId>) -> Case {
        let standstill = STANDSTILL * parts.drives.top_speed(parts.mechanism.size());
        Case { parts, classes, standstill }
    }

    /// Returns a case made of `parts`, the changed parts of this case.
    /// The change must leave the classes of links unchanged, because they are copied from this case.
    fn of_parts(&self, parts: CaseParts) -> Case {
        Case::made(parts, self.classes.clone())
    }

    /// Returns the parts of this case. To make a new case, change the parts and pass them to [`Case::new`].
    #[must_use]
    pub fn into_parts(self) -> CaseParts {
        self.parts
    }

    /// Changes the parts of this case by `change`, checks the changed parts and returns their case.
    ///
    /// # Errors
    /// The errors of [`Case::new`].
    pub fn with(&self, change: impl FnOnce(&mut CaseParts)) -> Result<Case> {
        let mut parts = self.parts.clone();
        change(&mut parts);
        Case::new(parts)
    }

    /// Changes coordinates, masses and moments of inertia of links, and positions of joints on links, without a check.
    /// Names, kinds and order must remain. The start pose is not changed, so it may no longer fit the mechanism.
    pub fn renumber(&mut self, change: impl FnOnce(&mut [Link], &mut [Joint])) {
        self.parts.mechanism.renumber(change);
        self.standstill = STANDSTILL * self.parts.drives.top_speed(self.parts.mechanism.size());
    }

    /// Returns this case with the grid `grid`.
    ///
    /// # Errors
    /// The errors of [`Grid::check`].
    pub fn on(&self, grid: Grid) -> Result<Case> {
        check::grid(&grid, &self.drives)?;
        Ok(self.of_parts(CaseParts { grid, ..self.parts.clone() }))
    }

    /// Returns this case with a request for all channels of the stages in `wanted`.
    #[must_use]
    pub fn wanting(&self, wanted: Wanted) -> Case {
        self.of_parts(CaseParts { wanted, only: None, ..self.parts.clone() })
    }

    /// Returns this case with a request for `channels` only, in place of the present request.
    /// Channels that the case does not have are ignored.
    #[must_use]
    pub fn wanting_only(&self, channels: &[Channel]) -> Case {
        let stages: Vec<Stage> = channels.iter().map(|channel| channel.kind.stage).collect();
        let mut case = self.wanting(Wanted::of(&stages));
        let key = |channel: &Channel| (channel.kind.subject, channel.of.clone(), channel.kind.suffix);
        let asked: BTreeSet<_> = channels.iter().map(key).collect();
        let all = case.channels();
        let own: Vec<Channel> = all.iter().filter(|channel| asked.contains(&key(channel))).cloned().collect();
        case.parts.only = (own.len() < all.len()).then_some(own);
        case
    }

    /// Returns this case with the given motor of the crank, or without a motor.
    ///
    /// # Errors
    /// The errors of [`Case::new`], for example if a number of the motor is NaN or out of range.
    pub fn with_motor(&self, motor: Option<Motor>) -> Result<Case> {
        self.with(|parts| *parts.drives.crank_mut() = self.crank().with_motor(motor))
    }

    /// Returns this case with every drive replaced by its nominal motion.
    /// The crank angles of the grid belong to the nominal motion.
    #[must_use]
    pub fn nominal(&self) -> Case {
        self.of_parts(CaseParts { drives: self.drives.map(Drive::nominal), ..self.parts.clone() })
    }

    /// Returns this case with the crank at constant speed: the top speed of its drive.
    #[must_use]
    pub fn at_top_speed(&self) -> Case {
        let mut drives = self.drives.clone();
        *drives.crank_mut() = self.crank().at_top_speed();
        self.of_parts(CaseParts { drives, ..self.parts.clone() })
    }

    /// Requested channels in the order of columns: links, points, joints, sliders, frictions, transmissions, frame,
    /// drives.
    /// Within each subject the order is that of [`CHANNELS`].
    #[must_use]
    pub fn channels(&self) -> Vec<Channel> {
        self.only.clone().unwrap_or_else(|| self.channels_of(|stage| self.wanted.has(stage)))
    }

    /// All channels that the case can have, in the order of [`Case::channels`].
    #[must_use]
    pub fn all_channels(&self) -> Vec<Channel> {
        self.channels_of(|_| true)
    }

    fn channels_of(&self, is_wanted: impl Fn(Stage) -> bool) -> Vec<Channel> {
        let rows = |(subject, of, _): (ChannelSubject, &str, Seat)| {
            let kinds = CHANNELS.iter().filter(|kind| kind.subject == subject && is_wanted(kind.stage));
            kinds.map(|kind| Channel { of: of.to_string(), kind }).collect::<Vec<_>>()
        };
        self.subjects().flat_map(rows).collect()
    }

    /// Whether unwrapped angles of links are needed.
    /// If only some channels are requested, angles are needed only if one of these channels is the angle of a link.
    #[must_use]
    pub fn wants_angles(&self) -> bool {
        self.only.as_ref().is_none_or(|only| only.iter().any(|own| own.kind.reading == Reading::Link(OfLink::Angle)))
    }

    /// The first drive (the crank), whose input identifies an instant.
    #[inline]
    pub fn crank(&self) -> &Drive {
        self.drives.crank()
    }

    /// The input with the value `value`, formatted for messages.
    pub fn told(&self, value: f64) -> InputValue {
        self.crank().told(value)
    }

    /// Value of the input in a state of the mechanism, in the scenario's convention.
    /// The arguments are the same as in [`Case::each_load`].
    #[inline]
    #[must_use]
    pub fn input_in(&self, motions: &[Motion], angles: &[f64]) -> f64 {
        self.state_in(motions, angles).value
    }

    /// Value, rate and acceleration of the input in a state of the mechanism.
    /// The arguments are the same as in [`Case::each_load`].
    #[inline]
    pub fn state_in(&self, motions: &[Motion], angles: &[f64]) -> InputState {
        self.drive_state(self.crank(), motions, angles)
    }

    /// Value, rate and acceleration of the input of a drive in a state of the mechanism.
    /// The other arguments are the same as in [`Case::each_load`].
    #[inline]
    pub fn drive_state(&self, drive: &Drive, motions: &[Motion], angles: &[f64]) -> InputState {
        let joint = &self.mechanism.joints()[drive.joint];
        let [value, rate, acceleration] = match drive.input {
            Input::Angle => [angles[drive.link], motions[drive.link].omega, motions[drive.link].alpha],
            Input::Turn => {
                let [first, second] = [joint.first.link, joint.second.link];
                let [one, other] = [&motions[first], &motions[second]];
                [angles[second] - angles[first], other.omega - one.omega, other.alpha - one.alpha]
            }
            Input::Slide => joint.slide(motions).expect("the driven joint slides"),
        };
        InputState { value: drive.from_coordinate(value), rate, acceleration }
    }

    /// The coordinate of the first drive, its rate and its acceleration, each as a sum of channels with signs.
    /// The coordinate differs from the input by the drive's zero.
    #[must_use]
    pub fn input_channels(&self) -> [Vec<(Channel, f64)>; 3] {
        let drive = self.crank();
        let joint = &self.mechanism.joints()[drive.joint];
        let named = |subject: &str, of: &str, suffix: &str, sign: f64| {
            let channel = Channel::named(&format!("{subject}.{of}.{suffix}")).expect("the channel is in the table");
            (channel, sign)
        };
        let link =
            |link: LinkId, suffix: &str, sign: f64| named("link", &self.mechanism.links()[link].name, suffix, sign);
        let of_links = ["angle_rad", "omega_rad_s", "alpha_rad_s2"];
        match drive.input {
            Input::Angle => of_links.map(|suffix| vec![link(drive.link, suffix, 1.0)]),
            Input::Turn => {
                of_links.map(|suffix| vec![link(joint.second.link, suffix, 1.0), link(joint.first.link, suffix, -1.0)])
            }
            Input::Slide => ["slide_m", "slide_speed_m_s", "slide_acceleration_m_s2"]
                .map(|suffix| vec![named("joint", &joint.name, suffix, 1.0)]),
        }
    }

    /// Actions of the moment (N m) or force (N) of a drive.
    /// For a crank, the first action is on the frame, and the second action is on the crank.
    /// At a joint between moving links, and for a slide, the first action is on the joint's first link, and the second
    /// action is on the joint's second link; the first link exerts the moment or force on the second link.
    #[must_use]
    pub fn effort(&self, drive: &Drive, effort: f64, motions: &[Motion]) -> [Action; 2] {
        match drive.input {
            Input::Angle => [Action::of_moment(GROUND, -effort), Action::of_moment(drive.link, effort)],
            Input::Turn | Input::Slide => Action::pair(&self.mechanism.joints()[drive.joint], effort, motions),
        }
    }

    /// Whether the pose is a function of the time instead of the first drive's input.
    /// The pose is a function of the time if there are several drives and the speed of at least one drive varies.
    #[must_use]
    pub fn goes_by_time(&self) -> bool {
        self.drives.len() > 1 && self.drives.iter().any(|drive| drive.constant_speed().is_none())
    }

    /// Step of the variable that determines the pose: the time (s) if [`Case::goes_by_time`], otherwise the input of
    /// the first drive.
    /// During this step, every driving link turns by at most `turn` (rad). With a single drive, the step is
    /// [`Case::step`].
    #[must_use]
    pub fn stride(&self, turn: f64) -> f64 {
        if self.drives.further().is_empty() {
            return self.step(turn);
        }
        let time = turn / self.drives.top_speed(self.mechanism.size());
        if self.goes_by_time() { time } else { time * self.crank().at(0.0).rate.abs() }
    }

    /// Change of the input that corresponds to a rotation of a driving link by `turn` (rad). A slide changes by the
    /// fraction `turn` of the mechanism's size.
    #[inline]
    #[must_use]
    pub fn step(&self, turn: f64) -> f64 {
        turn * self.crank().input.span(self.mechanism.size())
    }

    /// Whether forces determine the motion of a driving link (a free motion).
    /// In a free motion, crank angles are known only from a solved trajectory.
    /// The crank angles of the grid belong to the nominal motion.
    #[must_use]
    pub fn is_free(&self) -> bool {
        self.drives.iter().any(Drive::is_free)
    }

    /// Whether the mechanism continues through change points: see [`Drive::passes`].
    /// Near a change point, reactions and friction grow without bound, so a mechanism with friction does not continue.
    /// A mechanism with several drives does not continue either.
    #[must_use]
    pub fn passes(&self) -> bool {
        self.drives.further().is_empty() && self.crank().passes() && !self.has_friction()
    }

    /// Whether every drive has a prescribed constant speed.
    #[must_use]
    pub fn is_steady(&self) -> bool {
        !self.is_free() && self.drives.iter().all(|drive| drive.constant_speed().is_some())
    }

    /// Lever arm of the balancing moments (m): the extent of the largest driving link.
    /// If a driving link has a slider, the lever arm is at least the size of the mechanism, because a slider's force
    /// acts at the slider's position.
    #[must_use]
    pub fn drive_arm(&self) -> f64 {
        let links = self.mechanism.links();
        let arm = |link: LinkId| {
            let has_slider = self.mechanism.joints().iter().any(|joint| joint.slides() && joint.on(link).is_some());
            links[link].extent().larger(if has_slider { self.mechanism.size() } else { 0.0 })
        };
        self.drives.iter().map(|drive| arm(drive.link)).fold(0.0, f64::larger)
    }

    /// Calls `put` with the action of every load on every link, the ground included.
    /// Friction in joints and losses of transmissions are included. Friction and losses follow from `reactions`.
    /// `motions` and `angles` contain the motion and the angle (rad, unwrapped) of every link, as in
    /// [`State`](crate::solver::State).
    /// Loads depend on positions and velocities, not on accelerations.
    #[inline]
    pub fn each_load(
        &self,
        motions: &[Motion],
        angles: &[f64],
        reactions: JointReactions,
        mut put: impl FnMut(Action),
    ) {
        let setting = self.setting(motions, angles);
        for load in &self.loads {
            self.act_in(&setting, load, &mut put);
        }
        for friction in self.frictions() {
            friction.act(friction.effort(motions, reactions), motions).into_iter().for_each(&mut put);
        }
    }

    /// Power of all loads (W), positive if the loads drive the mechanism.
    /// The arguments are the same as in [`Case::each_load`].
    #[must_use]
    pub fn load_power(&self, motions: &[Motion], angles: &[f64], reactions: JointReactions) -> f64 {
        let mut power = 0.0;
        self.each_load(motions, angles, reactions, |action| power += action.power(&motions[action.link]));
        power
    }

    /// Whether a load or the loss of a transmission depends on a sense of motion.
    #[must_use]
    pub fn has_sense(&self) -> bool {
        self.senses().any(|senses| senses != Senses::Nothing)
    }

    /// Calls `put` with the action of load number `load` on each of the load's links.
    /// The other arguments are the same as in [`Case::each_load`].
    pub fn each_action(&self, load: usize, motions: &[Motion], angles: &[f64], mut put: impl FnMut(Action)) {
        self.act_in(&self.setting(motions, angles), &self.loads[load], &mut put);
    }

    #[inline]
    fn act_in(&self, setting: &LoadState, load: &Load, put: &mut impl FnMut(Action)) {
        match load.nature().senses {
            Senses::Nothing => load.act(setting, put),
            Senses::Link(link) => {
                put(Action::of_moment(link, load.moment_in(self.spin(setting.motions, link), setting.crank)));
            }
            Senses::Point(at) if self.moves(setting.motions, at) => load.act(setting, put),
            Senses::Joint(joint) => {
                let (mut rate, own) = (self.joint_rate(setting.motions, joint), &setting.joints[joint]);
                // If forces determine the motion, a load on a joint at rest acts in the sense of the motion that begins.
                if rate == 0.0 && self.is_free() && self.can_move(joint) {
                    rate = own.rates(setting.motions)[1];
                }
                Action::pair(own, load.moment_in(rate, setting.crank), setting.motions).into_iter().for_each(put);
            }
            Senses::Point(_) => {}
        }
    }

    /// Crank angles (rad) at which tables of loads jump, each with the period of its table (rad).
    pub fn load_jumps(&self) -> impl Iterator<Item = [f64; 2]> {
        self.loads.iter().flat_map(Load::courses).flat_map(Course::jumps)
    }

    /// Breakpoints (rad or m) of all tables of loads, each list with the period after which it repeats.
    pub fn load_knots(&self) -> impl Iterator<Item = (&[f64], f64)> {
        self.loads.iter().flat_map(Load::courses).filter_map(Course::knots)
    }

    /// Whether a link can turn. A slider on the ground and the coupler of a parallelogram only translate.
    #[inline]
    #[must_use]
    pub fn can_turn(&self, link: LinkId) -> bool {
        self.classes[link] != self.classes[GROUND]
    }

    /// Whether a joint can move. Some revolute joints cannot move.
    /// For example, two sliders on fixed guides cannot turn about their common pin.
    #[must_use]
    pub fn can_move(&self, joint: JointId) -> bool {
        let joint = &self.mechanism.joints()[joint];
        joint.slides() || self.classes[joint.first.link] != self.classes[joint.second.link]
    }

    /// Angular velocity of a link (rad/s), for loads that depend on its sense of rotation.
    /// The result is zero for a link that cannot turn.
    /// The result is also zero if the angular velocity is not larger than the rounding error of the fastest link's
    /// angular velocity.
    #[inline]
    #[must_use]
    pub fn spin(&self, motions: &[Motion], link: LinkId) -> f64 {
        let omega = motions[link].omega;
        // If the angular velocity of any link is NaN, `is_seen` returns false and the result is zero.
        let is_seen = || motions.iter().all(|motion| omega.abs() > STANDSTILL * motion.omega.abs());
        if self.can_turn(link) && is_seen() { omega } else { 0.0 }
    }

    /// Whether a point of a link moves. A speed that may be a rounding error of the mechanism's speeds counts as
    /// standstill.
    #[must_use]
    pub fn moves(&self, motions: &[Motion], at: JointSide) -> bool {
        let speed = motions[at.link].point_velocity(at.local).norm();
        speed > STANDSTILL * fastest(motions) * self.mechanism.size()
    }

    #[inline]
    fn setting<'a>(&'a self, motions: &'a [Motion], angles: &'a [f64]) -> LoadState<'a> {
        let crank = self.input_in(motions, angles);
        LoadState { motions, angles, joints: self.mechanism.joints(), start: &self.start.0, crank }
    }

    /// Writes to `out` the resultant of all loads except friction on every link, the ground included.
    /// A resultant is a force (N) at the mass centre and a moment (N m) about the mass centre.
    /// `out` has one entry per link. The other arguments are the same as in [`Case::each_load`].
    #[inline]
    pub fn loads_on(&self, motions: &[Motion], angles: &[f64], out: &mut [Wrench]) {
        self.loads_with(motions, angles, |_, load, crank| load.moment_in(self.load_rate(load, motions), crank), out);
    }

    /// The rate on whose sign a load depends: the angular velocity of a link (rad/s) or the rate of a joint (rad/s or
    /// m/s).
    /// The result is zero for a load that depends neither on the angular velocity of a link nor on the rate of a joint.
    /// The result is also zero if the rate may be only a rounding error.
    #[must_use]
    pub fn load_rate(&self, load: &Load, motions: &[Motion]) -> f64 {
        match load.nature().senses {
            Senses::Link(link) => self.spin(motions, link),
            Senses::Joint(joint) => self.joint_rate(motions, joint),
            Senses::Nothing | Senses::Point(_) => 0.0,
        }
    }

    /// Like [`Case::loads_on`], but the caller computes loads that depend on a link's sense of rotation or a joint's
    /// sense of sliding.
    /// `sensed` returns the moment (N m) or force (N) of such a load.
    /// `sensed` receives the number of the load, the load and the crank angle (rad).
    /// `sensed` is not called for a load that depends on the sense of rotation of a link that cannot turn: this load is
    /// zero.
    #[inline]
    pub fn loads_with(
        &self,
        motions: &[Motion],
        angles: &[f64],
        sensed: impl Fn(usize, &Load, f64) -> f64,
        out: &mut [Wrench],
    ) {
        self.loads_along(motions, angles, ANY_CRANK, sensed, |_, velocity| sense_of(velocity), out);
    }

    /// Like [`Case::loads_with`], but the caller also determines the direction in which loaded points move.
    /// `way` returns this direction (unit vector, or zero) for each load that depends on the direction.
    /// `way` receives the number of the load and the point's velocity (m/s).
    /// If the velocity is only rounding error, `way` receives zero.
    /// The tables of the loads are read at the crank angle limited to the interval `piece` (rad).
    /// If the crank angle passes an end of the interval, no load therefore jumps.
    #[inline]
    pub fn loads_along(
        &self,
        motions: &[Motion],
        angles: &[f64],
        piece: [f64; 2],
        sensed: impl Fn(usize, &Load, f64) -> f64,
        way: impl Fn(usize, Vec2) -> Vec2,
        out: &mut [Wrench],
    ) {
        out.fill(Wrench::ZERO);
        if self.loads.is_empty() {
            return;
        }
        let links = self.mechanism.links();
        let mut setting = self.setting(motions, angles);
        setting.crank = setting.crank.larger(piece[0]).smaller(piece[1]);
        let mut add = |action: Action| out[action.link].add(&action, &motions[action.link], &links[action.link]);
        for (index, load) in self.loads.iter().enumerate() {
            match load.nature().senses {
                Senses::Nothing => load.act(&setting, &mut add),
                Senses::Link(link) if self.can_turn(link) => {
                    add(Action::of_moment(link, sensed(index, load, setting.crank)));
                }
                Senses::Point(at) => {
                    let motion = &motions[at.link];
                    let velocity =
                        if self.moves(motions, at) { motion.point_velocity(at.local) } else { Vec2::zeros() };
                    let force = load.force_in(way(index, velocity));
                    add(Action { link: at.link, force, place: motion.point(at.local), moment: 0.0 });
                }
                Senses::Joint(joint) => {
                    let effort = sensed(index, load, setting.crank);
                    Action::pair(&setting.joints[joint], effort, motions).into_iter().for_each(&mut add);
                }
                Senses::Link(_) => {}
            }
        }
    }
}

/// The interval of all crank angles (rad).
pub const ANY_CRANK: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

/// Largest absolute angular velocity of the links (rad/s).
fn fastest(motions: &[Motion]) -> f64 {
    motions.iter().fold(0.0, |most, motion| most.larger(motion.omega.abs()))
}
