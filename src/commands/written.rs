//! Datasets that `ibr data generate` and `ibr data fem` write.

use crate::prelude::*;
use data::About;

pub(super) fn write_dataset(
    folder: &Path,
    dataset: &Dataset,
    about: &About,
    truth: String,
    inputs: &[Input],
    context: &mut Context,
) -> Result<()> {
    let mut files = Files { files: data::set_files(dataset, about)?.into(), ..Files::default() };
    files.text("truth.toml", truth);
    replace_files(folder, &files, inputs, context)
}
