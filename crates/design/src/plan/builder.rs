//! Computes the vectors of a plan from the motions of the links.

use super::names::{Named, NamedPoint, fixed_guide, pair, pivot, primed};
use super::sliding::Slide;
use super::vectors::{PlanTurn, Quantity, ROOM, Tip, TipKind, Vector, VectorKind, VectorPlan, longest};
use crate::sentences;
use drawing::paper::scale::factor;
use linkage::math::{Motion, Vec2, turned};
use linkage::mechanism::{LinkId, Mechanism};
use linkage::solver::State;

/// A tangential part shorter than this on paper (mm) counts as zero: the link turns uniformly.
pub(crate) const NOTHING: f64 = 1e-9;

/// A point of a link.
#[derive(Clone, Copy)]
struct On<'a> {
    named: &'a Named,
    local: Vec2,
    fixed: bool,
}

/// Collects the vectors of one plan.
pub(super) struct Builder<'a> {
    quantity: Quantity,
    mechanism: &'a Mechanism,
    state: &'a State,
    places: &'a [NamedPoint],
    slides: &'a [Slide],
    tips: Vec<Tip>,
    vectors: Vec<Vector>,
}

impl<'a> Builder<'a> {
    pub(super) fn new(
        quantity: Quantity,
        mechanism: &'a Mechanism,
        state: &'a State,
        places: &'a [NamedPoint],
        slides: &'a [Slide],
    ) -> Self {
        let pole = Tip { letter: quantity.pole().into(), kind: TipKind::Fixed, at: Vec2::zeros() };
        Builder { quantity, mechanism, state, places, slides, tips: vec![pole], vectors: Vec::new() }
    }

    pub(super) fn plan(mut self) -> VectorPlan {
        self.absolute();
        self.coincident();
        for link in self.mechanism.links().ids().skip(1) {
            self.relative(link);
        }
        self.sliding();
        let scale = factor(longest(&self.vectors), ROOM);
        if self.quantity == Quantity::Acceleration {
            self.split(scale);
        }
        let (lines, turn) = (Vec::new(), PlanTurn::Upright);
        VectorPlan { quantity: self.quantity, scale, tips: self.tips, vectors: self.vectors, lines, turn }
    }

    fn of_point(&self, motion: &Motion, local: Vec2) -> Vec2 {
        match self.quantity {
            Quantity::Velocity => motion.point_velocity(local),
            Quantity::Acceleration => motion.point_acceleration(local),
        }
    }

    /// Adds the vectors from the pole to the images of points and of mass centres.
    fn absolute(&mut self) {
        let (pole, symbol, word) = (self.quantity.pole(), self.quantity.symbol(), self.quantity.word());
        for place in self.places {
            let (Named { name, letter }, link) = (&place.named, place.side.link);
            let value = self.of_point(&self.state.motions[link], place.side.local);
            let kind = if place.fixed { TipKind::Fixed } else { TipKind::Point };
            self.tips.push(Tip { letter: letter.clone(), kind, at: value });
            if !place.fixed {
                let meaning = format!("{word} of {name}{}", self.direction(link, name));
                self.push(format!("{symbol}_{name}"), VectorKind::Absolute, [pole, letter], value, link, meaning);
            }
        }
        for (number, link) in self.mechanism.links().entries().skip(1).filter(|(_, link)| link.mass > 0.0) {
            let value = self.of_point(&self.state.motions[number], link.mass_centre);
            let letter = self.tip(format!("s{number}"), TipKind::MassCentre, value);
            let guide = fixed_guide(self.mechanism, number).map_or_else(String::new, |guide| along(&guide.name));
            let meaning = sentences::of_the_mass_centre_of_link(&word, &number, &link.name, &guide);
            self.push(format!("{symbol}_S{number}"), VectorKind::MassCentre, [pole, &letter], value, number, meaning);
        }
    }

    /// Describes the direction of the vector of a point of `link`. If the direction is not known in advance, the text
    /// is empty.
    fn direction(&self, link: LinkId, name: &str) -> String {
        match (self.quantity, pivot(self.mechanism, link), fixed_guide(self.mechanism, link)) {
            (Quantity::Velocity, Some((_, pivot)), _) => sentences::perpendicular_to(&pair(&pivot, name)),
            (_, None, Some(guide)) => along(&guide.name),
            _ => String::new(),
        }
    }

    /// Adds the absolute vectors of coincident points: the points of moving guides that coincide with sliding points.
    fn coincident(&mut self) {
        let (pole, symbol, word) = (self.quantity.pole(), self.quantity.symbol(), self.quantity.word());
        for slide in self.slides {
            let Some(under) = &slide.under else { continue };
            let guide = slide.guide.link;
            let value = self.of_point(&self.state.motions[guide], slide.place_under(self.state));
            self.tips.push(Tip { letter: under.letter.clone(), kind: TipKind::Coincident, at: value });
            let direction = self.direction(guide, &under.name);
            let meaning =
                sentences::of_the_point_of_link_under(&word, &under.name, &guide, &slide.place.named.name, &direction);
            let name = format!("{symbol}_{}", under.name);
            self.push(name, VectorKind::Absolute, [pole, &under.letter], value, guide, meaning);
        }
    }

    /// Relative vectors between the images of a link's points.
    fn relative(&mut self, link: LinkId) {
        let (symbol, word) = (self.quantity.symbol(), self.quantity.word());
        let motion = &self.state.motions[link];
        for (from, to) in self.pairs(link).into_iter().filter(|(from, _)| !from.fixed) {
            let arm = motion.arm(to.local - from.local);
            let value =
                self.quantity.of(turned(arm) * motion.omega, turned(arm) * motion.alpha - arm * motion.omega.powi(2));
            let (from, to) = (from.named, to.named);
            let line = sentences::perpendicular_to(&pair(&from.name, &to.name));
            let line = self.quantity.of(line.as_str(), "");
            let meaning = sentences::of_relative_to(&word, &to.name, &from.name, &line);
            let name = format!("{symbol}_{}", pair(&to.name, &from.name));
            self.push(name, VectorKind::Relative, [&from.letter, &to.letter], value, link, meaning);
        }
    }

    /// Adds the vectors of a prismatic joint on a moving guide.
    /// In a velocity plan, the added vector is the relative velocity.
    /// In an acceleration plan, the added vectors are the Coriolis part (if the guide can turn) and the relative
    /// acceleration.
    /// A fixed guide and a revolute joint add no vector.
    fn sliding(&mut self) {
        let mut number = 0;
        for slide in self.slides {
            let Some(under) = &slide.under else { continue };
            let NamedPoint { named: own, fixed, .. } = &slide.place;
            let joint = &self.mechanism.joints()[slide.joint].name;
            let (from, link) = (under.letter.as_str(), slide.block.link);
            let to = if *fixed { self.quantity.pole() } else { &own.letter };
            let of = pair(&own.name, &under.name);
            let Some([speed, growth]) = slide.rates(self.mechanism, self.state) else { continue };
            let meaning = sentences::of_relative_to(&self.quantity.word(), &own.name, &under.name, &along(joint));
            if self.quantity == Quantity::Velocity {
                self.push(format!("v_{of}"), VectorKind::Sliding, [from, to], speed, link, meaning);
                continue;
            }
            let coriolis = turned(speed) * (2.0 * self.state.motions[slide.guide.link].omega);
            let end = if !self.mechanism.can_turn(slide.guide.link) {
                from.to_string()
            } else {
                number += 1;
                let letter = self.tip(format!("k{number}"), TipKind::Coriolis, self.end(from) + coriolis);
                let meaning = sentences::coriolis_part_omega_perpendicular_to_the_guide(&joint);
                self.push(format!("a_{of}^cor"), VectorKind::Coriolis, [from, &letter], coriolis, link, meaning);
                letter
            };
            self.push(format!("a_{of}^r"), VectorKind::Sliding, [&end, to], growth, link, meaning);
        }
    }

    /// Adds the end of a vector and returns its letter.
    /// If the letter is taken, primes are appended.
    fn tip(&mut self, letter: String, kind: TipKind, at: Vec2) -> String {
        let letter = primed(letter, |letter| self.tips.iter().any(|tip| tip.letter == letter));
        self.tips.push(Tip { letter: letter.clone(), kind, at });
        letter
    }

    /// End of the vector with this letter, relative to the pole (SI).
    fn end(&self, letter: &str) -> Vec2 {
        self.tips.iter().find(|tip| tip.letter == letter).map_or_else(Vec2::zeros, |tip| tip.at)
    }

    /// Adds the normal and tangential parts of every relative acceleration, and of the acceleration of every point that
    /// turns about a ground pivot.
    fn split(&mut self, scale: f64) {
        let mut number = 0;
        for link in self.mechanism.links().ids().skip(1) {
            let motion = &self.state.motions[link];
            for (from, to) in self.pairs(link) {
                let arm = motion.arm(to.local - from.local);
                let (normal, tangential) = (-arm * motion.omega.powi(2), turned(arm) * motion.alpha);
                let start = if from.fixed { self.quantity.pole() } else { &from.named.letter };
                let (from, to) = (from.named, to.named);
                let (of, line) = (pair(&to.name, &from.name), pair(&from.name, &to.name));
                let uniform = !(tangential.norm() / scale > NOTHING);
                let end = if uniform {
                    to.letter.clone()
                } else {
                    number += 1;
                    self.tip(format!("n{number}"), TipKind::Normal, self.end(&from.letter) + normal)
                };
                let meaning = sentences::normal_part_along_omega(&of);
                self.push(format!("a_{of}^n"), VectorKind::Normal, [start, &end], normal, link, meaning);
                if !uniform {
                    let meaning = sentences::tangential_part_alpha_perpendicular_to(&line);
                    let (name, ends) = (format!("a_{of}^t"), [&*end, &to.letter]);
                    self.push(name, VectorKind::Tangential, ends, tangential, link, meaning);
                }
            }
        }
    }

    /// Pairs of points of a link.
    /// First come the pairs of the link's ground pivot with every other point, then the pairs of two moving points.
    /// If the link is a moving guide, the last pairs contain its points that coincide with sliding points.
    /// Each coincident point is paired with the link's pivot or, without a pivot, with the link's moving points.
    /// A link that never turns has no pairs: all its points have the same motion.
    fn pairs(&self, link: LinkId) -> Vec<(On<'a>, On<'a>)> {
        if !self.mechanism.can_turn(link) {
            return Vec::new();
        }
        let places = self.places;
        let on = |place: &'a NamedPoint, local: Vec2| On { named: &place.named, local, fixed: place.fixed };
        let moves = |name: &str| places.iter().find(|place| place.named.name == name && !place.fixed);
        let stands = |name: &str| places.iter().find(|place| place.named.name == name && place.fixed);
        let pivot = pivot(self.mechanism, link);
        let own = self.mechanism.links()[link].points.iter();
        let moving: Vec<On> = own
            .filter(|point| pivot.as_ref().is_none_or(|(local, _)| point.local != *local))
            .filter_map(|point| Some(on(moves(&point.name)?, point.local)))
            .collect();
        let base = pivot.as_ref().and_then(|(local, name)| Some(on(stands(name)?, *local)));
        let mut pairs: Vec<(On, On)> = base.iter().flat_map(|&base| moving.iter().map(move |&to| (base, to))).collect();
        for (index, &from) in moving.iter().enumerate() {
            pairs.extend(moving[index + 1..].iter().map(|&to| (from, to)));
        }
        for slide in self.slides.iter().filter(|slide| slide.guide.link == link) {
            let Some(under) = &slide.under else { continue };
            let to = On { named: under, local: slide.place_under(self.state), fixed: false };
            match base {
                Some(base) => pairs.push((base, to)),
                None => pairs.extend(moving.iter().map(|&from| (from, to))),
            }
        }
        pairs
    }

    fn push(
        &mut self,
        name: String,
        part: VectorKind,
        [from, to]: [&str; 2],
        value: Vec2,
        link: LinkId,
        meaning: String,
    ) {
        let start = self.end(from);
        self.vectors.push(Vector { name, part, from: from.into(), to: to.into(), start, value, link, meaning });
    }
}

/// Words for the direction along the guide of a joint, used in the meaning of a vector.
fn along(joint: &str) -> String {
    sentences::along_the_guide(&joint)
}
