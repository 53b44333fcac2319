//! A formula as a short list of instructions over a stack: compiled once, evaluated without allocation; and the names that it knows.

use spelling::units::Dimension;

type One = fn(f64) -> f64;
pub(crate) type Two = fn(f64, f64) -> f64;

#[derive(Debug, Clone, Copy)]
pub(crate) enum Op {
    Number(f64),
    /// A variable or a parameter by its place.
    Load(usize),
    /// A whole power, cheaper than any other and defined for negative bases.
    Whole(i32),
    Apply(One),
    Combine(Two),
}

/// Deepest stack a formula may need.
pub(crate) const DEPTH: usize = 32;

/// Value of a program over its inputs. The compiler has checked that the stack neither overflows nor runs empty.
pub(crate) fn run(program: &[Op], inputs: &[f64]) -> f64 {
    let mut stack = [0.0; DEPTH];
    let mut top = 0;
    for op in program {
        match *op {
            Op::Number(value) => push(&mut stack, &mut top, value),
            Op::Load(place) => push(&mut stack, &mut top, inputs[place]),
            Op::Whole(power) => stack[top - 1] = stack[top - 1].powi(power),
            Op::Apply(function) => stack[top - 1] = function(stack[top - 1]),
            Op::Combine(function) => {
                top -= 1;
                stack[top - 1] = function(stack[top - 1], stack[top]);
            }
        }
    }
    stack[0]
}

#[inline]
fn push(stack: &mut [f64; DEPTH], top: &mut usize, value: f64) {
    stack[*top] = value;
    *top += 1;
}

/// What a formula may call with one argument: name, law, and power of the argument's dimension in the result; `None`: the
/// argument must be a pure number.
pub(crate) const FUNCTIONS: &[(&str, One, Option<f64>)] = &[
    ("abs", f64::abs, Some(1.0)),
    ("pos", |x| x.max(0.0), Some(1.0)),
    ("sqrt", f64::sqrt, Some(0.5)),
    ("sign", |x| f64::from(i8::from(x > 0.0) - i8::from(x < 0.0)), Some(0.0)),
    ("step", |x| f64::from(u8::from(x > 0.0)), Some(0.0)),
    ("exp", f64::exp, None),
    ("ln", f64::ln, None),
    ("sin", f64::sin, None),
    ("cos", f64::cos, None),
    ("tan", f64::tan, None),
    ("tanh", f64::tanh, None),
];

/// What a formula may call with two arguments of one dimension.
pub(crate) const PAIRS: &[(&str, Two)] = &[("min", f64::min), ("max", f64::max)];

/// Names that every formula may use; the parameters follow.
pub(super) const VARIABLES: [(&str, Dimension); 8] = [
    ("kappa", Dimension([0.0, -1.0, 0.0])),
    ("theta", Dimension::NONE),
    ("p_act", Dimension::PRESSURE),
    ("p_body", Dimension::PRESSURE),
    ("s", Dimension::LENGTH),
    ("R", Dimension::LENGTH),
    ("B", Dimension([1.0, 3.0, -2.0])),
    ("pull", Dimension::MOMENT),
];
pub(super) const KAPPA: usize = 0;
pub(super) const STATION: usize = 4;
pub(super) const PULL: usize = 7;
/// Largest number of parameters of one formula, for which the inputs have room.
pub(crate) const MOST_PARAMETERS: usize = 8;
pub(super) const INPUTS: usize = VARIABLES.len() + MOST_PARAMETERS;

pub(crate) fn is_variable(name: &str) -> bool {
    VARIABLES.iter().any(|(known, _)| *known == name)
}
