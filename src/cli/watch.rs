//! `linkproof watch`: a page on this machine that follows a scenario file.
//!
//! - `desk`: the text of the file, the draft on the page, and what is known about the draft. Every change has a number.
//! - `work`: three threads. One follows the file, one solves the newest draft analytically, and one proves this draft
//!   if it has no mistakes. Results of older drafts are dropped.
//! - `server`: HTTP on 127.0.0.1. The address contains a random word, and requests of other pages are refused.
//!
//! Beside the text, a frame shows the page that `run -o PAGE.html` writes. Only `keep` writes to the file.

#[cfg(feature = "watch")]
mod desk;
#[cfg(feature = "watch")]
mod requests;
#[cfg(feature = "watch")]
mod server;
#[cfg(feature = "watch")]
mod work;

use std::path::PathBuf;

use crate::sentences;
use linkage::error::{Error, ErrorKind, Result};

#[derive(Debug, clap::Args)]
#[command(after_help = include_str!("help/watch.txt").trim_ascii_end())]
pub(super) struct Args {
    /// Scenario file
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Port of the page on this machine; 0 takes a free port
    #[arg(long, value_name = "PORT", default_value_t = 0)]
    port: u16,
}

/// Serves the page until the user ends the program.
///
/// # Errors
/// [`ErrorKind::Io`] if the file cannot be read, or if the port is taken.
#[cfg(feature = "watch")]
pub(super) fn watch(args: &Args) -> Result<()> {
    use std::sync::Arc;
    use std::thread;

    let text = scenario::source::text_of(&args.file)?;
    let desk = Arc::new(desk::Desk::of(args.file.clone(), text));
    let server = server::PageServer::at(args.port).map_err(|found| {
        Error::new(ErrorKind::Io, sentences::the_page_cannot_be_served(&args.port, &found))
            .key("--port")
            .help(sentences::NAME_ANOTHER_PORT)
    })?;
    super::output::print(&sentences::watch_serves(&server.address()))?;
    for work in [work::follow, work::move_drafts, work::prove_drafts] {
        let desk = Arc::clone(&desk);
        thread::spawn(move || work(&desk));
    }
    server.serve(&desk);
    Ok(())
}

/// Replaces the server in builds without a server.
#[cfg(not(feature = "watch"))]
pub(super) fn watch(_: &Args) -> Result<()> {
    Err(Error::new(ErrorKind::Unsupported, sentences::WATCH_IS_NOT_BUILT).help(sentences::BUILD_WITH_WATCH))
}
