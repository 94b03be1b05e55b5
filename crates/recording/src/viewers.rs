//! Messages that viewers of the Foxglove family can draw: scenes, frames and log lines.
//! The messages have only the fields used here.
//! Names and numbers of the fields are taken from Foxglove's schemas (foxglove/schemas, Protobuf).
//! The descriptors in the directory `viewers` also come from Foxglove.
//! The tests of `crates/crosschecks` compare messages and descriptors with Foxglove's SDK.

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
        pub struct $name { $(
            #[doc = concat!("Field ", $tag, " of Foxglove's schema.")]
            #[prost($($kind)+, tag = $tag)]
            pub $field: $type,
        )* })*
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
