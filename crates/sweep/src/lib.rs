//! Parameter sweeps: some numbers of a scenario are varied, and figures of every case are computed.
//!
//! A [`SweepDesign`] gives the values of the numbers in each case; a [`SweepPlan`] adds the scenario and the figures.
//! [`run`] solves all cases on several threads and stores them part by part, so that a stopped sweep can be continued.
//! The joined table does not depend on the number of threads, of shards, or of stops.

mod axis;
mod columns;
mod design;
mod fast;
mod figure;
mod groups;
mod plan;
mod run;
mod sentences;
mod sobol;
mod store;
mod summary;
mod table;

pub use axis::{Spread, SweepAxis};
pub use columns::column_table;
pub use design::{DesignKind, SweepDesign};
pub use groups::SweepGroups;
pub use plan::{CaseResult, CaseSolver, FORMAT, SweepPlan};
pub use run::{Shard, SweepTally, run};
pub use store::{SweepStore, TABLE};
pub use summary::{BEST, FigureSpread, Goal, Reasons, SweepRow, SweepSummary};
pub use table::{REFUSED, RowGroup, SOLVED};
