//! Pictures on paper: lines, shapes and letters in millimetres, as SVG.
//! Printed at full size they have the scale factors stated on them.

pub mod document;
pub mod figure;
pub mod labels;
pub mod scale;
pub mod style;
pub mod table;
