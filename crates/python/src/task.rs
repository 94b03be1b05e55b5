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
/// Stack size of the thread (bytes), as of the main thread of a program.
const STACK: usize = 8 << 20;

/// What the working thread sends.
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

/// Does the same as [`released`], with reports on the way: `hear` receives them on the calling thread, with Python's
/// lock.
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
        // Nobody receives the result after Ctrl-C.
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
