//! The state of a run as bytes and back, in the wire format of `postcard`: numbers keep all their bits.

use serde::Serialize;
use serde::de::DeserializeOwned;

pub(crate) fn pack<T: Serialize + ?Sized>(state: &T) -> Vec<u8> {
    // Only a list of unknown length can fail, which no state has.
    postcard::to_allocvec(state).unwrap_or_default()
}

/// The state that [`pack`] wrote; `None` for bytes that were cut, or with more behind them.
pub(crate) fn unpack<T: DeserializeOwned>(saved: &[u8]) -> Option<T> {
    let (state, rest) = postcard::take_from_bytes(saved).ok()?;
    rest.is_empty().then_some(state)
}

#[cfg(test)]
mod tests {
    use super::*;

    type State = (u64, f64, Vec<f64>, Vec<u32>, Option<[f64; 2]>, String);

    fn sample() -> State {
        let numbers = vec![f64::NAN, f64::MIN_POSITIVE, 0.1, f64::NEG_INFINITY];
        (u64::MAX, -0.0, numbers, vec![7, u32::MAX, 0], Some([0.1, 0.2]), "κ of ‘body’".into())
    }

    #[test]
    fn what_was_written_is_read_back_to_the_bit() {
        let (whole, zero, numbers, words, pair, text) = unpack::<State>(&pack(&sample())).unwrap();
        let bits = |all: &[f64]| all.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        assert_eq!((whole, words, pair, text), (u64::MAX, sample().3, sample().4, sample().5));
        assert_eq!((zero.to_bits(), bits(&numbers)), ((-0.0_f64).to_bits(), bits(&sample().2)));
    }

    #[test]
    fn a_cut_at_any_byte_and_a_byte_too_many_are_noticed() {
        let saved = pack(&sample());
        for length in 0..saved.len() {
            assert!(unpack::<State>(&saved[..length]).is_none(), "cut to {length} bytes");
        }
        assert!(unpack::<State>(&[&saved[..], &[0]].concat()).is_none());
    }

    #[test]
    fn an_absurd_length_neither_overflows_nor_allocates() {
        for length in [u64::MAX, 1 << 61, 1 << 40] {
            let saved = pack(&(length, 0_u64));
            assert!(unpack::<Vec<f64>>(&saved).is_none() && unpack::<Vec<u32>>(&saved).is_none());
        }
    }
}
