//! How a class does at an assignment: who has come how far, how points are spread, and what is missed most.
//!
//! Points and criteria are those of the attempts behind the marks. A criterion is missed by whoever has less than all its points.

use super::model::{AttemptState, Person};
use super::views;
use super::work::Work;
use serde_json::{Value, json};

/// Equal ranges of points, from none to all.
const BINS: usize = 10;

/// The board.
pub fn board(work: &Work, students: &[Person]) -> Value {
    let (mut rows, mut points, mut behind) = (Vec::new(), Vec::new(), Vec::new());
    let mut started = 0;
    for student in students {
        let share = work.of(student.id);
        let mark = share.mark();
        let count = |state| share.attempts.iter().filter(|attempt| attempt.state == state).count();
        started += usize::from(!share.attempts.is_empty());
        points.extend(mark.as_ref().map(|mark| mark.points));
        let counts = mark.as_ref().and_then(|mark| mark.attempt);
        behind.extend(share.attempts.iter().filter(|attempt| counts == Some(attempt.id)));
        rows.push(json!({
            "id": student.id, "name": student.name, "attempts": share.used(), "grading": count(AttemptState::Grading),
            "returned": count(AttemptState::Returned), "mark": mark.map(|mark| views::mark(&mark, &work.assignment)),
            "last_at": share.attempts.last().map(|attempt| attempt.submitted_at),
        }));
    }
    let feedbacks: Vec<_> = behind.iter().filter_map(|attempt| attempt.feedback.as_ref()).collect();
    let criteria = criteria(&feedbacks.iter().map(|feedback| feedback.criteria.as_slice()).collect::<Vec<_>>());
    let mean = (!points.is_empty()).then(|| points.iter().sum::<f64>() / points.len() as f64);
    json!({
        "assignment": views::assignment(&work.assignment, &work.extensions), "students": rows, "started": started,
        "graded": points.len(), "mean_points": mean, "distribution": spread(&points, work.assignment.settings.points),
        "commonest_failure": commonest(&criteria), "criteria": criteria,
    })
}

/// How many have how much; all points are in the last range.
fn spread(points: &[f64], of: f64) -> [u32; BINS] {
    let mut bins = [0; BINS];
    for points in points {
        let place = (points / of * BINS as f64).clamp(0.0, BINS as f64 - 1.0);
        bins[place as usize] += 1;
    }
    bins
}

/// Over everyone: how many miss each criterion, and what share of its points there is on average.
fn criteria(graded: &[&[Value]]) -> Vec<Value> {
    let Some(first) = graded.first() else { return Vec::new() };
    let share = |own: &Value| Some(own["points"].as_f64()? / own["of"].as_f64()?);
    first
        .iter()
        .enumerate()
        .map(|(n, criterion)| {
            let shares: Vec<_> = graded.iter().filter_map(|own| share(own.get(n)?)).collect();
            let failing = shares.iter().filter(|share| **share < 1.0).count();
            let mean = shares.iter().sum::<f64>() / shares.len().max(1) as f64;
            json!({ "id": criterion["id"], "label": criterion["label"], "failing": failing, "mean_share": mean })
        })
        .collect()
}

/// The criterion that most people miss; of several the one that is met worst, of these the first in the rubric.
fn commonest(criteria: &[Value]) -> Option<Value> {
    let missed = criteria.iter().filter(|own| own["failing"].as_u64() > Some(0));
    let lost = |own: &Value| 1.0 - own["mean_share"].as_f64().unwrap_or(1.0);
    let order = |one: &&Value, other: &&Value| {
        one["failing"].as_u64().cmp(&other["failing"].as_u64()).then(lost(one).total_cmp(&lost(other)))
    };
    missed.rev().max_by(order).map(|own| own["id"].clone())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_criteria_missed_by_as_many_the_worst_met_is_the_commonest_failure() {
        let own =
            |id: &str, failing: u32, mean_share: f64| json!({ "id": id, "failing": failing, "mean_share": mean_share });
        assert_eq!(commonest(&[own("a", 2, 0.9), own("b", 2, 0.1), own("c", 1, 0.0)]), Some(json!("b")));
        assert_eq!(commonest(&[own("a", 2, 0.5), own("b", 2, 0.5)]), Some(json!("a")));
        assert_eq!(commonest(&[own("a", 0, 1.0)]), None);
    }

    #[test]
    fn points_are_spread_over_ten_ranges_of_which_the_last_has_both_ends() {
        assert_eq!(spread(&[0.0, 4.9, 5.0, 49.9, 50.0, -3.0, 60.0], 50.0), [3, 1, 0, 0, 0, 0, 0, 0, 0, 3]);
    }

    #[test]
    fn a_criterion_is_missed_by_whoever_has_less_than_all_of_it() {
        let grade =
            |a: f64, b: f64| [json!({"id": "a", "points": a, "of": 4.0}), json!({"id": "b", "points": b, "of": 6.0})];
        let grades = [grade(4.0, 3.0), grade(3.99, 0.0)];
        let told = criteria(&[&grades[0], &grades[1]]);
        assert_eq!((&told[0]["failing"], &told[1]["failing"]), (&json!(1), &json!(2)));
        assert_eq!(told[1]["mean_share"], json!(0.25));
        assert!(criteria(&[]).is_empty());
    }
}
