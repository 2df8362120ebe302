//! A course from end to end: one student solves, one does not, one hands in nonsense; the teacher sees, extends, overrides and
//! exports, and the numbers agree everywhere.

use adaptarm_core::exercises::{Exercise, Visibility};
use adaptarm_core::scenario::Scenario;
use adaptarm_tests::classroom::{Visitor, school, secret, soft, stiff, teacher_link};
use adaptarm_tests::postgres::Cluster;
use adaptarm_tests::{Launch, Server};
use anyhow::{Context, Result, ensure};
use serde_json::{Value, json};

pub fn on_sqlite() -> Result<()> {
    let (server, _folder) = school(Launch::new())?;
    whole(&server, &[])
}

pub fn on_postgres() -> Result<()> {
    let cluster = Cluster::start()?;
    let database = cluster.database("school")?;
    let arguments = ["--database", database.as_str()];
    let (server, _folder) = school(Launch::new().arguments(arguments))?;
    whole(&server, &arguments)
}

fn whole(server: &Server, arguments: &[&str]) -> Result<()> {
    let teacher = Visitor::teacher(server, "ana", arguments)?;
    let (class, code) = teacher.class("Control, spring")?;
    let late = json!({ "percent_per_day": 10, "cap_percent": 50, "days": 7 });
    let given = json!({
        "exercise": "hold", "deadline": "2200-01-01T00:00:00Z", "attempts": 2, "late": late, "points": 50,
        "leaderboard": true,
    });
    let assignment = teacher.give(&class, &given)?;
    for (deadline, reason) in [("2020-01-01T00:00:00Z", json!("past")), ("0000-01-01T00:00:00Z", Value::Null)] {
        let over = json!({ "exercise": "hold", "deadline": deadline });
        let refused = teacher.post(&format!("/classes/{class}/assignments"), &over)?.expect(422)?;
        ensure!(refused["pointer"] == "/deadline" && refused["reason"] == reason, "{refused}");
    }
    let [well, badly, nonsense] =
        ["Bea", "Carlos", "Dora, the third"].map(|name| Visitor::student(&server.url, &code, name));
    let (well, badly, nonsense) = (well?, badly?, nonsense?);

    let (good, best) = solve(&well, &assignment)?;
    ensure!(good["score"] == 1.0 && good["points"] == 50.0 && good["late_percent"] == 0.0, "{good}");
    let poor = badly.graded(&badly.hand_in(&assignment, &soft())?)?;
    let score = poor["score"].as_f64().context("no score")?;
    ensure!(score < 0.7 && poor["points"] == (50.0 * score * 100.0).round() / 100.0, "{poor}");
    for wrong in
        [json!({}), json!({ "k_p": 1 }), json!({ "k_p": 501, "k_d": 1 }), json!({ "k_p": 1, "k_d": 1, "k_i": 1 })]
    {
        let path = format!("/assignments/{assignment}/attempts");
        let refused = nonsense.post(&path, &json!({ "gains": wrong }))?.expect(422)?;
        ensure!(refused["pointer"].as_str().is_some_and(|at| at.starts_with("/gains")), "{refused}");
    }
    ensure!(nonsense.get(&format!("/assignments/{assignment}/attempts"))?.expect(200)?["attempts"] == json!([]));

    preview(&well, &assignment)?;
    hints(&badly, &assignment)?;
    look(&teacher, &assignment, &[&well, &badly, &nonsense], &poor)?;
    replay(&teacher, &assignment, &well)?;
    extend(&teacher, &assignment, &badly)?;
    decide(&teacher, &class, &assignment, &nonsense)?;
    books(&teacher, &class, &well, &badly, &poor)?;
    let board = well.get(&format!("/assignments/{assignment}/leaderboard"))?.expect(200)?;
    let entries = board["entries"].as_array().context("no entries")?;
    ensure!(entries.len() == 3 && entries[0] == json!({ "rank": 1, "points": 50.0, "you": true }), "{board}");
    ensure!(!board.to_string().contains("Bea"), "{board}");
    papers(server, &teacher, &class, &assignment, &well, &best)?;
    leave(server, &teacher, &class, &badly)
}

/// Hands in twice under one key, follows the grade, and finds it final.
fn solve(student: &Visitor, assignment: &str) -> Result<(Value, String)> {
    let attempt = student.hand_in_surely(assignment, &stiff(), "once")?;
    ensure!(student.hand_in_surely(assignment, &stiff(), "once")? == attempt, "one key, two attempts");
    let path = format!("/assignments/{assignment}/attempts");
    let other = student.send("POST", &path, &[("idempotency-key", "once")], Some(&json!({ "gains": soft() })))?;
    ensure!(other.expect(422)?["type"] == "/problems/idempotency-key");
    let events = student.events(&attempt)?;
    let last = events.last().context("no events")?;
    ensure!(last.kind == "attempt" && last.data["state"] == "graded", "{events:?}");
    ensure!(events.iter().all(|event| matches!(event.kind.as_str(), "progress" | "attempt")), "{events:?}");
    let graded = student.graded(&attempt)?;
    ensure!(graded == last.data && graded["counts"] == true && graded["number"] == 1, "{graded}");
    let view = student.get(&format!("/assignments/{assignment}"))?.expect(200)?;
    ensure!(view["attempts_used"] == 1 && view["attempts_left"] == 1 && view["mark"]["points"] == 50.0, "{view}");
    Ok((graded, attempt))
}

/// What the browser computes on visible variants is what the server says they are.
fn preview(student: &Visitor, assignment: &str) -> Result<()> {
    let view = student.get(&format!("/assignments/{assignment}"))?.expect(200)?;
    let exercise = Exercise::read(&view["exercise"])?;
    let seed = view["seed"].as_u64().context("no seed")?;
    let runs = exercise.runs(&exercise.start(), seed, Visibility::Visible)?;
    let documents: Vec<_> = runs.iter().map(|run| json!(run.document())).collect();
    ensure!(view["visible"] == json!(documents), "{view}");
    let told = view.to_string();
    for secret in ["hidden", "solution-stiff", "NOTE-FOR", "EXPLANATION-OF", "HINT-TWO"] {
        ensure!(!told.contains(secret), "{secret} in {told}");
    }
    Ok(())
}

/// The second hint comes after the second graded attempt.
fn hints(student: &Visitor, assignment: &str) -> Result<()> {
    let hints = || {
        let view = student.get(&format!("/assignments/{assignment}"))?.expect(200)?;
        Ok::<_, anyhow::Error>((view["exercise"]["hints"].to_string(), view["hints_total"].clone()))
    };
    let (before, total) = hints()?;
    ensure!(before.contains("HINT-ONE") && !before.contains("HINT-TWO") && total == 2, "{before}");
    student.graded(&student.hand_in(assignment, &soft())?)?;
    ensure!(hints()?.0.contains("HINT-TWO"));
    Ok(())
}

/// The board agrees with what the students were told.
fn look(teacher: &Visitor, assignment: &str, students: &[&Visitor], poor: &Value) -> Result<()> {
    let board = teacher.get(&format!("/assignments/{assignment}/board"))?.expect(200)?;
    let counts = [&board["started"], &board["graded"], &board["students"][2]["attempts"]];
    ensure!(counts == [&json!(2), &json!(2), &json!(0)], "{board}");
    for (row, student) in board["students"].as_array().context("no students")?.iter().zip(students) {
        let mine = student.get(&format!("/assignments/{assignment}"))?.expect(200)?;
        ensure!(row["id"] == student.id()?.as_str() && row["mark"] == mine["mark"], "{row} {mine}");
    }
    let spread: Vec<_> = board["distribution"].as_array().context("no distribution")?.clone();
    ensure!(
        spread.len() == 10 && spread[9] == 1 && spread.iter().filter_map(Value::as_u64).sum::<u64>() == 2,
        "{board}"
    );
    let mean = f64::midpoint(50.0, poor["points"].as_f64().context("no points")?);
    ensure!((board["mean_points"].as_f64().context("no mean")? - mean).abs() < 1e-9, "{board}");
    ensure!(board["commonest_failure"] == "error" && board["criteria"][0]["failing"] == 1, "{board}");
    Ok(())
}

/// The teacher's documents give the very runs that were graded, hidden ones too.
fn replay(teacher: &Visitor, assignment: &str, student: &Visitor) -> Result<()> {
    let work = teacher.get(&format!("/assignments/{assignment}/students/{}", student.id()?))?.expect(200)?;
    let attempt = &work["attempts"][0];
    let runs = attempt["runs"].as_array().context("no runs")?;
    let hidden: Vec<_> = runs.iter().filter(|run| run["hidden"] == true).collect();
    let variants = attempt["grade"]["variants"].as_array().context("no variants")?;
    ensure!((runs.len(), hidden.len(), variants.len()) == (5, 3, 3), "{attempt}");
    for (run, variant) in hidden.iter().zip(variants) {
        let report = Scenario::read(&run["scenario"])?.run().report;
        ensure!(variant["scenario_hash"] == report.scenario_hash, "{variant}");
        ensure!(variant["trajectory_hash"] == report.trajectory_hash, "{variant}");
    }
    ensure!(attempt["gains"] == stiff(), "{attempt}");
    Ok(())
}

/// Whoever has used all attempts gets another one.
fn extend(teacher: &Visitor, assignment: &str, student: &Visitor) -> Result<()> {
    let path = format!("/assignments/{assignment}/attempts");
    let refused = student.post(&path, &json!({ "gains": stiff() }))?;
    let problem = refused.expect(409)?;
    ensure!(problem["type"] == "/problems/attempts" && problem["allowed"] == 2, "{problem}");
    let extension = json!({ "deadline": "2201-01-01T00:00:00Z", "attempts": 1, "comment": "was ill" });
    let own = format!("/assignments/{assignment}/extensions/{}", student.id()?);
    // An extension that would take time away.
    for sooner in ["2020-01-01T00:00:00Z", "2200-01-01T00:00:00Z"] {
        let refused = teacher.put(&own, &json!({ "deadline": sooner, "attempts": 1 }))?.expect(422)?;
        ensure!(refused["pointer"] == "/deadline" && refused["reason"] == "class-deadline", "{refused}");
    }
    // More attempts alone leave the deadline as it is.
    teacher.put(&own, &json!({ "attempts": 1 }))?.expect(200)?;
    let view = student.get(&format!("/assignments/{assignment}"))?.expect(200)?;
    ensure!(view["deadline"] == "2200-01-01T00:00:00Z" && view["attempts_left"] == 1, "{view}");
    teacher.put(&own, &extension)?.expect(200)?;
    let view = student.get(&format!("/assignments/{assignment}"))?.expect(200)?;
    ensure!(
        view["extended"] == true && view["attempts_left"] == 1 && view["deadline"] == "2201-01-01T00:00:00Z",
        "{view}"
    );
    Ok(())
}

/// A mark by the teacher's own decision, with its reason, where everyone sees it.
fn decide(teacher: &Visitor, class: &str, assignment: &str, student: &Visitor) -> Result<()> {
    let path = format!("/assignments/{assignment}/students/{}/override", student.id()?);
    for wrong in [
        json!({ "points": 30 }),
        json!({ "points": 30, "comment": " " }),
        json!({ "points": -1, "comment": "x" }),
        json!({ "points": 30, "comment": "-2+3" }),
    ] {
        teacher.put(&path, &wrong)?.expect(422)?;
    }
    let mark = teacher.put(&path, &json!({ "points": 30, "comment": "oral exam" }))?.expect(200)?;
    ensure!(mark["points"] == 30.0 && mark["overridden"] == true && mark["comment"] == "oral exam", "{mark}");
    let view = student.get(&format!("/assignments/{assignment}"))?.expect(200)?;
    ensure!(view["mark"] == mark, "{view}");
    // It is as large a share of the points when full credit becomes worth another number of them.
    for (points, expected) in [(10, 6.0), (50, 30.0)] {
        teacher.patch(&format!("/assignments/{assignment}"), &json!({ "points": points }))?.expect(200)?;
        let mark = student.get(&format!("/assignments/{assignment}"))?.expect(200)?["mark"].clone();
        ensure!(mark["points"] == expected && mark["of"] == f64::from(points), "{mark}");
    }
    let audit = teacher.get(&format!("/classes/{class}/audit"))?.expect(200)?;
    let newest = &audit["entries"][2];
    ensure!(newest["what"] == "mark.override" && newest["data"]["points"] == 30.0, "{audit}");
    ensure!(
        newest["data"]["student"] == student.id()?.as_str() && newest["teacher"] == teacher.id()?.as_str(),
        "{audit}"
    );
    ensure!(!audit.to_string().contains("Dora"), "people are in the audit by identifiers: {audit}");
    Ok(())
}

/// The gradebook in three shapes says what everyone else says.
fn books(teacher: &Visitor, class: &str, well: &Visitor, badly: &Visitor, poor: &Value) -> Result<()> {
    teacher.patch(&format!("/students/{}", well.id()?), &json!({ "number": "S-001" }))?.expect(200)?;
    let book = |shape: &str| {
        let answer = teacher.get(&format!("/classes/{class}/gradebook.csv?shape={shape}"))?;
        answer.expect_status(200)?;
        ensure!(answer.header("content-type").starts_with("text/csv"), "{answer}");
        Ok(String::from_utf8(answer.body)?.lines().map(str::to_owned).collect::<Vec<_>>())
    };
    let points = poor["points"].as_f64().context("no points")?;
    let canvas = book("canvas")?;
    let class_name = "\"Control, spring\"";
    let expected = [
        "Student,ID,SIS User ID,SIS Login ID,Section,Hold it".to_owned(),
        "\"    Points Possible\",,,,,50".to_owned(),
        format!("Bea,,S-001,,{class_name},50"),
        format!("Carlos,,,,{class_name},{points}"),
        format!("\"Dora, the third\",,,,{class_name},30"),
    ];
    ensure!(canvas == expected, "{canvas:?}");
    let moodle = book("moodle")?;
    let expected = [
        "ID number,Full name,Hold it,Hold it (feedback)".to_owned(),
        "S-001,Bea,50,".to_owned(),
        format!(",Carlos,{points},"),
        ",\"Dora, the third\",30,oral exam".to_owned(),
    ];
    ensure!(moodle == expected, "{moodle:?}");
    let plain = book("plain")?;
    ensure!(plain[0].starts_with("\u{feff}Name,Login"), "Excel needs to be told that it is UTF-8: {plain:?}");
    ensure!(plain[1] == format!("Bea,{},S-001,50,1,0,", well.text("login")?), "{plain:?}");
    ensure!(plain[2] == format!("Carlos,{},,{points},2,0,", badly.text("login")?), "{plain:?}");
    teacher.get(&format!("/classes/{class}/gradebook.csv?shape=xlsx"))?.expect(422)?;
    Ok(())
}

/// The explanation comes when the deadline is over for everyone; then attempts are late, then refused.
fn papers(
    server: &Server,
    teacher: &Visitor,
    class: &str,
    assignment: &str,
    student: &Visitor,
    attempt: &str,
) -> Result<()> {
    let set = |change: Value| teacher.patch(&format!("/assignments/{assignment}"), &change)?.expect(200);
    let released = || {
        let view = student.get(&format!("/assignments/{assignment}"))?.expect(200)?;
        Ok::<_, anyhow::Error>((view["state"].clone(), view["exercise"].get("explanation").is_some()))
    };
    ensure!(released()? == (json!("open"), false));
    let reveal = format!("/attempts/{attempt}/reveal");
    student.get(&reveal)?.expect_status(409)?;
    // A day and a half ago: two days have begun.
    let past = jiff::Timestamp::now() - jiff::SignedDuration::from_hours(36);
    set(json!({ "deadline": past.to_string() }))?;
    ensure!(released()? == (json!("late"), false));
    let late = student.graded(&student.hand_in(assignment, &stiff())?)?;
    ensure!(late["late_percent"] == 20.0 && late["points"] == 40.0 && late["counts"] == false, "{late}");
    let early = student.graded(attempt)?;
    // Handed in after the deadline as it is now, and earlier than the other.
    ensure!(early["points"] == 40.0 && early["counts"] == true, "{early}");
    set(json!({ "late": null }))?;
    ensure!(released()? == (json!("closed"), false), "someone has an extension until 2201");
    let path = format!("/assignments/{assignment}/attempts");
    let refused = student.post(&path, &json!({ "gains": stiff() }))?.expect(409)?;
    ensure!(refused["type"] == "/problems/closed", "{refused}");
    let listed = teacher.get(&format!("/classes/{class}"))?.expect(200)?;
    for extension in listed["assignments"][0]["extensions"].as_array().context("no extensions")? {
        let whose = extension["student"].as_str().context("no student")?;
        teacher.delete(&format!("/assignments/{assignment}/extensions/{whose}"))?.expect_status(204)?;
    }
    ensure!(released()? == (json!("closed"), true), "nobody can hand in any more");
    let receipt = student.get(&format!("/attempts/{attempt}/receipt"))?.expect(200)?;
    receipts(server, &receipt, &student.get(&reveal)?.expect(200)?, &early)
}

/// The receipt is signed by the server's key and runs again to the same bits; a forged one is refused.
fn receipts(server: &Server, receipt: &Value, reveal: &Value, attempt: &Value) -> Result<()> {
    let statement = &receipt["statement"];
    ensure!(statement["gains"] == attempt["gains"] && statement["grade"]["score"] == attempt["score"], "{receipt}");
    ensure!(statement["graded_at"] == attempt["graded_at"] && statement["attempt"] == attempt["id"], "{receipt}");
    let folder = tempfile::tempdir()?;
    let write = |name: &str, document: &Value| {
        let path = folder.path().join(name);
        std::fs::write(&path, document.to_string())?;
        Ok::<_, anyhow::Error>(path)
    };
    let adaptarm = |arguments: &[&std::ffi::OsStr]| {
        let output = std::process::Command::new(adaptarm_tests::binary()?).args(arguments).output()?;
        Ok::<_, anyhow::Error>((output.status.code(), String::from_utf8_lossy(&output.stdout).trim().to_owned()))
    };
    let (_, key) = adaptarm(&["receipt".as_ref(), "key".as_ref(), "--data".as_ref(), server.data.path().as_ref()])?;
    let revealed = write("reveal.json", reveal)?;
    let verify = |receipt: &std::path::Path| {
        let words: [&std::ffi::OsStr; 7] = [
            "receipt".as_ref(),
            "verify".as_ref(),
            receipt.as_ref(),
            "--key".as_ref(),
            key.as_ref(),
            "--reveal".as_ref(),
            revealed.as_ref(),
        ];
        adaptarm(&words)
    };
    let (code, told) = verify(&write("receipt.json", receipt)?)?;
    ensure!(code == Some(0), "{code:?}: {told}");
    let mut forged = receipt.clone();
    forged["statement"]["gains"]["k_p"] = json!(399.0);
    let (code, told) = verify(&write("forged.json", &forged)?)?;
    ensure!(code == Some(2), "{code:?}: {told}");
    Ok(())
}

/// What is kept about a student can be taken along, and is gone when they want it gone.
fn leave(server: &Server, teacher: &Visitor, class: &str, student: &Visitor) -> Result<()> {
    let export = student.get("/me/export")?.expect(200)?;
    ensure!(export["student"]["name"] == "Carlos" && export["class"] == "Control, spring", "{export}");
    let attempts = export["assignments"][0]["attempts"].as_array().context("no attempts")?;
    ensure!(attempts.len() == 2 && attempts.iter().all(|attempt| attempt["gains"] == soft()), "{export}");
    let as_teacher = teacher.get(&format!("/students/{}/export", student.id()?))?.expect(200)?;
    ensure!(as_teacher["assignments"] == export["assignments"], "{as_teacher}");
    student.delete("/me")?.expect_status(204)?;
    student.get("/me/export")?.expect_status(401)?;
    teacher.get(&format!("/students/{}/export", student.id()?))?.expect_status(404)?;
    let left = teacher.get(&format!("/classes/{class}"))?.expect(200)?;
    ensure!(left["student_count"] == 2 && !left.to_string().contains("Carlos"), "{left}");
    ensure!(Visitor::new(&server.url).post("/session", &json!({ "key": student.text("key")? }))?.status == 401);
    teacher.delete(&format!("/classes/{class}"))?.expect_status(204)?;
    ensure!(teacher.get("/classes")?.expect(200)? == json!({ "classes": [] }));
    Ok(())
}

/// Links of the command line work once, in either order, and an invitation makes one more teacher.
pub fn teachers() -> Result<()> {
    let (server, _folder) = school(Launch::new())?;
    let [first, second] = [teacher_link(&server, &[])?, teacher_link(&server, &["--url", "https://lab.example.org"])?];
    ensure!(second.starts_with("https://lab.example.org/teach.html#invitation="), "{second}");
    let redeem = |link: &str, login: &str| {
        let body = json!({ "invitation": secret(link, "invitation")?, "name": "T", "login": login });
        Visitor::new(&server.url).post("/teachers", &body)
    };
    redeem(&first, "Not A Login")?.expect_status(422)?;
    redeem(&first, "ana")?.expect_status(201)?;
    // The one voids the other: both were for the first teacher.
    for link in [&first, &second] {
        ensure!(redeem(link, "eva")?.expect(401)?["type"] == "/problems/sign-in");
    }
    let teacher = Visitor::teacher(&server, "bob", &[])?;
    let link = teacher.post("/invitations", &json!({}))?.expect(201)?;
    let link = link["link"].as_str().context("no link")?;
    ensure!(redeem(link, "bob")?.expect(409)?["type"] == "/problems/taken", "the link is still good");
    redeem(link, "eva")?.expect_status(201)?;
    redeem(link, "iva")?.expect_status(401)?;
    // The way back to one's own classes, by the command line.
    let (class, _) = teacher.class("A")?;
    let back = teacher_link(&server, &["--login", "bob"])?;
    let mut again = Visitor::new(&server.url);
    again.enter("/session", &json!({ "key": secret(&back, "key")? }))?;
    ensure!(again.get("/classes")?.expect(200)?["classes"][0]["id"] == class.as_str());
    ensure!(teacher.get("/classes")?.status == 401, "the old sessions are over");
    ensure!(teacher_link(&server, &["--login", "nobody"]).is_err());
    // A folder that no server uses is not made: a link into it would let nobody in.
    let nowhere = server.data.path().join("nowhere");
    let output = std::process::Command::new(adaptarm_tests::binary()?)
        .args(["teacher", "link", "--data"])
        .arg(&nowhere)
        .output()?;
    ensure!(!output.status.success() && !nowhere.exists(), "{output:?}");
    let teacher = again;
    let exercises = teacher.get("/exercises")?.expect(200)?.to_string();
    ensure!(exercises.contains("NOTE-FOR-TEACHERS") && exercises.contains("solution-stiff"));
    Ok(())
}
