//! What a teacher should mend in an exercise that can be read: texts that a page cannot show, parts that a class needs, draws that
//! make no arm.

use super::markdown::to_html;
use adaptarm_core::exercises::{Exercise, ExerciseDocument, Text, Visibility};

/// Seeds whose draws are tried.
const SEEDS: u64 = 200;

/// All findings, each on a line of its own; none if the exercise is fit for a class.
pub fn lint(exercise: &Exercise) -> Vec<String> {
    let document = exercise.document();
    let mut findings = missing(document);
    for (name, text) in texts(document) {
        for (language, text) in [("en", &text.en), ("es", &text.es)] {
            if let Err(error) = to_html(text) {
                findings.push(format!("{name}.{language}: {error}"));
            }
        }
    }
    for visibility in [Visibility::Visible, Visibility::Hidden] {
        if visibility == Visibility::Hidden && document.hidden.is_none() {
            continue;
        }
        let refused = |seed| exercise.runs(&exercise.start(), seed, visibility).err().map(|error| (seed, error));
        if let Some((seed, error)) = (0..SEEDS).find_map(refused) {
            findings.push(format!("seed {seed} draws a variant that is not allowed: {error}"));
        }
    }
    findings
}

fn missing(document: &ExerciseDocument) -> Vec<String> {
    let needed = [
        ("hidden", document.hidden.is_some(), "grades are made on hidden variants"),
        ("hints", !document.hints.is_empty(), "students who are stuck need help"),
        ("explanation", document.explanation.is_some(), "it is shown after the deadline"),
        ("teacher_note", document.teacher_note.is_some(), "it tells a teacher what to expect"),
        ("solutions", !document.solutions.is_empty(), "calibration needs one"),
    ];
    let missing = needed.into_iter().filter(|(_, given, _)| !given);
    missing.map(|(name, _, why)| format!("{name}: missing; {why}")).collect()
}

fn texts(document: &ExerciseDocument) -> Vec<(String, &Text)> {
    let mut texts = vec![("goal".to_owned(), &document.goal), ("statement".to_owned(), &document.statement)];
    texts.extend(document.explanation.as_ref().map(|text| ("explanation".to_owned(), text)));
    texts.extend(document.teacher_note.as_ref().map(|text| ("teacher_note".to_owned(), text)));
    texts.extend(document.hints.iter().enumerate().map(|(n, hint)| (format!("hints[{n}]"), &hint.text)));
    texts.extend(document.moves.iter().map(|own| (format!("moves.{}", own.name), &own.label)));
    texts.extend(document.criteria.iter().map(|own| (format!("criteria.{}", own.id), &own.label)));
    texts
}
