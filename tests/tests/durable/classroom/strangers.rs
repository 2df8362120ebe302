//! What a student may not see: teachers' pages and requests, other students, other classes, hidden variants; by addresses,
//! identifiers, jobs, cursors, and the words and time of errors.

use adaptarm_tests::Launch;
use adaptarm_tests::classroom::{Visitor, school, soft, stiff};
use adaptarm_tests::client::Client;
use anyhow::{Context, Result, ensure};
use serde_json::{Value, json};
use std::time::Instant;

/// A request of a teacher: method, path, body.
type Request = (&'static str, String, Option<Value>);

/// Everything that teachers may ask, about these.
fn of_teachers(class: &str, assignment: &str, student: &str) -> Vec<Request> {
    let some = || Some(json!({}));
    vec![
        ("POST", "/invitations".to_owned(), some()),
        ("GET", "/exercises".to_owned(), None),
        ("GET", "/classes".to_owned(), None),
        ("POST", "/classes".to_owned(), Some(json!({ "name": "B" }))),
        ("GET", format!("/classes/{class}"), None),
        ("PATCH", format!("/classes/{class}"), some()),
        ("DELETE", format!("/classes/{class}"), None),
        ("POST", format!("/classes/{class}/code"), some()),
        ("POST", format!("/classes/{class}/assignments"), Some(json!({ "exercise": "hold" }))),
        ("GET", format!("/classes/{class}/gradebook.csv"), None),
        ("GET", format!("/classes/{class}/audit"), None),
        ("PATCH", format!("/students/{student}"), Some(json!({ "name": "X" }))),
        ("DELETE", format!("/students/{student}"), None),
        ("POST", format!("/students/{student}/key"), some()),
        ("GET", format!("/students/{student}/export"), None),
        ("PATCH", format!("/assignments/{assignment}"), some()),
        ("DELETE", format!("/assignments/{assignment}"), None),
        ("PUT", format!("/assignments/{assignment}/extensions/{student}"), some()),
        ("DELETE", format!("/assignments/{assignment}/extensions/{student}"), None),
        ("GET", format!("/assignments/{assignment}/board"), None),
        ("GET", format!("/assignments/{assignment}/students/{student}"), None),
        (
            "PUT",
            format!("/assignments/{assignment}/students/{student}/override"),
            Some(json!({ "points": 100, "comment": "mine" })),
        ),
    ]
}

pub fn roles() -> Result<()> {
    let (server, _folder) = school(Launch::new())?;
    let teacher = Visitor::teacher(&server, "ana", &[])?;
    let (class, code) = teacher.class("A")?;
    let assignment = teacher.give(&class, &json!({ "exercise": "hold" }))?;
    let (bea, carlos) = (Visitor::student(&server.url, &code, "Bea")?, Visitor::student(&server.url, &code, "Carlos")?);
    let attempt = bea.hand_in(&assignment, &stiff())?;
    bea.graded(&attempt)?;
    let anyone = Visitor::new(&server.url);
    let nowhere = "0197b0a0-0000-7000-8000-000000000000";
    for (method, path, body) in of_teachers(&class, &assignment, &bea.id()?) {
        let refused = carlos.send(method, &path, &[], body.as_ref())?.expect(403)?;
        ensure!(refused["type"] == "/problems/role", "{method} {path}: {refused}");
        anyone.send(method, &path, &[], body.as_ref())?.expect_status(401)?;
    }
    // Another teacher, and another class's student: nothing of it exists, as if it never had.
    let eva = Visitor::teacher(&server, "eva", &[])?;
    let (other_class, other_code) = eva.class("B")?;
    let dora = Visitor::student(&server.url, &other_code, "Dora")?;
    let theirs = of_teachers(&class, &assignment, &bea.id()?);
    let nobodys = of_teachers(nowhere, nowhere, nowhere);
    for ((method, path, body), (_, unknown, _)) in
        theirs.iter().zip(&nobodys).filter(|((_, path, _), _)| path.contains('-'))
    {
        let [refused, none] = [path, unknown].map(|path| stripped(eva.send(method, path, &[], body.as_ref())));
        let (refused, none) = (refused?, none?);
        ensure!(refused == none && refused["status"] == 404, "{method} {path}: {refused} {none}");
    }
    // Ana's assignment with a student of Eva's.
    for (method, path, body) in of_teachers(&class, &assignment, &dora.id()?)
        .iter()
        .filter(|(_, path, _)| path.contains("/students/") || path.contains("/extensions/"))
    {
        teacher.send(method, path, &[], body.as_ref())?.expect_status(404).with_context(|| path.clone())?;
    }
    for student in [&carlos, &dora] {
        for rest in ["", "/events", "/receipt", "/reveal"] {
            let [refused, none] = [&attempt, nowhere].map(|id| stripped(student.get(&format!("/attempts/{id}{rest}"))));
            ensure!(refused? == none?, "{rest}");
        }
    }
    let paths = ["", "/attempts", "/leaderboard"].map(|rest| (rest, format!("/assignments/{assignment}{rest}")));
    for (rest, path) in &paths {
        ensure!(stripped(dora.get(path))? == stripped(dora.get(&format!("/assignments/{nowhere}{rest}")))?, "{path}");
    }
    dora.post(&format!("/assignments/{assignment}/attempts"), &json!({ "gains": soft() }))?.expect_status(404)?;
    ensure!(dora.get("/assignments")?.expect(200)? == json!({ "assignments": [] }));
    ensure!(eva.get(&format!("/classes/{other_class}"))?.expect(200)?["student_count"] == 1);
    unopened(&teacher, &class, &carlos)
}

/// A problem without the name of the request that it answers.
fn stripped(answer: Result<adaptarm_tests::client::Answer>) -> Result<Value> {
    let mut problem = answer?.json()?;
    ensure!(problem["status"].as_u64() >= Some(400), "{problem}");
    problem["instance"] = Value::Null;
    Ok(problem)
}

/// What has not opened does not exist for students.
fn unopened(teacher: &Visitor, class: &str, student: &Visitor) -> Result<()> {
    let given = json!({ "exercise": "hold", "opens_at": "2200-01-01T00:00:00Z", "leaderboard": true });
    let assignment = teacher.give(class, &given)?;
    for rest in ["", "/attempts", "/leaderboard"] {
        student.get(&format!("/assignments/{assignment}{rest}"))?.expect_status(404)?;
    }
    student.post(&format!("/assignments/{assignment}/attempts"), &json!({ "gains": soft() }))?.expect_status(404)?;
    ensure!(!student.get("/assignments")?.expect(200)?.to_string().contains(&assignment));
    Ok(())
}

/// Hidden variants and the jobs that compute them are in no answer to anyone but the teacher.
pub fn hidden() -> Result<()> {
    let (server, _folder) = school(Launch::new())?;
    let teacher = Visitor::teacher(&server, "ana", &[])?;
    let (class, code) = teacher.class("A")?;
    let assignment = teacher.give(&class, &json!({ "exercise": "hold", "explanation": "now" }))?;
    let student = Visitor::student(&server.url, &code, "Bea")?;
    let attempt = student.hand_in(&assignment, &stiff())?;
    let events = student.events(&attempt)?;
    student.graded(&attempt)?;
    let work = teacher.get(&format!("/assignments/{assignment}/students/{}", student.id()?))?.expect(200)?;
    let grade = &work["attempts"][0]["grade"];
    let mut secrets = Vec::new();
    for variant in grade["variants"].as_array().context("no variants")? {
        secrets.extend(
            [&variant["scenario_hash"], &variant["trajectory_hash"]]
                .map(|hash| hash.as_str().unwrap_or("?").to_owned()),
        );
    }
    for run in work["attempts"][0]["runs"].as_array().context("no runs")?.iter().filter(|run| run["hidden"] == true) {
        secrets.push(run["scenario"]["seed"].to_string());
        secrets.push(run["scenario"]["plant"]["theta_scale"][3].to_string());
    }
    ensure!(secrets.len() == 12 && secrets.iter().all(|secret| secret.len() > 6), "{secrets:?}");
    let mut told = format!("{events:?}");
    let paths = [
        "/session".to_owned(),
        "/assignments".to_owned(),
        format!("/assignments/{assignment}"),
        format!("/assignments/{assignment}/attempts"),
        format!("/attempts/{attempt}"),
        format!("/attempts/{attempt}/receipt"),
        format!("/attempts/{attempt}/reveal"),
        "/me/export".to_owned(),
    ];
    for path in paths {
        told += &String::from_utf8(student.get(&path)?.body)?;
    }
    // Nor do jobs tell: not by a list, not by identifiers, though this server asks nobody for a token.
    let client = Client::new(&server.url);
    told += &client.get("/api/v1/jobs?limit=200")?.expect(200)?.to_string();
    client.get("/api/v1/jobs?kind=grade")?.expect_status(422)?;
    let graded = json!({ "kind": "grade", "spec": { "scenarios": [] } });
    ensure!(client.post("/api/v1/jobs", &graded)?.status == 422);
    for secret in &secrets {
        ensure!(!told.contains(secret), "{secret} in {told}");
    }
    ensure!(
        told.contains("EXPLANATION-OF-HOLD") && !told.contains("solution-stiff") && !told.contains("NOTE-FOR"),
        "{told}"
    );
    files(&client)?;
    times(&student, &attempt)
}

/// The files of the library are not among those of the page.
fn files(client: &Client) -> Result<()> {
    let listed = client.get("/files.json")?.expect(200)?.to_string();
    ensure!(!listed.contains(".toml"), "{listed}");
    for path in
        ["/exercises/pendulum-gravity.toml", "/static/exercises/pendulum-gravity.toml", "/exercises/", "/exercises"]
    {
        client.get(path)?.expect_status(404)?;
    }
    Ok(())
}

/// That there is an attempt, of someone else, is not told by the time that the refusal takes.
fn times(student: &Visitor, own: &str) -> Result<()> {
    let other = student.clone().with_cookie(None);
    other.get(&format!("/attempts/{own}"))?.expect_status(401)?;
    let nowhere = "0197b0a0-0000-7000-8000-000000000000";
    let mut least = [f64::INFINITY; 2];
    for _ in 0..20 {
        for (time, path) in least.iter_mut().zip([format!("/attempts/{own}"), format!("/attempts/{nowhere}")]) {
            let began = Instant::now();
            other.get(&path)?.expect_status(401)?;
            *time = time.min(began.elapsed().as_secs_f64());
        }
    }
    println!("refusals take {least:?} s for what exists and what does not");
    ensure!(least[0] < 3.0 * least[1] + 0.005 && least[1] < 3.0 * least[0] + 0.005, "{least:?}");
    Ok(())
}
