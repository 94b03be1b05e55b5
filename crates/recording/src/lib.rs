//! Recordings: the results of a run as one MCAP file. Ordinary viewers replay the file, and this crate reads it back.
//!
//! In this crate, a side is a recorded trajectory: `reference`, or `engine` (the engine's name if there are several).
//!
//! | topic | schema | when |
//! |---|---|---|
//! | `/<side>/grid` | `linkproof.Grid` | every sample |
//! | `/<side>/link/<name>`, `/<side>/point/<name>` | `linkproof.Link`, `linkproof.Point` | every sample |
//! | `/<side>/frame` | `linkproof.Frame` | every sample |
//! | `/<side>/drive`, `/<side>/drive/<joint>` | `linkproof.Drive`; `linkproof.DriveThrust` of a slide | every sample |
//! | `/<side>/transmission/<name>` | `linkproof.Transmission` | every sample |
//! | `/<side>/joint/<name>` | `linkproof.Joint`; `linkproof.Slider` of a prismatic joint; both with `Rubbing` before the name if the joint has friction | every sample |
//! | `/error/link/<name>`, ... | `linkproof.LinkError`, ...: um, urad, mN | every sample |
//! | `/mechanism/links` | `foxglove.SceneUpdate` | once |
//! | `/robot_description` | `std_msgs/msg/String`: the links as URDF, for viewers without scenes | once |
//! | `/tf` | `foxglove.FrameTransforms` | every frame |
//! | `/mechanism/forces` | `foxglove.SceneUpdate` | every frame, if requested |
//! | `/log` | `foxglove.Log` | verdicts and warnings |
//!
//! A message type declares only the fields that are computed.
//! If a message type lacks fields, its name contains the numbers of the present fields, such as `linkproof.Point_1_2`.
//!
//! Log times are nanoseconds from the first instant of the recording.
//! A simulated second takes [`Show::slow`] seconds of log time. The messages of the grid contain the simulated times.
//! Nothing depends on a clock, so equal runs give equal files.
//! The sequence number of a message is the number of its sample in ascending order of time.
//! Messages of one sample have the same sequence number in all topics of a side.
//! The scenario is attached as `scenario.toml`.
//! The metadata record `linkproof` contains versions, settings and the scales of time and of force arrows.
//!
//! A recording by a program other than linkproof can also be read.
//! Such a recording needs `/<side>/grid` in protobuf. The side's other topics are read if they are in protobuf. Each of
//! these topics needs a value for every sample of the grid.
//! The names of the protobuf fields must be the suffixes of [`CHANNELS`](linkage::trajectory::CHANNELS).
//! The field numbers are looked up in the file.

mod beside;
mod extent;
mod film;
mod forces;
mod marks;
mod messages;
mod pour;
mod raw;
mod read;
mod recording;
#[cfg(feature = "live")]
mod reel;
mod scene;
mod schema;
mod sentences;
mod shapes;
mod sink;
mod table;
mod urdf;
mod view;
pub mod viewers;
mod write;

pub use beside::{RecordingPlace, place};
pub use film::{DrawnLink, Film, Numbers, film, numbers};
pub use read::{load, read_bytes};
pub use recording::{Level, LogEntry, RecordedSide, Recording, Show};
#[cfg(feature = "live")]
pub use reel::{Reel, ReelMessage, reel};
#[cfg(feature = "live")]
pub use sink::MessageKind;
pub use view::{Line, Plot, View, view};
pub use write::write;
