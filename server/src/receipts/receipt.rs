//! A receipt: a statement about a graded attempt, and the server's signature over it.
//!
//! ```text
//! signature = Ed25519(key, "adaptarm.receipt/1\0" ‖ statement as JSON: all fields in their order, no spaces)
//! ```
//!
//! The JSON is made anew from what was read, so that a receipt may be formatted as one likes. Nothing in a statement tells about
//! hidden variants: the seed and the trajectories' hashes are there as commitments, which `reveal` opens.

use super::key::ReceiptKey;
use super::reveal::Nonce;
use adaptarm_core::exercises::{Grade, PublicGrade};
use ed25519_dalek::{Signature, Signer, VerifyingKey};
use jiff::Timestamp;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use thiserror::Error;

/// The format that this version reads and writes.
pub const RECEIPT_FORMAT: &str = "adaptarm.receipt/1";

/// What is stated about an attempt.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Statement {
    /// `adaptarm.receipt/1`.
    pub format: String,
    /// Which attempt, as the server calls it.
    pub attempt: String,
    /// When it was graded.
    pub graded_at: Timestamp,
    /// What was submitted.
    pub gains: BTreeMap<String, f64>,
    /// What it was worth, as its student may know it: exercise, fingerprint, core version, points.
    pub grade: PublicGrade,
    /// Commitment to the seed of the hidden variants.
    pub seed_commitment: String,
    /// Commitments to the hashes of the trajectories, variant by variant.
    pub trajectory_commitments: Vec<String>,
}

/// A statement with its signature.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Receipt {
    /// What is stated.
    pub statement: Statement,
    /// The signer's public key, in hexadecimal.
    pub key: String,
    /// Ed25519 signature, in hexadecimal.
    pub signature: String,
}

/// Why a receipt is not to be trusted.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum Forgery {
    /// Of another format.
    #[error("its format is {0:?}; this program knows {RECEIPT_FORMAT}")]
    Format(String),
    /// No key.
    #[error("{0:?} is no public key: 64 hexadecimal digits of an Ed25519 key are needed")]
    Key(String),
    /// Not the expected signer.
    #[error("it is signed by key {found}, not by {expected}")]
    OtherSigner {
        /// The receipt's key.
        found: String,
        /// The one that was asked for.
        expected: String,
    },
    /// The signature is not one of this key over this statement.
    #[error("the signature does not fit: the receipt was changed after it was signed, or never was")]
    Signature,
}

impl Statement {
    /// About a grade on hidden variants drawn from `seed`. The nonce is a new one for each receipt.
    pub fn new(
        attempt: String,
        graded_at: Timestamp,
        gains: BTreeMap<String, f64>,
        grade: &Grade,
        seed: u64,
        nonce: &Nonce,
    ) -> Self {
        let hashes = grade.variants.iter().enumerate();
        Self {
            format: RECEIPT_FORMAT.to_owned(),
            attempt,
            graded_at,
            gains,
            grade: grade.public(),
            seed_commitment: nonce.commit_seed(seed),
            trajectory_commitments: hashes.map(|(n, own)| nonce.commit_trajectory(n, &own.trajectory_hash)).collect(),
        }
    }

    fn signed_bytes(&self) -> Vec<u8> {
        let mut bytes = format!("{RECEIPT_FORMAT}\0").into_bytes();
        // Only strings, numbers and lists, and a vector takes whatever is written.
        if serde_json::to_writer(&mut bytes, self).is_err() {
            unreachable!("a statement always encodes");
        }
        bytes
    }
}

impl Receipt {
    /// Signs a statement.
    pub fn sign(statement: Statement, key: &ReceiptKey) -> Self {
        let signature = key.0.sign(&statement.signed_bytes());
        Self { statement, key: key.public(), signature: hex::encode(signature.to_bytes()) }
    }

    /// Checks the signature, and if `expected` is given, that its key is the signer's.
    pub fn verify(&self, expected: Option<&str>) -> Result<(), Forgery> {
        if self.statement.format != RECEIPT_FORMAT {
            return Err(Forgery::Format(self.statement.format.clone()));
        }
        let signer = public_key(&self.key)?;
        if let Some(expected) = expected
            && public_key(expected)? != signer
        {
            return Err(Forgery::OtherSigner { found: self.key.clone(), expected: expected.to_owned() });
        }
        let mut bytes = [0; 64];
        hex::decode_to_slice(&self.signature, &mut bytes).map_err(|_| Forgery::Signature)?;
        // Strict: one statement has one signature, and weak keys sign nothing.
        let signature = Signature::from_bytes(&bytes);
        signer.verify_strict(&self.statement.signed_bytes(), &signature).map_err(|_| Forgery::Signature)
    }
}

fn public_key(text: &str) -> Result<VerifyingKey, Forgery> {
    let wrong = || Forgery::Key(text.chars().take(80).collect());
    let mut bytes = [0; 32];
    hex::decode_to_slice(text, &mut bytes).map_err(|_| wrong())?;
    VerifyingKey::from_bytes(&bytes).map_err(|_| wrong())
}
