//! Mechanisms as pictures: links, joints, guides and loads, at one crank angle, in all configurations, or moving.

mod media;
mod motion;
mod subject;

use drawing::sheet::{SheetCell, columns, sheet};
use linkage::error::Result;
use linkage::math::Vec2;
use scenario::Scenario;

pub use media::{Medium, PictureOptions};
pub(crate) use subject::{Drawn, Note};

/// Size of a picture with one mechanism, and of each picture among several (mm).
const ALONE: [f64; 2] = [150.0, 120.0];
const AMONG: [f64; 2] = [100.0, 96.0];

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
/// The error that prevents assembly at the instant is returned as well.
pub fn draw(scenario: Scenario, wish: &PictureOptions, medium: Medium) -> Result<Vec<u8>> {
    let drawn = Drawn::of(scenario, wish, medium)?;
    match &drawn.fault {
        None => picture(&[drawn], wish, medium),
        Some(fault) => Err(fault.clone()),
    }
}

/// The picture of several files. If a file has faults, its mechanism is drawn as far as possible.
pub(crate) fn picture(all: &[Drawn], wish: &PictureOptions, medium: Medium) -> Result<Vec<u8>> {
    let frames = medium.frames(wish);
    let count: usize = all.iter().map(|own| if wish.each_mode { own.shots.len() } else { 1 }).sum();
    let room = Vec2::from(if columns(count) == 1 { ALONE } else { AMONG });
    // The cells of all files, for each frame.
    let mut sheets: Vec<Vec<SheetCell>> = vec![Vec::new(); frames];
    for own in all {
        let mut cells = own.cells(wish, medium, room);
        if all.len() > 1 {
            cells.iter_mut().for_each(|cell| cell.heading.insert(0, own.headline.clone()));
        }
        match wish.each_mode {
            true => sheets[0].extend(cells),
            // A mechanism that cannot move looks the same in every frame, so its last cell is repeated.
            false => {
                let last = cells.last().cloned().into_iter().cycle();
                sheets.iter_mut().zip(cells.into_iter().chain(last)).for_each(|(sheet, cell)| sheet.push(cell));
            }
        }
    }
    let (title, subtitle) = match all {
        [one] if medium.moves() => (one.name.clone(), one.title.as_str()),
        [one] => (one.headline.clone(), one.title.as_str()),
        _ => (all.iter().map(|own| own.name.as_str()).collect::<Vec<_>>().join(", "), ""),
    };
    let pages: Vec<_> = sheets.iter().map(|cells| sheet(&title, subtitle, cells, room.x)).collect();
    medium.bytes(&pages, &title, wish)
}
