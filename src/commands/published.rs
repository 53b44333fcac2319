//! `ibr diagnose SCENARIO --published`: conclusions from the one displacement that the paper prints.

use crate::prelude::*;
use compare::diagnosis::words::{three, with_unit};
use compare::study::one_number::{OneNumber, one_number};
use data::published::printed;
use ibr::pages::one_number_files;
use models::scenario::SHIPPED;

pub(super) fn run(name: &str, out: Option<&Path>, context: &mut Context) -> Result<Outcome> {
    out.map_or(Ok(()), check_folder)?;
    if models::shipped(name).is_none() {
        let message = format!("the paper printed no displacement of `{name}`");
        let kinds: Vec<&str> = SHIPPED.iter().map(|s| s.0).collect();
        let help = format!("with --published name a robot of the paper; {}", spelling::known(name, &kinds));
        return Err(Failure::usage(message, help));
    }
    let one = one_number(name)?;
    let mut outcome = Outcome::answer(text(&one), "ibr.one_number", &OneNumberAnswer { result: &one });
    if let Some(folder) = out {
        write_files(folder, &one_number_files(&one)?, &[], context)?;
        outcome.notes.push(format!("plot: {}", folder.join(format!("one_number_{}.png", one.actuator)).display()));
    }
    Ok(outcome)
}

/// `ibr.one_number`: `ibr diagnose SCENARIO --published`
#[derive(Serialize)]
struct OneNumberAnswer<'a> {
    /// Published number, and what a diagnosis makes of it
    result: &'a OneNumber,
}

fn text(one: &OneNumber) -> String {
    let top = one.p_act_kpa.len() - 1;
    let mut out = format!(
        "{}: the model predicts {:.1} mm at {:.0} kPa, the paper {:.1} mm (published). One number, met by one effect alone at:\n",
        printed(&one.actuator),
        one.bare_mm[top],
        one.p_act_kpa[top],
        one.measured_mm
    );
    let mut met = TextTable::of(&one.met_by)
        .words("effect", |e| &e.effect)
        .words("value", |e| format!("{} = {}", e.key, with_unit(&three(e.value), &e.unit)))
        .number("times typical", 2, |e| e.times_typical);
    for (k, p) in one.p_act_kpa.iter().enumerate() {
        met = met.number(format!("mm at {p:.0} kPa"), 1, |e| e.y_mm.get(k).copied());
    }
    out += &met.text();
    out.push_str("Each value is calibrated on that one number: meeting it is evidence for none of them.\n");
    out.push_str(&told(one));
    if !one.not_met_by.is_empty() {
        out.push_str(&format!("At no value within its bounds: {}.\n", one.not_met_by.join(", ")));
    }
    if let Some(term) = &one.fe_carrier {
        out.push_str(&format!(
            "The finite elements differ from the model as shipped by: {term}. Without it in both, the difference is less than half.\n"
        ));
    }
    out
}

fn told(one: &OneNumber) -> String {
    let mut out = String::new();
    for k in 0..one.p_act_kpa.len() - 1 {
        if let Some([low, high]) = one.spread_mm(k) {
            out.push_str(&format!(
                "At {:.0} kPa they differ: {low:.1} to {high:.1} mm. Marker positions there would separate most of them.\n",
                one.p_act_kpa[k]
            ));
        }
    }
    out
}
