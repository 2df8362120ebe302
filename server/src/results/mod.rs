//! Where samples are kept: one object per scenario and version of the core, named by the scenario's hash; and checkpoints of
//! simulations under way.
//!
//! A folder or an S3 bucket. Objects are written whole or not at all, and read back only if they are what was written.

mod checkpoint;
mod error;

pub use checkpoint::Checkpoint;
pub use error::ResultError;

use crate::config::ResultsPlace;
use crate::series::parquet;
use adaptarm_core::recording::Recording;
use adaptarm_core::scenario::Report;
use anyhow::Context;
use bytes::Bytes;
use futures_util::{StreamExt, TryStreamExt};
use jiff::Timestamp;
use object_store::aws::AmazonS3Builder;
use object_store::local::LocalFileSystem;
use object_store::path::Path;
use object_store::prefix::PrefixStore;
use object_store::{ObjectStore, ObjectStoreExt, RetryConfig};
use std::sync::Arc;
use std::time::Duration;
use uuid::Uuid;

/// For how long a call to S3 tries again by itself.
const S3_RETRY: Duration = Duration::from_secs(5);

/// A result store; a clone is the same store.
#[derive(Debug, Clone)]
pub struct Results {
    objects: Arc<dyn ObjectStore>,
}

/// An object that is about to be stored, or has been.
#[derive(Debug, Clone, PartialEq)]
pub struct Encoded {
    /// Its bytes.
    pub bytes: Bytes,
    /// Hash over them.
    pub checksum: String,
}

impl Encoded {
    /// The samples of a run. Takes milliseconds of computing: not for an async task.
    pub fn new(report: &Report, recording: &Recording) -> Result<Self, ResultError> {
        let bytes = parquet::encode(report, recording).map_err(|error| ResultError::Damaged(error.to_string()))?;
        let checksum = blake3::hash(&bytes).to_hex().to_string();
        Ok(Self { bytes, checksum })
    }
}

impl Results {
    /// Opens a place; a folder is made if it does not exist.
    pub fn open(place: &ResultsPlace) -> anyhow::Result<Self> {
        let objects: Arc<dyn ObjectStore> = match place {
            ResultsPlace::Folder(folder) => {
                std::fs::create_dir_all(folder)
                    .with_context(|| format!("cannot make the results folder {}", folder.display()))?;
                let files = LocalFileSystem::new_with_prefix(folder)
                    .with_context(|| format!("cannot use the results folder {}", folder.display()))?;
                // What the tables say is stored must be there after a power cut too.
                Arc::new(files.with_fsync(true))
            }
            ResultsPlace::S3 { bucket, prefix } => {
                crate::webhooks::install_crypto_provider();
                let s3 = AmazonS3Builder::from_env()
                    .with_bucket_name(bucket)
                    // Whoever asks tries again by itself, and wants to hear of trouble before its lease runs out.
                    .with_retry(RetryConfig { max_retries: 2, retry_timeout: S3_RETRY, ..RetryConfig::default() })
                    .build()
                    .with_context(|| format!("cannot use the bucket {bucket}"))?;
                if prefix.is_empty() { Arc::new(s3) } else { Arc::new(PrefixStore::new(s3, prefix.as_str())) }
            }
        };
        Ok(Self { objects })
    }

    /// Whether it can be read.
    pub async fn check(&self) -> Result<(), ResultError> {
        self.objects.list(Some(&Path::from("checkpoints"))).next().await.transpose()?;
        Ok(())
    }

    /// Keeps the samples of a run. Doing so twice changes nothing: the same scenario has the same samples.
    pub async fn put(&self, report: &Report, encoded: &Encoded) -> Result<(), ResultError> {
        let path = recording_path(&report.scenario_hash, &report.core_version);
        self.objects.put(&path, encoded.bytes.clone().into()).await?;
        Ok(())
    }

    /// The samples of a run, if they are what was stored.
    pub async fn get(&self, hash: &str, core_version: &str, checksum: &str) -> Result<Recording, ResultError> {
        let bytes = self.objects.get(&recording_path(hash, core_version)).await?.bytes().await?;
        if blake3::hash(&bytes).to_hex().as_str() != checksum {
            return Err(ResultError::Damaged(format!("the samples of scenario {hash} are not what was stored")));
        }
        let decoded = tokio::task::spawn_blocking(move || parquet::decode(bytes)).await;
        match decoded {
            Ok(recording) => recording.map_err(|error| ResultError::Damaged(error.to_string())),
            Err(error) => Err(ResultError::Damaged(error.to_string())),
        }
    }

    /// Forgets the samples of a run, unless they were stored anew since `before`: someone needs them again.
    pub async fn remove(&self, hash: &str, core_version: &str, before: Timestamp) -> Result<(), ResultError> {
        let path = recording_path(hash, core_version);
        match self.objects.head(&path).await {
            Ok(found) if found.last_modified.timestamp_micros() > before.as_microsecond() => Ok(()),
            Ok(_) => gone(self.objects.delete(&path).await),
            Err(error) => gone(Err(error)),
        }
    }

    /// Keeps how far a shard has come, in place of what was kept before.
    pub async fn save(&self, job: Uuid, shard: i64, checkpoint: Bytes) -> Result<(), ResultError> {
        self.objects.put(&checkpoint_path(job, shard), checkpoint.into()).await?;
        Ok(())
    }

    /// How far a shard had come.
    pub async fn load(&self, job: Uuid, shard: i64) -> Result<Option<Checkpoint>, ResultError> {
        match self.objects.get(&checkpoint_path(job, shard)).await {
            Ok(found) => Checkpoint::decode(&found.bytes().await?).map(Some),
            Err(object_store::Error::NotFound { .. }) => Ok(None),
            Err(error) => Err(error.into()),
        }
    }

    /// Forgets how far a shard had come.
    pub async fn discard(&self, job: Uuid, shard: i64) -> Result<(), ResultError> {
        gone(self.objects.delete(&checkpoint_path(job, shard)).await)
    }

    /// Every shard of which a checkpoint is kept.
    pub async fn checkpoints(&self) -> Result<Vec<(Uuid, i64)>, ResultError> {
        let objects: Vec<_> = self.objects.list(Some(&Path::from("checkpoints"))).try_collect().await?;
        let parse = |path: &Path| {
            let mut parts = path.as_ref().split('/').skip(1);
            Some((parts.next()?.parse().ok()?, parts.next()?.parse().ok()?))
        };
        Ok(objects.iter().filter_map(|object| parse(&object.location)).collect())
    }
}

/// Two levels of folders keep each of them small.
fn recording_path(hash: &str, core_version: &str) -> Path {
    let start = hash.get(..2).unwrap_or("00");
    Path::from(format!("recordings/{core_version}/{start}/{hash}.parquet"))
}

fn checkpoint_path(job: Uuid, shard: i64) -> Path {
    Path::from(format!("checkpoints/{job}/{shard}"))
}

/// What is not there need not be removed.
fn gone(removed: Result<(), object_store::Error>) -> Result<(), ResultError> {
    match removed {
        Ok(()) | Err(object_store::Error::NotFound { .. }) => Ok(()),
        Err(error) => Err(error.into()),
    }
}
