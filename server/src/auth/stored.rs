//! Tokens as the tables hold them.

use super::{Owner, Token};
use crate::jobs::{StoreError, StoredToken};

impl From<&Token> for StoredToken {
    fn from(token: &Token) -> Self {
        Self {
            id: token.id.to_string(),
            owner: token.owner.to_string(),
            name: token.name.clone(),
            scopes: token.scopes.to_string(),
            secret_hash: token.secret_hash.to_string(),
            created_at: token.created_at,
            expires_at: token.expires_at,
            revoked_at: token.revoked_at,
            last_used_at: None,
        }
    }
}

impl TryFrom<StoredToken> for Token {
    type Error = StoreError;

    fn try_from(stored: StoredToken) -> Result<Self, StoreError> {
        let damaged =
            |what: &str| StoreError::Damaged(format!("a token, {:?}, whose {what} cannot be read", stored.id));
        Ok(Self {
            id: stored.id.parse().map_err(|_| damaged("identifier"))?,
            owner: Owner::stored(&stored.owner).map_err(|_| damaged("owner"))?,
            scopes: stored.scopes.parse().map_err(|_| damaged("list of scopes"))?,
            secret_hash: stored.secret_hash.parse().map_err(|_| damaged("hash"))?,
            name: stored.name,
            created_at: stored.created_at,
            expires_at: stored.expires_at,
            revoked_at: stored.revoked_at,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use jiff::Timestamp;

    #[test]
    fn a_token_comes_back_as_it_was_stored_and_a_damaged_one_does_not() {
        let (owner, scopes) = (Owner::new("ana").unwrap(), "jobs:read,metrics:read".parse().unwrap());
        let (token, _) = Token::issue(owner, "laptop", scopes, None, Timestamp::now()).unwrap();
        let stored = StoredToken::from(&token);
        assert_eq!(Token::try_from(stored.clone()).unwrap(), token);
        for damaged in [
            StoredToken { id: "x".to_owned(), ..stored.clone() },
            StoredToken { owner: "a b".to_owned(), ..stored.clone() },
            StoredToken { scopes: "all".to_owned(), ..stored.clone() },
            StoredToken { secret_hash: "0".to_owned(), ..stored.clone() },
        ] {
            assert!(matches!(Token::try_from(damaged), Err(StoreError::Damaged(_))));
        }
    }
}
