//! Numbers as little-endian bytes and back, with every length checked: what `save` and `restore` are written with.
//!
//! Slices carry their length in front. Reading past the end, or a length that does not fit what is left, gives `None`
//! and never allocates more than the bytes at hand could fill.
//!
//! ```
//! use fem::bytes::{Reader, Writer};
//! let mut writer = Writer::new();
//! writer.u64(7);
//! writer.f64s(&[1.0, -0.0]);
//! let saved = writer.into_bytes();
//! let mut reader = Reader::new(&saved);
//! assert_eq!(reader.u64(), Some(7));
//! assert_eq!(reader.f64s(), Some(vec![1.0, -0.0]));
//! assert!(reader.is_empty());
//! ```

/// Collects bytes.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Writer {
    bytes: Vec<u8>,
}

impl Writer {
    /// Nothing written yet.
    pub fn new() -> Writer {
        Writer::default()
    }
    /// One integer, 8 bytes.
    pub fn u64(&mut self, value: u64) {
        self.bytes.extend_from_slice(&value.to_le_bytes());
    }
    /// One number, all 64 bits of it.
    pub fn f64(&mut self, value: f64) {
        self.u64(value.to_bits());
    }
    /// Length, then numbers.
    pub fn f64s(&mut self, values: &[f64]) {
        self.u64(values.len() as u64);
        self.bytes.extend(values.iter().flat_map(|value| value.to_le_bytes()));
    }
    /// Length, then integers.
    pub fn u64s(&mut self, values: &[u64]) {
        self.u64(values.len() as u64);
        self.bytes.extend(values.iter().flat_map(|value| value.to_le_bytes()));
    }
    /// Length, then 32-bit integers.
    pub fn u32s(&mut self, values: &[u32]) {
        self.u64(values.len() as u64);
        self.bytes.extend(values.iter().flat_map(|value| value.to_le_bytes()));
    }
    /// Length, then bytes: what another `save` gave.
    pub fn bytes(&mut self, values: &[u8]) {
        self.u64(values.len() as u64);
        self.bytes.extend_from_slice(values);
    }
    /// Length, then the text in UTF-8.
    pub fn text(&mut self, value: &str) {
        self.bytes(value.as_bytes());
    }
    /// Everything written.
    pub fn into_bytes(self) -> Vec<u8> {
        self.bytes
    }
}

/// Takes back what a [`Writer`] wrote, in the same order. After a `None` nothing more should be read.
#[derive(Debug, Clone)]
pub struct Reader<'a> {
    rest: &'a [u8],
}

impl<'a> Reader<'a> {
    /// Reads from the start of `saved`.
    pub fn new(saved: &'a [u8]) -> Reader<'a> {
        Reader { rest: saved }
    }
    /// One integer.
    pub fn u64(&mut self) -> Option<u64> {
        let (head, rest) = self.rest.split_first_chunk::<8>()?;
        self.rest = rest;
        Some(u64::from_le_bytes(*head))
    }
    /// One number.
    pub fn f64(&mut self) -> Option<f64> {
        self.u64().map(f64::from_bits)
    }
    /// Numbers, as many as were written.
    pub fn f64s(&mut self) -> Option<Vec<f64>> {
        let bytes = self.block(8)?;
        Some(bytes.as_chunks::<8>().0.iter().map(|chunk| f64::from_le_bytes(*chunk)).collect())
    }
    /// Numbers into a slice that must have the length that was written; untouched otherwise.
    pub fn f64s_into(&mut self, target: &mut [f64]) -> Option<()> {
        let bytes = self.block(8)?;
        let chunks = bytes.as_chunks::<8>().0;
        if chunks.len() != target.len() {
            return None;
        }
        for (value, chunk) in target.iter_mut().zip(chunks) {
            *value = f64::from_le_bytes(*chunk);
        }
        Some(())
    }
    /// Integers, as many as were written.
    pub fn u64s(&mut self) -> Option<Vec<u64>> {
        let bytes = self.block(8)?;
        Some(bytes.as_chunks::<8>().0.iter().map(|chunk| u64::from_le_bytes(*chunk)).collect())
    }
    /// 32-bit integers, as many as were written.
    pub fn u32s(&mut self) -> Option<Vec<u32>> {
        let bytes = self.block(4)?;
        Some(bytes.as_chunks::<4>().0.iter().map(|chunk| u32::from_le_bytes(*chunk)).collect())
    }
    /// Bytes, as many as were written.
    pub fn bytes(&mut self) -> Option<&'a [u8]> {
        self.block(1)
    }
    /// Text.
    pub fn text(&mut self) -> Option<&'a str> {
        std::str::from_utf8(self.block(1)?).ok()
    }
    /// True when everything was read; a `restore` that ends with bytes left over did not fit.
    pub fn is_empty(&self) -> bool {
        self.rest.is_empty()
    }

    /// A length and that many values of `size` bytes.
    fn block(&mut self, size: usize) -> Option<&'a [u8]> {
        let count = usize::try_from(self.u64()?).ok()?;
        let (head, rest) = self.rest.split_at_checked(count.checked_mul(size)?)?;
        self.rest = rest;
        Some(head)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample() -> Vec<u8> {
        let mut writer = Writer::new();
        writer.u64(u64::MAX);
        writer.f64(-0.0);
        writer.f64s(&[f64::NAN, f64::MIN_POSITIVE, 0.1]);
        writer.u64s(&[3, 1 << 63]);
        writer.u32s(&[7, u32::MAX, 0]);
        writer.bytes(&[1, 2, 255]);
        writer.text("κ of ‘body’");
        writer.into_bytes()
    }

    /// Everything in the order of [`sample`], written again.
    fn copy(saved: &[u8]) -> Option<Vec<u8>> {
        let (mut reader, mut writer) = (Reader::new(saved), Writer::new());
        writer.u64(reader.u64()?);
        writer.f64(reader.f64()?);
        writer.f64s(&reader.f64s()?);
        writer.u64s(&reader.u64s()?);
        writer.u32s(&reader.u32s()?);
        writer.bytes(reader.bytes()?);
        writer.text(reader.text()?);
        reader.is_empty().then(|| writer.into_bytes())
    }

    #[test]
    fn what_was_written_is_read_back_to_the_bit() {
        assert_eq!(copy(&sample()), Some(sample()));
        let (saved, mut bits) = (sample(), Vec::new());
        let mut reader = Reader::new(&saved);
        assert_eq!(reader.u64(), Some(u64::MAX));
        bits.push(reader.f64().unwrap().to_bits());
        bits.extend(reader.f64s().unwrap().iter().map(|x| x.to_bits()));
        assert_eq!(bits, [-0.0, f64::NAN, f64::MIN_POSITIVE, 0.1].map(f64::to_bits));
        assert_eq!(reader.u64s(), Some(vec![3, 1 << 63]));
        assert_eq!(reader.u32s(), Some(vec![7, u32::MAX, 0]));
        assert_eq!(reader.bytes(), Some(&[1, 2, 255][..]));
        assert_eq!(reader.text(), Some("κ of ‘body’"));
    }

    #[test]
    fn a_cut_at_any_byte_and_a_byte_too_many_are_noticed() {
        let saved = sample();
        for length in 0..saved.len() {
            assert!(copy(&saved[..length]).is_none(), "cut to {length} bytes");
        }
        assert!(copy(&[&saved[..], &[0]].concat()).is_none());
    }

    #[test]
    fn an_absurd_length_neither_overflows_nor_allocates() {
        for length in [u64::MAX, 1 << 61, 1 << 40] {
            let mut writer = Writer::new();
            writer.u64(length);
            writer.u64(0);
            let saved = writer.into_bytes();
            assert_eq!(Reader::new(&saved).f64s(), None);
            assert_eq!(Reader::new(&saved).bytes(), None);
            assert_eq!(Reader::new(&saved).u32s(), None);
        }
    }

    #[test]
    fn a_slice_of_another_length_is_left_alone() {
        let mut writer = Writer::new();
        writer.f64s(&[1.0, 2.0]);
        let saved = writer.into_bytes();
        let mut three = [9.0; 3];
        assert_eq!(Reader::new(&saved).f64s_into(&mut three), None);
        assert_eq!(three, [9.0; 3]);
        let mut two = [9.0; 2];
        assert_eq!(Reader::new(&saved).f64s_into(&mut two), Some(()));
        assert_eq!(two, [1.0, 2.0]);
    }
}
