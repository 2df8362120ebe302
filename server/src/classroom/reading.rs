//! Texts of exercises as pages show them: HTML with MathML, made of their Markdown.

use crate::exercises::{MarkdownError, to_html};
use adaptarm_core::exercises::{ExerciseDocument, Text};
use serde_json::{Value, json};

/// Every text that a document has, under its field's name and by language; `null` for what it does not have.
pub fn html(document: &ExerciseDocument) -> Result<Value, MarkdownError> {
    let ExerciseDocument { goal, statement, hints, explanation, teacher_note, .. } = document;
    let hints = hints.iter().map(|hint| text(&hint.text)).collect::<Result<Vec<_>, _>>()?;
    let optional = |of: &Option<Text>| of.as_ref().map(text).transpose();
    Ok(json!({
        "goal": text(goal)?, "statement": text(statement)?, "hints": hints, "explanation": optional(explanation)?,
        "teacher_note": optional(teacher_note)?,
    }))
}

fn text(text: &Text) -> Result<Value, MarkdownError> {
    Ok(json!({ "en": to_html(&text.en)?, "es": to_html(&text.es)? }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exercises::Library;
    use adaptarm_core::exercises::Released;

    #[test]
    fn a_student_s_texts_are_those_of_the_student_s_document() {
        for exercise in Library::shipped().unwrap().iter() {
            let public = html(&exercise.public(Released { attempts: 0, explanation: false })).unwrap();
            let whole = html(exercise.document()).unwrap();
            assert_eq!((&public["explanation"], &public["teacher_note"]), (&Value::Null, &Value::Null));
            assert!(whole["explanation"]["es"].as_str().is_some_and(|text| text.starts_with("<p>")));
            let hints = |of: &Value| of["hints"].as_array().map(Vec::len);
            assert!(hints(&public) <= hints(&whole) && hints(&whole) == Some(exercise.document().hints.len()));
        }
    }
}
