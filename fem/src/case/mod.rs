//! The TOML file that describes a finite element run.
