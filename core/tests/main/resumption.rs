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

/// A way to spoil a snapshot.
type Damage = fn(&mut Snapshot);

#[test]
fn a_foreign_or_damaged_snapshot_is_refused() {
    let adaptive = |document: &mut ScenarioDocument| document.integration.method = MethodDocument::Dopri5;
    let refusals: [(&str, Damage); 9] = [
        ("numbers where", |snapshot| snapshot.state.truncate(5)),
        ("numbers where", |snapshot| snapshot.rows.push(1.0)),
        ("number of rows", |snapshot| snapshot.rows.clear()),
        ("not finite", |snapshot| snapshot.state[3] = f64::NAN),
        ("time and", |snapshot| snapshot.time_s = 0.3),
        ("time and", |snapshot| snapshot.time_s = f64::NAN),
        ("number of rows", |snapshot| snapshot.outcome = Some(adaptarm_core::simulation::Outcome::Completed)),
        ("of core 0.0.1", |snapshot| snapshot.core_version = "0.0.1".to_owned()),
        ("belongs to scenario", |snapshot| snapshot.identity = "another".to_owned()),
    ];
    for scenario in [short(Scheme::SlotineLi, |_| {}), short(Scheme::SlotineLi, adaptive)] {
        let mut simulation = scenario.start();
        simulation.advance(10);
        let good = simulation.snapshot();
        assert!(scenario.resume(good.clone()).is_ok());
        for (said, damage) in refusals {
            let mut damaged = good.clone();
            damage(&mut damaged);
            let error = scenario.resume(damaged).err().map(|error: SnapshotError| error.to_string());
            assert!(error.as_ref().is_some_and(|error| error.contains(said)), "{said}: {error:?}");
        }
    }
    let scenario = short(Scheme::SlotineLi, adaptive);
    for step_s in [f64::NAN, -1.0, 0.0, 1.0] {
        let mut damaged = scenario.start().snapshot();
        damaged.next_step_s = step_s;
        assert!(scenario.resume(damaged).is_err(), "{step_s}");
    }
}
