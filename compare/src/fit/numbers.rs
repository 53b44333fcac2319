//! Means, differences, orders and groups of numbers.

/// Sum over count.
pub(crate) fn mean(values: impl IntoIterator<Item = f64>) -> f64 {
    let mut count = 0;
    let sum: f64 = values.into_iter().inspect(|_| count += 1).sum();
    sum / count as f64
}

/// a − b, value by value.
pub(crate) fn differences(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

/// Σ (a − b)².
pub(crate) fn squared_distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum()
}

/// The first item of which the key is least.
pub(crate) fn least<T>(items: impl IntoIterator<Item = T>, key: impl Fn(&T) -> f64) -> Option<T> {
    items.into_iter().min_by(|a, b| key(a).total_cmp(&key(b)))
}

/// The last item of which the key is largest.
pub(crate) fn largest<T>(items: impl IntoIterator<Item = T>, key: impl Fn(&T) -> f64) -> Option<T> {
    items.into_iter().max_by(|a, b| key(a).total_cmp(&key(b)))
}

/// Sorts by a key, the least first; equal ones keep their order.
pub(crate) fn sort_by<T>(items: &mut [T], key: impl Fn(&T) -> f64) {
    items.sort_by(|a, b| key(a).total_cmp(&key(b)));
}

/// Indices of alike keys, in the order in which the first of each comes.
pub(crate) fn groups<K>(keys: impl IntoIterator<Item = K>, are_alike: impl Fn(&K, &K) -> bool) -> Vec<Vec<usize>> {
    let mut found: Vec<(K, Vec<usize>)> = Vec::new();
    for (i, key) in keys.into_iter().enumerate() {
        match found.iter_mut().find(|(known, _)| are_alike(known, &key)) {
            Some((_, own)) => own.push(i),
            None => found.push((key, vec![i])),
        }
    }
    found.into_iter().map(|(_, own)| own).collect()
}
