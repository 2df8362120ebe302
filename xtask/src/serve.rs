//! From a bare machine to a running laboratory: prepare, build the page's module and the server, run it.
//!
//! The server prints its own address. On Unix it replaces this process, so Ctrl-C, SIGTERM and the exit code are its own
//! and a drain is never cut short by a parent that has already gone.

use std::process::Command;

use anyhow::Result;

use crate::workspace::{Workspace, build_server};
use crate::{DistArgs, Purpose, ServeArgs, dist, setup, tools};

pub(crate) fn run(workspace: &Workspace, args: ServeArgs) -> Result<()> {
    setup(workspace, Purpose::Serve)?;
    dist::run(workspace, &DistArgs { debug_info: false })?;
    tools::run(&mut build_server(workspace, &args.profile))?;
    // Not at the root like every other command: `--data runs` means the folder where the user stands.
    let mut server = Command::new(workspace.server_program(&args.profile));
    server.arg("serve").args(args.server_args);
    become_server(server)
}

#[cfg(unix)]
fn become_server(mut server: Command) -> Result<()> {
    use std::os::unix::process::CommandExt;

    // Returns only if the program could not be started.
    let error = server.exec();
    Err(anyhow::Error::new(error).context(format!("cannot start `{}`", tools::describe(&server))))
}

#[cfg(not(unix))]
fn become_server(mut server: Command) -> Result<()> {
    tools::run(&mut server)
}
