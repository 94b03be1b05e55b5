//! Words for messages: lists, and the nearest known name to a misspelt one.

/// The candidate that `word` most probably stands for, if one is near enough.
#[must_use]
pub fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    // In names of one or two letters one letter is no slip but another name.
    let length = word.chars().count();
    let allowed = if length < 3 { 0 } else { ((length + 1) / 3).min(3) };
    candidates
        .into_iter()
        .map(|candidate| (distance(word, candidate), candidate))
        .filter(|&(distance, _)| distance <= allowed)
        .min_by_key(|&(distance, _)| distance)
        .map(|(_, candidate)| candidate)
}

/// `a, b or c`, each as Rust would quote it if `quote` is a quotation mark.
#[must_use]
pub fn choice<'a>(words: impl IntoIterator<Item = &'a str>, quote: &str) -> String {
    let words: Vec<String> = words.into_iter().map(|word| format!("{quote}{word}{quote}")).collect();
    match words.split_last() {
        None => "nothing".into(),
        Some((last, [])) => last.clone(),
        Some((last, rest)) => format!("{} or {last}", rest.join(", ")),
    }
}

/// "did you mean" with the nearest candidate, or else the list of all.
#[must_use]
pub fn suggestion<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>, quote: &str) -> String {
    let candidates: Vec<&str> = candidates.into_iter().collect();
    match nearest(word, candidates.iter().copied()) {
        Some(near) => format!("did you mean {quote}{near}{quote}?"),
        None if candidates.is_empty() => "there is none that could be named here".into(),
        None => format!("allowed here: {}", choice(candidates, quote)),
    }
}

/// Number of letters to insert, remove, exchange or swap with their neighbour to turn `a` into `b`.
fn distance(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
    let mut rows = vec![vec![0; b.len() + 1]; a.len() + 1];
    for i in 0..=a.len() {
        for j in 0..=b.len() {
            rows[i][j] = if i == 0 || j == 0 {
                i + j
            } else {
                let exchanged = rows[i - 1][j - 1] + usize::from(a[i - 1] != b[j - 1]);
                let mut least = exchanged.min(rows[i - 1][j] + 1).min(rows[i][j - 1] + 1);
                if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                    least = least.min(rows[i - 2][j - 2] + 1);
                }
                least
            };
        }
    }
    rows[a.len()][b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_count_single_slips() {
        assert_eq!(distance("mass_kg", "mass_kg"), 0);
        assert_eq!(distance("mas_kg", "mass_kg"), 1);
        assert_eq!(distance("lnegth_mm", "length_mm"), 1);
        assert_eq!(distance("", "abc"), 3);
    }

    #[test]
    fn only_a_near_word_is_suggested() {
        assert_eq!(nearest("rokcer", ["crank", "rocker"]), Some("rocker"));
        assert_eq!(nearest("wheel", ["crank", "rocker"]), None);
        assert_eq!(nearest("B", ["A", "C"]), None);
        assert_eq!(nearest("velocity", ["positions", "velocities"]), Some("velocities"));
        assert_eq!(suggestion("wheel", ["crank", "rocker"], "\""), "allowed here: \"crank\" or \"rocker\"");
    }
}
