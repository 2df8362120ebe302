//! What users write, and what they are told when it is wrong.

use super::*;
use proptest::prelude::*;
use std::collections::BTreeSet;
use std::io::Write;

/// Settings from a file's text, variables and flags.
fn load(file: &str, environment: &[(&str, &str)], flags: &[(&'static str, &str)]) -> Result<Loaded, String> {
    let mut sources = Sources {
        file: None,
        environment: environment.iter().map(|(name, value)| ((*name).to_owned(), (*value).into())).collect(),
        flags: flags.iter().map(|(key, value)| (*key, (*value).to_owned())).collect(),
    };
    let folder = tempfile();
    if !file.is_empty() {
        let path = folder.join("adaptarm.toml");
        std::fs::File::create(&path).unwrap().write_all(file.as_bytes()).unwrap();
        sources.file = Some(path);
    }
    let loaded = sources.load().map_err(|error| error.to_string().replace(&format!("{}/", folder.display()), ""));
    std::fs::remove_dir_all(folder).unwrap();
    loaded
}

/// A folder of this test's own.
fn tempfile() -> PathBuf {
    let folder = std::env::temp_dir().join(format!("adaptarm-config-{}", uuid::Uuid::now_v7()));
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

fn mistake(file: &str) -> String {
    load(file, &[], &[]).unwrap_err()
}

#[test]
fn later_layers_win_and_every_value_knows_its_place() {
    let file = "bind = \"127.0.0.1:1\"\nthreads = 1\n[limits]\nwait_s = 10\nscenarios_per_job = 5\n";
    let environment = [("ADAPTARM_THREADS", "2"), ("ADAPTARM_LIMITS_WAIT_S", "20"), ("ADAPTARM_DATA", "")];
    let loaded = load(file, &environment, &[("threads", "0x3")]).unwrap_err();
    assert_eq!(loaded, "--threads: threads: found the text \"0x3\", expected a whole number from 0 to 1024 threads");
    let loaded = load(file, &environment, &[("threads", "3")]).unwrap();
    let Config { bind, threads, limits, data, .. } = &loaded.config;
    assert_eq!((bind.port(), *threads, limits.wait_s, limits.scenarios_per_job), (1, Some(3), 20, 5));
    assert_eq!(*data, None, "an empty variable is one that is not set");
    let place = |key: &str| loaded.places.get(key).map(String::as_str).unwrap_or_default();
    assert!(place("bind").ends_with("adaptarm.toml:1"), "{}", place("bind"));
    assert!(place("limits.scenarios_per_job").ends_with("adaptarm.toml:5"));
    assert_eq!(place("limits.wait_s"), "variable ADAPTARM_LIMITS_WAIT_S");
    assert_eq!(place("threads"), "--threads");
    assert_eq!(place("limits.steps_per_job"), "");
}

#[test]
fn nothing_written_is_the_default() {
    assert_eq!(load("", &[("PATH", "/bin"), ("ADAPTARM_BIN", "x")], &[]).unwrap().config, Config::default());
    assert_eq!(load("# nothing\n[limits]\n", &[], &[]).unwrap().config, Config::default());
}

#[test]
fn mistakes_name_place_key_value_and_what_is_allowed() {
    for (file, message) in [
        (
            "\nthread = 3",
            "adaptarm.toml:2: there is no setting thread; there are bind, data, database, results, threads, log, limits, retention, queue, server, auth, webhooks",
        ),
        ("[auth]\nx = 1", "adaptarm.toml:2: there is no setting auth.x; there are requests_per_minute"),
        ("[limit]\nwait_s = 1", "adaptarm.toml:1: there is no setting limit; there are bind"),
        (
            "limits.wait_s.x = 1",
            "adaptarm.toml:1: limits.wait_s: found a section, expected a whole number from 0 to 600 s",
        ),
        ("limits = 3", "adaptarm.toml:1: limits: found the number 3, expected a section, [limits]"),
        ("threads = 1025", "adaptarm.toml:1: threads: 1025 is outside the allowed range 0 to 1024 threads"),
        ("threads = -1", "adaptarm.toml:1: threads: -1 is outside the allowed range 0 to 1024 threads"),
        (
            "threads = 2.5",
            "adaptarm.toml:1: threads: found the number 2.5, expected a whole number from 0 to 1024 threads",
        ),
        ("threads = true", "adaptarm.toml:1: threads: found true, expected a whole number"),
        ("threads = \"2\"", "adaptarm.toml:1: threads: found the text \"2\", expected a whole number"),
        ("threads = 99999999999999999999999999999999999999999", "adaptarm.toml:1:"),
        ("queue.lease_s = nan", "adaptarm.toml:1: queue.lease_s: NaN is outside the allowed range 0.5 to 3600 s"),
        ("queue.lease_s = 1e9", "adaptarm.toml:1: queue.lease_s: 1000000000 is outside the allowed range"),
        (
            "[server]\ndrain_s = 1979-05-27",
            "adaptarm.toml:2: server.drain_s: found a date, expected a number from 0 to 3600 s",
        ),
        ("bind = \"8080\"", "adaptarm.toml:1: bind \"8080\": not an address with a port, such as 127.0.0.1:8080"),
        ("results = \"gs://bucket\"", "adaptarm.toml:1: results \"gs://bucket\": gs:// is not supported"),
        ("results = \"s3://B\"", "adaptarm.toml:1: results \"s3://B\": \"B\" is no bucket's name"),
        ("data = \"\"", "adaptarm.toml:1: data \"\": not the name of a folder"),
        ("log.format = \"xml\"", "adaptarm.toml:1: log.format \"xml\": there are text and json"),
        ("log.filter = \"a=b=c\"", "adaptarm.toml:1: log.filter \"a=b=c\": not a filter such as"),
        (
            "[webhooks]\nallow = [\"10.0.0.0/33\"]",
            "adaptarm.toml:2: webhooks.allow \"10.0.0.0/33\": has a prefix that is not 0 to 32 (IPv4) or 0 to 128 (IPv6); allowed: an address, a",
        ),
        (
            "[webhooks]\nallow = [1]",
            "adaptarm.toml:2: webhooks.allow: found a list with the number 1, expected a list of texts",
        ),
        (
            "[webhooks]\nallow = \"a\"",
            "adaptarm.toml:2: webhooks.allow: found the text \"a\", expected a list of texts",
        ),
        ("a =", "adaptarm.toml:1:4: not TOML: "),
        ("[limits]\nwait_s = 1\nwait_s = 2", "adaptarm.toml:3:1: not TOML: "),
        (
            "[limits]\nwait_s = 90",
            "adaptarm.toml:2: limits.wait_s = 90 must be shorter than server.request_timeout_s = 90",
        ),
        (
            "queue.lease_s = 0.6",
            "adaptarm.toml:1: queue.heartbeat_ms = 250 must be at most a third, in ms, of queue.lease_s = 0.6",
        ),
        (
            "retention.results_days = 3",
            "adaptarm.toml:1: retention.finished_jobs_days = 30 must be at most retention.results_days = 3",
        ),
    ] {
        let told = mistake(file);
        assert!(told.starts_with(message), "{file}\n  told {told}\n  not  {message}");
        assert!(!told.contains('\n'), "{told}");
    }
}

#[test]
fn the_environment_is_read_strictly_where_a_name_can_only_be_ours() {
    let told = load("", &[("ADAPTARM_LIMITS_WAITS", "1")], &[]).unwrap_err();
    assert!(told.starts_with("variable ADAPTARM_LIMITS_WAITS: there is no setting limits.waits; there are "), "{told}");
    load("", &[("ADAPTARM_SERVER_PORT_80_TCP", "tcp://10.0.0.1:80"), ("ADAPTARM_SERVER_SERVICE_HOST", "h")], &[])
        .unwrap();
    let loaded = load("", &[("ADAPTARM_WEBHOOKS_ALLOW", "10.0.0.0/8, hooks.lab"), ("RUST_LOG", "debug")], &[]).unwrap();
    assert_eq!(loaded.config.webhooks.allow.len(), 2);
    assert_eq!(loaded.config.log.filter, "debug");
    assert_eq!(loaded.places["log.filter"], "variable RUST_LOG");
    let both = [("ADAPTARM_LOG_FILTER", "warn"), ("RUST_LOG", "debug")];
    assert_eq!(load("", &both, &[]).unwrap().config.log.filter, "warn");
    let told = load("", &[("ADAPTARM_WEBHOOKS_ALLOW_ALL", "yes")], &[]).unwrap_err();
    let message =
        "variable ADAPTARM_WEBHOOKS_ALLOW_ALL: webhooks.allow_all: found the text \"yes\", expected true or false";
    assert_eq!(told, message);
}

#[test]
fn passwords_are_shown_nowhere() {
    let url = "postgres://u:geheim@h/db?sslmode=require&password=geheim";
    let loaded = load("", &[("ADAPTARM_DATABASE", url)], &[]).unwrap();
    assert_eq!(loaded.config.database.as_ref().map(DatabaseUrl::expose), Some(url));
    for text in [format!("{:?}", loaded.config), format!("{loaded:?}"), effective(&loaded)] {
        assert!(text.contains("postgres://u:***@h/db?sslmode=require"), "{text}");
        assert!(!text.contains("geheim"), "{text}");
    }
    for bad in ["mysql://u:geheim@h/db", "postgres://u:geheim@h:port/db", "geheim"] {
        let told = load("", &[("ADAPTARM_DATABASE", bad)], &[]).unwrap_err();
        assert!(!told.contains("geheim") && told.starts_with("variable ADAPTARM_DATABASE: database: "), "{told}");
    }
    for bad in ["database = [\"geheim\"]", "database = { password = \"geheim\" }"] {
        assert!(!mistake(bad).contains("geheim"), "{}", mistake(bad));
    }
}

#[test]
fn the_example_file_is_the_defaults_and_its_comments_are_settings() {
    let text = example();
    let loaded = load(&text, &[], &[]).unwrap();
    assert_eq!(loaded.config, Config::default());
    let set: BTreeSet<_> = loaded.places.keys().cloned().collect();
    let unset = ["classroom.exercises", "classroom.public_url", "data", "database", "results", "threads"];
    let all: BTreeSet<_> = Config::settings().iter().map(|setting| setting.key()).collect();
    assert_eq!(all.difference(&set).collect::<Vec<_>>(), unset);
    // Without their `# `, the examples are settings too.
    let mut uncommented = text;
    for key in unset {
        let name = key.rsplit('.').next().unwrap();
        uncommented = uncommented.replace(&format!("# {name} = "), &format!("{name} = "));
    }
    let loaded = load(&uncommented, &[], &[]).unwrap();
    assert_eq!(loaded.places.len(), all.len());
    assert_eq!(loaded.config.thread_count(), 4);
}

#[test]
fn the_deployed_example_is_current() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../deploy/adaptarm.example.toml");
    let deployed = std::fs::read_to_string(path).unwrap();
    assert_eq!(deployed, example(), "write it anew: adaptarm config show-default > deploy/adaptarm.example.toml");
}

#[test]
fn what_is_printed_as_in_force_reads_back_as_the_same() {
    let file = "data = \"a \\\"b\\\" \\u0007\"\nresults = \"s3://bucket/a/b\"\nthreads = 0\n[queue]\nlease_s = 20\n[webhooks]\nallow = [\"Hooks.lab\", \"fd00::/8\"]\n";
    let loaded = load(file, &[], &[]).unwrap();
    let text = effective(&loaded);
    assert_eq!(load(&text, &[], &[]).unwrap().config, loaded.config, "{text}");
    assert!(text.contains("lease_s = 20.0  # ") && text.contains("adaptarm.toml:5\n"), "{text}");
}

#[test]
fn webhooks_follow_their_settings() {
    let webhooks = load("[webhooks]\nallow = [\"10.0.0.0/8\"]\nfirst_retry_s = 0.5", &[], &[]).unwrap().config.webhooks;
    assert_eq!(webhooks.timing().first_pause, Duration::from_millis(500));
    let reaches =
        |webhooks: &Webhooks, url: &str| webhooks.policy().unwrap().check_literal(&url.parse().unwrap()).is_ok();
    assert!(reaches(&webhooks, "http://10.1.2.3/") && !reaches(&webhooks, "http://192.168.0.1/"));
    assert!(reaches(&Webhooks { allow_all: true, ..webhooks }, "http://192.168.0.1/"));
}

#[test]
fn text_that_is_not_unicode_is_refused_where_it_matters() {
    #[cfg(unix)]
    {
        use std::os::unix::ffi::OsStringExt;
        let strange = std::ffi::OsString::from_vec(b"/data/\xff".to_vec());
        let environment = vec![("OTHER".to_owned(), strange.clone()), ("ADAPTARM_DATA".to_owned(), strange)];
        let told = Sources { environment, ..Sources::default() }.load().unwrap_err().to_string();
        assert_eq!(told, "variable ADAPTARM_DATA: data: found something that is not UTF-8, expected a text");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn whatever_stands_in_a_file_is_read_or_refused_in_one_line(
        text in prop_oneof![
            // Any text; a line of our own with any value; the example with something cut out of it.
            "\\PC{0,60}",
            ("(bind|database|results|threads|limits|log\\.filter|queue\\.lease_s|webhooks\\.allow)", "\\PC{0,30}")
                .prop_map(|(key, value)| format!("{key} = {value}")),
            (any::<prop::sample::Index>(), 0..40_usize).prop_map(|(at, length)| {
                let characters: Vec<_> = example().chars().collect();
                let at = at.index(characters.len());
                characters.iter().take(at).chain(characters.iter().skip(at + length)).collect()
            }),
            "\"[^\"]{1,10}\" = 1",
        ]
    ) {
        if let Err(message) = load(&text, &[], &[]) {
            prop_assert!(!message.is_empty() && !message.contains('\n'), "{text:?}: {message:?}");
        }
    }
}
