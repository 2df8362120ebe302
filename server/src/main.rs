//! The `adaptarm` program: hands over to the library and turns its answer into an exit code.

use mimalloc::MiMalloc;
use std::process::ExitCode;

#[global_allocator]
static ALLOCATOR: MiMalloc = MiMalloc;

fn main() -> ExitCode {
    adaptarm::commands::main()
}
