//! The boundary to C++. Only this file contains unsafe code. Every declaration repeats a declaration of `shim.h`.

use crate::sentences;
use std::ffi::{c_char, c_int, c_void};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::ptr::{self, NonNull};

use crate::parts::{Failure, IntegrationSettings, LoopClosure, SimbodyBody, SimbodyJoint};
use crate::state::{BodyState, LoopState, SimbodyState};

/// `linkproof_body`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct RawBody {
    parent: usize,
    slides: c_int,
    on_parent: [f64; 2],
    on_child: [f64; 2],
    axis_parent: [f64; 2],
    axis_child: [f64; 2],
    mass: f64,
    centre: [f64; 2],
    inertia: f64,
    extra_mass: f64,
    extra_inertia: f64,
    resistance: f64,
    coordinate: f64,
    driven: c_int,
    rate: f64,
}

impl RawBody {
    pub(crate) fn of(body: &SimbodyBody) -> Self {
        let x = [1.0, 0.0];
        let (slides, on_parent, on_child, axis_parent, axis_child) = match body.joint {
            SimbodyJoint::Pin { on_parent, on_child } => (0, on_parent, on_child, x, x),
            SimbodyJoint::Slider { on_parent, on_child, axis_parent, axis_child } => {
                (1, on_parent, on_child, axis_parent, axis_child)
            }
        };
        RawBody {
            parent: body.parent,
            slides,
            on_parent,
            on_child,
            axis_parent,
            axis_child,
            mass: body.inertia.mass,
            centre: body.inertia.centre,
            inertia: body.inertia.inertia,
            extra_mass: body.inertia.extra_mass,
            extra_inertia: body.inertia.extra_inertia,
            resistance: body.resistance,
            coordinate: body.coordinate,
            driven: body.law.is_some().into(),
            rate: body.law.map_or(body.rate, |law| law.rate),
        }
    }

    /// All floating-point numbers of the body.
    pub(crate) fn numbers(&self) -> impl Iterator<Item = f64> {
        let pairs = [self.on_parent, self.on_child, self.axis_parent, self.axis_child, self.centre];
        let masses = [self.mass, self.inertia, self.extra_mass, self.extra_inertia];
        let others = [self.resistance, self.coordinate, self.rate];
        pairs.into_iter().flatten().chain(masses).chain(others)
    }
}

/// The type `linkproof_run` of the shim. Only C++ uses the contents of this type.
#[repr(C)]
struct RawRun {
    private: [u8; 0],
}

/// `linkproof_act`.
type Callback = unsafe extern "C" fn(*mut c_void, *const BodyState, *mut f64);

// The functions marked `safe` are sound for all arguments that the types of their parameters permit.
unsafe extern "C" {
    fn linkproof_simbody_new(
        bodies: *const RawBody,
        body_count: usize,
        loops: *const LoopClosure,
        loop_count: usize,
        gravity: &[f64; 2],
        accuracy: f64,
        tolerance: f64,
        time_scale: f64,
        act: Option<Callback>,
        user: *mut c_void,
        run: &mut *mut RawRun,
        text: *mut c_char,
        size: usize,
    ) -> c_int;
    fn linkproof_simbody_advance(run: *mut RawRun, time: f64, steps: usize, text: *mut c_char, size: usize) -> c_int;
    fn linkproof_simbody_read(
        run: *mut RawRun,
        reactions: c_int,
        bodies: *mut BodyState,
        loops: *mut LoopState,
        text: *mut c_char,
        size: usize,
    ) -> c_int;
    fn linkproof_simbody_load(run: *mut RawRun, loads: *const f64);
    fn linkproof_simbody_gaps(
        run: *mut RawRun,
        time: &mut f64,
        gaps: *mut f64,
        text: *mut c_char,
        size: usize,
    ) -> c_int;
    fn linkproof_simbody_steps(run: *const RawRun) -> usize;
    fn linkproof_simbody_free(run: *mut RawRun);
    safe fn linkproof_simbody_version(version: &mut [c_int; 3]);
    #[cfg(test)]
    safe fn linkproof_simbody_sizes(sizes: &mut [usize; 4]);
}

/// Version of the Simbody library in use, as "3.7.0".
pub fn version() -> String {
    let mut version = [0; 3];
    linkproof_simbody_version(&mut version);
    version.map(|part| part.to_string()).join(".")
}

/// Calls the shim with a buffer for its error message.
fn told(call: impl FnOnce(*mut c_char, usize) -> c_int) -> Result<(), Failure> {
    let mut text = [0_u8; 1024];
    if call(text.as_mut_ptr().cast(), text.len()) == 0 {
        return Ok(());
    }
    let length = text.iter().position(|&byte| byte == 0).unwrap_or(text.len());
    Err(Failure::of(plain(&String::from_utf8_lossy(&text[..length]))))
}

/// Simbody's message in one line, without the source locations of its exceptions.
fn plain(words: &str) -> String {
    let line = words.split_whitespace().collect::<Vec<_>>().join(" ");
    let mut parts = line.split(sentences::SIMTK_EXCEPTION_THROWN_AT);
    let first = parts.next().unwrap_or_default().to_string();
    parts.fold(first, |told, part| told + part.split_once(": ").map_or(part, |(_, rest)| rest))
}

/// Computes the forces and moments that act on the bodies in addition to gravity.
/// The first argument has positions and velocities of all bodies. The accelerations and forces of the bodies in the
/// first argument are 0.
/// The second argument receives three numbers for every body: the force at the mass centre (N, world axes) and the
/// moment about the mass centre (N m).
/// The numbers of the second argument are 0 on entry.
pub type Act = Box<dyn FnMut(&[BodyState], &mut [[f64; 3]])>;

/// The data for Simbody's callback.
struct Acting {
    act: Act,
    count: usize,
}

/// Passes a call from Simbody on to Rust. If the Rust code panics, the loads are set to NaN, so Simbody ends the run.
unsafe extern "C" fn acting(user: *mut c_void, bodies: *const BodyState, loads: *mut f64) {
    // SAFETY: `user` points to the box of data, which exists as long as the run. Simbody calls this function from one
    // thread at a time.
    // `count` is the number of bodies with which the run was built. Simbody passes three loads for every body.
    let (acting, bodies, loads) = unsafe {
        let acting = &mut *user.cast::<Acting>();
        let count = acting.count;
        let loads = std::slice::from_raw_parts_mut(loads.cast::<[f64; 3]>(), count);
        (acting, std::slice::from_raw_parts(bodies, count), loads)
    };
    if catch_unwind(AssertUnwindSafe(|| (acting.act)(bodies, loads))).is_err() {
        loads.fill([f64::NAN; 3]);
    }
}

/// A run of a linkage, forwards in time.
pub struct LinkageRun {
    raw: NonNull<RawRun>,
    /// The callback's data. The data are boxed so that their address stays fixed, because Simbody has a pointer to the
    /// data.
    _acting: Option<Box<Acting>>,
    state: SimbodyState,
    time: f64,
    /// Internal steps allowed per time scale, and the time scale (s).
    pace: (usize, f64),
}

impl LinkageRun {
    pub(crate) fn start(
        bodies: &[RawBody],
        loops: &[LoopClosure],
        gravity: [f64; 2],
        settings: IntegrationSettings,
        act: Option<Act>,
    ) -> Result<Self, Failure> {
        let mut raw = ptr::null_mut();
        let mut kept = act.map(|act| Box::new(Acting { act, count: bodies.len() }));
        let user = kept.as_mut().map_or(ptr::null_mut(), |kept| ptr::from_mut(kept.as_mut()).cast());
        let call = kept.is_some().then_some(acting as Callback);
        told(|text, size| {
            let IntegrationSettings { accuracy, tolerance, time_scale, .. } = settings;
            // SAFETY: pointers and counts describe slices that outlive the call. The shim copies all data that it needs
            // after the call.
            // The model has checked that every body and every loop refers only to bodies that were added before it.
            // The callback's data is kept until the run is freed.
            // The shim writes at most `size` bytes of text.
            unsafe {
                linkproof_simbody_new(
                    bodies.as_ptr(),
                    bodies.len(),
                    loops.as_ptr(),
                    loops.len(),
                    &gravity,
                    accuracy,
                    tolerance,
                    time_scale,
                    call,
                    user,
                    &mut raw,
                    text,
                    size,
                )
            }
        })?;
        let raw = NonNull::new(raw).ok_or_else(|| Failure::of(sentences::SIMBODY_GAVE_NO_SYSTEM))?;
        let state = SimbodyState {
            bodies: vec![BodyState::default(); bodies.len()],
            loops: vec![LoopState::default(); loops.len()],
        };
        let mut run = LinkageRun { raw, _acting: kept, state, time: 0.0, pace: (settings.steps, settings.time_scale) };
        // Simbody accepts a free mobilizer without inertia, but the acceleration of such a mobilizer is not finite. The
        // state is therefore read here: a number that is not finite gives an error at the start of the run.
        run.read(false)?;
        Ok(run)
    }

    /// Integrates up to the time `time` (s), without passing it. After a failure the run can no longer be used.
    ///
    /// # Errors
    /// A `time` before the time already reached; any failure in Simbody. The error has Simbody's message, the time
    /// reached and all gaps at the time reached.
    pub fn advance(&mut self, time: f64) -> Result<(), Failure> {
        if !(time >= self.time && time.is_finite()) {
            return Err(Failure::of(sentences::is_asked_for_after(&time, &self.time)));
        }
        let (raw, (steps, time_scale)) = (self.raw.as_ptr(), self.pace);
        // If the number of steps is too large for an integer, the cast gives the largest integer, which still serves as
        // a limit.
        let intervals = (time - self.time) / time_scale;
        let steps = (steps as f64 * if intervals < 1.0 { 1.0 } else { intervals }) as usize;
        // SAFETY: the run is alive and has no other user. The shim writes at most `size` bytes of text.
        told(|text, size| unsafe { linkproof_simbody_advance(raw, time, steps, text, size) })
            .map_err(|failure| self.located(failure))?;
        self.time = time;
        Ok(())
    }

    /// Sets the loads on every body. Reactions that are read afterwards include these loads.
    /// A load is the force at the mass centre (N, world axes) and the moment about the mass centre (N m). Initially all
    /// loads are zero.
    /// Loads are used only when reactions are read, so they do not affect the motion.
    /// The reactions are therefore correct only if every degree of freedom is prescribed.
    ///
    /// # Errors
    /// An error if the number of loads differs from the number of bodies, or if a number is not finite.
    pub fn load(&mut self, loads: &[[f64; 3]]) -> Result<(), Failure> {
        if loads.len() != self.state.bodies.len() {
            return Err(Failure::of(sentences::loads_are_given_for_bodies(&loads.len(), &self.state.bodies.len())));
        }
        if !loads.as_flattened().iter().all(|number| number.is_finite()) {
            return Err(Failure::of(sentences::A_LOAD_IS_NOT_FINITE));
        }
        // SAFETY: the run is alive and has no other user. `loads` has three numbers for every body, and the shim copies
        // these numbers.
        unsafe { linkproof_simbody_load(self.raw.as_ptr(), loads.as_ptr().cast()) };
        Ok(())
    }

    /// Reads the state. If `reactions` is `false`, forces and moments are not read.
    ///
    /// # Errors
    /// The errors of Simbody, as in [`LinkageRun::advance`].
    /// An error also if a number of the state is not finite.
    pub fn read(&mut self, reactions: bool) -> Result<&SimbodyState, Failure> {
        let SimbodyState { bodies, loops } = &mut self.state;
        let raw = self.raw.as_ptr();
        // SAFETY: the run is alive and has no other user.
        // The vectors have one element for every body and every loop of the run, and the shim fills all elements.
        // The shim writes at most `size` bytes of text.
        let read = told(|text, size| unsafe {
            linkproof_simbody_read(raw, reactions.into(), bodies.as_mut_ptr(), loops.as_mut_ptr(), text, size)
        });
        read.map_err(|failure| self.located(failure))?;
        if !(self.state.bodies.iter().all(BodyState::is_finite) && self.state.loops.iter().all(LoopState::is_finite)) {
            return Err(self.located(Failure::of(sentences::SIMBODY_ANSWERED_WITH_A_NUMBER)));
        }
        Ok(&self.state)
    }

    /// Number of steps that the integrator has attempted.
    pub fn steps(&self) -> usize {
        // SAFETY: the run is alive, and the shim only reads.
        unsafe { linkproof_simbody_steps(self.raw.as_ptr()) }
    }

    /// Adds the time that the integrator has reached, and the gaps at that time, to a failure.
    fn located(&self, failure: Failure) -> Failure {
        let (mut time, mut gaps) = (0.0, vec![0.0; self.state.loops.len()]);
        let raw = self.raw.as_ptr();
        // SAFETY: the run is alive and has no other user. There are as many gaps as loops.
        // The shim writes at most `size` bytes of text.
        match told(|text, size| unsafe { linkproof_simbody_gaps(raw, &mut time, gaps.as_mut_ptr(), text, size) }) {
            Ok(()) => Failure { time: Some(time), gaps, ..failure },
            Err(_) => failure,
        }
    }
}

impl std::fmt::Debug for LinkageRun {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Run").field("time", &self.time).field("state", &self.state).finish_non_exhaustive()
    }
}

impl Drop for LinkageRun {
    fn drop(&mut self) {
        // SAFETY: the run came from `linkproof_simbody_new` and is freed only here.
        unsafe { linkproof_simbody_free(self.raw.as_ptr()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_omit_source_positions() {
        let thrown = "SimTK Exception thrown at Integrator.cpp:431:\n  Initialization failed because:\nSimTK Exception thrown at A.cpp:4:\n  no.";
        assert_eq!(plain(thrown), "Initialization failed because: no.");
        assert_eq!(plain("bad alloc"), "bad alloc");
    }

    #[test]
    fn rust_and_cpp_structures_have_equal_sizes() {
        let mut sizes = [0; 4];
        linkproof_simbody_sizes(&mut sizes);
        let own = [size_of::<RawBody>(), size_of::<LoopClosure>(), size_of::<BodyState>(), size_of::<LoopState>()];
        assert_eq!(sizes, own);
    }
}
