//! Recordings of mechanisms with sliders: one topic per joint, and the picture contains every mark of the sketch.

use crate::common::assert_within;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use analytic::AssurSolver;
use drawing::{Mark, MarkRole, Sketch, Travels};
use linkage::case::Case;
use linkage::math::Vec2;
use linkage::mechanism::{GROUND, LinkPose};
use linkage::solver::Solver;
use linkage::trajectory::Trajectory;
use prost::Message;
use recording::viewers::{LineType, SceneEntity, SceneUpdate};
use recording::{RecordedSide, Recording, Show, load, write};
use scenario::Scenario;

const SLIDERS: [&str; 5] = ["compressor", "six_bar_slider", "quick_return", "scotch_yoke", "tangent"];

/// Machines with friction, with transmissions, or with driven slides in addition to driven cranks.
const MACHINES: [&str; 5] = ["slider_crank_friction", "cam_follower", "planetary_train", "robot_arm", "platform_3rpr"];

/// A scenario's case, its reference solution on its grid, its recording, and the solution read back.
fn recorded(name: &str) -> (Case, Trajectory, Vec<u8>, Trajectory) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios").join(format!("{name}.toml"));
    let case = Scenario::load(&path).unwrap().case;
    let trajectory = AssurSolver.solve(&case).unwrap();
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("slider.mcap");
    let sides = [RecordedSide { name: "reference", trajectory: &trajectory }];
    let recording = Recording {
        name,
        scenario_text: "",
        metadata: &BTreeMap::new(),
        mechanism: &case.mechanism,
        sides: &sides,
        errors: None,
        log: &[],
        show: Show { forces: true, ..Show::default() },
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
fn all_channels_are_read_back_from_one_topic_per_subject() {
    for name in SLIDERS.into_iter().chain(MACHINES) {
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
        assert!(schemas.values().all(|contents| contents.len() == 1), "two schemas have the same name");
        let sliding = case.mechanism.joints().iter().filter(|joint| joint.slides());
        assert!(sliding.clone().count() == 0 || schemas.keys().any(|name| name.ends_with("Slider")), "{name}");
        for joint in sliding {
            assert!(topics.contains_key(&format!("/reference/joint/{}", joint.name)));
        }
    }
}

/// Every mark of the diagram is at its position in the frame of its link.
/// A guide is as long as the travel of its slide.
#[test]
fn every_mark_is_drawn_in_the_frame_of_its_link() {
    for name in SLIDERS {
        let (case, trajectory, bytes, _) = recorded(name);
        let mechanism = &case.mechanism;
        let mut travels = Travels::none(mechanism);
        for row in 0..trajectory.times().len() {
            travels.take_in(mechanism, |link, local| {
                if link == GROUND {
                    return Some(local);
                }
                let own = &mechanism.links()[link];
                let value =
                    |suffix: &str| trajectory.named(&format!("link.{}.{suffix}", own.name)).map(|column| column[row]);
                let at = Vec2::new(value("x_m")?, value("y_m")?);
                Some(LinkPose::through(own.mass_centre, at, value("angle_rad")?).point(local))
            });
        }
        let sketch = Sketch::of(mechanism, &travels, drawing::unit(mechanism));
        let scene: SceneUpdate = messages(&bytes, "/mechanism/links").remove(0);
        let mut robot = String::from_utf8(robot(&bytes)).unwrap();
        robot.retain(|sign| sign != '\0');
        let robot = roxmltree::Document::parse(&robot[robot.find('<').unwrap()..]).unwrap();
        for body in &sketch.bodies {
            let link = &mechanism.links()[body.link].name;
            let id = if body.link == GROUND { "ground".into() } else { format!("reference/{link}") };
            let entity = entity(&scene, &id);
            assert_eq!(entity.frame_id, if body.link == GROUND { "world".into() } else { id.clone() });
            let flat =
                |mark: &&Mark| !matches!(mark.role, MarkRole::Pin | MarkRole::MassCentre | MarkRole::MassQuarter);
            let mut lines = entity.lines.iter();
            for (_, mark) in sketch.in_order().into_iter().filter(|(of, mark)| *of == body.link && flat(mark)) {
                let (points, closed) = (mark.shape.points(), mark.shape.is_closed());
                let line = lines.next().unwrap();
                assert_eq!(line.r#type == LineType::LineLoop as i32, closed, "{name} {id} {:?}", mark.role);
                assert_eq!(line.points.len(), points.len());
                for (drawn, wanted) in line.points.iter().zip(points) {
                    // The picture is in single precision.
                    assert_within!((Vec2::new(drawn.x, drawn.y) - wanted).norm(), 1e-6, "{name} {id} {:?}", mark.role);
                }
            }
            assert!(lines.next().is_none(), "{name} {id}");
            let pins = body.marks.iter().filter(|mark| mark.role == MarkRole::Pin).count();
            // Each pin has a cylinder for the disc and a cylinder for the hole in the disc.
            assert_eq!(entity.cylinders.len(), 2 * pins, "{name} {id}");
            let frame = entity.frame_id.as_str();
            let own =
                robot.descendants().find(|node| node.has_tag_name("link") && node.attribute("name") == Some(frame));
            let parts = own.unwrap().children().filter(|node| node.has_tag_name("visual")).count();
            let segments = entity.lines.iter().map(|line| match line.r#type == LineType::LineLoop as i32 {
                true => line.points.len(),
                false => line.points.len() - 1,
            });
            assert_eq!(parts, segments.sum::<usize>() + 2 * pins, "{name} {id}");
        }
    }
}

/// The robot description in the file.
fn robot(bytes: &[u8]) -> Vec<u8> {
    let mut all = mcap::MessageStream::new(bytes).unwrap().map(Result::unwrap);
    let message = all.find(|message| message.channel.topic == "/robot_description").unwrap();
    message.data[8..].to_vec()
}
