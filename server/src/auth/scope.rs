//! What a token allows. No scope implies another.

use serde::Serialize;
use std::collections::BTreeSet;
use std::fmt;
use std::str::FromStr;
use thiserror::Error;

/// One kind of request.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub enum Scope {
    /// Read one's own jobs and their results.
    #[serde(rename = "jobs:read")]
    JobsRead,
    /// Start, cancel and delete one's own jobs.
    #[serde(rename = "jobs:write")]
    JobsWrite,
    /// Read the server's metrics.
    #[serde(rename = "metrics:read")]
    MetricsRead,
}

/// A list that is not one of scopes.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum ScopeError {
    /// A name without meaning.
    #[error("the scope {0:?} is not known; allowed: {all}", all = Scope::ALL.map(Scope::name).join(", "))]
    Unknown(String),
    /// A name that stands there twice.
    #[error("the scope {0} is named twice")]
    Twice(&'static str),
    /// Nothing.
    #[error("no scope is named; allowed: {}", Scope::ALL.map(Scope::name).join(", "))]
    None,
}

impl Scope {
    /// Every scope.
    pub const ALL: [Self; 3] = [Self::JobsRead, Self::JobsWrite, Self::MetricsRead];

    /// Its name on the command line and in storage.
    pub fn name(self) -> &'static str {
        match self {
            Self::JobsRead => "jobs:read",
            Self::JobsWrite => "jobs:write",
            Self::MetricsRead => "metrics:read",
        }
    }
}

impl FromStr for Scope {
    type Err = ScopeError;

    fn from_str(name: &str) -> Result<Self, ScopeError> {
        let found = Self::ALL.into_iter().find(|scope| scope.name() == name);
        found.ok_or_else(|| ScopeError::Unknown(name.chars().take(60).collect()))
    }
}

/// How a refused request could do better: the value of `WWW-Authenticate` (RFC 6750).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Challenge {
    /// With a token.
    Token,
    /// With another token.
    OtherToken,
    /// With a token of this scope.
    Scope(Scope),
}

impl fmt::Display for Challenge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Bearer realm=\"adaptarm\"")?;
        match self {
            Self::Token => Ok(()),
            Self::OtherToken => f.write_str(", error=\"invalid_token\""),
            Self::Scope(scope) => write!(f, ", error=\"insufficient_scope\", scope=\"{}\"", scope.name()),
        }
    }
}

/// Some scopes, at least one. Written `jobs:read,jobs:write`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(transparent)]
pub struct Scopes(BTreeSet<Scope>);

impl Scopes {
    /// Whether `scope` is among them.
    pub fn allow(&self, scope: Scope) -> bool {
        self.0.contains(&scope)
    }
}

impl FromStr for Scopes {
    type Err = ScopeError;

    fn from_str(list: &str) -> Result<Self, ScopeError> {
        if list.trim().is_empty() {
            return Err(ScopeError::None);
        }
        let mut scopes = BTreeSet::new();
        for name in list.split(',') {
            let scope: Scope = name.trim().parse()?;
            if !scopes.insert(scope) {
                return Err(ScopeError::Twice(scope.name()));
            }
        }
        Ok(Self(scopes))
    }
}

impl fmt::Display for Scopes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names: Vec<_> = self.0.iter().map(|scope| scope.name()).collect();
        f.write_str(&names.join(","))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_read_back_as_they_were_written() {
        for (list, written) in [
            ("jobs:read", "jobs:read"),
            ("metrics:read, jobs:write", "jobs:write,metrics:read"),
            ("jobs:write,metrics:read,jobs:read", "jobs:read,jobs:write,metrics:read"),
        ] {
            let scopes: Scopes = list.parse().unwrap();
            assert_eq!(scopes.to_string(), written);
            assert_eq!(written.parse(), Ok(scopes));
        }
    }

    #[test]
    fn writing_does_not_imply_reading() {
        let scopes: Scopes = "jobs:write".parse().unwrap();
        assert_eq!(Scope::ALL.map(|scope| scopes.allow(scope)), [false, true, false]);
    }

    #[test]
    fn wrong_lists_are_refused() {
        let read = |list: &str| list.parse::<Scopes>();
        assert_eq!(read(" "), Err(ScopeError::None));
        assert_eq!(read("jobs:read,jobs:read"), Err(ScopeError::Twice("jobs:read")));
        for (list, name) in [("jobs", "jobs"), ("jobs:read,", ""), ("Jobs:Read", "Jobs:Read"), ("*", "*")] {
            assert_eq!(read(list), Err(ScopeError::Unknown(name.to_owned())), "{list:?}");
        }
        assert_eq!(
            read("admin").unwrap_err().to_string(),
            "the scope \"admin\" is not known; allowed: jobs:read, jobs:write, metrics:read"
        );
    }

    #[test]
    fn json_uses_the_same_names() {
        let scopes: Scopes = Scope::ALL.map(Scope::name).join(",").parse().unwrap();
        assert_eq!(
            serde_json::to_value(&scopes).unwrap(),
            serde_json::json!(["jobs:read", "jobs:write", "metrics:read"])
        );
    }
}
