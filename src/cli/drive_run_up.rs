//! `linkproof drive --run-up`: how a run-up ended, and its table.

use std::fmt::Write;

use analytic::reduced::{End, RunUp};
use linkage::error::{Error, ErrorKind, Result};

/// Describes how a run-up ended.
pub(super) fn told(run_up: &RunUp) -> String {
    let mut text = match run_up.end {
        End::Reached => "run-up followed to its end".to_string(),
        End::Held(t, crank) => format!("run-up: held at {t:.9} s, crank angle {:.6} deg", crank.to_degrees()),
        End::Limit(t, crank) => {
            format!("run-up: at a limit of rotation at {t:.9} s, crank angle {:.6} deg", crank.to_degrees())
        }
    };
    if let Some(residual) = run_up.power_residual() {
        let _ = write!(text, "; motor against reactions: {residual:.1e} of the largest moment");
    }
    text.push_str("\n\n");
    text
}

/// One row per instant: the crank, the motor's moment, then all wanted channels; 17 significant digits.
pub(super) fn csv(run_up: &RunUp) -> Result<String> {
    let failed = |error: csv::Error| Error::new(ErrorKind::Io, format!("the table cannot be written: {error}"));
    let mut writer = csv::Writer::from_writer(Vec::new());
    let own = ["t_s", "crank_rad", "crank_omega_rad_s", "crank_alpha_rad_s2", "motor_on_crank_N_m", "shaft_N_m"];
    let names = run_up.trajectory.channels().iter().map(ToString::to_string);
    writer.write_record(own.map(String::from).into_iter().chain(names)).map_err(failed)?;
    for (row, at) in run_up.motion.iter().enumerate() {
        let own = [at.t, at.crank, at.omega, at.alpha, at.motor, at.shaft];
        let channels = run_up.trajectory.iter().map(|(_, values)| values[row]);
        writer.write_record(own.into_iter().chain(channels).map(|v| format!("{v:.16e}"))).map_err(failed)?;
    }
    let bytes = writer.into_inner().map_err(|error| failed(error.into_error().into()))?;
    Ok(String::from_utf8(bytes).expect("names and numbers are text"))
}
