//! The one error type: what was asked, what was found, where, and the way out.

use std::fmt;
use std::ops::Range;
use std::path::PathBuf;

/// Result of every fallible operation of this crate.
pub type Result<T> = std::result::Result<T, Error>;

/// What sort of thing went wrong; decides the exit code and nothing else.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ErrorKind {
    /// The scenario or an argument is wrong.
    Input,
    /// The mechanism cannot take the pose that was asked for.
    Geometry,
    /// A solver could not finish: a dead point, no convergence, a number that is not finite.
    Numeric,
    /// Well-formed, but not handled by this version.
    Unsupported,
    /// A file could not be read or written.
    Io,
}

/// Place in a text file that an error points at.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// Path of the file as the user gave it.
    pub file: PathBuf,
    /// Whole text of the file, for showing the line.
    pub text: String,
    /// Byte range in `text`.
    pub span: Range<usize>,
}

impl Place {
    /// Line number of the start of the span, counted from 1.
    #[must_use]
    pub fn line(&self) -> usize {
        let end = self.span.start.min(self.text.len());
        self.text.as_bytes()[..end].iter().filter(|&&byte| byte == b'\n').count() + 1
    }
}

/// An error with its message, its place where there is one, and the way out.
#[derive(Clone, Debug)]
pub struct Error(Box<Inner>);

#[derive(Clone, Debug)]
struct Inner {
    kind: ErrorKind,
    message: String,
    key: Option<String>,
    place: Option<Place>,
    help: Option<String>,
}

impl Error {
    /// New error of a kind; `message` says what was asked and what was found.
    #[must_use]
    pub fn new(kind: ErrorKind, message: impl Into<String>) -> Self {
        Error(Box::new(Inner { kind, message: message.into(), key: None, place: None, help: None }))
    }

    /// Adds the way out.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.0.help = Some(help.into());
        self
    }

    /// Names the scenario key (dotted path) at fault. A key already named is kept: the innermost knows best.
    #[must_use]
    pub fn key(mut self, key: impl Into<String>) -> Self {
        self.0.key.get_or_insert_with(|| key.into());
        self
    }

    /// Adds the place in the file. A place already known is kept.
    #[must_use]
    pub fn at(mut self, place: Place) -> Self {
        self.0.place.get_or_insert(place);
        self
    }

    /// Sort of the error.
    #[must_use]
    pub fn kind(&self) -> ErrorKind {
        self.0.kind
    }

    /// What was asked and what was found, without key, place and help.
    #[must_use]
    pub fn message(&self) -> &str {
        &self.0.message
    }

    /// Dotted path of the scenario key at fault, where one is.
    #[must_use]
    pub fn scenario_key(&self) -> Option<&str> {
        self.0.key.as_deref()
    }

    /// Place in the file, where one is known.
    #[must_use]
    pub fn place(&self) -> Option<&Place> {
        self.0.place.as_ref()
    }

    /// The way out, where one is known.
    #[must_use]
    pub fn way_out(&self) -> Option<&str> {
        self.0.help.as_deref()
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(place) = &self.0.place {
            write!(f, "{}:{}: ", place.file.display(), place.line())?;
        }
        if let Some(key) = &self.0.key {
            write!(f, "`{key}`: ")?;
        }
        write!(f, "{}", self.0.message)?;
        if let Some(help) = &self.0.help {
            write!(f, "; {help}")?;
        }
        Ok(())
    }
}

impl std::error::Error for Error {}
