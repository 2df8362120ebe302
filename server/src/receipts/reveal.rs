//! What opens a receipt's commitments once the deadline is over: nonce, seed and, if wished, the exercise as it was graded.
//!
//! ```text
//! commitment = BLAKE3 derive_key(context, nonce ‖ what)
//! ```
//!
//! The nonce has 256 random bits: without it the commitments tell nothing, although seeds have 53 bits only.

use adaptarm_core::exercises::{Exercise, ExerciseDocument};
use rand::TryRng;
use rand::rngs::{SysError, SysRng};
use serde::{Deserialize, Serialize};

/// The format that this version reads and writes.
pub const REVEAL_FORMAT: &str = "adaptarm.reveal/1";

/// What makes commitments tell nothing.
#[derive(Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Nonce([u8; 32]);

/// What is published after the deadline.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Reveal {
    /// `adaptarm.reveal/1`.
    pub format: String,
    /// Seed of the hidden variants.
    pub seed: u64,
    /// The receipt's nonce.
    pub nonce: Nonce,
    /// The exercise, where it is not one that comes with the program.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub exercise: Option<ExerciseDocument>,
}

impl Nonce {
    /// A new one.
    pub fn random() -> Result<Self, SysError> {
        let mut bytes = [0; 32];
        SysRng.try_fill_bytes(&mut bytes)?;
        Ok(Self(bytes))
    }

    /// Commitment to a seed.
    pub fn commit_seed(&self, seed: u64) -> String {
        self.commit("adaptarm.receipt/1 seed", &[&seed.to_le_bytes()])
    }

    /// Commitment to the hash of a variant's trajectory.
    pub fn commit_trajectory(&self, variant: usize, hash: &str) -> String {
        self.commit("adaptarm.receipt/1 trajectory", &[&(variant as u64).to_le_bytes(), hash.as_bytes()])
    }

    fn commit(&self, context: &str, what: &[&[u8]]) -> String {
        let mut hasher = blake3::Hasher::new_derive_key(context);
        hasher.update(&self.0);
        for part in what {
            hasher.update(part);
        }
        hasher.finalize().to_hex().to_string()
    }
}

impl std::fmt::Debug for Nonce {
    /// A secret until it is revealed: not for logs.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Nonce(…)")
    }
}

impl TryFrom<String> for Nonce {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        let mut bytes = [0; 32];
        hex::decode_to_slice(&text, &mut bytes).map_err(|_| "a nonce is 64 hexadecimal digits".to_owned())?;
        Ok(Self(bytes))
    }
}

impl From<Nonce> for String {
    fn from(nonce: Nonce) -> Self {
        hex::encode(nonce.0)
    }
}

impl Reveal {
    /// Of an attempt. The exercise is that of the class; its solutions and the teacher's note stay where they are.
    pub fn new(seed: u64, nonce: Nonce, exercise: Option<&Exercise>) -> Self {
        let exercise = exercise.map(|exercise| {
            let mut document = exercise.document().clone();
            document.solutions.clear();
            document.teacher_note = None;
            document
        });
        Self { format: REVEAL_FORMAT.to_owned(), seed, nonce, exercise }
    }
}
