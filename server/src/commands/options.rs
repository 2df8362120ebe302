//! Options that commands share, and how they become settings together with the file and the environment.
//!
//! Values are taken as they are written: the settings check them, in the same words wherever they come from. None shows
//! its variable's value in `--help`, because that may hold a password.

use super::Failure;
use crate::config::{ConfigError, Loaded, Sources};
use clap::Args;
use std::path::PathBuf;

/// Where settings and everything durable are.
#[derive(Debug, Clone, Default, Args)]
pub(super) struct StorageOptions {
    /// TOML file with settings; `adaptarm config show-default` prints one to start from.
    #[arg(long, value_name = "FILE", env = "ADAPTARM_CONFIG", hide_env_values = true)]
    config: Option<PathBuf>,
    /// Folder for the database and results, made if it does not exist [env: ADAPTARM_DATA].
    #[arg(long, value_name = "DIR")]
    data: Option<String>,
    /// PostgreSQL database in place of the data folder's file [env: ADAPTARM_DATABASE].
    #[arg(long, value_name = "postgres://USER@HOST/NAME")]
    database: Option<String>,
    /// Where recordings are kept in place of the data folder [env: ADAPTARM_RESULTS].
    #[arg(long, value_name = "DIR|s3://BUCKET/PREFIX")]
    results: Option<String>,
}

/// How much is computed.
#[derive(Debug, Clone, Default, Args)]
pub(super) struct ComputeOptions {
    /// Threads that simulate, as many as processors by default; 0 computes nothing here [env: ADAPTARM_THREADS].
    #[arg(long, value_name = "N")]
    threads: Option<String>,
}

impl ComputeOptions {
    /// As flags of settings.
    pub(super) fn flags(&self) -> Vec<(&'static str, String)> {
        self.threads.iter().map(|threads| ("threads", threads.clone())).collect()
    }
}

impl StorageOptions {
    /// Where settings come from: this process's environment, these options and `more` flags.
    pub(super) fn sources(&self, more: Vec<(&'static str, String)>) -> Sources {
        let mut flags = more;
        for (key, value) in [("data", &self.data), ("database", &self.database), ("results", &self.results)] {
            flags.extend(value.iter().map(|value| (key, value.clone())));
        }
        Sources::new(self.config.clone().filter(|file| !file.as_os_str().is_empty()), flags)
    }

    /// The settings in force with these options and `more` flags.
    pub(super) fn load(&self, more: Vec<(&'static str, String)>) -> Result<Loaded, Failure> {
        Ok(self.sources(more).load()?)
    }
}

impl From<ConfigError> for Failure {
    fn from(error: ConfigError) -> Self {
        if error.is_systems() { Self::system(error) } else { Self::input(error) }
    }
}
