//! A text file as a stream of lines that know their number and byte offset.
//!
//! One line is in memory at a time, so a file of any size needs none; a quote that is never closed can spoil one row
//! only. Quoted cells are therefore not allowed to contain line ends.

use std::io::{BufRead, BufReader, Read};

use crate::error::{DataError, Result};

/// Longest line accepted: far above any row of markers; without a bound a binary file would be read whole.
const LONGEST_LINE: u64 = 1 << 20;
/// Bytes between two calls of the progress function.
const PROGRESS_STEP: u64 = 1 << 20;

/// Called about every MiB and at the end with the bytes that are done and the bytes in all.
pub type Progress<'a> = &'a mut dyn FnMut(u64, u64);

/// One line of a file, without its line end.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TextLine<'a> {
    pub file: &'a str,
    pub number: u64,
    /// Byte offset of the first character in the file.
    pub start: usize,
    pub text: &'a str,
    /// False for a last line without line end.
    pub ended: bool,
}

impl TextLine<'_> {
    pub(crate) fn fault(&self, message: impl Into<String>, help: impl Into<String>) -> DataError {
        let mut error = DataError::of(self.file, message, help).at_line(self.number);
        let fault = error.fault_mut();
        fault.span = Some((self.start, self.start + self.text.len()));
        fault.source_line = Some(self.text.to_string());
        fault.source_start = self.start;
        error
    }

    /// An owned copy of place and text, for faults found only when the whole file has been read.
    pub(crate) fn keep(&self) -> KeptLine {
        KeptLine { file: self.file.to_string(), number: self.number, start: self.start, text: self.text.to_string() }
    }
}

#[derive(Debug, Clone)]
pub(crate) struct KeptLine {
    pub file: String,
    number: u64,
    start: usize,
    text: String,
}

impl KeptLine {
    pub(crate) fn line(&self) -> TextLine<'_> {
        TextLine { file: &self.file, number: self.number, start: self.start, text: &self.text, ended: true }
    }
}

pub(crate) struct LineReader<'a> {
    reader: BufReader<Box<dyn Read + 'a>>,
    progress: Option<Progress<'a>>,
    file: String,
    buffer: Vec<u8>,
    number: u64,
    next_byte: u64,
    bytes_total: u64,
    next_report: u64,
}

impl<'a> LineReader<'a> {
    /// Lines of `reader`; `bytes_total` (0 if unknown) is handed on to `progress` with the bytes read so far.
    pub(crate) fn new(
        file: &str,
        reader: &'a mut dyn Read,
        bytes_total: u64,
        progress: Progress<'a>,
    ) -> LineReader<'a> {
        LineReader { progress: Some(progress), bytes_total, ..LineReader::of(file, Box::new(reader)) }
    }

    /// Lines of a text that is at hand.
    pub(crate) fn of_text(file: &str, text: &'a str) -> LineReader<'a> {
        LineReader::of(file, Box::new(text.as_bytes()))
    }

    fn of(file: &str, reader: Box<dyn Read + 'a>) -> LineReader<'a> {
        LineReader {
            reader: BufReader::with_capacity(1 << 16, reader),
            progress: None,
            file: file.to_string(),
            buffer: Vec::new(),
            number: 0,
            next_byte: 0,
            bytes_total: 0,
            next_report: PROGRESS_STEP,
        }
    }

    pub(crate) fn file(&self) -> &str {
        &self.file
    }

    /// The next line that is not blank (whitespace or separators only), or `None` at the end.
    pub(crate) fn next_filled(&mut self) -> Result<Option<TextLine<'_>>> {
        loop {
            let read = self.read_raw()?;
            if read == 0 {
                self.report();
                return Ok(None);
            }
            // A spreadsheet ends with rows of separators where cells were emptied.
            if !self.buffer.iter().all(|byte| byte.is_ascii_whitespace() || matches!(byte, b',' | b';')) {
                break;
            }
        }
        self.current().map(Some)
    }

    fn report(&mut self) {
        if let Some(progress) = &mut self.progress {
            progress(self.next_byte, self.bytes_total.max(self.next_byte));
        }
    }

    fn read_raw(&mut self) -> Result<usize> {
        self.buffer.clear();
        let read = self.reader.by_ref().take(LONGEST_LINE).read_until(b'\n', &mut self.buffer);
        let read = read.map_err(|cause| self.unreadable(&cause.to_string()))?;
        self.number += 1;
        self.next_byte += read as u64;
        if read as u64 == LONGEST_LINE && self.buffer.last() != Some(&b'\n') {
            return Err(self.too_long());
        }
        if self.next_byte >= self.next_report {
            self.next_report = self.next_byte + PROGRESS_STEP;
            self.report();
        }
        Ok(read)
    }

    fn current(&self) -> Result<TextLine<'_>> {
        let start = (self.next_byte - self.buffer.len() as u64) as usize;
        let ended = self.buffer.last() == Some(&b'\n');
        let mut bytes = self.buffer.strip_suffix(b"\n").unwrap_or(&self.buffer);
        bytes = bytes.strip_suffix(b"\r").unwrap_or(bytes);
        let text = std::str::from_utf8(bytes).map_err(|cause| self.not_utf8(start + cause.valid_up_to(), bytes))?;
        if self.number == 1 && text.trim_end_matches('\r').contains('\r') {
            return Err(self.cr_only());
        }
        let mark = if self.number == 1 && text.starts_with('\u{feff}') { '\u{feff}'.len_utf8() } else { 0 };
        Ok(TextLine { file: &self.file, number: self.number, start: start + mark, text: &text[mark..], ended })
    }

    fn unreadable(&self, cause: &str) -> DataError {
        let message = format!("cannot read the file: {cause}");
        DataError::file(&self.file, message, "check the disk and try again").at_line(self.number + 1)
    }

    fn cr_only(&self) -> DataError {
        let help = "save the table again as CSV (UTF-8), or convert the line ends: tr '\\r' '\\n' < old.csv > new.csv";
        let message = "the line ends are CR only, as old Macintosh programs write them: the whole file is one line";
        DataError::of(&self.file, message, help)
    }

    fn too_long(&self) -> DataError {
        if self.number == 1 && self.buffer.contains(&b'\r') {
            return self.cr_only();
        }
        let help = "save the table as CSV (UTF-8) with one row per line";
        let message = "a line is longer than 1 MiB: this is not a marker table";
        DataError::of(&self.file, message, help).at_line(self.number)
    }

    fn not_utf8(&self, at: usize, bytes: &[u8]) -> DataError {
        let help = match bytes {
            [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => "it looks like UTF-16: save it as \"CSV UTF-8\"",
            [b'P', b'K', 3, 4, ..] => "it looks like an Excel workbook: export the sheet as \"CSV UTF-8\"",
            _ => "save the file as \"CSV UTF-8\"; µ, ° and accented letters are the usual culprits",
        };
        let mut error = DataError::of(&self.file, "the text is not UTF-8", help).at_line(self.number);
        error.fault_mut().span = Some((at, at + 1));
        error
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(mut bytes: &[u8]) -> Vec<(u64, usize, String)> {
        let mut progress = |_, _| ();
        let mut lines = LineReader::new("f", &mut bytes, 0, &mut progress);
        let mut out = Vec::new();
        while let Some(line) = lines.next_filled().unwrap() {
            out.push((line.number, line.start, line.text.to_string()));
        }
        out
    }

    #[test]
    fn lines_know_number_and_offset_and_blank_ones_are_skipped() {
        let found = texts("\u{feff}a\r\n  \nbc".as_bytes());
        assert_eq!(found, [(1, 3, "a".to_string()), (3, 9, "bc".to_string())]);
    }

    #[test]
    fn progress_is_called_about_once_per_megabyte_and_at_the_end() {
        let bytes = b"0123456789abcde\n".repeat(3 << 16);
        let mut calls = Vec::new();
        let mut progress = |done, total| calls.push((done, total));
        let mut reader = bytes.as_slice();
        let mut lines = LineReader::new("f", &mut reader, bytes.len() as u64, &mut progress);
        while lines.next_filled().unwrap().is_some() {}
        drop(lines);
        let total = bytes.len() as u64;
        assert_eq!(calls, [(1 << 20, total), (2 << 20, total), (3 << 20, total), (total, total)]);
    }

    #[test]
    fn a_file_without_line_ends_is_refused_after_one_mebibyte() {
        let bytes = vec![b'x'; 3 << 20];
        let mut progress = |_, _| ();
        let mut reader = bytes.as_slice();
        let error = LineReader::new("f", &mut reader, 0, &mut progress).next_filled().unwrap_err();
        assert!(error.message().contains("longer than 1 MiB"), "{error}");
    }
}
