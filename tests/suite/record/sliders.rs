//! Recordings of mechanisms with sliders: one topic per joint, guides and blocks in the picture.

use crate::common::assert_within;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use analytic::AssurSolver;
use foxglove::messages::line_primitive::Type as LineType;
use foxglove::messages::{PointCloud, SceneEntity, SceneUpdate};
use linkage::case::Case;
use linkage::math::{Vec2, cross, rotated, unit};
use linkage::mechanism::GROUND;
use linkage::solver::Solver;
use linkage::trajectory::{Channel, Trajectory};
use linkproof::record::{Recording, Side, load, write};
use linkproof::scenario::Scenario;
use prost::Message;

const SLIDERS: [&str; 5] = ["compressor", "six_bar_slider", "quick_return", "scotch_yoke", "tangent"];

/// A scenario's reference on its own grid, and its recording.
fn recorded(name: &str) -> (Case, Trajectory, Vec<u8>, Trajectory) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios").join(format!("{name}.toml"));
    let case = Scenario::load(&path).unwrap().case;
    let trajectory = AssurSolver.solve(&case).unwrap();
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("slider.mcap");
    let sides = [Side { name: "reference", trajectory: &trajectory }];
    let recording = Recording {
        name,
        scenario_text: "",
        metadata: &BTreeMap::new(),
        mechanism: &case.mechanism,
        sides: &sides,
        errors: None,
        log: &[],
    };
    write(&recording, &file).unwrap();
    let back = load(&file).unwrap().remove(0).1;
    (case, trajectory, fs::read(&file).unwrap(), back)
}

fn messages<M: Message + Default>(bytes: &[u8], topic: &str) -> Vec<M> {
    let all = mcap::MessageStream::new(bytes).unwrap().map(Result::unwrap);
    all.filter(|message| message.channel.topic == topic).map(|message| M::decode(&message.data[..]).unwrap()).collect()
}

fn entity(scene: &SceneUpdate, id: &str) -> SceneEntity {
    scene.entities.iter().find(|entity| entity.id == id).unwrap().clone()
}

#[test]
fn every_channel_of_a_slider_is_read_back_from_one_topic_a_joint() {
    for name in SLIDERS {
        let (case, written, bytes, back) = recorded(name);
        assert_eq!(back.channels().len(), written.channels().len(), "{name}");
        for (channel, column) in written.iter() {
            let same = back.column(channel).unwrap().iter().zip(column).all(|(a, b)| a.to_bits() == b.to_bits());
            assert!(same, "{name} {channel}");
        }
        let mut schemas: BTreeMap<String, BTreeSet<Vec<u8>>> = BTreeMap::new();
        let mut topics: BTreeMap<String, u16> = BTreeMap::new();
        for message in mcap::MessageStream::new(&bytes).unwrap().map(Result::unwrap) {
            let channel = &message.channel;
            assert_eq!(*topics.entry(channel.topic.clone()).or_insert(channel.id), channel.id, "{}", channel.topic);
            let schema = channel.schema.as_ref().unwrap();
            schemas.entry(schema.name.clone()).or_default().insert(schema.data.to_vec());
        }
        assert!(schemas.values().all(|contents| contents.len() == 1), "a name of two schemas");
        let sliding = case.mechanism.joints().iter().filter(|joint| joint.slides());
        assert!(sliding.clone().count() > 0 && schemas.contains_key("linkproof.Slider"));
        for joint in sliding {
            assert!(topics.contains_key(&format!("/reference/joint/{}", joint.name)));
        }
    }
}

/// Rails are on both sides of the axis and contain the block in all its positions. Only pivots have triangles.
#[test]
fn rails_span_the_slide_and_guide_points_are_no_pivots() {
    for (name, pivots) in SLIDERS.into_iter().zip([1, 2, 2, 1, 1]) {
        let (case, trajectory, bytes, _) = recorded(name);
        let scene: SceneUpdate = messages(&bytes, "/mechanism/links").remove(0);
        let ground = entity(&scene, "ground");
        assert_eq!(ground.triangles[0].points.len(), 3 * pivots, "{name}");
        let fixed: Vec<_> = case.mechanism.joints().iter().filter(|j| j.slides() && j.on(GROUND).is_some()).collect();
        assert_eq!(ground.lines.len(), pivots + 2 * fixed.len(), "{name}");
        for (joint, rails) in fixed.iter().zip(ground.lines[pivots..].chunks(2)) {
            let (axis, origin) = (joint.axis_on(GROUND).unwrap(), joint.first.local);
            let slide = trajectory.column(&Channel::named(&format!("joint.{}.slide_m", joint.name)).unwrap()).unwrap();
            let ends = |k: usize| rails[k].points.iter().map(|p| Vec2::new(p.x, p.y) - origin).collect::<Vec<_>>();
            for rail in [ends(0), ends(1)] {
                let ways: Vec<f64> = rail.iter().map(|end| end.dot(&axis)).collect();
                assert!(slide.iter().all(|s| ways[0] < *s && *s < ways[1]), "{name} {}", joint.name);
            }
            // Single precision of half a metre.
            assert_within!((cross(axis, ends(0)[0]) + cross(axis, ends(1)[0])).abs(), 1e-6);
            assert!(cross(axis, ends(0)[0]) > 0.01 * case.mechanism.size());
        }
    }
}

/// A block is a closed rectangle in the frame of its link, so that it turns with it. A moving guide is a line through
/// its place along its axis.
#[test]
fn blocks_are_rectangles_and_moving_guides_lines_along_their_axes() {
    for name in SLIDERS {
        let (case, trajectory, bytes, _) = recorded(name);
        let mechanism = &case.mechanism;
        let scene: SceneUpdate = messages(&bytes, "/mechanism/links").remove(0);
        let lines = |link: usize| {
            let entity = entity(&scene, &format!("reference/{}", mechanism.links()[link].name));
            let points = |line: &foxglove::messages::LinePrimitive| {
                line.points.iter().map(|p| Vec2::new(p.x, p.y)).collect::<Vec<_>>()
            };
            entity.lines.iter().map(|line| (line.r#type == LineType::LineLoop as i32, points(line))).collect::<Vec<_>>()
        };
        for joint in mechanism.joints().iter().filter(|joint| joint.slides()) {
            let [guide, block] = mechanism.guide_and_block(joint).unwrap();
            let axis = joint.axis_on(block.link).unwrap();
            let rectangle = lines(block.link).into_iter().find(|(closed, points)| {
                let centre = points.iter().sum::<Vec2>() / points.len() as f64;
                *closed && points.len() == 4 && (centre - block.local).norm() < 1e-6
            });
            let (_, corners) = rectangle.unwrap_or_else(|| panic!("{name}: no block at {}", joint.name));
            let sides = [corners[1] - corners[0], corners[2] - corners[1]];
            // Single precision of the corners.
            assert_within!(cross(sides[0], axis).abs(), 1e-6, "{name} {}", joint.name);
            assert_within!(sides[1].dot(&axis).abs(), 1e-6, "{name} {}", joint.name);
            assert!(sides[0].norm() > sides[1].norm());
            if guide.link == GROUND {
                continue;
            }
            let axis = joint.axis_on(guide.link).unwrap();
            let slide = trajectory.column(&Channel::named(&format!("joint.{}.slide_m", joint.name)).unwrap()).unwrap();
            let held = |points: &Vec<Vec2>| {
                let on = points.iter().all(|point| cross(axis, point - guide.local).abs() < 1e-6);
                let ways = [points[0], points[1]].map(|point| (point - guide.local).dot(&axis));
                on && slide.iter().all(|s| ways[0] < *s && *s < ways[1])
            };
            assert!(lines(guide.link).iter().any(|(closed, points)| !closed && held(points)), "{name} {}", joint.name);
        }
    }
}

/// The cloud shows the blocks too: points around the sliding point, at the block's distance, at the link's place at
/// that time.
#[test]
fn the_cloud_holds_blocks_where_they_are() {
    let (case, trajectory, bytes, _) = recorded("quick_return");
    let clouds: Vec<PointCloud> = messages(&bytes, "/mechanism/outline");
    let column = |name: &str| trajectory.column(&Channel::named(name).unwrap()).unwrap();
    let size = case.mechanism.size();
    for (cloud, row) in clouds.iter().zip((0..).step_by(2)).take(150) {
        let at = Vec2::new(column("point.A.x_m")[row], column("point.A.y_m")[row]);
        let direction = unit(-column("link.block.angle_rad")[row]);
        let coordinate = |data: &[u8]| f64::from(f32::from_le_bytes(data.try_into().unwrap()));
        let points = cloud.data.chunks(16).map(|p| Vec2::new(coordinate(&p[..4]), coordinate(&p[4..8])));
        let near: Vec<Vec2> =
            points.map(|point| rotated(direction, point - at)).filter(|d| d.norm() < 0.05 * size).collect();
        // Coordinates are rounded to the size over 1024; the long sides are at 0.022 of it.
        let beside = |sign: f64| near.iter().any(|d| (d.y - sign * 0.022 * size).abs() < size / 1024.0);
        assert!(beside(1.0) && beside(-1.0), "row {row}");
    }
}
