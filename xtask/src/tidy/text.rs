//! Rules that one file's text can break: header, length, leftovers, minified code, and in the core, determinism.
//!
//! Lines are searched without their `//` comments, so a comment may say what is forbidden and why. This file is exempt
//! from the leftovers rule: it must name them.

use super::Violation;

const LONGEST_SOURCE_LINES: usize = 400;
const LONGEST_STATIC_LINE: usize = 1000;
const THIS_FILE: &str = "xtask/src/tidy/text.rs";

/// The one module that may call libm, and the only way to it for everyone else.
const SCALAR: [&str; 2] = ["core/src/scalar.rs", "core/src/scalar/"];

/// Functions whose bits differ between platforms' maths libraries. `sqrt`, `abs` and rounding are exact everywhere.
const INEXACT: [&str; 23] = [
    "sin", "cos", "tan", "sin_cos", "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh", "exp", "exp2", "exp_m1",
    "ln", "ln_1p", "log", "log2", "log10", "powf", "powi", "cbrt", "hypot",
];

/// The same as method calls, as far as the core's own scalar trait has no method of that name.
const INEXACT_CALLS: [&str; 4] = [".powi(", ".powf(", ".exp(", ".ln("];

/// Whether this file's text has rules; others only have a largest size.
pub(super) fn is_checked(path: &str) -> bool {
    has_extension(path, &["rs", "js", "css", "html", "toml", "sh"])
}

pub(super) fn check(path: &str, text: &str) -> Vec<Violation> {
    let mut violations = shape(path, text);
    if path != THIS_FILE {
        violations.extend(leftovers(path, text));
    }
    if path.starts_with("core/src/") && has_extension(path, &["rs"]) {
        violations.extend(determinism(path, text));
    }
    violations
}

/// Header, length, and lines that no person wrote.
fn shape(path: &str, text: &str) -> Vec<Violation> {
    let mut violations = Vec::new();
    if has_extension(path, &["rs"]) && !text.starts_with("//!") {
        violations.push(Violation::new(path, 1, "open the file with `//!`: its one job in two to six lines"));
    }
    let lines = text.lines().count();
    if lines > LONGEST_SOURCE_LINES && has_extension(path, &["rs", "js", "css"]) {
        let message = format!("{lines} lines; split it, {LONGEST_SOURCE_LINES} are the limit and 250 the aim");
        violations.push(Violation::new(path, LONGEST_SOURCE_LINES + 1, message));
    }
    if path.starts_with("static/") && has_extension(path, &["js", "css"]) {
        for (number, line) in numbered(text) {
            if line.len() > LONGEST_STATIC_LINE {
                violations.push(Violation::new(path, number, "a line this long is minified code: write the source"));
            }
        }
    }
    violations
}

/// Notes to self and debugging output. Searched in comments too: that is where they live.
fn leftovers(path: &str, text: &str) -> Vec<Violation> {
    let mut violations = Vec::new();
    for (number, line) in numbered(text) {
        for word in ["TODO", "FIXME"].into_iter().filter(|word| has_word(line, word)) {
            violations.push(Violation::new(path, number, format!("`{word}`: do it or file it")));
        }
        for call in ["dbg!", "console.log"].into_iter().filter(|call| code_of(line).contains(call)) {
            violations.push(Violation::new(path, number, format!("`{call}` is for debugging: remove it")));
        }
    }
    violations
}

/// What would make the core's bits depend on the target, the build or the run.
fn determinism(path: &str, text: &str) -> Vec<Violation> {
    let is_scalar = SCALAR.iter().any(|scalar| path.starts_with(scalar));
    let mut violations = Vec::new();
    for (number, line) in numbered(before_tests(path, text)) {
        let code = code_of(line);
        let mut forbid = |what: &str, instead: &str| {
            violations.push(Violation::new(path, number, format!("`{what}` in the core: {instead}")));
        };
        if has_word(code, "mul_add") {
            forbid("mul_add", "its bits differ where the target has no FMA");
        }
        if has_word(code, "HashMap") {
            forbid("HashMap", "its order differs from run to run; use BTreeMap");
        }
        if is_scalar {
            continue;
        }
        if has_word(code, "libm") && code.contains("libm::") {
            forbid("libm::", "call the scalar module, the one door to libm");
        }
        for function in INEXACT {
            let path_form = format!("f64::{function}");
            if has_word(code, &path_form) {
                forbid(&path_form, "differs between platforms; call the scalar module");
            }
        }
        for call in INEXACT_CALLS.into_iter().filter(|call| code.contains(call)) {
            forbid(call, "differs between platforms; call the scalar module");
        }
    }
    violations
}

/// The part of a file that ships: tests may use the platform's functions as an oracle.
fn before_tests<'a>(path: &str, text: &'a str) -> &'a str {
    if path.ends_with("/tests.rs") || path.contains("/tests/") {
        return "";
    }
    text.find("#[cfg(test)]\nmod ").map_or(text, |end| &text[..end])
}

/// A line without its `//` comment; `https://` is not one.
fn code_of(line: &str) -> &str {
    let comment = line.match_indices("//").find(|(at, _)| !line[..*at].ends_with(':'));
    comment.map_or(line, |(at, _)| &line[..at])
}

/// Whether `word` stands in `line` with no letter, digit or underscore on either side.
fn has_word(line: &str, word: &str) -> bool {
    let joins = |c: Option<char>| c.is_some_and(|c| c.is_alphanumeric() || c == '_');
    line.match_indices(word)
        .any(|(at, _)| !joins(line[..at].chars().next_back()) && !joins(line[at + word.len()..].chars().next()))
}

fn has_extension(path: &str, extensions: &[&str]) -> bool {
    path.rsplit_once('.').is_some_and(|(_, extension)| extensions.contains(&extension))
}

fn numbered(text: &str) -> impl Iterator<Item = (usize, &str)> {
    text.lines().enumerate().map(|(index, line)| (index + 1, line))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(path: &str, text: &str) -> Vec<usize> {
        check(path, text).into_iter().map(|violation| violation.line).collect()
    }

    #[test]
    fn a_rust_file_opens_with_its_job() {
        assert_eq!(lines("server/src/a.rs", "use std::fs;\n"), [1]);
        assert_eq!(lines("server/src/a.rs", "//! Job.\nuse std::fs;\n"), [0; 0]);
        assert_eq!(lines("static/a.js", "let x;\n"), [0; 0]);
    }

    #[test]
    fn long_files_and_minified_lines_are_named() {
        let long = "//! Job.\n".repeat(401);
        assert_eq!(lines("server/src/a.rs", &long), [401]);
        assert_eq!(lines("server/src/a.rs", &long[9..]), [0; 0]);
        assert_eq!(lines("static/a.css", &format!("a\n{}\n", "b".repeat(1001))), [2]);
    }

    #[test]
    fn leftovers_are_found_as_words() {
        assert_eq!(lines("server/src/a.rs", "//! Job.\n// TODO later\nlet mTODOs = 1;\n"), [2]);
        assert_eq!(lines("static/a.js", "console.log(1);\n// console.log is banned\n"), [1]);
        assert_eq!(lines("server/src/a.rs", "//! Job.\ndbg!(x);\n"), [2]);
    }

    #[test]
    fn the_core_goes_through_its_scalar_module() {
        let text = "//! Job.\nlet a = f64::sin(x);\nlet b = x.sin_cos();\nlet c = x.powi(2);\nlet d = libm::exp(x);\n\
            let e = f64::sqrt(x).mul_add(1.0, 2.0);\nuse std::collections::HashMap;\nmap(f64::tanh)\n";
        assert_eq!(lines("core/src/dynamics.rs", text), [2, 4, 5, 6, 7, 8]);
        assert_eq!(lines("core/src/scalar.rs", text), [6, 7]);
        assert_eq!(lines("server/src/a.rs", text), [0; 0]);
    }

    #[test]
    fn comments_and_tests_of_the_core_may_name_what_is_forbidden() {
        let text =
            "//! Never f64::sin.\nfn f() {} // not mul_add\n\n#[cfg(test)]\nmod tests {\n    f64::sin(1.0);\n}\n";
        assert_eq!(lines("core/src/dynamics.rs", text), [0; 0]);
        assert_eq!(lines("core/src/robots/tests.rs", "//! Laws.\nf64::sin(1.0);\n"), [0; 0]);
    }

    #[test]
    fn an_address_is_not_a_comment() {
        assert_eq!(code_of("let a = \"https://x\"; // why"), "let a = \"https://x\"; ");
    }
}
