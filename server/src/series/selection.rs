//! Which columns and rows of a recording somebody asks for, and in which format.

use crate::document::brief;
use crate::error::Problem;
use adaptarm_core::recording::Columns;
use axum::http::StatusCode;
use serde::Deserialize;
use thiserror::Error;
use utoipa::IntoParams;

/// Allowed distances between rows that are kept.
const EVERY: [usize; 2] = [1, 1_000_000];

/// A request for samples as its query says it.
#[derive(Debug, Clone, Default, PartialEq, Eq, Deserialize, IntoParams)]
#[serde(deny_unknown_fields, default)]
#[into_params(parameter_in = Query)]
pub struct SeriesQuery {
    /// Number of the scenario; the first is 0.
    #[param(required = false, maximum = 99_999)]
    pub scenario: usize,
    /// `csv` (the default), `npz` for numpy.load, or `parquet`.
    pub format: Option<String>,
    /// Names of columns, separated by commas, in the order wanted; all of them without this.
    #[param(example = "t_s,e_deg_1")]
    pub columns: Option<String>,
    /// Keeps rows 0, k, 2k and so on, and always the last one.
    #[param(value_type = Option<u32>, minimum = 1, maximum = 1_000_000)]
    pub every: Option<String>,
}

/// A format in which samples are sent.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Text, one line per row.
    Csv,
    /// NumPy's archive, one array per column.
    Npz,
    /// Apache Parquet, one column of doubles per column.
    Parquet,
}

impl Format {
    /// Every format.
    pub const ALL: [Self; 3] = [Self::Csv, Self::Npz, Self::Parquet];

    /// Identifier in queries, and ending of file names.
    pub const fn id(self) -> &'static str {
        match self {
            Self::Csv => "csv",
            Self::Npz => "npz",
            Self::Parquet => "parquet",
        }
    }

    /// Media type. None is registered for NPZ, and browsers unpack what is called a ZIP file.
    pub const fn media_type(self) -> &'static str {
        match self {
            Self::Csv => "text/csv; charset=utf-8; header=present",
            Self::Npz => "application/octet-stream",
            Self::Parquet => "application/vnd.apache.parquet",
        }
    }

    /// The format called `id`.
    pub fn parse(id: &str) -> Result<Self, SelectionError> {
        Self::ALL.into_iter().find(|format| format.id() == id).ok_or_else(|| SelectionError::Unknown {
            parameter: "format",
            value: brief(id),
            allowed: Self::ALL.map(Self::id).join(", "),
        })
    }
}

/// Columns and rows. Made by [`Selection::parse`], which lets nothing senseless through; the default is everything.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Selection {
    columns: Option<Vec<String>>,
    every: usize,
}

impl Default for Selection {
    fn default() -> Self {
        Self { columns: None, every: 1 }
    }
}

/// Why a request for samples makes no sense.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum SelectionError {
    /// A name that means nothing.
    #[error("{parameter}: {value:?} is not known; allowed: {allowed}")]
    Unknown {
        /// Parameter of the query.
        parameter: &'static str,
        /// What it says.
        value: String,
        /// What it may say.
        allowed: String,
    },
    /// A list of columns without columns, or with an empty name.
    #[error("columns: a name is empty; give names separated by commas, or leave `columns` out to get them all")]
    EmptyColumn,
    /// The same column again.
    #[error("columns: {0:?} is asked for twice")]
    DoubledColumn(String),
    /// Not a number of rows.
    #[error("every: {0:?} is not a whole number from {min} to {max}", min = EVERY[0], max = EVERY[1])]
    Every(String),
}

impl Selection {
    /// From the query's values, where they are given. Which columns there are, only [`Selection::places`] knows.
    pub fn parse(columns: Option<&str>, every: Option<&str>) -> Result<Self, SelectionError> {
        let columns = columns.map(parse_columns).transpose()?;
        Ok(Self { columns, every: every.map_or(Ok(1), parse_every)? })
    }

    /// Names of columns; all there are if none are named.
    pub fn columns(&self) -> Option<&[String]> {
        self.columns.as_deref()
    }

    /// Distance of rows.
    pub fn every(&self) -> usize {
        self.every
    }

    /// Where in a row of this shape the columns stand, in the order asked for.
    pub fn places(&self, shape: Columns) -> Result<Vec<usize>, SelectionError> {
        let Some(wanted) = &self.columns else {
            return Ok((0..shape.width()).collect());
        };
        let names = shape.names();
        let place = |wanted: &String| {
            names.iter().position(|name| name == wanted).ok_or_else(|| SelectionError::Unknown {
                parameter: "columns",
                value: brief(wanted),
                allowed: names.join(", "),
            })
        };
        wanted.iter().map(place).collect()
    }
}

fn parse_columns(text: &str) -> Result<Vec<String>, SelectionError> {
    let mut names: Vec<String> = Vec::new();
    for name in text.split(',').map(str::trim) {
        if name.is_empty() {
            return Err(SelectionError::EmptyColumn);
        }
        if names.iter().any(|earlier| earlier == name) {
            return Err(SelectionError::DoubledColumn(brief(name)));
        }
        names.push(name.to_owned());
    }
    Ok(names)
}

fn parse_every(text: &str) -> Result<usize, SelectionError> {
    let [min, max] = EVERY;
    let number = text.parse().ok().filter(|number| (min..=max).contains(number));
    number.ok_or_else(|| SelectionError::Every(brief(text)))
}

impl From<SelectionError> for Problem {
    fn from(error: SelectionError) -> Self {
        let detail = error.to_string();
        let new = |kind, title| Self::new(StatusCode::UNPROCESSABLE_ENTITY, kind, title, detail);
        match error {
            SelectionError::Unknown { parameter, value, allowed } => new("/problems/unknown", "A name is not known")
                .with("parameter", parameter)
                .with("value", value)
                .with("allowed", allowed),
            SelectionError::EmptyColumn => new("/problems/malformed", "Not the list that is needed")
                .with("parameter", "columns")
                .with("message", "a name is empty"),
            SelectionError::DoubledColumn(name) => new("/problems/conflict", "Parameters contradict each other")
                .with("parameter", "columns")
                .with("value", name)
                .with("message", "asked for twice"),
            SelectionError::Every(value) => new("/problems/out-of-range", "A number is outside its allowed range")
                .with("parameter", "every")
                .with("value", value)
                .with("min", EVERY[0])
                .with("max", EVERY[1])
                .with("unit", "rows"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const SHAPE: Columns = Columns { joints: 3, parameters: 18 };

    fn refusal(columns: Option<&str>, every: Option<&str>) -> String {
        let places = Selection::parse(columns, every).and_then(|selection| selection.places(SHAPE));
        places.unwrap_err().to_string()
    }

    #[test]
    fn names_stand_where_the_csv_has_them() {
        let all = Selection::default().places(SHAPE).unwrap();
        assert_eq!(all, (0..SHAPE.width()).collect::<Vec<_>>());
        let some = Selection::parse(Some("s_rad_s_3, t_s,e_deg_1"), Some("10")).unwrap();
        assert_eq!((some.places(SHAPE).unwrap(), some.every()), (vec![36, 0, 1], 10));
    }

    #[test]
    fn says_what_is_wrong_and_what_would_be_right() {
        let unknown = refusal(Some("t_s,e_deg_4"), None);
        assert!(unknown.starts_with("columns: \"e_deg_4\" is not known; allowed: t_s, e_deg_1, e_deg_2"), "{unknown}");
        assert_eq!(refusal(Some("t_s,t_s"), None), "columns: \"t_s\" is asked for twice");
        for empty in ["", " ", ",", "t_s,", "t_s,,e_deg_1"] {
            assert!(refusal(Some(empty), None).starts_with("columns: a name is empty"), "{empty}");
        }
        for every in ["", "0", "-1", "1.5", "1000001", "99999999999999999999999", "x"] {
            let expected = format!("every: {every:?} is not a whole number from 1 to 1000000");
            assert_eq!(refusal(None, Some(every)), expected);
        }
        let format = Format::parse("xlsx").unwrap_err().to_string();
        assert_eq!(format, "format: \"xlsx\" is not known; allowed: csv, npz, parquet");
    }

    #[test]
    fn problems_name_the_parameter() {
        let problem = Problem::from(Selection::parse(None, Some("0")).unwrap_err());
        assert_eq!((problem.status, problem.kind), (422, "/problems/out-of-range"));
        assert_eq!((&problem.fields["parameter"], &problem.fields["max"]), (&"every".into(), &1_000_000.into()));
    }

    proptest! {
        #[test]
        fn takes_any_text(columns in ".{0,600}", every in ".{0,30}", format in ".{0,20}") {
            let _ = Selection::parse(Some(&columns), Some(&every)).and_then(|selection| selection.places(SHAPE));
            if let Err(error) = Format::parse(&format) {
                prop_assert!(error.to_string().chars().count() < 1000);
            }
        }
    }
}
