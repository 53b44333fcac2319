//! Plain text to HTML: everything escaped, `code` and **bold** marked up.

const TAGS: [&str; 5] = ["measured", "published", "assumed", "calibrated", "predicted"];

pub(crate) fn escape(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
    text.replace('"', "&quot;").replace('\'', "&#39;")
}

/// The text escaped, with `` `code` `` and `**bold**` spans; a mark without its partner stays as it is.
pub(crate) fn inline(text: &str) -> String {
    spans(text, "`", "code", |text| spans(text, "**", "strong", escape))
}

/// Every second part between marks in a tag, if its mark is closed.
fn spans(text: &str, mark: &str, tag: &str, plain: impl Fn(&str) -> String) -> String {
    let parts: Vec<&str> = text.split(mark).collect();
    let span = |(i, part): (usize, &&str)| match (i % 2 == 1, i + 1 < parts.len()) {
        (true, true) => format!("<{tag}>{}</{tag}>", escape(part)),
        (true, false) => format!("{mark}{}", plain(part)),
        (false, _) => plain(part),
    };
    parts.iter().enumerate().map(span).collect()
}

/// A cell of the column "how do we know": [`inline`], with the five words as tags.
pub(crate) fn with_tags(text: &str) -> String {
    text.split(' ').map(tagged).collect::<Vec<_>>().join(" ")
}

fn tagged(word: &str) -> String {
    let bare = word.trim_end_matches([',', ';', ':', '.']);
    match TAGS.iter().find(|known| known.eq_ignore_ascii_case(bare)) {
        Some(known) => {
            let rest = &word[bare.len()..];
            format!("<span class=\"tag tag-{}\">{}</span>{}", known, escape(bare), escape(rest))
        }
        None => inline(word),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marked_spans_are_rendered_and_everything_else_is_escaped() {
        assert_eq!(inline("a **b** `c<d>` & e"), "a <strong>b</strong> <code>c&lt;d&gt;</code> &amp; e");
        assert_eq!(inline("2 ** 3 and `open"), "2 ** 3 and `open");
        assert_eq!(inline("`**`"), "<code>**</code>");
    }

    #[test]
    fn the_five_words_become_tags() {
        let cell = with_tags("Assumed, not measured: x<y");
        assert_eq!(
            cell,
            "<span class=\"tag tag-assumed\">Assumed</span>, not <span class=\"tag tag-measured\">measured</span>: x&lt;y"
        );
    }
}
