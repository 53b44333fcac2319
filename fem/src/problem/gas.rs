//! The gas of a chamber that is sealed, leaks or is filled by a flow.

use super::Amplitude;

/// The gas of a chamber without a supply that sets its pressure.
///
/// ```text
/// dP/dt = n/(V + V_d) · [p_atm (q − C p) − P dV/dt]        P = p + p_atm
/// ```
///
/// | symbol | meaning | unit |
/// |---|---|---|
/// | P, p | absolute and gauge pressure | Pa |
/// | V, V_d | volume of the chamber, dead volume | m³ |
/// | n | polytropic exponent | – |
/// | q | inflow, as volume at p_atm and room temperature | m³/s |
/// | C | leak, as the same volume per gauge pressure | m³/(s Pa) |
///
/// Without q and C it is P (V + V_d)ⁿ = const. Valid for an ideal gas that flows at room temperature: exact for n = 1 and for filling
/// with n = γ; a leaking gas with n > 1 has another temperature, an error of the order of (n − 1) p/p_atm of the leak.
/// Source: Richer, Hurmuzlu 2000, A high performance pneumatic force actuator system, part I, with one n for all three terms.
#[derive(Debug, Clone, PartialEq)]
pub struct Gas {
    /// Pressure of the surroundings p_atm \[Pa\].
    pub atmosphere_pa: f64,
    /// Volume V_d of hose and fittings, which the mesh does not have \[m³\].
    pub dead_m3: f64,
    /// n: 1 isothermal (slow), the heat ratio 1.4 adiabatic (fast).
    pub exponent: f64,
    /// Leak C as volume per gauge pressure \[m³/(s Pa)\]; 0 for a tight chamber.
    pub leak_m3_s_pa: f64,
    /// Inflow q over time, as volume at atmospheric pressure \[m³/s\].
    pub inflow_m3_s: Amplitude,
}

impl Default for Gas {
    /// A constant mass of air at constant temperature, all of it in the chamber.
    fn default() -> Gas {
        let inflow_m3_s = Amplitude::Constant(0.0);
        Gas { atmosphere_pa: 101_325.0, dead_m3: 0.0, exponent: 1.0, leak_m3_s_pa: 0.0, inflow_m3_s }
    }
}

impl Gas {
    /// Gauge pressure \[Pa\] at sealing, and the content that is conserved from then on.
    pub(crate) fn sealed(&self, pressure_pa: f64, all_m3: f64, t: f64) -> (f64, Option<(f64, f64)>) {
        let content = (pressure_pa + self.atmosphere_pa) * all_m3.powf(self.exponent);
        (pressure_pa, Some((content, t)))
    }

    /// The same after the gas had the volume and flowed from `before_s` to `t`: exact at constant volume and inflow.
    pub(crate) fn flows(&self, content: f64, all_m3: f64, before_s: f64, t: f64) -> (f64, Option<(f64, f64)>) {
        let power = all_m3.powf(self.exponent);
        let closed_pa = content / power - self.atmosphere_pa;
        let (leak, dt) = (self.leak_m3_s_pa, t - before_s);
        let rate = self.exponent * self.atmosphere_pa / all_m3 * dt;
        let faded = if leak > 0.0 { -(-rate * leak).exp_m1() / leak } else { rate };
        let flow = self.inflow_m3_s.at(t - 0.5 * dt) - leak * closed_pa;
        let pressure_pa = closed_pa + flow * faded;
        (pressure_pa, Some(((pressure_pa + self.atmosphere_pa) * power, t)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROOM_PA: f64 = 101_325.0;
    const DT_S: f64 = 1e-4;

    /// Gauge pressures of a gas of 5 kPa at 1 litre whose volume follows `volume_m3`, every step for `end_s`.
    fn pressures(gas: &Gas, end_s: f64, volume_m3: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
        let (mut pressure_pa, mut content) = gas.sealed(5e3, volume_m3(0.0) + gas.dead_m3, 0.0);
        let mut all = vec![(0.0, pressure_pa)];
        for step in 1..=(end_s / DT_S).round() as u32 {
            let (before, t) = (content.unwrap(), f64::from(step) * DT_S);
            (pressure_pa, content) = gas.flows(before.0, volume_m3(t) + gas.dead_m3, before.1, t);
            all.push((t, pressure_pa));
        }
        all
    }

    #[test]
    fn a_closed_gas_keeps_p_v_to_the_n_with_its_dead_volume() {
        let squeezed = |t: f64| 1e-3 * (1.0 - 0.4 * (30.0 * t).sin().powi(2));
        for (exponent, dead_m3) in [(1.0, 0.0), (1.0, 2e-4), (1.4, 0.0), (1.4, 2e-4)] {
            let gas = Gas { exponent, dead_m3, ..Gas::default() };
            let kept = |t: f64, p: f64| (p + ROOM_PA) * (squeezed(t) + dead_m3).powf(exponent);
            let all = pressures(&gas, 0.2, squeezed);
            let (start, lowest) = (kept(0.0, 5e3), all.iter().fold(f64::INFINITY, |m, (_, p)| m.min(*p)));
            assert!(all.iter().all(|(t, p)| (kept(*t, *p) / start - 1.0).abs() < 1e-11), "n = {exponent}");
            // Squeezed to the smallest volume: by the law of the text books.
            let least = (5e3 + ROOM_PA) * ((1e-3 + dead_m3) / (6e-4 + dead_m3)).powf(exponent) - ROOM_PA;
            let most = all.iter().fold(0.0_f64, |m, (_, p)| m.max(*p));
            assert!((most / least - 1.0).abs() < 1e-4 && lowest >= 5e3 - 1e-6, "{most} {least}");
        }
    }

    #[test]
    fn a_leak_empties_a_rigid_chamber_exponentially_and_an_inflow_fills_it_linearly() {
        for exponent in [1.0, 1.4] {
            let (dead_m3, leak_m3_s_pa) = (5e-4, 1e-8);
            let leaks = Gas { exponent, dead_m3, leak_m3_s_pa, ..Gas::default() };
            let fade_s = 1.5e-3 / (exponent * ROOM_PA * leak_m3_s_pa);
            for (t, p) in pressures(&leaks, 2.0, |_| 1e-3) {
                assert!((p - 5e3 * (-t / fade_s).exp()).abs() < 1e-6, "n = {exponent}, t = {t}: {p}");
            }
            let inflow_m3_s = Amplitude::Constant(2e-5);
            let fills = Gas { exponent, dead_m3, inflow_m3_s: inflow_m3_s.clone(), ..Gas::default() };
            for (t, p) in pressures(&fills, 2.0, |_| 1e-3) {
                assert!(
                    (p - 5e3 - exponent * ROOM_PA * 2e-5 / 1.5e-3 * t).abs() < 1e-6,
                    "n = {exponent}, t = {t}: {p}"
                );
            }
            // Both at once end where they are equal, however fast the leak is against a step.
            for leak_m3_s_pa in [1e-8, 1e-3] {
                let both = Gas { leak_m3_s_pa, inflow_m3_s: inflow_m3_s.clone(), ..leaks.clone() };
                let last = pressures(&both, 60.0, |_| 1e-3).last().unwrap().1;
                assert!((last / (2e-5 / leak_m3_s_pa) - 1.0).abs() < 1e-6, "{last}");
            }
        }
    }

    #[test]
    fn an_inflow_at_constant_pressure_swells_the_chamber_by_its_own_volume() {
        // n = 1: d(P V)/dt = p_atm q, so that V may grow by q p_atm/P without a change of P.
        let gas = Gas { inflow_m3_s: Amplitude::Linear(vec![(0.0, 0.0), (1.0, 4e-4)]), ..Gas::default() };
        let grown = |t: f64| 1e-3 + 0.5 * 4e-4 * t * t * ROOM_PA / (ROOM_PA + 5e3);
        for (t, p) in pressures(&gas, 1.0, grown) {
            assert!((p - 5e3).abs() < 1e-3, "t = {t}: {p}");
        }
    }
}
