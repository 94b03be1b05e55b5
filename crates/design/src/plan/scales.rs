//! Choice of the scales: by a scale factor, by the length of a vector or a distance on paper, or by the crank.
//!
//! The scale of the crank is mu_v = omega mu_l and mu_a = omega^2 mu_l.
//! At this scale, three lengths on paper are equal: the crank, the velocity of the crank pin, and its normal
//! acceleration.

use super::names::pair;
use super::planner::Plans;
use super::vectors::{Quantity, VectorPlan};
use crate::sentences;
use linkage::case::Case;
use linkage::error::{Error, ErrorKind, Result};
use linkage::input::Input;
use linkage::math::corners;
use linkage::solver::State;

/// Smallest and largest permitted size of a drawing on paper (mm). A smaller drawing is not legible, and a larger
/// drawing fits on no sheet.
const SIZES: [f64; 2] = [1.0, 2000.0];

/// A chosen scale.
#[derive(Clone, Debug, PartialEq)]
pub enum PlanScale {
    /// Scale factor mu_l of the kinematic diagram (m/mm).
    Drawing(f64),
    /// Scale factor of a plan: mu_v ((m/s)/mm) or mu_a ((m/s^2)/mm).
    Plan(Quantity, f64),
    /// The scale of the crank: mu_v and mu_a follow from mu_l and the speed of the crank.
    Crank,
    /// Length on paper (mm) of a vector, such as pa, v_B or a_BA^n, or of the distance between two points, such as OA.
    Length(String, f64),
}

impl PlanScale {
    /// Reads `mu_l=0.001`, `mu_v=0.02`, `mu_a=5`, `1:2`, `crank` or `pa=100mm`.
    ///
    /// # Errors
    /// A message that names the expected form.
    pub fn read(text: &str) -> std::result::Result<Self, String> {
        let positive = |number: &str| number.trim().parse::<f64>().ok().filter(|own| *own > 0.0 && own.is_finite());
        if text == "crank" {
            return Ok(PlanScale::Crank);
        }
        if let Some((paper, world)) = text.split_once(':') {
            let (paper, world) = (positive(paper), positive(world));
            let ratio = paper.zip(world).map(|(paper, world)| 1e-3 * world / paper);
            return ratio.map(PlanScale::Drawing).ok_or_else(|| sentences::EXPECTED_TWO_NUMBERS_SUCH_AS.into());
        }
        let Some((name, value)) = text.split_once('=') else { return Err(sentences::EXPECTED_A_SCALE.into()) };
        let (name, value) = (name.trim(), value.trim());
        let factor = |units: &[&str]| {
            let bare = units.iter().find_map(|unit| value.strip_suffix(unit)).unwrap_or(value);
            positive(bare).ok_or_else(|| sentences::expected_a_scale_factor(&name, &units[0]))
        };
        let of = |quantity: Quantity, more: &str| {
            let unit = format!("({})/mm", quantity.unit());
            Ok(PlanScale::Plan(quantity, factor(&[&unit, more])?))
        };
        match name {
            "mu_l" => factor(&["m/mm"]).map(PlanScale::Drawing),
            "mu_v" => of(Quantity::Velocity, "m/s/mm"),
            "mu_a" => of(Quantity::Acceleration, "(m/s²)/mm"),
            _ => {
                let mm = positive(value.strip_suffix("mm").unwrap_or(value));
                let mm = mm.ok_or_else(|| sentences::expected_a_length_on_paper(&name))?;
                Ok(PlanScale::Length(name.into(), mm))
            }
        }
    }
}

impl Plans {
    /// Draws the plans at the chosen scales.
    /// Drawings for which no scale is chosen keep their present scale.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] for an unknown vector, for a vector of zero length, for two scales of one drawing, for
    /// [`PlanScale::Crank`] if the crank does not turn, and for a drawing that would be too small or too large.
    pub fn scaled(mut self, case: &Case, state: &State, wishes: &[PlanScale]) -> Result<Plans> {
        let mut drawing = None;
        let mut plans = [None; 2];
        for wish in wishes {
            match wish {
                PlanScale::Crank => {}
                PlanScale::Drawing(scale) => put(&mut drawing, *scale, "mu_l")?,
                PlanScale::Plan(quantity, scale) => self.put_plan(&mut plans, *quantity, *scale)?,
                PlanScale::Length(name, mm) => match (self.vector(name), self.distance(name)) {
                    (Some((quantity, size)), _) => {
                        self.put_plan(
                            &mut plans,
                            quantity,
                            length(name, size, self.plan_of(quantity).longest(), *mm)?,
                        )?;
                    }
                    (None, Some(size)) => put(&mut drawing, length(name, size, size, *mm)?, "mu_l")?,
                    (None, None) => return Err(self.unknown(name)),
                },
            }
        }
        if let Some(scale) = drawing {
            let [low, high] = corners(self.scheme.points.iter().map(|(_, at)| *at));
            check("mu_l", (high - low).norm(), scale)?;
            for scheme in [&mut self.scheme].into_iter().chain(self.centres.as_mut().map(|sheet| &mut sheet.scheme)) {
                scheme.redraw(case, state, scale);
            }
        }
        if wishes.contains(&PlanScale::Crank) {
            let omega = match case.crank().input {
                Input::Angle | Input::Turn => state.motions[self.scheme.driver].omega.abs(),
                Input::Slide => 0.0,
            };
            if !(omega > 0.0) {
                return Err(Error::new(ErrorKind::Input, sentences::THE_CRANK_DOES_NOT_TURN_SO_ITS_SCALE)
                    .help(sentences::GIVE_A_SCALE_FACTOR_OR_A_LENGTH));
            }
            for (quantity, power) in Quantity::ALL.into_iter().zip([1, 2]) {
                self.put_plan(&mut plans, quantity, omega.powi(power) * self.scheme.scale)?;
            }
        }
        for (quantity, scale) in Quantity::ALL.into_iter().zip(plans) {
            let Some(scale) = scale else { continue };
            let plan = match quantity {
                Quantity::Velocity => &mut self.velocity,
                Quantity::Acceleration => &mut self.acceleration,
            };
            check(&format!("mu_{}", quantity.symbol()), plan.longest(), scale)?;
            plan.scale = scale;
        }
        Ok(self)
    }

    fn plan_of(&self, quantity: Quantity) -> &VectorPlan {
        quantity.of(&self.velocity, &self.acceleration)
    }

    fn put_plan(&self, plans: &mut [Option<f64>; 2], quantity: Quantity, scale: f64) -> Result<()> {
        put(&mut plans[quantity.of(0, 1)], scale, &format!("mu_{}", quantity.symbol()))
    }

    /// Quantity and magnitude (SI) of a vector. `name` is the name of the vector, such as `v_A`, or the letters of the
    /// pole and of the vector's end, such as `pa`.
    fn vector(&self, name: &str) -> Option<(Quantity, f64)> {
        Quantity::ALL.into_iter().find_map(|quantity| {
            let plan = self.plan_of(quantity);
            let spelt = |from: &str, to: &str| name.strip_prefix(from) == Some(to);
            let mut all = plan.vectors.iter();
            let found = all.find(|own| own.name == name || own.from == quantity.pole() && spelt(&own.from, &own.to))?;
            Some((quantity, found.value.norm()))
        })
    }

    /// Distance (m) between two points. `name` joins the names of the points, such as `OA`.
    fn distance(&self, name: &str) -> Option<f64> {
        let points = &self.scheme.points;
        let mut pairs = points.iter().flat_map(|one| points.iter().map(move |other| (one, other)));
        let (one, other) = pairs.find(|(one, other)| pair(&one.0, &other.0) == name)?;
        Some((other.1 - one.1).norm())
    }

    fn unknown(&self, name: &str) -> Error {
        let poles = Quantity::ALL.into_iter().flat_map(|quantity| {
            let vectors = self.plan_of(quantity).vectors.iter().filter(move |own| own.from == quantity.pole());
            vectors.map(|own| format!("{}{}", own.from, own.to))
        });
        let mut names: Vec<String> = poles.collect();
        names.dedup();
        Error::new(ErrorKind::Input, sentences::no_vector_and_no_side_is_called(&name))
            .help(sentences::name_a_vector_or_a_side(&names.join(", ")))
    }
}

/// Stores the scale of a drawing in `place`. A second scale of the same drawing is an error.
fn put(place: &mut Option<f64>, scale: f64, symbol: &str) -> Result<()> {
    match place.replace(scale) {
        None => Ok(()),
        Some(_) => Err(Error::new(ErrorKind::Input, sentences::is_given_twice(&symbol))
            .help(sentences::GIVE_ONE_SCALE_FOR_EACH_DRAWING)),
    }
}

/// The scale factor at which a vector of the magnitude `size` (SI) is `mm` long on paper. `longest` is the plan's
/// longest vector.
fn length(name: &str, size: f64, longest: f64, mm: f64) -> Result<f64> {
    // A vector below a billionth of the longest vector is a rounding error.
    if size > 1e-9 * longest {
        return Ok(size / mm);
    }
    Err(Error::new(ErrorKind::Input, sentences::has_no_length_here(&name, &mm))
        .help(sentences::NAME_ANOTHER_VECTOR_OR_INSTANT))
}

/// Checks the size on paper of a drawing whose longest vector or diagonal is `longest` (SI).
fn check(symbol: &str, longest: f64, scale: f64) -> Result<()> {
    let [least, most] = SIZES;
    let paper = longest / scale;
    if longest == 0.0 || paper >= least && paper <= most {
        return Ok(());
    }
    let [from, to] = [longest / most, longest / least].map(drawing::paper::style::significant);
    let message = sentences::the_drawing_would_be_mm_large(&symbol, &scale, &paper);
    Err(Error::new(ErrorKind::Input, message).help(sentences::give_a_scale_factor_from_to(&symbol, &from, &to)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_are_read_with_and_without_units() {
        let read = |text: &str| PlanScale::read(text).unwrap();
        for text in ["mu_v=0.02", "mu_v = 0.02 (m/s)/mm", "mu_v=0.02m/s/mm"] {
            assert_eq!(read(text), PlanScale::Plan(Quantity::Velocity, 0.02), "{text}");
        }
        assert_eq!(read("mu_a=5(m/s^2)/mm"), PlanScale::Plan(Quantity::Acceleration, 5.0));
        assert_eq!([read("mu_l=0.002 m/mm"), read("1:2")], [PlanScale::Drawing(0.002), PlanScale::Drawing(0.002)]);
        assert_eq!(read("pa = 100 mm"), PlanScale::Length("pa".into(), 100.0));
        assert_eq!([read("a_BA^n=20"), read("crank")], [PlanScale::Length("a_BA^n".into(), 20.0), PlanScale::Crank]);
    }

    #[test]
    fn impossible_scales_are_refused() {
        for text in ["", "0.02", "pa", "pa=0", "pa=-3mm", "pa=nan", "mu_v=0", "mu_v=5kg", "mu_l=1e999", "1:0", "a:2"] {
            assert!(PlanScale::read(text).unwrap_err().starts_with("expected "), "{text}");
        }
    }
}
