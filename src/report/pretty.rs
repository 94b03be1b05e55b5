//! JSON as text.

use serde_json::Value;

/// A value as indented text with a newline at its end.
pub(super) fn pretty(value: &Value) -> String {
    format!("{value:#}\n")
}

/// The list of what each of some things becomes.
pub(super) fn list<T>(all: impl IntoIterator<Item = T>, one: impl FnMut(T) -> Value) -> Value {
    all.into_iter().map(one).collect()
}

/// Rows of a JSON report: what they are made of, what is prepared, then every key once, with its type and its value. A key
/// with a predicate, as in `key["Option::is_none"]: ..`, is left out where that holds.
macro_rules! rows {
    ($($(#[$about:meta])* $vis:vis struct $row:ident = |$($given:ident: $of:ty),*| { $($first:tt)* } {
        $($(#[$key_about:meta])* $key:ident $([$absent:literal])?: $type:ty = $value:expr,)*
    })*) => {$(
        $(#[$about])*
        #[derive(Debug, Serialize)]
        $vis struct $row { $($(#[$key_about])* $(#[serde(skip_serializing_if = $absent)])? $key: $type,)* }

        impl $row {
            /// The row of what it is made of.
            #[must_use]
            $vis fn of($($given: $of),*) -> $row {
                $($first)*
                $row { $($key: $value,)* }
            }
        }
    )*};
}
pub(in crate::report) use rows;
