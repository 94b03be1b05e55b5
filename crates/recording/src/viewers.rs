//! Messages that viewers of the Foxglove family draw by themselves: scenes, frames and log lines, with the fields that
//! are used here. Names and numbers are those of Foxglove's schemas (foxglove/schemas, Protobuf). The descriptors beside
//! this file are theirs; tests hold both against Foxglove's SDK.

use prost::{Enumeration, Message};
use prost_types::Timestamp;

/// A message with a schema that viewers know.
pub trait Known: Message {
    /// Name of the schema.
    const SCHEMA: &'static str;
    /// The schema, a `FileDescriptorSet`.
    const DESCRIPTOR: &'static [u8];
}

macro_rules! known {
    ($($name:ident)*) => {
        $(impl Known for $name {
            const SCHEMA: &'static str = concat!("foxglove.", stringify!($name));
            const DESCRIPTOR: &'static [u8] = include_bytes!(concat!("viewers/", stringify!($name), ".bin"));
        })*
    };
}

known! { FrameTransforms Log SceneUpdate }

/// A vector, or the edges of a box (m).
#[derive(Clone, Copy, PartialEq, Message)]
pub struct Vector3 {
    /// Along x.
    #[prost(double, tag = "1")]
    pub x: f64,
    /// Along y.
    #[prost(double, tag = "2")]
    pub y: f64,
    /// Along z.
    #[prost(double, tag = "3")]
    pub z: f64,
}

/// A point (m).
#[derive(Clone, Copy, PartialEq, Message)]
pub struct Point3 {
    /// Along x.
    #[prost(double, tag = "1")]
    pub x: f64,
    /// Along y.
    #[prost(double, tag = "2")]
    pub y: f64,
    /// Along z.
    #[prost(double, tag = "3")]
    pub z: f64,
}

/// A rotation.
#[derive(Clone, Copy, PartialEq, Message)]
pub struct Quaternion {
    /// Along x.
    #[prost(double, tag = "1")]
    pub x: f64,
    /// Along y.
    #[prost(double, tag = "2")]
    pub y: f64,
    /// Along z.
    #[prost(double, tag = "3")]
    pub z: f64,
    /// Real part.
    #[prost(double, tag = "4")]
    pub w: f64,
}

/// A place and a rotation.
#[derive(Clone, Copy, PartialEq, Message)]
pub struct Pose {
    /// Position.
    #[prost(message, optional, tag = "1")]
    pub position: Option<Vector3>,
    /// Orientation.
    #[prost(message, optional, tag = "2")]
    pub orientation: Option<Quaternion>,
}

/// A colour, 0 to 1.
#[derive(Clone, Copy, PartialEq, Message)]
pub struct Color {
    /// Red.
    #[prost(double, tag = "1")]
    pub r: f64,
    /// Green.
    #[prost(double, tag = "2")]
    pub g: f64,
    /// Blue.
    #[prost(double, tag = "3")]
    pub b: f64,
    /// Opacity.
    #[prost(double, tag = "4")]
    pub a: f64,
}

/// An arrow along the x axis of its pose (m).
#[derive(Clone, Copy, PartialEq, Message)]
pub struct ArrowPrimitive {
    /// Pose.
    #[prost(message, optional, tag = "1")]
    pub pose: Option<Pose>,
    /// Shaft length.
    #[prost(double, tag = "2")]
    pub shaft_length: f64,
    /// Shaft diameter.
    #[prost(double, tag = "3")]
    pub shaft_diameter: f64,
    /// Head length.
    #[prost(double, tag = "4")]
    pub head_length: f64,
    /// Head diameter.
    #[prost(double, tag = "5")]
    pub head_diameter: f64,
    /// Color.
    #[prost(message, optional, tag = "6")]
    pub color: Option<Color>,
}

/// An ellipsoid.
#[derive(Clone, Copy, PartialEq, Message)]
pub struct SpherePrimitive {
    /// Pose.
    #[prost(message, optional, tag = "1")]
    pub pose: Option<Pose>,
    /// Size.
    #[prost(message, optional, tag = "2")]
    pub size: Option<Vector3>,
    /// Color.
    #[prost(message, optional, tag = "3")]
    pub color: Option<Color>,
}

/// A cylinder, or a cone, along the z axis of its pose.
#[derive(Clone, Copy, PartialEq, Message)]
pub struct CylinderPrimitive {
    /// Pose.
    #[prost(message, optional, tag = "1")]
    pub pose: Option<Pose>,
    /// Size.
    #[prost(message, optional, tag = "2")]
    pub size: Option<Vector3>,
    /// Bottom scale.
    #[prost(double, tag = "3")]
    pub bottom_scale: f64,
    /// Top scale.
    #[prost(double, tag = "4")]
    pub top_scale: f64,
    /// Color.
    #[prost(message, optional, tag = "5")]
    pub color: Option<Color>,
}

/// A line through points.
#[derive(Clone, PartialEq, Message)]
pub struct LinePrimitive {
    /// Type.
    #[prost(enumeration = "LineType", tag = "1")]
    pub r#type: i32,
    /// Pose.
    #[prost(message, optional, tag = "2")]
    pub pose: Option<Pose>,
    /// Thickness.
    #[prost(double, tag = "3")]
    pub thickness: f64,
    /// Scale invariant.
    #[prost(bool, tag = "4")]
    pub scale_invariant: bool,
    /// Points.
    #[prost(message, repeated, tag = "5")]
    pub points: Vec<Point3>,
    /// Color.
    #[prost(message, optional, tag = "6")]
    pub color: Option<Color>,
}

/// Triangles, three points each.
#[derive(Clone, PartialEq, Message)]
pub struct TriangleListPrimitive {
    /// Pose.
    #[prost(message, optional, tag = "1")]
    pub pose: Option<Pose>,
    /// Points.
    #[prost(message, repeated, tag = "2")]
    pub points: Vec<Point3>,
    /// Color.
    #[prost(message, optional, tag = "3")]
    pub color: Option<Color>,
}

/// A text at a pose.
#[derive(Clone, PartialEq, Message)]
pub struct TextPrimitive {
    /// Pose.
    #[prost(message, optional, tag = "1")]
    pub pose: Option<Pose>,
    /// Billboard.
    #[prost(bool, tag = "2")]
    pub billboard: bool,
    /// Font size.
    #[prost(double, tag = "3")]
    pub font_size: f64,
    /// Scale invariant.
    #[prost(bool, tag = "4")]
    pub scale_invariant: bool,
    /// Color.
    #[prost(message, optional, tag = "5")]
    pub color: Option<Color>,
    /// Text.
    #[prost(string, tag = "6")]
    pub text: String,
}

/// What moves with a frame.
#[derive(Clone, PartialEq, Message)]
pub struct SceneEntity {
    /// Timestamp.
    #[prost(message, optional, tag = "1")]
    pub timestamp: Option<Timestamp>,
    /// Frame id.
    #[prost(string, tag = "2")]
    pub frame_id: String,
    /// Id.
    #[prost(string, tag = "3")]
    pub id: String,
    /// Frame locked.
    #[prost(bool, tag = "5")]
    pub frame_locked: bool,
    /// Arrows.
    #[prost(message, repeated, tag = "7")]
    pub arrows: Vec<ArrowPrimitive>,
    /// Spheres.
    #[prost(message, repeated, tag = "9")]
    pub spheres: Vec<SpherePrimitive>,
    /// Cylinders.
    #[prost(message, repeated, tag = "10")]
    pub cylinders: Vec<CylinderPrimitive>,
    /// Lines.
    #[prost(message, repeated, tag = "11")]
    pub lines: Vec<LinePrimitive>,
    /// Triangles.
    #[prost(message, repeated, tag = "12")]
    pub triangles: Vec<TriangleListPrimitive>,
    /// Texts.
    #[prost(message, repeated, tag = "13")]
    pub texts: Vec<TextPrimitive>,
}

/// Entities of a scene.
#[derive(Clone, PartialEq, Message)]
pub struct SceneUpdate {
    /// Entities.
    #[prost(message, repeated, tag = "2")]
    pub entities: Vec<SceneEntity>,
}

/// The pose of a frame in another.
#[derive(Clone, PartialEq, Message)]
pub struct FrameTransform {
    /// Timestamp.
    #[prost(message, optional, tag = "1")]
    pub timestamp: Option<Timestamp>,
    /// Parent frame id.
    #[prost(string, tag = "2")]
    pub parent_frame_id: String,
    /// Child frame id.
    #[prost(string, tag = "3")]
    pub child_frame_id: String,
    /// Translation.
    #[prost(message, optional, tag = "4")]
    pub translation: Option<Vector3>,
    /// Rotation.
    #[prost(message, optional, tag = "5")]
    pub rotation: Option<Quaternion>,
}

/// The poses of frames at an instant.
#[derive(Clone, PartialEq, Message)]
pub struct FrameTransforms {
    /// Transforms.
    #[prost(message, repeated, tag = "1")]
    pub transforms: Vec<FrameTransform>,
}

/// A line of a log.
#[derive(Clone, PartialEq, Message)]
pub struct Log {
    /// Timestamp.
    #[prost(message, optional, tag = "1")]
    pub timestamp: Option<Timestamp>,
    /// Level.
    #[prost(enumeration = "LogLevel", tag = "2")]
    pub level: i32,
    /// Message.
    #[prost(string, tag = "3")]
    pub message: String,
    /// Name.
    #[prost(string, tag = "4")]
    pub name: String,
}

/// How a line joins its points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
#[repr(i32)]
pub enum LineType {
    /// From point to point.
    LineStrip = 0,
    /// And back to the first.
    LineLoop = 1,
}

/// How grave a line of a log is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
#[repr(i32)]
pub enum LogLevel {
    /// Not stated.
    Unknown = 0,
    /// What happened.
    Info = 2,
    /// What stands in the way.
    Warning = 3,
    /// What is wrong.
    Error = 4,
}

#[cfg(test)]
mod tests {
    use super::*;
    use foxglove::Encode;
    use foxglove::messages as sdk;

    /// Every field that is used here, filled with numbers that differ, read by the SDK and written again.
    #[test]
    fn the_sdk_reads_and_writes_the_same_bytes() {
        let pose = Some(Pose {
            position: Some(Vector3 { x: 1.0, y: 2.0, z: 3.0 }),
            orientation: Some(Quaternion { x: 0.1, y: 0.2, z: 0.3, w: 0.4 }),
        });
        let color = Some(Color { r: 0.5, g: 0.6, b: 0.7, a: 0.8 });
        let size = Some(Vector3 { x: 4.0, y: 5.0, z: 6.0 });
        let points = vec![Point3 { x: 7.0, y: 8.0, z: 9.0 }];
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

    fn again<S: Message + Default + Encode, K: Known>(ours: &K) {
        let bytes = ours.encode_to_vec();
        assert_eq!(S::decode(&*bytes).unwrap().encode_to_vec(), bytes, "{}", K::SCHEMA);
        let schema = S::get_schema().unwrap();
        assert_eq!((schema.name.as_str(), &*schema.data), (K::SCHEMA, K::DESCRIPTOR));
    }
}
