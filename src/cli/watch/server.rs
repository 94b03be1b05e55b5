//! HTTP on this machine.

use std::collections::hash_map::RandomState;
use std::hash::{BuildHasher, Hasher};
use std::io::{self, Read};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use tiny_http::{Header, Method, Request, Response, Server};

use super::desk::Desk;
use super::requests;
use crate::report::watch::{Request as Wish, SCRIPT, frame, shell};

/// Longest body of a request (bytes).
const LARGEST: u64 = 4 << 20;
/// Largest number of requests at a time; further ones are refused.
const MOST: usize = 64;

type Answer = Response<io::Cursor<Vec<u8>>>;

/// The server of one page.
pub(super) struct PageServer {
    server: Server,
    port: u16,
    word: String,
}

impl PageServer {
    /// Listens on this machine only.
    ///
    /// # Errors
    /// The error of the system, such as a taken port.
    pub(super) fn at(port: u16) -> Result<PageServer, Box<dyn std::error::Error + Send + Sync>> {
        let server = Server::http(("127.0.0.1", port))?;
        let port = server.server_addr().to_ip().map_or(port, |address| address.port());
        Ok(PageServer { server, port, word: random_word() })
    }

    /// The address of the page.
    pub(super) fn address(&self) -> String {
        format!("http://127.0.0.1:{}/{}/", self.port, self.word)
    }

    /// Answers requests until the program ends.
    pub(super) fn serve(self, desk: &Arc<Desk>) {
        let door = Arc::new(Door { port: self.port, word: self.word, open: AtomicUsize::new(0) });
        for mut request in self.server.incoming_requests() {
            let (door, desk) = (Arc::clone(&door), Arc::clone(desk));
            if door.open.fetch_add(1, Ordering::Relaxed) >= MOST {
                door.open.fetch_sub(1, Ordering::Relaxed);
                // An answer fails only if the client has gone, so its error is ignored.
                let _ = request.respond(status(503));
                continue;
            }
            thread::spawn(move || {
                let answer = door.answer(&mut request, &desk);
                let _ = request.respond(answer);
                door.open.fetch_sub(1, Ordering::Relaxed);
            });
        }
    }
}

/// A word of 32 hexadecimal digits that other programs cannot guess. The keys of the hasher come from the system's
/// random numbers.
fn random_word() -> String {
    let part = || RandomState::new().build_hasher().finish();
    format!("{:016x}{:016x}", part(), part())
}

/// What the server needs to answer a request.
struct Door {
    port: u16,
    word: String,
    open: AtomicUsize,
}

impl Door {
    fn answer(&self, request: &mut Request, desk: &Desk) -> Answer {
        if !self.admits(request) {
            return status(403);
        }
        let url = request.url().to_string();
        let Some(rest) = url.strip_prefix('/').and_then(|rest| rest.strip_prefix(self.word.as_str())) else {
            return status(404);
        };
        let (path, query) = rest.split_once('?').unwrap_or((rest, ""));
        let number = || query.split_once('=').and_then(|(_, number)| number.parse().ok()).unwrap_or(0);
        match (request.method(), path) {
            (Method::Get, "/") => typed(shell(&desk.file.display().to_string()), "text/html; charset=utf-8"),
            (Method::Get, "/frame") => typed(frame(), "text/html; charset=utf-8"),
            (Method::Get, "/watch.js") => typed(SCRIPT.into(), "text/javascript; charset=utf-8"),
            (Method::Get, "/state") => typed(desk.told(number()), "application/json"),
            (Method::Post, what) => {
                let wish = body(request).and_then(|body| Wish::of(what.strip_prefix('/')?, &body));
                wish.map_or_else(|| status(400), |wish| typed(requests::answered(desk, &wish), "application/json"))
            }
            _ => status(404),
        }
    }

    /// Whether a request comes from the page itself: the request names this machine as host, and no other origin. A
    /// request that changes something must name its origin.
    fn admits(&self, request: &Request) -> bool {
        let header = |name: &'static str| {
            let all = request.headers().iter().filter(move |header| header.field.equiv(name));
            all.map(|header| header.value.as_str().to_string()).collect::<Vec<_>>()
        };
        let hosts = ["127.0.0.1", "localhost"].map(|host| format!("{host}:{}", self.port));
        let (host, origin) = (header("Host"), header("Origin"));
        let is_here = matches!(&host[..], [host] if hosts.contains(host));
        let is_ours = |origin: &String| hosts.iter().any(|host| *origin == format!("http://{host}"));
        let names_origin = *request.method() == Method::Get || !origin.is_empty();
        is_here && names_origin && origin.iter().all(is_ours)
    }
}

/// The body of a request.
fn body(request: &mut Request) -> Option<String> {
    let mut text = String::new();
    request.as_reader().take(LARGEST).read_to_string(&mut text).ok()?;
    Some(text)
}

fn status(code: u16) -> Answer {
    Response::from_data(Vec::new()).with_status_code(code)
}

fn typed(content: String, kind: &str) -> Answer {
    let header = |name: &str, value: &str| Header::from_bytes(name, value).expect("printable characters");
    Response::from_data(content.into_bytes())
        .with_chunked_threshold(usize::MAX)
        .with_header(header("Content-Type", kind))
        .with_header(header("Cache-Control", "no-store"))
        .with_header(header("X-Content-Type-Options", "nosniff"))
        .with_header(header("Referrer-Policy", "no-referrer"))
}
