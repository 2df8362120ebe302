//! Integrators of `x' = f(t, x)`. They take the right-hand side as a closure and know nothing of robots.

mod aligned;
mod dopri5;
mod rk4;
mod rk4_slopes;

pub use aligned::Aligned;
pub use dopri5::{Dopri5, StepTooSmall, Tolerances};
pub use rk4::Rk4;
pub use rk4_slopes::Rk4Slopes;
