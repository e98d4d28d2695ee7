/// How long a quotation is at most, in characters as they are shown.
const LONGEST: usize = 60;

/// A piece of a file for a message: in backticks, cut short, and with nothing in it that a terminal would obey.
pub(crate) fn quoted(text: impl AsRef<[u8]>) -> String {
    format!("`{}`", cut(text))
}

/// As [`quoted`], without the backticks.
pub(crate) fn cut(text: impl AsRef<[u8]>) -> String {
    // Four bytes a character at most, so that the rest of a long line is not even looked at.
    let text = text.as_ref().trim_ascii();
    let start = String::from_utf8_lossy(&text[..text.len().min(4 * LONGEST + 4)]);
    let (mut cut, mut room) = (String::new(), LONGEST);
    for character in start.chars() {
        let shown = match character {
            ' '..='~' => character.to_string(),
            _ if character.is_control() || !character.is_alphanumeric() => character.escape_default().to_string(),
            _ => character.to_string(),
        };
        let length = shown.chars().count();
        if length > room {
            cut.push_str("..");
            break;
        }
        room -= length;
        cut += &shown;
    }
    cut
}

#[cfg(test)]
mod tests {
    use super::quoted;

    #[test]
    fn long_and_wild_text_is_cut_and_escaped() {
        assert_eq!(quoted(" v 1 2\t3 "), "`v 1 2\\t3`");
        assert_eq!(quoted("\u{1b}[31mé\u{202e}"), "`\\u{1b}[31mé\\u{202e}`");
        assert_eq!(quoted(vec![b'x'; 5_000_000]), format!("`{}..`", "x".repeat(60)));
        assert_eq!(quoted([b'a', 0xff]), "`a\\u{fffd}`");
        assert_eq!(quoted([0; 1000]), format!("`{}..`", "\\u{0}".repeat(12)));
    }
}
