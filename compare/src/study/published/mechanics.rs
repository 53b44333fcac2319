//! The mechanics of a shipped actuator that its textbook model lacks, effect by effect, nothing fitted.
//!
//! Values follow from the geometry of the pattern and from the published fabric; numbers that were not printed are assumed as in the
//! finite elements: welds of 3 mm, a bending stiffness 0.2 times a solid sheet's, ν₁₂ = 0.2.

use data::{Published, PublishedFabric};
use models::actuators::Family;
use models::fabrics::shear_modulus;
use models::scenario::ActuatorChoice;
use models::{Known, Scenario};

/// An effect to add, with the origin of its value (SI).
pub(super) struct MechanicsPart {
    pub effect: &'static str,
    pub value: f64,
    pub range: Option<[f64; 2]>,
    pub known: Known,
    pub why: &'static str,
}

/// Width of a weld \[m\] and what it may be.
const WELD_M: (f64, [f64; 2]) = (3e-3, [0.0, 8e-3]);
/// Bending stiffness of a coated fabric over a solid sheet's, and what it may be.
const BENDING: (f64, [f64; 2]) = (0.2, [0.1, 0.5]);
/// Contraction along fill per stretch along warp.
const NU12: f64 = 0.2;

/// What to add to the bare model of an actuator kind, in this order; nothing for one that is not published.
pub(super) fn additions(paper: &Published, actuator: &ActuatorChoice) -> Vec<MechanicsPart> {
    let kind = actuator.kind.name;
    let Some(fabric) = paper.actuator(kind).and_then(|a| paper.fabrics.iter().find(|f| f.name == a.fabric)) else {
        return Vec::new();
    };
    match actuator.kind.family {
        Family::Mckibben => muscle(fabric),
        Family::Pouch if actuator.in_wall() => pouch(fabric),
        Family::Pouch => {
            let why = "geometry of an actuator outside the body: its axis rides on its own bulge";
            std::iter::once(MechanicsPart::predicted("arm_growth", 1.0, why)).chain(pouch(fabric)).collect()
        }
    }
}

impl MechanicsPart {
    fn predicted(effect: &'static str, value: f64, why: &'static str) -> MechanicsPart {
        MechanicsPart { effect, value, range: None, known: Known::Predicted, why }
    }

    fn assumed(effect: &'static str, value: f64, range: Option<[f64; 2]>, why: &'static str) -> MechanicsPart {
        MechanicsPart { effect, value, range, known: Known::Assumed, why }
    }
}

fn pouch(fabric: &PublishedFabric) -> Vec<MechanicsPart> {
    let (predicted, assumed) = (MechanicsPart::predicted, MechanicsPart::assumed);
    // A neo-Hookean sheet in its plane is 8 C10 stiff, as in the finite elements.
    let modulus_pa = fabric.c10_printed.map_or(0.5 * (fabric.e0_pa + fabric.e90_pa), |c10| 8e6 * c10);
    let bending = |factor: f64| factor * modulus_pa * fabric.thickness_m.powi(3) / 12.0;
    let bonded_nm = 0.5 * modulus_pa * fabric.thickness_m.powi(3);
    let crimped = |width_m: f64| bonded_nm * width_m;
    vec![
        assumed("weld_width", WELD_M.0, Some(WELD_M.1), "welds of 3 mm; a line to a wide impulse seal"),
        predicted("chord_arm", 1.0, "the weld lines are chords of the body, not arcs"),
        predicted("displaced_gas", 0.5, "half of a lens in the wall is in the body"),
        predicted("gussets", 1.0, "side folds open as far as the diagonals allow which the ends hold"),
        predicted("sealed_sides", 1.0, "the sides are sealed as the ends are; with gussets it does nothing"),
        predicted(
            "roofed_welds",
            1.0,
            "welds across the wall fold in their middle where the gas of the body lifts them",
        ),
        assumed(
            "fold_energy",
            bending(BENDING.0),
            Some(BENDING.1.map(bending)),
            "0.2 of a solid sheet; droop of a coated nylon, measured by others: 0.1 to 0.5",
        ),
        assumed(
            "crimped_sides",
            crimped(WELD_M.0),
            Some(WELD_M.1.map(crimped)),
            "two bonded plies in side welds as wide as the others",
        ),
        assumed(
            "stuck_face",
            bonded_nm,
            Some([2.0 * bending(BENDING.1[0]), bonded_nm]),
            "two bonded plies, as in the finite elements; in the wall it does nothing",
        ),
        assumed(
            "wrinkled_sheets",
            bending(BENDING.0),
            Some(BENDING.1.map(bending)),
            "sheets as stiff as in fold_energy; with the load of wrinkles in finite elements",
        ),
        predicted(
            "fabric_stretch",
            1.0 / (fabric.e0_pa * fabric.thickness_m),
            "compliance from the published E0 and the published thickness",
        ),
    ]
}

fn muscle(fabric: &PublishedFabric) -> Vec<MechanicsPart> {
    let (predicted, assumed) = (MechanicsPart::predicted, MechanicsPart::assumed);
    let wall_n_per_m = 0.5 * (fabric.e0_pa + fabric.e90_pa) * fabric.thickness_m;
    let range = Some([(1.0 - 2.0 * NU12) / wall_n_per_m, 1.0 / wall_n_per_m]);
    let published = "published E0, E90 and thickness; nu12 = 0.2 (0 to 0.4) is not printed";
    let glued = "glued over its whole width to a wall of the same fabric";
    let mut list = vec![
        predicted("sunk_muscle", 1.0, "a tube glued over its flat width is half in the wall"),
        predicted("flat_ends", 2.0, "both ends stay flat"),
        assumed("yarn_stretch", (1.0 - NU12) / wall_n_per_m, range, published),
        assumed("glued_face", wall_n_per_m, None, glued),
    ];
    let shear_pa = fabric.e45_pa.map(|e45_pa| shear_modulus(fabric.e0_pa, fabric.e90_pa, e45_pa, 0.0));
    if let Some(Ok(shear_pa)) = shear_pa {
        let why = "shear modulus from the published E0, E45, E90 and the published thickness";
        list.push(predicted("shear_stiffness", shear_pa * fabric.thickness_m, why));
    }
    list
}

/// The scenario with an effect whose first parameter has a value; others stay neutral.
pub(super) fn with(scenario: &Scenario, effect: &str, value: f64) -> Scenario {
    let mut values = models::effects::by_name(effect).map_or_else(Vec::new, |e| e.neutral());
    values.iter_mut().take(1).for_each(|first| *first = value);
    scenario.with_effect(effect, &values)
}
