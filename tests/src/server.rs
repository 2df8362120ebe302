//! Servers and workers of the binary under test: what they are started with, and starting them again as they were.

use crate::binary;
use crate::process::Process;
use anyhow::{Context, Result, ensure};
use std::ffi::{OsStr, OsString};
use std::ops::{Deref, DerefMut};
use std::path::Path;
use std::process::Command;

/// What a process is started with.
#[derive(Debug, Clone)]
pub struct Launch {
    /// Program and arguments that start the binary, when it is not started itself.
    wrapper: Vec<OsString>,
    bind: String,
    arguments: Vec<OsString>,
    environment: Vec<(OsString, OsString)>,
}

impl Default for Launch {
    fn default() -> Self {
        Self { wrapper: Vec::new(), bind: "127.0.0.1:0".to_owned(), arguments: Vec::new(), environment: Vec::new() }
    }
}

impl Launch {
    /// Plain: a server on a free port of the loopback address.
    pub fn new() -> Self {
        Self::default()
    }

    /// Listens at this address instead; port 0 means any free one.
    pub fn bind(mut self, address: &str) -> Self {
        address.clone_into(&mut self.bind);
        self
    }

    /// With these arguments too.
    pub fn arguments<I: AsRef<OsStr>>(mut self, arguments: impl IntoIterator<Item = I>) -> Self {
        self.arguments.extend(arguments.into_iter().map(|argument| argument.as_ref().to_owned()));
        self
    }

    /// With this variable in its environment.
    pub fn variable(mut self, name: &str, value: &str) -> Self {
        self.environment.push((name.into(), value.into()));
        self
    }

    /// Through a program that is given the binary and its arguments after `words`, and becomes it.
    pub fn through<I: AsRef<OsStr>>(mut self, words: impl IntoIterator<Item = I>) -> Self {
        self.wrapper = words.into_iter().map(|word| word.as_ref().to_owned()).collect();
        self
    }

    /// Starts `adaptarm serve` with a fresh data folder and waits until it listens.
    pub fn serve(self) -> Result<Server> {
        let data = tempfile::tempdir()?;
        let (process, url) = self.start_server(data.path())?;
        Ok(Server { process, url, data, launch: self })
    }

    /// Starts `adaptarm worker` and waits until it is ready.
    pub fn work(self) -> Result<Worker> {
        let process = self.start_worker()?;
        Ok(Worker { process, launch: self })
    }

    fn start_server(&self, data: &Path) -> Result<(Process, String)> {
        let mut command = self.command()?;
        command.args(["serve", "--bind", &self.bind, "--data"]).arg(data).args(&self.arguments);
        let (process, address) =
            Process::start(&mut command, |line| line.split_once("http://").map(|(_, address)| address.to_owned()))
                .context("adaptarm serve")?;
        // Bound to every address, it is reached by the one that every machine has.
        Ok((process, format!("http://{}", address.replace("0.0.0.0", "127.0.0.1"))))
    }

    fn start_worker(&self) -> Result<Process> {
        let mut command = self.command()?;
        command.arg("worker").args(&self.arguments);
        let ready = |line: &str| line.contains("worker is ready").then_some(());
        Ok(Process::start(&mut command, ready).context("adaptarm worker")?.0)
    }

    fn command(&self) -> Result<Command> {
        let words: Vec<OsString> = self.wrapper.iter().cloned().chain([binary()?.into()]).collect();
        let mut command = Command::new(&words[0]);
        command.args(&words[1..]);
        // Settings of whoever runs the tests are not what they test.
        let own = |name: &str| name.starts_with("ADAPTARM_") || name.starts_with("AWS_");
        for (name, _) in std::env::vars_os().filter(|(name, _)| own(&name.to_string_lossy())) {
            command.env_remove(name);
        }
        // A line per request would bury what a failing test says.
        command.env("RUST_LOG", std::env::var_os("RUST_LOG").unwrap_or_else(|| "error".into()));
        command.envs(self.environment.iter().cloned());
        Ok(command)
    }
}

/// A server; it dies with this value.
#[derive(Debug)]
pub struct Server {
    process: Process,
    /// Address, such as `http://127.0.0.1:41234`; the same after a restart.
    pub url: String,
    /// Its data folder; kept over restarts, removed with this value.
    pub data: tempfile::TempDir,
    launch: Launch,
}

impl Server {
    /// Starts `adaptarm serve` on a free port with a fresh data folder and waits for the line that names its address.
    pub fn start(arguments: &[&str]) -> Result<Self> {
        Launch::new().arguments(arguments).serve()
    }

    /// Starts it again at the same address and on the same data, after ending it by SIGKILL if it still runs.
    pub fn restart(&mut self) -> Result<()> {
        self.process.kill()?;
        let port = self.url.rsplit_once(':').context("its address has no port")?.1;
        let host = self.launch.bind.rsplit_once(':').context("its address has no port")?.0;
        self.launch.bind = format!("{host}:{port}");
        (self.process, self.url) = self.launch.start_server(self.data.path())?;
        Ok(())
    }

    /// The same, and from now on started like this.
    pub fn restart_as(&mut self, launch: Launch) -> Result<()> {
        self.launch = Launch { bind: self.launch.bind.clone(), ..launch };
        self.restart()
    }

    /// A new token of this user.
    pub fn token(&self, owner: &str, arguments: &[&str]) -> Result<String> {
        let printed = self.tokens(&[&["create", "--owner", owner], arguments].concat())?;
        let token = printed.trim_end();
        ensure!(token.starts_with("adaptarm_") && !token.contains(char::is_whitespace), "not a token alone: {printed}");
        Ok(token.to_owned())
    }

    /// What `adaptarm token` prints about this server's data.
    pub fn tokens(&self, arguments: &[&str]) -> Result<String> {
        let mut command = Command::new(binary()?);
        let (action, rest) = arguments.split_first().context("no action")?;
        let output = command.args(["token", action, "--data"]).arg(self.data.path()).args(rest).output()?;
        ensure!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        Ok(String::from_utf8(output.stdout)?)
    }
}

/// A worker; it dies with this value.
#[derive(Debug)]
pub struct Worker {
    process: Process,
    launch: Launch,
}

impl Worker {
    /// Starts it again as it was, after ending it by SIGKILL if it still runs.
    pub fn restart(&mut self) -> Result<()> {
        self.process.kill()?;
        self.process = self.launch.start_worker()?;
        Ok(())
    }
}

impl Deref for Server {
    type Target = Process;

    fn deref(&self) -> &Process {
        &self.process
    }
}

impl DerefMut for Server {
    fn deref_mut(&mut self) -> &mut Process {
        &mut self.process
    }
}

impl Deref for Worker {
    type Target = Process;

    fn deref(&self) -> &Process {
        &self.process
    }
}

impl DerefMut for Worker {
    fn deref_mut(&mut self) -> &mut Process {
        &mut self.process
    }
}
