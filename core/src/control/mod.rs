//! Feedback laws: from the desired motion and the velocity estimate to the joint torque.
//!
//! The second of the three choices that make a scheme.

mod sliding;

pub use sliding::{CoriolisVelocity, SlidingFeedback, SlidingSignals};
