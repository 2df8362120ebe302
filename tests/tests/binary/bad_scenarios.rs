//! Documents that are no scenarios, as people and attackers write them. The command line and the server both refuse them.

/// The shortest scenario there is.
pub const MINIMAL: &str = r#"{"format":"adaptarm.scenario/1","scheme":{"kind":"proposed"}}"#;

/// One bad document.
pub struct Bad {
    /// What is wrong with it.
    pub name: &'static str,
    /// It.
    pub document: fn() -> Vec<u8>,
    /// What the refusal must contain: the field's name, or the place.
    pub names: &'static str,
    /// Status over HTTP, when it is the only scenario of a study.
    pub status: u16,
}

/// [`MINIMAL`] with more fields.
fn with(fields: &str) -> Vec<u8> {
    format!("{},{fields}}}", &MINIMAL[..MINIMAL.len() - 1]).into_bytes()
}

fn with_scheme(scheme: &str) -> Vec<u8> {
    format!(r#"{{"format":"adaptarm.scenario/1","scheme":{scheme}}}"#).into_bytes()
}

const fn bad(name: &'static str, document: fn() -> Vec<u8>, names: &'static str, status: u16) -> Bad {
    Bad { name, document, names, status }
}

/// Bad documents.
pub const BAD: &[Bad] = &[
    bad("unknown field", || with(r#""stepp":1"#), "stepp: unknown field `stepp`", 422),
    bad("unknown gain", || with_scheme(r#"{"kind":"slotine_li","gains":{"k_v":[1,2,3]}}"#), "scheme.gains.k_v", 422),
    bad("wrong length", || with_scheme(r#"{"kind":"proposed","gains":{"k_v":[1,2]}}"#), "scheme.gains.k_v: has 2", 422),
    bad("NaN", || with(r#""integration":{"step_s":NaN}"#), "integration.step_s: not JSON", 400),
    bad("NaN as text", || with(r#""integration":{"step_s":"NaN"}"#), "integration.step_s: invalid type", 422),
    bad("infinity", || with(r#""integration":{"step_s":1e999}"#), "integration.step_s: not JSON: number out of", 400),
    bad("negative step", || with(r#""integration":{"step_s":-1}"#), "integration.step_s: -1 is outside", 422),
    bad("10^12 steps", || with(r#""integration":{"step_s":1e-12,"duration_s":1}"#), "integration.step_s: ", 422),
    bad(
        "10^11 steps",
        || with(r#""integration":{"step_s":1e-6,"duration_s":1e5}"#),
        "integration.step_s: 100000 s",
        422,
    ),
    bad("no samples", || with(r#""recording":{"samples":0}"#), "recording.samples: 0 is outside", 422),
    bad("half a sample", || with(r#""recording":{"samples":1.5}"#), "recording.samples: ", 422),
    bad("doubled key", || with(r#""seed":1,"seed":2"#), "duplicate field `seed`", 422),
    bad("doubled kind", || with_scheme(r#"{"kind":"proposed","kind":"slotine_li"}"#), "scheme: duplicate field", 422),
    bad("unknown scheme", || with_scheme(r#"{"kind":"pid"}"#), "scheme.kind: unknown variant `pid`", 422),
    bad("unknown robot", || with(r#""robot":"puma""#), "robot: \"puma\" is not known; allowed: crs_a465", 422),
    bad("no scheme", || br#"{"format":"adaptarm.scenario/1"}"#.to_vec(), "missing field `scheme`", 422),
    bad("other format", || MINIMAL.replace("/1", "/99").into(), "format: \"adaptarm.scenario/99\"", 422),
    bad("not JSON", || b"hello".to_vec(), "expected value at line 1 column", 400),
    bad("more than JSON", || format!("{MINIMAL} x").into(), "at line 1 column 63", 400),
    bad("list", || b"[1, 2]".to_vec(), "invalid type: list, expected an object", 422),
    bad("empty", Vec::new, "", 400),
    bad("deep nesting", || vec![b'['; 500_000], "recursion limit", 400),
    bad(
        "deep nesting inside",
        || with(&format!(r#""trajectory":{{"a":{}"#, "[".repeat(500_000))),
        "recursion limit",
        400,
    ),
    bad("invalid UTF-8", || b"{\"format\":\"\xff\"}".to_vec(), "is not UTF-8 text at line 1 column", 400),
    bad("line break in a name", || with("\"a\\nb\\u001b[31m\":1"), r"unknown field `a\nb\u{1b}[31m`", 422),
    bad("very long name", || with(&format!("\"{}\":1", "b".repeat(500_000))), "unknown field `bbbb", 422),
];
