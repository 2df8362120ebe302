//! `adaptarm gc`: forgets what is older than the settings say.

use super::Failure;
use super::options::StorageOptions;
use crate::jobs::collect_garbage;
use crate::laboratory::Laboratory;
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
