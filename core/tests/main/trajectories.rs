//! Trajectories of every kind: derivatives against differences and dual numbers, tips where they should be, refusals.

use crate::dual::Dual;
use adaptarm_core::lanes;
use adaptarm_core::recording::Signal;
use adaptarm_core::robots::{Bend, Kinematics, ROBOTS};
use adaptarm_core::scalar::Scalar;
use adaptarm_core::scenario::{OutcomeKind, ReadError, Scenario, SideBySide};
use adaptarm_core::trajectories::{
    Chirp, Desired, Fourier, Motion, Path, PointToPoint, Samples, TipPath, chirp_phase, minimum_jerk, random_fourier,
};
use nalgebra::{SVector, Vector2, Vector3};
use proptest::prelude::*;
use std::f64::consts::TAU;

/// Velocity is the derivative of position, and acceleration that of velocity, by central differences.
fn check_derivatives<const N: usize>(
    name: &str,
    at: impl Fn(f64) -> Desired<f64, N>,
    times_s: impl Iterator<Item = f64>,
) {
    const H: f64 = 1e-5;
    for t in times_s {
        let (before, now, after) = (at(t - H), at(t), at(t + H));
        let velocity = (after.position - before.position) / (2.0 * H);
        let acceleration = (after.velocity - before.velocity) / (2.0 * H);
        let size = 1.0 + now.velocity.amax() + now.acceleration.amax();
        assert!((velocity - now.velocity).amax() < 1e-7 * size, "{name} at {t}: {velocity} {}", now.velocity);
        // Where the third derivative jumps, a difference is off by as much as the step.
        let off = (acceleration - now.acceleration).amax();
        assert!(off < 2e-3 * size, "{name} at {t}: {acceleration} {}", now.acceleration);
    }
}

fn times(until_s: f64) -> impl Iterator<Item = f64> {
    (1..400).map(move |n| f64::from(n) * until_s / 400.0)
}

fn table() -> Samples<2> {
    let angles = [[0.0, 1.0], [0.5, 0.2], [0.4, -0.7], [1.2, 0.3], [1.0, 0.0]].map(Vector2::from);
    Samples::new(vec![0.5, 1.0, 1.8, 2.5, 3.5], &angles)
}

fn tour() -> PointToPoint<2> {
    PointToPoint::new([[0.0, 1.0], [0.5, 0.2], [0.4, -0.7]].map(Vector2::from).to_vec(), 0.8, 0.3)
}

fn tip(robot: usize, path: Path) -> TipPath {
    TipPath { path, kinematics: Kinematics::new(ROBOTS[robot]), bend: Bend::Up }
}

const LINE: Path = Path::Line { from: [0.45, -0.2, 0.4], to: [0.35, 0.25, 0.7], move_s: 1.5 };
const CIRCLE: Path = Path::Circle { centre: [0.4, 0.0, 0.5], radius_m: 0.12, normal: [0.3, -1.0, 0.5], period_s: 2.0 };
const PLANAR: Path = Path::Circle { centre: [0.9, 0.0, 1.0], radius_m: 0.4, normal: [0.0, -1.0, 0.0], period_s: 2.0 };

#[test]
fn derivatives_are_those_of_the_positions() {
    let chirp = Chirp::<2> {
        offset: Vector2::new(0.1, -0.3),
        amplitude: Vector2::new(0.5, 0.2),
        frequency_rad_s: [1.0, 9.0],
        sweep_s: 2.0,
    };
    check_derivatives("chirp", |t| chirp.at(t), times(6.0));
    check_derivatives("minimum jerk", |t| tour().at(t), times(4.0));
    check_derivatives("samples", |t| table().at(t), times(4.5));
    check_derivatives::<3>("line", |t| tip(0, LINE).at(t), times(6.0));
    check_derivatives::<3>("circle", |t| tip(0, CIRCLE).at(t), times(4.0));
    check_derivatives::<2>("planar circle", |t| tip(1, PLANAR).at(t), times(4.0));
    let fourier: Fourier<f64, 2> = random_fourier(7, 1.3, 5, &[10.0, 20.0], 30.0);
    check_derivatives("random Fourier", |t| fourier.at(t), times(6.0));
}

#[test]
fn closed_forms_agree_with_dual_numbers() {
    for n in 1..50 {
        let s = f64::from(n) / 50.0;
        let [place, rate, _] = minimum_jerk(Dual::new(s, 1.0));
        let [value, first, second] = minimum_jerk(s);
        assert!((place.slope - first).abs() < 1e-14 && (rate.slope - second).abs() < 1e-13, "{s}");
        assert_eq!((place.value, rate.value), (value, first));
        let [phase, rate, _] = chirp_phase([1.0, 9.0], 2.0, Dual::new(6.0 * s, 1.0));
        let [_, first, second] = chirp_phase([1.0, 9.0], 2.0, 6.0 * s);
        let quintic = 10.0 * s.powi(3) - 15.0 * s.powi(4) + 6.0 * s.powi(5);
        assert!((phase.slope - first).abs() < 1e-13 && (rate.slope - second).abs() < 1e-12, "{s}");
        // The quintic that leaves and arrives without velocity and acceleration; a frequency that rises and falls as a sine squared.
        let frequency = 1.0 + 8.0 * (0.25 * TAU * 3.0 * s).sin().powi(2);
        assert!((quintic - value).abs() < 1e-14 && (first - frequency).abs() < 1e-13, "{s}");
    }
    assert_eq!((minimum_jerk(0.0), minimum_jerk(1.0)), ([0.0; 3], [1.0, 0.0, 0.0]));
    let [_, lowest, _] = chirp_phase([1.0, 9.0], 2.0, 0.0);
    let [_, highest, _] = chirp_phase([1.0, 9.0], 2.0, 2.0);
    assert!((lowest, (highest - 9.0).abs() < 1e-13) == (1.0, true));
}

/// The tip's place by an independent telling of the A465's geometry, over dual numbers: its slope is the tip's velocity.
fn told_tip(q: &SVector<Dual, 3>) -> [Dual; 3] {
    let n = Dual::splat;
    let ((s1, c1), (s2, c2)) = (q[0].sin_cos(), q[1].sin_cos());
    let (s23, c23) = (q[1] + q[2]).sin_cos();
    let out = n(0.3048) * c2 + n(0.3302 + 0.0762) * c23;
    [out * c1, out * s1, n(0.3302) + n(0.3048) * s2 + n(0.3302 + 0.0762) * s23]
}

#[test]
fn the_tip_is_where_its_path_says_as_fast_as_it_says() {
    for path in [LINE, CIRCLE] {
        for t in times(4.0) {
            let desired: Desired<f64, 3> = tip(0, path).at(t);
            let moving = told_tip(&SVector::from_fn(|i, _| Dual::new(desired.position[i], desired.velocity[i])));
            let [place, rate, _] = path.at(t);
            for axis in 0..3 {
                assert!((moving[axis].value - place[axis]).abs() < 1e-13, "{path:?} at {t}");
                assert!((moving[axis].slope - rate[axis]).abs() < 1e-12, "{path:?} at {t}");
            }
        }
    }
    for t in times(2.0) {
        let desired: Desired<f64, 2> = tip(1, PLANAR).at(t);
        let reached = Kinematics::new(ROBOTS[1]).points(desired.position.as_slice()).tip;
        assert!((Vector3::from(reached) - PLANAR.at(t)[0]).amax() < 1e-13);
        let Path::Circle { centre, radius_m, .. } = PLANAR else { panic!("it is a circle") };
        assert!(((Vector3::from(reached) - Vector3::from(centre)).norm() - radius_m).abs() < 1e-13);
    }
}

proptest! {
    /// Joints to tip and back, with velocities and accelerations, on either side of the elbow.
    #[test]
    fn inverse_after_forward_kinematics_is_the_identity(
        q in (-3.0..3.0_f64, 0.2..2.0_f64, 0.2..2.5_f64), v in prop::array::uniform3(-2.0..2.0_f64), up in any::<bool>(),
    ) {
        let (sign, bend) = if up { (-1.0, Bend::Up) } else { (1.0, Bend::Down) };
        let q = [q.0, if up { q.1 } else { -0.3 * q.1 }, sign * q.2];
        let arm = Kinematics::new(ROBOTS[0]);
        let moving = told_tip(&SVector::from_fn(|i, _| Dual::new(q[i], v[i])));
        let ahead = (moving[0].value * q[0].cos() + moving[1].value * q[0].sin()).max(0.0);
        prop_assume!(ahead > 0.05);
        let [place, rate] = [moving.map(|x| x.value), moving.map(|x| x.slope)].map(Vector3::from);
        let [found, velocity, _] = arm.follow(&[place, rate, Vector3::zeros()], bend).unwrap();
        for joint in 0..3 {
            prop_assert!((found[joint] - q[joint]).abs() < 1e-9, "{found:?} for {q:?}");
            prop_assert!((velocity[joint] - v[joint]).abs() < 1e-8, "{velocity:?} for {v:?}");
        }
    }
}

#[test]
fn a_pendulum_follows_the_circle_that_it_is_on() {
    let path = Path::Circle { centre: [0.0, 0.0, 0.6], radius_m: 0.5, normal: [0.0, -1.0, 0.0], period_s: TAU };
    let found = tip(2, path);
    for t in [0.1, 1.0, 1.4] {
        let desired: Desired<f64, 1> = found.at(t);
        // From level at x = 0.5, a quarter turn from hanging, one radian a second.
        assert!((desired.position[0] - (TAU / 4.0 + t)).abs() < 1e-12);
        assert!((desired.velocity[0] - 1.0).abs() < 1e-12 && desired.acceleration[0].abs() < 1e-12);
    }
}

#[test]
fn samples_are_met_smoothly_from_rest_to_rest() {
    let samples = table();
    let knots = [(0.5, [0.0, 1.0]), (1.0, [0.5, 0.2]), (1.8, [0.4, -0.7]), (2.5, [1.2, 0.3]), (3.5, [1.0, 0.0])];
    for (time_s, angles) in knots {
        assert!((samples.at(time_s).position - Vector2::from(angles)).amax() < 1e-14);
        let (before, after) = (samples.at(time_s - 1e-9), samples.at(time_s + 1e-9));
        assert!(
            (before.velocity - after.velocity).amax() < 1e-6
                && (before.acceleration - after.acceleration).amax() < 1e-5
        );
    }
    for time_s in [0.0, 0.5, 3.5, 9.0] {
        let end = samples.at(time_s);
        assert_eq!((end.velocity, end.acceleration), (Vector2::zeros(), Vector2::zeros()));
    }
    // Inside the table a sine is met with the fourth power of the spacing.
    let worst = |count: u32| {
        let times_s: Vec<_> = (0..=count).map(|n| TAU * f64::from(n) / f64::from(count)).collect();
        let angles: Vec<_> = times_s.iter().map(|t| SVector::<f64, 1>::new(t.sin())).collect();
        let spline = Samples::new(times_s, &angles);
        (0..100)
            .map(|n| 2.0 + 0.02 * f64::from(n))
            .map(|t| (spline.at(t).position[0] - t.sin()).abs())
            .fold(0.0, f64::max)
    };
    let order = (worst(64) / worst(128)).log2();
    assert!((order - 4.0).abs() < 0.5, "order {order}");
}

#[test]
fn a_random_series_has_the_level_asked_for_and_its_seed_decides() {
    let level = 25.0;
    let of = |seed| -> Fourier<f64, 2> { random_fourier(seed, 2.0, 6, &[0.0, 90.0], level) };
    let fourier = of(3);
    for joint in 0..2 {
        let count = 1000;
        let at = |n: i32| fourier.at(f64::from(n) / f64::from(count) * TAU / 2.0).velocity[joint].to_degrees();
        let mean = (0..count).map(|n| at(n) * at(n)).sum::<f64>() / f64::from(count);
        assert!((mean.sqrt() - level).abs() < 1e-9, "{}", mean.sqrt());
    }
    assert_eq!(fourier, of(3));
    assert_ne!(fourier, of(4));
}

fn read(robot: &str, trajectory: &str) -> Result<Scenario, ReadError<serde_json::Error>> {
    let text = format!(
        r#"{{"format":"adaptarm.scenario/1","robot":"{robot}","scheme":{{"kind":"slotine_li"}},"trajectory":{trajectory},
           "integration":{{"duration_s":0.5}},"recording":{{"samples":50}},"seed":5}}"#
    );
    Scenario::read(&mut serde_json::Deserializer::from_str(&text))
}

const OF_A465: [&str; 6] = [
    r#"{"kind":"random_fourier","offset_deg":[0,90,-90],"rms_deg_s":10}"#,
    r#"{"kind":"chirp","offset_deg":[0,90,-90],"amplitude_deg":[5,4,3],"frequency_end_rad_s":6,"sweep_s":3}"#,
    r#"{"kind":"minimum_jerk","points_deg":[[0,90,-90],[10,80,-80]],"move_s":0.4}"#,
    r#"{"kind":"line","from_m":[0.4,-0.1,0.5],"to_m":[0.4,0.1,0.6],"move_s":1}"#,
    r#"{"kind":"circle","centre_m":[0.4,0,0.5],"radius_m":0.1,"period_s":4}"#,
    r#"{"kind":"samples","times_s":[0,0.2,0.5],"points_deg":[[0,90,-90],[2,88,-90],[3,85,-91]]}"#,
];

#[test]
fn every_kind_is_followed_alone_and_in_lanes() {
    let scenarios: Vec<_> = OF_A465.iter().map(|trajectory| read("crs_a465", trajectory).unwrap()).collect();
    let alone: Vec<_> = scenarios.iter().map(Scenario::run).collect();
    for (scenario, run) in scenarios.iter().zip(&alone) {
        assert_eq!(run.report.outcome, OutcomeKind::Completed);
        let text = serde_json::to_string(scenario.document()).unwrap();
        let reread = Scenario::read(&mut serde_json::Deserializer::from_str(&text)).unwrap();
        assert_eq!((reread.hash(), &reread), (scenario.hash(), scenario), "{text}");
        let worst = run.recording.signal(Signal::Error, 1).map(f64::abs).fold(0.0, f64::max);
        assert!(worst < 0.2, "{text}: {worst} rad");
        let parts = scenario.torque_parts(&run.recording);
        assert_eq!(parts.len(), run.recording.len());
    }
    assert!(!scenarios[0].runs_beside(&scenarios[1]));
    for &width in lanes::widths() {
        let (members, runs) = (&scenarios[1..], &alone[1..]);
        for (members, runs) in members.chunks(width).zip(runs.chunks(width)) {
            let members: Vec<_> = members.iter().collect();
            let mut together = SideBySide::start(&members, width).unwrap();
            together.advance(u64::MAX);
            assert!(together.finish() == runs, "{width} lanes");
        }
    }
}

#[test]
fn refusals_name_the_point_and_the_field() {
    let cases = [
        (
            "crs_a465",
            r#"{"kind":"line","from_m":[0.4,0,0.5],"to_m":[0.9,0,0.5],"move_s":1}"#,
            "/trajectory/to_m",
            "out of the reach of robot crs_a465",
        ),
        (
            "crs_a465",
            r#"{"kind":"line","from_m":[0.9,0.25,0.5],"to_m":[0.4,0,0.5],"move_s":1}"#,
            "/trajectory/from_m",
            "[0.9000, 0.2500, 0.5000] m",
        ),
        (
            "crs_a465",
            r#"{"kind":"circle","centre_m":[0,0,0.5],"radius_m":0.3,"period_s":1}"#,
            "/trajectory/radius_m",
            "a joint would have to jump",
        ),
        (
            "two_link",
            r#"{"kind":"line","from_m":[1,0.1,1],"to_m":[1,0.1,1.2],"move_s":1}"#,
            "/trajectory/from_m",
            "[1.0000, 0.1000, 1.0000] m",
        ),
        (
            "pendulum",
            r#"{"kind":"line","from_m":[0.1,0,0.2],"to_m":[0.2,0,0.2],"move_s":1}"#,
            "/trajectory/from_m",
            "out of the reach of robot pendulum",
        ),
        ("crs_a465", r#"{"kind":"line","from_m":[0.4,0,0.5],"move_s":1}"#, "/trajectory/to_m", "missing"),
        ("crs_a465", r#"{"kind":"line","from_m":[1,2],"to_m":[1,2,3],"move_s":1}"#, "/trajectory/from_m", "x, y and z"),
        (
            "crs_a465",
            r#"{"kind":"circle","centre_m":[0.4,0,0.5],"radius_m":0.1,"period_s":4,"normal":[0,0,0]}"#,
            "/trajectory/normal",
            "has no direction",
        ),
        (
            "two_link",
            r#"{"kind":"samples","times_s":[0,1,1],"points_deg":[[0,0],[1,1],[2,2]]}"#,
            "/trajectory/times_s/2",
            "1 is outside the allowed range 1.001",
        ),
        (
            "two_link",
            r#"{"kind":"samples","times_s":[0],"points_deg":[[0,0],[1,1]]}"#,
            "/trajectory/times_s",
            "has 1 numbers where 2 are needed",
        ),
        ("two_link", r#"{"kind":"minimum_jerk","points_deg":[],"move_s":1}"#, "/trajectory/points_deg", "at least 1"),
        (
            "two_link",
            r#"{"kind":"minimum_jerk","points_deg":[[1,2,3]],"move_s":1}"#,
            "/trajectory/points_deg/0",
            "has 3 numbers where 2",
        ),
        (
            "pendulum",
            r#"{"kind":"chirp","offset_deg":[0],"amplitude_deg":[9],"frequency_rad_s":3,"frequency_end_rad_s":2,"sweep_s":1}"#,
            "/trajectory/frequency_end_rad_s",
            "2 is outside the allowed range 3 to 100",
        ),
        (
            "pendulum",
            r#"{"kind":"random_fourier","offset_deg":[0],"rms_deg_s":5,"harmonics":0}"#,
            "/trajectory/harmonics",
            "outside the allowed range 1 to 50",
        ),
        (
            "pendulum",
            r#"{"kind":"random_fourier","offset_deg":[0],"rms_deg_s":5,"move_s":1}"#,
            "/trajectory/move_s",
            "has no meaning for kind random_fourier, which takes",
        ),
    ];
    for (robot, trajectory, pointer, message) in cases {
        let error = read(robot, trajectory).expect_err(trajectory);
        let said = error.to_string();
        assert!(said.contains(message), "{trajectory}\n  said: {said}\n  instead of: {message}");
        assert_eq!(error.pointer(), pointer, "{said}");
    }
}

proptest! {
    /// Whatever numbers a trajectory holds, it is refused or it starts.
    #[test]
    fn no_trajectory_panics(numbers in prop::collection::vec(prop::num::f64::ANY, 3), small in 0.0..1.0_f64) {
        let list = serde_json::to_string(&numbers.iter().map(|x| if x.is_finite() { *x } else { small }).collect::<Vec<_>>()).unwrap();
        for trajectory in [
            format!(r#"{{"kind":"line","from_m":{list},"to_m":[0.4,0,0.5],"move_s":1}}"#),
            format!(r#"{{"kind":"circle","centre_m":[0.4,0,0.5],"normal":{list},"radius_m":{small},"period_s":1}}"#),
            format!(r#"{{"kind":"samples","times_s":{list},"points_deg":[[0,90,-90],[1,90,-90],[2,90,-90]]}}"#),
            format!(r#"{{"kind":"minimum_jerk","points_deg":[{list},[0,90,-90]],"move_s":{small}}}"#),
            format!(r#"{{"kind":"chirp","offset_deg":{list},"amplitude_deg":{list},"frequency_end_rad_s":{small},"sweep_s":{small}}}"#),
        ] {
            if let Ok(scenario) = read("crs_a465", &trajectory) {
                scenario.start().advance(3);
            }
        }
    }
}
