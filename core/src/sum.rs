//! Sums whose first term is not added to a zero: compilers may not drop such a zero, because it could have a sign.

use std::ops::Add;

/// A sum so far. Where a robot's structure says which terms there are, the compiler knows whether it is empty.
#[derive(Clone, Copy)]
pub(crate) struct Sum<T>(Option<T>);

impl<T: Copy + Add<Output = T>> Sum<T> {
    /// No terms.
    pub const EMPTY: Self = Self(None);

    /// The sum with one term more.
    #[inline(always)]
    pub fn plus(self, term: T) -> Self {
        Self(Some(match self.0 {
            Some(sum) => sum + term,
            None => term,
        }))
    }

    /// The sum, given the zero that it is without terms.
    #[inline(always)]
    pub fn total(self, zero: T) -> T {
        self.0.unwrap_or(zero)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn terms_are_added_in_their_order_to_the_first() {
        assert_eq!(Sum::EMPTY.plus(1e16).plus(1.0).plus(-1e16).total(0.0), 0.0);
        assert_eq!(Sum::EMPTY.plus(-0.0_f64).total(0.0).to_bits(), (-0.0_f64).to_bits());
        assert_eq!(Sum::EMPTY.total(0.0_f64).to_bits(), 0.0_f64.to_bits());
    }
}
