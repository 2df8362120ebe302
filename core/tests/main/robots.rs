//! The other robots: closed forms of their own, and every scheme on every robot with the gains that it has by default.

use crate::laws::Told;
use adaptarm_core::dynamics::{FrictionSign, Plant};
use adaptarm_core::integrators::{Aligned, Rk4};
use adaptarm_core::lanes;
use adaptarm_core::metrics::peak;
use adaptarm_core::recording::Signal;
use adaptarm_core::robots::{Pendulum, ROBOTS, Robot, TwoLink};
use adaptarm_core::scenario::{
    OutcomeKind, ReadError, Run, Scenario, ScenarioDocument, Scheme, SchemeDocument, SideBySide, TrajectoryKind,
    VelocityDocument, VelocityKind, preset,
};
use nalgebra::SVector;
use std::f64::consts::{FRAC_PI_2, TAU};

const OTHERS: [&str; 2] = ["two_link", "pendulum"];

fn document(robot: &str, scheme: Scheme) -> ScenarioDocument {
    ScenarioDocument::of_robot(robot, scheme.paper().scheme)
}

fn run(document: ScenarioDocument) -> Run {
    Scenario::new(document).unwrap().run()
}

fn read(text: &str) -> Result<Scenario, ReadError<serde_json::Error>> {
    Scenario::read(&mut serde_json::Deserializer::from_str(text))
}

/// Largest tracking error between two times, deg.
fn worst_deg(run: &Run, from_s: f64, to_s: f64) -> f64 {
    let errors = |joint| run.recording.signal(Signal::Error, joint).zip(run.recording.times_s());
    let within = |joint| errors(joint).filter(|&(_, t)| t >= from_s && t <= to_s).map(|(e, _)| e.to_degrees());
    (0..run.recording.columns().joints).map(|joint| peak(within(joint))).fold(0.0, f64::max)
}

/// Swings `plant` from `q` at velocity `v` without torque; `each` sees every step's end.
fn swing<R: Robot<N, P>, const N: usize, const P: usize>(
    plant: &Plant<R, f64, N, P>,
    x: &mut [f64],
    steps: u32,
    mut each: impl FnMut(f64, &[f64]),
) {
    let mut state = Aligned::from(&*x);
    let mut rk4 = Rk4::new(2 * N);
    let still = SVector::<f64, N>::zeros();
    for n in 0..steps {
        rk4.step(f64::from(n) * 1e-3, f64::from(n + 1) * 1e-3, &mut state, |_, x, rate| {
            let [q, v] = [&x[..N], &x[N..]].map(SVector::<f64, N>::from_column_slice);
            let a = plant.acceleration(&R::geometry(&q), &v, &plant.friction_sign.of(&v), &still);
            rate[..N].copy_from_slice(v.as_slice());
            rate[N..].copy_from_slice(a.as_slice());
        });
        each(f64::from(n + 1) * 1e-3, &state);
    }
    x.copy_from_slice(&state);
}

/// A robot's parameters without friction.
fn smooth<R: Told<N, P>, const N: usize, const P: usize>() -> SVector<f64, P> {
    let mut theta = R::theta();
    theta.as_mut_slice()[R::FRICTION..R::FRICTION + 2 * N].fill(0.0);
    theta
}

#[test]
fn free_arms_keep_their_energy() {
    fn check<R: Told<N, P>, const N: usize, const P: usize>(mut x: Vec<f64>) {
        let plant = Plant::<R, f64, N, P>::new(smooth::<R, N, P>(), FrictionSign::True);
        let energy = |x: &[f64]| {
            let [q, v] = [&x[..N], &x[N..]].map(SVector::<f64, N>::from_column_slice);
            let (h, _) = R::inertia_and_bias(&R::geometry(&q), &plant.theta, &v, &SVector::zeros());
            0.5 * v.dot(&(h * v)) + R::potential(std::array::from_fn(|i| crate::dual::Dual::new(q[i], 0.0))).value
        };
        let (start, mut worst) = (energy(&x), 0.0_f64);
        swing(&plant, &mut x, 5000, |_, x| worst = worst.max((energy(x) - start).abs()));
        assert!(worst < 1e-7 * start.abs().max(1.0), "{}: {worst} of {start}", R::DATA.id);
    }
    check::<TwoLink, 2, 11>(vec![0.5, -0.3, 0.8, 0.5]);
    check::<Pendulum, 1, 4>(vec![2.0, 0.5]);
}

/// K by the arithmetic-geometric mean: `K(k) = π / (2 agm(1, √(1 − k²)))`.
fn complete_elliptic_integral(k: f64) -> f64 {
    let (mut a, mut g) = (1.0, (1.0 - k * k).sqrt());
    for _ in 0..20 {
        (a, g) = (0.5 * (a + g), f64::sqrt(a * g));
    }
    FRAC_PI_2 / a
}

#[test]
fn the_pendulum_keeps_time_as_the_elliptic_integral_says() {
    let theta = smooth::<Pendulum, 1, 4>();
    let plant = Plant::<Pendulum, f64, 1, 4>::new(theta, FrictionSign::True);
    for amplitude in [0.1, 1.0, 2.5, 3.0] {
        let period = 4.0 * (theta[0] / theta[3]).sqrt() * complete_elliptic_integral((0.5_f64 * amplitude).sin());
        let (mut before, mut crossings) = ((0.0, amplitude), Vec::new());
        swing(&plant, &mut [amplitude, 0.0], 8000, |t, x| {
            if before.1 < 0.0 && x[0] >= 0.0 {
                crossings.push(before.0 - before.1 * (t - before.0) / (x[0] - before.1));
            }
            before = (t, x[0]);
        });
        for pair in crossings.windows(2) {
            assert!((pair[1] - pair[0] - period).abs() < 1e-5, "{amplitude}: {pair:?} for {period}");
        }
        assert!(crossings.len() >= 2 && (crossings[0] - 0.75 * period).abs() < 1e-5, "{crossings:?}");
    }
}

/// Viscous friction alone slows a pendulum without weight as `v0 exp(−θ2 t / θ1)`.
#[test]
fn viscous_friction_decays_as_it_should() {
    let mut theta = smooth::<Pendulum, 1, 4>();
    (theta[1], theta[3]) = (0.1, 0.0);
    let plant = Plant::<Pendulum, f64, 1, 4>::new(theta, FrictionSign::True);
    let mut x = vec![0.0, 2.0];
    swing(&plant, &mut x, 3000, |_, _| {});
    assert!((x[1] - 2.0 * f64::exp(-0.1 * 3.0 / 0.25)).abs() < 1e-10, "{x:?}");
    assert!((x[0] - 2.5 * (2.0 - x[1])).abs() < 1e-9);
}

#[test]
fn every_scheme_converges_on_every_robot_with_its_own_gains() {
    for robot in OTHERS {
        for scheme in Scheme::ALL {
            let mut long = document(robot, scheme);
            (long.integration.duration_s, long.recording.samples) = (20.0, 2000);
            let run = run(long.clone());
            let (early, late) = (worst_deg(&run, 0.0, 2.0), worst_deg(&run, 10.0, 20.0));
            println!("{robot} {}: {early:.3} deg, then {late:.3} deg", scheme.id());
            assert_eq!(run.report.outcome, OutcomeKind::Completed);
            assert!(late < 0.5 && late < 0.25 * early, "{robot} {}: {early}, then {late} deg", scheme.id());
            let limits = ROBOTS.iter().find(|data| data.id == robot).unwrap().effort_limit_nm;
            assert!(run.report.metrics.tau_peak_nm.iter().zip(limits).all(|(torque, limit)| torque < limit));
            // Steps twice as long give the same run: 1 ms is far from unstable.
            long.integration.step_s = 0.002;
            let coarse = Scenario::new(long).unwrap().run();
            for (fine, coarse) in run.report.metrics.index_e_deg.iter().zip(&coarse.report.metrics.index_e_deg) {
                assert!((fine - coarse).abs() < 1e-4 * fine, "{robot} {}: {fine} {coarse}", scheme.id());
            }
        }
    }
}

/// The book's figure 9.8 shows errors that start at some degrees and have nearly gone after 3 s.
#[test]
fn the_textbooks_arm_does_as_the_textbook_says() {
    let run = run(preset("two_link_textbook").unwrap().document());
    let (early, late) = (worst_deg(&run, 0.0, 1.0), worst_deg(&run, 2.0, 3.0));
    assert!((2.0..5.0).contains(&early) && late < 0.2 * early, "{early}, then {late} deg");
    assert!(run.report.theta_true[4..].iter().chain(&run.report.theta_hat_end[4..]).all(|&theta| theta == 0.0));
}

#[test]
fn gains_left_out_are_the_robots_own() {
    let partial = read(
        r#"{"format":"adaptarm.scenario/1","robot":"two_link","scheme":{"kind":"proposed","gains":{"beta":8,"k_v":[50,60]}}}"#,
    )
    .unwrap();
    let own = Scenario::new(document("two_link", Scheme::Proposed)).unwrap();
    let [SchemeDocument::Proposed(Some(given)), SchemeDocument::Proposed(Some(own))] =
        [&partial, &own].map(|scenario| &scenario.document().scheme)
    else {
        panic!("gains are filled in")
    };
    assert_eq!((given.beta, &given.k_v, own.beta), (8.0, &vec![50.0, 60.0], 5.5));
    assert_eq!((&given.gamma_adapt, &given.k_d, given.rho), (&own.gamma_adapt, &own.k_d, own.rho));
    assert_eq!(partial.document().trajectory.kind, TrajectoryKind::Fourier);
    let reread = read(&serde_json::to_string(partial.document()).unwrap()).unwrap();
    assert_eq!((reread.hash(), &reread), (partial.hash(), &partial));
}

/// An observer in the place of another scheme's velocity once had the A465's gains on every robot, three numbers where two were needed.
#[test]
fn an_observer_without_gains_has_the_robots_own() {
    for id in OTHERS {
        let mut other = document(id, Scheme::SlotineLi);
        other.velocity = Some(VelocityDocument { kind: VelocityKind::Observer, ..Default::default() });
        let other = Scenario::new(other).unwrap();
        let own = Scenario::new(document(id, Scheme::Proposed)).unwrap();
        let SchemeDocument::Proposed(Some(own)) = &own.document().scheme else { panic!("gains are filled in") };
        let velocity = other.document().velocity.as_ref().unwrap();
        assert_eq!((velocity.lambda_z.as_ref(), velocity.k_d.as_ref()), (Some(&own.lambda_z), Some(&own.k_d)), "{id}");
        assert_eq!(other.run().report.outcome, OutcomeKind::Completed, "{id}");
    }
}

#[test]
fn refusals_know_the_robot() {
    let with = |robot: &str, rest: &str| {
        format!(r#"{{"format":"adaptarm.scenario/1","robot":"{robot}","scheme":{{"kind":"slotine_li"{rest}}}"#)
    };
    let cases = [
        (with("two_link", r#","gains":{"k_s":[1,2,3]}}"#), "/scheme/gains/k_s", "has 3 numbers where 2 are needed"),
        (with("pendulum", r#","gains":{"k_s":[]}}"#), "/scheme/gains/k_s", "expected a number per joint or parameter"),
        (with("pendulum", r#"},"plant":{"theta_scale":[1,1]}"#), "/plant/theta_scale", "has 2 numbers where 4"),
        (with("two_link", r#"},"trajectory":{"kind":"paper"}"#), "/trajectory/kind", "no meaning for robot two_link"),
        (
            with("two_link", r#"},"trajectory":{"kind":"default","offset_deg":[1,2]}"#),
            "/trajectory/offset_deg",
            "has no meaning for kind default",
        ),
        (
            with("two_link", r#"},"plant":{"theta_scale":[1,0.01,100,100,1,1,1,1,1,1,1]}"#),
            "/plant/theta_scale",
            "not positive definite",
        ),
    ];
    for (text, pointer, message) in cases {
        let error = read(&text).expect_err(&text);
        let said = error.to_string();
        assert!(said.contains(message), "{text}\n  said: {said}");
        assert_eq!(error.pointer(), pointer, "{said}");
    }
}

#[test]
fn every_lane_has_the_bits_of_its_run_alone_on_every_robot() {
    for robot in OTHERS {
        for scheme in Scheme::ALL {
            let scenarios: Vec<_> = (0..4)
                .map(|n| {
                    let mut short = document(robot, scheme);
                    (short.integration.duration_s, short.recording.samples) = (0.3, 60);
                    short.plant.theta_scale = Some(vec![1.0 + 0.07 * f64::from(n); short_parameters(robot)]);
                    Scenario::new(short).unwrap()
                })
                .collect();
            let alone: Vec<_> = scenarios.iter().map(Scenario::run).collect();
            for &width in lanes::widths() {
                let members: Vec<_> = scenarios.iter().take(width).collect();
                let mut together = SideBySide::start(&members, width).unwrap();
                together.advance(u64::MAX);
                assert!(together.finish() == alone[..members.len()], "{robot} {} in {width}", scheme.id());
            }
        }
    }
    let [a, b] = OTHERS.map(|robot| Scenario::new(document(robot, Scheme::SlotineLi)).unwrap());
    assert!(!a.runs_beside(&b));
}

fn short_parameters(robot: &str) -> usize {
    ROBOTS.iter().find(|data| data.id == robot).unwrap().parameter_count()
}

#[test]
fn torques_are_told_apart_on_every_robot() {
    for robot in OTHERS {
        let mut short = document(robot, Scheme::TangArteaga);
        (short.integration.duration_s, short.recording.samples) = (1.0, 100);
        let scenario = Scenario::new(short).unwrap();
        let recording = scenario.run().recording;
        let parts = scenario.torque_parts(&recording);
        for joint in 0..recording.columns().joints {
            for (sample, torque) in recording.signal(Signal::Torque, joint).enumerate() {
                let sum: f64 = parts.at(sample, joint).iter().sum();
                assert!((sum - torque).abs() < 1e-9 * torque.abs().max(1.0), "{robot}: {sum} for {torque}");
            }
        }
    }
}

/// `q_d1 = 30° (1 − cos 2πt)`: the arm starts where it should be and stands still.
#[test]
fn the_books_trajectory_starts_at_rest() {
    let run = run(document("two_link", Scheme::SlotineLi));
    assert_eq!(worst_deg(&run, 0.0, 0.0), 0.0);
    let angles: Vec<_> = run.recording.signal(Signal::Position, 0).collect();
    let errors: Vec<_> = run.recording.signal(Signal::Error, 0).collect();
    for (n, t) in run.recording.times_s().enumerate() {
        let desired = 30.0 * (1.0 - (TAU * t).cos());
        assert!(((angles[n] - errors[n]).to_degrees() - desired).abs() < 1e-9, "{t}");
    }
}
