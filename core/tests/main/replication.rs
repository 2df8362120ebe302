//! The replication's verdicts: those of the default study, and that each criterion can come out the other way.

use adaptarm_core::experiments::replication::{Verdict, assumptions, check_claims, study, table_1, table_2};
use adaptarm_core::scenario::{InitialVelocityDocument, Run, ScenarioDocument, Scheme};

fn runs(adjust: impl Fn(&mut ScenarioDocument)) -> [Run; 3] {
    let runs: Vec<_> = study(adjust).unwrap().iter().map(adaptarm_core::scenario::Scenario::run).collect();
    runs.try_into().unwrap()
}

fn holding(runs: &[Run; 3]) -> Vec<&'static str> {
    let claims = check_claims(runs);
    claims.iter().filter(|claim| claim.verdict == Verdict::Holds).map(|claim| claim.id).collect()
}

#[test]
fn verdicts_on_the_default_study() {
    assert_eq!(
        holding(&runs(|_| {})),
        [
            "ultimately_bounded",
            "slotine_li_worst",
            "slotine_li_settles_last",
            "third_joint_velocity_stays",
            "observer_peaks"
        ]
    );
}

/// What decides is what ran: the same three runs under other names turn verdicts round.
#[test]
fn verdicts_follow_the_runs() {
    let [proposed, tang_arteaga, slotine_li] = runs(|_| {});
    let renamed = [slotine_li, tang_arteaga, proposed];
    let holding = holding(&renamed);
    assert!(!holding.contains(&"slotine_li_worst"));
    assert!(!holding.contains(&"slotine_li_settles_last"));
    assert!(!holding.contains(&"third_joint_velocity_stays"));
    assert!(!holding.contains(&"observer_peaks"), "it has no observer");
}

#[test]
fn nothing_is_claimed_of_diverged_runs() {
    let coarse = runs(|document| {
        document.integration.step_s = 0.05;
        document.integration.duration_s = 1.0;
        document.recording.samples = 100;
    });
    assert!(coarse.iter().any(|run| run.report.at_s.is_some()));
    for claim in check_claims(&coarse) {
        assert_eq!(claim.verdict, Verdict::NotTested, "{}", claim.id);
        assert!(claim.evidence.contains("diverged"));
    }
}

#[test]
fn nothing_is_claimed_from_a_handful_of_samples() {
    let few = runs(|document| document.recording.samples = 1);
    assert!(check_claims(&few).iter().all(|claim| claim.verdict == Verdict::NotTested));
}

/// What the list says is done is what was done.
#[test]
fn assumptions_follow_the_settings() {
    let said = |document: &ScenarioDocument| {
        assumptions(document).iter().map(|assumption| assumption.here.to_string()).collect::<Vec<_>>().join("\n")
    };
    let mut document = Scheme::Proposed.paper();
    let default = said(&document);
    document.integration.duration_s = 77.0;
    document.integration.step_s = 0.0025;
    document.recording.samples = 88;
    document.initial.velocity = InitialVelocityDocument::Rest;
    document.plant.friction.width_rad_s = 0.5;
    let changed = said(&document);
    for (before, after) in [
        ("12 s", "77 s"),
        ("steps of 0.001 s", "steps of 0.0025 s"),
        ("3000 samples", "88 samples"),
        ("that of the desired trajectory", "at rest"),
        ("v / 0.01", "v / 0.5"),
    ] {
        assert!(default.contains(before) && !default.contains(after), "{before}");
        assert!(changed.contains(after) && !changed.contains(before), "{after}");
    }
}

/// With time the parameters converge, the errors shrink, and more of the paper's story holds.
#[test]
fn long_runs_converge() {
    let long = runs(|document| document.integration.duration_s = 300.0);
    let holding = holding(&long);
    assert!(holding.contains(&"slotine_li_converges"), "{holding:?}");
    assert!(holding.contains(&"observer_replaces_the_sensor"), "{holding:?}");
}

#[test]
fn tables_divide_ours_by_the_papers() {
    let runs = runs(|_| {});
    for table in [table_1(&runs), table_2(&runs)] {
        for ((id, _, entries), run) in table.rows.iter().zip(&runs) {
            assert_eq!(*id, run.report.scheme);
            let metrics = &run.report.metrics;
            let index = if table.number == 1 { &metrics.index_e_deg } else { &metrics.index_de_deg_s };
            for (entry, ours) in entries.iter().zip(index.iter().copied()) {
                assert_eq!(entry.ours, ours);
                assert_eq!(entry.ratio, ours / entry.paper);
            }
        }
    }
    assert_eq!(table_1(&runs).rows[2].2[1].paper, 0.018);
    assert_eq!(table_2(&runs).rows[0].2[2].paper, 0.0023);
}
