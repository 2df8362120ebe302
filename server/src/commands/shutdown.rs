//! The signals that end a server or a worker.

#[cfg(unix)]
use tokio::signal::unix::{Signal, SignalKind, signal};

/// The signals, heard from the beginning.
#[cfg(unix)]
pub(super) struct Shutdown {
    interrupt: Signal,
    terminate: Signal,
}

#[cfg(unix)]
impl Shutdown {
    /// Watches from now on.
    pub(super) fn watch() -> std::io::Result<Self> {
        Ok(Self { interrupt: signal(SignalKind::interrupt())?, terminate: signal(SignalKind::terminate())? })
    }

    /// Done at the first signal, after telling; a second one ends the process at once.
    pub(super) async fn wait(mut self, tell: impl FnOnce()) {
        self.next().await;
        tracing::info!("stopping: finishing what is under way; a second signal stops at once");
        tell();
        tokio::spawn(async move {
            self.next().await;
            std::process::exit(1);
        });
    }

    async fn next(&mut self) {
        tokio::select! {
            _ = self.interrupt.recv() => {}
            _ = self.terminate.recv() => {}
        }
    }
}

/// Ctrl-C, where there is nothing else.
#[cfg(not(unix))]
pub(super) struct Shutdown;

#[cfg(not(unix))]
impl Shutdown {
    /// Watches from now on.
    pub(super) fn watch() -> std::io::Result<Self> {
        Ok(Self)
    }

    /// Done at the first signal, after telling.
    pub(super) async fn wait(self, tell: impl FnOnce()) {
        // Without a way to hear of it, nothing but killing the process stops it.
        if tokio::signal::ctrl_c().await.is_err() {
            std::future::pending::<()>().await;
        }
        tell();
    }
}
