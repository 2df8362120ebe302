//! Attempts are counted right however many come at once, and one that the server failed is given back.

use adaptarm_tests::Launch;
use adaptarm_tests::classroom::{Visitor, school, soft, stiff};
use adaptarm_tests::postgres::Cluster;
use anyhow::{Result, ensure};
use serde_json::json;
use std::thread;
use std::time::{Duration, Instant};

/// Requests sent at once for attempts that one may have three of.
const AT_ONCE: usize = 12;

pub fn at_once() -> Result<()> {
    race(Launch::new(), &[])
}

pub fn at_once_on_postgres() -> Result<()> {
    let cluster = Cluster::start()?;
    let database = cluster.database("race")?;
    let arguments = ["--database", database.as_str()];
    race(Launch::new().arguments(arguments), &arguments)
}

fn race(launch: Launch, arguments: &[&str]) -> Result<()> {
    let (server, _folder) = school(launch)?;
    let teacher = Visitor::teacher(&server, "ana", arguments)?;
    let (class, code) = teacher.class("A")?;
    let assignment = teacher.give(&class, &json!({ "exercise": "hold", "attempts": 3 }))?;
    let student = Visitor::student(&server.url, &code, "Bea")?;
    let path = format!("/assignments/{assignment}/attempts");
    let send = |n: usize, key: &str| {
        let gains = json!({ "k_p": 100 + n, "k_d": 10 });
        student.send("POST", &path, &[("idempotency-key", key)], Some(&json!({ "gains": gains })))
    };
    let mut statuses = thread::scope(|scope| {
        let sent: Vec<_> = (0..AT_ONCE)
            .map(|n| scope.spawn(move || Ok::<_, anyhow::Error>(send(n, &format!("k{n}"))?.status)))
            .collect();
        sent.into_iter().map(|sent| sent.join().expect("no panic")).collect::<Result<Vec<_>>>()
    })?;
    statuses.sort_unstable();
    let expected = [vec![202; 3], vec![409; AT_ONCE - 3]].concat();
    ensure!(statuses == expected, "{statuses:?}");
    let attempts = student.get(&path)?.expect(200)?;
    let numbers: Vec<_> =
        attempts["attempts"].as_array().into_iter().flatten().map(|own| own["number"].clone()).collect();
    ensure!(numbers == [1, 2, 3], "{attempts}");
    // One key at once from many connections is one attempt.
    let other = Visitor::student(&server.url, &code, "Carlos")?;
    let ids = thread::scope(|scope| {
        let other = &other;
        let assignment = &assignment;
        let sent: Vec<_> =
            (0..AT_ONCE).map(|_| scope.spawn(move || other.hand_in_surely(assignment, &stiff(), "one"))).collect();
        sent.into_iter().map(|sent| sent.join().expect("no panic")).collect::<Result<Vec<_>>>()
    })?;
    ensure!(ids.iter().all(|id| *id == ids[0]), "{ids:?}");
    let own = other.get(&format!("/assignments/{assignment}"))?.expect(200)?;
    ensure!(own["attempts_used"] == 1, "{own}");
    Ok(())
}

/// A job that kills its process three times is given up, and its attempt is given back.
pub fn given_back() -> Result<()> {
    let (mut server, folder) = school(Launch::new())?;
    let teacher = Visitor::teacher(&server, "ana", &[])?;
    let (class, code) = teacher.class("A")?;
    let assignment = teacher.give(&class, &json!({ "exercise": "hold", "attempts": 1 }))?;
    let student = Visitor::student(&server.url, &code, "Bea")?;
    let exercises = folder.path().to_string_lossy().into_owned();
    let launch = || Launch::new().variable("ADAPTARM_CLASSROOM_EXERCISES", &exercises);
    // One that computes nothing takes the attempt; then comes one that dies of whatever grades this assignment.
    server.restart_as(launch().arguments(["--threads", "0"]))?;
    let attempt = student.hand_in(&assignment, &soft())?;
    server.restart_as(launch().variable("ADAPTARM_TEST_ABORT_ON_LABEL", &format!("assignment {assignment}")))?;
    let state = || student.get(&format!("/attempts/{attempt}")).and_then(|answer| answer.expect(200));
    let deadline = Instant::now() + Duration::from_mins(2);
    let mut deaths = 0;
    while !state().is_ok_and(|attempt| attempt["state"] == "returned") {
        ensure!(Instant::now() < deadline, "{deaths} deaths, and it is not given back");
        if server.ended()?.is_some() {
            deaths += 1;
            server.restart()?;
        }
        thread::sleep(Duration::from_millis(50));
    }
    ensure!(deaths == 3, "{deaths} deaths");
    let given_back = student.graded(&attempt)?;
    ensure!(given_back["state"] == "returned" && given_back["score"].is_null(), "{given_back}");
    ensure!(given_back["reason"].as_str().is_some_and(|reason| reason.contains("does not count")), "{given_back}");
    let view = student.get(&format!("/assignments/{assignment}"))?.expect(200)?;
    ensure!(view["attempts_used"] == 0 && view["attempts_left"] == 1 && view["mark"].is_null(), "{view}");
    server.restart_as(launch())?;
    let again = student.graded(&student.hand_in(&assignment, &soft())?)?;
    ensure!(again["state"] == "graded" && again["number"] == 2, "{again}");
    Ok(())
}
