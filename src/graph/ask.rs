//! Reads the words by which the user requests curves.

use crate::sentences;

use formula::FormulaFault;
use linkage::error::{Error, ErrorKind, Result};
use linkage::trajectory::Channel;
use prover::run::solved::asked;
use scenario::words::suggestion;
use scenario::{Claim, Scenario};

/// The user's words, and the names that messages use for the options with these words.
#[derive(Clone, Debug, Default)]
pub(crate) struct Words {
    /// One text for each chart; empty for the usual charts.
    pub(crate) show: Vec<String>,
    /// Quantity of the horizontal axis: `time`, `crank` or an expression. `None` means the time in a motion under
    /// forces, and the input in any other motion.
    pub(crate) over: Option<String>,
    /// Names of the options for `show` and `over` in messages.
    pub(crate) keys: [&'static str; 2],
}

/// The requested charts of a scenario, with their horizontal axis.
#[derive(Clone, Debug)]
pub(crate) struct Question {
    pub(super) charts: Vec<Chart>,
    pub(super) over: Over,
}

/// Quantity of the horizontal axis.
#[derive(Clone, Debug)]
pub(super) enum Over {
    Time,
    Input,
    Value(Box<Claim>),
}

/// One chart.
#[derive(Clone, Debug)]
pub(super) enum Chart {
    /// Curves over the horizontal axis.
    Curves(Vec<Shown>),
    /// Hodographs: the second component of a vector over its first component.
    Hodograph(Vec<[Claim; 2]>),
    /// Speeds of crank and motor over time.
    RunUp,
    /// Balancing moment from equilibrium minus balancing moment from powers, divided by the largest moment.
    Delta,
}

/// A requested curve; a formula with a claim gives two curves.
#[derive(Clone, Debug)]
pub(super) enum Shown {
    Claim(Box<Claim>),
    /// The formula with this index, and the quantity that it claims.
    Formula(usize),
}

const RUN_UP: &str = "run-up";
const DELTA: &str = "delta";
const REACTIONS: &str = "reactions";
const HODOGRAPH: &str = "hodograph:";
/// Charts if the user names none: angles, angular velocities and angular accelerations of links, reactions, and moments
/// or forces of drives.
const USUAL: [&str; 5] = ["link.*.angle_deg", "link.*.omega_rad_s", "link.*.alpha_rad_s2", "joint.*.f_N", "drive.*"];
/// Vectors of hodographs: kind of subject, word behind the subject's name, and endings of the components.
const VECTORS: [(&str, &str, [&str; 2]); 6] = [
    ("joint.", "", ["fx_N", "fy_N"]),
    ("point.", ".v", ["vx_m_s", "vy_m_s"]),
    ("point.", ".a", ["ax_m_s2", "ay_m_s2"]),
    ("link.", ".v", ["vx_m_s", "vy_m_s"]),
    ("link.", ".a", ["ax_m_s2", "ay_m_s2"]),
    ("point.", "", ["x_mm", "y_mm"]),
];

impl Question {
    /// Reads the charts that the user requests for a scenario.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] with the position of the mistake in the text.
    pub(crate) fn of(words: &Words, scenario: &Scenario) -> Result<Question> {
        let names = Claim::names(&scenario.case);
        let charts = match words.show.is_empty() {
            true => USUAL.iter().filter_map(|glob| usual(glob, scenario, &names)).collect(),
            false => {
                let chart = |text: &String| chart(text, scenario, &names, words.keys[0]);
                words.show.iter().map(chart).collect::<Result<Vec<_>>>()?
            }
        };
        let over = match words.over.as_deref() {
            None if scenario.case.is_free() => Over::Time,
            None | Some("crank") => Over::Input,
            Some("time") => Over::Time,
            Some(text) => {
                let claim =
                    Claim::parse(text, &scenario.case).map_err(|fault| placed(words.keys[1], text, 0, &fault))?;
                Over::Value(Box::new(claim))
            }
        };
        Ok(Question { charts, over })
    }

    /// The channels that a solver has to compute.
    pub(crate) fn channels(&self, scenario: &Scenario) -> Vec<Channel> {
        let case = &scenario.case;
        let mut all: Vec<Channel> = case.input_channels().into_iter().flatten().map(|(channel, _)| channel).collect();
        let mut put = |claim: &Claim| all.extend(asked(claim, case));
        for chart in &self.charts {
            match chart {
                Chart::Curves(shown) => shown.iter().for_each(|own| match own {
                    Shown::Claim(claim) => put(claim),
                    Shown::Formula(index) => scenario.formulas.list[*index].claim.iter().for_each(&mut put),
                }),
                Chart::Hodograph(vectors) => vectors.iter().flatten().for_each(&mut put),
                Chart::RunUp | Chart::Delta => {}
            }
        }
        if let Over::Value(claim) = &self.over {
            put(claim);
        }
        all
    }
}

/// A chart of all names that fit a pattern; `None` if no name fits.
fn usual(glob: &str, scenario: &Scenario, names: &[String]) -> Option<Chart> {
    let shown: Vec<Shown> = names
        .iter()
        .filter(|name| fits(glob, name))
        .filter_map(|name| Some(Shown::Claim(Box::new(Claim::parse(name, &scenario.case).ok()?))))
        .collect();
    (!shown.is_empty()).then_some(Chart::Curves(shown))
}

/// Reads the text of one chart.
fn chart(text: &str, scenario: &Scenario, names: &[String], key: &'static str) -> Result<Chart> {
    let items = items(text);
    let whole = |word: &str, chart: Chart| match items.len() {
        1 => Ok(chart),
        _ => Err(Error::new(ErrorKind::Input, sentences::is_a_chart_of_its_kind(&word))
            .key(key)
            .help(sentences::ASK_FOR_IT_ALONE)),
    };
    if items.iter().any(|(_, item)| *item == RUN_UP) {
        return whole(RUN_UP, Chart::RunUp);
    }
    if items.iter().any(|(_, item)| *item == DELTA) {
        return whole(DELTA, Chart::Delta);
    }
    let (mut shown, mut vectors) = (Vec::new(), Vec::new());
    for (at, item) in items {
        let fault = |fault: FormulaFault| placed(key, text, at, &fault);
        if let Some(subject) = item.strip_prefix(HODOGRAPH) {
            let at_subject = |own: FormulaFault| placed(key, text, at + HODOGRAPH.len(), &own);
            vectors.push(vector(subject, scenario).map_err(at_subject)?);
            continue;
        }
        let glob = if item == REACTIONS { USUAL[3] } else { item };
        let found: Vec<&String> =
            if glob.contains('*') { names.iter().filter(|name| fits(glob, name)).collect() } else { Vec::new() };
        let is_pattern = glob.contains(".*") || glob.contains("*.");
        if found.is_empty() && is_pattern {
            let help = sentences::A_PATTERN_SUCH_AS_JOINT_F_N.into();
            let message = sentences::no_channel_fits(&glob);
            return Err(fault(FormulaFault { message, at: 0..item.len(), help }));
        }
        for name in found.iter().copied() {
            shown.push(Shown::Claim(Box::new(Claim::parse(name, &scenario.case).map_err(fault)?)));
        }
        if found.is_empty() {
            let known = scenario.formulas.list.iter().position(|own| own.name == item);
            shown.push(match known {
                Some(index) => Shown::Formula(index),
                None => Shown::Claim(Box::new(claim(item, scenario).map_err(fault)?)),
            });
        }
    }
    match (shown.is_empty(), vectors.is_empty()) {
        (_, true) => Ok(Chart::Curves(shown)),
        (true, false) => Ok(Chart::Hodograph(vectors)),
        (false, false) => Err(Error::new(ErrorKind::Input, sentences::is_a_chart_of_its_kind(&"hodograph"))
            .key(key)
            .help(sentences::ASK_FOR_IT_ALONE)),
    }
}

/// Reads an expression. A figure of the whole mechanism is refused, because it is a single number.
fn claim(text: &str, scenario: &Scenario) -> std::result::Result<Claim, FormulaFault> {
    let claim = Claim::parse(text, &scenario.case).map_err(|fault| {
        // A single word may be a misspelt name of a formula.
        let names = || scenario.formulas.list.iter().map(|own| own.name.as_str());
        let is_word = text.chars().all(|sign| sign.is_alphanumeric() || sign == '_');
        let is_formula = is_word && names().next().is_some();
        FormulaFault { help: if is_formula { suggestion(text, names(), "`") } else { fault.help.clone() }, ..fault }
    })?;
    match claim.figures.first() {
        None => Ok(claim),
        Some((name, _)) => Err(FormulaFault {
            message: sentences::is_one_number_and_no_curve(&name),
            at: 0..text.len(),
            help: sentences::NAME_CHANNELS_THAT_CHANGE.into(),
        }),
    }
}

/// Reads the vector of a hodograph.
fn vector(text: &str, scenario: &Scenario) -> std::result::Result<[Claim; 2], FormulaFault> {
    let names = Claim::names(&scenario.case);
    let mut first = None;
    for (subject, word, endings) in VECTORS {
        let Some(name) = text.strip_prefix(subject).and_then(|_| text.strip_suffix(word)) else { continue };
        let both = endings.map(|ending| format!("{name}.{ending}"));
        if both.iter().all(|own| names.contains(own)) {
            let [x, y] = both.each_ref().map(|own| Claim::parse(own, &scenario.case));
            return Ok([x?, y?]);
        }
        first = first.or(Some(both[0].clone()));
    }
    let subjects: Vec<String> = VECTORS
        .iter()
        .flat_map(|(_, word, endings)| {
            let ending = format!(".{}", endings[0]);
            names.iter().filter_map(move |name| Some(format!("{}{word}", name.strip_suffix(&ending)?)))
        })
        .collect();
    let help = suggestion(text, subjects.iter().map(String::as_str), "`");
    Err(FormulaFault { message: sentences::there_is_no_vector(&text), at: 0..text.len(), help })
}

/// An error with its position in the text of an option.
fn placed(key: &'static str, text: &str, from: usize, fault: &FormulaFault) -> Error {
    let at = from + fault.at.start..from + fault.at.end;
    scenario::formula::refused(key, text, &FormulaFault { at, ..fault.clone() })
}

/// The pieces of a text between commas outside parentheses, with their positions.
fn items(text: &str) -> Vec<(usize, &str)> {
    let (mut depth, mut from, mut parts) = (0, 0, Vec::new());
    for (at, sign) in text.char_indices().chain([(text.len(), ',')]) {
        match sign {
            '(' => depth += 1,
            ')' => depth -= 1,
            ',' if depth <= 0 || at == text.len() => {
                let part = &text[from..at];
                let trimmed = part.trim_start();
                parts.push((from + part.len() - trimmed.len(), trimmed.trim_end()));
                from = at + 1;
            }
            _ => {}
        }
    }
    parts
}

/// Whether a name fits a pattern in which `*` stands for any letters.
fn fits(pattern: &str, name: &str) -> bool {
    match pattern.split_once('*') {
        None => pattern == name,
        Some((begin, rest)) => name.strip_prefix(begin).is_some_and(|left| {
            let starts = left.char_indices().map(|(at, _)| at).chain([left.len()]);
            starts.into_iter().any(|at| fits(rest, &left[at..]))
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commas_inside_parentheses_do_not_separate() {
        assert_eq!(items("a, atan2(b,c) ,d"), [(0, "a"), (3, "atan2(b,c)"), (15, "d")]);
        assert_eq!(items(""), [(0, "")]);
    }

    #[test]
    fn a_star_stands_for_any_letters() {
        assert!(fits("joint.*.f_N", "joint.A.f_N") && fits("*", "") && fits("a*b*c", "a-b-b-c"));
        assert!(!fits("joint.*.f_N", "joint.A.fx_N") && !fits("a*b", "ac"));
    }
}
