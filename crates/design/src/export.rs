//! Export of a mechanism as a model for other programs, and of the profiles of its cams.

pub mod cam;
mod limits;
pub mod mjcf;
mod names;
pub mod sdf;
mod shapes;
mod start;
pub mod urdf;
pub mod usd;
mod xml;

pub use start::first_state;

use crate::sentences;
use linkage::case::Case;
use linkage::error::Result;
use linkage::solver::Solver;

/// A format of models for other programs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ModelFormat {
    /// MJCF of MuJoCo.
    Mjcf,
    /// SDFormat of Gazebo.
    Sdf,
    /// URDF of ROS.
    Urdf,
    /// USD with UsdPhysics.
    Usd,
}

impl ModelFormat {
    /// All formats.
    pub const ALL: [ModelFormat; 4] = [ModelFormat::Mjcf, ModelFormat::Sdf, ModelFormat::Urdf, ModelFormat::Usd];

    /// The usual file name extension, without the dot.
    pub const fn ending(self) -> &'static str {
        match self {
            ModelFormat::Mjcf => "xml",
            ModelFormat::Sdf => "sdf",
            ModelFormat::Urdf => "urdf",
            ModelFormat::Usd => "usda",
        }
    }

    /// The case as a model called `name`, with the time step `step` (s) if the format has one.
    ///
    /// # Errors
    /// The errors of [`mjcf::mjcf`], [`sdf::sdf`], [`urdf::urdf`] and [`usd::usd`].
    pub fn model(self, case: &Case, solver: &dyn Solver, name: &str, step: f64) -> Result<String> {
        match self {
            ModelFormat::Mjcf => mjcf::mjcf(case, solver, name, step),
            ModelFormat::Sdf => sdf::sdf(case, solver, name, step),
            ModelFormat::Urdf => urdf::urdf(case, solver, name, None),
            ModelFormat::Usd => usd::usd(case, solver, name),
        }
    }

    /// Changes the first comment of a model: the comment then says that the scenario's loads are left out of the model.
    #[must_use]
    pub fn noting_no_loads(self, model: &str) -> String {
        let opening = match self {
            ModelFormat::Mjcf | ModelFormat::Sdf | ModelFormat::Urdf => "<!-- ",
            ModelFormat::Usd => "doc = \"",
        };
        let version = env!("CARGO_PKG_VERSION");
        let [found, noted] = [sentences::written_by(&version), sentences::written_without_loads_by(&version)]
            .map(|origin| format!("{opening}{origin}"));
        model.replacen(&found, &noted, 1)
    }
}
