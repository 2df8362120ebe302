//! A cluster of PostgreSQL for one test run: in a folder of its own, as durable as by default, stopped with its value.

use crate::client::surely;
use crate::machine;
use anyhow::{Context, Result, ensure};
use std::fs::File;
use std::net::TcpListener;
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

/// The administrator that Debian's package makes. PostgreSQL refuses to run as root.
const USER: &str = "postgres";

const PATIENCE: Duration = Duration::from_mins(1);

/// A running cluster. Anyone on this machine may connect to it, so nothing of value belongs in it.
#[derive(Debug)]
pub struct Cluster {
    folder: tempfile::TempDir,
    programs: PathBuf,
    port: u16,
    postmaster: Option<Child>,
}

impl Cluster {
    /// Makes a cluster and starts it on a free port of the loopback address.
    pub fn start() -> Result<Self> {
        let programs = machine::postgres_programs().context("ADAPTARM_POSTGRES names no programs of PostgreSQL")?;
        let folder = tempfile::Builder::new().prefix("postgres").tempdir()?;
        let port = TcpListener::bind("127.0.0.1:0")?.local_addr()?.port();
        if machine::is_root() {
            ensure!(Command::new("chown").arg(USER).arg(folder.path()).status()?.success(), "there is no user {USER}");
        }
        let mut cluster = Self { folder, programs, port, postmaster: None };
        let mut initdb = cluster.program("initdb");
        initdb.args(["--auth=trust", "--encoding=UTF8", "--no-locale"]).args(["--username", USER]);
        let made = initdb.arg("--pgdata").arg(cluster.data()).output()?;
        ensure!(made.status.success(), "initdb: {}", String::from_utf8_lossy(&made.stderr));
        cluster.resume()?;
        Ok(cluster)
    }

    /// Makes a new database; its address.
    pub fn database(&self, name: &str) -> Result<String> {
        self.query("postgres", &format!("CREATE DATABASE \"{name}\""))?;
        Ok(format!("postgres://{USER}@127.0.0.1:{}/{name}", self.port))
    }

    /// What a statement gives, one line per row.
    pub fn query(&self, database: &str, statement: &str) -> Result<String> {
        let mut psql = self.program("psql");
        psql.args(["--no-psqlrc", "--quiet", "--tuples-only", "--no-align", "--host", "127.0.0.1"]);
        psql.args(["--port", &self.port.to_string(), "--username", USER, "--dbname", database, "--command", statement]);
        let output = psql.output()?;
        ensure!(output.status.success(), "{statement}: {}", String::from_utf8_lossy(&output.stderr));
        Ok(String::from_utf8(output.stdout)?.trim().to_owned())
    }

    /// Shuts down at once, as if it had crashed: connections break off, and the next start recovers from the log.
    pub fn crash(&mut self) -> Result<()> {
        self.stop("QUIT")
    }

    /// Starts it again.
    pub fn resume(&mut self) -> Result<()> {
        let log = File::options().create(true).append(true).open(self.folder.path().join("log"))?;
        let mut postgres = self.program("postgres");
        postgres.arg("-D").arg(self.data()).args(["-p", &self.port.to_string(), "-c", "listen_addresses=127.0.0.1"]);
        postgres.arg("-k").arg(self.folder.path()).stdin(Stdio::null()).stdout(log.try_clone()?).stderr(log);
        self.postmaster = Some(postgres.spawn()?);
        surely(PATIENCE, || Ok(self.query("postgres", "SELECT 1").ok())).context("PostgreSQL does not answer")?;
        Ok(())
    }

    fn stop(&mut self, signal: &str) -> Result<()> {
        let Some(mut postmaster) = self.postmaster.take() else { return Ok(()) };
        Command::new("kill").args([&format!("-{signal}"), &postmaster.id().to_string()]).status()?;
        postmaster.wait()?;
        Ok(())
    }

    fn data(&self) -> PathBuf {
        self.folder.path().join("data")
    }

    /// One of its programs, as a user that it accepts; signals reach it, because whatever starts it becomes it.
    fn program(&self, name: &str) -> Command {
        let path = self.programs.join(name);
        let mut command = if machine::is_root() {
            let mut command = Command::new("setpriv");
            command.args(["--reuid", USER, "--regid", USER, "--init-groups"]).arg(path);
            command
        } else {
            Command::new(path)
        };
        // It warns about a current folder that it may not read.
        command.current_dir(self.folder.path());
        command
    }
}

impl Drop for Cluster {
    fn drop(&mut self) {
        // Nobody needs its data any more.
        let _ = self.stop("QUIT");
    }
}
