//! DXF of the oldest dialect that every cutter reads (AC1009, AutoCAD R12), in mm.

use super::{PatternSheet, PenLine, SheetText};

/// The drawing as a DXF file: one layer a pen, and `TEXT` for words. Characters beyond ASCII become `?`, which R12 has not.
pub fn dxf(sheet: &PatternSheet) -> String {
    let mut out = Pairs::default();
    out.text(999, "made by ibr");
    out.section("HEADER");
    out.text(9, "$ACADVER").text(1, "AC1009");
    out.text(9, "$INSUNITS").text(70, "4");
    out.text(9, "$EXTMIN").point(10, [0.0, 0.0]);
    out.text(9, "$EXTMAX").point(10, sheet.size);
    out.text(0, "ENDSEC");
    out.section("TABLES");
    out.text(0, "TABLE").text(2, "LAYER").number(70, sheet.layers.len() + 1);
    for (name, aci) in sheet.layers.iter().map(|layer| (layer.name, layer.aci)).chain([(WORDS, 7)]) {
        out.text(0, "LAYER").text(2, name).text(70, "0").number(62, usize::from(aci)).text(6, "CONTINUOUS");
    }
    out.text(0, "ENDTAB").text(0, "ENDSEC");
    out.section("ENTITIES");
    sheet.lines.iter().for_each(|line| polyline(sheet, line, &mut out));
    sheet.labels.iter().for_each(|label| word(label, &mut out));
    out.text(0, "ENDSEC").text(0, "EOF");
    out.0
}

/// Pen of words.
const WORDS: &str = "TEXT";

/// Group codes and values, a line each.
#[derive(Default)]
struct Pairs(String);

impl Pairs {
    fn text(&mut self, code: u16, value: &str) -> &mut Pairs {
        let plain: String = value.chars().map(|c| if (' '..='~').contains(&c) { c } else { '?' }).collect();
        self.0.push_str(&format!("{code}\n{plain}\n"));
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

fn word(label: &SheetText, out: &mut Pairs) {
    out.text(0, "TEXT").text(8, WORDS).point(10, label.at).length(40, label.height).text(1, &label.text);
}
