//! Colours that stand for numbers: from dark blue, small and good, through green to pale yellow, large. Their lightness rises
//! all the way, so that they read in grey and for the colour-blind. Source: the colour map viridis (van der Walt and Smith).

use super::super::style::Rgb;

const STOPS: [Rgb; 9] = [
    (68, 1, 84),
    (71, 44, 122),
    (59, 81, 139),
    (44, 113, 142),
    (33, 144, 141),
    (39, 173, 129),
    (92, 200, 99),
    (170, 220, 50),
    (253, 231, 37),
];

/// The colour of a share from 0 to 1.
pub(super) fn shade(share: f64) -> Rgb {
    let place = share.clamp(0.0, 1.0) * (STOPS.len() - 1) as f64;
    let below = (place.floor() as usize).min(STOPS.len() - 2);
    let (from, to, part) = (STOPS[below], STOPS[below + 1], place - below as f64);
    let mix = |a: u8, b: u8| (f64::from(a) + (f64::from(b) - f64::from(a)) * part).round() as u8;
    (mix(from.0, to.0), mix(from.1, to.1), mix(from.2, to.2))
}

/// Whether letters on this shade must be light.
pub(super) fn is_dark(share: f64) -> bool {
    share < 0.55
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lightness_rises() {
        let lightness = |n: u8| {
            let (r, g, b) = shade(f64::from(n) / 20.0);
            0.2126 * f64::from(r) + 0.7152 * f64::from(g) + 0.0722 * f64::from(b)
        };
        assert!((0..20).all(|n| lightness(n) < lightness(n + 1)));
    }
}
