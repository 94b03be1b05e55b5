//! A setting: either free, or given together with its origin.

use linkage::error::{Error, Place};

/// Origin of a setting.
#[derive(Clone, Debug, PartialEq)]
pub enum SettingOrigin {
    /// In a scenario file: the dotted key, and its position.
    Key(String, Place),
    /// On the command line, by this argument.
    Argument(&'static str),
    /// In code.
    Code,
}

/// A setting.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum EngineSetting<T> {
    /// Free: the proof or the engine chooses the value.
    #[default]
    Free,
    /// Given, with its origin.
    Given(T, SettingOrigin),
}

impl<T> EngineSetting<T> {
    /// Given in code.
    pub fn of(value: T) -> Self {
        EngineSetting::Given(value, SettingOrigin::Code)
    }

    /// This setting, or `other` if this setting is free.
    pub fn or<'a>(&'a self, other: &'a EngineSetting<T>) -> &'a EngineSetting<T> {
        if self.is_free() { other } else { self }
    }

    /// The value, if the setting is given.
    pub fn value(&self) -> Option<&T> {
        if let EngineSetting::Given(value, _) = self { Some(value) } else { None }
    }

    /// Whether the setting is not given.
    pub fn is_free(&self) -> bool {
        self.value().is_none()
    }

    /// The error, with the position where the setting was given.
    pub fn blamed(&self, error: Error) -> Error {
        match self {
            EngineSetting::Given(_, SettingOrigin::Key(key, place)) => error.key(key.as_str()).at(place.clone()),
            EngineSetting::Given(_, SettingOrigin::Argument(name)) => error.key(format!("--{name}")),
            EngineSetting::Given(_, SettingOrigin::Code) | EngineSetting::Free => error,
        }
    }
}

impl<T> From<Option<T>> for EngineSetting<T> {
    fn from(value: Option<T>) -> Self {
        value.map_or(EngineSetting::Free, EngineSetting::of)
    }
}

impl<T: Copy> EngineSetting<T> {
    /// The value, if the setting is given.
    pub fn get(&self) -> Option<T> {
        self.value().copied()
    }
}
