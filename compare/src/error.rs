//! What can go wrong when a prediction is held against measurements.

/// Errors of this crate; each message says what is wrong and what to do.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CompareError {
    /// The dataset has no run, hold, marker or sample.
    #[error("the dataset `{name}` is empty: it needs at least one run, one hold, one marker and one sample")]
    Empty {
        /// Name of the dataset.
        name: String,
    },
    /// An array does not have the shape of one run.
    #[error(
        "{what} has {found} values, one run of the data has {expected} ({holds} holds x {samples} samples x {markers} \
         markers x 2): predict at the holds, sample times and markers of the dataset"
    )]
    WrongLength {
        /// Which array.
        what: &'static str,
        /// Its length.
        found: usize,
        /// The length of one run.
        expected: usize,
        /// Holds per run.
        holds: usize,
        /// Samples per hold.
        samples: usize,
        /// Markers.
        markers: usize,
    },
    /// An array holds NaN, infinity or more than a kilometre.
    #[error(
        "{what} is not a usable number at hold {hold}, marker {marker} (counted from 1): check the model or the file \
         there (finite, below 1 km)"
    )]
    NotFinite {
        /// Which array.
        what: &'static str,
        /// Hold, counted from 1.
        hold: usize,
        /// Marker, counted from 1.
        marker: usize,
    },
    /// The list of sessions does not fit the runs.
    #[error("{found} session labels for {runs} runs: give one label per run, or none if all runs are one session")]
    WrongSessions {
        /// Labels given.
        found: usize,
        /// Runs in the data.
        runs: usize,
    },
    /// Every session has a single run, so nothing repeats.
    #[error(
        "every session has one run only, so run-to-run scatter cannot be told from session differences: repeat at \
         least one session, or leave the session labels out"
    )]
    SessionsWithoutRepeats,
    /// A setting is outside its range.
    #[error("{name} = {value} is not possible: {expected}")]
    BadOption {
        /// Name of the setting.
        name: &'static str,
        /// Value given.
        value: f64,
        /// What is expected.
        expected: &'static str,
    },
    /// A matrix decomposition did not converge.
    #[error("the noise covariance could not be decomposed: check the marker positions for extreme values")]
    Decomposition,
}
