//! Function generation: pairs of crank and rocker angles.
//!
//! Three pairs of world angles: if phi and psi are measured from the line of the pivots, Freudenstein's equation
//! (Freudenstein 1955)
//!
//! ```text
//! k1 cos psi - k2 cos phi + k3 = cos(phi - psi),   k1 = f/a,  k2 = f/c,  k3 = (a^2 - b^2 + c^2 + f^2) / (2 a c)
//! ```
//!
//! is linear in k1, k2, k3. A negative a or c means that the pin lies opposite to the given angle.
//!
//! Three to five pairs with a free start: only the rotations from the first pair are given.
//! The rocker U = 1 displaces its pin by `d_j = e^(i psi_j) - 1`. The crank W turns by phi_j, and the coupler Z by
//! unknown angles.
//! The frame is then W + Z - U. A scaling and a rotation bring this vector to the given pivots.

use crate::sentences;

use super::choice::{Choice, PrecisionSynthesis};
use super::dyad::dyads;
use super::four_bar::{GivenFrames, GroundLink};
use super::points::{check_apart, check_positions, no_dyad, turns_from_first};
use crate::synthesize::wrong;
use linkage::error::Result;
use linkage::math::dense::Lu;
use linkage::math::{Complex, KeepNan};

/// The three equations determine the lengths if the smallest pivot element of the elimination, divided by the largest
/// pivot element, is above this limit.
const INDEPENDENT: f64 = 1e-12;
/// A frame that is shorter than this fraction of the rocker counts as having no length.
const FRAME: f64 = 1e-6;

/// Meaning of the angles given for a function generator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FunctionStart {
    /// The angles are world angles. World angles are possible only for three pairs.
    World,
    /// Only the differences from the first pair matter.
    Free,
}

/// Requirements on a four-bar that couples the angles of crank and rocker.
#[derive(Clone, Debug, PartialEq)]
pub struct FunctionSpec {
    /// Pivots of crank and rocker (m).
    pub pivots: [Complex; 2],
    /// Three to five pairs of crank and rocker angles (rad, counter-clockwise), in their order.
    pub pairs: Vec<[f64; 2]>,
    /// Meaning of the angles.
    pub start: FunctionStart,
}

impl FunctionSpec {
    /// The best four-bars that couple all pairs of angles; at most `wanted` four-bars.
    /// In these four-bars, the angles of the links `crank` and `rocker` equal the given angles.
    ///
    /// # Errors
    /// [`ErrorKind::Input`](linkage::error::ErrorKind::Input) for a wrong number of pairs, for numbers that are not
    /// finite, for equal crank angles, for coincident pivots, and for world angles of more than three pairs.
    /// [`ErrorKind::Geometry`](linkage::error::ErrorKind::Geometry) if no four-bar exists. The error states the reason.
    pub fn four_bars(&self, wanted: usize) -> Result<PrecisionSynthesis> {
        self.check()?;
        let [crank, rocker] = self.pairs[0].map(Some);
        let is_scanned = self.start == FunctionStart::Free && self.pairs.len() < 5;
        let mut choice = Choice::new(GivenFrames { crank, rocker, ..GivenFrames::default() }, wanted, is_scanned);
        match self.start {
            FunctionStart::World => self.offer_freudenstein(&mut choice)?,
            FunctionStart::Free => self.offer_free(&mut choice)?,
        }
        choice.best()
    }

    fn check(&self) -> Result<()> {
        let [o, c] = self.pivots;
        check_positions(
            "pairs",
            self.pairs.len(),
            self.pairs.iter().flatten().copied().chain([o.re, o.im, c.re, c.im]),
        )?;
        if !((c - o).norm() > 0.0) {
            let message = sentences::BOTH_PIVOTS_ARE_ONE_POINT.into();
            return Err(wrong("pivots", message, sentences::GIVE_THE_ROCKER_A_PIVOT_OF_ITS_OWN));
        }
        if self.start == FunctionStart::World && self.pairs.len() > 3 {
            let message = sentences::world_angles_of_so_many_pairs(&self.pairs.len());
            return Err(wrong("pairs", message, sentences::LET_THE_START_BE_FREE));
        }
        check_apart("crank angles", &[], &self.turns(0))
    }

    /// Rotations of the crank (0) or of the rocker (1) from the first pair to every pair.
    fn turns(&self, link: usize) -> Vec<Complex> {
        turns_from_first(self.pairs.iter().map(|pair| pair[link]))
    }

    fn links(&self, arms: [Complex; 2]) -> [GroundLink; 2] {
        let link = |side: usize| {
            let pivot = self.pivots[side];
            GroundLink { pivot, pin: pivot + arms[side], turns: self.turns(side) }
        };
        [link(0), link(1)]
    }

    fn offer_freudenstein(&self, choice: &mut Choice) -> Result<()> {
        let frame = self.pivots[1] - self.pivots[0];
        let mut equations = Lu::new(3);
        let mut k = [0.0; 3];
        for (row, pair) in self.pairs.iter().enumerate() {
            let [phi, psi] = pair.map(|angle| angle - frame.arg());
            [psi.cos(), -phi.cos(), 1.0]
                .iter()
                .enumerate()
                .for_each(|(column, value)| equations.add(row, column, *value));
            k[row] = (phi - psi).cos();
        }
        let is_solved = equations.factor() && {
            let sizes = || equations.pivots().map(f64::abs);
            sizes().fold(f64::INFINITY, f64::smaller) > INDEPENDENT * sizes().fold(0.0, f64::larger)
        };
        if !is_solved {
            return Err(no_dyad(
                sentences::THE_PAIRS_DETERMINE_NO_FOUR_BAR,
                sentences::CHANGE_A_PAIR_OR_FREE_THE_START,
            ));
        }
        equations.solve(&mut k);
        let [a, c] = [frame.norm() / k[0], frame.norm() / k[1]];
        let [phi, psi] = self.pairs[0];
        let [crank, rocker] = self.links([a * Complex::from_polar(1.0, phi), c * Complex::from_polar(1.0, psi)]);
        choice.offer([&crank, &rocker]);
        Ok(())
    }

    fn offer_free(&self, choice: &mut Choice) -> Result<()> {
        let ways: Vec<Complex> = self.turns(1).iter().map(|turn| turn - 1.0).collect();
        let none = || no_dyad(sentences::ROCKER_AND_CRANK_TURN_ALIKE, sentences::CHANGE_A_PAIR_OR_USE_A_PARALLELOGRAM);
        let one = Complex::new(1.0, 0.0);
        for dyad in dyads(&self.turns(0), &ways).ok_or_else(none)? {
            // One solution is degenerate: its coupler turns with the rocker, and its crank and frame have no length.
            let frame = dyad.given + dyad.free - one;
            if frame.norm() > FRAME {
                let scale = (self.pivots[1] - self.pivots[0]) / frame;
                let [crank, rocker] = self.links([dyad.given * scale, one * scale]);
                choice.offer([&crank, &rocker]);
            }
        }
        Ok(())
    }
}
