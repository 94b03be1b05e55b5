//! Files in the formats of foreign programs: encodings, decimal commas, semicolons.

use std::fs;

use super::tools::Place;

const TABLE: &str = "crank_deg,rocker_deg\n0,70\n90,75\n";

/// A scenario with a table of published numbers.
fn with_table(place: &Place, table: &[u8]) {
    let own = "[[oracle]]\nsource = \"a table\"\nfile = \"table.csv\"\ncrank = \"crank_deg\"\ndigits = 0\n\
               [oracle.columns]\nrocker_deg = { channel = \"link.rocker.angle_deg\" }\n";
    let text = fs::read_to_string(place.path("scenarios/crank_rocker.toml")).unwrap();
    fs::write(place.path("scenarios/own.toml"), format!("{text}\n{own}")).unwrap();
    fs::write(place.path("scenarios/table.csv"), table).unwrap();
}

#[test]
fn a_scenario_in_another_encoding_is_refused_with_a_remedy() {
    let place = Place::new();
    let text = fs::read_to_string(place.path("scenarios/crank_rocker.toml")).unwrap();
    let utf16: Vec<u8> = [0xfeff].into_iter().chain(text.encode_utf16()).flat_map(u16::to_le_bytes).collect();
    fs::write(place.path("wide.toml"), utf16).unwrap();
    let latin: Vec<u8> = text.replacen("title = \"", "title = \"\u{e4}", 1).chars().map(|c| c as u8).collect();
    fs::write(place.path("latin.toml"), latin).unwrap();
    for command in ["run FILE", "check FILE", "solve FILE --with assur", "inspect FILE"] {
        place.refused(
            &command.replace("FILE", "wide.toml"),
            &["wide.toml cannot be read", "UTF-16", "iconv -f UTF-16 -t UTF-8"],
        );
        place.refused(
            &command.replace("FILE", "latin.toml"),
            &["not written in UTF-8", "line 3", "\u{e4}", "iconv -f WINDOWS-1252"],
        );
    }
    fs::write(place.path("marked.toml"), format!("\u{feff}{text}")).unwrap();
    place.ok("inspect marked.toml");
}

#[test]
fn a_table_in_another_encoding_is_refused_with_a_remedy() {
    let place = Place::new();
    let utf16: Vec<u8> = TABLE.encode_utf16().flat_map(u16::to_be_bytes).collect();
    with_table(&place, &utf16);
    place.refused("inspect scenarios/own.toml", &["table.csv", "UTF-16BE", "iconv", "own.toml:", "file = "]);
    with_table(&place, b"crank_deg,rocker_deg\n0,70\n90,75\xb0\n");
    place.refused("inspect scenarios/own.toml", &["line 3", "0xB0", "WINDOWS-1252"]);
    with_table(&place, format!("\u{feff}{TABLE}").as_bytes());
    place.ok("inspect scenarios/own.toml");
}

#[test]
fn wrong_separators_of_tables_are_reported() {
    let place = Place::new();
    for (table, words) in [
        ("crank_deg;rocker_deg\n0;70,5\n", ["table.csv:1", "separated by ';'", "decimals with a point"]),
        ("crank_deg\trocker_deg\n0\t70.5\n", ["table.csv:1", "separated by '\\t'", "commas"]),
        (
            "crank_deg,rocker_deg\n0,70\n90,0,75,5\n",
            ["table.csv:3", "4 cells, but the header has 2", "decimals seem to be written with commas"],
        ),
        (
            "crank_deg,rocker_deg\n0,70\n90,\"75,5\"\n",
            ["table.csv:3", "found \"75,5\"", "written with a decimal point"],
        ),
    ] {
        with_table(&place, table.as_bytes());
        place.refused("inspect scenarios/own.toml", &words);
    }
}

#[test]
fn decimal_commas_and_duplicates_are_reported_with_positions() {
    let place = Place::new();
    place.edited("crank_rocker.toml", "own.toml", &[("mass_kg = 2.6", "mass_kg = 2,6")]);
    place.refused("run scenarios/own.toml", &["own.toml:", "`2,6` has a decimal comma", "with a point: 2.6"]);
    place.edited("crank_rocker.toml", "own.toml", &[("mass_kg = 2.6", "mass_kg = 2.6\nmass_kg = 3")]);
    let text = fs::read_to_string(place.path("scenarios/own.toml")).unwrap();
    let first = text[..text.find("mass_kg").unwrap()].matches('\n').count() + 1;
    let words = [format!("first in line {first}"), format!("own.toml:{}", first + 1)];
    place.refused("run scenarios/own.toml", &[&words[0], &words[1], "`mass_kg` is given twice", "keep one"]);
}
