//! Figures as PDF files of one page. Letters are drawn as outlines.

use pdf_writer::types::{LineCapStyle, LineJoinStyle};
use pdf_writer::{Content, Finish, Name, Pdf, Rect, Ref, TextStr};
use tiny_skia::{Path, PathSegment};

use crate::paper::figure::{DrawnFigure, Style, Tint};
use crate::paths::{self, Surface, dashes, rgb};

/// PDF points in a millimetre.
const POINT: f64 = 72.0 / 25.4;
/// Coordinates on the page are rounded to 1 / `PARTS` of a millimetre.
const PARTS: f32 = 1000.0;

/// The PDF file of a figure on white paper of the given size (mm).
/// The paper's upper left corner is the figure's origin.
pub fn pdf(figure: &DrawnFigure, [width, height]: [f64; 2], title: &str) -> Vec<u8> {
    let mut sheet = Sheet { content: Content::new(), opacities: Vec::new(), groups: Vec::new() };
    sheet.content.transform([POINT, 0.0, 0.0, -POINT, 0.0, POINT * height].map(|own| own as f32));
    sheet.begin();
    paths::draw(figure, &mut sheet);
    sheet.bytes([width, height], title)
}

/// The page that is being written.
struct Sheet {
    content: Content,
    /// Opacities in thousandths. In the file, an opacity has the name `o` followed by its index.
    opacities: Vec<u32>,
    /// Contents of the groups that are drawn as one element. In the file, a group has the name `g` followed by its
    /// index.
    groups: Vec<Vec<u8>>,
}

impl Sheet {
    /// Makes ends and corners of lines round, as in SVG and bitmaps.
    fn begin(&mut self) {
        self.content.set_line_cap(LineCapStyle::RoundCap).set_line_join(LineJoinStyle::RoundJoin);
    }

    fn set_opacity(&mut self, opacity: f64) {
        let thousandths = (opacity.clamp(0.0, 1.0) * 1000.0).round() as u32;
        let known = self.opacities.iter().position(|own| *own == thousandths);
        let index = known.unwrap_or_else(|| {
            self.opacities.push(thousandths);
            self.opacities.len() - 1
        });
        self.content.set_parameters(Name(format!("o{index}").as_bytes()));
    }

    fn bytes(self, [width, height]: [f64; 2], title: &str) -> Vec<u8> {
        let [catalog, pages, page, content, info] = [1, 2, 3, 4, 5].map(Ref::new);
        let group = |index: usize| Ref::new(6 + index as i32);
        let mut pdf = Pdf::new();
        pdf.catalog(catalog).pages(pages);
        pdf.pages(pages).kids([page]).count(1);
        let title: String = title.chars().filter(|sign| !sign.is_control()).collect();
        pdf.document_info(info).title(TextStr(&title)).creator(TextStr("linkproof"));
        let size = [width, height].map(|own| (POINT * own) as f32);
        let mut written = pdf.page(page);
        written.media_box(Rect::new(0.0, 0.0, size[0], size[1])).parent(pages).contents(content);
        let own_resources = |resources: &mut pdf_writer::writers::Resources, groups: usize| {
            let mut states = resources.ext_g_states();
            for (index, thousandths) in self.opacities.iter().enumerate() {
                let opacity = *thousandths as f32 / 1000.0;
                let mut state = states
                    .insert(Name(format!("o{index}").as_bytes()))
                    .start::<pdf_writer::writers::ExtGraphicsState>();
                state.non_stroking_alpha(opacity).stroking_alpha(opacity);
            }
            states.finish();
            let mut objects = resources.x_objects();
            for index in 0..groups {
                objects.pair(Name(format!("g{index}").as_bytes()), group(index));
            }
        };
        own_resources(&mut written.resources(), self.groups.len());
        written.finish();
        for (index, drawn) in self.groups.iter().enumerate() {
            let mut form = pdf.form_xobject(group(index), drawn);
            form.bbox(Rect::new(0.0, 0.0, width as f32, height as f32));
            form.group().transparency().isolated(true);
            // Groups within a group have smaller indices than the group itself.
            own_resources(&mut form.resources(), index);
        }
        pdf.stream(content, &self.content.finish());
        pdf.finish()
    }
}

impl Surface for Sheet {
    fn paint(&mut self, path: Option<Path>, fill: Option<Tint>, style: &Style) {
        let Some(path) = path else { return };
        let part = |colour: &str| rgb(colour).map(|part| f32::from(part) / 255.0);
        if let Some(tint) = fill {
            let [red, green, blue] = part(tint.colour);
            let is_clear = tint.opacity < 1.0;
            if is_clear {
                self.content.save_state();
                self.set_opacity(tint.opacity);
            }
            self.content.set_fill_rgb(red, green, blue);
            follow(&mut self.content, &path);
            self.content.fill_nonzero();
            if is_clear {
                self.content.restore_state();
            }
        }
        if style.width > 0.0 {
            let [red, green, blue] = part(style.colour);
            self.content.set_stroke_rgb(red, green, blue).set_line_width(style.width as f32);
            self.content.set_dash_pattern(dashes(style), 0.0);
            follow(&mut self.content, &path);
            self.content.stroke();
        }
    }

    fn group(&mut self, opacity: f64, draw: &mut dyn FnMut(&mut Sheet)) {
        let below = std::mem::replace(&mut self.content, Content::new());
        self.begin();
        draw(self);
        let own = std::mem::replace(&mut self.content, below).finish();
        self.groups.push(own.to_vec());
        self.content.save_state();
        self.set_opacity(opacity);
        self.content.x_object(Name(format!("g{}", self.groups.len() - 1).as_bytes()));
        self.content.restore_state();
    }
}

/// Adds a path to the content. PDF has no quadratic curves, so each quadratic curve is written as an identical cubic
/// curve.
fn follow(content: &mut Content, path: &Path) {
    let round = |own: f32| (own * PARTS).round() / PARTS;
    let mut from = tiny_skia::Point::zero();
    for segment in path.segments() {
        match segment {
            PathSegment::MoveTo(to) => {
                content.move_to(round(to.x), round(to.y));
                from = to;
            }
            PathSegment::LineTo(to) => {
                content.line_to(round(to.x), round(to.y));
                from = to;
            }
            PathSegment::QuadTo(bend, to) => {
                let toward = |end: tiny_skia::Point| [end.x + (bend.x - end.x) / 1.5, end.y + (bend.y - end.y) / 1.5];
                let ([x1, y1], [x2, y2]) = (toward(from).map(round), toward(to).map(round));
                content.cubic_to(x1, y1, x2, y2, round(to.x), round(to.y));
                from = to;
            }
            PathSegment::CubicTo(first, second, to) => {
                let [x1, y1, x2, y2] = [first.x, first.y, second.x, second.y].map(round);
                content.cubic_to(x1, y1, x2, y2, round(to.x), round(to.y));
                from = to;
            }
            PathSegment::Close => {
                content.close_path();
            }
        }
    }
}
