//! Where the live numbers of a symmetric matrix such as `YᵀY` are kept, so that vector instructions find them side by side.
//!
//! Parameters that are live in the same joints' rows form groups as wide as a vector. Of each block that two groups make, the
//! vectors `(i, group)` are kept: row i's numbers in that group's columns. What is asked for across them is put together from
//! several. With a width of 1 this is the upper triangle, row by row. All of it is computed while the program is compiled.

use crate::scalar::MOST_PACKED;

/// In place of an index: there is none.
pub const NONE: usize = usize::MAX;
/// Room in the lists.
const MOST: usize = 384;

/// Row `parameter` of the matrix, in the columns of `group`.
#[derive(Debug, Clone, Copy)]
pub struct Piece {
    /// Which row.
    pub parameter: usize,
    /// Which columns.
    pub group: usize,
    /// Which kept vectors it comes from: itself alone, or one per number of the group ([`NONE`] for zeros).
    pub from: [usize; MOST_PACKED],
    /// Which number of each of them; [`NONE`] where it is kept as it is.
    pub lane: usize,
}

/// A symmetric matrix of `P` rows in vectors of `width` numbers.
#[derive(Debug, Clone, Copy)]
pub struct SymmetricLayout<const P: usize> {
    /// Numbers in a vector.
    pub width: usize,
    /// The parameters of each group; [`NONE`] where it is not full.
    pub members: [[usize; MOST_PACKED]; P],
    /// Number of groups.
    pub groups: usize,
    /// The kept vectors, in their order.
    pub kept: [(usize, usize); MOST],
    /// Number of kept vectors.
    pub kept_len: usize,
    /// All rows of the whole matrix in the columns of all groups, as far as they are live: by group, then by row.
    pub pieces: [Piece; MOST],
    /// Number of pieces.
    pub pieces_len: usize,
}

impl<const P: usize> SymmetricLayout<P> {
    /// The layout for a pattern of live entries, `LIVE` of a robot.
    pub const fn new<const N: usize>(live: &[[bool; P]; N], width: usize) -> Self {
        assert!(width <= MOST_PACKED);
        let none = Piece { parameter: 0, group: 0, from: [NONE; MOST_PACKED], lane: NONE };
        let mut layout = Self {
            width,
            members: [[NONE; MOST_PACKED]; P],
            groups: 0,
            kept: [(NONE, NONE); MOST],
            kept_len: 0,
            pieces: [none; MOST],
            pieces_len: 0,
        };
        layout.form_groups(live);
        layout.keep(live);
        layout.cut(live);
        layout
    }

    /// Group and place within it of a parameter.
    pub const fn place(&self, parameter: usize) -> (usize, usize) {
        let mut n = 0;
        while self.members[n / self.width][n % self.width] != parameter {
            n += 1;
        }
        (n / self.width, n % self.width)
    }

    /// Where row i keeps its number of column j, counted in numbers; `None` where only row j keeps it.
    pub const fn index(&self, i: usize, j: usize) -> Option<usize> {
        let (group, lane) = self.place(j);
        match self.find(i, group) {
            NONE => None,
            n => Some(n * self.width + lane),
        }
    }

    /// Parameters by the rows in which they are live, those of most rows first; a group never begins within such a class that
    /// it could have held as a whole.
    const fn form_groups<const N: usize>(&mut self, live: &[[bool; P]; N]) {
        let (mut next, mut rows) = (0_usize, N + 1);
        while rows > 0 {
            rows -= 1;
            let mut class = 0_usize;
            while class < (1_usize << N) {
                if class.count_ones() as usize == rows {
                    let size = self.class_size(live, class);
                    if !next.is_multiple_of(self.width) && size > self.width - next % self.width {
                        next = next.next_multiple_of(self.width);
                    }
                    let mut parameter = 0;
                    while parameter < P {
                        // A width of 1 needs no classes.
                        if self.width > 1 && class_of(live, parameter) == class {
                            self.members[next / self.width][next % self.width] = parameter;
                            next += 1;
                        }
                        parameter += 1;
                    }
                }
                class += 1;
            }
        }
        while self.width == 1 && next < P {
            self.members[next][0] = next;
            next += 1;
        }
        self.groups = next.div_ceil(self.width);
    }

    const fn class_size<const N: usize>(&self, live: &[[bool; P]; N], class: usize) -> usize {
        let (mut size, mut parameter) = (0, 0);
        while parameter < P {
            if class_of(live, parameter) == class {
                size += 1;
            }
            parameter += 1;
        }
        size
    }

    /// Chooses the vectors of each block: its rows or its columns, whichever are fewer.
    const fn keep<const N: usize>(&mut self, live: &[[bool; P]; N]) {
        let mut a = 0;
        while a < self.groups {
            let mut b = a;
            while b < self.groups {
                if self.count_meeting(live, a, b) <= self.count_meeting(live, b, a) {
                    self.keep_block(live, a, b);
                } else {
                    self.keep_block(live, b, a);
                }
                b += 1;
            }
            a += 1;
        }
    }

    /// How many parameters of one group share a row with any of another.
    const fn count_meeting<const N: usize>(&self, live: &[[bool; P]; N], group: usize, other: usize) -> usize {
        let (mut count, mut lane) = (0, 0);
        while lane < self.width {
            if self.meets(live, self.members[group][lane], other) {
                count += 1;
            }
            lane += 1;
        }
        count
    }

    const fn keep_block<const N: usize>(&mut self, live: &[[bool; P]; N], rows: usize, columns: usize) {
        let mut lane = 0;
        while lane < self.width {
            let parameter = self.members[rows][lane];
            if self.meets(live, parameter, columns) {
                self.kept[self.kept_len] = (parameter, columns);
                self.kept_len += 1;
            }
            lane += 1;
        }
    }

    /// Whether row `parameter` is live anywhere in the columns of `group`.
    const fn meets<const N: usize>(&self, live: &[[bool; P]; N], parameter: usize, group: usize) -> bool {
        let (mut lane, mut meets) = (0, false);
        while lane < self.width {
            meets = meets || share_row(live, parameter, self.members[group][lane]);
            lane += 1;
        }
        meets
    }

    /// Which kept vector is row `parameter` in the columns of `group`.
    const fn find(&self, parameter: usize, group: usize) -> usize {
        let mut n = 0;
        while n < self.kept_len {
            if self.kept[n].0 == parameter && self.kept[n].1 == group {
                return n;
            }
            n += 1;
        }
        NONE
    }

    const fn cut<const N: usize>(&mut self, live: &[[bool; P]; N]) {
        let mut n = 0;
        while n < self.groups * P {
            let (group, parameter) = (n / P, n % P);
            if self.meets(live, parameter, group) {
                self.pieces[self.pieces_len] = self.piece(parameter, group);
                self.pieces_len += 1;
            }
            n += 1;
        }
    }

    const fn piece(&self, parameter: usize, group: usize) -> Piece {
        let mut piece = Piece { parameter, group, from: [NONE; MOST_PACKED], lane: NONE };
        piece.from[0] = self.find(parameter, group);
        if piece.from[0] == NONE {
            let (column, lane) = self.place(parameter);
            piece.lane = lane;
            let mut n = 0;
            while n < self.width {
                piece.from[n] = self.find(self.members[group][n], column);
                n += 1;
            }
        }
        piece
    }
}

/// The rows in which a parameter is live, as bits.
const fn class_of<const N: usize, const P: usize>(live: &[[bool; P]; N], parameter: usize) -> usize {
    let (mut class, mut row) = (0, 0);
    while row < N {
        if live[row][parameter] {
            class |= 1 << row;
        }
        row += 1;
    }
    class
}

/// Whether two parameters meet in a row, so that entry (i, j) of `YᵀY` can differ from zero.
pub(super) const fn share_row<const N: usize, const P: usize>(live: &[[bool; P]; N], i: usize, j: usize) -> bool {
    i != NONE && j != NONE && class_of(live, i) & class_of(live, j) != 0
}
