//! Jobs whose results are known beforehand: the core, in this process and undisturbed, says what every trajectory hashes to.
//!
//! Every scenario carries a seed of its own. A seed changes the scenario's hash, so nothing is answered from stored
//! results, and not the trajectory, so each shape is computed here once.

use crate::client::Client;
use adaptarm_core::scenario::Scenario;
use anyhow::{Context, Result, ensure};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use serde_json::{Value, json};
use std::thread;

/// A scenario without seed, and what its trajectory hashes to.
#[derive(Debug)]
struct Shape {
    document: Value,
    hash: String,
}

/// A job to submit and what it must give.
#[derive(Debug, Clone)]
pub struct Work {
    /// Body of the request.
    pub body: Value,
    /// Its label; no two jobs of a workload have the same.
    pub label: String,
    /// Trajectory hashes of its scenarios, in their order.
    pub hashes: Vec<String>,
}

impl Work {
    /// Checks that the job succeeded with exactly the result that an undisturbed computation gives.
    pub fn check(&self, client: &Client, job: &Value) -> Result<()> {
        ensure!(job["state"] == "succeeded", "{}: {job}", self.label);
        ensure!(job["label"] == self.label.as_str(), "{}: {job}", self.label);
        let counts = (job["scenarios"].as_u64(), job["scenarios_done"].as_u64(), job["progress"].as_f64());
        let all = Some(self.hashes.len() as u64);
        ensure!(counts == (all, all, Some(1.0)), "{}: {job}", self.label);
        let result = client.result(job["id"].as_str().context("a job without an identifier")?)?;
        ensure!(result["complete"] == true, "{}: {result}", self.label);
        let reports = result["reports"].as_array().context("a result without reports")?;
        let hashes: Vec<_> =
            reports.iter().map(|report| report["trajectory_hash"].as_str().unwrap_or("none")).collect();
        ensure!(hashes == self.hashes, "{}: {hashes:?} instead of {:?}", self.label, self.hashes);
        Ok(())
    }
}

/// A source of jobs: the same seed gives the same ones.
#[derive(Debug)]
pub struct Workload {
    short: Vec<Shape>,
    long: Vec<Shape>,
    random: StdRng,
    seed: u64,
    scenarios: u64,
    jobs: u64,
}

impl Workload {
    /// A workload whose long jobs simulate `long_s` seconds.
    pub fn new(seed: u64, long_s: f64) -> Result<Self> {
        let kinds = ["proposed", "tang_arteaga", "slotine_li"];
        let mut short = Vec::new();
        for kind in kinds {
            short.push(scenario(kind, &json!({"duration_s": 0.5})));
            short.push(scenario(kind, &json!({"duration_s": 12})));
        }
        short.push(scenario("proposed", &json!({"duration_s": 2, "method": "dopri5", "step_s": 0.01})));
        // Diverges, which is a result like any other.
        short.push(scenario("slotine_li", &json!({"step_s": 0.1})));
        let long = kinds.iter().map(|kind| {
            let mut document = scenario(kind, &json!({"duration_s": long_s}));
            document["recording"] = json!({"samples": 60});
            document
        });
        let (short, long) = (computed(short)?, computed(long.collect())?);
        Ok(Self { short, long, random: StdRng::seed_from_u64(seed), seed, scenarios: 0, jobs: 0 })
    }

    /// Mixed jobs, mostly of one to eight short scenarios; one in `every` is a single long one.
    pub fn mixed(&mut self, count: usize, every: usize) -> Vec<Work> {
        (1..=count)
            .map(|n| {
                if n % every == 0 {
                    return self.long();
                }
                let scenarios = if self.random.random_bool(0.5) { 1 } else { self.random.random_range(2..=8) };
                self.study(scenarios)
            })
            .collect()
    }

    /// A job of this many short scenarios.
    pub fn study(&mut self, scenarios: usize) -> Work {
        let shapes = (0..scenarios).map(|_| self.random.random_range(0..self.short.len())).collect::<Vec<_>>();
        self.work(&shapes, false)
    }

    /// A job of the shortest scenario there is in here.
    pub fn smallest(&mut self) -> Work {
        self.work(&[0], false)
    }

    /// A job of one long scenario.
    pub fn long(&mut self) -> Work {
        let shape = self.random.random_range(0..self.long.len());
        self.work(&[shape], true)
    }

    /// A job of this many long scenarios: the shapes in turn, so that every such job is the same work.
    pub fn even(&mut self, scenarios: usize) -> Work {
        let shapes = (0..scenarios).map(|n| n % self.long.len()).collect::<Vec<_>>();
        self.work(&shapes, true)
    }

    fn work(&mut self, shapes: &[usize], long: bool) -> Work {
        let mut hashes = Vec::new();
        let mut scenarios = Vec::new();
        for shape in shapes {
            let shape = if long { &self.long[*shape] } else { &self.short[*shape] };
            let mut document = shape.document.clone();
            self.scenarios += 1;
            document["seed"] = json!((self.seed << 24) + self.scenarios);
            scenarios.push(document);
            hashes.push(shape.hash.clone());
        }
        self.jobs += 1;
        let label = format!("work-{}-{}", self.seed, self.jobs);
        let body = json!({"kind": "study", "label": &label, "spec": {"scenarios": scenarios}});
        Work { body, label, hashes }
    }
}

/// A scenario of the paper's robot and gains, integrated like this.
pub fn scenario(kind: &str, integration: &Value) -> Value {
    json!({"format": "adaptarm.scenario/1", "scheme": {"kind": kind}, "integration": integration})
}

/// A study of these scenarios, as a request's body.
pub fn study(scenarios: &[Value]) -> Value {
    json!({"kind": "study", "spec": {"scenarios": scenarios}})
}

/// What the core says each of these gives, computed on all processors.
fn computed(documents: Vec<Value>) -> Result<Vec<Shape>> {
    thread::scope(|scope| {
        let threads: Vec<_> = documents
            .into_iter()
            .map(|document| {
                scope.spawn(move || {
                    let hash = Scenario::read(&document)?.run().report.trajectory_hash;
                    Ok(Shape { document, hash })
                })
            })
            .collect();
        threads.into_iter().map(|thread| thread.join().expect("the core does not panic")).collect()
    })
}
