use crate::cli::StudioArgs;
use crate::prelude::*;
use crate::studio::Studio;

/// `PAGE`: the page that `web/build.sh` had built when this program was built.
mod built {
    include!(concat!(env!("OUT_DIR"), "/page.rs"));
}

/// Where a checkout has the page, for a program without one.
const CHECKOUT: &str = "web/dist/ibr.html";

pub(super) fn run(args: &StudioArgs, context: &mut Context) -> Result<Outcome> {
    if context.json {
        return Err(Failure::usage("ibr studio serves a page and has no answer", "leave --json out"));
    }
    let help =
        "this program was built without a page: build one with web/build.sh in a checkout, and start ibr studio there";
    let absent = |cause| Failure::usage(format!("no page at {CHECKOUT}: {cause}"), help);
    let page = built::PAGE.map_or_else(|| std::fs::read_to_string(CHECKOUT), |page| Ok(page.to_string()));
    let page = page.map_err(absent)?;
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
