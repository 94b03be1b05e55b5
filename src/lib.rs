//! Builds every planar mechanism twice, once analytically and once as a Rapier multibody, and proves that the two
//! agree.
//!
//! A [`Scenario`] contains a [`Case`].
//! [`prove`] solves the case with both analytic sides and with engines, and compares the trajectories.
//! [`solve`] gives only the analytic solution.
//! [`check`] judges formulas, and [`compare`] judges tables and recordings of other programs.
//! `draw` shows a mechanism (feature `command`).
//!
//! A proof of a scenario file:
//!
//! ```
//! use linkproof::{Options, Scenario, prove};
//!
//! # std::env::set_current_dir(env!("CARGO_MANIFEST_DIR"))?;
//! let scenario = Scenario::load("scenarios/crank_rocker.toml")?;
//! let proof = prove(&scenario, &Options::default())?;
//! println!("{}", proof.verdict.word());
//! # assert_eq!(proof.verdict.word(), "agree");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A proof of a mechanism that is built in code, in SI units:
//!
//! ```
//! use linkproof::parts::AssemblyMode;
//! use linkproof::{Case, Options, Scenario, prove};
//!
//! let case = Case::builder()
//!     .ground(&[("O", [0.0, 0.0]), ("C", [0.4, 0.0])])
//!     .link("crank", &[("O", [0.0, 0.0]), ("A", [0.1, 0.0])])
//!     .link("coupler", &[("A", [0.0, 0.0]), ("B", [0.35, 0.0])])
//!     .link("rocker", &[("C", [0.0, 0.0]), ("B", [0.25, 0.0])])
//!     .mass("coupler", 2.0, [0.175, 0.0], 0.02)
//!     .pin("O", "ground", "crank")
//!     .pin("A", "crank", "coupler")
//!     .pin("B", "coupler", "rocker")
//!     .pin("C", "ground", "rocker")
//!     .crank("O", 10.0)
//!     .mode(&["coupler", "rocker"], AssemblyMode::Left)
//!     .build()?;
//! let proof = prove(&Scenario::of_case("four_bar", case)?, &Options::default())?;
//! # assert_eq!(proof.verdict.word(), "agree");
//! # Ok::<(), linkproof::parts::Error>(())
//! ```
//!
//! [`compare`] compares a table, a recording or another program's solution with a scenario:
//!
//! ```
//! use linkproof::parts::{ComparedParty, ComparisonRule, Mapping};
//! use linkproof::{Scenario, compare, solve};
//!
//! # std::env::set_current_dir(env!("CARGO_MANIFEST_DIR"))?;
//! let scenario = Scenario::load("scenarios/crank_rocker.toml")?;
//! let solved = solve(&scenario.case)?;
//! let found = compare([scenario.clone().into(), solved.into()], &ComparisonRule::default())?;
//! assert_eq!(found.verdict.word(), "agree");
//!
//! let mapping = Mapping::load("examples/foreign/mujoco_crank_rocker.map.toml".as_ref())?;
//! let table = ComparedParty::table("examples/foreign/data/wrong_mujoco_late.csv", &mapping)?;
//! let found = compare([scenario.into(), table], &ComparisonRule::default())?;
//! assert_eq!(found.verdict.word(), "disagree");
//! println!("{}", found.pairs[0].channels[0].since.unwrap().difference);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! In a test, `assert_proven!` proves a scenario, and panics with the report unless the proof agrees.
//! [`testing`] has further functions for tests:
//!
//! ```
//! linkproof::assert_proven!("scenarios/crank_rocker.toml", only = ["positions"]);
//! ```
//!
//! All values are in SI units and world axes (x right, y up, angles counter-clockwise from +x).
//! In scenario files and formulas, the suffix of a key or of a channel states another unit, such as `angle_deg`.

#[doc(hidden)]
#[macro_use]
pub mod plain;

mod check;
#[cfg(feature = "command")]
#[doc(hidden)]
pub mod cli;
#[cfg(feature = "command")]
mod draw;
#[cfg(feature = "command")]
mod graph;
#[cfg(feature = "command")]
#[doc(hidden)]
pub mod report;
#[cfg_attr(not(feature = "command"), allow(dead_code, reason = "most belong to the command"))]
mod sentences;
#[cfg(feature = "command")]
mod shipped;
pub mod testing;

pub use check::{check, check_formula};
#[cfg(feature = "command")]
pub use draw::draw;
#[doc(inline)]
pub use linkage::case::Case;
#[doc(inline)]
pub use prover::bounds::Verdict;
#[doc(inline)]
pub use prover::compare::compare;
#[doc(inline)]
pub use prover::run::{Options, Proof, prove, solve};
#[doc(inline)]
pub use scenario::Scenario;

/// Types that the main functions use: errors, choices, and the parts of a proof and a solution.
pub mod parts {
    pub use crate::check::FormulaQuestion;
    #[cfg(feature = "command")]
    pub use crate::draw::{Medium, PictureOptions};
    pub use linkage::case::{CaseBuilder, Grid, Wanted, When};
    pub use linkage::drive::{Load, MotionLaw};
    pub use linkage::engine::Route;
    pub use linkage::error::{Advice, Error, ErrorKind};
    pub use linkage::mechanism::AssemblyMode;
    pub use linkage::trajectory::{Channel, Stage, Trajectory};
    pub use prover::bounds::{Check, Residual};
    pub use prover::compare::{Compared, ComparedParty, ComparisonRule, PartyComparison, RowPair, SidePair};
    pub use prover::engines::EngineName;
    pub use prover::run::solved::Claimed;
    pub use prover::run::{ChannelProof, EngineInfo, EngineProof, Reference, prove_with};
    pub use prover::tables::By;
    pub use scenario::mapping::{Allowed, Mapped, Mapping, Size};
    pub use scenario::{EngineSetting, EngineSettings, SettingOrigin};
}
