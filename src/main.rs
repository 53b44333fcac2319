//! The command `ibr`.

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(ibr::program::run(std::env::args_os()))
}
