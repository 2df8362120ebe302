//! Jobs that outlive crashes, full disks, slow databases and crowds; the API as strangers and attackers use it.
//!
//! What a machine lacks shows as ignored, unless `REQUIRE_POSTGRES=1` or `REQUIRE_PYTHON=1` makes that a failure. With
//! `ADAPTARM_SOAK=1` (`cargo xtask test --soak`) every test takes its long form, one at a time.

mod accounts;
mod auth;
mod bucket;
mod cancel;
mod examples;
mod experiments;
mod fair;
mod formats;
mod full_disk;
mod fuzz;
mod kill;
mod load;
mod poison;
mod postgres;
mod schemathesis;
mod subscribers;

use adaptarm_tests::machine;
use anyhow::Result;
use libtest_mimic::{Arguments, Failed, Trial};

/// What a test cannot run without.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Need {
    Postgres,
    Python,
    /// A file system of a process's own, which only root can make.
    Mount,
}

impl Need {
    /// What to do about it where it is absent.
    fn missing(self) -> Option<&'static str> {
        let (present, advice) = match self {
            Self::Postgres => (machine::postgres_programs().is_some(), "PostgreSQL: `cargo xtask setup`"),
            Self::Python => (machine::python().is_some(), "Python packages: `cargo xtask setup`"),
            Self::Mount => (machine::can_mount(), "a private file system: run as root"),
        };
        (!present).then_some(advice)
    }

    fn is_required(self) -> bool {
        match self {
            Self::Postgres => machine::switched_on("REQUIRE_POSTGRES"),
            Self::Python => machine::switched_on("REQUIRE_PYTHON"),
            // Containers of CI services often may not mount either.
            Self::Mount => false,
        }
    }
}

type Case = (&'static str, &'static [Need], fn() -> Result<()>);

const CASES: &[Case] = &[
    ("killed_servers_lose_nothing_and_double_nothing", &[], kill::servers),
    ("workers_and_a_database_may_die_in_turn", &[Need::Postgres], postgres::crashes),
    ("an_experiment_killed_again_and_again_gives_the_same_bytes", &[], experiments::killed),
    ("an_experiment_shared_by_workers_gives_the_same_bytes", &[Need::Postgres], experiments::workers),
    ("two_workers_do_nearly_twice_the_work_of_one", &[Need::Postgres], postgres::throughput),
    ("results_in_a_bucket_are_the_same", &[], bucket::results),
    ("nobody_waits_for_anothers_mountain", &[], fair::users),
    ("a_full_disk_fails_the_job_and_nothing_else", &[Need::Mount], full_disk::results),
    ("a_job_that_kills_its_process_fails_alone", &[], poison::job),
    ("many_clients_at_once_are_all_served", &[], load::clients),
    ("every_subscriber_sees_every_event_once", &[], subscribers::crowd),
    ("a_canceled_simulation_stops_within_a_second", &[], cancel::running),
    ("npz_and_parquet_hold_the_bits_of_the_csv", &[Need::Python], formats::series),
    ("strangers_see_nothing_of_others", &[], auth::strangers),
    ("tokens_end_and_have_limits", &[], auth::limits),
    ("the_examples_of_the_manual_work", &[Need::Python], examples::manual),
    ("the_api_keeps_its_own_description", &[Need::Python], schemathesis::conformance),
    ("no_document_makes_the_server_fail", &[], fuzz::documents),
];

fn main() {
    let mut arguments = Arguments::from_args();
    // Two busy servers at a time are enough for a small machine; what is measured in a soak is measured alone.
    let threads = if machine::soak() { 1 } else { 2 };
    arguments.test_threads.get_or_insert(threads);
    let trials = CASES.iter().map(|&(name, needs, case)| {
        let missing = needs.iter().find(|need| !need.is_required() && need.missing().is_some());
        if let Some(advice) = missing.and_then(|need| need.missing()) {
            println!("{name} is ignored: it needs {advice}");
        }
        let trial = Trial::test(name, move || case().map_err(|error| Failed::from(format!("{error:#}"))));
        trial.with_ignored_flag(missing.is_some())
    });
    libtest_mimic::run(&arguments, trials.collect()).exit();
}
