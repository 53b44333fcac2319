//! Actuators, effects, datasets and cases.

use compare::diagnosis::words::with_unit;
use fem::case::{GENERATORS, SHIPPED_CASES};
use ibr::studies::STUDIES;
use models::actuators::ACTUATORS;
use models::effects::EFFECTS;
use serde_json::{Value, json};

/// As text, and for programs.
pub fn actuators() -> (String, Value) {
    let mut text = String::from("ACTUATORS\n");
    for a in ACTUATORS {
        text.push_str(&format!(
            "  {:<6} {}\n         {}\n         {}\n         {}\n         source: {}\n",
            a.name, a.title, a.sentence, a.formula, a.validity, a.reference
        ));
    }
    let value = ACTUATORS.iter().map(|a| {
        json!({"name": a.name, "title": a.title, "sentence": a.sentence, "formula": a.formula, "validity": a.validity, "reference": a.reference})
    });
    (text, value.collect())
}

/// As text, and for programs.
pub fn effects() -> (String, Value) {
    let mut text = String::from("EFFECTS\n");
    for e in EFFECTS {
        text.push_str(&format!("  {:<18} [{}] {}\n    {}\n", e.name, e.stage.word(), e.sentence, e.formula));
        text.push_str(&format!("    in data: {}\n", e.differs));
        for p in e.parameters {
            text.push_str(&format!(
                "    {} ({}): {}; typical {}, {} to {}, no effect at {}\n",
                p.key,
                p.symbol,
                p.meaning,
                with_unit(&p.typical.to_string(), p.unit),
                p.lower,
                p.upper,
                p.neutral
            ));
        }
        text.push_str(&format!("    valid: {}; to check: {}; source: {}\n", e.validity, e.remedy, e.reference));
    }
    let value = EFFECTS.iter().map(|e| {
        let parameters: Vec<Value> = e
            .parameters
            .iter()
            .map(|p| json!({"key": p.key, "symbol": p.symbol, "unit": p.unit, "neutral": p.neutral, "typical": p.typical, "lower": p.lower, "upper": p.upper, "starts": p.starts, "meaning": p.meaning}))
            .collect();
        json!({"name": e.name, "stage": e.stage.word(), "group": e.group.word(), "history": e.history, "differs": e.differs, "sentence": e.sentence, "formula": e.formula, "remedy": e.remedy, "validity": e.validity, "reference": e.reference, "parameters": parameters})
    });
    (text, value.collect())
}

/// As text, and for programs.
pub fn datasets() -> (String, Value) {
    let sets = data::sets();
    let mut text = String::from("DATASETS\n");
    for s in &sets {
        let table = data::bench::KINDS.iter().find(|k| s.files.contains(&format!("{}.csv", k.name))).map(|k| k.name);
        let coupons = s.files.iter().any(|f| f.starts_with("coupon_")).then_some("tensile tests");
        let markers = s.has_markers().then_some("markers");
        let kind = markers.or(table).or(coupons).unwrap_or("published numbers");
        text.push_str(&format!(
            "  {:<28} {} ({}, {kind})\n    {}; licence {}\n",
            s.name,
            s.title,
            s.provenance.word(),
            s.source,
            s.licence
        ));
    }
    let value = sets.iter().map(|s| {
        json!({"name": s.name, "title": s.title, "provenance": s.provenance.word(), "source": s.source, "licence": s.licence, "files": s.files})
    });
    (text, value.collect())
}

/// As text, and for programs.
pub fn cases() -> (String, Value) {
    let mut text = String::from("CASES (ibr simulate; ibr new prints them)\n");
    let mut shipped = Vec::new();
    for (name, toml) in SHIPPED_CASES {
        let title = toml.lines().find_map(|line| line.strip_prefix("name = ")).unwrap_or_default().trim_matches('"');
        text.push_str(&format!("  {name:<16} {title}\n"));
        shipped.push(json!({"name": name, "title": title}));
    }
    text.push_str("  robots in finite elements, beside the four of ibr list actuators\n");
    let mut studies = Vec::new();
    for (name, about, _) in STUDIES {
        text.push_str(&format!("    {name:<14} {about}\n"));
        studies.push(json!({"name": name, "title": about}));
    }
    text.push_str("  meshes for cases of your own, [mesh] generator = …\n");
    for g in GENERATORS {
        let keys = g.keys.iter().map(|k| k.key).collect::<Vec<_>>().join(", ");
        text.push_str(&format!("    {:<14} {}\n                   {keys}\n", g.name, g.sentence));
    }
    let generators: Vec<Value> = GENERATORS
        .iter()
        .map(|g| {
            let keys: Vec<Value> =
                g.keys.iter().map(|k| json!({"key": k.key, "default": k.default, "meaning": k.meaning})).collect();
            json!({"name": g.name, "sentence": g.sentence, "keys": keys})
        })
        .collect();
    (text, json!({"shipped": shipped, "studies": studies, "generators": generators}))
}
