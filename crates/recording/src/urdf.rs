//! The links as a robot's description (URDF), for viewers that cannot draw scenes.
//! The description contains boxes and cylinders that move with `/tf`.

use super::shapes::rgba;
use crate::viewers::{Color, LinePrimitive, LineType, Pose, SceneEntity, SceneUpdate, Vector3};
use linkage::math::Vec2;
use std::fmt::Write;

/// Height of a line's box, divided by the thickness of the line in the plane of motion. The height is not visible from
/// above.
const FLAT: f64 = 0.1;

/// The description of the links of a scene, with the ground as the root.
pub fn text(name: &str, links: &SceneUpdate) -> String {
    let mut text = format!("<robot name=\"{}\">", escaped(name));
    let (ground, moving): (Vec<_>, Vec<_>) = links.entities.iter().partition(|entity| entity.frame_id == "world");
    write_link(&mut text, "world", &ground);
    for (number, entity) in moving.into_iter().enumerate() {
        let frame = escaped(&entity.frame_id);
        write_link(&mut text, &frame, &[entity]);
        let _ = write!(
            text,
            "<joint name=\"joint_{number}\" type=\"floating\"><parent link=\"world\"/><child link=\"{frame}\"/></joint>"
        );
    }
    text + "</robot>"
}

/// The description as a text message in CDR encoding: the text's length (little endian), the text, and a zero byte.
pub fn message(text: &str) -> Vec<u8> {
    let mut data = vec![0, 1, 0, 0];
    data.extend((text.len() as u32 + 1).to_le_bytes());
    data.extend(text.as_bytes());
    data.push(0);
    data
}

fn write_link(text: &mut String, name: &str, entities: &[&SceneEntity]) {
    let _ = write!(text, "<link name=\"{name}\">");
    for entity in entities {
        for line in &entity.lines {
            let count = line.points.len();
            let closed = line.r#type == LineType::LineLoop as i32 && count > 2;
            for start in 0..if closed { count } else { count.saturating_sub(1) } {
                write_box(text, line, &line.points[start], &line.points[(start + 1) % count]);
            }
        }
        for pin in &entity.cylinders {
            let (radius, length) = pin.size.map_or((0.0, 0.0), |size| (size.x / 2.0, size.z));
            let shape = format!("<cylinder radius=\"{radius}\" length=\"{length}\"/>");
            write_visual(text, &at(pin.pose), &shape, pin.color);
        }
    }
    text.push_str("</link>");
}

fn write_box(text: &mut String, line: &LinePrimitive, from: &Vector3, to: &Vector3) {
    let [from, to] = [from, to].map(|point| Vec2::new(point.x, point.y));
    let (middle, way) = ((from + to) / 2.0, to - from);
    let z = line.pose.and_then(|pose| pose.position).map_or(0.0, |position| position.z);
    let origin = format!("xyz=\"{} {} {z}\" rpy=\"0 0 {}\"", middle.x, middle.y, way.y.atan2(way.x));
    let size = format!("{} {} {}", way.norm() + line.thickness, line.thickness, FLAT * line.thickness);
    write_visual(text, &origin, &format!("<box size=\"{size}\"/>"), line.color);
}

fn at(pose: Option<Pose>) -> String {
    let at = pose.and_then(|pose| pose.position).unwrap_or_default();
    format!("xyz=\"{} {} {}\" rpy=\"0 0 0\"", at.x, at.y, at.z)
}

/// Writes one part. The name of a part's material follows from the part's colour, so a name never has two colours.
fn write_visual(text: &mut String, origin: &str, shape: &str, colour: Option<Color>) {
    let [r, g, b, a] = rgba(colour);
    let rgba = [r, g, b, a].map(|part| (f64::from(part) / 255.0).to_string()).join(" ");
    let _ = write!(
        text,
        "<visual><origin {origin}/><geometry>{shape}</geometry>\
         <material name=\"{r:02x}{g:02x}{b:02x}{a:02x}\"><color rgba=\"{rgba}\"/></material></visual>"
    );
}

fn escaped(name: &str) -> String {
    name.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
