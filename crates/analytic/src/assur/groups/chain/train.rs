//! The equation of a transmission in a group: the sum of factor times coordinate keeps the value of the start pose.
//! The coordinates are angles of links and slides, inside or outside the group. Angles count whole turns.

use std::f64::consts::TAU;

use super::Node;
use linkage::math::Motion;
use linkage::math::dense::Lu;
use linkage::mechanism::{Coordinate, Joint, LinkId, Mechanism, TransmissionId};

/// A coordinate of a transmission.
#[derive(Clone, Debug)]
enum Of {
    Angle(LinkId),
    /// The slide of a node, with the sign of the joint's slide.
    Node(usize, f64),
    /// The slide of a joint outside the group.
    Slide(Box<Joint>),
}

#[derive(Clone, Debug)]
struct Term {
    of: Of,
    factor: f64,
    /// The unknown on which the coordinate depends, with the derivative of the term by it; `None` for a known coordinate.
    column: Option<(usize, f64)>,
    /// The coordinate at the last pose and at the present one.
    last: f64,
    now: f64,
}

/// A transmission of a group.
#[derive(Clone, Debug)]
pub(in crate::assur) struct Train {
    pub(in crate::assur) id: TransmissionId,
    /// Largest factor of the transmission (m): the multiplier of the row divided by it is the force.
    pub(in crate::assur) scale: f64,
    terms: Vec<Term>,
    /// The value of the sum; NaN before the first pose.
    value: f64,
}

impl Train {
    /// The equation of a transmission in the group of these nodes; `size` is the unit of slides (m).
    pub(super) fn of(mechanism: &Mechanism, id: TransmissionId, nodes: &[Node], size: f64) -> Self {
        let terms = &mechanism.transmissions()[id].terms;
        let extent = |(of, factor): &(Coordinate, f64)| match of {
            Coordinate::Angle(_) => factor.abs(),
            Coordinate::Slide(_) => factor.abs() * size,
        };
        let scale = terms.iter().map(extent).fold(0.0, linkage::math::KeepNan::larger);
        let term = |&(of, factor): &(Coordinate, f64)| {
            let factor = factor / scale;
            let (of, column) = match of {
                Coordinate::Angle(link) => {
                    let spin = nodes.iter().find(|node| node.link == link).and_then(|node| node.spin);
                    (Of::Angle(link), spin.map(|spin| (spin, factor)))
                }
                Coordinate::Slide(joint) => {
                    let found = &mechanism.joints()[joint];
                    match nodes.iter().position(|node| node.joint == joint) {
                        Some(node) => {
                            let sign = if found.second.link == nodes[node].link { 1.0 } else { -1.0 };
                            (Of::Node(node, sign), Some((node, factor * sign * size)))
                        }
                        None => (Of::Slide(Box::new(found.clone())), None),
                    }
                }
            };
            Term { of, factor, column, last: 0.0, now: 0.0 }
        };
        Train { id, scale, terms: terms.iter().map(term).collect(), value: f64::NAN }
    }

    /// Takes the value of the sum from the start pose, at the first call.
    pub(super) fn start(&mut self, slides: &[f64], motions: &[Motion]) {
        if self.value.is_nan() {
            self.value = self.sum(slides, motions);
            self.keep();
        }
    }

    /// The sum at the present pose, with the angles nearest to those of the last pose.
    fn sum(&mut self, slides: &[f64], motions: &[Motion]) -> f64 {
        for term in &mut self.terms {
            term.now = match &term.of {
                Of::Angle(link) => {
                    let direction = motions[*link].direction;
                    let angle = direction.y.atan2(direction.x);
                    angle + TAU * ((term.last - angle) / TAU).round()
                }
                Of::Node(node, sign) => sign * slides[*node],
                Of::Slide(joint) => joint.slide(motions).expect("the joint slides")[0],
            };
        }
        self.terms.iter().map(|term| term.factor * term.now).sum()
    }

    /// Makes the present pose the last one.
    pub(super) fn keep(&mut self) {
        self.terms.iter_mut().for_each(|term| term.last = term.now);
    }

    /// Writes the row of the equation to the Jacobian and returns its residual.
    pub(super) fn assemble(&mut self, row: usize, slides: &[f64], motions: &[Motion], jacobian: &mut Lu) -> f64 {
        for (column, derivative) in self.terms.iter().filter_map(|term| term.column) {
            jacobian.add(row, column, derivative);
        }
        self.sum(slides, motions) - self.value
    }

    /// Right-hand side of the equation for the rates of the unknowns: `of_link` is the rate of a known angle, `of_slide`
    /// that of a known slide among slide, speed and acceleration.
    pub(super) fn known(&self, order: usize, of_link: impl Fn(&Motion) -> f64, motions: &[Motion]) -> f64 {
        let known = self.terms.iter().filter(|term| term.column.is_none());
        let rate = |term: &Term| match &term.of {
            Of::Angle(link) => term.factor * of_link(&motions[*link]),
            Of::Node(..) => 0.0,
            Of::Slide(joint) => term.factor * joint.slide(motions).expect("the joint slides")[order],
        };
        -known.map(rate).sum::<f64>()
    }
}
