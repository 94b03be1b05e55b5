//! JSON as text.

use serde_json::Value;

/// A value as indented text with a newline at its end.
pub(super) fn pretty(value: &Value) -> String {
    format!("{value:#}\n")
}

/// Rows of a JSON report: what they are made of, what is prepared, then every key once, with its type and its value.
macro_rules! rows {
    ($($(#[$about:meta])* $vis:vis struct $row:ident = |$($given:ident: $of:ty),*| { $($first:tt)* } {
        $($(#[$key_about:meta])* $key:ident: $type:ty = $value:expr,)*
    })*) => {$(
        $(#[$about])*
        #[derive(Debug, Serialize)]
        $vis struct $row { $($(#[$key_about])* $key: $type,)* }

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
