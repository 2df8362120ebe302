//! Memory of rows that nobody needs any more, kept for the next recording.
//!
//! A run's samples are a megabyte. Allocators give so much back to the system, which maps and clears every page of it anew for the next run:
//! a tenth of a batch's time, of Slotine and Li's a quarter (docs/decisions/0015-lanes.md).

use std::cell::RefCell;

/// Most numbers that a thread keeps: 16 MiB, twice the rows of eight default runs.
const MOST_KEPT: usize = 2 << 20;
/// Fewer are not worth it: allocators keep as little themselves.
const FEWEST_KEPT: usize = 1 << 12;

thread_local! {
    /// `None` in a thread that never asked: what others recorded and it dropped is of no use to it.
    static SPARE: RefCell<Option<Vec<Vec<f64>>>> = const { RefCell::new(None) };
}

/// An empty vector with room for `capacity` numbers.
pub(crate) fn take(capacity: usize) -> Vec<f64> {
    if cfg!(target_arch = "wasm32") {
        return Vec::with_capacity(capacity);
    }
    let fits = |rows: &Vec<f64>| (capacity..=2 * capacity).contains(&rows.capacity());
    // A thread that is ending has none left.
    let found = SPARE.try_with(|spare| {
        let mut spare = spare.borrow_mut();
        let spare = spare.get_or_insert_default();
        spare.iter().rposition(fits).map(|n| spare.remove(n))
    });
    found.ok().flatten().unwrap_or_else(|| Vec::with_capacity(capacity))
}

/// Keeps the memory of `rows`, if it is worth it and there is not enough already.
pub(crate) fn give(mut rows: Vec<f64>) {
    if cfg!(target_arch = "wasm32") || !(FEWEST_KEPT..=MOST_KEPT).contains(&rows.capacity()) {
        return;
    }
    rows.clear();
    let _ = SPARE.try_with(|spare| {
        let mut spare = spare.borrow_mut();
        let Some(spare) = spare.as_mut() else { return };
        // The oldest make room: who records something else now has no use for them.
        while spare.iter().map(Vec::capacity).sum::<usize>() + rows.capacity() > MOST_KEPT {
            spare.remove(0);
        }
        spare.push(rows);
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn memory_comes_back_where_it_fits_and_is_bounded() {
        let rows = |capacity| Vec::<f64>::with_capacity(capacity);
        give(rows(FEWEST_KEPT));
        assert!(SPARE.with_borrow(Option::is_none), "nobody asked yet");
        let first = take(FEWEST_KEPT);
        let place = first.as_ptr();
        give(first);
        let small = take(FEWEST_KEPT / 4);
        assert_ne!(small.as_ptr(), place, "far too large");
        let again = take(FEWEST_KEPT);
        assert!(again.as_ptr() == place && again.is_empty());
        give(rows(MOST_KEPT + 1));
        for _ in 0..5 {
            give(rows(MOST_KEPT / 2));
        }
        let kept = SPARE.with_borrow(|spare| spare.iter().flatten().map(Vec::capacity).sum::<usize>());
        assert!((MOST_KEPT / 2..=MOST_KEPT).contains(&kept), "{kept}");
    }
}
