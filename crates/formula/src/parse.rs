//! Parser from text to a tree.

use crate::sentences;
use std::ops::Range;

use winnow::combinator::{Infix, Prefix, expression};
use winnow::error::{ErrMode, ParserError};
use winnow::stream::{LocatingSlice, Location, Stream};
use winnow::{ModalResult, Parser};

use crate::tree::{FormulaFault, FormulaTree, Function, NodeShape, Operator};

/// Upper limit of the length of a formula's text (bytes). A notebook page has several thousand bytes.
const LONGEST: usize = 20_000;
/// Upper limit of the nesting depth of a formula. The limit prevents a stack overflow.
const DEEPEST: usize = 200;

type Input<'a> = LocatingSlice<&'a str>;

/// A fault found while the text was parsed; `None` if the parser may try another alternative.
#[derive(Debug)]
struct Found(Option<FormulaFault>);

impl<'a> ParserError<Input<'a>> for Found {
    type Inner = Self;

    fn from_input(_: &Input<'a>) -> Self {
        Found(None)
    }

    fn into_inner(self) -> Result<Self, Self> {
        Ok(self)
    }
}

type Read<T> = ModalResult<T, Found>;

fn refused<T>(message: impl Into<String>, at: Range<usize>, help: impl Into<String>) -> Read<T> {
    Err(ErrMode::Cut(Found(Some(FormulaFault::new(message, at, help)))))
}

impl FormulaTree {
    /// Parses a formula: numbers, names (with dots if needed), `+ - * / ^`, parentheses and calls of a [`Function`].
    /// A name that contains any other character, such as a space in a column's name, is put in backquotes.
    /// `^` is right-associative and binds tighter than a minus before it: -x^2 is -(x^2), 2^3^2 is 2^9.
    ///
    /// # Errors
    /// The text that cannot be parsed, with its position and the remedy.
    pub fn parse(text: &str) -> Result<FormulaTree, FormulaFault> {
        bounded(text)?;
        whole(&mut LocatingSlice::new(text)).map_err(|error| match error {
            ErrMode::Cut(Found(Some(fault))) | ErrMode::Backtrack(Found(Some(fault))) => fault,
            ErrMode::Cut(Found(None)) | ErrMode::Backtrack(Found(None)) | ErrMode::Incomplete(_) => FormulaFault::new(
                sentences::THIS_IS_NO_FORMULA,
                0..text.len(),
                sentences::WRITE_AN_EXPRESSION_SUCH_AS_A_COS,
            ),
        })
    }
}

/// Checks that the parsing of the text cannot exhaust memory or stack.
fn bounded(text: &str) -> Result<(), FormulaFault> {
    if text.len() > LONGEST {
        let message = sentences::the_formula_has_bytes_more(&text.len(), &LONGEST);
        return Err(FormulaFault::new(message, LONGEST..text.len(), sentences::DIVIDE_IT_A_FORMULA_MAY_USE));
    }
    let (mut open, mut signs, mut powers) = (0usize, 0usize, 0usize);
    for (index, byte) in text.bytes().enumerate() {
        match byte {
            b'(' => open += 1,
            b')' => open = open.saturating_sub(1),
            // Powers, and several signs in a row, nest to the right, so they are counted against the depth limit.
            b'^' => powers += 1,
            b'-' | b'+' => signs += 1,
            b' ' => {}
            _ => signs = 0,
        }
        if open.max(signs).max(powers) > DEEPEST {
            let message = sentences::the_formula_is_nested_deeper(&DEEPEST);
            return Err(FormulaFault::new(message, index..index + 1, sentences::DIVIDE_IT_A_FORMULA_MAY_USE));
        }
    }
    Ok(())
}

fn whole(input: &mut Input<'_>) -> Read<FormulaTree> {
    let found = sum(input)?;
    let at = input.current_token_start();
    let rest: &str = input;
    match rest.chars().next() {
        None => Ok(found),
        Some(')') => refused(sentences::THERE_IS_NO_BEFORE_THIS, at..at + 1, sentences::TAKE_IT_OUT_OR_OPEN_IT),
        Some('=') => refused(sentences::A_FORMULA_HAS_NO, at..at + 1, sentences::WRITE_THE_RIGHT_SIDE_ONLY),
        Some(other) => no_operator(other, at),
    }
}

/// The fault if the character `sign` stands where an operator or the end of an operand is expected.
fn no_operator<T>(sign: char, at: usize) -> Read<T> {
    let own = at..at + sign.len_utf8();
    if sign == ',' {
        return refused(sentences::A_COMMA_STANDS_BETWEEN_ARGUMENTS, own, sentences::WRITE_NUMBERS_WITH_A_DECIMAL);
    }
    if sign.is_ascii_alphanumeric() || sign == '(' || sign == '_' {
        let message = sentences::an_operator_is_missing_before(&sign);
        return refused(message, own, sentences::WRITE_A_PRODUCT_WITH_SUCH_AS_PHI);
    }
    unknown_sign(sign, at)
}

fn unknown_sign<T>(sign: char, at: usize) -> Read<T> {
    let help = match sign {
        '·' | '×' | '∙' => sentences::WRITE_A_PRODUCT_WITH,
        '÷' | ':' => sentences::WRITE_A_QUOTIENT_WITH,
        '²' | '³' => sentences::WRITE_A_POWER_WITH_SUCH_AS,
        '−' | '–' => sentences::WRITE_A_MINUS_AS,
        'φ' | 'ϕ' => sentences::WRITE_THE_CRANK_ANGLE_AS_PHI,
        '√' => sentences::WRITE_A_SQUARE_ROOT_AS_SQRT,
        'π' => "write pi",
        '[' | '{' => sentences::USE_PARENTHESES,
        _ => sentences::NUMBERS_NAMES_AND_FUNCTIONS_MAKE,
    };
    refused(sentences::has_no_meaning_in_a_formula(&sign), at..at + sign.len_utf8(), help)
}

fn skip(input: &mut Input<'_>) {
    let spaces = input.len() - input.trim_start().len();
    let _ = input.next_slice(spaces);
}

fn sum(input: &mut Input<'_>) -> Read<FormulaTree> {
    skip(input);
    expression(operand).prefix(sign).infix(between).parse_next(input)
}

/// A minus or plus sign before an operand.
fn sign<'a>(input: &mut Input<'a>) -> Read<Prefix<Input<'a>, FormulaTree, ErrMode<Found>>> {
    let at = input.current_token_start();
    let first = input.chars().next();
    match first {
        Some('-') => {
            take(input, 1);
            Ok(Prefix(30, |_, part| Ok(negative(part))))
        }
        Some('+') => {
            take(input, 1);
            Ok(Prefix(30, |_, part| Ok(part)))
        }
        Some('*' | '/' | '^') => refused(sentences::A_PART_IS_MISSING_BEFORE_THIS_OPERATOR, at..at + 1, "add it"),
        Some(_) | None => none(),
    }
}

fn negative(part: FormulaTree) -> FormulaTree {
    // The text range of the negated formula begins one byte before its operand.
    // The byte before the operand is the minus or a space behind the minus.
    let at = part.at.start.saturating_sub(1)..part.at.end;
    FormulaTree { shape: NodeShape::Negative(Box::new(part)), at }
}

fn between<'a>(input: &mut Input<'a>) -> Read<Infix<Input<'a>, FormulaTree, ErrMode<Found>>> {
    let text: &str = input;
    let (length, found) = match text.as_bytes() {
        // `**` is recognised as a power, as in Python and Fortran.
        [b'*', b'*', ..] => (2, Operator::Power),
        [b'+', ..] => (1, Operator::Plus),
        [b'-', ..] => (1, Operator::Minus),
        [b'*', ..] => (1, Operator::Times),
        [b'/', ..] => (1, Operator::Over),
        [b'^', ..] => (1, Operator::Power),
        _ => return none(),
    };
    take(input, length);
    Ok(match found {
        Operator::Plus => Infix::Left(10, |_, left, right| Ok(pair(Operator::Plus, left, right))),
        Operator::Minus => Infix::Left(10, |_, left, right| Ok(pair(Operator::Minus, left, right))),
        Operator::Times => Infix::Left(20, |_, left, right| Ok(pair(Operator::Times, left, right))),
        Operator::Over => Infix::Left(20, |_, left, right| Ok(pair(Operator::Over, left, right))),
        Operator::Power => Infix::Right(40, |_, left, right| Ok(pair(Operator::Power, left, right))),
    })
}

fn pair(operator: Operator, left: FormulaTree, right: FormulaTree) -> FormulaTree {
    let at = left.at.start..right.at.end;
    FormulaTree { shape: NodeShape::Pair(operator, Box::new([left, right])), at }
}

fn none<T>() -> Read<T> {
    Err(ErrMode::Backtrack(Found(None)))
}

/// Consumes the given number of bytes, and the spaces after them.
fn take(input: &mut Input<'_>, bytes: usize) {
    let _ = input.next_slice(bytes);
    skip(input);
}

fn operand(input: &mut Input<'_>) -> Read<FormulaTree> {
    let start = input.current_token_start();
    let text: &str = input;
    match text.chars().next() {
        Some('(') => parentheses(input, start),
        Some(first) if first.is_ascii_digit() || first == '.' => number(input, start),
        Some(first) if first.is_ascii_alphabetic() || first == '_' => name(input, start),
        Some('`') => quoted(input, start),
        None => {
            refused(sentences::THE_FORMULA_ENDS_WHERE_A_PART, start..start, sentences::ADD_A_NUMBER_A_NAME_OR_A_CALL)
        }
        // No operand begins with a plus or minus. At such a character, the parser tries to read a sign instead.
        Some('-' | '+') => none(),
        Some(sign @ (')' | ',' | '=' | '*' | '/' | '^')) => {
            let message = sentences::a_part_is_missing_before(&sign);
            refused(message, start..start + 1, sentences::ADD_A_NUMBER_A_NAME_OR_A_CALL)
        }
        Some(other) => unknown_sign(other, start),
    }
}

fn parentheses(input: &mut Input<'_>, start: usize) -> Read<FormulaTree> {
    take(input, 1);
    let mut inner = sum(input)?;
    closed(input, start)?;
    inner.at = start..input.previous_token_end();
    skip(input);
    Ok(inner)
}

/// Consumes the closing parenthesis that belongs to the opening parenthesis at `start`.
fn closed(input: &mut Input<'_>, start: usize) -> Read<()> {
    let at = input.current_token_start();
    match input.chars().next() {
        Some(')') => {
            let _ = input.next_slice(1);
            Ok(())
        }
        None => refused(sentences::THIS_IS_NOT_CLOSED, start..start + 1, "add `)`"),
        Some(other) => no_operator(other, at),
    }
}

fn number(input: &mut Input<'_>, start: usize) -> Read<FormulaTree> {
    let text: &str = input;
    let bytes = text.as_bytes();
    let digits = |from: usize| from + bytes[from..].iter().take_while(|byte| byte.is_ascii_digit()).count();
    let mut end = digits(0);
    if bytes.get(end) == Some(&b'.') {
        end = digits(end + 1);
    }
    if let Some(b'e' | b'E') = bytes.get(end) {
        let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        let last = digits(end + 1 + sign);
        if last > end + 1 + sign {
            end = last;
        }
    }
    let written = &text[..end];
    let Some(value) = written.parse::<f64>().ok().filter(|value| value.is_finite()) else {
        let message = sentences::is_no_finite_number(&written);
        return refused(message, start..start + end, sentences::WRITE_A_NUMBER_SUCH_AS);
    };
    take(input, end);
    Ok(FormulaTree { shape: NodeShape::Number(value), at: start..start + end })
}

fn name(input: &mut Input<'_>, start: usize) -> Read<FormulaTree> {
    let text: &str = input;
    let belongs = |byte: &u8| byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b'.');
    let end = text.bytes().take_while(belongs).count();
    let name = &text[..end];
    let at = start..start + end;
    take(input, end);
    let is_call = input.starts_with('(');
    match Function::named(name) {
        Some(function) if is_call => call(input, function, at),
        Some(function) => {
            let help = sentences::write_it_with_parentheses_phi(&function.name());
            refused(sentences::the_function_has_no_argument(&function.name()), at, help)
        }
        None if is_call => {
            let known = Function::ALL.map(Function::name).join(", ");
            let help = match name {
                "arcsin" | "arccos" | "arctan" | "arctan2" => format!("write {}", name.replacen("arc", "a", 1)),
                "log" => sentences::WRITE_LN_FOR_THE_NATURAL.to_string(),
                "cot" | "sec" | "csc" => sentences::WRITE_IT_BY_SIN_COS_AND_TAN.to_string(),
                "pow" => sentences::WRITE_A_POWER_WITH.to_string(),
                _ => sentences::the_functions_are_write_a_product(&known),
            };
            refused(sentences::there_is_no_function(&name), at, help)
        }
        None => Ok(FormulaTree { shape: NodeShape::Name(name.into()), at }),
    }
}

/// A name between backquotes.
fn quoted(input: &mut Input<'_>, start: usize) -> Read<FormulaTree> {
    let text: &str = input;
    let Some(length) = text[1..].find('`').filter(|&length| length > 0) else {
        return refused(sentences::THIS_BACKQUOTE_OPENS_NO_NAME, start..start + 1, sentences::CLOSE_IT_BEHIND_THE_NAME);
    };
    let name = text[1..=length].to_string();
    let at = start..start + length + 2;
    take(input, length + 2);
    Ok(FormulaTree { shape: NodeShape::Name(name), at })
}

fn call(input: &mut Input<'_>, function: Function, name: Range<usize>) -> Read<FormulaTree> {
    let open = input.current_token_start();
    take(input, 1);
    let mut parts = vec![sum(input)?];
    while parts.len() < function.arity() && input.starts_with(',') {
        take(input, 1);
        parts.push(sum(input)?);
    }
    if parts.len() < function.arity() {
        let message = sentences::needs_arguments(&function.name(), &function.arity());
        return refused(message, name, sentences::WRITE_ATAN2_WITH_THE_SINE);
    }
    closed(input, open)?;
    let at = name.start..input.previous_token_end();
    skip(input);
    Ok(FormulaTree { shape: NodeShape::Call(function, parts), at })
}
