//! Everything about a robot that its scenario does not say, each with how it is known.

use crate::FemError;
use crate::problem::Amplitude;

/// Distance of the rings under a taped sheet over its element size: its margins of stuck plies fold across in the middle of every
/// pouch, and with seven rows from weld to middle seams snap or hold from seed to seed.
pub(super) const TAPED_SPACING: f64 = 0.8;
/// Length of the rows beside the welds of a folded sheet over their width: its pouches fill so far that the welds between them stand
/// on edge, and the wall beside them turns by a right angle within that width. With half of it, on elements twice as wide, gussets of
/// long pouches turn inside out.
pub(super) const FOLDED_ROW: f64 = 2.0 / 3.0;
/// Elements shorter than this \[m\] are much finer than what moves: their selective masses take six passes.
pub(super) const FINE_M: f64 = 1.5e-3;
/// `mass_factor`: of all robots, and of such fine ones whose layers touch. Contact makes their step
/// dear, and stuck plies, which make a longer one expensive in mass, are few: the cPAM gets 66 % of mass with 3.6, 31 with 2.4, and ends
/// where 222 % had left it before.
pub(super) const MASS_FACTOR: [f64; 2] = [2.4, 3.6];
/// Thickness of a tape that only ties two sheets \[m\].
const TIE_M: f64 = 1e-6;

/// Mesh, fabrication and loading of a robot.
#[derive(Debug, Clone, PartialEq)]
pub struct RobotSettings {
    /// Element size of the body \[m\].
    pub body_size_m: f64,
    /// Element size of the strip under the actuator and of the actuator \[m\].
    pub actuator_size_m: f64,
    /// Distance of the rings at the actuator over `actuator_size_m`; `None`: 1, and 0.8 under a taped sheet.
    pub ring_spacing: Option<f64>,
    /// Length of the rows beside welds \[m\], from which rows grow by a quarter each to the distance of the rings; `None`: no shorter
    /// than those, and two thirds of a weld under a folded sheet.
    pub seam_row_m: Option<f64>,
    /// Distance between layers at the start \[m\]. Published: 0.01 mm.
    pub layer_gap_m: f64,
    /// Width of the welds across the robot and along the actuator's sides \[m\]; 0 is a line, along which taped plies fold
    /// without end as the mesh gets finer. Assumed.
    pub weld_m: f64,
    /// Share of the bending stiffness of a solid plate that one sheet of coated fabric has. Assumed.
    pub bending_factor: f64,
    /// Share of compression that single sheets of a film carry: less than 1 where wrinkles are shorter than the elements
    /// ([`models::fabrics::WrinklingFilm`]). Assumed.
    pub compression: f64,
    /// How far taped and glued plies bend as one: 1 without slip, 0 as loose sheets. Assumed.
    pub bond: f64,
    /// Thickness of the transfer tape \[m\]. Calibrated on the sPAM, with its margin.
    pub tape_m: f64,
    /// Young's modulus of the tape's adhesive \[Pa\]. Assumed.
    pub tape_e_pa: f64,
    /// Width of the taped sheet beyond the welds along its sides \[m\]. Calibrated on the sPAM.
    pub tape_margin_m: f64,
    /// Thickness of the glue film \[m\]. Assumed.
    pub glue_m: f64,
    /// Young's modulus of the glue (silicone) \[Pa\]. Assumed.
    pub glue_e_pa: f64,
    /// Contraction along fill per stretch along warp of an anisotropic fabric; `None` keeps the material's own.
    /// Calibrated on the fPAM.
    pub nu12: Option<f64>,
    /// Mass per volume of all fabrics, tape and glue \[kg/m³\]. Assumed.
    pub density_kg_m3: f64,
    /// Actuator gauge pressure at the end \[Pa\].
    pub actuator_pa: f64,
    /// Duration of the body's ramp, which comes first \[s\].
    pub body_ramp_s: f64,
    /// Duration of the actuator's ramp \[s\].
    pub actuator_ramp_s: f64,
    /// The actuator's pressure grows by equal shares of itself plus this in equal times \[Pa\]: a robot bends most, and its
    /// folds open, while this is about the body's pressure. `None`: a fifth-order step of the pressure itself.
    pub ramp_floor_pa: Option<f64>,
    /// Time at full pressure \[s\].
    pub hold_s: f64,
    /// Square of the step over the time that sound takes through the smallest element; masses are raised as the highest mode of the
    /// mesh needs (`mass_scaling`). `None`: 2.4, and 3.6 for elements below 1.5 mm whose layers touch.
    pub mass_factor: Option<f64>,
    /// Whether waves of a few elements are heavy in place of everything ([`crate::problem::Settings::selective_mass`]).
    pub selective_mass: bool,
    /// Passes of the selective masses, 2, 4 or 6 ([`crate::problem::Settings::mass_passes`]), and the longer step that they allow
    /// beside `mass_factor`; `None`: 2, and 6 for elements below 1.5 mm.
    pub mass_passes: Option<usize>,
    /// Mass damping \[1/s\].
    pub mass_damping_1_s: f64,
    /// Hourglass coefficient.
    pub hourglass: f64,
    /// Whether layers touch; `None`: where the pattern folds.
    pub contact: Option<bool>,
    /// Whether the base ring cannot turn either: the row beside it is held too. Published: no difference, so pinned.
    pub encastre: bool,
    /// Random offset of the nodes at the start, as a share of the element size: a push that breaks the symmetry.
    pub imperfection: f64,
    /// How far the sewn shape, free of membrane stress, departs from the pattern \[m\]: root mean square along each axis, in random
    /// waves of 30 to 120 mm. A seed is the same robot on every mesh. Assumed.
    pub waviness_m: f64,
    /// Seed of both.
    pub seed: u64,
}

impl RobotSettings {
    /// The recommended set, one for all four robots; how each number is known:
    ///
    /// | number | why |
    /// |---|---|
    /// | 8 mm on the body, 4 mm on the actuator | 3 mm and 2 mm change the means of all four by up to 3 %: `docs/robots.md` |
    /// | rings under a taped sheet at 0.8 of that | seven rows from weld to middle of a pouch leave the sPAM's seams to snap or hold from seed to seed |
    /// | rows of 2 mm beside the welds of a folded sheet | full pouches set these welds on edge, which longer rows cannot follow |
    /// | waviness 0.1 mm | assumed; without it all seeds of a robot take the folds that its mesh prefers |
    /// | welds 3 mm wide | assumed; 4 mm lower cPAM and ePAM by 2 and 4 to 11 %, a line does not converge |
    /// | 0.04 + 0.36 + 0.06 s, masses raised | 24 000 to 47 000 steps; with rate-free fabrics only their number counts |
    /// | selective masses | the step asks for an eighth and less of the mass that it asks for without; half the steps change the means by up to 1.2 % |
    /// | ramp floor 2 kPa | the body's pressure: there a robot bends most per pascal, and gussets open |
    /// | mass damping 40 1/s | with the time at full pressure it brings the kinetic share below 1 % |
    /// | hourglass .001 | p R/(E t) of the TPU-coated body; .01 holds 9 to 16 % of the stored energy, .001 up to 2 % |
    /// | 1 % of compression | single sheets wrinkle below the mesh; with all of it the cPAM gains 10 mm for every millimetre off the elements |
    /// | bending factor 0.1 | assumed |
    /// | tape 0.025 mm with a margin of 8 mm | **calibrated** on the tip of the sPAM: of the pairs near it the one with which no seam snaps on any mesh |
    /// | ν₁₂ = 0.3 | **calibrated** on the tip of the fPAM; usual values of both: [`RobotSettings::usual`] |
    ///
    /// `ibr verify --only robots` holds this set against the measured tips.
    pub fn compressed() -> RobotSettings {
        RobotSettings {
            body_size_m: 8e-3,
            actuator_size_m: 4e-3,
            ring_spacing: None,
            seam_row_m: None,
            layer_gap_m: 1e-5,
            weld_m: 3e-3,
            bending_factor: 0.1,
            compression: 0.01,
            bond: 1.0,
            tape_m: 2.5e-5,
            tape_e_pa: 1e6,
            tape_margin_m: 8e-3,
            glue_m: 1e-4,
            glue_e_pa: 1e6,
            nu12: Some(0.3),
            density_kg_m3: 1000.0,
            actuator_pa: 30e3,
            body_ramp_s: 0.04,
            actuator_ramp_s: 0.36,
            ramp_floor_pa: Some(2e3),
            hold_s: 0.06,
            mass_factor: None,
            selective_mass: true,
            mass_passes: None,
            mass_damping_1_s: 40.0,
            hourglass: 1e-3,
            contact: None,
            encastre: false,
            imperfection: 2e-4,
            waviness_m: 1e-4,
            seed: 1,
        }
    }

    /// The same with what one would assume of the taped sheet and the weave before seeing a robot bend: nothing is calibrated.
    pub fn usual() -> RobotSettings {
        RobotSettings { tape_m: 5e-5, tape_margin_m: 0.0, nu12: Some(0.0), ..RobotSettings::compressed() }
    }

    /// The modelling choices of du Pasquier et al. 2023 (Section III-A and the captions of their figures), nothing calibrated:
    ///
    /// | choice | where |
    /// |---|---|
    /// | a hyperelastic shell: bends as a solid plate, carries all of compression | III-A, III-B |
    /// | *Tie* on welds and tape: a line without width, no margin, tape as thin as [`TIE_M`] | III-A |
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
            compression: 1.0,
            tape_m: TIE_M,
            tape_margin_m: 0.0,
            nu12: Some(0.0),
            body_ramp_s: 0.1,
            actuator_ramp_s: 1.0,
            ramp_floor_pa: None,
            hold_s: 0.0,
            mass_damping_1_s: 5.0,
            waviness_m: 0.0,
            ..RobotSettings::compressed()
        }
    }

    /// The actuator's pressure through (time \[s\], pressure \[Pa\]) points.
    pub(super) fn rise(&self, points: Vec<(f64, f64)>) -> Amplitude {
        match self.ramp_floor_pa {
            Some(floor) => Amplitude::Growing { points, floor },
            None => Amplitude::Smooth(points),
        }
    }

    /// Refuses numbers that cannot be meant.
    ///
    /// # Errors
    /// [`FemError::Problem`] with the name, the number and what is accepted.
    pub fn check(&self) -> Result<(), FemError> {
        let above_0 = f64::MIN_POSITIVE;
        for (name, value, low, high) in [
            ("body_size_m", self.body_size_m, 1e-4, 0.1),
            ("actuator_size_m", self.actuator_size_m, 1e-4, 0.1),
            ("ring_spacing", self.ring_spacing.unwrap_or(1.0), 0.1, 10.0),
            ("seam_row_m", self.seam_row_m.unwrap_or(1e-3), 1e-4, 0.1),
            ("layer_gap_m", self.layer_gap_m, 1e-7, 1e-3),
            ("weld_m", self.weld_m, 0.0, 0.1),
            ("bending_factor", self.bending_factor, 0.0, 10.0),
            ("compression", self.compression, 0.0, 1.0),
            ("bond", self.bond, 0.0, 1.0),
            ("tape_m", self.tape_m, above_0, 5e-3),
            ("tape_e_pa", self.tape_e_pa, above_0, 1e10),
            ("tape_margin_m", self.tape_margin_m, 0.0, 0.1),
            ("glue_m", self.glue_m, above_0, 5e-3),
            ("glue_e_pa", self.glue_e_pa, above_0, 1e10),
            ("density_kg_m3", self.density_kg_m3, 10.0, 2e4),
            ("actuator_pa", self.actuator_pa, 0.0, 1e6),
            ("body_ramp_s", self.body_ramp_s, above_0, 1e3),
            ("actuator_ramp_s", self.actuator_ramp_s, above_0, 1e3),
            ("ramp_floor_pa", self.ramp_floor_pa.unwrap_or(1.0), 1.0, 1e9),
            ("hold_s", self.hold_s, 0.0, 1e3),
            ("mass_factor", self.mass_factor.unwrap_or(1.0), 1.0, 1e4),
            ("waviness_m", self.waviness_m, 0.0, 1e-3),
        ] {
            if !(low..=high).contains(&value) {
                let low = if low == above_0 { "above 0".into() } else { low.to_string() };
                let message = format!("robot: {name} is {value}; write a number from {low} to {high}");
                return Err(FemError::Problem(message));
            }
        }
        Ok(())
    }
}

impl Default for RobotSettings {
    fn default() -> RobotSettings {
        RobotSettings::compressed()
    }
}

/// A number that nobody printed, and the interval it may lie in.
#[derive(Debug, Clone, Copy)]
pub struct Assumed {
    /// Field of [`RobotSettings`].
    pub name: &'static str,
    /// Smallest and largest plausible value, SI.
    pub interval: [f64; 2],
    /// Where the interval comes from.
    pub reason: &'static str,
    /// Writes a value.
    pub set: fn(&mut RobotSettings, f64),
}

/// What the four robots leave open, besides pouch count and marker stations, which are in the scenario.
pub const ASSUMED: &[Assumed] = &[
    Assumed {
        name: "weld_m",
        interval: [0.0, 0.008],
        reason: "a line to a wide impulse seal; ultrasonic wheels are a few millimetres wide",
        set: |s, v| s.weld_m = v,
    },
    Assumed {
        name: "bending_factor",
        interval: [0.02, 1.0],
        reason: "yarns that slide in a thin coat to a solid film",
        set: |s, v| s.bending_factor = v,
    },
    Assumed {
        name: "compression",
        interval: [0.01, 1.0],
        reason: "sheets that wrinkle below the mesh, as far as it was tried, to sheets that carry all of it",
        set: |s, v| s.compression = v,
    },
    Assumed {
        name: "bond",
        interval: [0.0, 1.0],
        reason: "plies that slide to plies without slip; shear lag through 0.05 mm of adhesive is about 2 mm",
        set: |s, v| s.bond = v,
    },
    Assumed {
        name: "tape_m",
        interval: [2e-5, 2.5e-4],
        reason: "adhesive transfer tapes are sold from 0.02 to 0.25 mm; 0.025 mm is calibrated on the sPAM's tip",
        set: |s, v| s.tape_m = v,
    },
    Assumed {
        name: "tape_margin_m",
        interval: [0.0, 0.015],
        reason: "a sheet cut at its welds to one that is easy to tape; 8 mm is calibrated on the sPAM's tip, 0 usual",
        set: |s, v| s.tape_margin_m = v,
    },
    Assumed {
        name: "waviness_m",
        interval: [0.0, 2e-4],
        reason: "a perfect pattern to a thickness of the fabric",
        set: |s, v| s.waviness_m = v,
    },
    Assumed { name: "glue_m", interval: [5e-5, 5e-4], reason: "a film spread by hand", set: |s, v| s.glue_m = v },
    Assumed { name: "glue_e_pa", interval: [3e5, 3e6], reason: "silicone adhesives", set: |s, v| s.glue_e_pa = v },
    Assumed {
        name: "nu12",
        interval: [0.0, 0.4],
        reason: "woven fabrics pulled in one direction; 0 is yarns that do not cross; 0.3 is calibrated on the fPAM's tip",
        set: |s, v| s.nu12 = Some(v),
    },
    Assumed {
        name: "density_kg_m3",
        interval: [700.0, 1300.0],
        reason: "nylon 1140, coats 900 to 1200, air between yarns",
        set: |s, v| s.density_kg_m3 = v,
    },
];
