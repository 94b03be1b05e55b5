//! Printed numbers, and what stands beside those that are known to be wrong.

use super::printed::{MOST_DIGITS, Printed};
use super::reader::Table;
use linkage::error::Result;

/// `value` and `digits` of a number in the scenario itself. TOML does not keep the printed text.
pub(super) fn number(entry: &mut Table) -> Result<Printed> {
    let value = entry.number("value")?;
    let digits = digits(entry)?;
    Ok(Printed::with_digits(value, digits))
}

/// Why a printed number is wrong, and the correct number, in the printed unit.
pub(super) struct Correction {
    pub finding: String,
    pub right: Printed,
}

impl Correction {
    /// Reads the keys `finding` and `right`, which belong together; `None` without them.
    pub fn read(entry: &mut Table, printed: &Printed) -> Result<Option<Self>> {
        let Some(finding) = finding(entry)? else { return Ok(None) };
        let mut table = entry.table("right")?;
        let right = table.read(|table| {
            let right = number(table)?;
            table.finish()?;
            Ok(right)
        })?;
        check_apart(entry, printed, &right)?;
        Ok(Some(Correction { finding, right }))
    }
}

/// Reads the anchor under the key `finding`, which needs the key `right` beside it.
pub(super) fn finding(entry: &mut Table) -> Result<Option<String>> {
    let finding = entry.optional_string("finding")?;
    let help = "a number known to be wrong has a `finding`, which says why, and the number that is `right` instead: \
                `right = { value = 2.6, digits = 1 }`";
    match (finding, entry.has("right")) {
        (Some(finding), true) => Ok(Some(finding)),
        (None, false) => Ok(None),
        (Some(_), false) => Err(entry.lacks(&["right"], help)),
        (None, true) => Err(entry.lacks(&["finding"], help)),
    }
}

/// Refuses a correct number so close to the printed one that one number could agree with both.
pub(super) fn check_apart(entry: &Table, printed: &Printed, right: &Printed) -> Result<()> {
    if (printed.value - right.value).abs() > printed.half_unit() + right.half_unit() {
        return Ok(());
    }
    let message = format!(
        "{} with {} decimals is not apart from the printed {} with {}",
        right.value, right.digits, printed.value, printed.digits
    );
    let help = "give the right number with more decimals, or take `finding` and `right` out if the printed one holds";
    entry.refuse("right", message, help)
}

/// The count of printed decimals under the key `digits`.
pub(super) fn digits(entry: &mut Table) -> Result<i32> {
    let digits = entry.integer("digits")?;
    match i32::try_from(digits) {
        Ok(digits) if digits.abs() <= MOST_DIGITS => Ok(digits),
        _ => entry.refuse(
            "digits",
            format!("found {digits}, but no number is printed with as many decimals"),
            format!("give the count of printed decimals, from {} to {MOST_DIGITS}", -MOST_DIGITS),
        ),
    }
}
