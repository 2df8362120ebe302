//! Numbers in memory from where a cache line begins, and at a known place in a page: a vector that is read or written never lies across two
//! cache lines, and arrays that are worked on together lie apart. By the last twelve bits of addresses processors tell whether what is read
//! was written just before: arrays that begin anywhere made eight lanes up to 1.4 times as slow, by chance
//! (docs/decisions/0015-lanes.md).

use std::ops::{Deref, DerefMut};

/// Bytes of a page.
const PAGE: usize = 4096;
/// Bytes from where one array begins in its page to where the next does: nine cache lines.
const APART: usize = 576;

/// Numbers from a known place in a page on, as many as at first. Not `Clone`: a derived copy would begin anywhere.
#[derive(Debug)]
pub struct Aligned<T> {
    /// With room to begin at that place.
    room: Vec<T>,
    start: usize,
    len: usize,
}

impl<T: Copy> Aligned<T> {
    /// `len` times the same number, where a page begins.
    pub fn repeat(number: T, len: usize) -> Self {
        Self::apart(number, len, 0)
    }

    /// The same for the `n`th of some arrays that are worked on together, counted from 0.
    pub fn apart(number: T, len: usize, n: usize) -> Self {
        let (size, shift) = (size_of::<T>().max(1), n * APART);
        let room = vec![number; len + (PAGE + shift) / size];
        // Where it cannot be told, any start is right.
        let start = (room.as_ptr().align_offset(PAGE).saturating_add(shift / size)).min(room.len() - len);
        Self { room, start, len }
    }
}

impl<T: Copy> From<&[T]> for Aligned<T> {
    fn from(numbers: &[T]) -> Self {
        let Some(first) = numbers.first() else { return Self { room: Vec::new(), start: 0, len: 0 } };
        let mut copy = Self::repeat(*first, numbers.len());
        copy.copy_from_slice(numbers);
        copy
    }
}

impl<T> Deref for Aligned<T> {
    type Target = [T];
    #[inline(always)]
    fn deref(&self) -> &[T] {
        &self.room[self.start..self.start + self.len]
    }
}

impl<T> DerefMut for Aligned<T> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut [T] {
        &mut self.room[self.start..self.start + self.len]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn several_lie_apart() {
        for n in 0..5 {
            let numbers = Aligned::apart(1.0_f64, 300, n);
            assert_eq!(numbers.as_ptr().addr() % PAGE, n * APART);
            assert!(numbers.iter().all(|number| *number == 1.0));
        }
    }

    #[test]
    fn begins_where_a_page_does_and_holds_its_numbers() {
        for len in 0..20_u32 {
            let numbers: Vec<f64> = (0..len).map(f64::from).collect();
            let mut aligned = Aligned::from(numbers.as_slice());
            assert_eq!(*aligned, *numbers);
            assert!(len == 0 || aligned.as_ptr().addr().is_multiple_of(PAGE));
            aligned.fill(1.0);
            assert_eq!(*aligned, vec![1.0; numbers.len()]);
        }
    }
}
