//! Diagnostics against what is known otherwise: balances, proofs, closed forms.

use adaptarm_core::diagnostics::{Diagnostics, Trace, Traced};
use adaptarm_core::scenario::{
    ComputedTorqueGains, EffectsDocument, ModelParameters, Run, SamplingDocument, Scenario, ScenarioDocument, Scheme,
    SchemeDocument, StribeckDocument, TrajectoryDocument, TrajectoryKind, VelocityDocument, VelocityKind,
};

fn diagnose(document: ScenarioDocument) -> (Diagnostics, Trace, Run) {
    let scenario = Scenario::new(document).unwrap();
    let run = scenario.run();
    let (diagnostics, trace) = scenario.diagnose(&run.recording);
    assert_eq!(trace.len(), run.recording.len());
    (diagnostics, trace, run)
}

fn document(robot: &str, scheme: SchemeDocument, duration_s: f64, samples: usize) -> ScenarioDocument {
    let mut document = ScenarioDocument::of_robot(robot, scheme);
    (document.integration.duration_s, document.recording.samples) = (duration_s, samples);
    document
}

const ROBOTS: [&str; 3] = ["crs_a465", "two_link", "pendulum"];

fn assumptions(diagnostics: &Diagnostics) -> Vec<&str> {
    diagnostics.violations.iter().map(|violation| violation.assumption.as_str()).collect()
}

/// Finer samples close the gap in the energy balance with the square of their distance.
#[test]
fn energy_is_balanced() {
    for robot in ROBOTS {
        let gap = |samples| {
            let mut document = document(robot, SchemeDocument::SlotineLi(None), 2.0, samples);
            document.plant.friction.width_rad_s = 0.5;
            document.effects = Some(EffectsDocument {
                stribeck: Some(StribeckDocument { excess_nm: vec![0.5; joints(robot)], velocity_rad_s: 0.5 }),
                ..Default::default()
            });
            let energy = diagnose(document).0.energy.unwrap();
            assert!(energy.dissipated_j > 0.1 && energy.supplied_j > 0.1, "{robot}: {energy:?}");
            energy.largest_gap_j / energy.dissipated_j
        };
        let (coarse, fine) = (gap(500), gap(1000));
        assert!(fine < 2e-4 && (3.5..4.5).contains(&(coarse / fine)), "{robot}: {coarse} {fine}");
    }
}

fn joints(robot: &str) -> usize {
    adaptarm_core::robots::robot(robot).unwrap().joint_count()
}

/// Slotine and Li's proof, read off runs of it: V falls, at the rate that feedback and friction explain, to second order of the samples.
#[test]
fn the_gradient_laws_lyapunov_function_falls_as_proved() {
    for robot in ROBOTS {
        let excess = |samples| {
            let mut document = document(robot, SchemeDocument::SlotineLi(None), 2.0, samples);
            document.plant.friction.width_rad_s = 0.5;
            let (diagnostics, trace, _) = diagnose(document);
            assert_eq!(assumptions(&diagnostics), Vec::<&str>::new());
            let lyapunov = diagnostics.lyapunov.unwrap();
            assert!(lyapunov.rising_share == 0.0 && lyapunov.end < lyapunov.start && lyapunov.largest_rate <= 0.0);
            let fastest = (0..samples).map(|row| trace.at(Traced::LyapunovRate, row)).fold(0.0, f64::min);
            lyapunov.largest_excess_rate / -fastest
        };
        let (coarse, fine) = (excess(1000), excess(2000));
        assert!(fine < 1e-3 && (3.0..5.0).contains(&(coarse / fine)), "{robot}: {coarse} {fine}");
    }
}

/// Computed torque with the true model: `V̇ = −ėᵀ Kd ė`; and its motion is the desired one, so both excite alike.
#[test]
fn computed_torque_is_its_linear_oscillator_and_excites_as_desired() {
    for robot in ROBOTS {
        let n = joints(robot);
        let gains =
            ComputedTorqueGains { parameters: ModelParameters::True, k_p: vec![100.0; n], k_d: vec![20.0; n] };
        let (diagnostics, ..) = diagnose(document(robot, SchemeDocument::ComputedTorque(Some(gains)), 4.0, 1000));
        assert_eq!(assumptions(&diagnostics), Vec::<&str>::new());
        let (desired, actual) = (diagnostics.desired_excitation.unwrap(), diagnostics.actual_excitation.unwrap());
        for (a, b) in desired.eigenvalues_n2m2.iter().zip(&actual.eigenvalues_n2m2) {
            assert!((a - b).abs() < 1e-6 * desired.eigenvalues_n2m2.last().unwrap(), "{robot}: {a} {b}");
        }
        assert!(diagnostics.parameter_error.is_none());
        assert!(diagnostics.lyapunov.unwrap().largest_rate < 1e-12);
    }
}

/// At rest a pendulum shows its gravity alone; a sine shows all four parameters, as its Gram matrix in closed form says.
#[test]
fn a_pendulum_at_rest_shows_gravity_alone() {
    let mut at_rest = document("pendulum", SchemeDocument::SlotineLi(None), 8.0, 800);
    at_rest.trajectory = TrajectoryDocument {
        kind: TrajectoryKind::MinimumJerk,
        points_deg: Some(vec![vec![30.0]]),
        move_s: Some(1.0),
        ..TrajectoryDocument::of_robot()
    };
    let (diagnostics, trace, _) = diagnose(at_rest);
    let meter = diagnostics.desired_excitation.unwrap();
    assert!(!meter.is_persistent && meter.rank == 1 && meter.worst_window_n2m2 == 0.0);
    // θ4 sin 30°, squared, with θ4 of 4.905 N·m.
    assert!((meter.eigenvalues_n2m2[3] - 0.25 * 4.905 * 4.905).abs() < 1e-9, "{:?}", meter.eigenvalues_n2m2);
    let named: Vec<_> = meter.unidentifiable.iter().map(|found| (found.terms.len(), &*found.terms[0].parameter)).collect();
    assert_eq!(named.len(), 3);
    assert!(["θ1", "θ2", "θ3"].iter().all(|symbol| named.contains(&(1, symbol))), "{named:?}");
    let split = diagnostics.parameter_error.unwrap();
    assert!((split.start.all - 2.0).abs() < 1e-12, "nothing is known of four parameters");
    assert!(split.end.excited < split.start.excited);
    for row in 0..trace.len() {
        let [excited, unexcited] = [Traced::ExcitedError, Traced::UnexcitedError].map(|part| trace.at(part, row));
        assert!(excited * excited + unexcited * unexcited <= 4.0 + 1e-9);
    }

    // q = ½ sin t: G of [q̈, q̇, sgn q̇, sin q] has ⟨q̈²⟩ = ⟨q̇²⟩ = 1/8, ⟨|q̇|⟩ = 1/π, ⟨q̈ sin q⟩ = −½ J1(½), ⟨sin²q⟩ = (1 − J0(1))/2,
    // ⟨sgn²⟩ = 1 and all else zero, so its eigenvalues are those of two 2×2 matrices.
    let mut moving = document("pendulum", SchemeDocument::ComputedTorque(None), 8.0 * std::f64::consts::PI, 4000);
    moving.plant.friction.width_rad_s = 0.0;
    moving.integration.step_s = moving.integration.duration_s / 4000.0;
    moving.trajectory = TrajectoryDocument {
        kind: TrajectoryKind::Fourier,
        frequency_rad_s: Some(1.0),
        offset_deg: Some(vec![0.0]),
        sine_deg: Some(vec![vec![0.5_f64.to_degrees()]]),
        cosine_deg: Some(vec![]),
        ..TrajectoryDocument::of_robot()
    };
    let meter = diagnose(moving).0.desired_excitation.unwrap();
    let [inertia, viscous, coulomb, gravity] = [0.25, 0.1, 0.2, 4.905];
    let (j1_half, j0_one) = (0.242_268_457_674_873_9, 0.765_197_686_557_966_6);
    let pair = |a: f64, b: f64, c: f64| {
        let (mean, root) = (0.5 * (a + c), (0.25 * (a - c) * (a - c) + b * b).sqrt());
        [mean - root, mean + root]
    };
    let conservative = pair(
        inertia * inertia / 8.0,
        -0.5 * j1_half * inertia * gravity,
        gravity * gravity * 0.5 * (1.0 - j0_one),
    );
    let friction = pair(viscous * viscous / 8.0, viscous * coulomb / std::f64::consts::PI, coulomb * coulomb);
    let mut expected = [conservative, friction].concat();
    expected.sort_by(f64::total_cmp);
    for (found, expected) in meter.eigenvalues_n2m2.iter().zip(&expected) {
        assert!((found - expected).abs() < 1e-3 * expected, "{:?} for {expected:?}", meter.eigenvalues_n2m2);
    }
    assert!(meter.is_persistent && meter.rank == 4 && meter.unidentifiable.is_empty());
}

/// Violated assumptions are named, with when and how often.
#[test]
fn what_a_proof_assumes_and_a_run_lacks_is_named() {
    let (diagnostics, ..) = diagnose(document("crs_a465", SchemeDocument::Proposed(None), 2.0, 500));
    let found = assumptions(&diagnostics);
    assert!(found.starts_with(&["exact_velocity"]), "{found:?}");
    let (diagnostics, ..) = diagnose(document("crs_a465", SchemeDocument::TangArteaga(None), 2.0, 500));
    assert_eq!(assumptions(&diagnostics), ["scalar_adaptation_gain"]);

    let mut limited = document("crs_a465", SchemeDocument::SlotineLi(None), 2.0, 500);
    limited.velocity = Some(VelocityDocument { kind: VelocityKind::HighGain, ..Default::default() });
    limited.effects = Some(EffectsDocument {
        sampling: Some(SamplingDocument { period_s: 0.002, delay_s: 0.0 }),
        encoder_step_rad: Some(1e-5),
        torque_limit_nm: Some(vec![10.0, 20.0, 10.0]),
        ..Default::default()
    });
    let (diagnostics, ..) = diagnose(limited);
    assert_eq!(
        assumptions(&diagnostics),
        ["exact_velocity", "continuous_controller", "exact_measurement", "unlimited_torque"]
    );
    let cut = &diagnostics.violations[3];
    assert!(cut.share.is_some_and(|share| share > 0.0 && share < 1.0) && cut.first_s.is_some());
    let (diagnostics, ..) = diagnose(document("crs_a465", SchemeDocument::Pd(None), 2.0, 500));
    assert_eq!(assumptions(&diagnostics), ["exact_model", "desired_rest"]);
}

/// On the A465 seven of the eighteen parameters hardly show: what their own size says.
#[test]
fn the_papers_motion_hardly_shows_the_small_inertias() {
    for scheme in Scheme::ALL {
        let (diagnostics, ..) = diagnose(scheme.paper());
        println!("{diagnostics:#?}");
        let meter = diagnostics.desired_excitation.unwrap();
        assert_eq!(meter.eigenvalues_n2m2.len(), 18);
    }
}
