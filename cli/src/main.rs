//! The binary `caveat`: hands its arguments to [`cli::run`].

use mimalloc::MiMalloc;

/// Search makes and drops very many small things.
#[global_allocator]
static ALLOCATOR: MiMalloc = MiMalloc;

fn main() -> std::process::ExitCode {
    cli::run(std::env::args_os())
}
