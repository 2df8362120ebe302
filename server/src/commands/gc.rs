//! `adaptarm gc`: forgets what is older than the settings say.

use super::Failure;
use super::options::StorageOptions;
use crate::jobs::collect_garbage;
use crate::laboratory::{Laboratory, data_folder};
use crate::stdout::print;
use clap::Args;

#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  adaptarm gc --data runs
  adaptarm gc --database postgres://adaptarm@db/adaptarm --results /shared/results

How long jobs and results are kept is set by [retention] in the settings' file. A server does this by itself once an
hour; with a data folder, stop the server first.")]
pub(super) struct Arguments {
    #[command(flatten)]
    storage: StorageOptions,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let config = arguments.storage.load(Vec::new())?.config;
    if config.database.is_none() && !data_folder(&config).join("adaptarm.sqlite3").is_file() {
        let data = data_folder(&config);
        return Err(Failure::input(format!(
            "--data {}: there is no database of adaptarm in this folder",
            data.display()
        )));
    }
    if config.database.is_some() && config.results.is_none() {
        return Err(Failure::input("with --database, name by --results where its results are"));
    }
    super::runtime()?.block_on(async {
        let laboratory = Laboratory::open(&config).await.map_err(Failure::chain)?;
        let Laboratory { store, queue, results, .. } = &laboratory;
        let forgotten =
            collect_garbage(&**store, &**queue, results, &config.retention).await.map_err(Failure::chain)?;
        let (jobs, results, checkpoints) = (forgotten.jobs, forgotten.results, forgotten.checkpoints);
        print(&format!("forgotten: {jobs} jobs, {results} results, {checkpoints} checkpoints\n"))?;
        Ok(())
    })
}
