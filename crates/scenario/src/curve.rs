//! Formulas as functions: motion laws over time, lifts over the angle of a cam.

use std::sync::{Arc, Mutex, PoisonError};

use super::formula::Formulas;
use super::reader::TomlTable;
use crate::sentences;
use formula::{FormulaFault, FormulaTree, Function, NodeShape, Program, Rounded};
use linkage::error::{ErrorKind, Result};
use linkage::math::{Curve, FormulaCurve, Smooth};

/// The variable of a formula.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CurveVariable {
    /// The time t (s).
    Time,
    /// The angle phi of a cam (rad).
    Angle,
}

/// A formula of one variable, with its derivatives.
#[derive(Debug)]
struct Stated {
    text: String,
    variable: CurveVariable,
    /// Computes the value and the first two derivatives. The program is locked because it stores intermediate values.
    program: Mutex<Program>,
}

impl Smooth for Stated {
    fn at(&self, x: f64) -> [f64; 3] {
        let mut program = self.program.lock().unwrap_or_else(PoisonError::into_inner);
        let found = program.run(&inputs(self.variable, x));
        [0, 1, 2].map(|k| found[k].value)
    }

    fn stated(&self) -> &str {
        &self.text
    }
}

/// Inputs of [`Formulas`]: the angle, then the time. The formula uses only the input `variable`, whose value is `x`.
fn inputs(variable: CurveVariable, x: f64) -> [Rounded; 2] {
    let (own, other) = (Rounded::exact(x), Rounded::UNDEFINED);
    if variable == CurveVariable::Time { [other, own] } else { [own, other] }
}

/// Reads the key `formula`: a formula of `variable` from 0 to `end`. The formula gives rad or m and may use the
/// parameters. Returns the formula minus its value at 0 as a curve, and the value at 0.
pub fn formula(table: &mut TomlTable, variable: CurveVariable, end: f64) -> Result<(Curve, f64)> {
    let text = table.string("formula")?;
    let parameters = table.source().parameters.list();
    let mut formulas = Formulas::over(parameters.to_vec());
    let program = match formulas.add("law", &text).map(|own| (own.id, own.tree.clone())) {
        Ok((id, tree)) => checked(&tree, variable).map(|()| {
            let input = usize::from(variable == CurveVariable::Time);
            let rate = formulas.graph.derivative(id, input);
            let acceleration = formulas.graph.derivative(rate, input);
            Program::of(&formulas.graph, &[id, rate, acceleration])
        }),
        Err(fault) => Err(fault),
    };
    let program = program.map_err(|fault| table.fault_in("formula", &fault))?;
    // Two curves count as equal if their texts are equal. The function also depends on the parameters, so the text
    // includes their values.
    let numbers: Vec<String> = parameters.iter().map(|own| format!("{} = {:e}", own.key, own.given)).collect();
    let stated = Stated { text: format!("{text} | {}", numbers.join(", ")), variable, program: Mutex::new(program) };
    let begin = stated.at(0.0)[0];
    let formula = FormulaCurve::new(Arc::new(stated), end);
    if let Some(x) = formula.undefined_at() {
        let message = match variable {
            CurveVariable::Time => sentences::the_formula_is_undefined_at(&"t", &x, &"s"),
            CurveVariable::Angle => sentences::the_formula_is_undefined_at(&"phi", &x, &"rad"),
        };
        return table.refuse("formula", message, sentences::GIVE_A_FORMULA_WITH_TWO_DERIVATIVES);
    }
    let curve = Curve::Formula(formula);
    if !(curve.range() > 0.0) {
        return Err(table.wrong(ErrorKind::Input, "formula", sentences::THE_FORMULA_IS_CONSTANT));
    }
    Ok((curve, begin))
}

/// Checks that a formula has the right variable and no kink.
fn checked(tree: &FormulaTree, variable: CurveVariable) -> std::result::Result<(), FormulaFault> {
    let wrong = if variable == CurveVariable::Time { "phi" } else { "t" };
    if let Some((name, at)) = tree.names().into_iter().find(|(name, _)| *name == wrong) {
        let help = if variable == CurveVariable::Time { sentences::A_LAW_USES_T } else { sentences::A_LIFT_USES_PHI };
        return Err(FormulaFault { message: sentences::is_no_variable_here(&name), at, help: help.into() });
    }
    if let Some((name, at)) = kink(tree) {
        let help = sentences::GIVE_A_FORMULA_WITH_TWO_DERIVATIVES.into();
        return Err(FormulaFault { message: sentences::has_a_kink(&name), at, help });
    }
    Ok(())
}

/// The first function with a kink or jump.
fn kink(tree: &FormulaTree) -> Option<(&'static str, std::ops::Range<usize>)> {
    if let NodeShape::Call(own @ (Function::Abs | Function::Sign), _) = &tree.shape {
        return Some((own.name(), tree.at.clone()));
    }
    tree.parts().iter().find_map(kink)
}
