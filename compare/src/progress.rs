//! How long work reports its progress.

/// Receives the current step, and the share of the whole that is done if that is known.
pub type Progress<'p> = dyn FnMut(&str, Option<f64>) + Send + 'p;

/// Where the parts of long work begin, as shares of its whole time; estimates of the time left rest on them.
///
/// Measured once as processor time, release build on two cores, when each part was first reported: `ibr diagnose epam-textbook
/// synthetic-epam --out FOLDER` (2.5 s; 0.24 s without a report), `ibr compare epam synthetic-epam --out FOLDER` (1.1 s), `ibr ladder
/// epam-textbook synthetic-epam --out FOLDER` (0.5 s) and `ibr demo` (14 s). Other data take other shares. A finite element run reports
/// the share of its simulated time: of `ibr simulate epam` (5.6 s) 0.5 was reported at 0.41 and 0.95 at 0.80; pictures come after.
pub mod shares {
    /// The data are read, and the command's own work begins.
    pub const READ: f64 = 0.01;
    /// Of a diagnosis: left-out data begin (0.21 with one effect missing, 0.52 with two), then the next experiment (0.63, 0.77).
    pub const DIAGNOSIS: [f64; 2] = [0.4, 0.7];
    /// Share of a diagnosis's fits after which pairs of effects are fitted.
    pub const PAIRS: f64 = 0.35;
    /// The fits of a diagnosis are done, and its report begins.
    pub const DIAGNOSED: f64 = 0.1;
    /// The report of a comparison begins.
    pub const COMPARED: f64 = 0.02;
    /// The report of a ladder begins.
    pub const CLIMBED: f64 = 0.4;
    /// A demonstration is computed, its page begins.
    pub const SHOWN: f64 = 0.75;
    /// Pictures of its page: both engines, diagnosis.
    pub const PICTURES: [f64; 2] = [0.2, 0.5];
}

/// The progress of a part of the whole: its shares from 0 to 1 become shares of the whole from `from` to `to`.
pub fn part<'p>(progress: &'p mut Progress, [from, to]: [f64; 2]) -> impl FnMut(&str, Option<f64>) + Send + 'p {
    move |what, share| progress(what, Some(from + (to - from) * share.unwrap_or(0.0).clamp(0.0, 1.0)))
}

/// Does work for every item and reports before each how much is done.
pub fn each<T, R>(items: &[T], what: &str, progress: &mut Progress, mut work: impl FnMut(&T) -> R) -> Vec<R> {
    let one = |(i, item): (usize, &T)| {
        progress(what, Some(i as f64 / items.len() as f64));
        work(item)
    };
    items.iter().enumerate().map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_fill_their_share_of_the_whole() {
        let mut shares = Vec::new();
        let mut whole = |_: &str, share: Option<f64>| shares.extend(share);
        let doubled = each(&[1, 2], "half", &mut part(&mut whole, [0.5, 0.7]), |v| 2 * v);
        part(&mut whole, [0.7, 1.0])("rest", None);
        assert_eq!((doubled, shares), (vec![2, 4], vec![0.5, 0.6, 0.7]));
    }
}
