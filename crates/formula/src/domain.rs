//! Messages for operations outside their domain.

use crate::sentences;
use std::fmt::Write;

use crate::rounded::Rounded;
use crate::tree::{FormulaFault, FormulaTree, Function, NodeShape, Operator};

impl FormulaTree {
    /// Value of the formula. `of` gives the values of names.
    ///
    /// # Errors
    /// The first operation outside its domain, with its position in the text.
    pub fn evaluated(&self, of: &dyn Fn(&str) -> Rounded) -> Result<Rounded, FormulaFault> {
        let mut lower: Option<Rounded> = None;
        for tree in self.left_parts().into_iter().rev() {
            let others = &tree.parts()[usize::from(lower.is_some())..];
            let others: Vec<Rounded> = others.iter().map(|part| part.evaluated(of)).collect::<Result<_, _>>()?;
            let parts: Vec<Rounded> = lower.into_iter().chain(others).collect();
            let value = match &tree.shape {
                NodeShape::Number(number) => Rounded::decimal(*number),
                NodeShape::Name(name) => of(name),
                NodeShape::Negative(_) => parts[0].negative(),
                NodeShape::Pair(Operator::Minus, own)
                    if parts[0] == parts[1] && own[0].to_string() == own[1].to_string() =>
                {
                    Rounded::pair(Operator::Times, Rounded::exact(0.0), parts[0])
                }
                NodeShape::Pair(operator, _) => Rounded::pair(*operator, parts[0], parts[1]),
                NodeShape::Call(function, _) => {
                    Rounded::call(*function, [parts[0], *parts.last().unwrap_or(&parts[0])])
                }
            };
            if value.is_undefined() {
                return Err(undefined(tree, &parts));
            }
            lower = Some(value);
        }
        Ok(lower.expect("a tree is one of its parts"))
    }
}

/// The fault of an operation that is undefined for these arguments.
pub(crate) fn undefined(tree: &FormulaTree, arguments: &[Rounded]) -> FormulaFault {
    let of = |index: usize| arguments.get(index).map_or_else(|| "?".into(), |number| short(number.value));
    let (what, rule) = match &tree.shape {
        NodeShape::Pair(operator, _) => {
            let base = if of(0).starts_with('-') { format!("({})", of(0)) } else { of(0) };
            (format!("{base}{}{}", operator.sign(), of(1)), rule_of_operator(*operator))
        }
        NodeShape::Call(function, parts) => {
            let mut call = format!("{}({}", function.name(), of(0));
            if parts.len() > 1 {
                let _ = write!(call, ", {}", of(1));
            }
            (call + ")", rule_of_function(*function))
        }
        NodeShape::Name(name) => (format!("`{name}`"), sentences::WHAT_IT_STANDS_FOR_HAS_NO_VALUE),
        NodeShape::Number(_) | NodeShape::Negative(_) => (tree.to_string(), EVERYWHERE),
    };
    FormulaFault::new(sentences::is_undefined(&what), tree.at.clone(), rule)
}

/// Rule for operations that are defined for every number.
const EVERYWHERE: &str = sentences::ITS_PARTS_MUST_HAVE_VALUES;

fn rule_of_operator(operator: Operator) -> &'static str {
    match operator {
        Operator::Over => sentences::A_DIVISOR_MUST_NOT_BE_ZERO,
        Operator::Power => sentences::A_NEGATIVE_BASE_TAKES_A_WHOLE,
        Operator::Plus | Operator::Minus | Operator::Times => EVERYWHERE,
    }
}

fn rule_of_function(function: Function) -> &'static str {
    match function {
        Function::Ln => sentences::LN_TAKES_A_POSITIVE_NUMBER,
        Function::Sqrt => sentences::SQRT_TAKES_ZERO_OR_A_POSITIVE,
        Function::Asin | Function::Acos => sentences::ASIN_AND_ACOS_TAKE_A_NUMBER,
        Function::Atan2 => sentences::ATAN2_TAKES_TWO_NUMBERS_OF_WHICH_ONE_IS_NOT_ZERO,
        Function::Sin
        | Function::Cos
        | Function::Tan
        | Function::Atan
        | Function::Abs
        | Function::Exp
        | Function::Sign => EVERYWHERE,
    }
}

/// A number with six digits.
fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.5e}").parse().unwrap_or(value);
    if rounded == 0.0 || (1e-4..1e7).contains(&rounded.abs()) { format!("{rounded}") } else { format!("{rounded:e}") }
}
