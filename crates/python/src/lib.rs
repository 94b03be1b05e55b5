#![doc = include_str!("../README.md")]

mod builder;
mod check;
mod command;
mod compare;
mod draw;
mod errors;
mod foreign;
mod html;
mod proof;
mod scenario_class;
mod sensitivity;
mod sentences;
mod solution;
mod sweep;
mod swept;
mod table;
mod task;

use pyo3::prelude::*;

/// The compiled part of the package `linkproof`.
#[pymodule]
fn _linkproof(module: &Bound<'_, PyModule>) -> PyResult<()> {
    linkproof::cli::silence();
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<scenario_class::Scenario>()?;
    module.add_class::<builder::Builder>()?;
    module.add_class::<table::Table>()?;
    module.add_class::<solution::Solution>()?;
    module.add_class::<proof::Proof>()?;
    module.add_class::<check::FormulaCheck>()?;
    module.add_class::<compare::Comparison>()?;
    module.add_class::<draw::Picture>()?;
    module.add_class::<swept::Sweep>()?;
    module.add_class::<sensitivity::Sensitivity>()?;
    module.add_function(wrap_pyfunction!(sweep::resume, module)?)?;
    module.add_function(wrap_pyfunction!(sweep::merge, module)?)?;
    module.add_function(wrap_pyfunction!(command::run_command, module)?)?;
    module.add_function(wrap_pyfunction!(scenario_class::templates, module)?)
}
