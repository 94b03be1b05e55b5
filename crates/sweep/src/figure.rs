//! Figures of a case: one number for a whole motion.

use analytic::AssurSolver;
use analytic::assur::batch::{rrr_sine, spans};
use analytic::range::{Extent, reachable};
use linkage::case::Case;
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::{KeepNan, Motion};
use linkage::mechanism::assembly::transmission_sine;
use linkage::mechanism::{Group, GroupId, GroupKind, PerLink, Pose};
use linkage::solver::{Sampler, Solver};
use linkage::trajectory::{Channel, Trajectory};
use scenario::words::suggestion;
use scenario::{Claim, Scenario, Statistic, TurnFigure};

use crate::sentences;

/// A figure that is computed for every case.
#[derive(Clone, Debug, PartialEq)]
pub struct SweepFigure {
    /// The figure as the user writes it; also the name of its column.
    pub text: String,
    pub(crate) kind: FigureKind,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum FigureKind {
    /// A statistic of a quantity.
    Turn(TurnFigure),
    /// Input of the first drive at which the quantity has its extreme (deg or mm).
    Place(TurnFigure),
    /// Smallest transmission angle of all dyads at the instants of the grid (deg, at most 90).
    TransmissionAngle,
    /// Lower (0) or upper (1) limit of the range of motion (deg or mm); 0 and 360 for a full turn.
    Reach(usize),
    /// Verdict of a formula: 1 agrees, 0 disagrees, NaN inconclusive.
    Verdict(String),
}

/// Figures of the whole mechanism.
const WHOLE: [(&str, FigureKind); 3] = [
    ("transmission_angle_deg", FigureKind::TransmissionAngle),
    ("reach_from", FigureKind::Reach(0)),
    ("reach_to", FigureKind::Reach(1)),
];

/// Prefix of the verdict of a formula.
const VERDICT: &str = "verdict:";

/// Prefix of the input at an extreme.
const PLACE: &str = "at_";

impl SweepFigure {
    /// Reads a figure, and checks that the scenario has its quantity.
    /// There are these figures:
    /// - a statistic of a quantity ([`TurnFigure`]), such as `max:joint.A.f_N`; the quantity is a channel or an
    ///   expression of channels as in claims of formulas;
    /// - the input at an extreme: `at_max:`, `at_min:` or `at_maxabs:` and a quantity;
    /// - `transmission_angle_deg`, `reach_from`, `reach_to`;
    /// - `verdict:NAME`, for a formula of the file.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] for an unknown figure, and for a mistake in its expression.
    pub fn parse(text: &str, scenario: &Scenario) -> Result<SweepFigure> {
        let wrong = |message: String, help: String| Err(Error::new(ErrorKind::Input, message).help(help));
        let figure = SweepFigure::unchecked(text.trim())?;
        match &figure.kind {
            FigureKind::Verdict(name) => {
                let claims = scenario.formulas.list.iter().filter(|own| own.claim.is_some());
                let names: Vec<&str> = claims.map(|own| own.name.as_str()).collect();
                if !names.contains(&name.as_str()) {
                    return wrong(sentences::no_formula_claims(name), suggestion(name, names, "`"));
                }
            }
            FigureKind::Turn(own) | FigureKind::Place(own) => {
                let claim = claim(own, scenario)?;
                if !claim.figures.is_empty() {
                    return wrong(sentences::is_one_number_already(&own.quantity), sentences::A_FIGURE_IS.into());
                }
            }
            FigureKind::TransmissionAngle | FigureKind::Reach(_) => {}
        }
        Ok(figure)
    }

    /// Reads a figure without checking that a scenario has its quantity.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] for an unknown figure.
    pub(crate) fn unchecked(text: &str) -> Result<SweepFigure> {
        let own = |kind: FigureKind| Ok(SweepFigure { text: text.into(), kind });
        if let Some((_, kind)) = WHOLE.into_iter().find(|(name, _)| *name == text) {
            return own(kind);
        }
        if let Some(name) = text.strip_prefix(VERDICT) {
            return own(FigureKind::Verdict(name.into()));
        }
        if !text.contains(':') {
            let near = suggestion(text, WHOLE.into_iter().map(|(name, _)| name), "`");
            let error = Error::new(ErrorKind::Input, sentences::no_figure(&text));
            return Err(error.help(format!("{near}; {}", sentences::A_FIGURE_IS)));
        }
        if let Some(figure) = text.strip_prefix(PLACE).and_then(|rest| rest.parse::<TurnFigure>().ok())
            && matches!(figure.statistic, Statistic::Max | Statistic::Min | Statistic::MaxAbs)
        {
            return own(FigureKind::Place(figure));
        }
        own(FigureKind::Turn(text.parse()?))
    }

    /// Whether the figure needs the formulas of the file.
    pub(crate) fn is_of_formulas(&self) -> bool {
        matches!(self.kind, FigureKind::Verdict(_))
    }

    /// Unit of the figure, as channels have it; empty for a number without a unit.
    #[must_use]
    pub fn unit(&self, scenario: &Scenario) -> String {
        let input = scenario.case.crank().input.shown_in().0;
        match &self.kind {
            FigureKind::Turn(own) => claim(own, scenario).map_or_else(|_| String::new(), |claim| claim.unit().into()),
            FigureKind::Place(_) => input.into(),
            FigureKind::TransmissionAngle => "deg".into(),
            FigureKind::Reach(_) => input.into(),
            FigureKind::Verdict(_) => String::new(),
        }
    }
}

/// The quantity of a figure, which may name parameters of the scenario.
fn claim(figure: &TurnFigure, scenario: &Scenario) -> Result<Claim> {
    Claim::with_parameters(&figure.quantity, &scenario.case, &scenario.formulas.parameters).map_err(|fault| {
        Error::new(ErrorKind::Input, format!("{}: {}", figure.quantity, fault.message)).help(fault.help)
    })
}

/// The solution of a case, as far as the figures need it.
struct SolvedCase {
    trajectory: Trajectory,
    /// Smallest sine of a transmission angle.
    sine: f64,
}

/// Writes the figures of a scenario into `values`. Figures that do not exist are NaN.
///
/// # Errors
/// The errors of the analytic solver, of range of motion, and of formulas.
pub(crate) fn all(figures: &[SweepFigure], scenario: &Scenario, values: &mut [f64]) -> Result<()> {
    let case = &scenario.case;
    let mut claims: Vec<Option<Claim>> = Vec::new();
    for figure in figures {
        claims.push(match &figure.kind {
            FigureKind::Turn(own) | FigureKind::Place(own) => Some(claim(own, scenario)?),
            FigureKind::TransmissionAngle | FigureKind::Reach(_) | FigureKind::Verdict(_) => None,
        });
    }
    let channels: Vec<Channel> = claims.iter().flatten().flat_map(Claim::components).collect();
    let needs_poses = figures.iter().any(|own| own.kind == FigureKind::TransmissionAngle);
    let solved = match channels.is_empty() && !needs_poses {
        true => None,
        false => Some(solved(case, &channels, needs_poses)?),
    };
    let mut extent = None;
    for ((figure, claim), value) in figures.iter().zip(&claims).zip(values) {
        *value = match (&figure.kind, claim, &solved) {
            (FigureKind::Turn(own), Some(claim), Some(solved)) => own.sampled(claim, &solved.trajectory)?.value,
            (FigureKind::Place(own), Some(claim), Some(solved)) => {
                let row = own.sampled(claim, &solved.trajectory)?.rows[0];
                case.crank().input.shown(solved.trajectory.inputs()[row])
            }
            (FigureKind::TransmissionAngle, _, Some(solved)) => angle_of_sine(solved.sine),
            (FigureKind::Turn(_) | FigureKind::Place(_) | FigureKind::TransmissionAngle, ..) => f64::NAN,
            (FigureKind::Reach(end), ..) => {
                let extent = match extent {
                    Some(extent) => extent,
                    None => *extent.insert(reachable(case)?),
                };
                match extent {
                    Extent::FullTurn(_) => [0.0, 360.0][*end],
                    Extent::Limited(limits) => case.crank().input.shown(limits[*end].crank),
                }
            }
            (FigureKind::Verdict(name), ..) => verdict(scenario, name)?,
        };
    }
    Ok(())
}

fn solved(case: &Case, channels: &[Channel], needs_poses: bool) -> Result<SolvedCase> {
    let mut sine = f64::NAN;
    // Like `solve`, only the part of the mechanism on which the requested channels depend is solved.
    // A transmission angle needs all links.
    let wanted = if needs_poses { case.clone() } else { case.wanting_only(channels).scene()?.case };
    let mut sampler = Sampler::new(&wanted);
    AssurSolver
        .each(&wanted, &mut |row, state| {
            if needs_poses {
                let groups = wanted.structure.groups.ids();
                let sines = groups.filter_map(|group| sine_of(&wanted, group, &state.motions));
                let least = sines.fold(f64::INFINITY, f64::smaller);
                if !(sine <= least) && least.is_finite() {
                    sine = least;
                }
            }
            sampler.put(&wanted, row, state);
            Ok(())
        })
        .map_err(|error| analytic::range::explained(&wanted, error))?;
    Ok(SolvedCase { trajectory: sampler.finish(&wanted)?, sine })
}

/// Sine of a dyad's transmission angle, without its sign.
fn sine_of(case: &Case, group: GroupId, motions: &PerLink<Motion>) -> Option<f64> {
    let own = &case.structure.groups[group];
    if is_plain_dyad(own) {
        return Some(rrr_sine([0, 1].map(|k| motions[own.links[k]].direction), spans(case, group)));
    }
    transmission_sine(&case.mechanism, own, &Pose::of(motions)).map(f64::abs)
}

/// The angle of a sine (deg, at most 90).
pub(crate) fn angle_of_sine(sine: f64) -> f64 {
    sine.smaller(1.0).asin().to_degrees()
}

/// Whether a group is a dyad with three pins.
pub(crate) fn is_plain_dyad(group: &Group) -> bool {
    group.kind == GroupKind::Rrr && group.is_rigid()
}

fn verdict(scenario: &Scenario, name: &str) -> Result<f64> {
    let mut only = scenario.clone();
    only.formulas.list.iter_mut().filter(|own| own.name != name).for_each(|own| own.claim = None);
    let found = prover::run::solved::judge(&only)?;
    Ok(match found.verdict {
        prover::bounds::Verdict::Agree { .. } => 1.0,
        prover::bounds::Verdict::Disagree { .. } | prover::bounds::Verdict::Expected { .. } => 0.0,
        prover::bounds::Verdict::Inconclusive { .. } => f64::NAN,
    })
}
