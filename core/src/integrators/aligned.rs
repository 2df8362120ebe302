//! Numbers in memory from where a cache line begins: a vector that is read or written never lies across two lines.

use std::ops::{Deref, DerefMut};

/// Bytes of a cache line, and of the longest vector.
const LINE: usize = 64;

/// Numbers from a line's start on, as many as at first. Not `Clone`: a derived copy would begin anywhere.
#[derive(Debug)]
pub struct Aligned<T> {
    /// With room to begin where a line does.
    room: Vec<T>,
    start: usize,
    len: usize,
}

impl<T: Copy> Aligned<T> {
    /// `len` times the same number.
    pub fn repeat(number: T, len: usize) -> Self {
        let room = vec![number; len + LINE / size_of::<T>().max(1)];
        // Where it cannot be told, any start is right.
        let start = room.as_ptr().align_offset(LINE).min(room.len() - len);
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
    fn begins_where_a_line_does_and_holds_its_numbers() {
        for len in 0..20_u32 {
            let numbers: Vec<f64> = (0..len).map(f64::from).collect();
            let mut aligned = Aligned::from(numbers.as_slice());
            assert_eq!(*aligned, *numbers);
            assert!(len == 0 || aligned.as_ptr().addr().is_multiple_of(LINE));
            aligned.fill(1.0);
            assert_eq!(*aligned, vec![1.0; numbers.len()]);
        }
    }
}
