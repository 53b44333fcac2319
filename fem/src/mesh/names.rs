//! Names people type, in errors of one line.

/// "; did you mean `x`?", or nothing.
pub(crate) fn meant<'a>(wrong: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    spelling::nearest(wrong, known).map_or(String::new(), |name| format!("; did you mean `{name}`?"))
}
