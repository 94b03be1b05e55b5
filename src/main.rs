//! The `linkproof` command. The code of the command is in [`linkproof::cli`].

fn main() -> std::process::ExitCode {
    linkproof::cli::main()
}
