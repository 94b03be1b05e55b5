//! Checks against other libraries: a JSON Schema validator, a YAML reader, another differentiator of formulas, the SDK
//! of a viewer.
//! They are a separate crate because their features would make cargo compile the engine a second time.
