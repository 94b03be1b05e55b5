//! Messages and descriptors for viewers agree with the SDK of Foxglove.

use foxglove::Encode;
use foxglove::messages as sdk;
use prost::Message;
use prost_types::Timestamp;
use recording::viewers::*;

/// All fields used here are filled with different numbers, read by the SDK and written again.
#[test]
fn the_sdk_reads_and_writes_the_same_bytes() {
    let pose = Some(Pose {
        position: Some(Vector3 { x: 1.0, y: 2.0, z: 3.0 }),
        orientation: Some(Quaternion { x: 0.1, y: 0.2, z: 0.3, w: 0.4 }),
    });
    let color = Some(Color { r: 0.5, g: 0.6, b: 0.7, a: 0.8 });
    let size = Some(Vector3 { x: 4.0, y: 5.0, z: 6.0 });
    let points = vec![Vector3 { x: 7.0, y: 8.0, z: 9.0 }];
    let timestamp = Some(Timestamp { seconds: 11, nanos: 12 });
    let entity = SceneEntity {
        timestamp,
        frame_id: "frame".into(),
        id: "id".into(),
        frame_locked: true,
        arrows: vec![ArrowPrimitive {
            pose,
            shaft_length: 1.5,
            shaft_diameter: 1.6,
            head_length: 1.7,
            head_diameter: 1.8,
            color,
        }],
        spheres: vec![SpherePrimitive { pose, size, color }],
        cylinders: vec![CylinderPrimitive { pose, size, bottom_scale: 2.5, top_scale: 2.6, color }],
        lines: vec![LinePrimitive {
            r#type: LineType::LineLoop as i32,
            pose,
            thickness: 3.5,
            scale_invariant: true,
            points: points.clone(),
            color,
        }],
        triangles: vec![TriangleListPrimitive { pose, points, color }],
        texts: vec![TextPrimitive {
            pose,
            billboard: true,
            font_size: 4.5,
            scale_invariant: true,
            color,
            text: "text".into(),
        }],
    };
    let scene = SceneUpdate { entities: vec![entity] };
    let (parent_frame_id, child_frame_id) = ("parent".to_string(), "child".to_string());
    let transform = FrameTransform {
        timestamp,
        parent_frame_id,
        child_frame_id,
        translation: size,
        rotation: Some(Quaternion { x: 0.1, y: 0.2, z: 0.3, w: 0.4 }),
    };
    let frames = FrameTransforms { transforms: vec![transform] };
    let log = Log { timestamp, level: LogLevel::Warning as i32, message: "message".into(), name: "name".into() };
    again::<sdk::SceneUpdate, _>(&scene);
    again::<sdk::FrameTransforms, _>(&frames);
    again::<sdk::Log, _>(&log);
    for (ours, theirs) in
        [(LogLevel::Info as i32, sdk::log::Level::Info as i32), (LogLevel::Error as i32, sdk::log::Level::Error as i32)]
    {
        assert_eq!(ours, theirs);
    }
}

fn again<S: Message + Default + Encode, K: ViewerMessage>(ours: &K) {
    let bytes = ours.encode_to_vec();
    assert_eq!(S::decode(&*bytes).unwrap().encode_to_vec(), bytes, "{}", K::SCHEMA);
    let schema = S::get_schema().unwrap();
    assert_eq!((schema.name.as_str(), &*schema.data), (K::SCHEMA, K::DESCRIPTOR));
}
