//! The paper's claims in our words, each with a criterion that can fail, tested against what runs say. Source: paper sections
//! 4.3, 5.
//!
//! A criterion is ours: the paper states none. It is printed with every verdict, so that a reader can disagree.

use super::findings::{Findings, HorizonFindings, JOINTS, PARAMETERS};
use super::of;
use super::tables::OBSERVER_PEAKS_DEG;
use crate::scenario::{Run, Scheme};
use serde::Serialize;

/// How a claim fared.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// It holds under these settings.
    Holds,
    /// It does not hold under these settings.
    DoesNotHold,
    /// A run diverged or has too few samples, so there is nothing to compare.
    NotTested,
}

/// A claim and how it fared.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Claim {
    /// Identifier.
    pub id: &'static str,
    /// The claim, in our words.
    pub claim: &'static str,
    /// When we say that it holds.
    pub criterion: &'static str,
    /// Verdict.
    pub verdict: Verdict,
    /// The numbers behind it.
    pub evidence: String,
}

/// Within this factor two indices count as similar.
const SIMILAR: f64 = 2.0;
/// An estimate counts as close to the truth within this relative distance.
const CLOSE: f64 = 0.1;

/// Halves and sixths of a run must hold more than a sample or two.
pub(super) const FEWEST_SAMPLES: usize = 60;

/// The schemes' numbers, in the order of [`Scheme::ALL`].
pub(super) type Study = [Findings; 3];

/// A claim with its criterion, and the test: whether it holds, and the numbers behind it.
pub(super) struct TestedClaim {
    pub id: &'static str,
    pub claim: &'static str,
    pub criterion: &'static str,
    pub test: fn(&Study) -> (bool, String),
}

/// Every claim.
pub(super) const CRITERIA: [TestedClaim; 12] = [
    TestedClaim {
        id: "ultimately_bounded",
        claim: "The proposed scheme's tracking and observer errors are ultimately bounded.",
        criterion: "for every joint the index of e and of z over the second half is at most that over the first",
        test: bounded,
    },
    TestedClaim {
        id: "slotine_li_converges",
        claim: "Slotine and Li's tracking errors tend to zero.",
        criterion: "for every joint I(e) over the second half is smaller than over the first",
        test: slotine_li_converges,
    },
    TestedClaim {
        id: "errors_look_alike",
        claim: "The joint errors of the three controllers behave very much alike.",
        criterion: "for every joint the largest I(e) is within a factor of 2 of the smallest",
        test: errors_look_alike,
    },
    TestedClaim {
        id: "slotine_li_worst",
        claim: "Slotine and Li's controller tracks worst of the three.",
        criterion: "its I(e) is the largest for every joint (the paper's own Table 1 denies this for joint 2)",
        test: slotine_li_worst_tracking,
    },
    TestedClaim {
        id: "similar_to_tang_arteaga",
        claim: "The proposed scheme performs much like Tang and Arteaga's, although it lacks the velocity sensor.",
        criterion: "I(e) and I(ė) of the two are within a factor of 2 for every joint",
        test: similar_to_tang_arteaga,
    },
    TestedClaim {
        id: "slotine_li_settles_last",
        claim: "The velocity errors of Slotine and Li's controller settle last.",
        criterion: "for every joint its ė enters the band of 0.5 °/s for good later than with both others",
        test: slotine_li_settles_last,
    },
    TestedClaim {
        id: "third_joint_velocity_stays",
        claim: "With Slotine and Li's controller the third joint's velocity error stays at a bounded level instead of vanishing.",
        criterion: "its I(ė3) over the last sixth is more than half of that over the whole run, and a larger share than with both others",
        test: third_joint_velocity_stays,
    },
    TestedClaim {
        id: "observer_replaces_the_sensor",
        claim: "The velocity errors confirm that the observer stands in well for a velocity sensor.",
        criterion: "for every joint I(ė) of the proposed scheme is at most twice Tang and Arteaga's and below Slotine and Li's",
        test: observer_replaces_the_sensor,
    },
    TestedClaim {
        id: "observer_peaks",
        claim: "The observer errors stay below 0.023°, 0.027° and 0.019°.",
        criterion: "the peaks do not exceed these bounds as rounded (K_d was calibrated to them: no evidence for the claim)",
        test: observer_peaks,
    },
    TestedClaim {
        id: "estimates_become_constant",
        claim: "Only with Tang and Arteaga's and the proposed scheme do the estimates settle to constants.",
        criterion: "in the last sixth at least 16 of 18 estimates move less than 5 % of their range with these two, and fewer with Slotine and Li",
        test: estimates_become_constant,
    },
    TestedClaim {
        id: "closest_estimates",
        claim: "Only the proposed scheme's estimates come close to some true values.",
        criterion: "at the end at least one of its estimates is within 10 % of the truth, and none of the other schemes' is",
        test: closest_estimates,
    },
    TestedClaim {
        id: "proposed_best",
        claim: "The performance indices show the proposed scheme ahead.",
        criterion: "it has the smallest index in more than half of the six entries of Tables 1 and 2 (the paper's own tables: 4 of 6)",
        test: proposed_best,
    },
];

/// Tests every claim against a study's runs, which stand in the order of [`Scheme::ALL`].
pub fn check_claims(runs: &[Run; 3]) -> Vec<Claim> {
    let judged = match (untestable(runs), runs.each_ref().map(Findings::of)) {
        (None, [Some(proposed), Some(tang_arteaga), Some(slotine_li)]) => Ok([proposed, tang_arteaga, slotine_li]),
        (reason, _) => Err(reason.unwrap_or_default()),
    };
    let claim = |TestedClaim { id, claim, criterion, test }: TestedClaim| {
        let (verdict, evidence) = match &judged {
            Ok(study) => {
                let (holds, evidence) = test(study);
                (if holds { Verdict::Holds } else { Verdict::DoesNotHold }, evidence)
            }
            Err(reason) => (Verdict::NotTested, reason.clone()),
        };
        Claim { id, claim, criterion, verdict, evidence }
    };
    CRITERIA.into_iter().map(claim).collect()
}

/// Why nothing can be said about these runs, if so.
fn untestable(runs: &[Run; 3]) -> Option<String> {
    let diverged: Vec<_> = Scheme::ALL.into_iter().filter(|scheme| of(runs, *scheme).report.at_s.is_some()).collect();
    if !diverged.is_empty() {
        return Some(format!(
            "diverged: {}",
            diverged.iter().map(|scheme| scheme.name()).collect::<Vec<_>>().join(", ")
        ));
    }
    let samples = runs[0].report.samples;
    (samples < FEWEST_SAMPLES).then(|| format!("{samples} samples; verdicts need at least {FEWEST_SAMPLES}"))
}

/// Numbers of all schemes, by name.
fn listing(numbers: impl Fn(Scheme) -> String) -> String {
    Scheme::ALL.map(|scheme| format!("{} {}", scheme.name(), numbers(scheme))).join("; ")
}

fn three(numbers: &[f64], decimals: usize) -> String {
    numbers.iter().map(|x| format!("{x:.decimals$}")).collect::<Vec<_>>().join(", ")
}

fn bounded(study: &Study) -> (bool, String) {
    let HorizonFindings { growth_e, growth_z, .. } = &of(study, Scheme::Proposed).horizon;
    (
        growth_e.iter().chain(growth_z).all(|ratio| *ratio <= 1.0),
        format!("second half / first half: e {}; z {}", three(growth_e, 3), three(growth_z, 3)),
    )
}

fn slotine_li_converges(study: &Study) -> (bool, String) {
    let ratios = &of(study, Scheme::SlotineLi).horizon.growth_e;
    (ratios.iter().all(|ratio| *ratio < 1.0), format!("second half / first half: {}", three(ratios, 3)))
}

fn errors_look_alike(study: &Study) -> (bool, String) {
    let spread: [f64; JOINTS] = std::array::from_fn(|joint| {
        let indices = Scheme::ALL.map(|scheme| of(study, scheme).index_e_deg[joint]);
        indices.iter().fold(0.0_f64, |a, b| a.max(*b)) / indices.iter().fold(f64::INFINITY, |a, b| a.min(*b))
    });
    (spread.iter().all(|ratio| *ratio <= SIMILAR), format!("largest / smallest: {}", three(&spread, 1)))
}

fn observer_replaces_the_sensor(study: &Study) -> (bool, String) {
    let index = |scheme| &of(study, scheme).index_de_deg_s;
    let good = (0..JOINTS).all(|joint| {
        let own = index(Scheme::Proposed)[joint];
        own <= SIMILAR * index(Scheme::TangArteaga)[joint] && own < index(Scheme::SlotineLi)[joint]
    });
    (good, format!("I(ė) in °/s: {}", listing(|scheme| three(index(scheme), 4))))
}

fn slotine_li_worst_tracking(study: &Study) -> (bool, String) {
    let index = |scheme| &of(study, scheme).index_e_deg;
    let worst = (0..JOINTS).all(|joint| {
        let own = index(Scheme::SlotineLi)[joint];
        own > index(Scheme::Proposed)[joint] && own > index(Scheme::TangArteaga)[joint]
    });
    (worst, format!("I(e) in °: {}", listing(|scheme| three(index(scheme), 4))))
}

fn similar_to_tang_arteaga(study: &Study) -> (bool, String) {
    let (proposed, other) = (of(study, Scheme::Proposed), of(study, Scheme::TangArteaga));
    let ratios =
        |ours: &[f64; JOINTS], theirs: &[f64; JOINTS]| std::array::from_fn(|joint| ours[joint] / theirs[joint]);
    let e: [f64; JOINTS] = ratios(&proposed.index_e_deg, &other.index_e_deg);
    let de: [f64; JOINTS] = ratios(&proposed.index_de_deg_s, &other.index_de_deg_s);
    (
        e.iter().chain(&de).all(|ratio| (1.0 / SIMILAR..=SIMILAR).contains(ratio)),
        format!("proposed / Tang and Arteaga: e {}; ė {}", three(&e, 2), three(&de, 2)),
    )
}

fn slotine_li_settles_last(study: &Study) -> (bool, String) {
    // A joint that never settles settles after every other.
    let settling = |scheme| of(study, scheme).horizon.settling_de_s.map(|time| time.unwrap_or(f64::INFINITY));
    let (own, others) = (settling(Scheme::SlotineLi), [settling(Scheme::Proposed), settling(Scheme::TangArteaga)]);
    let last = (0..JOINTS).all(|joint| others.iter().all(|other| own[joint] > other[joint]));
    let show = |time: &f64| if time.is_finite() { format!("{time:.2}") } else { "never".to_owned() };
    (
        last,
        format!(
            "settling time of ė in s: {}",
            listing(|scheme| settling(scheme).iter().map(show).collect::<Vec<_>>().join(", "))
        ),
    )
}

fn third_joint_velocity_stays(study: &Study) -> (bool, String) {
    let share = |scheme| of(study, scheme).horizon.late_share;
    let (own, others) = (share(Scheme::SlotineLi), [share(Scheme::Proposed), share(Scheme::TangArteaga)]);
    (
        own > 0.5 && others.iter().all(|other| own > *other),
        format!("last sixth / whole run: {}", listing(|scheme| format!("{:.2}", share(scheme)))),
    )
}

fn observer_peaks(study: &Study) -> (bool, String) {
    let peaks: Vec<_> = of(study, Scheme::Proposed).horizon.z_peak_deg.into_iter().flatten().collect();
    // The paper prints its bounds with two digits.
    let within = !peaks.is_empty() && peaks.iter().zip(OBSERVER_PEAKS_DEG).all(|(ours, paper)| *ours <= paper + 0.0005);
    (within, format!("peak |z| in °: {}", three(&peaks, 5)))
}

fn estimates_become_constant(study: &Study) -> (bool, String) {
    let count = |scheme| of(study, scheme).horizon.settled_estimates;
    let counts = Scheme::ALL.map(count);
    (
        counts[0] >= 16.0 && counts[1] >= 16.0 && counts[2] < counts[0].min(counts[1]),
        format!("settled estimates of 18: {}", listing(|scheme| count(scheme).to_string())),
    )
}

fn closest_estimates(study: &Study) -> (bool, String) {
    let distance = |scheme| &of(study, scheme).horizon.distance;
    let close = |scheme| distance(scheme).iter().filter(|far| **far < CLOSE).count();
    let nearest = |scheme| {
        let wins = |k: &usize| Scheme::ALL.iter().all(|other| distance(scheme)[*k] <= distance(*other)[*k]);
        (0..PARAMETERS).filter(wins).count()
    };
    let counts = Scheme::ALL.map(close);
    (
        counts[0] > 0 && counts[1] == 0 && counts[2] == 0,
        format!(
            "within 10 %: {}; nearest of the three: {}",
            listing(|scheme| close(scheme).to_string()),
            listing(|scheme| nearest(scheme).to_string())
        ),
    )
}

fn proposed_best(study: &Study) -> (bool, String) {
    let (own, others) = (of(study, Scheme::Proposed), [Scheme::TangArteaga, Scheme::SlotineLi].map(|it| of(study, it)));
    let wins = |of: fn(&Findings) -> &[f64; JOINTS]| {
        (0..JOINTS).filter(|joint| others.iter().all(|other| of(own)[*joint] < of(other)[*joint])).count()
    };
    let best = wins(|it| &it.index_e_deg) + wins(|it| &it.index_de_deg_s);
    (best > 3, format!("smallest in {best} of 6"))
}
