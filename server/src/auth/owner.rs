//! Whose a job or a token is.

use serde::Serialize;
use std::fmt;
use thiserror::Error;

/// Longest name, characters.
const LONGEST: usize = 64;

/// The owner of everything asked for without a token, on a server that only its own machine reaches.
const LOCAL: &str = "local";

/// Names that nobody can be given, in any spelling of upper and lower case.
const RESERVED: [&str; 3] = [LOCAL, "anonymous", "system"];

/// An owner's name. Upper and lower case differ.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(transparent)]
pub struct Owner(String);

/// A name that no owner can have.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum OwnerError {
    /// Empty or too long.
    #[error("an owner's name has 1 to {LONGEST} characters; this one has {0}")]
    Length(usize),
    /// A character that is not allowed.
    #[error("an owner's name is made of A-Z a-z 0-9 . _ @ -; {0:?} is not among them")]
    Character(char),
    /// A name that the server keeps for itself.
    #[error("the owner's name {0:?} is reserved; not allowed: {all}", all = RESERVED.join(", "))]
    Reserved(String),
}

impl Owner {
    /// An owner named by someone outside.
    pub fn new(name: &str) -> Result<Self, OwnerError> {
        if RESERVED.iter().any(|reserved| reserved.eq_ignore_ascii_case(name)) {
            return Err(OwnerError::Reserved(name.to_owned()));
        }
        Self::stored(name)
    }

    /// An owner read back from storage, who may be the server's own.
    pub fn stored(name: &str) -> Result<Self, OwnerError> {
        let chars = name.chars().count();
        if !(1..=LONGEST).contains(&chars) {
            return Err(OwnerError::Length(chars));
        }
        match name.chars().find(|c| !c.is_ascii_alphanumeric() && !"._@-".contains(*c)) {
            Some(c) => Err(OwnerError::Character(c)),
            None => Ok(Self(name.to_owned())),
        }
    }

    /// Whoever uses this machine.
    pub fn local() -> Self {
        Self(LOCAL.to_owned())
    }

    /// The name.
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

impl fmt::Display for Owner {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_have_a_length_and_an_alphabet() {
        for name in ["a", "ana.diaz@example.org", "Lab-2_b", "locals", &"x".repeat(64)] {
            assert_eq!(Owner::new(name).unwrap().as_str(), name);
        }
        assert_eq!(Owner::new(""), Err(OwnerError::Length(0)));
        assert_eq!(Owner::new(&"x".repeat(65)), Err(OwnerError::Length(65)));
        for (name, wrong) in [("a b", ' '), ("a/b", '/'), ("José", 'é'), ("a\n", '\n'), ("a\0", '\0'), ("a'--", '\'')]
        {
            assert_eq!(Owner::new(name), Err(OwnerError::Character(wrong)), "{name:?}");
        }
    }

    #[test]
    fn nobody_outside_gets_a_reserved_name() {
        for name in ["local", "Local", "LOCAL", "system", "anonymous"] {
            assert_eq!(Owner::new(name), Err(OwnerError::Reserved(name.to_owned())));
        }
        assert_eq!(Owner::stored("local"), Ok(Owner::local()));
        assert_eq!(Owner::stored("a b"), Err(OwnerError::Character(' ')));
    }
}
