//! Pausing: a run in slices, or stored and resumed, gives the same bits as a run in one piece.

use adaptarm_core::scenario::{MethodDocument, Scenario, ScenarioDocument, Scheme};
use adaptarm_core::simulation::{Snapshot, SnapshotError};
use proptest::prelude::*;

fn short(scheme: Scheme, adjust: impl Fn(&mut ScenarioDocument)) -> Scenario {
    let mut document = scheme.paper();
    document.integration.duration_s = 0.5;
    document.recording.samples = 100;
    adjust(&mut document);
    Scenario::new(document).unwrap()
}

/// Through bytes and back, as a job that survives its process would.
fn stored(snapshot: &Snapshot) -> Snapshot {
    serde_json::from_str(&serde_json::to_string(snapshot).unwrap()).unwrap()
}

fn in_slices(scenario: &Scenario, slices: &[u64]) -> String {
    let mut simulation = scenario.start();
    for slice in slices.iter().cycle() {
        if simulation.advance(*slice) {
            break;
        }
        simulation = scenario.resume(stored(&simulation.snapshot())).unwrap();
    }
    let run = scenario.finish(simulation);
    let whole = scenario.run();
    assert_eq!(run, whole);
    run.report.trajectory_hash
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn resumed_runs_have_the_bits_of_undisturbed_ones(
        slices in prop::collection::vec(1_u64..200, 1..6),
        scheme in prop::sample::select(Scheme::ALL.to_vec()),
    ) {
        in_slices(&short(scheme, |_| {}), &slices);
    }

    #[test]
    fn also_where_samples_fall_inside_steps(slices in prop::collection::vec(1_u64..200, 1..6)) {
        in_slices(&short(Scheme::Proposed, |document| document.integration.step_s = 0.0013), &slices);
    }

    #[test]
    fn also_with_adaptive_steps(slices in prop::collection::vec(1_u64..50, 1..6)) {
        in_slices(
            &short(Scheme::SlotineLi, |document| {
                document.integration.method = MethodDocument::Dopri5;
                document.integration.step_s = 0.01;
            }),
            &slices,
        );
    }
}

#[test]
fn a_finished_run_resumes_as_finished() {
    let scenario = short(Scheme::SlotineLi, |_| {});
    let mut simulation = scenario.start();
    assert!(simulation.advance(u64::MAX));
    let mut again = scenario.resume(stored(&simulation.snapshot())).unwrap();
    assert!(again.advance(1));
    assert_eq!(scenario.finish(again), scenario.run());
}

#[test]
fn a_foreign_or_damaged_snapshot_is_refused() {
    let scenario = short(Scheme::SlotineLi, |_| {});
    let mut simulation = scenario.start();
    simulation.advance(10);
    let snapshot = simulation.snapshot();
    let other = short(Scheme::TangArteaga, |_| {});
    assert!(matches!(other.resume(snapshot.clone()), Err(SnapshotError::OtherScenario { .. })));
    let mut damaged = snapshot.clone();
    damaged.state.pop();
    assert!(matches!(scenario.resume(damaged), Err(SnapshotError::Shape { what: "state", .. })));
    let mut damaged = snapshot;
    damaged.rows.pop();
    assert!(matches!(scenario.resume(damaged), Err(SnapshotError::Shape { what: "rows", .. })));
}
