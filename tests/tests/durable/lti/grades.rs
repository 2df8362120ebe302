//! Grades on their way while the platform does not answer and the server is killed: each arrives, once, with its value.

use super::lessons::scores;
use super::{Setting, standing};
use adaptarm_tests::classroom::{soft, stiff};
use adaptarm_tests::platform::User;
use anyhow::{Result, ensure};
use serde_json::json;
use std::collections::BTreeMap;
use std::time::Duration;

/// Longer than a score that is sent twice would take to arrive.
const QUIET: Duration = Duration::from_secs(3);

/// The platform is gone, the server dies twice, and nothing is lost or doubled.
pub fn crashes() -> Result<()> {
    let mut setting = Setting::new()?;
    let tina = User::new("tina", "Instructor");
    let assignment = setting.assignment(&tina, "link-1")?;
    setting.platform.set_down(true);
    let mut expected = BTreeMap::new();
    for (n, gains) in [stiff(), soft(), json!({ "k_p": 0.0, "k_d": 0.0 })].into_iter().enumerate() {
        let name = format!("student-{n}");
        let student = setting.enter(&User::new(&name, "Learner"), "link-1", None)?;
        let attempt = student.graded(&student.hand_in(&assignment, &gains)?)?;
        ensure!(attempt["state"] == "graded", "{attempt}");
        expected.insert(name, attempt["points"].clone());
    }
    setting.server.restart()?;
    waits(&setting, &tina, &assignment)?;
    setting.server.restart()?;
    ensure!(setting.platform.scores().is_empty(), "{:?}", setting.platform.scores());
    setting.platform.set_down(false);
    scores(&setting.platform, expected.len())?;
    std::thread::sleep(QUIET);
    setting.server.restart()?;
    std::thread::sleep(QUIET);
    let arrived = setting.platform.scores();
    let given: BTreeMap<_, _> = arrived
        .iter()
        .map(|posted| {
            (posted.score["userId"].as_str().unwrap_or_default().to_owned(), posted.score["scoreGiven"].clone())
        })
        .collect();
    ensure!(given == expected, "{given:?} instead of {expected:?}");
    ensure!(arrived.len() == expected.len(), "some arrived twice: {arrived:?}");
    ensure!(setting.platform.columns().len() == 1, "{:?}", setting.platform.columns());
    unheard(&mut setting, &tina, &assignment)
}

/// The server dies between the platform's taking a score and its own note of it: the same score goes out again, by its time known
/// to be the same, and counts as delivered.
fn unheard(setting: &mut Setting, tina: &User, assignment: &str) -> Result<()> {
    let before = setting.platform.scores().len();
    setting.platform.set_mute(true);
    let student = setting.enter(&User::new("late", "Learner"), "link-1", None)?;
    let attempt = student.graded(&student.hand_in(assignment, &stiff())?)?;
    scores(&setting.platform, before + 1)?;
    setting.server.restart()?;
    setting.platform.set_mute(false);
    let arrived = scores(&setting.platform, before + 2)?;
    let [first, second] = &arrived[before..] else { anyhow::bail!("{arrived:?}") };
    ensure!(first == second && first.score["scoreGiven"] == attempt["points"], "{first:?}, {second:?}");
    let teacher = setting.enter(tina, "link-1", None)?;
    standing(&teacher, assignment, |standing| standing["waiting"] == 0 && standing["sent"] == 4)?;
    std::thread::sleep(QUIET);
    ensure!(setting.platform.scores().len() == before + 2, "{:?}", setting.platform.scores());
    Ok(())
}

/// The teacher sees that grades wait, and why.
fn waits(setting: &Setting, tina: &User, assignment: &str) -> Result<()> {
    let teacher = setting.enter(tina, "link-1", None)?;
    let standing =
        standing(&teacher, assignment, |standing| standing["waiting"] == 3 && standing["error"].is_string())?;
    ensure!(standing["sent"] == 0 && standing["error"].as_str().is_some_and(|why| why.contains("503")), "{standing}");
    Ok(())
}
