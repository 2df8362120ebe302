//! Where the live numbers of a symmetric matrix such as `YᵀY` are kept, so that vector instructions find neighbours.
//!
//! The columns form groups as wide as a vector. Of each block that two groups make, the vectors `(i, group)` are kept: row i's
//! numbers in that group's columns; what lies across is read from them one by one. With a width of 1 this is the upper
//! triangle, row by row. All of it is computed while the program is compiled.

use super::structure::share_row;

/// In place of an index: there is none.
pub const NONE: usize = usize::MAX;
/// Room in the lists; compiling fails where it does not suffice.
const MOST: usize = 324;

/// A symmetric matrix of `P` rows in vectors of `width` numbers.
#[derive(Debug, Clone, Copy)]
pub struct SymmetricLayout<const P: usize> {
    /// Numbers in a vector.
    width: usize,
    /// Number of groups; the last may reach beyond the columns.
    pub groups: usize,
    /// The kept vectors `(row, group)`, in their order.
    pub kept: [(usize, usize); MOST],
    /// Number of kept vectors.
    pub kept_len: usize,
    /// Which of the kept vectors `(row, group)` is; [`NONE`] where it is not kept.
    pub kept_as: [[usize; P]; P],
    /// All `(row, group)` of the whole matrix that are live anywhere, by row, then by group.
    pub whole: [(usize, usize); MOST],
    /// How many these are.
    pub whole_len: usize,
    /// Where entry (i, j) is among the kept numbers; [`NONE`] where it is zero and not kept.
    pub at: [[usize; P]; P],
}

impl<const P: usize> SymmetricLayout<P> {
    /// The layout for a pattern of live entries, `LIVE` of a robot.
    pub const fn new<const N: usize>(live: &[[bool; P]; N], width: usize) -> Self {
        let mut layout = Self {
            width,
            groups: P.div_ceil(width),
            kept: [(NONE, NONE); MOST],
            kept_len: 0,
            kept_as: [[NONE; P]; P],
            whole: [(NONE, NONE); MOST],
            whole_len: 0,
            at: [[NONE; P]; P],
        };
        layout.keep(live);
        layout.index();
        layout.list_whole(live);
        layout
    }

    /// Chooses the vectors of each block: its rows or its columns, whichever are fewer.
    const fn keep<const N: usize>(&mut self, live: &[[bool; P]; N]) {
        let mut a = 0;
        while a < self.groups {
            let mut b = a;
            while b < self.groups {
                if self.count_rows(live, a, b) <= self.count_rows(live, b, a) {
                    self.keep_rows(live, a, b);
                } else {
                    self.keep_rows(live, b, a);
                }
                b += 1;
            }
            a += 1;
        }
    }

    /// How many rows of group `rows` are live anywhere in the columns of `group`.
    const fn count_rows<const N: usize>(&self, live: &[[bool; P]; N], rows: usize, group: usize) -> usize {
        let (mut count, mut row) = (0, rows * self.width);
        while row < (rows + 1) * self.width {
            count += self.meets(live, row, group) as usize;
            row += 1;
        }
        count
    }

    const fn keep_rows<const N: usize>(&mut self, live: &[[bool; P]; N], rows: usize, group: usize) {
        let mut row = rows * self.width;
        while row < (rows + 1) * self.width {
            if self.meets(live, row, group) {
                self.kept[self.kept_len] = (row, group);
                self.kept_as[row][group] = self.kept_len;
                self.kept_len += 1;
            }
            row += 1;
        }
    }

    /// Whether a row is live anywhere in the columns of `group`.
    const fn meets<const N: usize>(&self, live: &[[bool; P]; N], row: usize, group: usize) -> bool {
        let (mut column, mut meets) = (group * self.width, false);
        while column < (group + 1) * self.width {
            // The last group may reach beyond the columns.
            meets = meets || (row < P && column < P && share_row(live, row, column));
            column += 1;
        }
        meets
    }

    const fn index(&mut self) {
        let mut n = 0;
        while n < self.kept_len * self.width {
            let (row, group) = self.kept[n / self.width];
            let column = group * self.width + n % self.width;
            if column < P {
                self.at[row][column] = n;
                // Its twin may be kept too, and is then found for itself.
                if self.at[column][row] == NONE {
                    self.at[column][row] = n;
                }
            }
            n += 1;
        }
    }

    const fn list_whole<const N: usize>(&mut self, live: &[[bool; P]; N]) {
        let mut n = 0;
        while n < self.groups * P {
            let (row, group) = (n / self.groups, n % self.groups);
            if self.meets(live, row, group) {
                self.whole[self.whole_len] = (row, group);
                self.whole_len += 1;
            }
            n += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const P: usize = 9;
    type Pattern = [[bool; P]; 3];

    proptest! {
        #[test]
        fn every_live_entry_has_a_place_of_its_own(
            live in prop::array::uniform3(prop::array::uniform9(any::<bool>())),
            width in 1..=4_usize,
        ) {
            let layout = SymmetricLayout::<P>::new(&live, width);
            // Which entries say that they are at each of the kept numbers.
            let mut found = vec![Vec::new(); layout.kept_len * width];
            for i in 0..P {
                for j in 0..P {
                    match layout.at[i][j] {
                        NONE => prop_assert!(!share_row(&live, i, j), "({i}, {j}) is live and not kept"),
                        n => found[n].push((i, j)),
                    }
                }
            }
            for (n, entries) in found.into_iter().enumerate() {
                let ((row, group), column) = (layout.kept[n / width], layout.kept[n / width].1 * width + n % width);
                prop_assert_eq!(layout.kept_as[row][group], n / width);
                prop_assert!(entries.iter().all(|&entry| entry == (row, column) || entry == (column, row)));
                prop_assert_eq!(entries.contains(&(row, column)), column < P, "row {} of group {}", row, group);
            }
        }

        #[test]
        fn the_whole_matrix_is_live_where_its_rows_are(
            live in prop::array::uniform3(prop::array::uniform9(any::<bool>())),
            width in 1..=4_usize,
        ) {
            let layout = SymmetricLayout::<P>::new(&live, width);
            let is_live = |&(row, group): &(usize, usize)| {
                (group * width..P.min((group + 1) * width)).any(|column| share_row(&live, row, column))
            };
            let groups = P.div_ceil(width);
            let expected: Vec<_> = (0..P).flat_map(|row| (0..groups).map(move |group| (row, group))).collect();
            let expected: Vec<_> = expected.into_iter().filter(is_live).collect();
            prop_assert_eq!(&layout.whole[..layout.whole_len], expected);
        }

        #[test]
        fn one_number_wide_it_is_the_upper_triangle(live in prop::array::uniform3(prop::array::uniform9(any::<bool>()))) {
            let layout = SymmetricLayout::<P>::new(&live, 1);
            let pairs: Vec<_> = (0..P).flat_map(|i| (i..P).map(move |j| (i, j))).collect();
            let expected: Vec<_> = pairs.into_iter().filter(|&(i, j)| share_row(&live, i, j)).collect();
            prop_assert_eq!(&layout.kept[..layout.kept_len], expected);
        }
    }

    /// Three rows meet one column: that column is kept, as a row of the other half.
    #[test]
    fn the_shorter_way_across_a_block_is_kept() {
        let live: Pattern = [
            [false, true, true, true, true, false, false, false, false],
            [true, false, false, false, false, false, false, false, false],
            [false; P],
        ];
        let layout = SymmetricLayout::<P>::new(&live, 4);
        assert_eq!(layout.kept[..layout.kept_len], [(0, 0), (1, 0), (2, 0), (3, 0), (4, 0), (4, 1)]);
    }
}
