//! Parquet files that announce more than they contain.
//! No writer produces such files, so they are assembled byte by byte.

/// A file with one column `a` of 64-bit integers: its announced sizes, and the bytes of its pages.
#[derive(Clone)]
pub struct Announced {
    /// Rows of the file, and rows of each row group.
    pub rows: i64,
    pub of_group: i64,
    /// Number of row groups, all with the same pages.
    pub groups: usize,
    /// Number of children of the schema root, and depth of nested column groups above the single column.
    pub children: i64,
    pub depth: usize,
    /// Number that denotes the compression in the Parquet format.
    pub codec: i64,
    /// Sizes of a page as stated in its header: bytes after decompression, bytes in the file, number of values.
    pub held: i64,
    pub stored: i64,
    pub values: i64,
    /// Number of values of a dictionary, which is in a page before the data.
    pub dictionary: Option<i64>,
    /// Number that denotes the encoding in the Parquet format.
    pub encoding: i64,
    /// Contents of the page in the file.
    pub body: Vec<u8>,
}

const PLAIN: i64 = 0;
const RLE: i64 = 3;
const RLE_DICTIONARY: i64 = 8;
pub const GZIP: i64 = 2;

impl Announced {
    /// A valid file of `rows` zeros; its page stores every value.
    pub fn zeros(rows: i64) -> Self {
        let bytes = rows * 8;
        let body = vec![0; bytes as usize];
        let (held, stored) = (bytes, bytes);
        let (groups, children, depth, codec, dictionary) = (1, 1, 0, 0, None);
        Announced {
            rows,
            of_group: rows,
            groups,
            children,
            depth,
            codec,
            held,
            stored,
            values: rows,
            dictionary,
            encoding: PLAIN,
            body,
        }
    }

    /// A valid file of `rows` equal numbers in a few bytes: a dictionary with one value, and one run of that value.
    pub fn run(rows: i64) -> Self {
        // The body is the bit width zero, then the header of a run, which is twice the length of the run.
        let body = [vec![0], varint((rows as u64) << 1)].concat();
        let length = body.len() as i64;
        Announced {
            held: length,
            stored: length,
            body,
            dictionary: Some(1),
            encoding: RLE_DICTIONARY,
            values: rows,
            of_group: rows,
            rows,
            ..Announced::zeros(0)
        }
    }

    /// The file.
    pub fn file(&self) -> Vec<u8> {
        let mut bytes = b"PAR1".to_vec();
        let dictionary = bytes.len() as i64;
        if let Some(values) = self.dictionary {
            let own = [number(1, values), number(1, PLAIN), vec![0]].concat();
            bytes.extend([number(1, 2), number(1, 8), number(1, 8), inner(4, own), vec![0]].concat());
            bytes.extend([0; 8]);
        }
        let page = bytes.len() as i64;
        let own = [number(1, self.values), number(1, self.encoding), number(1, RLE), number(1, RLE), vec![0]].concat();
        bytes.extend([number(1, 0), number(1, self.held), number(1, self.stored), inner(2, own), vec![0]].concat());
        bytes.extend(&self.body);
        let length = bytes.len() as i64 - dictionary;
        let mut schema = vec![[text(4, "schema"), number(1, self.children), vec![0]].concat()];
        schema.extend((0..self.depth).map(|_| [number(3, 0), text(1, "g"), number(1, 1), vec![0]].concat()));
        schema.push([number(1, 2), number(2, 0), text(1, "a"), vec![0]].concat());
        let column = [
            number(1, 2),
            many(1, 5, vec![zigzag(PLAIN)]),
            many(1, 8, vec!["g"; self.depth].into_iter().chain(["a"]).map(word).collect()),
            number(1, self.codec),
            number(1, self.of_group),
            number(1, length),
            number(1, length),
            number(2, page),
            if self.dictionary.is_some() { number(2, dictionary) } else { Vec::new() },
            vec![0],
        ];
        let chunk = [number(2, dictionary), inner(1, column.concat()), vec![0]].concat();
        let group = [many(1, 12, vec![chunk]), number(1, length), number(1, self.of_group), vec![0]].concat();
        let described =
            [number(1, 1), many(1, 12, schema), number(1, self.rows), many(1, 12, vec![group; self.groups]), vec![0]]
                .concat();
        bytes.extend(&described);
        bytes.extend((described.len() as u32).to_le_bytes());
        bytes.extend(b"PAR1");
        bytes
    }
}

/// Header of a Thrift field; `step` is the difference of its number from the previous field's number.
fn field(step: u8, kind: u8) -> u8 {
    step << 4 | kind
}

fn number(step: u8, value: i64) -> Vec<u8> {
    [vec![field(step, 6)], zigzag(value)].concat()
}

fn inner(step: u8, structure: Vec<u8>) -> Vec<u8> {
    [vec![field(step, 12)], structure].concat()
}

fn text(step: u8, value: &str) -> Vec<u8> {
    [vec![field(step, 8)], word(value)].concat()
}

fn many(step: u8, kind: u8, elements: Vec<Vec<u8>>) -> Vec<u8> {
    [vec![field(step, 9), 0xf0 | kind], varint(elements.len() as u64), elements.concat()].concat()
}

fn word(value: &str) -> Vec<u8> {
    [varint(value.len() as u64), value.as_bytes().to_vec()].concat()
}

fn zigzag(value: i64) -> Vec<u8> {
    varint(((value << 1) ^ (value >> 63)) as u64)
}

fn varint(mut value: u64) -> Vec<u8> {
    let mut bytes = Vec::new();
    while value > 127 {
        bytes.push(value as u8 | 128);
        value >>= 7;
    }
    bytes.push(value as u8);
    bytes
}
