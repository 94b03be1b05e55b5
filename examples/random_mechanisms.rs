//! Writes random correct mechanisms as scenario files: four-bars, dyads with and without sliders, higher groups. The
//! motions of these mechanisms are prescribed or free. The same seed gives the same files.
//!
//! `cargo run --release --example random_mechanisms -- --seed 1 --count 400 --out DIR [--from 0] [--no-step]`
//!
//! The numbering of the mechanisms starts at `--from`; each mechanism depends only on its number and the seed.
//! With `--no-step` the files have no `[engine]` section.

#[allow(dead_code, unused_imports)]
#[path = "../tests/suite"]
mod suite {
    pub mod common;
}

use suite::common;

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

fn main() -> std::io::Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let option = |name: &str| {
        let place = arguments.iter().position(|argument| argument == name)?;
        arguments.get(place + 1).cloned()
    };
    let number = |name: &str, default: u64| {
        option(name).map_or(default, |text| text.parse().unwrap_or_else(|_| panic!("{name} takes a whole number")))
    };
    let (seed, count, from) = (number("--seed", 1), number("--count", 400), number("--from", 0));
    let out = PathBuf::from(option("--out").expect("--out DIR says where the files go"));
    let with_step = !arguments.iter().any(|argument| argument == "--no-step");
    std::fs::create_dir_all(&out)?;
    let (next, all) = (AtomicU64::new(from), Mutex::new(BTreeMap::new()));
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(|| {
                let mut dropped = BTreeMap::new();
                loop {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    if index >= from + count {
                        break;
                    }
                    let specimen = common::specimens::specimen(seed, index, &mut dropped);
                    let file = out.join(format!("{index:04}.toml"));
                    std::fs::write(&file, specimen.toml(with_step)).unwrap_or_else(|error| panic!("{error}"));
                }
                for (why, times) in dropped {
                    *all.lock().unwrap().entry(why).or_insert(0) += times;
                }
            });
        }
    });
    println!("{count} mechanisms of seed {seed} in {}", out.display());
    println!("random draws that were not used, by reason:");
    for (why, times) in all.into_inner().unwrap() {
        println!("{times:6} {why}");
    }
    Ok(())
}
