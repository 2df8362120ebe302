//! The page's files, and the list of them that lets browsers keep the page.

use crate::support::App;
use serde_json::Value;
use sha2::{Digest, Sha256};
use std::collections::BTreeSet;
use std::path::Path;

/// Paths of all files below a folder, as a browser asks for them.
fn files_below(folder: &Path, prefix: &str, found: &mut BTreeSet<String>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = format!("{prefix}{}", path.file_name().unwrap().to_str().unwrap());
        if path.is_dir() {
            files_below(&path, &format!("{name}/"), found);
        } else {
            found.insert(name);
        }
    }
}

#[tokio::test]
async fn every_file_of_the_page_is_listed_with_the_hash_of_what_is_served() {
    let app = App::new().await;
    let answer = app.get("/files.json").await;
    assert_eq!((answer.header("content-type"), answer.header("cache-control")), ("application/json", "no-cache"));
    let list = answer.json();
    let listed = list["files"].as_object().unwrap();
    let mut present = BTreeSet::new();
    files_below(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../static"), "", &mut present);
    assert!(present.contains("index.html") && present.contains("js/worker.js"), "{present:?}");
    let before = present.len();
    present.retain(|path| !path.starts_with("exercises/"));
    assert!(present.len() < before, "there are exercises");
    assert_eq!(listed.keys().cloned().collect::<BTreeSet<_>>(), present);

    let mut version = Sha256::new();
    for (path, hash) in listed {
        let file = app.get(&format!("/{path}")).await;
        assert_eq!(file.status, 200, "{path}");
        assert_eq!(hash, &Value::from(hex::encode(Sha256::digest(&file.body))), "{path}");
        version.update(format!("{path}\n{}\n", hash.as_str().unwrap()));
    }
    assert_eq!(list["version"], hex::encode(version.finalize()), "a version is exactly its files");

    let tag = answer.header("etag");
    let known = app.ask("GET", "/files.json", &[("if-none-match", tag)]).await;
    assert_eq!((known.status.as_u16(), known.body.len(), known.header("etag")), (304, 0, tag));
}

#[tokio::test]
async fn exercises_with_their_solutions_are_not_served() {
    let app = App::new().await;
    for path in [
        "/exercises/pendulum-gravity.toml",
        "/exercises/",
        "/exercises",
        "/./exercises/pendulum-gravity.toml",
        "/js/../exercises/pendulum-gravity.toml",
        "/exercises%2Fpendulum-gravity.toml",
        "//exercises/pendulum-gravity.toml",
    ] {
        let answer = app.get(path).await;
        assert!(answer.status.as_u16() >= 400, "{path}: {}", answer.status);
        assert!(!String::from_utf8_lossy(&answer.body).contains("solutions"), "{path}");
    }
}

#[tokio::test]
async fn the_manifest_names_files_that_are_there() {
    let app = App::new().await;
    let answer = app.get("/manifest.webmanifest").await;
    assert_eq!(answer.header("content-type"), "application/manifest+json");
    let manifest = answer.json();
    let icons = manifest["icons"].as_array().unwrap();
    assert!(icons.iter().any(|icon| icon["purpose"] == "maskable"), "{icons:?}");
    for icon in icons {
        let path = icon["src"].as_str().unwrap();
        let file = app.get(&format!("/{path}")).await;
        assert_eq!(
            (file.status.as_u16(), file.header("content-type")),
            (200, icon["type"].as_str().unwrap()),
            "{path}"
        );
    }
}
