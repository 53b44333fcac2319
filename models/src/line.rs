//! From a valve to the actuator: how fast a set pressure arrives.
//!
//! ```text
//! valve   P_v' = (P_set − P_v)/τ
//! line    P' = p₀ C/V · p_up ψ(p_down/p_up)        into the actuator where P_v > P, else out of it
//!         ψ(r) = 1 for r ≤ b,   √(1 − ((r − b)/(1 − b))²) for r > b       absolute pressures; linear from r = 0.999 to 1
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | τ | time constant of valve or regulator | s |
//! | C | sonic conductance of valve and tube, as data sheets have it (ISO 6358) | m³/(s·Pa) |
//! | b | critical pressure ratio, below which the flow is choked | - |
//! | V | volume that is filled: actuator and tube | m³ |
//! | p₀ | reference pressure of C, 100 kPa | Pa |
//!
//! **Validity**: isothermal, V as it is at the working point, no waves in the tube (long ones need them). The laws of the supply
//! stage act on what arrives. Reference: ISO 6358-1:2013; the linear end is its usual cure for the infinite slope at r = 1.

use crate::term::CHANNELS;

/// A valve and its line, the same for every channel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    /// Time constant τ of the valve \[s\]; 0: at once.
    pub valve_time_s: f64,
    /// Flow p₀ C/V \[1/s\]; infinite: at once.
    pub flow_per_s: f64,
    /// Ratio b of absolute pressures below which the flow is choked \[-\], as in ISO 6358.
    pub critical_ratio: f64,
}

/// Gauge pressures between the valves and the actuators at one time \[Pa\].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct InLine {
    /// Pressure behind each channel's valve, which follows the set one with the time constant τ.
    pub valve_pa: [f64; CHANNELS],
    /// In the actuators of each channel.
    pub arrived_pa: [f64; CHANNELS],
}

/// Reference pressure of a sonic conductance \[Pa\].
pub(crate) const REFERENCE_PA: f64 = 1e5;
/// Absolute pressure of the room \[Pa\], added to gauge pressures for the ratio of the flow.
const ROOM_PA: f64 = 101_325.0;
/// Ratio of pressures from which the flow is laminar.
const LAMINAR: f64 = 0.999;
/// Steps of Runge and Kutta over the shortest time in which the flow changes.
const STEPS: f64 = 8.0;
/// A pressure nearer than this to the set one has arrived \[Pa\].
const ARRIVED_PA: f64 = 1e-3;

impl Line {
    /// Lets `dt_s` pass at set pressures.
    ///
    /// ```
    /// let valve = models::Line { valve_time_s: 0.2, flow_per_s: f64::INFINITY, critical_ratio: 0.3 };
    /// let mut way = models::InLine::default();
    /// valve.pass(&[30e3; 4], 0.2, &mut way);
    /// assert!((way.arrived_pa[0] - 30e3 * (1.0 - (-1.0_f64).exp())).abs() < 1e-6);
    /// ```
    pub fn pass(&self, set_pa: &[f64; CHANNELS], dt_s: f64, way: &mut InLine) {
        for (channel, set) in set_pa.iter().enumerate() {
            let before = way.valve_pa[channel];
            let valve = |t: f64| self.valve(*set, before, t);
            way.valve_pa[channel] = valve(dt_s);
            way.arrived_pa[channel] = match self.flow_per_s {
                f64::INFINITY => valve(dt_s),
                _ => self.fill(way.arrived_pa[channel], &valve, *set, dt_s),
            };
        }
    }

    /// Behind the valve after a time: a first-order lag, exact.
    fn valve(&self, set: f64, before: f64, t_s: f64) -> f64 {
        if self.valve_time_s > 0.0 { set + (before - set) * (-t_s / self.valve_time_s).exp() } else { set }
    }

    /// In the actuator after a time: the classical method of Runge and Kutta, its steps a part of the shortest time scale.
    fn fill(&self, mut p: f64, valve: &dyn Fn(f64) -> f64, set: f64, dt_s: f64) -> f64 {
        let fastest = self.flow_per_s * self.share(LAMINAR) / (1.0 - LAMINAR);
        let count = (STEPS * fastest * dt_s).ceil().max(1.0);
        let (h, mut done) = (dt_s / count, 0.0);
        while done < count {
            if (p - set).abs() < ARRIVED_PA && (valve(done * h) - set).abs() < ARRIVED_PA {
                return set;
            }
            let rate = |t: f64, p: f64| self.rate(valve(t), p);
            let t = done * h;
            let k1 = rate(t, p);
            let k2 = rate(t + 0.5 * h, p + 0.5 * h * k1);
            let k3 = rate(t + 0.5 * h, p + 0.5 * h * k2);
            let k4 = rate(t + h, p + h * k3);
            p += h / 6.0 * (k1 + 2.0 * (k2 + k3) + k4);
            done += 1.0;
        }
        p
    }

    /// dp/dt in the actuator \[Pa/s\]: positive while the valve's pressure is the higher one.
    fn rate(&self, valve_pa: f64, p_pa: f64) -> f64 {
        let [up, down] = [valve_pa.max(p_pa), valve_pa.min(p_pa)].map(|p| p + ROOM_PA);
        (valve_pa - p_pa).signum() * self.flow_per_s * up * self.share(down / up)
    }

    /// Flow over the choked one, ψ.
    fn share(&self, ratio: f64) -> f64 {
        let b = self.critical_ratio;
        let open = |r: f64| (1.0 - ((r - b).max(0.0) / (1.0 - b)).powi(2)).sqrt();
        if ratio < LAMINAR { open(ratio) } else { open(LAMINAR) * (1.0 - ratio) / (1.0 - LAMINAR) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ode_solvers::dop_shared::OutputType;
    use ode_solvers::{Dopri5, System, Vector1};

    const LINE: Line = Line { valve_time_s: 0.0, flow_per_s: 0.8, critical_ratio: 0.4 };

    fn after(line: &Line, from: f64, set: f64, t_s: f64, parts: usize) -> f64 {
        let mut way = InLine { valve_pa: [from; CHANNELS], arrived_pa: [from; CHANNELS] };
        (0..parts).for_each(|_| line.pass(&[set; CHANNELS], t_s / parts as f64, &mut way));
        assert!(way.arrived_pa.iter().all(|p| *p == way.arrived_pa[0]));
        way.arrived_pa[0]
    }

    #[test]
    fn a_valve_alone_is_the_exponential_whatever_the_steps() {
        let valve = Line { valve_time_s: 0.3, flow_per_s: f64::INFINITY, ..LINE };
        for (t, parts) in [(0.1, 1), (0.5, 7), (2.0, 100)] {
            let exact = 40e3 + (10e3 - 40e3) * (-t / 0.3_f64).exp();
            assert!((after(&valve, 10e3, 40e3, t, parts) - exact).abs() < 1e-8, "{t}");
        }
    }

    /// While the flow is choked the pressure rises on a straight line, p₀ C/V · p_up.
    #[test]
    fn a_choked_line_fills_at_a_constant_rate() {
        let set = 400e3;
        let rate = LINE.flow_per_s * (set + ROOM_PA);
        let choked_until = 0.4 * (set + ROOM_PA) - ROOM_PA;
        let t = 0.9 * choked_until / rate;
        assert!((after(&LINE, 0.0, set, t, 3) / (rate * t) - 1.0).abs() < 1e-9);
    }

    /// Beyond it r = b + (1 − b) sin φ with φ' = k/(1 − b): filling is over after a time that is finite.
    #[test]
    fn a_line_below_choking_fills_as_the_sine() {
        let (set, b, k) = (60e3, LINE.critical_ratio, LINE.flow_per_s);
        let start = ((ROOM_PA / (set + ROOM_PA) - b) / (1.0 - b)).asin();
        for t in [0.05, 0.2, 0.4] {
            let exact = (b + (1.0 - b) * (start + k * t / (1.0 - b)).sin()) * (set + ROOM_PA) - ROOM_PA;
            assert!((after(&LINE, 0.0, set, t, 2) - exact).abs() < 1e-3, "{t}: {exact}");
        }
        assert_eq!(after(&LINE, 0.0, set, 10.0, 2), set);
    }

    /// Valve and line together, filling and venting, against another solver.
    #[test]
    fn both_together_follow_dormand_and_prince() {
        struct Problem {
            line: Line,
            from: f64,
            set: f64,
        }
        impl System<f64, Vector1<f64>> for Problem {
            fn system(&self, t: f64, p: &Vector1<f64>, dp: &mut Vector1<f64>) {
                dp[0] = self.line.rate(self.line.valve(self.set, self.from, t), p[0]);
            }
        }
        let line = Line { valve_time_s: 0.15, ..LINE };
        for (from, set) in [(0.0, 50e3), (50e3, 0.0), (20e3, 30e3)] {
            let start = Vector1::new(from);
            let problem = Problem { line, from, set };
            let mut solver = Dopri5::from_param(
                problem,
                0.0,
                0.6,
                0.6,
                start,
                1e-10,
                1e-6,
                0.9,
                0.04,
                0.2,
                10.0,
                0.6,
                0.0,
                100_000,
                1000,
                OutputType::Sparse,
            );
            solver.integrate().unwrap();
            let exact = solver.y_out().last().unwrap()[0];
            let own = after(&line, from, set, 0.6, 1);
            assert!((own - exact).abs() < 0.5, "{from} to {set}: {own} {exact}");
        }
    }
}
