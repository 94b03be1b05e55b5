//! Spanning tree of a linkage, which is structure: see [`crate::mechanism::spanning_tree`].

pub(super) use crate::mechanism::spanning_tree::coordinate;
pub use crate::mechanism::spanning_tree::{Branch, Tree};
