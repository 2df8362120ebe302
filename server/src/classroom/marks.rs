//! From attempts to marks: when an attempt is in time, what lateness costs, and which attempt counts.
//!
//! Points of an attempt: `score × points × (1 − late/100)` in hundredths; late is `min(percent_per_day × days begun, cap)`.
//! All of it follows from what is stored, at the time of asking: an extension given afterwards takes lateness back.

use super::model::{Assignment, Attempt, AttemptState, Counts, Explanation, Extension, Override, Settings};
use jiff::{SignedDuration, Timestamp};
use uuid::Uuid;

/// When a student may hand in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Window {
    /// From then on; always if not set.
    pub opens_at: Option<Timestamp>,
    /// In time until then; always if not set.
    pub deadline: Option<Timestamp>,
    /// At all until then.
    pub closes_at: Option<Timestamp>,
}

impl Window {
    /// Of a student with or without an extension, which never takes time away: the later of the two deadlines counts.
    pub fn of(settings: &Settings, extension: Option<&Extension>) -> Self {
        let own = extension.and_then(|extension| extension.deadline);
        let deadline = settings.deadline.map(|deadline| own.map_or(deadline, |own| own.max(deadline)));
        let days = settings.late.map_or(0, |late| i64::from(late.days));
        // Beyond the end of time there is no lateness.
        let closes_at =
            deadline.map(|at| at.checked_add(SignedDuration::from_hours(24 * days)).unwrap_or(Timestamp::MAX));
        Self { opens_at: settings.opens_at, deadline, closes_at }
    }

    /// Whether it has begun.
    pub fn has_opened(&self, at: Timestamp) -> bool {
        self.opens_at.is_none_or(|opens| at >= opens)
    }

    /// Whether attempts are taken at this moment.
    pub fn takes(&self, at: Timestamp) -> bool {
        self.has_opened(at) && self.closes_at.is_none_or(|closes| at <= closes)
    }

    /// What an attempt at this moment costs, % of its points.
    pub fn late_percent(&self, settings: &Settings, at: Timestamp) -> f64 {
        let (Some(deadline), Some(late)) = (self.deadline, settings.late) else { return 0.0 };
        let over = at.duration_since(deadline).as_millis();
        if over <= 0 {
            return 0.0;
        }
        let days = (over as f64 / 86_400_000.0).ceil();
        (late.percent_per_day * days).min(late.cap_percent)
    }
}

/// Most attempts that one student's work may hold where the teacher sets no limit.
pub const MOST_ATTEMPTS: u32 = 1000;

/// How many attempts a student has; as many as they like if there is no number.
pub fn allowed(settings: &Settings, extension: Option<&Extension>) -> Option<u32> {
    settings.attempts.map(|attempts| attempts.saturating_add(extension.map_or(0, |extension| extension.attempts)))
}

/// Whether nobody can hand in any more, or the teacher does not want to wait: explanations are shown.
pub fn released(assignment: &Assignment, extensions: &[Extension], now: Timestamp) -> bool {
    match assignment.settings.explanation {
        Explanation::Never => false,
        Explanation::Now => true,
        Explanation::AfterDeadline => is_over(assignment, extensions, now),
    }
}

/// Whether nobody can hand in any more.
pub fn is_over(assignment: &Assignment, extensions: &[Extension], now: Timestamp) -> bool {
    let over = |extension| Window::of(&assignment.settings, extension).closes_at.is_some_and(|closes| now > closes);
    over(None) && extensions.iter().all(|extension| over(Some(extension)))
}

/// What an attempt is worth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Worth {
    /// What lateness costs, %.
    pub late_percent: f64,
    /// Points, once it has its grade.
    pub points: Option<f64>,
}

/// What an attempt is worth by its student's conditions.
pub fn worth(settings: &Settings, extension: Option<&Extension>, attempt: &Attempt) -> Worth {
    let late_percent = Window::of(settings, extension).late_percent(settings, attempt.submitted_at);
    let graded = attempt.feedback.as_ref().filter(|_| attempt.state == AttemptState::Graded);
    let points = graded.map(|graded| hundredths(graded.score * settings.points * (1.0 - late_percent / 100.0)));
    Worth { late_percent, points }
}

/// A student's mark for an assignment.
#[derive(Debug, Clone, PartialEq)]
pub struct Mark {
    /// Points.
    pub points: f64,
    /// The attempt that counts.
    pub attempt: Option<Uuid>,
    /// What its lateness cost, %.
    pub late_percent: f64,
    /// Why it is another than the attempt's.
    pub overridden: Option<String>,
}

/// The mark of these attempts, all of one student, in the order of their numbers; and of the latest override, if it is one.
pub fn mark(
    settings: &Settings,
    extension: Option<&Extension>,
    attempts: &[Attempt],
    decided: Option<&Override>,
) -> Option<Mark> {
    let mut counts: Option<Mark> = None;
    for attempt in attempts {
        let Worth { late_percent, points } = worth(settings, extension, attempt);
        let Some(points) = points else { continue };
        let better = counts.as_ref().is_none_or(|mark| match settings.counts {
            Counts::Best => points > mark.points,
            Counts::Last => true,
        });
        if better {
            counts = Some(Mark { points, attempt: Some(attempt.id), late_percent, overridden: None });
        }
    }
    let Some((decided, points)) = decided.and_then(|decided| Some((decided, decided.points?))) else { return counts };
    // Decided as so many of what full credit was worth then.
    let points = decided.of.map_or(points, |of| hundredths(points / of * settings.points));
    let (attempt, late_percent) = counts.map_or((None, 0.0), |mark| (mark.attempt, mark.late_percent));
    Some(Mark { points, attempt, late_percent, overridden: Some(decided.comment.clone()) })
}

/// Rounded to hundredths, as every mark is, so that all places show the same.
pub fn hundredths(points: f64) -> f64 {
    (points * 100.0).round() / 100.0
}

#[cfg(test)]
mod tests {
    use super::super::model::{Feedback, Late};
    use super::*;
    use serde_json::Value;

    fn at(text: &str) -> Timestamp {
        text.parse().unwrap()
    }

    fn settings() -> Settings {
        Settings {
            title: "t".to_owned(),
            opens_at: Some(at("2026-01-01T00:00:00Z")),
            deadline: Some(at("2026-01-10T00:00:00Z")),
            attempts: Some(3),
            counts: Counts::Best,
            points: 100.0,
            late: Some(Late { percent_per_day: 10.0, cap_percent: 25.0, days: 5 }),
            explanation: Explanation::AfterDeadline,
            hints: true,
            leaderboard: false,
        }
    }

    fn extension(deadline: &str) -> Extension {
        let (assignment, student) = (Uuid::nil(), Uuid::nil());
        Extension { assignment, student, deadline: Some(at(deadline)), attempts: 2, comment: String::new() }
    }

    fn attempt(number: i64, score: f64, submitted_at: &str) -> Attempt {
        Attempt {
            id: Uuid::from_u128(number as u128),
            assignment: Uuid::nil(),
            student: Uuid::nil(),
            number,
            gains: Value::Null,
            job: Uuid::nil(),
            state: AttemptState::Graded,
            reason: None,
            submitted_at: at(submitted_at),
            graded_at: None,
            feedback: Some(Feedback { score, criteria: Vec::new() }),
        }
    }

    #[test]
    fn the_window_opens_closes_and_can_be_extended() {
        let window = Window::of(&settings(), None);
        for (moment, takes) in [
            ("2025-12-31T23:59:59Z", false),
            ("2026-01-01T00:00:00Z", true),
            ("2026-01-10T00:00:00Z", true),
            ("2026-01-15T00:00:00Z", true),
            ("2026-01-15T00:00:01Z", false),
        ] {
            assert_eq!(window.takes(at(moment)), takes, "{moment}");
        }
        assert!(Window::of(&settings(), Some(&extension("2026-01-20T00:00:00Z"))).takes(at("2026-01-25T00:00:00Z")));
        assert!(!Window::of(&Settings { late: None, ..settings() }, None).takes(at("2026-01-10T00:00:01Z")));
        assert!(Window::of(&Settings { deadline: None, ..settings() }, None).takes(at("2200-01-01T00:00:00Z")));
        assert_eq!(allowed(&settings(), Some(&extension("2026-01-20T00:00:00Z"))), Some(5));
    }

    #[test]
    fn an_extension_takes_no_time_away() {
        let (own, end) = (Some(at("2026-01-20T00:00:00Z")), settings().deadline);
        let deadline = |settings: &Settings, own| {
            let extension = Extension { deadline: own, ..extension("2026-01-20T00:00:00Z") };
            Window::of(settings, Some(&extension)).deadline
        };
        assert_eq!(deadline(&settings(), own), own);
        assert_eq!(deadline(&settings(), None), end);
        // The class's was moved beyond the student's.
        assert_eq!(deadline(&settings(), Some(at("2026-01-05T00:00:00Z"))), end);
        assert_eq!(deadline(&Settings { deadline: None, ..settings() }, own), None);
    }

    #[test]
    fn lateness_costs_by_the_day_begun_up_to_its_cap() {
        let (settings, window) = (settings(), Window::of(&settings(), None));
        for (moment, percent) in [
            ("2026-01-10T00:00:00Z", 0.0),
            ("2026-01-10T00:00:01Z", 10.0),
            ("2026-01-11T00:00:00Z", 10.0),
            ("2026-01-11T00:00:01Z", 20.0),
            ("2026-01-14T00:00:00Z", 25.0),
        ] {
            assert_eq!(window.late_percent(&settings, at(moment)), percent, "{moment}");
        }
    }

    #[test]
    fn best_or_last_counts_and_an_extension_takes_lateness_back() {
        let attempts = [
            attempt(1, 0.9, "2026-01-09T00:00:00Z"),
            attempt(2, 1.0, "2026-01-10T12:00:00Z"),
            attempt(3, 0.2, "2026-01-12T12:00:00Z"),
        ];
        let best = mark(&settings(), None, &attempts, None).unwrap();
        // 100 less 10 % is as good as 90 in time: the earlier one stays.
        assert_eq!((best.points, best.attempt), (90.0, Some(attempts[0].id)));
        let extended = mark(&settings(), Some(&extension("2026-01-11T00:00:00Z")), &attempts, None).unwrap();
        assert_eq!((extended.points, extended.attempt, extended.late_percent), (100.0, Some(attempts[1].id), 0.0));
        let last = mark(&Settings { counts: Counts::Last, ..settings() }, None, &attempts, None).unwrap();
        assert_eq!((last.points, last.late_percent), (15.0, 25.0));
        let returned = Attempt { state: AttemptState::Returned, ..attempts[0].clone() };
        assert_eq!(mark(&settings(), None, &[returned], None), None);
    }

    #[test]
    fn the_latest_override_decides_until_it_is_taken_back() {
        let decided = |points| Override {
            id: Uuid::nil(),
            assignment: Uuid::nil(),
            student: Uuid::nil(),
            teacher: Uuid::nil(),
            points,
            of: Some(100.0),
            comment: "oral exam".to_owned(),
            at: at("2026-01-12T00:00:00Z"),
        };
        let attempts = [attempt(1, 0.5, "2026-01-09T00:00:00Z")];
        let mark_of = |attempts: &[Attempt], points| mark(&settings(), None, attempts, Some(&decided(points)));
        let overridden = mark_of(&attempts, Some(80.0)).unwrap();
        assert_eq!((overridden.points, overridden.overridden.as_deref()), (80.0, Some("oral exam")));
        assert_eq!(mark_of(&[], Some(80.0)).unwrap().attempt, None);
        assert_eq!(mark_of(&attempts, None).unwrap().points, 50.0);
        // Full credit is worth another number of points now, as it is for everyone else.
        let tenth = Settings { points: 10.0, ..settings() };
        assert_eq!(mark(&tenth, None, &attempts, Some(&decided(Some(33.33)))).unwrap().points, 3.33);
        let kept_since_before = Override { of: None, ..decided(Some(7.0)) };
        assert_eq!(mark(&tenth, None, &attempts, Some(&kept_since_before)).unwrap().points, 7.0);
        assert_eq!(mark_of(&[], None), None);
    }

    #[test]
    fn the_explanation_waits_for_the_last_who_can_hand_in() {
        let assignment = Assignment {
            id: Uuid::nil(),
            class: Uuid::nil(),
            exercise: String::new(),
            document: String::new(),
            settings: settings(),
            created_at: at("2026-01-01T00:00:00Z"),
        };
        let (before, after) = (at("2026-01-15T00:00:00Z"), at("2026-01-15T00:00:01Z"));
        assert_eq!([before, after].map(|now| released(&assignment, &[], now)), [false, true]);
        assert!(!released(&assignment, &[extension("2026-02-01T00:00:00Z")], after));
        let endless = Assignment { settings: Settings { deadline: None, ..settings() }, ..assignment };
        assert!(!released(&endless, &[extension("2026-01-02T00:00:00Z")], after));
    }
}
