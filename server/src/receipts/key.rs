//! The key that signs receipts: 32 random bytes in hexadecimal in a file of the data folder that only its owner can read.
//!
//! Made at the first start. Several servers that share a database need a copy each; a lost key makes no receipt invalid.

use ed25519_dalek::SigningKey;
use rand::TryRng;
use rand::rngs::{SysError, SysRng};
use std::fs::{self, OpenOptions};
use std::io::{self, Write};
use std::os::unix::fs::{OpenOptionsExt, PermissionsExt};
use std::path::Path;
use thiserror::Error;

/// The file's name in the data folder.
const FILE: &str = "receipt-key";
/// Bits of its mode that others may not have.
const OTHERS: u32 = 0o077;

/// Why there is no key.
#[derive(Debug, Error)]
pub enum KeyError {
    /// The file cannot be read or made.
    #[error("{file}: {error}")]
    File {
        /// Which.
        file: String,
        /// Why.
        error: io::Error,
    },
    /// The file holds something else.
    #[error("{file}: is no key; it should hold 64 hexadecimal digits")]
    Malformed {
        /// Which.
        file: String,
    },
    /// Others may read it.
    #[error("{file}: others can read it (mode {mode:o}); set it to 600, or make a new key if that was so for long")]
    Exposed {
        /// Which.
        file: String,
        /// Its mode.
        mode: u32,
    },
    /// The system has no random numbers.
    #[error("no random numbers: {0}")]
    Random(#[from] SysError),
}

/// The key that signs receipts.
pub struct ReceiptKey(pub(super) SigningKey);

impl ReceiptKey {
    /// The data folder's key, made if there is none.
    pub fn open(folder: &Path) -> Result<Self, KeyError> {
        let path = folder.join(FILE);
        let file = path.display().to_string();
        let failed = |error| KeyError::File { file: file.clone(), error };
        if !path.exists() {
            fs::create_dir_all(folder).map_err(failed)?;
            make(folder, &path, &file)?;
        }
        let mode = fs::metadata(&path).map_err(failed)?.permissions().mode() & 0o777;
        if mode & OTHERS != 0 {
            return Err(KeyError::Exposed { file, mode });
        }
        let text = fs::read_to_string(&path).map_err(failed)?;
        let mut secret = [0; 32];
        hex::decode_to_slice(text.trim(), &mut secret).map_err(|_| KeyError::Malformed { file })?;
        Ok(Self(SigningKey::from_bytes(&secret)))
    }

    /// The key by which others check receipts, in hexadecimal.
    pub fn public(&self) -> String {
        hex::encode(self.0.verifying_key().to_bytes())
    }
}

impl std::fmt::Debug for ReceiptKey {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "ReceiptKey({})", self.public())
    }
}

/// Writes a new key beside its place and links it there: whoever comes second keeps the first one's, and nobody sees half of one.
fn make(folder: &Path, path: &Path, file: &str) -> Result<(), KeyError> {
    let failed = |error| KeyError::File { file: file.to_owned(), error };
    let mut secret = [0; 32];
    SysRng.try_fill_bytes(&mut secret)?;
    let new = folder.join(format!("{FILE}.{}.new", hex::encode(&secret[..4])));
    let written = OpenOptions::new().write(true).create_new(true).mode(0o600).open(&new).and_then(|mut out| {
        out.write_all(format!("{}\n", hex::encode(secret)).as_bytes())?;
        out.sync_all()
    });
    let linked = written.and_then(|()| fs::hard_link(&new, path));
    // Left behind, it would be a secret that nobody looks after.
    let removed = fs::remove_file(&new);
    match linked {
        Err(error) if error.kind() != io::ErrorKind::AlreadyExists => Err(failed(error)),
        _ => removed.map_err(failed),
    }
}
