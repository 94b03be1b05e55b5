//! A trajectory as topics: one for each subject, with one message per row.

use super::schema::{self, MessageContent};
use super::sink::Sink;
use linkage::trajectory::{ChannelKind, ChannelSubject, Trajectory};
use mcap::McapResult;

/// A trajectory with the topics of its columns.
pub struct ChannelTable<'a> {
    /// Times of the trajectory's rows (s).
    pub times: &'a [f64],
    /// Topics of the columns.
    pub topics: Vec<Topic<'a>>,
}

/// The topic of a subject, with one message per row.
pub struct Topic<'a> {
    /// Number of the topic in its sink.
    pub id: u16,
    fields: Vec<Field<'a>>,
}

enum Field<'a> {
    Value(u32, &'a [f64]),
    /// Field number, column, and number of small units in the SI unit of the column.
    Scaled(u32, &'a [f64], f64),
    /// The number of the row itself.
    Row(u32),
}

impl Topic<'_> {
    /// Writes the message of a row to `buffer`.
    pub fn encode(&self, row: usize, buffer: &mut Vec<u8>) {
        buffer.clear();
        for field in &self.fields {
            match *field {
                Field::Value(tag, column) => schema::put(buffer, tag, column[row]),
                Field::Row(tag) => schema::put(buffer, tag, row as f64),
                Field::Scaled(tag, column, factor) => {
                    let value = (column[row] * factor).clamp(f64::from(f32::MIN), f64::from(f32::MAX));
                    schema::put_small(buffer, tag, value as f32);
                }
            }
        }
    }
}

impl<'a> ChannelTable<'a> {
    /// The grid and the values of a side.
    pub fn values(sink: &mut impl Sink, side: &str, trajectory: &'a Trajectory) -> McapResult<Self> {
        let id = sink.topic(&format!("/{side}/grid"), &schema::grid(trajectory.input()))?;
        let fields = vec![Field::Value(1, trajectory.times()), Field::Value(2, trajectory.inputs()), Field::Row(3)];
        ChannelTable::of(sink, side, trajectory, MessageContent::Values, vec![Topic { id, fields }])
    }

    /// The errors of a recording, in small units such as um.
    pub fn errors(sink: &mut impl Sink, errors: &'a Trajectory) -> McapResult<Self> {
        ChannelTable::of(sink, "error", errors, MessageContent::Errors, Vec::new())
    }

    fn of(
        sink: &mut impl Sink,
        side: &str,
        trajectory: &'a Trajectory,
        told: MessageContent,
        mut topics: Vec<Topic<'a>>,
    ) -> McapResult<Self> {
        for (subject, of, columns) in by_subject(trajectory) {
            let kinds: Vec<&ChannelKind> = columns.iter().map(|&(kind, _)| kind).collect();
            let id = sink.topic(&topic_name(side, subject, of), &schema::of_subject(subject, told, &kinds))?;
            let field = |(kind, column): (&ChannelKind, &'a [f64])| match told {
                MessageContent::Values => Field::Value(schema::tag(kind), column),
                MessageContent::Errors => Field::Scaled(schema::tag(kind), column, schema::small_unit(kind).1),
            };
            topics.push(Topic { id, fields: columns.into_iter().map(field).collect() });
        }
        Ok(ChannelTable { times: trajectory.times(), topics })
    }
}

/// Topic of a subject's values on a side. If `side` is "error", the result is the topic of the errors in the subject's
/// values.
pub fn topic_name(side: &str, subject: ChannelSubject, of: &str) -> String {
    let word = subject.word();
    if of.is_empty() { format!("/{side}/{word}") } else { format!("/{side}/{word}/{of}") }
}

type Columns<'a> = Vec<(&'static ChannelKind, &'a [f64])>;

/// The columns of each subject, such as a link or the frame. Subjects are in the order of their first column.
/// All columns of a sliding joint are together.
fn by_subject(trajectory: &Trajectory) -> Vec<(ChannelSubject, &str, Columns<'_>)> {
    let mut subjects: Vec<(ChannelSubject, &str, Columns)> = Vec::new();
    for (channel, column) in trajectory.iter() {
        let (subject, of) = (channel.kind.subject, channel.of.as_str());
        let same = |own: &(ChannelSubject, &str, Columns)| (own.0.word(), own.1) == (subject.word(), of);
        let place = subjects.iter().position(same).unwrap_or_else(|| {
            subjects.push((subject, of, Vec::new()));
            subjects.len() - 1
        });
        if subject == ChannelSubject::Slider {
            subjects[place].0 = subject;
        }
        subjects[place].2.push((channel.kind, column));
    }
    subjects
}
