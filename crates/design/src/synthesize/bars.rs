//! Masses of links that consist of slender bars, with their derivatives.

use precise::{Dual, Scalar};

/// A number of a candidate with its derivatives.
type Number<const N: usize> = Dual<f64, N>;

/// Mass properties of a link in the frame of its points (SI). The moment of inertia is about the mass centre.
#[derive(Clone, Copy, Debug)]
pub(super) struct BarMass<const N: usize> {
    pub(super) mass: Number<N>,
    pub(super) centre: [Number<N>; 2],
    pub(super) inertia: Number<N>,
}

impl<const N: usize> BarMass<N> {
    /// Slender bars of `density` (kg/m) that join the first point of a link to each of its other points.
    /// A bar of length l has the moment of inertia m l^2 / 12 about its middle.
    /// The parallel-axis theorem gives the moment of inertia about the mass centre of the link.
    /// `None` if all points coincide.
    pub(super) fn of(points: &[[Number<N>; 2]], density: f64) -> Option<Self> {
        let (&[x, y], others) = points.split_first()?;
        let (density, half) = (Number::of(density), Number::of(0.5));
        let squared = |arm: [Number<N>; 2]| arm[0] * arm[0] + arm[1] * arm[1];
        let arms = others.iter().map(|other| [other[0] - x, other[1] - y]);
        let arms: Vec<_> = arms.filter(|arm| squared(*arm).value > 0.0).collect();
        let masses: Vec<Number<N>> = arms.iter().map(|arm| density * squared(*arm).sqrt()).collect();
        let sum = |values: &mut dyn Iterator<Item = Number<N>>| values.fold(Number::ZERO, |sum, value| sum + value);
        let mass = sum(&mut masses.iter().copied());
        if arms.is_empty() {
            return None;
        }
        let bars = || arms.iter().zip(&masses);
        let middle = [0, 1].map(|axis| sum(&mut bars().map(|(arm, mass)| arm[axis] * half * *mass)) / mass);
        let about_centre = |(arm, mass): (&[Number<N>; 2], &Number<N>)| {
            let offset = [0, 1].map(|axis| arm[axis] * half - middle[axis]);
            *mass * (squared(*arm) / Number::of(12.0) + squared(offset))
        };
        Some(BarMass { mass, centre: [x + middle[0], y + middle[1]], inertia: sum(&mut bars().map(about_centre)) })
    }
}
