//! The body of one cell: the moment that resists a curvature, with memory.
//!
//! Base laws: bending B κ and the hinge of the body pressure, share·π R³ p_b tanh(κ/k₀). Hidden laws, off at 0:
//! [`crate::HIDDEN`], [`crate::ALSO`] and [`crate::OUTSIDE`] have the equations of the hidden laws.

use super::laws::ByLaw;

/// Shares and relaxation times of creep by law \[-, s\]. The second ones are the spectrum (τ₀/τ)^α e^(−τ₀/τ) ln 4/Γ(α) of
/// (1 + t/τ₀)^(−α), τ₀ = 0.1 s, α = 0.2; what relaxes later than in half an hour is part of B.
const RELAXATION: [&[[f64; 2]]; 2] = [
    &[[0.3, 0.7], [0.4, 3.0], [0.3, 15.0]],
    &[
        [0.111_1, 0.1],
        [0.178_2, 0.4],
        [0.162_9, 1.6],
        [0.129_4, 6.4],
        [0.099_2, 25.6],
        [0.075_4, 102.4],
        [0.057_2, 409.6],
        [0.043_4, 1638.4],
    ],
];
/// κ_y of a wall of which a share yields, as a share of [`CellWall::scale_per_m`].
const YIELDS_AT: f64 = 0.2;
/// Friction coefficient of a tail on the wall: coated nylon on itself.
const DRAGGED: f64 = 0.3;
/// Curvature over which Dahl's bristles break off, as a share of [`CellWall::scale_per_m`].
const BRISTLES: f64 = 0.08;
/// Curvatures over which the friction layers slide, as shares of [`CellWall::scale_per_m`].
const SLIP_SHARES: [f64; 4] = [0.02, 0.06, 0.15, 0.3];
/// κ_h of softening, as a share of [`CellWall::scale_per_m`].
const CREASED_FROM: f64 = 0.4;
const RECOVERY_S: f64 = 40.0;

/// Stiffness of one cell's body and amounts of its hidden laws.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct CellWall {
    /// Bending stiffness B of the body \[N·m²\].
    pub bending: f64,
    /// Hinge moment per body pressure, share·π R³ \[m³\].
    pub hinge_m3: f64,
    /// Curvature k₀ over which the hinge reaches its moment \[1/m\].
    pub step_per_m: f64,
    /// Curvature scale κ_c of the hidden laws \[1/m\].
    pub scale_per_m: f64,
    /// Curvature κ_w at which wrinkling begins \[1/m\].
    pub wrinkle_per_m: ByLaw,
    /// Share s of B that creases take away \[-\].
    pub creased: ByLaw,
    /// Moment t of the tail per body pressure \[m³\].
    pub tail_m3: ByLaw,
    /// Length of the tail that is dragged along beyond this cell \[m\].
    pub dragged_m: f64,
    /// Share o of the arm that ovalization takes away \[-\].
    pub oval: ByLaw,
    /// Scale m of the moment of a stop \[N·m\].
    pub stop_nm: ByLaw,
    /// Curvature κ₀ at which the unloaded body rests \[1/m\].
    pub rest_per_m: f64,
    /// Friction, sum of all layers \[N·m\].
    pub friction_nm: ByLaw,
    /// Creep stiffness, sum of all arms \[N·m²\].
    pub creep_nm2: ByLaw,
    /// Share s of a large bend that stays as a set \[-\].
    pub set: ByLaw,
}

/// State of a cell that its next step in time starts from.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct CellMemory {
    slid: [f64; 4],
    crept: [[f64; 8]; 2],
    largest: f64,
    last: f64,
    rubbing_nm: f64,
    set: ByLaw,
}

impl CellWall {
    /// Factor of the actuator's arm, and d(κ·factor)/dκ.
    pub(super) fn arm_factor(&self, kappa: f64) -> (f64, f64) {
        let [flat, dented] = self.oval;
        if dented != 0.0 {
            let x = kappa.abs() / self.scale_per_m;
            let gone = dented * x / (1.0 + x);
            return (1.0 - gone, 1.0 - gone - dented * x / (1.0 + x).powi(2));
        }
        if flat == 0.0 {
            return (1.0, 1.0);
        }
        let (k2, c2) = (kappa * kappa, self.scale_per_m * self.scale_per_m);
        let share = k2 / (k2 + c2);
        let d_share = 2.0 * k2 * c2 / ((k2 + c2) * (k2 + c2));
        (1.0 - flat * share, 1.0 - flat * (share + d_share))
    }

    /// Resisting moment at a curvature reached `dt_s` after the state in `memory` \[N·m\].
    pub(super) fn moment(&self, kappa: f64, p_body_pa: f64, memory: &CellMemory, dt_s: f64) -> f64 {
        let mut moment = self.stiffness(kappa) * (kappa - self.rest_per_m) + self.hinge(kappa, p_body_pa);
        moment += self.tail(kappa) * p_body_pa * (kappa / self.step_per_m).tanh() + self.stop(kappa);
        if self.friction_nm[0] != 0.0 {
            moment += (0..4).map(|j| self.layer(j, kappa, memory)).sum::<f64>();
        }
        if self.friction_nm[1] != 0.0 {
            moment += self.rubbing(kappa, memory);
        }
        for law in (0..2).filter(|law| self.creep_nm2[*law] != 0.0) {
            moment += (0..RELAXATION[law].len()).map(|i| self.arm(law, i, kappa, memory, dt_s)).sum::<f64>();
        }
        if self.set != [0.0; 2] {
            moment -= self.bending * self.set_after(kappa, memory, dt_s).iter().sum::<f64>();
        }
        moment
    }

    pub(super) fn remember(&self, kappa: f64, memory: &mut CellMemory, dt_s: f64) {
        let before = *memory;
        if self.friction_nm[0] != 0.0 {
            for j in 0..4 {
                memory.slid[j] = kappa - self.layer(j, kappa, &before) / self.layer_stiffness(j);
            }
        }
        for law in (0..2).filter(|law| self.creep_nm2[*law] != 0.0) {
            for (q, [_, tau]) in memory.crept[law].iter_mut().zip(RELAXATION[law]) {
                *q += (kappa - *q) * (1.0 - (-dt_s / tau).exp());
            }
        }
        memory.rubbing_nm = self.rubbing(kappa, &before);
        memory.set = self.set_after(kappa, &before, dt_s);
        memory.largest = before.largest.max(kappa);
        memory.last = kappa;
    }

    /// B at a curvature; a share of it is gone beyond κ_h, or yields.
    fn stiffness(&self, kappa: f64) -> f64 {
        let [gone, yields] = self.creased;
        let x = kappa / (YIELDS_AT * self.scale_per_m);
        if yields != 0.0 && x != 0.0 {
            return self.bending * (1.0 - yields * (1.0 - x.tanh() / x));
        }
        if gone == 0.0 {
            return self.bending;
        }
        let (k2, h2) = (kappa * kappa, (CREASED_FROM * self.scale_per_m).powi(2));
        self.bending * (1.0 - gone * k2 / (k2 + h2))
    }

    /// Moment of the tail per body pressure beyond the hinge's step \[m³\].
    fn tail(&self, kappa: f64) -> f64 {
        let [steady, dragged] = self.tail_m3;
        if dragged == 0.0 { steady } else { dragged * (DRAGGED * kappa.abs() * self.dragged_m).exp() }
    }

    fn stop(&self, kappa: f64) -> f64 {
        let ([folds, round], x) = (self.stop_nm, kappa / self.scale_per_m);
        if round != 0.0 {
            return round * ((x - 0.6).max(0.0) / 0.1).powf(1.5);
        }
        if folds == 0.0 { 0.0 } else { folds * ((x - 0.7) / 0.08).min(200.0).exp() }
    }

    fn hinge(&self, kappa: f64, p_body_pa: f64) -> f64 {
        let complete = self.hinge_m3 * p_body_pa;
        let [round, flat] = self.wrinkle_per_m;
        if flat != 0.0 {
            let x = (kappa / flat).abs();
            let share = if x < 1.0 { x / 3.0 } else { 1.0 - 2.0 / 3.0 / x.sqrt() };
            return complete * share.copysign(kappa);
        }
        if round == 0.0 {
            return complete * (kappa / self.step_per_m).tanh();
        }
        let x = kappa / round;
        complete * x / (1.0 + x.abs().powf(1.5)).powf(2.0 / 3.0)
    }

    fn layer_stiffness(&self, j: usize) -> f64 {
        0.25 * self.friction_nm[0] / (SLIP_SHARES[j] * self.scale_per_m)
    }

    fn layer(&self, j: usize, kappa: f64, memory: &CellMemory) -> f64 {
        let most = 0.25 * self.friction_nm[0];
        (self.layer_stiffness(j) * (kappa - memory.slid[j])).clamp(-most, most)
    }

    /// Dahl's friction, integrated over a step in one direction \[N·m\].
    fn rubbing(&self, kappa: f64, memory: &CellMemory) -> f64 {
        let change = kappa - memory.last;
        let most = self.friction_nm[1].copysign(change);
        most + (memory.rubbing_nm - most) * (-change.abs() / (BRISTLES * self.scale_per_m)).exp()
    }

    fn arm(&self, law: usize, i: usize, kappa: f64, memory: &CellMemory, dt_s: f64) -> f64 {
        let [share, tau] = RELAXATION[law][i];
        self.creep_nm2[law] * share * (kappa - memory.crept[law][i]) * (-dt_s / tau).exp()
    }

    /// Curvatures that have become the wall's own \[1/m\].
    fn set_after(&self, kappa: f64, memory: &CellMemory, dt_s: f64) -> ByLaw {
        let [late, power] = self.set;
        let target = late * (kappa - 0.25 * self.scale_per_m).max(0.0);
        let faded = memory.set[0] * (-dt_s / RECOVERY_S).exp();
        let fresh = if kappa > memory.largest { faded.max(target) } else { faded };
        [fresh, if power == 0.0 { 0.0 } else { self.kept(kappa.max(memory.largest)) }]
    }

    /// Ramberg and Osgood's plastic part of a curvature: κ = κ_e + s κ_e²/κ_c, solved for the plastic part κ − κ_e \[1/m\].
    fn kept(&self, largest: f64) -> f64 {
        let per_m = 2.0 * self.set[1] / self.scale_per_m;
        largest - ((1.0 + 2.0 * per_m * largest).sqrt() - 1.0) / per_m
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLAIN: CellWall = CellWall {
        bending: 1.0,
        hinge_m3: 2e-4,
        step_per_m: 0.05,
        scale_per_m: 2.0,
        wrinkle_per_m: [0.0; 2],
        creased: [0.0; 2],
        tail_m3: [0.0; 2],
        dragged_m: 0.0,
        oval: [0.0; 2],
        stop_nm: [0.0; 2],
        rest_per_m: 0.0,
        friction_nm: [0.0; 2],
        creep_nm2: [0.0; 2],
        set: [0.0; 2],
    };

    /// Moments of the wall without bending and hinge along a path of curvatures.
    fn along(wall: &CellWall, path: &[f64], dt_s: f64) -> Vec<f64> {
        let mut memory = CellMemory::default();
        let step = |k: &f64| {
            let moment = wall.moment(*k, 0.0, &memory, dt_s) - wall.bending * k;
            wall.remember(*k, &mut memory, dt_s);
            moment
        };
        path.iter().map(step).collect()
    }

    /// At κ_h half of the share is gone; the moment never falls.
    #[test]
    fn a_creased_wall_is_softer_and_still_resists_more_at_larger_bends() {
        let wall = CellWall { creased: [0.75, 0.0], ..PLAIN };
        let moment = |kappa: f64| wall.moment(kappa, 0.0, &CellMemory::default(), 0.0);
        assert!((moment(0.8) - 0.8 * (1.0 - 0.375)).abs() < 1e-12);
        assert!((0..200).all(|i| moment(0.05 * f64::from(i + 1)) > moment(0.05 * f64::from(i))));
    }

    #[test]
    fn friction_saturates_and_reverses_by_twice_its_size() {
        let wall = CellWall { friction_nm: [0.3, 0.0], ..PLAIN };
        let up: Vec<f64> = (0..=40).map(|i| 0.05 * f64::from(i)).collect();
        let down: Vec<f64> = up.iter().rev().copied().collect();
        let loop_nm = along(&wall, &[up, down].concat(), 0.1);
        assert!((loop_nm[40] - 0.3).abs() < 1e-12, "all layers slide: {}", loop_nm[40]);
        assert!((loop_nm[81] + 0.3).abs() < 1e-12, "and slide back: {}", loop_nm[81]);
        assert!(loop_nm[20] < 0.3 + 1e-12 && loop_nm[10] > 0.1);
    }

    #[test]
    fn creep_relaxes_with_three_times_to_nothing() {
        let wall = CellWall { creep_nm2: [0.25, 0.0], ..PLAIN };
        let moments = along(&wall, &[1.0; 2000], 0.1);
        let exact = |t: f64| {
            let arm = |(share, tau): (f64, f64)| share * (-t / tau).exp();
            0.25 * [(0.3, 0.7), (0.4, 3.0), (0.3, 15.0)].map(arm).iter().sum::<f64>()
        };
        for i in [0, 9, 99, 1999] {
            assert!((moments[i] - exact(0.1 * (i + 1) as f64)).abs() < 1e-12, "{i}");
        }
        assert!(moments[1999] < 1e-6);
    }

    #[test]
    fn a_set_needs_a_bend_beyond_yield_and_fades() {
        let wall = CellWall { set: [0.2, 0.0], ..PLAIN };
        assert_eq!(along(&wall, &[0.4, 0.0], 1.0), [0.0, 0.0]);
        let moments = along(&wall, &[1.5, 0.0, 0.0], 1.0);
        assert!((moments[0] + 0.2).abs() < 1e-12 && moments[1] < -0.19 && moments[2] > moments[1], "{moments:?}");
    }

    #[test]
    fn the_arm_slope_is_the_derivative_and_stays_positive() {
        let wall = CellWall { oval: [0.4, 0.0], ..PLAIN };
        for i in 0..100 {
            let k = 0.1 * f64::from(i);
            let product = |k: f64| k * wall.arm_factor(k).0;
            let slope = (product(k + 1e-5) - product(k - 1e-5)) / 2e-5;
            assert!((wall.arm_factor(k).1 - slope).abs() < 1e-8 && slope > 0.0, "{k}");
        }
    }
}
