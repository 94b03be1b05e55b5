//! Quantities reduced to the crank, as arithmetic expressions of channels. A claim may also name these quantities.
//!
//! The quantities follow from a motion that a solver or an engine has found: from its kinetic energy, and from its
//! balance of powers.
//! Each solver or engine finds velocities, accelerations and the drive's moment by its own equations.

use crate::sentences;
use formula::{FormulaTree, Operator};
use linkage::case::Case;
use linkage::input::Input;
use linkage::mechanism::{GROUND, Link};

/// A quantity that is an arithmetic expression of channels.
struct Quantity {
    /// Name of the quantity in a claim, unit included.
    name: &'static str,
    /// Symbol of the quantity's unit.
    unit: &'static str,
    /// Whether the quantity is reduced to a slide; if not, the quantity is reduced to an angle.
    of_slide: bool,
    tree: fn(&Case) -> Found,
}

/// The arithmetic expression, or a message and help.
pub(super) type Found = Result<FormulaTree, (String, String)>;

/// All reduced quantities. The quantities do not include motor, reducer and flywheel.
const QUANTITIES: [Quantity; 4] = [
    // Reduced moment of inertia I*: the sum of m (v / omega)^2 + J (omega_link / omega)^2 over all links.
    Quantity { name: "drive.reduced_inertia_kg_m2", unit: "kg m^2", of_slide: false, tree: inertia },
    // Moment of gravity and loads reduced to the crank, counter-clockwise positive.
    Quantity { name: "drive.reduced_moment_N_m", unit: "N m", of_slide: false, tree: moment },
    // Mass and force reduced to a slide as the input, with the speed of the slide in place of omega.
    Quantity { name: "drive.reduced_mass_kg", unit: "kg", of_slide: true, tree: inertia },
    Quantity { name: "drive.reduced_force_N", unit: "N", of_slide: true, tree: moment },
];

impl Quantity {
    /// The arithmetic expression of channels for this quantity in a case.
    ///
    /// # Errors
    /// Message and help, if the quantity has no meaning in the case.
    fn of(&self, case: &Case) -> Found {
        let input = case.crank().input;
        match case.drives.len() {
            1 if (input == Input::Slide) != self.of_slide => {
                let own = QUANTITIES.iter().filter(|own| own.of_slide != self.of_slide).map(|own| own.name);
                Err((
                    sentences::the_quantity_is_not_of_a(&self.name, &input.noun()),
                    sentences::use_one_of(&(own.collect::<Vec<_>>().join("; "))),
                ))
            }
            _ => one_drive(self.name, case).and_then(|()| (self.tree)(case)),
        }
    }
}

/// Checks that a case has one drive. With several drives, the quantity `name` has no meaning, because it refers to the
/// input of a single drive.
///
/// # Errors
/// Message and help for several drives.
pub(super) fn one_drive(name: &str, case: &Case) -> Result<(), (String, String)> {
    match case.drives.len() {
        1 => Ok(()),
        count => Err((
            sentences::is_of_one_crank_but_the_mechanism(&name, &count),
            sentences::TAKE_A_SCENARIO_WITH_ONE_DRIVE.into(),
        )),
    }
}

/// The reduced quantity called `name` as an expression of channels, and its unit. `None` if `name` is not a reduced
/// quantity.
pub(super) fn named(name: &str, case: &Case) -> Option<(Found, &'static str)> {
    QUANTITIES.iter().find(|own| own.name == name).map(|own| (own.of(case), own.unit))
}

/// Names of all reduced quantities.
pub(super) fn names() -> impl Iterator<Item = &'static str> {
    QUANTITIES.iter().map(|own| own.name)
}

fn inertia(case: &Case) -> Found {
    let square =
        |link: &Link, word: &str| FormulaTree::pair(Operator::Power, of_link(link, word), FormulaTree::number(2.0));
    let energies = masses(case).map(|link| {
        let across = FormulaTree::pair(Operator::Plus, square(link, "vx_m_s"), square(link, "vy_m_s"));
        of_inertias(link, across, square(link, "omega_rad_s"))
    });
    let Some(sum) = sum(energies) else {
        let help = sentences::GIVE_THE_LINKS_MASS_KG_AND_INERTIA.into();
        return Err((sentences::NOTHING_IN_THE_MECHANISM_HAS_A_MASS.into(), help));
    };
    Ok(FormulaTree::pair(
        Operator::Over,
        sum,
        FormulaTree::pair(Operator::Power, input(case, 1), FormulaTree::number(2.0)),
    ))
}

fn moment(case: &Case) -> Found {
    let product = |link: &Link, words: [&str; 2]| {
        let [one, other] = words.map(|word| of_link(link, word));
        FormulaTree::pair(Operator::Times, one, other)
    };
    let powers = masses(case).map(|link| {
        let across = FormulaTree::pair(
            Operator::Plus,
            product(link, ["vx_m_s", "ax_m_s2"]),
            product(link, ["vy_m_s", "ay_m_s2"]),
        );
        of_inertias(link, across, product(link, ["omega_rad_s", "alpha_rad_s2"]))
    });
    let gained =
        sum(powers).map_or(FormulaTree::number(0.0), |sum| FormulaTree::pair(Operator::Over, sum, input(case, 1)));
    let drive = if case.crank().input == Input::Slide { "drive.force_N" } else { "drive.torque_N_m" };
    // A free crank without a motor has no driving moment to subtract.
    Ok(match case.drives.with_moment().next() {
        Some(_) => FormulaTree::pair(Operator::Minus, gained, FormulaTree::name(drive)),
        None => gained,
    })
}

/// The links that move and have inertia.
fn masses(case: &Case) -> impl Iterator<Item = &Link> {
    let links = case.mechanism.links().entries().filter(|(index, _)| *index != GROUND);
    links.map(|(_, link)| link).filter(|link| link.mass > 0.0 || link.inertia > 0.0)
}

/// The input (order 0), its rate (order 1) or its acceleration (order 2), as an expression of channels.
pub(super) fn input(case: &Case, order: usize) -> FormulaTree {
    let [position, rate, acceleration] = case.input_channels();
    let terms = [position, rate, acceleration].into_iter().nth(order).into_iter().flatten();
    let mut terms = terms.map(|(channel, _)| FormulaTree::name(channel.to_string()));
    let first = terms.next().expect("the input has channels");
    // The rate of an angle between two links is the difference of their angular velocities.
    terms.fold(first, |sum, term| FormulaTree::pair(Operator::Minus, sum, term))
}

/// The link's mass times `of_mass` plus its moment of inertia times `of_inertia`. Terms that are zero are left out.
fn of_inertias(link: &Link, of_mass: FormulaTree, of_inertia: FormulaTree) -> FormulaTree {
    let parts = [(link.mass, of_mass), (link.inertia, of_inertia)];
    let parts = parts.into_iter().filter(|(factor, _)| *factor > 0.0);
    sum(parts.map(|(factor, part)| FormulaTree::pair(Operator::Times, FormulaTree::number(factor), part)))
        .expect("a link with inertia")
}

fn sum(parts: impl Iterator<Item = FormulaTree>) -> Option<FormulaTree> {
    parts.reduce(|sum, part| FormulaTree::pair(Operator::Plus, sum, part))
}

/// The channel of a link with the ending `word`.
pub(super) fn of_link(link: &Link, word: &str) -> FormulaTree {
    FormulaTree::name(format!("link.{}.{word}", link.name))
}
