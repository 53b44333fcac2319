//! What the camera makes of a marker.
//!
//! ```text
//! height     (x, y) → (x − e sinψ, y + e (cosψ − 1)), e (1 + 0.3 (s/L − ½))    markers on a body that tapers
//! mount      turned about the base by φ · 1.4 u/(1 + 0.4 u), u = P/30 kPa      a clamp that gives way less and less
//! scale      (1 + c)(1 + 0.4 c x/L)                                            the plane of the markers is tilted: keystone
//! rotation   turned about the base by δ (1 + 0.15 x/L)                         roll and a little bending of the image
//! lens       about (½L, L/6) by 1 + k r²                                        barrel distortion
//! drift      y + d u²                                                           the camera's stand moves with the robot's reaction
//! ```

/// Camera laws; all off at 0.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Camera {
    /// Body length L \[m\].
    pub length_m: f64,
    /// Marker height e \[m\].
    pub height_m: f64,
    /// Mount rotation at 30 kPa φ \[rad\].
    pub mount_rad: f64,
    /// Scale error c \[-\].
    pub scale: f64,
    /// Roll δ \[rad\].
    pub roll_rad: f64,
    /// Lens k \[1/m²\].
    pub lens_per_m2: f64,
    /// Drift at 30 kPa d \[m\].
    pub drift_m: f64,
}

/// A marker before the camera.
#[derive(Debug, Clone, Copy)]
pub struct SeenPoint {
    /// Place on the centre line \[m\].
    pub xy: [f64; 2],
    /// Heading \[rad\].
    pub heading: f64,
    /// Station \[m\].
    pub station_m: f64,
}

impl Camera {
    /// The marker as recorded \[m\], at the set pressure.
    pub fn see(&self, point: &SeenPoint, p_set_pa: f64) -> [f64; 2] {
        let (u, l) = (p_set_pa / 30e3, self.length_m);
        let (sin, cos) = point.heading.sin_cos();
        let height = self.height_m * (1.0 + 0.3 * (point.station_m / l - 0.5));
        let xy = [point.xy[0] - height * sin, point.xy[1] + height * (cos - 1.0)];
        let xy = turned(xy, self.mount_rad * 1.4 * u / (1.0 + 0.4 * u));
        let zoom = (1.0 + self.scale) * (1.0 + 0.4 * self.scale * xy[0] / l);
        let xy = turned([zoom * xy[0], zoom * xy[1]], self.roll_rad * (1.0 + 0.15 * xy[0] / l));
        let centre = [0.5 * l, l / 6.0];
        let off = [xy[0] - centre[0], xy[1] - centre[1]];
        let bulge = self.lens_per_m2 * (off[0] * off[0] + off[1] * off[1]);
        [xy[0] + bulge * off[0], xy[1] + bulge * off[1] + self.drift_m * u * u]
    }
}

fn turned([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    [x * cos - y * sin, x * sin + y * cos]
}
