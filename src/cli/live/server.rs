//! The server: it listens from the start of a proof on, and shows what there is so far.

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

/// Most viewers at a time.
const MOST: usize = 32;
/// What is waited after a viewer could not be let in.
const REST: Duration = Duration::from_millis(100);

/// The server of viewers.
pub(in crate::cli) struct Live {
    stage: Arc<Stage>,
    address: SocketAddr,
}

impl Live {
    /// Listens at an address, and lets viewers in from now on.
    ///
    /// # Errors
    /// If nobody can listen there.
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

    /// Shows the reference alone, before there is a proof. Where it fails, the proof says why.
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

    /// Shows what a recording of a proof would hold.
    ///
    /// # Errors
    /// Those of a recording.
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

    /// Where it is shown, how slowly, and how to look on, with the layout beside the recording.
    pub(in crate::cli) fn told(&self, layout: Option<&Path>) -> String {
        let address = self.address();
        let pace = self.stage.shown().reel.map_or(String::new(), |reel| format!(", {}", pace_told(&reel)));
        let layout = match layout {
            Some(layout) => sentences::then_layouts_import_from_file(&layout.display()),
            None => sentences::A_LAYOUT_IS_WRITTEN_BESIDE.into(),
        };
        sentences::live_lichtblick_or_foxglove_open(&address, &pace, &layout)
    }

    /// Serves until the user, or the system, ends it; `begin` is called when they can.
    ///
    /// # Errors
    /// If signals cannot be waited for.
    pub(in crate::cli) fn serve(&self, begin: impl FnOnce()) -> Result<()> {
        let (tell, told) = mpsc::channel();
        ctrlc::set_handler(move || {
            // Whoever waits is told once; nobody is left to be told again.
            let _ = tell.send(());
        })
        .map_err(|found| Error::new(ErrorKind::Io, sentences::ctrl_cannot_be_waited_for(&found)))?;
        begin();
        // The handler has the other end for good.
        let _ = told.recv();
        Ok(())
    }
}

/// Lets viewers in, each on a thread of its own.
fn let_in(listener: &TcpListener, stage: &Arc<Stage>) {
    for stream in listener.incoming() {
        // The server has two copies of the stage, every viewer one.
        let is_full = Arc::strong_count(stage) >= MOST + 2;
        match stream {
            Ok(stream) if !is_full => serve_one(stream, Arc::clone(stage)),
            // Too many viewers, or too many open files: both pass.
            Ok(_) | Err(_) => thread::sleep(REST),
        }
    }
}

fn serve_one(stream: TcpStream, stage: Arc<Stage>) {
    // A viewer that no thread can be had for is turned away.
    let _ = thread::Builder::new().spawn(move || {
        if let Some(viewer) = Viewer::greeted(stream, &stage) {
            viewer.attend();
        }
    });
}
