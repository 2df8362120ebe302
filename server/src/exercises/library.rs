//! All exercises by identifier: those that come with the program, then a folder's.

use super::read::{ExerciseError, parse, read};
use adaptarm_core::exercises::Exercise;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// A file that comes with the program, with its name.
macro_rules! shipped {
    ($($id:literal),* $(,)?) => {
        &[$((concat!($id, ".toml"), include_str!(concat!("../../../static/exercises/", $id, ".toml"))),)*]
    };
}

/// All of them, in the order of a course.
const SHIPPED: &[(&str, &str)] = shipped![
    "pendulum-gravity",
    "integral-action",
    "slotine-li-two-link",
    "role-of-gains",
    "persistent-excitation",
    "observer-noise",
    "no-velocity-sensor",
    "payload-change",
    "sampled-control",
    "beat-the-paper",
    "find-the-misprint",
];

/// Most files of a folder.
const MOST_FILES: usize = 1000;

/// Why a library cannot be opened.
#[derive(Debug, Error)]
pub enum LibraryError {
    /// A file is no exercise.
    #[error("{file}: {error}")]
    Exercise {
        /// Which.
        file: String,
        /// Why.
        error: ExerciseError,
    },
    /// Two exercises are called the same.
    #[error("{file}: its id {id:?} is that of another exercise")]
    Twice {
        /// The second one's file.
        file: String,
        /// Their name.
        id: String,
    },
    /// The folder cannot be listed.
    #[error("{folder}: cannot list it: {error}")]
    Folder {
        /// Which.
        folder: String,
        /// Why.
        error: std::io::Error,
    },
    /// Too many files.
    #[error("{folder}: has more than {MOST_FILES} exercises")]
    TooMany {
        /// Which.
        folder: String,
    },
}

/// Exercises by identifier.
#[derive(Debug, Default)]
pub struct Library {
    exercises: BTreeMap<String, Exercise>,
    /// Identifiers in the order of a course.
    order: Vec<String>,
}

impl Library {
    /// The program's own.
    pub fn shipped() -> Result<Self, LibraryError> {
        let mut library = Self::default();
        for (file, text) in SHIPPED {
            library.insert((*file).to_owned(), parse(text))?;
        }
        Ok(library)
    }

    /// The program's own and those of a folder: every file there whose name ends in `.toml`, by name.
    pub fn with_folder(folder: &Path) -> Result<Self, LibraryError> {
        let name = folder.display().to_string();
        let failed = |error| LibraryError::Folder { folder: name.clone(), error };
        let mut files: Vec<PathBuf> = Vec::new();
        for entry in std::fs::read_dir(folder).map_err(failed)? {
            let path = entry.map_err(failed)?.path();
            if path.extension().is_some_and(|end| end == "toml") {
                files.push(path);
            }
            if files.len() > MOST_FILES {
                return Err(LibraryError::TooMany { folder: name.clone() });
            }
        }
        files.sort();
        let mut library = Self::shipped()?;
        for path in files {
            library.insert(path.display().to_string(), read(&path))?;
        }
        Ok(library)
    }

    fn insert(&mut self, file: String, exercise: Result<Exercise, ExerciseError>) -> Result<(), LibraryError> {
        let exercise = exercise.map_err(|error| LibraryError::Exercise { file: file.clone(), error })?;
        let id = exercise.document().id.clone();
        if self.exercises.contains_key(&id) {
            return Err(LibraryError::Twice { file, id });
        }
        self.order.push(id.clone());
        self.exercises.insert(id, exercise);
        Ok(())
    }

    /// The exercise called so.
    pub fn get(&self, id: &str) -> Option<&Exercise> {
        self.exercises.get(id)
    }

    /// All, in the order of a course.
    pub fn iter(&self) -> impl Iterator<Item = &Exercise> {
        self.order.iter().filter_map(|id| self.exercises.get(id))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exercises::lint;

    #[test]
    fn every_shipped_file_is_listed_called_as_its_exercise_and_fit_for_a_class() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../static/exercises");
        let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
        let mut files: Vec<_> = files.collect();
        files.sort();
        let mut listed: Vec<_> = SHIPPED.iter().map(|(file, _)| (*file).to_owned()).collect();
        listed.sort();
        assert_eq!(files, listed);
        let library = Library::shipped().unwrap();
        assert!(library.iter().count() >= 10);
        for (exercise, (file, _)) in library.iter().zip(SHIPPED) {
            assert_eq!(format!("{}.toml", exercise.document().id), *file);
            assert_eq!(lint(exercise), Vec::<String>::new(), "{file}");
        }
    }

    #[test]
    fn a_folder_adds_exercises_and_replaces_none() {
        let folder = tempfile::tempdir().unwrap();
        let text = SHIPPED[0].1;
        std::fs::write(folder.path().join("mine.toml"), text.replace("id = \"pendulum-gravity\"", "id = \"mine\""))
            .unwrap();
        std::fs::write(folder.path().join("notes.txt"), "no exercise").unwrap();
        let library = Library::with_folder(folder.path()).unwrap();
        assert_eq!(library.iter().count(), SHIPPED.len() + 1);
        assert!(library.get("mine").is_some());
        std::fs::write(folder.path().join("twice.toml"), text).unwrap();
        let error = Library::with_folder(folder.path()).unwrap_err().to_string();
        assert!(error.contains("twice.toml: its id \"pendulum-gravity\" is that of another exercise"), "{error}");
    }
}
