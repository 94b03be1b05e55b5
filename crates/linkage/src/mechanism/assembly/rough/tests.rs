use super::super::random::{Lcg, group, mechanism, size};
use super::*;
use crate::math::KeepNan;
use crate::mechanism::{GroupKind, JointSide, LinkId};

/// The base links 6 and 5 are pinned to each other. Each base link has two leads.
/// Bases and leads form a group of six links and nine joints. All joints are closed in the pose.
fn case(random: &mut Lcg, slides: impl Fn(&mut Lcg) -> bool) -> (Mechanism, Group, Pose) {
    let mut pose = Pose((0..7).map(|_| random.pose()).collect());
    pose.0[LinkId(0)] = LinkPose::GROUND;
    let ends = [[0, 1], [0, 2], [3, 0], [4, 0], [1, 5], [5, 2], [3, 6], [6, 4], [5, 6]];
    let mut joints: Vec<Joint> = Vec::new();
    for (name, [a, b]) in ["A", "B", "C", "D", "E", "F", "G", "H", "I"].into_iter().zip(ends) {
        let slides = slides(random);
        let joint = random.joint(name, slides, LinkId(a), LinkId(b));
        joints.push(random.fitted(joint, &pose));
    }
    let mechanism = mechanism(7, joints);
    let group = group(&mechanism, &[1, 2, 3, 4, 5, 6].map(LinkId), GroupKind::Higher);
    (mechanism, group, pose)
}

/// All points of the group's links, after a random displacement of at most `by` in each coordinate.
fn drawing(random: &mut Lcg, mechanism: &Mechanism, group: &Group, pose: &Pose, by: f64) -> Vec<(SidePoint, Vec2)> {
    let mut near = Vec::new();
    for &link in &group.links {
        for point in &mechanism.links()[link].points {
            let side = JointSide { link, local: point.local };
            near.push((
                SidePoint { name: point.name.clone(), side },
                pose.0[link].point(point.local) + random.place() * by,
            ));
        }
    }
    near
}

#[test]
fn the_jacobian_is_the_derivative_of_the_gaps() {
    let mut random = Lcg(21);
    for _ in 0..20 {
        let (mechanism, group, mut pose) = case(&mut random, |random| random.yes());
        // Random poses are used, because all terms of the Jacobian contribute far from the closed pose.
        pose.0[1..].iter_mut().for_each(|link| *link = random.pose());
        let system = System { mechanism: &mechanism, group: &group, size: mechanism.size() };
        let rows = system.jacobian(&pose);
        let h = 1e-6;
        for column in 0..18 {
            let mut step = vec![0.0; 18];
            step[column] = -h;
            let ahead = system.gaps(&system.moved(&pose, &step));
            step[column] = h;
            let back = system.gaps(&system.moved(&pose, &step));
            for row in 0..18 {
                let slope = (ahead[row] - back[row]) / (2.0 * h);
                // The bound allows for the error of central differences: h^2 times third derivatives, plus rounding
                // error divided by h.
                assert!((slope - rows[row][column]).abs() < 1e-8, "{row} {column}: {slope} {}", rows[row][column]);
            }
        }
    }
}

/// The approximate positions have errors of at most 0.02 m in each coordinate.
/// The method usually finds the original pose again. Every returned pose is closed.
#[test]
fn a_rough_drawing_finds_its_configuration() {
    let mut random = Lcg(22);
    let (mut found, mut refused) = (0, 0);
    for number in 0..500 {
        let sliding = number % 2 == 1;
        let (mechanism, group, pose) = case(&mut random, |random| sliding && random.number(0.0, 1.0) < 0.2);
        let near = drawing(&mut random, &mechanism, &group, &pose, 0.02);
        let mut posed = pose.clone();
        posed.0[1..].iter_mut().for_each(|link| *link = LinkPose::GROUND);
        match place(&mechanism, &group, &near, &mut posed) {
            Ok(choice) => {
                let size = size(&mechanism, &posed);
                assert!(posed.closure(&mechanism) <= 1e-12 * size, "{}", posed.closure(&mechanism));
                let farthest =
                    near.iter().map(|(point, guess)| (posed.0[point.side.link].point(point.side.local) - guess).norm());
                assert_eq!(
                    choice,
                    ConfigurationChoice {
                        mode: AssemblyMode::Followed,
                        nearest_m: Some(farthest.fold(0.0, f64::larger)),
                        next_m: None
                    }
                );
                let same = posed.0.iter().zip(&pose.0).all(|(a, b)| (a.origin - b.origin).norm() < 1e-9);
                found += usize::from(same);
            }
            Err(error) => {
                assert!(error.kind() == ErrorKind::Geometry && error.way_out().is_some(), "{error}");
                assert!(posed.0[1..].iter().all(|link| *link == LinkPose::GROUND), "a refused group is not posed");
                refused += 1;
            }
        }
    }
    println!("{found} found, {refused} refused of 500");
    // More than 350 of the 500 samples must lead to the original pose.
    // In the remaining samples the drawing is nearer to a different configuration, or the pose is nearly singular.
    assert!(found > 350, "{found}");
}

#[test]
fn too_few_positions_are_refused_with_the_link() {
    let mut random = Lcg(23);
    let (mechanism, group, pose) = case(&mut random, |_| false);
    let near = drawing(&mut random, &mechanism, &group, &pose, 0.0);
    let error = place(&mechanism, &group, &near[..1], &mut pose.clone()).unwrap_err();
    assert!(error.to_string().contains("do not determine where link \"link1\" of the group lies"), "{error}");
    // One point is given for each of four links.
    // Links 1 and 2 are placed first, by their joints with the ground. Links 1 and 2 then determine link 5, and so on.
    let few: Vec<(SidePoint, Vec2)> = ["E1", "F2", "G3", "H4"]
        .iter()
        .map(|name| near.iter().find(|(point, _)| point.name == *name).expect("a point of that name").clone())
        .collect();
    let mut posed = pose.clone();
    place(&mechanism, &group, &few, &mut posed).unwrap();
    assert!(posed.0.iter().zip(&pose.0).all(|(a, b)| (a.origin - b.origin).norm() < 1e-9));
}

#[test]
fn a_drawing_far_from_any_configuration_is_refused() {
    let mut random = Lcg(24);
    let (mechanism, group, pose) = case(&mut random, |_| false);
    let mut near = drawing(&mut random, &mechanism, &group, &pose, 0.0);
    near.iter_mut().for_each(|(_, place)| *place += Vec2::new(9.0, 0.0));
    let error = place(&mechanism, &group, &near, &mut pose.clone()).unwrap_err();
    assert!(error.to_string().contains("half a link") || error.to_string().contains("no configuration"), "{error}");
}
