//! `[engine]`: engines by name, and their settings. Files and arguments pass the settings to the proof.
//! A setting that is not given is free: the program chooses its value.
//!
//! [`ROWS`] is the only definition of a setting. Reader, writer and argument follow from a setting's row.
//! Schema and documents follow from the setting's key in [`SECTIONS`].

use crate::sentences;
use std::fmt;
use std::ops::RangeInclusive;

use super::keys::key::{Section, ValueKind, optional};
use super::reader::{Sign, TomlTable};
use super::setting::EngineSetting;
use linkage::drive::Drive;
use linkage::engine::{Engine, Route, Settings};
use linkage::error::{ErrorKind, Result};
use linkage::input::Input;

linkage::words! {
    /// An engine by name.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
    pub enum EngineName: name {
        /// Rapier in f64, the default: a spanning tree as a multibody, loops closed by impulse joints.
        Rapier = "rapier",
        /// The engine `rapier` in single precision; needs the feature `f32`.
        RapierF32 = "rapier-f32",
        /// Rapier in f64, every link as a separate rigid body.
        Impulse = "impulse",
        /// The engine `impulse` in single precision; needs the feature `f32`.
        ImpulseF32 = "impulse-f32",
        /// Simbody; needs the feature `simbody`, and the library.
        Simbody = "simbody",
    }
}

impl EngineName {
    /// Cargo feature that adds the engine to a build. `None` if every build contains the engine.
    #[must_use]
    pub fn feature(self) -> Option<&'static str> {
        match self {
            EngineName::Rapier | EngineName::Impulse => None,
            EngineName::RapierF32 | EngineName::ImpulseF32 => Some("f32"),
            EngineName::Simbody => Some("simbody"),
        }
    }
}

impl fmt::Display for EngineName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

macro_rules! settings {
    ($($(#[$doc:meta])* $name:ident: $kind:ty,)*) => {
        /// Engines and their settings. A setting that is not given is free.
        #[derive(Clone, Debug, Default, PartialEq)]
        pub struct EngineSettings {
            $($(#[$doc])* pub $name: EngineSetting<$kind>,)*
        }

        impl EngineSettings {
            /// These settings. Each free setting is replaced by the corresponding setting of `other`.
            #[must_use]
            pub fn or(&self, other: &EngineSettings) -> Self {
                EngineSettings { $($name: self.$name.or(&other.$name).clone(),)* }
            }
        }
    };
}

settings! {
    /// Engines of the proof.
    engines: Vec<EngineName>,
    /// Time step (s) of engines with a fixed step.
    step: f64,
    /// Relative accuracy of engines that control their error.
    accuracy: f64,
    /// Number of sweeps over the constraints in a step.
    sweeps: usize,
    /// Number of parts into which an engine divides a step.
    substeps: usize,
    /// Method by which reactions and balancing moment are computed.
    route: Route,
    /// Number of extrapolations of the state to step size zero. With one extrapolation, a run at the given step size
    /// and a run at half the given step size are combined.
    extrapolated: usize,
}

/// Mutable access to a setting, by kind of value.
#[derive(Debug)]
pub enum Slot<'a> {
    /// Engines by name.
    Engines(&'a mut EngineSetting<Vec<EngineName>>),
    /// A number greater than zero.
    Positive(&'a mut EngineSetting<f64>),
    /// A whole number greater than zero.
    Count(&'a mut EngineSetting<usize>),
    /// A route.
    Route(&'a mut EngineSetting<Route>),
    /// A number of extrapolations.
    Times(&'a mut EngineSetting<usize>),
}

/// Names and meaning of a setting.
#[derive(Debug)]
pub struct SettingRow {
    /// Key of the setting in [`SECTIONS`]; the first key, if two keys can state the setting. `None` if no file can
    /// state the setting.
    pub key: Option<&'static str>,
    /// Command-line argument of the setting.
    pub argument: &'static str,
    /// Name of the argument's value in the help.
    pub value: &'static str,
    /// Description of the argument in the help.
    pub help: &'static str,
    /// Returns the place of the setting in the engine's settings.
    pub slot: fn(&mut EngineSettings) -> Slot<'_>,
}

/// Upper limit of the number of extrapolations. More extrapolations need steps that are too fine to run.
pub const MOST_TIMES: usize = 8;

/// All settings.
pub const ROWS: &[SettingRow] = &[
    row(Some("dt"), ["dt", "S", sentences::TIME_STEP_OF_THE_ENGINE_IN_SECONDS], |own| Slot::Positive(&mut own.step)),
    row(Some("name"), ["engine", "ENGINE", sentences::ENGINE_OR_ALL_TO_RUN_EVERY_ONE_SIDE], |own| {
        Slot::Engines(&mut own.engines)
    }),
    row(None, ["accuracy", "ACCURACY", sentences::RELATIVE_ACCURACY_OF_AN_ENGINE], |own| {
        Slot::Positive(&mut own.accuracy)
    }),
    row(Some("sweeps"), ["sweeps", "N", sentences::SWEEPS_OF_THE_ENGINE_ITERATION], |own| Slot::Count(&mut own.sweeps)),
    row(Some("substeps"), ["substeps", "N", sentences::NUMBER_OF_SUBSTEPS_INTO_WHICH_THE_ENGINE], |own| {
        Slot::Count(&mut own.substeps)
    }),
    row(Some("route"), ["route", "ROUTE", sentences::ROUTE_BY_WHICH_REACTIONS_AND_BALANCING], |own| {
        Slot::Route(&mut own.route)
    }),
    row(Some("extrapolated"), ["extrapolate", "TIMES", sentences::COMBINE_RUNS_AT_THE_STEP], |own| {
        Slot::Times(&mut own.extrapolated)
    }),
];

/// Creates a row from its key, its three texts, and the function that returns its slot.
const fn row(
    key: Option<&'static str>,
    [argument, value, help]: [&'static str; 3],
    slot: fn(&mut EngineSettings) -> Slot<'_>,
) -> SettingRow {
    SettingRow { key, argument, value, help, slot }
}

/// Descriptions of the keys that this module reads, in the order of the rows.
pub const SECTIONS: &[Section] = &[Section::at("engine").with(&[
    optional("dt", ValueKind::TIMES.of(Sign::Positive), "found by `run`")
        .means("time step of engines with a fixed step; at most one of `dt` and `step`"),
    optional("step", ValueKind::ANGLES.of(Sign::NotZero), "found by `run`")
        .means("the time step, given as the crank rotation in one step"),
    optional("name", ValueKind::Text, "the first engine").means("engine to use unless another is requested"),
    optional("sweeps", ValueKind::Integer, "found by `run`").means("sweeps of the engine's iteration in a step"),
    optional("substeps", ValueKind::Integer, "the engine's default")
        .means("number of parts into which the engine itself divides a step"),
    optional(
        "route",
        ValueKind::Choice(|| Route::ALL.map(Route::name).to_vec()),
        "the engine's default; the forces that the engine itself exerts are judged too",
    )
    .means("how reactions and balancing moment are obtained"),
    optional("extrapolated", ValueKind::IntegerOrBoolean, "found by `run`; 0 if the step is given").means(
        "a number N from 0 to 8: runs at the step, at half the step, ..., at the step divided by 2^N are \
         combined, so that the N leading errors cancel; `true` is 1, `false` is 0",
    ),
])];

impl EngineSettings {
    /// All settings of an engine, marked as given.
    #[must_use]
    pub fn exactly(engine: &dyn Engine) -> Self {
        let Settings { resolution, sweeps, substeps, route, extrapolated } = engine.settings();
        let is_stepped = !engine.controls_error();
        EngineSettings {
            engines: EngineSetting::from(EngineName::named(engine.name()).map(|name| vec![name])),
            step: EngineSetting::from(is_stepped.then_some(resolution)),
            accuracy: EngineSetting::from((!is_stepped).then_some(resolution)),
            sweeps: EngineSetting::from((sweeps > 0).then_some(sweeps)),
            substeps: EngineSetting::from(is_stepped.then_some(substeps)),
            route: EngineSetting::of(route),
            extrapolated: EngineSetting::from(is_stepped.then_some(extrapolated)),
        }
    }

    /// These settings, prepared for a search of the settings that are free.
    /// Extrapolation would use steps finer than a given step. If the step is given, extrapolation is therefore off by
    /// default.
    #[must_use]
    pub fn of_motion(mut self) -> Self {
        if !self.step.is_free() && self.extrapolated.is_free() {
            self.extrapolated = EngineSetting::of(0);
        }
        self
    }

    /// Whether a setting that a search could choose is free.
    #[must_use]
    pub fn leaves_a_choice(&self) -> bool {
        self.step.is_free() || self.sweeps.is_free() || self.extrapolated.is_free()
    }
}

/// Reads the settings of the section.
pub fn read(table: &mut TomlTable, drive: &Drive) -> Result<EngineSettings> {
    let mut own = EngineSettings::default();
    let (time, angle) = (table.optional_si("dt")?, table.optional_si("step")?);
    for row in ROWS {
        let Some(key) = row.key else { continue };
        match (row.slot)(&mut own) {
            // The step has two keys, which are read above, so nothing is read here.
            Slot::Positive(_) => {}
            Slot::Engines(engines) => {
                let engine = table.optional_choice(
                    key,
                    sentences::IS_NO_ENGINE,
                    &EngineName::ALL.map(|own| (own.name(), own)),
                )?;
                *engines = table.given(key, engine.map(|engine| vec![engine]));
            }
            Slot::Count(number) => *number = whole(table, key, 1..=usize::MAX)?,
            Slot::Route(route) => {
                let found = table.optional_choice(
                    key,
                    sentences::IS_NO_ROUTE_TO_REACTIONS,
                    &Route::ALL.map(|own| (own.name(), own)),
                )?;
                *route = table.given(key, found);
            }
            Slot::Times(times) if table.is_boolean(key) => {
                let found = table.optional_boolean(key)?.map(usize::from);
                *times = table.given(key, found);
            }
            Slot::Times(times) => *times = whole(table, key, 0..=MOST_TIMES)?,
        }
    }
    table.finish()?;
    let omega = drive.top_speed();
    if let (Some(_), Input::Slide) = (angle, drive.input) {
        return table.refuse("step", sentences::THE_STEP_IS_AN_ANGLE_BUT, sentences::GIVE_THE_TIME_STEP_OF_THE_ENGINE);
    }
    own.step = match (time, angle) {
        (Some(dt), None) => table.given("dt", Some(dt)),
        (None, Some(angle)) => table.given("step", Some((angle / omega).abs())),
        (Some(_), Some(_)) => {
            return table.refuse("step", sentences::THE_ENGINE_STEP_IS_GIVEN, sentences::KEEP_EITHER_DT_A_TIME_OR_STEP);
        }
        (None, None) => EngineSetting::Free,
    };
    match own.step.get() {
        Some(dt) if !(dt.is_finite() && dt > 0.0) => {
            let error = table.fault(sentences::the_engine_step_would_be(&dt));
            Err(error.help(sentences::CHECK_THE_STEP_AND_DRIVE))
        }
        _ => Ok(own),
    }
}

/// A whole number within `range`.
/// The message for a number outside `range` depends on the upper limit of `range`.
/// Without an upper limit, the message says that an engine needs at least one.
/// With an upper limit, the message is about the number of extrapolations.
fn whole(table: &mut TomlTable, key: &str, range: RangeInclusive<usize>) -> Result<EngineSetting<usize>> {
    let Some(number) = table.optional_integer(key)? else { return Ok(EngineSetting::Free) };
    if let Some(count) = usize::try_from(number).ok().filter(|count| range.contains(count)) {
        return Ok(table.given(key, Some(count)));
    }
    let (message, help) = match *range.end() {
        usize::MAX => (sentences::found_but_an_engine_needs(&number), sentences::GIVE_A_WHOLE_NUMBER_GREATER.into()),
        most => (sentences::found_extrapolations(&number), sentences::give_a_whole_number_from_to_or_true(&most)),
    };
    let error = table.wrong(ErrorKind::Input, key, message);
    table.instead(EngineSetting::Free, error.help(help))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Scenario, SettingOrigin};

    fn with(section: &str) -> Result<Scenario> {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenarios/pendulum.toml");
        let Scenario { text, path, .. } = Scenario::load(path).unwrap();
        Scenario::parse(&text.replacen("[grid]", &format!("[engine]\n{section}\n[grid]"), 1), &path)
    }

    #[test]
    fn a_setting_keeps_the_line_of_its_key() {
        let given = with("substeps = 2\nroute = \"native\"").unwrap().engine;
        let EngineSetting::Given(Route::Native, SettingOrigin::Key(key, place)) = &given.route else {
            panic!("{given:?}")
        };
        assert_eq!((key.as_str(), &place.text[place.span.clone()]), ("engine.route", "\"native\""));
        assert!(given.step.is_free() && given.substeps.get() == Some(2));
    }

    #[test]
    fn a_misspelt_engine_or_route_is_refused_with_suggestions() {
        for (section, key, near) in
            [("name = \"rapir\"", "engine.name", "rapier"), ("route = \"natve\"", "engine.route", "native")]
        {
            let error = with(section).unwrap_err();
            let place = error.place().unwrap();
            assert_eq!(
                (error.scenario_key(), &place.text[place.span.clone()]),
                (Some(key), &section[section.find('"').unwrap()..])
            );
            let help = error.way_out().unwrap();
            assert!(help.starts_with(&format!("did you mean \"{near}\"? allowed here: ")), "{help}");
        }
    }

    #[test]
    fn requested_settings_override_those_of_the_file() {
        let file = EngineSettings {
            sweeps: EngineSetting::of(7),
            substeps: EngineSetting::of(2),
            ..EngineSettings::default()
        };
        let asked = EngineSettings { sweeps: EngineSetting::of(9), ..EngineSettings::default() };
        let both = asked.or(&file);
        assert_eq!((both.sweeps.get(), both.substeps.get(), both.step.get()), (Some(9), Some(2), None));
    }

    #[test]
    fn a_given_step_fixes_the_extrapolation() {
        let given = EngineSettings { step: EngineSetting::of(1e-3), ..EngineSettings::default() }.of_motion();
        assert!(!given.extrapolated.is_free() && given.leaves_a_choice());
        assert!(EngineSettings::default().of_motion().extrapolated.is_free());
    }
}
