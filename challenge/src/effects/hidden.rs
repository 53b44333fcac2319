//! Effects that the catalogue of `models` also knows, by another law: of the actuator, of the body, of loads, supply and camera.

use super::kind::HiddenEffect;
use crate::robot::TrueRobot;
use models::actuators::Family;
use std::f64::consts::TAU;

/// Hinge moment of a body of 80 mm at 2 kPa, π p R³ \[N·m\].
const HINGE_NM: f64 = 0.402;
/// Length over which a clamp stiffens the wall \[m\].
const CLAMP_M: f64 = 0.12;
/// Length of a sleeve on an end, one diameter of a body of 80 mm \[m\].
const SLEEVE_M: f64 = 0.08;

/// A clamp by the first law, a sleeve by the second, at the base or the tip.
fn clamp(robot: &mut TrueRobot, law: usize, amount: f64, from_tip: bool) {
    let length = robot.length_m;
    robot.walls(|wall, s| {
        let away = if from_tip { length - s } else { s };
        let near = match law {
            0 => (1.0 - away / CLAMP_M).max(0.0),
            _ => f64::from(u8::from(away < SLEEVE_M)),
        };
        wall.bending *= 1.0 + amount * near * near;
    });
}

/// Effects that the catalogue of `models` also knows, by another law.
pub const HIDDEN: &[HiddenEffect] = &[
    HiddenEffect {
        name: "end_constraint",
        sentence: "Closed side edges pinch the pouch, so it holds less air the higher its lens.",
        family: None,
        equations: &[
            "volume (1 − β h/W) with the lens's height h; fPAM (1 − 4β r/L): stroke and end angle are lost, not a share of both",
            "volume (1 − β (h/W)²), fPAM (1 − β (4r/L)²): an inextensible sheet that bows by f over a span S draws its ends in by 8f²/3S",
        ],
        // The ends of a long tube take a smaller share of its volume.
        sizes: |robot| [if robot.cells[0].is(Family::Mckibben) { 0.2 } else { 0.5 }, 1.0],
        put: |robot, law, amount| robot.drives(|drive| drive.edge_loss[law] += amount),
    },
    HiddenEffect {
        name: "arm_growth",
        sentence: "The swelling pouch pushes its line of action off the body, late and then no further.",
        family: None,
        equations: &[
            "arm + s h²/(h² + (0.35 L₀)²), a Hill curve instead of a straight line",
            "arm + s (sinθ/θ − cosθ)/2θ: half of the tension runs in the bulged wall, and pulls through the centroid of that arc",
        ],
        sizes: |_| [0.016, 0.02],
        put: |robot, law, amount| robot.drives(|drive| drive.swell_m[law] += amount),
    },
    HiddenEffect {
        name: "fabric_stretch",
        sentence: "The yarns of the actuator's fabric straighten first and stretch then, and eat part of the stroke.",
        family: None,
        equations: &[
            "strain c (0.4 T + 300 (1 − e^(−T/500))): soft at first, then stiffer, instead of linear",
            "strain c T₀ ln(1 + T/T₀), T₀ = 300 N/m: Fung 1967, tension grows exponentially once crimp is pulled out",
        ],
        sizes: |_| [1e-4, 1e-4],
        put: |robot, law, amount| robot.drives(|drive| drive.stretch_m_per_n[law] += amount),
    },
    HiddenEffect {
        name: "seam_stiffness",
        sentence: "Welds and creases resist rolling up until they yield like a folded sheet.",
        family: Some(Family::Pouch),
        equations: &[
            "m tanh(θ/0.6) per pouch, an elastic-plastic hinge instead of a spring",
            "m θ^0.4 per pouch: Hollomon, a sheet whose stress is K εⁿ bends by a moment that grows as κⁿ",
        ],
        sizes: |_| [0.5, 0.5],
        put: |robot, law, amount| robot.drives(|drive| drive.crease_nm[law] += amount),
    },
    HiddenEffect {
        name: "shear_stiffness",
        sentence: "The coated weave resists shearing, and the more the further it is sheared.",
        family: Some(Family::Mckibben),
        equations: &[
            "τ = G γ (1 + (γ/0.3)²) instead of G γ",
            "τ = G γ/(1 + γ/0.15): Kondner 1963, crossings of yarns let go of each other one by one, so that it gets softer",
        ],
        sizes: |_| [35.0, 50.0],
        put: |robot, law, amount| robot.drives(|drive| drive.shear_n_per_m[law] += amount),
    },
    HiddenEffect {
        name: "shear_lock",
        sentence: "Neighbouring yarns press on each other ever harder, and the weave stops shearing.",
        family: Some(Family::Mckibben),
        equations: &[
            "τ_L exp((γ − 0.22)/0.035) instead of a corner",
            "τ_L ((1 − γ/0.36)⁻³ − 1): van Wyk 1946, fibres that are pressed together push back by the cube of their density",
        ],
        sizes: |_| [20.0, 5.0],
        put: |robot, law, amount| robot.drives(|drive| drive.lock_n_per_m[law] += amount),
    },
    HiddenEffect {
        name: "wrinkling",
        sentence: "The wall wrinkles little by little: small bends meet less of the body's pressure than large ones.",
        family: None,
        equations: &[
            "M₀ x/(1 + x^1.5)^(2/3), x = κ/κ_w, instead of Comer–Levy's curve",
            "M₀ x/3 up to x = κ/κ_w = 1, then M₀ (1 − ⅔ x^−½): a rectangular section that bears no compression, as in masonry",
        ],
        sizes: |robot| [0.25, 0.1].map(|share| share * robot.scale_per_m),
        put: |robot, law, amount| robot.walls(|wall, _| wall.wrinkle_per_m[law] += amount),
    },
    HiddenEffect {
        name: "tail_tension",
        sentence: "The tail inside pulls on the tip with the body's own pressure and drags along the wall.",
        family: None,
        equations: &[
            "moment ∝ p_b and falling by a quarter from base to tip, instead of one constant",
            "moment ∝ p_b e^(μ κ (L − s)), μ = 0.3: capstan, the pull grows with every bend that the tail is dragged round (Blumenschein 2017)",
        ],
        // Moments at 2 kPa.
        sizes: |_| [0.45, 0.4],
        put: |robot, law, amount| {
            let length = robot.length_m;
            robot.walls(|wall, s| match law {
                0 => wall.tail_m3[0] += amount / 2e3 * (1.125 - 0.25 * s / length),
                _ => {
                    wall.tail_m3[1] += amount / 2e3;
                    wall.dragged_m = length - s;
                }
            });
        },
    },
    HiddenEffect {
        name: "ovalization",
        sentence: "The bent body flattens and brings the actuator nearer to the far wall, until it is flat.",
        family: None,
        equations: &[
            "D (1 − o κ²/(κ² + κ_c²)) instead of D/(1 + o (κ/κ_c)²)",
            "D (1 − o x/(1 + x)), x = κ/κ_c: a line load dents an inflated tube in proportion at first, and no further than flat",
        ],
        sizes: |_| [0.25, 0.25],
        put: |robot, law, amount| robot.walls(|wall, _| wall.oval[law] += amount),
    },
    HiddenEffect {
        name: "self_contact",
        sentence: "Folds on the inside of the bend press on each other ever harder and stop it.",
        family: None,
        equations: &[
            "m exp((κ/κ_c − 0.7)/0.08) instead of a corner",
            "m ((κ/κ_c − 0.6)₊/0.1)^1.5: Hertz, round folds touch at once and press with the power 3/2 of their approach",
        ],
        sizes: |robot| [0.01, 0.1].map(|share| share * (robot.wall_moment() + HINGE_NM)),
        put: |robot, law, amount| robot.walls(|wall, _| wall.stop_nm[law] += amount),
    },
    HiddenEffect {
        name: "base_clamp",
        sentence: "The clamp keeps the body near the base from folding.",
        family: None,
        equations: &[
            "B (1 + b (1 − s/120 mm)²) near the base instead of an exponential",
            "B (1 + b) up to 80 mm from the base: a clamped sleeve, and by Saint-Venant an end is felt for one diameter",
        ],
        sizes: |_| [3.0, 1.5],
        put: |robot, law, amount| clamp(robot, law, amount, false),
    },
    HiddenEffect {
        name: "tip_clamp",
        sentence: "The closed end keeps the body near the tip from folding.",
        family: None,
        equations: &[
            "B (1 + b (1 − s/120 mm)²) near the tip instead of an exponential",
            "B (1 + b) up to 80 mm from the tip: a clamped sleeve, and by Saint-Venant an end is felt for one diameter",
        ],
        sizes: |_| [3.0, 1.5],
        put: |robot, law, amount| clamp(robot, law, amount, true),
    },
    HiddenEffect {
        name: "initial_curvature",
        sentence: "The robot was stored rolled up and wants to bend, more near its ends than in the middle.",
        family: None,
        equations: &[
            "κ₀ (1 + 0.4 cos 2πs/L) instead of a constant",
            "κ₀/√(1 + 3 (1 − s/L)): rolled up from the tip, the radius of a spiral grows as the root of the length wound",
        ],
        sizes: |robot| [0.125, 0.2].map(|share| share * robot.scale_per_m),
        put: |robot, law, amount| {
            let length = robot.length_m;
            robot.walls(|wall, s| {
                wall.rest_per_m += match law {
                    0 => amount * (1.0 + 0.4 * (TAU * s / length).cos()),
                    _ => amount / (1.0 + 3.0 * (1.0 - s / length)).sqrt(),
                }
            });
        },
    },
    HiddenEffect {
        name: "plastic_set",
        sentence: "Coating and creases keep part of a bend beyond their yield, and let go of it slowly.",
        family: None,
        equations: &[
            "s (κ_max − 0.25 κ_c)₊ that fades with 40 s, instead of s κ_max for good",
            "κ_p of κ_max = κ_e + κ_p, κ_p = s κ_e²/κ_c, for good: Ramberg and Osgood 1943, without a yield point",
        ],
        sizes: |_| [0.16, 0.12],
        put: |robot, law, amount| robot.walls(|wall, _| wall.set[law] += amount),
    },
    HiddenEffect {
        name: "friction",
        sentence: "Layers rub on each other and slide one after another, so up and down differ.",
        family: None,
        equations: &[
            "four Maxwell-slip layers that start to slide at 2, 6, 15 and 30 % of the scale, instead of Coulomb's corner",
            "dM/dκ = M_f/κ_d (1 − M sgn(κ̇)/M_f), κ_d = 0.08 κ_c: Dahl 1968, bristles that bend and break off",
        ],
        sizes: |robot| [0.15 * robot.wall_moment(); 2],
        put: |robot, law, amount| robot.walls(|wall, _| wall.friction_nm[law] += amount),
    },
    HiddenEffect {
        name: "creep",
        sentence: "The coated fabric goes on yielding while the pressure is held, fast at first and slowly for long.",
        family: None,
        equations: &[
            "relaxation times of 0.7, 3 and 15 s instead of one",
            "stiffness g (1 + t/0.1 s)^−0.2 after a step: the power law of polymers, as eight relaxation times from 0.1 s to half an hour",
        ],
        sizes: |robot| [0.25 * robot.wall_moment() / robot.scale_per_m; 2],
        put: |robot, law, amount| robot.walls(|wall, _| wall.creep_nm2[law] += amount),
    },
    HiddenEffect {
        name: "gravity",
        sentence: "The robot's weight pulls it down: the body, the pouches and, heavier, the end.",
        family: None,
        equations: &[
            "w (0.7 + 0.6 s/L) instead of w",
            "⅔ w along the body and w L/3 at the tip: a uniform tube with an end cap and its fitting",
        ],
        sizes: |_| [1.5, 1.2],
        put: |robot, law, amount| {
            let (length, loads) = (robot.length_m, &mut robot.loads);
            for (weight, cell) in loads.weight_n_per_m.iter_mut().zip(&robot.cells) {
                *weight += match law {
                    0 => amount * (0.7 + 0.6 * (cell.start_m + 0.5 * cell.length_m) / length),
                    _ => amount * 2.0 / 3.0,
                };
            }
            if law == 1 {
                loads.cap_n += amount * length / 3.0;
            }
        },
    },
    HiddenEffect {
        name: "tip_load",
        sentence: "A cable runs from the tip over a pulley below and pulls.",
        family: None,
        equations: &[
            "towards (0.8 L, −1.4 L): its direction turns as the tip moves, instead of a dead load",
            "w (h + 0.3 m)₊ down, h the tip's height: a hose hangs from the tip and rests on the table, and its lifted part weighs",
        ],
        sizes: |_| [0.4, 1.0],
        put: |robot, law, amount| match law {
            0 => {
                robot.loads.cable_n += amount;
                robot.loads.pulley_m = [0.8 * robot.length_m, -1.4 * robot.length_m];
            }
            _ => robot.loads.hose_n_per_m += amount,
        },
    },
    HiddenEffect {
        name: "pressure_loss",
        sentence: "Air that leaves through a small hole loses pressure in the hose.",
        family: None,
        equations: &[
            "p − f √(p·20 kPa): orifice and hose in series, instead of a constant share",
            "p − f p^1.5/√(30 kPa): a seam gapes in proportion to p and leaks by gap and √p, through a laminar hose",
        ],
        sizes: |_| [0.15, 0.15],
        put: |robot, law, amount| robot.supply.loss[law] += amount,
    },
    HiddenEffect {
        name: "pressure_offset",
        sentence: "The regulator's valve opens only above a threshold, softly.",
        family: None,
        equations: &[
            "√(p² + p₀²) − p₀ instead of p − p₀",
            "p − p₀ (1 − e^(−p/p₀)): a diaphragm whose spring is taken up bit by bit as the rubber seat lifts",
        ],
        sizes: |_| [2e3, 2e3],
        put: |robot, law, amount| robot.supply.dead_band_pa[law] += amount,
    },
    HiddenEffect {
        name: "leak",
        sentence: "The actuator leaks and runs down towards what the regulator can hold.",
        family: None,
        equations: &[
            "p (0.6 + 0.4 e^(−r t/0.4)) instead of p (1 − r t)",
            "p (1 − ½ r t √(20 kPa/p))²: Torricelli, a closed volume that empties through a hole",
        ],
        sizes: |_| [0.02, 0.02],
        put: |robot, law, amount| robot.supply.leak_per_s[law] += amount,
    },
    HiddenEffect {
        name: "camera_scale",
        sentence: "The camera's millimetre is wrong, and a little more so far from the base.",
        family: None,
        equations: &[
            "(1 + c)(1 + 0.4 c x/L), with keystone, instead of 1 + c",
            "x (1 + c), y (1 + c/2): pixels that are not square, or a calibration board that was tilted",
        ],
        sizes: |_| [0.021, 0.02],
        put: |robot, law, amount| robot.camera.scale[law] += amount,
    },
    HiddenEffect {
        name: "camera_rotation",
        sentence: "The camera is rolled, and its lens bends the image a little.",
        family: None,
        equations: &[
            "δ (1 + 0.15 x/L) instead of δ",
            "δ about the middle of the picture (L/2, 0): the camera was knocked after it was calibrated, and turns about its own axis",
        ],
        sizes: |_| [0.019, 0.02],
        put: |robot, law, amount| robot.camera.roll_rad[law] += amount,
    },
    HiddenEffect {
        name: "mount_rotation",
        sentence: "The base mount gives way as the actuator is pressurised, less and less.",
        family: None,
        equations: &[
            "φ 1.4 u/(1 + 0.4 u), u = P/30 kPa, instead of φ u",
            "φ (u − ¼)₊/¾, u = P/30 kPa: a gripped base holds by friction, and gives way in proportion beyond that",
        ],
        sizes: |_| [0.024, 0.024],
        put: |robot, law, amount| robot.camera.mount_rad[law] += amount,
    },
    HiddenEffect {
        name: "marker_height",
        sentence: "The markers sit above the robot's axis, near the tip more than near the base.",
        family: None,
        equations: &[
            "e (1 + 0.3 (s/L − ½)) instead of e",
            "pins of length e that lean by 20° towards the tip: a rigid offset along the body as well as across it",
        ],
        sizes: |_| [0.01, 0.01],
        put: |robot, law, amount| robot.camera.height_m[law] += amount,
    },
];
