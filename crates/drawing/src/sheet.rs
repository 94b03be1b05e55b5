//! Sheets: pictures side by side, each under its heading and above its scale.

use super::dimension::Dimension;
use super::paper::figure::{DrawnFigure, Type, solid, width, words};
use super::paper::scale::round_up;
use super::paper::style::colour;
use super::paper::style::{BLACK, GREY};
use super::picture::{ALARM, NUMBER, draw_number, millimetres};
use linkage::math::{KeepNan, Vec2};
use linkage::mechanism::LinkId;

/// Margin of the sheet, and distance between cells (mm).
const MARGIN: f64 = 6.0;
const GAP: f64 = 9.0;
/// Font sizes (mm) of title, headings and notes, and line spacing as a multiple of the font size.
const TITLE: f64 = 5.2;
const HEADING: f64 = 4.2;
const NOTE: f64 = 3.4;
const LINE: f64 = 1.45;
/// Height of the space for the scale bar below a picture (mm). `LONGEST` is the upper limit of the scale bar's length
/// (mm).
const SCALE: f64 = 9.0;
const LONGEST: f64 = 40.0;

/// Space after an entry of a legend (mm). `ROW` is the height of a row of the legend (mm).
const AFTER: f64 = 5.0;
const ROW: f64 = 6.0;

/// One picture of a sheet.
#[derive(Clone, Debug, Default)]
pub struct SheetCell {
    /// Lines above the picture. The first line is bold.
    pub heading: Vec<String>,
    /// The picture.
    pub figure: DrawnFigure,
    /// Corners of the area that the picture may cover (mm). The area is the same for all frames of an animation.
    pub bounds: [Vec2; 2],
    /// Length in the world that corresponds to a millimetre on paper (m).
    pub scale: f64,
    /// Names of links beside their numbers, below the picture.
    pub legend: Vec<(LinkId, String)>,
    /// Faults, written below the picture.
    pub faults: Vec<String>,
    /// The dimensions drawn in the picture.
    pub dimensions: Vec<Dimension>,
}

/// Scale (m/mm), with two digits, at which an extent (m) fits into the available size (mm).
pub fn fit(extent: Vec2, room: Vec2) -> f64 {
    let least = (extent.x / room.x).larger(extent.y / room.y);
    if !(least > 0.0 && least.is_finite()) {
        return 1e-3;
    }
    let power = 10f64.powi(least.log10().floor() as i32 - 1);
    let rounded = (least / power * (1.0 - 1e-12)).ceil() * power;
    // The product can have a rounding error. Printing the scale with two digits and parsing the text removes it.
    format!("{rounded:.1e}").parse().unwrap_or(rounded)
}

/// The smallest round scale (m/mm) at which an extent (m) fits into the available size (mm).
/// The enlargement or the reduction of the drawing is then a round number.
pub fn round_fit(extent: Vec2, room: Vec2) -> f64 {
    let least = (extent.x / room.x).larger(extent.y / room.y);
    if least > 0.0 { 1e-3 * round_up(1e3 * least) } else { 1e-3 }
}

/// Number of columns for this number of cells.
pub fn columns(cells: usize) -> usize {
    cells.clamp(1, 2)
}

/// The sheet, with its size (mm). The upper left corner of the sheet is the origin.
/// Every cell is at least `least` (mm) wide.
pub fn sheet(title: &str, subtitle: &str, cells: &[SheetCell], least: f64) -> (DrawnFigure, [f64; 2]) {
    let columns = columns(cells.len());
    let size = |cell: &SheetCell| cell.bounds[1] - cell.bounds[0];
    let wide = cells.iter().map(|cell| size(cell).x).fold(least, f64::larger);
    let whole = wide * columns as f64 + GAP * (columns - 1) as f64;
    let mut sheet = DrawnFigure::default();
    let mut top = -MARGIN;
    let mut put = |sheet: &mut DrawnFigure, text: &str, set: Type| {
        for line in wrapped(text, set.size, whole) {
            top -= LINE * set.size;
            sheet.text(Vec2::new(MARGIN, top), line, set);
        }
    };
    put(&mut sheet, title, Type { bold: true, ..words(TITLE) });
    put(&mut sheet, subtitle, words(NOTE));
    top -= 4.0;
    for row in cells.chunks(columns) {
        let heads: Vec<Vec<String>> = row
            .iter()
            .map(|cell| cell.heading.iter().flat_map(|line| wrapped(line, HEADING, wide)).collect())
            .collect();
        let lines = heads.iter().map(Vec::len).max().unwrap_or(0);
        let high = row.iter().map(|cell| size(cell).y).fold(0.0, f64::larger);
        let below = top - LINE * HEADING * lines as f64 - 3.0;
        let mut lowest = below - high - SCALE;
        for (column, (cell, head)) in row.iter().zip(heads).enumerate() {
            let left = MARGIN + (wide + GAP) * column as f64;
            for (k, line) in head.into_iter().enumerate() {
                let set = Type { bold: k == 0, ..words(HEADING) };
                sheet.text(Vec2::new(left, top - LINE * HEADING * (k as f64 + 0.7)), line, set);
            }
            let inset = (wide - size(cell).x) / 2.0;
            let offset = Vec2::new(left + inset - cell.bounds[0].x, below - cell.bounds[1].y);
            sheet.add(&cell.figure, offset);
            let foot = below - high - SCALE + 3.0;
            scale(&mut sheet, Vec2::new(left, foot), cell.scale);
            let mut down = foot - 2.0;
            for row in legend_rows(&cell.legend, wide) {
                down -= ROW;
                draw_legend(&mut sheet, Vec2::new(left, down), row);
            }
            down -= if cell.legend.is_empty() { 0.0 } else { 0.5 * ROW };
            for line in cell.faults.iter().flat_map(|fault| wrapped(fault, NOTE, wide)) {
                down -= LINE * NOTE;
                sheet.text(Vec2::new(left, down), line, Type { colour: ALARM, ..words(NOTE) });
            }
            lowest = lowest.smaller(down);
        }
        top = lowest - GAP;
    }
    (sheet, [(whole + 2.0 * MARGIN).ceil(), (MARGIN - GAP - top).ceil()])
}

/// The pictures of the cells side by side, without headings, scales and legends, and the size (mm) of the whole figure.
/// Every cell has at least the size `least` (mm). The upper left corner is the origin.
pub fn bare(cells: &[SheetCell], least: Vec2) -> (DrawnFigure, [f64; 2]) {
    let size = |cell: &SheetCell| cell.bounds[1] - cell.bounds[0];
    let room = cells.iter().map(size).fold(least, |most, own| most.sup(&own));
    let (mut figure, step) = (DrawnFigure::default(), room + Vec2::repeat(MARGIN));
    for (index, cell) in cells.iter().enumerate() {
        let [column, row] = [index % columns(cells.len()), index / columns(cells.len())].map(|count| count as f64);
        let middle = Vec2::new((column + 0.5) * step.x, -(row + 0.5) * step.y);
        figure.add(&cell.figure, middle - (cell.bounds[0] + cell.bounds[1]) / 2.0);
    }
    let [wide, high] = [columns(cells.len()), cells.len().div_ceil(columns(cells.len()))].map(|count| count as f64);
    (figure, [(wide * step.x).ceil(), (high * step.y).ceil()])
}

/// The entries of a legend in rows that are at most `wide` (mm).
pub fn legend_rows(legend: &[(LinkId, String)], wide: f64) -> Vec<&[(LinkId, String)]> {
    let mut rows = Vec::new();
    let mut from = 0;
    for to in 1..=legend.len() {
        let length: f64 = legend[from..to].iter().map(entry).sum();
        if length - AFTER > wide && to - from > 1 {
            rows.push(&legend[from..to - 1]);
            from = to - 1;
        }
    }
    rows.extend((from < legend.len()).then(|| &legend[from..]));
    rows
}

/// Length of an entry of a legend (mm).
fn entry((_, name): &(LinkId, String)) -> f64 {
    2.0 * NUMBER + 1.5 + width(name, NOTE) + AFTER
}

fn draw_legend(sheet: &mut DrawnFigure, mut at: Vec2, row: &[(LinkId, String)]) {
    for own in row {
        draw_number(sheet, at + Vec2::new(NUMBER, 1.15), own.0.to_string(), colour(own.0));
        sheet.text(at + Vec2::new(2.0 * NUMBER + 1.5, 0.0), own.1.as_str(), words(NOTE));
        at.x += entry(own);
    }
}

/// Draws a scale bar for a round length, which is written beside the bar.
fn scale(sheet: &mut DrawnFigure, at: Vec2, scale: f64) {
    let long = round_up(LONGEST * scale / 2.0);
    let end = at + Vec2::new(long / scale, 0.0);
    sheet.line([at, end], solid(BLACK, 0.5));
    for tick in [at, end] {
        sheet.line([tick - Vec2::new(0.0, 0.8), tick + Vec2::new(0.0, 0.8)], solid(BLACK, 0.5));
    }
    sheet.text(end + Vec2::new(2.0, -1.1), millimetres(long), Type { colour: GREY, ..words(NOTE) });
}

/// A text broken into lines of at most `wide` (mm), at the font size `size` (mm).
pub(crate) fn wrapped(text: &str, size: f64, wide: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if width(&format!("{line} {word}"), size) <= wide => *line += &format!(" {word}"),
            _ => lines.push(word.into()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_have_two_digits_and_fit_the_sheet() {
        for k in 0..200 {
            let extent = 1e-4 * 1.13f64.powi(k);
            let found = fit(Vec2::new(extent, 0.0), Vec2::new(120.0, 80.0));
            assert!(extent / found <= 120.0 * (1.0 + 1e-9) && extent / found > 108.0, "{extent}: {found}");
            assert!(format!("{found:e}").split('e').next().unwrap().len() <= 3, "{found}");
        }
        assert_eq!(fit(Vec2::zeros(), Vec2::new(1.0, 1.0)), 1e-3);
    }

    #[test]
    fn a_legend_has_as_many_rows_as_its_width_requires() {
        let legend: Vec<_> = ["crank", "coupler", "rocker"].map(|name| (LinkId(1), name.to_string())).to_vec();
        let rows = |wide| legend_rows(&legend, wide).iter().map(|row| row.len()).collect::<Vec<_>>();
        assert_eq!((rows(200.0), rows(50.0), rows(1.0)), (vec![3], vec![2, 1], vec![1, 1, 1]));
        assert!(legend_rows(&[], 10.0).is_empty());
    }

    #[test]
    fn text_is_wrapped_to_the_given_width() {
        assert_eq!(wrapped("a bc  def", 1.0, 100.0), ["a bc def"]);
        assert!(wrapped("a bc def", 1.0, 2.0).len() == 3 && wrapped("", 1.0, 2.0).is_empty());
    }
}
