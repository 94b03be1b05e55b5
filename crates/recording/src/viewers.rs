//! Messages that viewers of the Foxglove family can draw: scenes, frames and log lines.
//! The messages have only the fields used here.
//! Names and numbers of the fields are taken from Foxglove's schemas (foxglove/schemas, Protobuf).
//! The descriptors in the directory `viewers` also come from Foxglove.
//! Tests compare messages and descriptors with Foxglove's SDK.

use prost::{Enumeration, Message};
use prost_types::Timestamp;

/// A message with a schema that viewers know.
pub trait ViewerMessage: Message {
    /// Name of the schema.
    const SCHEMA: &'static str;
    /// The schema, a `FileDescriptorSet`.
    const DESCRIPTOR: &'static [u8];
}

macro_rules! known {
    ($($name:ident)*) => {
        $(impl ViewerMessage for $name {
            const SCHEMA: &'static str = concat!("foxglove.", stringify!($name));
            const DESCRIPTOR: &'static [u8] = include_bytes!(concat!("viewers/", stringify!($name), ".bin"));
        })*
    };
}

known! { FrameTransforms Log SceneUpdate }

/// The messages as tables: name, type, number and kind of each field.
macro_rules! messages {
    ($($(#[$about:meta])* $name:ident { $($field:ident: $type:ty = $tag:tt ($($kind:tt)+),)* })*) => {
        $($(#[$about])* #[derive(Clone, PartialEq, Message)]
        pub struct $name { $(#[prost($($kind)+, tag = $tag)] pub $field: $type,)* })*
    };
}

messages! {
    /// A vector, a point, or the edges of a box (m).
    #[derive(Copy)]
    Vector3 {
        x: f64 = 1 (double),
        y: f64 = 2 (double),
        z: f64 = 3 (double),
    }

    /// A rotation.
    #[derive(Copy)]
    Quaternion {
        x: f64 = 1 (double),
        y: f64 = 2 (double),
        z: f64 = 3 (double),
        w: f64 = 4 (double),
    }

    /// A position and a rotation.
    #[derive(Copy)]
    Pose {
        position: Option<Vector3> = 1 (message, optional),
        orientation: Option<Quaternion> = 2 (message, optional),
    }

    /// A colour. Each component of the colour is from 0 to 1.
    #[derive(Copy)]
    Color {
        r: f64 = 1 (double),
        g: f64 = 2 (double),
        b: f64 = 3 (double),
        a: f64 = 4 (double),
    }

    /// An arrow along the x axis of its pose (m).
    #[derive(Copy)]
    ArrowPrimitive {
        pose: Option<Pose> = 1 (message, optional),
        shaft_length: f64 = 2 (double),
        shaft_diameter: f64 = 3 (double),
        head_length: f64 = 4 (double),
        head_diameter: f64 = 5 (double),
        color: Option<Color> = 6 (message, optional),
    }

    /// An ellipsoid.
    #[derive(Copy)]
    SpherePrimitive {
        pose: Option<Pose> = 1 (message, optional),
        size: Option<Vector3> = 2 (message, optional),
        color: Option<Color> = 3 (message, optional),
    }

    /// A cylinder, or a cone, along the z axis of its pose.
    #[derive(Copy)]
    CylinderPrimitive {
        pose: Option<Pose> = 1 (message, optional),
        size: Option<Vector3> = 2 (message, optional),
        bottom_scale: f64 = 3 (double),
        top_scale: f64 = 4 (double),
        color: Option<Color> = 5 (message, optional),
    }

    /// A line through points.
    LinePrimitive {
        r#type: i32 = 1 (enumeration = "LineType"),
        pose: Option<Pose> = 2 (message, optional),
        thickness: f64 = 3 (double),
        scale_invariant: bool = 4 (bool),
        points: Vec<Vector3> = 5 (message, repeated),
        color: Option<Color> = 6 (message, optional),
    }

    /// Triangles, three points each.
    TriangleListPrimitive {
        pose: Option<Pose> = 1 (message, optional),
        points: Vec<Vector3> = 2 (message, repeated),
        color: Option<Color> = 3 (message, optional),
    }

    /// A text at a pose.
    TextPrimitive {
        pose: Option<Pose> = 1 (message, optional),
        billboard: bool = 2 (bool),
        font_size: f64 = 3 (double),
        scale_invariant: bool = 4 (bool),
        color: Option<Color> = 5 (message, optional),
        text: String = 6 (string),
    }

    /// Shapes that move with a frame.
    SceneEntity {
        timestamp: Option<Timestamp> = 1 (message, optional),
        frame_id: String = 2 (string),
        id: String = 3 (string),
        frame_locked: bool = 5 (bool),
        arrows: Vec<ArrowPrimitive> = 7 (message, repeated),
        spheres: Vec<SpherePrimitive> = 9 (message, repeated),
        cylinders: Vec<CylinderPrimitive> = 10 (message, repeated),
        lines: Vec<LinePrimitive> = 11 (message, repeated),
        triangles: Vec<TriangleListPrimitive> = 12 (message, repeated),
        texts: Vec<TextPrimitive> = 13 (message, repeated),
    }

    /// Entities of a scene.
    SceneUpdate {
        entities: Vec<SceneEntity> = 2 (message, repeated),
    }

    /// The pose of a frame relative to its parent frame.
    FrameTransform {
        timestamp: Option<Timestamp> = 1 (message, optional),
        parent_frame_id: String = 2 (string),
        child_frame_id: String = 3 (string),
        translation: Option<Vector3> = 4 (message, optional),
        rotation: Option<Quaternion> = 5 (message, optional),
    }

    /// The poses of frames at an instant.
    FrameTransforms {
        transforms: Vec<FrameTransform> = 1 (message, repeated),
    }

    /// A line of a log.
    Log {
        timestamp: Option<Timestamp> = 1 (message, optional),
        level: i32 = 2 (enumeration = "LogLevel"),
        message: String = 3 (string),
        name: String = 4 (string),
    }
}

/// How a line joins its points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
#[repr(i32)]
pub enum LineType {
    /// From point to point.
    LineStrip = 0,
    /// A line through all points and back to the first point.
    LineLoop = 1,
}

/// Severity of a log line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
#[repr(i32)]
pub enum LogLevel {
    /// Not stated.
    Unknown = 0,
    /// For information.
    Info = 2,
    /// A warning.
    Warning = 3,
    /// An error.
    Error = 4,
}

#[cfg(test)]
mod tests {
    use super::*;
    use foxglove::Encode;
    use foxglove::messages as sdk;

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
        for (ours, theirs) in [
            (LogLevel::Info as i32, sdk::log::Level::Info as i32),
            (LogLevel::Error as i32, sdk::log::Level::Error as i32),
        ] {
            assert_eq!(ours, theirs);
        }
    }

    fn again<S: Message + Default + Encode, K: ViewerMessage>(ours: &K) {
        let bytes = ours.encode_to_vec();
        assert_eq!(S::decode(&*bytes).unwrap().encode_to_vec(), bytes, "{}", K::SCHEMA);
        let schema = S::get_schema().unwrap();
        assert_eq!((schema.name.as_str(), &*schema.data), (K::SCHEMA, K::DESCRIPTOR));
    }
}
