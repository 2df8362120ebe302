//! Limits on what an exercise may ask for. All are inclusive.

/// Limits on exercises.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ExerciseLimits {
    /// Most characters of an identifier or a name.
    pub name_chars: usize,
    /// Most characters of a text.
    pub text_chars: usize,
    /// Shortest and longest estimated time, min.
    pub minutes: [u32; 2],
    /// Most hints.
    pub hints: usize,
    /// Most attempts that a hint may wait for.
    pub hint_attempts: u32,
    /// Most numbers that a student may move.
    pub moves: usize,
    /// Most fields that follow one of them, or that vary.
    pub fields: usize,
    /// Most visible variants.
    pub visible: u32,
    /// Most hidden variants.
    pub hidden: u32,
    /// Most integration steps in all variants together: some seconds of computing.
    pub steps: f64,
    /// Most criteria.
    pub criteria: usize,
    /// Smallest and largest weight of a criterion.
    pub weight: [f64; 2],
    /// Most solutions.
    pub solutions: usize,
}

/// The limits of this version.
pub const EXERCISE_LIMITS: ExerciseLimits = ExerciseLimits {
    name_chars: 60,
    text_chars: 20_000,
    minutes: [1, 1000],
    hints: 10,
    hint_attempts: 100,
    moves: 24,
    fields: 64,
    visible: 8,
    hidden: 32,
    steps: 1e6,
    criteria: 16,
    weight: [0.01, 1000.0],
    solutions: 8,
};
