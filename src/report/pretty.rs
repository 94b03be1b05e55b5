//! JSON as text.

use serde_json::Value;

/// A value as indented text with a newline at its end.
pub(super) fn pretty(value: &Value) -> String {
    format!("{value:#}\n")
}

/// A JSON list: `one` converts each item to a value.
pub(super) fn list<T>(all: impl IntoIterator<Item = T>, one: impl FnMut(T) -> Value) -> Value {
    all.into_iter().map(one).collect()
}

/// Defines rows of a JSON report.
/// A row states the arguments from which it is made. Then come preparing statements, and then each key once, with type
/// and value.
/// A key with a predicate, as in `key["Option::is_none"]: ..`, is omitted if the predicate is true.
macro_rules! rows {
    ($($(#[$about:meta])* $vis:vis struct $row:ident = |$($given:ident: $of:ty),*| { $($first:tt)* } {
        $($(#[$key_about:meta])* $key:ident $([$absent:literal])?: $type:ty = $value:expr,)*
    })*) => {$(
        $(#[$about])*
        #[derive(Debug, Serialize)]
        $vis struct $row { $($(#[$key_about])* $(#[serde(skip_serializing_if = $absent)])? $key: $type,)* }

        impl $row {
            /// Makes the row from its sources.
            #[must_use]
            $vis fn of($($given: $of),*) -> $row {
                $($first)*
                $row { $($key: $value,)* }
            }
        }
    )*};
}
pub(in crate::report) use rows;
