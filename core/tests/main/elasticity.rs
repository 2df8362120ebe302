//! Elastic joints: their frequency in closed form, the rigid arm as their limit, and who sees what.

use adaptarm_core::recording::Signal;
use adaptarm_core::scenario::{
    DisturbanceDocument, EffectsDocument, ElasticityDocument, EncodersDocument, InitialVelocityDocument, PdGains, Run,
    Scenario, ScenarioDocument, SchemeDocument,
};

fn elastic(stiffness: Vec<f64>, damping: Vec<f64>, inertia: Vec<f64>) -> ElasticityDocument {
    ElasticityDocument {
        stiffness_nm_rad: stiffness,
        damping_nms_rad: Some(damping),
        motor_inertia_kgm2: inertia,
        encoders: EncodersDocument::Motor,
    }
}

fn run(document: ScenarioDocument) -> Run {
    Scenario::new(document).unwrap().run()
}

/// Two masses and a spring: pushed by a constant torque d at the link, `q = d t²/2I + J d (1 − cos ωt) / (I M ω²)`, M the link's
/// inertia, `I = J + M`, `ω² = k (1/J + 1/M)`.
#[test]
fn an_undriven_pendulum_swings_at_the_frequency_of_two_masses() {
    let (inertia, motor, stiffness, push) = (0.25, 0.1, 100.0, 0.5);
    let gains = PdGains { k_p: vec![0.0], k_d: vec![0.0] };
    let mut document = ScenarioDocument::of_robot("pendulum", SchemeDocument::Pd(Some(gains)));
    document.plant.theta_scale = Some(vec![1.0, 0.0, 0.0, 0.0]);
    document.initial.velocity = InitialVelocityDocument::Rest;
    (document.integration.step_s, document.integration.duration_s, document.recording.samples) = (1e-4, 1.0, 500);
    document.effects = Some(EffectsDocument {
        elasticity: Some(elastic(vec![stiffness], vec![0.0], vec![motor])),
        disturbance: Some(DisturbanceDocument { constant_nm: Some(vec![push]), ..Default::default() }),
        ..Default::default()
    });
    let link = inertia - motor;
    let omega = (stiffness * (1.0 / motor + 1.0 / link)).sqrt();
    let run = run(document);
    for (t, q) in run.recording.times_s().zip(run.recording.signal(Signal::Position, 0)) {
        let swing = motor * push / (inertia * link * omega * omega) * (1.0 - (omega * t).cos());
        let expected = push * t * t / (2.0 * inertia) + swing;
        assert!((q - expected).abs() < 1e-9, "{t} s: {q} for {expected}");
    }
}

/// Twice as stiff, half as far from the rigid arm.
#[test]
fn stiff_joints_tend_to_rigid_ones_with_the_inverse_of_stiffness() {
    for (id, motor) in [("pendulum", vec![0.1]), ("two_link", vec![0.4, 0.1]), ("crs_a465", vec![0.5, 3.0, 0.7])] {
        let mut document = ScenarioDocument::of_robot(id, SchemeDocument::SlotineLi(None));
        document.plant.friction.width_rad_s = 0.5;
        (document.integration.step_s, document.integration.duration_s, document.recording.samples) = (2e-4, 1.5, 300);
        let rigid = run(document.clone());
        let distance = |factor: f64| {
            let of = |each: f64| motor.iter().map(|inertia| each * inertia).collect::<Vec<_>>();
            document.effects = Some(EffectsDocument {
                elasticity: Some(elastic(of(4e4 * factor), of(200.0), motor.clone())),
                ..Default::default()
            });
            let soft = run(document.clone());
            let late = |run: &Run| run.recording.signal(Signal::Position, motor.len() - 1).skip(150).collect::<Vec<_>>();
            late(&soft).iter().zip(late(&rigid)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        };
        let [soft, stiff] = [1.0, 2.0].map(distance);
        println!("{id}: {soft} {stiff}");
        assert!(stiff > 0.0 && (1.7..2.4).contains(&(soft / stiff)), "{id}: {soft} {stiff}");
    }
}

/// At rest under gravity the spring is wound up: the motor's encoder does not see it, the link's does.
#[test]
fn an_encoder_at_the_motor_misses_what_the_spring_gives_way() {
    let settled = |encoders| {
        let mut document = ScenarioDocument::of_robot("pendulum", SchemeDocument::PdGravity(None));
        document.trajectory.kind = adaptarm_core::scenario::TrajectoryKind::MinimumJerk;
        document.trajectory.points_deg = Some(vec![vec![90.0]]);
        document.trajectory.move_s = Some(1.0);
        document.integration.duration_s = 6.0;
        document.effects = Some(EffectsDocument {
            elasticity: Some(ElasticityDocument { encoders, ..elastic(vec![100.0], vec![1.0], vec![0.1]) }),
            ..Default::default()
        });
        run(document).report.q_end_rad[0] - std::f64::consts::FRAC_PI_2
    };
    let (motor, link) = (settled(EncodersDocument::Motor), settled(EncodersDocument::Link));
    // Gravity of 4.905 N·m at 100 N·m/rad. The motor is held where the feedback meets gravity's change over the sag.
    assert!((motor + 0.049).abs() < 0.002, "{motor}");
    assert!(link.abs() < 0.01 * motor.abs(), "{link}");
}

#[test]
fn refusals_say_what_an_elastic_joint_may_be() {
    let refusal = |elasticity: &str| {
        let text = format!(
            r#"{{"format":"adaptarm.scenario/1","scheme":{{"kind":"slotine_li"}},"effects":{{"elasticity":{elasticity}}}}}"#
        );
        let error = Scenario::read(&mut serde_json::Deserializer::from_str(&text)).expect_err(&text);
        format!("{} {error}", error.pointer())
    };
    for (elasticity, pointer, message) in [
        (r#"{"stiffness_nm_rad":[1e4,1e4],"motor_inertia_kgm2":[1,1,1]}"#, "stiffness_nm_rad", "2 numbers where 3"),
        (r#"{"stiffness_nm_rad":[1e4,1e4,0],"motor_inertia_kgm2":[1,1,1]}"#, "stiffness_nm_rad/2", "1 to"),
        (r#"{"stiffness_nm_rad":[1e8,1e4,1e4],"motor_inertia_kgm2":[1,1,1]}"#, "stiffness_nm_rad/0", "steps of 0.001 s"),
        (r#"{"stiffness_nm_rad":[1e4,1e4,1e4],"motor_inertia_kgm2":[3,1,1]}"#, "motor_inertia_kgm2", "of the links"),
        (r#"{"stiffness_nm_rad":[1e4,1e4,1e4]}"#, "", "missing field `motor_inertia_kgm2`"),
    ] {
        let said = refusal(elasticity);
        let pointer = format!("/effects/elasticity/{pointer}").trim_end_matches('/').to_owned();
        assert!(said.starts_with(&format!("{pointer} ")) && said.contains(message), "{elasticity}\n  said: {said}");
    }
}
