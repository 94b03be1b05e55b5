//! Constant columns.
//! If the other columns of a file omit trailing zeros, a `0` is taken to have as many digits as their numbers.
//! If no other column omits trailing zeros, a `0` may be a rounded value.

use super::digits::Format;
use super::{scenario, solved};
use prover::compare::{ComparisonRule, PartyComparison};
use prover::tables::load;

/// Compares channels of a scenario in the given formats.
/// If a number is given, it replaces all values of the column.
fn compared(name: &str, columns: &[(&str, Format, Option<f64>)]) -> PartyComparison {
    let scenario = scenario(name);
    let right = solved(&scenario);
    let mut text = format!("t_s,{}\n", columns.iter().map(|(name, ..)| *name).collect::<Vec<_>>().join(","));
    for row in 0..right.times().len() {
        text += &format!("{}", right.times()[row]);
        for (name, format, instead) in columns {
            text += &format!(",{}", format.print(instead.unwrap_or(right.named(name).unwrap()[row])));
        }
        text += "\n";
    }
    let directory = tempfile::TempDir::new().unwrap();
    let path = directory.path().join("printed.csv");
    std::fs::write(&path, text).unwrap();
    super::against(&scenario, &load(&path).unwrap(), &ComparisonRule::default())
}

fn words(name: &str, columns: &[(&str, Format, Option<f64>)]) -> Vec<&'static str> {
    compared(name, columns).pairs[0].channels.iter().map(|own| own.verdict.word()).collect()
}

const NINE: Format = Format::General(9);

/// Constant columns: a guide without a moment, a link that only translates, a constant speed.
/// The constant values are printed as `0` and `30` in every format.
#[test]
fn structural_constants_agree_in_every_format() {
    for (format, constant) in [(NINE, NINE), (Format::Shortest, Format::Shortest), (Format::Fixed(6), Format::Fixed(0))]
    {
        let found = compared(
            "scotch_yoke",
            &[
                ("link.block.x_m", format, None),
                ("link.crank.ay_m_s2", format, None),
                ("link.yoke.omega_rad_s", constant, None),
                ("joint.slot.moment_N_m", constant, None),
                ("link.crank.alpha_rad_s2", constant, None),
                ("link.crank.omega_rad_s", constant, None),
                ("link.block.angle_rad", format, None),
            ],
        );
        for own in &found.pairs[0].channels {
            assert_eq!(own.verdict.word(), "agree", "{format:?} {}: {:?}", own.claim.text, own.verdict);
        }
    }
}

/// If the other columns omit trailing zeros, a `0` is taken to have as many digits as their numbers, so a wrong `0`
/// disagrees.
/// If the other columns have fixed decimals, `0` may be the rounded form of any value below 0.5.
#[test]
fn wrong_constants_disagree_only_where_they_are_exact() {
    let of = |format, constant| {
        words(
            "crank_rocker",
            &[
                ("link.rocker.omega_rad_s", format, None),
                ("link.coupler.alpha_rad_s2", format, None),
                ("point.A.x_m", constant, Some(0.0)),
                ("point.B.vx_m_s", constant, Some(1.0)),
            ],
        )
    };
    assert_eq!(of(NINE, NINE), ["agree", "agree", "disagree", "disagree"]);
    assert_eq!(of(Format::Shortest, Format::Shortest), ["agree", "agree", "disagree", "disagree"]);
    // The columns that vary have nine decimals, the constant columns have none.
    assert_eq!(of(Format::Fixed(9), Format::Fixed(0))[..3], ["agree", "agree", "inconclusive"]);
}
