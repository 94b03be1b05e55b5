//! Hostile inputs of every kind that the command line reads, reproducible from seed and number.
//! The inputs are shipped files with damaged text or bytes, and inputs that nobody writes by hand.

mod spoil;

use super::damage::{NUMBERS, SHIPPED, damaged};
use super::sketch::RandomSource;
use spoil::{announced, lengths, spoil, wide};

/// The kinds of untrusted input, one for each input channel of the program.
pub const DOORS: [&str; 12] = [
    "scenario",
    "formula",
    "table",
    "mapping",
    "recording",
    "catalogue",
    "kept figures",
    "peer",
    "standard input",
    "Parquet",
    "synthesis",
    "older output",
];

/// Valid inputs to be damaged, created once by the program itself.
pub struct Good {
    pub recording: Vec<u8>,
    pub accepted: Vec<u8>,
    pub stress: Vec<u8>,
    pub table: Vec<u8>,
    pub positions: Vec<u8>,
    /// For each command that chooses the names of its output files: the command and these files.
    pub older: Vec<(&'static str, Files)>,
}

/// Files by name, with their bytes.
pub type Files = Vec<(String, Vec<u8>)>;

/// Commands that choose file names, and therefore inspect existing files.
pub const OLDER: [&str; 9] = [
    "export pendulum.toml",
    "export pendulum.toml --json",
    "run pendulum.toml --route differences --record r --output h/",
    "draw pendulum.toml",
    "view r/pendulum.mcap --with foxglove",
    "stress turns --quick --output s --output p/page.md",
    "bench five_bar.toml --output b --output p/page.md --quick --engine rapier --only positions --budget 1e4",
    "golden double_pendulum --output g",
    "man --output m",
];

/// A command with its inputs.
pub struct Attack {
    pub door: usize,
    /// Description of the damage.
    pub what: Vec<String>,
    pub files: Vec<(String, Vec<u8>)>,
    pub arguments: Vec<String>,
    pub standard_input: Vec<u8>,
    /// Files that the command may replace, because the program made these files or the arguments name them.
    pub may: Vec<String>,
}

const CRANK_ROCKER: &str = include_str!("../../../scenarios/crank_rocker.toml");
const PENDULUM: &str = include_str!("../../../scenarios/pendulum.toml");
const GOOD: &str = include_str!("../bad_scenarios/good.toml");
const FIVE_BAR: &str = include_str!("../../../scenarios/five_bar.toml");
const TASK: &str = include_str!("../../../scenarios/ov7_drives/sinker_task.toml");
const MACHINE: &str = "format = 1\nname = \"m\"\ntitle = \"A machine\"\n[[organs]]\nname = \"sinkers\"\n\
    task = \"task.toml\"\nmechanism = \"sinker.toml\"\noffset_deg = 30\n\
    [[moments]]\nname = \"pressing\"\nduring = { sinkers = [5, 6] }\n";
const DRAWING: &str = include_str!("../../../scenarios/ov7_drives/rockers_drawing.toml");
const SINKER: &str = include_str!("../../../scenarios/ov7_drives/sinker.toml");
const PARQUETS: [&[u8]; 3] = [
    include_bytes!("../compare/pandas.parquet"),
    include_bytes!("../compare/polars_f32.parquet"),
    include_bytes!("../compare/gzip.parquet"),
];
const CATALOGUE: &str = include_str!("../../../catalogues/motors.toml");
const MAPPING: &str = "[channels]\n\"point.B.x_mm\" = \"point.B.x_m*1000\"\n\n[tolerance]\nall = { rel = 0.01 }\n\
     \"point.B.y_m\" = { abs = 0.1 }\n";

/// The attack with the number `index`, drawn from the random numbers of `seed`.
pub fn attack(seed: u64, index: u64, good: &Good) -> Attack {
    let door = index as usize % DOORS.len();
    let random = &mut RandomSource::of_sample(seed, index);
    let mut what = Vec::new();
    let (mut files, mut standard_input, mut may) = (Vec::new(), Vec::new(), Vec::new());
    // The commands alternate, so that each kind of input meets each command.
    let turn = index as usize / DOORS.len() + door;
    let line = match door {
        0 | 8 => {
            let mut text = scenario(random, seed, index, &mut what);
            if random.index(3) > 0 {
                spoil(random, &mut text, &mut what);
            }
            let command = COMMANDS[turn % COMMANDS.len()];
            match door {
                0 => files.push(("bad.toml".into(), text)),
                _ => standard_input = text,
            }
            files.push(("good.toml".into(), CRANK_ROCKER.into()));
            files.push(("task.toml".into(), TASK.into()));
            files.push(("rockers_drawing.toml".into(), DRAWING.into()));
            may = vec!["recordings/pendulum.mcap".into(), "bad.accepted".into()];
            if command.contains("--write") {
                may.push("bad.toml".into());
            }
            command.replace("FILE", if door == 0 { "bad.toml" } else { "-" })
        }
        1 => {
            let expression = expression(random, &mut what);
            match random.index(3) {
                // Arguments are limited to 128 kB, and contain no zero byte.
                0 if expression.len() < 100_000 && !expression.contains('\0') => {
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
            may = vec!["recordings/pendulum.mcap".into()];
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
            may = vec!["s/turns.json".into(), "pendulum.accepted".into()];
            match (is_stress, random.yes()) {
                (true, _) => "stress turns --quick --out s",
                (false, true) => "accept pendulum.toml --check --route differences",
                (false, false) => "accept pendulum.toml --route differences",
            }
            .into()
        }
        9 => {
            let is_shipped = random.yes();
            let mut bytes =
                if is_shipped { PARQUETS[random.index(PARQUETS.len())].to_vec() } else { announced(random, &mut what) };
            match (is_shipped, random.index(3)) {
                // Changes one bit of a byte that probably belongs to a number.
                (true, 0) => {
                    let at = 4 + random.index(bytes.len() / 3);
                    bytes[at] ^= 1 << random.index(8);
                    what.push(format!("a bit of byte {at}"));
                }
                (false, 0 | 1) => {}
                _ => spoil(random, &mut bytes, &mut what),
            }
            files.push(("table.parquet".into(), bytes));
            let oracle =
                "file = \"table.parquet\"\ncrank = \"a\"\n[oracle.columns]\na = { channel = \"point.B.x_m\" }\n";
            files.push((
                "good.toml".into(),
                format!("{CRANK_ROCKER}\n[[oracle]]\nsource = \"a table\"\n{oracle}").into(),
            ));
            files.push(("plain.toml".into(), CRANK_ROCKER.into()));
            [
                "compare plain.toml table.parquet",
                "compare table.parquet table.parquet",
                "compare plain.toml table.parquet --map a=point.B.x_m",
                "run good.toml --no-record -q",
            ][random.index(if is_shipped { 2 } else { 4 })]
            .into()
        }
        10 => {
            let (mut task, mut drawing) = (TASK.as_bytes().to_vec(), DRAWING.as_bytes().to_vec());
            let one = if random.index(3) > 0 { &mut task } else { &mut drawing };
            spoil(random, one, &mut what);
            files.push(("task.toml".into(), task));
            files.push(("rockers_drawing.toml".into(), drawing));
            files.push(("sinker.toml".into(), SINKER.into()));
            let mut machine = MACHINE.as_bytes().to_vec();
            if random.index(2) > 0 {
                spoil(random, &mut machine, &mut what);
            }
            files.push(("machine.toml".into(), machine));
            [
                "synthesize search task.toml --candidates 500 --refined 1 --evaluations 50 -o out.toml --svg out.svg",
                "synthesize search task.toml --candidates 300 --refined 1 --evaluations 5 --refinement gradients",
                "synthesize front task.toml --limit transmission_deg=5:20:2 --candidates 300 --refined 1 --evaluations 5",
                "synthesize check task.toml sinker.toml",
                "run rockers_drawing.toml --no-record -q",
                "synthesize cyclogram machine.toml",
            ][random.index(6)]
            .into()
        }
        11 => {
            let (command, older) = &good.older[turn % good.older.len()];
            files.push(("pendulum.toml".into(), PENDULUM.into()));
            files.push(("five_bar.toml".into(), FIVE_BAR.into()));
            files.push(("r/pendulum.mcap".into(), good.recording.clone()));
            may.push("p/page.md".into());
            let one = random.index(older.len());
            for (index, (name, bytes)) in older.iter().enumerate() {
                let mut bytes = bytes.clone();
                if index == one {
                    spoil(random, &mut bytes, &mut what);
                    what.push(name.clone());
                }
                // For the file names listed below, the program knows only whether it wrote a file, not whether the file
                // has changed since.
                // A changed file of this kind may therefore be replaced.
                let is_any = ["mcap", "s/turns.json", "s/turns.csv"].iter().any(|own| name.ends_with(own));
                // Changed line endings do not count as damage, because tools change them.
                let plain = |bytes: &[u8]| bytes.iter().copied().filter(|&byte| byte != b'\r').collect::<Vec<u8>>();
                if is_any || plain(&bytes) == plain(&older[index].1) {
                    may.push(name.clone());
                }
                files.retain(|(own, _)| own != name);
                files.push((name.clone(), bytes));
            }
            (*command).into()
        }
        _ => {
            files.push(("five_bar.toml".into(), FIVE_BAR.into()));
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

/// Commands on a scenario; usual commands occur more often in the list.
const COMMANDS: [&str; 45] = [
    "sensitivity FILE --figure maxabs:drive.torque_N_m",
    "merge FILE",
    "sweep FILE --vary links.crank.mass_kg=1:2:5 --figure max:drive.torque_N_m --figure reach_to",
    "graph FILE -o out.csv",
    "exercise FILE -o class",
    "mark FILE",
    "run FILE --no-record -q",
    "run FILE",
    "run FILE --no-record --verbose --json out.json --html out.html",
    "check FILE",
    "run FILE --no-record --explain",
    "inspect FILE --modes",
    "inspect FILE --range",
    "inspect FILE --driver all",
    "solve FILE --with assur",
    "draw FILE -o out.svg --loads --dimensions",
    "export FILE --mjcf -",
    "solve FILE --with newton",
    "run FILE --no-record -q --budget 1e4",
    "plan FILE",
    "bearings FILE",
    "drive FILE",
    "run FILE --no-record -q --engine all --budget 1e4",
    "clearance FILE",
    "draw FILE -o out.svg --each-mode",
    "export FILE --json -",
    "export FILE -o -.sdf",
    "export FILE -o -.urdf --mimic 3",
    "export FILE -o -.usda --no-loads",
    "tune FILE --within 0.01 --engine rapier --channel positions --budget 1e4",
    "import FILE -o -",
    "accept FILE --budget 1e4",
    "mutate FILE --kind load --no-sizes --budget 1e4",
    "compare good.toml FILE",
    "compare FILE good.toml --by crank",
    "solve FILE --with rapier --dt 0.001",
    "diagram FILE --channel link.crank.angle_rad",
    "draw FILE -o out.png --trace B",
    "list --channels FILE",
    "list .",
    "synthesize check task.toml FILE",
    "bench FILE --out bench --quick --engine rapier --only positions --budget 1e4",
    "run FILE good.toml --no-record --write --budget 1e4 --record r",
    "drive FILE --run-up out.csv --points 100",
    "draw FILE -o out.gif --frames 4 --width 200",
];

/// A scenario with damaged text, or with more parts than anybody writes by hand.
fn scenario(random: &mut RandomSource, seed: u64, index: u64, what: &mut Vec<String>) -> Vec<u8> {
    if random.index(4) > 0 {
        let bad = damaged(seed, index);
        what.extend(bad.what);
        return bad.text.into_bytes();
    }
    let count = [100, 1000, 10_000][random.index(3)];
    let (name, part): (&str, &dyn Fn(usize) -> String) = match random.index(11) {
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
        7 => ("traces", &|k| match k {
            0 => "[draw]\ntraces = [\"B\"".into(),
            _ => ", \"B\"".into(),
        }),
        8 => ("sliders", &|k| {
            format!(
                "[links.s{k}.points]\nS = {{ x_mm = 0, y_mm = 0 }}\n[[joints]]\nname = \"S{k}\"\ntype = \"prismatic\"\nlinks = [\"ground\", \"s{k}\"]\n"
            )
        }),
        9 => ("tables", &|k| format!("[a.b.c.d{k}]\nx = {k}\n")),
        _ => ("one key", &|_| "title = \"again\"\n".into()),
    };
    what.push(format!("{count} {name}"));
    let mut text = GOOD.split("[[oracle]]").next().unwrap().to_string();
    if name == "instants" {
        text = text.replace("[grid]", "[unused]");
    }
    text.push('\n');
    (0..count).for_each(|k| text.push_str(&part(k)));
    if name == "instants" || name == "traces" {
        text.push(']');
    }
    text.into_bytes()
}

/// A formula: nested parentheses, a chain of operators, a number, or random text.
fn expression(random: &mut RandomSource, what: &mut Vec<String>) -> String {
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

/// A peer program: its messages, its output, and how it ends.
fn peer(random: &mut RandomSource, good: &Good, what: &mut Vec<String>) -> Vec<(String, Vec<u8>)> {
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
