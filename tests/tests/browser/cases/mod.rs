//! The cases, by name.

mod appearance;
mod compare;
mod identity;
mod input;
mod keyboard;
mod latency;
mod links;
mod long_runs;
mod pinned;
mod resilience;
mod sliders;

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
    ("every_change_can_be_undone_and_a_drag_is_one", compare::every_change_can_be_undone),
    ("the_history_survives_a_reload", compare::the_history_survives_a_reload),
    ("pinned_runs_are_compared_kept_and_computed_again", compare::pinned_runs_are_compared_and_kept),
    ("a_pin_with_other_bits_says_so_and_there_is_no_seventh", compare::other_bits_and_a_seventh_pin_are_said),
    ("a_pinned_run_is_drawn_beside_the_new_one", compare::a_pinned_run_is_drawn_beside_the_new_one),
    ("a_slider_does_not_wait_for_pins", compare::a_slider_does_not_wait_for_pins),
    ("a_link_opens_the_same_bits_in_a_fresh_profile", links::a_link_opens_the_same_bits_in_a_fresh_profile),
    ("back_and_reload_keep_their_settings", links::back_and_reload_keep_their_settings),
    ("links_of_version_1_are_read_forever", links::links_of_version_1_are_read_forever),
    ("a_broken_link_changes_nothing_and_says_why", links::a_broken_link_changes_nothing),
    ("a_broken_file_changes_nothing_and_says_why", links::a_broken_file_changes_nothing),
    ("exported_files_open_to_the_same_bits", links::exported_files_open_to_the_same_bits),
];
