//! A class as its people make it: a teacher by the printed link, students by the code, each in a browser of their own.
//!
//! What the pages show is compared with what the interface says to the same browser: `api` asks with its session.

use super::jobs::{go, text};
use crate::bench::Bench;
use crate::page::{Page, Screen};
use adaptarm_core::exercises::Exercise;
use adaptarm_tests::Server;
use anyhow::{Context, Result, ensure};
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// The exercise of these trials: short runs, three numbers to move.
pub const EXERCISE: &str = "pendulum-gravity";

/// Gains by name.
pub type Gains = BTreeMap<String, f64>;

/// A server with one teacher, one class and one assignment.
pub struct School<'a> {
    pub bench: &'a Bench,
    pub server: Server,
    pub teacher: Page<'a>,
    /// The class's code.
    pub code: String,
    /// Identifier of the class.
    pub class: String,
    /// Identifier of the assignment.
    pub assignment: String,
    /// The exercise's document as teachers see it.
    pub document: Value,
}

impl<'a> School<'a> {
    /// A teacher opens the printed link, makes a class, and gives an exercise out with two attempts.
    pub fn open(bench: &'a Bench) -> Result<Self> {
        let server = Server::start(&[])?;
        let teacher = Page::blank(bench, Screen::Desktop)?;
        become_teacher(&teacher, &server)?;
        teacher.type_into("#new-class-name", "Robotics, group B")?;
        teacher.click("#new-class button")?;
        teacher.wait_for("return document.getElementById('class-code') !== null")?;
        let code = text(&teacher, "return document.getElementById('class-code').textContent")?;
        let class = text(&teacher, "return location.hash.split('/')[1]")?;
        let library = api(&teacher, "exercises")?;
        let exercises = library["exercises"].as_array().context("no exercises")?;
        let document = exercises.iter().find(|one| one["id"] == EXERCISE).context("the exercise is not there")?.clone();
        let assignment = assign(&teacher)?;
        Ok(Self { bench, server, teacher, code, class, assignment, document })
    }

    /// A student joins: opens the link of the class, keeps the personal one, and comes to the assignments.
    pub fn join(&self, name: &str, screen: Screen) -> Result<Page<'a>> {
        Ok(self.join_with_link(name, screen)?.0)
    }

    /// The same, with the personal link that was shown.
    pub fn join_with_link(&self, name: &str, screen: Screen) -> Result<(Page<'a>, String)> {
        let page = Page::blank(self.bench, screen)?;
        page.go(&format!("{}/learn.html#code={}", self.server.url, self.code))?;
        page.wait_for("return document.getElementById('join') !== null")?;
        ensure!(text(&page, "return location.href")?.ends_with("/learn.html"), "the code stays in the address");
        page.type_into("#join-name", name)?;
        page.click("#join button")?;
        let link = keep_link(&page)?;
        page.wait_for("return document.querySelector('.assignment-list [data-assignment]') !== null")?;
        Ok((page, link))
    }

    /// Opens the assignment by its link in the list, and waits for the first preview.
    pub fn open_assignment(&self, page: &Page<'_>) -> Result<()> {
        page.click(&format!("[data-assignment='{}'] a", self.assignment))?;
        previewed(page)
    }

    /// The exercise as the student's browser has it, and the seed of its variants.
    pub fn exercise_of(&self, page: &Page<'_>) -> Result<(Exercise, u64)> {
        let answer = api(page, &format!("assignments/{}", self.assignment))?;
        let exercise = Exercise::read(&answer["exercise"])?;
        Ok((exercise, answer["seed"].as_u64().context("no seed")?))
    }

    /// A solution that its author gave.
    pub fn solution(&self) -> Result<Gains> {
        Ok(serde_json::from_value(self.document["solutions"][0]["gains"].clone())?)
    }
}

/// The link that the server printed makes a teacher.
fn become_teacher(page: &Page<'_>, server: &Server) -> Result<()> {
    let link = server.said(|line| line.split(' ').find(|word| word.contains("#invitation=")).map(str::to_owned))?;
    page.go(&link)?;
    page.wait_for("return document.getElementById('redeem') !== null")?;
    ensure!(text(page, "return location.href")?.ends_with("/teach.html"), "the invitation stays in the address");
    page.type_into("#redeem-name", "Prof. Vega")?;
    page.type_into("#redeem-login", "vega")?;
    page.type_into("#redeem-password", "correct horse battery")?;
    page.click("#redeem button")?;
    keep_link(page)?;
    page.wait_for("return document.getElementById('new-class') !== null")
}

/// The personal link is shown once, before anything else; returns it.
fn keep_link(page: &Page<'_>) -> Result<String> {
    page.wait_for(
        "return document.getElementById('link-kept') !== null || document.querySelector('.message.error') !== null",
    )?;
    let link = text(page, "return document.querySelector('.secret')?.textContent ?? document.body.innerText")?;
    ensure!(link.contains("#key="), "no personal link: {link}");
    page.click("#link-kept")?;
    Ok(link)
}

/// Gives the exercise out with two attempts and a deadline; returns the assignment's identifier.
fn assign(page: &Page<'_>) -> Result<String> {
    page.run(
        "document.getElementById('assign').open = true; const choice = document.getElementById('new-assignment-exercise'); \
         choice.value = arguments[0]; choice.dispatchEvent(new Event('change'))",
        &[json!(EXERCISE)],
    )?;
    page.type_into("#new-assignment-attempts", "2")?;
    page.run("document.getElementById('new-assignment-deadline').value = '2099-06-01T12:00'", &[])?;
    page.click("#new-assignment > button")?;
    page.wait_for("return document.querySelector('.assignments [data-assignment]') !== null")?;
    text(page, "return document.querySelector('.assignments [data-assignment]').dataset.assignment")
}

/// Types gains into their fields, one after another, and waits for the preview of all of them.
pub fn set_gains(page: &Page<'_>, gains: &Gains) -> Result<()> {
    for (name, value) in gains {
        page.type_into(&format!("[data-move={name}] .exact input"), &value.to_string())?;
    }
    previewed(page)
}

/// Waits until the preview is that of the newest gains.
pub fn previewed(page: &Page<'_>) -> Result<()> {
    page.wait_for("return document.documentElement.dataset.preview === 'ready'")
}

/// Hands in what the sliders show, and waits for the grade of this attempt, counted from 1; returns its points.
pub fn hand_in(page: &Page<'_>, number: usize) -> Result<f64> {
    page.click("#submit")?;
    graded(page, number)
}

/// Waits for the grade of an attempt; returns its points.
pub fn graded(page: &Page<'_>, number: usize) -> Result<f64> {
    let attempt = format!("document.querySelector('.attempt[data-number=\"{number}\"]')");
    page.wait_for(&format!("return {attempt}?.dataset.state === 'graded'"))?;
    let points = text(page, &format!("return {attempt}.dataset.points"))?;
    points.parse().with_context(|| format!("attempt {number} has the points {points:?}"))
}

/// What the interface answers to this browser's session.
pub fn api(page: &Page<'_>, path: &str) -> Result<Value> {
    let script = "const [path, done] = arguments; fetch(`/api/v1/classroom/${path}`).then(async (answer) => { \
        const body = await answer.text(); \
        done(answer.headers.get('Content-Type')?.includes('json') ? JSON.parse(body) : body); }, (error) => done(String(error)))";
    page.run_async(script, &[json!(path)])
}

/// A request that changes something, with the session's token: status and answer.
pub fn change(page: &Page<'_>, method: &str, path: &str, body: &Value) -> Result<(u64, Value)> {
    let script = "const [method, path, body, done] = arguments; (async () => { \
        const { csrf } = await (await fetch('/api/v1/classroom/session')).json(); \
        const answer = await fetch(`/api/v1/classroom/${path}`, { method, body: JSON.stringify(body), \
            headers: { 'Content-Type': 'application/json', 'X-CSRF-Token': csrf } }); \
        const text = await answer.text(); done([answer.status, text ? JSON.parse(text) : null]); })() \
        .catch((error) => done([0, String(error)]))";
    let answer = page.run_async(script, &[json!(method), json!(path), body.clone()])?;
    Ok((answer[0].as_u64().context("no status")?, answer[1].clone()))
}

/// Goes to a place of the teachers' page that the address names, and waits until it is shown.
pub fn place(page: &Page<'_>, server: &Server, path: &str) -> Result<()> {
    page.devtools("Page.navigate", &json!({ "url": "about:blank" }))?;
    go(page, &format!("{}/{path}", server.url))
}
