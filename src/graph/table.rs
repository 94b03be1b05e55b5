//! The numbers of graphs as a table.

use super::curve::Curve;

/// The numbers of all curves: a header, then one row for each point.
/// Neighbouring curves with the same horizontal values share the column of these values.
/// A cell is empty where a curve has no number.
pub(crate) fn rows(curves: &[Curve]) -> Vec<Vec<String>> {
    let mut columns: Vec<(String, &[f64])> = Vec::new();
    let mut over: Option<(&str, &[f64])> = None;
    for curve in curves {
        let own = (curve.x_key.as_str(), curve.x.as_slice());
        if over != Some(own) {
            columns.push((curve.x_key.clone(), &curve.x));
            over = Some(own);
        }
        columns.push((curve.key(), &curve.y));
    }
    let count = columns.iter().map(|(_, values)| values.len()).max().unwrap_or(0);
    let cell = |values: &[f64], row: usize| match values.get(row) {
        Some(value) if value.is_finite() => format!("{value:.16e}"),
        Some(_) | None => String::new(),
    };
    let header = columns.iter().map(|(name, _)| name.clone()).collect();
    let body = (0..count).map(|row| columns.iter().map(|(_, values)| cell(values, row)).collect());
    std::iter::once(header).chain(body).collect()
}
