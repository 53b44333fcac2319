//! DXF of the oldest dialect that every cutter reads (AC1009, AutoCAD R12), in mm. Its texts are ASCII: × is x, others are `\U+` and their code in hex.

use super::{PatternSheet, PenLine, SheetText};

/// The drawing as a DXF file: one layer a pen.
pub fn dxf(sheet: &PatternSheet) -> String {
    let mut out = Pairs::default();
    out.text(999, "made by ibr");
    out.section("HEADER");
    out.text(9, "$ACADVER").text(1, "AC1009");
    // Metric, and millimetres: some programs read the one, some the other.
    out.text(9, "$MEASUREMENT").text(70, "1");
    out.text(9, "$INSUNITS").text(70, "4");
    out.text(9, "$EXTMIN").point(10, [0.0, 0.0]);
    out.text(9, "$EXTMAX").point(10, sheet.size);
    out.text(0, "ENDSEC");
    out.section("TABLES");
    out.text(0, "TABLE").text(2, "LAYER").number(70, sheet.layers.len());
    for layer in &sheet.layers {
        out.text(0, "LAYER").text(2, layer.name).text(70, "0").number(62, usize::from(layer.aci)).text(6, "CONTINUOUS");
    }
    out.text(0, "ENDTAB").text(0, "ENDSEC");
    out.section("ENTITIES");
    sheet.lines.iter().for_each(|line| polyline(sheet, line, &mut out));
    let words = sheet.layers.last().map_or("0", |layer| layer.name);
    sheet.labels.iter().for_each(|label| word(label, words, &mut out));
    out.text(0, "ENDSEC").text(0, "EOF");
    out.0
}

#[derive(Default)]
struct Pairs(String);

impl Pairs {
    fn text(&mut self, code: u16, value: &str) -> &mut Pairs {
        let plain = |c: char| match c {
            ' '..='~' => c.to_string(),
            '×' => "x".into(),
            _ => format!("\\U+{:04X}", u32::from(c)),
        };
        self.0.push_str(&format!("{code}\n{}\n", value.chars().map(plain).collect::<String>()));
        self
    }

    fn number(&mut self, code: u16, value: usize) -> &mut Pairs {
        self.text(code, &value.to_string())
    }

    fn length(&mut self, code: u16, value: f64) -> &mut Pairs {
        self.text(code, &format!("{value:.4}"))
    }

    fn point(&mut self, code: u16, [x, y]: [f64; 2]) -> &mut Pairs {
        self.length(code, x).length(code + 10, y)
    }

    fn section(&mut self, name: &str) {
        self.text(0, "SECTION").text(2, name);
    }
}

fn polyline(sheet: &PatternSheet, line: &PenLine, out: &mut Pairs) {
    let Some(layer) = sheet.layers.get(line.layer) else { return };
    out.text(0, "POLYLINE").text(8, layer.name).text(66, "1").number(70, usize::from(line.closed));
    for point in &line.points {
        out.text(0, "VERTEX").text(8, layer.name).point(10, *point);
    }
    out.text(0, "SEQEND").text(8, layer.name);
}

fn word(label: &SheetText, layer: &str, out: &mut Pairs) {
    out.text(0, "TEXT").text(8, layer).point(10, label.at).length(40, label.height).text(1, &label.text);
}
