//! Names that every formula may use, and their places among the inputs.

use spelling::units::Dimension;

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
