//! The cases, by name.

mod accessibility;
mod appearance;
pub mod benchmark;
mod identity;
mod input;
mod keyboard;
mod language;
mod latency;
mod long_runs;
mod look;
mod memory;
mod offline;
mod pinned;
mod resilience;
mod sliders;
mod transfer;

pub use accessibility::axe;

use crate::bench::Bench;
use anyhow::Result;

/// A case: passes or says what is wrong.
pub type Case = fn(&Bench) -> Result<()>;

/// Every case.
pub const ALL: &[(&str, Case)] = &[
    ("the_default_study_has_the_same_bits_everywhere", identity::the_default_study_has_the_same_bits_everywhere),
    ("nothing_is_asked_of_other_origins_and_nothing_is_logged", identity::nothing_is_asked_of_other_origins),
    ("a_slider_changes_its_scheme_and_no_other", sliders::a_slider_changes_its_scheme_and_no_other),
    ("after_sixty_rapid_moves_the_last_one_is_shown", sliders::after_sixty_rapid_moves_the_last_one_is_shown),
    ("a_study_replaces_all_settings", sliders::a_study_replaces_all_settings),
    ("a_diverging_run_says_when_and_why", input::a_diverging_run_says_when_and_why),
    ("nonsense_is_refused_and_the_last_good_run_stays", input::nonsense_is_refused_and_the_last_good_run_stays),
    ("the_keyboard_is_enough", keyboard::the_keyboard_is_enough),
    ("a_phone_shows_everything_without_scrolling_sideways", appearance::a_phone_shows_everything),
    ("a_phone_sees_the_pinned_figure_follow_the_slider", pinned::a_phone_sees_the_figure_follow_the_slider),
    ("the_pinned_figure_is_chosen_and_hidden_by_keyboard", pinned::it_is_chosen_and_hidden_by_keyboard),
    ("a_phone_held_sideways_keeps_room_for_the_controls", pinned::a_phone_held_sideways_keeps_room),
    ("every_colour_of_text_has_enough_contrast", appearance::every_colour_of_text_has_enough_contrast),
    ("screenshots", appearance::screenshots),
    ("a_slider_move_is_drawn_in_time", latency::a_slider_move_is_drawn_in_time),
    (
        "a_long_run_is_drawn_while_it_computes_and_can_be_stopped",
        long_runs::a_long_run_is_drawn_while_it_computes_and_can_be_stopped,
    ),
    ("a_stopped_run_can_be_started_again", long_runs::a_stopped_run_can_be_started_again),
    ("a_reload_keeps_state_and_theme", resilience::a_reload_keeps_state_and_theme),
    ("a_missing_module_is_explained", resilience::a_missing_module_is_explained),
    ("a_dead_worker_is_replaced", resilience::a_dead_worker_is_replaced),
    ("a_silent_worker_is_replaced", resilience::a_silent_worker_is_replaced),
    ("axe_finds_nothing_on_the_playground", accessibility::axe_finds_nothing_on_the_playground),
    ("axe_finds_nothing_on_the_other_pages", accessibility::axe_finds_nothing_on_the_other_pages),
    (
        "axe_finds_only_swagger_ui_s_own_on_the_api_s_page",
        accessibility::axe_finds_only_swagger_ui_s_own_on_the_api_s_page,
    ),
    ("axe_would_find_a_mistake", accessibility::axe_would_find_a_mistake),
    ("nothing_moves_for_who_asked_for_less_motion", accessibility::nothing_moves_for_who_asked_for_less_motion),
    ("both_languages_have_the_same_texts", language::both_languages_have_the_same_texts),
    ("switching_languages_keeps_everything_but_the_words", language::switching_keeps_everything_but_the_words),
    ("the_browser_s_language_is_the_first_choice", language::the_browser_s_language_is_the_first_choice),
    ("offline_the_page_works_after_the_server_is_gone", offline::it_works_after_the_server_is_gone),
    ("a_new_version_replaces_the_old_one_whole", offline::a_new_version_replaces_the_old_one_whole),
    ("another_tab_follows_to_the_new_version", offline::another_tab_follows_to_the_new_version),
    ("the_page_can_be_installed", offline::it_can_be_installed),
    ("a_first_visit_is_small", transfer::a_first_visit_is_small),
    (
        "after_two_hundred_random_moves_nothing_is_left_over",
        memory::after_two_hundred_random_moves_nothing_is_left_over,
    ),
    ("the_main_page_looks_as_approved", look::the_main_page_looks_as_approved),
    ("a_change_of_looks_would_be_seen", look::a_change_of_looks_would_be_seen),
];
