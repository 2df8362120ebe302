//! Base against base under the same random numbers: paired differences, and a ranking with its uncertainty.
//!
//! Runs of one point and condition are a block. What diverged or never settled is worse than anything that did; blocks with a
//! refused run are left out.

use super::experiment::Experiment;
use super::layout::{Layout, Place};
use super::results::{ResultColumn, Results};
use super::row::RowOutcome;
use super::row_store::RowStoreError;
use super::statistics::{Share, Statistics, quantile, ranks};
use super::stream::{Purpose, Stream};
use serde::{Deserialize, Serialize};

/// Two bases under one condition.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PairSummary {
    /// Condition.
    pub condition: String,
    /// Metric over all joints.
    pub metric: String,
    /// One.
    pub a: String,
    /// The other.
    pub b: String,
    /// `a − b` where both have a number: its mean's interval is the paired t interval.
    pub difference: Option<Statistics>,
    /// Blocks in which `a` is better than `b`.
    pub a_better: Share,
    /// Blocks in which it is worse.
    pub b_better: Share,
}

/// A metric by which bases are ranked.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Ranking {
    /// Metric over all joints.
    pub metric: String,
    /// Blocks that it rests on.
    pub blocks: usize,
    /// What was resampled: `draw` or `condition`; nothing where there is only one of either.
    pub resampled: Option<String>,
    /// Bases, the best first.
    pub bases: Vec<Ranked>,
}

/// A base's place.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Ranked {
    /// Base.
    pub base: String,
    /// Mean of its ranks over all blocks; 1 is the best.
    pub mean_rank: f64,
    /// Bootstrap interval of it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub interval: Option<[f64; 2]>,
    /// Share of the resamples in which it is the best.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub best_share: Option<f64>,
}

/// Resamples, and most units drawn for one ranking.
const RESAMPLES: [usize; 2] = [200, 2000];
const MOST_DRAWN: usize = 10_000_000;

/// A block's numbers, infinite where there is none.
struct Block {
    point: u64,
    condition: usize,
    values: Vec<f64>,
}

/// All comparisons of an experiment with several bases.
pub(super) fn compare(
    experiment: &Experiment,
    results: &Results,
) -> Result<(Vec<PairSummary>, Vec<Ranking>), RowStoreError> {
    let (mut pairs, mut rankings) = (Vec::new(), Vec::new());
    let Some(layout) = experiment.layout().filter(|layout| layout.bases > 1) else { return Ok((pairs, rankings)) };
    for column in experiment.columns().overall() {
        let numbers = results.column(column)?;
        if !comparable(experiment, layout, results, column, &numbers) {
            continue;
        }
        let blocks = blocks(layout, results, &numbers);
        if blocks.is_empty() {
            continue;
        }
        for condition in 0..layout.conditions.len() {
            let within: Vec<_> = blocks.iter().filter(|block| block.condition == condition).collect();
            for a in 0..layout.bases {
                for b in a + 1..layout.bases {
                    pairs.extend(pair(experiment, layout, column, condition, [a, b], &within));
                }
            }
        }
        rankings.push(rank(experiment, layout, column, &blocks));
    }
    Ok((pairs, rankings))
}

/// Whether a metric means something for every base: only some observe. That nothing settled is no lack of meaning.
fn comparable(
    experiment: &Experiment,
    layout: &Layout,
    results: &Results,
    column: usize,
    numbers: &ResultColumn,
) -> bool {
    let mut completed = vec![false; layout.bases];
    let mut measured = vec![false; layout.bases];
    for (index, outcome) in results.outcomes() {
        let base = layout.place(index).base;
        completed[base] |= outcome == RowOutcome::Completed;
        measured[base] |= numbers.of(index).is_some();
    }
    let settling = experiment.columns().names()[column].starts_with("settling");
    settling || completed.iter().zip(&measured).all(|(completed, measured)| *measured || !completed)
}

fn blocks(layout: &Layout, results: &Results, numbers: &ResultColumn) -> Vec<Block> {
    let mut blocks = Vec::new();
    let mut seen = None;
    for (index, _) in results.outcomes() {
        let Place { point, condition, base: _ } = layout.place(index);
        if seen.replace((point, condition)) == Some((point, condition)) {
            continue;
        }
        let value = |base: usize| {
            let index = layout.index(Place { point, condition, base });
            let made = results.outcome(index)? != RowOutcome::Refused;
            made.then(|| numbers.of(index).unwrap_or(f64::INFINITY))
        };
        if let Some(values) = (0..layout.bases).map(value).collect::<Option<Vec<_>>>() {
            blocks.push(Block { point, condition, values });
        }
    }
    blocks
}

fn pair(
    experiment: &Experiment,
    layout: &Layout,
    column: usize,
    condition: usize,
    [a, b]: [usize; 2],
    blocks: &[&Block],
) -> Option<PairSummary> {
    if blocks.is_empty() {
        return None;
    }
    let confidence = experiment.document.confidence;
    let values = blocks.iter().map(|block| (block.values[a], block.values[b]));
    let differences: Vec<_> =
        values.clone().filter(|(a, b)| a.is_finite() && b.is_finite()).map(|(a, b)| a - b).collect();
    let share = |count| Share::new(count, blocks.len(), confidence);
    Some(PairSummary {
        condition: layout.conditions[condition].name.clone(),
        metric: experiment.columns().names()[column].clone(),
        a: experiment.bases[a].name.clone(),
        b: experiment.bases[b].name.clone(),
        difference: Statistics::of(&differences, confidence),
        a_better: share(values.clone().filter(|(a, b)| a < b).count()),
        b_better: share(values.filter(|(a, b)| b < a).count()),
    })
}

fn rank(experiment: &Experiment, layout: &Layout, column: usize, blocks: &[Block]) -> Ranking {
    // A draw is one piece of chance under all conditions; without draws, conditions are what could have been others.
    let by_draw = layout.points > 1;
    let mut units: Vec<(u64, Vec<f64>, f64)> = Vec::new();
    let unit_of = |block: &Block| if by_draw { block.point } else { block.condition as u64 };
    for block in blocks {
        let (unit, ranks) = (unit_of(block), ranks(&block.values));
        match units.last_mut() {
            Some((last, sums, count)) if *last == unit => {
                sums.iter_mut().zip(ranks).for_each(|(sum, rank)| *sum += rank);
                *count += 1.0;
            }
            _ => units.push((unit, ranks, 1.0)),
        }
    }
    let mean = |units: &mut dyn Iterator<Item = &(u64, Vec<f64>, f64)>| {
        let (mut sums, mut count) = (vec![0.0; layout.bases], 0.0);
        for (_, ranks, blocks) in units {
            sums.iter_mut().zip(ranks).for_each(|(sum, rank)| *sum += rank);
            count += blocks;
        }
        sums.iter().map(|sum| sum / count).collect::<Vec<f64>>()
    };
    let means = mean(&mut units.iter());
    let [fewest, most] = RESAMPLES;
    let resamples = if units.len() > 1 { (MOST_DRAWN / units.len()).clamp(fewest, most) } else { 0 };
    let mut resampled = vec![Vec::with_capacity(resamples); layout.bases];
    let mut best = vec![0.0; layout.bases];
    for n in 0..resamples {
        let mut stream = Stream::new(layout.seed, Purpose::Bootstrap, n as u64);
        let means = mean(&mut (0..units.len()).map(|_| &units[stream.below(units.len())]));
        let least = means.iter().copied().fold(f64::INFINITY, f64::min);
        let winners = means.iter().filter(|mean| **mean == least).count() as f64;
        for (base, mean) in means.into_iter().enumerate() {
            resampled[base].push(mean);
            best[base] += if mean == least { 1.0 / winners } else { 0.0 };
        }
    }
    let outside = 0.5 - 0.5 * experiment.document.confidence;
    let ranked = |base: usize| {
        let mut sorted = resampled[base].clone();
        sorted.sort_by(f64::total_cmp);
        let known = resamples > 0;
        Ranked {
            base: experiment.bases[base].name.clone(),
            mean_rank: means[base],
            interval: known.then(|| [quantile(&sorted, outside), quantile(&sorted, 1.0 - outside)]),
            best_share: known.then(|| best[base] / resamples as f64),
        }
    };
    let mut bases: Vec<_> = (0..layout.bases).map(ranked).collect();
    bases.sort_by(|a, b| a.mean_rank.total_cmp(&b.mean_rank));
    Ranking {
        metric: experiment.columns().names()[column].clone(),
        blocks: blocks.len(),
        resampled: (resamples > 0).then(|| if by_draw { "draw" } else { "condition" }.to_owned()),
        bases,
    }
}
