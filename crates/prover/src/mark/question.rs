//! The requested quantities of an exercise.

use crate::sentences;

use linkage::case::Case;
use linkage::error::{Error, ErrorKind, Result};
use linkage::mechanism::GROUND;
use linkage::trajectory::{Channel, Stage, Trajectory, Unit};
use scenario::PrintedChannel;
use scenario::words::suggestion;

/// A requested quantity: a channel in its printed unit, or the magnitude of a vector.
#[derive(Clone, Debug)]
pub struct AskedColumn {
    /// Name of the column: the name of the channel, or of a magnitude such as `point.B.v_m_s`.
    pub name: String,
    /// Symbol of the printed unit.
    pub unit: &'static str,
    /// The channel, or both components of the vector.
    pub channels: Vec<Channel>,
    /// Size of the printed unit in SI.
    pub scale: f64,
    /// A whole turn in the printed unit, if the quantity is an angle.
    pub turn: Option<f64>,
}

/// Ending of the name of a magnitude, and the endings of its components.
const SIZES: [(&str, [&str; 2]); 3] =
    [("v_m_s", ["vx_m_s", "vy_m_s"]), ("a_m_s2", ["ax_m_s2", "ay_m_s2"]), ("f_N", ["fx_N", "fy_N"])];

impl AskedColumn {
    /// The quantity with this name. The function does not check whether a case has the quantity.
    fn named(name: &str) -> Option<AskedColumn> {
        let size = SIZES.iter().find_map(|(ending, parts)| {
            let subject = name.strip_suffix(ending)?.strip_suffix('.')?;
            let [x, y] = parts.map(|part| Channel::named(&format!("{subject}.{part}")));
            Some([x?, y?])
        });
        if let Some(parts) = size {
            let unit = parts[0].kind.unit.symbol();
            return Some(AskedColumn { name: name.into(), unit, channels: parts.to_vec(), scale: 1.0, turn: None });
        }
        let printed = PrintedChannel::named(name)?;
        Some(AskedColumn {
            name: name.into(),
            unit: printed.unit_symbol(),
            scale: printed.to_si(1.0),
            turn: printed.turn(),
            channels: vec![printed.channel],
        })
    }

    /// The stage of a solution that the quantity needs.
    #[must_use]
    pub fn stage(&self) -> Stage {
        self.channels[0].kind.stage
    }

    /// The SI unit of the quantity.
    #[must_use]
    pub fn si_unit(&self) -> Unit {
        self.channels[0].kind.unit
    }

    /// Whether the quantity is the magnitude of a vector.
    #[must_use]
    pub fn is_size(&self) -> bool {
        self.channels.len() == 2
    }

    /// Name of the link, point or joint to which the quantity belongs; empty for the first drive.
    #[must_use]
    pub fn of(&self) -> &str {
        &self.channels[0].of
    }

    /// The values in a solution, in the printed unit. Angles lie between zero and a whole turn.
    pub(super) fn values(&self, of: &Trajectory) -> Option<Vec<f64>> {
        let columns: Option<Vec<&[f64]>> = self.channels.iter().map(|channel| of.column(channel)).collect();
        let columns = columns?;
        let value = |row: usize| match &columns[..] {
            [x, y] => x[row].hypot(y[row]),
            own => own[0][row],
        };
        let printed = |value: f64| self.turn.map_or(value, |turn| value.rem_euclid(turn));
        Some((0..of.times().len()).map(|row| printed(value(row) / self.scale)).collect())
    }
}

/// The stages whose names select several quantities.
pub const ANSWER_WORDS: [Stage; 5] =
    [Stage::Positions, Stage::Velocities, Stage::Accelerations, Stage::Reactions, Stage::BalancingMoment];

/// The quantities of a case that the words select, in the order of the words.
/// A word is the name of a channel, of a magnitude or of a stage.
/// If there are no words, the stages of positions, velocities and accelerations are selected, and the balancing moment
/// if the case has masses or loads.
///
/// The stages of positions, velocities and accelerations select the angles, angular velocities and angular
/// accelerations of all links that can turn, except the driving link.
/// The stages of velocities and accelerations also select the magnitudes of the velocities or accelerations of all
/// points that join moving links.
/// If no other link turns, as in a cam with a translating follower, the slides and their rates are selected.
///
/// # Errors
/// [`ErrorKind::Input`] for a word that selects nothing.
pub fn columns_of(words: &[String], case: &Case) -> Result<Vec<AskedColumn>> {
    let all = case.all_channels();
    let has = |own: &AskedColumn| own.channels.iter().all(|channel| all.contains(channel));
    let mut names: Vec<String> = words.to_vec();
    if names.is_empty() {
        let has_forces = case.mechanism.links().iter().any(|link| link.mass > 0.0) || !case.loads.is_empty();
        let stages = ANSWER_WORDS.iter().filter(|stage| match stage {
            Stage::Positions | Stage::Velocities | Stage::Accelerations => true,
            Stage::Reactions => false,
            Stage::BalancingMoment => has_forces,
        });
        names = stages.map(|stage| stage.name().into()).collect();
    }
    let mut found: Vec<AskedColumn> = Vec::new();
    for name in &names {
        let own = match Stage::named(name) {
            Some(stage) => of_stage(stage, case),
            None => vec![name.clone()],
        };
        let own: Vec<AskedColumn> = own.iter().filter_map(|name| AskedColumn::named(name)).filter(has).collect();
        if own.is_empty() && !words.is_empty() {
            let words = ANSWER_WORDS.iter().map(|stage| stage.name());
            let known: Vec<String> = ANSWER_WORDS.iter().flat_map(|stage| of_stage(*stage, case)).collect();
            let help = suggestion(name, known.iter().map(String::as_str).chain(words), "\"");
            return Err(Error::new(ErrorKind::Input, sentences::no_answer_is_called(&name)).help(help));
        }
        found.extend(
            own.into_iter()
                .filter(|own| names.len() < 2 || found.iter().all(|known| known.name != own.name))
                .collect::<Vec<_>>(),
        );
    }
    Ok(found)
}

/// Names of the quantities of a stage.
fn of_stage(stage: Stage, case: &Case) -> Vec<String> {
    let mechanism = &case.mechanism;
    let crank = case.crank().link;
    let links: Vec<&str> = mechanism
        .links()
        .entries()
        .filter(|(index, _)| *index != GROUND && *index != crank && case.can_turn(*index))
        .map(|(_, link)| link.name.as_str())
        .collect();
    let of_links = |ending: &str| links.iter().map(|link| format!("link.{link}.{ending}")).collect::<Vec<_>>();
    // Whether a joint between moving links has the name of the point.
    let is_joined = |name: &str| {
        let at_pin = |joint: &linkage::mechanism::Joint| joint.name == name && joint.on(GROUND).is_none();
        mechanism.joints().iter().any(at_pin)
    };
    let mut points: Vec<&str> =
        mechanism.moving_points().map(|(name, _)| name).filter(|name| is_joined(name)).collect();
    points.sort_unstable();
    points.dedup();
    let of_points = |ending: &str| points.iter().map(|point| format!("point.{point}.{ending}")).collect::<Vec<_>>();
    let driven = case.crank().joint;
    let slides = mechanism.joints().entries().filter(|(index, joint)| joint.slides() && *index != driven);
    let slides: Vec<&str> = slides.map(|(_, joint)| joint.name.as_str()).filter(|_| links.is_empty()).collect();
    let of_slides = |ending: &str| slides.iter().map(|joint| format!("joint.{joint}.{ending}")).collect::<Vec<_>>();
    match stage {
        Stage::Positions => [of_links("angle_deg"), of_slides("slide_mm")].concat(),
        Stage::Velocities => [of_links("omega_rad_s"), of_points("v_m_s"), of_slides("slide_speed_m_s")].concat(),
        Stage::Accelerations => {
            [of_links("alpha_rad_s2"), of_points("a_m_s2"), of_slides("slide_acceleration_m_s2")].concat()
        }
        Stage::Reactions => mechanism.joints().iter().map(|joint| format!("joint.{}.f_N", joint.name)).collect(),
        Stage::BalancingMoment => vec!["drive.torque_N_m".into(), "drive.force_N".into()],
    }
}
