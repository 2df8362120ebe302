//! What metrics and fields are called on an axis, with their units.

use crate::experiments::Experiment;
use crate::scenario::{Scenario, Scheme};

/// A metric over all joints, or of one joint, with its unit.
pub(super) fn metric(name: &str) -> String {
    const KNOWN: [(&str, &str); 12] = [
        ("index_e_deg", "index of tracking errors [°]"),
        ("index_de_deg_s", "index of velocity errors [°/s]"),
        ("e_peak_deg", "peak tracking error [°]"),
        ("z_peak_deg", "peak observer error [°]"),
        ("tau_peak_nm", "peak torque [N·m]"),
        ("voltage_peak_v", "peak motor voltage [V]"),
        ("tau_rms_nm", "root mean square of the torque [N·m]"),
        ("control_effort_n2m2s", "control effort [N²·m²·s]"),
        ("settling_e_s", "settling time of the tracking error [s]"),
        ("settling_de_s", "settling time of the velocity error [s]"),
        ("ultimate_bound_e_deg", "ultimate bound of the tracking error [°]"),
        ("tau_variation_nm_s", "variation of the torque [N·m/s]"),
    ];
    let known = KNOWN.iter().find(|(id, _)| name.strip_prefix(id).is_some_and(is_joint));
    known.map_or_else(
        || name.to_owned(),
        |(id, words)| match name[id.len()..].strip_prefix('_') {
            Some(joint) => format!("{words}, joint {joint}"),
            None => (*words).to_owned(),
        },
    )
}

fn is_joint(rest: &str) -> bool {
    rest.is_empty() || rest.strip_prefix('_').is_some_and(|joint| joint.bytes().all(|byte| byte.is_ascii_digit()))
}

/// A field by the last names of its JSON pointer; a gain with its unit where `schemes` agree on it, a factor as one.
pub(super) fn field(schemes: &[Scheme], pointer: &str, relative: bool) -> String {
    let mut parts = pointer.rsplit('/').filter(|part| !part.is_empty());
    let last = parts.next().unwrap_or(pointer);
    let is_number = last.bytes().all(|byte| byte.is_ascii_digit());
    let (name, index) = if is_number { (parts.next().unwrap_or(""), Some(last)) } else { (last, None) };
    let gains = schemes.iter().flat_map(|scheme| scheme.gains()).filter(|_| pointer.starts_with("/scheme/gains/"));
    let mut units = gains.filter(|gain| gain.name == name).map(|gain| gain.unit);
    let unit = units.next().filter(|unit| units.all(|other| other == *unit));
    let index = index.map(|index| format!("[{index}]")).unwrap_or_default();
    match unit.filter(|unit| !unit.is_empty()) {
        _ if relative => format!("{name}{index} [× base]"),
        Some(unit) => format!("{name}{index} [{unit}]"),
        None => format!("{name}{index}"),
    }
}

/// The fields of an experiment's points as they stand on axes.
pub(super) fn fields(experiment: &Experiment) -> Vec<String> {
    let axes = experiment.document().sweep.iter().flat_map(|sweep| &sweep.axes);
    let relative: Vec<_> = axes.map(|axis| axis.relative).collect();
    let schemes: Vec<_> = experiment.base_scenarios().map(Scenario::scheme).collect();
    let names = experiment.fields().into_iter().enumerate();
    names.map(|(n, pointer)| field(&schemes, pointer, relative.get(n).copied().unwrap_or(false))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_have_units() {
        assert_eq!(metric("tau_peak_nm_2"), "peak torque [N·m], joint 2");
        assert_eq!(metric("index_e_deg"), "index of tracking errors [°]");
        assert_eq!(metric("something"), "something");
        let field = |schemes: &[Scheme], pointer| field(schemes, pointer, false);
        assert_eq!(field(&Scheme::ALL, "/plant/theta_scale/3"), "theta_scale[3]");
        assert_eq!(super::field(&Scheme::ALL, "/scheme/gains/k_v/0", true), "k_v[0] [× base]");
        assert_eq!(field(&Scheme::ALL, "/integration/step_s"), "step_s");
        // The observer's gain and the yardstick's damping have one name.
        assert_eq!(field(&[Scheme::Proposed], "/scheme/gains/k_d/0"), "k_d[0] [1/s]");
        assert_eq!(field(&[Scheme::Pd], "/scheme/gains/k_d/0"), "k_d[0] [N·m·s]");
        assert_eq!(field(&[Scheme::Proposed, Scheme::Pd], "/scheme/gains/k_d/0"), "k_d[0]");
    }
}
