//! Dual numbers `value + slope ε`, `ε² = 0`: exact derivatives of anything written over the scalar trait.
//!
//! A second scalar beside f64, so the tests also prove that the core does not depend on one.

use adaptarm_core::scalar::{Kernel, Scalar};
use num_traits::{One, Zero};
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// A number and its derivative along one direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dual {
    pub value: f64,
    pub slope: f64,
}

impl Dual {
    pub fn new(value: f64, slope: f64) -> Self {
        Self { value, slope }
    }
}

impl Add for Dual {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self::new(self.value + o.value, self.slope + o.slope)
    }
}

impl Sub for Dual {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        Self::new(self.value - o.value, self.slope - o.slope)
    }
}

impl Mul for Dual {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        Self::new(self.value * o.value, self.slope * o.value + self.value * o.slope)
    }
}

impl Div for Dual {
    type Output = Self;
    fn div(self, o: Self) -> Self {
        let quotient = self.value / o.value;
        Self::new(quotient, (self.slope - quotient * o.slope) / o.value)
    }
}

impl Neg for Dual {
    type Output = Self;
    fn neg(self) -> Self {
        Self::new(-self.value, -self.slope)
    }
}

impl AddAssign for Dual {
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}

impl SubAssign for Dual {
    fn sub_assign(&mut self, o: Self) {
        *self = *self - o;
    }
}

impl MulAssign for Dual {
    fn mul_assign(&mut self, o: Self) {
        *self = *self * o;
    }
}

impl DivAssign for Dual {
    fn div_assign(&mut self, o: Self) {
        *self = *self / o;
    }
}

impl Zero for Dual {
    fn zero() -> Self {
        Self::new(0.0, 0.0)
    }
    fn is_zero(&self) -> bool {
        self.value == 0.0 && self.slope == 0.0
    }
}

impl One for Dual {
    fn one() -> Self {
        Self::new(1.0, 0.0)
    }
}

impl Scalar for Dual {
    type Mask = bool;
    type Pack = Self;
    const LANES: usize = 1;

    fn from_lanes(mut number: impl FnMut(usize) -> f64) -> Self {
        Self::splat(number(0))
    }
    fn lane(self, _n: usize) -> f64 {
        self.value
    }
    fn compiled<K: Kernel>(kernel: K) -> K::Output {
        kernel.run()
    }
    fn splat(value: f64) -> Self {
        Self::new(value, 0.0)
    }
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.value.sin_cos();
        (Self::new(sin, cos * self.slope), Self::new(cos, -sin * self.slope))
    }
    fn tanh(self) -> Self {
        let tanh = self.value.tanh();
        Self::new(tanh, (1.0 - tanh * tanh) * self.slope)
    }
    fn abs(self) -> Self {
        if self.value < 0.0 { -self } else { self }
    }
    fn less_than(self, other: Self) -> bool {
        self.value < other.value
    }
    fn any(mask: bool) -> bool {
        mask
    }
    fn quadrant(self) -> (bool, bool, bool) {
        self.value.quadrant()
    }
    fn power_of_two(self) -> Self {
        Self::new(self.value.power_of_two(), 0.0)
    }
    fn select(mask: bool, if_true: Self, if_false: Self) -> Self {
        if mask { if_true } else { if_false }
    }
}
