//! Catalogue files: lists of motors to choose from.

use crate::sentences;
use std::path::Path;

use crate::drive::motor::CatalogueMotor;
use linkage::error::{Error, ErrorKind, Result};
use scenario::header::check_format;
use scenario::reader::{Sign, TomlTable};
use scenario::source::Source;
use scenario::unit::{ANGULAR_SPEED, INERTIA, POWER};

/// Reads the motors of a catalogue file, in the file's order.
///
/// # Errors
/// [`ErrorKind::Io`] if the file cannot be read.
/// [`ErrorKind::Input`] for an invalid entry. The error states the entry's position.
pub fn load(path: &Path) -> Result<Vec<CatalogueMotor>> {
    let text = files::read_text(path).map_err(|error| {
        Error::new(ErrorKind::Io, sentences::the_catalogue_cannot_be_read(&path.display(), &error))
            .help(files::way_out(&error, sentences::GIVE_THE_PATH_OF_A_CATALOGUE))
    })?;
    let source = Source::new(path, &text);
    let tree = source.tree()?;
    read(&mut TomlTable::root(&source, &tree)).map_err(|error| source.located(tree.get_ref(), error))
}

fn read(root: &mut TomlTable) -> Result<Vec<CatalogueMotor>> {
    check_format(root)?;
    root.optional_string("source")?;
    let motors = root.tables("motors")?.into_iter().map(motor).collect::<Result<Vec<_>>>()?;
    root.finish()?;
    if motors.is_empty() {
        return Err(root
            .fault(sentences::THE_CATALOGUE_HOLDS_NO_MOTOR)
            .key("motors")
            .help(sentences::ADD_A_TABLE_MOTORS_FOR_EACH));
    }
    Ok(motors)
}

fn motor(mut table: TomlTable) -> Result<CatalogueMotor> {
    let name = table.string("name")?;
    let power = table.quantity("power", &POWER, Sign::Positive)?;
    let rated_speed = table.quantity("rated_speed", &ANGULAR_SPEED, Sign::Positive)?;
    let synchronous_speed = table.quantity("synchronous_speed", &ANGULAR_SPEED, Sign::Positive)?;
    let breakdown = table.optional_number("breakdown_ratio")?;
    let rotor = table.optional_quantity("rotor_inertia", &INERTIA, Sign::NotNegative)?;
    if !(rated_speed < synchronous_speed) {
        let message = sentences::THE_RATED_SPEED_IS_NOT_BELOW;
        return table.refuse("rated_speed", message, sentences::CHECK_THE_TWO_SPEEDS_AND_THEIR);
    }
    if breakdown.is_some_and(|ratio| ratio <= 1.0) {
        let message = sentences::THE_BREAKDOWN_TORQUE_IS_NOT_ABOVE;
        return table.refuse("breakdown_ratio", message, sentences::GIVE_BREAKDOWN_TORQUE_OVER_RATED);
    }
    table.finish()?;
    Ok(CatalogueMotor { name, power, rated_speed, synchronous_speed, breakdown, rotor })
}
