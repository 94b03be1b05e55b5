//! Describes the machine on which times are measured. Without this description, measured times are meaningless.

use crate::sentences;
use std::collections::BTreeSet;
use std::fs;

/// Names and values that describe machine and build.
pub fn machine() -> Vec<(&'static str, String)> {
    let unknown = || "unknown".to_string();
    let info = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let models: BTreeSet<&str> = info.lines().filter(|line| line.starts_with("model name")).filter_map(value).collect();
    let cpu = if models.is_empty() { unknown() } else { models.into_iter().collect::<Vec<_>>().join(", ") };
    let release = fs::read_to_string("/etc/os-release").unwrap_or_default();
    let system = release.lines().find_map(|line| line.strip_prefix("PRETTY_NAME=")).map(|name| name.trim_matches('"'));
    let kernel = fs::read_to_string("/proc/sys/kernel/osrelease").unwrap_or_default();
    let load = fs::read_to_string("/proc/loadavg").unwrap_or_default();
    let load = load.split_whitespace().next().map_or_else(unknown, str::to_string);
    vec![
        ("cpu", cpu),
        ("cores", std::thread::available_parallelism().map_or_else(|_| unknown(), |cores| cores.to_string())),
        ("architecture", std::env::consts::ARCH.into()),
        ("system", format!("{} {} {}", std::env::consts::OS, system.unwrap_or(""), kernel.trim()).trim().into()),
        (sentences::LOAD_AT_THE_START, load),
        ("linkproof", env!("CARGO_PKG_VERSION").into()),
        ("build", if cfg!(debug_assertions) { sentences::WITH_DEBUG_ASSERTIONS } else { "release" }.into()),
    ]
}

fn value(line: &str) -> Option<&str> {
    line.split_once(':').map(|(_, value)| value.trim())
}

/// Processor time (s) used by the present thread, if Linux provides it.
pub fn processor_time() -> Option<f64> {
    let told = fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    Some(told.split_whitespace().next()?.parse::<f64>().ok()? * 1e-9)
}
