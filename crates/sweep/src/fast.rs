//! Cases of a sweep that are solved in batches. The cases of a batch differ only in points, masses and moments of
//! inertia of links. The mechanism has a crank at constant speed, dyads with three pins, and no loads other than
//! moments of resistance. The figures are statistics of channels, inputs at extremes of channels, and the smallest
//! transmission angle.
//! The figures of a batch equal, bit by bit, the figures of a case that is read and solved alone. Cases that do not
//! suit a batch are read and solved alone.

use analytic::assur::batch::{CaseBatch, PoseQuantity, PoseTally};
use formula::{FormulaGraph, NodeShape, Program, Rounded};
use linkage::case::{Case, Seat};
use linkage::math::KeepNan;
use linkage::math::tally::{LanePeak, Tally};
use linkage::trajectory::{OfDrive, OfJoint, OfLink, Reading, Stage};
use scenario::{
    CaseFigure, Claim, FigureGrid, FigureKind, PrintedChannel, Renumbering, Scenario, ScenarioFamily, Statistic,
    TurnFigure,
};

use crate::axis::SweepAxis;
use crate::figure::{angle_of_sine, is_plain_dyad};

/// How a figure follows from the statistics of a batch. Numbers such as `at` are indices in the list of statistics.
enum FastFigure {
    /// The statistic `at`, or its square root if `is_root`, divided by `unit`.
    Value { at: usize, is_root: bool, unit: f64 },
    /// The input at the extreme that this statistic has found.
    Place(usize),
    /// The smallest transmission angle, from the statistics of all dyads.
    TransmissionAngle(std::ops::Range<usize>),
    /// A statistic of an expression of columns, or the input at the extreme of this expression.
    Expression { figure: TurnFigure, is_place: bool, columns: Vec<usize>, program: Program },
}

/// The cases of a sweep, solved in batches.
pub(crate) struct FastCases {
    renumbering: Renumbering,
    batch: CaseBatch,
    tallies: Vec<PoseTally>,
    figures: Vec<FastFigure>,
    deepest: Stage,
    grid: FigureGrid,
    inputs: Vec<Rounded>,
    values: Vec<f64>,
}

/// The figures of a case, and the statistics that these figures need.
struct Figures<'a> {
    case: &'a Case,
    grid: FigureGrid,
    tallies: Vec<PoseTally>,
    deepest: Stage,
}

impl FastCases {
    /// Prepares the cases of a sweep; `member` is a scenario of the family. `None` if the cases cannot be solved in
    /// batches.
    pub(crate) fn of(
        axes: &[SweepAxis],
        figures: &[CaseFigure],
        family: &ScenarioFamily,
        member: &Scenario,
    ) -> Option<FastCases> {
        let keys: Vec<String> = axes.iter().map(|axis| axis.key.clone()).collect();
        let renumbering = Renumbering::of(family, &keys, member)?;
        let case = &member.case;
        let grid = FigureGrid::of(&case.grid.times, case.crank().input, &case.grid.inputs);
        let mut reading = Figures { case, grid, tallies: Vec::new(), deepest: Stage::Positions };
        let figures = figures.iter().map(|figure| reading.figure(figure)).collect::<Option<_>>()?;
        let Figures { grid, tallies, deepest, .. } = reading;
        let (inputs, values) = (Vec::new(), Vec::new());
        Some(FastCases { renumbering, batch: CaseBatch::of(case)?, tallies, figures, deepest, grid, inputs, values })
    }

    /// Writes the figures for the varied numbers `values`. Returns `false` if the case must be read and solved alone.
    pub(crate) fn solve(&mut self, values: &[f64], found: &mut [f64]) -> bool {
        let mut is_written = false;
        let renumbering = &mut self.renumbering;
        self.batch.renumber(|links, joints| is_written = renumbering.write(values, links, joints));
        if !(is_written
            && Renumbering::is_sound(self.batch.case())
            && self.batch.solve(self.deepest, &mut self.tallies))
        {
            return false;
        }
        let case = self.batch.case();
        let input = |row: usize| case.crank().input.shown(case.grid.inputs[row]);
        for (own, found) in self.figures.iter_mut().zip(found) {
            *found = match own {
                FastFigure::Value { at, is_root, unit } => {
                    let shown = |value: f64| if *is_root { value.sqrt() / *unit } else { value / *unit };
                    self.tallies[*at].tally.value_as(shown)
                }
                FastFigure::Place(at) => match self.tallies[*at].tally.rows() {
                    [Some(row), _] => input(row),
                    [None, _] => return false,
                },
                FastFigure::TransmissionAngle(dyads) => {
                    let sines = self.tallies[dyads.clone()].iter().map(|own| own.tally.value());
                    angle_of_sine(sines.fold(f64::INFINITY, f64::smaller))
                }
                FastFigure::Expression { figure, is_place, columns, program } => {
                    self.values.clear();
                    for row in 0..case.grid.len() {
                        self.inputs.clear();
                        for at in &*columns {
                            let Tally::Column(column) = &self.tallies[*at].tally else { return false };
                            self.inputs.push(Rounded::exact(column[row]));
                        }
                        self.values.push(program.run(&self.inputs)[0].known());
                    }
                    let Ok(sampled) = figure.on(&self.grid, &self.values) else { return false };
                    if *is_place { input(sampled.rows[0]) } else { sampled.value }
                }
            };
        }
        true
    }
}

impl Figures<'_> {
    fn figure(&mut self, figure: &CaseFigure) -> Option<FastFigure> {
        let (own, is_place) = match &figure.kind {
            FigureKind::Turn(own) => (own, false),
            FigureKind::Place(own) => (own, true),
            FigureKind::TransmissionAngle => {
                let first = self.tallies.len();
                for (id, group) in self.case.structure.groups.entries() {
                    let sine = is_plain_dyad(group).then_some(PoseQuantity::TransmissionSine(id))?;
                    self.tallies.push(PoseTally::of(sine, 1.0, Tally::Min(LanePeak::NONE)));
                }
                return Some(FastFigure::TransmissionAngle(first..self.tallies.len()));
            }
            FigureKind::Reach(_) | FigureKind::Verdict(_) => return None,
        };
        // Only channels are allowed in the claim, because the values of parameters and of reduced quantities may vary
        // from case to case.
        let claim = Claim::of_channels(&own.quantity, &self.case.all_channels()).ok()?;
        if let (NodeShape::Name(_), [(_, printed)]) = (&claim.tree.shape, &claim.channels[..]) {
            let (tally, unit) = (self.grid.tally(own.statistic)?, printed.to_si(1.0));
            // If the figure is the value of an extreme, square root and unit are applied to the extreme only.
            // If the figure is the input at an extreme, square root and unit are applied to all values before the
            // search, because rounding may make different values equal.
            let is_late = !is_place && !matches!(own.statistic, Statistic::Mean | Statistic::Rms);
            let mut quantity = self.quantity(printed)?;
            let is_root = is_late && printed.magnitude;
            if let (PoseQuantity::Force(joint), true) = (quantity, is_root) {
                quantity = PoseQuantity::ForceSquare(joint);
            }
            let (early, unit) = if is_late { (1.0, unit) } else { (unit, 1.0) };
            let at = self.place(PoseTally::of(quantity, early, tally));
            if is_place {
                self.tallies[at].want_rows();
                return Some(FastFigure::Place(at));
            }
            return Some(FastFigure::Value { at, is_root, unit });
        }
        let of = |(_, printed): &(String, PrintedChannel)| {
            let tally = PoseTally::of(self.quantity(printed)?, printed.to_si(1.0), Tally::Column(Vec::new()));
            Some(self.place(tally))
        };
        let columns = claim.channels.iter().map(of).collect::<Option<_>>()?;
        let names: Vec<&str> = claim.channels.iter().map(|(name, _)| name.as_str()).collect();
        let mut graph = FormulaGraph::new(&names, 0);
        let node = graph.add(&claim.tree).ok()?;
        Some(FastFigure::Expression { figure: own.clone(), is_place, columns, program: Program::of(&graph, &[node]) })
    }

    /// The quantity of a channel in SI; `None` for a channel that a batch does not have.
    fn quantity(&mut self, printed: &PrintedChannel) -> Option<PoseQuantity> {
        let (channel, of) = (&printed.channel, self.case.seats().of(&printed.channel)?);
        let quantity = match (channel.kind.reading, of) {
            (Reading::Link(OfLink::Angle), Seat::Link(link)) => PoseQuantity::Angle(link),
            (Reading::Link(OfLink::Omega), Seat::Link(link)) => PoseQuantity::Omega(link),
            (Reading::Link(OfLink::Alpha), Seat::Link(link)) => PoseQuantity::Alpha(link),
            (Reading::Link(OfLink::Centre(reading)), Seat::Link(link)) => PoseQuantity::Centre(link, reading),
            (Reading::Point(reading), Seat::Point(side)) => {
                let points = &self.case.mechanism.links()[side.link].points;
                let point = points.iter().position(|point| point.name == channel.of)?;
                PoseQuantity::Point(side.link, point, reading)
            }
            (Reading::Joint(_), Seat::Joint(joint)) if printed.magnitude => PoseQuantity::Force(joint),
            (Reading::Joint(OfJoint::ForceX), Seat::Joint(joint)) => PoseQuantity::ForceX(joint),
            (Reading::Joint(OfJoint::ForceY), Seat::Joint(joint)) => PoseQuantity::ForceY(joint),
            (Reading::Drive(OfDrive::Effort), Seat::Drive(drive)) => PoseQuantity::Torque(drive),
            _ => return None,
        };
        self.deepest = self.deepest.max(channel.kind.stage);
        Some(quantity)
    }

    /// Index of a statistic in the list. A statistic that is not in the list yet is added.
    fn place(&mut self, tally: PoseTally) -> usize {
        let known = self.tallies.iter().position(|own| own.is_like(&tally));
        known.unwrap_or_else(|| {
            self.tallies.push(tally);
            self.tallies.len() - 1
        })
    }
}
