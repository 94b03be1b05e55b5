//! Cost of a proof and its recording together, divided by the cost of the proof alone.
//! For a long recording, a second ratio is measured: the cost of writing the same messages, already prepared, with the
//! plain MCAP writer, divided by the cost of writing the recording.
//! Only the ratios are printed; both costs of a ratio are measured in the same run.
//! `cargo bench --bench record`.

#[path = "shared/timing.rs"]
mod timing;

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::BufWriter;
use std::path::Path;
use std::sync::Arc;

use linkage::case::{Case, Grid};
use linkage::trajectory::Trajectory;
use linkproof::{Options, prove};
use mcap::records::MessageHeader;
use mcap::{Channel, MessageStream, WriteOptions};
use recording::{RecordedSide, Recording, Show, write};
use scenario::Scenario;

use timing::shortest;

/// Number of timings; the shortest counts.
const REPEATS: usize = 9;
/// Samples per second of mechanism time.
const RATE: f64 = 1000.0;
/// Samples per revolution in the long recording.
const LONG: usize = 20_000;

fn scenario(name: &str) -> Scenario {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios").join(format!("{name}.toml"));
    Scenario::load(&path).unwrap_or_else(|error| panic!("{error}"))
}

/// One turn of a crank at constant speed.
fn turn(case: &Case, instants: usize) -> Case {
    let crank = case.crank();
    let angle = |k: usize| crank.start + std::f64::consts::TAU * crank.sense() * k as f64 / (instants - 1) as f64;
    case.on(Grid::of_inputs(crank, (0..instants).map(angle).collect())).unwrap()
}

/// Records reference and engine as the command `run` does.
fn record(scenario: &Scenario, sides: &[RecordedSide], errors: Option<&Trajectory>, path: &Path) {
    let recording = Recording {
        name: &scenario.name,
        scenario_text: &scenario.text,
        metadata: &BTreeMap::new(),
        mechanism: &scenario.case.mechanism,
        sides,
        errors,
        log: &[],
        show: Show { slow: 1.0, hz: None, forces: false },
    };
    write(&recording, path).unwrap_or_else(|error| panic!("{error}"));
}

/// A message as stored in a file.
struct Ready<'a> {
    channel: Arc<Channel<'a>>,
    header: MessageHeader,
    data: Vec<u8>,
}

fn messages(bytes: &[u8]) -> Vec<Ready<'_>> {
    let mut all = Vec::new();
    for message in MessageStream::new(bytes).unwrap() {
        let message = message.unwrap();
        let (log_time, publish_time, sequence) = (message.log_time, message.publish_time, message.sequence);
        let header = MessageHeader { channel_id: 0, sequence, log_time, publish_time };
        all.push(Ready { channel: message.channel, header, data: message.data.into_owned() });
    }
    all
}

/// Writes the prepared messages with the MCAP library's writer at its default settings.
fn plain(messages: &[Ready<'_>], path: &Path) {
    let mut writer = WriteOptions::new().create(BufWriter::new(File::create(path).unwrap())).unwrap();
    let mut topics: BTreeMap<&str, u16> = BTreeMap::new();
    for Ready { channel, header, data } in messages {
        let id = *topics.entry(&channel.topic).or_insert_with(|| writer.add_channel_from(channel));
        writer.write_to_known_channel(&MessageHeader { channel_id: id, ..*header }, data).unwrap();
    }
    writer.finish().unwrap();
}

/// Adds a channel read from another file.
trait FromChannel {
    fn add_channel_from(&mut self, channel: &Channel) -> u16;
}

impl<W: std::io::Write + std::io::Seek> FromChannel for mcap::Writer<W> {
    fn add_channel_from(&mut self, channel: &Channel) -> u16 {
        let schema = channel
            .schema
            .as_ref()
            .map_or(0, |schema| self.add_schema(&schema.name, &schema.encoding, &schema.data).unwrap());
        self.add_channel(schema, &channel.topic, &channel.message_encoding, &channel.metadata).unwrap()
    }
}

fn main() {
    let place = tempfile::tempdir().unwrap();
    let [ours, theirs] = ["ours.mcap", "theirs.mcap"].map(|name| place.path().join(name));
    println!("{:14} {:>26} {:>32}", "", "proof and recording", "plain writer / ours");
    println!("{:14} {:>26} {:>32}", "", "over the proof, 1 kHz", format!("{LONG} instants, two sides"));
    for name in ["crank_rocker", "ov7_base", "fourth_class"] {
        let mut own = scenario(name);
        let instants = (RATE * std::f64::consts::TAU / own.case.crank().constant_speed().unwrap().abs()).ceil();
        let long = turn(&own.case, LONG);
        own.case = turn(&own.case, instants as usize + 1);
        let proof = prove(&own, &Options::default()).unwrap();
        let proving = shortest(REPEATS, || drop(prove(&own, &Options::default()).unwrap()));
        let engine = proof.engine();
        let reference = RecordedSide { name: "reference", trajectory: &proof.reference_trajectory };
        let other = engine.trajectory.as_ref().map(|trajectory| RecordedSide { name: "engine", trajectory });
        let sides: Vec<RecordedSide> = std::iter::once(reference).chain(other).collect();
        let recording = shortest(REPEATS, || record(&own, &sides, engine.errors.as_ref(), &ours));

        let solved = prover::run::solve(&long).unwrap();
        let sides = ["reference", "engine"].map(|name| RecordedSide { name, trajectory: &solved });
        let writing = shortest(REPEATS, || record(&own, &sides, None, &ours));
        let bytes = fs::read(&ours).unwrap();
        let messages = messages(&bytes);
        let plainly = shortest(REPEATS, || plain(&messages, &theirs));
        println!("{name:14} {:>26.2} {:>32.2}", 1.0 + recording / proving, plainly / writing);
    }
}
