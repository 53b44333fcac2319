//! The catalogue of one scenario: the effects of all, and its own formulas.

use crate::effects::{EFFECTS, Effect, Parameter};
use crate::formula::Formula;
use std::sync::Arc;

/// Every effect that a scenario may use: [`EFFECTS`] and its own formulas, in the order in which they are added to a model.
///
/// ```
/// let text = models::shipped("epam-textbook").unwrap().to_string() + r#"
/// [[formula]]
/// name = "cubic_spring"
/// moment = "-k * theta^3"
/// [formula.parameters.k]
/// unit = "N m"
/// typical = 0.5
/// bounds = [0, 20]
/// "#;
/// let scenario = models::Scenario::parse(&text).unwrap();
/// let catalogue = scenario.catalogue();
/// let own = catalogue.by_name("cubic_spring").unwrap();
/// assert_eq!((own.parameters[0].key, own.typical()[0]), ("k", 0.5));
/// assert_eq!(catalogue.effects().count(), models::effects::EFFECTS.len() + 1);
/// let softer = scenario.with_effect("cubic_spring", &own.typical());
/// assert_eq!(softer.effects.last().unwrap().name, "cubic_spring");
/// ```
pub struct Catalogue<'a> {
    own: Vec<(&'a Formula, Vec<Parameter<'a>>)>,
}

impl<'a> Catalogue<'a> {
    pub(crate) fn new(formulas: &'a [Arc<Formula>]) -> Catalogue<'a> {
        Catalogue { own: formulas.iter().map(|formula| (&**formula, formula.parameters())).collect() }
    }

    /// Iterates over [`EFFECTS`], then over the formulas of the scenario in their order.
    pub fn effects(&self) -> impl Iterator<Item = Effect<'_>> {
        EFFECTS.iter().copied().chain(self.own.iter().map(|(formula, parameters)| formula.effect(parameters)))
    }

    /// Finds an effect or a formula by its key in `[effects]`; `None` if neither has that name.
    pub fn by_name(&self, name: &str) -> Option<Effect<'_>> {
        self.effects().find(|effect| effect.name == name)
    }
}
