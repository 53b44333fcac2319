//! `ibr pattern`: files true to size, or an error with its remedy and nothing written.

use crate::support::Folder;

#[test]
fn a_pattern_is_written_whole_and_by_pages() {
    let folder = Folder::new();
    let text = folder.run(&["pattern", "cpam", "--out", "sheet.svg", "--page", "a4"]).stdout;
    assert!(text.matches("sheet-").count() > 1 && text.contains("sheet of the pouches"), "{text}");
    for page in ["sheet-1-1.svg", "sheet-1-2.svg"] {
        let svg = std::fs::read_to_string(folder.path(page)).unwrap();
        assert!(svg.contains(r#"width="210mm" height="297mm" viewBox="0 0 210 297""#), "{page}");
    }
    assert_eq!(folder.run(&["pattern", "epam", "--out", "sheet.dxf"]).code, 0);
    assert!(std::fs::read_to_string(folder.path("sheet.dxf")).unwrap().contains("AC1009"));
}

#[test]
fn what_cannot_be_drawn_says_what_to_type_and_leaves_files_alone() {
    let folder = Folder::new();
    folder.write("old.svg", "mine");
    let cases: [(&[&str], &str); 4] = [
        (&["pattern", "epam", "--out", "old.pdf"], "pattern.svg"),
        (&["pattern", "epam", "--out", "old.dxf", "--page", "a4"], "leave out --page"),
        (&["pattern", "epam", "--out", "old.svg", "--weld", "70mm"], "write a width from 0"),
        (&["pattern", "epam", "--out", "old.svg", "--allowance", "-5mm"], "--allowance 10mm"),
    ];
    for (typed, said) in cases {
        let ran = folder.run(typed);
        assert!(ran.code == 2 && ran.stderr.contains(said), "{typed:?}: {} {}", ran.code, ran.stderr);
    }
    assert_eq!(std::fs::read_to_string(folder.path("old.svg")).unwrap(), "mine");
}

#[test]
fn a_kerf_is_stated_where_cut_lines_have_it() {
    let folder = Folder::new();
    for (args, kerf) in [(&["--kerf", "0.2mm"][..], true), (&[], false)] {
        let ran = folder.run(&[&["pattern", "epam", "--out", "kerf.dxf", "--force"], args].concat());
        assert_eq!(ran.code, 0, "{}", ran.stderr);
        let drawn = std::fs::read_to_string(folder.path("kerf.dxf")).unwrap();
        assert!(
            ran.stdout.contains("Kerf 0.20 mm") == kerf && drawn.contains("Kerf 0.20 mm") == kerf,
            "{}",
            ran.stdout
        );
    }
}
