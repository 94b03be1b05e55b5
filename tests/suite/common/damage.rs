//! Bad scenarios: shipped scenarios and random specimens with random damage, reproducible from seed and number.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use super::sketch::RandomSource;
use super::specimens::specimen;

/// A damaged scenario: the path under which it is read, its text, and a description of the damage.
pub struct Damaged {
    pub path: PathBuf,
    pub text: String,
    pub what: Vec<String>,
}

/// All TOML files below `scenarios/`, in the order of their paths.
pub static SHIPPED: LazyLock<Vec<(PathBuf, String)>> = LazyLock::new(|| {
    let mut open = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios")];
    let mut found = Vec::new();
    while let Some(directory) = open.pop() {
        for entry in std::fs::read_dir(directory).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|extension| extension == "toml") {
                let text = std::fs::read_to_string(&path).unwrap();
                found.push((path, text));
            }
        }
    }
    found.sort();
    found
});

/// The damaged scenario with number `index` of a seed.
pub fn damaged(seed: u64, index: u64) -> Damaged {
    let mut random = RandomSource::of_sample(seed, index);
    let (path, mut text) = match random.index(3) {
        0 => {
            let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios/random.toml");
            (path, specimen(seed, index, &mut BTreeMap::new()).toml(random.yes()))
        }
        _ => SHIPPED[random.index(SHIPPED.len())].clone(),
    };
    // Published numbers are long and would get most of the damage, so they are removed from half of the files.
    if random.yes()
        && let Some(end) = text.find("[[oracle]]")
    {
        text.truncate(end);
    }
    let what = (0..[1, 1, 1, 2, 3][random.index(5)]).map(|_| damage(&mut random, &mut text)).collect();
    Damaged { path, text, what }
}

/// Extreme numbers, unusual spellings of numbers, and values that are not numbers.
pub const NUMBERS: [&str; 36] = [
    "0",
    "-0.0",
    "1e308",
    "-1e308",
    "1e300",
    "1e-300",
    "5e-324",
    "1e30",
    "1e-30",
    "1e18",
    "-1e18",
    "1e9",
    "1e6",
    "1e-6",
    "nan",
    "-nan",
    "inf",
    "-inf",
    "\"\"",
    "\"3\"",
    "true",
    "[]",
    "{}",
    "[1, 2]",
    "99999999999999999999",
    "-9223372036854775808",
    "0x7fffffffffffffff",
    "1979-05-27",
    "1e",
    "--1",
    "1_000",
    "3.",
    "0.1e-400",
    "1e400",
    "[[]]",
    "{ x = 1 }",
];

/// Texts that replace a name, a type or a path.
const TEXTS: [&str; 24] = [
    "\"\"",
    "\" \"",
    "\"ground\"",
    "\"../../etc/passwd\"",
    "\"/dev/zero\"",
    "\".\"",
    "\"con\"",
    "\"-x\"",
    "\"a/b\"",
    "\"a.b\"",
    "\"a,b\"",
    "\"\\u0000\"",
    "\"\\n\"",
    "\"\\u001b[31m\"",
    "\"\\u202e\"",
    "\"ё\"",
    "'''x'''",
    "1",
    "nan",
    "false",
    "[]",
    "[\"A\"]",
    "\"prismatic\"",
    "\"revolute\"",
];

fn damage(random: &mut RandomSource, text: &mut String) -> String {
    let lines = |text: &str| text.lines().map(String::from).collect::<Vec<String>>();
    match random.index(16) {
        0..=4 => {
            let Some(at) = one(random, numbers(text)) else { return "nothing".into() };
            let old = text[at.clone()].to_string();
            let new = match (random.index(3), old.parse::<f64>()) {
                (0, Ok(value)) => {
                    let factor = [-1.0, 10.0, 0.1, 1e3, 1e-3, 1e6, 1e-6, 1.0 + 1e-9, 1.01][random.index(9)];
                    format!("{:e}", value * factor)
                }
                _ => NUMBERS[random.index(NUMBERS.len())].to_string(),
            };
            text.replace_range(at, &new);
            format!("{old} -> {new}")
        }
        5 | 6 => {
            let all = texts(text);
            let Some(at) = one(random, all.clone()) else { return "nothing".into() };
            let old = text[at.clone()].to_string();
            // Replacing a name by a second name of the file separates links, or joins links that should be separate.
            let new = match random.index(2) {
                0 => text[all[random.index(all.len())].clone()].to_string(),
                _ => TEXTS[random.index(TEXTS.len())].to_string(),
            };
            text.replace_range(at, &new);
            format!("{old} -> {new}")
        }
        7 => {
            let mut all = lines(text);
            let gone = all.remove(random.index(all.len()));
            *text = all.join("\n");
            format!("without {gone}")
        }
        8 => {
            let mut all = lines(text);
            let place = random.index(all.len());
            let line = all[place].clone();
            all.insert(random.index(all.len()), line.clone());
            *text = all.join("\n");
            format!("twice {line}")
        }
        9 => {
            let mut all = lines(text);
            let [a, b] = [random.index(all.len()), random.index(all.len())];
            all.swap(a, b);
            *text = all.join("\n");
            format!("lines {a} and {b} swapped")
        }
        10 | 11 => {
            let Some(at) = one(random, keys(text)) else { return "nothing".into() };
            let old = text[at.clone()].to_string();
            let new = misspelt(random, &old);
            text.replace_range(at, &new);
            format!("{old} -> {new}")
        }
        12 => {
            // One of three damages: a heading is removed, so its keys belong to the section before; a section is
            // removed; or a section is repeated at the end of the file.
            let heads: Vec<usize> =
                text.lines().enumerate().filter(|(_, line)| line.starts_with('[')).map(|l| l.0).collect();
            let Some(line) = (!heads.is_empty()).then(|| heads[random.index(heads.len())]) else {
                return "nothing".into();
            };
            let mut all = lines(text);
            let end = heads.iter().copied().find(|&head| head > line).unwrap_or(all.len());
            let what = if random.yes() { line..line + 1 } else { line..end };
            let gone = all[what.start].clone();
            if random.yes() {
                all.drain(what);
                *text = all.join("\n");
                return format!("section without {gone}");
            }
            let own = all[line..end].to_vec();
            all.extend(own);
            *text = all.join("\n");
            format!("section twice {gone}")
        }
        13 => {
            let mut cut = random.index(text.len().max(1));
            while !text.is_char_boundary(cut) {
                cut -= 1;
            }
            text.truncate(cut);
            format!("cut after {cut} bytes")
        }
        14 => {
            let mut place = random.index(text.len().max(1));
            while !text.is_char_boundary(place) {
                place -= 1;
            }
            let letters =
                ["\u{0}", "\u{7f}", "\"", "[", "]", "{", "}", "=", "\n", "\r", ",", ".", "#", "'", "\u{202e}", "é"];
            let letter = letters[random.index(letters.len())];
            text.insert_str(place, letter);
            format!("{letter:?} at {place}")
        }
        _ => grid(random, text),
    }
}

/// Replaces the grid by an unusual or wrong grid: reversed, empty, with one instant, far away, very fine, with
/// contradictory keys, or as a list.
fn grid(random: &mut RandomSource, text: &mut String) -> String {
    const GRIDS: [&str; 14] = [
        "from_deg = 360\nto_deg = 0\nstep_deg = 1",
        "from_deg = 360\nto_deg = 0\nstep_deg = -90",
        "from_deg = 0\nto_deg = 0\nstep_deg = 1",
        "from_deg = 0\nto_deg = 1e9\nstep_deg = 1e9",
        "from_deg = 0\nto_deg = 3.6e7\nstep_deg = 1.8e7",
        "from_deg = 0\nto_deg = 1\nstep_deg = 1e-9",
        "from_deg = 0\nto_deg = 1e-12\nstep_deg = 1e-13",
        "from_s = 0\nto_s = 1\nstep_s = 0.5",
        "from_s = -1\nto_s = 1\nstep_s = 0.5",
        "times_s = [0, 0]",
        "times_s = []",
        "times_s = [0, 1e-300, 1e-3]",
        "angles_deg = [10, -10, 370]",
        "from_deg = 0\nto_s = 1\nstep_deg = 1",
    ];
    let new = GRIDS[random.index(GRIDS.len())];
    let Some(start) = text.find("\n[grid]") else { return "nothing".into() };
    let start = start + "\n[grid]\n".len();
    let end = text[start..].find("\n[").map_or(text.len(), |end| start + end);
    if start > end || !text.is_char_boundary(start) {
        return "nothing".into();
    }
    text.replace_range(start..end, new);
    format!("grid {new:?}")
}

fn one(random: &mut RandomSource, all: Vec<Range<usize>>) -> Option<Range<usize>> {
    (!all.is_empty()).then(|| all[random.index(all.len())].clone())
}

/// Positions of the numbers that are values of keys or elements of lists.
fn numbers(text: &str) -> Vec<Range<usize>> {
    words(text, |letter| letter.is_ascii_alphanumeric() || "+-._".contains(letter))
        .into_iter()
        .filter(|at| {
            let before = text[..at.start].trim_end_matches(' ').as_bytes().last();
            text[at.clone()].parse::<f64>().is_ok() && matches!(before, Some(b'=' | b',' | b'['))
        })
        .collect()
}

/// Positions of bare keys, and of words before a closing bracket.
fn keys(text: &str) -> Vec<Range<usize>> {
    words(text, |letter| letter.is_ascii_alphanumeric() || "-_".contains(letter))
        .into_iter()
        .filter(|at| text[at.end..].trim_start_matches(' ').starts_with(['=', ']']))
        .collect()
}

/// Positions of texts, with their quotes.
fn texts(text: &str) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        let quotes: Vec<usize> = line.match_indices('"').map(|(place, _)| start + place).collect();
        found.extend(quotes.chunks_exact(2).map(|pair| pair[0]..pair[1] + 1));
        start += line.len();
    }
    found
}

/// Positions of all runs of characters that `is_own` accepts, each as long as possible, outside comments.
fn words(text: &str, is_own: impl Fn(char) -> bool) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        let code = line.split('#').next().unwrap_or_default();
        let mut from = None;
        for (place, letter) in code.char_indices().chain([(code.len(), '\n')]) {
            match (is_own(letter), from) {
                (true, None) => from = Some(place),
                (false, Some(first)) => {
                    found.push(start + first..start + place);
                    from = None;
                }
                (true, Some(_)) | (false, None) => {}
            }
        }
        start += line.len();
    }
    found
}

fn misspelt(random: &mut RandomSource, key: &str) -> String {
    let mut letters: Vec<char> = key.chars().collect();
    let place = random.index(letters.len());
    match random.index(5) {
        0 => letters.insert(place, 'x'),
        1 => drop(letters.remove(place)),
        2 if letters.len() > 1 => letters.swap(place, (place + 1) % key.chars().count()),
        3 => return ["mass_kg", "x_mm", "crank_deg", "name", "points", "speed_rpm", "ground"][random.index(7)].into(),
        _ => {
            let stem = key.rsplit_once('_').map_or(key, |(stem, _)| stem);
            return format!(
                "{stem}_{}",
                ["mm", "m", "deg", "rad", "kg", "N", "N_m", "s", "parsec", ""][random.index(10)]
            );
        }
    }
    letters.into_iter().collect()
}
