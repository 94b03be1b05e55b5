//! Random mechanisms in their start pose.
//! Links get random poses. The two links of a revolute joint have its pin at the same world position; those of a
//! prismatic joint have points on one line along its axis.
//! Every mechanism can therefore be assembled, and its start pose is known without solving.

use chacha20::ChaCha20Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use linkage::math::{KeepNan, Vec2, rotated, unit};
use linkage::mechanism::LinkPose;

use super::spec::{Guide, Pin, Spec, SpecimenLink};

/// Source of random numbers.
pub struct RandomSource(ChaCha20Rng);

impl RandomSource {
    /// The random numbers that follow from `seed`.
    pub fn from_seed(seed: u8) -> Self {
        RandomSource(ChaCha20Rng::from_seed([seed; 32]))
    }

    /// The random numbers of the sample `index`. Many samples follow from one seed.
    pub fn of_sample(seed: u64, index: u64) -> Self {
        let mut bytes = [0; 32];
        bytes[..8].copy_from_slice(&seed.to_le_bytes());
        bytes[8..16].copy_from_slice(&index.to_le_bytes());
        bytes[31] = 1;
        RandomSource(ChaCha20Rng::from_seed(bytes))
    }

    /// A positive number between `from` and `to`, whose logarithm is uniformly distributed.
    pub fn decades(&mut self, from: f64, to: f64) -> f64 {
        10f64.powf(self.number(from.log10(), to.log10()))
    }

    /// A number from `from` to `to`, uniformly distributed.
    pub fn number(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * (self.0.next_u64() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A random index below `count`.
    pub fn index(&mut self, count: usize) -> usize {
        self.number(0.0, count as f64) as usize
    }

    /// True or false with equal probability.
    pub fn yes(&mut self) -> bool {
        self.number(0.0, 1.0) < 0.5
    }

    /// An angle (rad) from a range slightly smaller than a full turn.
    pub fn angle(&mut self) -> f64 {
        self.number(-3.1, 3.1)
    }

    /// A vector in a random direction, with a length between `shortest` and `longest`.
    pub fn vector(&mut self, shortest: f64, longest: f64) -> Vec2 {
        unit(self.angle()) * self.number(shortest, longest)
    }
}

/// A joint of a random mechanism.
#[derive(Clone, Copy, Debug)]
pub struct DrawnJoint {
    /// World positions of the joint on its two links, in the order of the links passed to `join`.
    /// The two positions coincide for a revolute joint; for a prismatic joint they are two points along the axis.
    pub places: [Vec2; 2],
    /// World direction of a prismatic joint's axis; zero for a revolute joint.
    pub axis: Vec2,
    /// The link that is named first in the joint.
    pub first: usize,
}

/// A mechanism under construction. Link 0 is the ground, link 1 the crank.
pub struct SpecimenSketch<'a> {
    /// Source of the mechanism's random numbers.
    pub random: &'a mut RandomSource,
    /// The mechanism so far.
    pub spec: Spec,
    /// Pose of the ground and of every link.
    pub poses: Vec<LinkPose>,
    /// For every link, a representative link. Links that turn together have the same representative.
    turning: Vec<usize>,
    joints: usize,
}

/// Largest initial displacement of a slider (m).
const SLIDE: f64 = 0.5;

impl<'a> SpecimenSketch<'a> {
    /// A crank on the ground, with a length between the two values given (m).
    pub fn new(random: &'a mut RandomSource, crank: [f64; 2]) -> Self {
        let start = random.angle();
        let speed = random.number(0.5, 30.0) * if random.yes() { 1.0 } else { -1.0 };
        let (zero, gravity, guides_first) = (random.angle(), random.vector(0.0, 10.0), random.yes());
        let grid = (start - 0.3, 0.05, 12);
        let spec = Spec { guides_first, speed, zero, start, gravity, grid, dt: Some(1e-3), ..Spec::default() };
        let mut sketch = SpecimenSketch { random, spec, poses: vec![LinkPose::GROUND], turning: vec![0], joints: 0 };
        let pivot = sketch.random.vector(0.0, 0.5);
        let crank_link = sketch.link(pivot);
        sketch.poses[crank_link].angle = zero + start;
        sketch.join(false, 0, crank_link, pivot);
        // The crank's end is the point E. The distance of E from the pivot is the crank's length.
        let end = sketch.random.vector(crank[0], crank[1]);
        sketch.put(crank_link, "E", pivot + end);
        sketch
    }

    /// World position of the crank's end.
    pub fn crank_end(&self) -> Vec2 {
        let (_, end) = &self.spec.links[0].points[1];
        self.poses[1].point(*end)
    }

    /// A new link whose frame is near `at`.
    pub fn link(&mut self, at: Vec2) -> usize {
        let index = self.poses.len();
        self.poses.push(LinkPose { origin: at + self.random.vector(0.0, 0.3), angle: self.random.angle() });
        self.turning.push(index);
        self.spec.links.push(SpecimenLink { name: format!("link{index}"), points: Vec::new(), mass: None });
        index
    }

    /// Name of a link.
    pub fn name(&self, link: usize) -> String {
        if link == 0 { "ground".into() } else { self.spec.links[link - 1].name.clone() }
    }

    /// Name of the next joint.
    pub fn next_joint(&self) -> String {
        format!("J{}", self.joints)
    }

    fn local(&self, link: usize, at: Vec2) -> Vec2 {
        let pose = self.poses[link];
        rotated(unit(-pose.angle), at - pose.origin)
    }

    fn put(&mut self, link: usize, point: &str, at: Vec2) {
        let local = self.local(link, at);
        let points = if link == 0 { &mut self.spec.ground } else { &mut self.spec.links[link - 1].points };
        points.push((point.into(), local));
    }

    /// Joins links `a` and `b` at the position `at` on `a`. Either link may be named first.
    pub fn join(&mut self, slides: bool, a: usize, b: usize, at: Vec2) -> DrawnJoint {
        let name = self.next_joint();
        self.joints += 1;
        let is_turned = self.random.yes();
        let order = |pair: [usize; 2]| if is_turned { [pair[1], pair[0]] } else { pair };
        let links = order([a, b]).map(|link| self.name(link));
        let first = order([a, b])[0];
        if !slides {
            self.put(a, &name, at);
            self.put(b, &name, at);
            self.spec.pins.push(Pin { name, links });
            return DrawnJoint { places: [at, at], axis: Vec2::zeros(), first };
        }
        let angle = self.random.angle();
        let slide = self.random.number(-SLIDE, SLIDE);
        let axis = unit(angle);
        let places = [at, at + axis * slide];
        let points = [format!("A{name}"), format!("B{name}")];
        for (link, place) in [a, b].into_iter().zip(places) {
            self.put(link, &points[usize::from(link == b)], place);
        }
        let axes = order([a, b]).map(|link| angle - self.poses[link].angle);
        let [p, q] = points;
        let points = if is_turned { [q, p] } else { [p, q] };
        self.spec.guides.push(Guide { name, links, points, axes });
        let (kept, gone) = (self.turning[a].min(self.turning[b]), self.turning[a].max(self.turning[b]));
        self.turning.iter_mut().filter(|own| **own == gone).for_each(|own| *own = kept);
        DrawnJoint { places, axis, first }
    }

    /// Gives every link a mass, and some of the turning links a resistance. No mass centre is on a line between joints.
    pub fn finish(mut self) -> (Spec, Vec<LinkPose>) {
        for index in 0..self.spec.links.len() {
            let points = &self.spec.links[index].points;
            let middle = points.iter().map(|(_, at)| at).sum::<Vec2>() / points.len() as f64;
            let reach = points.iter().map(|(_, at)| (at - middle).norm()).fold(0.05, f64::larger);
            let centre = middle + self.random.vector(0.0, reach);
            let mass = self.random.number(0.1, 5.0);
            let inertia = mass * reach * reach * self.random.number(0.1, 1.0);
            self.spec.links[index].mass = Some((mass, centre, inertia));
            if self.turning[index + 1] != 0 && self.random.number(0.0, 1.0) < 0.3 {
                let load = self.random.number(0.0, 20.0);
                self.spec.loads.push((self.spec.links[index].name.clone(), load));
            }
        }
        (self.spec, self.poses)
    }
}
