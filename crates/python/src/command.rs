//! The command line, run within Python.

use std::ffi::OsString;

use pyo3::prelude::*;

/// Run the command with its arguments, the name of the program first, and return its exit code.
#[pyfunction]
#[pyo3(signature = (arguments, /))]
pub(crate) fn run_command(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    py.detach(|| linkproof::cli::run(arguments))
}
