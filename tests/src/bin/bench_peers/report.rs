//! The table of times and ratios, for people and as JSON.

use crate::measurement::Contestant;
use crate::rounds::{Pinned, ROUNDS, SchemeTimes, Time};
use serde_json::{Value, json};

/// Prints one line per contestant: per scheme its median and, in brackets, the ratio to ours.
pub fn print(contestants: &[Contestant], results: &[SchemeTimes], pinned: &Pinned) {
    let place = pinned.core().map_or("not pinned".to_owned(), |core| format!("on core {core}"));
    println!(
        "Default study, microseconds per step of 1 ms, median of {ROUNDS} rounds, {place}; in brackets, times ours"
    );
    let headings = results.iter().map(|result| format!("{:>20}", result.scheme.name()));
    println!("{:<38}{}{:>14}", "", headings.collect::<String>(), "differs by");
    for (index, contestant) in contestants.iter().enumerate() {
        let cells = results.iter().map(|result| match find(result, index) {
            Some(time) => format!("{:>11.3} {:>8}", time.median(), format!("({:.2})", ratio(result, time))),
            None => format!("{:>20}", "refused"),
        });
        // The strict comparison's.
        let differences = results.iter().filter_map(|result| find(result, index)?.differences.last());
        println!(
            "{:<38}{}{:>14.1e}",
            contestant.name,
            cells.collect::<String>(),
            differences.copied().fold(0.0, f64::max)
        );
    }
    println!();
    for (index, contestant) in contestants.iter().enumerate() {
        if let Some(time) = results.iter().find_map(|result| find(result, index)) {
            println!("{:<38}{}", contestant.name, time.with);
        }
    }
}

/// The same with every round, for tables elsewhere.
pub fn json(contestants: &[Contestant], results: &[SchemeTimes]) -> Value {
    let entry = |result: &SchemeTimes, time: &Time| {
        json!({
            "contestant": contestants[time.contestant].name,
            "with": time.with,
            "scheme": result.scheme.id(),
            "median_us_per_step": time.median(),
            "rounds_us_per_step": time.us_per_step,
            "ratio": ratio(result, time),
            "largest_scaled_differences": time.differences,
        })
    };
    let times = results.iter().flat_map(|result| result.times.iter().map(move |time| entry(result, time)));
    let repetitions = results.iter().map(|result| (result.scheme.id().to_owned(), json!(result.repetitions)));
    json!({
        "format": "adaptarm.bench_peers/1",
        "repetitions": Value::Object(repetitions.collect()),
        "times": times.collect::<Vec<_>>(),
    })
}

fn find(result: &SchemeTimes, contestant: usize) -> Option<&Time> {
    result.times.iter().find(|time| time.contestant == contestant)
}

/// To the first of ours.
fn ratio(result: &SchemeTimes, time: &Time) -> f64 {
    find(result, 0).map_or(f64::NAN, |ours| time.median() / ours.median())
}
