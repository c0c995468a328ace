//! The binary `caveat`: hands its arguments to [`cli::run`].

fn main() -> std::process::ExitCode {
    cli::run(std::env::args_os())
}
