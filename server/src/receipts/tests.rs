//! Receipts stand for what was graded and nothing else.

use super::{Forgery, Nonce, Receipt, ReceiptKey, RerunError, Reveal, Statement, rerun};
use crate::exercises::{Library, reports};
use adaptarm_core::exercises::{Exercise, Visibility};
use jiff::Timestamp;
use std::os::unix::fs::PermissionsExt;

const SEED: u64 = 8_123_456_789;

fn exercise() -> Exercise {
    Library::shipped().unwrap().get("pendulum-gravity").unwrap().clone()
}

fn receipt(key: &ReceiptKey, nonce: &Nonce) -> Receipt {
    let exercise = exercise();
    let gains = exercise.start();
    let reports = reports(&exercise, &gains, SEED, Visibility::Hidden).unwrap();
    let grade = exercise.grade(&gains, SEED, Visibility::Hidden, &reports).unwrap();
    let statement = Statement::new("attempt-1".to_owned(), Timestamp::UNIX_EPOCH, gains, &grade, SEED, nonce);
    Receipt::sign(statement, key)
}

fn key() -> (tempfile::TempDir, ReceiptKey) {
    let folder = tempfile::tempdir().unwrap();
    let key = ReceiptKey::open(folder.path()).unwrap();
    (folder, key)
}

#[test]
fn a_receipt_survives_json_and_runs_again_to_the_same_bits() {
    let ((_folder, key), nonce) = (key(), Nonce::random().unwrap());
    let receipt = receipt(&key, &nonce);
    let again: Receipt = serde_json::from_str(&serde_json::to_string_pretty(&receipt).unwrap()).unwrap();
    assert_eq!(again, receipt);
    assert_eq!(again.verify(Some(&key.public())), Ok(()));
    let exercise = exercise();
    let reveal = Reveal::new(SEED, nonce.clone(), Some(&exercise));
    let reveal: Reveal = serde_json::from_str(&serde_json::to_string(&reveal).unwrap()).unwrap();
    let revealed = Exercise::new(reveal.exercise.clone().unwrap()).unwrap();
    assert!(revealed.document().solutions.is_empty() && revealed.document().teacher_note.is_none());
    assert_eq!(rerun(&again, &reveal, &revealed).unwrap().trajectories, 5);
    let other = Reveal::new(SEED + 1, nonce, None);
    assert!(matches!(rerun(&again, &other, &exercise), Err(RerunError::Seed)));
    let guessed = Reveal::new(SEED, Nonce::random().unwrap(), None);
    assert!(matches!(rerun(&again, &guessed, &exercise), Err(RerunError::Seed)));
}

#[test]
fn nothing_in_a_receipt_can_be_changed() {
    let ((_folder, key), nonce) = (self::key(), Nonce::random().unwrap());
    let receipt = receipt(&key, &nonce);
    let changes: [&dyn Fn(&mut Receipt); 7] = [
        &|receipt| receipt.statement.grade.score = 1.0,
        &|receipt| receipt.statement.grade.criteria[0].points += 0.01,
        &|receipt| receipt.statement.attempt.push('2'),
        &|receipt| *receipt.statement.gains.get_mut("k_p").unwrap() += 1e-12,
        &|receipt| receipt.statement.seed_commitment = nonce.commit_seed(1),
        &|receipt| receipt.signature.replace_range(..2, "00"),
        &|receipt| receipt.signature.truncate(12),
    ];
    for change in changes {
        let mut forged = receipt.clone();
        change(&mut forged);
        assert_eq!(forged.verify(None), Err(Forgery::Signature));
    }
    // Whoever signs anew has another key.
    let (_other_folder, mine) = self::key();
    let mut statement = receipt.statement.clone();
    statement.grade.score = 1.0;
    let forged = Receipt::sign(statement, &mine);
    assert_eq!(forged.verify(None), Ok(()));
    assert!(matches!(forged.verify(Some(&key.public())), Err(Forgery::OtherSigner { .. })));
    assert!(matches!(receipt.verify(Some("abc")), Err(Forgery::Key(_))));
}

#[test]
fn a_receipt_tells_nothing_about_hidden_variants() {
    let ((_folder, key), nonce) = (key(), Nonce::random().unwrap());
    let text = serde_json::to_string(&receipt(&key, &nonce)).unwrap();
    let exercise = exercise();
    let runs = exercise.runs(&exercise.start(), SEED, Visibility::Hidden).unwrap();
    for run in runs {
        assert!(!text.contains(&run.hash()));
        assert!(!text.contains(&run.run().report.trajectory_hash));
    }
    assert!(!text.contains(&SEED.to_string()) && !text.contains(&String::from(nonce.clone())));
    assert!(!format!("{nonce:?}").contains(&String::from(nonce)[..8]));
}

#[test]
fn the_key_is_made_once_and_kept_secret() {
    let (folder, key) = key();
    assert_eq!(ReceiptKey::open(folder.path()).unwrap().public(), key.public());
    let files: Vec<_> = std::fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().path()).collect();
    assert_eq!(files.len(), 1, "{files:?}");
    let mode = std::fs::metadata(&files[0]).unwrap().permissions().mode() & 0o777;
    assert_eq!(mode, 0o600);
    std::fs::set_permissions(&files[0], std::fs::Permissions::from_mode(0o644)).unwrap();
    let error = ReceiptKey::open(folder.path()).unwrap_err().to_string();
    assert!(error.contains("others can read it (mode 644)"), "{error}");
    std::fs::set_permissions(&files[0], std::fs::Permissions::from_mode(0o600)).unwrap();
    std::fs::write(&files[0], "no key").unwrap();
    assert!(ReceiptKey::open(folder.path()).unwrap_err().to_string().contains("64 hexadecimal digits"));
}
