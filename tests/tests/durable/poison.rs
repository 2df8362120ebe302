//! A job that kills whoever computes it: after three deaths it fails with a reason, and nobody else's work suffers.

use adaptarm_tests::Launch;
use adaptarm_tests::client::Client;
use adaptarm_tests::workload::{Workload, scenario, study};
use anyhow::{Result, ensure};
use serde_json::json;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::thread::{scope, sleep};
use std::time::Duration;

const LABEL: &str = "poison";

pub fn job() -> Result<()> {
    // Long enough to be under way whenever the poisoned job strikes.
    let work = Workload::new(4, 300.0)?.mixed(20, 3);
    let mut server = Launch::new().variable("ADAPTARM_TEST_ABORT_ON_LABEL", LABEL).serve()?;
    let client = Client::new(&server.url);
    let (done, deaths) = (AtomicBool::new(false), AtomicU32::new(0));
    scope(|scope| {
        let supervisor = scope.spawn(|| {
            while !done.load(Ordering::Relaxed) {
                if server.ended()?.is_some() {
                    deaths.fetch_add(1, Ordering::Relaxed);
                    server.restart()?;
                }
                sleep(Duration::from_millis(20));
            }
            anyhow::Ok(())
        });
        let outcome = (|| {
            let submit = |body, key: &str| client.submit_surely(body, key, Duration::from_mins(1));
            let before = work[..10].iter().map(|work| submit(&work.body, &work.label)).collect::<Result<Vec<_>>>()?;
            let mut poison = study(&[scenario("slotine_li", &json!({"duration_s": 1}))]);
            poison["label"] = json!(LABEL);
            poison["priority"] = json!(10);
            let id = submit(&poison, LABEL)?;
            let after = work[10..].iter().map(|work| submit(&work.body, &work.label)).collect::<Result<Vec<_>>>()?;
            let ended = client.wait(&id, Duration::from_mins(2))?;
            ensure!(ended["state"] == "failed", "{ended}");
            ensure!(ended["reason"].as_str().is_some_and(|reason| reason.len() > 10), "{ended}");
            for (work, id) in work.iter().zip(before.iter().chain(&after)) {
                work.check(&client, &client.wait(id, Duration::from_mins(2))?)?;
            }
            println!("the poisoned job failed after {} deaths: {}", deaths.load(Ordering::Relaxed), ended["reason"]);
            Ok(())
        })();
        done.store(true, Ordering::Relaxed);
        supervisor.join().expect("the supervisor does not panic")?;
        outcome
    })?;
    ensure!(deaths.load(Ordering::Relaxed) == 3, "{} deaths instead of 3", deaths.load(Ordering::Relaxed));
    Ok(())
}
