//! What the report and the JSON show of a diagnosis, and where the report shows it.

use super::{edited, parsed, text};
use linkage::error::Advice;
use linkage::work::{Count, PLACED};
use linkproof::report::json::Document;
use linkproof::report::text::proof as told;
use prover::run::{Options, Proof, prove_against};

fn against(from: &str, to: &str) -> Proof {
    let right = text("crank_rocker");
    let wrong = parsed("crank_rocker", &edited(&right, from, to)).case;
    prove_against(&parsed("crank_rocker", &right), &wrong, &Options::default()).unwrap()
}

#[test]
fn a_diagnosis_follows_the_verdict_and_is_in_the_json() {
    let proof = against("y_m_s2 = -9.81", "y_m_s2 = 0");
    let report = told(&proof, Advice::to_string, None);
    println!("{report}");
    let (verdict, diagnosis) = (report.find("DISAGREE").unwrap(), report.find("\nDiagnosis of rapier:").unwrap());
    assert!(verdict < diagnosis);
    for line in [
        "\n  suspect   rapier; all other parties agree with each other",
        "\n  since     t = 0.000000 s, crank angle 0.000 deg, first in joint.",
        "\n  cause     gravity: missing; this explains all ",
    ] {
        assert!(report.contains(line), "{line}");
    }
    let mut document = Document::new();
    document.add(&proof, None);
    let json: serde_json::Value = serde_json::from_str(&document.text()).unwrap();
    let found = &json["runs"][0]["diagnosis"];
    assert_eq!((&found["suspect"], &found["alone"]), (&"rapier".into(), &"rapier".into()));
    assert_eq!((&found["cause"], &found["explained"]), (&"gravity: missing".into(), &true.into()));
    let times: Vec<f64> = found["since"].as_array().unwrap().iter().map(|one| one["t_s"].as_f64().unwrap()).collect();
    assert!(!times.is_empty() && times.is_sorted());
}

#[test]
fn without_a_disagreement_there_is_no_diagnosis() {
    let proof = against("y_m_s2 = -9.81", "y_m_s2 = -9.810");
    assert!(proof.diagnosis.is_none() && !told(&proof, Advice::to_string, None).contains("Diagnosis"));
    let mut document = Document::new();
    document.add(&proof, None);
    assert!(!document.text().contains("\"diagnosis\":"));
}

/// With two simultaneous faults, neither is named as the cause of everything.
#[test]
fn two_faults_at_once_have_no_single_cause() {
    let right = text("crank_rocker");
    let once = edited(&right, "mass_kg = 34.7", "mass_kg = 36");
    let twice = edited(&once, "moment_N_m = 100", "moment_N_m = 130");
    let wrong = parsed("crank_rocker", &twice).case;
    let proof = prove_against(&parsed("crank_rocker", &right), &wrong, &Options::default()).unwrap();
    let found = proof.diagnosis.as_ref().unwrap();
    assert!(!found.is_explained() && !found.left_over.is_empty(), "{:?}", found.cause);
    let report = told(&proof, Advice::to_string, None);
    println!("{}", &report[report.find("Diagnosis").unwrap()..]);
    assert!(report.contains("\n  cause     no"));
}

/// The search for a cause has a separate work limit: as much work as the budget allows for the proof.
/// At this limit the search stops.
/// The report and the JSON then say that the search was stopped early.
#[test]
fn a_truncated_search_for_a_cause_is_reported() {
    let right = text("double_pendulum");
    let once = edited(&right, "y_m_s2 = -9.80665", "y_m_s2 = -9");
    let twice = edited(&once, "start_deg = 40", "start_deg = 44");
    let mut whole = parsed("double_pendulum", &right);
    whole.oracles.clear();
    let wrong = parsed("double_pendulum", &twice).case;
    // Every changed case is integrated again, which costs much work.
    // The engine settings are given, so that the work of the engine itself is small.
    let of = |budget: f64| {
        let options = Options::default().step(5e-3).sweeps(1).extrapolated(0).budget(budget);
        let proof = prove_against(&whole, &wrong, &options).unwrap();
        assert_eq!(proof.verdict.word(), "disagree");
        let entry = proof.work.iter().find(|own| own.part == "diagnosis").unwrap();
        let work = entry.work.as_ref().unwrap();
        let work = work.of(Count::Intervals) as f64 + PLACED * work.of(Count::Groups) as f64;
        let report = told(&proof, Advice::to_string, None);
        let mut document = Document::new();
        document.add(&proof, None);
        let json: serde_json::Value = serde_json::from_str(&document.text()).unwrap();
        let words = report.split_whitespace().collect::<Vec<_>>().join(" ");
        let is_told = words.contains("The search for a cause reached its work limit");
        assert_eq!(is_told, proof.diagnosis_is_cut, "{report}");
        assert_eq!(json["runs"][0]["diagnosis_cut"] == true, proof.diagnosis_is_cut);
        (proof.diagnosis_is_cut, work)
    };
    let (is_cut, all) = of(1e7);
    assert!(!is_cut && all < 1e7, "{all}");
    let budget = all / 2.0;
    let (is_cut, work) = of(budget);
    assert!(is_cut && work > 0.5 * budget && work < 1.1 * budget, "{work} of {budget}");
}
