//! `adaptarm lti`: registers, lists and removes the learning platforms from which users come (`docs/lti.md`).

use super::Failure;
use super::options::StorageOptions;
use crate::laboratory::open_tables;
use crate::lti::{NewPlatform, Platform, caller};
use crate::stdout::print;
use clap::{Args, Subcommand};
use uuid::Uuid;

#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  adaptarm lti register --teacher ana --issuer https://moodle.example.org --client-id Ab12 --deployment 3 \\
      --auth-url https://moodle.example.org/mod/lti/auth.php --token-url https://moodle.example.org/mod/lti/token.php \\
      --keys-url https://moodle.example.org/mod/lti/certs.php --data runs
  adaptarm lti list --data runs
  adaptarm lti remove 0199f3a0-0000-7000-8000-000000000000 --data runs

A running server knows a new platform at once, and a removed one no more.")]
pub(super) struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Let a platform's users in.
    Register(Register),
    /// List all platforms.
    List {
        #[command(flatten)]
        storage: StorageOptions,
    },
    /// Let nobody in from a platform any more, and send no grades there; classes and marks stay.
    Remove {
        /// Its identifier: the first column of `adaptarm lti list`.
        #[arg(value_name = "ID")]
        id: Uuid,
        #[command(flatten)]
        storage: StorageOptions,
    },
}

#[derive(Debug, Args)]
struct Register {
    /// Login of the teacher whose registration it is.
    #[arg(long, value_name = "LOGIN")]
    teacher: String,
    /// What the platform calls itself (platform ID, issuer).
    #[arg(long, value_name = "URL")]
    issuer: String,
    /// What the platform calls this tool (client ID).
    #[arg(long, value_name = "TEXT")]
    client_id: String,
    /// Where the platform answers logins (authentication request URL, authorization endpoint).
    #[arg(long, value_name = "URL")]
    auth_url: String,
    /// Where it gives out access tokens (access token URL).
    #[arg(long, value_name = "URL")]
    token_url: String,
    /// Where its public keys are (public keyset URL, JWKS).
    #[arg(long, value_name = "URL")]
    keys_url: String,
    /// A deployment from which launches are taken (deployment ID); several may be named.
    #[arg(long = "deployment", value_name = "TEXT", required = true)]
    deployments: Vec<String>,
    #[command(flatten)]
    storage: StorageOptions,
}

pub(super) fn run(arguments: Arguments) -> Result<(), Failure> {
    super::runtime()?.block_on(async {
        match arguments.command {
            Command::Register(asked) => register(asked).await,
            Command::List { storage } => {
                let tables = open_tables(&storage.load(Vec::new())?.config).await.map_err(Failure::chain)?;
                let platforms = tables.lti.platforms().await.map_err(Failure::chain)?;
                Ok(print(&platforms.iter().map(line).collect::<String>())?)
            }
            Command::Remove { id, storage } => {
                let tables = open_tables(&storage.load(Vec::new())?.config).await.map_err(Failure::chain)?;
                if !tables.lti.remove_platform(id, None).await.map_err(Failure::chain)? {
                    return Err(Failure::input(format!("there is no platform {id}; `adaptarm lti list` shows all")));
                }
                eprintln!("the platform {id} is removed");
                Ok(())
            }
        }
    })
}

async fn register(asked: Register) -> Result<(), Failure> {
    let Register { teacher, issuer, client_id, auth_url, token_url, keys_url, deployments, storage } = asked;
    let config = storage.load(Vec::new())?.config;
    let tables = open_tables(&config).await.map_err(Failure::chain)?;
    let found = tables.classroom.person_by_login(&teacher).await.map_err(Failure::chain)?;
    let found = found.filter(|person| person.role == crate::classroom::model::Role::Teacher);
    let found = found.ok_or_else(|| Failure::input(format!("--teacher: there is no teacher {teacher:?}")))?;
    let new = NewPlatform { issuer, client_id, auth_url, token_url, keys_url, deployments };
    let platform = new.check(found.id, &caller(&config).map_err(Failure::chain)?).map_err(Failure::input)?;
    if !tables.lti.add_platform(&platform).await.map_err(Failure::chain)? {
        let Platform { issuer, client_id, .. } = &platform;
        return Err(Failure::input(format!("{issuer} with the client ID {client_id:?} is registered already")));
    }
    Ok(print(&format!("{}\n", platform.id))?)
}

/// A platform on a line.
fn line(platform: &Platform) -> String {
    let Platform { id, issuer, client_id, deployments, .. } = platform;
    format!("{id}  {issuer}  client {client_id}  deployments {}\n", deployments.join(", "))
}
