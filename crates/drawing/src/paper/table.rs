//! Tables of a drawing.

use super::figure::{DrawnFigure, Style, Type, solid, width, words};
use super::style::{BLACK, GREY};
use linkage::math::{KeepNan, Vec2};

/// Font size and line spacing (mm).
const SIZE: f64 = 3.3;
const LINE: f64 = 5.0;
/// Distance between columns, and width of the line sample before the first column (mm).
const GAP: f64 = 3.0;
const SAMPLE: f64 = 9.0;

/// A table with a heading and rows. Each row explains a kind of line and starts with a sample of this line.
pub struct LegendTable {
    /// Headings of the columns.
    pub head: Vec<&'static str>,
    /// Rows: the explained line, and the cells.
    pub rows: Vec<(Style, Vec<String>)>,
    /// Indices of the columns that contain numbers. These columns are aligned right.
    pub numbers: &'static [usize],
}

impl LegendTable {
    /// The table as a figure; its upper left corner is the origin.
    pub fn figure(&self) -> DrawnFigure {
        let mut figure = DrawnFigure::default();
        let cells = |column: usize| self.rows.iter().filter_map(move |(_, row)| row.get(column));
        let wide = |column: usize| {
            let head = width(self.head[column], SIZE);
            cells(column).map(|text| width(text, SIZE)).fold(head, f64::larger)
        };
        let widths: Vec<f64> = (0..self.head.len()).map(wide).collect();
        let left = |column: usize| SAMPLE + widths[..column].iter().map(|w| w + GAP).sum::<f64>();
        let right = left(self.head.len()) - GAP;
        let mut put = |column: usize, y: f64, text: &str, set: Type| {
            let number = self.numbers.contains(&column);
            let (x, anchor) = if number { (left(column) + widths[column], "end") } else { (left(column), "start") };
            figure.text(Vec2::new(x, y), text, Type { anchor, ..set });
        };
        for (column, text) in self.head.iter().enumerate() {
            put(column, -SIZE, text, Type { bold: true, ..words(SIZE) });
        }
        for (index, (_, row)) in self.rows.iter().enumerate() {
            for (column, text) in row.iter().enumerate() {
                put(column, row_y(index), text, words(SIZE));
            }
        }
        figure.line([Vec2::new(0.0, -SIZE - 1.3), Vec2::new(right, -SIZE - 1.3)], solid(BLACK, 0.25));
        for (index, (style, _)) in self.rows.iter().enumerate() {
            let y = row_y(index) + 0.35 * SIZE;
            figure.line([Vec2::new(0.5, y), Vec2::new(SAMPLE - 2.0, y)], *style);
        }
        let end = row_y(self.rows.len()) + SIZE;
        figure.line([Vec2::new(0.0, end), Vec2::new(right, end)], solid(GREY, 0.15));
        figure
    }
}

fn row_y(index: usize) -> f64 {
    -SIZE - 1.3 - LINE * (index + 1) as f64 + 0.4
}
