//! Many cases with the same grid. The cases differ only in points, masses and moments of inertia of links.

use linkage::case::Case;
use linkage::input::Input;
use linkage::math::{KeepNan, unit};
use linkage::mechanism::{Joint, Link};
use linkage::trajectory::Stage;
use pulp::{Arch, Simd, WithSimd};

use super::STEP;
use super::equations::Clearance;
use super::groups::Groups;
use super::lanes::{AlignedNumbers, Columns, Lanes, TILE, Tile, TileColumn};
use super::poses::{DIRECTION, Layout};
use super::tally::PoseTally;
use crate::assur::groups::SolutionPlan;

/// Lower limit of the magnitude of the sine of every transmission angle.
const CLEAR_SINE: f64 = 0.01;
/// Largest allowed change of the sine of a transmission angle between two instants, as a fraction of the sine.
/// Near a dead point the square of the sine s is linear in time. With the rate s', s is zero after the time
/// t = s / (2 s').
/// The change s' t is then half of s; the limit is half of this change.
const CLEAR_CHANGE: f64 = 0.25;

/// Solver for cases with the same structure and the same grid.
/// The structure consists of a crank on the ground at constant speed, and RRR dyads. All loads are moments of
/// resistance.
/// The results equal those of [`PoseSolver`](crate::PoseSolver), bit by bit.
/// Cases that may pass a dead point are not solved.
#[derive(Debug)]
pub struct CaseBatch {
    case: Case,
    layout: Layout,
    groups: Groups,
    /// Angles and directions of the crank in each tile of the grid, and at the start pose.
    cranks: Vec<CrankTile>,
    start: CrankTile,
    /// Whether the rows are in the order of time.
    is_ascending: bool,
    omega: f64,
    /// Largest time between two successive instants (s).
    pace: f64,
    /// The columns of the present tile.
    tile: AlignedNumbers,
    work: AlignedNumbers,
    /// The values of a quantity in the present tile.
    values: TileColumn,
    pub(super) arch: Arch,
}

/// The crank in one tile.
#[derive(Clone, Debug)]
struct CrankTile {
    rows: usize,
    angles: TileColumn,
    direction: [TileColumn; 2],
}

impl CrankTile {
    /// Unused rows repeat the last angle.
    fn of(angles: &[f64]) -> CrankTile {
        let rows = angles.len();
        let angles = std::array::from_fn(|row| angles[row.min(rows - 1)]);
        let directions = angles.map(unit);
        CrankTile {
            rows,
            angles: TileColumn(angles),
            direction: [TileColumn(directions.map(|own| own.x)), TileColumn(directions.map(|own| own.y))],
        }
    }
}

impl CaseBatch {
    /// A solver for cases that differ from `case` only in points, masses and moments of inertia of links.
    /// `None` if the case must be solved pose by pose, or if its instants are too far apart.
    #[must_use]
    pub fn of(case: &Case) -> Option<CaseBatch> {
        let (crank, grid) = (case.crank(), &case.grid);
        let omega = crank.constant_speed()?;
        let is_plain = case.drives.len() == 1
            && crank.input == Input::Angle
            && !crank.through
            && !case.is_free()
            && case.loads.iter().all(|load| load.resistance().is_some_and(|(link, _)| case.can_turn(link)))
            && !case.has_friction();
        let rows = grid.ascending();
        let inputs: Vec<f64> = rows.iter().map(|&row| grid.inputs[row]).collect();
        let gaps =
            inputs.windows(2).map(|pair| pair[1] - pair[0]).chain(inputs.first().map(|first| first - crank.start));
        let widest = gaps.map(f64::abs).fold(0.0, f64::larger);
        if !(is_plain && omega.is_normal() && widest <= STEP) {
            return None;
        }
        let plan = SolutionPlan::of(&case.mechanism, &case.structure, &case.modes);
        let layout = Layout::of(case, false);
        let groups = Groups::of(case, &plan, layout)?;
        if groups.chains().next().is_some() {
            return None;
        }
        let zero = crank.coordinate(0.0);
        let angles: Vec<f64> = grid.inputs.iter().map(|input| zero + input).collect();
        let mut batch = CaseBatch {
            layout,
            cranks: angles.chunks(TILE).map(CrankTile::of).collect(),
            start: CrankTile::of(&[zero + crank.start]),
            is_ascending: rows.is_sorted(),
            omega,
            pace: (widest / omega).abs(),
            tile: AlignedNumbers::zeros(layout.columns() * TILE),
            work: AlignedNumbers::zeros(groups.columns * TILE),
            values: TileColumn([0.0; TILE]),
            groups,
            arch: Arch::new(),
            case: case.clone(),
        };
        batch.fix();
        Some(batch)
    }

    /// The case with its present numbers.
    #[must_use]
    pub fn case(&self) -> &Case {
        &self.case
    }

    /// Changes coordinates, masses and moments of inertia of links, and positions of joints on links.
    /// The names, kinds and order of links and joints must stay unchanged.
    pub fn renumber(&mut self, change: impl FnOnce(&mut [Link], &mut [Joint])) {
        self.case.renumber(change);
        let places = |groups: &Groups| (groups.drivers[0].ground, groups.drivers[0].reaction.place);
        let before = places(&self.groups);
        self.groups.renumber(&self.case.mechanism);
        if places(&self.groups) != before {
            self.fix();
        }
    }

    /// Writes the columns of the crank that are the same in all rows.
    fn fix(&mut self) {
        self.groups.drivers[0].fix(&mut self.tile, self.omega, 0.0);
    }

    /// Solves all instants of the grid up to the stage `deepest`, and computes the statistics `tallies`.
    /// Returns `false` in the cases below. [`PoseSolver`](crate::PoseSolver) then solves the case or gives the error.
    /// - A pose cannot be assembled, or a number is not finite.
    /// - A dyad is near a dead point, or may pass one between two instants.
    /// - An angle with whole turns is requested, and the rows are not in the order of time.
    /// - An angle with whole turns is requested, and the link's direction at the start is nearly -x.
    pub fn solve(&mut self, deepest: Stage, tallies: &mut [PoseTally]) -> bool {
        tallies.iter_mut().for_each(|own| own.start(&self.case, self.layout));
        let arch = self.arch;
        arch.dispatch(AllTiles { batch: self, deepest, tallies })
    }
}

/// All tiles of a case.
struct AllTiles<'a> {
    batch: &'a mut CaseBatch,
    deepest: Stage,
    tallies: &'a mut [PoseTally],
}

impl CaseBatch {
    /// Solves the tile number `crank` of the grid (`None`: the start pose).
    /// Returns NaN where a dead point may be near, or the direction of a resistance is uncertain; 0 elsewhere.
    #[inline(always)]
    fn solve_tile<S: Simd>(&mut self, on: S, deepest: Stage, crank: Option<usize>) -> Lanes<S> {
        let CaseBatch { groups, cranks, start, pace, tile, work, .. } = self;
        let crank = crank.map_or(&*start, |index| &cranks[index]);
        let direction = (groups.drivers[0].body.link + DIRECTION) * TILE;
        for (column, values) in tile[direction..].chunks_exact_mut(TILE).zip(&crank.direction) {
            column.copy_from_slice(&values.0);
        }
        let (tile, work) = (Tile::of(on, tile, crank.rows), Tile::of(on, work, crank.rows));
        let check = Clearance { pace: *pace, least: CLEAR_SINE, share: CLEAR_CHANGE };
        let mut doubt = groups.move_links::<S, false, _>(deepest, check, tile, work);
        if deepest >= Stage::Reactions {
            groups.load_joints::<S, false>(tile, work);
        }
        if deepest >= Stage::Reactions && groups.is_resisted {
            for part in tile.parts() {
                doubt = doubt + groups.standstill(tile.window(part));
            }
        }
        doubt
    }
}

impl WithSimd for AllTiles<'_> {
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: Simd>(self, on: S) -> bool {
        let AllTiles { batch, deepest, tallies } = self;
        if tallies.iter().any(PoseTally::needs_start) {
            batch.solve_tile(on, Stage::Positions, None);
            let tile = Columns::of(on, &mut batch.tile);
            if !(batch.is_ascending && tallies.iter_mut().all(|own| own.begin(tile))) {
                return false;
            }
        }
        // The check for dead points needs velocities.
        let deepest = if deepest < Stage::Velocities { Stage::Velocities } else { deepest };
        let mut doubt = Lanes::splat(on, 0.0);
        for index in 0..batch.cranks.len() {
            doubt = doubt + batch.solve_tile(on, deepest, Some(index));
            let CaseBatch { cranks, tile, values, .. } = &mut *batch;
            let crank = &cranks[index];
            let rows = index * TILE..index * TILE + crank.rows;
            let (tile, values) = (Tile::of(on, tile, crank.rows), Columns::of(on, &mut values.0));
            for own in &mut *tallies {
                own.add(rows.clone(), &crank.angles, tile, values);
            }
        }
        (0..S::F64_LANES).all(|lane| doubt.number(lane) == 0.0) && tallies.iter().all(PoseTally::is_finite)
    }
}
