//! Printable text: names from files and arguments may hold what a terminal obeys.

/// The text with every control character but line ends and tabs as `?`, one for each of its bytes, so that places in it stay.
pub(crate) fn printable(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text.chars().peekable();
    while let Some(c) = rest.next() {
        match c {
            '\n' | '\t' => out.push(c),
            '\r' if rest.peek() == Some(&'\n') => out.push(c),
            c if c.is_control() => out.extend(std::iter::repeat_n('?', c.len_utf8())),
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_terminal_obeys_is_shown_and_places_stay() {
        let text = "a\u{1b}[31mred\u{9b}2J\u{7}\rb\tµ\r\nend\n";
        assert_eq!(printable(text), "a?[31mred??2J??b\tµ\r\nend\n");
        assert_eq!(printable(text).len(), text.len());
    }
}
