//! Instant centres of all pairs of links, by the theorem of three centres, and the acceleration centres of all links.
//!
//! A mechanism of n links with the ground has n (n - 1) / 2 instant centres.
//! A pin is the centre of its two links. The centre of a guide and its block is at infinity, across the guide.
//! The three centres of three links lie on one line (Aronhold 1872, Kennedy 1886).
//! The centre of the links i and j is therefore the intersection of two lines: one goes through the centres ik and kj,
//! the other through the centres im and mj.
//! The two members of a transmission have the same speed along their line of action, so their centre lies on this line.
//! These constructions use only the pose.
//! If fewer than two lines through a centre are known, the centre is computed from the velocities.
//! Further centres may then be found by lines through this centre.
//! [`InstantCentre::slip`] compares every centre with the solved velocities.

use linkage::math::centre::{MotionCentre, MotionNoise, instant_centre};
use linkage::math::projective::Projective;
use linkage::math::{KeepNan, Motion, Vec2, corners, turned};
use linkage::mechanism::{LinkId, Mechanism};

/// Velocities and accelerations below this fraction of the mechanism's largest ones are rounding errors.
const ROUNDING: f64 = 1e-12;

/// A line on which a centre lies.
#[derive(Clone, Debug, PartialEq)]
pub enum CentreLine {
    /// Line through two other centres: the centre of the first link and this third link, and the centre of the second
    /// link and this third link.
    Through(LinkId),
    /// Line of action of a transmission.
    Contact {
        /// Name of the transmission.
        name: String,
        /// A point of the line, at which the force acts on the first member (world, m).
        foot: Vec2,
    },
}

/// How a centre was found.
#[derive(Clone, Debug, PartialEq)]
pub enum CentreOrigin {
    /// The pin with this name.
    Pin(String),
    /// At infinity, across a guide.
    Guide {
        /// Name of the joint.
        name: String,
        /// Sliding point of the block (world, m).
        block: Vec2,
    },
    /// The centres of the first and of the second link with this third link coincide. The centre is at the same point.
    Common(LinkId),
    /// Intersection of two lines.
    Lines([CentreLine; 2]),
    /// From the velocities of the links, because no two lines through the centre are known.
    Velocities,
}

/// Instant centre of two links.
#[derive(Clone, Debug, PartialEq)]
pub struct InstantCentre {
    /// The links, the smaller number first.
    pub links: [LinkId; 2],
    /// Position of the centre.
    pub place: MotionCentre,
    /// How the centre was found.
    pub origin: CentreOrigin,
    /// Difference of the solved velocities of both links at the centre (m/s): zero except for rounding errors.
    /// For a centre at infinity, the value is the sum of two magnitudes: the component of the velocity difference
    /// towards the centre, and the difference of the angular velocities times the size of the mechanism.
    pub slip: f64,
    /// Velocity to which `slip` is compared (m/s): an upper bound of the relative velocity of the two links, over all
    /// points within the mechanism's size.
    pub speed: f64,
}

/// All centres of one instant.
#[derive(Clone, Debug, PartialEq)]
pub struct Centres {
    /// Instant centres of all pairs of links.
    pub instant: Vec<InstantCentre>,
    /// Acceleration centre of every moving link, relative to the ground.
    pub acceleration: Vec<(LinkId, MotionCentre)>,
}

impl Centres {
    /// Finds all centres of a mechanism whose links have these motions.
    pub fn of(mechanism: &Mechanism, motions: &[Motion]) -> Self {
        let mut finder = Finder::of(mechanism, motions);
        finder.direct();
        loop {
            let missing: Vec<[LinkId; 2]> = finder.missing().collect();
            let Some(&first) = missing.first() else { break };
            let found = missing.into_iter().filter_map(|pair| Some((pair, finder.constructed(pair)?)));
            let found: Vec<_> = found.collect();
            if found.is_empty() {
                let place = finder.by_velocities(first);
                finder.put(first, place, CentreOrigin::Velocities);
            }
            for (pair, (place, origin)) in found {
                finder.put(pair, Some(place), origin);
            }
        }
        let acceleration = mechanism.links().ids().skip(1);
        let acceleration = acceleration.map(|link| (link, motions[link].acceleration_centre(finder.noise[1])));
        Centres { acceleration: acceleration.collect(), instant: finder.finish() }
    }

    /// The instant centre of two links.
    pub fn between(&self, one: LinkId, other: LinkId) -> Option<&InstantCentre> {
        self.instant.iter().find(|centre| centre.links == [one, other] || centre.links == [other, one])
    }
}

struct Finder<'a> {
    mechanism: &'a Mechanism,
    motions: &'a [Motion],
    middle: Vec2,
    size: f64,
    /// Rounding errors of velocities, and of accelerations.
    noise: [MotionNoise; 2],
    /// For every pair of links: the centre, and how it was found; the outer `None` marks a centre that is not found
    /// yet.
    /// The inner centre is `None` if the links do not move relative to each other.
    found: Vec<Option<(Option<Projective>, CentreOrigin)>>,
}

impl<'a> Finder<'a> {
    fn of(mechanism: &'a Mechanism, motions: &'a [Motion]) -> Self {
        let pins = mechanism.joints().iter().map(|joint| motions[joint.first.link].point(joint.first.local));
        let [low, high] = corners(pins);
        let size = mechanism.size().larger((high - low).norm());
        let most = |of: fn(&Motion) -> f64| motions.iter().map(of).fold(0.0, f64::larger);
        let noise = |turning: f64, shift: f64| MotionNoise {
            turning: ROUNDING * turning.larger(shift / size),
            shift: ROUNDING * shift.larger(turning * size),
        };
        let noise = [
            noise(most(|own| own.omega.abs()), most(|own| own.velocity.norm())),
            noise(most(|own| own.omega.powi(2).hypot(own.alpha)), most(|own| own.acceleration.norm())),
        ];
        let found = vec![None; motions.len().pow(2)];
        Finder { mechanism, motions, middle: (low + high) / 2.0, size, noise, found }
    }

    fn pairs(&self) -> impl Iterator<Item = [LinkId; 2]> + use<> {
        let links = self.motions.len();
        (0..links).flat_map(move |first| (first + 1..links).map(move |second| [LinkId(first), LinkId(second)]))
    }

    fn missing(&self) -> impl Iterator<Item = [LinkId; 2]> + '_ {
        self.pairs().filter(|pair| self.found[self.index(*pair)].is_none())
    }

    fn index(&self, [one, other]: [LinkId; 2]) -> usize {
        one.index().min(other.index()) * self.motions.len() + one.index().max(other.index())
    }

    fn put(&mut self, pair: [LinkId; 2], place: Option<Projective>, origin: CentreOrigin) {
        let index = self.index(pair);
        self.found[index].get_or_insert((place, origin));
    }

    fn known(&self, pair: [LinkId; 2]) -> Option<Projective> {
        self.found[self.index(pair)].as_ref().and_then(|(place, _)| *place)
    }

    /// Converts a world position (m) to units in which the size of the mechanism is about 1.
    fn inner(&self, at: Vec2) -> Vec2 {
        (at - self.middle) / self.size
    }

    /// Stores the centres of pins and guides.
    fn direct(&mut self) {
        for joint in self.mechanism.joints().iter() {
            let first = &self.motions[joint.first.link];
            let name = joint.name.clone();
            let place = self.inner(first.point(joint.first.local));
            let (place, origin) = match (joint.axis_on(joint.first.link), self.mechanism.guide_and_block(joint)) {
                (Some(axis), Some([_, block])) => {
                    let block = self.motions[block.link].point(block.local);
                    (Projective::at_infinity(turned(first.arm(axis))), CentreOrigin::Guide { name, block })
                }
                (None, _) | (_, None) => (Projective::point(place), CentreOrigin::Pin(name)),
            };
            self.put([joint.first.link, joint.second.link], Some(place), origin);
        }
    }

    /// Constructs a centre from the centres found so far and the lines of action, as the intersection of two lines.
    /// Of all pairs of lines, it takes the pair that is closest to perpendicular.
    fn constructed(&self, pair: [LinkId; 2]) -> Option<(Projective, CentreOrigin)> {
        let [one, other] = pair;
        let mut lines: Vec<(Projective, CentreLine)> = Vec::new();
        for third in self.mechanism.links().ids().filter(|third| !pair.contains(third)) {
            let (Some(near), Some(far)) = (self.known([one, third]), self.known([third, other])) else { continue };
            match near.with(far) {
                Some((line, _)) => lines.push((line, CentreLine::Through(third))),
                None => return Some((near, CentreOrigin::Common(third))),
            }
        }
        for train in self.mechanism.transmissions().iter() {
            let [first, second, carrier] = train.links();
            if [first, second] != pair && [second, first] != pair {
                continue;
            }
            let (carrier, contact) = (&self.motions[carrier], train.contact_in(self.mechanism.joints(), self.motions));
            lines.extend(contact.lines.iter().map(|line| {
                let foot = carrier.point(line.feet[0]);
                let line = Projective::line(self.inner(foot), carrier.arm(line.direction));
                (line, CentreLine::Contact { name: train.name().to_string(), foot })
            }));
        }
        let meetings = lines.iter().enumerate().flat_map(|(index, one)| {
            lines[index + 1..].iter().filter_map(move |other| {
                let (place, sine) = one.0.with(other.0)?;
                Some((sine, place, [one.1.clone(), other.1.clone()]))
            })
        });
        let (_, place, lines) = meetings.max_by(|one, other| one.0.total_cmp(&other.0))?;
        Some((place, CentreOrigin::Lines(lines)))
    }

    fn by_velocities(&self, [one, other]: [LinkId; 2]) -> Option<Projective> {
        match instant_centre(&self.motions[one], &self.motions[other], self.noise[0]) {
            MotionCentre::At(at) => Some(Projective::point(self.inner(at))),
            MotionCentre::AtInfinity(direction) => Some(Projective::at_infinity(direction)),
            MotionCentre::Nowhere | MotionCentre::Everywhere => None,
        }
    }

    fn finish(self) -> Vec<InstantCentre> {
        let one = |links: [LinkId; 2]| {
            let (place, origin) = self.found[self.index(links)].clone()?;
            let relative = self.motions[links[1]].relative_to(&self.motions[links[0]]);
            let speed = relative.velocity_at(self.middle).norm() + relative.omega.abs() * self.size;
            let (place, slip) = match place.map(Projective::place) {
                Some(Ok(at)) => {
                    // A coordinate below the rounding error of the mechanism's size is set to zero.
                    let at = (self.middle + at * self.size)
                        .map(|own| if own.abs() > ROUNDING * self.size { own } else { 0.0 });
                    (MotionCentre::At(at), relative.velocity_at(at).norm())
                }
                Some(Err(direction)) => {
                    let along = relative.velocity_at(self.middle).dot(&direction);
                    (MotionCentre::AtInfinity(direction), along.abs() + relative.omega.abs() * self.size)
                }
                None => (MotionCentre::Everywhere, speed),
            };
            Some(InstantCentre { links, place, origin, slip, speed })
        };
        self.pairs().filter_map(one).collect()
    }
}
