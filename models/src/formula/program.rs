//! A formula as a short list of instructions over a stack: compiled once, evaluated without allocation.

/// One instruction.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Op {
    Number(f64),
    /// A variable or a parameter by its place.
    Load(usize),
    Add,
    Subtract,
    Multiply,
    Divide,
    Negate,
    Power,
    /// A whole power, cheaper than [`Op::Power`] and defined for negative bases.
    Whole(i32),
    Apply(fn(f64) -> f64),
    Combine(fn(f64, f64) -> f64),
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
            Op::Negate => stack[top - 1] = -stack[top - 1],
            Op::Whole(power) => stack[top - 1] = stack[top - 1].powi(power),
            Op::Apply(function) => stack[top - 1] = function(stack[top - 1]),
            Op::Add => pair(&mut stack, &mut top, |a, b| a + b),
            Op::Subtract => pair(&mut stack, &mut top, |a, b| a - b),
            Op::Multiply => pair(&mut stack, &mut top, |a, b| a * b),
            Op::Divide => pair(&mut stack, &mut top, |a, b| a / b),
            Op::Power => pair(&mut stack, &mut top, f64::powf),
            Op::Combine(function) => pair(&mut stack, &mut top, function),
        }
    }
    stack[0]
}

#[inline]
fn push(stack: &mut [f64; DEPTH], top: &mut usize, value: f64) {
    stack[*top] = value;
    *top += 1;
}

#[inline]
fn pair(stack: &mut [f64; DEPTH], top: &mut usize, function: impl Fn(f64, f64) -> f64) {
    *top -= 1;
    stack[*top - 1] = function(stack[*top - 1], stack[*top]);
}

/// A function of one argument.
pub(crate) struct Function {
    pub name: &'static str,
    pub law: fn(f64) -> f64,
    /// Power of the argument's dimension in the result; `None`: the argument must be a pure number.
    pub power: Option<f64>,
}

const fn function(name: &'static str, law: fn(f64) -> f64, power: Option<f64>) -> Function {
    Function { name, law, power }
}

/// What a formula may call with one argument.
pub(crate) const FUNCTIONS: &[Function] = &[
    function("abs", f64::abs, Some(1.0)),
    function("pos", |x| x.max(0.0), Some(1.0)),
    function("sqrt", f64::sqrt, Some(0.5)),
    function("sign", |x| f64::from(i8::from(x > 0.0) - i8::from(x < 0.0)), Some(0.0)),
    function("step", |x| f64::from(u8::from(x > 0.0)), Some(0.0)),
    function("exp", f64::exp, None),
    function("ln", f64::ln, None),
    function("sin", f64::sin, None),
    function("cos", f64::cos, None),
    function("tan", f64::tan, None),
    function("tanh", f64::tanh, None),
];

/// A function of two arguments of one dimension.
pub(crate) struct Pair {
    pub name: &'static str,
    pub law: fn(f64, f64) -> f64,
}

/// What a formula may call with two arguments.
pub(crate) const PAIRS: &[Pair] = &[Pair { name: "min", law: f64::min }, Pair { name: "max", law: f64::max }];
