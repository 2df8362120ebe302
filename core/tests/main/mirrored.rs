//! Imperfections know no side: a run wanted on the other side, and pushed the other way, is the mirrored run to the bit.

use adaptarm_core::recording::{Recording, Signal};
use adaptarm_core::scenario::{
    DisturbanceDocument, EffectsDocument, ElasticityDocument, SamplingDocument, Scenario, ScenarioDocument,
    SchemeDocument, StribeckDocument, TrajectoryDocument, TrajectoryKind, VelocityDocument, VelocityKind,
};

/// The first joint swings to `side` and is pushed there; the others are as they are.
fn recording(robot: &str, joints: usize, scheme: SchemeDocument, effects: &EffectsDocument, side: f64) -> Recording {
    let mut document = ScenarioDocument::of_robot(robot, scheme);
    let each = |first: f64, rest: f64| {
        let mut all = vec![rest; joints];
        all[0] = first;
        all
    };
    document.trajectory = TrajectoryDocument {
        kind: TrajectoryKind::Fourier,
        offset_deg: Some(each(side * 7.0, 40.0)),
        sine_deg: Some(each(side * 31.0, 13.0).into_iter().map(|a| vec![a, 0.3 * a]).collect()),
        ..Default::default()
    };
    document.velocity = Some(VelocityDocument { kind: VelocityKind::HighGain, ..Default::default() });
    let disturbance = DisturbanceDocument {
        constant_nm: Some(each(side * 0.4, 0.1)),
        sine_nm: Some(each(side * 0.7, 0.3)),
        frequency_rad_s: Some(9.0),
        ..Default::default()
    };
    document.effects = Some(EffectsDocument { disturbance: Some(disturbance), ..effects.clone() });
    (document.integration.duration_s, document.recording.samples) = (2.0, 100);
    Scenario::new(document).unwrap().run().recording
}

fn imperfections(joints: usize) -> Vec<EffectsDocument> {
    let none = || EffectsDocument {
        sampling: Some(SamplingDocument { period_s: 0.002, delay_s: 0.001 }),
        ..Default::default()
    };
    let elasticity = ElasticityDocument {
        compliance_rad_nm: Some(vec![1e-4; joints]),
        damping_nms_rad: Some(vec![20.0; joints]),
        motor_inertia_kgm2: if joints == 1 { vec![0.1] } else { vec![0.5, 3.0, 0.7] },
        ..Default::default()
    };
    let stribeck = StribeckDocument { excess_nm: vec![0.3; joints], velocity_rad_s: 0.05 };
    vec![
        none(),
        EffectsDocument { stribeck: Some(stribeck), ..none() },
        EffectsDocument { encoder_step_rad: Some(1e-3), ..none() },
        EffectsDocument { torque_limit_nm: Some(vec![1.5; joints]), ..none() },
        EffectsDocument { voltage_limit_v: Some(1.0), ..none() },
        EffectsDocument { elasticity: Some(elasticity), ..none() },
    ]
}

#[test]
fn a_mirrored_run_is_the_run_mirrored() {
    for (robot, joints) in [("pendulum", 1), ("crs_a465", 3)] {
        for effects in imperfections(joints) {
            for scheme in [SchemeDocument::Pd(None), SchemeDocument::SlotineLi(None)] {
                let [right, left] = [1.0, -1.0].map(|side| recording(robot, joints, scheme.clone(), &effects, side));
                assert!(right.len() > 50 && right.len() == left.len(), "{robot} {scheme:?} {effects:?}");
                for signal in [Signal::Error, Signal::ErrorRate, Signal::Torque, Signal::Position] {
                    for joint in 0..joints {
                        let sign = if joint == 0 { -1.0 } else { 1.0 };
                        let mirrored: Vec<_> = left.signal(signal, joint).map(|x| sign * x).collect();
                        let found: Vec<_> = right.signal(signal, joint).collect();
                        assert!(found.iter().any(|x| *x != 0.0));
                        assert_eq!(found, mirrored, "{robot} {scheme:?} {signal:?} {joint} {effects:?}");
                    }
                }
            }
        }
    }
}
