#![doc = include_str!("../README.md")]
//! - [`FormulaTree`]: a formula as written, with the position of every subexpression.
//! - [`FormulaGraph`]: many formulas in one graph, which contains each common subexpression only once. The graph also
//!   forms derivatives.
//! - [`Program`]: the part of a graph on which the requested nodes depend, evaluated for many inputs.
//! - [`Rounded`]: a number with a bound on its error.
//! - [`DerivationSheet`]: a derivation stored as a list of subexpressions, to search for its errors.
//! - [`Products`]: products of powers of known quantities, to recognise a number by its value.

mod derivative;
mod domain;
mod graph;
mod parse;
mod products;
mod program;
mod rounded;
mod sentences;
mod sheet;
#[cfg(test)]
mod tests;
mod tree;

pub use graph::{FormulaGraph, NodeId};
pub use products::{Product, Products, information};
pub use program::Program;
pub use rounded::Rounded;
pub use sheet::{DerivationSheet, FormulaTarget};
pub use tree::{FormulaFault, FormulaTree, Function, NodeShape, Operator};
