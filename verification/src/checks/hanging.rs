//! Weight and static answers do not depend on how masses are raised.

use super::setup::*;
use models::fabrics::Orthotropic;

pub(super) const CHECK: Check = Check::quick(
    "hanging",
    "A strip hangs from its upper edge under gravity that is there from the start: its support carries the true weight.",
    "m g; the lower edge moves as with the true masses",
    run,
);

fn run() -> CheckResult {
    let mesh = generate::plate(0.2, 0.05, 20, 5, None)?;
    let film = Orthotropic::isotropic(50e6, 0.3, 1e-3);
    let mut problem = problem("hanging", mesh, section(Arc::new(film), 1.0), vec![]);
    problem.gravity = Some(Gravity { g_m_s2: [9.81, 0.0, 0.0], amplitude: Amplitude::Constant(1.0) });
    problem.supports = vec![hold("left", [true; 3])];
    (problem.settings.end_s, problem.settings.mass_damping_1_s) = (0.6, 100.0);
    let (mut lines, mut first) = (Vec::new(), None);
    for (name, problem) in each_mass(&problem)? {
        let run = settle(&problem)?;
        lines.push(CheckedNumber::value(
            format!("{name}: force of the support [N]"),
            -pull_n(&run, "left"),
            0.0981,
            1e-3,
        ));
        let way = 1e6 * (mean(&problem.mesh, "right", &run.positions(), 0) - 0.2);
        let exact = *first.get_or_insert(way);
        lines.push(CheckedNumber::value(format!("{name}: way of the lower edge [µm]"), way, exact, 1e-3));
        lines.push(balance(run.ledger().residual_share()));
    }
    Ok(lines.into())
}
