//! Files of the program Linkage (`.linkage2`): connectors with their positions, links through connectors, anchors,
//! inputs, sliders, actuators and gears.
//! Lengths are 1/96 inch, y points up, and a positive speed is clockwise.

mod build;
mod elements;
mod gears;
mod sliders;

use super::parts::Parts;
use super::xml::XmlFile;
use linkage::error::Result;

/// The mechanism of a file.
pub(super) fn parts(file: &XmlFile) -> Result<Parts> {
    let elements = elements::elements(file)?;
    let mut builder = build::Builder::of(file, elements)?;
    builder.joints()?;
    builder.sliders();
    builder.drives();
    builder.gears()?;
    Ok(builder.parts)
}
