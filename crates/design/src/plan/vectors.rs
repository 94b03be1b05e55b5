//! Velocity or acceleration plan: its vectors and their end points.

use super::names::{SINGULAR, primed};
use super::singular::SingularPoint;
use crate::sentences;
use drawing::paper::scale::factor;
use linkage::math::{KeepNan, Vec2, turned};
use linkage::mechanism::LinkId;

/// At the automatic scale of a plan, its longest vector is at most this long on paper (mm).
pub(super) const ROOM: f64 = 100.0;
/// If a plan is reduced to selected vectors, its new scale factor is at least the old one times this fraction.
const FINEST: f64 = 1e-3;

linkage::words! {
    /// The quantity of a plan.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Quantity: word {
        /// Velocities (m/s).
        Velocity = "velocity",
        /// Accelerations (m/s^2).
        Acceleration = "acceleration",
    }
}

impl Quantity {
    /// Selects the value for this quantity.
    pub(super) fn of<T>(self, velocity: T, acceleration: T) -> T {
        match self {
            Quantity::Velocity => velocity,
            Quantity::Acceleration => acceleration,
        }
    }

    /// SI unit.
    pub fn unit(self) -> &'static str {
        self.of("m/s", "m/s^2")
    }

    /// Symbol of the vectors: v or a.
    pub fn symbol(self) -> &'static str {
        self.of("v", "a")
    }

    /// Letter of the pole: p or π.
    pub fn pole(self) -> &'static str {
        self.of("p", "π")
    }
}

linkage::words! {
    /// Kind of the end point of a vector.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum TipKind: word {
        /// Pole, or a ground point, which coincides with the pole.
        Fixed = "fixed",
        /// A named point of the mechanism.
        Point = "point",
        /// A mass centre, marked with the letter s and the number of the link.
        MassCentre = "centre",
        /// End of the vector of a normal acceleration, marked with the letter n and a running number.
        Normal = "between",
        /// Point of a moving guide's link that coincides with a sliding point, marked with the letter of the sliding
        /// point and the number of the link, such as a3.
        Coincident = "coincident",
        /// A singular point of a group. Its letter is σ.
        Singular = "singular",
        /// End of a Coriolis part. Its letter is k with a running number.
        Coriolis = "between",
    }
}

/// Point of a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Tip {
    /// Letter.
    pub letter: String,
    /// Kind.
    pub kind: TipKind,
    /// Vector from the pole to the end point (SI).
    pub at: Vec2,
}

linkage::words! {
    /// Kind of a vector.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum VectorKind: word {
        /// Absolute vector of a named point.
        Absolute = "absolute",
        /// Absolute vector of a mass centre.
        MassCentre = "centre",
        /// Relative vector of two points of one link.
        Relative = "relative",
        /// Normal part of an acceleration: omega^2 l. The normal part of a_BA points from B to A.
        Normal = "normal",
        /// Tangential part of an acceleration: alpha l, perpendicular to the line through both points.
        Tangential = "tangential",
        /// Velocity or acceleration of a sliding point relative to the moving guide's link, along the guide.
        Sliding = "sliding",
        /// Coriolis part of the acceleration of a point that slides on a turning guide: 2 omega x v, across the guide.
        Coriolis = "coriolis",
    }
}

/// Vector of a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Vector {
    /// Name in the usual notation: `v_B`, `v_BA`, `a_BA^n`, `a_BA^t`, `v_S2`.
    /// If A slides on link 3: `v_A3`, `v_A,A3`, `a_A,A3^cor`, `a_A,A3^r`.
    pub name: String,
    /// Kind.
    pub part: VectorKind,
    /// Letter of the vector's start point.
    pub from: String,
    /// Letter of the vector's end point.
    pub to: String,
    /// Start point of the vector, relative to the pole (SI).
    pub start: Vec2,
    /// Components of the vector in world axes (SI).
    pub value: Vec2,
    /// Number of the link from whose motion the vector is computed.
    pub link: LinkId,
    /// Meaning in words.
    pub meaning: String,
}

linkage::words! {
    /// How a plan is turned on paper.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum PlanTurn: word {
        /// Not turned.
        Upright = "not turned",
        /// By 90 deg counter-clockwise.
        CounterClockwise = "counter-clockwise",
        /// By 90 deg clockwise.
        Clockwise = "clockwise",
    }
}

impl PlanTurn {
    /// Turns a vector of the plan.
    pub fn of(self, vector: Vec2) -> Vec2 {
        match self {
            PlanTurn::Upright => vector,
            PlanTurn::CounterClockwise => turned(vector),
            PlanTurn::Clockwise => -turned(vector),
        }
    }

    /// Angle of the turn (deg), counter-clockwise positive.
    pub fn degrees(self) -> f64 {
        match self {
            PlanTurn::Upright => 0.0,
            PlanTurn::CounterClockwise => 90.0,
            PlanTurn::Clockwise => -90.0,
        }
    }
}

/// A velocity or acceleration plan.
#[derive(Clone, Debug, PartialEq)]
pub struct VectorPlan {
    /// The quantity of the plan.
    pub quantity: Quantity,
    /// Scale factor mu_v ((m/s)/mm) or mu_a ((m/s^2)/mm).
    pub scale: f64,
    /// End points of vectors; the pole is first.
    pub tips: Vec<Tip>,
    /// All vectors.
    pub vectors: Vec<Vector>,
    /// Construction lines, each between two points relative to the pole (SI).
    pub lines: Vec<[Vec2; 2]>,
    /// How the plan is turned on paper. The fields `tips`, `vectors` and `lines` are not turned.
    pub turn: PlanTurn,
}

/// Size of the longest of several vectors (SI).
pub(super) fn longest(vectors: &[Vector]) -> f64 {
    vectors.iter().map(|vector| vector.value.norm()).fold(0.0, f64::larger)
}

impl VectorPlan {
    /// Keeps only the vectors whose two ends stay. The plan gets a new scale.
    /// The pole and the points with these letters stay.
    /// Coincident points and the ends of normal or Coriolis parts are intermediate points. An intermediate point stays
    /// if each of its vectors joins it to the pole, to a point with one of these letters, or to another intermediate
    /// point.
    pub(super) fn keep(&mut self, letters: &[String]) {
        let pole = self.quantity.pole();
        let kind = |letter: &str| self.tips.iter().find(|tip| tip.letter == letter).map(|tip| tip.kind);
        let is_between =
            |letter: &str| matches!(kind(letter), Some(TipKind::Normal | TipKind::Coriolis | TipKind::Coincident));
        let is_chosen = |letter: &str| letter == pole || letters.iter().any(|own| own == letter);
        let leads_on = |letter: &str| {
            let touching = self.vectors.iter().filter(|own| own.from == letter || own.to == letter);
            touching.flat_map(|own| [&own.from, &own.to]).all(|end| is_chosen(end) || is_between(end))
        };
        let stays = |letter: &str| is_chosen(letter) || is_between(letter) && leads_on(letter);
        let kept: Vec<Vector> = self.vectors.iter().filter(|own| stays(&own.from) && stays(&own.to)).cloned().collect();
        let is_touched = |tip: &Tip| kept.iter().any(|own| own.from == tip.letter || own.to == tip.letter);
        let tips = self.tips.iter().filter(|tip| is_chosen(&tip.letter) || is_touched(tip)).cloned().collect();
        (self.vectors, self.tips, self.lines) = (kept, tips, Vec::new());
        // The scale factor has a lower limit. Vectors that consist only of rounding errors thus stay short on paper.
        self.scale = factor(self.longest(), ROOM).larger(self.scale * FINEST);
    }

    /// Size of the longest vector (SI).
    pub fn longest(&self) -> f64 {
        longest(&self.vectors)
    }

    /// Adds the velocities of the groups' singular points. Two construction lines meet at the end of each velocity.
    /// A velocity that is too long for the paper at the plan's scale is left out.
    pub(super) fn add_singular(&mut self, points: &[SingularPoint]) {
        for point in points.iter().filter(|point| point.velocity.norm() <= ROOM * self.scale) {
            let is_taken = |letter: &str| self.tips.iter().any(|tip| tip.letter == letter);
            let letter = primed(SINGULAR[1].into(), is_taken);
            let name = letter.replace(SINGULAR[1], SINGULAR[0]);
            self.vectors.push(Vector {
                name: format!("{}_{name}", self.quantity.symbol()),
                part: VectorKind::Absolute,
                from: self.quantity.pole().into(),
                to: letter.clone(),
                start: Vec2::zeros(),
                value: point.velocity,
                link: point.links[0].0,
                meaning: sentences::of_the_singular_point(&self.quantity.word(), &name, &point.lines()),
            });
            self.tips.push(Tip { letter, kind: TipKind::Singular, at: point.velocity });
            let away = |end: &Vec2| (end - point.velocity).norm();
            for [near, far] in point.leads.each_ref().map(|lead| lead.velocities) {
                self.lines.push([if away(&near) > away(&far) { near } else { far }, point.velocity]);
            }
        }
    }

    /// Position on paper (mm, from the pole) of a point of the plan (SI, from the pole).
    pub fn on_paper(&self, at: Vec2) -> Vec2 {
        self.turn.of(at) / self.scale
    }

    /// Length of a vector on paper (mm).
    pub fn paper(&self, vector: &Vector) -> f64 {
        vector.value.norm() / self.scale
    }
}
