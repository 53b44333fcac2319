//! Plots inside the page: only the elements and attributes that our plots use, page colours and page font.

use crate::markup::escape;
use crate::with_css_variables;

const ELEMENTS: [&str; 8] = ["svg", "rect", "line", "polyline", "polygon", "circle", "path", "text"];
/// Attributes that are kept.
const KEPT: [&str; 27] = [
    "viewBox",
    "x",
    "y",
    "dy",
    "x1",
    "y1",
    "x2",
    "y2",
    "cx",
    "cy",
    "r",
    "d",
    "points",
    "width",
    "height",
    "transform",
    "text-anchor",
    "font-size",
    "font-style",
    "font-weight",
    "opacity",
    "fill",
    "stroke",
    "stroke-width",
    "stroke-linejoin",
    "stroke-linecap",
    "stroke-opacity",
];
/// Attributes that the page sets itself.
const DROPPED: [&str; 2] = ["xmlns", "font-family"];

/// The plot ready for the page, with an accessible title; or what in it is not allowed.
pub(crate) fn inline(svg: &str, id: &str, alt: &str) -> Result<String, String> {
    if !svg.starts_with("<svg ") || !svg.trim_end().ends_with("</svg>") {
        return Err("it does not start with <svg and end with </svg>".to_owned());
    }
    let mut out = String::with_capacity(svg.len());
    for (i, piece) in svg.split('<').skip(1).enumerate() {
        let (tag, content) = piece.split_once('>').ok_or("an element that is not closed")?;
        out.push_str(&element(tag, i == 0)?);
        if i == 0 {
            out.insert_str("<svg".len(), &format!(" role=\"img\" aria-labelledby=\"{id}\""));
            out.push_str(&format!("<title id=\"{id}\">{}</title>", escape(alt)));
        }
        out.push_str(content);
    }
    Ok(with_css_variables(&out))
}

/// One tag, rewritten; the outermost one loses its size, so that it fills its column.
fn element(tag: &str, outermost: bool) -> Result<String, String> {
    if let Some(name) = tag.strip_prefix('/') {
        return if ELEMENTS.contains(&name) { Ok(format!("</{name}>")) } else { Err(format!("element {name}")) };
    }
    let (body, end) = tag.strip_suffix('/').map_or((tag, ">"), |body| (body, "/>"));
    let (name, mut rest) = body.split_once(' ').unwrap_or((body, ""));
    if !ELEMENTS.contains(&name) {
        return Err(format!("element {name}"));
    }
    let mut out = format!("<{name}");
    while !rest.trim_start().is_empty() {
        let (key, value, after) = attribute(rest).ok_or_else(|| format!("a malformed attribute in {name}"))?;
        rest = after;
        if KEPT.contains(&key) && !value.contains("url(") {
            if !(outermost && matches!(key, "width" | "height")) {
                out.push_str(&format!(" {key}=\"{value}\""));
            }
        } else if !DROPPED.contains(&key) {
            return Err(format!("attribute {key}"));
        }
    }
    Ok(out + end)
}

/// First attribute `key="value"` of a tag, and what follows it.
fn attribute(text: &str) -> Option<(&str, &str, &str)> {
    let (key, rest) = text.trim_start().split_once("=\"")?;
    let (value, rest) = rest.split_once('"')?;
    Some((key, value, rest))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plot_gets_a_title_and_page_colours() {
        let svg = "<svg width=\"520\" height=\"9\" viewBox=\"0 0 1 1\" xmlns=\"x\"><rect fill=\"#1B1F24\"/></svg>";
        let page = inline(svg, "t", "a & b").unwrap();
        assert_eq!(
            page,
            "<svg role=\"img\" aria-labelledby=\"t\" viewBox=\"0 0 1 1\"><title id=\"t\">a &amp; b</title>\
             <rect fill=\"var(--ink)\"/></svg>"
        );
    }

    #[test]
    fn scripts_links_handlers_and_broken_markup_are_refused() {
        for inner in [
            "<script>x</script>",
            "<a href=\"x\">y</a>",
            "<rect onload=\"x\"/>",
            "<rect fill=\"url(x)\"/>",
            "<rect fill=red/>",
            "<image",
        ] {
            assert!(inline(&format!("<svg >{inner}</svg>"), "t", "").is_err(), "{inner}");
        }
        assert!(inline("<p>no plot</p>", "t", "").is_err());
    }
}
