//! Every file of `examples/` prints what its head states.

#[path = "../../examples/control_loop.rs"]
#[allow(dead_code, reason = "its main only prints")]
mod control_loop;
#[path = "../../examples/design.rs"]
#[allow(dead_code, reason = "its main only prints")]
mod design;
#[path = "../../examples/export_c.rs"]
#[allow(dead_code, reason = "its main only prints")]
mod export_c;
#[path = "../../examples/fabric_test.rs"]
#[allow(dead_code, reason = "its main only prints")]
mod fabric_test;
#[path = "../../examples/own_csv.rs"]
#[allow(dead_code, reason = "its main only prints")]
mod own_csv;
// Finite elements without optimisation overflow the stack of their threads.
#[cfg(not(debug_assertions))]
#[path = "../../examples/pouch_in_elements.rs"]
#[allow(dead_code, reason = "its main only prints")]
mod pouch_in_elements;
#[path = "../../examples/sweep.rs"]
#[allow(dead_code, reason = "its main only prints")]
mod sweep;
#[path = "../../examples/two_strips.rs"]
#[allow(dead_code, reason = "its main only prints")]
mod two_strips;

/// Compares the block of text in the head of an example with what it prints.
fn prints_its_head<E: std::fmt::Debug>(source: &str, example: fn() -> Result<String, E>) {
    let head = source.lines().map_while(|line| line.strip_prefix("//!"));
    let head: String = head.map(|line| format!("{}\n", line.strip_prefix(' ').unwrap_or(line))).collect();
    let stated = head.split("```text\n").nth(1).and_then(|rest| rest.split("```").next());
    assert_eq!(example().unwrap(), stated.unwrap());
}

macro_rules! stated {
    ($($name:ident)*) => {
        $(
            #[test]
            fn $name() {
                prints_its_head(include_str!(concat!("../../examples/", stringify!($name), ".rs")), self::$name::example);
            }
        )*
    };
}

stated!(
    control_loop design export_c fabric_test own_csv sweep two_strips
);
#[cfg(not(debug_assertions))]
stated!(pouch_in_elements);
