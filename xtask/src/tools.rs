//! Spawning other programs: find them, run them, read their output, bound their time, show how to repeat them.
//!
//! Cargo's own variables for this program never reach a child: see [`is_inherited_from_cargo`].

use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use anyhow::{Context, Result, bail};

/// Cargo as it started us, so that every step uses the same toolchain.
pub(crate) fn cargo() -> Command {
    let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    for (name, _) in std::env::vars_os() {
        if is_inherited_from_cargo(&name.to_string_lossy()) {
            command.env_remove(name);
        }
    }
    command
}

/// What `cargo run` told this program about itself, which is false of any other package.
pub(crate) fn is_inherited_from_cargo(name: &str) -> bool {
    ["CARGO_PKG_", "CARGO_MANIFEST_", "CARGO_BIN_", "CARGO_CRATE_"].iter().any(|prefix| name.starts_with(prefix))
        || name == "CARGO_PRIMARY_PACKAGE"
}

/// Runs to the end with our terminal; anything but success is an error that names the command and how it ended.
pub(crate) fn run(command: &mut Command) -> Result<()> {
    run_unnamed(command).with_context(|| format!("`{}`", describe(command)))
}

/// Like [`run`], for a caller that names the command itself: the error only says how it ended.
pub(crate) fn run_unnamed(command: &mut Command) -> Result<()> {
    let status = command.status().context("cannot be started")?;
    if !status.success() {
        bail!("{status}");
    }
    Ok(())
}

/// Like [`run`], but gives up (and ends the program) after `limit`.
pub(crate) fn run_within(command: &mut Command, limit: Duration) -> Result<()> {
    let started = Instant::now();
    let mut child = command.spawn().with_context(|| format!("cannot start `{}`", describe(command)))?;
    let status = loop {
        if let Some(status) = child.try_wait()? {
            break status;
        }
        if started.elapsed() > limit {
            child.kill()?;
            child.wait()?;
            bail!("`{}` took more than {} s", describe(command), limit.as_secs());
        }
        thread::sleep(Duration::from_millis(50));
    };
    if !status.success() {
        bail!("`{}` ended with {status}", describe(command));
    }
    Ok(())
}

/// Standard output as text; standard error goes to the terminal.
pub(crate) fn capture(command: &mut Command) -> Result<String> {
    let output =
        command.stderr(Stdio::inherit()).output().with_context(|| format!("cannot start `{}`", describe(command)))?;
    if !output.status.success() {
        bail!("`{}` ended with {}", describe(command), output.status);
    }
    String::from_utf8(output.stdout).with_context(|| format!("`{}` printed text that is not UTF-8", describe(command)))
}

/// Whether the program starts and succeeds, with nothing shown.
pub(crate) fn succeeds(command: &mut Command) -> bool {
    command
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()
        .is_ok_and(|status| status.success())
}

/// The first file called `program` on PATH.
pub(crate) fn find_program(program: &str) -> Option<PathBuf> {
    let file = format!("{program}{}", std::env::consts::EXE_SUFFIX);
    std::env::split_paths(&std::env::var_os("PATH")?).map(|folder| folder.join(&file)).find(|path| path.is_file())
}

/// The command as one would type it: variables that we set, the program's plain name, arguments.
pub(crate) fn describe(command: &Command) -> String {
    let set = command.get_envs().filter_map(|(name, value)| {
        let value = quoted(&value?.to_string_lossy());
        Some(format!("{}={value}", name.to_string_lossy()))
    });
    let program = PathBuf::from(command.get_program());
    // Cargo's full path is noise; Debian's in /usr/bin is the point.
    let is_cargo = std::env::var_os("CARGO").is_some_and(|cargo| cargo == command.get_program());
    let program = if is_cargo { "cargo".to_owned() } else { program.display().to_string() };
    let arguments = command.get_args().map(|argument| quoted(&argument.to_string_lossy()));
    set.chain([program]).chain(arguments).collect::<Vec<_>>().join(" ")
}

fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./=:,+@".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

/// Whether an environment variable is switched on: set, and neither empty, `0` nor `false`.
pub(crate) fn switched_on(variable: &str) -> bool {
    std::env::var(variable).is_ok_and(|value| !matches!(value.as_str(), "" | "0" | "false"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_described_command_can_be_pasted_into_a_shell() {
        let mut command = Command::new("cargo");
        command.env("PROPTEST_CASES", "1").env_remove("RUSTC").args(["test", "--", "it's slow"]);
        assert_eq!(describe(&command), r"PROPTEST_CASES=1 cargo test -- 'it'\''s slow'");
    }

    #[test]
    fn variables_about_this_package_are_dropped_and_the_users_stay() {
        assert!(is_inherited_from_cargo("CARGO_PKG_NAME"));
        assert!(is_inherited_from_cargo("CARGO_MANIFEST_DIR"));
        assert!(!is_inherited_from_cargo("CARGO_HOME"));
        assert!(!is_inherited_from_cargo("CARGO_TARGET_DIR"));
        assert!(!is_inherited_from_cargo("CARGO_NET_OFFLINE"));
    }

    #[cfg(unix)]
    #[test]
    fn a_hanging_program_is_ended_at_its_limit() {
        let started = Instant::now();
        let error = run_within(Command::new("sleep").arg("30"), Duration::from_millis(200)).unwrap_err();
        assert!(error.to_string().contains("took more than"), "{error}");
        assert!(started.elapsed() < Duration::from_secs(10));
    }
}
