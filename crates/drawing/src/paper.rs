//! Pictures on paper: lines, shapes and letters in millimetres, as SVG.
//! If a picture is printed at full size, the scale factors stated on it are correct.

pub mod document;
pub mod figure;
pub mod labels;
pub mod scale;
pub mod style;
pub mod table;
