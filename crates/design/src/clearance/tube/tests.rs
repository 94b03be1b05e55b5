//! Tests the bounds against samples: random joints between random tubes.
//! Most quantities are zero in half of the samples. Every term of a bound thus dominates in at least one sample.

use linkage::math::unit;
use linkage::mechanism::{JointKind, JointSide, LinkId};

use super::*;

/// Number of random joints. `POSES` is the number of poses that are tried for each joint.
const JOINTS: usize = 4_000;
const POSES: usize = 30;

/// Repeatable random numbers (Knuth's MMIX generator).
struct Random(u64);

impl Random {
    /// Returns a number from -1 to 1.
    fn number(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    fn yes(&mut self) -> bool {
        self.number() > 0.0
    }

    /// Returns, with equal probability, zero or a random number of at most `most` in magnitude.
    fn some(&mut self, most: f64) -> f64 {
        let number = most * self.number();
        if self.yes() { number } else { 0.0 }
    }

    fn vector(&mut self, most: f64) -> Vec2 {
        let size = self.some(most);
        unit(4.0 * self.number()) * size
    }
}

/// Pose of a link: its reference point and its angle.
type Place = (Vec2, f64);

fn point(tube: &Tube, (at, angle): Place, local: Vec2) -> Vec2 {
    at + rotated(unit(angle), local - tube.centre)
}

/// Returns a random pose within the tube, often on its boundary. `by` is the crank angle from the middle.
fn place(tube: &Tube, by: f64, random: &mut Random) -> Place {
    let mut share = || if random.yes() { random.number() } else { random.number().signum() };
    let (off, twist) = (tube.off * share(), tube.twist * share());
    let middle = tube.direction.y.atan2(tube.direction.x);
    (tube.at + tube.rate * by + unit(4.0 * random.number()) * off, middle + tube.spin * by + twist)
}

fn tube(random: &mut Random, half: f64) -> Tube {
    Tube {
        centre: random.vector(1.0),
        at: random.vector(1.0),
        rate: random.vector(1.0),
        direction: unit(4.0 * random.number()),
        spin: random.some(1.0),
        off: random.some(0.01).abs(),
        twist: random.some(0.02).abs(),
        half,
    }
}

/// Random joint of two links, with the tubes of both links. A prismatic joint nearly closes at the middle.
/// The sample also states which of the two links belong to the group.
struct Sample {
    joint: Joint,
    tubes: [Tube; 2],
    own: [bool; 2],
    half: f64,
    /// Rate of the joint's coordinate.
    rate: f64,
}

impl Sample {
    fn of(random: &mut Random) -> Sample {
        let half = 0.1 * random.number().abs();
        let mut tubes = [tube(random, half), tube(random, half)];
        let locals = tubes.map(|tube| tube.centre + random.vector(1.0));
        let sides = [0, 1].map(|link| JointSide { link: LinkId(link), local: locals[link] });
        let slides = random.yes();
        let axis = unit(4.0 * random.number());
        if slides {
            // The axes are nearly parallel and the sliding point is near the guide's line, so the joint nearly closes.
            let turn = unit(random.some(0.01));
            let along = rotated(tubes[0].direction, axis);
            let gap = along * random.some(1.0) + turned(along) * random.some(0.01);
            let arm = rotated(tubes[1].direction, locals[1] - tubes[1].centre);
            tubes[1].at = tubes[0].point(locals[0]).at + gap - arm;
            let back = Vec2::new(tubes[1].direction.x, -tubes[1].direction.y);
            let axes = [axis, rotated(back, rotated(turn, along))];
            return Sample::with(JointKind::Prismatic { axes }, sides, tubes, half, random);
        }
        Sample::with(JointKind::Revolute, sides, tubes, half, random)
    }

    fn with(
        kind: JointKind,
        [first, second]: [JointSide; 2],
        tubes: [Tube; 2],
        half: f64,
        random: &mut Random,
    ) -> Sample {
        let joint = Joint { name: "j".into(), kind, first, second, drawn: None };
        let own = if random.yes() { [true, random.yes()] } else { [false, true] };
        Sample { joint, tubes, own, half, rate: random.some(1.0) }
    }

    /// Residuals of the joint's equations at the crank angle `by` from the middle (rad).
    /// For a revolute joint, the equations state that the two links' points coincide.
    /// For a prismatic joint, the equations state that the second link's point lies on the first link's line, and that
    /// the axes of both links are parallel. The third equation states that the joint's coordinate changes at `rate`.
    fn open(&self, places: [Place; 2], by: f64) -> [f64; 3] {
        let (now, middle) = (self.coordinate(places), self.coordinate(self.middle()));
        let [first, second] = self.gaps(places);
        [first, second, now - middle - self.rate * by]
    }

    fn middle(&self) -> [Place; 2] {
        self.tubes.map(|tube| (tube.at, tube.direction.y.atan2(tube.direction.x)))
    }

    fn coordinate(&self, places: [Place; 2]) -> f64 {
        let [first, second] =
            [0, 1].map(|k| point(&self.tubes[k], places[k], [self.joint.first, self.joint.second][k].local));
        match self.joint.kind.axes() {
            Some(axes) => rotated(unit(places[0].1), axes[0]).dot(&(second - first)),
            None => places[1].1 - places[0].1,
        }
    }

    fn gaps(&self, places: [Place; 2]) -> [f64; 2] {
        let sides = [self.joint.first, self.joint.second];
        let [first, second] = [0, 1].map(|k| point(&self.tubes[k], places[k], sides[k].local));
        let gap = second - first;
        let Some(axes) = self.joint.kind.axes() else { return [gap.x, gap.y] };
        let [one, two] = [0, 1].map(|k| rotated(unit(places[k].1), axes[k]));
        [cross(one, gap), cross(one, two).atan2(one.dot(&two))]
    }

    /// Derivative of the equations with respect to the poses of the group's links, by central differences.
    fn derivative(&self, places: [Place; 2]) -> Matrix {
        const STEP: f64 = 1e-5;
        let mut found = Matrix::zeros(3, 6);
        for column in (0..6).filter(|column| self.own[column / 3]) {
            let [ahead, behind] = [STEP, -STEP].map(|step| {
                let mut moved = places;
                let (at, angle) = &mut moved[column / 3];
                match column % 3 {
                    0 => at.x += step,
                    1 => at.y += step,
                    _ => *angle += step,
                }
                self.open(moved, 0.0)
            });
            for row in 0..3 {
                found[(row, column)] = (ahead[row] - behind[row]) / (2.0 * STEP);
            }
        }
        found
    }

    fn column(&self) -> impl Fn(LinkId) -> Option<usize> {
        let own = self.own;
        move |link: LinkId| own[link].then_some(3 * link.index())
    }

    fn rows(&self) -> Vec<Row<'_>> {
        closure(&self.joint).into_iter().chain([motion(&self.joint, self.rate)]).collect()
    }

    fn equations(&self) -> (Matrix, Vec<f64>) {
        let mut derivative = Matrix::zeros(3, 6);
        let open = equations(&self.rows(), &self.tubes, self.half, &self.column(), &mut derivative);
        (derivative, open)
    }
}

/// Random crank angle from the middle. Half of the samples lie at an end of the part.
fn distance(half: f64, random: &mut Random) -> f64 {
    half * if random.yes() { random.number() } else { random.number().signum() }
}

#[test]
fn points_stay_within_the_error_of_their_tracks() {
    let mut random = Random(1);
    for _ in 0..JOINTS {
        let half = 0.1 * random.number().abs();
        let (tube, local) = (tube(&mut random, half), random.vector(1.0));
        let track = tube.point(local);
        for _ in 0..POSES {
            let by = distance(half, &mut random);
            let off = point(&tube, place(&tube, by, &mut random), local) - track.at - track.rate * by;
            assert!(off.norm() <= track.error * (1.0 + 1e-12) + 1e-15, "{off} {track:?} {tube:?}");
            let moved = (off + track.rate * by).norm();
            assert!(moved <= track.reach(half) * (1.0 + 1e-12) + 1e-15, "{moved} {track:?} {tube:?}");
        }
    }
}

/// Tests the bound on the residuals of a joint.
/// Links of the group move uniformly. Links outside the group have random poses in their tubes.
#[test]
fn closure_errors_are_within_their_bound() {
    let mut random = Random(2);
    let mut tightest = [[0.0; 3]; 2];
    for _ in 0..JOINTS {
        let sample = Sample::of(&mut random);
        let (_, open) = sample.equations();
        for _ in 0..POSES {
            let by = distance(sample.half, &mut random);
            let places = [0, 1].map(|k| {
                let tube = &sample.tubes[k];
                let even = Tube { off: 0.0, twist: 0.0, ..*tube };
                place(if sample.own[k] { &even } else { tube }, by, &mut random)
            });
            for (row, found) in sample.open(places, by).into_iter().enumerate() {
                let bound = open[row] * (1.0 + 1e-12) + 1e-14;
                assert!(found.abs() <= bound, "row {row}: {found} {open:?} {:?}", sample.joint.kind);
                let slides = usize::from(sample.joint.kind.axes().is_some());
                tightest[slides][row] = f64::larger(tightest[slides][row], found.abs() / bound);
            }
        }
    }
    // The bound is also tight: in the tightest sample, the residual is above 0.99 of the bound.
    assert!(tightest.iter().flatten().all(|share| *share > 0.99), "{tightest:?}");
}

#[test]
fn the_derivative_is_the_limit_of_differences() {
    let mut random = Random(3);
    for _ in 0..JOINTS {
        let sample = Sample::of(&mut random);
        let off = (sample.equations().0 - sample.derivative(sample.middle())).amax();
        assert!(off < 1e-8, "{off} {:?}", sample.joint.kind);
    }
}

/// Tests the bound on the following product: the change of the derivative over a box, times the radii of the box.
#[test]
fn the_change_of_the_derivative_is_within_its_bound() {
    let mut random = Random(4);
    let mut tightest: f64 = 0.0;
    for _ in 0..JOINTS {
        let mut sample = Sample::of(&mut random);
        let mut radii = vec![0.0; 6];
        for link in (0..2).filter(|&link| sample.own[link]) {
            let [x, y, twist] = [0.01, 0.01, 0.02].map(|most| random.some(most).abs());
            radii[3 * link..3 * link + 3].copy_from_slice(&[x, y, twist]);
            (sample.tubes[link].off, sample.tubes[link].twist) = (x.hypot(y), twist);
        }
        let changes = changes(&sample.rows(), &sample.tubes, sample.half, &sample.column(), &radii);
        let (middle, _) = sample.equations();
        for _ in 0..POSES {
            let by = distance(sample.half, &mut random);
            let places = [0, 1].map(|k| place(&sample.tubes[k], by, &mut random));
            let off = (sample.derivative(places) - &middle).abs();
            for (row, bound) in changes.iter().enumerate() {
                let found: f64 = (0..6).map(|column| off[(row, column)] * radii[column]).sum();
                assert!(found <= bound * (1.0 + 1e-12) + 1e-9 * radii.iter().sum::<f64>(), "{row}: {found} {bound}");
                if *bound > 1e-6 {
                    tightest = tightest.larger(found / bound);
                }
            }
        }
    }
    assert!(tightest > 0.99, "{tightest}");
}
