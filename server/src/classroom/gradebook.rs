//! Marks of a class as CSV (RFC 4180), in the shapes that other systems import.
//!
//! Canvas: the columns `Student,ID,SIS User ID,SIS Login ID,Section`, then one per assignment, and below them a row `Points
//! Possible` (`lib/gradebook_importer.rb` of canvas-lms). Moodle: any columns, of which the teacher says which one identifies the
//! user (`ID number`) and which are grades or feedback (Grades, Import, CSV file).

use super::model::{Assignment, Person};
use super::views;
use super::work::Work;

/// For whom.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// People and other programs: everything.
    Plain,
    /// Moodle.
    Moodle,
    /// Canvas.
    Canvas,
}

impl Shape {
    /// Names of all shapes.
    pub const NAMES: &str = "plain, moodle, canvas";

    /// The shape of this name.
    pub fn from_id(id: &str) -> Option<Self> {
        match id {
            "plain" => Some(Self::Plain),
            "moodle" => Some(Self::Moodle),
            "canvas" => Some(Self::Canvas),
            _ => None,
        }
    }
}

/// The table.
pub fn table(shape: Shape, class: &str, students: &[Person], works: &[Work]) -> String {
    let titles = apart(works.iter().map(|work| title(&work.assignment)).collect());
    let mut lines = head(shape, &titles, works);
    for student in students {
        let number = student.number.clone().unwrap_or_default();
        let mut line = match shape {
            Shape::Plain => vec![student.name.clone(), student.login.clone(), number],
            Shape::Moodle => vec![number, student.name.clone()],
            // Canvas finds a student by SIS User ID, or else by name; its own ID is unknown here.
            Shape::Canvas => {
                vec![student.name.clone(), String::new(), number, String::new(), class.to_owned()]
            }
        };
        for work in works {
            let share = work.of(student.id);
            let mark = share.mark();
            let points = mark.as_ref().map_or_else(String::new, |mark| mark.points.to_string());
            let comment = mark.as_ref().and_then(|mark| mark.overridden.clone()).unwrap_or_default();
            match shape {
                Shape::Plain => {
                    let late = mark.as_ref().map_or_else(String::new, |mark| mark.late_percent.to_string());
                    line.extend([points, share.used().to_string(), late, comment]);
                }
                Shape::Moodle => line.extend([points, comment]),
                Shape::Canvas => line.push(points),
            }
        }
        lines.push(line);
    }
    let lines: String = lines.iter().map(|line| write(line)).collect();
    match shape {
        // Excel takes a file without a byte-order mark for one of an old code page.
        Shape::Plain => format!("\u{feff}{lines}"),
        Shape::Moodle | Shape::Canvas => lines,
    }
}

/// Titles of which no two are the same: importers find columns by name, and take two of one name for one.
fn apart(titles: Vec<String>) -> Vec<String> {
    let mut told: Vec<String> = Vec::new();
    for title in titles {
        let others = (2..).map(|n| format!("{title} ({n})"));
        let free = std::iter::once(title.clone()).chain(others).find(|name| !told.contains(name));
        told.extend(free);
    }
    told
}

fn head(shape: Shape, titles: &[String], works: &[Work]) -> Vec<Vec<String>> {
    let own = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>();
    let per = |form: fn(&str) -> Vec<String>| titles.iter().flat_map(|title| form(title)).collect::<Vec<_>>();
    match shape {
        Shape::Plain => {
            let columns = per(|title| {
                let more = ["attempts", "late percent", "comment"].map(|what| format!("{title} ({what})"));
                [vec![title.to_owned()], more.to_vec()].concat()
            });
            vec![[own(&["Name", "Login", "Number"]), columns].concat()]
        }
        Shape::Moodle => {
            let columns = per(|title| vec![title.to_owned(), format!("{title} (feedback)")]);
            vec![[own(&["ID number", "Full name"]), columns].concat()]
        }
        Shape::Canvas => {
            let names = own(&["Student", "ID", "SIS User ID", "SIS Login ID", "Section"]);
            let possible = works.iter().map(|work| work.assignment.settings.points.to_string()).collect();
            let row = own(&["    Points Possible", "", "", "", ""]);
            vec![[names, titles.to_vec()].concat(), [row, possible].concat()]
        }
    }
}

fn title(assignment: &Assignment) -> String {
    views::title(assignment)["en"].as_str().unwrap_or(&assignment.exercise).to_owned()
}

fn write(cells: &[String]) -> String {
    let cell = |cell: &String| {
        if cell.contains([',', '"', '\n', '\r']) || cell.starts_with(' ') {
            format!("\"{}\"", cell.replace('"', "\"\""))
        } else {
            cell.clone()
        }
    };
    cells.iter().map(cell).collect::<Vec<_>>().join(",") + "\r\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_of_one_exercise_given_out_twice_have_names_of_their_own() {
        let titles = ["Hold it", "Track", "Hold it", "Hold it (2)", "Hold it"].map(str::to_owned);
        assert_eq!(apart(titles.to_vec()), ["Hold it", "Track", "Hold it (2)", "Hold it (2) (2)", "Hold it (3)"]);
    }
}
