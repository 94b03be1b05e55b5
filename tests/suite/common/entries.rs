//! Properties that every input must satisfy, however bad the input is.
//! The property tests and the fuzz targets in `fuzz/` call the same functions.
//!
//! Each function panics if a property is violated.
//! Termination and memory are monitored from outside.

use std::io::Cursor;
use std::path::Path;

use arbitrary::{Result, Unstructured};
use formula::{FormulaGraph, FormulaTree, Program, Rounded};
use linkage::math::{Vec2, unit};
use linkage::mechanism::{
    DrivingLink, GROUND, Joint, JointId, JointKind, JointSide, Link, LinkId, Mechanism, Point, Structure, is_unseen,
};
use linkage::trajectory::CHANNELS;
use linkage::{Error, ErrorKind};
use scenario::Scenario;

/// Checks the text of a scenario file: the text loads, or its error gives the user enough information.
pub fn scenario(text: &str) -> Option<Scenario> {
    let path = Path::new("no_such_directory/scenario.toml");
    match Scenario::parse(text, path) {
        Ok(scenario) => {
            let case = &scenario.case;
            assert!(case.grid.times.iter().chain(&case.grid.inputs).all(|value| value.is_finite()));
            assert!(case.start.0.iter().all(|pose| pose.angle.is_finite() && pose.origin.norm().is_finite()));
            assert_eq!(case.channels().len(), case.channels().iter().collect::<Vec<_>>().len());
            Some(scenario)
        }
        Err(error) => {
            explains(&error, text);
            None
        }
    }
}

/// Checks that an error of a scenario file has a message and a location, and is not a numerical error.
/// The error must also name a key, unless the error concerns the whole file.
pub fn explains(error: &Error, text: &str) {
    let shown = format!("{error}");
    assert!(!error.message().trim().is_empty(), "an error without a message");
    assert_ne!(error.kind(), ErrorKind::Numeric, "loading must not end with a numerical error: {shown}");
    let place = error.place().unwrap_or_else(|| panic!("no place: {shown}"));
    if place.file.extension().is_some_and(|own| own == "toml") {
        assert!(place.line() <= text.split('\n').count().max(1), "line {} does not exist: {shown}", place.line());
        let is_whole = error.message().starts_with("the file is not valid TOML")
            || error.message().starts_with("the file contains no scenario")
            || error.message().starts_with("a key ");
        assert!(error.scenario_key().is_some_and(|key| !key.is_empty()) || is_whole, "no key: {shown}");
    }
}

/// The text of a formula: either it is parsed, differentiated twice and evaluated, or it is refused with its location.
pub fn formula(text: &str) {
    let tree = match FormulaTree::parse(text) {
        Ok(tree) => tree,
        Err(fault) => {
            assert!(!fault.message.is_empty() && !fault.help.is_empty());
            assert!(fault.at.end <= text.len() && text.get(fault.at.clone()).is_some(), "{fault:?}");
            return;
        }
    };
    let written = tree.to_string();
    assert_eq!(FormulaTree::parse(&written).expect(&written).to_string(), written);
    let mut graph = FormulaGraph::new(&["phi", "t"], 0);
    let Ok(place) = graph.add(&tree) else { return };
    let speed = graph.derivative(place, 0);
    let acceleration = graph.derivative(speed, 0);
    let mut program = Program::of(&graph, &[place, speed, acceleration]);
    for value in program.run(&[Rounded::nearly(0.7), Rounded::nearly(0.1)]) {
        assert!(!(value.error < 0.0), "{written}: {value:?}");
    }
}

/// Any links and joints: either their structure is refused, or the structure's driving links and groups fulfil their
/// definitions.
pub fn structure(bytes: &[u8]) -> Result<()> {
    let mut from = Unstructured::new(bytes);
    let Ok((mechanism, drives)) = mechanism(&mut from)? else { return Ok(()) };
    let structure = match Structure::of(&mechanism, &drives) {
        Ok(structure) => structure,
        Err(error) => {
            assert!(!error.message().is_empty());
            return Ok(());
        }
    };
    // The links are added from the ground outwards: first the driving links, then the groups in their order.
    // Every group is joined to links that were added before it, and every joint is used exactly once.
    let (mut known, mut used) = (vec![GROUND], Vec::new());
    for (_, &DrivingLink { link, joint, .. }) in structure.leading() {
        assert!(!known.contains(&link), "link {link} is solved twice");
        assert!(mechanism.joints()[joint].on(link).is_some());
        known.push(link);
        used.push(joint);
    }
    for group in &structure.groups {
        let equations = 2 * (group.inner.len() + group.outer.len()) + group.given.len();
        assert_eq!(3 * group.links.len(), equations, "{group:?} is no Assur group");
        for &link in &group.links {
            assert!(!known.contains(&link), "link {link} is solved twice");
        }
        for &joint in &group.outer {
            let ends = [mechanism.joints()[joint].first.link, mechanism.joints()[joint].second.link];
            assert_eq!(ends.iter().filter(|end| known.contains(end)).count(), 1, "outer joint {joint} of {group:?}");
        }
        for &joint in &group.inner {
            let ends = [mechanism.joints()[joint].first.link, mechanism.joints()[joint].second.link];
            assert!(ends.iter().all(|end| group.links.contains(end)), "inner joint {joint} of {group:?}");
        }
        known.extend(&group.links);
        used.extend(group.inner.iter().chain(&group.outer));
    }
    known.sort_unstable();
    used.sort_unstable();
    assert_eq!(known, mechanism.links().ids().collect::<Vec<_>>());
    assert_eq!(used, mechanism.joints().ids().collect::<Vec<_>>());
    // The structural formula, with names and classes of the groups, contains only visible characters.
    assert!(!structure.formula(&mechanism).contains(is_unseen));
    assert_eq!(structure.upstream(&mechanism).len(), mechanism.links().len());
    Ok(())
}

type DrawnJoint = (Mechanism, Vec<JointId>);

/// Up to 64 links with joints between any two of them, and up to four drives.
fn mechanism(from: &mut Unstructured) -> Result<std::result::Result<DrawnJoint, Error>> {
    let moving = from.int_in_range(1..=63usize)?;
    let drives = from.int_in_range(1..=4usize)?;
    // In half of the random structures, the number of joints gives the mobility that the drives need.
    let fitting = (3 * moving).saturating_sub(drives) / 2;
    let joints = if from.arbitrary()? { fitting } else { from.int_in_range(0..=100usize)? };
    let links = (0..=moving)
        .map(|index| {
            let place = |from: &mut Unstructured| Ok(Vec2::new(f64::from(from.arbitrary::<i8>()?), 1.0));
            let points = ["P", "Q"].map(|name| format!("{name}{index}"));
            let points = points.into_iter().map(|name| Ok(Point { name, local: place(from)? }));
            let (points, mass_centre) = (points.collect::<Result<_>>()?, Vec2::zeros());
            Ok(Link { name: format!("L{index}"), points, mass: 1.0, mass_centre, inertia: 1.0 })
        })
        .collect::<Result<Vec<Link>>>()?;
    let joints = (0..joints)
        .map(|index| {
            let side = |from: &mut Unstructured, link: LinkId| {
                Ok(JointSide { link, local: links[link].points[usize::from(from.arbitrary::<bool>()?)].local })
            };
            // Links with close numbers are joined more often than links with distant numbers.
            // Without this preference, hardly any structure decomposes into groups.
            let first = from.int_in_range(0..=moving)?;
            let second = match from.arbitrary()? {
                true => (first + from.int_in_range(0..=3usize)?) % (moving + 1),
                false => from.int_in_range(0..=moving)?,
            };
            let kind = match from.ratio(1, 4)? {
                true => JointKind::Prismatic { axes: [0.0, 1.0].map(unit) },
                false => JointKind::Revolute,
            };
            Ok(Joint {
                name: format!("J{index}"),
                kind,
                first: side(from, LinkId(first))?,
                second: side(from, LinkId(second))?,
                drawn: None,
            })
        })
        .collect::<Result<Vec<Joint>>>()?;
    let drives =
        (0..drives).map(|_| Ok(JointId(from.choose_index(joints.len().max(1))?))).collect::<Result<Vec<JointId>>>()?;
    Ok(match joints.is_empty() {
        true => Err(Error::new(ErrorKind::Input, "no joint")),
        false => Mechanism::new(links, joints).map(|mechanism| (mechanism, drives)),
    })
}

/// Reads a recording made from `bytes`. The reader must refuse the file, or every side in it must be a trajectory.
/// If the first byte is even, the remaining bytes are the file.
/// If the first byte is odd, the remaining bytes determine topics and messages of a complete file.
pub fn recording(bytes: &[u8]) -> Result<()> {
    let Some((first, rest)) = bytes.split_first() else { return Ok(()) };
    let file = match first % 2 {
        0 => rest.to_vec(),
        _ => drawn_file(&mut Unstructured::new(rest))?,
    };
    match recording::read_bytes(&file, Path::new("drawn.mcap")) {
        Ok(sides) => {
            assert!(!sides.is_empty());
            for (_, side) in sides {
                let rows = side.times().len();
                assert!(rows > 0 && side.inputs().len() == rows);
                assert!(side.iter().all(|(_, column)| column.len() == rows && column.iter().all(|v| v.is_finite())));
            }
        }
        Err(error) => {
            let message = format!("{error}");
            assert!(message.contains("drawn.mcap") || error.kind() == ErrorKind::Numeric, "no path: {message}");
        }
    }
    Ok(())
}

/// A file with topics, descriptors and messages of any kind; most of these parts are valid, or valid except for one
/// detail.
fn drawn_file(from: &mut Unstructured) -> Result<Vec<u8>> {
    let options = mcap::WriteOptions::new().compression(None).chunk_size(None);
    let mut file = options.create(Cursor::new(Vec::new())).expect("memory can be written");
    for _ in 0..from.int_in_range(0..=4)? {
        let side = ["reference", "engine", "error", ""][from.choose_index(4)?];
        let subject = ["grid", "link/crank", "joint/A", "drive", "frame", "//", "grid/grid"][from.choose_index(7)?];
        let names: Vec<String> = match (subject, from.ratio(1, 8)?) {
            (_, true) => vec![from.arbitrary()?, "t_s".into()],
            ("grid", _) => ["t_s", "crank_rad", "row"].map(String::from).to_vec(),
            _ => {
                (0..3).map(|_| Ok(CHANNELS[from.choose_index(CHANNELS.len())?].suffix.into())).collect::<Result<_>>()?
            }
        };
        let descriptor = if from.ratio(1, 8)? { from.arbitrary()? } else { descriptor(&names, from)? };
        let schema = file.add_schema("linkproof.Any", "protobuf", &descriptor);
        let topic = format!("/{side}/{subject}");
        let Ok(topic) = schema.and_then(|id| file.add_channel(id, &topic, "protobuf", &Default::default())) else {
            continue;
        };
        for sequence in 0..from.int_in_range(0..=4u32)? {
            let mut data = Vec::new();
            for tag in 1..=names.len() as u64 {
                let value: f64 = if from.ratio(1, 16)? { from.arbitrary()? } else { f64::from(sequence) };
                data.push((tag << 3 | 1) as u8);
                data.extend(value.to_le_bytes());
            }
            if from.ratio(1, 8)? {
                data.extend(from.arbitrary::<[u8; 4]>()?);
            }
            let sequence = if from.ratio(1, 16)? { from.arbitrary()? } else { sequence };
            let header = mcap::records::MessageHeader { channel_id: topic, sequence, log_time: 0, publish_time: 0 };
            file.write_to_known_channel(&header, &data).expect("memory can be written");
        }
    }
    file.finish().expect("memory can be written");
    Ok(file.into_inner().into_inner())
}

/// A descriptor of one message with double fields of these names.
/// Most field numbers follow the order of the list; some are arbitrary.
fn descriptor(names: &[String], from: &mut Unstructured) -> Result<Vec<u8>> {
    use prost::Message;
    use prost_types::{DescriptorProto, FieldDescriptorProto, FileDescriptorProto, FileDescriptorSet};
    let field = |(index, name): (usize, &String)| {
        let number = if from.ratio(1, 16)? { from.arbitrary()? } else { index as i32 + 1 };
        Ok(FieldDescriptorProto {
            name: Some(name.clone()),
            number: Some(number),
            r#type: Some(1),
            ..FieldDescriptorProto::default()
        })
    };
    let field = names.iter().enumerate().map(field).collect::<Result<_>>()?;
    let message = DescriptorProto { name: Some("Any".into()), field, ..DescriptorProto::default() };
    let file = FileDescriptorProto {
        package: Some("linkproof".into()),
        message_type: vec![message],
        ..FileDescriptorProto::default()
    };
    Ok(FileDescriptorSet { file: vec![file] }.encode_to_vec())
}
