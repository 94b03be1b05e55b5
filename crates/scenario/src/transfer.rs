//! Transfer functions, instant centres and acceleration poles, as arithmetic expressions of channels.
//!
//! Each solver or engine computes positions, velocities and accelerations by separate equations.
//! The quantities of this file are computed from these positions, velocities and accelerations.

use super::reduced::{Found, input, of_link, one_drive};
use formula::{FormulaTree, Operator};
use linkage::case::Case;
use linkage::mechanism::{GROUND, Link};
use linkage::trajectory::{Channel, Stage};

/// Names of all transfer functions, instant centres and acceleration poles of a case.
pub(super) fn names(case: &Case) -> Vec<String> {
    let functions = case.all_channels().into_iter().filter(|channel| channel.kind.stage == Stage::Positions);
    let functions = functions.flat_map(|channel| {
        let of = channel.subject();
        [1, 2].map(|order| format!("{of}.{}", word(order, &channel)))
    });
    let links: Vec<&str> = case.mechanism.links().iter().map(|link| link.name.as_str()).collect();
    let pairs = links.iter().enumerate().flat_map(|(k, one)| links[k + 1..].iter().map(move |other| (one, other)));
    let centres = pairs.flat_map(|(one, other)| ["x_m", "y_m"].map(|axis| format!("centre.{one}.{other}.{axis}")));
    let poles = links[1..].iter().flat_map(|link| ["x_m", "y_m"].map(|axis| format!("pole.{link}.{axis}")));
    functions.chain(centres).chain(poles).collect()
}

/// Last part of a transfer function's name: `dangle_dphi`, `d2x_dphi2_m`.
fn word(order: u32, channel: &Channel) -> String {
    let (stem, unit) = match channel.kind.suffix.strip_suffix("_rad") {
        Some(angle) => (angle, ""),
        None => (channel.kind.suffix.trim_end_matches("_m"), "_m"),
    };
    match order {
        1 => format!("d{stem}_dphi{unit}"),
        order => format!("d{order}{stem}_dphi{order}{unit}"),
    }
}

/// The transfer function, instant centre or acceleration pole called `name` as an expression of channels, and its unit.
/// `None` if the case has no quantity of this name.
///
/// Let q be a position or an angle, q' and q'' its time derivatives, w the velocity of the input phi, and e the
/// acceleration of the input. Then
/// dq/dphi = q' / w, and d2q/dphi2 = (q'' - dq/dphi e) / w^2 (derivatives of q(phi(t)) by the chain rule).
/// At the instant centre of two links, the velocities of both links are equal. The pole of a link is its point without
/// acceleration.
pub(super) fn named(name: &str, case: &Case) -> Option<(Found, &'static str)> {
    let (si, factor) = match name.strip_suffix("_mm") {
        Some(stem) => (format!("{stem}_m"), Some(1e3)),
        None => (name.to_string(), None),
    };
    let scaled = |tree: FormulaTree| match factor {
        Some(factor) => pair(Operator::Times, FormulaTree::number(factor), tree),
        None => tree,
    };
    let unit = match (si.ends_with("_m"), factor) {
        (true, Some(_)) => "mm",
        (true, None) => "m",
        (false, _) => "",
    };
    let found = match si.split('.').next()? {
        "centre" => Ok(centre(&si, case)?),
        "pole" => Ok(pole(&si, case)?),
        _ => function(&si, case)?,
    };
    Some((found.map(scaled), unit))
}

fn pair(operator: Operator, one: FormulaTree, other: FormulaTree) -> FormulaTree {
    FormulaTree::pair(operator, one, other)
}

fn square(tree: FormulaTree) -> FormulaTree {
    pair(Operator::Power, tree, FormulaTree::number(2.0))
}

fn function(name: &str, case: &Case) -> Option<Found> {
    let (of, wanted) = name.rsplit_once('.').filter(|(_, wanted)| wanted.contains("_dphi"))?;
    let mut positions = case.all_channels().into_iter().filter(|channel| channel.kind.stage == Stage::Positions);
    let (channel, order) = positions.find_map(|channel| {
        let order = [1, 2].into_iter().find(|&order| word(order, &channel) == wanted)?;
        (channel.subject() == of).then_some((channel, order))
    })?;
    let rate = channel.rate()?;
    let first = pair(Operator::Over, FormulaTree::name(rate.to_string()), input(case, 1));
    Some(one_drive(name, case).map(|()| {
        if order == 1 {
            return first;
        }
        let second = rate.rate().expect("a rate of a position has a rate");
        let along = pair(Operator::Times, first, input(case, 2));
        let rest = pair(Operator::Minus, FormulaTree::name(second.to_string()), along);
        pair(Operator::Over, rest, square(input(case, 1)))
    }))
}

/// Coordinate of the instant centre of two links, such as `centre.coupler.rocker.x_m`.
fn centre(name: &str, case: &Case) -> Option<FormulaTree> {
    let (of, axis) = name.strip_prefix("centre.")?.rsplit_once('.')?;
    let links = || case.mechanism.links().iter();
    let is_pair = |one: &Link, other: &Link| one.name != other.name && of == format!("{}.{}", one.name, other.name);
    let (one, other) = links().find_map(|one| Some((one, links().find(|other| is_pair(one, other))?)))?;
    // A coordinate of the instant centre follows from one velocity component in each of the two links: that of the
    // link's point which momentarily lies at the origin of the ground's frame.
    let (velocity, across, sign) = match axis {
        "x_m" => ("vy_m_s", "x_m", Operator::Minus),
        "y_m" => ("vx_m_s", "y_m", Operator::Plus),
        _ => return None,
    };
    let ground = &case.mechanism.links()[GROUND].name;
    let at_origin = |link: &Link| {
        let turning = pair(Operator::Times, of_link(link, "omega_rad_s"), of_link(link, across));
        (link.name != *ground).then(|| pair(sign, of_link(link, velocity), turning))
    };
    let omega = |link: &Link| (link.name != *ground).then(|| of_link(link, "omega_rad_s"));
    let difference = |one: Option<FormulaTree>, other: Option<FormulaTree>| match (one, other) {
        (Some(one), Some(other)) => Some(pair(Operator::Minus, one, other)),
        (Some(one), None) => Some(one),
        (None, Some(other)) => Some(other.negative()),
        (None, None) => None,
    };
    let (from, to) = if axis == "x_m" { (one, other) } else { (other, one) };
    let above = difference(at_origin(from), at_origin(to))?;
    Some(pair(Operator::Over, above, difference(omega(other), omega(one))?))
}

/// Coordinate of the acceleration pole of a link, such as `pole.coupler.x_m`.
fn pole(name: &str, case: &Case) -> Option<FormulaTree> {
    let (of, axis) = name.strip_prefix("pole.")?.rsplit_once('.')?;
    let (id, link) = case.mechanism.links().entries().find(|(_, link)| link.name == of)?;
    let ([along, across], sign) = match axis {
        "x_m" => (["ax_m_s2", "ay_m_s2"], Operator::Minus),
        "y_m" => (["ay_m_s2", "ax_m_s2"], Operator::Plus),
        _ => return None,
    };
    let of = |word: &str| of_link(link, word);
    let omega = || square(of("omega_rad_s"));
    let towards = pair(Operator::Times, omega(), of(along));
    let turned = pair(Operator::Times, of("alpha_rad_s2"), of(across));
    let below = pair(Operator::Plus, square(omega()), square(of("alpha_rad_s2")));
    let offset = pair(Operator::Over, pair(sign, towards, turned), below);
    (id != GROUND).then(|| pair(Operator::Plus, of(axis), offset))
}
