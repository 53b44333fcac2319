//! What `json_types` reads in the sources: fields, variants and doc comments as `rustfmt` leaves them, and units in names of keys.

#[derive(Debug, Clone, Default)]
pub(crate) struct Field {
    pub name: String,
    pub kind: String,
    pub docs: String,
    pub serde: String,
}

#[derive(Debug, Clone)]
pub(crate) enum Shape {
    Record(Vec<Field>),
    /// An enum without data: these words.
    Words(Vec<String>),
    /// An untagged enum: one of these types.
    Either(Vec<String>),
    Alias(String),
}

pub(crate) fn between<'t>(text: &'t str, start: &str, end: char) -> Option<&'t str> {
    let (_, rest) = text.split_once(start)?;
    rest.split_once(end).map(|(inside, _)| inside)
}

/// Documentation and attributes before an item.
#[derive(Default)]
pub(crate) struct Before {
    pub docs: Vec<String>,
    pub attributes: String,
}

impl Before {
    /// Takes a line that belongs to it; false for any other line.
    pub(crate) fn takes(&mut self, line: &str) -> bool {
        if let Some(doc) = line.strip_prefix("///") {
            self.docs.push(doc.trim().to_string());
        } else if line.starts_with("#[") {
            self.attributes += line;
        } else {
            return false;
        }
        true
    }

    pub(crate) fn docs(&self) -> String {
        self.docs.iter().take_while(|line| !line.is_empty()).cloned().collect::<Vec<_>>().join(" ")
    }
}

/// `snake_case` or `lowercase` of a variant.
pub(crate) fn renamed(variant: &str, attributes: &str) -> String {
    match between(attributes, "rename_all = \"", '"') {
        Some("lowercase") => variant.to_lowercase(),
        Some("snake_case") => {
            let word = |c: char| if c.is_uppercase() { format!("_{}", c.to_lowercase()) } else { c.to_string() };
            variant.chars().map(word).collect::<String>().trim_start_matches('_').to_string()
        }
        _ => variant.to_string(),
    }
}

pub(crate) fn fields<'l>(lines: &mut impl Iterator<Item = &'l str>) -> Vec<Field> {
    let (mut fields, mut before) = (Vec::new(), Before::default());
    while let Some(line) = lines.next().filter(|line| *line != "}") {
        let line = line.trim();
        if before.takes(line) || line.is_empty() || line.starts_with("//") {
            continue;
        }
        let mut whole = line.to_string();
        while !whole.ends_with(',') {
            whole += lines.next().unwrap().trim();
        }
        let own = std::mem::take(&mut before);
        let (name, kind) = whole.trim_end_matches(',').split_once(": ").unwrap();
        let name = name.rsplit(' ').next().unwrap().to_string();
        fields.push(Field { name, kind: kind.to_string(), docs: own.docs(), serde: own.attributes });
    }
    fields
}

pub(crate) fn variants<'l>(lines: &mut impl Iterator<Item = &'l str>, attributes: &str) -> Shape {
    let (mut words, mut types, mut before) = (Vec::new(), Vec::new(), Before::default());
    for line in lines.take_while(|line| *line != "}") {
        let line = line.trim();
        if before.takes(line) || line.is_empty() || line.starts_with("//") {
            continue;
        }
        let own = std::mem::take(&mut before);
        match line.trim_end_matches(',').split_once('(') {
            Some((variant, inside)) => {
                types.push(inside.trim_end_matches(')').to_string());
                words.push(renamed(variant, attributes));
            }
            None => {
                let variant = line.trim_end_matches(',');
                let name = between(&own.attributes, "rename = \"", '"').map(String::from);
                words.push(name.unwrap_or_else(|| renamed(variant, attributes)));
            }
        }
    }
    if let Some((tag, content)) = between(attributes, "tag = \"", '"').zip(between(attributes, "content = \"", '"')) {
        let words: Vec<String> = words.iter().map(|word| format!("`{word}`")).collect();
        let field = |name: &str, kind: &str, docs: String, serde: &str| Field {
            name: name.into(),
            kind: kind.into(),
            docs,
            serde: serde.into(),
        };
        return Shape::Record(vec![
            field(tag, "String", format!("One of {}", words.join(", ")), ""),
            field(content, "String", "Its reason".into(), "skip_serializing_if"),
        ]);
    }
    if attributes.contains("untagged") { Shape::Either(types) } else { Shape::Words(words) }
}

/// What a doc comment says of a key, and its unit.
pub(crate) fn meaning(docs: &str, name: &str) -> (String, String) {
    let stated = between(docs, "\\[", '\\').filter(|unit| *unit != "-");
    let mut text = docs.to_string();
    if let Some(unit) = stated {
        text = text.replace(&format!(" \\[{unit}\\]"), "");
    }
    let text = text.replace("\\[", "[").replace("\\]", "]").replace("`None`", "null").replace(" | ", " or ");
    let text = text.replace("[`", "`").replace("`]", "`");
    let text = text.trim_end_matches('.').to_string();
    (text, unit_of(name).map_or(stated.unwrap_or_default().to_string(), String::from))
}

/// Ends of keys, the longest first, and their units.
pub(crate) const UNITS: [(&str, &str); 35] = [
    ("_cm3_per_kpa", "cm³/kPa"),
    ("_mm_per_kpa", "mm/kPa"),
    ("_deg_per_kpa", "°/kPa"),
    ("_nm_per_kpa", "N·m/kPa"),
    ("_nms_per_rad", "N·m·s/rad"),
    ("_nm_per_rad", "N·m/rad"),
    ("_kg_per_m", "kg/m"),
    ("_mm_per_n", "mm/N"),
    ("_mm_per_s", "mm/s"),
    ("_n_per_mm", "N/mm"),
    ("_n_per_m", "N/m"),
    ("_per_cpu_s", "1/s"),
    ("_per_m", "1/m"),
    ("_cm3", "cm³"),
    ("_nm2", "N·m²"),
    ("_kpa", "kPa"),
    ("_mpa", "MPa"),
    ("_deg", "°"),
    ("_rad", "rad"),
    ("_pct", "%"),
    ("_mm", "mm"),
    ("_cm", "cm"),
    ("_m3", "m³"),
    ("_mj", "mJ"),
    ("_nm", "N·m"),
    ("_ms", "ms"),
    ("_us", "µs"),
    ("_pa", "Pa"),
    ("_hz", "Hz"),
    ("_kg", "kg"),
    ("_j", "J"),
    ("_m", "m"),
    ("_n", "N"),
    ("_s", "s"),
    ("_g", "g"),
];

pub(crate) fn unit_of(name: &str) -> Option<&'static str> {
    UNITS.iter().find(|(end, _)| name.ends_with(end)).map(|(_, unit)| *unit)
}
