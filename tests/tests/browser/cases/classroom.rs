//! A whole class: a teacher sets up, three students join and solve, well, badly and with nonsense; the teacher looks, extends,
//! overrides and exports. The numbers agree everywhere, and the preview is what the core says.

use super::jobs::text;
use super::school::{Gains, School, api, change, graded, hand_in, place, previewed, set_gains};
use crate::bench::Bench;
use crate::page::{Page, Screen};
use crate::pictures::save;
use adaptarm_core::exercises::Visibility;
use adaptarm_core::scenario::Scenario;
use anyhow::{Context, Result, ensure};
use serde_json::{Value, json};

pub fn a_whole_class_is_graded_and_the_numbers_agree(bench: &Bench) -> Result<()> {
    let school = School::open(bench)?;
    let [ana, bruno, chiara] = [
        school.join("Ana Díaz", Screen::Desktop)?,
        school.join("Bruno Keller", Screen::Phone)?,
        school.join("Chiara Rossi", Screen::Desktop)?,
    ];
    let good = solve(&school, &ana, &school.solution()?)?;
    let bad = solve(&school, &bruno, &school.exercise_of(&bruno)?.0.start())?;
    let nonsense = nonsense(&school, &chiara)?;
    ensure!(good == 100.0, "the solution of the exercise's author has {good} of 100");
    ensure!(bad < 50.0 && nonsense < 50.0, "who does nothing has {bad}, who hands in nonsense {nonsense} of 100");
    let mut marks = vec![("Ana Díaz", good), ("Bruno Keller", bad), ("Chiara Rossi", nonsense)];
    agree(&school, &[&ana, &bruno, &chiara], &marks)?;

    replay(&school, &ana)?;
    marks[1].1 = 42.5;
    override_mark(&school, "Bruno Keller", "42.5")?;
    extend(&school, "Chiara Rossi")?;
    marks[2].1 = second_chance(&school, &chiara)?;
    agree(&school, &[&ana, &bruno, &chiara], &marks)?;
    let shown = text(&bruno, "return document.querySelector('.exercise-head').textContent")?;
    ensure!(
        shown.contains("set by your teacher") && shown.contains("explained it"),
        "the override is not told: {shown}"
    );
    audit(&school)
}

/// Hands gains in after comparing their preview with the core's own grade; returns the points.
fn solve(school: &School<'_>, page: &Page<'_>, gains: &Gains) -> Result<f64> {
    school.open_assignment(page)?;
    set_gains(page, gains)?;
    let (exercise, seed) = school.exercise_of(page)?;
    let runs = exercise.runs(gains, seed, Visibility::Visible)?;
    let reports: Vec<_> = runs.iter().map(|run| run.run().report).collect();
    let grade = exercise.grade(gains, seed, Visibility::Visible, &reports)?;
    let shown = page.run(
        "const { points, score } = document.querySelector('.preview-total').dataset; return [Number(points), Number(score)]",
        &[],
    )?;
    let told = [&shown[0], &shown[1]].map(Value::as_f64);
    ensure!(told == [Some(grade.points), Some(grade.score)], "the preview is {shown}, the core says {}", grade.points);
    let points = hand_in(page, 1)?;
    let listed = text(page, "return document.querySelector('.attempt-list .gains-line').textContent")?;
    let stiffness = format!("Stiffness Kp:\u{a0}{}\u{a0}N·m/rad", gains["k_p"]);
    ensure!(listed.contains(&stiffness), "the list of attempts says {listed:?}, not {stiffness:?}");
    Ok(points)
}

/// What is no number, or out of its range, is refused by page and server alike, and costs no attempt; the worst gains do count.
fn nonsense(school: &School<'_>, page: &Page<'_>) -> Result<f64> {
    school.open_assignment(page)?;
    let first = "document.querySelector('[data-move]')";
    // The last is the backspace key, which empties the field.
    for (typed, said) in [("abc", "abc"), ("1e9", "1000000000"), ("\u{e003}", "")] {
        page.type_into("[data-move] .exact input", typed)?;
        let wrong = text(page, &format!("return {first}.querySelector('.field-error').textContent"))?;
        ensure!(!wrong.is_empty() && wrong.contains(said), "{typed:?} is answered by {wrong:?}");
    }
    let path = format!("assignments/{}/attempts", school.assignment);
    for body in
        [json!({}), json!({ "gains": { "k_p": "x" } }), json!({ "gains": { "nothing": 1 } }), json!({ "points": 100 })]
    {
        let (status, answer) = change(page, "POST", &path, &body)?;
        ensure!(status == 422, "{body} is answered by {status} {answer}");
    }
    ensure!(api(page, &path)?["attempts"] == json!([]), "nonsense is an attempt");
    let (exercise, _) = school.exercise_of(page)?;
    let least = exercise.document().moves.iter().map(|own| (own.name.clone(), own.min)).collect();
    set_gains(page, &least)?;
    hand_in(page, 1)
}

/// Page, interface and gradebook tell everyone's marks alike.
fn agree(school: &School<'_>, students: &[&Page<'_>], marks: &[(&str, f64)]) -> Result<()> {
    let School { teacher, server, assignment, class, .. } = school;
    place(teacher, server, &format!("teach.html#assignment/{assignment}"))?;
    let board = api(teacher, &format!("assignments/{assignment}/board"))?;
    let csv = api(teacher, &format!("classes/{class}/gradebook.csv?shape=plain"))?;
    let csv = csv.as_str().context("no gradebook")?;
    for (page, (name, points)) in students.iter().zip(marks) {
        place(page, server, &format!("learn.html#{assignment}"))?;
        let own = number(page, "return document.getElementById('mark').dataset.points")?;
        let list = api(page, "assignments")?["assignments"][0]["mark"]["points"].as_f64();
        let entry = board["students"].as_array().and_then(|all| all.iter().find(|one| one["name"] == *name));
        let entry = entry.with_context(|| format!("{name} is not on the board"))?;
        let row = format!(
            "return document.querySelector('.roster [data-student=\"{}\"]').dataset.points",
            entry["id"].as_str().unwrap_or_default()
        );
        let seen = number(teacher, &row)?;
        let line = csv.lines().find(|line| line.contains(name)).context("not in the gradebook")?;
        let booked = line.split(',').any(|cell| cell.trim_matches('"').parse() == Ok(*points));
        let told = [Some(own), list, entry["mark"]["points"].as_f64(), Some(seen)];
        ensure!(told == [Some(*points); 4] && booked, "{name} has {points}: {told:?}, {line:?}");
    }
    let mean = marks.iter().map(|(_, points)| points).sum::<f64>() / marks.len() as f64;
    let shown = number(teacher, "return document.getElementById('board-mean').dataset.points")?;
    ensure!((shown - mean).abs() < 0.01, "the mean is shown as {shown} instead of {mean}");
    let bins: u64 = board["distribution"].as_array().context("no bins")?.iter().filter_map(Value::as_u64).sum();
    ensure!(bins == 3 && board["graded"] == 3, "{board}");
    save(teacher, "classroom-board")
}

fn number(page: &Page<'_>, script: &str) -> Result<f64> {
    let shown = text(page, script)?;
    shown.parse().with_context(|| format!("{shown:?} is no number"))
}

/// Opens a student's work.
fn work(school: &School<'_>, name: &str) -> Result<()> {
    let School { teacher, server, assignment, .. } = school;
    place(teacher, server, &format!("teach.html#assignment/{assignment}"))?;
    teacher.run(
        "[...document.querySelectorAll('.roster a')].find((link) => link.textContent === arguments[0]).click()",
        &[json!(name)],
    )?;
    teacher.wait_for("return document.getElementById('override') !== null")
}

/// The teacher's replay has the bits that were graded, and so has the core here.
fn replay(school: &School<'_>, ana: &Page<'_>) -> Result<()> {
    work(school, "Ana Díaz")?;
    let page = &school.teacher;
    let student = text(page, "return location.hash.split('/')[2]")?;
    let answer = api(page, &format!("assignments/{}/students/{student}", school.assignment))?;
    let attempt = &answer["attempts"][0];
    let hidden: Vec<_> =
        attempt["runs"].as_array().context("no runs")?.iter().filter(|run| run["hidden"] == true).collect();
    let graded: Vec<_> = attempt["grade"]["variants"].as_array().context("no variants")?.iter().collect();
    ensure!(!hidden.is_empty() && hidden.len() == graded.len(), "{} runs, {} grades", hidden.len(), graded.len());
    let mut hashes = Vec::new();
    for (run, variant) in hidden.iter().zip(&graded) {
        let hash = Scenario::read(&run["scenario"])?.run().report.trajectory_hash;
        ensure!(variant["trajectory_hash"] == json!(hash), "the graded run has other bits");
        hashes.push(hash);
    }
    page.run("document.querySelector('[data-replay]').open = true", &[])?;
    page.wait_for("return document.querySelector('[data-hashes]') !== null")?;
    let shown = text(page, "return document.querySelector('[data-hashes]').dataset.hashes")?;
    ensure!(hashes.iter().take(4).eq(shown.split(' ').take(hashes.len().min(4))), "the replay has other bits: {shown}");
    save(page, "classroom-work")?;
    // Nothing of this is for the student.
    let refused = api(ana, &format!("assignments/{}/students/{student}", school.assignment))?;
    ensure!(refused["type"] == "/problems/role", "a student asks for the hidden variants: {refused}");
    Ok(())
}

fn override_mark(school: &School<'_>, name: &str, points: &str) -> Result<()> {
    work(school, name)?;
    let page = &school.teacher;
    page.type_into("#override-points", points)?;
    page.click("#override > button")?;
    page.wait_for("return document.querySelector('#override-comment').getAttribute('aria-invalid') === 'true'")?;
    page.type_into("#override-comment", "explained it at the board")?;
    page.click("#override > button")?;
    page.wait_for("return document.getElementById('override-back') !== null")
}

fn extend(school: &School<'_>, name: &str) -> Result<()> {
    work(school, name)?;
    let page = &school.teacher;
    page.type_into("#extension-attempts", "1")?;
    page.type_into("#extension-comment", "ill")?;
    page.click("#extension > button")?;
    page.wait_for("return document.body.innerText.includes('1 more attempt')")
}

/// With the extension there are two attempts left; the connection fails while one is handed in, and it is handed in once.
fn second_chance(school: &School<'_>, page: &Page<'_>) -> Result<f64> {
    let again = || place(page, &school.server, &format!("learn.html#{}", school.assignment));
    again()?;
    let head = text(page, "return document.querySelector('.exercise-head').textContent")?;
    ensure!(head.contains("extended for you") && head.contains("2 of 3 left"), "{head}");
    let solution = school.solution()?;
    set_gains(page, &solution)?;
    let offline = |off: bool| {
        let conditions = json!({ "offline": off, "latency": 0, "downloadThroughput": -1, "uploadThroughput": -1 });
        page.devtools("Network.emulateNetworkConditions", &conditions)
    };
    page.devtools("Network.enable", &json!({}))?;
    offline(true)?;
    page.click("#submit")?;
    page.wait_for("return document.querySelector('.submit-panel').dataset.phase === 'unsent'")?;
    let said = text(page, "return document.querySelector('.submit-panel').textContent")?;
    ensure!(said.contains("Your gains are kept"), "{said}");
    offline(false)?;
    again()?;
    let points = graded(page, 2)?;
    previewed(page)?;
    for (name, value) in &solution {
        let kept = text(page, &format!("return document.querySelector('[data-move={name}] .exact input').value"))?;
        ensure!(kept.parse() == Ok(*value), "{name} is {kept} after the reload, not {value}");
    }
    let attempts = api(page, &format!("assignments/{}/attempts", school.assignment))?;
    ensure!(attempts["attempts"].as_array().map(Vec::len) == Some(2), "sent twice: {attempts}");
    Ok(points)
}

fn audit(school: &School<'_>) -> Result<()> {
    let School { teacher, server, class, .. } = school;
    place(teacher, server, &format!("teach.html#class/{class}"))?;
    teacher.click("#show-audit")?;
    teacher.wait_for("return document.querySelectorAll('.audit tbody tr').length >= 4")?;
    let entries = api(teacher, &format!("classes/{class}/audit"))?;
    let shown = teacher.run("return document.querySelectorAll('.audit tbody tr').length", &[])?;
    ensure!(
        entries["entries"].as_array().map(Vec::len) == shown.as_u64().map(|count| count as usize),
        "{shown}: {entries}"
    );
    Ok(())
}
