//! Columns of numbers that a study asks for.

use crate::study::{Output, Study};
use models::Account;

/// Accounts of the ledger, in the order of their columns.
pub(crate) const ACCOUNTS: [(&str, Account); 8] = [
    ("actuator_gas", Account::ActuatorGas),
    ("body_gas", Account::BodyGas),
    ("wall", Account::Wall),
    ("stretch", Account::Stretch),
    ("compressed_sheets", Account::Compression),
    ("contact", Account::Contact),
    ("numerical", Account::Numerical),
    ("load", Account::Load),
];

pub(crate) const TRUSTED: &str = "trusted";
pub(crate) const CPU_S: &str = "cpu_s";

pub(crate) fn columns(study: &Study) -> Vec<String> {
    let of = |output: &Output| -> Vec<String> {
        match output {
            Output::Tip => {
                let places = study.axes_of_place().iter().map(|axis| format!("tip_{axis}_mm"));
                places.chain(["tip_angle_deg".into()]).collect()
            }
            Output::Markers => (1..=study.base.markers_m.len())
                .flat_map(|m| study.axes_of_place().iter().map(move |axis| format!("marker_{m}_{axis}_mm")))
                .collect(),
            Output::Ledger => ACCOUNTS.map(|(name, _)| format!("{name}_mj")).to_vec(),
            Output::Limits => vec![TRUSTED.into()],
            Output::Time => vec![CPU_S.into()],
        }
    };
    study.outputs.iter().flat_map(of).collect()
}
