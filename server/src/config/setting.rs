//! What one setting is: its name, what it means, what it may be, and how its value is written.
//!
//! A section of settings is declared once, with `section!`: type, documentation, default and range stand in one place, and
//! the file, the environment, error messages and the example file are all made from it.

use super::values::toml_text;
use std::path::PathBuf;

/// One setting.
#[derive(Debug)]
pub struct Setting {
    /// Table of the file it stands in; empty at the top.
    pub section: &'static str,
    /// Its name there.
    pub name: &'static str,
    /// What it means, a line each.
    pub doc: &'static [&'static str],
    /// What it may be.
    pub rule: Rule,
}

impl Setting {
    /// Its whole name: `limits.wait_s`.
    pub fn key(&self) -> String {
        if self.section.is_empty() { self.name.to_owned() } else { format!("{}.{}", self.section, self.name) }
    }

    /// The environment variable that sets it: `ADAPTARM_LIMITS_WAIT_S`.
    pub fn variable(&self) -> String {
        format!("ADAPTARM_{}", self.key().replace('.', "_").to_uppercase())
    }
}

/// What a setting may be.
#[derive(Debug, Clone, Copy)]
pub struct Rule {
    /// The type and its bounds.
    pub form: Form,
    /// A value for the example file, where there is no default to show.
    pub example: &'static str,
    /// Whether its value may not be repeated in messages.
    pub secret: bool,
}

/// Checks a text and gives the form in which it is kept.
pub type Check = fn(&str) -> Result<String, String>;

/// Type and bounds of a value.
#[derive(Debug, Clone, Copy)]
pub enum Form {
    /// A whole number.
    Integer {
        /// Smallest.
        min: u64,
        /// Largest.
        max: u64,
        /// What is counted or measured.
        unit: &'static str,
    },
    /// Any number.
    Number {
        /// Smallest.
        min: f64,
        /// Largest.
        max: f64,
        /// In what it is measured.
        unit: &'static str,
    },
    /// Yes or no.
    Switch,
    /// A text.
    Text(Check),
    /// A list of texts.
    List(Check),
}

impl Form {
    /// In words, for people who gave something else.
    pub fn describe(&self) -> String {
        match self {
            Self::Integer { .. } => format!("a whole number from {}", self.range()),
            Self::Number { .. } => format!("a number from {}", self.range()),
            Self::Switch => "true or false".to_owned(),
            Self::Text(_) => "a text".to_owned(),
            Self::List(_) => "a list of texts".to_owned(),
        }
    }

    /// `1 to 60 s`; empty where there are no bounds.
    pub fn range(&self) -> String {
        match self {
            Self::Integer { min, max, unit } => format!("{min} to {max} {unit}"),
            Self::Number { min, max, unit } => format!("{min} to {max} {unit}"),
            Self::Switch | Self::Text(_) | Self::List(_) => String::new(),
        }
    }
}

impl Rule {
    const fn of(form: Form) -> Self {
        Self { form, example: "", secret: false }
    }

    /// A whole number between two bounds, both inclusive.
    pub const fn integer(min: u64, max: u64, unit: &'static str) -> Self {
        Self::of(Form::Integer { min, max, unit })
    }

    /// A number between two bounds, both inclusive.
    pub const fn number(min: f64, max: f64, unit: &'static str) -> Self {
        Self::of(Form::Number { min, max, unit })
    }

    /// Yes or no.
    pub const fn switch() -> Self {
        Self::of(Form::Switch)
    }

    /// A text that passes `check`.
    pub const fn text(check: Check) -> Self {
        Self::of(Form::Text(check))
    }

    /// A list of texts that each pass `check`.
    pub const fn list(check: Check) -> Self {
        Self::of(Form::List(check))
    }

    /// With a value for the example file, as TOML.
    pub const fn example(self, example: &'static str) -> Self {
        Self { example, ..self }
    }

    /// With a value that messages must not repeat.
    pub const fn secret(self) -> Self {
        Self { secret: true, ..self }
    }
}

/// A value as TOML; secrets are masked.
pub(super) trait Shown {
    /// Nothing where it is not set.
    fn shown(&self) -> Option<String>;
}

impl<T: Shown> Shown for Option<T> {
    fn shown(&self) -> Option<String> {
        self.as_ref().and_then(Shown::shown)
    }
}

impl<T: Shown> Shown for Vec<T> {
    fn shown(&self) -> Option<String> {
        let items: Vec<_> = self.iter().filter_map(Shown::shown).collect();
        Some(format!("[{}]", items.join(", ")))
    }
}

impl Shown for String {
    fn shown(&self) -> Option<String> {
        Some(toml_text(self))
    }
}

impl Shown for PathBuf {
    fn shown(&self) -> Option<String> {
        Some(toml_text(&self.to_string_lossy()))
    }
}

impl Shown for f64 {
    fn shown(&self) -> Option<String> {
        // With its decimal point: a TOML reader other than ours would take `15` for an integer.
        Some(format!("{self:?}"))
    }
}

macro_rules! shown_as_displayed {
    ($($type:ty)+) => { $(
        impl Shown for $type {
            fn shown(&self) -> Option<String> {
                Some(self.to_string())
            }
        }
    )+ };
}
shown_as_displayed!(bool u16 u32 u64 usize);

/// Declares a section: a struct with a default, and the table of its settings.
macro_rules! section {
    (
        $(#[doc = $about:literal])+
        $section:ident [$name:literal] {
            $( $(#[doc = $doc:literal])+ $key:ident: $type:ty = $default:expr, $rule:expr; )+
        }
        $( sections { $( $(#[doc = $subdoc:literal])+ $sub:ident: $subtype:ty; )+ } )?
    ) => {
        $(#[doc = $about])+
        #[derive(Debug, Clone, PartialEq, serde::Deserialize)]
        #[serde(default, deny_unknown_fields)]
        pub struct $section {
            $( $(#[doc = $doc])+ pub $key: $type, )+
            $( $( $(#[doc = $subdoc])+ pub $sub: $subtype, )+ )?
        }

        impl Default for $section {
            fn default() -> Self {
                Self { $( $key: $default, )+ $( $( $sub: <$subtype>::default(), )+ )? }
            }
        }

        impl $section {
            /// Every setting of this section and of those within it, in the order of the file.
            pub fn settings() -> Vec<&'static $crate::config::setting::Setting> {
                const SETTINGS: &[$crate::config::setting::Setting] = &[ $(
                    $crate::config::setting::Setting {
                        section: $name, name: stringify!($key), doc: &[$($doc),+], rule: $rule,
                    },
                )+ ];
                #[allow(unused_mut, reason = "sections without sections within them add nothing")]
                let mut settings: Vec<_> = SETTINGS.iter().collect();
                $( $( settings.extend(<$subtype>::settings()); )+ )?
                settings
            }

            /// The values of [`Self::settings`] as TOML, in the same order; nothing where one is not set.
            pub(super) fn shown(&self) -> Vec<Option<String>> {
                #[allow(unused_mut, reason = "sections without sections within them add nothing")]
                let mut values = vec![$( $crate::config::setting::Shown::shown(&self.$key), )+];
                $( $( values.extend(self.$sub.shown()); )+ )?
                values
            }
        }
    };
}
pub(super) use section;
