//! Loads and obstacles: the small entries of the list of terms.
