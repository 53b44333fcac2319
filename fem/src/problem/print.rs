//! What of a problem two runs must share so that one can go on from the other, and the loads at a moment.

use std::collections::BTreeMap;

use super::{Amplitude, Pressure, Problem};
use crate::problem::Guards;

/// Loads at one moment by what they are, with their unit; a pressure is the first of the three numbers.
pub type PrintedLoads = BTreeMap<String, [f64; 3]>;

/// Name of a chamber's pressure in [`PrintedLoads`].
pub fn pressure_of(chamber: &str) -> String {
    format!("pressure of chamber `{chamber}` [Pa]")
}
/// Name of the force on a node set in [`PrintedLoads`].
pub fn force_on(set: &str) -> String {
    format!("force on `{set}` [N]")
}
/// Name by which [`PrintedLoads`] addresses the acceleration of gravity.
pub const GRAVITY: &str = "gravity [m/s²]";
/// Name of the motion of an obstacle, from 0, in [`PrintedLoads`].
pub fn motion_of(obstacle: usize) -> String {
    format!("motion of obstacle {} [m]", obstacle + 1)
}

impl Problem {
    /// A number that two problems share only if a checkpoint of one fits the other; threads do not matter.
    pub fn fingerprint(&self) -> u64 {
        let mut plain = self.clone();
        plain.settings.threads = 0;
        plain.number()
    }

    /// The same, whatever the time at which the run ends.
    pub(crate) fn fingerprint_of_any_length(&self) -> u64 {
        let mut plain = self.clone();
        plain.settings.end_s = 0.0;
        plain.fingerprint()
    }

    /// A number that two problems share if a run of one can go on from the end of the other: mesh, sections, supported nodes, contact and
    /// numerics agree. Pressures, forces, gravity, obstacles, amplitudes of supports, guards, patience, end time and outputs may differ.
    pub(crate) fn fingerprint_of_structure(&self) -> u64 {
        let mut plain = self.clone();
        plain.name.clear();
        (plain.forces, plain.gravity, plain.obstacles) = (Vec::new(), None, Vec::new());
        for chamber in plain.chambers.iter_mut() {
            chamber.pressure = Pressure::Set(Amplitude::Constant(0.0));
        }
        let still = || [0; 3].map(|_| Amplitude::Constant(0.0));
        for support in plain.supports.iter_mut() {
            support.motion = support.motion.as_ref().map(|_| still());
        }
        let s = &mut plain.settings;
        (s.output_every_s, s.patience, s.guards) = (0.0, None, Guards::default());
        plain.fingerprint_of_any_length()
    }

    fn number(&self) -> u64 {
        struct Fnv(u64);
        impl std::fmt::Write for Fnv {
            fn write_str(&mut self, text: &str) -> std::fmt::Result {
                for b in text.bytes() {
                    self.0 = (self.0 ^ u64::from(b)).wrapping_mul(0x0100_0000_01b3);
                }
                Ok(())
            }
        }
        let mut hash = Fnv(0xcbf2_9ce4_8422_2325);
        // Writing into a hash cannot fail.
        let _ = std::fmt::Write::write_fmt(&mut hash, format_args!("{self:?}"));
        hash.0
    }

    /// All loads at a time \[s\] that the problem sets; a sealed chamber's pressure follows its volume and is none of them.
    pub(crate) fn loads_at(&self, time_s: f64) -> PrintedLoads {
        let mut loads = PrintedLoads::new();
        for chamber in &self.chambers {
            let set = match &chamber.pressure {
                Pressure::Set(amplitude) => amplitude,
                Pressure::Sealed { filling, sealed_at_s, .. } if time_s < *sealed_at_s => filling,
                Pressure::Sealed { .. } => continue,
            };
            loads.insert(pressure_of(&chamber.name), [set.at(time_s), 0.0, 0.0]);
        }
        for force in &self.forces {
            let sum = loads.entry(force_on(&force.set)).or_default();
            for (sum, total) in sum.iter_mut().zip(force.total_n) {
                *sum += total * force.amplitude.at(time_s);
            }
        }
        if let Some(gravity) = &self.gravity {
            loads.insert(GRAVITY.into(), gravity.g_m_s2.map(|g| g * gravity.amplitude.at(time_s)));
        }
        for (i, obstacle) in self.obstacles.iter().enumerate() {
            loads.insert(motion_of(i), obstacle.moved_m(time_s));
        }
        for support in &self.supports {
            if let Some(motion) = &support.motion {
                loads.insert(
                    format!("motion of support `{}` [m]", support.set),
                    [0, 1, 2].map(|k| motion[k].at(time_s)),
                );
            }
        }
        loads
    }
}
