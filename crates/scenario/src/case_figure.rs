//! A figure: one number that describes the whole motion of a case.
//! Sweeps and the section `[report]` request figures.

use super::claim::Claim;
use super::formula::Formulas;
use super::keys::key::{Section, ValueKind, needed};
use super::reader::TomlTable;
use super::statistic::{Statistic, TurnFigure};
use super::words::suggestion;
use crate::sentences;
use linkage::case::Case;
use linkage::error::{Advice, Error, ErrorKind, Result};

/// Descriptions of the keys that this module reads.
pub const SECTIONS: &[Section] = &[Section::at("report")
    .with(&[needed("figures", ValueKind::Texts)
        .means("figures that the report of a proof shows, instead of its usual ones")])];

/// A figure of a case, with its text.
#[derive(Clone, Debug, PartialEq)]
pub struct CaseFigure {
    /// The figure as the user writes it; also the name of its column in tables.
    pub text: String,
    /// What the figure is.
    pub kind: FigureKind,
}

/// The kinds of a [`CaseFigure`].
#[derive(Clone, Debug, PartialEq)]
pub enum FigureKind {
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

/// Name of the smallest transmission angle.
pub const TRANSMISSION_ANGLE: &str = "transmission_angle_deg";

/// Figures of the whole mechanism.
const WHOLE: [(&str, FigureKind); 3] = [
    (TRANSMISSION_ANGLE, FigureKind::TransmissionAngle),
    ("reach_from", FigureKind::Reach(0)),
    ("reach_to", FigureKind::Reach(1)),
];

/// Prefix of the verdict of a formula.
const VERDICT: &str = "verdict:";

/// Prefix of the input at an extreme.
const PLACE: &str = "at_";

impl CaseFigure {
    /// What a figure may be, as help for users.
    pub const HELP: &str = sentences::A_FIGURE_IS;

    /// Reads a figure, and checks that the case has its quantity.
    /// There are these figures:
    /// - a statistic of a quantity ([`TurnFigure`]), such as `max:joint.A.f_N`; the quantity is a channel or an
    ///   expression of channels as in claims of formulas;
    /// - the input at an extreme: `at_max:`, `at_min:` or `at_maxabs:` and a quantity;
    /// - `transmission_angle_deg`, `reach_from`, `reach_to`;
    /// - `verdict:NAME`, for a formula of the file.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] for an unknown figure, and for a mistake in its expression.
    pub fn parse(text: &str, case: &Case, formulas: &Formulas) -> Result<CaseFigure> {
        let wrong = |message: String, help: String| Err(Error::new(ErrorKind::Input, message).help(help));
        let figure = CaseFigure::unchecked(text.trim())?;
        if let FigureKind::Verdict(name) = &figure.kind {
            let claims = formulas.list.iter().filter(|own| own.claim.is_some());
            let names: Vec<&str> = claims.map(|own| own.name.as_str()).collect();
            if !names.contains(&name.as_str()) {
                return wrong(sentences::no_formula_claims(name), suggestion(name, names, "`"));
            }
        }
        if let Some(claim) = figure.claim(case, formulas)?
            && !claim.figures.is_empty()
        {
            return wrong(sentences::is_one_number_already(&claim.text), sentences::A_FIGURE_IS.into());
        }
        Ok(figure)
    }

    /// Reads a figure without checking that a case has its quantity.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] for an unknown figure.
    pub fn unchecked(text: &str) -> Result<CaseFigure> {
        let own = |kind: FigureKind| Ok(CaseFigure { text: text.into(), kind });
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

    /// The quantity of the figure, which may name parameters of the scenario. `None` for a figure without a quantity.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] for a mistake in the expression.
    pub fn claim(&self, case: &Case, formulas: &Formulas) -> Result<Option<Claim>> {
        let (FigureKind::Turn(own) | FigureKind::Place(own)) = &self.kind else { return Ok(None) };
        Claim::with_parameters(&own.quantity, case, &formulas.parameters).map(Some).map_err(|fault| {
            Error::new(ErrorKind::Input, format!("{}: {}", own.quantity, fault.message)).help(fault.help)
        })
    }

    /// Whether the figure needs the formulas of the file.
    #[must_use]
    pub fn is_of_formulas(&self) -> bool {
        matches!(self.kind, FigureKind::Verdict(_))
    }

    /// Unit of the figure, written like the unit of a channel; empty for a number without a unit.
    #[must_use]
    pub fn unit(&self, case: &Case, formulas: &Formulas) -> String {
        let input = case.crank().input.shown_in().0;
        match &self.kind {
            FigureKind::Turn(_) => {
                self.claim(case, formulas).ok().flatten().map_or_else(String::new, |claim| claim.unit().into())
            }
            FigureKind::Place(_) | FigureKind::Reach(_) => input.into(),
            FigureKind::TransmissionAngle => "deg".into(),
            FigureKind::Verdict(_) => String::new(),
        }
    }
}

/// The figures of the section `[report]`.
///
/// # Errors
/// [`ErrorKind::Input`] for an unknown figure, for a figure that the solution of the case does not contain, and for an
/// empty list.
pub(super) fn reported(mut table: TomlTable, case: &Case, formulas: &Formulas) -> Result<Vec<CaseFigure>> {
    let texts = table.strings("figures")?;
    table.finish()?;
    if texts.is_empty() {
        return table.refuse("figures", sentences::NO_FIGURE_IS_REPORTED, sentences::A_REPORTED_FIGURE_IS);
    }
    let wanted = case.channels();
    let mut figures = Vec::new();
    for text in texts {
        let found =
            CaseFigure::parse(&text, case, formulas).and_then(|figure| Ok((figure.claim(case, formulas)?, figure)));
        let (claim, figure) = match found {
            Ok(found) => found,
            Err(error) => {
                let help = error.way_out().unwrap_or_default();
                return table.refuse("figures", error.message(), Advice::Text(help));
            }
        };
        if matches!(figure.kind, FigureKind::Reach(_) | FigureKind::Verdict(_)) {
            return table.refuse(
                "figures",
                sentences::is_no_figure_of_a_report(&text),
                sentences::A_REPORTED_FIGURE_IS,
            );
        }
        let lacks = claim.iter().flat_map(Claim::components).find(|channel| !wanted.contains(channel));
        if let Some(channel) = lacks {
            let message = sentences::the_figure_needs_the_channel(&text, &channel);
            return table.refuse("figures", message, sentences::ASK_FOR_THE_CHANNEL);
        }
        figures.push(figure);
    }
    Ok(figures)
}
