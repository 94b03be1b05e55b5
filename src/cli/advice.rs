//! Advice in the words of the command line: it names the options and commands.

use linkage::error::{Advice, rounded_up};

/// Advice as text for a user of the command line.
pub(super) fn told(advice: &Advice) -> String {
    match advice {
        Advice::SmallerStep { to } => format!("choose a smaller time step{}", option("--dt", *to)),
        Advice::LargerStep { to } => format!("choose a larger time step{}", option("--dt", *to)),
        Advice::TighterAccuracy { to } => format!("choose a tighter accuracy{}", option("--accuracy", Some(*to))),
        Advice::LooserAccuracy { to } => format!("choose a looser accuracy{}", option("--accuracy", Some(*to))),
        Advice::MoreSweeps { to: None } => "raise the number of sweeps (--sweeps)".into(),
        Advice::MoreSweeps { to: Some(to) } => format!("raise the number of sweeps, such as --sweeps {to}"),
        Advice::FreeSettings => "leave out the engine's settings, and the run finds its own".into(),
        Advice::MoreWork { to } => format!("allow more work, such as --budget {to:e}"),
        Advice::MoreMemory { to } => format!("allow more memory, such as --memory {:.1}", rounded_up(*to / 1e9)),
        Advice::OtherEngine => format!("{advice}: `linkproof list --solvers` names them"),
        Advice::OtherRoute { routes } => {
            let options: Vec<String> = routes.iter().map(|route| format!("--route {route}")).collect();
            format!("take another way to the reactions: {}", options.join(" or "))
        }
        Advice::OtherReference { solver } => format!("take side \"{solver}\": --reference {solver}"),
        Advice::OtherSolver { solver } => format!("solve the scenario with `linkproof solve FILE --with {solver}`"),
        Advice::LookAtRange => {
            "`linkproof inspect FILE --range` shows what limits the crank and which links turn fully".into()
        }
        Advice::Configuration { .. } => format!("{advice}; `linkproof inspect FILE --modes` lists them"),
        Advice::SolutionTable => "read them off a table of `linkproof solve` instead".into(),
        Advice::OtherChannel { groups } => {
            format!("name a column of `linkproof solve`, such as joint.A.fx_N, or one of: {groups}")
        }
        Advice::WeakerWish => {
            "ask for a larger error, other channels (--channel) or further engines (--engine all)".into()
        }
        Advice::AllResults => "all of them with --json".into(),
        Advice::Text(text) => as_commands(text),
        Advice::DoublePrecision | Advice::FewerInstants | Advice::ShortenGrid => advice.to_string(),
    }
}

/// An option with a value to try, or the option alone.
fn option(name: &str, to: Option<f64>) -> String {
    match to {
        Some(to) => format!(", such as {name} {to:e}"),
        None => format!(" ({name})"),
    }
}

/// A text that speaks of pages as files, for whom may not have the files: `docs/scenario.md` is the command that shows it.
fn as_commands(text: &str) -> String {
    let is_of_path = |sign: char| sign.is_alphanumeric() || matches!(sign, '/' | '.' | '#' | '-' | '_');
    let mut told = String::new();
    let mut rest = text;
    while let Some(at) = rest.find("docs/") {
        let path = &rest[at..];
        let path = &path[..path.find(|sign| !is_of_path(sign)).unwrap_or(path.len())];
        let path = path.trim_end_matches('.');
        told.push_str(&rest[..at]);
        match path.strip_prefix("docs/").and_then(|page| page.split_once(".md")) {
            Some((page, section)) => told.push_str(&format!("`linkproof docs {page}{section}`")),
            None => told.push_str(path),
        }
        rest = &rest[at + path.len()..];
    }
    told + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn advice_becomes_options() {
        for (advice, words) in [
            (Advice::SmallerStep { to: Some(5e-4) }, "choose a smaller time step, such as --dt 5e-4"),
            (Advice::SmallerStep { to: None }, "choose a smaller time step (--dt)"),
            (Advice::LargerStep { to: Some(2e-3) }, "choose a larger time step, such as --dt 2e-3"),
            (Advice::TighterAccuracy { to: 1e-9 }, "choose a tighter accuracy, such as --accuracy 1e-9"),
            (Advice::LooserAccuracy { to: 1e-9 }, "choose a looser accuracy, such as --accuracy 1e-9"),
            (Advice::MoreSweeps { to: Some(64) }, "raise the number of sweeps, such as --sweeps 64"),
            (Advice::MoreMemory { to: 5.23e9 }, "allow more memory, such as --memory 5.3"),
            (Advice::OtherEngine, "take another engine: `linkproof list --solvers` names them"),
            (Advice::OtherReference { solver: "newton" }, "take side \"newton\": --reference newton"),
            (Advice::AllResults, "all of them with --json"),
            ("check the lengths".into(), "check the lengths"),
            (Advice::ShortenGrid, "shorten the grid to the crank angles that can be reached on this branch"),
        ] {
            assert_eq!(told(&advice), words);
        }
        let routes = Advice::OtherRoute { routes: &["differences", "native"] };
        assert!(told(&routes).ends_with("--route differences or --route native"));
        let modes = Advice::Configuration { give: "a number from 1 to 2".into() };
        assert_eq!(told(&modes), "give a number from 1 to 2; `linkproof inspect FILE --modes` lists them");
    }

    #[test]
    fn pages_become_commands() {
        for (text, told) in [
            ("docs/scenario.md describes it.", "`linkproof docs scenario` describes it."),
            ("see docs/findings.md#a-b.", "see `linkproof docs findings#a-b`."),
            ("in docs/ and docs/bench", "in docs/ and docs/bench"),
        ] {
            assert_eq!(as_commands(text), told);
        }
    }
}
