//! The `linkproof` command; everything it does stands in [`linkproof::cli`].

fn main() -> std::process::ExitCode {
    linkproof::cli::main()
}
