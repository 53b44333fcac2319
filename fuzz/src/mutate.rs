//! Broken inputs made from good ones: bytes, numbers, words and lines are changed, moved, doubled and cut.

/// Splitmix64: small, and the same everywhere.
#[derive(Debug, Clone)]
pub(crate) struct Random(u64);

impl Random {
    /// The numbers of one case: they depend on nothing but these two.
    pub(crate) fn of(seed: u64, case: u64) -> Random {
        let mut random = Random(seed ^ case.wrapping_mul(0x9e37_79b9_7f4a_7c15));
        random.next();
        random
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A whole number below `count`; 0 if that is 0.
    pub(crate) fn below(&mut self, count: usize) -> usize {
        if count == 0 { 0 } else { (self.next() % count as u64) as usize }
    }

    fn one_of<'a, T>(&mut self, list: &'a [T]) -> &'a T {
        &list[self.below(list.len())]
    }
}

const NUMBERS: &[&str] = &[
    "0",
    "-0",
    "-1",
    "1",
    "nan",
    "NaN",
    "inf",
    "-inf",
    "1e400",
    "1e308",
    "-1e308",
    "1e-320",
    "1e-9",
    "1e9",
    "0.5",
    "2147483648",
    "4294967296",
    "9223372036854775807",
    "18446744073709551615",
    "18446744073709551616",
    "1,5",
    "0x10",
    "1_000",
    "+3",
    "1.2.3",
    "",
    "\"7\"",
    "true",
    "[1, 2]",
    "--1",
    "1e",
    "½",
];
/// Pieces that mean something to one reader or another.
const PIECES: &[&str] = &[
    "\n",
    "\r",
    "\r\n",
    "\0",
    "\t",
    ",",
    ";",
    "\"",
    "'",
    "#",
    "=",
    "[",
    "]",
    "[[",
    "{",
    "}",
    "(",
    ")",
    "*",
    "/",
    "^",
    "<",
    ">",
    "<a>",
    "&#0;",
    "$End",
    "\u{feff}",
    "µ",
    "\u{1b}[2J",
    "_mm",
    "_kpa",
    "sin(",
    "((((((((",
    "[[[[[[[[",
    "<a><a><a><a>",
];
const MOST_BYTES: usize = 200_000;

/// A broken input: one of the good ones, changed once or a few times.
pub(crate) fn broken(corpus: &[Vec<u8>], random: &mut Random) -> Vec<u8> {
    let mut bytes = random.one_of(corpus).clone();
    for _ in 0..1 + random.below(2) * random.below(6) {
        bytes = changed(bytes, corpus, random);
        bytes.truncate(MOST_BYTES);
    }
    bytes
}

fn changed(bytes: Vec<u8>, corpus: &[Vec<u8>], random: &mut Random) -> Vec<u8> {
    match random.below(16) {
        0 => flipped(bytes, random),
        1 => inserted(bytes, random),
        2 => cut(bytes, random),
        3 => bytes[..random.below(bytes.len() + 1)].to_vec(),
        4 => {
            let other: &Vec<u8> = random.one_of(corpus);
            spliced(&bytes, other, random)
        }
        5..=8 => with_number(&bytes, random),
        9 | 10 => words_swapped(&bytes, random),
        11..=13 => lines_changed(&bytes, random),
        14 => with_piece(bytes, random),
        _ => whole_number_swapped(bytes, random),
    }
}

fn flipped(mut bytes: Vec<u8>, random: &mut Random) -> Vec<u8> {
    let at = random.below(bytes.len());
    if let Some(byte) = bytes.get_mut(at) {
        *byte ^= 1 << random.below(8);
    }
    bytes
}

fn inserted(mut bytes: Vec<u8>, random: &mut Random) -> Vec<u8> {
    let at = random.below(bytes.len() + 1);
    bytes.insert(at, random.next() as u8);
    bytes
}

/// A range of the bytes, short more often than long.
fn range(length: usize, random: &mut Random) -> std::ops::Range<usize> {
    let most = 1 << random.below(12);
    let from = random.below(length + 1);
    from..(from + random.below(most)).min(length)
}

fn cut(mut bytes: Vec<u8>, random: &mut Random) -> Vec<u8> {
    bytes.drain(range(bytes.len(), random));
    bytes
}

fn spliced(bytes: &[u8], other: &[u8], random: &mut Random) -> Vec<u8> {
    let from = &other[range(other.len(), random)];
    let at = random.below(bytes.len() + 1);
    [&bytes[..at], from, &bytes[at..]].concat()
}

fn with_piece(bytes: Vec<u8>, random: &mut Random) -> Vec<u8> {
    let piece = random.one_of(PIECES).as_bytes().repeat(1 << (random.below(2) * random.below(12)));
    let at = random.below(bytes.len() + 1);
    [&bytes[..at], &piece, &bytes[at..]].concat()
}

/// Four or eight bytes in a row become a number that a count should not be.
fn whole_number_swapped(mut bytes: Vec<u8>, random: &mut Random) -> Vec<u8> {
    let value = *random.one_of(&[0, 1, 0x7fff_ffff, 0xffff_ffff, u64::MAX, 1 << 40, 0x0a0a_0a0a]);
    let width = *random.one_of(&[4, 8]);
    let at = random.below(bytes.len().saturating_sub(width) + 1);
    if let Some(room) = bytes.get_mut(at..at + width) {
        room.copy_from_slice(&value.to_le_bytes()[..width]);
    }
    bytes
}

/// Where runs of bytes of one kind stand.
fn runs(bytes: &[u8], is: impl Fn(u8) -> bool) -> Vec<std::ops::Range<usize>> {
    let mut found = Vec::new();
    let mut from = None;
    for (at, byte) in bytes.iter().enumerate() {
        match (is(*byte), from) {
            (true, None) => from = Some(at),
            (false, Some(start)) => {
                found.push(start..at);
                from = None;
            }
            _ => {}
        }
    }
    found.extend(from.map(|start| start..bytes.len()));
    found
}

fn with_number(bytes: &[u8], random: &mut Random) -> Vec<u8> {
    let numbers = runs(bytes, |b| b.is_ascii_digit() || matches!(b, b'.' | b'-' | b'+'));
    if numbers.is_empty() {
        return bytes.to_vec();
    }
    let at = random.one_of(&numbers).clone();
    [&bytes[..at.start], random.one_of(NUMBERS).as_bytes(), &bytes[at.end..]].concat()
}

fn words_swapped(bytes: &[u8], random: &mut Random) -> Vec<u8> {
    let words = runs(bytes, |b| b.is_ascii_alphanumeric() || matches!(b, b'.' | b'-' | b'_') || b >= 0x80);
    if words.is_empty() {
        return bytes.to_vec();
    }
    let (a, b) = (random.one_of(&words).clone(), random.one_of(&words).clone());
    let (a, b) = if a.start <= b.start { (a, b) } else { (b, a) };
    if a == b {
        return bytes.to_vec();
    }
    [&bytes[..a.start], &bytes[b.clone()], &bytes[a.end..b.start], &bytes[a.clone()], &bytes[b.end..]].concat()
}

fn lines_changed(bytes: &[u8], random: &mut Random) -> Vec<u8> {
    let mut lines: Vec<&[u8]> = bytes.split_inclusive(|b| *b == b'\n').collect();
    if lines.is_empty() {
        return Vec::new();
    }
    let (a, b) = (random.below(lines.len()), random.below(lines.len()));
    let last = lines.len() - 1;
    match random.below(4) {
        0 => lines.swap(a, b),
        1 => drop(lines.remove(a)),
        2 => lines.insert(a, lines[b]),
        _ => lines[a..].rotate_left(usize::from(a < last)),
    }
    lines.concat()
}
