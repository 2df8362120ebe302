//! Everything that outlives a request, opened as the settings say: tables, queue, results, engine.

use crate::classroom::{ClassroomStore, Desk};
use crate::config::{Config, ResultsPlace};
use crate::jobs::{Engine, EngineSettings, JobStore, Queue, Stores, connect};
use crate::lti::{LtiStore, Tool};
use crate::results::Results;
use crate::webhooks::{Policy, Sender};
use anyhow::{Context, bail};
use std::fs::{File, TryLockError};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Where things are kept if nobody says where.
const DEFAULT_DATA: &str = "adaptarm-data";

/// What is kept, and who works on it.
pub struct Laboratory {
    /// Accepts and runs jobs.
    pub engine: Engine,
    /// The tables.
    pub store: Arc<dyn JobStore>,
    /// The queue beside them.
    pub queue: Arc<dyn Queue>,
    /// Classes.
    pub classroom: Arc<dyn ClassroomStore>,
    /// Learning platforms.
    pub lti: Arc<dyn LtiStore>,
    /// Samples and checkpoints.
    pub results: Results,
    /// Whom webhooks may reach.
    pub receivers: Arc<Policy>,
    /// Held for as long as the data folder's database is used.
    _lock: Option<File>,
}

impl Laboratory {
    /// Opens everything. A database in the data folder belongs to this process alone from then on: whatever the tables
    /// say is running was left by one that is dead, and is given back.
    pub async fn open(config: &Config) -> anyhow::Result<Self> {
        let data = data_folder(config);
        let lock = if config.database.is_none() { Some(lock(&data)?) } else { None };
        let results = Results::open(&results_place(config))?;
        let Stores { jobs: store, queue, classroom, lti } = connect(config.database.as_ref(), &data).await?;
        if lock.is_some() {
            lti.retry_all().await?;
            let buried = store.bury_all().await?;
            if buried > 0 {
                tracing::warn!(
                    "{buried} shards were under way when this server last ended; they go on from what was saved"
                );
            }
        }
        let engine = Engine::new(store.clone(), queue.clone(), results.clone(), EngineSettings::of(config))?;
        let receivers = Arc::new(config.webhooks.policy().context("webhooks.allow")?);
        Ok(Self { receivers, classroom, lti, engine, store, queue, results, _lock: lock })
    }

    /// What requests of the classroom share; servers have it, and workers do without.
    pub async fn desk(&self, config: &Config) -> anyhow::Result<Arc<Desk>> {
        Ok(Arc::new(Desk::open(self.classroom.clone(), config).await?))
    }

    /// What requests of learning platforms and the passing back of grades share.
    pub fn tool(&self, desk: &Arc<Desk>, config: &Config) -> anyhow::Result<Arc<Tool>> {
        Ok(Arc::new(Tool::new(self.lti.clone(), desk.clone(), config)?))
    }

    /// What makes the calls to webhooks.
    pub fn sender(&self, config: &Config) -> Sender {
        Sender::with_timing((*self.receivers).clone(), config.webhooks.timing())
    }
}

/// The tables alone, which a server may be using at the same time.
pub async fn open_tables(config: &Config) -> anyhow::Result<Stores> {
    let data = data_folder(config);
    if config.database.is_none() {
        make_folder(&data)?;
    }
    Ok(connect(config.database.as_ref(), &data).await?)
}

/// The data folder.
pub fn data_folder(config: &Config) -> PathBuf {
    config.data.clone().unwrap_or_else(|| DEFAULT_DATA.into())
}

/// Where results are kept.
fn results_place(config: &Config) -> ResultsPlace {
    config.results.clone().unwrap_or_else(|| ResultsPlace::Folder(data_folder(config).join("results")))
}

/// Makes the data folder and takes hold of it.
fn lock(data: &Path) -> anyhow::Result<File> {
    make_folder(data)?;
    let path = data.join("adaptarm.lock");
    let file = File::create(&path).with_context(|| format!("cannot write {}", path.display()))?;
    match file.try_lock() {
        Ok(()) => Ok(file),
        Err(TryLockError::WouldBlock) => bail!(
            "another adaptarm uses the data folder {} already; stop it, name another folder by --data, or let several \
             share a PostgreSQL database by --database",
            data.display()
        ),
        Err(TryLockError::Error(error)) => Err(error).with_context(|| format!("cannot lock {}", path.display())),
    }
}

fn make_folder(data: &Path) -> anyhow::Result<()> {
    make_private(data).with_context(|| format!("cannot make the data folder {}", data.display()))
}

/// Makes a folder that only its owner can look into, if it does not exist: the database holds webhooks' secrets.
fn make_private(folder: &Path) -> std::io::Result<()> {
    let mut builder = std::fs::DirBuilder::new();
    #[cfg(unix)]
    std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
    builder.recursive(true).create(folder)
}
