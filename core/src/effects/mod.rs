//! Imperfections, all on the plant's side of one boundary: what the arm does to torques, and what of its motion is seen.
//!
//! The controller knows none of them. What crosses the boundary is a measurement ([`Sensing`]) at the instants of a
//! [`SampledControl`], and a torque through an [`Actuator`]; the arm itself carries a [`Load`]. Each is absent unless asked for.

mod actuator;
mod elasticity;
mod load;
mod sampling;
mod sensing;

pub use actuator::Actuator;
pub use elasticity::{Elasticity, EncoderSide};
pub use load::{Disturbance, Load, Payload, Stribeck};
pub use sampling::{SampledControl, Tick};
pub use sensing::Sensing;
