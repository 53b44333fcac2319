//! The solid of an obstacle: where a node is with respect to it.

use super::{Obstacle, ObstacleShape};
use crate::policy;
use crate::vec3::{V3, along, cross, dot, scale, sub, unit};
use crate::{FemError, Result};

#[derive(Debug, Clone)]
pub(crate) struct Solid {
    pub point: V3,
    /// Unit normal of a plane, or unit axis of a cylinder.
    pub axis: V3,
    pub radius_m: Option<f64>,
    pub friction: f64,
}

/// Where a node is with respect to a solid.
pub(crate) struct SolidTouch {
    pub(crate) depth_m: f64,
    pub normal: V3,
}

impl Solid {
    /// The solid of obstacle `index` (from 0).
    pub(crate) fn new(index: usize, obstacle: &Obstacle) -> Result<Solid> {
        let bad = |what: &str| FemError::Problem(format!("obstacle {}: {what}", index + 1));
        if !(obstacle.friction >= 0.0 && obstacle.friction.is_finite()) {
            return Err(bad("friction must be 0 or more"));
        }
        let (point, axis, radius_m) = match obstacle.shape {
            ObstacleShape::Plane { point, normal } => (point, normal, None),
            ObstacleShape::Cylinder { point, axis, radius_m } => (point, axis, Some(radius_m)),
        };
        if point.iter().any(|x| !x.is_finite()) {
            return Err(bad("its point is not finite"));
        }
        if radius_m.is_some_and(|r| !(r > 0.0 && r.is_finite())) {
            return Err(bad("the radius must be positive"));
        }
        let axis = unit(axis).ok_or_else(|| bad("its normal or axis has no length; write for example [0, 0, 1]"))?;
        Ok(Solid { point, axis, radius_m, friction: obstacle.friction })
    }
    pub(crate) fn touch(&self, x: &[f64; 4]) -> SolidTouch {
        let r = sub([x[0], x[1], x[2]], self.point);
        let height = dot(r, self.axis);
        let Some(radius) = self.radius_m else { return SolidTouch { depth_m: -height, normal: self.axis } };
        let out = along(r, -height, self.axis);
        let distance = dot(out, out).sqrt();
        let normal = if distance > 0.0 { scale(out, 1.0 / distance) } else { any_across(self.axis) };
        SolidTouch { depth_m: radius - distance, normal }
    }
}

/// Refuses nodes at these places that start inside an obstacle, as it is at a time \[s\].
///
/// # Errors
/// [`FemError::Problem`] with the deepest node (from 1), its place, the obstacle (from 1) and what to do.
pub(crate) fn check(places_m: &[V3], obstacles: &[Obstacle], time_s: f64) -> Result<()> {
    for (number, obstacle) in obstacles.iter().enumerate() {
        let solid = Solid::new(number, obstacle)?;
        let depth = |node: usize| {
            let [x, y, z] = sub(places_m[node], obstacle.moved_m(time_s));
            solid.touch(&[x, y, z, 0.0]).depth_m
        };
        let deepest = (0..places_m.len()).max_by(|a, b| depth(*a).total_cmp(&depth(*b)));
        let Some(node) = deepest.filter(|node| policy::is_inside(depth(*node))) else { continue };
        let [x, y, z] = places_m[node].map(|c| c * 1e3);
        return Err(FemError::Problem(format!(
            "[[obstacle]] {}: node {} starts {:.3} mm inside it, at ({x:.2}, {y:.2}, {z:.2}) mm. Move the obstacle, or turn the \
             normal of a plane to its free side",
            number + 1,
            node + 1,
            depth(node) * 1e3
        )));
    }
    Ok(())
}

fn any_across(axis: V3) -> V3 {
    let other = if axis[0].abs() < 0.5 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
    unit(cross(axis, other)).unwrap_or([0.0, 0.0, 1.0])
}
