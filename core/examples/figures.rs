//! Draws every figure of the paper's study as SVG into a folder: `cargo run --example figures --features figures -- DIR`.

use adaptarm_core::figures::{Figure, PlottedRun, Theme, svg};
use adaptarm_core::robots::ROBOTS;
use adaptarm_core::scenario::{Scenario, Scheme};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args().nth(1).ok_or("name a folder")?;
    let mut runs = Vec::new();
    for scheme in Scheme::ALL {
        runs.push((scheme, Scenario::new(scheme.paper())?.run()));
    }
    let plotted: Vec<_> = runs
        .iter()
        .map(|(scheme, run)| PlottedRun {
            scheme: *scheme,
            recording: &run.recording,
            completed: true,
            theta_true: &run.report.theta_true,
        })
        .collect();
    for theme in [Theme::Light, Theme::Dark] {
        for figure in Figure::ALL {
            let path = format!("{folder}/{}-{theme:?}.svg", figure.id());
            std::fs::write(path, svg(figure, ROBOTS[0], &plotted, theme)?)?;
        }
    }
    Ok(())
}
