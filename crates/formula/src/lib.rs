//! Formulas as they are written down: read, differentiated, and evaluated with a bound on their own rounding.
//!
//! - [`Tree`]: what somebody wrote, with the place of every part.
//! - [`Graph`]: many formulas at once; what two of them share stands in it once. Derivatives are taken here.
//! - [`Program`]: the part of a graph that some of its nodes need, to be run for many inputs.
//! - [`Rounded`]: a number, and how far it may be from the exact one.
//! - [`Sheet`]: a derivation part by part, for the search of what is wrong in it; [`Products`]: numbers as products.
//!
//! ```
//! use linkproof_formula::{Graph, Program, Rounded, Tree};
//!
//! let mut graph = Graph::new(&["phi", "r"], 0);
//! let place = graph.add(&Tree::parse("r*cos(phi)")?)?;
//! let speed = graph.derivative(place, 0);
//! let mut program = Program::of(&graph, &[place, speed]);
//! let values = program.run(&[Rounded::exact(0.0), Rounded::exact(2.0)]);
//! assert_eq!([values[0].value, values[1].value], [2.0, 0.0]);
//! # Ok::<(), linkproof_formula::Fault>(())
//! ```

mod derivative;
mod domain;
mod graph;
mod parse;
mod products;
mod program;
mod rounded;
mod sheet;
#[cfg(test)]
mod tests;
mod tree;

pub use graph::{Graph, Id};
pub use products::{Product, Products, information};
pub use program::Program;
pub use rounded::Rounded;
pub use sheet::{Sheet, Target};
pub use tree::{Fault, Function, Operator, Shape, Tree};
