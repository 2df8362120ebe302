//! A whole school hands in within a minute while its server is killed: every attempt that was taken is graded, once, and with
//! the grade that the core gives undisturbed.

use adaptarm_core::exercises::{Exercise, Visibility};
use adaptarm_core::scenario::Scenario;
use adaptarm_tests::classroom::{Visitor, school};
use adaptarm_tests::{Launch, machine};
use anyhow::{Context, Result, ensure};
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread::{self, sleep};
use std::time::{Duration, Instant};

/// Connections that students share.
const CLIENTS: usize = 8;

/// Within which all hand in.
const MINUTE: Duration = Duration::from_mins(1);

pub fn hands_in() -> Result<()> {
    let (count, kills) = if machine::soak() { (200, 2) } else { (20, 1) };
    let (mut server, _folder) = school(Launch::new())?;
    let url = server.url.clone();
    let teacher = Visitor::teacher(&server, "ana", &[])?;
    let (class, code) = teacher.class("A")?;
    let assignment = teacher.give(&class, &json!({ "exercise": "hold", "attempts": 1 }))?;
    let students: Vec<_> =
        (0..count).map(|n| Visitor::student(&url, &code, &format!("Student {n}"))).collect::<Result<_>>()?;
    let gains: Vec<_> = (0..count).map(|n| json!({ "k_p": 20 + 380 * n / count, "k_d": 5 + n % 20 })).collect();

    let (began, next) = (Instant::now(), AtomicUsize::new(0));
    // Spread over half the time that they have, as people do: the rest is for outages.
    let pace = MINUTE / 2 / u32::try_from(count)?;
    let (handed, graded) = thread::scope(|scope| {
        let clients: Vec<_> = (0..CLIENTS)
            .map(|_| {
                scope.spawn(|| {
                    let mut taken = Vec::new();
                    loop {
                        let n = next.fetch_add(1, Ordering::Relaxed);
                        if n >= students.len() {
                            return Ok::<_, anyhow::Error>(taken);
                        }
                        sleep((pace * n as u32).saturating_sub(began.elapsed()));
                        taken.push((n, students[n].hand_in_surely(&assignment, &gains[n], "mine")?));
                    }
                })
            })
            .collect();
        for kill in 1..=kills {
            while next.load(Ordering::Relaxed) < count * kill / (kills + 1) {
                sleep(Duration::from_millis(5));
            }
            server.restart()?;
        }
        let mut taken = Vec::new();
        for client in clients {
            taken.extend(client.join().expect("a client does not panic")?);
        }
        let handed = began.elapsed();
        // The last that was taken before a kill is as safe as any: the server goes at once after it.
        server.restart()?;
        taken.sort();
        let graded = taken.iter().map(|(n, id)| students[*n].graded(id)).collect::<Result<Vec<_>>>()?;
        anyhow::Ok((handed, graded))
    })?;
    let took = began.elapsed();
    println!("{count} attempts handed in within {handed:.1?}, {} kills, the last grade after {took:.1?}", kills + 1);
    ensure!(handed < MINUTE, "handing in took {handed:?}");
    check(&teacher, &class, &assignment, &students, &graded)
}

/// Each student has one attempt, with the grade that its documents give here, and the teacher's books say the same.
fn check(teacher: &Visitor, class: &str, assignment: &str, students: &[Visitor], graded: &[Value]) -> Result<()> {
    let ids: BTreeSet<_> = graded.iter().map(|attempt| attempt["id"].to_string()).collect();
    ensure!(ids.len() == students.len() && graded.len() == students.len(), "{} attempts", ids.len());
    let library = teacher.get("/exercises")?.expect(200)?;
    let all = library["exercises"].as_array().context("no exercises")?;
    let mut hold = all.iter().find(|own| own["id"] == "hold").context("no hold")?.clone();
    // Its texts as they are shown stand beside the document.
    hold.as_object_mut().context("no object")?.remove("html");
    let exercise = Exercise::read(&hold)?;
    let board = teacher.get(&format!("/assignments/{assignment}/board"))?.expect(200)?;
    ensure!(board["graded"] == students.len(), "{} graded", board["graded"]);
    for (student, attempt) in students.iter().zip(graded) {
        ensure!(attempt["state"] == "graded" && attempt["number"] == 1 && attempt["counts"] == true, "{attempt}");
        let work = teacher.get(&format!("/assignments/{assignment}/students/{}", student.id()?))?.expect(200)?;
        let attempts = work["attempts"].as_array().context("no attempts")?;
        ensure!(attempts.len() == 1 && attempts[0]["score"] == attempt["score"], "{work}");
        let variants = attempts[0]["grade"]["variants"].as_array().context("no variants")?;
        let runs = attempts[0]["runs"].as_array().context("no runs")?.iter().filter(|run| run["hidden"] == true);
        for (run, variant) in runs.zip(variants) {
            let report = Scenario::read(&run["scenario"])?.run().report;
            ensure!(variant["trajectory_hash"] == report.trajectory_hash, "{variant}");
        }
    }
    let variants = exercise.document().hidden.as_ref().map_or(0, |hidden| hidden.count);
    ensure!(variants == 3 && exercise.runs(&exercise.start(), 1, Visibility::Hidden)?.len() == 3);
    let book = teacher.get(&format!("/classes/{class}/gradebook.csv?shape=moodle"))?;
    let lines = String::from_utf8(book.body)?;
    for attempt in graded {
        let points = &attempt["points"];
        ensure!(lines.contains(&format!(",{},", points.as_f64().context("no points")?)), "{points} in {lines}");
    }
    Ok(())
}
