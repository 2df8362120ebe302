//! A course from the platform's side: its teacher chooses an exercise, its students come and solve it, their grades go back.

use super::{PATIENCE, Setting, reason, standing};
use adaptarm_tests::classroom::stiff;
use adaptarm_tests::client::{Answer, surely};
use adaptarm_tests::platform::{Platform, Posted, Signed, User, hidden};
use adaptarm_tests::postgres::Cluster;
use anyhow::{Context, Result, ensure};
use serde_json::{Value, json};

/// So many scores, once they have arrived.
pub fn scores(platform: &Platform, count: usize) -> Result<Vec<Posted>> {
    let found = surely(PATIENCE, || Ok(Some(platform.scores()).filter(|scores| scores.len() >= count)));
    found.with_context(|| format!("waiting for {count} scores; there are {:?}", platform.scores()))
}

pub fn on_sqlite() -> Result<()> {
    whole(&Setting::new()?)
}

pub fn on_postgres() -> Result<()> {
    let cluster = Cluster::start()?;
    let database = cluster.database("course")?;
    whole(&Setting::with(&["--database", &database])?)
}

/// Choosing, following links, grades, members.
fn whole(setting: &Setting) -> Result<()> {
    let assignment = chooses(setting)?;
    grades(setting, &assignment)?;
    members(setting)?;
    shared_account(setting)?;
    in_a_frame(setting, &assignment)?;
    separate(setting, &assignment)
}

/// A teacher chooses an exercise from within the platform; the assignment.
fn chooses(setting: &Setting) -> Result<String> {
    let (platform, mut browser) = (&setting.platform, setting.browser());
    let tina = User::new("tina", "Instructor");
    let page = browser.launch(platform, |nonce| platform.choosing(&tina, nonce))?;
    ensure!(page.status == 200 && String::from_utf8_lossy(&page.body).contains("Hold it"), "{page}");
    let policy = page.header("content-security-policy");
    ensure!(
        policy.contains("form-action 'self'") && policy.contains(&format!("frame-ancestors {}", platform.url())),
        "{policy}"
    );
    let ticket = hidden(&page, "ticket")?;
    let own = [("sec-fetch-site", "same-origin")];
    let foreign = browser.post_form(
        "/lti/choose",
        &[("ticket", &ticket), ("exercise", "hold")],
        &[("sec-fetch-site", "cross-site")],
    )?;
    ensure!(foreign.status == 403, "another site's page chooses: {foreign}");
    let carried = browser.post_form("/lti/choose", &[("ticket", &ticket), ("exercise", "hold")], &own)?;
    ensure!(carried.status == 200, "{carried}");
    let action = format!("action=\"{}/chosen\"", platform.url());
    ensure!(String::from_utf8_lossy(&carried.body).contains(&action), "{carried}");
    let again = browser.post_form("/lti/choose", &[("ticket", &ticket), ("exercise", "hold")], &own)?;
    ensure!(reason(&again)? == "ticket", "a ticket is good twice");
    let answer = platform.read_tool_s_token(&hidden(&carried, "JWT")?)?;
    ensure!(answer["iss"] == "adaptarm-client" && answer["aud"] == platform.url(), "{answer}");
    ensure!(answer["https://purl.imsglobal.org/spec/lti/claim/message_type"] == "LtiDeepLinkingResponse", "{answer}");
    ensure!(answer["https://purl.imsglobal.org/spec/lti/claim/deployment_id"] == "deployment-1", "{answer}");
    ensure!(answer["https://purl.imsglobal.org/spec/lti-dl/claim/data"] == "opaque <data>", "{answer}");
    let items = &answer["https://purl.imsglobal.org/spec/lti-dl/claim/content_items"];
    let item = &items[0];
    ensure!(item["type"] == "ltiResourceLink" && item["title"] == "Hold it", "{items}");
    ensure!(item["lineItem"]["scoreMaximum"] == 100.0 && items[1].is_null(), "{items}");
    Ok(item["custom"]["assignment"].as_str().context("no assignment")?.to_owned())
}

/// A student solves it; the grade goes back, and so does the teacher's own decision, and what takes it back.
fn grades(setting: &Setting, assignment: &str) -> Result<()> {
    let platform = &setting.platform;
    let (sam, tina) = (User::new("sam", "Learner"), User::new("tina", "Instructor"));
    let (_, led) = setting.follow(&sam, "link-1", Some(assignment))?;
    ensure!(led.header("location") == format!("/learn.html#{assignment}"), "{led}");
    let student = setting.enter(&sam, "link-1", None)?;
    ensure!(student.session["role"] == "student" && student.session["name"] == "sam", "{}", student.session);
    let attempt = student.graded(&student.hand_in(assignment, &stiff())?)?;
    let arrived = scores(platform, 1)?;
    let score = &arrived[0].score;
    ensure!(score["userId"] == "sam" && score["scoreMaximum"] == 100.0, "{score}");
    ensure!(score["scoreGiven"] == attempt["points"] && score["scoreGiven"] != 0.0, "{score} for {attempt}");
    let teacher = setting.enter(&tina, "link-1", None)?;
    ensure!(teacher.session["role"] == "teacher", "{}", teacher.session);
    let board = teacher.get(&format!("/assignments/{assignment}/board"))?.expect(200)?;
    ensure!(board["students"][0]["mark"]["points"] == attempt["points"], "{board}");
    let path = format!("/assignments/{assignment}/students/{}/override", student.id()?);
    teacher.put(&path, &json!({ "points": 42.5, "comment": "oral exam" }))?.expect(200)?;
    ensure!(scores(platform, 2)?[1].score["scoreGiven"] == 42.5, "{:?}", platform.scores());
    teacher.put(&path, &json!({ "points": null, "comment": "a mistake" }))?.expect(200)?;
    ensure!(scores(platform, 3)?[2].score["scoreGiven"] == attempt["points"], "{:?}", platform.scores());
    let columns = platform.columns();
    ensure!(
        columns.len() == 1 && columns[0]["resourceId"] == assignment && columns[0]["label"] == "Hold it",
        "{columns:?}"
    );
    let wanted = json!({ "links": 1, "columns": 1, "sent": 1, "waiting": 0, "error": null });
    standing(&teacher, assignment, |standing| *standing == wanted).map(|_| ())
}

/// The platform's list makes students of those who attend.
fn members(setting: &Setting) -> Result<()> {
    let role = |name: &str| json!([format!("http://purl.imsglobal.org/vocab/lis/v2/membership#{name}")]);
    let member = |subject: &str, name: &str, role: Value, status: &str| json!({ "user_id": subject, "name": name, "roles": role, "status": status, "lis_person_sourcedid": format!("N-{subject}") });
    setting.platform.set_members(vec![
        member("sam", "Sam Soto", role("Learner"), "Active"),
        member("tina", "Tina Teach", role("Instructor"), "Active"),
        member("una", "Una Uribe", json!(["Learner"]), "Active"),
        member("ivo", "Ivo Gone", role("Learner"), "Inactive"),
        member("vic", "=cmd()", role("Learner"), "Active"),
    ]);
    let teacher = setting.enter(&User::new("tina", "Instructor"), "link-1", None)?;
    let classes = teacher.get("/classes")?.expect(200)?;
    let class = classes["classes"][0]["id"].as_str().context("no class")?.to_owned();
    let path = format!("/classes/{class}/lti/members");
    let enrolled = teacher.post(&path, &json!({}))?.expect(200)?;
    ensure!(enrolled == json!({ "listed": 3, "added": 2, "left_out": 0 }), "{enrolled}");
    let again = teacher.post(&path, &json!({}))?.expect(200)?;
    ensure!(again == json!({ "listed": 3, "added": 0, "left_out": 0 }), "{again}");
    let shown = teacher.get(&format!("/classes/{class}"))?.expect(200)?;
    let names: Vec<_> =
        shown["students"].as_array().into_iter().flatten().map(|one| (&one["name"], &one["number"])).collect();
    // A name that a spreadsheet would run is none.
    let wanted = [("Sam Soto", "N-sam"), ("Una Uribe", "N-una"), ("Student", "N-vic")]
        .map(|(name, number)| (json!(name), json!(number)));
    ensure!(names == wanted.iter().map(|(name, number)| (name, number)).collect::<Vec<_>>(), "{shown}");
    // Who was listed is the one who comes.
    let una = setting.enter(&User::new("una", "Learner"), "link-1", None)?;
    ensure!(una.session["name"] == "Una Uribe", "{}", una.session);
    let refused = una.post(&path, &json!({}))?;
    ensure!(refused.status == 403, "a student fetches the list: {refused}");
    ensure!(setting.teacher.post(&path, &json!({}))?.status == 404, "another teacher fetches the list");
    Ok(())
}

/// A course's account is all its teachers': none of them can keep a key to it, or make accounts that outlive their role.
fn shared_account(setting: &Setting) -> Result<()> {
    let teacher = setting.enter(&User::new("tina", "Instructor"), "link-1", None)?;
    ensure!(teacher.session["course_account"] == true, "{}", teacher.session);
    let refused = |answer: Answer| -> Result<()> {
        let problem = answer.expect(403)?;
        ensure!(problem["type"] == "/problems/course-account", "{problem}");
        Ok(())
    };
    refused(teacher.put("/me/password", &json!({ "password": "correct horse battery" }))?)?;
    refused(teacher.post("/me/key", &json!({}))?)?;
    refused(teacher.post("/invitations", &json!({}))?)?;
    refused(teacher.post("/lti/platforms", &setting.platform.registration())?)?;
    let class = teacher.get("/classes")?.expect(200)?["classes"][0]["id"].clone();
    let course = teacher.get(&format!("/classes/{}/lti", class.as_str().context("no class")?))?.expect(200)?;
    ensure!(course == json!({ "platform": setting.platform.url(), "members": true }), "{course}");
    Ok(())
}

/// Within the platform's page there is only a button; what it opens is a window of its own.
fn in_a_frame(setting: &Setting, assignment: &str) -> Result<()> {
    let (platform, mut browser) = (&setting.platform, setting.browser());
    let begun = browser.login(platform)?;
    let claims = platform.claims(&User::new("sam", "Learner"), "link-1", &begun.nonce);
    let token = Signed::By(platform.key()).token(&claims)?;
    let page = browser.bring(&begun.state, &token, &[("sec-fetch-dest", "iframe"), ("accept-language", "es-MX")])?;
    ensure!(page.status == 200 && String::from_utf8_lossy(&page.body).contains("Abrir"), "{page}");
    ensure!(!browser.cookies.contains_key("adaptarm"), "a session within a frame");
    let ticket = hidden(&page, "ticket")?;
    let mut enter = |site| browser.post_form("/lti/enter", &[("ticket", &ticket)], &[("sec-fetch-site", site)]);
    ensure!(enter("cross-site")?.status == 403, "another site's page enters");
    let entered = enter("same-origin")?;
    ensure!(entered.status == 303 && entered.header("location") == format!("/learn.html#{assignment}"), "{entered}");
    ensure!(entered.header("set-cookie").contains("SameSite=Strict"), "{}", entered.header("set-cookie"));
    ensure!(reason(&enter("same-origin")?)? == "ticket", "a ticket is good twice");
    Ok(())
}

/// Another course is another class: neither its teacher nor its students see this one.
fn separate(setting: &Setting, assignment: &str) -> Result<()> {
    let other = setting.enter(&User::new("theo", "Instructor").of("chemistry"), "link-9", None)?;
    ensure!(
        other.get(&format!("/assignments/{assignment}/board"))?.status == 404,
        "another course's teacher sees the board"
    );
    let (_, refused) = setting.follow(&User::new("sam", "Learner").of("chemistry"), "link-9", Some(assignment))?;
    ensure!(reason(&refused)? == "link", "a link to another course's assignment");
    let sam = User::new("sam", "Learner");
    let chooser = setting.browser().launch(&setting.platform, |nonce| setting.platform.choosing(&sam, nonce))?;
    ensure!(reason(&chooser)? == "role", "a student chooses");
    Ok(())
}
