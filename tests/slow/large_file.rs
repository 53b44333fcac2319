//! A table of 200 MB: read as a stream, in a memory that does not grow with the file.
#![cfg(target_os = "linux")]

use crate::alone;
use crate::support::Folder;
use std::fmt::Write as _;
use std::io::Write as _;
use std::process::Stdio;
use std::time::{Duration, Instant};

const MEGABYTE: u64 = 1_000_000;
/// Most memory that reading may need \[kB\]; the file is three times as large.
const MOST_KB: u64 = 64_000;

#[test]
fn a_table_of_200_megabytes_is_checked_and_compared_in_bounded_memory() {
    let _alone = alone();
    let folder = Folder::new();
    write_table(&folder, "small.csv", 10 * MEGABYTE);
    write_table(&folder, "large.csv", 200 * MEGABYTE);
    for command in [&["data", "check"][..], &["compare", "epam"]] {
        let (small_kb, _) = measure(&folder, &[command, &["small.csv", "--json"]].concat());
        let (large_kb, time_s) = measure(&folder, &[command, &["large.csv", "--json"]].concat());
        println!("{command:?}: 10 MB {small_kb} kB, 200 MB {large_kb} kB, {time_s:.1} s");
        assert!(large_kb < MOST_KB, "{command:?}: {large_kb} kB");
        assert!(large_kb < small_kb + MOST_KB / 2, "{command:?}: {small_kb} kB become {large_kb} kB");
    }
}

/// Five runs of the paper's protocol, sampled as fast as makes the file this large; positions of the embedded set.
fn write_table(folder: &Folder, name: &str, bytes: u64) {
    let table = data::set_file("synthetic-epam", "markers.csv").unwrap();
    let repeats = bytes / table.len() as u64 + 1;
    let mut file = std::io::BufWriter::new(std::fs::File::create(folder.path(name)).unwrap());
    writeln!(file, "{}", table.lines().next().unwrap()).unwrap();
    let rows: Vec<&str> = table.lines().skip(1).collect();
    let mut text = String::new();
    // Six markers of one sample: they are repeated together, at later and later times.
    for sample in rows.chunks(6) {
        for repeat in 0..repeats {
            text.clear();
            for row in sample {
                let mut cells = row.splitn(4, ',');
                let [run, actuator, t] = [(); 3].map(|()| cells.next().unwrap());
                let t_s = t.parse::<f64>().unwrap() + repeat as f64 / repeats as f64;
                writeln!(text, "{run},{actuator},{t_s:.7},{}", cells.next().unwrap()).unwrap();
            }
            file.write_all(text.as_bytes()).unwrap();
        }
    }
    file.flush().unwrap();
    let length = std::fs::metadata(folder.path(name)).unwrap().len();
    assert!(length > bytes && length < 2 * bytes, "{length} bytes");
}

/// Peak memory \[kB\] and time \[s\] of a command, which must end well.
fn measure(folder: &Folder, args: &[&str]) -> (u64, f64) {
    let start = Instant::now();
    let mut child = folder.ibr(args).stdout(Stdio::null()).stderr(Stdio::inherit()).spawn().unwrap();
    let mut peak_kb = 0;
    let status = loop {
        if let Some(status) = child.try_wait().unwrap() {
            break status;
        }
        peak_kb = peak_kb.max(high_water_kb(child.id()).unwrap_or(0));
        std::thread::sleep(Duration::from_millis(2));
    };
    assert!(status.success(), "{args:?}");
    assert!(peak_kb > 0, "the memory of {args:?} was never read");
    (peak_kb, start.elapsed().as_secs_f64())
}

fn high_water_kb(process: u32) -> Option<u64> {
    let status = std::fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    line.split_whitespace().nth(1)?.parse().ok()
}
