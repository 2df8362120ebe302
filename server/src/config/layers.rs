//! The layers that settings come from: a TOML file, the environment, flags.
//!
//! Each value is checked against its setting where its place is still known, then handed to the crate `config` as a source.

use super::error::ConfigError;
use super::setting::{Form, Setting};
use config::{Map, Source, Value, ValueKind};
use std::ffi::OsString;
use toml::de::{DeTable, DeValue};

/// A value, before it is known whether its setting can have it.
#[derive(Debug, PartialEq)]
enum Given {
    Integer(i128),
    Number(f64),
    Switch(bool),
    Text(String),
    List(Vec<String>),
    /// Anything else, in words.
    Other(String),
}

/// The values of one layer, each with its place.
#[derive(Debug, Clone, Default)]
pub(super) struct Layer(Map<String, Value>);

impl Source for Layer {
    fn clone_into_box(&self) -> Box<dyn Source + Send + Sync> {
        Box::new(self.clone())
    }

    fn collect(&self) -> Result<Map<String, Value>, config::ConfigError> {
        Ok(self.0.clone())
    }
}

impl Layer {
    fn add(&mut self, setting: &Setting, given: Given, place: &str) -> Result<(), ConfigError> {
        let kind = accept(setting, given, place)?;
        self.0.insert(setting.key(), Value::new(Some(&place.to_owned()), kind));
        Ok(())
    }

    /// From the text of a file of this name.
    pub(super) fn file(name: &str, text: &str, settings: &[&'static Setting]) -> Result<Self, ConfigError> {
        let table = DeTable::parse(text).map_err(|error| {
            let at = error.span().map_or(0, |span| span.start);
            let before = text.get(..at).unwrap_or_default();
            let column = before.chars().rev().take_while(|character| *character != '\n').count() + 1;
            let place = format!("{name}:{}:{column}", line(text, at));
            ConfigError::Syntax { place, message: error.message().to_owned() }
        })?;
        let mut layer = Self::default();
        layer.table(table.get_ref(), "", settings, &|at| format!("{name}:{}", line(text, at)))?;
        Ok(layer)
    }

    fn table(
        &mut self,
        table: &DeTable<'_>,
        section: &str,
        settings: &[&'static Setting],
        place: &dyn Fn(usize) -> String,
    ) -> Result<(), ConfigError> {
        // By their order in the file: the first mistake is told first.
        let mut entries: Vec<_> = table.iter().collect();
        entries.sort_by_key(|(key, _)| key.span().start);
        for (key, value) in entries {
            let (name, place_of_key) = (key.get_ref().as_ref(), place(key.span().start));
            if section.is_empty() && settings.iter().any(|setting| setting.section == name) {
                let DeValue::Table(inner) = value.get_ref() else {
                    return Err(ConfigError::Type {
                        place: place_of_key,
                        key: name.to_owned(),
                        found: words(value.get_ref()),
                        expected: format!("a section, [{name}]"),
                    });
                };
                self.table(inner, name, settings, place)?;
                continue;
            }
            let setting = settings.iter().find(|setting| setting.section == section && setting.name == name);
            let setting = setting.ok_or_else(|| unknown(place_of_key.clone(), section, name, settings))?;
            self.add(setting, given(value.get_ref()), &place_of_key)?;
        }
        Ok(())
    }

    /// From environment variables. `RUST_LOG` is one of them; an empty one counts as not set.
    pub(super) fn environment(
        variables: &[(String, OsString)],
        settings: &[&'static Setting],
    ) -> Result<Self, ConfigError> {
        let mut layer = Self::default();
        let set = |name: &str| variables.iter().find(|(variable, value)| variable == name && !value.is_empty());
        for setting in settings {
            let general = if setting.key() == "log.filter" { set("RUST_LOG") } else { None };
            if let Some((variable, value)) = set(&setting.variable()).or(general) {
                let place = format!("variable {variable}");
                let strange = || ConfigError::wrong_type(&place, setting, "something that is not UTF-8");
                layer.add(setting, written(setting, value.to_str().ok_or_else(strange)?), &place)?;
            }
        }
        let sections = settings.iter().map(|setting| setting.section).filter(|section| !section.is_empty());
        let prefixes: Vec<_> =
            sections.map(|section| (section, format!("ADAPTARM_{}_", section.to_uppercase()))).collect();
        for (variable, _) in variables {
            let within = prefixes.iter().find(|(_, prefix)| variable.starts_with(prefix));
            let known = || settings.iter().any(|setting| setting.variable() == *variable);
            if let Some((section, prefix)) = within
                && !known()
                && !is_of_a_service(variable)
            {
                let name = variable[prefix.len()..].to_lowercase();
                return Err(unknown(format!("variable {variable}"), section, &name, settings));
            }
        }
        Ok(layer)
    }

    /// From flags, by the keys of their settings.
    pub(super) fn flags(flags: &[(&str, String)], settings: &[&'static Setting]) -> Result<Self, ConfigError> {
        let mut layer = Self::default();
        for (key, value) in flags {
            let flag = format!("--{}", key.replace(['.', '_'], "-"));
            let setting = settings.iter().find(|setting| setting.key() == *key);
            let setting = setting.ok_or_else(|| unknown(flag.clone(), "", key, settings))?;
            layer.add(setting, written(setting, value), &flag)?;
        }
        Ok(layer)
    }
}

/// Line of a byte; the first is 1.
fn line(text: &str, at: usize) -> usize {
    text.as_bytes().iter().take(at).filter(|byte| **byte == b'\n').count() + 1
}

/// Kubernetes tells every container about services named like our sections: ADAPTARM_SERVER_PORT_80_TCP.
fn is_of_a_service(variable: &str) -> bool {
    variable.contains("_SERVICE_") || variable.contains("_PORT")
}

fn unknown(place: String, section: &str, name: &str, settings: &[&'static Setting]) -> ConfigError {
    // Quoted keys can hold anything, and the message is one line.
    let name = name.escape_debug();
    let key = if section.is_empty() { name.to_string() } else { format!("{section}.{name}") };
    let mut allowed: Vec<_> =
        settings.iter().filter(|setting| setting.section == section).map(|setting| setting.name).collect();
    if section.is_empty() {
        allowed.extend(settings.iter().map(|setting| setting.section).filter(|section| !section.is_empty()));
        allowed.dedup();
    }
    ConfigError::Unknown { place, key, allowed }
}

/// A value as TOML has it.
fn given(value: &DeValue<'_>) -> Given {
    match value {
        DeValue::Integer(integer) => i128::from_str_radix(integer.as_str(), integer.radix())
            .map_or_else(|_| Given::Other(format!("{integer}")), Given::Integer),
        DeValue::Float(number) => {
            number.as_str().parse().map_or_else(|_| Given::Other(format!("{number}")), Given::Number)
        }
        DeValue::Boolean(switch) => Given::Switch(*switch),
        DeValue::String(text) => Given::Text(text.clone().into_owned()),
        DeValue::Array(items) => {
            let texts = items.iter().map(|item| match item.get_ref() {
                DeValue::String(text) => Ok(text.clone().into_owned()),
                other => Err(format!("a list with {}", words(other))),
            });
            texts.collect::<Result<_, _>>().map_or_else(Given::Other, Given::List)
        }
        DeValue::Datetime(_) | DeValue::Table(_) => Given::Other(words(value)),
    }
}

/// A value written in the environment or as a flag: a bare text that the setting's type gives its meaning.
fn written(setting: &Setting, text: &str) -> Given {
    let trimmed = text.trim();
    let read = match setting.rule.form {
        Form::Integer { .. } => trimmed.replace('_', "").parse().ok().map(Given::Integer),
        Form::Number { .. } => trimmed.parse().ok().map(Given::Number),
        Form::Switch => trimmed.parse().ok().map(Given::Switch),
        Form::Text(_) => None,
        Form::List(_) => {
            let items = text.split(',').map(str::trim).filter(|item| !item.is_empty());
            Some(Given::List(items.map(str::to_owned).collect()))
        }
    };
    read.unwrap_or_else(|| Given::Text(text.to_owned()))
}

fn words(value: &DeValue<'_>) -> String {
    match value {
        DeValue::String(text) => format!("the text {text:?}"),
        DeValue::Integer(integer) => format!("the number {integer}"),
        DeValue::Float(number) => format!("the number {number}"),
        DeValue::Boolean(switch) => switch.to_string(),
        DeValue::Datetime(_) => "a date".to_owned(),
        DeValue::Array(_) => "a list".to_owned(),
        DeValue::Table(_) => "a section".to_owned(),
    }
}

/// The value as `config` takes it, if its setting may have it.
fn accept(setting: &Setting, given: Given, place: &str) -> Result<ValueKind, ConfigError> {
    let out_of_range = |value: String| ConfigError::OutOfRange {
        place: place.to_owned(),
        key: setting.key(),
        value,
        range: setting.rule.form.range(),
    };
    let checked = |check: super::setting::Check, text: String| {
        check(&text).map_err(|message| {
            let value = (!setting.rule.secret).then_some(text);
            ConfigError::Text { place: place.to_owned(), key: setting.key(), value, message }
        })
    };
    match (setting.rule.form, given) {
        (Form::Integer { min, max, .. }, Given::Integer(value)) => match u64::try_from(value) {
            Ok(value) if (min..=max).contains(&value) => Ok(value.into()),
            _ => Err(out_of_range(value.to_string())),
        },
        (Form::Number { min, max, .. }, Given::Number(value)) if (min..=max).contains(&value) => Ok(value.into()),
        (Form::Number { min, max, .. }, Given::Integer(value)) if (min..=max).contains(&(value as f64)) => {
            Ok((value as f64).into())
        }
        (Form::Number { .. }, Given::Number(value)) => Err(out_of_range(value.to_string())),
        (Form::Number { .. }, Given::Integer(value)) => Err(out_of_range(value.to_string())),
        (Form::Switch, Given::Switch(value)) => Ok(value.into()),
        (Form::Text(check), Given::Text(text)) => checked(check, text).map(Into::into),
        (Form::List(check), Given::List(texts)) => {
            let texts = texts.into_iter().map(|text| checked(check, text));
            texts.collect::<Result<Vec<_>, _>>().map(Into::into)
        }
        (_, given) => Err(ConfigError::wrong_type(
            place,
            setting,
            match given {
                Given::Integer(value) => format!("the number {value}"),
                Given::Number(value) => format!("the number {value}"),
                Given::Switch(value) => value.to_string(),
                Given::Text(text) => format!("the text {text:?}"),
                Given::List(_) => "a list".to_owned(),
                Given::Other(words) => words,
            },
        )),
    }
}
