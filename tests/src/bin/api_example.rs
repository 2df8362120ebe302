//! The example in Rust of docs/api.md, whose test compares the two and runs this.

use serde_json::{Value, json};
use std::error::Error;
use std::io::{BufRead, BufReader};

fn main() -> Result<(), Box<dyn Error>> {
    let server = std::env::args().nth(1).unwrap_or("http://127.0.0.1:8080".to_owned());
    let study = json!({ "kind": "study", "label": "from Rust", "spec": { "scenarios": [
        { "format": "adaptarm.scenario/1", "scheme": { "kind": "proposed" } },
        { "format": "adaptarm.scenario/1", "scheme": { "kind": "slotine_li" } },
    ] } });
    // With a key, sending it again after a lost connection makes no second job.
    let accepted = ureq::post(format!("{server}/api/v1/jobs"))
        .header("Content-Type", "application/json")
        .header("Idempotency-Key", "from-rust-1")
        .send(study.to_string())?;
    let job: Value = serde_json::from_reader(accepted.into_body().into_reader())?;
    let job = format!("{server}{}", job["links"]["self"].as_str().ok_or("a job without an address")?);

    // The stream ends when the job does.
    let events = ureq::get(format!("{job}/events")).call()?.into_body().into_reader();
    for line in BufReader::new(events).lines() {
        let line = line?;
        let Some(data) = line.strip_prefix("data: ") else { continue };
        let data: Value = serde_json::from_str(data)?;
        if let Some(progress) = data["progress"].as_f64() {
            println!("{:.0} % done", 100.0 * progress);
        }
    }

    let result = ureq::get(format!("{job}/result")).call()?.into_body().into_reader();
    let result: Value = serde_json::from_reader(result)?;
    for report in result["reports"].as_array().into_iter().flatten() {
        println!("{}: tracking error {} deg", report["scheme"], report["index_e_deg"]);
    }
    let samples = ureq::get(format!("{job}/result/series?scenario=1&columns=t_s,e_deg_1&every=10"));
    let samples = samples.call()?.into_body().read_to_string()?;
    println!("{} lines of samples", samples.lines().count());
    Ok(())
}
