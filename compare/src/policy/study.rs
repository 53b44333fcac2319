//! Agreement between models, words of publications, fabric tests.

/// Within this share of each other two models, or a model and a number, meet.
pub const MEETS: f64 = 0.1;
/// Share of the last turn from which a robot is bent.
pub const BENT: f64 = 0.1;
/// Readings of a run this near are of one pressure, or of one size \[kPa, mm\].
pub const SAME_READING: f64 = 0.05;
/// Pressures of a run and of a hold within this fraction are the same.
pub const SAME_SET_POINT: f64 = 0.02;
/// Stations this near are the same marker \[mm\].
pub const SAME_STATION_MM: f64 = 1.0;
/// Share of its highest pressure by which the line through a run's last two readings is followed.
pub const BEYOND_RUN: f64 = 0.1;

/// Whether two models, or a model and a number, meet, of their quotient less one.
pub fn meets(off: f64) -> bool {
    off.abs() <= MEETS
}

/// Whether a robot is bent, of its turn and the last one.
pub fn is_bent(turn_rad: f64, last_rad: f64) -> bool {
    turn_rad > BENT * last_rad
}

/// Whether two readings of a run are of one pressure or size \[kPa, mm\].
pub fn is_same_reading(one: f64, other: f64) -> bool {
    (one - other).abs() < SAME_READING
}

/// Whether a run was read at the pressure of a hold.
pub fn is_same_set_point(of_run: f64, of_hold: f64) -> bool {
    (of_run - of_hold).abs() < SAME_SET_POINT * of_run
}

/// Whether two stations belong to one marker \[mm\].
pub fn is_same_station(one_mm: f64, other_mm: f64) -> bool {
    (one_mm - other_mm).abs() < SAME_STATION_MM
}

/// Whether a pressure is so far beyond the highest of a run that nothing is known of it.
pub fn is_beyond(pressure: f64, highest: f64) -> bool {
    pressure > highest * (1.0 + BEYOND_RUN)
}

/// Differences up to this share are "none" in a publication.
pub const NONE: f64 = 0.02;
/// A share that is "very little" there.
pub const LITTLE: f64 = 0.05;
/// "Almost" a number of points: from so many below it.
pub const ALMOST: f64 = 5.0;

/// Whether a share counts as no difference in the words of a publication.
pub fn is_none(share: f64) -> bool {
    share <= NONE
}

/// Whether a share is very little in the words of a publication.
pub fn is_little(share: f64) -> bool {
    share <= LITTLE
}

/// Whether points are almost those printed.
pub fn is_almost(points: f64, printed: f64) -> bool {
    (printed - ALMOST..=printed).contains(&points)
}

/// A specimen that is off the mean of the others by more than this share deviates.
pub const DEVIATES: f64 = 0.25;
/// The same where chance does that in few sets: of many specimens, small but significant deviations do no harm.
pub const DEVIATES_BEYOND_CHANCE: f64 = 0.05;
/// Within this share of the mean of another direction a specimen is taken for one of it.
pub const LIKE_ANOTHER: f64 = 0.2;
/// Fewest rows of loading: less are no curve.
pub const FEWEST_ROWS: usize = 5;
/// Shear angle beyond which yarns slip \[rad\].
pub const SURELY_SLIP_RAD: f64 = 70.0 * std::f64::consts::PI / 180.0;
/// Moduli of films and coated fabrics pulled along a yarn \[Pa\]: silicone on light nylon to uncoated polyester, with room.
pub const ALONG_PA: [f64; 2] = [5e6, 20e9];
/// The same of fabrics pulled at 45° to the yarns.
pub const BIAS_PA: [f64; 2] = [0.02e6, 2e9];

/// Whether a specimen is not one of the others, of how far it is off their mean and whether chance does that.
pub fn deviates(off: f64, beyond_chance: bool) -> bool {
    off.abs() > if beyond_chance { DEVIATES_BEYOND_CHANCE } else { DEVIATES }
}

/// Whether a specimen looks like specimens of another direction, from its modulus and their mean.
pub fn is_like_another(modulus: f64, mean: f64) -> bool {
    (modulus / mean - 1.0).abs() < LIKE_ANOTHER
}
