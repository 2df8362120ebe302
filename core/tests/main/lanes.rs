//! Runs side by side: each lane has the bits of its run alone, whatever its neighbours do.

use adaptarm_core::lanes;
use adaptarm_core::scenario::{
    Group, InitialVelocityDocument, MethodDocument, OutcomeKind, Run, Scenario, ScenarioDocument, Scheme,
    SchemeDocument, SideBySide, TrajectoryDocument, TrajectoryKind, run_each,
};
use adaptarm_core::simulation::Simulation;
use proptest::prelude::*;
use std::ops::ControlFlow;

fn short(scheme: Scheme) -> ScenarioDocument {
    let mut document = scheme.paper();
    document.integration.duration_s = 0.3;
    document.recording.samples = 60;
    document
}

fn scenario(document: ScenarioDocument) -> Scenario {
    Scenario::new(document).unwrap()
}

/// Every gain and every parameter of the arm scaled: lane `n` differs from its neighbours in all that may differ.
fn varied(scheme: Scheme, n: usize) -> Scenario {
    let factor = 1.0 + 0.07 * n as f64;
    let mut document = scenario(short(scheme)).document().clone();
    document.plant.theta_scale = Some(vec![1.0 / factor; 18]);
    document.plant.friction.width_rad_s *= factor;
    document.seed = n as u64;
    document.trajectory = TrajectoryDocument {
        kind: TrajectoryKind::Fourier,
        frequency_rad_s: Some(1.3),
        offset_deg: Some(vec![factor, 90.0, -90.0]),
        sine_deg: Some(vec![vec![5.0 * factor], vec![7.0, 1.0], vec![3.0]]),
        cosine_deg: Some(vec![vec![factor], vec![], vec![]]),
        ..TrajectoryDocument::default()
    };
    let scale = |gains: &mut [f64]| gains.iter_mut().for_each(|gain| *gain *= factor);
    match &mut document.scheme {
        SchemeDocument::Proposed(Some(gains)) => {
            for gains in [&mut gains.k_v, &mut gains.lambda, &mut gains.lambda_z, &mut gains.lambda_x, &mut gains.k_d] {
                scale(gains);
            }
            scale(&mut gains.gamma_adapt);
            gains.beta *= factor;
            gains.projection.lower_margin *= factor;
        }
        SchemeDocument::TangArteaga(Some(gains)) => {
            scale(&mut gains.gamma_adapt);
            gains.filter_rad_s *= factor;
            gains.delta *= factor;
        }
        SchemeDocument::SlotineLi(Some(gains)) => scale(&mut gains.gamma_adapt),
        _ => panic!("gains are filled in"),
    }
    scenario(document)
}

fn side_by_side(scenarios: &[&Scenario], width: usize) -> Vec<Run> {
    let mut lanes = SideBySide::start(scenarios, width).unwrap();
    // In slices, as a job advances them.
    while !lanes.advance(70) {}
    lanes.finish()
}

#[test]
fn every_lane_has_the_bits_of_its_run_alone() {
    for scheme in Scheme::ALL {
        let scenarios: Vec<_> = (0..8).map(|n| varied(scheme, n)).collect();
        let alone: Vec<_> = scenarios.iter().map(Scenario::run).collect();
        assert!(alone.windows(2).all(|pair| pair[0].report.trajectory_hash != pair[1].report.trajectory_hash));
        for &width in lanes::widths() {
            // Full and with a lane to spare.
            for count in [width, width.div_ceil(2)] {
                let members: Vec<_> = scenarios.iter().take(count).collect();
                assert!(side_by_side(&members, width) == alone[..count], "{} in {width} lanes", scheme.id());
            }
        }
    }
}

/// Gains so high that the run diverges.
fn wild(scheme: Scheme) -> Scenario {
    let mut wild = scenario(short(scheme)).document().clone();
    match &mut wild.scheme {
        SchemeDocument::SlotineLi(Some(gains)) => gains.k_s = vec![1e5; 3],
        SchemeDocument::TangArteaga(Some(gains)) => gains.k_s = vec![1e5; 3],
        SchemeDocument::Proposed(Some(gains)) => gains.k_v = vec![1e5; 3],
        _ => panic!("gains are filled in"),
    }
    scenario(wild)
}

#[test]
fn groups_paused_at_any_step_give_the_same_bits() {
    let adaptive = |n: usize| {
        let mut document = varied(Scheme::SlotineLi, n).document().clone();
        document.integration.method = MethodDocument::Dopri5;
        scenario(document)
    };
    let lanes = (0..5).map(|n| varied(Scheme::SlotineLi, n)).collect();
    let (wild, calm) = (|| wild(Scheme::SlotineLi), || scenario(short(Scheme::SlotineLi)));
    let with_wild_ones = vec![wild(), calm(), wild(), calm()];
    let eight_with_a_wild_one = vec![calm(), calm(), calm(), calm(), wild(), calm()];
    let alone = vec![adaptive(0), adaptive(1)];
    for scenarios in [lanes, with_wild_ones, eight_with_a_wild_one, alone, vec![varied(Scheme::Proposed, 0)]] {
        let members: Vec<_> = scenarios.iter().collect();
        let expected: Vec<_> = scenarios.iter().map(Scenario::run).collect();
        for pause in [1, 2, 7, 150, 299] {
            let mut group = Group::start(&members);
            let mut ended = group.advance(pause);
            let mut pauses = 0;
            while !ended {
                let steps = group.steps();
                group = Group::resume(&members, &group.snapshots()).unwrap();
                assert_eq!(group.steps(), steps);
                ended = group.advance(if pauses < 3 { pause } else { 100 });
                pauses += 1;
            }
            assert_eq!(group.steps(), expected.iter().map(|run| run.report.steps).sum::<u64>());
            assert!(group.finish() == expected, "pause after {pause} steps");
        }
    }
    let (one, other) = (varied(Scheme::Proposed, 1), varied(Scheme::Proposed, 2));
    assert!(Group::resume(&[&one, &other], &Group::start(&[&other, &one]).snapshots()).is_err());
}

/// Alone a run keeps its states in another order than in lanes; its snapshots do not show it.
#[test]
fn a_run_left_alone_goes_on_in_a_lane_and_alone_again() {
    for scheme in Scheme::ALL {
        let scenarios = [varied(scheme, 0), varied(scheme, 1)];
        let members: Vec<_> = scenarios.iter().collect();
        for &width in lanes::widths().iter().filter(|&&width| width > 1) {
            let mut alone: Vec<_> = scenarios.iter().map(Scenario::start).collect();
            for run in &mut alone {
                assert!(!run.advance(100));
            }
            let snapshots = alone.iter().map(Simulation::snapshot).collect();
            let mut together = SideBySide::resume(&members, width, snapshots).unwrap();
            together.advance(100);
            for run in &mut alone {
                assert!(!run.advance(100));
            }
            let snapshots = together.snapshots();
            for ((scenario, snapshot), run) in scenarios.iter().zip(snapshots).zip(&alone) {
                assert!(snapshot == run.snapshot(), "{} in {width} lanes", scheme.id());
                let mut again = scenario.resume(snapshot).unwrap();
                again.advance(u64::MAX);
                assert!(scenario.finish(again) == scenario.run(), "{} in {width} lanes", scheme.id());
            }
        }
    }
}

#[test]
fn a_lane_that_diverges_leaves_the_others_alone() {
    for scheme in Scheme::ALL {
        let (calm, wild) = (scenario(short(scheme)), wild(scheme));
        let (calm_alone, wild_alone) = (calm.run(), wild.run());
        assert_eq!(wild_alone.report.outcome, OutcomeKind::Diverged);
        let mut diverged = wild.start();
        assert!(diverged.advance(u64::MAX));
        for &width in lanes::widths().iter().filter(|&&width| width > 1) {
            for at in 0..width {
                let members: Vec<_> = (0..width).map(|n| if n == at { &wild } else { &calm }).collect();
                for (n, run) in side_by_side(&members, width).into_iter().enumerate() {
                    let expected = if n == at { &wild_alone } else { &calm_alone };
                    assert!(run == *expected, "{}: lane {n} of {width}, wild one {at}", scheme.id());
                }
                // Its states, too, are those that it leaves alone.
                let mut together = SideBySide::start(&members, width).unwrap();
                while !together.advance(70) {}
                assert!(together.snapshots()[at] == diverged.snapshot(), "{}: lane {at} of {width}", scheme.id());
            }
        }
    }
}

#[test]
fn what_takes_other_steps_does_not_run_beside() {
    let first = scenario(short(Scheme::Proposed));
    let other = |change: &dyn Fn(&mut ScenarioDocument)| {
        let mut document = short(Scheme::Proposed);
        change(&mut document);
        scenario(document)
    };
    let others = [
        scenario(short(Scheme::SlotineLi)),
        other(&|document| document.integration.step_s = 5e-4),
        other(&|document| document.integration.duration_s = 0.6),
        other(&|document| document.recording.samples = 30),
        other(&|document| document.initial.velocity = InitialVelocityDocument::Rest),
        other(&|document| document.plant.friction.width_rad_s = 0.0),
        other(&|document| document.trajectory = varied(Scheme::Proposed, 0).document().trajectory.clone()),
    ];
    for other in &others {
        assert!(!first.runs_beside(other) && SideBySide::start(&[&first, other], 2).is_none());
    }
    let adaptive = other(&|document| {
        document.integration.method = MethodDocument::Dopri5;
    });
    let between_steps = other(&|document| document.recording.samples = 70);
    assert!(!adaptive.runs_beside(&adaptive) && !between_steps.runs_beside(&between_steps));
    assert!(SideBySide::start(&[], 2).is_none() && SideBySide::start(&[&first; 3], 2).is_none());
    assert!(SideBySide::start(&[&first], 3).is_none());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    /// Any mixture of scenarios, in any number: each run once, under its own index, with its own bits.
    #[test]
    fn each_of_a_mixture_is_run_once(kinds in prop::collection::vec((0..4_usize, 0..3_usize), 1..20)) {
        let scenarios: Vec<_> = kinds
            .iter()
            .map(|&(kind, n)| {
                let mut document = varied(Scheme::ALL[kind.min(2)], n).document().clone();
                document.integration.duration_s = 0.05;
                document.recording.samples = 10;
                if kind == 3 {
                    document.integration.method = MethodDocument::Dopri5;
                    document.integration.relative_tolerance = Some(1e-6);
                    document.integration.absolute_tolerance = Some(1e-8);
                }
                scenario(document)
            })
            .collect();
        let mut runs = vec![None; scenarios.len()];
        let ended = run_each(&scenarios, |n, run| {
            assert!(runs[n].replace(run).is_none());
            ControlFlow::Continue(())
        });
        prop_assert!(ended.is_continue());
        for (scenario, run) in scenarios.iter().zip(runs) {
            prop_assert!(run == Some(scenario.run()));
        }
        let mut heard = 0;
        let broken_off = run_each(&scenarios, |_, _| { heard += 1; ControlFlow::Break(()) });
        prop_assert!(broken_off.is_break() && heard == 1);
    }
}
