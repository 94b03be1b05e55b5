//! Untrusted recordings with false sizes and false indices.

use std::fs;
use std::io::Cursor;
use std::path::Path;

use mcap::records::MessageHeader;

use crate::cli::tools::Place;
use recording::read_bytes;

/// Byte offset of the content of the first record with this code.
fn content(file: &[u8], code: u8) -> usize {
    let mut at = mcap::MAGIC.len();
    while file[at] != code {
        at += 9 + u64::from_le_bytes(file[at + 1..at + 9].try_into().unwrap()) as usize;
    }
    at + 9
}

/// A file with one compressed chunk of `messages` messages; each message is a mebibyte of zeros.
fn zeros(messages: u32) -> Vec<u8> {
    let options = mcap::WriteOptions::new().chunk_size(None).calculate_chunk_crcs(false);
    let mut file = options.create(Cursor::new(Vec::new())).unwrap();
    let schema = file.add_schema("linkproof.Any", "protobuf", &[]).unwrap();
    let channel_id = file.add_channel(schema, "/other", "protobuf", &Default::default()).unwrap();
    for sequence in 0..messages {
        let header = MessageHeader { channel_id, sequence, log_time: 0, publish_time: 0 };
        file.write_to_known_channel(&header, &vec![0; (1 << 20) - 100]).unwrap();
    }
    file.finish().unwrap();
    file.into_inner().into_inner()
}

fn refusal(file: &[u8]) -> String {
    read_bytes(file, Path::new("zeros.mcap")).unwrap_err().to_string()
}

/// Symptom: a file of 31 kB with a chunk of zeros was decompressed to a gigabyte, which took 12 s.
#[test]
fn a_small_file_that_claims_a_large_size_is_not_decompressed() {
    let file = zeros(300);
    assert!(file.len() < 100_000, "{} bytes", file.len());
    let told = refusal(&file);
    assert!(
        told.contains("zeros.mcap has") && told.contains("claims to unpack to 31") && told.contains("134 MB"),
        "{told}"
    );
    // A similar file within the limit is decompressed to its end.
    assert!(refusal(&zeros(20)).contains("contains no trajectory"));
}

/// Sizes stated in a file are trusted only up to a limit.
#[test]
fn a_file_is_read_no_further_than_its_stated_size() {
    let mut file = zeros(300);
    let size = content(&file, mcap::records::op::CHUNK) + 16;
    file[size..size + 8].copy_from_slice(&1000u64.to_le_bytes());
    assert!(refusal(&file).contains("damaged"), "{}", refusal(&file));
    // The file states twice the actual size of its chunk.
    let mut file = zeros(20);
    file[size..size + 8].copy_from_slice(&(41u64 << 20).to_le_bytes());
    assert!(refusal(&file).contains("damaged"), "{}", refusal(&file));
    file[size..size + 8].copy_from_slice(&u64::MAX.to_le_bytes());
    assert!(refusal(&file).contains("claims to unpack to"), "{}", refusal(&file));
}

/// Symptom: the index of an older recording pointed outside the file, and the run that read the recording panicked.
#[test]
fn an_older_recording_with_a_bad_index_is_left_alone() {
    let place = Place::new();
    place.ok("run scenarios/pendulum.toml --route differences --record out");
    let path = place.path("out/pendulum.mcap");
    let whole = fs::read(&path).unwrap();
    for code in [mcap::records::op::ATTACHMENT_INDEX, mcap::records::op::METADATA_INDEX] {
        let mut file = whole.clone();
        let at = content(&file, code);
        file[at..at + 8].copy_from_slice(&u64::MAX.to_le_bytes());
        file[at + 8..at + 16].copy_from_slice(&5u64.to_le_bytes());
        fs::write(&path, &file).unwrap();
        let told = place.ok("run scenarios/pendulum.toml --route differences --record out");
        assert!(told.contains("out/pendulum.mcap"), "{told}");
        assert_eq!(
            fs::read(&path).unwrap(),
            whole,
            "a recording of the same run by this program was replaced by other bytes"
        );
    }
    // If the metadata are cut off at any byte, the recording counts as a file of the user.
    for cut in [9, 30, content(&whole, mcap::records::op::METADATA) + 20] {
        fs::write(&path, &whole[..cut]).unwrap();
        let told = place.ok("run scenarios/pendulum.toml --route differences --record out");
        assert!(told.contains("out/pendulum-2.mcap") && told.contains("not a recording of a run"), "{told}");
        assert_eq!(fs::read(&path).unwrap(), whole[..cut]);
    }
}

/// Endless inputs and paths of non-regular files are not read.
#[cfg(unix)]
#[test]
fn only_regular_files_are_read_as_recordings() {
    let place = Place::new();
    assert!(std::process::Command::new("mkfifo").arg(place.path("pipe.mcap")).status().unwrap().success());
    std::os::unix::fs::symlink("/dev/zero", place.path("zero.mcap")).unwrap();
    for name in ["pipe.mcap", "zero.mcap"] {
        place.refused(&format!("view {name} --with foxglove"), &[name, "not a regular file"]);
        place.refused(&format!("view {name} --with plotjuggler"), &[name, "not a regular file"]);
        place.refused(&format!("compare scenarios/pendulum.toml {name}"), &[name, "not a regular file"]);
    }
}
