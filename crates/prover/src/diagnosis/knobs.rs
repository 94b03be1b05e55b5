//! "Knobs": parts of a case that can be changed by one number each. This module lists the knobs of a case and changes
//! their values.
//! See docs/numerics/diagnosis.md.

use crate::sentences;
use std::f64::consts::PI;

use super::cause::{CasePart, FrameAxis, PartChange};
use super::configurations::reassembled;
use linkage::case::{Case, CaseParts, Grid};
use linkage::drive::{Drive, DriveMotion, MotionLaw, Motor, ShaftInertia};
use linkage::input::Input;
use linkage::math::{KeepNan, Vec2, unit};
use linkage::mechanism::{
    Joint, JointId, JointKind, Link, LinkId, Mechanism, Transmission, TransmissionDesign, TransmissionId,
    TransmissionKind,
};

/// Sets a new value in the parts of a case; `None` if the value is impossible.
type Turn = Box<dyn Fn(&mut CaseParts, f64) -> Option<()>>;

/// The channels on which a part has an effect if the motion is prescribed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shows {
    /// Only reactions and moments.
    Forces,
    /// The motion, and the forces that depend on it.
    Motion,
    /// Forces, and positions of mass centres.
    Centres,
}

/// A part of a case that can be changed by one number.
pub(super) struct Knob {
    pub(super) part: CasePart,
    /// Value of the part in the case, and the unit of this value.
    pub(super) given: f64,
    pub(super) unit: &'static str,
    /// Values with a simple meaning, such as twice the given value, the simplest first.
    pub(super) plain: Vec<(f64, PartChange)>,
    /// A small change of the value with which the effect of the part is estimated.
    pub(super) nudge: f64,
    pub(super) shows: Shows,
    /// Whether a linear approximation is useless for values far from the given value.
    pub(super) is_far: bool,
    turn: Turn,
}

impl Knob {
    /// The case with the value `value` of this part.
    pub(super) fn at(&self, case: &Case, value: f64) -> Option<Case> {
        remade(case, |parts| (self.turn)(parts, value))
    }

    /// The change of the part to the value `found`.
    pub(super) fn told(&self, found: f64) -> PartChange {
        PartChange::Instead { found, given: self.given, unit: self.unit }
    }

    /// The value rounded to a number of significant digits; angles are rounded in degrees.
    pub(super) fn significant(&self, value: f64, digits: usize) -> f64 {
        significant_in(self.unit == "rad", value, digits)
    }

    /// A knob for a quantity. Simple multiples of its value `given` are tried.
    fn amount(
        part: CasePart,
        given: f64,
        unit: &'static str,
        turn: impl Fn(&mut CaseParts, f64) -> Option<()> + 'static,
    ) -> Knob {
        let plain = vec![
            (0.0, PartChange::Missing),
            (-given, PartChange::Reversed),
            (2.0 * given, PartChange::Twice),
            (given / 2.0, PartChange::Half),
        ];
        let (nudge, turn) = (1e-3 * given, Box::new(turn));
        let knob = Knob { part, given, unit, plain, nudge, shows: Shows::Forces, is_far: false, turn };
        knob.times([(1e3, sentences::AS_FOR_KG_OR_FOR_MM), (1e-3, sentences::AS_KG_FOR_OR_MM_FOR)])
    }

    /// A knob for a coordinate or an angle. Multiples of its value have no meaning. The nudge is a fraction of
    /// `natural`.
    fn place(
        part: CasePart,
        given: f64,
        natural: f64,
        unit: &'static str,
        turn: impl Fn(&mut CaseParts, f64) -> Option<()> + 'static,
    ) -> Knob {
        let plain = if given == 0.0 { Vec::new() } else { vec![(-given, PartChange::Reversed)] };
        let (nudge, turn) = (1e-4 * natural, Box::new(turn));
        Knob { part, given, unit, plain, nudge, shows: Shows::Motion, is_far: false, turn }
    }

    fn also(mut self, plain: impl IntoIterator<Item = (f64, PartChange)>) -> Knob {
        self.plain.extend(plain);
        self
    }

    /// Adds values: the given value times each factor, with the meaning of the factor.
    fn times(self, factors: impl IntoIterator<Item = (f64, &'static str)>) -> Knob {
        let given = self.given;
        self.also(factors.into_iter().map(|(factor, told)| (factor * given, PartChange::Times(factor, told))))
    }

    fn moving(self) -> Knob {
        Knob { shows: Shows::Motion, ..self }
    }
}

/// All knobs of a case, the simplest first.
pub(super) fn all(case: &Case) -> Vec<Knob> {
    let mut knobs = Vec::new();
    let gravity = case.gravity;
    if gravity.norm() > 0.0 {
        knobs.push(Knob::amount(CasePart::Gravity, gravity.norm(), "m/s^2", move |parts, value| {
            parts.gravity = gravity * (value / gravity.norm());
            Some(())
        }));
    }
    knobs.extend((0..case.loads.len()).map(|index| load(case, index)));
    knobs.extend((0..case.loads.len()).filter_map(|index| free(case, index)));
    knobs.extend(motor(case));
    let moving = || case.mechanism.links().entries().skip(1);
    // A knob for all links together is added only if several links have the quantity. If only one link has the
    // quantity, the link's own knob has the same effect.
    if moving().filter(|(_, link)| link.mass > 0.0).count() > 1 {
        knobs.push(share(CasePart::Masses, |link, factor| link.mass *= factor));
    }
    if moving().filter(|(_, link)| link.inertia > 0.0).count() > 1 {
        knobs.push(share(CasePart::Inertias, |link, factor| link.inertia *= factor));
    }
    for (index, link) in moving().filter(|(_, link)| link.mass > 0.0) {
        let turn = move |parts: &mut CaseParts, mass| changed(parts, |links, _| links[index].mass = mass);
        knobs.push(Knob::amount(CasePart::Mass(link.name.clone()), link.mass, "kg", turn));
    }
    for (index, link) in moving().filter(|(_, link)| link.inertia > 0.0) {
        knobs.push(inertia(case, index, link));
    }
    for (index, drive) in case.drives.iter().enumerate() {
        knobs.extend(of_drive(case, index, drive));
    }
    for (index, transmission) in case.mechanism.transmissions().entries() {
        knobs.extend(of_transmission(index, transmission));
    }
    for (index, link) in moving().filter(|(_, link)| link.mass > 0.0) {
        knobs.extend([FrameAxis::X, FrameAxis::Y].map(|axis| mass_centre(index, link, axis)));
    }
    for (joint, link) in places(case) {
        knobs.extend([FrameAxis::X, FrameAxis::Y].map(|axis| place(case, joint, link, axis)));
    }
    knobs.extend(case.mechanism.joints().ids().flat_map(|joint| axes(case, joint)));
    knobs.extend(lengths(case));
    knobs
}

/// The directions of sliding of a joint on its two links.
fn axes(case: &Case, joint: JointId) -> Vec<Knob> {
    let own = &case.mechanism.joints()[joint];
    let Some(axes) = own.kind.axes() else { return Vec::new() };
    let knob = |side: usize| {
        let turn = move |parts: &mut CaseParts, angle: f64| {
            changed(parts, |_, joints| {
                let mut axes = axes;
                axes[side] = unit(angle);
                joints[joint.index()].kind = JointKind::Prismatic { axes };
            })?;
            reassembled(parts)
        };
        let link = [own.first, own.second][side].link;
        let part = CasePart::Axis(own.name.clone(), case.mechanism.links()[link].name.clone());
        Knob::place(part, axes[side].y.atan2(axes[side].x), 1.0, "rad", turn)
    };
    vec![knob(0), knob(1)]
}

/// Ratio and pressure angle of a transmission, or the lift of a cam.
fn of_transmission(index: TransmissionId, transmission: &Transmission) -> Vec<Knob> {
    let name = transmission.name();
    let own = transmission.design.clone();
    let turn =
        |size: f64| move |parts: &mut CaseParts, value: f64| recoupled(parts, index, own.times_ratio(value / size));
    let mut knobs = vec![match (&transmission.design.kind, transmission.ratio()) {
        (TransmissionKind::Cam { law, .. }, _) => {
            let unit = if transmission.slide().is_some() { "m" } else { "rad" };
            Knob::amount(CasePart::Lift(name.into()), law.range(), unit, turn(law.range())).moving()
        }
        (_, ratio) => {
            let ratio = ratio.expect("only cams have no ratio");
            let inverse = [((ratio * ratio).recip(), sentences::THE_INVERSE_RATIO)];
            Knob::amount(CasePart::Ratio(name.into()), ratio, "", turn(ratio)).moving().times(inverse)
        }
    }];
    knobs.extend(transmission.design.pressure_angle().map(|angle| {
        let own = transmission.design.clone();
        let turn = move |parts: &mut CaseParts, value: f64| recoupled(parts, index, own.with_pressure_angle(value));
        Knob::amount(CasePart::PressureAngle(name.into()), angle, "rad", turn)
    }));
    let (own, is_slide) = (transmission.design.clone(), transmission.slide().is_some());
    let turn = move |parts: &mut CaseParts, start: f64| {
        recoupled(parts, index, Some(TransmissionDesign { start, ..own.clone() }))?;
        reassembled(parts)
    };
    let (natural, unit) = if is_slide { (transmission.design.start.abs().larger(1e-3), "m") } else { (1.0, "rad") };
    knobs.push(Knob::place(CasePart::Phase(name.into()), transmission.design.start, natural, unit, turn));
    knobs
}

/// Replaces a transmission. Start pose and structure remain unchanged.
pub fn recoupled(parts: &mut CaseParts, index: TransmissionId, other: Option<TransmissionDesign>) -> Option<()> {
    let mut designs = parts.mechanism.transmission_designs();
    *designs.get_mut(index.index())? = other?;
    parts.mechanism = parts.mechanism.clone().with_transmissions(designs).ok()?;
    Some(())
}

/// The case with changed parts; `None` if the changed parts do not form a valid case.
pub fn remade(case: &Case, change: impl FnOnce(&mut CaseParts) -> Option<()>) -> Option<Case> {
    let mut parts = case.clone().into_parts();
    change(&mut parts)?;
    Case::new(parts).ok()
}

/// Changes links and joints. The structure remains unchanged.
pub fn changed(parts: &mut CaseParts, change: impl FnOnce(&mut [Link], &mut [Joint])) -> Option<()> {
    let (mut links, mut joints) = (parts.mechanism.links().to_vec(), parts.mechanism.joints().to_vec());
    change(&mut links, &mut joints);
    for link in &mut links {
        // A rotating link with inertia must have a mass. If the mass is zero, a mass that is too small to have an
        // effect is added.
        if link.mass == 0.0 && link.inertia > 0.0 {
            link.mass = 1e-12;
        }
    }
    let transmissions = parts.mechanism.transmission_designs();
    parts.mechanism = Mechanism::new(links, joints).and_then(|own| own.with_transmissions(transmissions)).ok()?;
    Some(())
}

fn share(part: CasePart, scale: fn(&mut Link, f64)) -> Knob {
    Knob::amount(part, 1.0, "", move |parts, factor| {
        changed(parts, |links, _| links.iter_mut().for_each(|link| scale(link, factor)))
    })
}

fn load(case: &Case, index: usize) -> Knob {
    let sort = case.loads[index].sort();
    let ratio = case.drives.iter().find_map(Drive::motor).map(|motor| motor.ratio).filter(|ratio| *ratio != 1.0);
    let turn = move |parts: &mut CaseParts, factor| {
        let own = parts.loads.remove(index).times(factor)?;
        parts.loads.splice(index..index, own);
        Some(())
    };
    Knob::amount(CasePart::Load(index + 1, sort), 1.0, "", turn).times(ratio.into_iter().flat_map(|ratio| {
        [(1.0 / ratio, sentences::DIVIDED_BY_THE_REDUCER_RATIO), (ratio, sentences::MULTIPLIED_BY_THE_REDUCER_RATIO)]
    }))
}

/// The length or angle at which a spring exerts no force or moment.
fn free(case: &Case, index: usize) -> Option<Knob> {
    let mut load = case.loads[index].clone();
    let (&mut given, unit) = load.rest()?;
    let turn = move |parts: &mut CaseParts, value| {
        *parts.loads[index].rest()?.0 = value;
        Some(())
    };
    let natural = if unit == "m" { case.mechanism.size() } else { 1.0 };
    let knob = Knob::place(CasePart::Free(index + 1), given, natural, unit, turn);
    Some(Knob { shows: Shows::Forces, ..knob }.also([(0.0, PartChange::Missing)]))
}

fn inertia(case: &Case, index: LinkId, link: &Link) -> Knob {
    let turn = move |parts: &mut CaseParts, inertia| changed(parts, |links, _| links[index].inertia = inertia);
    let about = case.mechanism.joints().iter().filter_map(|joint| {
        let arm = (joint.on(index)? - link.mass_centre).norm_squared();
        (arm > 0.0).then(|| (link.inertia + link.mass * arm, PartChange::AboutJoint(joint.name.clone())))
    });
    Knob::amount(CasePart::Inertia(link.name.clone()), link.inertia, "kg m^2", turn).also(about)
}

fn mass_centre(index: LinkId, link: &Link, axis: FrameAxis) -> Knob {
    let turn =
        move |parts: &mut CaseParts, value| changed(parts, |links, _| links[index].mass_centre[axis as usize] = value);
    let part = CasePart::MassCentreAlong(link.name.clone(), axis);
    let knob = Knob::place(part, link.mass_centre[axis as usize], link.extent(), "m", turn);
    Knob { shows: Shows::Centres, ..knob }
}

/// Positions of joints on links, each once.
fn places(case: &Case) -> Vec<(JointId, LinkId)> {
    let mut found: Vec<(JointId, LinkId)> = Vec::new();
    let joints = case.mechanism.joints();
    for (index, joint) in joints.entries() {
        for side in [joint.first, joint.second] {
            let known =
                found.iter().any(|&(other, link)| link == side.link && joints[other].on(link) == Some(side.local));
            if !known {
                found.push((index, side.link));
            }
        }
    }
    found
}

fn place(case: &Case, joint: JointId, link: LinkId, axis: FrameAxis) -> Knob {
    let own = &case.mechanism.joints()[joint];
    let old = own.on(link).expect("the joint is on the link");
    let turn = move |parts: &mut CaseParts, value| {
        let mut new = old;
        new[axis as usize] = value;
        moved(parts, link, old, new)
    };
    let part = CasePart::Place(own.name.clone(), case.mechanism.links()[link].name.clone(), axis);
    Knob::place(part, old[axis as usize], case.mechanism.size(), "m", turn)
}

/// Moves a position on a link, together with every joint and point at this position.
fn moved(parts: &mut CaseParts, link: LinkId, old: Vec2, new: Vec2) -> Option<()> {
    changed(parts, |links, joints| {
        let points = links[link].points.iter_mut().map(|point| &mut point.local);
        let on_link = joints.iter_mut().flat_map(|joint| [&mut joint.first, &mut joint.second]);
        let sides = on_link.filter(|side| side.link == link).map(|side| &mut side.local);
        points.chain(sides).filter(|local| **local == old).for_each(|local| *local = new);
    })?;
    reassembled(parts)
}

/// Distances between two joints on a link.
/// A pair is left out if the line through the joints is parallel to an axis of the link's frame. The knob for the
/// coordinate along this axis then changes the same distance.
fn lengths(case: &Case) -> Vec<Knob> {
    let places = places(case);
    let at = |&(joint, link): &(JointId, LinkId)| case.mechanism.joints()[joint].on(link);
    let mut knobs = Vec::new();
    for one in &places {
        for other in places.iter().filter(|other| other.1 == one.1 && other.0 != one.0) {
            let (Some(old), Some(from)) = (at(one), at(other)) else { continue };
            let (arm, link) = (old - from, one.1);
            if !(arm.x.abs().smaller(arm.y.abs()) > 1e-9 * arm.norm()) {
                continue;
            }
            let turn = move |parts: &mut CaseParts, length| moved(parts, link, old, from + arm * (length / arm.norm()));
            let name = |place: &(JointId, LinkId)| case.mechanism.joints()[place.0].name.clone();
            let part = CasePart::Length(name(one), name(other), case.mechanism.links()[link].name.clone());
            let knob = Knob::place(part, arm.norm(), case.mechanism.size(), "m", turn);
            knobs.push(Knob { plain: Vec::new(), ..knob });
        }
    }
    knobs
}

/// Knobs of a drive: its start angle, and its speed (for a free drive, the speed at the start).
fn of_drive(case: &Case, index: usize, drive: &Drive) -> Vec<Knob> {
    let joint = case.mechanism.joints()[drive.joint].name.clone();
    let start = move |parts: &mut CaseParts, value| {
        driven(parts, index, |drive| drive.start = value);
        reassembled(parts)
    };
    let is_angle = drive.input != Input::Slide;
    let (unit, rate) = if is_angle { ("rad", "rad/s") } else { ("m", "m/s") };
    let quarters: &[f64] = if is_angle { &[PI / 2.0, -PI / 2.0, PI] } else { &[] };
    let quarters = quarters.iter().map(|by| drive.start + by);
    let quarters = quarters.map(|found| (found, PartChange::Instead { found, given: drive.start, unit }));
    let natural = drive.input.span(case.mechanism.size());
    let angle = Knob::place(CasePart::StartAngle(joint.clone()), drive.start, natural, unit, start).also(quarters);
    let speed = move |rows: GivenRows| {
        move |parts: &mut CaseParts, value: f64| {
            let inputs = parts.grid.inputs.clone();
            driven(parts, index, |drive| match &mut drive.motion {
                DriveMotion::Prescribed { law, .. } => *law = at_speed(law, value),
                DriveMotion::Free { initial_speed, .. } => *initial_speed = value,
            });
            if rows == GivenRows::Inputs {
                parts.grid = Grid::of_inputs(parts.drives.crank(), inputs);
            }
            Some(())
        }
    };
    if matches!(&drive.motion, DriveMotion::Prescribed { law, .. } if law.holds()) {
        return vec![Knob { is_far: true, ..angle }];
    }
    let given = if drive.is_free() { drive.initial_speed() } else { drive.top_speed() };
    let part = if drive.is_free() { CasePart::InitialSpeed(joint) } else { CasePart::Speed(joint) };
    let units: &[(f64, &str)] = match is_angle {
        true => &[
            (30.0 / PI, sentences::AS_RPM_FOR_RAD),
            (PI / 30.0, sentences::AS_RAD_FOR_RPM),
            (PI / 180.0, sentences::AS_RAD_FOR_DEG),
        ],
        false => &[],
    };
    let knob = |rows: GivenRows| {
        let mut own = Knob::amount(part.clone(), given, rate, speed(rows)).moving().times(units.iter().copied());
        if given == 0.0 {
            (own.plain, own.nudge) = (Vec::new(), 1e-3 * drive.top_speed());
        } else if !drive.is_free() {
            // A speed of zero is not tried, because a prescribed motion needs a speed.
            own.plain.remove(0);
        }
        own
    };
    // The whole motion depends on speed and angle, so a linear approximation is useless for values far from the given
    // value. At given inputs, the speed changes only the rates and the forces.
    let by_inputs = (index == 0 && drive.constant_speed().is_some()).then(|| knob(GivenRows::Inputs));
    let by_times = [Knob { is_far: true, ..knob(GivenRows::Times) }, Knob { is_far: true, ..angle }];
    by_times.into_iter().chain(by_inputs).collect()
}

/// The columns that identify the rows of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum GivenRows {
    Times,
    Inputs,
}

/// Changes one drive, and adapts the crank angles of the grid to the changed drive.
pub fn driven(parts: &mut CaseParts, index: usize, change: impl FnOnce(&mut Drive)) {
    let (mut own, mut numbers) = (parts.drives[index].clone(), 0..);
    change(&mut own);
    parts.drives = parts.drives.map(|drive| if numbers.next() == Some(index) { &own } else { drive }.clone());
    parts.grid = Grid::of_times(parts.drives.crank(), parts.grid.times.clone());
}

/// The law, changed so that its top speed is `speed` (rad/s).
pub fn at_speed(law: &MotionLaw, speed: f64) -> MotionLaw {
    let factor = speed / law.top_speed();
    match law {
        MotionLaw::ConstantSpeed(_) => MotionLaw::ConstantSpeed(speed),
        MotionLaw::Ramp { time, .. } => MotionLaw::Ramp { speed, time: *time },
        MotionLaw::Cycloidal { rise, time } => MotionLaw::Cycloidal { rise: factor * rise, time: *time },
        MotionLaw::Curve(curve) => MotionLaw::Curve(curve.times(factor).into()),
    }
}

/// The motor that moves the crank: its moment, and the inertia of its shafts.
fn motor(case: &Case) -> Vec<Knob> {
    let Some(motor) = case.crank().moving_motor() else { return Vec::new() };
    let of_motor = |part: CasePart, change: fn(&mut Motor, f64)| {
        let turn = move |parts: &mut CaseParts, factor| {
            let drive = parts.drives.crank_mut();
            let mut motor = drive.moving_motor()?.clone();
            change(&mut motor, factor);
            *drive = drive.with_motor(Some(motor));
            Some(())
        };
        Knob::amount(part, 1.0, "", turn).moving()
    };
    let (ratio, efficiency) = (motor.ratio, motor.efficiency);
    let mut moment = of_motor(CasePart::MotorMoment, |motor, factor| motor.law = motor.law.scaled(factor));
    if efficiency < 1.0 {
        moment = moment.times([
            (1.0 / efficiency, sentences::WITHOUT_THE_EFFICIENCY),
            (efficiency, sentences::WITH_THE_EFFICIENCY_TWICE),
            (1.0 / (efficiency * efficiency), sentences::DIVIDED_BY_THE_EFFICIENCY_INSTEAD),
        ]);
    }
    let by_ratio =
        [(1.0 / ratio, sentences::WITHOUT_THE_REDUCER_RATIO), (ratio, sentences::WITH_THE_REDUCER_RATIO_TWICE)];
    let mut knobs = vec![moment.times(by_ratio)];
    if motor.inertia_on_crank() > 0.0 {
        knobs.push(of_motor(CasePart::RotorInertia, |motor, factor| {
            let own = &mut motor.inertia;
            let ShaftInertia { rotor, input, intermediate, intermediate_ratio: _, output } = own;
            [rotor, input, intermediate, output].into_iter().for_each(|part| *part *= factor);
        }));
    }
    knobs
}

/// The natural size of a knob for relative changes: its value or, if larger, a thousand times its nudge.
pub(super) fn natural(knob: &Knob) -> f64 {
    knob.given.abs().larger(1e3 * knob.nudge.abs())
}

/// A number rounded to `digits` significant digits.
pub(super) fn significant(value: f64, digits: usize) -> f64 {
    format!("{value:.*e}", digits - 1).parse().unwrap_or(value)
}

/// A number rounded to `digits` significant digits, as in `significant`; an angle is rounded in degrees.
pub(super) fn significant_in(is_angle: bool, value: f64, digits: usize) -> f64 {
    if is_angle { significant(value.to_degrees(), digits).to_radians() } else { significant(value, digits) }
}
