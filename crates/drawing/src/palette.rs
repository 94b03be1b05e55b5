//! Colours of links, the same in every picture.
//!
//! Colour is never the only distinction: links also have numbers, and plates are hatched at different angles.

use linkage::mechanism::LinkId;

/// A colour for light and dark paper, and the hatching that replaces it in pictures without colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PaletteColour {
    /// Colour on light paper (`#rrggbb`). The contrast of this colour with white is at least 3 : 1, as WCAG asks of
    /// lines.
    pub light: &'static str,
    /// Colour on dark paper (`#rrggbb`). The contrast of this colour with #16181c is at least 3 : 1.
    pub dark: &'static str,
    /// Angle of the hatching of plates (deg).
    pub hatch_deg: f64,
}

/// Colours of links (after Okabe and Ito 2008). The colours are also distinct in grey scale.
pub const LINKS: [PaletteColour; 7] = [
    PaletteColour { light: "#0072b2", dark: "#56b4e9", hatch_deg: 45.0 },
    PaletteColour { light: "#d55e00", dark: "#ff8c42", hatch_deg: -45.0 },
    PaletteColour { light: "#009e73", dark: "#2ec99a", hatch_deg: 15.0 },
    PaletteColour { light: "#b0578d", dark: "#e38fc0", hatch_deg: -15.0 },
    PaletteColour { light: "#b8860b", dark: "#f0c550", hatch_deg: 75.0 },
    PaletteColour { light: "#4b2e83", dark: "#a991e0", hatch_deg: -75.0 },
    PaletteColour { light: "#3b8ea5", dark: "#7fd1e6", hatch_deg: 0.0 },
];

/// Colours of the curves of a chart: four colours of Okabe and Ito (2008), three darker colours, and the colour of
/// text.
/// The darker colours replace orange, sky blue and yellow, because such lines are hardly visible on white paper.
/// Readers without red or green receptors can distinguish all colours.
pub const SERIES: [PaletteColour; 8] = [
    LINKS[0],
    LINKS[1],
    LINKS[2],
    PaletteColour { light: "#cc79a7", dark: "#cc79a7", hatch_deg: -15.0 },
    PaletteColour { light: "#6a00a8", dark: "#b18cff", hatch_deg: 75.0 },
    PaletteColour { light: "#7a3b00", dark: "#d9b38c", hatch_deg: -75.0 },
    PaletteColour { light: "#882255", dark: "#ff9a9a", hatch_deg: 0.0 },
    TEXT,
];

/// Colour of text and of fixed parts.
pub const TEXT: PaletteColour = PaletteColour { light: "#1a1a1a", dark: "#eceff4", hatch_deg: 45.0 };
/// Colour of auxiliary lines and symbols, such as axes and mass centres.
pub const QUIET: PaletteColour = PaletteColour { light: "#767676", dark: "#9aa0aa", hatch_deg: 45.0 };
/// Colour of loads, springs and dampers.
pub const LOAD: PaletteColour = PaletteColour { light: "#c1121f", dark: "#ff6b6b", hatch_deg: 45.0 };
/// The paper.
pub const PAPER: PaletteColour = PaletteColour { light: "#ffffff", dark: "#16181c", hatch_deg: 45.0 };

/// Colours of areas, grid lines and faults. Each entry has the colour on light paper and the colour on dark paper.
const OTHERS: [[&str; 2]; 12] = [
    ["#ffffff", PAPER.dark],
    ["white", PAPER.dark],
    ["#d11149", "#ff6b8a"],
    ["#c8c8c8", "#4a4e57"],
    ["#d0d0d0", "#464a53"],
    ["#d4d4d4", "#42464e"],
    ["#ececec", "#26292f"],
    ["#fcf0f0", "#3a2226"],
    ["#e3edf4", "#22313c"],
    ["#f3c9a5", "#6b4a2a"],
    ["#fbe9da", "#3d2f22"],
    ["#dcefdc", "#23392a"],
];

/// All colours on light paper, each with its colour on dark paper.
fn pairs() -> impl Iterator<Item = [&'static str; 2]> {
    let named = LINKS.into_iter().chain(SERIES).chain([TEXT, QUIET, LOAD]).map(|own| [own.light, own.dark]);
    named.chain(OTHERS)
}

/// Style rules for the dark mode of an SVG document: each colour on light paper is replaced by its colour on dark
/// paper.
/// The rules apply only if a viewer in dark mode shows the document alone. A printed document, and a document that is
/// embedded in a web page, stay light.
pub fn dark_rules(document: &str) -> String {
    let mut rules = Vec::new();
    for [light, dark] in pairs() {
        for key in ["fill", "stroke"] {
            let rule = format!("svg:root [{key}=\"{light}\"]{{{key}:{dark}}}");
            if document.contains(&format!("{key}=\"{light}\"")) && !rules.contains(&rule) {
                rules.push(rule);
            }
        }
    }
    format!("@media screen and (prefers-color-scheme:dark){{{}}}", rules.concat())
}

/// Colour of the link with this number. The ground has number 0 and the colour of text.
pub fn link(number: LinkId) -> PaletteColour {
    match number.index().checked_sub(1) {
        None => TEXT,
        Some(index) => LINKS[index % LINKS.len()],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::{Path, PathBuf};

    /// Red, green and blue of a colour as linear intensities from 0 to 1, after WCAG 2.
    fn linear(colour: &str) -> [f64; 3] {
        [1, 3, 5].map(|at| {
            let part = f64::from(u8::from_str_radix(&colour[at..at + 2], 16).unwrap()) / 255.0;
            if part <= 0.04045 { part / 12.92 } else { ((part + 0.055) / 1.055).powf(2.4) }
        })
    }

    fn times(matrix: [[f64; 3]; 3], own: [f64; 3]) -> [f64; 3] {
        matrix.map(|row| row.iter().zip(own).map(|(a, b)| a * b).sum())
    }

    /// Relative luminance of a colour, after WCAG 2.
    fn luminance(colour: &str) -> f64 {
        times([[0.2126, 0.7152, 0.0722]; 3], linear(colour))[0]
    }

    /// Smallest distance of two colours (CIELAB 1976) for three kinds of eyes: usual, without green receptors, and
    /// without red receptors (Machado, Oliveira and Fernandes 2009).
    fn distance(one: &str, other: &str) -> f64 {
        let eyes = [
            [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.01182, 0.04294, 0.968881]],
            [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
        ];
        let white = [[0.4339, 0.3762, 0.1899], [0.2126, 0.7152, 0.0722], [0.0178, 0.1095, 0.8727]];
        let place = |eye: [[f64; 3]; 3], colour: &str| {
            let seen = times(eye, linear(colour)).map(|part| part.clamp(0.0, 1.0));
            let [x, y, z] =
                times(white, seen).map(|own| if own > 0.008856 { own.cbrt() } else { 7.787 * own + 16.0 / 116.0 });
            [116.0 * y, 500.0 * (x - y), 200.0 * (y - z)]
        };
        let apart =
            |eye| place(eye, one).iter().zip(place(eye, other)).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
        eyes.map(apart).into_iter().fold(f64::INFINITY, linkage::math::KeepNan::smaller)
    }

    /// The files with this ending in folders of the repository; only folders and files that `is_read` accepts.
    fn files(folders: &[&str], ending: &str, is_read: impl Fn(&Path) -> bool) -> Vec<PathBuf> {
        let top = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let (mut open, mut found) = (folders.iter().map(|name| top.join(name)).collect::<Vec<_>>(), Vec::new());
        while let Some(folder) = open.pop() {
            let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
            for entry in entries.filter(|path| is_read(path)) {
                if entry.is_dir() {
                    open.push(entry);
                } else if entry.extension().is_some_and(|own| own == ending) {
                    found.push(entry);
                }
            }
        }
        found
    }

    /// Symptom: in a dark page, pictures stayed white or kept some light colours.
    #[test]
    fn regress_every_colour_has_one_partner_on_dark_paper() {
        let all: std::collections::BTreeMap<&str, &str> = pairs().map(|[light, dark]| (light, dark)).collect();
        assert!(pairs().all(|[light, dark]| all[light] == dark));
        let is_hex = |digits: &str| digits.len() == 6 && digits.chars().all(|digit| digit.is_ascii_hexdigit());
        let is_colour = |word: &str| word.strip_prefix('#').is_some_and(is_hex);
        let is_read = |path: &Path| {
            let others = ["html", "layout.rs", "palette.rs", "plotjuggler.rs", "sweep.rs"];
            !others.iter().any(|name| path.ends_with(name))
        };
        for entry in files(&["crates/drawing/src", "crates/design/src", "src/report"], "rs", is_read) {
            let text = std::fs::read_to_string(&entry).unwrap();
            let code = text.split("#[cfg(test)]").next().unwrap();
            for colour in code.split('"').filter(|word| is_colour(word)) {
                assert!(all.contains_key(colour), "{}: {colour}", entry.display());
            }
        }
    }

    /// Symptom: two curves had nearly the same orange, and two other curves the same blue.
    #[test]
    fn regress_the_colours_of_series_differ_for_all_eyes() {
        for (index, one) in SERIES.iter().enumerate() {
            for other in &SERIES[..index] {
                let apart = distance(one.light, other.light);
                assert!(apart > 17.0, "{one:?} {other:?}: {apart}");
            }
        }
    }

    /// Smallest contrast of a colour with the paper, light or dark (WCAG 2).
    fn contrast([light, dark]: [&str; 2]) -> f64 {
        let on_light = (luminance(PAPER.light) + 0.05) / (luminance(light) + 0.05);
        linkage::math::KeepNan::smaller(on_light, (luminance(dark) + 0.05) / (luminance(PAPER.dark) + 0.05))
    }

    #[test]
    fn every_colour_has_enough_contrast_with_the_paper() {
        for paint in LINKS.into_iter().chain(SERIES).chain([TEXT, QUIET, LOAD]) {
            let (found, least) =
                (contrast([paint.light, paint.dark]), if [TEXT, QUIET].contains(&paint) { 4.5 } else { 3.0 });
            assert!(found >= least, "{paint:?}: {found}");
        }
    }

    /// Symptom: numbers of links had the colours of links, with a contrast of 3 : 1. WCAG asks for 4.5 : 1 for text.
    #[test]
    fn regress_text_in_the_pictures_of_documents_has_enough_contrast() {
        let mut found = std::collections::BTreeMap::new();
        for entry in files(&["docs"], "svg", |_| true) {
            let picture = std::fs::read_to_string(&entry).unwrap();
            let texts = picture.split("<text").skip(1).filter_map(|text| text.split('>').next());
            let fills = texts.filter_map(|text| text.split("fill=\"").nth(1)?.split('"').next());
            found.extend(fills.map(|fill| (fill.to_string(), entry.clone())));
        }
        assert!(found.len() > 3, "{found:?}");
        for (light, picture) in &found {
            let pair = pairs().find(|pair| pair[0] == light).unwrap();
            assert!(contrast(pair) >= 4.5, "{light} in {}: {}", picture.display(), contrast(pair));
        }
    }
}
