//! The claim of a formula: the channel, figure or expression to which the formula is claimed to be equal.

use super::figure::MechanismFigure;
use super::parameters::Parameter;
use super::printed::{PrintedChannel, endings};
use super::reduced;
use super::transfer;
use super::words::nearest;
use crate::sentences;
use formula::{FormulaFault, FormulaGraph, FormulaTree, Function, NodeShape, Operator};
use linkage::case::Case;
use linkage::trajectory::Channel;

/// Endings of the names of velocities and of accelerations. The first text is the ending of a magnitude. The other two
/// texts are the ending of a component, before and after its letter `x` or `y`.
const MAGNITUDES: [(&str, &str, &str); 2] = [("v_m_s", "v", "_m_s"), ("a_m_s2", "a", "_m_s2")];

/// A channel, a figure, or an arithmetic expression of channels and figures, in the units of their names.
#[derive(Clone, Debug)]
pub struct Claim {
    /// Text of the claim.
    pub text: String,
    /// The expression tree of the text. The names in the tree denote channels and figures.
    /// A reduced quantity, transfer function or instant centre is replaced by its arithmetic expression of channels.
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
        Claim::with_parameters(text, case, &[])
    }

    /// Reads a claim about a case. The name `pi` and the names of parameters are replaced by their numbers.
    ///
    /// # Errors
    /// The mistake, with its position in the text.
    pub fn with_parameters(text: &str, case: &Case, parameters: &[Parameter]) -> Result<Claim, FormulaFault> {
        Claim::read(text, &case.all_channels(), Some(case), parameters)
    }

    /// Reads a claim about the given channels, without a case.
    ///
    /// # Errors
    /// The mistake, with its position in the text.
    pub fn of_channels(text: &str, all: &[Channel]) -> Result<Claim, FormulaFault> {
        Claim::read(text, all, None, &[])
    }

    /// The names that a claim about a case may contain, except the names of figures and of quantities reduced to the
    /// crank.
    /// Channels in every unit and magnitudes of vectors come first, in the order of the channels.
    /// Then come transfer functions, instant centres and acceleration poles.
    #[must_use]
    pub fn names(case: &Case) -> Vec<String> {
        names(&case.all_channels()).into_iter().chain(transfer::names(case)).collect()
    }

    fn read(text: &str, all: &[Channel], case: Option<&Case>, parameters: &[Parameter]) -> Result<Claim, FormulaFault> {
        let number = |name: &str| match name {
            "pi" => Some(std::f64::consts::PI),
            _ => parameters.iter().flat_map(Parameter::names).find(|(own, _)| *own == name).map(|(_, own)| own.value),
        };
        let channel = |name: &str| PrintedChannel::named(name).filter(|found| all.contains(&found.channel));
        // A channel name may contain characters that are operators in an arithmetic expression.
        // The text is therefore parsed as an expression only if it is not a channel or magnitude as a whole.
        let written = match channel(text).is_some() || magnitude(text, all).is_some() {
            true => FormulaTree { shape: NodeShape::Name(text.into()), at: 0..text.len() },
            false => FormulaTree::parse(text)?,
        };
        let mut claim =
            Claim { text: text.into(), tree: written.clone(), channels: Vec::new(), figures: Vec::new(), unit: "" };
        for (name, at) in written.names() {
            let fault = |(message, help): (String, String)| FormulaFault { message, at, help };
            let quantity = |case| reduced::named(name, case).or_else(|| transfer::named(name, case));
            let unit = if let Some(found) = channel(name) {
                found.unit_symbol()
            } else if let Some(number) = number(name) {
                claim.tree = claim.tree.with_name(name, &FormulaTree::number(number));
                ""
            } else if let Some((quantity, unit)) = case.and_then(quantity) {
                claim.tree = claim.tree.with_name(name, &quantity.map_err(fault)?);
                unit
            } else if let Some(figure) = case.and_then(|case| MechanismFigure::claimed(name, case)) {
                let figure = figure.map_err(fault)?;
                claim.figures.push((name.into(), figure));
                figure.unit()
            } else if let Some((tree, unit)) = magnitude(name, all) {
                claim.tree = claim.tree.with_name(name, &tree);
                unit
            } else {
                return Err(fault(unknown(name, all, case)));
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

    /// Whether the claim contains a quantity reduced to the crank, whose expression has masses as plain numbers.
    #[must_use]
    pub fn has_masses(&self) -> bool {
        reduced::names().any(|name| self.text.contains(name))
    }

    /// The channels of the claim; for a magnitude, the channels of both components.
    pub fn components(&self) -> impl Iterator<Item = Channel> {
        let of = |own: &PrintedChannel| [Some(own.channel.clone()), own.other_component()].into_iter().flatten();
        self.channels.iter().flat_map(move |(_, own)| of(own))
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

/// The names of channels, in every unit, and of the magnitudes of vectors.
fn names(all: &[Channel]) -> Vec<String> {
    let of = |channel: &Channel| {
        let subject = channel.subject();
        let own = endings(channel.kind).into_iter().map(|ending| format!("{subject}.{ending}"));
        let is_first = |(_, start, rest): &&(&str, &str, &str)| channel.kind.suffix == format!("{start}x{rest}");
        let size = MAGNITUDES.iter().find(is_first).map(|(ending, ..)| format!("{subject}.{ending}"));
        own.chain(size).collect::<Vec<_>>()
    };
    all.iter().flat_map(of).collect()
}

/// The magnitude of a velocity or acceleration, such as `point.B.v_m_s` or `link.rocker.a_m_s2`, as an expression of
/// its components, and its unit.
fn magnitude(name: &str, all: &[Channel]) -> Option<(FormulaTree, &'static str)> {
    let (ending, start, rest) = MAGNITUDES.iter().find(|(ending, ..)| name.ends_with(&format!(".{ending}")))?;
    let subject = name.strip_suffix(ending)?;
    let [x, y] = ["x", "y"].map(|axis| Channel::named(&format!("{subject}{start}{axis}{rest}")));
    let (x, y) = (x?, y?);
    let unit = all.iter().find(|own| **own == x)?.kind.unit.symbol();
    let square = |channel: Channel| {
        FormulaTree::pair(Operator::Power, FormulaTree::name(channel.to_string()), FormulaTree::number(2.0))
    };
    let sum = FormulaTree::pair(Operator::Plus, square(x), square(y));
    Some((FormulaTree::call(Function::Sqrt, vec![sum]), unit))
}

/// The channel of the first drive that `name` means, such as `drive.force_N` for `drive.X.force_N`.
/// The name of this channel contains no joint, but the names of all other drives' channels do.
fn of_first_drive<'a>(name: &str, known: &'a [String]) -> Option<&'a str> {
    let (joint, quantity) = name.strip_prefix("drive.")?.split_once('.')?;
    let is_further = known.iter().any(|own| own.starts_with(&format!("drive.{joint}.")));
    known.iter().map(String::as_str).find(|own| !is_further && own.strip_prefix("drive.") == Some(quantity))
}

/// The message for an unknown name, and a help text with the known name that is nearest to it.
fn unknown(name: &str, all: &[Channel], case: Option<&Case>) -> (String, String) {
    let known = names(all);
    let derived = reduced::names().map(String::from).chain(case.into_iter().flat_map(transfer::names));
    let others: Vec<String> = MechanismFigure::claims().chain(derived).collect();
    let all = known.iter().chain(&others).map(String::as_str);
    let help = match of_first_drive(name, &known).or_else(|| nearest(name, all)) {
        Some(near) => sentences::did_you_mean(&near),
        None => sentences::NAME_ONE_OF_THIS_SCENARIO.into(),
    };
    (sentences::there_is_no_channel_here(&name), help)
}
