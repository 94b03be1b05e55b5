//! JSON as text.

use serde_json::Value;

/// A value as indented text with a newline at its end.
pub(super) fn pretty(value: &Value) -> String {
    format!("{value:#}\n")
}
