//! A photograph or rendered picture with labels and leader lines.

use crate::markup::escape;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;

/// An SVG of a PNG with labels: text, where its baseline begins, where its leader ends, in pixels of the picture.
pub fn labelled(png: &[u8], [width, height]: [u32; 2], labels: &[(&str, [u32; 2], [u32; 2])]) -> String {
    let label = |(text, [x, y], [to_x, to_y]): &(&str, [u32; 2], [u32; 2])| {
        // The leader begins below or above the words, towards its end.
        let from_y = if to_y > y { y + 6 } else { y - 18 };
        format!(
            "<path d=\"M{} {from_y}L{to_x} {to_y}\" stroke=\"#333\" stroke-width=\"1.5\"/>\
             <text x=\"{x}\" y=\"{y}\" font-family=\"sans-serif\" font-size=\"18\" fill=\"#111\" stroke=\"#fff\" stroke-width=\"4\" \
             paint-order=\"stroke\">{}</text>",
            x + 30,
            escape(text)
        )
    };
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\">\
         <image width=\"{width}\" height=\"{height}\" href=\"data:image/png;base64,{}\"/>{}</svg>",
        STANDARD.encode(png),
        labels.iter().map(label).collect::<String>()
    )
}
