//! The known forces on links, for several poses at once: inertia, weight, moments of resistance, and the reactions of
//! later groups.

use super::bodies::Body;
use super::lanes::{Columns, Lanes, Plane, Tile};
use linkage::math::Vec2;
use pulp::Simd;

/// Number of columns in the working memory for the known forces on a link.
pub(super) const OF_LOAD: usize = 5;

/// The resultant of the known forces on a link (2 columns), its moment about the link's pole (1), and the world
/// position of this pole (2).
#[derive(Clone, Copy)]
pub(super) struct LoadColumns<'a, S: Simd>(Columns<'a, S>);

impl<'a, S: Simd> LoadColumns<'a, S> {
    /// The columns number `index` in the working memory.
    #[inline(always)]
    pub(super) fn of(work: Columns<'a, S>, index: usize) -> Self {
        LoadColumns(work.adjacent::<OF_LOAD>(OF_LOAD * index))
    }

    /// The resultant and its moment.
    #[inline(always)]
    pub(super) fn get(self, part: usize) -> (Plane<S>, Lanes<S>) {
        (self.0.vector(0, part), self.0.get(2, part))
    }

    #[inline(always)]
    fn put(self, part: usize, (force, moment): (Plane<S>, Lanes<S>)) {
        self.0.put_vector(0, part, force);
        self.0.put(2, part, moment);
    }
}

impl Body {
    /// Computes the resultant of all known forces on the link and their moment about the point `local` of the link.
    #[inline(always)]
    pub(super) fn load_about<S: Simd>(&self, local: Vec2, gravity: Vec2, tile: Tile<S>, sum: LoadColumns<S>) {
        let (link, mut pole) = (tile.columns.link(self.link), sum.0.adjacent::<2>(3));
        if local == Vec2::zeros() {
            pole = link.origin();
        } else {
            for part in tile.parts() {
                pole.put_vector(0, part, link.get(part).point(local));
            }
        }
        self.load(gravity, tile, pole, sum);
    }

    /// Computes the resultant of all known forces on the link and their moment about the world points `pole`.
    /// The operations and their order are the same as in the module `assur::forces`.
    #[inline(always)]
    pub(super) fn load<S: Simd>(&self, gravity: Vec2, tile: Tile<S>, pole: Columns<S>, sum: LoadColumns<S>) {
        let (link, zero) = (tile.columns.link(self.link), Lanes::splat(pole.on, 0.0));
        let (mass, mass_centre, inertia) = (self.mass, self.mass_centre, self.inertia);
        // The loads are added before the moment of the force at the mass centre.
        macro_rules! inertial {
            (|$force:ident, $moment:ident, $omega:ident| $loaded:expr) => {
                for part in tile.parts() {
                    let link = link.get(part);
                    let arm = link.direction.rotate(mass_centre);
                    let [centre, _, acceleration] = link.at(arm);
                    let $force = (Plane::splat(pole.on, gravity) - acceleration) * mass;
                    let ($moment, $omega) = (-(link.alpha * inertia), link.omega);
                    let (force, moment) = $loaded;
                    sum.put(part, (force, moment + (centre - pole.vector(0, part)).cross(force)));
                }
            };
        }
        match self.resistance {
            None => inertial!(|force, moment, _omega| (force, moment)),
            Some(size) => inertial!(|force, moment, omega| {
                let backwards = zero.exceeds(omega).of(zero + size, zero);
                (force + Vec2::zeros(), moment + omega.exceeds(zero).of(zero - size, backwards))
            }),
        }
        for action in &self.hanging {
            let (hung, sign, place) = (tile.columns.adjacent::<2>(action.force), action.sign, action.place);
            for part in tile.parts() {
                let (force, moment) = sum.get(part);
                let hung = hung.vector(0, part).signed(sign);
                let arm = link.get(part).point(place) - pole.vector(0, part);
                sum.put(part, (force + hung, moment + arm.cross(hung)));
            }
        }
    }
}
