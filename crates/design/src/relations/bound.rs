//! Proven bounds on the errors of joints and pins that follow polynomials.
//!
//! The range of the input is divided into parts.
//! Over each part, [`Tubes`] enclose the true motion. A tube is a uniform motion, with a proven bound on the deviation
//! of the true motion from it.
//! For the motion by the polynomials, three numbers are computed: value and first derivative at the middle of the part,
//! and a bound on the second derivative over the part.
//! The difference of the two motions is thus a linear function of the input, plus a remainder with a known bound.
//! A linear function has its largest magnitude at an end of the part.
//! Parts are halved until every bound is close to the largest sampled error, which is taken at the middles of parts.

use super::range::InputRange;
use super::{JointRelation, MimicError, Mimics};
use crate::clearance::tube::{MOST_HALVINGS, RangePart, Tube, Tubes};
use crate::rigid::{Body, Freedom, RigidModel};
use crate::sentences;
use linkage::case::Case;
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::{KeepNan, Vec2, angle, rotated, turned, unit};
use linkage::mechanism::LinkId;

/// A part is halved while a bound exceeds both of two limits. The first limit is the largest sampled error times this
/// factor.
const FACTOR: f64 = 1.1;
/// The second limit: an angle (rad), or a length divided by the mechanism's size.
const FLOOR: f64 = 1e-9;
/// Largest number of parts that are examined.
const BUDGET: usize = 400_000;
/// Rounding error of an angle (rad).
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// A function of the input over a part: value and derivative at the middle, bound on the second derivative.
#[derive(Clone, Copy, Debug)]
struct Curved {
    value: f64,
    rate: f64,
    bend: f64,
}

impl Curved {
    const ZERO: Curved = Curved { value: 0.0, rate: 0.0, bend: 0.0 };

    fn plus(self, other: Curved) -> Curved {
        Curved { value: self.value + other.value, rate: self.rate + other.rate, bend: self.bend + other.bend }
    }

    /// Upper bound of the derivative's magnitude over the part.
    fn top(&self, half: f64) -> f64 {
        self.rate.abs() + self.bend * half
    }
}

/// Frame of a link if the joints follow the polynomials.
#[derive(Clone, Copy, Debug)]
struct Followed {
    origin: Vec2,
    speed: Vec2,
    bend: f64,
    turn: Curved,
}

impl Followed {
    const GROUND: Followed =
        Followed { origin: Vec2::new(0.0, 0.0), speed: Vec2::new(0.0, 0.0), bend: 0.0, turn: Curved::ZERO };

    /// Position and derivative of the point `local` at the middle, and a bound on its second derivative.
    fn point(&self, local: Vec2, half: f64) -> (Vec2, Vec2, f64) {
        let arm = rotated(unit(self.turn.value), local);
        let bend = local.norm() * (self.turn.bend + self.turn.top(half).powi(2));
        (self.origin + arm, self.speed + turned(arm) * self.turn.rate, self.bend + bend)
    }

    /// Frame of the child link `body`, whose joint has the coordinate `by`.
    fn child(&self, body: &Body, by: Curved, half: f64) -> Followed {
        let turned_by = Curved { value: body.turn, ..Curved::ZERO };
        match body.freedom {
            Freedom::Hinge(place) => {
                let turn = self.turn.plus(turned_by).plus(by);
                let (at, speed, bend) = self.point(body.offset + rotated(unit(body.turn), place), half);
                let (arm, spin) = (rotated(unit(turn.value), place), turn.bend + turn.top(half).powi(2));
                let (origin, speed) = (at - arm, speed - turned(arm) * turn.rate);
                Followed { origin, speed, bend: bend + place.norm() * spin, turn }
            }
            Freedom::Slide(axis) => {
                let axis = rotated(unit(body.turn), axis);
                let local = body.offset + axis * by.value;
                let (origin, speed, bend) = self.point(local, half);
                let way = rotated(unit(self.turn.value), axis);
                let (top, spin) = (by.top(half), self.turn.top(half));
                // Bound on the second derivative of a slide along an axis that turns with the parent.
                let more = by.bend + 2.0 * top * spin + top * half * (self.turn.bend + spin * spin);
                Followed { origin, speed: speed + way * by.rate, bend: bend + more, turn: self.turn.plus(turned_by) }
            }
        }
    }
}

/// Computes proven bounds on the errors of all joints and pins of `mimics`, and stores them.
///
/// # Errors
/// [`ErrorKind::Numeric`] if no bound can be proven near a pose. The errors of the pose solver.
pub(super) fn prove(model: &RigidModel, case: &Case, range: InputRange, mimics: &mut Mimics) -> Result<()> {
    let mut tubes = Tubes::new(case, range.ends, 0.0)?;
    let slides = |own: &JointRelation| model.case.mechanism.joints()[own.joint].slides();
    let floor = |is_length: bool| if is_length { FLOOR * model.size() } else { FLOOR };
    let floors: Vec<f64> =
        mimics.relations.iter().map(slides).chain(mimics.pins.iter().map(|_| true)).map(floor).collect();
    let mut sampled = vec![0.0; floors.len()];
    let examine = |tubes: &mut Tubes, part: RangePart, sampled: &mut [f64]| -> Result<(RangePart, Vec<f64>)> {
        let errors = over(model, range, mimics, tubes, part)?;
        sampled.iter_mut().zip(&errors).for_each(|(most, own)| *most = most.larger(own.sampled));
        Ok((part, errors.iter().map(|own| own.bound).collect()))
    };
    let first = tubes.parts().map(|part| examine(&mut tubes, part, &mut sampled));
    let mut open = first.collect::<Result<Vec<_>>>()?;
    let (mut closed, mut examined) = (vec![0.0; floors.len()], open.len());
    loop {
        let exceeds = |bounds: &[f64]| {
            let limits = sampled.iter().zip(&floors).map(|(most, floor)| floor.larger(FACTOR * most));
            bounds.iter().zip(limits).any(|(bound, limit)| *bound > limit)
        };
        let (wide, near): (Vec<_>, Vec<_>) = open.drain(..).partition(|(_, bounds)| exceeds(bounds));
        let take = |closed: &mut Vec<f64>, parts: &[(RangePart, Vec<f64>)]| {
            for (_, bounds) in parts {
                closed.iter_mut().zip(bounds).for_each(|(most, own)| *most = most.larger(*own));
            }
        };
        take(&mut closed, &near);
        examined += 2 * wide.len();
        let is_over = examined > BUDGET || wide.iter().any(|(part, _)| part.halvings == MOST_HALVINGS);
        if wide.is_empty() || is_over {
            take(&mut closed, &wide);
            let unproven = wide.iter().find(|(_, bounds)| bounds.iter().any(|bound| !bound.is_finite()));
            if let Some((part, _)) = unproven {
                let [from, _] = tubes.ends(*part);
                let message = sentences::no_error_of_the_relations_is_proven(&range.coordinate(from));
                return Err(Error::new(ErrorKind::Numeric, message).help(sentences::WRITE_NO_RELATIONS_OR_STAY_AWAY));
            }
            break;
        }
        for part in wide.iter().flat_map(|(part, _)| part.halves()) {
            open.push(examine(&mut tubes, part, &mut sampled)?);
        }
    }
    let mut errors = closed.into_iter().zip(sampled).map(|(bound, sampled)| MimicError { bound, sampled });
    let owners = mimics.relations.iter_mut().map(|own| &mut own.error);
    owners
        .chain(mimics.pins.iter_mut().map(|own| &mut own.error))
        .zip(&mut errors)
        .for_each(|(own, found)| *own = found);
    Ok(())
}

/// For all joints and pins: a proven bound on the error over a part, and the error at the middle.
fn over(
    model: &RigidModel,
    range: InputRange,
    mimics: &Mimics,
    tubes: &mut Tubes,
    part: RangePart,
) -> Result<Vec<MimicError>> {
    let rounding = tubes.rounding();
    let [from, to] = tubes.ends(part);
    let slice = tubes.slice(f64::midpoint(from, to), (to - from).abs() / 2.0)?;
    let (half, coordinate) = (slice.half, range.coordinate(slice.crank));
    let mut frames = vec![Followed::GROUND; slice.tubes.len()];
    let mut errors = Vec::with_capacity(mimics.relations.len() + mimics.pins.len());
    let whole =
        |sampled: f64, bound: f64| MimicError { sampled, bound: if slice.sound { bound } else { f64::INFINITY } };
    for body in &model.bodies {
        let polynomial = mimics.polynomial(body.branch.joint);
        let by = match polynomial {
            None => Curved { value: coordinate, rate: range.sense, bend: 0.0 },
            Some(own) => {
                let [value, rate, bend] = own.at(coordinate);
                Curved { value, rate: range.sense * rate, bend: bend.abs() + own.third() * half }
            }
        };
        frames[body.branch.link.index()] = frames[body.branch.parent.index()].child(body, by, half);
        if let Some(own) = polynomial {
            let (value, rate, rest) = difference(model, body, by, &slice.tubes, half);
            let most = (value + rate * half).abs().larger((value - rate * half).abs());
            let rest = rest + by.bend * half * half / 2.0 + own.rounding() + ROUNDING;
            errors.push(whole(value.abs(), most + rest));
        }
    }
    for pin in &mimics.pins {
        let local = model.point(pin.joint, pin.link);
        let (at, rate, bend) = frames[pin.link.index()].point(local, half);
        let track = slice.tubes[pin.link.index()].point(local);
        let (value, rate) = (at - track.at, rate - track.rate);
        let most = (value + rate * half).norm().larger((value - rate * half).norm());
        errors.push(whole(value.norm(), most + bend * half * half / 2.0 + track.error + rounding));
    }
    Ok(errors)
}

/// Error of the polynomial for a joint's coordinate: the value `by` of the polynomial minus the true coordinate.
/// The first two numbers are value and derivative of this error at the middle of the part.
/// The third number is the largest deviation of the true coordinate from a uniform change.
fn difference(model: &RigidModel, body: &Body, by: Curved, tubes: &[Tube], half: f64) -> (f64, f64, f64) {
    let of = |link: LinkId| &tubes[link.index()];
    let (parent, child) = (of(body.branch.parent), of(body.branch.link));
    let [[spin, twist], [child_spin, child_twist]] = [parent.turning(), child.turning()];
    let (along, across) = (parent.frame().1, child.frame().1);
    match body.freedom {
        Freedom::Hinge(_) => {
            let now = rotated(Vec2::new(along.x, -along.y), across);
            let value = angle::wrapped(by.value + body.turn - now.y.atan2(now.x));
            (value, by.rate - (child_spin - spin), twist + child_twist)
        }
        Freedom::Slide(axis) => {
            let axis = rotated(along, rotated(unit(body.turn), axis));
            let point = |link: LinkId| of(link).point(model.point(body.branch.joint, link));
            let (from, to) = (point(body.branch.parent), point(body.branch.link));
            let (gap, rate, error) = (to.at - from.at, to.rate - from.rate, to.error + from.error);
            let (value, change) = (axis.dot(&gap), axis.dot(&rate) + spin * turned(axis).dot(&gap));
            // The axis turns with the parent, by at most `turn`. The deviation of the axis from a uniform motion is at
            // most `bend`.
            let turn = spin.abs() * half + twist;
            let (bend, reach) = (twist + turn * turn / 2.0, rate.norm() * half + error);
            let rest = error + bend * (gap.norm() + reach) + spin.abs() * half * reach;
            (by.value + body.coordinate - value, by.rate - change, rest)
        }
    }
}
