//! `--live`: serves the result of a proof, as an animation, to viewers that connect by Foxglove's WebSocket.
//!
//! - Source: a `recording::Reel` in memory. The same function, `recording::pour`, fills a reel and a recording file.
//! - Protocol: supported under its former name (`foxglove.websocket.v1`) and its present name (`foxglove.sdk.v1`).
//!   The server of Foxglove's library supports only the present name.
//!   Lichtblick and the open Foxglove Studio offer only the former name.
//!   Therefore `tungstenite` does handshake and frames, and `report::live` has the messages.
//! - Clock: messages contain log times of the recording.
//!   The machine's clock decides when a message is sent. The bytes of the message do not depend on this clock.
//! - Viewers: each has a thread and a position in the reel.
//!   A viewer that pauses, seeks or is slow does not disturb the other viewers.
//! - Stage: while the engine works, viewers see only the reference; afterwards they see everything.
//!   Channels then get new numbers, and viewers subscribe again.

#[cfg(feature = "live")]
mod player;
#[cfg(feature = "live")]
mod server;
#[cfg(feature = "live")]
mod stage;
#[cfg(feature = "live")]
mod viewer;

use crate::sentences;
use std::path::PathBuf;

#[cfg(feature = "live")]
pub(super) use server::Live;

use linkage::error::{Error, ErrorKind, Result};
#[cfg(not(feature = "live"))]
use {
    super::record_args::RecordArgs,
    prover::run::{Proof, Reference},
    scenario::Scenario,
    std::path::Path,
};

/// Default address for viewers, as Foxglove proposes it.
const USUAL: &str = "127.0.0.1:8765";

/// Whether the command serves live viewers, and at which address.
#[derive(Clone, Debug, clap::Args)]
#[group(skip)]
pub(super) struct LiveArgs {
    /// Show the mechanism to Foxglove and Lichtblick while and after it is proven, in a slow loop until Ctrl-C [default
    /// address: 127.0.0.1:8765; port 0 selects a free port]. Needs the cargo feature `live`
    #[arg(long, value_name = "[HOST:]PORT", num_args = 0..=1, require_equals = true, default_missing_value = USUAL)]
    pub(super) live: Option<String>,
}

impl LiveArgs {
    /// Listens for viewers of a scenario, if requested.
    ///
    /// # Errors
    /// An error is returned if this build has no server, if there are several scenarios, or if the address cannot be
    /// used.
    pub(super) fn start(&self, files: &[PathBuf]) -> Result<Option<Live>> {
        let Some(address) = &self.live else { return Ok(None) };
        if let [_, _, ..] = files {
            let message = sentences::live_shows_one_scenario_but_are_given(&files.len());
            return Err(Error::new(ErrorKind::Input, message).help(sentences::NAME_ONE_FILE));
        }
        let on_this_machine = |port| format!("127.0.0.1:{port}");
        Live::at(&address.parse::<u16>().map_or(address.clone(), on_this_machine)).map(Some)
    }
}

/// Replaces the server in builds without a server.
#[cfg(not(feature = "live"))]
pub(super) enum Live {}

#[cfg(not(feature = "live"))]
impl Live {
    fn at(_: &str) -> Result<Live> {
        Err(Error::new(ErrorKind::Unsupported, sentences::LIVE_IS_ASKED_FOR_BUT_THIS_BUILD)
            .help(sentences::BUILD_WITH_THE_CARGO_FEATURE)
            .or_help(sentences::LEAVE_OUT_LIVE_AND_OPEN_THE_RECORDING))
    }

    pub(super) fn show_reference(&self, _: &RecordArgs, _: &Scenario, _: Reference) {
        match *self {}
    }

    pub(super) fn show_proof(&self, _: &RecordArgs, _: &Scenario, _: &Proof) -> Result<()> {
        match *self {}
    }

    pub(super) fn address(&self) -> String {
        match *self {}
    }

    pub(super) fn told(&self, _: Option<&Path>) -> String {
        match *self {}
    }

    pub(super) fn serve(&self, _: impl FnOnce()) -> Result<()> {
        match *self {}
    }
}
