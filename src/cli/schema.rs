//! `linkproof schema`.

use std::path::PathBuf;

use super::output;
use crate::report::schema;
use linkage::error::Result;

#[derive(Debug, clap::Args)]
#[command(after_help = include_str!("help/schema.txt").trim_ascii_end())]
pub(super) struct Args {
    /// Write the schema to this file
    #[arg(short, long, value_name = "FILE", default_value = "-", value_parser = output::target)]
    output: PathBuf,
}

pub(super) fn schema(args: &Args) -> Result<()> {
    output::write(&schema::scenario(), &args.output)
}
