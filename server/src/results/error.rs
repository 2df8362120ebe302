//! What can go wrong with stored results, told apart by what can be done about it.

use std::error::Error;
use std::io;
use thiserror::Error;

/// Why a result was not stored or read.
#[derive(Debug, Error)]
pub enum ResultError {
    /// There is no room for it; someone must make some.
    #[error("there is no space left for results: {0}")]
    NoSpace(String),
    /// It is not there.
    #[error("not stored: {0}")]
    Missing(String),
    /// It is there, but is not what was stored.
    #[error("damaged: {0}")]
    Damaged(String),
    /// The store cannot be used now; it may work again later.
    #[error("the result store failed: {0}")]
    Unavailable(object_store::Error),
}

impl From<object_store::Error> for ResultError {
    fn from(error: object_store::Error) -> Self {
        if let object_store::Error::NotFound { path, .. } = error {
            return Self::Missing(path);
        }
        let mut cause: Option<&(dyn Error + 'static)> = Some(&error);
        while let Some(found) = cause {
            let kind = found.downcast_ref::<io::Error>().map(io::Error::kind);
            if matches!(kind, Some(io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded)) {
                return Self::NoSpace(found.to_string());
            }
            cause = found.source();
        }
        Self::Unavailable(error)
    }
}
