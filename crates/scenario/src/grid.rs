//! `[grid]`: the instants at which a solution is requested.

use crate::sentences;
use std::cmp::Ordering;

use super::keys::key::{Section, ValueKind, optional};
use super::reader::{Sign, TomlTable};
use super::unit::{TIME, UnitFamily, of_input};
use linkage::case::Grid;
use linkage::drive::Drives;
use linkage::error::Result;

/// Descriptions of the keys that this module reads.
pub const SECTIONS: &[Section] = &[Section::at("grid").with(&[
    optional("from", ValueKind::INPUTS_OR_TIMES, "given with `to` and `step`")
        .means("first input, or first time from the start"),
    optional("to", ValueKind::INPUTS_OR_TIMES, "given with `from`")
        .means("last input or time, in the same kind of unit"),
    optional("step", ValueKind::INPUTS_OR_TIMES, "given with `from`")
        .means("distance between instants; may be negative"),
    optional("angles", ValueKind::LIST_OF_ANGLES, "a range")
        .means("crank angles, one by one, in any order; not for a free motion"),
    optional("slides", ValueKind::LIST_OF_LENGTHS, "a range")
        .means("slides, one by one, in any order; not for a free motion"),
    optional("times", ValueKind::LIST_OF_TIMES, "a range").means("times, one by one, in any order"),
])];

/// Largest number of points of a range.
pub const MOST: usize = 1_000_000;

/// Points `from + k * step` (k = 0, 1, ...) up to `to`. The step may be negative.
/// `to` is included if its distance from a point is at most 1e-9 steps.
///
/// # Errors
/// A message if a number is not finite, if the step is zero or leads away from `to`, or if there would be more than a
/// million points.
pub fn range(from: f64, to: f64, step: f64) -> std::result::Result<Vec<f64>, String> {
    if ![from, to, step].into_iter().all(f64::is_finite) {
        return Err(sentences::the_range_from_to_by_is_not_finite(&from, &to, &step));
    }
    if step == 0.0 {
        return Err(sentences::THE_STEP_MUST_NOT_BE_ZERO.into());
    }
    let steps = (to - from) / step;
    if steps < 0.0 {
        let way = if step > 0.0 { "positive" } else { "negative" };
        return Err(sentences::a_step_leads_away_from_the_end(&way));
    }
    let last = (steps + 1e-9).floor();
    if last >= MOST as f64 {
        return Err(sentences::the_range_has_more_than_points(&MOST));
    }
    Ok((0..=last as usize).map(|k| from + k as f64 * step).collect())
}

/// Checks the values of a list of instants.
///
/// # Errors
/// A message if the list is empty or too long, or if a value occurs twice.
pub fn listed(values: Vec<f64>) -> std::result::Result<Vec<f64>, String> {
    if values.is_empty() {
        return Err(sentences::THE_LIST_IS_EMPTY.into());
    }
    if values.len() > MOST {
        return Err(sentences::the_list_has_more_than_values(&MOST));
    }
    let mut order: Vec<usize> = (0..values.len()).collect();
    // The sort is stable: of two equal values, the value that is earlier in the list comes first.
    order.sort_by(|&a, &b| values[a].partial_cmp(&values[b]).unwrap_or(Ordering::Equal));
    match order.windows(2).find(|pair| values[pair[0]] == values[pair[1]]) {
        Some(pair) => Err(sentences::values_and_of_the_list_are_the_same(&(pair[0] + 1), &(pair[1] + 1))),
        None => Ok(values),
    }
}

/// The grid of a scenario, by input (crank angle or slide) or by time: a range or a list.
/// If `is_replaced`, the grid is read but not checked against the drive, and the returned grid is empty.
pub fn read(table: &mut TomlTable, drives: &Drives, is_replaced: bool) -> Result<Grid> {
    let [angles, slides, times] = ["angles", "slides", "times"]
        .map(|key| Ok(table.optional_si_list(key)?.map(|(family, values)| (key, family, values))));
    let lists: Vec<_> = [angles?, slides?, times?].into_iter().flatten().collect();
    let ranged = table.optional_si_of("from")?;
    let (family, points) = match (ranged, lists.as_slice()) {
        (None, [(key, family, values)]) => {
            let help = sentences::GIVE_EVERY_INSTANT_ONCE_FOR_EXAMPLE;
            (*family, listed(values.clone()).or_else(|message| table.refuse(key, message, help))?)
        }
        (Some((family, _)), []) if !std::ptr::eq(family, &TIME) && drives.crank().is_free() && has_times(table) => {
            let message = sentences::A_FREE_MOTION_HAS_NO_GRID_OF_INPUTS;
            return table.refuse("from", message, sentences::GIVE_THE_GRID_BY_TIME_FROM_TO_STEP);
        }
        (Some((family, from)), []) => (family, ranged_points(table, family, from)?),
        (None, []) => {
            let keys = ["from_deg", "from_rad", "from_s", "from_ms", "angles_deg", "angles_rad", "times_s", "times_ms"];
            return Err(table.lacks(&keys, sentences::A_GRID_GOES_BY_CRANK_ANGLE));
        }
        (_, [.., (key, _, _)]) => {
            return table.refuse(key, sentences::THE_GRID_IS_GIVEN_TWICE, sentences::KEEP_ONE_OF_A_RANGE_FROM_TO_STEP);
        }
    };
    table.finish()?;
    if is_replaced {
        return Ok(Grid::default());
    }
    let drive = drives.crank();
    let by_input = !std::ptr::eq(family, &TIME);
    if by_input && !std::ptr::eq(family, of_input(drive.input)) {
        let message = sentences::the_grid_has_units_of_but_the_input_is(&family.noun, &drive.input.noun());
        return Err(table.fault(message).help(sentences::give_the_grid_in(&drive.input.shown_in().0)));
    }
    let grid = if by_input { Grid::of_inputs(drive, points) } else { Grid::of_times(drive, points) };
    let help = match by_input && drive.is_free() {
        true => sentences::GIVE_THE_GRID_BY_TIME_FROM_TO_STEP,
        false => sentences::CHECK_THE_UNIT_AND_SIZE_OF_THE_GRID,
    };
    grid.check(drives).map_err(|message| table.fault(message).help(help))?;
    Ok(grid)
}

/// Whether end or step of a range is a time.
fn has_times(table: &TomlTable) -> bool {
    ["to", "step"].iter().any(|key| TIME.all_keys(key).iter().any(|spelling| table.has(spelling)))
}

fn ranged_points(table: &mut TomlTable, family: &'static UnitFamily, from: f64) -> Result<Vec<f64>> {
    let to = table.quantity("to", family, Sign::Any)?;
    let step = table.quantity("step", family, Sign::NotZero)?;
    range(from, to, step).or_else(|message| table.refuse("step", message, sentences::CHECK_FROM_TO_AND_THE_SIZE))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grid_points_accumulate_no_rounding_and_include_the_end() {
        let points = range(0.0, 1.0, 0.1).unwrap();
        assert_eq!((points.len(), points[3]), (11, 3.0 * 0.1));
        assert_eq!(range(0.0, 0.95, 0.1).unwrap().len(), 10);
        assert_eq!(range(1.0, -1.0, -0.5).unwrap(), [1.0, 0.5, 0.0, -0.5, -1.0]);
        assert_eq!(range(2.0, 2.0, -3.0).unwrap(), [2.0]);
    }

    #[test]
    fn a_turn_by_degrees_has_361_points() {
        assert_eq!(range(0.0, 360f64.to_radians(), 1f64.to_radians()).unwrap().len(), 361);
        assert_eq!(range(0.0, -360f64.to_radians(), -1f64.to_radians()).unwrap().len(), 361);
    }

    #[test]
    fn lists_keep_their_order_and_refuse_duplicates() {
        assert_eq!(listed(vec![0.3, 0.0, 0.1]), Ok(vec![0.3, 0.0, 0.1]));
        assert!(listed(Vec::new()).unwrap_err().contains("empty"));
        assert!(listed(vec![0.1, 0.2, 0.1]).unwrap_err().contains("values 1 and 3"));
        assert!(listed(vec![0.0, -0.0]).unwrap_err().contains("values 1 and 2"));
    }

    #[test]
    fn invalid_ranges_are_refused() {
        assert!(range(0.0, 1.0, 0.0).unwrap_err().contains("zero"));
        assert!(range(0.0, 1.0, -0.1).unwrap_err().contains("negative step"));
        assert!(range(1.0, 0.0, 0.1).unwrap_err().contains("positive step"));
        assert!(range(0.0, f64::NAN, 0.1).unwrap_err().contains("not finite"));
        assert!(range(0.0, 1.0, 1e-6).unwrap_err().contains("more than 1000000"));
        assert_eq!(range(0.0, 0.999_999, 1e-6).unwrap().len(), MOST);
        assert!(range(-1e308, 1e308, 1e-300).unwrap_err().contains("more than"));
    }
}
