//! What people may be called, and what else they may write: lengths in characters, and what a spreadsheet would not run.

use adaptarm_core::scenario::{Problem, ScenarioError};
use jiff::Timestamp;
use jiff::tz::TimeZone;

/// Allowed lengths.
pub const NAME_CHARS: [usize; 2] = [1, 80];
/// Of a login that a teacher chooses.
pub const LOGIN_CHARS: [usize; 2] = [3, 40];
/// Of a password.
pub const PASSWORD_CHARS: [usize; 2] = [10, 200];
/// Of a school's own number for a student.
pub const NUMBER_CHARS: [usize; 2] = [1, 64];
/// Of an assignment's title.
pub const TITLE_CHARS: [usize; 2] = [1, 120];
/// Of what explains a decision.
pub const COMMENT_CHARS: [usize; 2] = [1, 1000];
/// Of a deadline, and of when something opens.
const YEARS: [f64; 2] = [2000.0, 2999.0];

/// A text of an allowed length without control characters; the space around it does not count.
pub fn line(pointer: &str, text: &str, allowed: [usize; 2]) -> Result<String, ScenarioError> {
    let text = text.trim();
    check_length(pointer, text, allowed)?;
    if text.chars().any(char::is_control) {
        return Err(malformed(pointer, "has a control character; one line of plain text is needed"));
    }
    Ok(text.to_owned())
}

/// A name or number that goes into gradebooks. A spreadsheet takes for a formula what begins like one.
pub fn cell(pointer: &str, text: &str, allowed: [usize; 2]) -> Result<String, ScenarioError> {
    let text = line(pointer, text, allowed)?;
    if text.starts_with(['=', '+', '-', '@']) {
        return Err(malformed(pointer, "begins with =, +, - or @, which spreadsheets take for a formula"));
    }
    Ok(text)
}

/// A teacher's login.
pub fn login(pointer: &str, text: &str) -> Result<String, ScenarioError> {
    check_length(pointer, text, LOGIN_CHARS)?;
    // Students' logins, which the server makes, have capitals only: the two cannot meet.
    let allowed = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || "._-".contains(c);
    if text.chars().all(allowed) && text.chars().any(|c| c.is_ascii_lowercase()) {
        return Ok(text.to_owned());
    }
    Err(malformed(pointer, "a login is made of a-z 0-9 . _ - with at least one letter"))
}

/// Whether a text has a length between these two.
pub fn check_length(pointer: &str, text: &str, [least, most]: [usize; 2]) -> Result<(), ScenarioError> {
    let chars = text.chars().count();
    if (least..=most).contains(&chars) {
        return Ok(());
    }
    let problem = Problem::OutOfRange { value: chars as f64, min: least as f64, max: most as f64, unit: "characters" };
    Err(ScenarioError::new(pointer, problem))
}

/// A number in its range.
pub fn number(pointer: &str, value: f64, [min, max]: [f64; 2], unit: &'static str) -> Result<f64, ScenarioError> {
    if (min..=max).contains(&value) {
        return Ok(value);
    }
    Err(ScenarioError::new(pointer, Problem::OutOfRange { value, min, max, unit }))
}

/// A moment that a course may have something to do with.
pub fn moment(pointer: &str, moment: Option<Timestamp>) -> Result<(), ScenarioError> {
    let Some(moment) = moment else { return Ok(()) };
    let year = f64::from(moment.to_zoned(TimeZone::UTC).year());
    number(pointer, year, YEARS, "years").map(|_| ())
}

/// Not the text that is needed.
pub fn malformed(pointer: &str, message: &str) -> ScenarioError {
    ScenarioError::new(pointer, Problem::Malformed { message: message.to_owned() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_lines_that_no_spreadsheet_runs() {
        assert_eq!(cell("/name", " Ana Díaz ", NAME_CHARS).unwrap(), "Ana Díaz");
        for wrong in ["", "  ", "a\nb", "a\0", "=1+1", "@x", "-2", " +3", &"x".repeat(81)] {
            assert!(cell("/name", wrong, NAME_CHARS).is_err(), "{wrong:?}");
        }
        assert!(login("/login", "ana.diaz-2").is_ok());
        for wrong in ["an", "Ana", "K7WQ2M9P", "ana diaz", "123", &"x".repeat(41)] {
            assert!(login("/login", wrong).is_err(), "{wrong:?}");
        }
    }
}
