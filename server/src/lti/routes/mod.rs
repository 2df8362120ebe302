//! Handlers of LTI: what platforms and their users' browsers ask for below `/lti`, and what teachers ask for in the classroom.

mod launch;
mod setup;
mod teacher;

use crate::state::AppState;
use axum::Router;
use axum::extract::DefaultBodyLimit;
use axum::routing::{delete, get, post};

/// Largest form that is taken, bytes: a launch with its token.
const FORM_BYTES: usize = 256 << 10;

/// Where platforms send browsers to, by form as well: these two are protected by signature and state, not by where they come from.
const LOGIN: &str = "/lti/login";
const LAUNCH: &str = "/lti/launch";

/// Whether a path takes forms from pages of other sites.
pub fn takes_posts_from_elsewhere(path: &str) -> bool {
    matches!(path, LOGIN | LAUNCH)
}

/// What browsers and platforms ask for.
pub fn pages() -> Router<AppState> {
    Router::new()
        .route(LOGIN, get(launch::login_by_query).post(launch::login_by_form))
        .route(LAUNCH, post(launch::launch))
        .route("/lti/enter", post(launch::enter))
        .route("/lti/choose", post(launch::choose))
        .route("/lti/keys", get(setup::keys))
        .route("/lti/canvas.json", get(setup::canvas))
        .route("/lti/submit.js", get(setup::script))
        .route("/lti/page.css", get(setup::style))
        .layer(DefaultBodyLimit::max(FORM_BYTES))
}

/// What teachers ask for, by paths below the classroom's.
pub fn api() -> Router<AppState> {
    Router::new()
        .route("/lti", get(setup::tool))
        .route("/lti/platforms", get(teacher::platforms).post(teacher::register))
        .route("/lti/platforms/{id}", delete(teacher::remove))
        .route("/classes/{class}/lti", get(teacher::course))
        .route("/classes/{class}/lti/members", post(teacher::fetch_members))
        .route("/assignments/{id}/lti", get(teacher::standing))
}
