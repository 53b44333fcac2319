//! From the file's coordinates to the robot's: scale, origin at the base, x along the straight robot, y towards the actuator.

use super::lens::CameraView;
use super::moved::{Moved, TILTED, third};
use super::options::{FileAxis, FilePlace, ImportOptions, Scale};
use super::recording::{LOST, Lengths, Recording};
use super::vectors::along;
use crate::error::{DataError, Result};
use crate::units::mm;

/// A marker that moves less than this does not show where the actuator is \[m\].
const TELLING_M: f64 = 0.005;
/// Largest angle of the robot at rest to an axis of the file \[rad\].
const ASKEW: f64 = 0.26;

const LARGER_BOARD: &str = "film a board that fills the part of the picture in which the robot moves";

#[derive(Debug, Clone)]
enum Map {
    Factor(f64),
    Board(CameraView),
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
}

/// Runs that have the same markers in the same order, as a camera saw them.
pub(crate) struct CameraRuns<'a> {
    pub file: &'a str,
    pub runs: &'a [Recording],
    /// Frames at rest and at the top, of every run.
    pub ends: &'a [RestAndTop],
    pub options: &'a ImportOptions,
}

impl CameraRuns<'_> {
    /// Puts the runs into the robot's frame; `assumed` receives the assumptions.
    pub(super) fn place(&self, assumed: &mut Vec<String>) -> Result<PlacedRuns> {
        let (map, words) = self.map()?;
        assumed.push(words);
        let (bases, skipped) = self.bases(&map, assumed)?;
        let all = &self.runs[0].markers;
        let is_kept = |marker: &usize| Some(*marker) != skipped;
        let kept: Vec<usize> = (0..all.len()).filter(is_kept).collect();
        let markers: Vec<String> = kept.iter().map(|marker| all[*marker].clone()).collect();
        let moved = self.moved(&bases, &kept, &map);
        let axes = self.axes(&markers, &moved, assumed)?;
        let (sin, cos) = self.options.turn_rad.sin_cos();
        let placed = |place: &[f64; 3], base: &[f64; 3]| {
            let from = map.metres(*place);
            let [x, y] = axes.map(|axis| along(axis, from) - along(axis, *base));
            [cos * x + sin * y, cos * y - sin * x]
        };
        let of_run = |(run, base): (&Recording, &[f64; 3])| {
            let column = |marker: &usize| run.places[*marker].iter().map(|place| placed(place, base)).collect();
            kept.iter().map(column).collect()
        };
        let xy_m = self.runs.iter().zip(&bases).map(of_run).collect();
        Ok(PlacedRuns { xy_m, markers })
    }

    /// Where markers are at rest from their base, and how they move.
    fn moved(&self, bases: &[[f64; 3]], markers: &[usize], map: &Map) -> Moved {
        let (mut rest, mut by) = (Vec::new(), Vec::new());
        for &marker in markers {
            let (mut sums, mut count) = ([[0.0; 3]; 2], 0.0);
            for ((run, ends), base) in self.runs.iter().zip(self.ends).zip(bases) {
                let mean = |frames: &[usize]| run.mean_place(marker, frames).map(|place| map.metres(place));
                let (Some(low), Some(high)) = (mean(&ends.rest), mean(&ends.top)) else { continue };
                (0..3).for_each(|axis| sums[0][axis] += low[axis] - base[axis]);
                (0..3).for_each(|axis| sums[1][axis] += high[axis] - low[axis]);
                count += 1.0;
            }
            let [low, high] = sums.map(|of| if count > 0.0 { of.map(|sum| sum / count) } else { LOST });
            rest.push(low);
            by.push(high);
        }
        Moved { rest, by }
    }

    fn fault(&self, message: impl Into<String>, help: impl Into<String>) -> DataError {
        DataError::of(self.file, message, help)
    }

    /// How coordinates become metres, and how that is known.
    fn map(&self) -> Result<(Map, String)> {
        let (scale, of_file) = (&self.options.scale, self.runs[0].lengths);
        if let Lengths::Metres(metres) = of_file {
            let unit = unit(metres);
            if [Scale::OfFile, Scale::Unit(metres)].contains(scale) {
                return Ok((Map::Factor(metres), format!("lengths are in {unit}, as the file states")));
            }
            let message = format!("the file states that its lengths are in {unit}, and a scale was given");
            return Err(self.fault(message, "leave the scale out, or export in pixels"));
        }
        let (map, words) = match scale {
            Scale::OfFile | Scale::Unit(_) if of_file == Lengths::Pixels => {
                let message = "positions are pixels of the picture, and their scale is not known";
                let help = "give --scale 3.1px/mm, or --scale MARKER:MARKER=40mm, or --board corners.csv=25mm";
                return Err(self.fault(message, help));
            }
            Scale::OfFile => {
                let message = "the file does not say the unit of its positions";
                return Err(self.fault(message, "give it: --scale mm, cm, m or 3.1px/mm"));
            }
            Scale::Unit(metres) => (Map::Factor(*metres), format!("lengths are in {}, as given", unit(*metres))),
            Scale::PixelsPerMetre(pixels) => {
                let per = short(pixels * 1e-3);
                (Map::Factor(1.0 / pixels), format!("{per} px are a millimetre, as given"))
            }
            Scale::Known(places, length_m) => {
                let apart = (0..self.runs.len()).map(|run| self.distance(run, places));
                let apart = apart.sum::<Result<f64, _>>()? / self.runs.len() as f64;
                let (length, per) = (mm(*length_m), short(apart * 1e-3 / length_m));
                let words = format!("{apart:.2} units of the file are {length:.2} mm: {per} to a millimetre");
                (Map::Factor(length_m / apart), words)
            }
            Scale::Board(corners, square_m) => {
                let help = "give at least four corners, no three on a line: a table column,row,x,y";
                let board = CameraView::of_board(corners, *square_m).map_err(|message| self.fault(message, help))?;
                let words = board.words(corners.len()) + &self.outside(&board)?;
                (Map::Board(board), words)
            }
        };
        Ok((map, words))
    }

    /// How many of the places are outside of the board, where lens and plane are extrapolated.
    fn outside(&self, board: &CameraView) -> Result<String> {
        let places = self.runs.iter().flat_map(|run| run.places.iter().flatten());
        let pixels: Vec<[f64; 2]> = places.map(|at| [at[0], at[1]]).filter(|at| at[0].is_finite()).collect();
        if let Some([x, y]) = pixels.iter().find(|pixel| !board.knows(**pixel)) {
            let message = format!(
                "a marker at {x:.0}, {y:.0} px is so far outside of the board that its lens is not known there"
            );
            return Err(self.fault(message, LARGER_BOARD));
        }
        let count = pixels.iter().filter(|pixel| board.is_outside(**pixel)).count();
        if count == 0 {
            return Ok(String::new());
        }
        let percent = (100.0 * count as f64 / pixels.len() as f64).ceil();
        let where_to = "outside of the board, where its plane is extrapolated";
        Ok(format!("; warning: {percent:.0} % of the positions are {where_to}: {LARGER_BOARD}"))
    }

    /// Distance of two places in the file's units.
    fn distance(&self, run: usize, places: &[FilePlace; 2]) -> Result<f64> {
        let [a, b] = places.each_ref().map(|place| self.where_is(run, place).map(|(at, _)| at));
        let (a, b) = (a?, b?);
        let apart = (0..3).map(|axis| (a[axis] - b[axis]).powi(2)).sum::<f64>().sqrt();
        if apart > 0.0 {
            return Ok(apart);
        }
        let help = "name two different ones";
        Err(self.fault("the two places of --scale are one", help))
    }

    fn where_is(&self, run: usize, place: &FilePlace) -> Result<FoundMarker> {
        let found = where_is(&self.runs[run], &self.ends[run], place);
        found.map_err(|[message, help]| self.fault(message, help))
    }

    /// The base of every run \[m\], and the marker at it.
    fn bases(&self, map: &Map, assumed: &mut Vec<String>) -> Result<(Vec<[f64; 3]>, Option<usize>)> {
        let Some(place) = &self.options.base else {
            if matches!(self.options.scale, Scale::PixelsPerMetre(_) | Scale::Known(..)) {
                let message = "positions are pixels of the picture: where is the robot's base?";
                let help =
                    "give --base X,Y in pixels as the picture counts them, or --base MARKER for a marker at the clamp";
                return Err(self.fault(message, help));
            }
            assumed.push("the robot's base is the origin of the file's coordinates".to_string());
            return Ok((vec![[0.0; 3]; self.runs.len()], None));
        };
        let found = (0..self.runs.len()).map(|run| self.where_is(run, place));
        let found: Vec<FoundMarker> = found.collect::<Result<_>>()?;
        assumed.push(match place {
            FilePlace::At(at) => {
                let at: Vec<String> = at.iter().map(f64::to_string).collect();
                format!("the robot's base is at {} of the file", at.join(", "))
            }
            FilePlace::Marker(name) => {
                format!("the robot's base is marker {name} at rest, separately in every run; the table leaves this marker out")
            }
        });
        Ok((found.iter().map(|(at, _)| map.metres(*at)).collect(), found[0].1))
    }

    /// Directions in the file: the axes given, or along the robot at rest, and across it where the farthest marker moves as the pressure
    /// rises. Where the robot or its motion is out of the planes of the file's axes, both are in the plane of the motion.
    fn axes(&self, labels: &[String], moved: &Moved, assumed: &mut Vec<String>) -> Result<[[f64; 3]; 2]> {
        let words = |axes: [FileAxis; 2]| {
            let [along, towards] = axes.map(FileAxis::word);
            format!("along the robot is the file's {along}, towards the actuator its {towards}")
        };
        let help = "give --axes ALONG,TOWARDS, for example --axes x,-y where y of the picture points down";
        if let Some(axes) = self.options.axes {
            let directions = axes.map(FileAxis::direction);
            if let Some(ends) = moved.ends(moved.along()) {
                self.straight(axes[0], directions, moved, ends)?;
                self.in_plane(axes, moved, ends)?;
            }
            assumed.push(format!("{}, as given", words(axes)));
            return Ok(directions);
        }
        let index = moved.along();
        let Some([near, far]) = moved.ends(index) else {
            let message = "no marker was seen both at the lowest and at the highest pressure";
            return Err(self.fault(message, help));
        };
        let (rest, by) = (moved.rest[far], moved.by[far]);
        let most = |a: &usize, b: &usize| by[*a].abs().total_cmp(&by[*b].abs());
        let across = (0..3).filter(|axis| *axis != index).max_by(most).unwrap_or(1);
        let axis = |index: usize, way: [f64; 3]| FileAxis { index, turned: way[index] < 0.0 };
        let axes = [axis(index, rest), axis(across, by)];
        let tilted = moved.tilted(axes, [near, far]);
        let directions = tilted.unwrap_or(axes.map(FileAxis::direction));
        let by_mm = mm(along(directions[1], by).abs());
        if by_mm < mm(TELLING_M) {
            let message =
                format!("the markers move by {by_mm:.1} mm across the robot: where the actuator is cannot be seen");
            return Err(self.fault(message, help));
        }
        self.straight(axes[0], directions, moved, [near, far])?;
        let label = &labels[far];
        let words = match tilted {
            None => words(axes),
            Some(_) => {
                let [x, y] = directions.map(|d| d.map(|part| format!("{:.3}", part + 0.0)).join(", "));
                format!(
                    "the plane of the motion is not one of the file's axes: along the robot is {x} of the file, towards the actuator {y}"
                )
            }
        };
        assumed.push(format!("{words}: marker {label} moves there by {by_mm:.1} mm as the pressure rises"));
        Ok(directions)
    }

    /// Refuses a robot that is not along its axis at rest.
    fn straight(&self, axis: FileAxis, directions: [[f64; 3]; 2], moved: &Moved, ends: [usize; 2]) -> Result<()> {
        let [x, y] = directions.map(|direction| along(direction, moved.line(ends)));
        let angle = y.atan2(x) - self.options.turn_rad;
        if angle.abs() <= ASKEW {
            return Ok(());
        }
        let degrees = angle.to_degrees();
        let axis = axis.word();
        let message = format!("at rest the robot is at {degrees:.0} degrees to the file's {axis}");
        let clocks = "give the log's time minus the camera's, --clock-offset, or find";
        if let Some([rest, top]) = moved.straightens(ends[1]) {
            let bent =
                format!("{message} and bent by {:.1} mm, at the highest pressure by {:.1} mm", mm(rest), mm(top));
            let help = format!("the pressures belong to other times, or to another column: {clocks}");
            return Err(self.fault(format!("{bent}: it is bent where it should be straight"), help));
        }
        let clocks = if self.options.pressure_logs.is_empty() {
            String::new()
        } else {
            format!("where log and camera have two clocks, {clocks}; else ")
        };
        let help = format!("{clocks}correct --base or --axes, or turn the picture: --turn {degrees:.1}deg");
        Err(self.fault(message, help))
    }

    /// Refuses a robot that is out of the plane of the axes given.
    fn in_plane(&self, axes: [FileAxis; 2], moved: &Moved, ends: [usize; 2]) -> Result<()> {
        let line = moved.line(ends);
        let angle = (line[third(axes)].abs() / along(line, line).sqrt()).asin();
        if angle.is_nan() || angle <= TILTED || ends[0] == ends[1] {
            return Ok(());
        }
        let degrees = angle.to_degrees();
        let message = format!("at rest the robot is {degrees:.0} degrees out of the plane of --axes");
        let help = "leave --axes out: the plane of the motion is found; or correct --axes";
        Err(self.fault(message, help))
    }
}

impl FileAxis {
    fn word(self) -> String {
        let sign = if self.turned { "-" } else { "" };
        format!("{sign}{}", ["x", "y", "z"][self.index])
    }
}

fn unit(metres: f64) -> String {
    let known = [(1e-3, "mm"), (1e-2, "cm"), (1.0, "m"), (1e-6, "µm")];
    match known.iter().find(|(value, _)| *value == metres) {
        Some((_, word)) => (*word).to_string(),
        None => format!("{} mm", short(metres * 1e3)),
    }
}

fn short(value: f64) -> String {
    format!("{}", (value * 1e6).round() / 1e6)
}

/// A place in the file's units, and the marker that it is.
pub(crate) type FoundMarker = ([f64; 3], Option<usize>);

/// Where a place of the caller is in a run.
pub(crate) fn where_is(run: &Recording, ends: &RestAndTop, place: &FilePlace) -> Result<FoundMarker, [String; 2]> {
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
        return Err([format!("marker {name} does not exist"), help]);
    };
    let Some(at) = run.mean_place(marker, &ends.rest) else {
        let message = format!("marker {name} was not seen at the lowest pressure");
        return Err([message, "take another marker".into()]);
    };
    Ok((at, Some(marker)))
}
