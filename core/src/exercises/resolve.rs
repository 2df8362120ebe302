//! What an exercise may say. Checks a document once; every error names the field, the value and what would be allowed.

use super::document::{
    CriterionDocument, EXERCISE_FORMAT, ExerciseDocument, MoveDocument, ShareAggregate, Text, VariantsDocument,
};
use super::exercise::{Criterion, Exercise, Move, Variants, Visibility};
use super::grade::hundredths;
use super::limits::EXERCISE_LIMITS;
use super::measures::{Measure, metric_names};
use crate::experiments::{
    Change, Tree, changes, check_count, check_fields, check_range, conflict, random_fields, unknown,
};
use crate::robots::RobotData;
use crate::scenario::{Problem, Scenario, ScenarioError};
use std::collections::BTreeMap;

const LIMITS: &super::limits::ExerciseLimits = &EXERCISE_LIMITS;

type Check = Result<(), ScenarioError>;

/// Checks a document and fills its scenario in.
pub(super) fn resolve(mut document: ExerciseDocument) -> Result<Exercise, ScenarioError> {
    if document.format != EXERCISE_FORMAT {
        return Err(unknown("/format", &document.format, EXERCISE_FORMAT.to_owned()));
    }
    check_id("/id", &document.id, &[])?;
    let [least, most] = LIMITS.minutes.map(f64::from);
    check_range("/minutes", f64::from(document.minutes), [least, most], "min")?;
    check_texts(&document)?;
    let scenario = Scenario::new(document.scenario).map_err(|error| error.within("/scenario"))?;
    document.scenario = scenario.document().clone();
    let tree = Tree::of(&scenario);
    let moves = moves(&document.moves, &tree)?;
    let visible = variants(&document.visible, "/visible", &tree, LIMITS.visible, &moves)?;
    let hidden = document.hidden.as_ref();
    let hidden = hidden.map(|hidden| variants(hidden, "/hidden", &tree, LIMITS.hidden, &moves)).transpose()?;
    check_steps(&scenario, visible.count + hidden.as_ref().map_or(0, |hidden| hidden.count))?;
    let criteria = criteria(&document.criteria, scenario.robot())?;
    let exercise = Exercise { document, robot: scenario.robot(), tree, moves, visible, hidden, criteria };
    check_gains(&exercise)?;
    Ok(exercise)
}

/// Lower-case letters, digits and hyphens: fit for a file name, an address and a column.
fn check_id(pointer: &str, id: &str, earlier: &[&str]) -> Check {
    check_range(pointer, id.chars().count() as f64, [1.0, LIMITS.name_chars as f64], "characters")?;
    let allowed = |byte: u8| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'-' || byte == b'_';
    if !id.bytes().all(allowed) || !id.starts_with(|first: char| first.is_ascii_lowercase()) {
        let form = "a lower-case letter, then lower-case letters, digits, hyphens and underscores";
        return Err(unknown(pointer, id, form.to_owned()));
    }
    if earlier.contains(&id) {
        return Err(conflict(pointer, format!("{id:?} is taken already; every name is given once")));
    }
    Ok(())
}

fn check_text(pointer: &str, text: &Text, most: usize) -> Check {
    for (language, text) in [("en", &text.en), ("es", &text.es)] {
        let at = format!("{pointer}/{language}");
        check_range(&at, text.chars().count() as f64, [1.0, most as f64], "characters")?;
        if text.trim().is_empty() {
            return Err(conflict(at, "is empty; every text is there in every language".to_owned()));
        }
        if text.chars().any(|c| c.is_control() && c != '\n') {
            return Err(conflict(at, "holds a control character other than the end of a line".to_owned()));
        }
    }
    Ok(())
}

fn check_texts(document: &ExerciseDocument) -> Check {
    let short = 2 * LIMITS.name_chars;
    check_text("/title", &document.title, short)?;
    check_text("/goal", &document.goal, LIMITS.text_chars)?;
    check_text("/statement", &document.statement, LIMITS.text_chars)?;
    for (name, text) in [("explanation", &document.explanation), ("teacher_note", &document.teacher_note)] {
        text.as_ref().map_or(Ok(()), |text| check_text(&format!("/{name}"), text, LIMITS.text_chars))?;
    }
    if document.hints.len() > LIMITS.hints {
        let problem = Problem::TooMany { found: document.hints.len(), most: LIMITS.hints, what: "hints" };
        return Err(ScenarioError::new("/hints", problem));
    }
    for (n, hint) in document.hints.iter().enumerate() {
        let at = format!("/hints/{n}");
        let most = f64::from(LIMITS.hint_attempts);
        check_range(&format!("{at}/after_attempts"), f64::from(hint.after_attempts), [0.0, most], "attempts")?;
        check_text(&format!("{at}/text"), &hint.text, LIMITS.text_chars)?;
    }
    Ok(())
}

fn moves(documents: &[MoveDocument], tree: &Tree) -> Result<Vec<Move>, ScenarioError> {
    check_count("/moves", documents.len(), LIMITS.moves, "numbers to move")?;
    let (mut moves, mut names, mut all) = (Vec::new(), Vec::new(), Vec::new());
    for (n, document) in documents.iter().enumerate() {
        let at = format!("/moves/{n}");
        check_id(&format!("{at}/name"), &document.name, &names)?;
        names.push(document.name.as_str());
        check_text(&format!("{at}/label"), &document.label, 2 * LIMITS.name_chars)?;
        check_range(&format!("{at}/unit"), document.unit.chars().count() as f64, [0.0, 20.0], "characters")?;
        let least = if document.log { 1e-12 } else { -1e12 };
        check_range(&format!("{at}/min"), document.min, [least, 1e12], "")?;
        check_range(&format!("{at}/max"), document.max, [document.min, 1e12], "(at least min)")?;
        check_range(&format!("{at}/start"), document.start, [document.min, document.max], "(the move's own range)")?;
        if let Some(step) = document.step {
            check_range(&format!("{at}/step"), step, [1e-12, document.max - document.min], "(up to max - min)")?;
        }
        check_count(&format!("{at}/fields"), document.fields.len(), LIMITS.fields, "fields")?;
        let mut own = Vec::new();
        for (m, field) in document.fields.iter().enumerate() {
            own.append(&mut changes(field, document.relative, &format!("{at}/fields/{m}"), &[tree])?);
        }
        all.extend(own.iter().cloned());
        moves.push(Move { changes: own });
    }
    check_fields(&all, LIMITS.moves * LIMITS.fields, "/moves")?;
    Ok(moves)
}

fn variants(
    document: &VariantsDocument,
    at: &str,
    tree: &Tree,
    most: u32,
    moves: &[Move],
) -> Result<Variants, ScenarioError> {
    check_range(&format!("{at}/count"), f64::from(document.count), [1.0, f64::from(most)], "variants")?;
    let fields_at = format!("{at}/fields");
    let (changes, distributions) = random_fields(&document.fields, &fields_at, &[tree])?;
    let is_moved = |change: &Change| moves.iter().flat_map(|own| &own.changes).any(|own| own.pointer == change.pointer);
    if let Some(both) = changes.iter().find(|change| is_moved(change)) {
        return Err(conflict(fields_at, format!("{} is the student's to move; it cannot vary, too", both.pointer)));
    }
    Ok(Variants { count: document.count, changes, distributions, vary_seed: document.vary_seed })
}

/// All variants together are computed in seconds.
fn check_steps(scenario: &Scenario, variants: u32) -> Check {
    let (steps, most) = (scenario.settings().steps() as f64, LIMITS.steps);
    if steps * f64::from(variants) <= most {
        return Ok(());
    }
    let message = format!("{steps} steps in each of {variants} variants are more than the {most:e} that are allowed");
    Err(conflict("/scenario/integration", message))
}

fn criteria(documents: &[CriterionDocument], robot: &RobotData) -> Result<Vec<Criterion>, ScenarioError> {
    check_count("/criteria", documents.len(), LIMITS.criteria, "criteria")?;
    let (mut criteria, mut ids) = (Vec::new(), Vec::new());
    for (n, document) in documents.iter().enumerate() {
        let at = format!("/criteria/{n}");
        check_id(&format!("{at}/id"), &document.id, &ids)?;
        ids.push(document.id.as_str());
        check_text(&format!("{at}/label"), &document.label, 2 * LIMITS.name_chars)?;
        let measure = Measure::find(&document.metric, robot)
            .ok_or_else(|| unknown(format!("{at}/metric"), &document.metric, metric_names(robot).join(", ")))?;
        check_range(&format!("{at}/full"), document.full, [0.0, 1e12], "")?;
        check_range(&format!("{at}/zero"), document.zero, [0.0, 1e12], "")?;
        if document.full == document.zero {
            let message = format!("is {} like full; between them lies partial credit", document.zero);
            return Err(conflict(format!("{at}/zero"), message));
        }
        check_range(&format!("{at}/weight"), document.weight, LIMITS.weight, "points")?;
        if hundredths(document.weight) != document.weight {
            let message = format!("{} is no whole number of hundredths of a point", document.weight);
            return Err(conflict(format!("{at}/weight"), message));
        }
        match (document.aggregate, document.quantile) {
            (ShareAggregate::Quantile, Some(share)) => check_range(&format!("{at}/quantile"), share, [0.0, 1.0], "")?,
            (ShareAggregate::Quantile, None) => {
                return Err(conflict(format!("{at}/quantile"), "missing; aggregate quantile needs it".to_owned()));
            }
            (ShareAggregate::Worst | ShareAggregate::Mean, Some(_)) => {
                let message = "belongs to aggregate quantile".to_owned();
                return Err(conflict(format!("{at}/quantile"), message));
            }
            (ShareAggregate::Worst | ShareAggregate::Mean, None) => {}
        }
        criteria.push(Criterion { measure });
    }
    Ok(criteria)
}

/// The start and every solution are submissions that are allowed.
fn check_gains(exercise: &Exercise) -> Check {
    let document = &exercise.document;
    let runs = |gains: &BTreeMap<String, f64>, at: &str| {
        exercise.runs(gains, 0, Visibility::Visible).map(drop).map_err(|error| {
            // A draw that makes a wrong scenario has its place already.
            if error.pointer.starts_with("/gains") { error.within(at) } else { error }
        })
    };
    runs(&exercise.start(), "/moves")?;
    if document.solutions.len() > LIMITS.solutions {
        let problem = Problem::TooMany { found: document.solutions.len(), most: LIMITS.solutions, what: "solutions" };
        return Err(ScenarioError::new("/solutions", problem));
    }
    let mut names = Vec::new();
    for (n, solution) in document.solutions.iter().enumerate() {
        let at = format!("/solutions/{n}");
        check_id(&format!("{at}/name"), &solution.name, &names)?;
        names.push(solution.name.as_str());
        runs(&solution.gains, &at)?;
    }
    Ok(())
}
