//! Feedback laws: from the desired motion and the velocity estimate to the joint torque.
//!
//! The second of the three choices that make a scheme.

mod any;
mod linear;
mod sliding;

pub use any::AnyFeedback;
pub use linear::{LinearFeedback, LinearModel};
pub use sliding::{CoriolisVelocity, SlidingFeedback, SlidingSignals};
