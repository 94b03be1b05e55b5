//! Computations without Python's global interpreter lock, and Ctrl-C during a computation.

use std::ops::ControlFlow;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use linkproof::parts::{Error, ErrorKind};
use pyo3::prelude::*;

use crate::errors::{OrRaised, raised};
use crate::sentences;

/// Time between two checks for Ctrl-C.
const PATIENCE: Duration = Duration::from_millis(50);
/// Stack size of the working thread (bytes). The main thread of a program usually has a stack of this size.
const STACK: usize = 8 << 20;

/// What the working thread sends: a report of its progress, or its result.
enum Message<M, T> {
    Told(M),
    Done(Result<T, Error>),
}

/// Does `work` on a separate thread without Python's lock, so that other Python threads can run.
/// Ctrl-C ends the wait for this thread; the thread finishes in the background, and its result is dropped.
///
/// # Errors
/// The error of `work`, as an exception; `KeyboardInterrupt` after Ctrl-C.
pub(crate) fn released<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce() -> Result<T, Error> + Send + 'static,
) -> PyResult<T> {
    told(py, |_: &mut dyn FnMut(()) -> ControlFlow<()>| work(), |()| Ok(()))
}

/// Like [`released`], but `work` can report its progress. `hear` receives the reports on the calling thread, with
/// Python's lock.
/// After Ctrl-C or an exception of `hear`, the report function of `work` returns a break.
///
/// # Errors
/// The errors of [`released`] and of `hear`.
pub(crate) fn told<T: Send + 'static, M: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce(&mut dyn FnMut(M) -> ControlFlow<()>) -> Result<T, Error> + Send + 'static,
    mut hear: impl FnMut(M) -> PyResult<()>,
) -> PyResult<T> {
    let (give, mut messages) = channel();
    let thread = thread::Builder::new().stack_size(STACK).spawn(move || {
        let done = work(&mut |message| match give.send(Message::Told(message)) {
            Ok(()) => ControlFlow::Continue(()),
            Err(_) => ControlFlow::Break(()),
        });
        // After Ctrl-C the channel is closed and nobody receives the result, so a failure to send is ignored.
        let _ = give.send(Message::Done(done));
    });
    thread.map_err(|error| Error::new(ErrorKind::Io, sentences::no_thread_begins(&error))).or_raised(py)?;
    loop {
        let (back, message) = py.detach(move || {
            let message = messages.recv_timeout(PATIENCE);
            (messages, message)
        });
        messages = back;
        match message {
            Ok(Message::Told(message)) => {
                py.check_signals()?;
                hear(message)?;
            }
            Ok(Message::Done(done)) => return done.or_raised(py),
            Err(RecvTimeoutError::Timeout) => py.check_signals()?,
            Err(RecvTimeoutError::Disconnected) => {
                let error = Error::new(ErrorKind::Numeric, sentences::THIS_IS_A_FAULT_OF_THE_PROGRAM);
                return Err(raised(py, &error.help(sentences::REPORT_IT_WITH_THE_SCENARIO)));
            }
        }
    }
}
