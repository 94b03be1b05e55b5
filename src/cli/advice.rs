//! Advice in the words of the command line: the text names options and commands.

use crate::sentences;
use linkage::error::{Advice, rounded_up};

/// Puts advice into words for a user of the command line.
pub(super) fn told(advice: &Advice) -> String {
    match advice {
        Advice::SmallerStep { to } => sentences::choose_a_smaller_time_step(&option("--dt", *to)),
        Advice::LargerStep { to } => sentences::choose_a_larger_time_step(&option("--dt", *to)),
        Advice::TighterAccuracy { to } => sentences::choose_a_tighter_accuracy(&option("--accuracy", Some(*to))),
        Advice::LooserAccuracy { to } => sentences::choose_a_looser_accuracy(&option("--accuracy", Some(*to))),
        Advice::MoreSweeps { to: None } => sentences::RAISE_THE_NUMBER_OF_SWEEPS_SWEEPS.into(),
        Advice::MoreSweeps { to: Some(to) } => sentences::raise_the_number_of_sweeps(&to),
        Advice::FreeSettings => sentences::LEAVE_OUT_THE_ENGINE_SETTINGS.into(),
        Advice::MoreWork { to } => sentences::allow_more_work_such_as_budget(&format_args!("{to:e}")),
        Advice::MoreMemory { to } => sentences::allow_more_memory_such_as_memory(&(rounded_up(*to / 1e9))),
        Advice::OtherEngine => sentences::linkproof_list_solvers_names_them(&advice),
        Advice::OtherRoute { routes } => {
            let options: Vec<String> = routes.iter().map(|route| format!("--route {route}")).collect();
            sentences::take_another_way_to_the_reactions(&options.join(" or "))
        }
        Advice::OtherReference { solver } => sentences::take_side_reference(&solver),
        Advice::OtherSolver { solver } => sentences::solve_the_scenario_with_linkproof(&solver),
        Advice::LookAtRange => sentences::LINKPROOF_INSPECT_FILE_RANGE_SHOWS.into(),
        Advice::Configuration { .. } => sentences::linkproof_inspect_file_modes_lists(&advice),
        Advice::SolutionTable => sentences::READ_THEM_OFF_A_TABLE_OF_LINKPROOF.into(),
        Advice::OtherChannel { groups } => sentences::name_a_column_of_linkproof(&groups),
        Advice::WeakerWish => sentences::ASK_FOR_A_LARGER_ERROR_OTHER.into(),
        Advice::AllResults => sentences::ALL_OF_THEM_WITH_JSON.into(),
        Advice::NoLoads => sentences::LEAVE_THE_LOADS_OUT_WITH_NO_LOADS.into(),
        Advice::Text(text) => as_commands(text),
        Advice::DoublePrecision | Advice::FewerInstants | Advice::ShortenGrid => advice.to_string(),
    }
}

/// An option with the suggested value `to`, or the option alone if no value is suggested.
fn option(name: &str, to: Option<f64>) -> String {
    match to {
        Some(to) => sentences::such_as(&name, &format_args!("{to:e}")),
        None => format!(" ({name})"),
    }
}

/// Replaces the file names of documentation pages, for example `docs/scenario.md`, by commands that show the pages. An
/// installed program has these commands, but not the files.
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
    fn advice_names_command_line_options() {
        for (advice, words) in [
            (Advice::SmallerStep { to: Some(5e-4) }, "choose a smaller time step, such as --dt 5e-4"),
            (Advice::SmallerStep { to: None }, "choose a smaller time step (--dt)"),
            (Advice::LargerStep { to: Some(2e-3) }, "choose a larger time step, such as --dt 2e-3"),
            (Advice::TighterAccuracy { to: 1e-9 }, "choose a tighter accuracy, such as --accuracy 1e-9"),
            (Advice::LooserAccuracy { to: 1e-9 }, "choose a looser accuracy, such as --accuracy 1e-9"),
            (Advice::MoreSweeps { to: Some(64) }, "raise the number of sweeps, such as --sweeps 64"),
            (Advice::MoreMemory { to: 5.23e9 }, "allow more memory, such as --memory 5.3"),
            (Advice::OtherEngine, "use another engine: `linkproof list --solvers` lists the engines"),
            (Advice::OtherReference { solver: "newton" }, "use side \"newton\" as the reference: --reference newton"),
            (Advice::AllResults, "-o FILE.json lists all results"),
            (Advice::NoLoads, "leave the loads out with --no-loads, and add them to the model by hand"),
            ("check the lengths".into(), "check the lengths"),
            (Advice::ShortenGrid, "shorten the grid to the inputs that can be reached on this branch"),
        ] {
            assert_eq!(told(&advice), words);
        }
        let routes = Advice::OtherRoute { routes: &["differences", "native"] };
        assert!(told(&routes).ends_with("--route differences or --route native"));
        let modes = Advice::Configuration { give: "a number from 1 to 2".into() };
        assert_eq!(told(&modes), "give a number from 1 to 2; `linkproof inspect FILE --modes` lists configurations");
    }

    #[test]
    fn page_references_become_docs_commands() {
        for (text, told) in [
            ("docs/scenario.md describes it.", "`linkproof docs scenario` describes it."),
            ("see docs/findings.md#a-b.", "see `linkproof docs findings#a-b`."),
            ("in docs/ and docs/bench", "in docs/ and docs/bench"),
        ] {
            assert_eq!(as_commands(text), told);
        }
    }
}
