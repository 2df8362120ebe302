//! One process of the binary: signals, memory, time on the processor, how it ended. It dies with its value.

use anyhow::{Context, Result, bail, ensure};
use std::fs;
use std::io::{BufRead, BufReader};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Longest that a line is waited for.
const PATIENCE: Duration = Duration::from_secs(30);

/// A running process.
#[derive(Debug)]
pub struct Process {
    child: Child,
    /// Lines of its standard output after the one that said it was ready.
    said: Arc<Mutex<Vec<String>>>,
}

impl Process {
    /// Starts `command` and waits for the line of its standard output in which `find` finds what was waited for.
    pub fn start<T>(command: &mut Command, find: impl Fn(&str) -> Option<T>) -> Result<(Self, T)> {
        let mut child = command.stdin(Stdio::null()).stdout(Stdio::piped()).spawn()?;
        let mut output = BufReader::new(child.stdout.take().context("the process has no standard output")?);
        let mut process = Self { child, said: Arc::default() };
        let mut line = String::new();
        while output.read_line(&mut line)? > 0 {
            if let Some(found) = find(line.trim()) {
                // Nothing may block the process by not reading what it prints.
                let said = Arc::clone(&process.said);
                std::thread::spawn(move || {
                    for line in output.lines().map_while(Result::ok) {
                        said.lock().unwrap_or_else(PoisonError::into_inner).push(line);
                    }
                });
                return Ok((process, found));
            }
            line.clear();
        }
        bail!("it ended before it was ready: {}", process.child.wait()?);
    }

    /// What `find` finds in a line that it prints once it is ready; waits for the line.
    pub fn said<T>(&self, find: impl Fn(&str) -> Option<T>) -> Result<T> {
        let deadline = Instant::now() + PATIENCE;
        while Instant::now() < deadline {
            let said = self.said.lock().unwrap_or_else(PoisonError::into_inner);
            if let Some(found) = said.iter().find_map(|line| find(line)) {
                return Ok(found);
            }
            drop(said);
            std::thread::sleep(Duration::from_millis(10));
        }
        bail!("it does not say what is waited for");
    }

    /// Process identifier.
    pub fn id(&self) -> u32 {
        self.child.id()
    }

    /// Sends a signal by its short name, such as `TERM`.
    pub fn signal(&self, name: &str) -> Result<()> {
        let sent = Command::new("kill").args([&format!("-{name}"), &self.id().to_string()]).status()?;
        ensure!(sent.success(), "cannot send SIG{name}");
        Ok(())
    }

    /// SIGKILL, as the kernel does when memory runs out; returns once it is gone.
    pub fn kill(&mut self) -> Result<()> {
        self.child.kill()?;
        self.child.wait()?;
        Ok(())
    }

    /// SIGSTOP: it stands still, and does not know.
    pub fn freeze(&self) -> Result<()> {
        self.signal("STOP")
    }

    /// SIGCONT: it goes on as if no time had passed.
    pub fn thaw(&self) -> Result<()> {
        self.signal("CONT")
    }

    /// SIGTERM, and how it ended.
    pub fn terminate(&mut self, within: Duration) -> Result<ExitStatus> {
        self.signal("TERM")?;
        self.wait(within)
    }

    /// How it ended, if it has.
    pub fn ended(&mut self) -> Result<Option<ExitStatus>> {
        Ok(self.child.try_wait()?)
    }

    /// How it ended, once it has, which must be within this time.
    pub fn wait(&mut self, within: Duration) -> Result<ExitStatus> {
        let deadline = Instant::now() + within;
        while Instant::now() < deadline {
            if let Some(status) = self.ended()? {
                return Ok(status);
            }
            std::thread::sleep(Duration::from_millis(10));
        }
        bail!("process {} still runs after {within:?}", self.id());
    }

    /// Memory that it occupies now, bytes.
    pub fn memory_bytes(&self) -> Result<u64> {
        self.status_bytes("VmRSS:")
    }

    /// The most memory that it has ever occupied, bytes.
    pub fn peak_memory_bytes(&self) -> Result<u64> {
        self.status_bytes("VmHWM:")
    }

    fn status_bytes(&self, field: &str) -> Result<u64> {
        let status = fs::read_to_string(format!("/proc/{}/status", self.id()))?;
        let line = status.lines().find_map(|line| line.strip_prefix(field));
        let kilobytes = line.and_then(|line| line.trim().strip_suffix(" kB")).context("no such field in its status")?;
        Ok(kilobytes.parse::<u64>()? * 1024)
    }

    /// Time that its threads have spent on processors.
    pub fn processor_time(&self) -> Result<Duration> {
        /// Linux counts for programs in this unit on every architecture, whatever its own clock is.
        const TICK: Duration = Duration::from_millis(10);
        let stat = fs::read_to_string(format!("/proc/{}/stat", self.id()))?;
        // The name before the last parenthesis may hold anything; user and system time are fields 14 and 15.
        let (_, fields) = stat.rsplit_once(") ").context("its stat has no name")?;
        let fields: Vec<&str> = fields.split(' ').collect();
        let ticks = fields[11].parse::<u32>()? + fields[12].parse::<u32>()?;
        Ok(TICK * ticks)
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        // It may have ended already, by a test's own doing.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
