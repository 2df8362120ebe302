//! The classroom's pages themselves: by keyboard, on a phone, in both languages, for axe-core; leaving and coming back.

use super::accessibility::examine;
use super::jobs::text;
use super::language::COMPARE;
use super::school::{School, api, graded, hand_in, place, previewed, set_gains};
use crate::bench::Bench;
use crate::page::{Page, Screen};
use crate::pictures::save;
use anyhow::{Context, Result, ensure};
use fantoccini::key::Key;
use serde_json::{Value, json};

/// Presses the tabulator until the focus is on what a selector finds.
fn tab_to(page: &Page<'_>, selector: &str) -> Result<()> {
    let found = format!("return document.activeElement.matches({})", json!(selector));
    for _ in 0..80 {
        page.press(&char::from(Key::Tab).to_string())?;
        if page.run(&found, &[])? == true {
            return Ok(());
        }
    }
    anyhow::bail!("eighty presses of the tabulator do not lead to {selector}")
}

pub fn the_classroom_goes_by_keyboard(bench: &Bench) -> Result<()> {
    let school = School::open(bench)?;
    let page = Page::blank(bench, Screen::Desktop)?;
    let enter = || page.press(&char::from(Key::Enter).to_string());
    page.go(&format!("{}/learn.html", school.server.url))?;
    page.wait_for("return document.getElementById('join') !== null")?;
    tab_to(&page, "#join-code")?;
    page.press(&school.code.to_lowercase())?;
    tab_to(&page, "#join-name")?;
    page.press("Dora")?;
    enter()?;
    page.wait_for("return document.getElementById('link-kept') !== null")?;
    tab_to(&page, "#link-kept")?;
    enter()?;
    page.wait_for("return document.querySelector('[data-assignment]') !== null")?;
    tab_to(&page, "[data-assignment] a")?;
    enter()?;
    previewed(&page)?;
    tab_to(&page, "[data-move] input[type=range]")?;
    let before = text(&page, "return document.querySelector('[data-move] .exact input').value")?;
    page.press(&char::from(Key::Right).to_string().repeat(5))?;
    previewed(&page)?;
    let after = text(&page, "return document.querySelector('[data-move] .exact input').value")?;
    ensure!(before != after, "the arrow keys do not move the slider from {before}");
    tab_to(&page, "#submit")?;
    enter()?;
    let points = graded(&page, 1)?;
    ensure!((0.0..=100.0).contains(&points), "{points}");
    tab_to(&page, ".take-back")?;
    enter()?;
    let focus = text(&page, "return document.activeElement.closest('[data-move]')?.dataset.move ?? 'elsewhere'")?;
    ensure!(focus != "elsewhere", "after the gains were taken back the focus is nowhere");
    Ok(())
}

/// Every place of the classroom, with who sees it: students' ones are `None`'s first.
fn places(school: &School<'_>) -> [(bool, String); 6] {
    let School { class, assignment, .. } = school;
    [
        (false, "learn.html".to_owned()),
        (false, format!("learn.html#{assignment}")),
        (false, "learn.html#account".to_owned()),
        (true, "teach.html".to_owned()),
        (true, format!("teach.html#class/{class}")),
        (true, format!("teach.html#assignment/{assignment}")),
    ]
}

/// A class with one student who has handed in; the teacher's session, too, in the student's kind of browser.
fn busy<'a>(school: &School<'a>, screen: Screen) -> Result<(Page<'a>, Page<'a>)> {
    let student = school.join("María-José de la Fuente y Echeverría", screen)?;
    school.open_assignment(&student)?;
    hand_in(&student, 1)?;
    let teacher = Page::blank(school.bench, screen)?;
    teacher.go(&format!("{}/teach.html", school.server.url))?;
    teacher.wait_for("return document.getElementById('by-password') !== null")?;
    teacher.run("document.querySelector('details.fold').open = true", &[])?;
    teacher.type_into("#by-password-login", "vega")?;
    teacher.type_into("#by-password-password", "correct horse battery")?;
    teacher.click("#by-password button")?;
    teacher.wait_for("return document.querySelector('[data-class]') !== null")?;
    Ok((student, teacher))
}

fn unfold(page: &Page<'_>) -> Result<()> {
    page.run("for (const details of document.querySelectorAll('main details')) details.open = true", &[])?;
    page.wait_for(
        "return document.querySelector('.replay .help') === null || document.querySelector('[data-hashes]') !== null",
    )
}

/// The places of a busy class, and the first student's work.
fn visit(
    school: &School<'_>,
    (student, teacher): (&Page<'_>, &Page<'_>),
    look: &dyn Fn(&Page<'_>, &str) -> Result<()>,
) -> Result<()> {
    let id =
        api(teacher, &format!("classes/{}", school.class))?["students"][0]["id"].as_str().context("nobody")?.to_owned();
    let work = (true, format!("teach.html#assignment/{}/{id}", school.assignment));
    for (is_teacher, path) in places(school).into_iter().chain([work]) {
        let page = if is_teacher { teacher } else { student };
        place(page, &school.server, &path)?;
        unfold(page)?;
        look(page, &path)?;
    }
    Ok(())
}

pub fn the_classroom_fits_a_phone(bench: &Bench) -> Result<()> {
    let school = School::open(bench)?;
    let (student, teacher) = busy(&school, Screen::Phone)?;
    let fits = |page: &Page<'_>, path: &str| -> Result<()> {
        for language in ["es", "en"] {
            page.run("localStorage.setItem('adaptarm.language', arguments[0]); location.reload()", &[json!(language)])?;
            page.wait_for(&format!("return document.documentElement.lang === '{language}' && document.documentElement.dataset.state === 'ready'"))?;
            unfold(page)?;
            let outside = page.run(OUTSIDE, &[])?;
            ensure!(outside == json!([0]), "{path} in {language} is too wide: {outside}");
            let small = page.run(SMALL, &[])?;
            ensure!(small == json!([]), "{path} in {language} is too small for a finger: {small}");
        }
        let name =
            path.split(['.', '#', '/']).filter(|part| part.len() < 12 && *part != "html").collect::<Vec<_>>().join("-");
        save(page, &format!("classroom-phone-{name}"))
    };
    visit(&school, (&student, &teacher), &fits)
}

/// What is wider than the window; the page's own excess comes first.
const OUTSIDE: &str = "return [document.documentElement.scrollWidth - innerWidth, ...[...document.querySelectorAll('main *')] \
    .filter((node) => { const box = node.getBoundingClientRect(); return box.width > 0 && !node.closest('math, pre, .visually-hidden, thead') \
    && (box.right > innerWidth + 1 || box.left < -1); }).map((node) => node.outerHTML.slice(0, 120))]";

/// What a finger misses; links within a text are as high as their line.
const SMALL: &str = "return [...document.querySelectorAll('main :is(button, select, summary, input:not([type=checkbox]), a:not(.prose a))')] \
    .filter((node) => { const { width, height } = node.getBoundingClientRect(); \
    return width > 0 && (height < 43.9 || width < 43.9); }).map((node) => node.outerHTML.slice(0, 120))";

pub fn axe_finds_nothing_in_the_classroom(bench: &Bench) -> Result<()> {
    let school = School::open(bench)?;
    for screen in [Screen::Desktop, Screen::Phone] {
        let (student, teacher) = busy(&school, screen)?;
        for theme in ["light", "dark"] {
            for page in [&student, &teacher] {
                page.run("localStorage.setItem('adaptarm.theme', arguments[0])", &[json!(theme)])?;
            }
            let look = |page: &Page<'_>, path: &str| examine(page, &format!("{path}, {screen:?}, {theme}"));
            visit(&school, (&student, &teacher), &look)?;
        }
    }
    let page = Page::blank(bench, Screen::Phone)?;
    for path in ["learn.html#code=ABCD", "teach.html", "teach.html#invitation=abcd"] {
        page.devtools("Page.navigate", &json!({ "url": "about:blank" }))?;
        page.go(&format!("{}/{path}", school.server.url))?;
        page.wait_for("return document.documentElement.dataset.state === 'ready'")?;
        unfold(&page)?;
        examine(&page, path)?;
    }
    Ok(())
}

pub fn whoever_leaves_comes_back_or_is_erased(bench: &Bench) -> Result<()> {
    let school = School::open(bench)?;
    let (page, link) = school.join_with_link("Eve", Screen::Desktop)?;
    page.click("#account-link")?;
    page.wait_for("return document.getElementById('sign-out') !== null")?;
    page.click("#sign-out")?;
    page.wait_for("return document.getElementById('join') !== null")?;
    ensure!(api(&page, "session")?["role"] == Value::Null, "still signed in");
    // The way back, and a link that is none.
    let other = if link.ends_with('0') { '1' } else { '0' };
    page.type_into("#by-link-key", &format!("{}{other}", &link[..link.len() - 1]))?;
    page.click("#by-link button")?;
    page.wait_for("return document.querySelector('#by-link .message.error')?.dataset.kind === 'sign-in'")?;
    page.type_into("#by-link-key", &link)?;
    page.click("#by-link button")?;
    page.wait_for("return document.getElementById('account-link')?.textContent.includes('Eve')")?;
    page.click("#account-link")?;
    page.wait_for("return [...document.querySelectorAll('.confirm button')].length > 0")?;
    page.run("[...document.querySelectorAll('.confirm')].at(-1).querySelector('button').click()", &[])?;
    page.run("[...document.querySelectorAll('.confirm')].at(-1).querySelector('.danger').click()", &[])?;
    page.wait_for("return document.getElementById('join') !== null")?;
    let class = api(&school.teacher, &format!("classes/{}", school.class))?;
    ensure!(class["students"] == json!([]), "Eve is not erased: {class}");
    Ok(())
}

/// Ends the session of this browser as another tab, or the server, would: the page does not know.
const END_SESSION: &str = "const done = arguments[0]; (async () => { \
    const { csrf } = await (await fetch('/api/v1/classroom/session')).json(); \
    const answer = await fetch('/api/v1/classroom/session', { method: 'DELETE', headers: { 'X-CSRF-Token': csrf } }); \
    done(answer.status); })().catch((error) => done(String(error)))";

pub fn an_ended_session_loses_nothing(bench: &Bench) -> Result<()> {
    let school = School::open(bench)?;
    let (page, link) = school.join_with_link("Ana", Screen::Desktop)?;
    school.open_assignment(&page)?;
    set_gains(&page, &school.solution()?)?;
    ensure!(page.run_async(END_SESSION, &[])? == 204, "the session does not end");
    page.click("#submit")?;
    page.wait_for("return document.querySelector('.come-back[open]') !== null")?;
    page.type_into(".come-back #by-link-key", &link)?;
    page.click(".come-back #by-link button")?;
    // What was handed in goes on its way, once, with the gains that were set.
    ensure!(graded(&page, 1)? == 100.0, "other gains were handed in");
    ensure!(page.run("return document.querySelector('.come-back')", &[])? == Value::Null, "it still asks");
    let attempts = api(&page, &format!("assignments/{}/attempts", school.assignment))?;
    ensure!(attempts["attempts"].as_array().is_some_and(|all| all.len() == 1), "{attempts}");

    let teacher = &school.teacher;
    teacher.run("document.getElementById('assign').open = true", &[])?;
    teacher.type_into("#new-assignment-title", "Hours of work")?;
    ensure!(teacher.run_async(END_SESSION, &[])? == 204, "the teacher's session does not end");
    teacher.click("#new-assignment > button")?;
    teacher.wait_for("return document.querySelector('.come-back[open]') !== null")?;
    teacher.type_into(".come-back #by-password-login", "vega")?;
    teacher.type_into(".come-back #by-password-password", "correct horse battery")?;
    teacher.click(".come-back #by-password button")?;
    teacher.wait_for("return document.querySelector('.come-back') === null")?;
    let typed = text(teacher, "return document.getElementById('new-assignment-title')?.value ?? 'gone'")?;
    ensure!(typed == "Hours of work", "what the teacher typed is {typed:?}");
    Ok(())
}

pub fn a_refused_number_is_not_handed_in(bench: &Bench) -> Result<()> {
    let school = School::open(bench)?;
    let page = school.join("Ana", Screen::Desktop)?;
    school.open_assignment(&page)?;
    page.type_into("[data-move] .exact input", "1e9")?;
    page.click("#submit")?;
    page.wait_for("return document.querySelector('.submit-panel .message.error') !== null")?;
    let focus = text(&page, "return document.activeElement.closest('.invalid')?.dataset.move ?? 'elsewhere'")?;
    ensure!(focus != "elsewhere", "the number to mend has not the focus");
    let attempts = api(&page, &format!("assignments/{}/attempts", school.assignment))?;
    ensure!(attempts["attempts"] == json!([]), "the number before it was handed in: {attempts}");
    set_gains(&page, &school.solution()?)?;
    ensure!(hand_in(&page, 1)? == 100.0, "what was mended is not what was handed in");
    Ok(())
}

pub fn a_join_link_asks_whoever_is_signed_in(bench: &Bench) -> Result<()> {
    let school = School::open(bench)?;
    let link = format!("{}/learn.html#code={}", school.server.url, school.code);
    let student = school.join("Ana", Screen::Desktop)?;
    for (page, role) in [(&school.teacher, "teacher"), (&student, "student")] {
        page.devtools("Page.navigate", &json!({ "url": "about:blank" }))?;
        page.go(&link)?;
        page.wait_for("return document.getElementById('join-anyway') !== null")?;
        ensure!(page.run("return document.getElementById('join')", &[])? == Value::Null, "a {role} is offered to join");
        ensure!(api(page, "session")?["role"] == role, "the {role}'s session is gone");
    }
    student.click("#go-on")?;
    student.wait_for("return document.querySelector('.assignment-list [data-assignment]') !== null")?;
    Ok(())
}

pub fn both_languages_have_the_same_texts(bench: &Bench) -> Result<()> {
    let page = Page::blank(bench, Screen::Desktop)?;
    page.go(&format!("{}/learn.html", bench.server.url))?;
    let found = page.run_async(COMPARE, &[json!("classroom/"), json!([])])?;
    ensure!(found["differences"] == json!([]), "the languages differ: {}", found["differences"]);
    ensure!(found["texts"].as_u64().is_some_and(|texts| texts > 150), "hardly a text was compared: {found}");
    Ok(())
}
