//! Recordings are read back bit for bit.
//! Equal runs give equal recordings, and a recording replaces an older one only if both are of the same run.

mod picture;
mod sliders;

use linkage::ErrorKind;
use linkage::math::{Motion, Vec2, cross, turned, unit};
use linkage::mechanism::{Joint, JointKind, JointSide as On, Link, LinkId, Mechanism, Point};
use linkage::trajectory::{CHANNELS, Channel, ChannelSubject, Stage, Trajectory};
use recording::{Level, LogEntry, RecordedSide, Recording, Show, load, write};
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::fs;
use std::path::{Path, PathBuf};

/// Speed of the crank (rad/s): one revolution in about 65 ms.
const OMEGA: f64 = 96.0;

fn link(name: &str, points: &[(&str, f64, f64)], mass_centre: Vec2) -> Link {
    let points = points.iter().map(|&(name, x, y)| Point { name: name.into(), local: Vec2::new(x, y) }).collect();
    Link { name: name.into(), points, mass: 1.0, mass_centre, inertia: 0.01 }
}

/// Four-bar OA = 0.1, AB = 0.4, CB = 0.3, OC = 0.4 m; the coupler carries a point P off its line.
fn four_bar() -> Mechanism {
    let links = vec![
        link("ground", &[("O", 0.0, 0.0), ("C", 0.4, 0.0)], Vec2::zeros()),
        link("crank", &[("O", 0.0, 0.0), ("A", 0.1, 0.0)], Vec2::new(0.02, 0.0)),
        link("coupler", &[("A", 0.0, 0.0), ("B", 0.4, 0.0), ("P", 0.15, 0.12)], Vec2::new(0.18, 0.04)),
        link("rocker", &[("C", 0.0, 0.0), ("B", 0.3, 0.0)], Vec2::new(0.15, 0.0)),
    ];
    let pins = [("O", 0, 1), ("A", 1, 2), ("B", 2, 3), ("C", 0, 3)];
    let side = |name: &str, link: LinkId| {
        let local = links[link].points.iter().find(|point| point.name == name).unwrap().local;
        On { link, local }
    };
    let joints = pins.map(|(name, first, second)| Joint {
        name: name.into(),
        kind: JointKind::Revolute,
        first: side(name, LinkId(first)),
        second: side(name, LinkId(second)),
        drawn: None,
    });
    Mechanism::new(links, joints.to_vec()).unwrap()
}

/// Angles of crank, coupler and rocker by intersecting two circles.
fn angles(crank: f64) -> [f64; 3] {
    let (a, c) = (unit(crank) * 0.1, Vec2::new(0.4, 0.0));
    let base = c - a;
    let d = base.norm();
    let along = (d * d + 0.4 * 0.4 - 0.3 * 0.3) / (2.0 * d);
    let b = a + base * (along / d) + turned(base) * ((0.4 * 0.4 - along * along).sqrt() / d);
    [crank, (b - a).y.atan2((b - a).x), (b - c).y.atan2((b - c).x)]
}

/// Motions of crank, coupler and rocker at a time: velocities and accelerations by central differences.
fn motions(time: f64) -> [Motion; 3] {
    let h = 1e-5;
    let [back, here, ahead] = [-h, 0.0, h].map(|dt| angles(OMEGA * (time + dt)));
    let mut motions: [Motion; 3] = [0, 1, 2].map(|k| Motion {
        direction: unit(here[k]),
        omega: (ahead[k] - back[k]) / (2.0 * h),
        alpha: (ahead[k] - 2.0 * here[k] + back[k]) / (h * h),
        ..Motion::REST
    });
    let a = Vec2::new(0.1, 0.0);
    motions[1] = Motion {
        origin: motions[0].point(a),
        velocity: motions[0].point_velocity(a),
        acceleration: motions[0].point_acceleration(a),
        ..motions[1]
    };
    motions[2].origin = Vec2::new(0.4, 0.0);
    motions
}

/// Reactions at O, A, B and C and the torque on the crank, from the balances of the links.
fn reactions(mechanism: &Mechanism, motions: &[Motion; 3]) -> ([Vec2; 4], f64) {
    let inertia = |k: usize| {
        let link = &mechanism.links()[LinkId(k + 1)];
        let force = motions[k].point_acceleration(link.mass_centre) * link.mass;
        let arm = motions[k].arm(link.mass_centre);
        (force, link.inertia * motions[k].alpha + cross(arm, force))
    };
    let ((f1, m1), (f2, m2), (f3, m3)) = (inertia(0), inertia(1), inertia(2));
    let (coupler, rocker) = (motions[1].arm(Vec2::new(0.4, 0.0)), motions[2].arm(Vec2::new(0.3, 0.0)));
    // Moments of coupler about A and of rocker about C: two equations for the force B of the coupler on the rocker.
    let d = cross(coupler, rocker);
    let b = (coupler * m3 + rocker * m2) / d;
    let a = f2 + b;
    let o = f1 + a;
    ([o, a, b, f3 - b], m1 + cross(motions[0].arm(Vec2::new(0.1, 0.0)), a))
}

fn value(mechanism: &Mechanism, channel: &Channel, time: f64) -> f64 {
    let motions = motions(time);
    let on = |link: LinkId, local: Vec2| {
        let motion = &motions[link.index() - 1];
        let d = motion.direction;
        let [p, v, a] = [motion.point(local), motion.point_velocity(local), motion.point_acceleration(local)];
        match channel.kind.suffix {
            "angle_rad" => d.y.atan2(d.x),
            "omega_rad_s" => motion.omega,
            "alpha_rad_s2" => motion.alpha,
            "x_m" => p.x,
            "y_m" => p.y,
            "vx_m_s" => v.x,
            "vy_m_s" => v.y,
            "ax_m_s2" => a.x,
            "ay_m_s2" => a.y,
            other => panic!("no value for {other}"),
        }
    };
    match channel.kind.subject {
        ChannelSubject::Link => {
            let link = mechanism.link_named(&channel.of).unwrap();
            on(link, mechanism.links()[link].mass_centre)
        }
        ChannelSubject::Point => {
            let (_, side) = mechanism.moving_points().find(|(name, _)| *name == channel.of).unwrap();
            on(side.link, side.local)
        }
        ChannelSubject::Joint => {
            let force = reactions(mechanism, &motions).0[mechanism.joint_named(&channel.of).unwrap()];
            if channel.kind.suffix == "fx_N" { force.x } else { force.y }
        }
        ChannelSubject::Frame => {
            let ([o, _, _, c], torque) = reactions(mechanism, &motions);
            match channel.kind.suffix {
                "fx_N" => -o.x - c.x,
                "fy_N" => -o.y - c.y,
                _ => -cross(Vec2::new(0.4, 0.0), c) - torque,
            }
        }
        ChannelSubject::Drive => reactions(mechanism, &motions).1,
        ChannelSubject::Slider
        | ChannelSubject::Journal
        | ChannelSubject::Guide
        | ChannelSubject::Transmission
        | ChannelSubject::Motor
        | ChannelSubject::Thrust
        | ChannelSubject::FurtherThrust => {
            panic!("a four-bar on a crank has no {channel}")
        }
    }
}

/// Every channel of the mechanism that `wanted` accepts.
fn channels(mechanism: &Mechanism, wanted: impl Fn(&Channel) -> bool) -> Vec<Channel> {
    let links = mechanism.links()[1..].iter().map(|link| (ChannelSubject::Link, link.name.clone()));
    let points = mechanism.moving_points().map(|(name, _)| (ChannelSubject::Point, name.to_string()));
    let joints = mechanism.joints().iter().map(|joint| (ChannelSubject::Joint, joint.name.clone()));
    let subjects = links
        .chain(points)
        .chain(joints)
        .chain([(ChannelSubject::Frame, String::new()), (ChannelSubject::Drive, String::new())]);
    let rows = subjects.flat_map(|(subject, of)| {
        let kinds = CHANNELS.iter().filter(move |kind| kind.subject == subject);
        kinds.map(move |kind| Channel { of: of.clone(), kind })
    });
    rows.filter(wanted).collect()
}

/// Trajectory over `times`, each value changed by `spoil`.
fn trajectory(times: Vec<f64>, channels: Vec<Channel>, spoil: impl Fn(f64, usize) -> f64) -> Trajectory {
    let mechanism = four_bar();
    let column = |channel: &Channel| {
        let values = times.iter().enumerate();
        values.map(|(row, &time)| spoil(value(&mechanism, channel, time), row)).collect()
    };
    let columns = channels.iter().map(column).collect();
    let cranks = times.iter().map(|time| time * OMEGA).collect();
    Trajectory::new(times, cranks, channels, columns).unwrap()
}

fn turn(samples: usize) -> Vec<f64> {
    (0..samples).map(|k| TAU / OMEGA * k as f64 / (samples - 1) as f64).collect()
}

/// A reference, an engine whose error grows a little with each row, and the difference.
struct Run {
    mechanism: Mechanism,
    metadata: BTreeMap<String, String>,
    log: Vec<LogEntry>,
    show: Show,
    reference: Trajectory,
    engine: Trajectory,
    errors: Trajectory,
}

impl Run {
    fn over(times: Vec<f64>) -> Run {
        let mechanism = four_bar();
        let all = channels(&mechanism, |_| true);
        let reference = trajectory(times.clone(), all.clone(), |value, _| value);
        let engine = trajectory(times, all.clone(), |value, row| value * (1.0 + 1e-8 * row as f64));
        let difference = |channel: &Channel| {
            let [ours, theirs] = [&reference, &engine].map(|side| side.column(channel).unwrap());
            theirs.iter().zip(ours).map(|(theirs, ours)| theirs - ours).collect()
        };
        let columns = all.iter().map(difference).collect();
        let errors = Trajectory::new(reference.times().to_vec(), reference.inputs().to_vec(), all, columns).unwrap();
        let metadata = BTreeMap::from([("rapier".into(), "0.36.1".into()), ("step_s".into(), "1e-5".into())]);
        let log = vec![
            LogEntry { time: 0.0, level: Level::Warning, text: "transmission angle below 30 deg".into() },
            LogEntry { time: 0.05, level: Level::Info, text: "agree".into() },
        ];
        let show = Show { forces: true, ..Show::default() };
        Run { mechanism, metadata, log, show, reference, engine, errors }
    }

    fn write(&self, path: &Path) -> linkage::Result<()> {
        let sides = [
            RecordedSide { name: "reference", trajectory: &self.reference },
            RecordedSide { name: "engine", trajectory: &self.engine },
        ];
        write(&self.recording(&sides), path)
    }

    fn recording<'a>(&'a self, sides: &'a [RecordedSide<'a>]) -> Recording<'a> {
        Recording {
            name: "four_bar",
            scenario_text: "name = \"four_bar\"\n",
            metadata: &self.metadata,
            mechanism: &self.mechanism,
            sides,
            errors: Some(&self.errors),
            log: &self.log,
            show: self.show,
        }
    }
}

/// The single precision numbers of a message, in the order of the wire.
fn floats(data: &[u8]) -> Vec<f32> {
    let fields = data.chunks_exact(5);
    assert!(fields.remainder().is_empty());
    fields
        .map(|field| {
            assert_eq!(field[0] & 7, 5, "a field of four bytes");
            f32::from_le_bytes([field[1], field[2], field[3], field[4]])
        })
        .collect()
}

/// The recorded difference is engine minus reference, with its sign, in micrometres, microradians and millinewtons.
#[test]
fn errors_are_engine_minus_reference_in_small_units() {
    let (_directory, path) = place("errors.mcap");
    let run = Run::over(turn(50));
    run.write(&path).unwrap();
    let bytes = fs::read(&path).unwrap();
    for (topic, subject, of, factor) in [
        ("/error/point/B", ChannelSubject::Point, "B", 1e6),
        ("/error/link/rocker", ChannelSubject::Link, "rocker", 1e6),
        ("/error/joint/A", ChannelSubject::Joint, "A", 1e3),
    ] {
        let columns: Vec<Vec<f64>> = (run.engine.iter().zip(run.reference.iter()))
            .filter(|((channel, _), _)| channel.kind.subject == subject && channel.of == of)
            .map(|((_, engine), (_, reference))| engine.iter().zip(reference).map(|(e, r)| (e - r) * factor).collect())
            .collect();
        let all = mcap::MessageStream::new(&bytes).unwrap().map(Result::unwrap);
        let rows: Vec<Vec<f32>> =
            all.filter(|message| message.channel.topic == topic).map(|message| floats(&message.data)).collect();
        assert_eq!((rows.len(), rows[0].len()), (50, columns.len()), "{topic}");
        for (row, found) in rows.iter().enumerate() {
            let wanted: Vec<f32> = columns.iter().map(|column| column[row] as f32).collect();
            assert_eq!(*found, wanted, "{topic} {row}");
        }
        assert!(rows.iter().flatten().any(|&error| error > 0.0) && rows.iter().flatten().any(|&error| error < 0.0));
    }
}

/// Path of a recording that is deleted after the test, or kept so that viewers can open it.
fn place(name: &str) -> (tempfile::TempDir, PathBuf) {
    let directory = tempfile::tempdir().unwrap();
    let kept = std::env::var_os("LINKPROOF_RECORD_SAMPLE").map(PathBuf::from);
    let path = kept.unwrap_or_else(|| directory.path().to_path_buf()).join(name);
    (directory, path)
}

fn bits(trajectory: &Trajectory) -> Vec<Vec<u64>> {
    let columns = trajectory.iter().map(|(_, column)| column);
    let all = [trajectory.times(), trajectory.inputs()].into_iter().chain(columns);
    all.map(|column| column.iter().map(|value| value.to_bits()).collect()).collect()
}

fn assert_same(read: &Trajectory, written: &Trajectory) {
    assert_eq!(read.channels(), written.channels());
    assert!(bits(read) == bits(written), "values differ in bits");
}

#[test]
fn both_sides_are_read_back_bit_for_bit() {
    let (_directory, path) = place("sample.mcap");
    let run = Run::over(turn(361));
    run.write(&path).unwrap();
    let sides = load(&path).unwrap();
    assert_eq!(sides.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>(), ["reference", "engine"]);
    assert_same(&sides[0].1, &run.reference);
    assert_same(&sides[1].1, &run.engine);
    // The file must be smaller than 1 MB.
    // Two thirds of the file's size are incompressible numbers and the index of 13 thousand messages.
    let size = fs::metadata(&path).unwrap().len();
    assert!(size < 1_000_000, "361 samples of a four-bar take {size} bytes");
}

#[test]
fn rows_in_any_order_with_negative_times_keep_their_order() {
    let (_directory, path) = place("shuffled.mcap");
    let run = Run::over(vec![0.03, -0.01, 0.05, -0.0, 0.02, 1e-12, 0.05, -0.013]);
    run.write(&path).unwrap();
    let sides = load(&path).unwrap();
    assert_same(&sides[0].1, &run.reference);
    assert_same(&sides[1].1, &run.engine);
}

#[test]
fn extreme_values_survive_and_absent_channels_stay_absent() {
    let (_directory, path) = place("few.mcap");
    let mut run = Run::over(turn(5));
    let few = channels(&run.mechanism, |channel| {
        channel.kind.subject != ChannelSubject::Link || channel.kind.suffix == "vy_m_s"
    });
    const VALUES: [f64; 5] = [0.0, -0.0, f64::MAX, f64::MIN_POSITIVE / 8.0, -f64::MAX];
    run.reference = trajectory(turn(5), few, |_, row| VALUES[row]);
    run.write(&path).unwrap();
    let sides = load(&path).unwrap();
    assert_same(&sides[0].1, &run.reference);
    assert!(sides[0].1.column(&Channel::named("link.crank.x_m").unwrap()).is_none());
}

#[test]
fn without_positions_there_is_no_scene() {
    let (_directory, path) = place("velocities.mcap");
    let mut run = Run::over(turn(5));
    let velocities = channels(&run.mechanism, |channel| channel.kind.stage == Stage::Velocities);
    run.reference = trajectory(turn(5), velocities, |value, _| value);
    run.engine = run.reference.clone();
    run.write(&path).unwrap();
    let bytes = fs::read(&path).unwrap();
    let messages = mcap::MessageStream::new(&bytes).unwrap().map(|message| message.unwrap().channel.topic.clone());
    let scene: Vec<String> = messages.filter(|topic| topic.starts_with("/mechanism") || topic == "/tf").collect();
    assert_eq!(scene, [""; 0]);
    assert_same(&load(&path).unwrap()[1].1, &run.engine);
}

#[test]
fn equal_runs_give_equal_bytes() {
    let directory = tempfile::tempdir().unwrap();
    let [one, two] = ["one.mcap", "two.mcap"].map(|name| directory.path().join(name));
    Run::over(turn(50)).write(&one).unwrap();
    Run::over(turn(50)).write(&two).unwrap();
    assert!(fs::read(one).unwrap() == fs::read(two).unwrap());
}

#[test]
fn a_truncated_file_opens_up_to_the_cut_but_is_not_complete() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("cut.mcap");
    Run::over(turn(361)).write(&path).unwrap();
    let bytes = fs::read(&path).unwrap();
    let cut = &bytes[..bytes.len() * 6 / 10];
    let ignore_end = mcap::read::Options::IgnoreEndMagic.into();
    let messages = mcap::MessageStream::new_with_options(cut, ignore_end).unwrap().map_while(Result::ok);
    let grids = messages.filter(|message| message.channel.topic == "/reference/grid").count();
    assert!((100..361).contains(&grids), "{grids} samples before the cut");
    fs::write(&path, cut).unwrap();
    let error = load(&path).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Io);
    assert!(error.to_string().contains("cut off or damaged"), "{error}");
}

#[test]
fn a_file_that_is_no_recording_is_not_called_damaged() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("mine.toml");
    for (bytes, words) in [("", "mine.toml is empty"), ("name = \"mine\"\n", "mine.toml is not a recording")] {
        fs::write(&path, bytes).unwrap();
        let error = load(&path).unwrap_err();
        assert!(error.to_string().contains(words) && error.way_out().is_some(), "{error}");
    }
}

#[test]
fn a_recording_that_cannot_be_written_is_an_error_with_its_path() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("old.mcap");
    // A directory at the path of the file prevents even a superuser from writing the file.
    // File permissions would not prevent a superuser from writing.
    fs::create_dir(&path).unwrap();
    let run = Run::over(turn(5));
    let error = run.write(&path).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Io);
    assert!(error.to_string().contains("old.mcap") && error.way_out().is_some(), "{error}");

    let error = run.write(&directory.path().join("missing/new.mcap")).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Io);
    let error = load(&directory.path().join("missing.mcap")).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Io);
}

#[test]
fn names_that_would_mix_topics_are_refused() {
    let directory = tempfile::tempdir().unwrap();
    let run = Run::over(turn(3));
    for names in [["", "b"], ["a/b", "c"], ["a", "a"], ["error", "b"], ["mechanism", "b"]] {
        let sides = names.map(|name| RecordedSide { name, trajectory: &run.reference });
        let error = write(&run.recording(&sides), &directory.path().join("x.mcap")).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Input, "{names:?}");
    }
}
