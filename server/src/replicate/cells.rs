//! Numbers as they stand in the tables of a replication, on the terminal and in the report.

/// From here on a number says how large it is rather than what it is.
const LARGE: f64 = 1e4;

/// A number of ours; those of a diverged run depend on when it was given up and say nothing.
pub(super) fn ours(diverged: bool, value: f64) -> String {
    if diverged { "diverged".to_owned() } else { number(value, 5) }
}

/// A number of ours divided by the paper's.
pub(super) fn ratio(diverged: bool, value: f64, decimals: usize) -> String {
    if diverged { "–".to_owned() } else { number(value, decimals) }
}

fn number(value: f64, decimals: usize) -> String {
    if value.abs() > LARGE { format!("{value:.1e}") } else { format!("{value:.decimals$}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_number_is_wider_than_its_column() {
        assert_eq!((ours(false, 0.0351), ratio(false, 1.25, 1)), ("0.03510".to_owned(), "1.2".to_owned()));
        assert_eq!(ratio(false, 19_205_112_450.455, 3), "1.9e10");
        assert_eq!((ours(true, 19_205.0), ratio(true, 1e9, 1)), ("diverged".to_owned(), "–".to_owned()));
    }
}
