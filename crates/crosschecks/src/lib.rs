//! Checks against other libraries: a JSON Schema validator, a YAML reader, another differentiator of formulas, the SDK
//! of a viewer.
//! The checks are in a separate crate, because the features of these libraries would make cargo compile the engine a
//! second time.
