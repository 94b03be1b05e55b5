//! Many cases with the same grid. The cases differ only in points, masses and moments of inertia of links.

use linkage::case::Case;
use linkage::input::Input;
use linkage::math::{KeepNan, unit};
use linkage::mechanism::{Joint, Link};
use linkage::trajectory::Stage;
use pulp::Arch;

use super::STEP;
use super::equations::Clearance;
use super::groups::Groups;
use super::lanes::{TILE, TileColumn, Window};
use super::poses::{DIRECTION, Layout};
use super::registers::{OnRegisters, Registers, dispatch};
use super::tally::{BLOCK, PoseTally, TileBlock};
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
    /// The tiles of a block, one after the other.
    tiles: Vec<TileColumn>,
    work: Vec<TileColumn>,
    block: TileBlock,
    pub(super) arch: Arch,
}

/// The crank in one tile.
#[derive(Clone, Debug)]
struct CrankTile {
    angles: TileColumn,
    direction: [TileColumn; 2],
}

impl CrankTile {
    /// Unused rows repeat the last angle.
    fn of(angles: &[f64]) -> CrankTile {
        let angles = std::array::from_fn(|row| angles[row.min(angles.len() - 1)]);
        let directions = angles.map(unit);
        CrankTile {
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
            tiles: vec![TileColumn([0.0; TILE]); BLOCK * layout.columns()],
            work: vec![TileColumn([0.0; TILE]); groups.columns],
            block: TileBlock([[0.0; TILE]; BLOCK]),
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
        for tile in self.tiles.chunks_exact_mut(self.layout.columns()) {
            self.groups.drivers[0].fix(tile, self.omega, 0.0);
        }
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
        dispatch(arch, AllTiles { batch: self, deepest, tallies })
    }
}

/// All tiles of a case.
struct AllTiles<'a> {
    batch: &'a mut CaseBatch,
    deepest: Stage,
    tallies: &'a mut [PoseTally],
}

impl CaseBatch {
    /// Solves the tile number `crank` of the grid (`None`: the start pose), and writes it to the place `place` of the
    /// block. `doubt` becomes NaN where a dead point may be near, or the direction of a resistance is uncertain.
    #[inline(always)]
    fn solve_tile<R: Registers>(
        &mut self,
        on: R,
        deepest: Stage,
        crank: Option<usize>,
        place: usize,
        doubt: &mut TileColumn,
    ) {
        let CaseBatch { groups, cranks, start, pace, tiles, work, layout, .. } = self;
        let (link, crank) = (groups.drivers[0].body.link, crank.map_or(&*start, |index| &cranks[index]));
        let tile = &mut tiles[place * layout.columns()..][..layout.columns()];
        [tile[link + DIRECTION], tile[link + DIRECTION + 1]] = crank.direction;
        let check = Clearance { pace: *pace, least: CLEAR_SINE, share: CLEAR_CHANGE };
        for part in 0..Window::<R>::PARTS {
            let mut tile = Window { on, columns: &mut *tile, part };
            let mut work = Window { on, columns: &mut *work, part };
            let found = groups.move_links(deepest, check, &mut tile, &mut work);
            tile.add_to(&mut doubt.0, found);
            if deepest >= Stage::Reactions {
                groups.load_joints(&mut tile, &mut work);
                if groups.is_resisted {
                    tile.add_to(&mut doubt.0, groups.standstill(&tile));
                }
            }
        }
    }
}

impl OnRegisters for AllTiles<'_> {
    const IN_PAIRS: bool = true;
    type Output = bool;

    #[inline(always)]
    fn run<R: Registers>(self, on: R) -> bool {
        let AllTiles { batch, deepest, tallies } = self;
        let mut doubt = TileColumn([0.0; TILE]);
        if tallies.iter().any(PoseTally::needs_start) {
            batch.solve_tile(on, Stage::Positions, None, 0, &mut TileColumn([0.0; TILE]));
            if !(batch.is_ascending && tallies.iter_mut().all(|own| own.begin(&batch.tiles))) {
                return false;
            }
        }
        // The check for dead points needs velocities.
        let deepest = if deepest < Stage::Velocities { Stage::Velocities } else { deepest };
        let rows = batch.case.grid.len();
        for first in (0..batch.cranks.len()).step_by(BLOCK) {
            let block = first..batch.cranks.len().min(first + BLOCK);
            for index in block.clone() {
                batch.solve_tile(on, deepest, Some(index), index - first, &mut doubt);
            }
            let block_rows = first * TILE..rows.min(block.end * TILE);
            for own in &mut *tallies {
                let angles = batch.cranks[block.clone()].iter().map(|crank| &crank.angles);
                own.add(on, block_rows.clone(), angles, &mut batch.tiles, &mut batch.block);
            }
        }
        tallies.iter_mut().for_each(|own| own.tally.truncate(rows));
        doubt.0.iter().all(|lane| *lane == 0.0) && tallies.iter().all(PoseTally::is_finite)
    }
}
