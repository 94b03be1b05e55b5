#![doc = include_str!("../README.md")]
//!
//! Links, joints and Assur groups are in [`mechanism`], drives and loads in [`drive`], what an input measures in [`input`].
//! [`case`] has the problem as every solver receives it, [`trajectory`] the result that every solver returns.
//! [`solver`] and [`engine`] have the traits of solvers and engines, [`work`] counts what they do, [`threads`] does it side by side.

pub mod case;
pub mod drive;
pub mod engine;
pub mod error;
#[cfg(any(test, feature = "fixtures"))]
#[doc(hidden)]
pub mod fixtures;
pub mod input;
pub mod math;
pub mod mechanism;
pub mod quiet;
mod sentences;
pub mod solver;
pub mod threads;
pub mod trajectory;
pub mod work;

pub use error::{Error, ErrorKind, Result};

/// Declares the sentences that a crate can show: `NAME = "text";` makes a constant, `name(a, b) = "text with {a} and {b}";`
/// a function from values to a `String`. Each crate has them in one file, to be read as a list.
#[macro_export]
macro_rules! sentences {
    (@one $name:ident = $text:literal) => { pub(crate) const $name: &str = $text; };
    (@one $name:ident($($value:ident),+) = $text:literal) => {
        #[allow(clippy::too_many_arguments, reason = "a sentence has as many values as it needs")]
        pub(crate) fn $name($($value: &dyn std::fmt::Display),+) -> String { format!($text) }
    };
    ($($name:ident $(($($value:ident),+))? = $text:literal;)*) => {
        $($crate::sentences! { @one $name $(($($value),+))? = $text })*
    };
}

/// Declares an enum whose variants stand for words in files and reports: `enum Name: method { Variant = "word", }`. It has
/// the list `ALL` in this order, the word by `method`, and the variant that a word stands for by `named`.
#[macro_export]
macro_rules! words {
    ($(#[$about:meta])* $vis:vis enum $name:ident: $method:ident { $($(#[$meaning:meta])* $variant:ident = $word:literal,)* }) => {
        $(#[$about])*
        $vis enum $name {
            $($(#[$meaning])* $variant,)*
        }

        #[allow(dead_code, reason = "not every enum is listed, or read from a word")]
        impl $name {
            /// All of them, in their order.
            pub const ALL: [$name; [$($word),*].len()] = [$($name::$variant),*];

            /// The word that it has in files and reports.
            #[must_use]
            pub const fn $method(self) -> &'static str {
                match self {
                    $($name::$variant => $word,)*
                }
            }

            /// The one that a word stands for.
            #[must_use]
            pub fn named(word: &str) -> Option<$name> {
                $name::ALL.into_iter().find(|own| own.$method() == word)
            }
        }
    };
}
