use std::fs;

use crate::cli::tools::Place;

/// The crank-rocker with formulas appended.
fn with(place: &Place, formulas: &str) {
    let path = place.path("scenarios/crank_rocker.toml");
    let text = fs::read_to_string(path).unwrap();
    fs::write(place.path("mine.toml"), format!("{text}\n{formulas}")).unwrap();
}

#[test]
fn a_formula_of_the_command_line_is_judged() {
    let place = Place::new();
    let right = place.ok("check scenarios/crank_rocker.toml phi*180/pi --channel link.crank.angle_deg");
    assert!(right.starts_with("crank_rocker: AGREE: 1 formula right at 361 instants (assur, newton)"), "{right}");
    let ratio = "link.crank.omega_rad_s/link.crank.omega_rad_s";
    place.ok(&format!("check scenarios/crank_rocker.toml 1 --channel {ratio}"));
    let wrong = place.run("check scenarios/crank_rocker.toml phi --channel link.crank.angle_deg");
    assert_eq!(wrong.code, 1, "{}", wrong.stderr);
    assert!(
        wrong.stdout.starts_with("crank_rocker: DISAGREE: ") && wrong.stdout.contains("a unit"),
        "{}",
        wrong.stdout
    );
    let json = place.run("check scenarios/crank_rocker.toml -phi --channel link.crank.angle_rad --json -");
    let json: serde_json::Value = serde_json::from_str(&json.stdout).unwrap();
    assert_eq!(
        (json["verdict"].as_str(), json["formulas"][0]["cause"]["kind"].as_str()),
        (Some("disagree"), Some("a sign"))
    );
    // Short names of parameters have SI values; whole keys, such as `a_mm`, are the numbers as given.
    let place = Place::new();
    for expression in ["a/l*omega_crank*0+w", "w+a_mm-1000*a", "w_rpm*pi/30"] {
        let set = "--set a_mm=30 --set l_m=0.2 --set w_rpm=130 --set omega_crank=0";
        place.ok(&format!("check scenarios/crank_rocker.toml {expression} {set} --channel link.crank.omega_rad_s"));
    }
}

#[test]
fn steps_ranges_and_claimed_errors() {
    let place = Place::new();
    let steps = "--let u=2*phi --let v=u/2";
    place.ok(&format!("check scenarios/crank_rocker.toml v {steps} --channel link.crank.angle_rad"));
    let near = "check scenarios/crank_rocker.toml phi+0.009 --channel link.crank.angle_rad";
    assert_eq!(place.run(near).code, 1);
    place.ok(&format!("{near} --error 0.01"));
    let outcome = place.run(&format!("{near} --error 0.01 --from-deg 1000 --to-deg 1001"));
    assert_eq!(outcome.code, 3, "{}", outcome.stdout);
    assert!(outcome.stdout.contains("no instant lies between"), "{}", outcome.stdout);
    // The formula is right for half a revolution.
    // At both ends of this half revolution, the derivative of acos is undefined.
    let branch = "check scenarios/crank_rocker.toml acos(cos(phi)) --channel link.crank.angle_rad";
    let outcome = place.run(branch);
    assert_eq!(outcome.code, 1);
    assert!(outcome.stdout.contains("the formula is right up to crank angle 180.000 deg"), "{}", outcome.stdout);
    place.ok(&format!("{branch} --from-deg 0 --to-deg 180"));
}

#[test]
fn errors_are_shown_with_position_and_remedy() {
    let place = Place::new();
    let to = "--channel link.crank.angle_rad";
    for (arguments, words) in [
        ("check scenarios/crank_rocker.toml 2phi --channel link.crank.angle_rad", ["operator is missing", "2*phi"]),
        ("check scenarios/crank_rocker.toml fi --channel link.crank.angle_rad", ["no `fi`", "phi"]),
        (
            "check scenarios/crank_rocker.toml phi --channel link.crank.angel_rad",
            ["no channel", "link.crank.angle_rad"],
        ),
        ("check scenarios/crank_rocker.toml phi --channel 3", ["names no channel", "link.rocker.angle_deg"]),
        ("check scenarios/crank_rocker.toml", ["no formula", "channel"]),
        (&format!("check scenarios/crank_rocker.toml phi {to} --error -1"), ["--error", "greater than 0"]),
        (&format!("check scenarios/crank_rocker.toml phi {to} --set phi=1"), ["is a reserved name", "another name"]),
        (&format!("check scenarios/crank_rocker.toml phi {to} --let t=1"), ["is a reserved name", "another name"]),
        (
            &format!("check scenarios/crank_rocker.toml phi {to} --set a_mm=1 --set a_m=2"),
            ["would mean both `a_mm` and `a_m`", "unit"],
        ),
        (&format!("check scenarios/crank_rocker.toml phi {to} --from-deg 9 --to-deg 1"), ["less than", "exchange"]),
    ] {
        place.refused(arguments, &words);
    }
    // The argument parser reports unreadable arguments.
    for arguments in ["--set a", "--set a=x", "--set a=inf", "--let u"] {
        assert_eq!(place.run(&format!("check scenarios/crank_rocker.toml phi {to} {arguments}")).code, 2);
    }
}

#[test]
fn errors_in_a_file_are_shown_at_their_position() {
    let place = Place::new();
    let claim = "channel = \"link.crank.angle_rad\"";
    for (formulas, words) in [
        (format!("[[formula]]\nname = \"x\"\nexpression = \"phi + y\"\n{claim}"), ["mine.toml", "no `y`"]),
        (
            format!("[[formula]]\nname = \"x\"\nexpression = \"phi +\"\n{claim}"),
            ["mine.toml", "is incomplete at its end"],
        ),
        (format!("[[formula]]\nname = \"x y\"\nexpression = \"phi\"\n{claim}"), ["cannot be a name", "letters"]),
        (format!("[[formula]]\nname = \"pi\"\nexpression = \"phi\"\n{claim}"), ["is a reserved name", "another name"]),
        (format!("[[formula]]\nname = \"x\"\nexpresion = \"phi\"\n{claim}"), ["expression", "did you mean"]),
        ("[[formula]]\nname = \"x\"\nexpression = \"phi\"\nerror = 1".into(), ["belongs to a claim", "channel"]),
        (format!("[[formula]]\nname = \"x\"\nexpression = \"phi\"\nerror = 0\n{claim}"), ["positive", "exact"]),
        ("[parameters]\nsin = 3".into(), ["is a reserved name", "another name"]),
        ("[parameters]\na_mm = 3\na = 4".into(), ["would mean both `a_mm` and `a`", "keep one"]),
        ("[parameters]\na_mm = \"x\"".into(), ["no `x`", "number"]),
        ("[parameters]\na_mm = 3\n[[formula]]\nname = \"a\"\nexpression = \"1\"".into(), ["already", "another name"]),
    ] {
        with(&place, &formulas);
        let outcome = place.refused("run mine.toml --no-record", &words);
        assert!(outcome.stderr.contains("mine.toml"), "{formulas}: {}", outcome.stderr);
    }
    with(&place, &format!("[[formula]]\nname = \"x\"\nexpression = \"2*phi\"\n{claim}"));
    let outcome = place.run("run mine.toml --no-record");
    assert_eq!(outcome.code, 1, "{}", outcome.stdout);
    assert!(
        outcome.stdout.contains("is not link.crank.angle_rad")
            && outcome.unbroken().contains("a factor: right would be `2*phi/2`"),
        "{}",
        outcome.stdout
    );
}
