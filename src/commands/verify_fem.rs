//! The finite element part of `ibr verify`.

use super::Context;
use super::tables::table;
use crate::cli::VerifyArgs;
use crate::cost::cpu_seconds;
use crate::failure::Failure;
use ibr::pages::Files;
use report::{LineSeries, LineStyle, Lines};
use serde_json::{Value, json};
use verification::checks::{Against, CHECKS, Check, Figure, Line, Outcome};

/// What the checks of the engine came to.
#[derive(Default)]
pub struct Engine {
    pub text: String,
    pub json: Vec<Value>,
    pub missed: usize,
    pub notes: Vec<String>,
}

pub fn run(args: &VerifyArgs, context: &mut Context) -> Result<Engine, Failure> {
    let checks = chosen(args)?;
    let mut engine = Engine::default();
    let (mut rows, mut files, mut lines) = (Vec::new(), Files::default(), 0);
    for (i, check) in checks.iter().enumerate() {
        (context.progress)(check.name, Some(i as f64 / checks.len() as f64));
        let start = cpu_seconds();
        let outcome = (check.run)()?;
        let cpu_s = cpu_seconds() - start;
        engine.missed += outcome.lines.iter().filter(|line| !line.passes()).count();
        lines += outcome.lines.len();
        rows.extend(outcome.lines.iter().enumerate().map(|(n, line)| row(check, line, n == 0, cpu_s)));
        engine.json.push(as_json(check, &outcome, cpu_s));
        if let (Some(figure), true) = (&outcome.figure, args.plots.is_some()) {
            files.files.push((format!("{}.png", check.name), draw(figure)?));
        }
    }
    engine.text = table(&["check", "quantity", "measured", "known", "error", "", "CPU-s"], 2, rows);
    engine.text.push_str(&format!("{} of {lines} engine results within their limits\n", lines - engine.missed));
    let left = CHECKS.iter().filter(|c| c.slow).count();
    if !args.slow && args.only.is_empty() && left > 0 {
        engine.text.push_str(&format!("{left} longer checks were left out; `ibr verify --slow` runs them too\n"));
    }
    if let Some(folder) = &args.plots {
        crate::output::write_files(folder, &files, &[], context)?;
        engine.text.push_str(&format!("{} figures in {}\n", files.files.len(), folder.display()));
    }
    Ok(engine)
}

fn chosen(args: &VerifyArgs) -> Result<Vec<&'static Check>, Failure> {
    if args.only.is_empty() {
        return Ok(CHECKS.iter().filter(|c| args.slow || !c.slow).collect());
    }
    let find = |name: &String| {
        let known = || CHECKS.iter().map(|c| c.name).collect::<Vec<_>>().join(", ");
        let found = CHECKS.iter().find(|c| c.name == name);
        found.ok_or_else(|| Failure::usage(format!("there is no check `{name}`"), format!("write one of {}", known())))
    };
    args.only.iter().map(find).collect()
}

fn row(check: &Check, line: &Line, first: bool, cpu_s: f64) -> Vec<String> {
    let known = match line.against {
        Against::Value { exact, tolerance } => format!("{} ± {} %", short(exact), short(100.0 * tolerance)),
        Against::AtMost(limit) => format!("≤ {}", short(limit)),
        Against::AtLeast(limit) => format!("≥ {}", short(limit)),
        Against::Between(low, high) => format!("{} to {}", short(low), short(high)),
    };
    vec![
        if first { check.name.to_string() } else { String::new() },
        line.quantity.clone(),
        short(line.measured),
        known,
        line.error().map_or(String::new(), |e| format!("{:+.2} %", 100.0 * e)),
        if line.passes() { "ok" } else { "MISSED" }.into(),
        if first { format!("{cpu_s:.1}") } else { String::new() },
    ]
}

/// Five digits, in powers of ten only where plain digits would be long.
fn short(x: f64) -> String {
    let size = x.abs();
    if x == 0.0 {
        "0".into()
    } else if (1e-3..1e5).contains(&size) {
        let decimals = (4 - size.log10().floor() as i32).clamp(0, 7) as usize;
        let text = format!("{x:.decimals$}");
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_string() } else { text }
    } else {
        format!("{x:.3e}")
    }
}

fn as_json(check: &Check, outcome: &Outcome, cpu_s: f64) -> Value {
    let line = |line: &Line| {
        let against = match line.against {
            Against::Value { exact, tolerance } => json!({"exact": exact, "tolerance": tolerance}),
            Against::AtMost(limit) => json!({"at_most": limit}),
            Against::AtLeast(limit) => json!({"at_least": limit}),
            Against::Between(low, high) => json!({"between": [low, high]}),
        };
        json!({"quantity": line.quantity, "measured": line.measured, "against": against, "passes": line.passes()})
    };
    let lines: Vec<Value> = outcome.lines.iter().map(line).collect();
    json!({"check": check.name, "sentence": check.sentence, "source": check.source, "cpu_s": cpu_s, "lines": lines})
}

fn draw(figure: &Figure) -> Result<Vec<u8>, Failure> {
    let known = figure.curves.iter().filter(|c| c.exact).count();
    let paired = 2 * known == figure.curves.len();
    let mut seen = [0, 0];
    let series = figure.curves.iter().map(|curve| {
        let place = &mut seen[usize::from(curve.exact)];
        *place += 1;
        LineSeries {
            name: curve.label.clone(),
            points: curve.points.clone(),
            style: if curve.exact { LineStyle::Line } else { LineStyle::Points },
            // An engine's marks have the colour of the line that they belong to.
            colour: paired.then_some(*place - 1),
            ..LineSeries::default()
        }
    });
    let lines = Lines {
        title: figure.title.clone(),
        x_label: figure.x.clone(),
        y_label: figure.y.clone(),
        series: series.collect(),
    };
    Ok(report::lines(&lines)?.png)
}
