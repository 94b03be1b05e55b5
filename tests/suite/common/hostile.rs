//! Hostile inputs to every door of the command line, by seed and number: shipped files damaged as text and as bytes, and
//! what nobody writes by hand.

use super::damage::{NUMBERS, SHIPPED, damaged};
use super::sketch::Random;

/// The doors through which something comes in that nobody vouches for.
pub const DOORS: [&str; 9] =
    ["scenario", "formula", "table", "mapping", "recording", "catalogue", "kept figures", "peer", "standard input"];

/// Good inputs that are damaged, made once by the program itself.
pub struct Good {
    pub recording: Vec<u8>,
    pub accepted: Vec<u8>,
    pub stress: Vec<u8>,
    pub table: Vec<u8>,
    pub positions: Vec<u8>,
}

/// A command with its inputs.
pub struct Attack {
    pub door: usize,
    /// What was done, in words.
    pub what: Vec<String>,
    pub files: Vec<(String, Vec<u8>)>,
    pub arguments: Vec<String>,
    pub standard_input: Vec<u8>,
    /// Files that the command may replace: it made them, or they are named.
    pub may: &'static [&'static str],
}

const CRANK_ROCKER: &str = include_str!("../../../scenarios/crank_rocker.toml");
const PENDULUM: &str = include_str!("../../../scenarios/pendulum.toml");
const GOOD: &str = include_str!("../bad_scenarios/good.toml");
const CATALOGUE: &str = include_str!("../../../catalogues/motors.toml");
const MAPPING: &str = "[channels]\n\"point.B.x_mm\" = \"point.B.x_m*1000\"\n\n[tolerance]\nall = { rel = 0.01 }\n\
     \"point.B.y_m\" = { abs = 0.1 }\n";

/// The attack with this number of a seed.
pub fn attack(seed: u64, index: u64, good: &Good) -> Attack {
    let door = index as usize % DOORS.len();
    let random = &mut Random::of_sample(seed, index);
    let mut what = Vec::new();
    let (mut files, mut standard_input, mut may) = (Vec::new(), Vec::new(), &[][..]);
    let line = match door {
        0 | 8 => {
            let mut text = scenario(random, seed, index, &mut what);
            if random.index(3) > 0 {
                spoil(random, &mut text, &mut what);
            }
            let command = COMMANDS[random.index(COMMANDS.len())];
            match door {
                0 => files.push(("bad.toml".into(), text)),
                _ => standard_input = text,
            }
            may = &["recordings/pendulum.mcap"];
            command.replace("FILE", if door == 0 { "bad.toml" } else { "-" })
        }
        1 => {
            let expression = expression(random, &mut what);
            match random.index(3) {
                // Arguments have less than 128 kB.
                0 if expression.len() < 100_000 => {
                    files.push(("good.toml".into(), CRANK_ROCKER.into()));
                    let words = ["check", "good.toml", &expression, "--channel=link.rocker.angle_rad", "-q"];
                    return Attack {
                        door,
                        what,
                        files,
                        arguments: words.map(String::from).to_vec(),
                        standard_input,
                        may,
                    };
                }
                1 => {
                    let text = CRANK_ROCKER.split("[[oracle]]").next().unwrap();
                    let claim = format!(
                        "\n[[formula]]\nname = \"own\"\nexpression = {expression:?}\nchannel = \"link.rocker.angle_rad\"\n"
                    );
                    files.push(("bad.toml".into(), format!("{text}{claim}").into()));
                }
                _ => {
                    let all: Vec<_> = SHIPPED.iter().filter(|(_, text)| text.contains("[[formula]]")).collect();
                    let (path, text) = all[random.index(all.len())];
                    what.push(path.file_name().unwrap().to_string_lossy().into_owned());
                    let mut text = text.clone().into_bytes();
                    let from = text.windows(11).position(|part| part == b"[[formula]]").unwrap();
                    let mut own = text.split_off(from);
                    spoil(random, &mut own, &mut what);
                    text.extend(own);
                    files.push(("bad.toml".into(), text));
                }
            }
            ["run bad.toml --no-record -q", "check bad.toml"][random.index(2)].into()
        }
        2 => {
            let mut table = good.table.clone();
            spoil(random, &mut table, &mut what);
            if random.index(4) == 0 {
                let columns = [10, 1000, 30_000][random.index(3)];
                what.push(format!("{columns} columns"));
                table = wide(&table, columns);
            }
            files.push(("table.csv".into(), table));
            let oracle = "file = \"table.csv\"\ncrank = \"crank_rad\"\n[oracle.columns]\n\"point.B.x_m\" = { channel = \"point.B.x_m\" }\n";
            let text = CRANK_ROCKER.split("[[oracle]]").next().unwrap();
            files.push(("good.toml".into(), format!("{text}\n[[oracle]]\nsource = \"a table\"\n{oracle}").into()));
            files.push(("plain.toml".into(), text.into()));
            [
                "run good.toml --no-record -q",
                "compare plain.toml table.csv --rel 0.05",
                "compare table.csv table.csv --interpolate --rel 0.1",
            ][random.index(3)]
            .into()
        }
        3 => {
            let mut mapping = MAPPING.as_bytes().to_vec();
            spoil(random, &mut mapping, &mut what);
            files.push(("map.toml".into(), mapping));
            files.push(("table.csv".into(), good.table.clone()));
            files.push(("plain.toml".into(), CRANK_ROCKER.into()));
            [
                "compare plain.toml table.csv --map map.toml",
                "compare table.csv table.csv --map map.toml --map-a map.toml",
            ][random.index(2)]
            .into()
        }
        4 => {
            let mut bytes = good.recording.clone();
            match random.index(3) {
                0 => spoil(random, &mut bytes, &mut what),
                1 => lengths(random, &mut bytes, &mut what),
                _ => {
                    lengths(random, &mut bytes, &mut what);
                    spoil(random, &mut bytes, &mut what);
                }
            }
            files.push(("recordings/pendulum.mcap".into(), bytes));
            files.push(("good.mcap".into(), good.recording.clone()));
            files.push(("pendulum.toml".into(), PENDULUM.into()));
            may = &["recordings/pendulum.mcap"];
            [
                "view recordings/pendulum.mcap --with foxglove -o out.json",
                "view recordings/pendulum.mcap --with plotjuggler -o out.xml",
                "view recordings/pendulum.mcap --python false",
                "compare good.mcap recordings/pendulum.mcap",
                "run pendulum.toml -q",
            ][random.index(5)]
            .into()
        }
        5 => {
            let mut text = CATALOGUE.as_bytes().to_vec();
            spoil(random, &mut text, &mut what);
            files.push(("motors.toml".into(), text));
            files.push(("good.toml".into(), CRANK_ROCKER.into()));
            "drive good.toml --catalogue motors.toml".into()
        }
        6 => {
            let is_stress = random.yes();
            let mut text = if is_stress { good.stress.clone() } else { good.accepted.clone() };
            spoil(random, &mut text, &mut what);
            files.push((if is_stress { "s/turns.json" } else { "pendulum.accepted" }.into(), text));
            files.push(("pendulum.toml".into(), PENDULUM.into()));
            may = &["s/turns.json", "pendulum.accepted"];
            match (is_stress, random.yes()) {
                (true, _) => "stress turns --quick --out s",
                (false, true) => "accept pendulum.toml --check --route differences",
                (false, false) => "accept pendulum.toml --route differences",
            }
            .into()
        }
        _ => {
            files.push(("five_bar.toml".into(), include_bytes!("../../../scenarios/five_bar.toml").to_vec()));
            files.extend(peer(random, good, &mut what));
            let command = "bench five_bar.toml --out bench --page page.md --quick --engine rapier --only positions";
            format!("{command} --budget 1e4 --peer-limit 3 --peer")
        }
    };
    let mut arguments: Vec<String> = line.split(' ').map(String::from).collect();
    if door == 7 {
        arguments.push("own=sh ./peer.sh".into());
    }
    Attack { door, what, files, arguments, standard_input, may }
}

/// What is done with a scenario; most often what most people do.
const COMMANDS: [&str; 18] = [
    "run FILE --no-record -q",
    "run FILE --no-record -q",
    "run FILE",
    "run FILE --no-record --verbose --json out.json --html out.html",
    "run FILE --no-record --explain",
    "check FILE",
    "inspect FILE --modes",
    "inspect FILE --range",
    "solve FILE --with assur",
    "solve FILE --with newton",
    "draw FILE -o out.svg --loads --dimensions",
    "draw FILE -o out.svg --each-mode",
    "export FILE --mjcf -",
    "export FILE --json -",
    "plan FILE",
    "bearings FILE",
    "drive FILE",
    "clearance FILE",
];

/// A scenario, damaged as text, or with a number of parts that nobody writes by hand.
fn scenario(random: &mut Random, seed: u64, index: u64, what: &mut Vec<String>) -> Vec<u8> {
    if random.index(4) > 0 {
        let bad = damaged(seed, index);
        what.extend(bad.what);
        return bad.text.into_bytes();
    }
    let count = [100, 1000, 10_000][random.index(3)];
    let (name, part): (&str, &dyn Fn(usize) -> String) = match random.index(9) {
        0 => ("links", &|k| format!("[links.l{k}.points]\nA = {{ x_mm = {k}, y_mm = 0 }}\n")),
        1 => ("points", &|k| format!("[links.coupler.points.P{k}]\nx_mm = {k}\ny_mm = 1\n")),
        2 => ("joints", &|k| {
            format!("[[joints]]\nname = \"J{k}\"\ntype = \"revolute\"\nlinks = [\"crank\", \"rocker\"]\n")
        }),
        3 => ("loads", &|k| {
            format!("[[loads]]\ntype = \"force\"\nlink = \"rocker\"\npoint = \"B\"\nx_N = {k}\ny_N = 1\n")
        }),
        4 => ("parameters", &|k| match k {
            0 => "[parameters]\nk0_mm = 1\n".into(),
            _ => format!("k{k}_mm = \"k{} + 1e-9\"\n", k - 1),
        }),
        5 => ("oracles", &|k| {
            format!(
                "[[oracle]]\nsource = \"s\"\ncrank_deg = {}\nvalues = [{{ channel = \"link.rocker.angle_deg\", value = {k}, digits = 3 }}]\n",
                k % 360
            )
        }),
        6 => ("instants", &|k| match k {
            0 => "[grid]\ntimes_s = [0".into(),
            _ => format!(", {}e-5", k),
        }),
        7 => ("tables", &|k| format!("[a.b.c.d{k}]\nx = {k}\n")),
        _ => ("one key", &|_| "title = \"again\"\n".into()),
    };
    what.push(format!("{count} {name}"));
    let mut text = GOOD.split("[[oracle]]").next().unwrap().to_string();
    if name == "instants" {
        text = text.replace("[grid]", "[unused]");
    }
    text.push('\n');
    (0..count).for_each(|k| text.push_str(&part(k)));
    if name == "instants" {
        text.push(']');
    }
    text.into_bytes()
}

/// A formula: a nest, a chain, a number, or anything.
fn expression(random: &mut Random, what: &mut Vec<String>) -> String {
    let deep = [3, 10, 100, 1000, 20_000, 200_000][random.index(6)];
    let inner = ["phi", "t", "k1", "1e308", "0", "1/0", "ln(-1)", "x", "", "pi*phi^2"][random.index(10)];
    let kind = random.index(12);
    what.push(format!("formula {kind} with {deep} times `{inner}`"));
    match kind {
        0 => format!("{}{inner}{}", "(".repeat(deep), ")".repeat(deep)),
        1 => format!("{}{inner}{}", "sin(".repeat(deep), ")".repeat(deep)),
        2 => format!("{}{inner}", "-".repeat(deep)),
        3 => vec![inner; deep].join("^"),
        4 => vec![inner; deep].join(" + "),
        5 => vec![inner; deep].join("*"),
        6 => "9".repeat(deep),
        7 => format!("{}(", "atan2(phi, ".repeat(deep)),
        8 => format!(
            "phi {}",
            ["\u{0}", "\u{202e}", "\u{1b}[2J", "é", "$(x)", "`", "\\", "\"\n"][random.index(8)].repeat(deep)
        ),
        9 => format!("{inner}^{}", NUMBERS[random.index(NUMBERS.len())]),
        10 => format!("0.{}1*phi", "0".repeat(deep)),
        _ => {
            let parts =
                ["phi", "(", ")", "+", "-", "*", "/", "^", "sin", "sqrt(", "atan2(", ",", "1e9", "0", " ", "abs("];
            (0..deep.min(1000)).map(|_| parts[random.index(parts.len())]).collect()
        }
    }
}

/// A table with each of its columns many times.
fn wide(table: &[u8], columns: usize) -> Vec<u8> {
    let lines = table.split(|&byte| byte == b'\n').take(4_000_000 / columns.max(1) / 8 + 2);
    let times = columns / 4 + 1;
    lines.flat_map(|line| [vec![line; times].join(&b','), vec![b'\n']].concat()).collect()
}

/// A peer: what it says, what it writes, and how it ends.
fn peer(random: &mut Random, good: &Good, what: &mut Vec<String>) -> Vec<(String, Vec<u8>)> {
    let mut ways = br#"[{"name": "as it is", "resolution": "none", "dt": 0.001}]"#.to_vec();
    let mut answer =
        br#"{"version": "MuJoCo 4.0", "seconds": [0.0102, 0.0101], "work": {"steps": 4000, "sweeps": 16361}}"#.to_vec();
    let mut table = good.positions.clone();
    match random.index(6) {
        0 => spoil(random, &mut ways, what),
        1 | 2 => spoil(random, &mut answer, what),
        3 | 4 => spoil(random, &mut table, what),
        _ => {}
    }
    let ends = [
        "",
        "rm -f \"$csv\"; mkfifo \"$csv\"",
        "ln -sf /dev/zero \"$csv\"",
        "ln -sf \"$here/precious\" \"$csv\"",
        "rm -f \"$csv\"; mkdir \"$csv\"",
        "yes",
        "sleep 20 & yes >&2 &",
        "printf '\\033[2J' >&2; exit 7",
        "kill -9 $$",
        "cd $(dirname \"$csv\"); rm -f stdout request.json; ln -s /dev/zero stdout",
    ];
    let end = if what.is_empty() { ends[random.index(ends.len())] } else { "" };
    what.push(end.into());
    let csv = r#"csv=$(sed -n 's/.*"csv":"\([^"]*\)".*/\1/p' "$2")"#;
    let script = format!(
        "here=$PWD\nif [ \"$1\" = ways ]; then cat ways; exit; fi\n{csv}\ncat table > \"$csv\"\ncat answer\n{end}\n"
    );
    vec![("peer.sh".into(), script.into()), ("ways".into(), ways), ("answer".into(), answer), ("table".into(), table)]
}

/// Lengths and sizes in a recording that are not what is there.
fn lengths(random: &mut Random, bytes: &mut [u8], what: &mut Vec<String>) {
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

/// Does something to bytes that whoever wrote them would not.
fn spoil(random: &mut Random, bytes: &mut Vec<u8>, what: &mut Vec<String>) {
    /// Most bytes of an input: more are refused at every door.
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

/// A slip of whoever writes by hand: one other digit, a line twice, one line less, or two of them exchanged.
fn slip(random: &mut Random, bytes: &mut Vec<u8>, what: &mut Vec<String>) {
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

/// Puts something in the place of a number.
fn number(random: &mut Random, bytes: &mut Vec<u8>, new: &[u8]) {
    let starts = |at: &usize| bytes[*at].is_ascii_digit() && (*at == 0 || !bytes[at - 1].is_ascii_alphanumeric());
    let all: Vec<usize> = (0..bytes.len()).filter(starts).collect();
    if all.is_empty() {
        return;
    }
    let start = all[random.index(all.len())];
    let length = bytes[start..].iter().take_while(|byte| byte.is_ascii_alphanumeric() || **byte == b'.').count();
    bytes.splice(start..start + length, new.iter().copied());
}
