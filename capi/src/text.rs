//! Text of a fixed size for C: nothing is allocated to say what went wrong.

use std::ffi::c_char;
use std::fmt::{self, Write};

/// Bytes of an error text, with its closing zero.
const SIZE: usize = 512;

/// A text that ends with a zero and is cut where it is too long.
pub(crate) struct Text {
    bytes: [u8; SIZE],
    length: usize,
}

impl Default for Text {
    fn default() -> Text {
        Text { bytes: [0; SIZE], length: 0 }
    }
}

impl Text {
    pub(crate) fn clear(&mut self) {
        (self.bytes[0], self.length) = (0, 0);
    }

    pub(crate) fn say(&mut self, words: fmt::Arguments) {
        self.clear();
        // What does not fit is cut.
        let _ = self.write_fmt(words);
    }

    pub(crate) fn as_ptr(&self) -> *const c_char {
        self.bytes.as_ptr().cast()
    }
}

impl Write for Text {
    fn write_str(&mut self, more: &str) -> fmt::Result {
        let kept = more.floor_char_boundary(SIZE - 1 - self.length);
        self.bytes[self.length..self.length + kept].copy_from_slice(&more.as_bytes()[..kept]);
        self.length += kept;
        self.bytes[self.length] = 0;
        if kept == more.len() { Ok(()) } else { Err(fmt::Error) }
    }
}

/// Copies a text into a buffer of the caller, cut to its size, with its closing zero.
///
/// # Safety
/// `to` is null or has `size` bytes.
pub(crate) unsafe fn copy(words: &str, to: *mut c_char, size: usize) {
    if to.is_null() || size == 0 {
        return;
    }
    let kept = words.floor_char_boundary(size - 1);
    // SAFETY: kept + 1 is at most size; a text of Rust does not overlap a buffer of the caller.
    unsafe {
        std::ptr::copy_nonoverlapping(words.as_ptr().cast(), to, kept);
        *to.add(kept) = 0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_that_is_too_long_is_cut_between_letters_and_closed() {
        let mut text = Text::default();
        text.say(format_args!("{}{}", "é".repeat(200), "ü".repeat(200)));
        assert_eq!((text.length, text.bytes[510], text.bytes[511]), (510, 0, 0));
        text.say(format_args!("short"));
        assert_eq!(&text.bytes[..6], b"short\0");
        let mut buffer = [1; 4];
        // SAFETY: the buffer has its size.
        unsafe { copy("aéé", buffer.as_mut_ptr(), buffer.len()) };
        assert_eq!(buffer.map(|c| c as u8), [b'a', 0xc3, 0xa9, 0]);
    }
}
