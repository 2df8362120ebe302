//! What a replication's section may say: checked once, every option on every scheme that it concerns.

use super::claims::FEWEST_SAMPLES;
use super::document::{OptionDocument, ReplicationDocument, UnknownDocument};
use super::findings::HorizonFindings;
use super::search::{Search, Unknown, changed, concerns};
use crate::experiments::experiment::Base;
use crate::experiments::limits::{EXPERIMENT_LIMITS, check_count, check_name, check_range, conflict, unknown};
use crate::scenario::{ScenarioError, Scheme};
use ciborium::Value;

const LIMITS: &crate::experiments::ExperimentLimits = &EXPERIMENT_LIMITS;

/// Checks a section.
pub(super) fn search(document: &ReplicationDocument, bases: &[Base]) -> Result<Search, ScenarioError> {
    check_bases(bases)?;
    if !document.unknowns.is_empty() {
        check_count("/replication/unknowns", document.unknowns.len(), LIMITS.unknowns, "unknowns")?;
    }
    let (mut unknowns, mut steps) = (Vec::new(), 0);
    for (n, it) in document.unknowns.iter().enumerate() {
        let earlier = document.unknowns[..n].iter().map(|unknown| unknown.name.as_str());
        unknowns.push(check_unknown(it, &format!("/replication/unknowns/{n}"), earlier, bases, &mut steps)?);
    }
    let horizons = horizons(document, bases)?;
    check_windows(document, &horizons)?;
    check_count("/replication/units", document.units.len(), 3, "units")?;
    if (1..document.units.len()).any(|n| document.units[..n].contains(&document.units[n])) {
        return Err(conflict("/replication/units", "names a unit twice".to_owned()));
    }
    check_range("/replication/reached_factor", document.reached_factor, LIMITS.factor, "")?;
    check_range("/replication/plausible_factor", document.plausible_factor, LIMITS.factor, "")?;
    let search = Search { unknowns, horizons, windows: document.windows.clone(), steps };
    let cuts = (search.horizons.len() * search.windows.len() * document.units.len()) as u64;
    let numbers = search.horizons.len() * (6 * search.windows.len() + HorizonFindings::names().len());
    for (what, count, most) in [
        ("readings", search.combinations().saturating_mul(cuts), LIMITS.readings),
        ("numbers kept", search.runs().saturating_mul(numbers as u64), LIMITS.kept),
    ] {
        if count > most {
            return Err(conflict("/replication", format!("asks for {count} {what}; at most {most} are allowed")));
        }
    }
    Ok(search)
}

/// The study's three schemes on its arm, in the order of its tables, all with the same samples.
fn check_bases(bases: &[Base]) -> Result<(), ScenarioError> {
    let found: Vec<_> = bases.iter().map(|base| base.scenario.scheme()).collect();
    if found != Scheme::ALL || bases.iter().any(|base| base.scenario.robot().id != "crs_a465") {
        let message = "a replication needs three scenarios of the crs_a465, with the schemes proposed, tang_arteaga and \
                       slotine_li in this order";
        return Err(conflict("/bases", message.to_owned()));
    }
    let settings = |base: &Base| {
        let settings = base.scenario.settings();
        (settings.duration_s, settings.samples)
    };
    if bases.iter().any(|base| settings(base) != settings(&bases[0])) {
        return Err(conflict("/bases", "differ in duration or samples, from which all horizons are cut".to_owned()));
    }
    Ok(())
}

fn check_unknown<'a>(
    it: &UnknownDocument,
    at: &str,
    earlier: impl Iterator<Item = &'a str>,
    bases: &[Base],
    steps: &mut u64,
) -> Result<Unknown, ScenarioError> {
    check_name(&format!("{at}/name"), &it.name, earlier)?;
    let concerns = concerns(it).map_err(|other| {
        let allowed = Scheme::ALL.map(Scheme::id).join(", ");
        unknown(format!("{at}/schemes"), other, allowed)
    })?;
    if concerns == [false; 3] {
        return Err(conflict(format!("{at}/schemes"), "is empty; leave it out if all are meant".to_owned()));
    }
    check_count(&format!("{at}/options"), it.options.len(), LIMITS.unknowns, "options")?;
    for (n, option) in it.options.iter().enumerate() {
        let at = format!("{at}/options/{n}");
        check_name(&format!("{at}/name"), &option.name, it.options[..n].iter().map(|option| option.name.as_str()))?;
        *steps = (*steps).max(check_change(option, &at, concerns, bases)?);
    }
    Ok(Unknown { concerns, options: it.options.iter().map(|option| option.change.clone()).collect() })
}

/// An option makes an allowed scenario of every base that it concerns; the most steps of one.
fn check_change(option: &OptionDocument, at: &str, concerns: [bool; 3], bases: &[Base]) -> Result<u64, ScenarioError> {
    let Some(change) = &option.change else { return Ok(0) };
    let mut steps = 0;
    let at = format!("{at}/change");
    if !matches!(change, Value::Map(_)) {
        return Err(conflict(at, "is no object with members of a scenario".to_owned()));
    }
    for (base, _) in bases.iter().zip(concerns).filter(|(_, concerned)| *concerned) {
        let mut tree = base.tree.clone();
        tree.merge(change);
        let wrong = |error| conflict(at.clone(), format!("with base {:?}: {error}", base.name));
        steps = steps.max(changed(&tree, base).map_err(wrong)?.settings().steps());
    }
    Ok(steps)
}

/// Horizons in samples.
fn horizons(document: &ReplicationDocument, bases: &[Base]) -> Result<Vec<usize>, ScenarioError> {
    let settings = bases[0].scenario.settings();
    check_count("/replication/horizons_s", document.horizons_s.len(), LIMITS.horizons, "horizons")?;
    let per_second = settings.samples as f64 / settings.duration_s;
    let mut horizons = Vec::new();
    for (n, horizon_s) in document.horizons_s.iter().enumerate() {
        let at = format!("/replication/horizons_s/{n}");
        check_range(&at, *horizon_s, [FEWEST_SAMPLES as f64 / per_second, settings.duration_s], "s")?;
        let samples = horizon_s * per_second;
        if (samples - samples.round()).abs() > 1e-6 {
            let message =
                format!("{horizon_s} s are {samples} samples of the bases; it must be a whole number of them");
            return Err(conflict(at, message));
        }
        if horizons.contains(&(samples.round() as usize)) {
            return Err(conflict(at, format!("{horizon_s} s stand here twice")));
        }
        horizons.push(samples.round() as usize);
    }
    Ok(horizons)
}

fn check_windows(document: &ReplicationDocument, horizons: &[usize]) -> Result<(), ScenarioError> {
    check_count("/replication/windows", document.windows.len(), LIMITS.windows, "windows")?;
    let shortest = horizons.iter().copied().min().unwrap_or(0) as f64;
    for (n, window) in document.windows.iter().enumerate() {
        let at = format!("/replication/windows/{n}");
        let earlier = document.windows[..n].iter().map(|window| window.name.as_str());
        check_name(&format!("{at}/name"), &window.name, earlier)?;
        check_range(&format!("{at}/from"), window.from, [0.0, 1.0], "of the horizon")?;
        check_range(&format!("{at}/to"), window.to, [0.0, 1.0], "of the horizon")?;
        if (window.from * shortest) as usize >= (window.to * shortest) as usize {
            return Err(conflict(at, "holds no sample of the shortest horizon".to_owned()));
        }
    }
    Ok(())
}
