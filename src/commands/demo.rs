//! `ibr demo`

use crate::prelude::*;
use crate::shown::demo::{DemoAnswer, SmallRun, text};
use compare::demo::demo;
use compare::progress::part;
use compare::progress::shares::SHOWN;
use fem::session::{FeRun, Settings, Source, heights_mm, simulate};
use ibr::pages::demo_page;
use ibr::studies::SMALL_RUN;
use std::ops::ControlFlow;

pub(super) fn run(folder: &Path, context: &mut Context) -> Result<Outcome> {
    check_folder(folder)?;
    let say = &mut *context.say;
    let computed = demo(&mut part(context.progress, [0.0, SHOWN[0]]), &mut |told| say(&text(told)))?;
    let small = small_run(context)?;
    (context.say)(&small_text(&small));
    let mut files = demo_page(&computed, &imprint(), &mut part(context.progress, [SHOWN[1], 1.0]))?;
    let picture = small.files.iter().find(|(name, _)| name == "side.png");
    files.files.splice(0..0, picture.map(|(_, png)| ("small_run.png".to_string(), png.clone())));
    write_files(folder, &files, &[], context)?;
    let mut outcome = Outcome::answer(String::new(), "ibr.demo", &DemoAnswer::of(&computed, small_json(&small)));
    outcome.report(folder);
    Ok(outcome)
}

/// Pressures of the run that is made here and now.
const PRESSURES: (&str, &str) = ("pressures_kpa", "[10, 20, 30]");

fn small_run(context: &mut Context) -> Result<FeRun> {
    let mut tell = part(context.progress, SHOWN);
    let keys = SMALL_RUN.iter().chain([&PRESSURES]);
    let changes: Vec<_> = keys.map(|(key, value)| (key.to_string(), value.to_string())).collect();
    let robot = Source::new("epam", models::shipped("epam").unwrap_or_default()).with(&changes)?;
    Ok(simulate(&robot, &Settings::default(), &mut |_, share| {
        tell("a small finite element run", share);
        ControlFlow::Continue(())
    })?)
}

fn small_text(small: &FeRun) -> String {
    let tips = small.readings().iter().filter(|r| r.actuator_pa > 0.0);
    let tips: Vec<String> =
        tips.map(|r| format!("{:.1} mm at {:.0} kPa", heights_mm(r)[1], r.actuator_pa * 1e-3)).collect();
    format!(
        "\nA finite element run of the ePAM made just now, {} elements, 4 mm at the actuator, {:.1} CPU s: tip {}; {} buckling \
         events, energy balance missing {:.3} %\n",
        small.summary.elements,
        small.cost.cpu_s,
        tips.join(", "),
        snaps(small),
        100.0 * small.summary.residual_share
    )
}

fn snaps(small: &FeRun) -> usize {
    small.summary.robot.as_ref().map_or(0, |robot| robot.snaps.len())
}

fn small_json(small: &FeRun) -> SmallRun<'_> {
    SmallRun {
        elements: small.summary.elements,
        cpu_s: small.cost.cpu_s,
        residual_share: small.summary.residual_share,
        buckling_events: snaps(small),
        readings: small.readings(),
    }
}
