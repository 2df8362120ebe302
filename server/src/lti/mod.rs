//! LTI 1.3: learning platforms such as Moodle and Canvas sign their users in here, choose exercises, tell who is in a course,
//! and get grades back. `docs/lti.md` is the manual; decision 0020 says why it is done so.
//!
//! [`Tool`] is what requests share, [`LtiStore`] the seam to the tables. What a platform says counts only behind its signature;
//! what happens in a class is the classroom's affair.

mod access;
mod arrive;
mod claims;
mod client;
mod deep_link;
mod gradebook;
mod handshake;
mod jwt;
mod key;
mod model;
mod pages;
mod passback;
mod platform_keys;
mod refusal;
mod registration;
mod roster;
mod routes;
pub(crate) mod rows;
mod store;
mod tool;

pub use claims::Role;
pub use model::{
    Arrival, Arrived, Context, DueItem, DueScore, Enrolled, Link, Member, Platform, Score, StaleLink, Standing,
};
pub use passback::run as pass_back;
pub use registration::NewPlatform;
pub use routes::{api, pages as browser_routes, takes_posts_from_elsewhere};
pub use store::LtiStore;
pub use tool::{Tool, caller};
