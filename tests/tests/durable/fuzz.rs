//! Documents that are nearly scenarios, made from valid ones by a seeded generator: each is taken or refused, and the
//! server never fails over one.

use adaptarm_core::scenario::PRESETS;
use adaptarm_tests::client::Client;
use adaptarm_tests::workload::study;
use adaptarm_tests::{Launch, machine};
use anyhow::{Context, Result, ensure};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use serde_json::{Value, json};
use std::time::{Duration, Instant};

pub fn documents() -> Result<()> {
    let time = Duration::from_secs(if machine::soak() { 300 } else { 5 });
    // What is taken is computed too, so it must be little.
    let mut server = Launch::new()
        .variable("ADAPTARM_LIMITS_STEPS_PER_JOB", "20000")
        .variable("ADAPTARM_LIMITS_SAMPLES_PER_JOB", "20000")
        .serve()?;
    let client = Client::new(&server.url);
    let presets = PRESETS.iter().map(|preset| serde_json::to_value(preset.document()));
    let valid = presets.collect::<Result<Vec<_>, _>>()?;
    let mut random = StdRng::seed_from_u64(9);
    let mut counts = [0; 2];
    let started = Instant::now();
    while started.elapsed() < time {
        let mut request = study(&[valid[random.random_range(0..valid.len())].clone()]);
        for _ in 0..random.random_range(1..3) {
            mutate(&mut request, &mut random);
        }
        let mut bytes = request.to_string().into_bytes();
        if random.random_bool(0.2) {
            damage(&mut bytes, &mut random);
        }
        let text = || String::from_utf8_lossy(&bytes).chars().take(2000).collect::<String>();
        let answer =
            client.send("POST", "/api/v1/jobs", &[("content-type", "application/json")], &bytes).with_context(text)?;
        match answer.status {
            200 | 202 => counts[0] += 1,
            400..500 => {
                counts[1] += 1;
                let problem = answer.json()?;
                let named = problem["type"].as_str().is_some_and(|kind| kind.starts_with("/problems/"));
                ensure!(named && problem["detail"].is_string(), "{answer} to {}", text());
            }
            _ => anyhow::bail!("{answer} to {}", text()),
        }
        ensure!(server.ended()?.is_none(), "the server ended over {}", text());
    }
    println!("{} documents taken, {} refused", counts[0], counts[1]);
    ensure!(counts[0] > 10 && counts[1] > 10, "too few of a kind: {counts:?}");
    client.wait_for_all(Duration::from_mins(2))?;
    let failed = client.jobs("state=failed")?;
    ensure!(failed.is_empty() && server.ended()?.is_none(), "what was taken cannot be computed: {failed:?}");
    client.get("/healthz")?.expect_status(200)
}

/// Changes one value somewhere in a document: mostly deep inside, which is more interesting than the request's frame.
fn mutate(value: &mut Value, random: &mut StdRng) {
    let deeper = random.random_bool(0.9);
    match value {
        Value::Object(fields) if deeper && !fields.is_empty() => {
            let n = random.random_range(0..fields.len());
            fields.values_mut().nth(n).into_iter().for_each(|field| mutate(field, random));
        }
        Value::Array(items) if deeper && !items.is_empty() => {
            let n = random.random_range(0..items.len());
            mutate(&mut items[n], random);
        }
        _ => *value = replacement(value, random),
    }
}

fn replacement(value: &Value, random: &mut StdRng) -> Value {
    let number = value.as_f64().unwrap_or(1.0);
    match random.random_range(0..20) {
        0 => Value::Null,
        1 => json!(true),
        2 => json!(-number),
        3 => json!(number * 10.0_f64.powi(random.random_range(-20..20))),
        4 => json!(0),
        5 => json!(u64::MAX),
        6 => json!(f64::MAX),
        7 => json!(f64::MIN_POSITIVE / 3.0),
        8 | 16..20 => nearby(value, random),
        9 => json!(text(random)),
        10 => json!([value, value]),
        11 => json!(vec![value; random.random_range(0..40)]),
        12 => json!({ text(random): value }),
        13 => with_field(value, random),
        14 => without_item(value, random),
        _ => nested(value.clone(), random.random_range(1..300)),
    }
}

/// A number that may well be allowed too.
fn nearby(value: &Value, random: &mut StdRng) -> Value {
    match (value.as_u64(), value.as_f64()) {
        (Some(whole), _) => json!(whole.saturating_add(random.random_range(0..5))),
        (None, Some(number)) => json!(number * random.random_range(0.9..1.1)),
        (None, None) => value.clone(),
    }
}

fn text(random: &mut StdRng) -> String {
    const WORDS: [&str; 12] = [
        "",
        "fourier",
        "dopri5",
        "rest",
        "proposed",
        "NaN",
        "\0",
        "é\u{202e}",
        "../../etc/passwd",
        "'; DROP TABLE job",
        "1e3",
        "%",
    ];
    let word = WORDS[random.random_range(0..WORDS.len())];
    word.repeat(if random.random_bool(0.05) { 5000 } else { 1 })
}

fn with_field(value: &Value, random: &mut StdRng) -> Value {
    let mut value = value.clone();
    if let Some(fields) = value.as_object_mut() {
        fields.insert(text(random), json!(random.random_range(-1e3..1e3)));
    }
    value
}

fn without_item(value: &Value, random: &mut StdRng) -> Value {
    match value.clone() {
        Value::Object(fields) if !fields.is_empty() => {
            let gone = random.random_range(0..fields.len());
            Value::Object(fields.into_iter().enumerate().filter(|(n, _)| *n != gone).map(|(_, field)| field).collect())
        }
        Value::Array(mut items) if !items.is_empty() => {
            items.remove(random.random_range(0..items.len()));
            Value::Array(items)
        }
        other => other,
    }
}

fn nested(value: Value, depth: usize) -> Value {
    (0..depth).fold(value, |value, _| json!([value]))
}

/// Changes bytes without regard to what they mean.
fn damage(bytes: &mut Vec<u8>, random: &mut StdRng) {
    for _ in 0..random.random_range(1..5) {
        let at = random.random_range(0..bytes.len());
        match random.random_range(0..4) {
            0 => bytes[at] = random.random(),
            1 => bytes.insert(at, random.random()),
            2 => bytes.truncate(at.max(1)),
            _ => {
                let end = (at + random.random_range(1..50)).min(bytes.len());
                let piece = bytes[at..end].to_vec();
                bytes.splice(at..at, piece);
            }
        }
    }
}
