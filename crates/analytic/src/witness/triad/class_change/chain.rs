//! The chain of dyads that remains if a ground lead drives: the other ground lead and the base link, then lead 3 and
//! the crank.

use linkage::math::{Vec2, cross, rotated, turned};

/// A ground lead.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grounded {
    /// Foot of the lead (m, world axes).
    pub(super) foot: Vec2,
    /// Length of the lead (m).
    pub(super) length: f64,
    /// Head of the lead in the base link's frame (m).
    pub(super) on_base: Vec2,
}

/// The chain for one choice of the conditional driver.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chain {
    /// The ground lead that drives, then the other ground lead.
    pub(super) leads: [Grounded; 2],
    /// Head of lead 3 in the base link's frame (m).
    pub(super) third: Vec2,
    /// On which side the head of the other ground lead lies, seen along the line from the driver's head to the foot of
    /// the other ground lead: +1 left, -1 right.
    pub(super) side: f64,
}

/// A pose of the chain (m, world axes).
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    /// Vector of the driving lead, from foot to head.
    pub(super) driver: Vec2,
    /// Vector on the base link from the driver's head to the head of the other ground lead.
    pub(super) base: Vec2,
    /// Vector of the other ground lead, from foot to head.
    pub(super) other: Vec2,
    /// Vector on the base link from the driver's head to the head of lead 3.
    pub(super) arm: Vec2,
    /// World position of the head of lead 3.
    pub(super) third: Vec2,
}

/// First and second derivatives of the chain with respect to the driving lead's angle.
pub(super) struct Slopes {
    pub(super) base: [f64; 2],
    pub(super) other: [f64; 2],
    /// First and second derivatives of the position of the head of lead 3 (m).
    pub(super) third: [Vec2; 2],
}

impl Chain {
    /// Places the first dyad. D is the driver's head; E and G are the head and the foot of the other ground lead.
    /// Let d = |DG|, b = |DE| on the base link, and l the length of the other ground lead.
    /// The cosine rule gives, as complex numbers, E = D + DG (b^2 - l^2 + d^2 +- i sqrt((b + l + d)(b + l - d)(d + b -
    /// l)(d - b + l))) / 2 d^2.
    /// The root is four times the area of the triangle by Heron's formula. `None` if the dyad cannot be assembled.
    pub(super) fn place(&self, driver: Vec2) -> Option<Place> {
        let [lead, other] = self.leads;
        let head = lead.foot + driver;
        let own = other.on_base - lead.on_base;
        let span = other.foot - head;
        let (b, l, d) = (own.norm(), other.length, span.norm());
        let area = (b + l + d) * (b + l - d) * (d + b - l) * (d - b + l);
        // The comparison is negated so that NaN is refused too.
        if !(area >= 0.0) {
            return None;
        }
        let turn = Vec2::new((b - l) * (b + l) + d * d, self.side * area.sqrt()) / (2.0 * d * d);
        let base = rotated(span, turn);
        let arm = rotated(along(own, base), self.third - lead.on_base);
        Some(Place { driver, base, other: head + base - other.foot, arm, third: head + arm })
    }
}

impl Place {
    /// Signed sine of the angle between the base link and the ground lead that does not drive.
    /// The sine is zero if the first dyad is at its limit. The driving lead is then in a limit position.
    pub(super) fn sine(&self) -> f64 {
        cross(self.base, self.other) / (self.base.norm() * self.other.norm())
    }

    /// The slopes follow from the first and second derivatives of driver + base = FG + other.
    /// FG is the vector from the driver's foot to the foot of the other ground lead.
    /// The scalar product with `base` or with `other` eliminates the rate of that vector.
    pub(super) fn slopes(&self) -> Slopes {
        let (p, r) = (self.base, self.other);
        let d = [turned(self.driver), -self.driver];
        let area = cross(p, r);
        let (base, other) = (-d[0].dot(&r) / area, -d[0].dot(&p) / area);
        let rest = d[1] - p * (base * base) + r * (other * other);
        let second = [-rest.dot(&r) / area, -rest.dot(&p) / area];
        let third = [d[0] + turned(self.arm) * base, d[1] + turned(self.arm) * second[0] - self.arm * (base * base)];
        Slopes { base: [base, second[0]], other: [other, second[1]], third }
    }
}

/// Direction of a frame if its vector `local` has the world direction `world`.
pub(super) fn along(local: Vec2, world: Vec2) -> Vec2 {
    Vec2::new(local.dot(&world), cross(local, world)).normalize()
}
