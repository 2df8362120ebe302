//! Classes on the real binary: a course from the teacher's link to the gradebook, what strangers and students try, and a crowd
//! that hands in while servers die.

pub mod course;
pub mod crowd;
pub mod entry;
pub mod limits;
pub mod strangers;
