//! A figure: lines, shapes and text, in millimetres with y upwards.
//! These elements are stored until the figure is written as SVG, PDF or bitmap.

use svg::node::Blob;
use svg::node::element::{Circle, Group, Line, Path, Title};

use linkage::math::{KeepNan, Vec2, turned};

/// Control characters: start of a subscript, start of a superscript, end of a sub- or superscript.
const SUB: char = '\u{1}';
const SUP: char = '\u{2}';
const END: char = '\u{3}';
/// Mean width of a letter divided by the font size.
const LETTER: f64 = 0.56;
/// Size of sub- and superscripts divided by the font size.
const SMALL: f64 = 0.72;
/// Downward shift of subscripts and upward shift of superscripts, divided by the font size.
const LOW: f64 = 0.28;
const HIGH: f64 = 0.36;
/// Length of an arrow head (mm). The head of a short arrow takes at most the fraction `HEAD_SHARE` of the arrow's
/// length.
const HEAD: f64 = 2.8;
const HEAD_SHARE: f64 = 0.45;

/// `text` as a subscript.
pub fn sub(text: &str) -> String {
    format!("{SUB}{text}{END}")
}

/// Converts a name such as `a_BA^n` or a unit such as `m/s^2` to text with sub- and superscripts.
pub fn scripted(name: &str) -> String {
    let split = |text: &str| match text.rsplit_once('^') {
        Some((base, power)) if !power.is_empty() => (base.to_string(), format!("{SUP}{power}{END}")),
        Some((base, _)) => (base.to_string(), String::new()),
        None => (text.to_string(), String::new()),
    };
    let (symbol, rest) = name.split_once('_').unwrap_or((name, ""));
    let ((symbol, lifted), (base, power)) = (split(symbol), split(rest));
    let base = if base.is_empty() { base } else { sub(&base) };
    symbol + &lifted + &base + &power
}

/// Text without control characters, as XML requires.
pub fn clean(text: &str) -> String {
    text.chars().filter(|sign| !sign.is_control()).collect()
}

/// Estimated width of a text (mm) at the font size `size` (mm).
pub fn width(text: &str, size: f64) -> f64 {
    let mut scale = 1.0;
    let mut sum = 0.0;
    for sign in text.chars() {
        match sign {
            SUB | SUP => scale = SMALL,
            END => scale = 1.0,
            _ => sum += scale * LETTER * size,
        }
    }
    sum
}

/// Length (mm) of the part of a text that lies to the left of the text's position.
fn left(text: &str, set: &Type) -> f64 {
    match set.anchor {
        "middle" => width(text, set.size) / 2.0,
        "end" => width(text, set.size),
        _ => 0.0,
    }
}

/// How a line is drawn.
#[derive(Clone, Copy, Debug)]
pub struct Style {
    /// Colour, `#rrggbb`.
    pub colour: &'static str,
    /// Thickness (mm).
    pub width: f64,
    /// Lengths of strokes and gaps (mm), as in SVG; empty for a solid line.
    pub dash: &'static str,
}

/// A solid line.
pub const fn solid(colour: &'static str, width: f64) -> Style {
    Style { colour, width, dash: "" }
}

/// Fill of an area.
#[derive(Clone, Copy, Debug)]
pub struct Tint {
    /// Colour, `#rrggbb` or `white`.
    pub colour: &'static str,
    /// Opacity, 0 to 1.
    pub opacity: f64,
}

impl Tint {
    /// A fill that hides everything beneath it.
    pub const fn opaque(colour: &'static str) -> Tint {
        Tint { colour, opacity: 1.0 }
    }
}

/// The corners of a rectangle, counter-clockwise from the lower left corner.
pub fn rectangle([low, high]: [Vec2; 2]) -> Vec<Vec2> {
    vec![low, Vec2::new(high.x, low.y), high, Vec2::new(low.x, high.y)]
}

/// Typography of a text.
#[derive(Clone, Copy, Debug)]
pub struct Type {
    /// Font size (mm).
    pub size: f64,
    /// Colour, `#rrggbb`.
    pub colour: &'static str,
    /// `start`, `middle` or `end`.
    pub anchor: &'static str,
    /// Whether the letters are slanted.
    pub italic: bool,
    /// Whether the letters are bold.
    pub bold: bool,
    /// Whether the text runs upwards, turned by 90 degrees counter-clockwise about its position.
    pub upward: bool,
}

/// Upright text that starts at its position.
pub const fn words(size: f64) -> Type {
    Type { size, colour: super::style::BLACK, anchor: "start", italic: false, bold: false, upward: false }
}

#[derive(Clone, Debug)]
pub(crate) enum Ink {
    Line([Vec2; 2], Style),
    Arrow([Vec2; 2], Style, String),
    Shape { corners: Vec<Vec2>, closed: bool, fill: Option<Tint>, style: Style },
    Disc { centre: Vec2, radius: f64, fill: &'static str, style: Style },
    Text { at: Vec2, text: String, set: Type },
    Group { ink: Vec<Ink>, opacity: f64, name: String },
}

/// A figure, or a part of one.
#[derive(Clone, Debug, Default)]
pub struct DrawnFigure {
    pub(crate) ink: Vec<Ink>,
    /// Boxes of the placed labels: lower left and upper right corner (mm).
    pub labels: Vec<[Vec2; 2]>,
    /// Layers: the index of the ink at which a layer begins, and the name of the layer.
    layers: Vec<(usize, String)>,
    low: Option<[Vec2; 2]>,
}

impl DrawnFigure {
    /// Begins a layer with this name. Everything that is drawn afterwards lies on the layer.
    pub fn set_layer(&mut self, name: &str) {
        if self.layers.last().is_none_or(|(_, last)| last != name) {
            self.layers.push((self.ink.len(), name.into()));
        }
    }

    /// The layer of the ink with this index. Before the first layer, this is `0`, the usual layer of DXF.
    pub(crate) fn layer_of(&self, index: usize) -> &str {
        let next = self.layers.partition_point(|(from, _)| *from <= index);
        next.checked_sub(1).map_or("0", |last| &self.layers[last].1)
    }

    /// A straight line.
    pub fn line(&mut self, ends: [Vec2; 2], style: Style) {
        ends.iter().for_each(|end| self.reach(*end));
        self.ink.push(Ink::Line(ends, style));
    }

    /// An arrow with a name. A viewer shows the name when the mouse points at the arrow.
    pub fn arrow(&mut self, ends: [Vec2; 2], style: Style, name: String) {
        ends.iter().for_each(|end| self.reach(*end));
        self.ink.push(Ink::Arrow(ends, style, name));
    }

    /// A line through corners. The fill covers the area between the line and the straight line from its last to its
    /// first corner.
    pub fn curve(&mut self, corners: Vec<Vec2>, fill: Option<Tint>, style: Style) {
        corners.iter().for_each(|corner| self.reach(*corner));
        self.ink.push(Ink::Shape { corners, closed: false, fill, style });
    }

    /// A polygon and its fill.
    pub fn area(&mut self, corners: Vec<Vec2>, fill: Option<Tint>, style: Style) {
        corners.iter().for_each(|corner| self.reach(*corner));
        self.ink.push(Ink::Shape { corners, closed: true, fill, style });
    }

    /// A circle.
    pub fn disc(&mut self, centre: Vec2, radius: f64, fill: &'static str, style: Style) {
        let half = Vec2::new(radius, radius);
        self.reach(centre - half);
        self.reach(centre + half);
        self.ink.push(Ink::Disc { centre, radius, fill, style });
    }

    /// A text with its base line at `at`. The text starts, is centred or ends there, as `set.anchor` states.
    pub fn text(&mut self, at: Vec2, text: impl Into<String>, set: Type) {
        let text = text.into();
        let (wide, left) = (width(&text, set.size), left(&text, &set));
        let along = |x: f64, y: f64| if set.upward { Vec2::new(-y, x) } else { Vec2::new(x, y) };
        self.reach(at + along(-left, -0.3 * set.size));
        self.reach(at + along(wide - left, 0.8 * set.size));
        self.ink.push(Ink::Text { at, text, set });
    }

    /// Adds another figure as one element with this opacity. Where shapes of the element overlap, the element is not
    /// darker.
    /// A viewer shows the name of the element when the mouse points at the element.
    pub fn group(&mut self, other: DrawnFigure, opacity: f64, name: String) {
        if let Some(bounds) = other.low {
            bounds.iter().for_each(|corner| self.reach(*corner));
        }
        self.ink.push(Ink::Group { ink: other.ink, opacity, name });
    }

    /// Lower left and upper right corner of all elements.
    pub fn bounds(&self) -> [Vec2; 2] {
        self.low.unwrap_or([Vec2::zeros(); 2])
    }

    /// Adds all of `other` to this figure, moved by `offset`.
    pub fn add(&mut self, other: &DrawnFigure, offset: Vec2) {
        if let Some(bounds) = other.low {
            bounds.iter().for_each(|corner| self.reach(corner + offset));
        }
        let from = self.ink.len();
        self.layers.extend(other.layers.iter().map(|(index, name)| (from + index, name.clone())));
        self.ink.extend(other.ink.iter().map(|ink| ink.moved(offset)));
        self.labels.extend(other.labels.iter().map(|corners| corners.map(|corner| corner + offset)));
    }

    /// All texts outside groups: position, text and typography.
    pub fn texts(&self) -> impl Iterator<Item = (Vec2, &str, &Type)> {
        self.ink.iter().filter_map(|ink| match ink {
            Ink::Text { at, text, set } => Some((*at, text.as_str(), set)),
            Ink::Line(..) | Ink::Arrow(..) | Ink::Shape { .. } | Ink::Disc { .. } | Ink::Group { .. } => None,
        })
    }

    fn reach(&mut self, at: Vec2) {
        let [low, high] = self.low.unwrap_or([at; 2]);
        self.low = Some([low.inf(&at), high.sup(&at)]);
    }

    /// The figure as SVG elements; its y axis is turned downwards.
    pub fn nodes(&self) -> impl Iterator<Item = Box<dyn svg::Node>> + '_ {
        self.ink.iter().map(Ink::node)
    }
}

impl Ink {
    fn moved(&self, by: Vec2) -> Ink {
        let mut ink = self.clone();
        match &mut ink {
            Ink::Line(ends, _) | Ink::Arrow(ends, ..) => ends.iter_mut().for_each(|end| *end += by),
            Ink::Shape { corners, .. } => corners.iter_mut().for_each(|corner| *corner += by),
            Ink::Disc { centre, .. } => *centre += by,
            Ink::Text { at, .. } => *at += by,
            Ink::Group { ink, .. } => ink.iter_mut().for_each(|own| *own = own.moved(by)),
        }
        ink
    }

    fn node(&self) -> Box<dyn svg::Node> {
        match self {
            Ink::Line(ends, style) => Box::new(line(ends, style)),
            Ink::Arrow(ends, style, name) => Box::new(arrow(*ends, style, name)),
            Ink::Shape { corners, closed, fill, style } => {
                let mut data = String::new();
                for (index, corner) in corners.iter().enumerate() {
                    data += &format!("{}{} {}", if index == 0 { "M" } else { "L" }, mm(corner.x), mm(-corner.y));
                }
                data += if *closed { "Z" } else { "" };
                let Tint { colour, opacity } = fill.unwrap_or(Tint::opaque("none"));
                let path = Path::new().set("d", data).set("fill", colour).set("stroke", style.colour);
                let path = path.set("stroke-width", mm(style.width));
                let path = if opacity < 1.0 { path.set("fill-opacity", opacity) } else { path };
                Box::new(if style.dash.is_empty() { path } else { path.set("stroke-dasharray", style.dash) })
            }
            Ink::Disc { centre, radius, fill, style } => Box::new(
                Circle::new()
                    .set("cx", mm(centre.x))
                    .set("cy", mm(-centre.y))
                    .set("r", mm(*radius))
                    .set("fill", *fill)
                    .set("stroke", style.colour)
                    .set("stroke-width", mm(style.width)),
            ),
            Ink::Text { at, text, set } => Box::new(Blob::new(text_element(*at, text, set))),
            Ink::Group { ink, opacity, name } => {
                let group = Group::new().set("opacity", *opacity).add(Title::new(clean(name)));
                Box::new(ink.iter().fold(group, |group, own| group.add(own.node())))
            }
        }
    }
}

/// A length on paper rounded to hundredths of a millimetre; zero has no sign.
fn mm(value: f64) -> f64 {
    (value * 100.0).round() / 100.0 + 0.0
}

fn line(ends: &[Vec2; 2], style: &Style) -> Line {
    let line = Line::new()
        .set("x1", mm(ends[0].x))
        .set("y1", mm(-ends[0].y))
        .set("x2", mm(ends[1].x))
        .set("y2", mm(-ends[1].y))
        .set("stroke", style.colour)
        .set("stroke-width", mm(style.width));
    if style.dash.is_empty() { line } else { line.set("stroke-dasharray", style.dash) }
}

/// The end of an arrow's line, and the corners of its head.
pub(crate) fn head(ends: [Vec2; 2]) -> (Vec2, [Vec2; 3]) {
    let along = ends[1] - ends[0];
    let length = along.norm();
    let unit = along / length;
    let head = HEAD.smaller(HEAD_SHARE * length);
    let base = ends[1] - unit * head;
    let side = turned(unit) * (head * 0.3);
    (base + unit * 0.3, [ends[1], base + side, base - side])
}

fn arrow(ends: [Vec2; 2], style: &Style, name: &str) -> Group {
    let (base, corners) = head(ends);
    let corners = corners.map(|corner| format!("{} {}", mm(corner.x), mm(-corner.y)));
    let head = Path::new().set("d", format!("M{}Z", corners.join("L"))).set("fill", style.colour);
    let group = if name.is_empty() { Group::new() } else { Group::new().add(Title::new(clean(name))) };
    group.add(line(&[ends[0], base], style)).add(head)
}

/// A letter of a text, with its font size and its height above the base line (mm).
pub(crate) struct Piece {
    pub sign: char,
    pub size: f64,
    pub rise: f64,
}

/// The letters of a text at its font size (mm).
pub(crate) fn pieces(text: &str, size: f64) -> Vec<Piece> {
    let (mut own, mut rise) = (size, 0.0);
    let mut pieces = Vec::new();
    for sign in text.chars() {
        match sign {
            SUB => (own, rise) = (SMALL * size, -LOW * size),
            SUP => (own, rise) = (SMALL * size, HIGH * size),
            END => (own, rise) = (size, 0.0),
            sign if sign.is_control() => {}
            sign => pieces.push(Piece { sign, size: own, rise }),
        }
    }
    pieces
}

/// The SVG element of a text, as a string.
/// A tree of elements is not used, because the writer of the tree could add white space between the parts of the text.
fn text_element(at: Vec2, text: &str, set: &Type) -> String {
    let size = set.size;
    let mut shift = 0.0;
    let mut body = String::new();
    let mut open = false;
    let mut start = |body: &mut String, to: f64, size: f64| {
        if open {
            *body += "</tspan>";
        }
        *body += &format!("<tspan dy=\"{}\" font-size=\"{}\">", mm(to - shift), mm(size));
        (shift, open) = (to, true);
    };
    for sign in text.chars() {
        match sign {
            SUB => start(&mut body, LOW * size, SMALL * size),
            SUP => start(&mut body, -HIGH * size, SMALL * size),
            END => start(&mut body, 0.0, size),
            '&' => body += "&amp;",
            '<' => body += "&lt;",
            '>' => body += "&gt;",
            sign if sign.is_control() => {}
            sign => body.push(sign),
        }
    }
    body += if open { "</tspan>" } else { "" };
    let face =
        if set.italic { " font-family=\"Liberation Serif, Times New Roman, serif\" font-style=\"italic\"" } else { "" };
    let weight = if set.bold { " font-weight=\"bold\"" } else { "" };
    // Some viewers do not centre a text of several pieces. The text is therefore shifted by half or all of its
    // estimated width.
    let pieces = text.contains([SUB, SUP]);
    let back = if pieces { left(text, set) } else { 0.0 };
    let [x, y] = if set.upward { [at.x, -at.y + back] } else { [at.x - back, -at.y] }.map(mm);
    let turn = if set.upward { format!(" transform=\"rotate(-90 {x} {y})\"") } else { String::new() };
    let anchor =
        if pieces || set.anchor == "start" { String::new() } else { format!(" text-anchor=\"{}\"", set.anchor) };
    format!(
        "<text x=\"{x}\" y=\"{y}\" font-size=\"{}\" fill=\"{}\"{anchor}{face}{weight}{turn}>{body}</text>",
        mm(size),
        set.colour
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The mark of a cylinder needs both: its line is open at one end, and its fill hides everything beneath it.
    #[test]
    fn an_open_curve_can_be_filled_and_stay_open() {
        let mut figure = DrawnFigure::default();
        let corners = vec![Vec2::zeros(), Vec2::new(1.0, 0.0), Vec2::new(1.0, 1.0)];
        figure.curve(corners.clone(), Some(Tint::opaque("white")), solid("#000000", 0.5));
        figure.curve(corners.clone(), None, solid("#000000", 0.5));
        figure.area(corners, None, solid("#000000", 0.5));
        let [cover, line, area] = [0, 1, 2].map(|k| figure.nodes().nth(k).unwrap().to_string());
        assert!(cover.contains("fill=\"white\"") && !cover.contains('Z'), "{cover}");
        assert!(line.contains("fill=\"none\"") && !line.contains('Z'), "{line}");
        assert!(area.contains("fill=\"none\"") && area.contains('Z'), "{area}");
    }
}
