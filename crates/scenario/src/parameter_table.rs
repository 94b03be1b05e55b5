//! `[parameters]`: parameters as a file states them.

use super::numbers::is_path;
use super::parameters::{Parameter, Parameters, fault_of_name};
use super::reader::TomlTable;
use super::words::suggestion;
use crate::sentences;
use linkage::error::{Error, ErrorKind, Result};

/// Reads the section `[parameters]`. Numbers in `set` replace numbers of the file. If `may_add` is true, keys that the
/// file does not have are added.
/// A parameter with a mistake is left out. Of all mistakes in the section, only the first is returned, because it may
/// cause the later ones.
///
/// # Errors
/// Mistakes in `set`.
pub(super) fn read(
    table: Option<TomlTable>,
    set: &[(String, f64)],
    may_add: bool,
) -> Result<(Parameters, Option<Error>)> {
    let mut parameters = Parameters::default();
    let mut first = None;
    if let Some(mut table) = table {
        for key in table.keys() {
            match own(&mut table, &key, &parameters) {
                Ok(parameter) => {
                    parameters.push(parameter);
                    // The new value must be set here, because later parameters may be computed from this parameter.
                    set.iter().filter(|(own, _)| *own == key).for_each(|(_, value)| {
                        parameters.set(&key, *value);
                    });
                }
                Err(error) => first = first.or(Some(error)),
            }
        }
        if let (Err(error), None) = (table.finish(), &first) {
            first = Some(error);
        }
    }
    for (key, value) in set.iter().filter(|(key, _)| !is_path(key)) {
        let wrong = |message: String| Error::new(ErrorKind::Input, message).key("parameters");
        let parameter = Parameter::new(key, *value);
        if let Some((message, help)) = parameter.names().find_map(|(name, _)| fault_of_name(name)) {
            return Err(wrong(message).help(help));
        }
        if parameters.set(key, *value) {
            continue;
        }
        if !may_add && first.is_none() {
            let keys = parameters.list().iter().map(|own| own.key.as_str());
            return Err(wrong(sentences::the_scenario_has_no_parameter(&key)).help(suggestion(key, keys, "`")));
        } else if let Some((message, _)) = twice(&parameters, &parameter) {
            return Err(wrong(message).help(sentences::SET_THE_PARAMETER_WITH_THE_UNIT));
        } else {
            parameters.push(parameter);
        }
    }
    Ok((parameters, first))
}

/// The parameter of a key. `before` are the parameters that have been read already.
fn own(table: &mut TomlTable, key: &str, before: &Parameters) -> Result<Parameter> {
    let parameter = Parameter::new(key, table.number_with(key, before)?);
    let faulty = parameter.names().find_map(|(name, _)| fault_of_name(name));
    match faulty.or_else(|| twice(before, &parameter)) {
        Some((message, help)) => table.refuse(key, message, help),
        None => Ok(parameter),
    }
}

/// Message and help, if another parameter already has one of the parameter's names.
fn twice(others: &Parameters, parameter: &Parameter) -> Option<(String, &'static str)> {
    let (name, other) = parameter.names().find_map(|(name, _)| Some((name, others.called(name)?)))?;
    let message = sentences::would_stand_for_and_for(&name, &other.key, &parameter.key);
    Some((message, sentences::KEEP_ONE_OF_THE_TWO_OR_CALL))
}
