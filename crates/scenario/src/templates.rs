//! Templates of mechanisms: commented scenarios whose dimensions are parameters.

use toml_edit::{DocumentMut, Item, Value};

use super::header::is_name;
use super::words::nearest;
use linkage::error::{Error, ErrorKind, Result};

/// A template of a mechanism.
#[derive(Debug)]
pub struct Template {
    /// Name by which the template is requested.
    pub name: &'static str,
    text: &'static str,
}

macro_rules! templates {
    ($($name:literal),* $(,)?) => {
        &[$(Template { name: $name, text: include_str!(concat!("templates/", $name, ".toml")) }),*]
    };
}

/// All templates, in the order in which they are listed to the user. A new template needs a file in `templates/` and
/// its name in this list.
pub static TEMPLATES: &[Template] = templates![
    "four-bar",
    "slider-crank",
    "inverted-slider",
    "quick-return",
    "watt",
    "stephenson",
    "jansen",
    "klann",
    "scissor",
    "pendulum",
    "class-iii",
    "class-iv",
    "excavator",
    "scissor-lift",
    "toggle-press",
    "geared-five-bar",
    "planetary",
    "cam-follower",
];

/// The template called `name`. Upper case counts as lower case, and `_` or a blank in `name` counts as `-`.
///
/// # Errors
/// [`ErrorKind::Input`] if no template has the name.
pub fn named(name: &str) -> Result<&'static Template> {
    let wanted = name.to_ascii_lowercase().replace(['_', ' '], "-");
    let names = || TEMPLATES.iter().map(|template| template.name);
    TEMPLATES.iter().find(|template| template.name == wanted).ok_or_else(|| {
        let near = nearest(&wanted, names()).map_or(String::new(), |near| format!("did you mean \"{near}\"? "));
        Error::new(ErrorKind::Input, format!("there is no template \"{name}\""))
            .help(format!("{near}The templates are: {}", names().collect::<Vec<_>>().join(", ")))
    })
}

/// Sets a value and keeps the comment and the blanks around it.
fn set(value: &mut Value, to: impl Into<Value>) {
    let decor = value.decor().clone();
    *value = to.into();
    *value.decor_mut() = decor;
}

/// A number as people write it. A whole number has no decimal point.
fn written(number: f64) -> Value {
    // Below 2^53, about 9e15, every whole number is exact, so it is written as an integer.
    let whole = (number.fract() == 0.0 && number.abs() < 9e15).then(|| format!("{number:.0}").parse::<i64>());
    match whole {
        Some(Ok(whole)) => whole.into(),
        Some(Err(_)) | None => number.into(),
    }
}

/// Keys and numbers of the parameters, as the template writes them.
fn parameters(document: &DocumentMut) -> Vec<(String, String)> {
    let plain = |item: &Item| item.as_value().map(|value| value.clone().decorated("", "").to_string());
    let table = document["parameters"].as_table();
    table.into_iter().flatten().map(|(key, item)| (key.into(), plain(item).unwrap_or_default())).collect()
}

impl Template {
    fn document(&self) -> DocumentMut {
        self.text.parse().expect("tests read every template")
    }

    /// Description of the template, in one line.
    #[must_use]
    pub fn title(&self) -> String {
        self.document()["title"].as_str().unwrap_or_default().into()
    }

    /// Name of a scenario that is made from the template, unless another name is given.
    #[must_use]
    pub fn scenario_name(&self) -> String {
        self.name.replace('-', "_")
    }

    /// Dimensions of the template, as `key = number`.
    #[must_use]
    pub fn dimensions(&self) -> String {
        let all = parameters(&self.document());
        all.iter().map(|(key, number)| format!("{key} = {number}")).collect::<Vec<_>>().join(", ")
    }

    /// The text of a scenario: the template, in which each dimension listed in `dimensions` has the value given there.
    /// The scenario gets the name `name` if this name is allowed for a scenario.
    pub fn scenario(&self, name: &str, dimensions: &[(String, f64)]) -> Result<String> {
        let mut document = self.document();
        if is_name(name)
            && let Some(own) = document["name"].as_value_mut()
        {
            set(own, name);
        }
        for (key, number) in dimensions {
            match document["parameters"].get_mut(key).and_then(Item::as_value_mut) {
                Some(value) => set(value, written(*number)),
                None => return Err(self.lacks(key)),
            }
        }
        Ok(document.to_string())
    }

    fn lacks(&self, key: &str) -> Error {
        let all = parameters(&self.document());
        let keys = || all.iter().map(|(key, _)| key.as_str());
        // A key that is the unknown key plus a unit is a better guess than the key with the nearest spelling.
        let with_unit = keys().find(|own| own.strip_prefix(key).is_some_and(|unit| unit.starts_with('_')));
        let near = with_unit.or_else(|| nearest(key, keys()));
        let near = near.map_or(String::new(), |near| format!("did you mean `{near}`? "));
        Error::new(ErrorKind::Input, format!("the template \"{}\" has no dimension `{key}`", self.name))
            .help(format!("{near}Its dimensions are: {}", self.dimensions()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_given_dimensions_and_the_name_change() {
        let template = named("four_bar").unwrap();
        assert_eq!(template.scenario("four_bar", &[]).unwrap(), template.text);
        let changed = template.scenario("mine", &[("crank_mm".into(), 30.0), ("density".into(), 0.25)]).unwrap();
        let lines = template.text.lines().zip(changed.lines()).filter(|(old, new)| old != new);
        let new: Vec<&str> = lines.map(|(_, new)| new.split(" #").next().unwrap()).collect();
        assert_eq!(new, ["name = \"mine\"", "crank_mm = 30", "density = 0.25"]);
        assert_eq!(changed.matches(" # ").count(), template.text.matches(" # ").count());
        // If `name` is not allowed for a scenario, the template's name is kept.
        assert!(template.scenario("Mine!", &[]).unwrap().contains("name = \"four_bar\""));
    }

    #[test]
    fn unknown_names_are_refused_with_the_known_ones() {
        let error = named("fourbar").unwrap_err().to_string();
        assert!(error.contains("did you mean \"four-bar\"?") && error.contains("class-iv"), "{error}");
        let error = named("four-bar").unwrap().scenario("a", &[("crank".into(), 1.0)]).unwrap_err().to_string();
        assert!(error.contains("`crank_mm`?") && error.contains("density = 1.5"), "{error}");
    }

    #[test]
    fn every_template_file_is_listed() {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("src/templates");
        let mut files: Vec<String> = std::fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().path().file_stem().unwrap().to_string_lossy().into_owned())
            .collect();
        let mut names: Vec<&str> = TEMPLATES.iter().map(|template| template.name).collect();
        files.sort();
        names.sort_unstable();
        assert_eq!(names, files);
    }
}
