//! A peer is a command that receives a scenario and answers with a solution.
//! The document `docs/peers.md` describes the protocol.

use crate::sentences;
use std::cell::RefCell;
use std::fs;
use std::path::Path;

use serde_json::{Value, json};
use tempfile::TempDir;

use super::{answer, process};
use crate::bench::{Answer, Clock, Peer, Way};
use files::visible;

/// Version of the protocol.
const PROTOCOL: u32 = 1;

/// A scenario in the form given to other programs.
#[derive(Clone, Debug)]
pub struct Exports {
    /// Name.
    pub name: String,
    /// The case as JSON.
    pub case: String,
    /// The case as MJCF, or the reason why it cannot be written as MJCF.
    pub mjcf: Result<String, String>,
    /// Whether a rough measurement is enough.
    pub is_quick: bool,
}

/// A command that speaks the protocol.
pub struct Command<'a> {
    name: String,
    command: String,
    exports: &'a Exports,
    /// Longest duration of a call (s).
    limit: f64,
    clock: Clock<'a>,
    /// The peer's directory.
    /// The first call creates the directory. Dropping the peer removes the directory.
    place: RefCell<Option<TempDir>>,
}

impl<'a> Command<'a> {
    /// The peer `name`, called as `command`. One call may take at most `limit` (s).
    pub fn new(name: &str, command: &str, exports: &'a Exports, limit: f64, clock: Clock<'a>) -> Self {
        let (name, command) = (name.to_string(), command.to_string());
        Command { name, command, exports, limit, clock, place: RefCell::new(None) }
    }

    /// Calls the command with a request.
    /// Passes the command's output and the directory to `read`.
    fn call<T>(
        &self,
        what: &str,
        way: Option<&Way>,
        read: impl FnOnce(&str, &Path) -> Result<T, String>,
    ) -> Result<T, String> {
        let mut place = self.place.borrow_mut();
        if place.is_none() {
            *place = Some(self.furnished().map_err(|error| sentences::no_temporary_directory(&error))?);
        }
        let directory = place.as_ref().expect("it was made").path();
        let table = directory.join("answer.csv");
        let request = directory.join("request.json");
        // Removes the files of an earlier run.
        // Without this removal, an old table could be taken as the answer, or an old symbolic link could be followed.
        for old in [&table, &request] {
            let _ = fs::remove_file(old);
        }
        let way = way.map_or(Value::Null, |way| serde_json::from_str(&way.told).unwrap_or(Value::Null));
        let mjcf = self.exports.mjcf.as_ref();
        let value = json!({
            "protocol": PROTOCOL, "do": what, "scenario": self.exports.name, "quick": self.exports.is_quick,
            "case": directory.join("case.json"), "csv": table, "way": way,
            "mjcf": mjcf.ok().map(|_| directory.join("model.xml")), "mjcf_refused": mjcf.err(),
        });
        fs::write(&request, value.to_string()).map_err(|error| sentences::the_request_cannot_be_written(&error))?;
        let request = request.to_string_lossy();
        let output = process::run(&self.command, &[what, &request], directory, self.limit, self.clock);
        // Users see the message of a failed peer, so control characters are removed from the message.
        output.and_then(|output| read(&output, directory)).map_err(|reason| visible(&reason))
    }

    fn furnished(&self) -> std::io::Result<TempDir> {
        let place = TempDir::with_prefix("linkproof-peer-")?;
        fs::write(place.path().join("case.json"), &self.exports.case)?;
        if let Ok(model) = &self.exports.mjcf {
            fs::write(place.path().join("model.xml"), model)?;
        }
        Ok(place)
    }
}

impl Peer for Command<'_> {
    fn name(&self) -> &str {
        &self.name
    }

    fn ways(&self) -> Result<Vec<Way>, String> {
        self.call("ways", None, |output, _| answer::ways(output))
    }

    fn run(&self, way: &Way) -> Result<Answer, String> {
        let read =
            |output: &str, directory: &Path| answer::answer(output, || process::text(&directory.join("answer.csv")));
        self.call("solve", Some(way), read)
    }
}
