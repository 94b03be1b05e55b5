//! The server: it listens from the start of a proof on, and shows what there is so far.

use std::net::{SocketAddr, TcpListener, TcpStream};
use std::sync::{Arc, mpsc};
use std::thread;
use std::time::Duration;

use super::stage::Stage;
use super::viewer::Viewer;
use linkage::error::{Error, ErrorKind, Result};
use recording::Reel;

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
            Error::new(ErrorKind::Io, format!("viewers cannot be served at {address}: {found}"))
                .key("--live")
                .help("name another address as --live=HOST:PORT; port 0 takes a free one")
        };
        let listener = TcpListener::bind(address).map_err(|found| wrong(&found))?;
        let address = listener.local_addr().map_err(|found| wrong(&found))?;
        let name = concat!("linkproof ", env!("CARGO_PKG_VERSION")).into();
        let stage = Arc::new(Stage::of(name));
        let own = Arc::clone(&stage);
        thread::spawn(move || let_in(&listener, &own));
        Ok(Live { stage, address })
    }

    /// Where it listens.
    pub(super) fn listens_at(&self) -> SocketAddr {
        self.address
    }

    /// What is shown now.
    pub(super) fn shown(&self) -> Option<Arc<Reel>> {
        self.stage.shown().reel
    }

    /// Shows this from now on.
    pub(super) fn show(&self, reel: Reel) {
        self.stage.show(reel);
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
        .map_err(|found| Error::new(ErrorKind::Io, format!("Ctrl-C cannot be waited for: {found}")))?;
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
