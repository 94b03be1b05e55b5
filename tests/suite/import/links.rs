//! Links of PMKS+: web addresses that contain a mechanism.
//! The test compares the points with the coordinates from which the addresses were made by hand.

use super::{data, imported, proven};
use crate::cli::tools::{Place, Table};
use crate::common::assert_within;
use linkage::math::KeepNan;

/// A web address, its unit of length in m, the positions of moving points at t = 0 in this unit, and the speed of the
/// input (rpm; 0 if the test does not check the speed).
struct Link {
    name: &'static str,
    metres: f64,
    points: &'static [(&'static str, [f64; 2])],
    speed: f64,
    /// Further notes.
    told: &'static [&'static str],
}

const LINKS: [Link; 11] = [
    Link { name: "four_bar", metres: 0.01, points: &[("B", [3.0, 2.0]), ("C", [10.0, 7.0])], speed: 20.0, told: &[] },
    Link {
        name: "slider_crank",
        metres: 0.01,
        points: &[("B", [2.0, 1.0]), ("C", [1.0, 8.5])],
        speed: 30.0,
        told: &[],
    },
    Link {
        name: "six_bar",
        metres: 0.01,
        points: &[("B", [2.0, 2.0]), ("C", [8.0, 6.0]), ("E", [6.0, 8.0]), ("F", [13.0, 9.0])],
        speed: 20.0,
        told: &[],
    },
    Link {
        name: "coupler_point",
        metres: 0.0254,
        points: &[("B", [2.0, 3.0]), ("C", [7.0, 5.5]), ("traceur_é", [4.0, 7.0])],
        speed: -45.0,
        told: &["joint \"crank pivot\" is called \"crank_pivot\"", "link \"input link\" is called \"input_link\""],
    },
    Link {
        name: "force",
        metres: 1.0,
        points: &[("B", [0.3, 0.4]), ("C", [1.5, 1.2]), ("F1", [0.9, 0.8]), ("F2", [1.75, 0.6])],
        speed: 20.0,
        told: &[],
    },
    Link {
        name: "welded",
        metres: 0.01,
        points: &[("B", [3.0, 2.0]), ("C", [9.0, 6.0]), ("E", [12.0, 9.0])],
        speed: 20.0,
        told: &[],
    },
    Link {
        name: "common_pin",
        metres: 0.01,
        points: &[("B", [2.0, 1.5]), ("C", [8.0, 5.0]), ("E", [13.0, 6.0])],
        speed: 20.0,
        told: &["the crank angle reaches only from -90.159882 to 149.659035 deg"],
    },
    Link {
        name: "driven_slide",
        metres: 0.01,
        points: &[("B", [0.0, 5.0]), ("C", [7.0, 0.0])],
        speed: 0.0,
        told: &["slide \"D\": it moves at 5 cm/s", "the section \"LAB\" is left out"],
    },
    Link { name: "slot", metres: 0.01, points: &[("B", [1.0, 5.0]), ("E", [1.569, 7.845])], speed: 20.0, told: &[] },
    Link {
        name: "older_four_bar",
        metres: 0.001,
        points: &[("P2", [30.0, 20.0]), ("P3", [60.0, 80.0]), ("P4", [100.0, 70.0])],
        speed: 30.0,
        told: &["coordinates are taken as mm"],
    },
    Link {
        name: "older_slider",
        metres: 0.001,
        points: &[("P2", [20.0, 15.0]), ("P3", [90.0, -10.0])],
        speed: 10.0,
        told: &["coordinates are taken as mm"],
    },
];

#[test]
fn every_link_becomes_a_scenario_that_is_proven() {
    for Link { name, metres, points, speed, told } in LINKS {
        let (place, outcome) = imported(&format!("{name}.pmks"));
        assert_eq!(outcome.code, 0, "{name}: {}", outcome.stderr);
        let stderr = outcome.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
        let text = std::fs::read_to_string(place.path("own.toml")).unwrap();
        for told in told {
            assert!(stderr.contains(told) && text.contains(told), "{name}: `{told}` is not in: {stderr}");
        }
        assert!(!told.is_empty() || stderr.is_empty(), "{name}: {stderr}");
        proven(&place, name);
        // The start pose is the drawing; coordinates in an address have three decimals.
        let table = Table::of(&place.ok("solve own.toml --with newton --times 0"));
        for (point, [x, y]) in points {
            let found = ["x", "y"].map(|axis| table.column(&format!("point.{point}.{axis}_m"))[0]);
            let off = (found[0] - x * metres).abs().larger((found[1] - y * metres).abs());
            assert_within!(off, 1.1e-3 * metres, "{name}: {point}");
        }
        if speed != 0.0 {
            let omega = table.header.iter().find(|own| own.ends_with("omega_rad_s")).unwrap();
            let expected = speed * std::f64::consts::TAU / 60.0;
            assert_within!((table.column(omega)[0] - expected).abs(), 1e-9, "{name}");
        }
    }
}

#[test]
fn masses_and_forces_have_the_units_of_the_document() {
    let mass = |name: &str, link: &str| {
        let (place, _) = imported(name);
        let scenario = scenario::Scenario::load(place.path("own.toml")).unwrap();
        let links = scenario.case.mechanism.links();
        let own = links.iter().find(|own| own.name == link).unwrap();
        (own.mass, own.inertia, scenario.case.gravity, scenario.case.loads.len())
    };
    // The units of mass and moment of inertia depend on the unit of length of the address.
    // They are g and kg cm^2 for cm, lb and lb in^2 for inches, and kg and kg m^2 for m.
    let (own, inertia, gravity, loads) = mass("four_bar.pmks", "BC");
    assert_within!((own - 0.06).abs() + (inertia - 3e-4).abs() + gravity.norm(), 1e-15);
    assert_eq!(loads, 0);
    let (own, inertia, ..) = mass("coupler_point.pmks", "BCE");
    assert_within!((own - 1.5 * 0.453_592_37).abs(), 1e-15);
    assert_within!((inertia - 6.0 * 0.453_592_37 * 0.0254 * 0.0254).abs(), 1e-15);
    let (own, inertia, gravity, loads) = mass("force.pmks", "BC");
    assert_eq!((own, inertia, gravity.x, gravity.y, loads), (5.0, 0.8, 0.0, -9.81, 2));
    let (place, _) = imported("force.pmks");
    let text = std::fs::read_to_string(place.path("own.toml")).unwrap();
    assert!(text.contains("link = \"BC\"\npoint = \"F1\"\nx_N = 0\ny_N = -25"), "{text}");
    // This force turns with its link.
    // The arrow of the force goes from (2, 0.7) to the point of the link at (1.75, 0.6).
    let (along, across) = (unit_of(0.5, -1.2), [-0.25, -0.1]);
    let size = 10.0 / 0.25f64.hypot(0.1);
    let x = size * (across[0] * along[0] + across[1] * along[1]);
    assert!(text.contains(&format!("frame = \"link\"\nx_N = {}", (x * 1e9).round() / 1e9)), "{text}");
}

fn unit_of(x: f64, y: f64) -> [f64; 2] {
    let size = x.hypot(y);
    [x / size, y / size]
}

/// The address itself, its query alone, standard input and a file give the same scenario.
#[test]
fn an_address_may_be_given_in_every_way() {
    let place = Place::empty();
    let address = data("four_bar.pmks");
    let address = address.trim();
    let query = &address[address.find('?').unwrap()..];
    std::fs::write(place.path("pmks.txt"), address).unwrap();
    let texts = [address, query, "pmks.txt"].map(|source| {
        let outcome = place.given(&["import", source, "-o", "-"]);
        assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""));
        outcome.stdout
    });
    assert!(texts.iter().all(|text| *text == texts[0] && text.contains("name = \"pmks\"")));
    let outcome = place.given(&["import", address]);
    assert_eq!(outcome.code, 0);
    assert_eq!(std::fs::read_to_string(place.path("pmks.toml")).unwrap(), texts[0]);
    for again in [vec!["import", address], vec!["import", address, "-o", "pmks.toml"]] {
        let outcome = place.given(&again);
        assert!(outcome.code == 2 && outcome.stderr.contains("pmks.toml already exists"), "{}", outcome.stderr);
    }
    assert_eq!(place.given(&["import", address, "--force"]).code, 0);
}
