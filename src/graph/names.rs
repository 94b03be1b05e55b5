//! Names of curves and axes: quantity, part of the mechanism, and unit.

use linkage::trajectory::{Channel, Stage, shown_unit};
use scenario::{Claim, PrintedChannel};

/// The name of a curve.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct CurveName {
    /// The quantity, such as `angular velocity`; empty for an expression.
    pub(super) quantity: String,
    /// Word between quantity and subject, ` of ` or ` in `.
    pub(super) of: &'static str,
    /// The part of the mechanism, or the text of an expression; empty for the whole mechanism.
    pub(super) subject: String,
    /// Unit, as people write it; empty for a quantity without a unit.
    pub(super) unit: String,
}

impl CurveName {
    /// The name of a quantity of the whole mechanism.
    pub(super) fn whole(quantity: &str, unit: &str) -> CurveName {
        CurveName { quantity: quantity.into(), unit: unit.into(), ..CurveName::default() }
    }

    /// The name of a claimed quantity.
    pub(super) fn of(claim: &Claim) -> CurveName {
        let unit = shown_unit(claim.unit());
        let text = claim.text.as_str();
        if let Some(found) = PrintedChannel::named(text).filter(|_| claim.channels.len() == 1) {
            return CurveName { unit, ..CurveName::of_channel(&found.channel, found.magnitude) };
        }
        // The ending of a magnitude is that of its first component without the letter `x`.
        let component = ["v_m_s", "a_m_s2"].iter().find_map(|ending| {
            let (subject, rest) = (text.strip_suffix(ending)?, ending.get(1..)?);
            Channel::named(&format!("{subject}{}x{rest}", &ending[..1]))
        });
        if let Some(channel) = component {
            return CurveName { unit, ..CurveName::of_channel(&channel, true) };
        }
        let suffix = format!("_{}", claim.unit().replace('^', "").replace([' ', '/'], "_"));
        if let Some(word) = text.strip_prefix("drive.").and_then(|rest| rest.strip_suffix(&suffix)) {
            return CurveName::whole(&word.replace('_', " "), &unit);
        }
        CurveName { subject: text.into(), unit, ..CurveName::default() }
    }

    fn of_channel(channel: &Channel, is_magnitude: bool) -> CurveName {
        let quantity = channel.kind.quantity;
        let quantity = quantity.strip_prefix("point ").unwrap_or(quantity);
        let first = channel.kind.suffix.split('_').next().unwrap_or_default();
        let axis = first.chars().last().filter(|axis| matches!(axis, 'x' | 'y') && first.len() <= 2 && !is_magnitude);
        let quantity = axis.map_or(quantity.to_string(), |axis| format!("{quantity} along {axis}"));
        let of = if channel.kind.stage == Stage::Reactions { " in " } else { " of " };
        CurveName { quantity, of, subject: channel.of.clone(), unit: String::new() }
    }

    /// The whole name without the unit.
    pub(super) fn full(&self) -> String {
        match (self.quantity.is_empty(), self.subject.is_empty()) {
            (_, true) => self.quantity.clone(),
            (true, false) => self.subject.clone(),
            (false, false) => format!("{}{}{}", self.quantity, self.of, self.subject),
        }
    }
}

/// The parts of names that all curves of a chart share.
pub(super) struct CommonName {
    /// Name of the vertical axis; empty if the quantities differ too much for one name.
    pub(super) axis: String,
    /// Unit of all curves; empty if their units differ.
    pub(super) unit: String,
    /// Whether all curves show the same quantity. If so, the name of a curve is only its subject.
    is_one_quantity: bool,
    /// Whether all curves have the same name. If so, only the axis has the name.
    is_one_name: bool,
    is_one_unit: bool,
}

/// The parts that the names of some curves share.
pub(super) fn common<'a>(names: impl Iterator<Item = &'a CurveName> + Clone) -> CommonName {
    let Some(first) = names.clone().next() else {
        let (axis, unit) = (String::new(), String::new());
        return CommonName { axis, unit, is_one_quantity: false, is_one_name: false, is_one_unit: false };
    };
    let is_one_name = names.clone().all(|own| own == first);
    let is_one_unit = names.clone().all(|own| own.unit == first.unit);
    let is_one_quantity =
        is_one_unit && !first.quantity.is_empty() && names.clone().all(|own| own.quantity == first.quantity);
    let mut quantities: Vec<&str> = names.map(|own| own.quantity.as_str()).collect();
    quantities.sort_unstable();
    quantities.dedup();
    let axis = match (is_one_name, is_one_quantity) {
        (true, _) => first.full(),
        (false, true) => first.quantity.clone(),
        (false, false) if quantities.len() == 2 && is_one_unit && !quantities[0].is_empty() => quantities.join(", "),
        (false, false) => String::new(),
    };
    let unit = if is_one_unit { first.unit.clone() } else { String::new() };
    CommonName { axis, unit, is_one_quantity, is_one_name, is_one_unit }
}

impl CommonName {
    /// The part of a curve's name that its axis does not state; empty if the axis states the whole name.
    pub(super) fn rest(&self, name: &CurveName) -> String {
        match (self.is_one_name, self.is_one_quantity) {
            (true, _) => String::new(),
            (false, true) if name.subject.is_empty() => name.quantity.clone(),
            (false, true) => name.subject.clone(),
            (false, false) if self.is_one_unit || name.unit.is_empty() => name.full(),
            (false, false) => format!("{}, {}", name.full(), name.unit),
        }
    }
}
