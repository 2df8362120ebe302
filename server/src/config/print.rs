//! Settings as a TOML file: those in force with their places, and the commented example with every default.

use super::load::Loaded;
use super::{Config, Setting};

/// Settings in force; whatever is not a default says where it comes from. Secrets are masked.
pub fn effective(loaded: &Loaded) -> String {
    let threads = loaded.config.thread_count();
    written(&loaded.config, |setting, value| {
        let place = loaded.places.get(&setting.key()).map(|place| format!("  # {place}")).unwrap_or_default();
        vec![match value {
            Some(value) => format!("{} = {value}{place}", setting.name),
            None if setting.name == "threads" => format!("# threads = {threads}, as many as processors"),
            None => format!("# {} is not set", setting.name),
        }]
    })
}

/// A file that sets every setting to its default, and tells what each means.
pub fn example() -> String {
    let head = "# Settings of adaptarm, each with its default. `adaptarm config check --config FILE` checks a file like this.\n\
         # A setting's environment variable wins over this file, and a flag over both.\n";
    let settings = written(&Config::default(), |setting, value| {
        let mut lines = vec![String::new()];
        lines.extend(setting.doc.iter().map(|line| format!("# {}", line.trim())));
        let range = Some(setting.rule.form.range()).filter(|range| !range.is_empty());
        let range = range.map(|range| format!("{range}; ")).unwrap_or_default();
        lines.push(format!("# {range}{}", setting.variable()));
        lines.push(match value {
            Some(value) => format!("{} = {value}", setting.name),
            None => format!("# {} = {}", setting.name, setting.rule.example),
        });
        lines
    });
    head.to_owned() + &settings
}

/// All settings in the order of the file, a heading before each section.
fn written(config: &Config, lines_of: impl Fn(&Setting, Option<String>) -> Vec<String>) -> String {
    let mut lines = Vec::new();
    let mut section = "";
    for (setting, value) in Config::settings().into_iter().zip(config.shown()) {
        if section != setting.section {
            section = setting.section;
            lines.extend([String::new(), format!("[{section}]")]);
        }
        lines.extend(lines_of(setting, value));
    }
    lines.join("\n") + "\n"
}
