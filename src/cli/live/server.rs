//! The server: it listens from the start of a proof, and shows the results that exist so far.

use crate::sentences;
use std::net::{SocketAddr, TcpListener, TcpStream};
use std::path::Path;
use std::sync::{Arc, mpsc};
use std::thread;
use std::time::Duration;

use super::stage::Stage;
use super::viewer::Viewer;
use crate::cli::record_args::RecordArgs;
use crate::report::live::pace_told;
use linkage::error::{Error, ErrorKind, Result};
use prover::run::{Proof, Reference};
use scenario::Scenario;

/// Largest number of simultaneous viewers.
const MOST: usize = 32;
/// Waiting time after the server could not accept a viewer.
const REST: Duration = Duration::from_millis(100);

/// The server of viewers.
pub(in crate::cli) struct Live {
    stage: Arc<Stage>,
    address: SocketAddr,
}

impl Live {
    /// Listens at an address, and accepts viewers from now on.
    ///
    /// # Errors
    /// An error is returned if the program cannot listen at this address.
    pub(super) fn at(address: &str) -> Result<Live> {
        let wrong = |found: &std::io::Error| {
            Error::new(ErrorKind::Io, sentences::viewers_cannot_be_served_at(&address, &found))
                .key("--live")
                .help(sentences::NAME_ANOTHER_ADDRESS_AS_LIVE)
        };
        let listener = TcpListener::bind(address).map_err(|found| wrong(&found))?;
        let address = listener.local_addr().map_err(|found| wrong(&found))?;
        let name = concat!("linkproof ", env!("CARGO_PKG_VERSION")).into();
        let stage = Arc::new(Stage::of(name));
        let own = Arc::clone(&stage);
        thread::spawn(move || let_in(&listener, &own));
        Ok(Live { stage, address })
    }

    /// Shows the reference alone, before the proof is finished.
    /// An error is ignored here: the proof meets the same error and reports it.
    pub(in crate::cli) fn show_reference(&self, record: &RecordArgs, scenario: &Scenario, reference: Reference) {
        let reel = || {
            let case = scenario.case.scene()?.case;
            let trajectory = reference.solver().solve(&case)?;
            record.first_reel(scenario, &case, &trajectory)
        };
        if let Ok(reel) = reel() {
            self.stage.show(reel);
        }
    }

    /// Shows the contents that a recording of the proof would have.
    ///
    /// # Errors
    /// An error is returned if these contents cannot be recorded.
    pub(in crate::cli) fn show_proof(&self, record: &RecordArgs, scenario: &Scenario, proof: &Proof) -> Result<()> {
        record.reel(scenario, proof).map(|reel| self.stage.show(reel))
    }

    /// The address for viewers on this machine.
    pub(in crate::cli) fn address(&self) -> String {
        let address = self.address;
        match address.ip() {
            ip if !ip.is_unspecified() => format!("ws://{address}"),
            ip if ip.is_ipv6() => format!("ws://[::1]:{}", address.port()),
            _ => format!("ws://127.0.0.1:{}", address.port()),
        }
    }

    /// Message for the user: the address, the speed, how to watch, and the layout beside the recording.
    pub(in crate::cli) fn told(&self, layout: Option<&Path>) -> String {
        let address = self.address();
        let pace = self.stage.shown().reel.map_or(String::new(), |reel| format!(", {}", pace_told(&reel)));
        let layout = match layout {
            Some(layout) => sentences::then_layouts_import_from_file(&layout.display()),
            None => sentences::A_LAYOUT_IS_WRITTEN_BESIDE.into(),
        };
        sentences::live_lichtblick_or_foxglove_open(&address, &pace, &layout)
    }

    /// Serves viewers until the user or the system ends the server. `begin` is called as soon as the server can react
    /// to signals.
    ///
    /// # Errors
    /// An error is returned if no handler for the signals can be installed.
    pub(in crate::cli) fn serve(&self, begin: impl FnOnce()) -> Result<()> {
        let (tell, told) = mpsc::channel();
        ctrlc::set_handler(move || {
            // The waiting thread needs only the first signal; later signals have no receiver, so a failure to send is
            // ignored.
            let _ = tell.send(());
        })
        .map_err(|found| Error::new(ErrorKind::Io, sentences::ctrl_cannot_be_waited_for(&found)))?;
        begin();
        // The handler never drops its end of the channel, so receiving cannot fail.
        let _ = told.recv();
        Ok(())
    }
}

/// Accepts viewers, each on a separate thread.
fn let_in(listener: &TcpListener, stage: &Arc<Stage>) {
    for stream in listener.incoming() {
        // The server holds two references to the stage, and every viewer holds one reference, so the number of
        // references gives the number of viewers.
        let is_full = Arc::strong_count(stage) >= MOST + 2;
        match stream {
            Ok(stream) if !is_full => serve_one(stream, Arc::clone(stage)),
            // If there are too many viewers, the new viewer is refused. If too many files are open, none is accepted.
            // In both cases the server waits before it tries again.
            Ok(_) | Err(_) => thread::sleep(REST),
        }
    }
}

fn serve_one(stream: TcpStream, stage: Arc<Stage>) {
    // If no thread is available, the viewer is refused.
    let _ = thread::Builder::new().spawn(move || {
        if let Some(viewer) = Viewer::greeted(stream, &stage) {
            viewer.attend();
        }
    });
}
