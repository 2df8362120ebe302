//! From layers to settings: the file below the environment below flags, and then what only shows when all are together.

use super::Config;
use super::error::ConfigError;
use super::layers::Layer;
use super::setting::Setting;
use crate::document::read_file;
use std::collections::BTreeMap;
use std::ffi::OsString;
use std::path::PathBuf;

/// Where settings are to come from.
#[derive(Debug, Clone, Default)]
pub struct Sources {
    /// A TOML file.
    pub file: Option<PathBuf>,
    /// Environment variables, by name.
    pub environment: Vec<(String, OsString)>,
    /// Flags, by the key of their setting.
    pub flags: Vec<(&'static str, String)>,
}

/// Settings, and where those come from that are not defaults.
#[derive(Debug)]
pub struct Loaded {
    /// The settings.
    pub config: Config,
    /// Key of a setting to the place that decided it.
    pub places: BTreeMap<String, String>,
}

impl Sources {
    /// A file and flags, with this process's environment.
    pub fn new(file: Option<PathBuf>, flags: Vec<(&'static str, String)>) -> Self {
        // All our names are Unicode.
        let environment =
            std::env::vars_os().filter_map(|(name, value)| Some((name.into_string().ok()?, value))).collect();
        Self { file, environment, flags }
    }

    /// Reads them all.
    pub fn load(&self) -> Result<Loaded, ConfigError> {
        let settings = Config::settings();
        let mut builder = config::Config::builder();
        if let Some(path) = &self.file {
            let unreadable = |error| ConfigError::File { path: path.clone(), error };
            let name = path.display().to_string();
            let text = String::from_utf8(read_file(path).map_err(unreadable)?).map_err(|error| {
                let message = format!("byte {} is not UTF-8 text", error.utf8_error().valid_up_to());
                ConfigError::Syntax { place: name.clone(), message }
            })?;
            builder = builder.add_source(Layer::file(&name, &text, &settings)?);
        }
        builder = builder
            .add_source(Layer::environment(&self.environment, &settings)?)
            .add_source(Layer::flags(&self.flags, &settings)?);
        Loaded::new(builder.build()?, &settings)
    }

    /// Names in the environment that look like settings and are none.
    pub fn ignored(&self) -> Vec<&str> {
        let settings = Config::settings();
        let is_ours =
            |name: &str| name == "ADAPTARM_CONFIG" || settings.iter().any(|setting| setting.variable() == name);
        let names = self.environment.iter().map(|(name, _)| name.as_str());
        names.filter(|name| name.starts_with("ADAPTARM_") && !is_ours(name)).collect()
    }
}

/// The place that a setting's value was given with, if it was given.
fn place_of(root: &config::Value, setting: &Setting) -> Option<String> {
    let mut value = root;
    for part in setting.key().split('.') {
        let config::ValueKind::Table(table) = &value.kind else { return None };
        value = table.get(part)?;
    }
    value.origin().map(str::to_owned)
}

impl Loaded {
    fn new(merged: config::Config, settings: &[&'static Setting]) -> Result<Self, ConfigError> {
        let mut places = BTreeMap::new();
        for setting in settings {
            if let Some(place) = place_of(&merged.cache, setting) {
                places.insert(setting.key(), place);
            }
        }
        let loaded = Self { config: merged.try_deserialize()?, places };
        loaded.check()?;
        Ok(loaded)
    }

    /// What each setting alone cannot show.
    fn check(&self) -> Result<(), ConfigError> {
        let Config { limits, retention, queue, server, .. } = &self.config;
        self.ordered(
            ("limits.wait_s", limits.wait_s as f64),
            "must be shorter than",
            ("server.request_timeout_s", server.request_timeout_s),
            (limits.wait_s as f64) < server.request_timeout_s,
        )?;
        self.ordered(
            ("queue.heartbeat_ms", queue.heartbeat_ms as f64),
            "must be at most a third, in ms, of",
            ("queue.lease_s", queue.lease_s),
            queue.heartbeat_ms as f64 * 3.0 <= queue.lease_s * 1000.0,
        )?;
        self.ordered(
            ("retention.finished_jobs_days", f64::from(retention.finished_jobs_days)),
            "must be at most",
            ("retention.results_days", f64::from(retention.results_days)),
            retention.finished_jobs_days <= retention.results_days,
        )
    }

    fn ordered(&self, first: (&str, f64), relation: &str, second: (&str, f64), holds: bool) -> Result<(), ConfigError> {
        if holds {
            return Ok(());
        }
        // Defaults agree with each other, so one of the two was set.
        let place = [second.0, first.0].iter().find_map(|key| self.places.get(*key)).cloned().unwrap_or_default();
        let message = format!("{} = {} {relation} {} = {}", first.0, first.1, second.0, second.1);
        Err(ConfigError::Conflict { place, message })
    }
}
