//! SIGKILL at random moments: what was accepted ends, once, with the result of a computation that nothing disturbed.

use crate::accounts::Batch;
use adaptarm_tests::workload::Workload;
use adaptarm_tests::{Launch, machine};
use anyhow::Result;
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use std::thread::sleep;
use std::time::Duration;

pub fn servers() -> Result<()> {
    let (jobs, kills, long_s) = if machine::soak() { (300, 5, 3000.0) } else { (60, 3, 300.0) };
    let work = Workload::new(1, long_s)?.mixed(jobs, 15);
    let mut server = Launch::new().serve()?;
    let url = server.url.clone();
    let mut random = StdRng::seed_from_u64(1);
    Batch::new(&url, &work).survive(8, |batch| {
        for kill in 0..kills {
            // Spread over the batch, and anywhere within a job.
            let moment = (f64::from(kill) + random.random_range(0.2..0.8)) / f64::from(kills);
            batch.reach(moment)?;
            sleep(Duration::from_millis(random.random_range(0..100)));
            server.restart()?;
        }
        Ok(())
    })
}
