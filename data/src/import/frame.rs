//! From the file's coordinates to the robot's: scale, origin at the base, x along the straight robot, y towards the actuator.

use super::homography::Homography;
use super::options::{FileAxis, FilePlace, ImportOptions, Scale};
use super::recording::{LOST, Lengths, Recording};
use crate::error::{DataError, Fault};
use crate::units::mm;

/// A marker that moves less than this does not show where the actuator is \[m\].
const TELLING_M: f64 = 0.005;
/// Largest angle of the robot at rest to an axis of the file \[rad\].
const ASKEW: f64 = 0.26;

/// How a file's coordinates become metres.
#[derive(Debug, Clone)]
enum Map {
    Factor(f64),
    Board(Homography),
}

impl Map {
    fn metres(&self, place: [f64; 3]) -> [f64; 3] {
        match self {
            Map::Factor(metres) => place.map(|value| value * metres),
            Map::Board(board) => {
                let [x, y] = board.at([place[0], place[1]]);
                [x, y, 0.0]
            }
        }
    }
}

/// Frames in which the actuator is empty, and in which it is fullest, of one run.
pub(crate) struct RestAndTop {
    pub rest: Vec<usize>,
    pub top: Vec<usize>,
}

pub(crate) struct PlacedRuns {
    /// `[run][marker][frame]` \[m\], NaN where not seen.
    pub xy_m: Vec<Vec<Vec<[f64; 2]>>>,
    pub markers: Vec<String>,
    pub told: Vec<String>,
}

/// Puts runs into the robot's frame; they have the same markers in the same order.
///
/// # Errors
/// Scale, base or axes are not known and cannot be found from the data.
pub(crate) fn place(
    file: &str,
    runs: &[Recording],
    ends: &[RestAndTop],
    options: &ImportOptions,
) -> Result<PlacedRuns, DataError> {
    let (map, mut told) = map(file, runs, ends, options)?;
    let (bases, skipped) = bases(file, runs, ends, options, &map, &mut told)?;
    let markers: Vec<usize> = (0..runs[0].markers.len()).filter(|marker| Some(*marker) != skipped).collect();
    let moved = Moved::of(runs, ends, &bases, &markers, &map);
    let labels: Vec<String> = markers.iter().map(|marker| runs[0].markers[*marker].clone()).collect();
    let axes = axes(file, &labels, &moved, options, &mut told)?;
    let turn = options.turn_rad.sin_cos();
    let xy_m = runs.iter().zip(&bases).map(|(run, base)| {
        let of_marker = |marker: &usize| {
            run.places[*marker].iter().map(|place| {
                let from = map.metres(*place);
                let [x, y] = axes.map(|axis| axis.of(from) - axis.of(*base));
                [turn.1 * x + turn.0 * y, turn.1 * y - turn.0 * x]
            })
        };
        markers.iter().map(|marker| of_marker(marker).collect()).collect()
    });
    let xy_m = xy_m.collect();
    Ok(PlacedRuns { xy_m, markers: labels, told })
}

impl FileAxis {
    fn of(self, place: [f64; 3]) -> f64 {
        if self.turned { -place[self.index] } else { place[self.index] }
    }

    fn word(self) -> String {
        format!("{}{}", if self.turned { "-" } else { "" }, ["x", "y", "z"][self.index])
    }
}

fn fault(file: &str, message: impl Into<String>, help: impl Into<String>) -> DataError {
    DataError::Unit(Box::new(Fault::of_file(file, message, help)))
}

fn map(
    file: &str,
    runs: &[Recording],
    ends: &[RestAndTop],
    options: &ImportOptions,
) -> Result<(Map, Vec<String>), DataError> {
    let (message, help) = match (&options.scale, runs[0].lengths) {
        (Scale::OfFile, Lengths::Metres(metres)) => return Ok(of_file(metres)),
        (Scale::Unit(given), Lengths::Metres(metres)) if *given == metres => return Ok(of_file(metres)),
        (_, Lengths::Metres(metres)) => {
            let message = format!("the file says that its lengths are in {}, and a scale was given", unit(metres));
            return Err(fault(file, message, "leave the scale out, or export in pixels"));
        }
        (Scale::OfFile | Scale::Unit(_), Lengths::Pixels) => (
            "positions are pixels of the picture, and their scale is not known",
            "give --scale 3.1px/mm, or --known-distance MARKER:MARKER=40mm, or --board corners.csv --square 25mm",
        ),
        (Scale::OfFile, Lengths::Unsaid) => {
            ("the file does not say the unit of its positions", "give it: --scale mm, cm, m or 3.1px/mm")
        }
        _ => return given(file, runs, ends, &options.scale),
    };
    Err(fault(file, message, help))
}

fn of_file(metres: f64) -> (Map, Vec<String>) {
    (Map::Factor(metres), vec![format!("lengths are in {}, as the file says", unit(metres))])
}

/// The scale that the caller knows, or from a distance or a board.
fn given(file: &str, runs: &[Recording], ends: &[RestAndTop], scale: &Scale) -> Result<(Map, Vec<String>), DataError> {
    let (map, words) = match scale {
        Scale::PixelsPerMetre(pixels) => {
            (Map::Factor(1.0 / pixels), format!("{} px are a millimetre, as given", short(pixels * 1e-3)))
        }
        Scale::Known(places, length_m) => {
            let apart = runs.iter().zip(ends).map(|(run, ends)| distance(file, run, ends, places));
            let apart = apart.sum::<Result<f64, _>>()? / runs.len() as f64;
            let (length, per) = (mm(*length_m), short(apart * 1e-3 / length_m));
            let words = format!("{apart:.2} units of the file are {length:.2} mm: {per} to a millimetre");
            (Map::Factor(length_m / apart), words)
        }
        Scale::Board(corners, square_m) => {
            let help = "give at least four corners, no three on a line: a table column,row,x,y";
            let found = Homography::of_board(corners, *square_m).map_err(|message| fault(file, message, help));
            let (board, rms_px) = found?;
            (Map::Board(board), format!("a homography of {} corners, {rms_px:.2} px off (rms)", corners.len()))
        }
        Scale::Unit(metres) => (Map::Factor(*metres), format!("lengths are in {}, as given", unit(*metres))),
        Scale::OfFile => (Map::Factor(1.0), String::new()),
    };
    Ok((map, vec![words]))
}

fn unit(metres: f64) -> String {
    let known = [(1e-3, "mm"), (1e-2, "cm"), (1.0, "m"), (1e-6, "µm")];
    known
        .iter()
        .find(|(value, _)| *value == metres)
        .map_or_else(|| format!("{} mm", short(metres * 1e3)), |(_, word)| (*word).to_string())
}

fn short(value: f64) -> String {
    format!("{}", (value * 1e6).round() / 1e6)
}

/// Distance of two places in the file's units.
fn distance(file: &str, run: &Recording, ends: &RestAndTop, places: &[FilePlace; 2]) -> Result<f64, DataError> {
    let at = |place: &FilePlace| where_is(file, run, ends, place).map(|(at, _)| at);
    let (a, b) = (at(&places[0])?, at(&places[1])?);
    let apart = (0..3).map(|axis| (a[axis] - b[axis]).powi(2)).sum::<f64>().sqrt();
    if apart > 0.0 {
        Ok(apart)
    } else {
        Err(fault(file, "the two places of --known-distance are one", "name two different ones"))
    }
}

/// A place in the file's units, and the marker that it is.
pub(crate) fn where_is(
    file: &str,
    run: &Recording,
    ends: &RestAndTop,
    place: &FilePlace,
) -> Result<([f64; 3], Option<usize>), DataError> {
    let name = match place {
        FilePlace::At(values) => {
            let mut at = [0.0; 3];
            at.iter_mut().zip(values).for_each(|(at, value)| *at = *value);
            return Ok((at, None));
        }
        FilePlace::Marker(name) => name,
    };
    let Some(marker) = run.markers.iter().position(|known| known == name) else {
        let meant = spelling::meant(name, run.markers.iter().map(String::as_str));
        let help = format!("{meant}the markers are {}", run.markers.join(", "));
        return Err(fault(file, format!("there is no marker {name}"), help));
    };
    let seen = run.mean_place(marker, ends.rest.iter().copied());
    let at = seen.ok_or_else(|| {
        fault(file, format!("marker {name} was not seen at the lowest pressure"), "take another marker")
    })?;
    Ok((at, Some(marker)))
}

/// The base of every run \[m\], and the marker at it.
fn bases(
    file: &str,
    runs: &[Recording],
    ends: &[RestAndTop],
    options: &ImportOptions,
    map: &Map,
    told: &mut Vec<String>,
) -> Result<(Vec<[f64; 3]>, Option<usize>), DataError> {
    let Some(place) = &options.base else {
        if matches!(options.scale, Scale::PixelsPerMetre(_) | Scale::Known(..)) {
            let help =
                "give --base X,Y in pixels as the picture counts them, or --base MARKER for a marker at the clamp";
            return Err(fault(file, "positions are pixels of the picture: where is the robot's base?", help));
        }
        told.push("the robot's base is the origin of the file's coordinates".to_string());
        return Ok((vec![[0.0; 3]; runs.len()], None));
    };
    let found: Vec<_> =
        runs.iter().zip(ends).map(|(run, ends)| where_is(file, run, ends, place)).collect::<Result<_, _>>()?;
    told.push(match place {
        FilePlace::At(at) => format!(
            "the robot's base is at {} of the file",
            at.iter().map(f64::to_string).collect::<Vec<_>>().join(", ")
        ),
        FilePlace::Marker(name) => {
            format!("the robot's base is marker {name} at rest, in every run anew; it is no marker of the table")
        }
    });
    Ok((found.iter().map(|(at, _)| map.metres(*at)).collect(), found[0].1))
}

/// Where markers are at rest from the base, and how they move to the highest pressure, means over runs \[m\].
struct Moved {
    rest: Vec<[f64; 3]>,
    by: Vec<[f64; 3]>,
}

impl Moved {
    fn of(runs: &[Recording], ends: &[RestAndTop], bases: &[[f64; 3]], markers: &[usize], map: &Map) -> Moved {
        let (mut rest, mut by) = (Vec::new(), Vec::new());
        for &marker in markers {
            let (mut sums, mut count) = ([[0.0; 3]; 2], 0.0);
            for ((run, ends), base) in runs.iter().zip(ends).zip(bases) {
                let mean =
                    |frames: &[usize]| run.mean_place(marker, frames.iter().copied()).map(|place| map.metres(place));
                let (Some(low), Some(high)) = (mean(&ends.rest), mean(&ends.top)) else { continue };
                (0..3).for_each(|axis| sums[0][axis] += low[axis] - base[axis]);
                (0..3).for_each(|axis| sums[1][axis] += high[axis] - low[axis]);
                count += 1.0;
            }
            rest.push(if count > 0.0 { sums[0].map(|sum| sum / count) } else { LOST });
            by.push(if count > 0.0 { sums[1].map(|sum| sum / count) } else { LOST });
        }
        Moved { rest, by }
    }

    /// The axis along which the markers are at rest: of their spread, or of a single one's distance from the base.
    fn along(&self) -> usize {
        let seen: Vec<&[f64; 3]> = self.rest.iter().filter(|at| at[0].is_finite()).collect();
        let spread = |axis: usize| {
            let values = seen.iter().map(|at| at[axis]);
            values.clone().fold(f64::NEG_INFINITY, f64::max) - values.fold(f64::INFINITY, f64::min)
        };
        let size =
            |axis: usize| if seen.len() > 1 { spread(axis) } else { seen.first().map_or(0.0, |at| at[axis].abs()) };
        (0..3).max_by(|a, b| size(*a).total_cmp(&size(*b))).unwrap_or(0)
    }

    /// The markers nearest to the base and farthest from it along an axis.
    fn ends(&self, axis: usize) -> Option<[usize; 2]> {
        let by = |a: &usize, b: &usize| self.rest[*a][axis].abs().total_cmp(&self.rest[*b][axis].abs());
        let seen = || (0..self.rest.len()).filter(|k| self.rest[*k][0].is_finite());
        Some([seen().min_by(by)?, seen().max_by(by)?])
    }
}

/// The axes given, or: along the robot at rest, and across it where the farthest marker moves as the pressure rises.
fn axes(
    file: &str,
    labels: &[String],
    moved: &Moved,
    options: &ImportOptions,
    told: &mut Vec<String>,
) -> Result<[FileAxis; 2], DataError> {
    let words = |axes: &[FileAxis; 2]| {
        format!("along the robot is the file's {}, towards the actuator its {}", axes[0].word(), axes[1].word())
    };
    if let Some(axes) = options.axes {
        told.push(format!("{}, as given", words(&axes)));
        return Ok(axes);
    }
    let help = "give --axes ALONG,TOWARDS, for example --axes x,-y where y of the picture points down";
    let along = moved.along();
    let Some([near, far]) = moved.ends(along) else {
        return Err(fault(file, "no marker was seen both at the lowest and at the highest pressure", help));
    };
    let (rest, by) = (moved.rest[far], moved.by[far]);
    let across = (0..3).filter(|axis| *axis != along).max_by(|a, b| by[*a].abs().total_cmp(&by[*b].abs())).unwrap_or(1);
    if by[across].abs() < TELLING_M {
        let message = format!(
            "the markers move by {:.1} mm across the robot: where the actuator is cannot be seen",
            mm(by[across].abs())
        );
        return Err(fault(file, message, help));
    }
    let axes =
        [FileAxis { index: along, turned: rest[along] < 0.0 }, FileAxis { index: across, turned: by[across] < 0.0 }];
    let from = if near == far { [0.0; 3] } else { moved.rest[near] };
    let [x, y] = axes.map(|axis| axis.of(rest) - axis.of(from));
    let angle = y.atan2(x) - options.turn_rad;
    if angle.abs() > ASKEW {
        let degrees = angle.to_degrees();
        let message = format!("at rest the robot lies at {degrees:.0} degrees to the file's {}", axes[0].word());
        return Err(fault(file, message, format!("turn it: --turn {degrees:.1}deg; or correct --base")));
    }
    let (label, by_mm) = (&labels[far], mm(by[across].abs()));
    told.push(format!("{}: marker {label} moves there by {by_mm:.1} mm as the pressure rises", words(&axes)));
    Ok(axes)
}
