//! What is shown of a scenario, and what is said of it.

use std::path::Path;

use super::server::Live;
use crate::cli::record_args::RecordArgs;
use crate::report::live::pace_told;
use linkage::error::Result;
use prover::proof::{Proof, Reference};
use scenario::Scenario;

impl Live {
    /// Shows the reference alone, before there is a proof. Where it fails, the proof says why.
    pub(in crate::cli) fn show_reference(&self, record: &RecordArgs, scenario: &Scenario, reference: Reference) {
        let reel = || {
            let case = scenario.case.scene()?.case;
            let trajectory = reference.solver().solve(&case)?;
            record.first_reel(scenario, &case, &trajectory)
        };
        if let Ok(reel) = reel() {
            self.show(reel);
        }
    }

    /// Shows what a recording of a proof would hold.
    ///
    /// # Errors
    /// Those of a recording.
    pub(in crate::cli) fn show_proof(&self, record: &RecordArgs, scenario: &Scenario, proof: &Proof) -> Result<()> {
        record.reel(scenario, proof).map(|reel| self.show(reel))
    }

    /// The address for viewers on this machine.
    pub(in crate::cli) fn address(&self) -> String {
        let address = self.listens_at();
        match address.ip() {
            ip if !ip.is_unspecified() => format!("ws://{address}"),
            ip if ip.is_ipv6() => format!("ws://[::1]:{}", address.port()),
            _ => format!("ws://127.0.0.1:{}", address.port()),
        }
    }

    /// Where it is shown, how slowly, and how to look on, with the layout beside the recording.
    pub(in crate::cli) fn told(&self, layout: Option<&Path>) -> String {
        let address = self.address();
        let pace = self.shown().map_or(String::new(), |reel| format!(", {}", pace_told(&reel)));
        let layout = match layout {
            Some(layout) => format!("then Layouts, Import from file: {}", layout.display()),
            None => "a layout is written beside a recording, so not with --no-record".into(),
        };
        format!(
            "\nlive       {address}{pace}\n           \
             Lichtblick or Foxglove: Open connection, Foxglove WebSocket, this address;\n           \
             Foxglove at once: https://app.foxglove.dev/?ds=foxglove-websocket&ds.url={address}\n           \
             {layout}\n           \
             Ctrl-C ends it\n"
        )
    }
}
