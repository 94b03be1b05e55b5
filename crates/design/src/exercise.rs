//! Exercises: one mechanism with different numbers for every student, and the positions at which answers are required.
//!
//! Numbers are drawn evenly around the numbers of the scenario, and rounded to few digits.
//! A draw is kept only if the mechanism covers the motion of the original and keeps away from singular poses.
//! Every student has a random stream (ChaCha, by Bernstein), so the numbers of one student do not depend on the number
//! of students.

use crate::sentences;
use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use std::f64::consts::TAU;
use std::path::Path;

use analytic::range::{Extent, Range};
use linkage::case::Case;
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::KeepNan;
use scenario::Scenario;
use scenario::varied::{NumberSort, VariedNumber, varied_numbers, with_numbers};

/// How numbers are drawn.
#[derive(Clone, Debug)]
pub struct VariationWish {
    /// Seed of all random numbers.
    pub seed: u64,
    /// Largest change of a number, as a fraction of the number.
    pub share: f64,
    /// The numbers that are changed.
    pub sorts: Vec<NumberSort>,
    /// Smallest transmission angle (rad). The lower limit of each group's determinant is the sine of this angle.
    /// The limit is lower for a group whose determinant is small in the original: three quarters of its smallest value.
    pub transmission: f64,
}

/// Largest number of draws for one student.
const DRAWS: usize = 400;
/// A group's determinant may always fall to this fraction of the group's smallest determinant in the original.
/// In [`positions`], it may fall to this fraction of the group's largest determinant.
const KEPT: f64 = 0.75;

/// The mechanism from which exercises are made, with the limits that all exercises keep.
pub struct ExerciseMechanism {
    scenario: Scenario,
    numbers: Vec<VariedNumber>,
    /// Whether the crank turns fully.
    is_full: bool,
    /// Smallest permitted magnitude of each group's determinant in the exercises.
    limits: Vec<f64>,
}

/// The mechanism with the numbers of one student.
pub struct StudentMechanism {
    /// The scenario with the student's numbers.
    pub scenario: Scenario,
    /// Number of draws that were needed.
    pub draws: usize,
    /// Smallest magnitude of a determinant over the range of the grid.
    pub determinant: f64,
}

impl ExerciseMechanism {
    /// Finds the numbers to vary in the original `scenario`, and the limits of the exercises.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] if the motion does not follow from one crank angle.
    /// [`ErrorKind::Input`] if the file has no number of the requested sorts.
    /// The errors of [`Range::of`].
    pub fn of(scenario: Scenario, wish: &VariationWish) -> Result<ExerciseMechanism> {
        let name = &scenario.name;
        check_motion(&scenario)?;
        let mut numbers = varied_numbers(&scenario.text)?;
        numbers.retain(|own| wish.sorts.contains(&own.sort));
        if numbers.is_empty() {
            let sorts: Vec<&str> = wish.sorts.iter().map(|sort| sort.name()).collect();
            let message = sentences::no_numbers_of_of_this_sort(name, &sorts.join(", "));
            return Err(Error::new(ErrorKind::Input, message).help(sentences::WRITE_THE_NUMBERS_AS_NUMBERS));
        }
        let range = Range::of(&scenario.case)?;
        let limit = |own: f64| wish.transmission.sin().smaller(KEPT * own);
        let limits = smallest(&scenario.case, &range).into_iter().map(limit).collect();
        Ok(ExerciseMechanism { is_full: matches!(range.extent, Extent::FullTurn(_)), scenario, numbers, limits })
    }

    /// Draws the numbers of the student `student`, counted from 0.
    /// The numbers are drawn again until a draw keeps the limits.
    /// Each further draw stays closer to the original.
    ///
    /// # Errors
    /// [`ErrorKind::Geometry`] if no draw keeps the limits.
    pub fn drawn(&self, wish: &VariationWish, student: u64, name: &str) -> Result<StudentMechanism> {
        let mut random = ChaCha8Rng::seed_from_u64(wish.seed);
        random.set_stream(student);
        for draw in 0..DRAWS {
            let share = wish.share * (1.0 - draw as f64 / DRAWS as f64);
            let new = |own: &VariedNumber| own.sensible(own.value * (1.0 + share * (2.0 * even(&mut random) - 1.0)));
            let values: Vec<f64> = self.numbers.iter().map(new).collect();
            let numbers: Vec<(VariedNumber, f64)> = self.numbers.iter().cloned().zip(values).collect();
            let text = with_numbers(&self.scenario.text, name, &numbers)?;
            let parsed = Scenario::parse(&text, Path::new(&format!("{name}.toml")));
            let Some((scenario, determinant)) = parsed.ok().and_then(|found| self.kept(found)) else { continue };
            return Ok(StudentMechanism { scenario, draws: draw + 1, determinant });
        }
        let message = sentences::none_of_draws_of_keeps_the_range(&DRAWS, &self.scenario.name);
        Err(Error::new(ErrorKind::Geometry, message).help(sentences::DRAW_CLOSER_TO_THE_NUMBERS))
    }

    /// The scenario and its smallest determinant. `None` if the mechanism does not cover the motion of the original, or
    /// if a determinant is below its limit.
    fn kept(&self, scenario: Scenario) -> Option<(Scenario, f64)> {
        let range = Range::of(&scenario.case).ok()?;
        let covers = match &range.extent {
            Extent::FullTurn(_) => self.is_full,
            Extent::Limited([from, to]) => {
                !self.is_full && scenario.case.grid.inputs.iter().all(|at| (from.crank..=to.crank).contains(at))
            }
        };
        let own = smallest(&scenario.case, &range);
        let keeps = own.iter().zip(&self.limits).all(|(own, limit)| own >= limit);
        (covers && keeps).then(|| (scenario, own.iter().copied().fold(1.0, f64::smaller)))
    }
}

/// A number from 0 to 1: the upper 53 bits of a random draw.
fn even(random: &mut ChaCha8Rng) -> f64 {
    (random.next_u64() >> 11) as f64 / (1u64 << 53) as f64
}

/// Checks that the scenario has a single drive with constant prescribed speed.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for any other motion.
pub fn check_motion(scenario: &Scenario) -> Result<()> {
    let case = &scenario.case;
    let has_one = case.drives.further().is_empty() && case.crank().constant_speed().is_some() && !case.is_free();
    if has_one {
        return Ok(());
    }
    let message = sentences::the_motion_of_is_not_one_of_a_crank(&scenario.name);
    Err(Error::new(ErrorKind::Unsupported, message).help(sentences::GIVE_A_SCENARIO_WITH_ONE_PRESCRIBED_DRIVE))
}

/// Smallest magnitude of each group's determinant over the range of the case's grid.
fn smallest(case: &Case, range: &Range) -> Vec<f64> {
    let mut least = vec![1.0; case.structure.groups.len()];
    for sample in range.samples.iter().filter(|sample| is_covered(case, range, sample.crank)) {
        least.iter_mut().zip(&sample.groups).for_each(|(least, own)| *least = least.smaller(own.determinant.abs()));
    }
    least
}

/// Whether a crank angle (rad) lies within the grid. If the crank turns fully, every angle lies within the grid.
fn is_covered(case: &Case, range: &Range, crank: f64) -> bool {
    let [low, high] = ends(&case.grid.inputs);
    matches!(range.extent, Extent::FullTurn(_)) || (low..=high).contains(&crank)
}

fn ends(values: &[f64]) -> [f64; 2] {
    let over = |start: f64, pick: fn(f64, f64) -> f64| values.iter().copied().fold(start, pick);
    [over(f64::INFINITY, f64::smaller), over(f64::NEG_INFINITY, f64::larger)]
}

/// The positions of the crank (rad) at which answers are required: the start, then angles evenly spread over the grid.
/// Each position is a whole number of degrees from the start, and all determinants are at least their limits there.
/// Of such positions, the one nearest to the evenly spread angle is chosen.
/// The limit of a group's determinant is the sine of `transmission` (rad), but at most three quarters of the group's
/// largest determinant.
///
/// # Errors
/// [`ErrorKind::Geometry`] if the grid has too few such poses. The errors of [`Range::of`].
pub fn positions(scenario: &Scenario, count: usize, transmission: f64) -> Result<Vec<f64>> {
    let case = &scenario.case;
    let range = Range::of(case)?;
    let [low, high] = ends(&case.grid.inputs);
    let is_full = matches!(range.extent, Extent::FullTurn(_)) && high - low > TAU - 1e-6;
    let start = case.crank().start;
    let limits: Vec<f64> = (0..case.structure.groups.len())
        .map(|group| range.samples.iter().map(|own| own.groups[group].determinant.abs()).fold(0.0, f64::larger))
        .map(|largest| transmission.sin().smaller(KEPT * largest))
        .collect();
    let is_good = |crank: f64| {
        let away = |other: f64| match is_full {
            true => (other - crank - TAU * ((other - crank) / TAU).round()).abs(),
            false => (other - crank).abs(),
        };
        let near = range.samples.iter().min_by(|a, b| away(a.crank).total_cmp(&away(b.crank)));
        near.is_some_and(|near| near.groups.iter().zip(&limits).all(|(own, limit)| own.determinant.abs() >= *limit))
    };
    // The crank angles of the grid that are a whole number of degrees from the start.
    let degree = TAU / 360.0;
    let mut free: Vec<f64> = (((low - start) / degree).ceil() as i64..=((high - start) / degree).floor() as i64)
        .map(|step| (start.to_degrees() + step as f64).to_radians())
        .filter(|&crank| is_good(crank) && !(is_full && crank > high - 0.5 * degree))
        .collect();
    let wanted = (0..count).map(|place| match (place, is_full) {
        (0, _) => start,
        (_, true) => low + (start - low + (high - low) * place as f64 / count as f64).rem_euclid(high - low),
        (_, false) => low + (high - low) * (place as f64 - 0.5) / (count as f64 - 1.0),
    });
    let mut found = Vec::with_capacity(count);
    for wanted in wanted {
        let near = (0..free.len()).min_by(|&a, &b| (free[a] - wanted).abs().total_cmp(&(free[b] - wanted).abs()));
        let Some(near) = near else {
            let message = sentences::has_too_few_poses_for_positions(&scenario.name, &count);
            return Err(Error::new(ErrorKind::Geometry, message).help(sentences::ASK_FOR_FEWER_POSITIONS));
        };
        found.push(free.remove(near));
    }
    Ok(found)
}

/// The exercise with the original numbers of the scenario. Published numbers and formulas are left out.
///
/// # Errors
/// The errors of [`check_motion`], of [`with_numbers`] and of reading its result.
pub fn as_given(scenario: &Scenario, name: &str) -> Result<Scenario> {
    check_motion(scenario)?;
    let text = with_numbers(&scenario.text, name, &[])?;
    Scenario::parse(&text, Path::new(&format!("{name}.toml")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wish(seed: u64) -> VariationWish {
        let sorts = vec![NumberSort::Lengths, NumberSort::Speed];
        VariationWish { seed, share: 0.2, sorts, transmission: 20f64.to_radians() }
    }

    #[test]
    fn a_student_has_the_same_numbers_in_every_class() {
        let original =
            ExerciseMechanism::of(fixtures::of_repository("scenarios/crank_rocker.toml"), &wish(17)).unwrap();
        let text = |seed, student| original.drawn(&wish(seed), student, "s").unwrap().scenario.text;
        assert_eq!(text(17, 3), text(17, 3));
        assert!(text(17, 3) != text(17, 4) && text(17, 3) != text(18, 3));
    }

    #[test]
    fn positions_stay_away_from_singular_poses() {
        // The given pose of variant 13 is singular: the rod is perpendicular to the guide.
        let scenario = fixtures::of_repository("scenarios/variants60/variant_13.toml");
        let limit = 12f64.to_radians();
        let found = positions(&scenario, 4, limit).unwrap();
        assert_eq!(found.len(), 4);
        for crank in &found {
            let degrees = crank.to_degrees();
            assert!((33.0..=148.0).contains(&degrees) && (degrees - degrees.round()).abs() < 1e-9, "{degrees}");
        }
        assert!(positions(&scenario, 400, limit).is_err());
    }
}
