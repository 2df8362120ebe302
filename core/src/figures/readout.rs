//! What a figure shows at one instant, in numbers: for a read-out beside the pointer or for a reader of the screen.

use super::figure::Figure;
use super::panels::{Key, Panel, Reference, panels};
use super::run::PlottedRun;
use super::view::View;
use crate::robots::RobotData;

/// Values at an instant.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    /// Time of the recorded sample nearest to the instant, s; of the first run that has any.
    pub time_s: f64,
    /// One per panel, in the order of drawing.
    pub panels: Vec<PanelReading>,
}

/// Values of a panel, in its unit.
#[derive(Debug, Clone, PartialEq)]
pub struct PanelReading {
    /// Symbol and unit: `e1 [°]`.
    pub label: String,
    /// Symbol and unit of what it is drawn over; absent where that is time.
    pub x_label: Option<String>,
    /// True value or desired angle.
    pub reference: Option<f64>,
    /// One per curve, in the order of the runs.
    pub values: Vec<Value>,
}

/// Value of a curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Value {
    /// What the curve stands for.
    pub key: Key,
    /// Its value; none where the run had ended by then.
    pub value: Option<f64>,
    /// Where along the horizontal axis, if that is not time.
    pub x: Option<f64>,
}

/// What a figure shows at `time_s`.
pub fn read(figure: Figure, robot: &RobotData, runs: &[PlottedRun<'_>], view: &View<'_>, time_s: f64) -> Reading {
    // All are read at one instant: the nearest sample of the first run that was still under way.
    let lasting = |run: &&PlottedRun<'_>| run.end_s().is_some_and(|end_s| end_s >= time_s);
    let longest = || {
        runs.iter()
            .filter(|run| !run.recording.is_empty())
            .max_by(|a, b| a.end_s().partial_cmp(&b.end_s()).unwrap_or(std::cmp::Ordering::Equal))
    };
    let clock = runs.iter().find(lasting).or_else(longest);
    let nearest = clock.and_then(|run| run.nearest_row(time_s).map(|row| run.time_s(row)));
    let time_s = nearest.unwrap_or(time_s);
    let panels = panels(figure, robot, runs, view);
    Reading { time_s, panels: panels.iter().map(|panel| read_panel(panel, runs, time_s)).collect() }
}

fn read_panel(panel: &Panel, runs: &[PlottedRun<'_>], time_s: f64) -> PanelReading {
    let mut values: Vec<_> = panel
        .curves
        .iter()
        .map(|curve| {
            let run = &runs[curve.run];
            let row = row_at(run, time_s);
            let value = |quantity| row.and_then(|row| run.value(quantity, row));
            Value { key: curve.key, value: value(curve.y), x: curve.x.and_then(value) }
        })
        .collect();
    values.sort_by_key(|value| match value.key {
        Key::Run(n) | Key::Part(n) => n,
        Key::Total => usize::MAX,
    });
    let reference = panel.reference.and_then(|reference| match reference {
        Reference::Constant(value) => Some(value),
        Reference::Curve { run, quantity } => row_at(&runs[run], time_s).and_then(|row| runs[run].value(quantity, row)),
    });
    PanelReading { label: panel.label.clone(), x_label: panel.x_label.clone(), reference, values }
}

/// The nearest sample of a run that had not ended before.
fn row_at(run: &PlottedRun<'_>, time_s: f64) -> Option<usize> {
    let row = run.nearest_row(time_s)?;
    let last = run.recording.len() - 1;
    let interval_s = if last > 0 { run.time_s(last) - run.time_s(last - 1) } else { 0.0 };
    (time_s - run.time_s(row) <= interval_s.max(0.0)).then_some(row)
}

#[cfg(test)]
mod tests {
    use super::super::style::{Style, Theme};
    use super::*;
    use crate::decomposition::PARTS;
    use crate::robots::ROBOTS;
    use crate::scenario::{Scenario, Scheme};

    fn scenario(scheme: Scheme) -> Scenario {
        let mut document = scheme.paper();
        (document.integration.duration_s, document.recording.samples) = (0.1, 50);
        Scenario::new(document).unwrap()
    }

    #[test]
    fn values_are_those_of_the_nearest_sample() {
        let scenario = scenario(Scheme::Proposed);
        let run = scenario.run();
        let theta = scenario.theta();
        let plotted = [PlottedRun::new(Scheme::Proposed, &run.recording, true, &theta)];
        let view = View::whole(Style { theme: Theme::Light, scale: 1.0 });
        let at = |figure, time_s| read(figure, ROBOTS[0], &plotted, &view, time_s);

        let errors = at(Figure::TrackingErrors, 0.0509);
        assert!((errors.time_s - 0.05).abs() < 1e-12);
        let row: Vec<f64> = run.recording.rows().chunks_exact(37).nth(25).unwrap().to_vec();
        assert_eq!(errors.panels[1].label, "e2 [°]");
        assert_eq!(
            errors.panels[1].values,
            [Value { key: Key::Run(0), value: Some(row[2] * 180.0 / std::f64::consts::PI), x: None }]
        );

        let phase = &at(Figure::PhasePlane, 0.05).panels[0];
        assert_eq!(phase.x_label.as_deref(), Some("e1 [°]"));
        assert_eq!(phase.values[0].x, errors.panels[0].values[0].value);
        let estimates = at(Figure::Estimates, 0.0);
        assert_eq!(estimates.panels.len(), 18);
        assert_eq!((estimates.panels[16].reference, estimates.panels[16].values[0].value), (Some(22.0), Some(0.0)));
        assert_eq!(at(Figure::ParameterErrorNorm, 0.0).panels[0].values[0].value, Some(1.0));
        let position = &at(Figure::Positions, 0.0).panels[1];
        assert_eq!(position.values[0].value.unwrap(), position.reference.unwrap());
        let voltage = at(Figure::Voltages, 0.05).panels[0].values[0].value.unwrap();
        let torque = at(Figure::Torques, 0.05).panels[0].values[0].value.unwrap();
        assert!((voltage * 16.952_380_952 - torque).abs() < 1e-6 * torque.abs());
    }

    #[test]
    fn parts_sum_to_the_torque_that_is_read() {
        let scenario = scenario(Scheme::SlotineLi);
        let run = scenario.run();
        let parts = scenario.torque_parts(&run.recording);
        let plotted =
            [PlottedRun { parts: Some(&parts), ..PlottedRun::new(Scheme::SlotineLi, &run.recording, true, &[]) }];
        let view = View::whole(Style { theme: Theme::Light, scale: 1.0 });
        for panel in read(Figure::TorqueParts, ROBOTS[0], &plotted, &view, 0.02).panels {
            let values: Vec<f64> = panel.values.iter().map(|value| value.value.unwrap()).collect();
            assert_eq!(panel.values[PARTS].key, Key::Total);
            let sum: f64 = values[..PARTS].iter().sum();
            assert!((sum - values[PARTS]).abs() < 1e-9 * values[PARTS].abs().max(1.0));
        }
    }

    #[test]
    fn a_run_that_ended_before_has_no_value() {
        let (long, short) = (scenario(Scheme::Proposed).run().recording, scenario(Scheme::SlotineLi).run().recording);
        let width = short.columns().width();
        let cut = crate::recording::Recording::from_rows(short.columns(), short.rows()[..20 * width].to_vec()).unwrap();
        let runs =
            [PlottedRun::new(Scheme::SlotineLi, &cut, false, &[]), PlottedRun::new(Scheme::Proposed, &long, true, &[])];
        let view = View::whole(Style { theme: Theme::Light, scale: 1.0 });
        let reading = read(Figure::TrackingErrors, ROBOTS[0], &runs, &view, 0.08);
        assert!((reading.time_s - 0.08).abs() < 1e-12);
        let values = &reading.panels[0].values;
        assert_eq!((values[0].value, values[1].key), (None, Key::Run(1)));
        assert!(values[1].value.is_some());
        let none = read(Figure::TrackingErrors, ROBOTS[0], &[], &view, 0.08);
        assert_eq!((none.time_s, none.panels.len(), none.panels[0].values.len()), (0.08, 3, 0));
    }
}
