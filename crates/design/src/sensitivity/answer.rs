//! Question and answer of a sensitivity.

use scenario::{CaseKey, SampledFigure, StartRequest, TurnFigure};

/// The requested derivatives of a scenario.
#[derive(Clone, Debug, Default)]
pub struct SensitivityQuestion {
    /// The figures.
    pub figures: Vec<TurnFigure>,
    /// Names of the keys; empty for [the usual keys](scenario::CaseSlopes::usual).
    pub keys: Vec<String>,
    /// Names of further keys, such as those with tolerances.
    pub also: Vec<String>,
    /// The start to use in place of the start in the file.
    pub asked: StartRequest,
    /// Whether the instants keep their inputs (`true`) or their times (`false`) when a number of a law changes.
    /// `None` means that the instants keep the coordinate by which the file gives its grid.
    pub by_input: Option<bool>,
}

/// The derivatives of one figure.
#[derive(Clone, Debug, PartialEq)]
pub struct FigureSlopes {
    /// The figure.
    pub figure: TurnFigure,
    /// Unit of the figure's quantity; empty for an expression.
    pub unit: String,
    /// The value of the figure, with the rows that determine it.
    pub sampled: SampledFigure,
    /// Values of the input at the rows of `sampled`, as messages write them.
    pub instants: Vec<String>,
    /// Derivatives by the keys, per unit of the key, in the order of [`Sensitivity::keys`].
    /// NaN if `has_kink` is true and the derivative does not exist.
    pub by: Vec<f64>,
    /// Value of the input at a second, equal extreme; `None` if there is only one extreme.
    /// With two equal extremes, the derivatives are valid only for changes that leave the extreme at the first instant.
    pub rival: Option<String>,
    /// Whether the figure has a kink with respect to a key.
    /// The figure is then the absolute value of zero, the magnitude of a zero vector, or an extreme that is reached at
    /// successive instants whose derivatives differ.
    pub has_kink: bool,
}

/// The derivatives of figures by keys.
#[derive(Clone, Debug)]
pub struct Sensitivity {
    /// The keys.
    pub keys: Vec<CaseKey>,
    /// The figures, in the order of the question.
    pub figures: Vec<FigureSlopes>,
    /// Usual keys that were left out, each with the part of the file whose derivative with respect to the key is not
    /// known.
    pub left_out: Vec<(String, String)>,
    /// Whether the instants keep their inputs (`true`) or their times (`false`) when a key changes.
    pub by_input: bool,
}

/// Relative derivative above which a figure is the rounding error of zero.
const MOST_RELATIVE: f64 = 1e9;

impl FigureSlopes {
    /// Relative derivative by the key with this index: the change of the figure in per cent if the key grows by one per
    /// cent.
    /// `None` if the key is zero, or the figure is zero or a rounding error of zero.
    #[must_use]
    pub fn relative(&self, keys: &[CaseKey], index: usize) -> Option<f64> {
        let (value, key) = (self.sampled.value, keys[index].value);
        let relative = self.by[index] * key / value;
        (value != 0.0 && key != 0.0 && !(relative.abs() > MOST_RELATIVE)).then_some(relative)
    }

    /// Indices of the keys, by decreasing magnitude of the relative derivative.
    /// Keys without a relative derivative follow, by decreasing magnitude of the derivative. Keys with equal
    /// derivatives keep their order.
    #[must_use]
    pub fn ranked(&self, keys: &[CaseKey]) -> Vec<usize> {
        let mut order: Vec<usize> = (0..keys.len()).collect();
        let size = |index: usize| self.relative(keys, index).map_or(-1.0, f64::abs);
        order.sort_by(|&a, &b| size(b).total_cmp(&size(a)).then_with(|| self.by[b].abs().total_cmp(&self.by[a].abs())));
        order
    }
}
