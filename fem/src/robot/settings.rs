//! Everything about a robot that its scenario does not say, each with how it is known.

use crate::policy;
use crate::problem::{Amplitude, Guards};

/// Distance of the rings under a taped sheet over its element size: its margins of stuck plies fold across in the middle of every
/// pouch, and with seven rows from weld to middle seams snap or hold from seed to seed.
pub(super) const TAPED_SPACING: f64 = 0.8;
/// Length of the rows next to the welds of a folded sheet over their width: its pouches fill so far that the welds between them stand
/// on edge, and the adjacent wall turns by a right angle within that width. With half of it, on elements twice as wide, gussets of
/// long pouches turn inside out.
pub(super) const FOLDED_ROW: f64 = 2.0 / 3.0;
/// Elements shorter than this \[m\] are much finer than what moves: their selective masses take six passes.
pub(super) const FINE_M: f64 = 1.5e-3;
/// `mass_factor`: of robots whose layers touch on elements that are not fine, and of all others. On the former 3.6 adds 57 % of mass where 2.4
/// adds 30, and moves the cPAM by 1.4 % at 10 kPa; the ePAM moves by less than 0.7 %.
const MASS_FACTOR: [f64; 2] = [2.4, 3.6];
/// Thickness of a tape that only ties two sheets \[m\].
const TIE_M: f64 = 1e-6;

/// Mesh, fabrication and loading of a robot: the numbers of [`super::KEYS`] in SI, and the words and lists.
#[derive(Debug, Clone, PartialEq)]
#[allow(missing_docs, reason = "`KEYS` describes the other numbers, and `ASSUMED` lists the unmeasured ones")]
pub struct RobotSettings {
    pub body_size_m: f64,
    pub actuator_size_m: f64,
    /// Distance of the rings at the actuator over `actuator_size_m`; `None`: 1, and 0.8 under a taped sheet.
    pub ring_spacing: Option<f64>,
    /// Length of the rows next to welds \[m\], from which rows grow by a quarter each to the distance of the rings; `None`: no shorter
    /// than those, and two thirds of a weld under a folded sheet.
    pub seam_row_m: Option<f64>,
    /// Distance between layers at the start \[m\]. Published: 0.01 mm.
    pub layer_gap_m: f64,
    pub layer_friction: f64,
    /// Width of the welds across the robot and along the actuator's sides \[m\]; 0 is a line, along which taped plies fold
    /// without end as the mesh gets finer. Assumed.
    pub weld_m: f64,
    /// Share of the bending stiffness of a solid plate that one sheet of coated fabric has. Assumed.
    pub bending_factor: f64,
    /// Share of the bending stiffness of sheets, welds and glued plies that is kept; wrinkles keep their load. 1 but for a study of
    /// what carries a difference.
    pub bending_share: f64,
    /// Length of the wrinkles of single sheets over the length that the geometry gives (`plies`), to which their load is inverse
    /// ([`models::fabrics::WrinklingFilm`]). `None`: sheets carry all of compression. Assumed.
    pub wrinkle_length: Option<f64>,
    /// How far taped and glued plies bend as one: 1 without slip, 0 as loose sheets. Assumed.
    pub bond: f64,
    pub tape_m: f64,
    pub tape_e_pa: f64,
    pub tape_margin_m: f64,
    /// Whether tape holds separate pouches at their seams only, and not over their whole face. The paper prints neither.
    pub taped_at_seams: bool,
    pub glue_m: f64,
    pub glue_e_pa: f64,
    /// Contraction along fill per stretch along warp of an anisotropic fabric; `None` keeps the material's own.
    /// Assumed.
    pub nu12: Option<f64>,
    /// Thickness of the actuator's sheet \[m\]; `None`: its fabric's.
    pub sheet_m: Option<f64>,
    /// Young's modulus of the actuator's sheet \[Pa\]; `None`: its fabric's. Isotropic fabrics only.
    pub sheet_e_pa: Option<f64>,
    /// Thickness of the body's sheet \[m\]; `None`: its fabric's.
    pub body_sheet_m: Option<f64>,
    /// Young's modulus of the body's sheet \[Pa\]; `None`: its fabric's. Isotropic fabrics only.
    pub body_sheet_e_pa: Option<f64>,
    /// Force per length that a weld carries \[N/m\], from a peel or tensile test of a seam; `None`: not known. Changes no run.
    pub weld_strength_n_per_m: Option<f64>,
    pub density_kg_m3: f64,
    /// Actuator gauge pressure at the end \[Pa\].
    pub actuator_pa: f64,
    pub body_ramp_s: f64,
    pub actuator_ramp_s: f64,
    /// The actuator's pressure grows by equal shares of itself plus this in equal times \[Pa\]: a robot bends most, and its
    /// folds open, while this is about the body's pressure. `None`: a fifth-order step of the pressure itself.
    pub ramp_floor_pa: Option<f64>,
    pub hold_s: f64,
    /// Longest time that a hold then waits until the tip is at rest \[s\]; `None`: six times the actuator's ramp.
    pub rest_s: Option<f64>,
    /// Square of the step over the time that sound takes through the smallest element; masses are raised as the highest mode of the
    /// mesh needs (`mass_scaling`). `None`: 3.6, and 2.4 where layers of elements of 1.5 mm and more touch.
    pub mass_factor: Option<f64>,
    /// Whether waves of a few elements are heavy in place of everything ([`crate::problem::Settings::selective_mass`]).
    pub selective_mass: bool,
    /// Passes of the selective masses, 2, 4 or 6 ([`crate::problem::Settings::mass_passes`]), and the longer step that they allow
    /// in addition to `mass_factor`; `None`: 2, and 6 for elements below 1.5 mm.
    pub mass_passes: Option<usize>,
    /// Movement of the tip that a hold does not wait for, as a share of its displacement (`fem/src/robot/rest.rs`).
    pub creep: f64,
    pub cfl: f64,
    /// Viscosity of the membrane over critical damping ([`crate::problem::Settings::viscosity`]).
    pub viscosity: f64,
    /// Mass damping \[1/s\]; `None`: 1.4 ω, the estimate of the tip's lowest frequency (`fem/src/robot/rest.rs`).
    pub mass_damping_1_s: Option<f64>,
    pub hourglass: f64,
    /// Share of the stored energy that hourglass control may hold at the end ([`crate::problem::Guards::hourglass`]).
    pub guard_hourglass: f64,
    /// Whether layers touch; `None`: where the pattern folds.
    pub contact: Option<bool>,
    /// Whether the base ring cannot turn either: the next row is held too. Published: no difference, so pinned.
    pub encastre: bool,
    /// Random offset of the nodes at the start, as a share of the element size: a push that breaks the symmetry.
    pub imperfection: f64,
    /// How far the sewn shape, free of membrane stress, departs from the pattern \[m\]: root mean square along each axis, in random
    /// waves of 30 to 120 mm. A seed is the same robot on every mesh. Assumed.
    pub waviness_m: f64,
    /// Seed of both the imperfection and the waviness.
    pub seed: u64,
}

impl RobotSettings {
    /// The recommended set, one for all four robots; how each number is known:
    ///
    /// | number | why |
    /// |---|---|
    /// | 8 mm on the body, 4 mm on the actuator | 3 mm and 2 mm change ePAM and cPAM by up to 5 % at every pressure: `docs/robots.md` |
    /// | rings under a taped sheet at 0.8 of that | seven rows from weld to middle of a pouch leave the sPAM's seams to snap or hold from seed to seed |
    /// | rows of 2 mm next to the welds of a folded sheet | full pouches set these welds on edge, which longer rows cannot follow |
    /// | waviness 0.1 mm | assumed; without it all seeds of a robot take the folds that its mesh prefers |
    /// | welds 3 mm wide | assumed; of all numbers the one that decides most |
    /// | 0.04 + 0.12 s and holds until rest, masses raised | three times the ramp moves ePAM and cPAM by less than 0.8 % |
    /// | selective masses | the step asks for an eighth and less of the mass that it asks for without |
    /// | ramp floor 2 kPa | the body's pressure: there a robot bends most per pascal, and gussets open |
    /// | mass damping from the tip's frequency | holds last until the tip is at rest, so that it decides how long a run takes |
    /// | hourglass .0007 | a third and three times as much move the ePAM by up to 0.6 and the cPAM by up to 1.4 %; .002 held up to 5 % of the stored energy |
    /// | compressed sheets carry the load of their wrinkles | 2π √(D T)/ℓ, from D, T = p_b R and the geometry: not an independent number |
    /// | bending factor 0.2 | droop of a heat-bondable coated nylon, measured by others: 0.1 to 0.5 |
    /// | tape 0.05 mm over the whole face, no margin | assumed: the usual thickness, a sheet cut at its welds |
    /// | ν₁₂ = 0.2 | assumed: the middle of 0 to 0.4 |
    ///
    /// Nothing is calibrated on a tip. Unmeasured numbers are intervals: [`super::ASSUMED`].
    pub fn compressed() -> RobotSettings {
        RobotSettings {
            body_size_m: 8e-3,
            actuator_size_m: 4e-3,
            ring_spacing: None,
            seam_row_m: None,
            layer_gap_m: 1e-5,
            layer_friction: 0.0,
            weld_m: 3e-3,
            bending_factor: 0.2,
            bending_share: 1.0,
            wrinkle_length: Some(1.0),
            bond: 1.0,
            tape_m: 5e-5,
            tape_e_pa: 1e6,
            tape_margin_m: 0.0,
            taped_at_seams: false,
            glue_m: 1e-4,
            glue_e_pa: 1e6,
            nu12: Some(0.2),
            sheet_m: None,
            sheet_e_pa: None,
            body_sheet_m: None,
            body_sheet_e_pa: None,
            weld_strength_n_per_m: None,
            density_kg_m3: 1000.0,
            actuator_pa: 30e3,
            body_ramp_s: 0.04,
            actuator_ramp_s: 0.12,
            ramp_floor_pa: Some(2e3),
            hold_s: 4e-3,
            rest_s: None,
            mass_factor: None,
            selective_mass: true,
            mass_passes: None,
            creep: policy::CREEP,
            cfl: 0.9,
            viscosity: 0.06,
            mass_damping_1_s: None,
            hourglass: 7e-4,
            guard_hourglass: Guards::default().hourglass,
            contact: None,
            encastre: false,
            imperfection: 2e-4,
            waviness_m: 1e-4,
            seed: 1,
        }
    }

    /// The modelling choices of du Pasquier et al. 2023 (Section III-A and the captions of their figures), nothing calibrated:
    ///
    /// | choice | where |
    /// |---|---|
    /// | a hyperelastic shell: bends as a solid plate, carries all of compression | III-A, III-B |
    /// | *Tie* on welds and tape: a line without width, no margin, tape as thin as 1 µm | III-A |
    /// | glue with a thickness, *Composite* | III-A; its thickness and modulus are not printed, so as recommended |
    /// | ν₁₂ = 0: warp and fill are curves of their own | III-B, *Fabric* |
    /// | 0.01 mm between layers, 4 mm elements on all (`--mesh 4mm/1mm`: the final mesh) | III-A |
    /// | body to 0.1 s, actuator to 1.1 s, fifth-order steps, no hold, read at 1.1 s | III-A |
    /// | base ring pinned | III-A |
    /// | smooth pattern | nothing printed |
    ///
    /// Numerics, not printed, are ours: selective masses (true ones need ten times the steps), hourglass control, an offset of
    /// the nodes by 2e-4 of an element, mass damping 5 1/s.
    pub fn paper() -> RobotSettings {
        RobotSettings {
            body_size_m: 4e-3,
            actuator_size_m: 4e-3,
            ring_spacing: Some(1.0),
            weld_m: 0.0,
            bending_factor: 1.0,
            bending_share: 1.0,
            wrinkle_length: None,
            tape_m: TIE_M,
            tape_margin_m: 0.0,
            nu12: Some(0.0),
            body_ramp_s: 0.1,
            actuator_ramp_s: 1.0,
            ramp_floor_pa: None,
            hold_s: 0.0,
            rest_s: Some(0.0),
            mass_damping_1_s: Some(5.0),
            waviness_m: 0.0,
            ..RobotSettings::compressed()
        }
    }

    /// `mass_factor`, or what the program takes for a robot whose layers touch or do not.
    pub(crate) fn mass_factor_for(&self, touches: bool) -> f64 {
        let is_fine = self.body_size_m.min(self.actuator_size_m) < FINE_M;
        self.mass_factor.unwrap_or(MASS_FACTOR[usize::from(is_fine || !touches)])
    }

    /// Longest time that a hold waits for rest \[s\].
    pub(crate) fn longest_rest_s(&self) -> f64 {
        self.rest_s.unwrap_or(6.0 * self.actuator_ramp_s)
    }

    /// The actuator's pressure through (time \[s\], pressure \[Pa\]) points.
    pub(super) fn rise(&self, points: Vec<(f64, f64)>) -> Amplitude {
        match self.ramp_floor_pa {
            Some(floor) => Amplitude::Growing { points, floor },
            None => Amplitude::Smooth(points),
        }
    }
}

impl Default for RobotSettings {
    fn default() -> RobotSettings {
        RobotSettings::compressed()
    }
}

/// Where the settings come from that `[fem]` does not name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Preset {
    /// Settings of [`RobotSettings::compressed`], the recommended ones.
    #[default]
    Recommended,
    /// [`RobotSettings::paper`]: the modelling choices of du Pasquier et al. 2023.
    Paper,
}

impl Preset {
    /// All of them, as in the file.
    pub(crate) const ALL: [(&str, Preset); 2] = [("recommended", Preset::Recommended), ("paper", Preset::Paper)];

    /// Word for the preset in `[fem] model`.
    pub fn name(self) -> &'static str {
        Preset::ALL[self as usize].0
    }

    /// Settings that the preset has before other keys change them.
    pub fn settings(self) -> RobotSettings {
        match self {
            Preset::Recommended => RobotSettings::compressed(),
            Preset::Paper => RobotSettings::paper(),
        }
    }
}
