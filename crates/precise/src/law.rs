//! Motion laws of drives.

use std::sync::Arc;

use linkage::case::{Case, CaseNumber};
use linkage::drive::{DriveMotion, MotionLaw};
use linkage::error::{Error, ErrorKind, Result};
use linkage::input::Input;
use linkage::math::Curve;
use linkage::mechanism::{JointId, LinkId};

use super::scalar::{Lift, Scalar};
use crate::sentences;

/// A drive with its law.
#[derive(Clone, Debug)]
pub(crate) struct DriveNumbers<S> {
    pub(crate) input: Input,
    pub(crate) joint: JointId,
    pub(crate) link: LinkId,
    pub(crate) zero: S,
    start: S,
    law: Law<S>,
}

/// A motion law over time, whose numbers are of any scalar type.
#[derive(Clone, Debug)]
enum Law<S> {
    Constant(S),
    Ramp {
        speed: S,
        time: S,
    },
    Cycloidal {
        rise: S,
        time: S,
    },
    Harmonic {
        amplitude: S,
        period: S,
        phase: S,
    },
    /// A table or formula. The table or formula is evaluated in doubles. The results have no derivatives with respect
    /// to the numbers of the table or formula.
    Curve(Arc<Curve>),
}

impl<S: Scalar> DriveNumbers<S> {
    /// The drive with the index `number` among the drives of the case.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] for a free motion.
    pub(crate) fn of(case: &Case, number: usize, lift: Lift<S>) -> Result<Self> {
        let drive = &case.drives[number];
        let mut part = 0;
        let mut law_number = |value: f64| {
            part += 1;
            lift(CaseNumber::Law { drive: number, part: part - 1 }, value)
        };
        let DriveMotion::Prescribed { law, .. } = &drive.motion else {
            return Err(Error::new(ErrorKind::Unsupported, sentences::A_MOTION_IS_FREE));
        };
        let law = match law {
            MotionLaw::ConstantSpeed(speed) => Law::Constant(law_number(*speed)),
            MotionLaw::Ramp { speed, time } => Law::Ramp { speed: law_number(*speed), time: law_number(*time) },
            MotionLaw::Cycloidal { rise, time } => Law::Cycloidal { rise: law_number(*rise), time: law_number(*time) },
            MotionLaw::Curve(curve) => match curve.as_ref() {
                Curve::Harmonic { amplitude, period, phase } => Law::Harmonic {
                    amplitude: law_number(*amplitude),
                    period: law_number(*period),
                    phase: law_number(*phase),
                },
                Curve::Table(_) | Curve::Formula(_) => Law::Curve(Arc::clone(curve)),
            },
        };
        Ok(DriveNumbers {
            input: drive.input,
            joint: drive.joint,
            link: drive.link,
            zero: lift(CaseNumber::Zero(number), drive.zero),
            start: lift(CaseNumber::Start(number), drive.start),
            law,
        })
    }

    /// Input, rate and acceleration at a time (s).
    pub(crate) fn at(&self, time: S) -> [S; 3] {
        let half = S::of(0.5);
        match &self.law {
            Law::Constant(speed) => [self.start + *speed * time, *speed, S::ZERO],
            Law::Ramp { speed, time: end } if time.value() <= end.value() => {
                let alpha = *speed / *end;
                [self.start + alpha * time * time * half, alpha * time, alpha]
            }
            Law::Ramp { speed, time: end } => [self.start + *speed * (time - *end * half), *speed, S::ZERO],
            Law::Cycloidal { rise, time: end } => {
                let (share, mean) = (time / *end, *rise / *end);
                let (sin, cos) = (S::TURN * share).sin_cos();
                let gone = *rise * (share - sin / S::TURN);
                [self.start + gone, mean * (S::ONE - cos), mean / *end * S::TURN * sin]
            }
            Law::Harmonic { amplitude, period, phase } => {
                let speed = S::TURN / *period;
                let (sin, cos) = (speed * time + *phase).sin_cos();
                let (begin, _) = phase.sin_cos();
                let gone = *amplitude * (sin - begin);
                [self.start + gone, *amplitude * speed * cos, -*amplitude * speed * speed * sin]
            }
            Law::Curve(curve) => {
                let [gone, rate, acceleration] = curve.at(time.value()).map(S::of);
                // The time can have derivatives. `off` has the value zero and the derivatives of the time.
                let off = time - S::of(time.value());
                [self.start + gone + rate * off, rate + acceleration * off, acceleration]
            }
        }
    }

    /// Whether the law is a table or formula. This crate does not differentiate the acceleration of such a law.
    pub(crate) fn is_curve(&self) -> bool {
        matches!(self.law, Law::Curve(_))
    }

    /// The time `time` (s), with its derivatives with respect to the numbers of the law, at a constant input.
    /// `None` if the input has derivatives but the rate of the input is zero.
    pub(crate) fn time_of_same_input(&self, time: f64) -> Option<S> {
        let [input, rate, _] = self.at(S::of(time));
        let off = input - S::of(input.value());
        if off == S::ZERO {
            return Some(S::of(time));
        }
        (rate.value() != 0.0).then(|| S::of(time) - off / S::of(rate.value()))
    }
}
