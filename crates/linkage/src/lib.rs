#![doc = include_str!("../README.md")]
//! Links, joints and Assur groups are in [`mechanism`], drives and loads in [`drive`], the quantities of an input in
//! [`input`].
//! [`case`] defines the problem that every solver receives, [`trajectory`] the result that every solver returns.
//! [`solver`] and [`engine`] define the traits of solvers and engines.
//! [`work`] counts the work of solvers and engines, [`threads`] runs work in parallel.

pub mod case;
pub mod drive;
pub mod engine;
pub mod error;
#[cfg(test)]
mod fixtures;
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

/// Declares the messages that a crate can show.
/// `NAME = "text";` declares a constant.
/// `name(a, b) = "text with {a} and {b}";` declares a function from values to a `String`.
/// Each crate has all its messages in one file, so that they can be read as a list.
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

/// Declares an enum whose variants have words in files and reports: `enum Name: method { Variant = "word", }`.
/// `ALL` lists the variants in the order of declaration. `method` returns a variant's word.
/// `named` returns the variant with a given word.
#[macro_export]
macro_rules! words {
    ($(#[$about:meta])* $vis:vis enum $name:ident: $method:ident { $($(#[$meaning:meta])* $variant:ident = $word:expr,)* }) => {
        $(#[$about])*
        $vis enum $name {
            $($(#[$meaning])* $variant,)*
        }

        #[allow(dead_code, reason = "not every enum is listed, or read from a word")]
        impl $name {
            /// All variants, in the order of declaration.
            pub const ALL: [$name; [$($word),*].len()] = [$($name::$variant),*];

            /// Word of the variant in files and reports.
            #[must_use]
            pub const fn $method(self) -> &'static str {
                match self {
                    $($name::$variant => $word,)*
                }
            }

            /// The variant with this word.
            #[must_use]
            pub fn named(word: &str) -> Option<$name> {
                $name::ALL.into_iter().find(|own| own.$method() == word)
            }
        }
    };
}
