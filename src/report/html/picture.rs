//! The mechanism as SVG, at the first instant. The script moves the links.

use super::markup::escaped;
use super::placed::Placed;
use drawing::{Fill, Ink, Layer, Mark, MarkRole, MarkShape, Sketch, palette};
use linkage::math::KeepNan;
use linkage::mechanism::{GROUND, LinkId, LinkPose};

/// Margin around the motion for arrows and names, in picture units.
const MARGIN: f64 = 15.0;
/// Radius of an engine's pins divided by the radius of the reference's pins.
const RING: f64 = 1.5;

/// The view box that shows an area (m): left, top (y downwards), width and height in picture units.
pub(super) fn view([x, y]: [[f64; 2]; 2], unit: f64) -> [f64; 4] {
    let [wide, height] = [x, y].map(|ends| (ends[1] - ends[0]) / unit + 2.0 * MARGIN);
    // The picture is at most as high as wide, so that the controls below stay visible.
    let width = wide.larger(height);
    [x[0] / unit - MARGIN - (width - wide) / 2.0, -y[1] / unit - MARGIN, width, height]
}

/// The ground, the reference and an engine (dashed, with hollow pins) at this row.
pub(super) fn drawn(sketch: &Sketch, placed: &Placed, view: [f64; 4], row: usize) -> String {
    let [x, y, width, height] = view.map(number);
    let mut out = format!(
        "<svg id=\"picture\" viewBox=\"{x} {y} {width} {height}\" role=\"img\" aria-labelledby=\"picture-title\" aria-describedby=\"picture-words\">\n\
         <title id=\"picture-title\">The mechanism in motion</title>\n<g id=\"paths\"></g>\n"
    );
    let order = sketch.in_order();
    let is_ground = |link: LinkId| link == GROUND;
    let ground = |mark: &Mark| mark.role.look().layer == Layer::Ground;
    let of = |has: &dyn Fn(LinkId, &Mark) -> bool| group(&order, sketch, placed, row, has);
    say!(out, "<g class=\"ground\">{}</g>", of(&|link, mark| is_ground(link) && ground(mark)));
    say!(out, "<g class=\"reference\">{}</g>", of(&|link, mark| !(is_ground(link) && ground(mark))));
    let moves = |link: LinkId, mark: &Mark| {
        let layer = mark.role.look().layer;
        let is_body = matches!(layer, Layer::Links | Layer::Blocks) || mark.role.name() == "pin";
        is_body && !is_ground(link)
    };
    say!(out, "<g class=\"engine\">{}</g>", of(&moves));
    out.push_str(
        "<g id=\"stretched\"></g>\n<g id=\"arrows\"></g>\n<g id=\"loads\"></g>\n<g id=\"load-numbers\"></g>\n<g id=\"names\"></g>\n<g id=\"scales\"></g>\n</svg>",
    );
    out
}

/// Marks in their order; consecutive marks of one link share an element.
fn group(
    order: &[(LinkId, &Mark)],
    sketch: &Sketch,
    placed: &Placed,
    row: usize,
    has: &dyn Fn(LinkId, &Mark) -> bool,
) -> String {
    let mut out = String::new();
    let mut open: Option<LinkId> = None;
    for &(link, mark) in order.iter().filter(|(link, mark)| has(*link, mark)) {
        if open != Some(link) {
            if open.is_some() {
                out.push_str("</g>");
            }
            let place = transform(placed.pose(row, link), sketch.unit);
            let name = escaped(&placed.mechanism.links()[link].name);
            put!(out, "\n<g class=\"k{link}\" data-link=\"{link}\" data-name=\"{name}\" transform=\"{place}\">");
            open = Some(link);
        }
        out.push_str(&element(mark, sketch.unit));
    }
    if open.is_some() {
        out.push_str("</g>");
    }
    out
}

/// The SVG transform of a link: link coordinates have y upwards, picture coordinates have y downwards; both are in
/// picture units.
fn transform(pose: LinkPose, unit: f64) -> String {
    let (sine, cosine) = pose.angle.sin_cos();
    let at = pose.origin / unit;
    format!("matrix({cosine} {} {} {} {} {})", -sine, -sine, -cosine, at.x, -at.y)
}

fn element(mark: &Mark, unit: f64) -> String {
    let look = mark.role.look();
    let ink = match look.ink {
        Ink::Link => "il",
        Ink::Text => "it",
        Ink::Quiet => "iq",
        Ink::Load => "io",
    };
    let fill = match look.fill {
        Fill::None => "fn",
        Fill::Paper => "fp",
        Fill::Tint => "ft",
        Fill::Ink => "fi",
    };
    let class = format!("class=\"{} {ink} {fill}\" stroke-width=\"{}\"", mark.role.name(), number(look.width));
    match &mark.shape {
        MarkShape::Circle { centre, radius } => {
            // The engine's pins surround the reference's pins. The engine's wheels, dashed, lie on the reference's
            // wheels.
            let ring = if mark.role == MarkRole::Wheel { *radius } else { RING * radius };
            let [x, y, r, ring] = [centre.x, centre.y, *radius, ring].map(|own| number(own / unit));
            format!("<circle {class} cx=\"{x}\" cy=\"{y}\" r=\"{r}\" data-ring=\"{ring}\"/>")
        }
        MarkShape::Line { .. } | MarkShape::Arc { .. } => {
            let points = mark.shape.points().into_iter().map(|at| [at.x / unit, at.y / unit]);
            format!("<path {class} d=\"{}\"/>", path(points, mark.shape.is_closed()))
        }
    }
}

/// The path through some points, in picture units.
pub(super) fn path(points: impl Iterator<Item = [f64; 2]>, closed: bool) -> String {
    let points: Vec<String> = points.map(|[x, y]| format!("{} {}", number(x), number(y))).collect();
    format!("M{}{}", points.join("L"), if closed { "Z" } else { "" })
}

/// A length in picture units, to four decimals.
fn number(value: f64) -> String {
    let text = format!("{value:.4}");
    let short = text.trim_end_matches('0').trim_end_matches('.');
    if short == "-0" { "0".into() } else { short.into() }
}

/// Name of a custom property in the style of the page.
fn property(name: &str) -> String {
    format!("--{name}")
}

/// Name of the colour of a link, and of the class of its elements.
fn of_link(link: LinkId) -> String {
    format!("k{link}")
}

/// Rules for the colours of all links and other marks, on a light or dark background.
pub(super) fn colours(links: usize, dark: bool) -> String {
    let rule = |name: &str, paint: palette::PaletteColour| {
        format!("{}:{}", property(name), if dark { paint.dark } else { paint.light })
    };
    let named =
        [("text", palette::TEXT), ("quiet", palette::QUIET), ("load", palette::LOAD), ("paper", palette::PAPER)];
    let mut rules: Vec<String> = named.into_iter().map(|(name, paint)| rule(name, paint)).collect();
    rules.extend((0..links).map(LinkId).map(|link| rule(&of_link(link), palette::link(link))));
    rules.join(";")
}

/// Rules that give the elements of each link its colour.
pub(super) fn inks(links: usize) -> String {
    let rule = |name: String| format!(".{name}{{{}:var({})}}", property("ink"), property(&name));
    (0..links).map(LinkId).map(of_link).map(rule).collect()
}
