//! A setting: given, and where, or free.

use linkage::error::{Error, Place};

/// Where a setting was given.
#[derive(Clone, Debug, PartialEq)]
pub enum Origin {
    /// In a scenario file: the dotted key, and its place.
    Key(String, Place),
    /// As this argument of a command.
    Argument(&'static str),
    /// In code.
    Code,
}

/// A setting.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Setting<T> {
    /// Found by the proof, or the engine's own.
    #[default]
    Free,
    /// Given, and where.
    Given(T, Origin),
}

impl<T> Setting<T> {
    /// Given in code.
    pub fn of(value: T) -> Self {
        Setting::Given(value, Origin::Code)
    }

    /// This setting, or the other one if this is free.
    pub fn or<'a>(&'a self, other: &'a Setting<T>) -> &'a Setting<T> {
        if self.is_free() { other } else { self }
    }

    /// The value, if it is given.
    pub fn value(&self) -> Option<&T> {
        if let Setting::Given(value, _) = self { Some(value) } else { None }
    }

    /// Whether it is not given.
    pub fn is_free(&self) -> bool {
        self.value().is_none()
    }

    /// The error with the place where the setting was given.
    pub fn blamed(&self, error: Error) -> Error {
        match self {
            Setting::Given(_, Origin::Key(key, place)) => error.key(key.as_str()).at(place.clone()),
            Setting::Given(_, Origin::Argument(name)) => error.key(format!("--{name}")),
            Setting::Given(_, Origin::Code) | Setting::Free => error,
        }
    }
}

impl<T> From<Option<T>> for Setting<T> {
    fn from(value: Option<T>) -> Self {
        value.map_or(Setting::Free, Setting::of)
    }
}

impl<T: Copy> Setting<T> {
    /// The value, if it is given.
    pub fn get(&self) -> Option<T> {
        self.value().copied()
    }
}
