//! Parts of a scenario's text for readers who do not have the file.

use std::collections::BTreeSet;

use toml_edit::{DocumentMut, Item, TableLike, Value, value};

use super::Scenario;
use super::edit::document;
use super::parameters::{Parameters, arithmetic};
use super::renumbering::texts;
use super::varied::{listed, without_comments};

/// The tables of a list, such as `loads` or `transmissions`, as TOML, without comments.
/// Every expression is replaced by its value in the unit of its key.
/// Empty if the scenario has no such table.
#[must_use]
pub fn stated_tables(scenario: &Scenario, section: &str) -> String {
    let Ok(mut file) = document(&without_comments(&scenario.text)) else { return String::new() };
    listed(&mut file);
    let Some(Item::ArrayOfTables(mut tables)) = file.remove(section) else { return String::new() };
    let mut parameters = Parameters::default();
    scenario.formulas.parameters.iter().for_each(|own| parameters.push(own.clone()));
    let texts = texts();
    tables.iter_mut().for_each(|table| evaluate(table, &texts, &parameters));
    let mut own = DocumentMut::new();
    own.insert(section, Item::ArrayOfTables(tables));
    own.to_string().trim().to_string()
}

/// Replaces the expressions of a table, and of the tables in it, by their values. `texts` are the keys of other texts.
fn evaluate(table: &mut dyn TableLike, texts: &BTreeSet<&str>, parameters: &Parameters) {
    for (key, item) in table.iter_mut() {
        if let Some(inner) = item.as_table_like_mut() {
            evaluate(inner, texts, parameters);
        } else if let Some(all) = item.as_array_mut() {
            all.iter_mut().filter_map(Value::as_inline_table_mut).for_each(|inner| evaluate(inner, texts, parameters));
        } else if let Some(text) = item.as_str().filter(|_| !texts.contains(key.get()))
            && let Ok(number) = arithmetic(text, key.get(), parameters)
        {
            // Twelve digits hide rounding errors such as 0.30000000000000004.
            *item = value(format!("{number:.11e}").parse::<f64>().unwrap_or(number));
        }
    }
}
