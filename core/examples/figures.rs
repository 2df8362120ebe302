//! Draws every figure of the paper's study as SVG into a folder: `cargo run --example figures --features figures -- DIR`.

use adaptarm_core::figures::{Figure, PlottedRun, Style, Theme, View, svg};
use adaptarm_core::robots::ROBOTS;
use adaptarm_core::scenario::{Scenario, Scheme};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args().nth(1).ok_or("name a folder")?;
    let mut runs = Vec::new();
    for scheme in Scheme::ALL {
        let scenario = Scenario::new(scheme.paper())?;
        let run = scenario.run();
        let parts = scenario.torque_parts(&run.recording);
        runs.push((scheme, run, parts));
    }
    let plotted: Vec<_> = runs
        .iter()
        .map(|(scheme, run, parts)| PlottedRun {
            parts: Some(parts),
            ..PlottedRun::new(*scheme, &run.recording, true, &run.report.theta_true)
        })
        .collect();
    for theme in Theme::ALL {
        let view = View::whole(Style { theme, scale: 1.0 });
        for figure in Figure::ALL {
            let path = format!("{folder}/{}-{theme:?}.svg", figure.id());
            std::fs::write(path, svg(figure, ROBOTS[0], &plotted, &view)?)?;
        }
    }
    Ok(())
}
