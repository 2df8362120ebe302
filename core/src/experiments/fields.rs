//! Fields of a scenario by JSON pointer: any number of the filled-in document can be read and replaced.
//!
//! Works on the document as a generic tree and knows none of its fields: what is added to scenarios can vary at once.

use super::limits::{EXPERIMENT_LIMITS, conflict, unknown};
use crate::scenario::{Problem, Scenario, ScenarioDocument, ScenarioError};
use ciborium::Value;

/// A scenario as a tree.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Tree(Value);

/// What becomes of a number.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Change {
    /// JSON pointer without `*`.
    pub pointer: String,
    /// Whether the value is a factor.
    pub relative: bool,
}

impl Tree {
    /// Of a scenario with everything filled in.
    pub fn of(scenario: &Scenario) -> Self {
        match Value::serialized(scenario.document()) {
            Ok(value) => Self(value),
            Err(error) => unreachable!("a scenario document always encodes: {error}"),
        }
    }

    /// The pointers that one with `*` at its end stands for; `at` is where it is written.
    pub fn expand(&self, pointer: &str, at: &str) -> Result<Vec<String>, ScenarioError> {
        let Some(list) = pointer.strip_suffix("/*") else {
            self.number(pointer, at)?;
            return Ok(vec![pointer.to_owned()]);
        };
        let Some(Value::Array(elements)) = find(&self.0, list) else {
            return Err(unknown(at, pointer, "a list of the base scenario, followed by /*".to_owned()));
        };
        if elements.len() > EXPERIMENT_LIMITS.fields {
            let (found, most) = (elements.len(), EXPERIMENT_LIMITS.fields);
            return Err(ScenarioError::new(at, Problem::TooMany { found, most, what: "fields that vary" }));
        }
        let pointers: Vec<_> = (0..elements.len()).map(|n| format!("{list}/{n}")).collect();
        pointers.iter().try_for_each(|pointer| self.number(pointer, at).map(drop))?;
        Ok(pointers)
    }

    /// The number at `pointer`; `at` is where the pointer is written.
    pub fn number(&self, pointer: &str, at: &str) -> Result<f64, ScenarioError> {
        let found = find(&self.0, pointer).and_then(|value| match value {
            Value::Float(number) => Some(*number),
            Value::Integer(number) => Some(i128::from(*number) as f64),
            _ => None,
        });
        let allowed = "a JSON pointer to a number that the filled-in base scenario has, such as /plant/theta_scale/3 (a \
                       field that is off by default must stand in the base)";
        found.ok_or_else(|| unknown(at, pointer, allowed.to_owned()))
    }

    /// Replaces the number that a change names; an error is about the scenario.
    pub fn apply(&mut self, change: &Change, value: f64) -> Result<(), ScenarioError> {
        let value = if change.relative { value * self.number(&change.pointer, &change.pointer)? } else { value };
        match find_mut(&mut self.0, &change.pointer) {
            Some(Value::Float(number)) => *number = value,
            Some(Value::Integer(number)) => {
                // The largest whole number below which every one is a double.
                const EXACT: f64 = 9_007_199_254_740_992.0;
                if value.trunc() != value || !(0.0..=EXACT).contains(&value) {
                    let message = format!("{value} is not a whole number from 0 to {EXACT}");
                    return Err(conflict(change.pointer.clone(), message));
                }
                *number = (value as u64).into();
            }
            _ => return Err(unknown(change.pointer.clone(), &change.pointer, "a number".to_owned())),
        }
        Ok(())
    }

    /// Replaces the seed of a run's own noise.
    pub fn set_seed(&mut self, seed: u64) {
        if let Some(value) = find_mut(&mut self.0, "/seed") {
            *value = Value::Integer(seed.into());
        }
    }

    /// The scenario that this tree is.
    pub fn scenario(&self) -> Result<Scenario, ScenarioError> {
        let document: ScenarioDocument = self
            .0
            .deserialized()
            .map_err(|error| ScenarioError::new("", Problem::Malformed { message: error.to_string() }))?;
        Scenario::new(document)
    }
}

/// The parts of a pointer. Source: RFC 6901.
fn parts(pointer: &str) -> Option<impl Iterator<Item = String>> {
    let rest = pointer.strip_prefix('/')?;
    Some(rest.split('/').map(|part| part.replace("~1", "/").replace("~0", "~")))
}

/// Place in a list: digits only.
fn place(part: &str) -> Option<usize> {
    if part.bytes().all(|byte| byte.is_ascii_digit()) { part.parse().ok() } else { None }
}

fn find<'a>(root: &'a Value, pointer: &str) -> Option<&'a Value> {
    parts(pointer)?.try_fold(root, |value, part| match value {
        Value::Map(entries) => entries.iter().find(|(name, _)| name.as_text() == Some(&part)).map(|(_, value)| value),
        Value::Array(elements) => elements.get(place(&part)?),
        _ => None,
    })
}

fn find_mut<'a>(root: &'a mut Value, pointer: &str) -> Option<&'a mut Value> {
    parts(pointer)?.try_fold(root, |value, part| match value {
        Value::Map(entries) => {
            entries.iter_mut().find(|(name, _)| name.as_text() == Some(&part)).map(|(_, value)| value)
        }
        Value::Array(elements) => elements.get_mut(place(&part)?),
        _ => None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::Scheme;

    fn base() -> (Scenario, Tree) {
        let scenario = Scenario::new(Scheme::Proposed.paper()).unwrap();
        let tree = Tree::of(&scenario);
        (scenario, tree)
    }

    fn change(pointer: &str, relative: bool) -> Change {
        Change { pointer: pointer.to_owned(), relative }
    }

    #[test]
    fn a_tree_is_its_scenario() {
        let (scenario, tree) = base();
        assert_eq!(tree.scenario().unwrap().hash(), scenario.hash());
    }

    #[test]
    fn one_number_changes_and_nothing_else() {
        let (scenario, mut tree) = base();
        tree.apply(&change("/plant/theta_scale/3", false), 1.25).unwrap();
        tree.apply(&change("/scheme/gains/k_v/0", true), 2.0).unwrap();
        tree.apply(&change("/recording/samples", false), 100.0).unwrap();
        let mut document = scenario.document().clone();
        document.plant.theta_scale.as_mut().unwrap()[3] = 1.25;
        document.recording.samples = 100;
        if let crate::scenario::SchemeDocument::Proposed(Some(gains)) = &mut document.scheme {
            gains.k_v[0] *= 2.0;
        }
        assert_eq!(tree.scenario().unwrap().document(), &document);
    }

    #[test]
    fn what_is_no_number_is_refused() {
        let (_, mut tree) = base();
        for pointer in
            ["", "/", "plant", "/robot", "/plant/theta_scale", "/plant/theta_scale/18", "/plant/theta_scale/+1"]
        {
            assert!(tree.expand(pointer, "/at").is_err(), "{pointer}");
        }
        assert_eq!(tree.expand("/plant/theta_scale/*", "/at").unwrap().len(), 18);
        let error = tree.apply(&change("/recording/samples", false), 1.5).unwrap_err();
        assert_eq!(error.to_string(), "recording.samples: 1.5 is not a whole number from 0 to 9007199254740992");
        tree.apply(&change("/integration/step_s", false), -1.0).unwrap();
        assert!(tree.scenario().unwrap_err().to_string().contains("-1 is outside the allowed range"));
    }
}
