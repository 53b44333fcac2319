//! What could not be seen in the data.

use super::result::Group;
use serde::Serialize;

/// How large an effect would have to be.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Undetectable {
    /// Name in scenarios.
    pub effect: String,
    /// Group.
    pub group: Group,
    /// Smallest value of its first parameter found with 90 % probability; `None`: none within its bounds.
    pub smallest_detectable: Option<f64>,
    /// Unit.
    pub unit: String,
    /// The same as a multiple of the effect's typical size.
    pub times_typical: Option<f64>,
}
