//! The numbers of drives.

use super::file::{Part, SlopeFile};
use super::found::KeySort;
use super::slope::Slope;
use crate::asked::StartRequest;
use crate::unit::{ANGLE, TIME, UnitFamily, of_input, of_input_rate};
use linkage::case::{Case, CaseNumber};
use linkage::drive::{DriveMotion, MotionLaw};
use linkage::input::Input;
use linkage::math::Curve;

impl<'a> SlopeFile<'a> {
    pub(super) fn read_drives(&mut self, root: &Part<'a>, asked: &StartRequest) {
        let case: &'a Case = self.case;
        for (drive, part) in root.list("drive").into_iter().enumerate().take(case.drives.len()) {
            let own = &case.drives[drive];
            let family = of_input(own.input);
            let zero = self.quantity(&part, "zero", &[family], KeySort::Other);
            self.put(CaseNumber::Zero(drive), Some(zero.unwrap_or_default()));
            let stated = self.start_of(root, &part, drive, family);
            let start = match asked.start(own.input).filter(|_| drive == 0) {
                Some(start) => Slope::constant(start),
                None => stated.unwrap_or_else(|| Slope::constant(own.start)),
            };
            self.put(CaseNumber::Start(drive), Some(start.clone()));
            let parts = self.law_of(&part, drive, &start);
            for (part, own) in parts.into_iter().enumerate() {
                self.put(CaseNumber::Law { drive, part }, own);
            }
        }
    }

    /// The input at t = 0, as stated in the file.
    fn start_of(
        &mut self,
        root: &Part<'a>,
        part: &Part<'a>,
        drive: usize,
        family: &'static UnitFamily,
    ) -> Option<Slope> {
        if drive == 0 && self.case.drives[drive].input == Input::Angle {
            return self.quantity(&root.inner("start")?, "crank", &[&ANGLE], KeySort::Other);
        }
        if let Some(start) = self.quantity(part, "start", &[family], KeySort::Other) {
            return Some(start);
        }
        let first = part.list("points").into_iter().next()?;
        let value = if self.case.drives[drive].input == Input::Slide { "slide" } else { "angle" };
        let start = self.quantity(&first, value, &[family], KeySort::Law)?;
        self.put_untold(&start, &part.path);
        Some(start)
    }

    /// The numbers of the law, in the order of [`CaseNumber::Law`].
    fn law_of(&mut self, part: &Part<'a>, drive: usize, start: &Slope) -> Vec<Option<Slope>> {
        let case: &'a Case = self.case;
        let own = &case.drives[drive];
        let (family, rates) = (of_input(own.input), of_input_rate(own.input));
        let mut law = |key: &str, family: &'static UnitFamily| self.quantity(part, key, &[family], KeySort::Law);
        match &own.motion {
            DriveMotion::Free { .. } => {
                vec![law("speed", rates), Some(law("initial_speed", rates).unwrap_or_default())]
            }
            DriveMotion::Prescribed { law: MotionLaw::ConstantSpeed(_), .. } if part.text("law") == Some("hold") => {
                vec![Some(Slope::default())]
            }
            DriveMotion::Prescribed { law: MotionLaw::ConstantSpeed(_), .. } => vec![law("speed", rates)],
            DriveMotion::Prescribed { law: MotionLaw::Ramp { .. }, .. } => {
                vec![law("speed", rates), law("time", &TIME)]
            }
            DriveMotion::Prescribed { law: MotionLaw::Cycloidal { .. }, .. } => {
                vec![law("to", family).map(|to| &to - start), law("time", &TIME)]
            }
            DriveMotion::Prescribed { law: MotionLaw::Curve(curve), .. } => match curve.as_ref() {
                Curve::Harmonic { .. } => {
                    let phase = law("phase", &ANGLE).unwrap_or_default();
                    vec![law("amplitude", family), law("period", &TIME), Some(phase)]
                }
                Curve::Table(_) => {
                    for point in part.list("points") {
                        for key in [("time", &TIME), ("angle", family), ("slide", family)] {
                            if let Some(own) = self.quantity(&point, key.0, &[key.1], KeySort::Law) {
                                self.put_untold(&own, &part.path);
                            }
                        }
                    }
                    Vec::new()
                }
                Curve::Formula(_) => {
                    let text = part.text("formula").unwrap_or_default().to_string();
                    self.put_named(&text, &format!("{}.formula", part.path));
                    Vec::new()
                }
            },
        }
    }
}
