//! `adaptarm teacher`: the way in for a teacher, for whoever can reach the server's data.

use super::Failure;
use super::options::StorageOptions;
use crate::classroom::model::Role;
use crate::classroom::{ClassroomStore, invite, secrets};
use crate::laboratory::{data_folder, open_tables};
use crate::stdout::print;
use clap::{Args, Subcommand};

#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  adaptarm teacher link --data runs
  adaptarm teacher link --data runs --login ana
  adaptarm teacher link --data runs --url https://lab.example.org")]
pub(super) struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Print a link: one that makes whoever opens it first a new teacher, once and within a day; or, with --login, a new
    /// personal link of a teacher who lost theirs, to the same classes. Give the server's own --data; it knows the link at once.
    Link {
        /// Login of the teacher who lost the way in. The old link is void then, and their sessions end.
        #[arg(long, value_name = "LOGIN")]
        login: Option<String>,
        /// Where people reach the server; without this, the setting classroom.public_url, or the address of `bind`.
        #[arg(long, value_name = "URL")]
        url: Option<String>,
        #[command(flatten)]
        storage: StorageOptions,
    },
}

pub(super) fn run(Arguments { command: Command::Link { login, url, storage } }: &Arguments) -> Result<(), Failure> {
    let flags = url.iter().map(|url| ("classroom.public_url", url.clone())).collect();
    let config = storage.load(flags)?.config;
    let base = config.classroom.public_url.clone().unwrap_or_else(|| format!("http://{}", config.bind));
    let base = base.trim_end_matches('/');
    let folder = data_folder(&config);
    if config.database.is_none() && !folder.is_dir() {
        // A link into a database that no server uses would let nobody in.
        let message = format!("--data: there is no folder {}; name the one that the server uses", folder.display());
        return Err(Failure::input(message));
    }
    super::runtime()?.block_on(async {
        let tables = open_tables(&config).await.map_err(Failure::chain)?;
        let link = if let Some(login) = login {
            way_back(&*tables.classroom, base, login).await?
        } else {
            let (link, ends) = invite(&*tables.classroom, base, true).await.map_err(Failure::chain)?;
            eprintln!("It makes a new teacher, once, until {ends}:");
            link
        };
        if url.is_none() && config.classroom.public_url.is_none() {
            eprintln!("(for a server at {base}; for another address give --url)");
        }
        Ok(print(&format!("{link}\n"))?)
    })
}

/// A new personal link of the teacher with this login; the old one is void.
async fn way_back(store: &dyn ClassroomStore, base: &str, login: &str) -> Result<String, Failure> {
    let found = store.person_by_login(login).await.map_err(Failure::chain)?;
    let teacher = found.filter(|person| person.role == Role::Teacher);
    let teacher = teacher.ok_or_else(|| Failure::input(format!("--login: there is no teacher {login:?}")))?;
    let key = secrets::fresh().map_err(Failure::system)?;
    store.set_key(teacher.id, &secrets::hash(&key), "").await.map_err(Failure::chain)?;
    eprintln!("The personal link of {}, in place of the one before:", teacher.name);
    Ok(secrets::link(base, &teacher, &key))
}
