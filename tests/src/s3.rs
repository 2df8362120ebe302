//! A store that speaks S3, in this process: one bucket, which is a folder, and requests must be signed with its keys.

use crate::Launch;
use anyhow::Result;
use hyper_util::rt::{TokioExecutor, TokioIo};
use hyper_util::server::conn::auto::Builder;
use s3s::auth::SimpleAuth;
use s3s::service::{S3Service, S3ServiceBuilder};
use std::fs;
use std::path::PathBuf;
use tokio::net::TcpListener;
use tokio::runtime::{self, Runtime};

const BUCKET: &str = "adaptarm";
const KEY: &str = "test-key";
const SECRET: &str = "test-secret";

/// A running store; it ends with this value.
#[derive(Debug)]
pub struct S3 {
    url: String,
    _runtime: Runtime,
    folder: tempfile::TempDir,
}

impl S3 {
    /// Starts one on a free port of the loopback address, with an empty bucket.
    pub fn start() -> Result<Self> {
        let folder = tempfile::tempdir()?;
        fs::create_dir(folder.path().join(BUCKET))?;
        let store = s3s_fs::FileSystem::new(folder.path()).map_err(|error| anyhow::anyhow!("{error:?}"))?;
        let mut service = S3ServiceBuilder::new(store);
        service.set_auth(SimpleAuth::from_single(KEY, SECRET));
        let runtime = runtime::Builder::new_multi_thread().worker_threads(1).enable_all().build()?;
        let listener = runtime.block_on(TcpListener::bind("127.0.0.1:0"))?;
        let url = format!("http://{}", listener.local_addr()?);
        runtime.spawn(serve(listener, service.build()));
        Ok(Self { url, _runtime: runtime, folder })
    }

    /// A process that keeps its results below `prefix` in the bucket.
    pub fn launch(&self, launch: Launch, prefix: &str) -> Launch {
        launch
            .arguments(["--results", &format!("s3://{BUCKET}/{prefix}")])
            .variable("AWS_ACCESS_KEY_ID", KEY)
            .variable("AWS_SECRET_ACCESS_KEY", SECRET)
            .variable("AWS_REGION", "us-east-1")
            .variable("AWS_ENDPOINT_URL", &self.url)
            .variable("AWS_ALLOW_HTTP", "true")
    }

    /// Objects below a prefix, by their files; what the store itself notes beside them is not among them.
    pub fn objects(&self, prefix: &str) -> Result<Vec<PathBuf>> {
        let mut found = Vec::new();
        let mut folders = vec![self.folder.path().join(BUCKET).join(prefix)];
        while let Some(folder) = folders.pop() {
            if !folder.is_dir() {
                continue;
            }
            for entry in fs::read_dir(folder)? {
                let path = entry?.path();
                if path.is_dir() { folders.push(path) } else { found.push(path) }
            }
        }
        found.retain(|path| !path.file_name().is_some_and(|name| name.to_string_lossy().starts_with('.')));
        Ok(found)
    }
}

async fn serve(listener: TcpListener, service: S3Service) {
    while let Ok((stream, _)) = listener.accept().await {
        let service = service.clone();
        tokio::spawn(async move {
            // A client that was killed breaks its connections off.
            let _ = Builder::new(TokioExecutor::new()).serve_connection(TokioIo::new(stream), service).await;
        });
    }
}
