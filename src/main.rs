//! The `linkproof` command. All its work is done in [`linkproof::cli`].

fn main() -> std::process::ExitCode {
    linkproof::cli::main()
}
