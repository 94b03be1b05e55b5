//! Mechanisms as pictures: links, joints, guides and loads, at one crank angle, in all configurations, or moving.

mod media;
mod motion;
mod points;
mod positions;
mod subject;

use drawing::dxf::Dxf;
use drawing::paper::document::Drawing;
use drawing::paper::figure::DrawnFigure;
use drawing::sheet::{SheetCell, bare, columns, sheet};
use linkage::error::{Error, Result};
use linkage::math::Vec2;
use scenario::Scenario;

pub use media::{Medium, PictureOptions};
pub(crate) use subject::{Drawn, Note};

/// Size of a picture with one mechanism, of each picture among several, and of a small picture (mm).
const ALONE: [f64; 2] = [150.0, 120.0];
const AMONG: [f64; 2] = [100.0, 96.0];
const SMALL: [f64; 2] = [64.0, 48.0];
/// Factor on `ALONE` and `AMONG` if several positions or enlarged paths are drawn.
const SERIES: f64 = 1.3;
/// Space between pictures in a DXF file, divided by the width of a picture.
const BETWEEN: f64 = 0.2;

/// Draws a mechanism; returns the bytes of a file.
///
/// ```
/// use linkproof::parts::{Medium, PictureOptions, When};
/// use linkproof::{Scenario, draw};
///
/// # std::env::set_current_dir(env!("CARGO_MANIFEST_DIR"))?;
/// let scenario = Scenario::load("scenarios/crank_rocker.toml")?;
/// let picture = draw(scenario, &PictureOptions { at: Some(When::Crank(0.5)), ..PictureOptions::default() }, Medium::Svg)?;
/// assert!(String::from_utf8(picture)?.starts_with("<svg"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`ErrorKind::Input`](crate::parts::ErrorKind::Input) for an invalid instant or an unknown point.
/// The error of the assembly if the mechanism cannot be assembled at the instant.
pub fn draw(scenario: Scenario, wish: &PictureOptions, medium: Medium) -> Result<Vec<u8>> {
    let drawn = Drawn::of(scenario, wish, medium)?;
    match &drawn.fault {
        None => picture(&[drawn], wish, medium),
        Some(fault) => Err(fault.clone()),
    }
}

/// The picture of several files. If a file has faults, its mechanism is drawn as far as possible.
pub(crate) fn picture(all: &[Drawn], wish: &PictureOptions, medium: Medium) -> Result<Vec<u8>> {
    picture_and_warning(all, wish, medium).map(|(bytes, _)| bytes)
}

/// The picture of several files, and a warning if it has letters that the format cannot show.
pub(crate) fn picture_and_warning(
    all: &[Drawn],
    wish: &PictureOptions,
    medium: Medium,
) -> Result<(Vec<u8>, Option<Error>)> {
    match medium {
        Medium::Dxf => Ok((full_size(&sheets(all, wish, medium).swap_remove(0)).into_bytes(), None)),
        Medium::Svg | Medium::Pdf | Medium::Png | Medium::Gif | Medium::WebP => {
            let (pages, title) = pages(all, wish, medium);
            let warning = medium.lacking(pages.iter().map(|(figure, _)| figure));
            Ok((medium.bytes(&pages, &title, wish)?, warning))
        }
    }
}

/// Pictures as DXF at full size (mm), side by side. The origin of the file is the world's origin in the first picture.
fn full_size(cells: &[SheetCell]) -> String {
    let mut file = Dxf::default();
    let mut right = None;
    for cell in cells {
        let factor = cell.scale * 1e3;
        let [low, high] = cell.bounds.map(|corner| corner.x * factor);
        let offset = right.map_or(0.0, |right| right - low);
        file.figure(&cell.figure, factor, Vec2::new(offset, 0.0));
        right = Some(offset + high + BETWEEN * (high - low));
    }
    file.finish()
}

/// The picture of one file as a drawing, which can be written in every still format.
pub(crate) fn drawing(one: Drawn, wish: &PictureOptions) -> Drawing {
    let (pages, title) = pages(&[one], wish, Medium::Svg);
    let (figure, size) = pages.into_iter().next().unwrap_or_default();
    Drawing { figure, size, title }
}

/// The cells of each frame.
fn sheets(all: &[Drawn], wish: &PictureOptions, medium: Medium) -> Vec<Vec<SheetCell>> {
    let frames = medium.frames(wish);
    let room = room(all, wish);
    let mut sheets: Vec<Vec<SheetCell>> = vec![Vec::new(); frames];
    for own in all {
        let mut cells = own.cells(wish, medium, room);
        if all.len() > 1 {
            cells.iter_mut().for_each(|cell| cell.heading.insert(0, own.headline.clone()));
        }
        match frames {
            1 => sheets[0].extend(cells),
            // A mechanism that cannot move looks the same in every frame, so its last cell is repeated.
            _ => {
                let last = cells.last().cloned().into_iter().cycle();
                sheets.iter_mut().zip(cells.into_iter().chain(last)).for_each(|(sheet, cell)| sheet.push(cell));
            }
        }
    }
    sheets
}

/// Size of the area of each cell (mm).
fn room(all: &[Drawn], wish: &PictureOptions) -> Vec2 {
    let count: usize = all.iter().map(|own| own.count(wish)).sum();
    Vec2::from(match (columns(count), wish.course()) {
        (_, _) if wish.small => SMALL,
        (1, None) => ALONE,
        (1, Some(_)) => ALONE.map(|size| SERIES * size),
        (_, None) => AMONG,
        (_, Some(_)) => AMONG.map(|size| SERIES * size),
    })
}

/// The pages of a picture with their sizes (mm), one page for each frame, and the title of the picture.
fn pages(all: &[Drawn], wish: &PictureOptions, medium: Medium) -> (Vec<(DrawnFigure, [f64; 2])>, String) {
    let sheets = sheets(all, wish, medium);
    let formula = all.first().filter(|_| wish.groups).and_then(Drawn::formula);
    let (title, subtitle) = match all {
        [one] if medium.moves() => (one.name.clone(), one.title.as_str()),
        [one] => (one.headline.clone(), formula.as_deref().unwrap_or(&one.title)),
        _ => (all.iter().map(|own| own.name.as_str()).collect::<Vec<_>>().join(", "), ""),
    };
    let page = |cells: &Vec<SheetCell>| match wish.small {
        true => bare(cells, room(all, wish)),
        false => sheet(&title, subtitle, cells, room(all, wish).x),
    };
    let pages = sheets.iter().map(page).collect();
    (pages, title)
}
