#![doc = include_str!("../README.md")]
//!
//! - [`FormulaTree`]: what somebody wrote, with the place of every part.
//! - [`FormulaGraph`]: many formulas at once; what two of them share stands in it once. Derivatives are taken here.
//! - [`Program`]: the part of a graph that some of its nodes need, to be run for many inputs.
//! - [`Rounded`]: a number, and how far it may be from the exact one.
//! - [`DerivationSheet`]: a derivation part by part, for the search of what is wrong in it; [`Products`]: numbers as products.

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
