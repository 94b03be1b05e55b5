//! Errors of the library as exceptions of Python.

use std::fmt::Display;

use linkproof::parts::{Advice, Error, ErrorKind};
use linkproof::plain::errors::text;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::sentences;

/// The module of Python in which the exceptions are defined.
const MODULE: &str = "linkproof.errors";

/// Name of the exception for a kind of error.
const fn class(kind: ErrorKind) -> &'static str {
    match kind {
        ErrorKind::Input => "InputError",
        ErrorKind::Geometry => "GeometryError",
        ErrorKind::Numeric => "NumericError",
        ErrorKind::Unsupported => "UnsupportedError",
        ErrorKind::Io => "ReadError",
    }
}

/// The exception for an error. The attribute `found` contains the exceptions for all errors that were found together.
pub(crate) fn raised(py: Python<'_>, error: &Error) -> PyErr {
    exception(py, error).map_or_else(|fault| fault, PyErr::from_value)
}

fn exception<'py>(py: Python<'py>, error: &Error) -> PyResult<Bound<'py, PyAny>> {
    let whole = text(error, Advice::to_string);
    let whole = whole.strip_prefix("error: ").unwrap_or(&whole);
    let found = error.each().map(|own| one(py, own, own.message())).collect::<PyResult<Vec<_>>>()?;
    let first = one(py, error, whole)?;
    first.setattr("found", found)?;
    Ok(first)
}

/// The exception for one error alone.
fn one<'py>(py: Python<'py>, error: &Error, told: &str) -> PyResult<Bound<'py, PyAny>> {
    let parts = PyDict::new(py);
    parts.set_item("message", error.message())?;
    parts.set_item("file", error.place().map(|place| place.file.display().to_string()))?;
    parts.set_item("line", error.place().map(linkage::error::Place::line))?;
    parts.set_item("key", error.scenario_key())?;
    parts.set_item("help", error.way_out())?;
    parts.set_item("time_s", error.time())?;
    py.import(MODULE)?.getattr(class(error.kind()))?.call((told,), Some(&parts))
}

/// An error of an argument.
pub(crate) fn argument(key: &str, message: impl Into<String>, help: impl Into<String>) -> Error {
    Error::new(ErrorKind::Input, message).key(key).help(help.into())
}

/// The number of an argument; an error if it is NaN or outside of `range`.
pub(crate) fn within<T>(key: &str, value: &Bound<'_, PyAny>, [least, most]: [T; 2]) -> PyResult<T>
where
    T: for<'a, 'py> FromPyObject<'a, 'py, Error = PyErr> + PartialOrd + Display,
{
    let number: T = value.extract()?;
    match least <= number && number <= most {
        true => Ok(number),
        false => Err(refused(key, value, &number, sentences::give_a_number_from(&least, &most))),
    }
}

/// The number of an argument; an error if it is not positive and finite.
pub(crate) fn positive(key: &str, value: &Bound<'_, PyAny>) -> PyResult<f64> {
    let number: f64 = value.extract()?;
    match number.is_finite() && number > 0.0 {
        true => Ok(number),
        false => Err(refused(key, value, &number, sentences::GIVE_A_POSITIVE_NUMBER.into())),
    }
}

fn refused(key: &str, value: &Bound<'_, PyAny>, number: &dyn Display, help: String) -> PyErr {
    raised(value.py(), &argument(key, sentences::found_the_number(number), help))
}

/// Results of the library as results of Python.
pub(crate) trait OrRaised<T> {
    /// The value, or the exception.
    fn or_raised(self, py: Python<'_>) -> PyResult<T>;
}

impl<T> OrRaised<T> for Result<T, Error> {
    fn or_raised(self, py: Python<'_>) -> PyResult<T> {
        self.map_err(|error| raised(py, &error))
    }
}
