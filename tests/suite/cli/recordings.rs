//! A recording takes the place of an older one of the same run, and of no other.

use std::fs;

use super::tools::Place;

const RUN: &str = "run scenarios/pendulum.toml --route differences --record out";

fn recordings(place: &Place) -> Vec<String> {
    let entries = fs::read_dir(place.path("out")).unwrap();
    let mut names: Vec<String> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn other_settings_get_a_name_of_their_own() {
    let place = Place::new();
    place.ok(RUN);
    let first = fs::read(place.path("out/pendulum.mcap")).unwrap();
    // The same run again takes its place, byte for byte.
    let told = place.ok(RUN);
    assert!(told.ends_with("recording  out/pendulum.mcap\n"), "{told}");
    assert_eq!(
        (recordings(&place), fs::read(place.path("out/pendulum.mcap")).unwrap()),
        (vec!["pendulum.mcap".into()], first.clone())
    );

    for (arguments, name, why) in [
        ("--reference newton", "pendulum-2.mcap", "its reference is \"assur\", not \"newton\""),
        ("--times 0,0.1,0.2", "pendulum-3.mcap", "its grid_times_s is none, not \"0,0.1,0.2\""),
        ("--only positions", "pendulum-4.mcap", "its only is none, not \"positions\""),
        ("--reference newton", "pendulum-2.mcap", "its reference"),
    ] {
        let told = place.ok(&format!("{RUN} {arguments}"));
        let line = format!("recording  out/{name}\n           pendulum.mcap is of another run and is kept: {why}");
        assert!(told.contains(&line), "{arguments}: {told}");
    }
    // Another scenario of the same name, and one that was changed.
    place.edited("pendulum.toml", "pendulum.toml", &[("title = \"", "title = \"Another, ")]);
    let told = place.ok(RUN);
    assert!(told.contains("out/pendulum-5.mcap") && told.contains("its scenario has another text"), "{told}");
    let expected = ["pendulum-2.mcap", "pendulum-3.mcap", "pendulum-4.mcap", "pendulum-5.mcap", "pendulum.mcap"];
    assert_eq!(recordings(&place), expected);
    assert_eq!(fs::read(place.path("out/pendulum.mcap")).unwrap(), first);
}

#[test]
fn what_is_no_recording_is_left_alone() {
    let place = Place::new();
    fs::create_dir(place.path("out")).unwrap();
    fs::write(place.path("out/pendulum.mcap"), "notes of mine").unwrap();
    let told = place.ok(RUN);
    assert!(told.contains("out/pendulum-2.mcap") && told.contains("it is no recording of a run"), "{told}");
    assert_eq!(fs::read_to_string(place.path("out/pendulum.mcap")).unwrap(), "notes of mine");
}

/// Two scenarios of one name in one command.
#[test]
fn scenarios_of_one_name_are_both_recorded() {
    let place = Place::new();
    place.edited("pendulum.toml", "other.toml", &[("title = \"", "title = \"Another, ")]);
    place.ok("run scenarios/pendulum.toml scenarios/other.toml --route differences --record out");
    assert_eq!(recordings(&place), ["pendulum-2.mcap", "pendulum.mcap"]);
}
