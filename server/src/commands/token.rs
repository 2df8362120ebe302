//! `adaptarm token`: makes, lists and revokes the tokens by which a server on a public address knows its users.

use super::Failure;
use super::options::StorageOptions;
use crate::auth::{Owner, Token, TokenId};
use crate::jobs::{JobStore, StoredToken};
use crate::laboratory::open_tables;
use crate::stdout::print;
use clap::{Args, Subcommand};
use jiff::{SignedDuration, Timestamp};
use std::sync::Arc;

#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  adaptarm token create --owner ana --data runs
  adaptarm token create --owner grafana --scopes metrics:read --expires-days 365 --data runs
  curl -H \"Authorization: Bearer $(adaptarm token create --owner ana --data runs)\" http://server:8080/api/v1/jobs

A running server knows a new token at once, and a revoked one no more.")]
pub(super) struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Make a token and print it: this is the only time that it is shown.
    Create(Create),
    /// List all tokens, without their secrets.
    List {
        #[command(flatten)]
        storage: StorageOptions,
    },
    /// Make a token worthless, for ever.
    Revoke {
        /// Its identifier: the 12 digits after adaptarm_, or the first column of `adaptarm token list`.
        #[arg(value_name = "ID")]
        id: String,
        #[command(flatten)]
        storage: StorageOptions,
    },
}

#[derive(Debug, Args)]
struct Create {
    /// Whose jobs its requests see: 1 to 64 of A-Z a-z 0-9 . _ @ -
    #[arg(long, value_name = "NAME")]
    owner: String,
    /// A name for people, such as the machine it is used on.
    #[arg(long, value_name = "TEXT", default_value = "unnamed")]
    name: String,
    /// What it allows: some of jobs:read, jobs:write and metrics:read.
    #[arg(long, value_name = "LIST", default_value = "jobs:read,jobs:write")]
    scopes: String,
    /// After how many days it ends; without this, never.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=36_500))]
    expires_days: Option<u32>,
    #[command(flatten)]
    storage: StorageOptions,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    match &arguments.command {
        Command::Create(create) => run_create(create),
        Command::List { storage } => with_tables(storage, async |tables| {
            let tokens = tables.tokens().await.map_err(Failure::chain)?;
            Ok(print(&table(&tokens))?)
        }),
        Command::Revoke { id, storage } => {
            let id: TokenId = id.parse().map_err(Failure::input)?;
            with_tables(storage, async |tables| {
                if !tables.revoke_token(&id.to_string()).await.map_err(Failure::chain)? {
                    return Err(Failure::input(format!("there is no token {id}; `adaptarm token list` shows all")));
                }
                eprintln!("the token {id} is revoked");
                Ok(())
            })
        }
    }
}

fn run_create(Create { owner, name, scopes, expires_days, storage }: &Create) -> Result<(), Failure> {
    let now = Timestamp::now();
    let owner = Owner::new(owner).map_err(|error| Failure::input(format!("--owner: {error}")))?;
    let scopes = scopes.parse().map_err(|error| Failure::input(format!("--scopes: {error}")))?;
    let expires_at = expires_days.map(|days| now + SignedDuration::from_hours(24 * i64::from(days)));
    let (token, text) = Token::issue(owner, name, scopes, expires_at, now).map_err(Failure::input)?;
    with_tables(storage, async |tables| {
        tables.add_token(&StoredToken::from(&token)).await.map_err(Failure::chain)?;
        let Token { id, owner, scopes, .. } = &token;
        let ends = expires_at.map_or_else(|| "never ends".to_owned(), |at| format!("ends at {at}"));
        eprintln!("token {id} of {owner} for {scopes}; it {ends}. Its text follows and is not shown again.");
        Ok(print(&format!("{}\n", text.reveal()))?)
    })
}

/// Does something with the tables that a server may be using at the same time.
fn with_tables(
    storage: &StorageOptions,
    act: impl AsyncFnOnce(Arc<dyn JobStore>) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let config = storage.load(Vec::new())?.config;
    super::runtime()?.block_on(async { act(open_tables(&config).await.map_err(Failure::chain)?.jobs).await })
}

/// The tokens in columns.
fn table(tokens: &[StoredToken]) -> String {
    let now = Timestamp::now();
    let day = |at: Option<Timestamp>| at.map_or_else(|| "never".to_owned(), |at| at.strftime("%Y-%m-%d").to_string());
    let minute =
        |at: Option<Timestamp>| at.map_or_else(|| "never".to_owned(), |at| at.strftime("%Y-%m-%d %H:%M").to_string());
    let state = |token: &StoredToken| match (token.revoked_at, token.expires_at) {
        (Some(_), _) => "revoked",
        (None, Some(at)) if at <= now => "expired",
        _ => "good",
    };
    let head = ["ID", "STATE", "OWNER", "SCOPES", "CREATED", "EXPIRES", "LAST USED", "NAME"].map(str::to_owned);
    let rows = tokens.iter().map(|token| {
        [
            token.id.clone(),
            state(token).to_owned(),
            token.owner.clone(),
            token.scopes.clone(),
            day(Some(token.created_at)),
            day(token.expires_at),
            minute(token.last_used_at),
            token.name.clone(),
        ]
    });
    let rows: Vec<_> = std::iter::once(head).chain(rows).collect();
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let widths: [usize; 8] = std::array::from_fn(width);
    let line = |row: &[String; 8]| {
        let cells = row.iter().zip(widths).map(|(cell, width)| format!("{cell:width$}"));
        cells.collect::<Vec<_>>().join("  ").trim_end().to_owned() + "\n"
    };
    rows.iter().map(line).collect()
}
