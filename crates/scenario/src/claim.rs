//! The claim of a formula: the channel, figure or expression that the formula is said to equal.

use super::figure::MechanismFigure;
use super::printed::PrintedChannel;
use super::reduced::QUANTITIES;
use super::words::nearest;
use crate::sentences;
use formula::{FormulaFault, FormulaGraph, FormulaTree, NodeShape, Operator};
use linkage::case::Case;
use linkage::trajectory::Channel;

/// A channel, a figure, or an arithmetic expression of channels and figures, in the units of their names.
#[derive(Clone, Debug)]
pub struct Claim {
    /// Text of the claim.
    pub text: String,
    /// The text as parsed. Its names denote channels and figures.
    /// A quantity reduced to the crank is replaced by its arithmetic expression of channels.
    pub tree: FormulaTree,
    /// The channels in the claim, with their names in the expression tree.
    pub channels: Vec<(String, PrintedChannel)>,
    /// The figures of the mechanism in the claim, with their names in the expression tree.
    pub figures: Vec<(String, MechanismFigure)>,
    /// Unit of the claim's values; empty for an arithmetic expression.
    unit: &'static str,
}

impl Claim {
    /// Reads a claim about a case.
    ///
    /// # Errors
    /// The mistake, with its position in the text.
    pub fn parse(text: &str, case: &Case) -> Result<Claim, FormulaFault> {
        Claim::read(text, &case.all_channels(), Some(case))
    }

    /// Reads a claim about the given channels, without a case.
    ///
    /// # Errors
    /// The mistake, with its position in the text.
    pub fn of_channels(text: &str, all: &[Channel]) -> Result<Claim, FormulaFault> {
        Claim::read(text, all, None)
    }

    fn read(text: &str, all: &[Channel], case: Option<&Case>) -> Result<Claim, FormulaFault> {
        let channel = |name: &str| PrintedChannel::named(name).filter(|found| all.contains(&found.channel));
        // A channel name may contain characters that are operators in an arithmetic expression.
        let written = match channel(text) {
            Some(_) => FormulaTree { shape: NodeShape::Name(text.into()), at: 0..text.len() },
            None => FormulaTree::parse(text)?,
        };
        let mut claim =
            Claim { text: text.into(), tree: written.clone(), channels: Vec::new(), figures: Vec::new(), unit: "" };
        for (name, at) in written.names() {
            let fault = |(message, help): (String, String)| FormulaFault { message, at, help };
            let quantity = case.and_then(|case| Some((QUANTITIES.iter().find(|own| own.name == name)?, case)));
            let unit = if let Some((quantity, case)) = quantity {
                claim.tree = claim.tree.with_name(name, &quantity.of(case).map_err(fault)?);
                quantity.unit
            } else if let Some(figure) = case.and_then(|case| MechanismFigure::claimed(name, case)) {
                let figure = figure.map_err(fault)?;
                claim.figures.push((name.into(), figure));
                figure.unit()
            } else if let Some(found) = channel(name) {
                found.unit_symbol()
            } else {
                return Err(fault(unknown(name, all)));
            };
            if matches!(written.shape, NodeShape::Name(_)) {
                claim.unit = unit;
            }
        }
        let is_figure = |name: &str| claim.figures.iter().any(|(own, _)| own == name);
        let names = claim.tree.names().into_iter().map(|(name, _)| name).filter(|name| !is_figure(name));
        let mut channels: Vec<(String, PrintedChannel)> = Vec::new();
        for name in names {
            if channels.iter().all(|(own, _)| own != name) {
                channels.extend(channel(name).map(|found| (name.into(), found)));
            }
        }
        claim.channels = channels;
        claim.figures.sort_by(|one, other| one.0.cmp(&other.0));
        claim.figures.dedup_by(|one, other| one.0 == other.0);
        if claim.channels.is_empty() && claim.figures.is_empty() {
            let help = sentences::NAME_A_CHANNEL_SUCH_AS_LINK.to_string();
            return Err(FormulaFault {
                message: sentences::THE_CLAIM_NAMES_NO_CHANNEL.into(),
                at: 0..text.len(),
                help,
            });
        }
        let names = written.names().into_iter().map(|(name, _)| name).collect::<Vec<&str>>();
        FormulaGraph::new(&names, 0).add_defined(&written)?;
        Ok(claim)
    }

    /// Unit of the claim's values; empty for an arithmetic expression.
    #[must_use]
    pub fn unit(&self) -> &'static str {
        match self.turn() {
            Some(360.0) => "deg",
            _ => self.unit,
        }
    }

    /// A full turn in the unit of the claim, if the claim is an angle, or a sum or difference of angles.
    /// Values of an angle that differ by full turns are equivalent.
    #[must_use]
    pub fn turn(&self) -> Option<f64> {
        fn is_sum(tree: &FormulaTree) -> bool {
            match &tree.shape {
                NodeShape::Number(_) | NodeShape::Name(_) => true,
                NodeShape::Negative(part) => is_sum(part),
                NodeShape::Pair(Operator::Plus | Operator::Minus, parts) => parts.iter().all(is_sum),
                NodeShape::Pair(Operator::Times | Operator::Over | Operator::Power, _) | NodeShape::Call(..) => false,
            }
        }
        let turns: Vec<Option<f64>> = self.channels.iter().map(|(_, channel)| channel.turn()).collect();
        let first = turns.first().copied().flatten()?;
        let is_angle = self.figures.is_empty() && is_sum(&self.tree) && turns.iter().all(|turn| *turn == Some(first));
        is_angle.then_some(first)
    }
}

/// The channel of the first drive, if `name` contains its joint: `drive.force_N` for `drive.X.force_N`.
fn of_first_drive<'a>(name: &str, known: &'a [String]) -> Option<&'a str> {
    let (joint, quantity) = name.strip_prefix("drive.")?.split_once('.')?;
    let is_further = known.iter().any(|own| own.starts_with(&format!("drive.{joint}.")));
    known.iter().map(String::as_str).find(|own| !is_further && own.strip_prefix("drive.") == Some(quantity))
}

/// The message for an unknown name, and a help text with the known name that is nearest to it.
fn unknown(name: &str, all: &[Channel]) -> (String, String) {
    let known: Vec<String> = all.iter().map(Channel::to_string).collect();
    let reduced = QUANTITIES.iter().map(|own| own.name);
    let figures: Vec<String> = MechanismFigure::claims().collect();
    let all = known.iter().chain(&figures).map(String::as_str).chain(reduced);
    let help = match of_first_drive(name, &known).or_else(|| nearest(name, all)) {
        Some(near) => sentences::did_you_mean(&near),
        None => sentences::NAME_ONE_OF_THIS_SCENARIO.into(),
    };
    (sentences::there_is_no_channel_here(&name), help)
}
