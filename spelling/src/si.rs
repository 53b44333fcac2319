//! Serialising SI numbers in the units that the key names: `#[serde(rename = "x_mm", serialize_with = "si::mm")] x_m: f64`.

use serde::{Serialize, Serializer};

/// A number, or a list or option of numbers, that is serialised in another unit.
pub trait Numbers {
    /// Type of the converted numbers, of the same shape.
    type Written: Serialize;
    /// Applies `to` to every number, and keeps the shape.
    fn converted(&self, to: fn(f64) -> f64) -> Self::Written;
}

impl Numbers for f64 {
    type Written = f64;
    fn converted(&self, to: fn(f64) -> f64) -> f64 {
        to(*self)
    }
}

impl<N: Numbers> Numbers for Option<N> {
    type Written = Option<N::Written>;
    fn converted(&self, to: fn(f64) -> f64) -> Self::Written {
        self.as_ref().map(|numbers| numbers.converted(to))
    }
}

impl<T: Numbers, const N: usize> Numbers for [T; N] {
    type Written = Vec<T::Written>;
    fn converted(&self, to: fn(f64) -> f64) -> Self::Written {
        self.iter().map(|numbers| numbers.converted(to)).collect()
    }
}

/// Metres as millimetres, joules as millijoules.
pub fn mm<S: Serializer>(value: &impl Numbers, to: S) -> Result<S::Ok, S::Error> {
    value.converted(|m| 1e3 * m).serialize(to)
}

/// Serialises pascals as kilopascals, for `serialize_with`.
pub fn kpa<S: Serializer>(value: &impl Numbers, to: S) -> Result<S::Ok, S::Error> {
    value.converted(|pa| pa / 1e3).serialize(to)
}

/// Serialises a rate per pascal as a rate per kilopascal.
pub fn per_kpa<S: Serializer>(value: &impl Numbers, to: S) -> Result<S::Ok, S::Error> {
    value.converted(|per_pa| 1e3 * per_pa).serialize(to)
}

/// Cubic metres as cubic centimetres.
pub fn cm3<S: Serializer>(value: &impl Numbers, to: S) -> Result<S::Ok, S::Error> {
    value.converted(|m3| 1e6 * m3).serialize(to)
}

/// Cubic metres per pascal as cubic centimetres per kilopascal.
pub fn cm3_per_kpa<S: Serializer>(value: &impl Numbers, to: S) -> Result<S::Ok, S::Error> {
    value.converted(|m3_per_pa| 1e9 * m3_per_pa).serialize(to)
}

/// Newtons per metre as newtons per millimetre.
pub fn n_per_mm<S: Serializer>(value: &impl Numbers, to: S) -> Result<S::Ok, S::Error> {
    value.converted(|n_per_m| n_per_m / 1e3).serialize(to)
}

/// Metres per pascal as millimetres per kilopascal.
pub fn mm_per_kpa<S: Serializer>(value: &impl Numbers, to: S) -> Result<S::Ok, S::Error> {
    value.converted(|m_per_pa| 1e6 * m_per_pa).serialize(to)
}

/// Radians per pascal as degrees per kilopascal.
pub fn deg_per_kpa<S: Serializer>(value: &impl Numbers, to: S) -> Result<S::Ok, S::Error> {
    value.converted(|rad_per_pa| 1e3 * rad_per_pa.to_degrees()).serialize(to)
}

/// Serialises radians as degrees, for `serialize_with`.
pub fn deg<S: Serializer>(value: &impl Numbers, to: S) -> Result<S::Ok, S::Error> {
    value.converted(f64::to_degrees).serialize(to)
}
