//! Tests of the reader as a whole: good tables, bad tables, round trips.

mod about;
mod bad_input;
mod boundaries;
mod checks;
mod good_input;
mod lost;
mod placeholders;
mod space;
mod writing;

use crate::{DataError, Dataset, ReadOptions, parse_markers};

/// A small table in the paper's protocol: runs × (0, 10, 20, 30, 0 kPa) × `frames` × markers `1` (60 mm), `2` (360 mm).
pub(crate) fn table(runs: usize, frames: usize) -> String {
    let mut text = String::from("run,actuator,t_s,p_body_kpa,p_act_kpa,phase,marker,x_mm,y_mm\n");
    for run in 1..=runs {
        for (hold, (p, phase)) in
            [(0, "load"), (10, "load"), (20, "load"), (30, "load"), (0, "unload")].iter().enumerate()
        {
            for frame in 0..frames {
                let t = 5.0 * hold as f64 + 0.5 * frame as f64;
                for (marker, s) in [(1, 60.0), (2, 360.0)] {
                    let (x, y) = (s - 0.01 * f64::from(*p), f64::from(*p) * s / 90.0 + 0.1 * run as f64);
                    text.push_str(&format!("{run},ePAM,{t},2,{p},{phase},{marker},{x},{y}\n"));
                }
            }
        }
    }
    text
}

pub(crate) fn read(text: &str) -> Result<Dataset, DataError> {
    read_bytes(text.as_bytes(), ReadOptions::default())
}

pub(crate) fn read_bytes(mut bytes: &[u8], options: ReadOptions) -> Result<Dataset, DataError> {
    parse_markers("markers.csv", &mut bytes, options, &mut |_, _| ())
}
