//! How far a shard has come, as bytes.

use super::ResultError;
use adaptarm_core::simulation::Snapshot;
use bytes::Bytes;
use serde::{Deserialize, Serialize};

/// Fast, and the samples of a run hardly get smaller by trying harder.
const COMPRESSION_LEVEL: i32 = 1;

/// A simulation under way, and which one of its shard it is.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Checkpoint {
    /// Number of the scenario in its job.
    pub n: i64,
    /// The simulation.
    pub snapshot: Snapshot,
}

impl Checkpoint {
    /// As bytes, with a hash in front. Takes milliseconds of computing: not for an async task.
    pub fn encode(&self) -> Result<Bytes, ResultError> {
        let failed =
            |error: &dyn std::fmt::Display| ResultError::Damaged(format!("a checkpoint cannot be written: {error}"));
        let plain = rmp_serde::to_vec_named(self).map_err(|error| failed(&error))?;
        let packed = zstd::encode_all(&*plain, COMPRESSION_LEVEL).map_err(|error| failed(&error))?;
        let mut bytes = blake3::hash(&packed).as_bytes().to_vec();
        bytes.extend(packed);
        Ok(bytes.into())
    }

    /// From what [`Self::encode`] gave.
    pub fn decode(bytes: &[u8]) -> Result<Self, ResultError> {
        let damaged =
            |what: &dyn std::fmt::Display| ResultError::Damaged(format!("a checkpoint is not what was stored: {what}"));
        let (hash, packed) = bytes.split_at_checked(blake3::OUT_LEN).ok_or_else(|| damaged(&"it is too short"))?;
        if blake3::hash(packed).as_bytes() != hash {
            return Err(damaged(&"its hash differs"));
        }
        let plain = zstd::decode_all(packed).map_err(|error| damaged(&error))?;
        rmp_serde::from_slice(&plain).map_err(|error| damaged(&error))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use adaptarm_core::scenario::{Scenario, Scheme};

    #[test]
    fn a_resumed_checkpoint_gives_the_same_bits() {
        let mut document = Scheme::Proposed.paper();
        document.integration.duration_s = 0.4;
        document.recording.samples = 37;
        let scenario = Scenario::new(document).unwrap();
        let mut simulation = scenario.start();
        simulation.advance(123);
        let bytes = Checkpoint { n: 5, snapshot: simulation.snapshot() }.encode().unwrap();
        let Checkpoint { n, snapshot } = Checkpoint::decode(&bytes).unwrap();
        let mut resumed = scenario.resume(snapshot).unwrap();
        resumed.advance(u64::MAX);
        assert_eq!((n, scenario.finish(resumed)), (5, scenario.run()));
    }

    #[test]
    fn damaged_bytes_are_refused() {
        let scenario = Scenario::new(Scheme::SlotineLi.paper()).unwrap();
        let bytes = Checkpoint { n: 0, snapshot: scenario.start().snapshot() }.encode().unwrap();
        for end in [0, 10, 40, bytes.len() - 1] {
            assert!(matches!(Checkpoint::decode(&bytes[..end]), Err(ResultError::Damaged(_))), "{end} bytes");
        }
        let mut flipped = bytes.to_vec();
        *flipped.last_mut().unwrap() ^= 1;
        assert!(matches!(Checkpoint::decode(&flipped), Err(ResultError::Damaged(_))));
    }
}
