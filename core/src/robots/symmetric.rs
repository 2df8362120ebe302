//! Where the live numbers of a symmetric matrix such as `YᵀY` are kept, so that vector instructions find neighbours.
//!
//! The columns form groups as wide as a vector, put together of columns that are live in the same rows of Y or nearly so: their
//! vectors of `YᵀY` have fewest zeros. Of each block that two groups make, the vectors `(i, group)` are kept: row i's numbers in
//! that group's columns; what lies across is read from them one by one. With a width of 1 this is the upper triangle, row by
//! row. All of it is computed while the program is compiled.

use super::structure::{share_row, turns_from_everywhere};

/// In place of an index: there is none.
pub const NONE: usize = usize::MAX;
/// Room in the lists; compiling fails where it does not suffice.
const MOST: usize = 324;

/// A symmetric matrix of `P` rows in vectors of `width` numbers.
#[derive(Debug, Clone, Copy)]
pub struct SymmetricLayout<const P: usize> {
    /// Numbers in a vector.
    width: usize,
    /// The columns, those of one group after those of another.
    order: [usize; P],
    /// Where each column is in that order.
    pub place: [usize; P],
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
            order: [NONE; P],
            place: [NONE; P],
            groups: P.div_ceil(width),
            kept: [(NONE, NONE); MOST],
            kept_len: 0,
            kept_as: [[NONE; P]; P],
            whole: [(NONE, NONE); MOST],
            whole_len: 0,
            at: [[NONE; P]; P],
        };
        layout.arrange(live);
        layout.keep(live);
        layout.index();
        layout.list_whole(live);
        layout
    }

    /// Orders the columns: from those that are live in every row on, from one to the next by as few rows as can be. Of equals the
    /// first comes first.
    const fn arrange<const N: usize>(&mut self, live: &[[bool; P]; N]) {
        let mut column = 0;
        while column < P {
            let (mut before, mut other) = (0, 0);
            while other < P {
                let is_before = if self.width == 1 {
                    other < column
                } else {
                    let (its, own) = (turns_from_everywhere(live, other), turns_from_everywhere(live, column));
                    its < own || (its == own && other < column)
                };
                before += is_before as usize;
                other += 1;
            }
            self.order[before] = column;
            self.place[column] = before;
            column += 1;
        }
    }

    /// The column that is number `n` of a group; `None` beyond the last.
    #[inline(always)]
    pub const fn column(&self, group: usize, n: usize) -> Option<usize> {
        if group * self.width + n < P { Some(self.order[group * self.width + n]) } else { None }
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
        let (mut count, mut n) = (0, 0);
        while n < self.width {
            if let Some(row) = self.column(rows, n) {
                count += self.meets(live, row, group) as usize;
            }
            n += 1;
        }
        count
    }

    const fn keep_rows<const N: usize>(&mut self, live: &[[bool; P]; N], rows: usize, group: usize) {
        let mut n = 0;
        while n < self.width {
            if let Some(row) = self.column(rows, n)
                && self.meets(live, row, group)
            {
                self.kept[self.kept_len] = (row, group);
                self.kept_as[row][group] = self.kept_len;
                self.kept_len += 1;
            }
            n += 1;
        }
    }

    /// Whether a row is live anywhere in the columns of `group`.
    const fn meets<const N: usize>(&self, live: &[[bool; P]; N], row: usize, group: usize) -> bool {
        let (mut n, mut meets) = (0, false);
        while n < self.width {
            if let Some(column) = self.column(group, n) {
                meets = meets || share_row(live, row, column);
            }
            n += 1;
        }
        meets
    }

    const fn index(&mut self) {
        let mut n = 0;
        while n < self.kept_len * self.width {
            let (row, group) = self.kept[n / self.width];
            if let Some(column) = self.column(group, n % self.width) {
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
                let (row, group) = layout.kept[n / width];
                prop_assert_eq!(layout.kept_as[row][group], n / width);
                match layout.column(group, n % width) {
                    Some(column) => {
                        prop_assert!(entries.contains(&(row, column)), "row {} of group {}", row, group);
                        prop_assert!(entries.iter().all(|&entry| entry == (row, column) || entry == (column, row)));
                    }
                    None => prop_assert!(entries.is_empty(), "row {} of group {}", row, group),
                }
            }
        }

        #[test]
        fn the_whole_matrix_is_live_where_its_rows_are(
            live in prop::array::uniform3(prop::array::uniform9(any::<bool>())),
            width in 1..=4_usize,
        ) {
            let layout = SymmetricLayout::<P>::new(&live, width);
            let is_live = |&(row, group): &(usize, usize)| {
                (0..width).filter_map(|n| layout.column(group, n)).any(|column| share_row(&live, row, column))
            };
            let groups = P.div_ceil(width);
            let expected: Vec<_> = (0..P).flat_map(|row| (0..groups).map(move |group| (row, group))).collect();
            let expected: Vec<_> = expected.into_iter().filter(is_live).collect();
            prop_assert_eq!(&layout.whole[..layout.whole_len], expected);
        }

        #[test]
        fn every_column_has_a_place_of_its_own(
            live in prop::array::uniform3(prop::array::uniform9(any::<bool>())),
            width in 1..=4_usize,
        ) {
            let layout = SymmetricLayout::<P>::new(&live, width);
            let columns: Vec<_> = (0..layout.groups * width).filter_map(|n| layout.column(n / width, n % width)).collect();
            prop_assert!(layout.place.iter().enumerate().all(|(column, &place)| columns[place] == column));
            prop_assert_eq!(columns.len(), P);
        }

        #[test]
        fn one_number_wide_it_is_the_upper_triangle(live in prop::array::uniform3(prop::array::uniform9(any::<bool>()))) {
            let layout = SymmetricLayout::<P>::new(&live, 1);
            let pairs: Vec<_> = (0..P).flat_map(|i| (i..P).map(move |j| (i, j))).collect();
            let expected: Vec<_> = pairs.into_iter().filter(|&(i, j)| share_row(&live, i, j)).collect();
            prop_assert_eq!(&layout.kept[..layout.kept_len], expected);
        }
    }

    /// Of four rows in the first group one meets the second, in all of its columns: it is kept, not they.
    #[test]
    fn the_shorter_way_across_a_block_is_kept() {
        let live: Pattern = [
            [false; P],
            [true, true, true, true, false, false, false, false, false],
            [false, false, false, true, true, true, true, true, false],
        ];
        let layout = SymmetricLayout::<P>::new(&live, 4);
        let order = |group| [0, 1, 2, 3].map(|n| layout.column(group, n));
        assert_eq!([order(0), order(1)], [[0, 1, 2, 3].map(Some), [4, 5, 6, 7].map(Some)]);
        let expected = [(0, 0), (1, 0), (2, 0), (3, 0), (3, 1), (4, 1), (5, 1), (6, 1), (7, 1)];
        assert_eq!(layout.kept[..layout.kept_len], expected);
    }

    /// The arm's 126 live numbers would make 32 vectors; in the order of the parameters they make 50.
    #[test]
    fn the_arm_has_few_vectors() {
        use crate::robots::{CrsA465, Robot};
        let of_width = |width| {
            let layout = SymmetricLayout::<18>::new(&<CrsA465 as Robot<3, 18>>::LIVE, width);
            (layout.kept_len, layout.whole_len)
        };
        assert_eq!([1, 2, 4].map(of_width), [(126, 234), (68, 122), (42, 71)]);
    }
}
