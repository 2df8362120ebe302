//! The exercises that can be given out: those of this program, and a teacher's own from a folder.

use adaptarm_core::exercises::Exercise;
use anyhow::{Context, bail};
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

/// Exercises by their identifiers.
#[derive(Debug, Clone, Default)]
pub struct Library {
    exercises: BTreeMap<String, Arc<Exercise>>,
}

impl Library {
    /// With everything from this folder, which must be exercises: one JSON document per file.
    pub fn with_folder(mut self, folder: &Path) -> anyhow::Result<Self> {
        let listed = std::fs::read_dir(folder).with_context(|| format!("cannot read {}", folder.display()))?;
        for entry in listed {
            let path = entry?.path();
            if path.extension().is_none_or(|extension| extension != "json") {
                continue;
            }
            let told = || path.display().to_string();
            let bytes = crate::document::read_file(&path).with_context(told)?;
            let exercise = Exercise::new(crate::document::parse(&bytes).with_context(told)?).with_context(told)?;
            let id = exercise.document().id.clone();
            if self.exercises.insert(id.clone(), Arc::new(exercise)).is_some() {
                bail!("{}: there is an exercise {id:?} already", path.display());
            }
        }
        Ok(self)
    }

    /// All of them, by their identifiers.
    pub fn all(&self) -> impl Iterator<Item = &Exercise> {
        self.exercises.values().map(AsRef::as_ref)
    }

    /// The exercise of this identifier.
    pub fn get(&self, id: &str) -> Option<&Exercise> {
        self.exercises.get(id).map(AsRef::as_ref)
    }

    /// Their identifiers, for whoever asked for another.
    pub fn ids(&self) -> String {
        self.exercises.keys().map(String::as_str).collect::<Vec<_>>().join(", ")
    }
}
