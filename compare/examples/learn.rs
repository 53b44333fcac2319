use compare::diagnosis::{Options, diagnose};
use compare::{Evidence, ScenarioFile};
fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let pairs: Vec<(String, String)> = if args.len() >= 2 { vec![(args[0].clone(), args[1].clone())] } else {
        ["spam", "cpam", "epam", "fpam"].iter().flat_map(|k| [(k.to_string(), format!("fem-{k}")), (format!("{k}-textbook"), format!("fem-{k}"))]).collect() };
    for (scenario, data) in pairs {
        let file = ScenarioFile::read(&scenario).unwrap();
        let evidence = [Evidence::read(&data).unwrap()];
        for keep in [false, true] {
            let t = std::time::Instant::now();
            let options = Options { keep_bending: keep, learn: true, pairs: false, next_experiment: false, ..Options::default() };
            let found = diagnose(&file, &evidence, &options, &mut |_, _| ()).unwrap();
            let floor = found.missing_moment.as_ref().map_or(f64::NAN, |m| m.shapes[0].floor_mm);
            println!("== {scenario} {data} keep {keep} {:?} floor {floor:.2}", t.elapsed());
            let Some(l) = &found.learned else { println!("   nothing learned: before {:?}", found.base.heldout_mm); continue };
            println!("   {} | {}", l.words, l.formula);
            println!("   line {:.2?} B {:?}", l.line, l.bending_nm2);
            println!("   train {:.2} -> {:.2}; heldout {:.2?} -> {:.2?}", l.before_mm, l.after_mm, l.heldout_before_mm.unwrap_or(f64::NAN), l.heldout_after_mm);
            for p in &l.parameters { print!("   {}={:.3} [{:.3?},{:.3?}] b{}", p.key, p.value, p.lo.unwrap_or(f64::NAN), p.hi.unwrap_or(f64::NAN), p.at_bound); }
            println!();
            for t in &l.tried { println!("      {:8.3} {:.2} mm {} {}", t.missed, t.heldout_mm, t.numbers, t.words); }
        }
    }
}
