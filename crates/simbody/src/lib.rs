//! Planar linkages in Simbody: bodies on pins and sliders, loops closed by constraints, coordinates prescribed in time,
//! Simbody's own error-controlled integrator, and its reactions.
//!
//! All data are plain numbers in SI units, in the plane x-y; angles are in rad, counter-clockwise positive.
//! Simbody works in three dimensions.
//! The mobilizers permit no motion out of the plane, and the constraints add no equation there.
//!
//! ```
//! use linkproof_simbody::{Body, GROUND, Inertia, Joint, Law, Model, Settings};
//!
//! // A pendulum of 2 kg that a drive turns at 3 rad/s, read when it points along +x.
//! let mut model = Model::new([0.0, -9.81]);
//! let joint = Joint::Pin { on_parent: [0.0, 0.0], on_child: [0.0, 0.0] };
//! let inertia = Inertia { mass: 2.0, centre: [0.5, 0.0], ..Inertia::default() };
//! let law = Some(Law { rate: 3.0 });
//! let rod = model.add(Body { parent: GROUND, joint, inertia, resistance: 0.0, coordinate: 0.0, rate: 0.0, law }).unwrap();
//! let mut run = model.run(Settings::default()).unwrap();
//! let state = run.read(true).unwrap();
//! let rod = &state.bodies[rod - 1];
//! assert!((rod.drive - 2.0 * 9.81 * 0.5).abs() < 1e-12);
//! assert!((rod.force[0] + 2.0 * 0.5 * 9.0).abs() < 1e-12);
//! ```

mod ffi;
mod model;
mod parts;
mod state;

pub use ffi::{Act, Run, version};
pub use model::Model;
pub use parts::{Body, Closing, Failure, GROUND, Inertia, Joint, Law, Settings};
pub use state::{BodyState, LoopState, State};
