//! Stribeck's friction over whole runs of a weightless pendulum, against closed forms: coasting to rest, sticking and breaking
//! away, and what it takes of a feedback at constant speed.

use adaptarm_core::recording::Signal;
use adaptarm_core::scenario::{
    DisturbanceDocument, EffectsDocument, InitialVelocityDocument, PdGains, Run, Scenario, ScenarioDocument,
    SchemeDocument, StribeckDocument, TrajectoryDocument, TrajectoryKind,
};

const INERTIA: f64 = 0.25;
const VISCOUS: f64 = 1.0;
const COULOMB: f64 = 0.2;
const EXCESS: f64 = 0.3;

/// A pendulum without weight under PD, wanted at `q_d = A sin ω t`; `viscous` in parts of the usual friction.
fn pendulum([k_p, k_d]: [f64; 2], viscous: f64, stribeck_rad_s: f64, [a_deg, frequency]: [f64; 2]) -> ScenarioDocument {
    let gains = PdGains { k_p: vec![k_p], k_d: vec![k_d] };
    let mut document = ScenarioDocument::of_robot("pendulum", SchemeDocument::Pd(Some(gains)));
    document.plant.theta_scale = Some(vec![1.0, viscous, 1.0, 0.0]);
    document.trajectory = TrajectoryDocument {
        kind: TrajectoryKind::Fourier,
        frequency_rad_s: Some(frequency),
        offset_deg: Some(vec![0.0]),
        sine_deg: Some(vec![vec![a_deg]]),
        ..Default::default()
    };
    let stribeck = StribeckDocument { excess_nm: vec![EXCESS], velocity_rad_s: stribeck_rad_s };
    document.effects = Some(EffectsDocument { stribeck: Some(stribeck), ..Default::default() });
    document
}

fn run(document: ScenarioDocument) -> Run {
    Scenario::new(document).unwrap().run()
}

/// Times and velocities of a run that is wanted at `A sin ω t`.
fn velocities(run: &Run, [a_deg, frequency]: [f64; 2]) -> Vec<(f64, f64)> {
    let wanted = |t: f64| a_deg.to_radians() * frequency * (frequency * t).cos();
    run.recording.times_s().zip(run.recording.signal(Signal::ErrorRate, 0)).map(|(t, e)| (t, e + wanted(t))).collect()
}

/// `I v' = −F_c − F_x / (1 + u²)` with `u = v/v_s` and `k = F_x/F_c`:
/// `t = (I v_s/F_c) (u₀ − u − k/√(1+k) (atan(u₀/√(1+k)) − atan(u/√(1+k))))`.
#[test]
fn a_coasting_pendulum_comes_to_rest_when_the_closed_form_says() {
    let (wanted, stribeck) = ([90.0, 2.0], 0.5);
    let mut document = pendulum([0.0; 2], 0.0, stribeck, wanted);
    document.plant.friction.width_rad_s = 0.0;
    (document.integration.duration_s, document.recording.samples) = (4.0, 400);
    let (k, start) = (EXCESS / COULOMB, std::f64::consts::PI / stribeck);
    let root = (1.0 + k).sqrt();
    let until = |u: f64| {
        let bend = k / root * ((start / root).atan() - (u / root).atan());
        INERTIA * stribeck / COULOMB * (start - u - bend)
    };
    let rest_s = until(0.0);
    assert!((3.0..3.3).contains(&rest_s), "{rest_s}");
    for (t, v) in velocities(&run(document), wanted) {
        if t < rest_s - 0.01 {
            assert!((until(v / stribeck) - t).abs() < 1e-9, "{v} rad/s at {t} s");
        } else if t > rest_s + 0.01 {
            // A step turns it round where it stands, and the next turns it back.
            assert!(v.abs() <= (COULOMB + EXCESS) / INERTIA * 1e-3, "{v} rad/s at {t} s");
        }
    }
}

/// `D v + (F_c + F_x / (1 + (v/v_s)²)) tanh(v/w)`.
fn friction(v: f64, stribeck_rad_s: f64, width_rad_s: f64) -> f64 {
    VISCOUS * v + (COULOMB + EXCESS / (1.0 + (v / stribeck_rad_s).powi(2))) * (v / width_rad_s).tanh()
}

/// Pushed less than what breaks it away, it creeps where it rested and runs on where it ran; pushed more, it runs.
#[test]
fn it_sticks_until_it_breaks_away_and_does_not_stick_again() {
    let (stribeck, width) = (0.1, 0.005);
    let torque = |v: f64| friction(v, stribeck, width);
    let (peak_at, peak) = (1..2000)
        .map(|n| f64::from(n) * 1e-4)
        .map(|v| (v, torque(v)))
        .fold((0.0, 0.0), |best, it| if it.1 > best.1 { it } else { best });
    // Nearly the whole of F_c + F_x, and some viscous friction.
    assert!((0.49..0.51).contains(&peak), "{peak} at {peak_at} rad/s");
    // Where friction equals the push: rising with v below the peak, and again far beyond it.
    let balance = |push: f64, [mut low, mut high]: [f64; 2]| {
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if torque(middle) < push { low = middle } else { high = middle }
        }
        low
    };
    let pushed = |push: f64, moves: bool| {
        let wanted = [if moves { 90.0 } else { 0.0 }, 2.0];
        let mut document = pendulum([0.0; 2], 10.0, stribeck, wanted);
        document.plant.friction.width_rad_s = width;
        if !moves {
            document.initial.velocity = InitialVelocityDocument::Rest;
        }
        let disturbance = DisturbanceDocument { constant_nm: Some(vec![push]), ..Default::default() };
        document.effects.as_mut().unwrap().disturbance = Some(disturbance);
        (document.integration.duration_s, document.recording.samples) = (20.0, 40);
        velocities(&run(document), wanted).pop().unwrap().1
    };
    let (less, more) = (peak - 0.01, peak + 0.01);
    let (creep, slide) = (balance(less, [0.0, peak_at]), balance(less, [0.15, 10.0]));
    assert!(creep < peak_at && slide > 0.2);
    for (push, moves, expected) in
        [(less, false, creep), (less, true, slide), (more, false, balance(more, [0.15, 10.0]))]
    {
        let found = pushed(push, moves);
        assert!((found - expected).abs() < 1e-9, "{found} rad/s for {expected} under {push} N·m");
    }
}

/// At constant speed PD lags by all of friction: `e = −F(v)/K_p`.
#[test]
fn at_constant_speed_a_feedback_carries_the_friction() {
    let (stribeck, width) = (0.05, 0.005);
    // So slow a sine is a straight line for a while. Where friction rises steeply, an error takes a second to settle.
    for a_deg in [300.0, 900.0, 3600.0] {
        let wanted = [a_deg, 1e-3];
        let mut document = pendulum([50.0, 10.0], 10.0, stribeck, wanted);
        document.plant.friction.width_rad_s = width;
        (document.integration.duration_s, document.recording.samples) = (20.0, 50);
        let speed = a_deg.to_radians() * 1e-3 * 0.02_f64.cos();
        let expected = -friction(speed, stribeck, width) / 50.0;
        let found = run(document).recording.signal(Signal::Error, 0).next_back().unwrap();
        assert!((found / expected - 1.0).abs() < 3e-5, "{found} rad for {expected} at {speed} rad/s");
    }
}

#[test]
fn none_of_it_changes_no_bit() {
    let plain = |stribeck: Option<StribeckDocument>| {
        let mut document = pendulum([50.0, 10.0], 1.0, 0.05, [90.0, 2.0]);
        document.effects = stribeck.map(|it| EffectsDocument { stribeck: Some(it), ..Default::default() });
        run(document).report.trajectory_hash
    };
    let excess = |nm: f64| Some(StribeckDocument { excess_nm: vec![nm], velocity_rad_s: 0.05 });
    assert_eq!(plain(excess(0.0)), plain(None));
    assert_ne!(plain(excess(0.1)), plain(None));
}
