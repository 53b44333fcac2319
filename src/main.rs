//! Binary of the command `ibr`, a call of the library's program.

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(ibr::program::run(std::env::args_os()))
}
