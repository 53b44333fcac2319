//! The colour map.

/// Viridis at steps of a tenth: N. Smith and S. van der Walt for matplotlib, CC0.
const VIRIDIS: [u32; 11] = [
    0x44_01_54, 0x48_24_75, 0x41_44_87, 0x35_5f_8d, 0x2a_78_8e, 0x21_91_8c, 0x22_a8_84, 0x44_bf_70, 0x7a_d1_51,
    0xbd_df_26, 0xfd_e7_25,
];

/// Colour of a share between 0 (dark violet) and 1 (yellow): red, green, blue from 0 to 1. Even in perceived lightness,
/// also for colour-blind eyes and in grey print.
pub(crate) fn viridis(share: f64) -> [f64; 3] {
    let place = share.clamp(0.0, 1.0) * (VIRIDIS.len() - 1) as f64;
    let index = (place as usize).min(VIRIDIS.len() - 2);
    let (a, b) = (parts(VIRIDIS[index]), parts(VIRIDIS[index + 1]));
    let along = place - index as f64;
    [0, 1, 2].map(|k| a[k] + along * (b[k] - a[k]))
}

fn parts(hex: u32) -> [f64; 3] {
    [16, 8, 0].map(|shift| f64::from(hex >> shift & 0xff) / 255.0)
}

#[cfg(test)]
mod tests {
    use super::super::raster::bytes;
    use super::*;

    #[test]
    fn the_colour_map_grows_lighter_from_end_to_end() {
        let lightness = |i: usize| {
            let [r, g, b] = viridis(i as f64 / 100.0).map(|v| v.powf(2.2));
            0.2126 * r + 0.7152 * g + 0.0722 * b
        };
        assert!((0..100).all(|i| lightness(i) < lightness(i + 1)));
        assert_eq!(bytes(viridis(0.0)), [0x44, 0x01, 0x54]);
        assert_eq!(bytes(viridis(2.0)), [0xfd, 0xe7, 0x25]);
        assert_eq!(bytes(viridis(0.5)), [0x21, 0x91, 0x8c]);
    }
}
