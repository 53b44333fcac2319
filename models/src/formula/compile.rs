//! Text → program, with the dimension of every part checked on the way.
//!
//! ```text
//! sum = product (('+' | '-') product)*      product = sign (('*' | '/') sign)*      sign = ('-' | '+') sign | power
//! power = atom ('^' sign)?      atom = number | name | name '(' sum (',' sum)* ')' | '(' sum ')'
//! ```

use super::program::{DEPTH, FUNCTIONS, Op, PAIRS, Two};
use crate::error::{Checked, fault};
use spelling::units::Dimension;

/// A name that the formula may use; its place in the inputs is its place in the list.
pub(crate) struct Name<'a> {
    pub name: &'a str,
    pub dimension: Dimension,
}

#[derive(Debug, Clone)]
pub(crate) struct Compiled {
    pub program: Vec<Op>,
    pub dimension: Dimension,
    pub used: Vec<bool>,
}

pub(crate) fn compile(text: &str, names: &[Name]) -> Checked<Compiled> {
    let used = vec![false; names.len()];
    let mut reader = FormulaReader { text, at: 0, names, program: Vec::new(), used, depth: 0, nesting: 0 };
    let part = reader.sum()?;
    reader.skip_space();
    if reader.at < text.len() {
        let (found, at) = reader.next_word();
        return fault(format!("`{found}` is not expected here"))
            .help("write an operator + - * / ^ between two parts")
            .within(at);
    }
    Ok(Compiled { program: reader.program, dimension: part.dimension, used: reader.used })
}

#[derive(Clone, Copy)]
struct Subexpression {
    dimension: Dimension,
    /// Its value, if it is made of numbers alone.
    value: Option<f64>,
    at: (usize, usize),
}

struct FormulaReader<'a> {
    text: &'a str,
    at: usize,
    names: &'a [Name<'a>],
    program: Vec<Op>,
    used: Vec<bool>,
    depth: usize,
    nesting: usize,
}

const NESTING: usize = 64;

impl<'a> FormulaReader<'a> {
    fn sum(&mut self) -> Checked<Subexpression> {
        let mut left = self.product()?;
        while let Some(sign) = self.take(&['+', '-']) {
            let right = self.product()?;
            let (verb, law): (_, Two) = match sign {
                '+' => ("added to", |a, b| a + b),
                _ => ("subtracted from", |a, b| a - b),
            };
            alike(&left, &right, verb)?;
            left = self.joined(left, right, law);
        }
        Ok(left)
    }

    fn product(&mut self) -> Checked<Subexpression> {
        let mut left = self.sign()?;
        while let Some(sign) = self.take(&['*', '/']) {
            let right = self.sign()?;
            let (power, law): (_, Two) = match sign {
                '*' => (1.0, |a, b| a * b),
                _ => (-1.0, |a, b| a / b),
            };
            let dimension = left.dimension.times(right.dimension, power);
            left = Subexpression { dimension, ..self.joined(left, right, law) };
        }
        Ok(left)
    }

    fn sign(&mut self) -> Checked<Subexpression> {
        let start = self.here();
        let Some(sign) = self.take(&['-', '+']) else { return self.power() };
        self.enter(start)?;
        let part = self.sign()?;
        self.nesting -= 1;
        let minus = sign == '-';
        if minus {
            self.program.push(Op::Apply(|x| -x));
        }
        Ok(Subexpression { value: part.value.map(|v| if minus { -v } else { v }), at: (start, part.at.1), ..part })
    }

    fn power(&mut self) -> Checked<Subexpression> {
        let base = self.atom()?;
        if self.take(&['^']).is_none() {
            return Ok(base);
        }
        self.enter(self.at)?;
        let before = self.program.len();
        let exponent = self.sign()?;
        self.nesting -= 1;
        if !exponent.dimension.is(Dimension::NONE) {
            return fault(format!("an exponent must be a pure number, not {}", exponent.dimension.words()))
                .help("divide it by a quantity of the same unit")
                .within(exponent.at);
        }
        let at = (base.at.0, exponent.at.1);
        let dimension = match exponent.value {
            Some(power) => Dimension::NONE.times(base.dimension, power),
            None if base.dimension.is(Dimension::NONE) => Dimension::NONE,
            None => {
                return fault(format!("{} to a power that is not a number has no unit", base.dimension.words()))
                    .help("write the exponent as a number, for example ^3")
                    .within(at);
            }
        };
        let part = self.joined(base, exponent, f64::powf);
        if let Some(whole) = exponent.value.filter(|v| v.fract() == 0.0 && v.abs() <= 100.0) {
            self.program.truncate(before);
            self.program.push(Op::Whole(whole as i32));
        }
        Ok(Subexpression { dimension, ..part })
    }

    fn atom(&mut self) -> Checked<Subexpression> {
        let start = self.here();
        match self.text[start..].chars().next() {
            Some('(') => {
                self.enter(start)?;
                self.at += 1;
                let inner = self.sum()?;
                self.close(start)?;
                self.nesting -= 1;
                Ok(Subexpression { at: (start, self.at), ..inner })
            }
            Some(c) if c.is_ascii_digit() || c == '.' => self.number(start),
            Some(c) if c.is_alphabetic() || c == '_' => self.name(start),
            Some(c) => {
                let at = (start, start + c.len_utf8());
                fault(format!("`{c}` is not expected here")).help("a number, a name or `(` belongs here").within(at)
            }
            None => {
                fault("the formula ends too early").help("a number, a name or `(` is missing").within((start, start))
            }
        }
    }

    fn number(&mut self, start: usize) -> Checked<Subexpression> {
        let bytes = self.text.as_bytes();
        let mut end = start;
        while end < bytes.len() && (bytes[end].is_ascii_digit() || bytes[end] == b'.') {
            end += 1;
        }
        let exponent = end < bytes.len() && (bytes[end] | 32) == b'e';
        let sign = usize::from(exponent && bytes.get(end + 1).is_some_and(|c| matches!(c, b'+' | b'-')));
        if exponent && bytes.get(end + 1 + sign).is_some_and(u8::is_ascii_digit) {
            end += 1 + sign;
            while end < bytes.len() && bytes[end].is_ascii_digit() {
                end += 1;
            }
        }
        self.at = end;
        let (text, at) = (&self.text[start..end], (start, end));
        let Some(value) = text.parse().ok().filter(|v: &f64| v.is_finite()) else {
            return fault(format!("`{text}` is not a number")).help("write for example 0.5 or 2e-3").within(at);
        };
        self.push(Op::Number(value), at)?;
        Ok(Subexpression { dimension: Dimension::NONE, value: Some(value), at })
    }

    fn name(&mut self, start: usize) -> Checked<Subexpression> {
        let (name, at) = self.next_word();
        self.at = at.1;
        self.skip_space();
        if self.text[self.at..].starts_with('(') {
            self.enter(start)?;
            let part = self.call(name, at)?;
            self.nesting -= 1;
            return Ok(part);
        }
        let Some(place) = self.names.iter().position(|known| known.name == name) else {
            let known: Vec<&str> = self.names.iter().map(|n| n.name).collect();
            return fault(format!("`{name}` is not known")).help(spelling::known(name, &known)).within(at);
        };
        self.used[place] = true;
        self.push(Op::Load(place), at)?;
        Ok(Subexpression { dimension: self.names[place].dimension, value: None, at })
    }

    fn call(&mut self, name: &str, at: (usize, usize)) -> Checked<Subexpression> {
        let open = self.at;
        self.at += 1;
        let first = self.sum()?;
        if let Some((_, law, power)) = FUNCTIONS.iter().find(|known| known.0 == name) {
            self.close(open)?;
            if power.is_none() && !first.dimension.is(Dimension::NONE) {
                return fault(format!("{name} needs a pure number, not {}", first.dimension.words()))
                    .help("divide by a parameter of the same unit")
                    .within(first.at);
            }
            self.program.push(Op::Apply(*law));
            let dimension = Dimension::NONE.times(first.dimension, power.unwrap_or(0.0));
            return Ok(Subexpression { dimension, value: None, at: (at.0, self.at) });
        }
        let Some((_, law)) = PAIRS.iter().find(|known| known.0 == name) else {
            let known: Vec<&str> = FUNCTIONS.iter().map(|f| f.0).chain(PAIRS.iter().map(|f| f.0)).collect();
            return fault(format!("unknown function `{name}`")).help(spelling::known(name, &known)).within(at);
        };
        if self.take(&[',']).is_none() {
            return fault(format!("{name} takes two arguments"))
                .help(format!("write {name}(a, b)"))
                .within((at.0, self.at));
        }
        let second = self.sum()?;
        self.close(open)?;
        alike(&first, &second, "compared with")?;
        Ok(Subexpression { value: None, at: (at.0, self.at), ..self.joined(first, second, *law) })
    }

    fn close(&mut self, open: usize) -> Checked<()> {
        match self.take(&[')']) {
            Some(_) => Ok(()),
            None => fault("this parenthesis is not closed").help("add `)`").within((open, open + 1)),
        }
    }

    fn enter(&mut self, at: usize) -> Checked<()> {
        self.nesting += 1;
        if self.nesting > NESTING {
            return fault("the formula is nested too deeply").help("write it flatter").within((at, at + 1));
        }
        Ok(())
    }

    fn push(&mut self, op: Op, at: (usize, usize)) -> Checked<()> {
        self.program.push(op);
        self.depth += 1;
        if self.depth > DEPTH {
            return fault("the formula is nested too deeply").help("write it flatter").within(at);
        }
        Ok(())
    }

    /// Two parts as one by a law, of the dimension of the left.
    fn joined(&mut self, left: Subexpression, right: Subexpression, law: Two) -> Subexpression {
        self.program.push(Op::Combine(law));
        self.depth -= 1;
        let value = left.value.zip(right.value).map(|(a, b)| law(a, b));
        Subexpression { dimension: left.dimension, value, at: (left.at.0, right.at.1) }
    }

    fn skip_space(&mut self) {
        let rest = &self.text[self.at..];
        self.at += rest.len() - rest.trim_start().len();
    }

    fn here(&mut self) -> usize {
        self.skip_space();
        self.at
    }

    fn take(&mut self, wanted: &[char]) -> Option<char> {
        self.skip_space();
        let next = self.text[self.at..].chars().next().filter(|c| wanted.contains(c))?;
        self.at += next.len_utf8();
        Some(next)
    }

    /// The name that starts here, or one character.
    fn next_word(&self) -> (&'a str, (usize, usize)) {
        let rest: &'a str = &self.text[self.at..];
        let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
        let end = if end == 0 { rest.chars().next().map_or(0, char::len_utf8) } else { end };
        (&rest[..end], (self.at, self.at + end))
    }
}

/// Only like can be added and compared.
fn alike(left: &Subexpression, right: &Subexpression, verb: &str) -> Checked<()> {
    if left.dimension.is(right.dimension) {
        return Ok(());
    }
    let (a, b) = (right.dimension.words(), left.dimension.words());
    fault(format!("{a} cannot be {verb} {b}"))
        .help("both parts need the same unit; check the units of the parameters")
        .within((left.at.0, right.at.1))
}
