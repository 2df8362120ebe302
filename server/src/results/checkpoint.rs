//! How far a shard has come, as bytes.

use super::ResultError;
use crate::packed;
use adaptarm_core::experiments::Row;
use adaptarm_core::simulation::Snapshot;
use bytes::Bytes;
use serde::{Deserialize, Serialize};

/// Simulations under way, which of their shard they are, and what an experiment's shard has done before them.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Checkpoint {
    /// Numbers of the scenarios in their job, or of the runs in their experiment.
    pub numbers: Vec<i64>,
    /// Each one's simulation.
    pub snapshots: Vec<Snapshot>,
    /// Rows of the runs that are done.
    pub rows: Vec<Row>,
    /// Steps that those took.
    pub steps: u64,
}

impl Checkpoint {
    /// As bytes. Takes milliseconds of computing: not for an async task.
    pub fn encode(&self) -> Result<Bytes, ResultError> {
        let failed = |error| ResultError::Damaged(format!("a checkpoint cannot be written: {error}"));
        packed::pack(self).map(Bytes::from).map_err(failed)
    }

    /// From what [`Self::encode`] gave.
    pub fn decode(bytes: &[u8]) -> Result<Self, ResultError> {
        let damaged = |error| ResultError::Damaged(format!("a checkpoint is not what was stored: {error}"));
        packed::unpack(bytes).map_err(damaged)
    }

    /// The snapshots of these numbers, in their order; none unless all are there.
    pub fn snapshots_of(&self, numbers: &[i64]) -> Vec<Snapshot> {
        let snapshot = |number: &i64| {
            let place = self.numbers.iter().position(|other| other == number)?;
            self.snapshots.get(place).cloned()
        };
        numbers.iter().map(snapshot).collect::<Option<_>>().unwrap_or_default()
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
        let checkpoint =
            Checkpoint { numbers: vec![5], snapshots: vec![simulation.snapshot()], ..Checkpoint::default() };
        let decoded = Checkpoint::decode(&checkpoint.encode().unwrap()).unwrap();
        assert!(decoded.snapshots_of(&[4]).is_empty() && decoded.snapshots_of(&[5, 6]).is_empty());
        let mut resumed = scenario.resume(decoded.snapshots_of(&[5]).remove(0)).unwrap();
        resumed.advance(u64::MAX);
        assert_eq!(scenario.finish(resumed), scenario.run());
    }

    #[test]
    fn damaged_bytes_are_refused() {
        let bytes = Checkpoint::default().encode().unwrap();
        assert!(matches!(Checkpoint::decode(&bytes[..40]), Err(ResultError::Damaged(_))));
    }
}
