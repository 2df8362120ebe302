//! Following jobs: one look at the tables for all who watch, however many they are, and only while someone does.
//!
//! [`Hub`] looks; a [`Follower`] hears of what happens to one job, in order and without gaps: what it missed, because it
//! came late or is slow, it reads from the tables by number.

mod follow;
mod hub;

pub use follow::{Follower, Progress, Told};
pub use hub::{Hub, Sight};
