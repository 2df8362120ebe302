//! Compile-time bookkeeping of a regressor's zeros: from the pattern that a robot states to the lists that loops run over.

/// Reads a pattern that is drawn, one row per joint and one character per parameter: `#` may differ from zero.
pub const fn pattern_to_live<const N: usize, const P: usize>(pattern: &[&[u8; P]; N]) -> [[bool; P]; N] {
    let mut live = [[false; P]; N];
    let mut row = 0;
    while row < N {
        let mut column = 0;
        while column < P {
            live[row][column] = pattern[row][column] == b'#';
            column += 1;
        }
        row += 1;
    }
    live
}

/// How many entries of the pattern are live.
pub const fn count_entries<const N: usize, const P: usize>(live: &[[bool; P]; N]) -> usize {
    let mut count = 0;
    let mut row = 0;
    while row < N {
        let mut column = 0;
        while column < P {
            if live[row][column] {
                count += 1;
            }
            column += 1;
        }
        row += 1;
    }
    count
}

/// The live entries as (row, column), row by row; `L` is [`count_entries`].
pub const fn list_entries<const N: usize, const P: usize, const L: usize>(
    live: &[[bool; P]; N],
) -> [(usize, usize); L] {
    let mut list = [(0, 0); L];
    let mut next = 0;
    let mut row = 0;
    while row < N {
        let mut column = 0;
        while column < P {
            if live[row][column] {
                list[next] = (row, column);
                next += 1;
            }
            column += 1;
        }
        row += 1;
    }
    list
}

/// Whether two parameters meet in a row, so that entry (i, j) of `YᵀY` can differ from zero.
pub(super) const fn share_row<const N: usize, const P: usize>(live: &[[bool; P]; N], i: usize, j: usize) -> bool {
    let mut row = 0;
    while row < N {
        if live[row][i] && live[row][j] {
            return true;
        }
        row += 1;
    }
    false
}

/// How far a parameter is, by the rows where it is live, from one that is live everywhere, when the sets of rows are passed through
/// one after the other and each differs from the one before by a row (a Gray code).
pub(super) const fn turns_from_everywhere<const N: usize, const P: usize>(
    live: &[[bool; P]; N],
    column: usize,
) -> usize {
    // The place of a set in the code: each digit says whether an odd number of rows so far are in it.
    let (mut own, mut everywhere, mut row) = (0, 0, 0);
    while row < N {
        own = 2 * own + ((own % 2 == 1) != live[row][column]) as usize;
        everywhere = 2 * everywhere + (everywhere + 1) % 2;
        row += 1;
    }
    // Downwards, and around.
    (everywhere + (1 << N) - own) % (1 << N)
}

/// How many pairs `i <= j` of parameters share a row.
pub const fn count_pairs<const N: usize, const P: usize>(live: &[[bool; P]; N]) -> usize {
    let mut count = 0;
    let mut i = 0;
    while i < P {
        let mut j = i;
        while j < P {
            if share_row(live, i, j) {
                count += 1;
            }
            j += 1;
        }
        i += 1;
    }
    count
}

/// The pairs `i <= j` of parameters that share a row; `L` is [`count_pairs`].
pub const fn list_pairs<const N: usize, const P: usize, const L: usize>(live: &[[bool; P]; N]) -> [(usize, usize); L] {
    let mut list = [(0, 0); L];
    let mut next = 0;
    let mut i = 0;
    while i < P {
        let mut j = i;
        while j < P {
            if share_row(live, i, j) {
                list[next] = (i, j);
                next += 1;
            }
            j += 1;
        }
        i += 1;
    }
    list
}

#[cfg(test)]
mod tests {
    use super::*;

    const PATTERN: [[bool; 3]; 2] = [[true, false, true], [false, true, false]];

    #[test]
    fn lists_follow_the_pattern() {
        assert_eq!(list_entries::<2, 3, { count_entries(&PATTERN) }>(&PATTERN), [(0, 0), (0, 2), (1, 1)]);
        assert_eq!(list_pairs::<2, 3, { count_pairs(&PATTERN) }>(&PATTERN), [(0, 0), (0, 2), (1, 1), (2, 2)]);
    }

    #[test]
    fn from_one_set_of_rows_to_the_next_one_row_changes() {
        let sets: Vec<[bool; 3]> = (0..8).map(|n| [n & 4 > 0, n & 2 > 0, n & 1 > 0]).collect();
        let mut order: Vec<_> =
            sets.iter().map(|set| (turns_from_everywhere(&set.map(|is_live| [is_live]), 0), set)).collect();
        order.sort_unstable();
        assert_eq!(order[0].1, &[true; 3]);
        for n in 1..8 {
            assert_eq!(order[n].0, n);
            assert_eq!((0..3).filter(|&row| order[n].1[row] != order[n - 1].1[row]).count(), 1);
        }
    }
}
