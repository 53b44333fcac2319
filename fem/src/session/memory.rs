//! Memory that a run takes: a mesh that cannot fit is refused before the system ends the program.

use crate::policy::LEAST_BYTES;
use crate::problem::Problem;
use crate::{FemError, Result};

/// Memory that a run of a problem takes at least \[bytes\]. Contacts add to it, up to as much again for a robot of many layers.
pub fn least_bytes(problem: &Problem) -> u64 {
    problem.mesh.elements() as u64 * LEAST_BYTES
}

/// # Errors
/// More than this machine, or the group of processes that this one belongs to, has left.
pub(super) fn check(problem: &Problem) -> Result<()> {
    let mut system = sysinfo::System::new();
    system.refresh_memory();
    let group = system.cgroup_limits().map_or(u64::MAX, |limits| limits.free_memory);
    let left = match system.available_memory() {
        // A system that does not report its memory.
        0 => return Ok(()),
        left => left.min(group),
    };
    refused(least_bytes(problem), left)
}

fn refused(least: u64, left: u64) -> Result<()> {
    if least <= left {
        return Ok(());
    }
    let gb = |bytes: u64| bytes as f64 * 1e-9;
    let message = format!("this mesh needs at least {:.1} GB of memory, and {:.1} GB are free", gb(least), gb(left));
    let help = "take larger elements: twice the size needs a quarter of the memory";
    Err(FemError::setting(message, help))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_cannot_fit_is_refused_with_both_numbers() {
        let error = refused(30_000_000_000, 4_000_000_000).unwrap_err().to_string();
        assert!(error.contains("30.0 GB") && error.contains("4.0 GB"), "{error}");
        assert!(refused(4_000_000_000, 4_000_000_000).is_ok());
    }
}
