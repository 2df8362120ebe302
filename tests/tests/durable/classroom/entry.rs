//! Coming in: sessions that nobody can plant, share or keep for ever, requests of other sites, passwords, and guessing.

use adaptarm_tests::Launch;
use adaptarm_tests::classroom::{ROOT, Visitor, school};
use adaptarm_tests::client::Client;
use anyhow::{Context, Result, ensure};
use serde_json::{Value, json};
use std::time::{Duration, Instant};

/// A cookie that someone planted is not the session after signing in, and the session before ends with it.
pub fn fixation() -> Result<()> {
    let (server, _folder) = school(Launch::new())?;
    let teacher = Visitor::teacher(&server, "ana", &[])?;
    let (_, code) = teacher.class("A")?;
    let planted = format!("adaptarm={}", "a".repeat(64));
    let mut student = Visitor::new(&server.url).with_cookie(Some(planted.clone()));
    student.enter("/students", &json!({ "code": code, "name": "Bea" }))?;
    let first = student.clone();
    ensure!(first.cookie.as_deref() != Some(&planted), "the planted cookie became the session");
    let as_planted = Visitor::new(&server.url).with_cookie(Some(planted.clone()));
    ensure!(as_planted.get("/session")?.expect(200)? == json!({ "role": null }));
    // Signing in again, with the first session's cookie: another session, and the first is over.
    student.enter("/session", &json!({ "key": first.text("key")? }))?;
    ensure!(student.cookie != first.cookie && student.csrf != first.csrf);
    first.get("/assignments")?.expect_status(401)?;
    student.get("/assignments")?.expect_status(200)?;
    // A cookie that is there twice does not count, whichever is the good one.
    let good = student.cookie.clone().context("no cookie")?;
    for both in [format!("{good}; {planted}"), format!("{planted}; {good}")] {
        let tossed = student.clone().with_cookie(Some(both));
        tossed.get("/assignments")?.expect_status(401)?;
    }
    student.delete("/session")?.expect_status(204)?;
    student.get("/assignments")?.expect_status(401)?;
    cookies(&server.url, &first)
}

/// The cookie is out of reach of scripts and other sites, and over https bound to it.
fn cookies(url: &str, student: &Visitor) -> Result<()> {
    let key = json!({ "key": student.text("key")? });
    let anyone = Visitor::new(url);
    let plain = anyone.post("/session", &key)?;
    let cookie = plain.header("set-cookie");
    ensure!(cookie.starts_with("adaptarm=") && cookie.ends_with("HttpOnly; SameSite=Strict"), "{cookie}");
    let secure = anyone.send("POST", "/session", &[("x-forwarded-proto", "https")], Some(&key))?;
    let cookie = secure.header("set-cookie").to_owned();
    ensure!(cookie.starts_with("__Host-adaptarm=") && cookie.ends_with("SameSite=Strict; Secure"), "{cookie}");
    ensure!(cookie.contains("; Path=/;") && !cookie.contains("Domain"), "{cookie}");
    // Without https it is not read, under either name.
    let value = cookie.split(';').next().and_then(|pair| pair.split_once('=')).context("no value")?.1.to_owned();
    let host = Visitor::new(url).with_cookie(Some(format!("__Host-adaptarm={value}")));
    host.get("/assignments")?.expect_status(401)?;
    host.send("GET", "/assignments", &[("x-forwarded-proto", "https")], None)?.expect_status(200)
}

/// What other sites' pages can send changes nothing.
pub fn cross_site() -> Result<()> {
    let (server, _folder) = school(Launch::new())?;
    let teacher = Visitor::teacher(&server, "ana", &[])?;
    let body = json!({ "name": "A" });
    let other = Visitor::teacher(&server, "eva", &[])?;
    for token in ["", "0", &other.csrf] {
        let refused = teacher.send("POST", "/classes", &[("x-csrf-token", token)], Some(&body))?;
        ensure!(refused.expect(403)?["type"] == "/problems/csrf", "{token}");
    }
    for header in
        [("sec-fetch-site", "cross-site"), ("sec-fetch-site", "same-site"), ("origin", "https://evil.example")]
    {
        let refused = teacher.send("POST", "/classes", &[header], Some(&body))?;
        ensure!(refused.expect(403)?["type"] == "/problems/cross-site", "{header:?}");
        // Nor can a page sign its visitor in as someone else.
        let body = json!({ "login": "ana", "password": "does not matter" });
        let visitor = Visitor::new(&server.url);
        visitor.send("POST", "/session", &[header], Some(&body))?.expect_status(403)?;
    }
    // What a form can send is not JSON.
    let (cookie, text) = (teacher.cookie.clone().context("no cookie")?, body.to_string());
    let headers = [("cookie", cookie.as_str()), ("x-csrf-token", &teacher.csrf), ("content-type", "text/plain")];
    let client = Client::new(&server.url);
    client.send("POST", &format!("{ROOT}/classes"), &headers, text.as_bytes())?.expect_status(415)?;
    ensure!(teacher.get("/classes")?.expect(200)? == json!({ "classes": [] }));
    let own = teacher.send("POST", "/classes", &[("sec-fetch-site", "same-origin")], Some(&body))?;
    own.expect_status(201)
}

/// Passwords are asked for again where they change, end other sessions, and cannot be guessed; nothing tells who exists.
pub fn passwords() -> Result<()> {
    let (server, _folder) = school(Launch::new())?;
    let teacher = Visitor::teacher(&server, "ana", &[])?;
    let (_, code) = teacher.class("A")?;
    let student = Visitor::student(&server.url, &code, "Bea")?;
    let mut elsewhere = Visitor::new(&server.url);
    elsewhere.enter("/session", &json!({ "key": student.text("key")? }))?;
    for wrong in ["too short", "            "] {
        student.put("/me/password", &json!({ "password": wrong }))?.expect_status(422)?;
    }
    student.put("/me/password", &json!({ "password": "correct horse" }))?.expect_status(204)?;
    elsewhere.get("/assignments")?.expect_status(401)?;
    student.get("/assignments")?.expect_status(200)?;
    let login = student.text("login")?;
    elsewhere.enter("/session", &json!({ "login": login, "password": "correct horse" }))?;
    ensure!(elsewhere.id()? == student.id()?);
    student.put("/me/password", &json!({ "password": "another horse" }))?.expect_status(401)?;
    let both = json!({ "password": "another horse", "current": "correct horse" });
    student.put("/me/password", &both)?.expect_status(204)?;
    // A known login, one without a password, and one that nobody has: the same words, and about the same time.
    let anyone = Visitor::new(&server.url);
    let attempt = |login: &str| {
        let began = Instant::now();
        let refused = anyone.post("/session", &json!({ "login": login, "password": "correct horse" }))?;
        let mut problem = refused.expect(401)?;
        problem["instance"] = Value::Null;
        Ok::<_, anyhow::Error>((problem, began.elapsed()))
    };
    let mut times = [Duration::MAX; 3];
    for _ in 0..3 {
        let outcomes = [attempt(&login)?, attempt("ana")?, attempt("nobody")?];
        ensure!(outcomes[0].0 == outcomes[1].0 && outcomes[1].0 == outcomes[2].0, "{outcomes:?}");
        for (time, (_, took)) in times.iter_mut().zip(&outcomes) {
            *time = (*time).min(*took);
        }
    }
    let (least, most) = (times.iter().min().context("no time")?, times.iter().max().context("no time")?);
    println!("a wrong password takes {times:?} for a login with one, without one, and of nobody");
    ensure!(*most < 3 * *least, "{times:?} tell who exists");
    // Guessing ends soon, and the right password does not help whoever guessed too often.
    let wrong = json!({ "login": login, "password": "wrong horse" });
    let guessed = (0..40).find(|_| anyone.post("/session", &wrong).is_ok_and(|answer| answer.status == 429));
    ensure!(guessed.is_some(), "nobody stopped the guessing");
    anyone.post("/session", &json!({ "login": login, "password": "another horse" }))?.expect_status(429)?;
    // The personal link still lets its owner in.
    anyone.post("/session", &json!({ "key": student.text("key")? }))?.expect_status(201)?;
    Ok(())
}

/// Codes and links end when the teacher says so, and wrong ones all look alike.
pub fn codes() -> Result<()> {
    let (server, _folder) = school(Launch::new())?;
    let teacher = Visitor::teacher(&server, "ana", &[])?;
    let (class, code) = teacher.class("A")?;
    let anyone = Visitor::new(&server.url);
    let join = |code: &str, name: &str| anyone.post("/students", &json!({ "code": code, "name": name }));
    for name in ["", " ", "=HYPERLINK(1)", "a\u{7}b", &"x".repeat(81)] {
        join(&code, name)?.expect_status(422)?;
    }
    let (one, other) = code.split_at(4);
    join(&format!("{one}-{other}"), "Dora")?.expect_status(201)?;
    join(&format!("{one} {other}"), "Eva")?.expect_status(201)?;
    let student = Visitor::student(&server.url, &format!(" {} ", code.to_lowercase()), "Bea")?;
    ensure!(student.session["class"]["name"] == "A", "{}", student.session);
    let strip = |mut problem: Value| {
        problem["instance"] = Value::Null;
        problem
    };
    let unknown = strip(join("AAAAAAAA", "Bea")?.expect(401)?);
    teacher.patch(&format!("/classes/{class}"), &json!({ "joining": false }))?.expect(200)?;
    ensure!(strip(join(&code, "Carlos")?.expect(401)?) == unknown, "a closed class looks like none");
    teacher.patch(&format!("/classes/{class}"), &json!({ "joining": true }))?.expect(200)?;
    let renewed = teacher.post(&format!("/classes/{class}/code"), &json!({}))?.expect(200)?;
    ensure!(strip(join(&code, "Carlos")?.expect(401)?) == unknown);
    join(renewed["code"].as_str().context("no code")?, "Carlos")?.expect_status(201)?;
    // The teacher makes a new link: the old one, and whoever is in by it, are out.
    let link = teacher.post(&format!("/students/{}/key", student.id()?), &json!({}))?.expect(200)?;
    student.get("/assignments")?.expect_status(401)?;
    anyone.post("/session", &json!({ "key": student.text("key")? }))?.expect_status(401)?;
    anyone.post("/session", &json!({ "key": link["key"] }))?.expect_status(201)?;
    for wrong in [json!({}), json!({ "key": "x", "login": "y" }), json!({ "login": "y" })] {
        anyone.post("/session", &wrong)?.expect_status(422)?;
    }
    // Nobody guesses codes for long.
    let guessed = (0..2000).find(|_| join("AAAAAAAA", "Bea").is_ok_and(|answer| answer.status == 429));
    println!("guessing a code ends after {guessed:?} wrong ones");
    ensure!(guessed.is_some_and(|wrong| wrong >= 200));
    Ok(())
}
