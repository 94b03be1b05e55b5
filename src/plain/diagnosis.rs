//! Diagnoses in words.

use super::cells::{counted, some};
use crate::sentences;
use linkage::trajectory::{Channel, Stage};
use prover::diagnosis::{
    Arm, CasePart, Change, DataSlip, Diagnosis, DisagreementCause, ErrorNature, FrameAxis, LateChannels, Over,
    PartChange, PartyStanding, Plain, Since,
};
use prover::numbers::{fixed, input_in, input_told, significant, told_apart, with_unit};

/// Column at which the text of a line begins.
pub const INDENT: usize = 12;

/// Note for a diagnosis whose search for a cause stopped at its work limit.
pub const CUT: &str = sentences::THE_SEARCH_FOR_A_CAUSE_ENDED;

/// Number of channels that are named; further channels are only counted.
const NAMED: usize = 3;

/// A diagnosis as lines of text, without a newline at the end.
#[must_use]
pub fn text(diagnosis: &Diagnosis) -> String {
    let mut text = sentences::diagnosis_of(&diagnosis.suspect);
    let mut line = |what: &str, told: String| {
        put!(text, "\n  {what:<10}{told}");
    };
    line("suspect", standing(&diagnosis.alone));
    if let Some(first) = diagnosis.since.first() {
        line("since", since(diagnosis, first));
    }
    let (wrong, solved) = (counted(diagnosis.since.len(), "channel"), diagnosis.solved);
    match &diagnosis.cause {
        None => {
            line("cause", sentences::nothing_simple_changed_cases_and_all(&solved));
        }
        Some(found) if diagnosis.is_explained() => {
            line("cause", sentences::that_explains_all_to_within(&cause(found), &wrong));
        }
        Some(found) => {
            line("cause", sentences::no_single_one_a_part_is_explained(&cause(found)));
            let left = &diagnosis.left_over;
            line("remaining", format!("{} of {wrong}: {}", left.len(), names(left)));
        }
    }
    if let Some(own) = diagnosis.nature {
        line("error", nature(own));
    }
    for one in &diagnosis.also {
        line("or", sentences::which_explains_as_much(&cause(one)));
    }
    text
}

/// Which parties disagree with each other, in words.
#[must_use]
pub fn standing(standing: &PartyStanding) -> String {
    match standing {
        PartyStanding::Together => sentences::NOBODY_EACH_IS_WITHIN_THE_BOUNDS.into(),
        PartyStanding::Alone(name) => sentences::all_others_agree_with_each(&name),
        PartyStanding::Camps([one, other]) => sentences::nobody_stand_against(&one.join(" and "), &other.join(" and ")),
        PartyStanding::Open(pairs) => {
            let pairs: Vec<String> = pairs.iter().map(|[one, other]| format!("{one} and {other}")).collect();
            sentences::cannot_be_told_differ(&pairs.join(", "))
        }
    }
}

fn since(diagnosis: &Diagnosis, first: &Since) -> String {
    let together: Vec<Channel> = diagnosis.first().iter().map(|one| one.channel.clone()).collect();
    let at = input_told(first.input.at(first.crank), 3);
    let mut told = sentences::at_time_first_in(&fixed(first.time, 6), &at, &names(&together));
    if let Some(next) = diagnosis.since.get(together.len()) {
        let at = input_in(next.input.at(next.crank), 3);
        put!(told, sentences::from_in(&fixed(next.time, 6), &at, &next.channel));
        let more = diagnosis.since.len() - together.len() - 1;
        if more > 0 {
            put!(told, sentences::and_later_in_more(&more));
        }
    }
    told
}

fn names(channels: &[Channel]) -> String {
    some(channels, NAMED)
}

/// A coordinate of a vector is shown as zero below this fraction of the vector's length.
const NOTHING: f64 = 1e-9;

/// A cause in words.
#[must_use]
pub fn cause(cause: &DisagreementCause) -> String {
    match cause {
        DisagreementCause::Values { slip: own, channels } => slip(own, channels),
        DisagreementCause::Case(own) => change(own),
    }
}

fn slip(slip: &DataSlip, channels: &[Channel]) -> String {
    let of = names(channels);
    let unit = channels.first().map_or("", |channel| channel.kind.unit.symbol());
    match slip {
        DataSlip::Plain(own) => plain(*own, &of),
        DataSlip::Unit { factor: _, told } => sentences::another_unit_in(&told, &of),
        DataSlip::Offset(by) => sentences::added_at_every_instant_to(&amount(*by, unit), &of),
        DataSlip::Mirrored(by) => sentences::counted_the_other_way_round(&of, &amount(*by, unit)),
        DataSlip::Instead(other) => sentences::the_values_of_in_place_of(&other, &of),
        DataSlip::Opposite(other) => sentences::the_values_of_with_the_opposite(&other, &of),
        DataSlip::Magnitude([one, other]) => sentences::the_magnitude_of_and_in_place(&one, &other, &of),
        DataSlip::Differences { of: other, order, over } => {
            let (order, over) = (if *order == 1 { "" } else { "second " }, rows_of(*over));
            sentences::differences_of_over_or_such_of_its_like(&order, &other, &over, &of)
        }
        DataSlip::NoCoriolis(joint) => sentences::the_coriolis_acceleration_of_the_block(&joint, &of),
        DataSlip::About(Arm::Constant(arm)) => {
            let least = NOTHING * arm[0].hypot(arm[1]);
            let [x, y] = arm.map(|own| number(if own.abs() < least { 0.0 } else { own }));
            sentences::about_another_point_by_away(&of, &x, &y)
        }
        DataSlip::About(Arm::Between(None, to)) => sentences::about_instead_of_the_origin(&of, &to),
        DataSlip::About(Arm::Between(Some(from), to)) => sentences::about_instead_of(&of, &to, &from),
        DataSlip::Outlier(time) => sentences::one_row_alone_at_in_an_outlier(&number(*time), &of),
        DataSlip::Clock { factor, told: Some(told) } => sentences::another_unit_of_time_times(&told, &number(*factor)),
        DataSlip::Clock { factor, told: None } => {
            let how = if *factor < 1.0 { "fast" } else { "slow" };
            let by = told_apart(factor.recip(), 1.0);
            sentences::the_clock_of_all_rows_is_too(&how, &by)
        }
        DataSlip::Exchanged([one, other]) => sentences::and_exchanged_2(&one, &other),
        DataSlip::Between { of: [first, second], offset: 0.0 } => {
            sentences::less_in_place_of_counted(&first, &second, &of)
        }
        DataSlip::Between { of: [first, second], offset } => {
            sentences::less_and_more_in_place_of_counted(&first, &second, &amount(*offset, unit), &of)
        }
        DataSlip::Factor(factor) => sentences::times_the_values_of(&number(*factor), &of),
        DataSlip::Late { by, steps, of: late } => {
            let (what, is_one) = match late {
                LateChannels::All => ("all channels".to_string(), false),
                LateChannels::OfStage(stage) => (stage.name().replace('_', " "), *stage == Stage::BalancingMoment),
                LateChannels::Explained => (of, channels.len() == 1),
            };
            let how = if *by >= 0.0 { "late" } else { "early" };
            let size = duration(by.abs());
            let steps = steps.map_or(String::new(), |(steps, told)| {
                let several = if steps.abs() > 1.0 { "s" } else { "" };
                format!(", {} {told}{several}", number(steps.abs()))
            });
            let are = if is_one { "is" } else { "are" };
            format!("{what} {are} {size}{steps} too {how}")
        }
    }
}

fn plain(slip: Plain, of: &str) -> String {
    match slip {
        Plain::Sign => sentences::the_opposite_sign_of(&of),
        Plain::Turns => sentences::whole_turns_too_much_or_too(&of),
        Plain::HalfTurns => sentences::half_turns_too_much_or_too(&of),
        Plain::Twice => sentences::twice_the_values_of(&of),
        Plain::Half => sentences::half_the_values_of(&of),
        Plain::Zero => sentences::zero_instead_of(&of),
        Plain::Size => sentences::the_sign_of_is_lost(&of),
        Plain::ArcSine => sentences::from_its_sine_beyond_a_quarter(&of),
        Plain::PerRadian => sentences::rates_per_radian_of_the_crank(&of),
        Plain::BeforeReducer => sentences::at_the_motor_shaft(&of),
    }
}

fn rows_of(over: Over) -> String {
    match over {
        Over::Either(1) => sentences::THE_ROW_BEFORE_AND_THE_ONE_BEHIND.into(),
        Over::Either(rows) => sentences::rows_before_and_behind(&rows),
        Over::Before => sentences::THE_ROW_AND_THE_ONE_BEFORE.into(),
        Over::Behind => sentences::THE_ROW_AND_THE_ONE_BEHIND.into(),
    }
}

/// A time in words: in ms below 0.1 s, otherwise in s.
fn duration(seconds: f64) -> String {
    if seconds < 0.1 { format!("{} ms", number(1e3 * seconds)) } else { format!("{} s", number(seconds)) }
}

/// Description of an error without a simple cause.
#[must_use]
pub fn nature(nature: ErrorNature) -> String {
    let percent = prover::numbers::percent;
    match nature {
        ErrorNature::Growing(power) => {
            let how = power.map_or(String::new(), |power| match power {
                1 => sentences::ABOUT_IN_PROPORTION_TO_IT.into(),
                power => sentences::about_with_its_power_of(&power),
            });
            sentences::the_error_grows_with_time(&how)
        }
        ErrorNature::Smooth(share) => sentences::the_error_is_smooth_at_most(&percent(share)),
        ErrorNature::Noise(share) => sentences::the_error_has_no_order_at_most(&percent(share)),
    }
}

/// A fitted amount with its unit; angles in degrees.
fn amount(by: f64, unit: &str) -> String {
    if unit == "rad" { format!("{} deg", number(by.to_degrees())) } else { with_unit(&number(by), unit) }
}

/// Describes a difference between two cases in words.
#[must_use]
pub fn change(change: &Change) -> String {
    let how = match &change.how {
        PartChange::Missing => "missing".into(),
        PartChange::Reversed => sentences::OF_THE_OPPOSITE_SIGN.into(),
        PartChange::Twice => "counted twice".into(),
        PartChange::Half => "counted half".into(),
        PartChange::Times(factor, told) => sentences::times_as_large(&number(*factor), &told),
        PartChange::AtJoint(joint) => sentences::at_joint(&joint),
        PartChange::AtPoint(point) => sentences::at_point(&point),
        PartChange::FromJoint([one, other]) => sentences::measured_from_the_wrong_end(&one, &other),
        PartChange::Across([one, other]) => sentences::mirrored_at_the_line_of_and(&one, &other),
        PartChange::Middle([one, other]) => sentences::in_the_middle_of_and(&one, &other),
        PartChange::Turned(by) => sentences::turned_by_deg(&number(by.to_degrees())),
        PartChange::AboutJoint(joint) => sentences::taken_about_joint_instead_of_the_mass(&joint),
        PartChange::Swapped => sentences::AND_EXCHANGED.into(),
        PartChange::Other(mode) => (*mode).to_string(),
        PartChange::Instead { found, given, unit } => {
            let (factor, unit) = if *unit == "rad" { (1f64.to_degrees(), "deg") } else { (1.0, *unit) };
            let [found, given] = [found, given].map(|value| factor * value);
            let [found, given] = [told_apart(found, given), number(given)].map(|own| with_unit(&own, unit));
            sentences::instead_of(&found, &given)
        }
    };
    format!("{}: {how}", part(&change.part))
}

fn part(part: &CasePart) -> String {
    let axis = |axis: &FrameAxis| match axis {
        FrameAxis::X => "x",
        FrameAxis::Y => "y",
    };
    match part {
        CasePart::Gravity => "gravity".into(),
        CasePart::InertiaForces => sentences::INERTIA_FORCES_OF_ALL_LINKS.into(),
        CasePart::Inertias => sentences::MOMENTS_OF_INERTIA_OF_ALL.into(),
        CasePart::Masses => sentences::MASSES_OF_ALL_LINKS.into(),
        CasePart::Inertia(link) => sentences::moment_of_inertia_of(&link),
        CasePart::Mass(link) => sentences::mass_of(&link),
        CasePart::Body(link) => sentences::mass_and_inertia_of(&link),
        CasePart::Weight(link) => sentences::weight_of(&link),
        CasePart::Inert(link) => sentences::inertia_forces_of(&link),
        CasePart::Length(one, other, link) => sentences::distance_of_and_on(&one, &other, &link),
        CasePart::MassCentre(link) => sentences::mass_centre_of_2(&link),
        CasePart::MassCentreAlong(link, along) => sentences::mass_centre_of(&link, &axis(along)),
        CasePart::Load(number, sort) => format!("load {number}, {}", sort.replace('_', " ")),
        CasePart::Free(number) => sentences::free_length_of_load_spring(&number),
        CasePart::Configuration(group) => sentences::another_configuration_of(&group),
        CasePart::Speed(joint) => sentences::speed_of_the_drive_at(&joint),
        CasePart::StartAngle(joint) => sentences::angle_of_the_drive_at_at(&joint),
        CasePart::InitialSpeed(joint) => sentences::speed_at_at(&joint),
        CasePart::Lift(name) => sentences::lift_of_cam(&name),
        CasePart::Ratio(name) => sentences::ratio_of_transmission(&name),
        CasePart::PressureAngle(name) => sentences::pressure_angle_of_transmission(&name),
        CasePart::Phase(name) => sentences::start_of_transmission(&name),
        CasePart::MotorMoment => sentences::MOMENT_OF_THE_MOTOR.into(),
        CasePart::RotorInertia => sentences::INERTIA_OF_ROTOR_AND_REDUCER.into(),
        CasePart::Axis(joint, link) => sentences::axis_of_on(&joint, &link),
        CasePart::Place(joint, link, along) => sentences::place_of_on(&joint, &link, &axis(along)),
    }
}

/// A number with at most six significant digits.
pub fn number(value: f64) -> String {
    significant(value, 6)
}
