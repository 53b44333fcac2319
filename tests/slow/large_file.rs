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

/// Frames of an hour at 60 per second, and markers.
const HOUR: (usize, usize) = (216_000, 12);
/// Most memory \[kB\] and time \[s\] for it.
const MOST_FOR_AN_HOUR: (u64, f64) = (500_000, 10.0);

#[test]
fn an_hour_of_video_is_imported_in_seconds() {
    let _alone = alone();
    let folder = Folder::new();
    let pressure = |t: f64| [0.0, 10.0, 20.0, 30.0][(t / 60.0) as usize % 4];
    let mut file = std::io::BufWriter::new(std::fs::File::create(folder.path("hour.csv")).unwrap());
    let names: Vec<String> = (1..=HOUR.1).map(|m| format!("m{m}")).collect();
    let row = |first: &str, cell: &dyn Fn(usize) -> String| {
        (0..HOUR.1).fold(first.to_string(), |row, m| row + "," + &cell(m)) + "\n"
    };
    file.write_all(row("scorer", &|_| "net,net,net".into()).as_bytes()).unwrap();
    file.write_all(row("bodyparts", &|m| [names[m].as_str(); 3].join(",")).as_bytes()).unwrap();
    file.write_all(row("coords", &|_| "x,y,likelihood".into()).as_bytes()).unwrap();
    for frame in 0..HOUR.0 {
        let p = pressure(frame as f64 / 60.0);
        let place = |m: usize| {
            let (s, noise) = (30.0 * (m + 1) as f64, ((frame * 31 + m * 7) % 101) as f64 * 0.01);
            format!("{:.5},{:.5},0.98", 212.0 + 3.1 * s - 0.02 * p + noise, 540.0 - p * s * s / 4000.0 + noise)
        };
        file.write_all(row(&frame.to_string(), &place).as_bytes()).unwrap();
    }
    file.flush().unwrap();
    let mut log = String::from("time_s,p_act_kpa,p_body_kpa\n");
    (0..36_000).map(|k| 0.1 * f64::from(k)).for_each(|t| writeln!(log, "{t:.1},{:.3},2.0", pressure(t)).unwrap());
    folder.write("log.csv", log);
    let options = "--pressure log.csv --scale 3.1px/mm --base 212,540 --fps 60 --actuator epam --out made";
    let args: Vec<&str> = ["data", "import", "hour.csv"].into_iter().chain(options.split(' ')).collect();
    let (most_kb, time_s) = measure(&folder, &args);
    println!("an hour of video: {most_kb} kB, {time_s:.1} s");
    assert!(most_kb <= MOST_FOR_AN_HOUR.0 && time_s <= MOST_FOR_AN_HOUR.1, "{most_kb} kB, {time_s:.1} s");
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
