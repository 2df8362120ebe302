//! What a replication leaves in its folder: scenarios, series, figures, `report.json` and `report.html`.

use super::{Replication, html};
use crate::figures::{figure_svg, png};
use adaptarm_core::figures::{Figure, PlottedRun};
use anyhow::{Context, Result};
use rayon::prelude::*;
use std::path::{Path, PathBuf};

/// Writes everything; returns the report's path.
pub(super) fn write(replication: &Replication, folder: &Path) -> Result<PathBuf> {
    for scenario in &replication.scenarios {
        let text = serde_json::to_string_pretty(scenario.document())?;
        save(folder, &format!("scenarios/{}.json", scenario.scheme().id()), text + "\n")?;
    }
    for (scenario, run) in replication.scenarios.iter().zip(&replication.runs) {
        save(folder, &format!("series/{}.csv", scenario.scheme().id()), run.recording.to_csv())?;
    }
    let figures = draw(replication)?;
    figures.par_iter().try_for_each(|(figure, svg)| {
        save(folder, &format!("figures/{}.svg", figure.id()), svg)?;
        save(folder, &format!("figures/{}.png", figure.id()), png(svg)?)
    })?;
    save(folder, "report.json", serde_json::to_string_pretty(replication)? + "\n")?;
    save(folder, "report.html", html::page(replication, &figures))?;
    Ok(folder.join("report.html"))
}

/// The report's figures as SVG, on paper.
fn draw(replication: &Replication) -> Result<Vec<(Figure, String)>> {
    let robot = replication.scenarios[0].robot();
    let runs: Vec<_> = replication
        .scenarios
        .iter()
        .zip(&replication.runs)
        .map(|(scenario, run)| {
            let completed = run.report.at_s.is_none();
            PlottedRun::new(scenario.scheme(), &run.recording, completed, &run.report.theta_true)
        })
        .collect();
    Figure::REPLICATION.into_iter().map(|figure| Ok((figure, figure_svg(figure, robot, &runs)?))).collect()
}

fn save(folder: &Path, name: &str, content: impl AsRef<[u8]>) -> Result<()> {
    let path = folder.join(name);
    if let Some(parent) = path.parent() {
        std::fs::create_dir_all(parent).with_context(|| format!("cannot make the folder {}", parent.display()))?;
    }
    std::fs::write(&path, content).with_context(|| format!("cannot write {}", path.display()))
}
