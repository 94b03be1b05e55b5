//! The only error type. An error says what was requested and what was found, where the fault is, and how to mend it.
//! The parts of an error are stored as data and become text only in the output.

mod advice;
mod several;

use crate::sentences;
pub use advice::{Advice, rounded_up};

use std::fmt;
use std::ops::Range;
use std::path::PathBuf;
use std::sync::Arc;

use crate::input::InputValue;

/// Result of every fallible operation of this crate.
pub type Result<T> = std::result::Result<T, Error>;

/// Kind of error. The kind determines the exit code.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ErrorKind {
    /// The scenario or an argument is wrong.
    #[default]
    Input,
    /// The mechanism cannot reach the requested pose.
    Geometry,
    /// A solver could not finish: a dead point, no convergence, a NaN or infinite number.
    Numeric,
    /// The input is well-formed, but this version does not support it.
    Unsupported,
    /// A file could not be read or written.
    Io,
}

/// Location in a text file that an error refers to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// Path of the file as the user gave it.
    pub file: PathBuf,
    /// Whole text of the file, from which the faulty line is displayed.
    pub text: Arc<str>,
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

/// Part of a mechanism that an error refers to, by name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ErrorSubject {
    /// A link.
    Link(String),
    /// A joint.
    Joint(String),
    /// An Assur group: the names of its links.
    Group(String),
}

/// Key in a scenario, to which an error refers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct KeyPath {
    text: String,
    /// Length of the dotted path at the start of `text`.
    path: usize,
    links: Vec<String>,
}

impl KeyPath {
    /// Key of an Assur group. `path` is the dotted path of the list of groups; the links identify the group.
    #[must_use]
    pub fn of_group(path: &str, links: Vec<String>) -> Self {
        KeyPath { text: format!("{path} ({})", links.join(", ")), path: path.len(), links }
    }

    /// Dotted path of the key from the top of the scenario: `joints.A`.
    #[must_use]
    pub fn path(&self) -> &str {
        &self.text[..self.path]
    }

    /// The links of an Assur group; empty for any other key.
    #[must_use]
    pub fn links(&self) -> &[String] {
        &self.links
    }
}

impl<T: Into<String>> From<T> for KeyPath {
    fn from(path: T) -> Self {
        let text: String = path.into();
        KeyPath { path: text.len(), text, links: Vec::new() }
    }
}

/// A number that exceeds its bound.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Excess {
    /// The number; may be NaN.
    pub value: f64,
    /// The bound.
    pub bound: f64,
    /// Unit of the number and its bound; empty for a ratio.
    pub unit: &'static str,
}

/// How far a run got before it failed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RunReached {
    /// The run reached this time (s).
    Time(f64),
    /// The run reached this value of the input.
    Input(InputValue),
}

impl fmt::Display for RunReached {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            RunReached::Time(t) => write!(f, "{}", sentences::the_run_stands_up_to_2(&t)),
            RunReached::Input(at) => write!(f, "{}", sentences::the_run_stands_up_to(&at)),
        }
    }
}

/// An error: message, known data, location in the file (if any) and remedy.
#[derive(Clone, Debug)]
#[must_use]
pub struct Error(Box<Inner>);

#[derive(Clone, Debug, Default)]
struct Inner {
    kind: ErrorKind,
    message: String,
    key: Option<KeyPath>,
    place: Option<Place>,
    time: Option<f64>,
    input: Option<InputValue>,
    part: Option<ErrorSubject>,
    residual: Option<Excess>,
    reached: Option<RunReached>,
    out_of_reach: bool,
    advice: Vec<Advice>,
    further: Vec<Error>,
    left_out: usize,
}

impl Error {
    /// New error of this kind. `message` says what was requested and what was found.
    pub fn new(kind: ErrorKind, message: impl Into<String>) -> Self {
        Error(Box::new(Inner { kind, message: message.into(), ..Inner::default() }))
    }

    /// Sets the remedy. An earlier remedy is replaced.
    pub fn help(mut self, advice: impl Into<Advice>) -> Self {
        self.0.advice = vec![advice.into()];
        self
    }

    /// Adds an alternative remedy.
    pub fn or_help(mut self, advice: impl Into<Advice>) -> Self {
        self.0.advice.push(advice.into());
        self
    }

    /// Replaces every remedy by the result of `change`.
    pub fn map_advice(mut self, change: impl FnMut(Advice) -> Advice) -> Self {
        self.0.advice = std::mem::take(&mut self.0.advice).into_iter().map(change).collect();
        self
    }

    /// Rewords the error: `change` converts the old message into the new message. All other parts of the error are
    /// kept.
    pub fn map_message(mut self, change: impl FnOnce(&str) -> String) -> Self {
        self.0.message = change(&self.0.message);
        self
    }

    /// Sets the time (s) of the error.
    pub fn at_time(mut self, time: f64) -> Self {
        self.0.time = Some(time);
        self
    }

    /// Sets the value of the input at which the error occurs.
    pub fn at_input(mut self, at: InputValue) -> Self {
        self.0.input = Some(at);
        self
    }

    /// Sets the link that the error is about.
    pub fn of_link(mut self, name: impl Into<String>) -> Self {
        self.0.part = Some(ErrorSubject::Link(name.into()));
        self
    }

    /// Sets the joint that the error is about.
    pub fn of_joint(mut self, name: impl Into<String>) -> Self {
        self.0.part = Some(ErrorSubject::Joint(name.into()));
        self
    }

    /// Sets the Assur group that the error is about, by the names of its links.
    pub fn of_group(mut self, names: impl Into<String>) -> Self {
        self.0.part = Some(ErrorSubject::Group(names.into()));
        self
    }

    /// Sets the number and the bound that it exceeds, both in `unit` (empty for a ratio).
    pub fn beyond(mut self, value: f64, bound: f64, unit: &'static str) -> Self {
        self.0.residual = Some(Excess { value, bound, unit });
        self
    }

    /// Sets how far the run got before it failed.
    pub fn after(mut self, reached: RunReached) -> Self {
        self.0.reached = Some(reached);
        self
    }

    /// Marks the error as out of reach: the mechanism cannot reach a pose on the branch of the case.
    /// A caller with access to the solvers can then add the reachable crank angles.
    pub fn out_of_reach(mut self) -> Self {
        self.0.out_of_reach = true;
        self
    }

    /// Removes the out-of-reach mark. Callers use this method after they have explained the error.
    pub fn explained(mut self) -> Self {
        self.0.out_of_reach = false;
        self
    }

    /// Names the scenario key (dotted path) at fault.
    /// A key that is already set stays: the function closest to the fault sets its key first and knows the fault best.
    pub fn key(mut self, key: impl Into<KeyPath>) -> Self {
        self.0.key.get_or_insert_with(|| key.into());
        self
    }

    /// Adds the location in the file. A location that is already set is kept.
    pub fn at(mut self, place: Place) -> Self {
        self.0.place.get_or_insert(place);
        self
    }

    /// Kind of the error.
    #[must_use]
    pub fn kind(&self) -> ErrorKind {
        self.0.kind
    }

    /// What was requested and what was found, without key, location and remedy.
    #[must_use]
    pub fn message(&self) -> &str {
        &self.0.message
    }

    /// Text of the scenario key at fault, if known. The text is the dotted path of the key.
    /// For an Assur group, the group's links follow the path.
    #[must_use]
    pub fn scenario_key(&self) -> Option<&str> {
        self.0.key.as_ref().map(|key| key.text.as_str())
    }

    /// The scenario key at fault, if known.
    #[must_use]
    pub fn key_at_fault(&self) -> Option<&KeyPath> {
        self.0.key.as_ref()
    }

    /// Location in the file, if known.
    #[must_use]
    pub fn place(&self) -> Option<&Place> {
        self.0.place.as_ref()
    }

    /// Time (s), if known.
    #[must_use]
    pub fn time(&self) -> Option<f64> {
        self.0.time
    }

    /// Value of the input at which the error occurs, if known.
    #[must_use]
    pub fn input(&self) -> Option<InputValue> {
        self.0.input
    }

    /// Link, joint or group at fault, if known.
    #[must_use]
    pub fn part(&self) -> Option<&ErrorSubject> {
        self.0.part.as_ref()
    }

    /// The number that exceeds its bound, if there is one.
    #[must_use]
    pub fn residual(&self) -> Option<Excess> {
        self.0.residual
    }

    /// How far the run got. `None` if no run had begun.
    #[must_use]
    pub fn reached(&self) -> Option<RunReached> {
        self.0.reached
    }

    /// Whether the error is marked as out of reach.
    /// [`Error::out_of_reach`] sets the mark, and [`Error::explained`] removes the mark.
    #[must_use]
    pub fn is_out_of_reach(&self) -> bool {
        self.0.out_of_reach
    }

    /// The alternative remedies; empty if no remedy is known.
    #[must_use]
    pub fn advice(&self) -> &[Advice] {
        &self.0.advice
    }

    /// The remedy and the progress of the failed run, in words; `None` if both are unknown.
    /// The text does not mention command-line options.
    #[must_use]
    pub fn way_out(&self) -> Option<String> {
        self.way_out_by(Advice::to_string)
    }

    /// Like [`Error::way_out`], but `tell` puts each piece of advice into words.
    #[must_use]
    pub fn way_out_by(&self, tell: impl Fn(&Advice) -> String) -> Option<String> {
        let parts = [Advice::sentence(&self.0.advice, tell), self.0.reached.map(|reached| reached.to_string())];
        let parts: Vec<String> = parts.into_iter().flatten().collect();
        (!parts.is_empty()).then(|| parts.join("; "))
    }

    /// The whole error in one line, without the errors found together with it.
    /// `tell` puts each piece of advice into words.
    #[must_use]
    pub fn line_by(&self, tell: impl Fn(&Advice) -> String) -> String {
        let place = self.0.place.as_ref().map(|place| format!("{}:{}: ", place.file.display(), place.line()));
        let key = self.scenario_key().map(|key| format!("`{key}`: "));
        let way_out = self.way_out_by(tell).map(|way_out| format!("; {way_out}"));
        let [place, key, way_out] = [place, key, way_out].map(Option::unwrap_or_default);
        format!("{place}{key}{}{way_out}", self.0.message)
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.lines_by(Advice::to_string))
    }
}

impl std::error::Error for Error {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::Input;

    #[test]
    fn an_error_is_as_small_as_a_pointer() {
        assert_eq!(size_of::<Error>(), size_of::<usize>());
        assert_eq!(size_of::<Result<()>>(), size_of::<usize>());
    }

    #[test]
    fn an_error_carries_its_data_and_a_remedy() {
        let error = Error::new(ErrorKind::Numeric, "the loop has opened")
            .at_time(0.25)
            .at_input(Input::Angle.at(1.5))
            .of_joint("B")
            .beyond(0.2, 0.1, "m")
            .after(RunReached::Time(0.125))
            .help(Advice::SmallerStep { to: None })
            .or_help("check the pose");
        assert_eq!((error.time(), error.input()), (Some(0.25), Some(Input::Angle.at(1.5))));
        assert_eq!(error.part(), Some(&ErrorSubject::Joint("B".into())));
        assert_eq!(error.residual(), Some(Excess { value: 0.2, bound: 0.1, unit: "m" }));
        assert_eq!(error.advice(), [Advice::SmallerStep { to: None }, "check the pose".into()]);
        let way_out = "choose a smaller time step, or check the pose; the results are valid up to t = 0.125000 s";
        assert_eq!(error.way_out().unwrap(), way_out);
        assert_eq!(error.to_string(), format!("the loop has opened; {way_out}"));
        let other = error.map_message(|old| format!("{old} again")).help("go on");
        assert_eq!((other.message(), other.advice()), ("the loop has opened again", &["go on".into()][..]));
        assert_eq!(other.time(), Some(0.25));
    }

    #[test]
    fn a_key_is_printed_and_carried_as_data() {
        let links = vec!["coupler".to_string(), "rocker".to_string()];
        let error =
            Error::new(ErrorKind::Geometry, "open").key(KeyPath::of_group("start.groups", links.clone())).key("drive");
        assert_eq!(error.to_string(), "`start.groups (coupler, rocker)`: open");
        let key = error.key_at_fault().unwrap();
        assert_eq!((key.path(), key.links()), ("start.groups", &links[..]));
        let plain = KeyPath::from("joints.A");
        assert_eq!((plain.path(), plain.links().len()), ("joints.A", 0));
    }

    #[test]
    fn explaining_an_error_clears_its_out_of_reach_mark() {
        let error = Error::new(ErrorKind::Geometry, "too far").out_of_reach();
        assert!(error.is_out_of_reach() && !error.clone().explained().is_out_of_reach());
        assert!(!Error::new(ErrorKind::Geometry, "too far").is_out_of_reach());
    }
}
