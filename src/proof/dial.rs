//! One dial on every bound, for looking at a proof from outside.

use super::{Proof, of_engines, parties};
use crate::compare::{Check, Verdict, overall};

impl Proof {
    /// The same proof, judged with every bound multiplied by `dial`: below 1 stricter than the bounds are, at 0 nothing but an exact zero agrees.
    ///
    /// Residuals are left as they are, and so is what proved nothing either way: its bound says nothing, whatever it is multiplied by.
    #[must_use]
    pub fn with_bounds_scaled(mut self, dial: f64) -> Self {
        for engine in &mut self.engines {
            for channel in &mut engine.channels {
                channel.bound *= dial;
                judge(&mut channel.verdict, channel.residual.max, channel.bound);
            }
            engine.checks.iter_mut().for_each(|check| scale(check, dial));
            let channels = engine.channels.iter().map(|channel| &channel.verdict);
            if engine.failure.is_none() {
                engine.verdict = overall(channels.chain(engine.checks.iter().map(|check| &check.verdict)));
            }
        }
        self.checks.iter_mut().for_each(|check| scale(check, dial));
        if self.engines.len() > 1 {
            self.disputes = parties::disputes(self.reference, &self.reference_trajectory, &self.engines);
        }
        let analytic = overall(self.checks.iter().map(|check| &check.verdict));
        self.verdict = overall([&analytic, &of_engines(&self.engines)]);
        self
    }
}

fn scale(check: &mut Check, dial: f64) {
    check.bound *= dial;
    judge(&mut check.verdict, check.value, check.bound);
}

/// Judges again what was judged by its bound.
fn judge(verdict: &mut Verdict, value: f64, bound: f64) {
    if let Verdict::Agree { .. } | Verdict::Disagree { .. } = verdict {
        *verdict = Verdict::of(value, bound, || format!("{value:.3e} beyond the scaled bound {bound:.3e}"));
    }
}
