//! What the camera makes of a marker.
//!
//! [`crate::HIDDEN`], [`crate::ALSO`] and [`crate::OUTSIDE`] have the equations of the hidden laws.

use super::laws::ByLaw;

/// Angle by which pins lean in the second law of the height \[rad\].
const LEAN_RAD: f64 = 0.349;

#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Camera {
    pub length_m: f64,
    /// Height e of the markers above the centre line \[m\].
    pub height_m: ByLaw,
    /// Mount rotation at 30 kPa φ \[rad\].
    pub mount_rad: ByLaw,
    /// Relative error c of the scale \[-\].
    pub scale: ByLaw,
    /// Roll δ of the camera against the robot \[rad\].
    pub roll_rad: ByLaw,
    /// Lens k of r² \[1/m²\], and of r⁴ \[1/m⁴\].
    pub lens: ByLaw,
    /// Drift at 30 kPa d \[m\].
    pub drift_m: f64,
}

/// A marker's place on the robot, before the camera distorts it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SeenPoint {
    pub xy: [f64; 2],
    /// Angle of the centre line from the straight robot \[rad\].
    pub heading: f64,
    pub station_m: f64,
}

impl Camera {
    /// The marker as recorded \[m\], at the set pressure.
    pub(crate) fn see(&self, point: &SeenPoint, p_set_pa: f64) -> [f64; 2] {
        let (u, l) = (p_set_pa / 30e3, self.length_m);
        let (sin, cos) = point.heading.sin_cos();
        let [tapering, leaning] = self.height_m;
        let across = tapering * (1.0 + 0.3 * (point.station_m / l - 0.5)) + leaning * LEAN_RAD.cos();
        let along = leaning * LEAN_RAD.sin();
        let xy = [point.xy[0] - across * sin + along * (cos - 1.0), point.xy[1] + across * (cos - 1.0) + along * sin];
        let [gives, slips] = self.mount_rad;
        let xy = turned(xy, gives * 1.4 * u / (1.0 + 0.4 * u) + slips * (u - 0.25).max(0.0) / 0.75);
        let [keystone, pixels] = self.scale;
        let zoom = (1.0 + keystone) * (1.0 + 0.4 * keystone * xy[0] / l);
        let [bent, knocked] = self.roll_rad;
        let xy = turned([zoom * xy[0], zoom * xy[1]], bent * (1.0 + 0.15 * xy[0] / l));
        let xy = [xy[0] * (1.0 + pixels), xy[1] * (1.0 + 0.5 * pixels)];
        let xy = if knocked == 0.0 { xy } else { about(xy, [0.5 * l, 0.0], knocked) };
        let centre = [0.5 * l, l / 6.0];
        let off = [xy[0] - centre[0], xy[1] - centre[1]];
        let (square, [barrel, fisheye]) = (off[0] * off[0] + off[1] * off[1], self.lens);
        let bulge = barrel * square + fisheye * square * square;
        [xy[0] + bulge * off[0], xy[1] + bulge * off[1] + self.drift_m * u * u]
    }
}

fn turned([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    [x * cos - y * sin, x * sin + y * cos]
}

fn about([x, y]: [f64; 2], [cx, cy]: [f64; 2], angle: f64) -> [f64; 2] {
    let [dx, dy] = turned([x - cx, y - cy], angle);
    [cx + dx, cy + dy]
}
