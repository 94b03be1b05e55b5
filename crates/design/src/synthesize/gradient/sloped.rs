//! Values with their derivatives by all unknowns of an optimisation.

/// A value with its derivatives by the unknowns. `slopes` is empty if no derivatives are computed.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Sloped {
    pub(super) value: f64,
    pub(super) slopes: Vec<f64>,
}

impl Sloped {
    /// `self + factor * other`.
    pub(super) fn plus(&self, factor: f64, other: &Sloped) -> Sloped {
        let slopes = self.slopes.iter().zip(&other.slopes).map(|(a, b)| a + factor * b).collect();
        Sloped { value: self.value + factor * other.value, slopes }
    }

    /// `factor * self + constant`.
    pub(super) fn scaled(&self, factor: f64, constant: f64) -> Sloped {
        let slopes = self.slopes.iter().map(|own| factor * own).collect();
        Sloped { value: factor * self.value + constant, slopes }
    }

    /// `self / other`.
    pub(super) fn over(&self, other: &Sloped) -> Sloped {
        let value = self.value / other.value;
        let slope = |(a, b): (&f64, &f64)| (a - value * b) / other.value;
        Sloped { value, slopes: self.slopes.iter().zip(&other.slopes).map(slope).collect() }
    }
}
