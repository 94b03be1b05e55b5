//! Formulas of published work in the scenarios of their mechanisms.

use std::path::Path;

use super::{is_wrong, judged, load, rewritten};

/// A scenario, one of its formulas, and the same formula with a mistake.
const WRONG: [(&str, &str, &str); 8] = [
    ("compressor", "eps2", "(l1*w1^2*sin(f1) - l2*w2^2*sin(f2))/(l2*cos(f2))"),
    ("compressor", "angle_4", "pi/2 + asin(l1*sin(f1 + delta)/l4)"),
    ("six_bar_slider", "w3", "w1*l1*sin(phi - f2)/(lC*sin(f3 - f2))"),
    ("class3_group", "x_contour_2", "xP - l5*cos(phi) - xA"),
    ("class3_changed_driver", "cramer_2", "-m14*nc3/D"),
    ("class3_changed_driver", "alpha3_2", "(dd3*d5 - d3*dd5)/d5^2"),
    ("fourth_class", "y_contour_1", "YK + OA*sin(phi)"),
    ("fourth_class_plans", "eps3_plan", "26.8/CE"),
];

/// The formulas of the guide to practicals, and of the papers on mechanisms of classes III and IV, agree.
/// A formula with a mistake disagrees.
#[test]
fn val_formulas_of_the_guide_and_of_classes_three_and_four() {
    for (name, formula, wrong) in WRONG {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios").join(format!("{name}.toml"));
        let scenario = load(&path);
        let found = judged(&scenario);
        assert_eq!(found.verdict.word(), "agree", "{name}: {:?}", found.verdict);
        let sources = scenario.formulas.claims().map(|(own, _)| own.source.as_ref());
        assert!(sources.flatten().count() == scenario.formulas.claims().count(), "{name}: a formula without source");
        assert!(is_wrong(&judged(&rewritten(&scenario, formula, wrong)), formula), "{name}: {formula} = {wrong}");
    }
}
