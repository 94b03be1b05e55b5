//! Damage to bytes: random changes, false sizes in records, and typing errors.

use super::super::damage::NUMBERS;
use super::super::parquet::Announced;
use super::super::sketch::RandomSource;

/// Replaces lengths and sizes in a recording by false ones.
pub fn lengths(random: &mut RandomSource, bytes: &mut [u8], what: &mut Vec<String>) {
    let mut places = Vec::new();
    let mut at = mcap::MAGIC.len();
    while at + 9 < bytes.len() {
        let length = u64::from_le_bytes(bytes[at + 1..at + 9].try_into().unwrap()) as usize;
        places.extend([(at + 1, bytes[at]), (at + 9, bytes[at]), (at + 17, bytes[at]), (at + 25, bytes[at])]);
        at = at.saturating_add(9).saturating_add(length);
    }
    for _ in 0..=random.index(3) {
        let (place, code) = places[random.index(places.len())];
        let value = [0, 1, 9, 5000, 1 << 20, 1 << 31, 1 << 40, u64::MAX - 8, u64::MAX][random.index(9)];
        if let Some(own) = bytes.get_mut(place..place + 8) {
            own.copy_from_slice(&value.to_le_bytes());
            what.push(format!("{value} at byte {place} of a record {code}"));
        }
    }
}

/// Makes a typing error, or changes bytes in ways that the author of a file would not.
pub fn spoil(random: &mut RandomSource, bytes: &mut Vec<u8>, what: &mut Vec<String>) {
    /// Largest damaged input (bytes).
    const MOST: usize = 8 << 20;
    if random.yes() {
        slip(random, bytes, what);
        return;
    }
    for _ in 0..=random.index(3) {
        let place = random.index(bytes.len().max(1)).min(bytes.len());
        let end = (place + random.index(2000)).min(bytes.len());
        let deep = [10, 1000, 100_000][random.index(3)];
        what.push(match random.index(15) {
            0 => {
                bytes.truncate(place);
                format!("cut after {place} bytes")
            }
            1 => {
                let count = 1 + random.index(16);
                for _ in 0..count.min(bytes.len()) {
                    let at = random.index(bytes.len());
                    bytes[at] ^= 1 << random.index(8);
                }
                format!("{count} bits turned")
            }
            2 => {
                let all: [&[u8]; 8] =
                    [b"\0", b"\xef\xbb\xbf", b"\xff", b"\x1b[31m", "\u{202e}".as_bytes(), b"\r", b"\"", b","];
                let own = all[random.index(all.len())];
                bytes.splice(place..place, own.iter().copied());
                format!("{own:?} at byte {place}")
            }
            3 => {
                *bytes = bytes
                    .iter()
                    .flat_map(|&byte| if byte == b'\n' { vec![b'\r', b'\n'] } else { vec![byte] })
                    .collect();
                "ends of lines of Windows".into()
            }
            4 => {
                let is_marked = random.yes();
                let units = String::from_utf8_lossy(bytes).encode_utf16().collect::<Vec<_>>();
                let mark = if is_marked { vec![0xfeffu16] } else { Vec::new() };
                *bytes = mark.into_iter().chain(units).flat_map(u16::to_le_bytes).collect();
                "UTF-16".into()
            }
            5 | 6 => {
                let start = bytes[..place].iter().rposition(|&byte| byte == b'\n').map_or(0, |at| at + 1);
                let stop =
                    bytes[place..].iter().position(|&byte| byte == b'\n').map_or(bytes.len(), |at| place + at + 1);
                let line = bytes[start..stop].to_vec();
                let times = deep.min(MOST / line.len().max(1));
                bytes.splice(stop..stop, line.repeat(times));
                format!("a line {times} times")
            }
            7 | 8 => {
                let digits = "9".repeat(deep);
                let new = if random.index(6) == 0 { digits.as_str() } else { NUMBERS[random.index(NUMBERS.len())] };
                number(random, bytes, new.as_bytes());
                format!("a number {}", &new[..new.len().min(30)])
            }
            9 | 10 => {
                let [open, close] =
                    [["[", "]"], ["(", ")"], ["{a = ", "}"], ["{\"a\": ", "}"], ["\"", "\""]][random.index(5)];
                let close = if random.yes() { close.repeat(deep) } else { String::new() };
                number(random, bytes, format!("{}1{close}", open.repeat(deep)).as_bytes());
                format!("{open} {deep} times")
            }
            11 => {
                bytes.splice(place..place, vec![b'a'; deep * 10]);
                format!("a word of {} letters", deep * 10)
            }
            12 => {
                bytes.drain(place..end);
                format!("without bytes {place} to {end}")
            }
            13 => {
                let part = bytes[place..end].to_vec();
                let to = random.index(bytes.len().max(1)).min(bytes.len());
                bytes.splice(to..to, part);
                format!("bytes {place} to {end} again at {to}")
            }
            _ => {
                *bytes = match random.index(4) {
                    0 => Vec::new(),
                    1 => vec![b' '; deep],
                    2 => vec![b'\n'; deep * 10],
                    _ => (0..deep.min(5000)).map(|_| random.index(256) as u8).collect(),
                };
                format!("{} other bytes", bytes.len())
            }
        });
        bytes.truncate(MOST);
    }
}

/// A typing error: one different digit, a line twice, a missing line, or two exchanged lines.
fn slip(random: &mut RandomSource, bytes: &mut Vec<u8>, what: &mut Vec<String>) {
    let kind = random.index(4);
    if kind == 0 {
        let digits: Vec<usize> = (0..bytes.len()).filter(|&at| bytes[at].is_ascii_digit()).collect();
        if let Some(&at) = digits.get(random.index(digits.len().max(1))) {
            bytes[at] = b'0' + random.index(10) as u8;
            what.push(format!("another digit at byte {at}"));
        }
        return;
    }
    let mut lines: Vec<Vec<u8>> = bytes.split(|&byte| byte == b'\n').map(<[u8]>::to_vec).collect();
    let [a, b] = [random.index(lines.len()), random.index(lines.len())];
    match kind {
        1 => lines.insert(b, lines[a].clone()),
        2 => drop(lines.remove(a)),
        _ => lines.swap(a, b),
    }
    what.push(format!("{} lines {a}, {b}", ["", "twice", "without", "exchanged"][kind]));
    *bytes = lines.join(&b'\n');
}

/// Replaces a number.
fn number(random: &mut RandomSource, bytes: &mut Vec<u8>, new: &[u8]) {
    let starts = |at: &usize| bytes[*at].is_ascii_digit() && (*at == 0 || !bytes[at - 1].is_ascii_alphanumeric());
    let all: Vec<usize> = (0..bytes.len()).filter(starts).collect();
    if all.is_empty() {
        return;
    }
    let start = all[random.index(all.len())];
    let length = bytes[start..].iter().take_while(|byte| byte.is_ascii_alphanumeric() || **byte == b'.').count();
    bytes.splice(start..start + length, new.iter().copied());
}

/// A table with each of its columns repeated many times.
pub fn wide(table: &[u8], columns: usize) -> Vec<u8> {
    let lines = table.split(|&byte| byte == b'\n').take(4_000_000 / columns.max(1) / 8 + 2);
    let times = columns / 4 + 1;
    lines.flat_map(|line| [vec![line; times].join(&b','), vec![b'\n']].concat()).collect()
}

/// A Parquet file in which some announced numbers are replaced by false numbers, most of them large.
pub fn announced(random: &mut RandomSource, what: &mut Vec<String>) -> Vec<u8> {
    let rows = [0, 1, 100, 100_000, 1 << 20, 60_000_000][random.index(6)];
    let mut own = if rows > 1 << 20 || random.yes() { Announced::run(rows) } else { Announced::zeros(rows) };
    let large = [0, -1, 1, 5000, 1 << 20, 1 << 26, (1 << 31) - 1, 1 << 40, i64::MAX, i64::MIN][random.index(10)];
    what.push(format!("{rows} rows"));
    for _ in 0..random.index(3) {
        what.push(match random.index(12) {
            0 => {
                own.rows = large;
                format!("{large} rows announced")
            }
            1 => {
                own.of_group = large;
                format!("{large} rows announced in the group")
            }
            2 => {
                (own.rows, own.of_group, own.values) = (large, large, large);
                format!("{large} rows announced everywhere")
            }
            3 => {
                own.groups = [0, 2, 1000, 20_000][random.index(4)];
                own.rows = own.of_group.saturating_mul(own.groups as i64);
                format!("{} groups of rows", own.groups)
            }
            4 => {
                own.children = large;
                format!("{large} columns announced")
            }
            5 => {
                own.depth = [1, 40, 10_000, 300_000][random.index(4)];
                format!("{} groups of columns within each other", own.depth)
            }
            6 => {
                own.held = large;
                format!("{large} bytes unpacked announced")
            }
            7 => {
                own.stored = large;
                format!("{large} bytes announced")
            }
            8 => {
                own.values = large;
                format!("{large} values announced in the page")
            }
            9 => {
                own.dictionary = Some(large);
                format!("{large} values announced in the dictionary")
            }
            10 => {
                own.encoding = [0, 2, 3, 4, 5, 6, 7, 8, 9, 99][random.index(10)];
                format!("encoding {}", own.encoding)
            }
            _ => {
                own.codec = random.index(10) as i64;
                format!("compression {}", own.codec)
            }
        });
    }
    own.file()
}
