//! Catalogue files: motors to choose from.

use std::path::Path;

use crate::motor::CatalogueMotor;
use linkage::error::{Error, ErrorKind, Result};
use scenario::header::check_format;
use scenario::reader::{Sign, Table};
use scenario::source::Source;
use scenario::unit::{ANGULAR_SPEED, POWER};

/// Reads the motors of a catalogue file, in its order.
///
/// # Errors
/// [`ErrorKind::Io`] if the file cannot be read, [`ErrorKind::Input`] for anything wrong in it, with the place.
pub fn load(path: &Path) -> Result<Vec<CatalogueMotor>> {
    let text = files::read_text(path).map_err(|error| {
        Error::new(ErrorKind::Io, format!("the catalogue {} cannot be read: {error}", path.display()))
            .help(files::way_out(&error, "give the path of a catalogue of motors, such as catalogues/motors.toml"))
    })?;
    let source = Source::new(path, &text);
    let tree = source.tree()?;
    read(&mut Table::root(&source, &tree)).map_err(|error| source.located(tree.get_ref(), error))
}

fn read(root: &mut Table) -> Result<Vec<CatalogueMotor>> {
    check_format(root)?;
    root.optional_string("source")?;
    let motors = root.tables("motors")?.into_iter().map(motor).collect::<Result<Vec<_>>>()?;
    root.finish()?;
    if motors.is_empty() {
        return Err(root.fault("the catalogue holds no motor").key("motors").help("add a table `[[motors]]` for each"));
    }
    Ok(motors)
}

fn motor(mut table: Table) -> Result<CatalogueMotor> {
    let name = table.string("name")?;
    let power = table.quantity("power", &POWER, Sign::Positive)?;
    let rated_speed = table.quantity("rated_speed", &ANGULAR_SPEED, Sign::Positive)?;
    let synchronous_speed = table.quantity("synchronous_speed", &ANGULAR_SPEED, Sign::Positive)?;
    let breakdown = table.optional_number("breakdown_ratio")?;
    if !(rated_speed < synchronous_speed) {
        let message = "the rated speed is not below the synchronous one";
        return Err(table.wrong(ErrorKind::Input, "rated_speed", message).help("check the two speeds and their units"));
    }
    if breakdown.is_some_and(|ratio| ratio <= 1.0) {
        let message = "the breakdown torque is not above the rated one";
        let help = "give breakdown torque over rated torque, 2 to 3 as a rule, or leave it out";
        return Err(table.wrong(ErrorKind::Input, "breakdown_ratio", message).help(help));
    }
    table.finish()?;
    Ok(CatalogueMotor { name, power, rated_speed, synchronous_speed, breakdown })
}
