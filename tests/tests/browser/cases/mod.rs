//! The cases, by name.

mod accessibility;
mod appearance;
mod arm;
mod arrival;
pub mod benchmark;
mod classroom;
mod classroom_forms;
mod classroom_pages;
mod compare;
mod experiments;
mod explain;
mod exports;
mod figures;
mod gains_said;
mod identity;
mod input;
mod jobs;
mod keyboard;
mod language;
mod latency;
mod links;
mod long_runs;
mod look;
mod memory;
mod offline;
mod pinned;
mod resilience;
mod school;
mod server_run;
mod sliders;
mod tour;
mod transfer;

pub use accessibility::axe;

use crate::bench::Bench;
use anyhow::Result;

/// A case: passes or says what is wrong.
pub type Case = fn(&Bench) -> Result<()>;

/// The cases that measure: nothing runs beside them.
pub const ALONE: &[&str] = &[
    "a_slider_move_is_drawn_in_time",
    "after_two_hundred_random_moves_nothing_is_left_over",
    "the_arm_takes_little_of_the_main_thread",
];

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
    ("zoom_is_shared_and_values_are_those_recorded", figures::zoom_is_shared_and_values_are_those_recorded),
    ("keys_move_the_cursor_and_zoom", figures::keys_move_the_cursor_and_zoom),
    ("fingers_scrub_zoom_and_scroll", figures::fingers_scrub_zoom_and_scroll),
    ("errors_are_seen_on_a_symmetric_logarithmic_axis", figures::errors_are_seen_on_a_symmetric_logarithmic_axis),
    ("figures_stay_sharp_at_any_pixel_ratio", figures::figures_stay_sharp_at_any_pixel_ratio),
    ("a_spike_of_one_sample_is_seen", figures::a_spike_of_one_sample_is_seen),
    ("a_figure_is_saved_as_shown", exports::a_figure_is_saved_as_shown),
    ("samples_in_used_arrays_are_those_of_the_last_run", exports::samples_in_used_arrays_are_those_of_the_last_run),
    ("the_paper_s_figures_of_estimates_are_saved", exports::the_paper_s_figures_of_estimates_are_saved),
    ("the_export_menu_opens_and_closes_by_keyboard", exports::the_menu_opens_and_closes_by_keyboard),
    ("every_colour_of_text_has_enough_contrast", appearance::every_colour_of_text_has_enough_contrast),
    ("screenshots", appearance::screenshots),
    ("a_slider_move_is_drawn_in_time", latency::a_slider_move_is_drawn_in_time),
    ("a_move_is_drawn_once", latency::a_move_is_drawn_once),
    ("a_move_does_not_make_the_browser_read_all_fields", latency::a_move_does_not_make_the_browser_read_all_fields),
    ("where_a_processor_draws_arms_wait_for_rest", latency::where_a_processor_draws_arms_wait_for_rest),
    ("a_finger_that_never_rests_sees_results", latency::a_finger_that_never_rests_sees_results),
    (
        "a_long_run_is_drawn_while_it_computes_and_can_be_stopped",
        long_runs::a_long_run_is_drawn_while_it_computes_and_can_be_stopped,
    ),
    ("a_stopped_run_can_be_started_again", long_runs::a_stopped_run_can_be_started_again),
    ("the_server_gives_the_bits_that_the_browser_has", server_run::the_server_gives_the_same_bits),
    ("other_settings_than_the_submitted_ones_are_explained", server_run::other_settings_are_explained),
    ("a_run_on_the_server_survives_server_and_page", server_run::a_run_survives_server_and_page),
    ("a_server_that_is_gone_loses_nothing", server_run::a_server_that_is_gone_loses_nothing),
    ("what_the_server_refuses_is_said", server_run::what_the_server_refuses_is_said),
    ("a_server_that_wants_a_token_is_given_one", server_run::a_token_is_asked_for),
    ("a_run_on_the_server_is_followed_without_a_stream", server_run::a_run_is_followed_without_a_stream),
    ("a_phone_shows_the_run_on_the_server", server_run::a_phone_shows_the_run_on_the_server),
    ("the_jobs_page_lists_filters_cancels_and_deletes", jobs::the_jobs_page_lists_filters_cancels_and_deletes),
    ("a_job_shows_its_results_and_opens_in_the_playground", jobs::a_job_opens_in_the_playground),
    ("an_experiment_is_submitted_by_hand", experiments::an_experiment_is_submitted_by_hand),
    ("experiments_show_tables_figures_and_files", experiments::experiments_show_tables_figures_and_files),
    ("the_best_of_a_tuning_opens_in_the_playground", experiments::the_best_of_a_tuning_opens_in_the_playground),
    ("experiments_fit_a_phone_in_both_languages", experiments::experiments_fit_a_phone_in_both_languages),
    ("a_study_is_submitted_by_hand", jobs::a_study_is_submitted_by_hand),
    ("the_jobs_page_fits_a_phone", jobs::the_jobs_page_fits_a_phone),
    ("a_whole_class_is_graded_and_the_numbers_agree", classroom::a_whole_class_is_graded_and_the_numbers_agree),
    ("forms_send_what_was_changed_and_refuse_the_rest", classroom_forms::forms_send_what_was_changed),
    ("places_that_are_none_lead_back", classroom_forms::places_that_are_none_lead_back),
    ("the_classroom_goes_by_keyboard", classroom_pages::the_classroom_goes_by_keyboard),
    ("the_classroom_fits_a_phone_in_both_languages", classroom_pages::the_classroom_fits_a_phone),
    ("whoever_leaves_the_classroom_comes_back_or_is_erased", classroom_pages::whoever_leaves_comes_back_or_is_erased),
    ("an_ended_session_loses_nothing", classroom_pages::an_ended_session_loses_nothing),
    ("a_refused_number_is_not_handed_in", classroom_pages::a_refused_number_is_not_handed_in),
    ("a_join_link_asks_whoever_is_signed_in", classroom_pages::a_join_link_asks_whoever_is_signed_in),
    ("axe_finds_nothing_in_the_classroom", classroom_pages::axe_finds_nothing_in_the_classroom),
    ("the_classroom_s_languages_have_the_same_texts", classroom_pages::both_languages_have_the_same_texts),
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
    ("everything_has_an_info_button_with_an_equation", explain::everything_has_an_info_button_with_an_equation),
    ("a_gain_is_tried_and_put_back", explain::a_gain_is_tried_and_put_back),
    ("the_glossary_lists_every_symbol", explain::the_glossary_lists_every_symbol),
    ("why_a_joint_is_worst_follows_the_run", explain::why_a_joint_is_worst_follows_the_run),
    ("claims_and_findings_are_in_spanish", explain::claims_and_findings_are_in_spanish),
    ("what_is_said_of_gains_is_so", gains_said::what_is_said_of_gains_is_so),
    (
        "the_tour_goes_by_keyboard_and_judges_as_the_replication",
        tour::the_tour_goes_by_keyboard_and_judges_as_the_replication,
    ),
    ("escape_ends_the_tour_and_the_settings_come_back", tour::escape_ends_the_tour_and_the_settings_come_back),
    ("the_tour_judges_longer_runs", tour::the_tour_judges_longer_runs),
    (
        "on_a_phone_the_tour_is_a_sheet_below_what_it_speaks_of",
        tour::on_a_phone_the_tour_is_a_sheet_below_what_it_speaks_of,
    ),
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
    ("a_page_that_waits_for_a_file_says_so", arrival::a_page_that_waits_for_a_file_says_so),
    ("a_page_without_a_script_says_so", arrival::a_page_without_a_script_says_so),
    ("a_script_that_fails_once_is_asked_for_again", arrival::a_script_that_fails_once_is_asked_for_again),
    ("a_first_visit_is_small", transfer::a_first_visit_is_small),
    (
        "after_two_hundred_random_moves_nothing_is_left_over",
        memory::after_two_hundred_random_moves_nothing_is_left_over,
    ),
    ("the_main_page_looks_as_approved", look::the_main_page_looks_as_approved),
    ("a_change_of_looks_would_be_seen", look::a_change_of_looks_would_be_seen),
    ("what_the_head_says_moves_nothing", look::what_the_head_says_moves_nothing),
    ("three_arms_are_drawn_side_by_side", arm::three_arms_are_drawn_side_by_side),
    ("the_arm_plays_and_is_scrubbed_by_keyboard", arm::the_arm_plays_and_is_scrubbed_by_keyboard),
    ("the_view_of_the_arm_turns_and_zooms_within_limits", arm::the_view_turns_and_zooms_within_limits),
    ("without_webgl_the_arm_is_drawn_flat", arm::without_webgl_the_arm_is_drawn_flat),
    ("a_lost_graphics_context_comes_back_or_is_explained", arm::a_lost_context_comes_back_or_is_explained),
    ("the_arm_takes_little_of_the_main_thread", arm::the_arm_takes_little_of_the_main_thread),
];
