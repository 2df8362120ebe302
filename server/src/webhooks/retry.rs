//! When to try again: longer and longer pauses, scattered so that many failed calls do not return together.

use jiff::Timestamp;
use jiff::fmt::rfc2822::DateTimeParser;
use rand::random_range;
use std::time::Duration;

/// Pauses after each failed attempt, as multiples of the first: 5 s, 25 s, 2 min, 10 min, 1 h, 6 h and 24 h.
const PAUSES: [u32; 7] = [1, 5, 24, 120, 720, 4320, 17280];

/// Each pause is this much longer or shorter at most.
const JITTER: f64 = 0.2;

/// Longest pause that a receiver can ask for.
const LONGEST_ASKED: Duration = Duration::from_hours(24);

/// The pause after failed attempt number `attempt` (the first is 1); none when it was the last.
/// A receiver that asked for a longer one gets it, up to 24 h.
pub fn pause_after(attempt: u32, first: Duration, asked: Option<Duration>) -> Option<Duration> {
    let index = usize::try_from(attempt.saturating_sub(1)).ok()?;
    let pause = first.saturating_mul(*PAUSES.get(index)?);
    let scattered = Duration::try_from_secs_f64(pause.as_secs_f64() * random_range(1.0 - JITTER..=1.0 + JITTER));
    let asked = asked.unwrap_or_default().min(LONGEST_ASKED);
    Some(scattered.unwrap_or(pause).max(asked))
}

/// What a `Retry-After` header asks for: seconds, or a date.
pub fn asked_pause(header: &str, now: Timestamp) -> Option<Duration> {
    if let Ok(seconds) = header.trim().parse() {
        return Some(Duration::from_secs(seconds));
    }
    let date = DateTimeParser::new().parse_timestamp(header.trim()).ok()?;
    Duration::try_from(date.duration_since(now)).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    const FIRST: Duration = Duration::from_secs(5);

    #[test]
    fn pauses_grow_and_end() {
        for (attempt, seconds) in [(1, 5.0), (2, 25.0), (3, 120.0), (4, 600.0), (5, 3600.0), (6, 21600.0), (7, 86400.0)]
        {
            for _ in 0..100 {
                let pause = pause_after(attempt, FIRST, None).unwrap().as_secs_f64();
                assert!((0.8 * seconds..=1.2 * seconds).contains(&pause), "{attempt}: {pause} s");
            }
        }
        for attempt in [8, 9, u32::MAX] {
            assert_eq!(pause_after(attempt, FIRST, None), None);
        }
    }

    #[test]
    fn a_pause_is_scattered() {
        let pauses: std::collections::BTreeSet<_> = (0..20).map(|_| pause_after(1, FIRST, None)).collect();
        assert!(pauses.len() > 1);
    }

    #[test]
    fn a_receiver_can_ask_for_longer_but_not_for_ever() {
        let pause = |seconds| pause_after(1, FIRST, Some(Duration::from_secs(seconds))).unwrap();
        assert!(pause(0) >= FIRST.mul_f64(0.8));
        assert_eq!(pause(60), Duration::from_mins(1));
        assert_eq!(pause(u64::MAX), Duration::from_hours(24));
        assert!(pause_after(1, Duration::MAX, None).is_some());
    }

    #[test]
    fn reads_both_forms_of_retry_after() {
        let now = "2015-10-21T07:28:00Z".parse().unwrap();
        assert_eq!(asked_pause("120", now), Some(Duration::from_mins(2)));
        assert_eq!(asked_pause("Wed, 21 Oct 2015 07:29:30 GMT", now), Some(Duration::from_secs(90)));
        for nothing in ["", "-1", "1.5", "soon", "Wed, 21 Oct 2015 07:27:00 GMT", "99999999999999999999"] {
            assert_eq!(asked_pause(nothing, now), None, "{nothing}");
        }
    }
}
