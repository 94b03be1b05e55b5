//! Enums whose variants have words, in one table: what is not in it is no variant, so that no list can lack one.

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
