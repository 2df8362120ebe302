//! Loops over compile-time lists, written out, so that every index in their bodies is a constant.
//!
//! The structure of a robot (live entries, pairs) is known when the program is built. With constant indices the compiler
//! drops bounds checks, index loads and whole terms that are structurally zero; a loop over the list keeps them all. A
//! macro, because a closure called a hundred times is not inlined.

/// `unrolled!(len, n => body)` runs `body` with `n` = 0, 1, ..., `len − 1`; the first 192 copies are written out.
macro_rules! unrolled {
    ($len:expr, $n:ident => $body:block) => {
        unrolled!(@64 0usize, $len, $n, $body);
        unrolled!(@64 64usize, $len, $n, $body);
        unrolled!(@64 128usize, $len, $n, $body);
        for $n in 192..$len $body
    };
    (@64 $at:expr, $len:expr, $n:ident, $body:block) => {
        unrolled!(@16 $at, $len, $n, $body);
        unrolled!(@16 $at + 16, $len, $n, $body);
        unrolled!(@16 $at + 32, $len, $n, $body);
        unrolled!(@16 $at + 48, $len, $n, $body);
    };
    (@16 $at:expr, $len:expr, $n:ident, $body:block) => {
        unrolled!(@4 $at, $len, $n, $body);
        unrolled!(@4 $at + 4, $len, $n, $body);
        unrolled!(@4 $at + 8, $len, $n, $body);
        unrolled!(@4 $at + 12, $len, $n, $body);
    };
    (@4 $at:expr, $len:expr, $n:ident, $body:block) => {
        unrolled!(@1 $at, $len, $n, $body);
        unrolled!(@1 $at + 1, $len, $n, $body);
        unrolled!(@1 $at + 2, $len, $n, $body);
        unrolled!(@1 $at + 3, $len, $n, $body);
    };
    (@1 $at:expr, $len:expr, $n:ident, $body:block) => {
        if $at < $len {
            let $n = $at;
            $body
        }
    };
}
pub(crate) use unrolled;

#[cfg(test)]
mod tests {
    #[test]
    fn visits_every_index_once_in_order() {
        for len in [0, 1, 7, 64, 126, 128, 191, 192, 193, 200] {
            let mut visited = Vec::new();
            unrolled!(len, n => { visited.push(n); });
            assert!(visited.into_iter().eq(0..len));
        }
    }
}
