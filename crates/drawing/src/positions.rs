//! Several positions in one drawing: thin outlines, and numbers of the positions along the paths of points.

use super::mark::MarkRole;
use super::paper::figure::{DrawnFigure, Style, Type, solid, words};
use super::paper::style::colour;
use super::picture::{LinkPlacement, Picture};
use super::sheet::{SheetCell, round_fit};
use super::sketch::Sketch;
use crate::sentences;
use linkage::math::{Vec2, corners, turned};
use linkage::mechanism::{GROUND, LinkId};

/// Width of outlines, width of paths, and radius of the dot at a position (mm).
const THIN: f64 = 0.25;
const PATH: f64 = 0.3;
const DOT: f64 = 0.5;
/// Opacity of outlines.
const PALE: f64 = 0.45;
/// Font size of the numbers of positions (mm). `APART` is the length of path that a number needs (mm on paper).
const NUMBER: f64 = 2.8;
const APART: f64 = 3.0;
/// Space for numbers around an enlarged path (mm), on each side.
const BESIDE: f64 = 6.0;
/// Positions closer to each other than this (mm on paper) share one label, such as `0,12`.
const ONE: f64 = 0.5;
/// Possible steps from one numbered position to the next. With step 3, every third position has a number.
const STEPS: [usize; 9] = [1, 2, 3, 4, 5, 6, 8, 9, 12];

/// Positions of a mechanism that are drawn with thin lines in addition to the complete drawing, and paths of points.
#[derive(Clone, Debug, Default)]
pub struct Series {
    /// Positions with thin lines: the placements of all links, and a name.
    /// A viewer shows the name when the mouse points at the lines.
    pub thin: Vec<(Vec<LinkPlacement>, String)>,
    /// Paths of points, on which the positions are numbered.
    pub paths: Vec<NumberedPath>,
}

/// The path of a point, and where the point lies in each position of a series.
#[derive(Clone, Debug)]
pub struct NumberedPath {
    /// Name of the point.
    pub name: String,
    /// Link of the point.
    pub link: LinkId,
    /// The path in the world (m).
    pub path: Vec<Vec2>,
    /// World coordinates of the point (m) in the positions 0, 1, 2 and so on of the mechanism.
    pub places: Vec<Vec2>,
}

impl NumberedPath {
    /// Width and height of the path (m).
    #[must_use]
    pub fn size(&self) -> Vec2 {
        let [low, high] = corners(self.path.iter().copied());
        high - low
    }

    /// The smallest step from one numbered position to the next at which the numbers have space beside the path.
    /// The path is drawn at the scale `scale` (m/mm).
    /// `None` if the path is too small for numbers.
    fn numbered_every(&self, scale: f64) -> Option<usize> {
        let way: f64 = self.places.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
        let apart = way / scale / self.places.len().saturating_sub(1).max(1) as f64;
        STEPS.into_iter().filter(|step| 3 * step <= self.places.len().max(3)).find(|&step| step as f64 * apart >= APART)
    }
}

impl Picture<'_> {
    /// Draws the outlines of moving links in other positions as one pale element. Within it, each position is an
    /// element with its own name.
    pub fn draw_thin(&mut self, positions: &[(Vec<LinkPlacement>, String)]) {
        let mut all = DrawnFigure::default();
        for (places, name) in positions {
            all.group(self.outlines(places), 1.0, name.clone());
        }
        self.figure.group(all, PALE, sentences::THE_OTHER_POSITIONS.into());
    }

    fn outlines(&self, places: &[LinkPlacement]) -> DrawnFigure {
        let mut outlines = DrawnFigure::default();
        for (link, mark) in self.sketch.in_order() {
            let is_drawn = match mark.role {
                MarkRole::Bar | MarkRole::Plate | MarkRole::Block | MarkRole::Piston | MarkRole::Slot => true,
                MarkRole::Cylinder => true,
                // The pitch circle looks the same at every angle. Only the stroke that shows the wheel's angle is
                // therefore drawn.
                MarkRole::Wheel => !mark.shape.is_closed(),
                MarkRole::Axis
                | MarkRole::Hatch
                | MarkRole::Rail
                | MarkRole::Bore
                | MarkRole::Pivot
                | MarkRole::Stop
                | MarkRole::Weld
                | MarkRole::Strand
                | MarkRole::Spring
                | MarkRole::Damper
                | MarkRole::TorsionSpring
                | MarkRole::TorsionDamper
                | MarkRole::Pin
                | MarkRole::CoincidentPin
                | MarkRole::MassCentre
                | MarkRole::MassQuarter
                | MarkRole::Tracer
                | MarkRole::Drive
                | MarkRole::DriveHead
                | MarkRole::Motor
                | MarkRole::Load
                | MarkRole::LoadHead => false,
            };
            let Some(pose) = places[link].pose().filter(|_| is_drawn && link != GROUND) else { continue };
            let points = mark.shape.points().into_iter().map(|local| pose.point(local) / self.scale).collect();
            match mark.shape.is_closed() {
                true => outlines.area(points, None, solid(colour(link), THIN)),
                false => outlines.curve(points, None, solid(colour(link), THIN)),
            }
        }
        outlines
    }

    /// Draws a path with a dot at each position, and numbers beside the dots.
    /// Returns whether the path is large enough for numbers.
    pub fn draw_numbered(&mut self, own: &NumberedPath) -> bool {
        let paper = |all: &[Vec2]| all.iter().map(|at| at / self.scale).collect::<Vec<Vec2>>();
        let (path, places, paint) = (paper(&own.path), paper(&own.places), colour(own.link));
        self.keep_clear(&path);
        self.figure.curve(path, None, Style { colour: paint, width: PATH, dash: "" });
        for at in &places {
            self.figure.disc(*at, DOT, paint, solid(paint, 0.1));
            self.obstacles.discs.push((*at, DOT));
        }
        let Some(step) = own.numbered_every(self.scale) else { return false };
        let middle = places.iter().sum::<Vec2>() / places.len().max(1) as f64;
        let set = Type { anchor: "middle", ..words(NUMBER) };
        let mut numbered: Vec<(usize, String)> = Vec::new();
        for k in (0..places.len()).step_by(step) {
            match numbered.iter_mut().find(|(other, _)| (places[*other] - places[k]).norm() < ONE) {
                Some((_, text)) => *text += &format!(",{k}"),
                None => numbered.push((k, k.to_string())),
            }
        }
        for (k, text) in numbered {
            // Numbers are placed on the outer side of the path.
            let normal = turned(places[(k + 1) % places.len()] - places[k.checked_sub(1).unwrap_or(places.len() - 1)]);
            let side = if normal.dot(&(places[k] - middle)) < 0.0 { -1.0 } else { 1.0 };
            self.set_letters(places[k], normal * side, DOT, text, set);
        }
        true
    }
}

/// A cell with one path. The path is enlarged by the largest round factor at which path and numbers fit into the size
/// `room` (mm).
/// The cell has no heading.
#[must_use]
pub fn enlarged(own: &NumberedPath, room: Vec2) -> SheetCell {
    let scale = round_fit(own.size(), room - Vec2::repeat(2.0 * BESIDE));
    let sketch =
        Sketch { unit: scale, bodies: Vec::new(), stretched: Vec::new(), loads: Vec::new(), labels: Vec::new() };
    let mut picture = Picture::of(&sketch, &[], scale);
    picture.draw_numbered(own);
    let figure = picture.finish(1);
    SheetCell { bounds: figure.bounds(), figure, scale, ..SheetCell::default() }
}

/// A scale (m/mm) as a ratio: `1 : 2.5`, or `4 : 1` if the drawing is larger than the mechanism.
#[must_use]
pub fn ratio(scale: f64) -> String {
    let shown = |ratio: f64| format!("{}", (ratio * 1e6).round() / 1e6);
    if scale >= 1e-3 { format!("1 : {}", shown(scale * 1e3)) } else { format!("{} : 1", shown(1e-3 / scale)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn path(step: f64, count: u32) -> NumberedPath {
        let places: Vec<Vec2> = (0..count).map(|k| Vec2::new(step * f64::from(k), 0.0)).collect();
        NumberedPath { name: "P".into(), link: LinkId(1), path: places.clone(), places }
    }

    #[test]
    fn numbers_need_space_along_the_path() {
        let every = |step: f64, count: u32| path(step * 1e-3, count).numbered_every(1e-3);
        assert_eq!(every(3.1, 12), Some(1));
        assert_eq!(every(1.1, 12), Some(3));
        assert_eq!(every(0.1, 12), None);
        assert_eq!(every(0.4, 72), Some(8));
        assert_eq!(every(4.0, 2), Some(1));
    }

    #[test]
    fn an_enlarged_path_has_a_round_scale_and_fits() {
        let cell = enlarged(&path(1e-3, 12), Vec2::new(140.0, 110.0));
        // A path of 11 mm that is enlarged 10 times fits into 128 mm. Enlarged 20 times, it would be too long.
        assert_eq!((cell.scale, ratio(cell.scale)), (1e-4, "10 : 1".to_string()));
        let size = cell.bounds[1] - cell.bounds[0];
        assert!(size.x > 110.0 && size.x < 140.0, "{size:?}");
        assert_eq!((ratio(2.5e-3), ratio(1e-3)), ("1 : 2.5".to_string(), "1 : 1".to_string()));
    }
}
