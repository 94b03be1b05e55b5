//! Motion diagrams over one turn of the crank, or over the stroke of a slide.
//! The diagrams show displacement, velocity and acceleration: exact, and by graphical methods.

use super::method::{Method, apply};
use crate::sentences;
use linkage::case::{Case, Grid, Wanted};
use linkage::error::{Error, ErrorKind, Result};
use linkage::input::Input;
use linkage::math::KeepNan;
use linkage::math::statistics::{ends, half_range, rms, share};
use linkage::solver::Solver;
use linkage::trajectory::{Channel, ChannelSubject, Stage};
use std::f64::consts::TAU;

/// Allowed number of divisions of the turn. Fewer divisions do not show the motion; more divisions only take time.
pub const DIVISIONS: std::ops::RangeInclusive<usize> = 4..=1000;
/// Lower limit of the number of points of the exact curves.
const CURVE: usize = 720;
/// Lower limit of a derivative's scale, divided by the natural scale; see [`MethodResult::share`].
/// The range of a nearly constant derivative is too small a scale, because the errors of the derivative arise in the
/// displacement.
const SMALLEST: f64 = 1e-3;
/// A motion counts as repeating if velocity and acceleration at the end equal those at the start.
/// The difference may be at most this fraction of half the range of the velocity or of the acceleration.
const REPEATS: f64 = 1e-6;
/// An error below this fraction of its scale counts as rounding error: no order of convergence is computed from it.
const ROUNDING: f64 = 1e-11;
/// Suffixes of a channel and its two derivatives.
const ENDINGS: [[&str; 3]; 3] =
    [["angle_rad", "omega_rad_s", "alpha_rad_s2"], ["x_m", "vx_m_s", "ax_m_s2"], ["y_m", "vy_m_s", "ay_m_s2"]];

/// A displacement or angle and its two derivatives with respect to time.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionCurve(pub [Channel; 3]);

impl MotionCurve {
    /// The channel `name` with its two derivatives. The channel is a position or an angle of a moving link or point of
    /// `case`.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] for any other name, with the possible names.
    pub fn named(case: &Case, name: &str) -> Result<Self> {
        let all = case.wanting(Wanted::ALL).channels();
        let wrong = |message: String, help: String| Error::new(ErrorKind::Input, message).help(help);
        let Some(channel) = all.iter().find(|channel| channel.to_string() == name) else {
            return Err(wrong(sentences::the_mechanism_has_no_channel(&name), help(&all, name)));
        };
        let stem = name.strip_suffix(channel.kind.suffix).unwrap_or(name);
        match ENDINGS.into_iter().find(|endings| endings.contains(&channel.kind.suffix)) {
            Some(endings) if endings[0] == channel.kind.suffix => Ok(MotionCurve(endings.map(|ending| {
                Channel::named(&format!("{stem}{ending}")).expect("links and points have all derivatives")
            }))),
            Some(endings) => Err(wrong(
                sentences::is_a_derivative_already_a_motion(&name),
                sentences::ask_for_its_diagram_shows(&stem, &endings[0]),
            )),
            None => Err(wrong(sentences::is_neither_a_position_nor(&name), help(&all, ""))),
        }
    }
}

/// Lists the possible names: the channel names of the link or point whose name occurs in `name`.
/// If this link or point does not exist, all names of links or all names of points are listed.
/// If `name` begins with neither `link` nor `point`, the help states how names are formed.
fn help(all: &[Channel], name: &str) -> String {
    let positions = all.iter().filter(|channel| channel.kind.stage == Stage::Positions);
    let parts: Vec<&str> = name.splitn(2, '.').collect();
    let sort =
        [ChannelSubject::Link, ChannelSubject::Point].into_iter().find(|sort| parts.first() == Some(&sort.word()));
    let Some(sort) = sort else {
        return sentences::CHANNELS_ARE_NAMED_LIKE_POINT.into();
    };
    let of = parts.get(1).and_then(|rest| rest.rsplit_once('.')).map_or("", |(of, _)| of);
    let names: Vec<String> = positions
        .filter(|channel| {
            channel.kind.subject == sort
                && (channel.of == of || all.iter().all(|c| c.kind.subject != sort || c.of != of))
        })
        .map(ToString::to_string)
        .collect();
    sentences::allowed_here(&names.join(", "))
}

/// Result of a method, with its error.
#[derive(Clone, Debug, PartialEq)]
pub struct MethodResult {
    /// Method.
    pub method: Method,
    /// Rows of [`MotionDiagram::cranks`] at which the method's values are given.
    pub rows: Vec<usize>,
    /// Values (SI).
    pub values: Vec<f64>,
    /// Largest error (SI).
    pub largest: f64,
    /// Root mean square of the errors (SI).
    pub rms: f64,
    /// Largest error divided by half the range of the exact curve.
    /// The divisor is at least a thousandth of the natural scale.
    /// For the velocity, the natural scale is the displacement's half range times the crank's angular velocity.
    /// For the acceleration, the natural scale is the displacement's half range times the square of this angular
    /// velocity.
    pub share: f64,
    /// Observed orders of convergence of the root mean square error.
    /// `orders[0]` compares the errors at N and 2 N divisions, `orders[1]` those at 2 N and 4 N; N is
    /// [`MotionDiagram::divisions`].
    /// An order is `None` if the error at the finer division is rounding error.
    pub orders: [Option<f64>; 2],
}

/// Motion diagrams of one position or angle.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionDiagram {
    /// Channels of the displacement and its two derivatives.
    pub course: MotionCurve,
    /// Number of divisions of the turn.
    pub divisions: usize,
    /// Number of rows per division, a multiple of 8.
    pub stride: usize,
    /// What the input measures.
    pub input: Input,
    /// Input in every row (SI unit), with the zero and the direction of the scenario's input.
    pub cranks: Vec<f64>,
    /// Time of every row (s).
    pub times: Vec<f64>,
    /// Exact displacement, velocity and acceleration in every row (SI).
    pub exact: [Vec<f64>; 3],
    /// Results of the methods, in the order of [`Method::ALL`].
    pub found: Vec<MethodResult>,
}

impl MotionDiagram {
    /// Computes the diagrams of `course` over one turn of the crank, with `divisions` equal divisions.
    /// The turn begins at the crank's start and follows its sense of rotation.
    /// If the input is a slide, the range of the grid replaces the turn.
    /// If the motion does not repeat after the range, some methods give no values near the ends of the range.
    /// Accelerations by chords of chords, and velocities by tangents, are then missing at both ends of the range.
    /// Accelerations by tangents are then missing at the first two and the last two ends of divisions.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] for a number of divisions outside [`DIVISIONS`], or if the grid of a slide has no stroke.
    /// [`ErrorKind::Unsupported`] if a drive has no constant speed, or if the solver does not provide a channel.
    /// The errors of the solver, if the crank cannot turn fully.
    pub fn of(case: &Case, solver: &dyn Solver, course: &MotionCurve, divisions: usize) -> Result<Self> {
        if !DIVISIONS.contains(&divisions) {
            let (least, most) = DIVISIONS.into_inner();
            return Err(Error::new(ErrorKind::Input, sentences::a_turn_cannot_be_divided(&divisions))
                .help(sentences::give_from_to_divisions(&least, &most)));
        }
        if !case.is_steady() {
            let message = sentences::THE_CHORD_METHOD_DIVIDES_A_TURN;
            return Err(Error::new(ErrorKind::Unsupported, message).help(sentences::GIVE_THE_DRIVE_A_CONSTANT));
        }
        let sense = case.crank().sense();
        let [low, high] = ends(case.grid.inputs.iter().copied());
        let (from, span) = match case.crank().input.period() {
            Some((turn, _)) => (case.crank().start, turn),
            None => (if sense > 0.0 { low } else { high }, high - low),
        };
        if !(span > 0.0) {
            return Err(
                Error::new(ErrorKind::Input, sentences::THE_GRID_HAS_NO_STROKE).help(sentences::EXTEND_THE_GRID)
            );
        }
        // The number of rows per division is a multiple of 8. The midpoints of whole, half and quarter divisions are
        // therefore rows.
        let stride = 8 * CURVE.div_ceil(8 * divisions);
        let rows = divisions * stride;
        let crank = |row: usize| from + sense * span * (row as f64 / rows as f64);
        let grid = Grid::of_inputs(case.crank(), (0..=rows).map(crank).collect());
        let wanted = Wanted::of(&[Stage::Positions, Stage::Velocities, Stage::Accelerations]);
        let trajectory = solver.solve(&case.on(grid)?.wanting(wanted))?;
        let column = |channel: &Channel| {
            trajectory.column(channel).map(<[f64]>::to_vec).ok_or_else(|| {
                Error::new(ErrorKind::Unsupported, sentences::does_not_provide(&solver.name(), &channel))
                    .help(sentences::SOLVE_WITH_ANOTHER_SOLVER)
            })
        };
        let [x, v, a] = &course.0;
        let exact = [column(x)?, column(v)?, column(a)?];
        let (cranks, times) = (trajectory.inputs().to_vec(), trajectory.times().to_vec());
        // With transmissions or several drives, the motion may repeat only after several turns.
        let repeats = |own: &Vec<f64>| (own[rows] - own[0]).abs() <= REPEATS * half_range(own);
        let is_closed = case.crank().input.period().is_some() && exact[1..].iter().all(repeats);
        let scales = scales(&exact, (times[rows] - times[0]).abs());
        let found = Method::ALL.into_iter().map(|method| {
            let runs = [stride, stride / 2, stride / 4].map(|stride| apply(method, stride, is_closed, &times, &exact));
            let errors = runs.each_ref().map(|(rows, values)| {
                rows.iter().zip(values).map(|(&row, value)| value - exact[method.gives()][row]).collect::<Vec<f64>>()
            });
            let size = errors.each_ref().map(|errors| rms(errors));
            let scale = scales[method.gives()];
            let order = |coarse: f64, fine: f64| (fine > ROUNDING * scale).then(|| (coarse / fine).log2());
            let largest = errors[0].iter().fold(0.0f64, |most, error| most.larger(error.abs()));
            let orders = [order(size[0], size[1]), order(size[1], size[2])];
            let [(rows, values), ..] = runs;
            // For a curve without motion, the error and the scale are both zero. `share` returns zero in this case.
            let share = share(largest, scale);
            MethodResult { method, rows, values, largest, rms: size[0], share, orders }
        });
        let found = found.collect();
        let input = case.crank().input;
        Ok(MotionDiagram { course: course.clone(), divisions, stride, input, cranks, times, exact, found })
    }

    /// Half the range of an exact curve (SI). Index 0 is the displacement, 1 the velocity, 2 the acceleration.
    pub fn half_range(&self, which: usize) -> f64 {
        half_range(&self.exact[which])
    }
}

/// Scales (SI) by which the errors of displacement, velocity and acceleration are divided.
fn scales(exact: &[Vec<f64>; 3], period: f64) -> [f64; 3] {
    let natural = |order: i32| SMALLEST * half_range(&exact[0]) * (TAU / period).powi(order);
    [0, 1, 2].map(|order| half_range(&exact[order as usize]).larger(natural(order)))
}
