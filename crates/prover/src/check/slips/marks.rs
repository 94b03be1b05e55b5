//! The smallest pieces of a formula's text that a correction changes.

use std::ops::Range;

use formula::{FormulaTree, NodeShape};

/// A wrong piece of a formula's text.
#[derive(Clone, Debug, PartialEq)]
pub struct FormulaMark {
    /// Byte range of the wrong piece in the text.
    pub at: Range<usize>,
    /// The right text in place of the wrong piece.
    pub right: String,
}

/// The pieces of `text` in which a formula differs from its correction, from left to right. Pieces without a position
/// in the text are left out.
pub(in crate::check) fn marks(text: &str, written: &FormulaTree, right: &FormulaTree) -> Vec<FormulaMark> {
    let mut found = Vec::new();
    differing(text, written, right, &mut found);
    found.retain(|mark| !mark.at.is_empty() && text.get(mark.at.clone()).is_some());
    found.sort_by_key(|mark| mark.at.start);
    found
}

fn is_same(one: &FormulaTree, other: &FormulaTree) -> bool {
    one.to_string() == other.to_string()
}

fn differing(text: &str, written: &FormulaTree, right: &FormulaTree, found: &mut Vec<FormulaMark>) {
    if is_same(written, right) {
        return;
    }
    // The correction adds a sign, a factor or a term to the unchanged subexpression.
    if right.parts().iter().any(|part| is_same(part, written)) {
        return found.push(FormulaMark { at: written.at.clone(), right: right.to_string() });
    }
    let parts = || written.parts().iter().zip(right.parts());
    let mut put = |at: Range<usize>, right: String| found.push(FormulaMark { at, right });
    match (&written.shape, &right.shape) {
        (NodeShape::Pair(own, ends), NodeShape::Pair(other, _))
            if own != other && parts().all(|(a, b)| is_same(a, b)) =>
        {
            let gap = ends[0].at.end..ends[1].at.start;
            let sign = text.get(gap.clone()).and_then(|between| between.find(own.sign()));
            match sign {
                Some(sign) => put(gap.start + sign..gap.start + sign + 1, other.sign().to_string()),
                None => put(written.at.clone(), right.to_string()),
            }
        }
        // A superfluous term or factor is marked together with its sign.
        (NodeShape::Pair(own, ends), _) if ends.iter().any(|end| is_same(end, right)) => {
            let gap = ends[0].at.end..ends[1].at.start;
            let sign = text.get(gap.clone()).and_then(|between| between.find(own.sign())).map(|sign| gap.start + sign);
            put(
                match sign {
                    Some(sign) if is_same(&ends[0], right) => sign..ends[1].at.end,
                    Some(sign) => ends[0].at.start..sign + 1,
                    None => written.at.clone(),
                },
                if sign.is_some() { String::new() } else { right.to_string() },
            );
        }
        (NodeShape::Pair(own, _), NodeShape::Pair(other, _)) if own == other => {
            parts().for_each(|(a, b)| differing(text, a, b, found));
        }
        (NodeShape::Call(own, all), NodeShape::Call(other, others)) if all.len() == others.len() => {
            if own != other {
                put(written.at.start..written.at.start + own.name().len(), other.name().to_string());
            }
            parts().for_each(|(a, b)| differing(text, a, b, found));
        }
        (NodeShape::Negative(_), NodeShape::Negative(_)) => parts().for_each(|(a, b)| differing(text, a, b, found)),
        // A superfluous minus sign is marked without its operand.
        (NodeShape::Negative(part), _) if is_same(part, right) => {
            let start = written.at.start;
            put(start..start + 1, String::new());
        }
        (
            NodeShape::Number(_)
            | NodeShape::Name(_)
            | NodeShape::Negative(_)
            | NodeShape::Pair(..)
            | NodeShape::Call(..),
            _,
        ) => put(written.at.clone(), right.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn marked(written: &str, right: &str) -> Vec<(String, String)> {
        let [one, other] = [written, right].map(|text| FormulaTree::parse(text).unwrap());
        let all = marks(written, &one, &other);
        all.into_iter().map(|mark| (written[mark.at].to_string(), mark.right)).collect()
    }

    #[test]
    fn the_smallest_wrong_part_is_marked() {
        let pairs = |all: &[(&str, &str)]| -> Vec<(String, String)> {
            all.iter().map(|(a, b)| (a.to_string(), b.to_string())).collect()
        };
        assert_eq!(marked("r*cos(x) + sqrt(l^2 + r^2)", "r*cos(x) + sqrt(l^2 - r^2)"), pairs(&[("+", "-")]));
        assert_eq!(marked("(a + b)*(c)", "(a - b)*(c)"), pairs(&[("+", "-")]));
        assert_eq!(marked("-w*sin(x)/cos(b)", "-w*cos(x)/cos(b)"), pairs(&[("sin", "cos")]));
        assert_eq!(marked("a*sin(b)", "b*sin(a)"), pairs(&[("a", "b"), ("b", "a")]));
        assert_eq!(marked("1 + 2*x", "1 + 3*x"), pairs(&[("2", "3")]));
        assert_eq!(marked("c - -b", "c - b"), pairs(&[("-", "")]));
        assert_eq!(marked("-r*sin(x)", "-r*sin(x)*w"), pairs(&[("-r*sin(x)", "-r*sin(x)*w")]));
        assert_eq!(marked("2*(a + b)", "2*a"), pairs(&[("+ b", "")]));
        assert_eq!(marked("a*b - c", "b - c"), pairs(&[("a*", "")]));
        assert_eq!(marked("x + y", "x + y"), pairs(&[]));
    }
}
