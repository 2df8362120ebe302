//! Documents: defaults, canonical form, and a clear refusal of everything that is not allowed.

use adaptarm_core::scenario::{PRESETS, ReadError, Scenario, Scheme};
use proptest::prelude::*;

fn read(text: &str) -> Result<Scenario, ReadError<serde_json::Error>> {
    Scenario::read(&mut serde_json::Deserializer::from_str(text))
}

fn with(fields: &str) -> String {
    format!(r#"{{"format":"adaptarm.scenario/1","scheme":{{"kind":"proposed"}}{fields}}}"#)
}

#[test]
fn what_is_left_out_is_the_papers() {
    let minimal = read(&with("")).unwrap();
    assert_eq!(minimal, Scenario::new(Scheme::Proposed.paper()).unwrap());
    let written_out = serde_json::to_string(minimal.document()).unwrap();
    let reread = read(&written_out).unwrap();
    assert_eq!(reread.hash(), minimal.hash());
    assert_eq!(reread, minimal);
    let partial = read(&with("").replace(r#""kind":"proposed""#, r#""gains":{"beta":5.5},"kind":"proposed""#)).unwrap();
    assert_eq!(partial.hash(), minimal.hash(), "the order of fields and naming a default must not matter");
}

/// A field added without care would change every hash ever published (docs/decisions/0003-hashes.md).
#[test]
fn the_hash_of_a_scenario_stays() {
    let hash = Scenario::new(Scheme::Proposed.paper()).unwrap().hash();
    assert_eq!(hash, "9a68d85787ed9c43ab37380c584ac0a7b8fc7d39b7174110e1b0fe21e1358a54");
}

#[test]
fn presets_are_allowed_and_differ() {
    let mut hashes: Vec<_> = PRESETS.iter().map(|preset| Scenario::new(preset.document()).unwrap().hash()).collect();
    hashes.sort();
    hashes.dedup();
    assert_eq!(hashes.len(), PRESETS.len());
}

/// Every refusal: the document's other fields, and what the error must say.
#[test]
fn refusals_name_field_value_and_range() {
    let gains = |gains: &str| {
        format!(r#"{{"format":"adaptarm.scenario/1","scheme":{{"kind":"proposed","gains":{{{gains}}}}}}}"#)
    };
    let cases = [
        (with(r#","plnat":{}"#), "/plnat", "unknown field `plnat`"),
        (with(r#","plant":{"frictoin":{}}"#), "/plant/frictoin", "unknown field `frictoin`"),
        (gains(r#""kv":[1,2,3]"#), "/scheme/gains/kv", "unknown field `kv`"),
        (gains(r#""k_v":[1,2]"#), "/scheme/gains/k_v", "scheme.gains.k_v: has 2 numbers where 3 are needed"),
        (
            gains(r#""k_v":[1,-2,3]"#),
            "/scheme/gains/k_v/1",
            "scheme.gains.k_v[1]: -2 is outside the allowed range 0 to",
        ),
        (gains(r#""rho":0.5"#), "/scheme/gains/rho", "0.5 is outside the allowed range 1 to"),
        (gains(r#""beta":"much""#), "/scheme/gains/beta", "expected a number"),
        (
            gains(r#""projection":{"upper_factor":20}"#),
            "/scheme/gains/projection/upper_hard_factor",
            "10.1 must exceed upper_factor, 20",
        ),
        (
            with(r#","integration":{"step_s":-1}"#),
            "/integration/step_s",
            "-1 is outside the allowed range 0.000001 to 0.1 s",
        ),
        (with(r#","integration":{"step_s":NaN}"#), "/integration/step_s", "expected value at line 1"),
        (with(r#","integration":{"step_s":1e999}"#), "/integration/step_s", "number out of range"),
        (
            with(r#","integration":{"step_s":1e-6,"duration_s":100000}"#),
            "/integration/step_s",
            "1.000e11 steps; at most 1e8 are allowed",
        ),
        (
            with(r#","integration":{"relative_tolerance":1e-6}"#),
            "/integration/relative_tolerance",
            "no meaning for method rk4",
        ),
        (with(r#","integration":{"method":"euler"}"#), "/integration/method", "unknown variant `euler`"),
        (with(r#","recording":{"samples":0}"#), "/recording/samples", "0 is outside the allowed range 1 to 200000"),
        (with(r#","recording":{"samples":-5}"#), "/recording/samples", "invalid value"),
        (with(r#","robot":"puma""#), "/robot", "\"puma\" is not known; allowed: crs_a465"),
        (with(r#","plant":{"theta_scale":[1,2,3]}"#), "/plant/theta_scale", "has 3 numbers where 18 are needed"),
        (
            with(r#","plant":{"theta_scale":[100,100,100,100,100,100,100,0.1,0.1,0.1,1,1,1,1,1,1,1,1]}"#),
            "/plant/theta_scale",
            "not positive definite",
        ),
        (
            with(r#","trajectory":{"kind":"fourier","offset_deg":[0,90]}"#),
            "/trajectory/offset_deg",
            "has 2 numbers where 3 are needed",
        ),
        (
            with(r#","trajectory":{"kind":"fourier","offset_deg":[0,90,-90],"sine_deg":[[1],[2],[3],[4]]}"#),
            "/trajectory/sine_deg",
            "has 4 where at most 3 are allowed",
        ),
        (with(r#","seed":1,"seed":2"#), "", "duplicate field `seed`"),
        (with("").replace("scenario/1", "scenario/2"), "/format", "allowed: adaptarm.scenario/1"),
        (with("").replace("proposed", "pid"), "/scheme/kind", "unknown variant `pid`"),
        (r#"{"format":"adaptarm.scenario/1"}"#.to_owned(), "", "missing field `scheme`"),
        ("not json".to_owned(), "", "expected"),
        (String::new(), "", "EOF while parsing"),
        ("[".repeat(100_000), "/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0", "recursion limit exceeded"),
        (r#"["adaptarm.scenario/1"]"#.to_owned(), "", "invalid type: list, expected an object"),
        (with(r#","integration":["rk4",0.001,12]"#), "/integration", "invalid type: list, expected an object"),
        (with(r#","trajectory":{"kind":"paper","frequency_rad_s":2}"#), "/trajectory/frequency_rad_s", "kind paper"),
        (with(r#","trajectory":{"kind":"paper","foo":2}"#), "/trajectory/foo", "unknown field `foo`"),
        (with(r#","trajectory":{"kind":"fourier"}"#), "/trajectory/offset_deg", "missing"),
        (
            with(r#","trajectory":{"sine_deg":[[1,"a"]],"offset_deg":[0,90,-90],"kind":"fourier"}"#),
            "/trajectory/sine_deg/0/1",
            "invalid type: string",
        ),
        (
            with(r#","plant":{"friction":{"width_rad_s":"wide"}}"#),
            "/plant/friction/width_rad_s",
            "invalid type: string",
        ),
        (
            with(r#","plant":{"friction":{"width_rad_s":1e-310}}"#),
            "/plant/friction/width_rad_s",
            "or 0 for the true sign",
        ),
        (
            r#"{"scheme":{"gains":{"k_s":[1,2,"z"]},"kind":"slotine_li"},"format":"adaptarm.scenario/1"}"#.to_owned(),
            "/scheme/gains/k_s/2",
            "invalid type: string",
        ),
    ];
    for (text, pointer, message) in cases {
        let error = read(&text).expect_err(&text);
        let said = error.to_string();
        assert!(said.contains(message), "{text:.200}\n  said: {said}\n  instead of: {message}");
        assert_eq!(error.pointer(), pointer, "{text:.200}: {said}");
        assert!(!said.contains('\n'), "{said}");
    }
}

proptest! {
    /// No document makes the core panic, and whatever is accepted can at least start.
    #[test]
    fn no_document_panics(
        step in prop::num::f64::ANY, duration in prop::num::f64::ANY, samples in 0_usize..5000,
        gain in prop::num::f64::ANY, factor in prop::num::f64::ANY, width in prop::num::f64::ANY,
    ) {
        let mut document = Scheme::SlotineLi.paper();
        document.integration.step_s = step;
        document.integration.duration_s = duration;
        document.recording.samples = samples;
        document.plant.theta_scale = Some(vec![factor; 18]);
        document.plant.friction = adaptarm_core::scenario::FrictionDocument { width_rad_s: width, ..Default::default() };
        document.scheme = adaptarm_core::scenario::SchemeDocument::SlotineLi(Some(
            adaptarm_core::scenario::SlotineLiGains { k_s: vec![gain; 3], ..Default::default() },
        ));
        if let Ok(scenario) = Scenario::new(document) {
            scenario.start().advance(100);
        }
    }

    /// Nor does a document with bytes changed, doubled or cut out.
    #[test]
    fn no_damaged_text_panics(
        edits in prop::collection::vec((any::<prop::sample::Index>(), 0_u8..3, prop::sample::select(b"0129-.eE+{}[]\",:_ aknul\\".to_vec())), 1..8),
        scheme in prop::sample::select(Scheme::ALL.to_vec()),
    ) {
        let mut text = serde_json::to_vec(Scenario::new(scheme.paper()).unwrap().document()).unwrap();
        for (place, edit, byte) in edits {
            let place = place.index(text.len());
            match edit {
                0 => text[place] = byte,
                1 => text.insert(place, byte),
                _ => { text.remove(place); }
            }
        }
        match Scenario::read(&mut serde_json::Deserializer::from_slice(&text)) {
            Ok(scenario) => { scenario.start().advance(5); }
            Err(error) => prop_assert!(!error.to_string().is_empty()),
        }
    }

    /// Extreme but allowed gains end in an outcome, with finite numbers up to it.
    #[test]
    fn extreme_gains_end_in_an_outcome(exponent in -6.0..5.0_f64, scheme in prop::sample::select(Scheme::ALL.to_vec())) {
        use adaptarm_core::scenario::SchemeDocument as S;
        let gain = 10_f64.powf(exponent);
        let mut document = scheme.paper();
        document.integration.duration_s = 0.2;
        document.recording.samples = 50;
        document.scheme = match scheme {
            Scheme::Proposed => S::Proposed(Some(adaptarm_core::scenario::ProposedGains {
                gamma_adapt: vec![gain; 18], k_v: vec![gain; 3], ..Default::default()
            })),
            Scheme::TangArteaga => S::TangArteaga(Some(adaptarm_core::scenario::TangArteagaGains {
                gamma_adapt: vec![gain; 18], k_s: vec![gain; 3], ..Default::default()
            })),
            _ => S::SlotineLi(Some(adaptarm_core::scenario::SlotineLiGains {
                gamma_adapt: vec![gain; 18], k_s: vec![gain; 3], ..Default::default()
            })),
        };
        let run = Scenario::new(document).unwrap().run();
        prop_assert!(run.recording.rows().iter().all(|x| x.is_finite()));
        prop_assert!(run.report.metrics.index_e_deg.iter().all(|x| x.is_finite()));
        prop_assert_eq!(run.report.at_s.is_some(), run.report.reason.is_some());
    }
}
