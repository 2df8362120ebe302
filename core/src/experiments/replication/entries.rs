//! The paper's 21 numbers, and how far a number of ours is from one: the factor between them, beyond what rounding explains.

use super::claims::Study;
use super::document::UnitsDocument;
use super::of;
use super::tables::{OBSERVER_PEAKS_DEG, TABLE_1_DEG, TABLE_2_DEG_S};
use crate::scenario::Scheme;

/// What a number is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Quantity {
    /// `I(e)`, Table 1.
    Error,
    /// `I(ė)`, Table 2.
    Rate,
    /// Peak `|z|`, section 4.3.
    ObserverPeak,
}

/// One of the paper's numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Entry {
    pub quantity: Quantity,
    pub scheme: Scheme,
    /// From 0.
    pub joint: usize,
    /// As printed, deg or deg/s.
    pub paper: f64,
    /// Half of its last printed digit.
    half_digit: f64,
}

/// Every number, in the order of the paper.
pub(super) fn entries() -> Vec<Entry> {
    let mut all = Vec::new();
    for (quantity, table) in [(Quantity::Error, TABLE_1_DEG), (Quantity::Rate, TABLE_2_DEG_S)] {
        for (scheme, numbers) in table {
            all.extend(numbers.into_iter().enumerate().map(|(joint, paper)| {
                // Four decimals, but for one number below them that has a fifth.
                let half_digit = if paper < 1e-4 { 5e-6 } else { 5e-5 };
                Entry { quantity, scheme, joint, paper, half_digit }
            }));
        }
    }
    let peak = |(joint, paper)| {
        let (quantity, scheme) = (Quantity::ObserverPeak, Scheme::Proposed);
        Entry { quantity, scheme, joint, paper, half_digit: 5e-4 }
    };
    all.extend(OBSERVER_PEAKS_DEG.into_iter().enumerate().map(peak));
    all
}

impl Entry {
    /// Where it stands in the paper.
    pub const fn place(&self) -> &'static str {
        match self.quantity {
            Quantity::Error => "Table 1",
            Quantity::Rate => "Table 2",
            Quantity::ObserverPeak => "Section 4.3",
        }
    }

    /// Symbol with the joint.
    pub fn symbol(&self) -> String {
        let joint = self.joint + 1;
        match self.quantity {
            Quantity::Error => format!("I(e{joint})"),
            Quantity::Rate => format!("I(ė{joint})"),
            Quantity::ObserverPeak => format!("peak z{joint}"),
        }
    }

    /// Ours, in the units in which the paper's number is read.
    pub fn ours(&self, study: &Study, units: UnitsDocument) -> Option<f64> {
        let findings = of(study, self.scheme);
        let (number, in_radians) = match self.quantity {
            Quantity::Error => (Some(findings.index_e_deg[self.joint]), units != UnitsDocument::Labelled),
            Quantity::Rate => (Some(findings.index_de_deg_s[self.joint]), units != UnitsDocument::Labelled),
            Quantity::ObserverPeak => (findings.horizon.z_peak_deg[self.joint], units == UnitsDocument::Radians),
        };
        // Zero has no factor.
        let number = number.filter(|number| *number > 0.0)?;
        Some(if in_radians { number.to_radians() } else { number })
    }

    /// Ours divided by the nearest number that rounds to the paper's; 1 if ours does.
    pub fn factor(&self, ours: f64) -> f64 {
        let (low, high) = (self.paper - self.half_digit, self.paper + self.half_digit);
        if ours < low {
            ours / low
        } else if ours > high {
            ours / high
        } else {
            1.0
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_rounds_to_the_papers_number_has_no_distance() {
        let all = entries();
        assert_eq!(all.len(), 21);
        let entry = |n: usize| all[n];
        // 0.0351, 0.00004 and 0.023.
        for (n, inside) in [(1, 0.035_06), (2, 0.000_044), (18, 0.023_4)] {
            assert_eq!(entry(n).factor(inside), 1.0, "{n}");
        }
        assert!((entry(1).factor(0.07) - 0.07 / 0.035_15).abs() < 1e-12);
        assert!((entry(18).factor(0.01) - 0.01 / 0.022_5).abs() < 1e-12);
    }
}
