//! A table of joint angles (CSV) as a trajectory, written into the scenario itself, which stays one document.

use adaptarm_core::scenario::{TrajectoryDocument, TrajectoryKind};
use thiserror::Error;

/// Why a table is none.
#[derive(Debug, PartialEq, Error)]
#[error("line {line}: {cell:?} is not a number")]
pub(super) struct NotANumber {
    line: usize,
    cell: String,
}

/// A trajectory of kind `samples` from lines of time (s) and one angle per joint (deg). A first line that does not start with
/// a number names the columns; blank lines count for nothing. Lengths and ranges are the scenario's own checks.
pub(super) fn trajectory(csv: &str) -> Result<TrajectoryDocument, NotANumber> {
    let (mut times_s, mut points_deg) = (Vec::new(), Vec::new());
    for (n, line) in csv.lines().enumerate() {
        let mut cells = line.split(',').map(str::trim);
        let first = cells.next().unwrap_or_default();
        if line.trim().is_empty() || (n == 0 && first.parse::<f64>().is_err()) {
            continue;
        }
        let number = |cell: &str| {
            // A longer cell tells no more about what it is.
            cell.parse::<f64>().map_err(|_| NotANumber { line: n + 1, cell: cell.chars().take(40).collect() })
        };
        times_s.push(number(first)?);
        points_deg.push(cells.map(number).collect::<Result<Vec<_>, _>>()?);
    }
    Ok(TrajectoryDocument {
        kind: TrajectoryKind::Samples,
        times_s: Some(times_s),
        points_deg: Some(points_deg),
        ..TrajectoryDocument::default()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_is_read_with_and_without_names() {
        let plain = trajectory("0, 1,2\n\n0.5,3,4e0\r\n").unwrap();
        assert_eq!(plain.times_s, Some(vec![0.0, 0.5]));
        assert_eq!(plain.points_deg, Some(vec![vec![1.0, 2.0], vec![3.0, 4.0]]));
        assert_eq!(trajectory("t_s,q1,q2\n0,1,2\n0.5,3,4\n").unwrap(), plain);
    }

    #[test]
    fn what_is_no_number_is_named_with_its_line() {
        let error = trajectory("t_s,q1\n0,1\n1,x\n").unwrap_err();
        assert_eq!(error.to_string(), "line 3: \"x\" is not a number");
    }
}
