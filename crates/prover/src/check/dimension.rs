//! Dimensions of formulas, as far as the units of their parameters determine them.
//! A corrected formula that adds metres to kilograms is rejected if another explanation exists.

use std::cell::Cell;
use std::collections::BTreeMap;

use formula::{FormulaTree, Function, NodeShape, Operator};
use scenario::{Claim, Formulas, Parameter};

/// Powers of kilogram, metre and second.
pub(super) type Dimension = [f64; 3];

/// A dimension; `None` if unknown.
pub(super) type Known = Option<Dimension>;

/// Error: inconsistent dimensions. Two operands have different dimensions but are added or compared, or the argument
/// of a function has a dimension.
struct Unsound;

const NONE: Dimension = [0.0; 3];
/// Cost of inspecting a formula or looking up a name, as a multiple of the cost of evaluating one subexpression.
const LOOK: u64 = 4;

/// Dimensions of the formulas of a derivation.
pub(super) struct Dimensions<'a> {
    formulas: &'a Formulas,
    of: usize,
    claimed: Known,
    /// Dimensions of the formulas as written. The list ends at the first inconsistent formula.
    written: Vec<Known>,
    /// Indices of the formulas by name.
    steps: BTreeMap<&'a str, usize>,
    parameters: BTreeMap<&'a str, &'a Parameter>,
    /// Number of formulas inspected and names looked up since the last call of `work`.
    looked: Cell<u64>,
}

impl<'a> Dimensions<'a> {
    /// Determines the dimension of the claim of the formula `of`, and the dimensions of all formulas before it.
    pub(super) fn of(formulas: &'a Formulas, of: usize, claim: &Claim) -> Self {
        let steps = formulas.list.iter().enumerate().map(|(index, own)| (own.name.as_str(), index)).collect();
        let named = |own: &'a Parameter| own.names().map(move |(name, _)| (name, own));
        let parameters = formulas.parameters.iter().flat_map(named).collect();
        let (claimed, written, looked) = (claimed(claim), Vec::new(), Cell::new(0));
        let mut own = Dimensions { formulas, of, claimed, written, steps, parameters, looked };
        for formula in &formulas.list[..of] {
            match own.dimension(&formula.tree, &own.written) {
                Ok(known) => own.written.push(known),
                Err(Unsound) => break,
            }
        }
        own
    }

    /// Returns the number of operations since the last call.
    pub(super) fn work(&self) -> u64 {
        LOOK * self.looked.take()
    }

    /// Whether the units are consistent if the formulas with the indices in `changed` have these trees.
    pub(super) fn are_sound(&self, changed: &[(usize, FormulaTree)]) -> bool {
        let first = changed.iter().map(|(index, _)| *index).min().unwrap_or(self.of);
        let Some(known) = self.written.get(..first) else { return false };
        let mut known = known.to_vec();
        for index in first..=self.of {
            let other = changed.iter().find(|(own, _)| *own == index).map(|(_, tree)| tree);
            match self.dimension(other.unwrap_or(&self.formulas.list[index].tree), &known) {
                Ok(own) => known.push(own),
                Err(Unsound) => return false,
            }
        }
        same(known[self.of], self.claimed).is_ok()
    }

    /// Judges by units whether the author may have meant the trees in `changed`.
    /// `replaced` holds the old and the new subexpression in the formula `index`.
    /// `Some(true)` if the units are consistent.
    /// `Some(false)` if the units are inconsistent although the old and the new subexpression have the same known
    /// dimension. The replacement is then not the cause of the inconsistency.
    /// `None` otherwise.
    pub(super) fn standing(
        &self,
        changed: &[(usize, FormulaTree)],
        index: usize,
        replaced: [&FormulaTree; 2],
    ) -> Option<bool> {
        if self.are_sound(changed) {
            return Some(true);
        }
        let known = &self.written[..index.min(self.written.len())];
        let [written, right] = replaced.map(|tree| self.dimension(tree, known).ok());
        (written.is_some() && written == right).then_some(false)
    }

    /// Dimension of a tree of parameters and numbers; `None` if unknown or inconsistent.
    pub(super) fn of_constant(&self, tree: &FormulaTree) -> Known {
        self.dimension(tree, &self.written).ok().flatten()
    }

    /// Whether a factor times a quantity with this unit has the dimension of the claim.
    pub(super) fn is_sound_term(&self, factor: &FormulaTree, unit: &str) -> bool {
        let Ok(Some(factor)) = self.dimension(factor, &[]) else { return false };
        let Some(basis) = of_unit(unit) else { return false };
        self.claimed == Some([0, 1, 2].map(|axis: usize| factor[axis] + basis[axis]))
    }

    fn dimension(&self, tree: &FormulaTree, known: &[Known]) -> Result<Known, Unsound> {
        self.looked.update(|looked| looked + 1);
        of_tree(tree, &|name| {
            self.looked.update(|looked| looked + 1);
            match self.steps.get(name).and_then(|&step| known.get(step)) {
                Some(step) => *step,
                None => self.of_parameter(name),
            }
        })
    }

    fn of_parameter(&self, name: &str) -> Known {
        match name {
            "phi" | "pi" => Some(NONE),
            "t" => Some([0.0, 0.0, 1.0]),
            scenario::formula::OMEGA => Some([0.0, 0.0, -1.0]),
            _ => of_unit(self.parameters.get(name)?.unit()?),
        }
    }
}

/// Dimension of a claim.
fn claimed(claim: &Claim) -> Known {
    if !claim.unit().is_empty() {
        return of_unit(claim.unit());
    }
    // A claim on a quantity reduced to the crank uses channels that the text of the claim does not name. The dimension
    // of such a claim is unknown, because the expression of the quantity contains masses as plain numbers.
    if claim.channels.iter().any(|(name, _)| !claim.text.contains(name.as_str())) {
        return None;
    }
    let channel = |name: &str| claim.channels.iter().find(|(own, _)| own == name).map(|(_, own)| own.unit_symbol());
    let figure = |name: &str| claim.figures.iter().find(|(own, _)| own == name).map(|(_, own)| own.unit());
    of_tree(&claim.tree, &|name| of_unit(channel(name).or_else(|| figure(name))?)).ok().flatten()
}

/// Dimension of a unit as written in channels and keys.
/// `N_m` counts as newton metre, not as newton per metre, because moments are more frequent in formulas of linkages
/// than spring rates.
fn of_unit(unit: &str) -> Known {
    Some(match unit {
        "rad" | "deg" => NONE,
        "m" | "mm" => [0.0, 1.0, 0.0],
        "rad_s" | "rpm" | "rad/s" => [0.0, 0.0, -1.0],
        "rad_s2" | "rad/s^2" => [0.0, 0.0, -2.0],
        "m_s" | "m/s" => [0.0, 1.0, -1.0],
        "m_s2" | "m/s^2" => [0.0, 1.0, -2.0],
        "s" | "ms" => [0.0, 0.0, 1.0],
        "kg" | "g" => [1.0, 0.0, 0.0],
        "kg_m2" | "kg m^2" => [1.0, 2.0, 0.0],
        "N" | "kN" => [1.0, 1.0, -2.0],
        "N m" | "N_m" | "N_m_rad" => [1.0, 2.0, -2.0],
        "N_m_s" => [1.0, 2.0, -1.0],
        "N_s_m" => [1.0, 0.0, -1.0],
        "N_mm" => [1.0, 0.0, -2.0],
        "kg_per_m" => [1.0, -1.0, 0.0],
        "W" | "kW" => [1.0, 2.0, -3.0],
        _ => return None,
    })
}

/// Common dimension of two expressions that are added, subtracted, compared, or passed to `atan2`.
fn same(one: Known, other: Known) -> Result<Known, Unsound> {
    match (one, other) {
        (Some(one), Some(other)) if one != other => Err(Unsound),
        (None, other) => Ok(other),
        (one, _) => Ok(one),
    }
}

/// Value of an exponent like `2`, `-2` or `1/2`; `None` for anything else.
fn number(tree: &FormulaTree) -> Option<f64> {
    match &tree.shape {
        NodeShape::Number(value) => Some(*value),
        NodeShape::Negative(part) => Some(-number(part)?),
        NodeShape::Pair(Operator::Over, parts) => Some(number(&parts[0])? / number(&parts[1])?),
        NodeShape::Pair(..) | NodeShape::Name(_) | NodeShape::Call(..) => None,
    }
}

fn of_tree(tree: &FormulaTree, named: &dyn Fn(&str) -> Known) -> Result<Known, Unsound> {
    let both = |one: Known, other: Known, sign: f64| {
        let [one, other] = [one?, other?];
        Some([0, 1, 2].map(|axis: usize| one[axis] + sign * other[axis]))
    };
    Ok(match &tree.shape {
        // The number 0 has any dimension. A number that is not a multiple of 1/24, such as 9.81, may have a unit.
        NodeShape::Number(value) => (*value != 0.0 && (24.0 * value).fract() == 0.0).then_some(NONE),
        NodeShape::Name(name) => named(name),
        NodeShape::Negative(part) => of_tree(part, named)?,
        NodeShape::Pair(operator, parts) => {
            let (left, right) = (of_tree(&parts[0], named)?, of_tree(&parts[1], named)?);
            match (operator, number(&parts[1])) {
                (Operator::Plus | Operator::Minus, _) => same(left, right)?,
                (Operator::Times, _) => both(left, right, 1.0),
                (Operator::Over, _) => both(left, right, -1.0),
                (Operator::Power, Some(power)) => left.map(|left| left.map(|own| power * own)),
                (Operator::Power, None) => same(left, Some(NONE))?.and(same(right, Some(NONE))?),
            }
        }
        NodeShape::Call(function, arguments) => {
            let first = of_tree(&arguments[0], named)?;
            match function {
                Function::Sqrt => first.map(|own| own.map(|power| power / 2.0)),
                Function::Abs => first,
                Function::Sign => Some(NONE),
                Function::Atan2 => same(first, of_tree(&arguments[1], named)?).map(|_| Some(NONE))?,
                Function::Sin
                | Function::Cos
                | Function::Tan
                | Function::Asin
                | Function::Acos
                | Function::Atan
                | Function::Exp
                | Function::Ln => same(first, Some(NONE))?,
            }
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Dimension of a formula of a mass m, a length l, a time t and an angle a. All other names have unknown
    /// dimensions.
    fn of(text: &str) -> Result<Known, ()> {
        let named = |name: &str| match name {
            "m" => Some([1.0, 0.0, 0.0]),
            "l" => Some([0.0, 1.0, 0.0]),
            "t" => Some([0.0, 0.0, 1.0]),
            "a" => Some(NONE),
            _ => None,
        };
        of_tree(&FormulaTree::parse(text).unwrap(), &named).map_err(|Unsound| ())
    }

    #[test]
    fn dimensions_follow_the_operations() {
        let force = [1.0, 1.0, -2.0];
        for (text, wanted) in [
            ("m*l/t^2", Some(force)),
            ("-(m*l)/t/t", Some(force)),
            ("m*l*t^-2 + m/t*(l/t)", Some(force)),
            ("(l^2)^(1/2) - l^(-1)*l^2", Some([0.0, 1.0, 0.0])),
            ("m/(t*t/l)", Some(force)),
            ("1/t", Some([0.0, 0.0, -1.0])),
            ("2*l - l/3", Some([0.0, 1.0, 0.0])),
            ("sqrt(l^2 + l*l)", Some([0.0, 1.0, 0.0])),
            ("abs(l/t)", Some([0.0, 1.0, -1.0])),
            ("atan2(l, 2*l) + sin(a) + l/l", Some(NONE)),
            ("sign(l)*exp(a)", Some(NONE)),
            ("l + 0", Some([0.0, 1.0, 0.0])),
            // An unknown fits every dimension, and 9.81 may carry a unit.
            ("l + x", Some([0.0, 1.0, 0.0])),
            ("l*x", None),
            ("m*9.81", None),
        ] {
            assert_eq!(of(text), Ok(wanted), "{text}");
        }
        for text in ["l + t", "m - l*m", "l + 1", "sin(l)", "ln(t/l)", "atan2(l, t)", "2^l", "l^a + 1", "sqrt(l) + l"] {
            assert!(of(text).is_err(), "{text}: {:?}", of(text));
        }
    }
}
