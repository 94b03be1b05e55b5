//! `linkproof schema`.

use std::path::PathBuf;

use super::output;
use crate::report::schema;
use linkage::error::Result;

const EXAMPLES: &str = "\
Examples:
  linkproof schema                             to standard output
  linkproof schema -o scenario.schema.json     to a file
An editor with Taplo (Even Better TOML) completes and checks keys of a scenario that begins with
  #:schema scenario.schema.json";

#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Args {
    /// Write the schema to this file
    #[arg(short, long, value_name = "FILE", default_value = "-", value_parser = output::target)]
    output: PathBuf,
}

pub(super) fn schema(args: &Args) -> Result<()> {
    output::write(&schema::scenario(), &args.output)
}
