//! How long work tells where it stands.

/// Told what is being done, and which share of the whole is done if that is known.
pub type Progress<'p> = dyn FnMut(&str, Option<f64>) + Send + 'p;

/// The progress of a part of the whole: its shares from 0 to 1 are those of the whole from `from` to `to`.
pub fn part<'p>(progress: &'p mut Progress, [from, to]: [f64; 2]) -> impl FnMut(&str, Option<f64>) + Send + 'p {
    move |what, share| progress(what, Some(from + (to - from) * share.unwrap_or(0.0).clamp(0.0, 1.0)))
}

/// Does work for every item and tells before each how much is done.
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
