//! From text to a tree.

use std::ops::Range;

use winnow::combinator::{Infix, Prefix, expression};
use winnow::error::{ErrMode, ParserError};
use winnow::stream::{LocatingSlice, Location, Stream};
use winnow::{ModalResult, Parser};

use crate::tree::{Fault, Function, Operator, Shape, Tree};

/// Longest text of a formula (bytes): a notebook page has some thousand.
const LONGEST: usize = 20_000;
/// Deepest nesting, so that no text uses up the stack.
const DEEPEST: usize = 200;

type Input<'a> = LocatingSlice<&'a str>;

/// A fault while reading; without one, another alternative may fit.
#[derive(Debug)]
struct Found(Option<Fault>);

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
    Err(ErrMode::Cut(Found(Some(Fault::new(message, at, help)))))
}

impl Tree {
    /// Reads a formula: numbers, names (they may contain dots), `+ - * / ^`, parentheses and calls of a [`Function`].
    /// A name with other signs in it, such as a column's, stands between backquotes.
    /// `^` binds to the right, and closer than a minus before it: -x^2 is -(x^2), 2^3^2 is 2^9.
    ///
    /// # Errors
    /// What cannot be read, with its place and the way out.
    pub fn parse(text: &str) -> Result<Tree, Fault> {
        bounded(text)?;
        whole(&mut LocatingSlice::new(text)).map_err(|error| match error {
            ErrMode::Cut(Found(Some(fault))) | ErrMode::Backtrack(Found(Some(fault))) => fault,
            ErrMode::Cut(Found(None)) | ErrMode::Backtrack(Found(None)) | ErrMode::Incomplete(_) => {
                Fault::new("this is no formula", 0..text.len(), "write an expression such as a*cos(phi) + b")
            }
        })
    }
}

/// Whether reading it can use up neither memory nor stack.
fn bounded(text: &str) -> Result<(), Fault> {
    if text.len() > LONGEST {
        let message = format!("the formula has {} bytes, more than {LONGEST}", text.len());
        return Err(Fault::new(message, LONGEST..text.len(), "divide it: a formula may use those before it by name"));
    }
    let (mut open, mut signs, mut powers) = (0usize, 0usize, 0usize);
    for (index, byte) in text.bytes().enumerate() {
        match byte {
            b'(' => open += 1,
            b')' => open = open.saturating_sub(1),
            // Powers, and signs in a row, nest to the right.
            b'^' => powers += 1,
            b'-' | b'+' => signs += 1,
            b' ' => {}
            _ => signs = 0,
        }
        if open.max(signs).max(powers) > DEEPEST {
            let message = format!("the formula is nested deeper than {DEEPEST}");
            return Err(Fault::new(message, index..index + 1, "divide it: a formula may use those before it by name"));
        }
    }
    Ok(())
}

fn whole(input: &mut Input<'_>) -> Read<Tree> {
    let found = sum(input)?;
    let at = input.current_token_start();
    let rest: &str = input;
    match rest.chars().next() {
        None => Ok(found),
        Some(')') => refused("there is no `(` before this `)`", at..at + 1, "take it out, or open it"),
        Some('=') => refused("a formula has no `=`", at..at + 1, "write the right side only"),
        Some(other) => no_operator(other, at),
    }
}

/// A sign where an operator or the end of a part could stand.
fn no_operator<T>(sign: char, at: usize) -> Read<T> {
    let own = at..at + sign.len_utf8();
    if sign == ',' {
        let help = "write numbers with a decimal point, such as 0.5";
        return refused("a comma stands between arguments of atan2 only", own, help);
    }
    if sign.is_ascii_alphanumeric() || sign == '(' || sign == '_' {
        let message = format!("an operator is missing before `{sign}`");
        return refused(message, own, "write a product with `*`, such as 2*phi");
    }
    unknown_sign(sign, at)
}

fn unknown_sign<T>(sign: char, at: usize) -> Read<T> {
    let help = match sign {
        '·' | '×' | '∙' => "write a product with `*`",
        '÷' | ':' => "write a quotient with `/`",
        '²' | '³' => "write a power with `^`, such as x^2",
        '−' | '–' => "write a minus as `-`",
        'φ' | 'ϕ' => "write the crank angle as phi",
        '√' => "write a square root as sqrt(x)",
        'π' => "write pi",
        '[' | '{' => "use parentheses: ( )",
        _ => "numbers, names, + - * / ^ ( ) and functions make up a formula",
    };
    refused(format!("`{sign}` has no meaning in a formula"), at..at + sign.len_utf8(), help)
}

fn skip(input: &mut Input<'_>) {
    let spaces = input.len() - input.trim_start().len();
    let _ = input.next_slice(spaces);
}

fn sum(input: &mut Input<'_>) -> Read<Tree> {
    skip(input);
    expression(operand).prefix(sign).infix(between).parse_next(input)
}

/// A minus or plus before a part.
fn sign<'a>(input: &mut Input<'a>) -> Read<Prefix<Input<'a>, Tree, ErrMode<Found>>> {
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
        Some('*' | '/' | '^') => refused("a part is missing before this operator", at..at + 1, "add it"),
        Some(_) | None => none(),
    }
}

fn negative(part: Tree) -> Tree {
    // The minus stands before it, with blanks between at most.
    let at = part.at.start.saturating_sub(1)..part.at.end;
    Tree { shape: Shape::Negative(Box::new(part)), at }
}

fn between<'a>(input: &mut Input<'a>) -> Read<Infix<Input<'a>, Tree, ErrMode<Found>>> {
    let text: &str = input;
    let (length, found) = match text.as_bytes() {
        // Python and Fortran write powers like that.
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

fn pair(operator: Operator, left: Tree, right: Tree) -> Tree {
    let at = left.at.start..right.at.end;
    Tree { shape: Shape::Pair(operator, Box::new([left, right])), at }
}

fn none<T>() -> Read<T> {
    Err(ErrMode::Backtrack(Found(None)))
}

/// Takes bytes, and the blanks after them.
fn take(input: &mut Input<'_>, bytes: usize) {
    let _ = input.next_slice(bytes);
    skip(input);
}

fn operand(input: &mut Input<'_>) -> Read<Tree> {
    let start = input.current_token_start();
    let text: &str = input;
    match text.chars().next() {
        Some('(') => parentheses(input, start),
        Some(first) if first.is_ascii_digit() || first == '.' => number(input, start),
        Some(first) if first.is_ascii_alphabetic() || first == '_' => name(input, start),
        Some('`') => quoted(input, start),
        None => refused("the formula ends where a part is missing", start..start, "add a number, a name or a call"),
        // The minus before a part.
        Some('-' | '+') => none(),
        Some(sign @ (')' | ',' | '=' | '*' | '/' | '^')) => {
            refused(format!("a part is missing before `{sign}`"), start..start + 1, "add a number, a name or a call")
        }
        Some(other) => unknown_sign(other, start),
    }
}

fn parentheses(input: &mut Input<'_>, start: usize) -> Read<Tree> {
    take(input, 1);
    let mut inner = sum(input)?;
    closed(input, start)?;
    inner.at = start..input.previous_token_end();
    skip(input);
    Ok(inner)
}

/// Takes the parenthesis that closes the one at `start`.
fn closed(input: &mut Input<'_>, start: usize) -> Read<()> {
    let at = input.current_token_start();
    match input.chars().next() {
        Some(')') => {
            let _ = input.next_slice(1);
            Ok(())
        }
        None => refused("this `(` is not closed", start..start + 1, "add `)`"),
        Some(other) => no_operator(other, at),
    }
}

fn number(input: &mut Input<'_>, start: usize) -> Read<Tree> {
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
        let message = format!("`{written}` is no finite number");
        return refused(message, start..start + end, "write a number such as 1.5e-3");
    };
    take(input, end);
    Ok(Tree { shape: Shape::Number(value), at: start..start + end })
}

fn name(input: &mut Input<'_>, start: usize) -> Read<Tree> {
    let text: &str = input;
    let belongs = |byte: &u8| byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b'.');
    let end = text.bytes().take_while(belongs).count();
    let name = &text[..end];
    let at = start..start + end;
    take(input, end);
    let is_call = input.starts_with('(');
    match Function::named(name) {
        Some(function) if is_call => call(input, function, at),
        Some(function) => refused(
            format!("the function `{}` has no argument", function.name()),
            at,
            format!("write it with parentheses: {}(phi)", function.name()),
        ),
        None if is_call => {
            let known = Function::ALL.map(Function::name).join(", ");
            let help = match name {
                "arcsin" | "arccos" | "arctan" | "arctan2" => format!("write {}", name.replacen("arc", "a", 1)),
                "log" => "write ln for the natural logarithm, ln(x)/ln(10) for that to base 10".to_string(),
                "cot" | "sec" | "csc" => "write it by sin, cos and tan".to_string(),
                "pow" => "write a power with `^`".to_string(),
                _ => format!("the functions are {known}; write a product with `*`"),
            };
            refused(format!("there is no function `{name}`"), at, help)
        }
        None => Ok(Tree { shape: Shape::Name(name.into()), at }),
    }
}

/// A name between backquotes.
fn quoted(input: &mut Input<'_>, start: usize) -> Read<Tree> {
    let text: &str = input;
    let Some(length) = text[1..].find('`').filter(|&length| length > 0) else {
        return refused("this backquote opens no name", start..start + 1, "close it behind the name: `body 2.x`");
    };
    let name = text[1..=length].to_string();
    let at = start..start + length + 2;
    take(input, length + 2);
    Ok(Tree { shape: Shape::Name(name), at })
}

fn call(input: &mut Input<'_>, function: Function, name: Range<usize>) -> Read<Tree> {
    let open = input.current_token_start();
    take(input, 1);
    let mut parts = vec![sum(input)?];
    while parts.len() < function.arity() && input.starts_with(',') {
        take(input, 1);
        parts.push(sum(input)?);
    }
    if parts.len() < function.arity() {
        let message = format!("{} needs {} arguments", function.name(), function.arity());
        return refused(message, name, "write atan2(y, x), with the sine's side first");
    }
    closed(input, open)?;
    let at = name.start..input.previous_token_end();
    skip(input);
    Ok(Tree { shape: Shape::Call(function, parts), at })
}
