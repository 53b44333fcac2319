use crate::cli::StudioArgs;
use crate::prelude::*;
use crate::studio::Studio;

/// Where the page is looked for, in the working folder.
const BUILT: &str = "web/dist/ibr.html";

pub(super) fn run(args: &StudioArgs, context: &mut Context) -> Result<Outcome> {
    if context.json {
        return Err(Failure::usage("ibr studio serves a page and has no answer", "leave --json out"));
    }
    let beside = std::env::current_exe().ok().and_then(|own| Some(own.parent()?.join("ibr.html")));
    let places: Vec<PathBuf> = match &args.page {
        Some(page) => vec![page.clone()],
        None => std::iter::once(PathBuf::from(BUILT)).chain(beside).collect(),
    };
    let Some(page) = places.iter().find_map(|place| std::fs::read_to_string(place).ok()) else {
        let tried: Vec<String> = places.iter().map(|place| place.display().to_string()).collect();
        let help = "build it with web/build.sh in a checkout, or name it: ibr studio --page ibr.html";
        return Err(Failure::usage(format!("no page at {}", tried.join(" or ")), help));
    };
    let studio = Studio::open(&page, args.port).map_err(|cause| {
        Failure::usage(
            format!("port {} cannot be used: {cause}", args.port),
            "choose another with --port, or 0 for a free one",
        )
    })?;
    (context.say)(&format!("{}\nOpen it in a browser on this machine. Ctrl-C ends it.\n", studio.address()));
    studio.serve();
    Ok(Outcome::default())
}
