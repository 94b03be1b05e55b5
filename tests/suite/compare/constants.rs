//! Columns of one number throughout: exact where the file leaves out zeros, and of unknown digits where it does not.

use super::digits::Format;
use super::{scenario, solved};
use prover::compare::{ComparisonRule, PartyComparison};
use prover::tables::load;

/// A scenario's channels in some formats, one column replaced by numbers of another.
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

/// A joint without a guide, links that only translate, a constant speed; `0`, `0.0` by Python, `30`.
#[test]
fn what_is_constant_by_structure_agrees_in_every_format() {
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

/// A force in place of which `0` stands was forgotten, if `0` is exact; rounded to whole numbers it may be any below a
/// half.
#[test]
fn a_zero_or_a_constant_that_is_wrong_is_found_where_it_is_exact_and_open_where_it_is_not() {
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
    // Each column with other decimals.
    assert_eq!(of(Format::Fixed(9), Format::Fixed(0))[..3], ["agree", "agree", "inconclusive"]);
}
