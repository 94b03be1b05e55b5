//! The command line, run within Python.

use std::ffi::OsString;

use pyo3::prelude::*;

/// Run the command line and return its exit code. The first of `arguments` is the name of the program.
#[pyfunction]
#[pyo3(signature = (arguments, /))]
pub(crate) fn run_command(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    py.detach(|| linkproof::cli::run(arguments))
}
