//! Labels of runs and markers: of the files, of the caller, or found.

use super::frame::{RestAndTop, where_is};
use super::options::ImportOptions;
use super::recording::Recording;
use crate::cells::stem;
use crate::error::{DataError, Result};

/// Labels of runs that have none: what the names of their files do not have in common.
pub(crate) fn number_runs(runs: &mut [(String, Recording)]) {
    let stems: Vec<String> = runs.iter().map(|(file, _)| stem(file)).collect();
    let labels = distinct(&stems);
    let several = |k: usize| runs.iter().filter(|(file, _)| *file == runs[k].0).count() > 1;
    let files = stems.iter().collect::<std::collections::BTreeSet<_>>().len();
    let new: Vec<String> = (0..runs.len())
        .map(|k| match &runs[k].1.run {
            Some(run) if files > 1 => format!("{}-{run}", labels[k]),
            Some(run) => run.clone(),
            None if several(k) => format!("{}-{}", labels[k], k + 1),
            None => labels[k].clone(),
        })
        .collect();
    runs.iter_mut().zip(new).for_each(|((_, run), label)| run.run = Some(label));
}

/// Names without what they begin and end with in common, whole numbers kept whole; all alike or one alone: their numbers.
pub(super) fn distinct(names: &[String]) -> Vec<String> {
    let numbered = || (1..=names.len()).map(|k| k.to_string()).collect();
    let Some((first, rest)) = names.split_first().filter(|(_, rest)| !rest.is_empty()) else { return numbered() };
    let (bytes, shortest) = (first.as_bytes(), names.iter().map(String::len).min().unwrap_or(0));
    let shared = |same: &dyn Fn(&[u8]) -> usize| rest.iter().map(|name| same(name.as_bytes())).min().unwrap_or(0);
    let mut begin = shared(&|name| bytes.iter().zip(name).take_while(|(a, b)| a == b).count());
    while begin > 0 && (bytes[begin - 1].is_ascii_digit() || !first.is_char_boundary(begin)) {
        begin -= 1;
    }
    let back = |name: &[u8]| bytes.iter().rev().zip(name.iter().rev()).take_while(|(a, b)| a == b).count();
    let mut end = shared(&back).min(shortest.saturating_sub(begin));
    while end > 0 && (bytes[bytes.len() - end].is_ascii_digit() || !first.is_char_boundary(bytes.len() - end)) {
        end -= 1;
    }
    let cut: Option<Vec<&str>> = names.iter().map(|name| name.get(begin..name.len() - end)).collect();
    let cut = cut.filter(|cut| cut.iter().all(|name| !name.is_empty()));
    cut.map_or(names.to_vec(), |cut| cut.into_iter().map(str::to_string).collect())
}

/// Names without the subject or asset before a colon, where all have the same one.
pub(crate) fn without_subject<'n>(names: &[&'n str]) -> Vec<&'n str> {
    let parts = || names.iter().map(|name| name.split_once(':'));
    let first = parts().next().flatten().map(|(subject, _)| subject);
    let one = first.is_some() && parts().all(|part| part.map(|(subject, _)| subject) == first);
    parts().zip(names).map(|(part, name)| part.filter(|_| one).map_or(*name, |(_, short)| short)).collect()
}

/// Puts the markers of all runs in the order of the first.
pub(crate) fn same_markers(file: &str, runs: &mut [(String, Recording)]) -> Result<()> {
    let Some(((_, first), rest)) = runs.split_first_mut() else { return Ok(()) };
    let markers = &first.markers;
    for (_, run) in rest {
        let label = run.run.clone().unwrap_or_default();
        let is_other = run.named && run.markers.iter().any(|name| !markers.contains(name));
        if is_other || run.markers.len() != markers.len() {
            let [own, first] = [&run.markers, markers].map(|names| names.join(", "));
            let message = format!("run {label} has the markers {own}, the first run has {first}");
            let help = "export the same markers of every run, under the same names";
            return Err(DataError::of(file, message, help));
        }
        if run.named {
            let place = |name: &String| run.markers.iter().position(|own| own == name).unwrap_or_default();
            let order: Vec<usize> = markers.iter().map(place).collect();
            run.places = order.iter().map(|k| run.places[*k].clone()).collect();
            run.markers.clone_from(markers);
        }
    }
    Ok(())
}

/// Markers without names are numbered from the base outwards; names that the caller gives replace the files' names.
pub(crate) fn rename(
    file: &str,
    runs: &mut [Recording],
    ends: &[RestAndTop],
    options: &ImportOptions,
    told: &mut Vec<String>,
) -> Result<()> {
    for (run, ends) in runs.iter_mut().zip(ends).filter(|(run, _)| !run.named) {
        let found = options.base.as_ref().map(|base| where_is(run, ends, base)).transpose();
        let found = found.map_err(|[message, help]| DataError::of(file, message, help))?;
        let base = found.map_or([0.0; 3], |(at, _)| at);
        let away = |marker: usize| match run.mean_place(marker, &ends.rest) {
            Some(at) => (0..3).map(|axis| (at[axis] - base[axis]).powi(2)).sum(),
            None => f64::INFINITY,
        };
        let mut order: Vec<usize> = (0..run.markers.len()).collect();
        order.sort_by(|a, b| away(*a).total_cmp(&away(*b)));
        run.places = order.iter().map(|k| run.places[*k].clone()).collect();
        run.markers = (1..=order.len()).map(|k| k.to_string()).collect();
    }
    if runs.iter().any(|run| !run.named) {
        told.push("the file has no names of markers: they are numbered from the base outwards".to_string());
    }
    let (given, known) = (&options.markers, &runs[0].markers);
    if given.is_empty() {
        return Ok(());
    }
    if given.len() != known.len() {
        let message = format!("--markers names {}, the file has {}: {}", given.len(), known.len(), known.join(", "));
        return Err(DataError::of(file, message, "name every marker, in this order"));
    }
    told.push(format!("markers {} are called {}", known.join(", "), given.join(", ")));
    runs.iter_mut().for_each(|run| run.markers.clone_from(given));
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::distinct;

    #[test]
    fn runs_are_called_what_their_files_do_not_share() {
        let found = |names: &[&str]| distinct(&names.iter().map(|n| (*n).to_string()).collect::<Vec<_>>());
        assert_eq!(found(&["run1", "run2", "run3"]), ["1", "2", "3"]);
        assert_eq!(found(&["run10DLC_resnet50", "run11DLC_resnet50"]), ["10", "11"]);
        assert_eq!(found(&["a", "b"]), ["a", "b"]);
        assert_eq!(found(&["take", "take_2"]), ["take", "take_2"]);
        assert_eq!(found(&["alone"]), ["1"]);
    }
}
