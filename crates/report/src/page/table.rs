//! One table, in HTML and in Markdown.

use std::fmt::Write as _;

use super::format::escape;

/// Rows of text under a head. A cell may have a shade from 0 (none) to 4.
#[derive(Default)]
pub(crate) struct Table {
    head: Vec<String>,
    rows: Vec<Vec<Cell>>,
    /// How many columns hold words, from the left; the others hold numbers.
    words: usize,
}

/// A cell.
pub(crate) struct Cell {
    text: String,
    shade: u8,
}

impl<T: Into<String>> From<T> for Cell {
    fn from(text: T) -> Self {
        Self { text: text.into(), shade: 0 }
    }
}

impl Cell {
    pub(crate) fn shaded(text: String, shade: u8) -> Self {
        Self { text, shade }
    }
}

impl Table {
    pub(crate) fn new<T: Into<String>>(words: usize, head: impl IntoIterator<Item = T>) -> Self {
        Self { head: head.into_iter().map(Into::into).collect(), rows: Vec::new(), words }
    }

    pub(crate) fn row<T: Into<Cell>>(&mut self, cells: impl IntoIterator<Item = T>) {
        let row: Vec<Cell> = cells.into_iter().map(Into::into).collect();
        debug_assert_eq!(row.len(), self.head.len(), "a cell a column");
        self.rows.push(row);
    }

    /// Adds a row, if there is one.
    pub(crate) fn rows_extend(&mut self, row: Option<Vec<String>>) {
        if let Some(row) = row {
            self.row(row);
        }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    pub(crate) fn html(&self) -> String {
        if self.is_empty() {
            return "<p>Not measured in this report.</p>\n".to_owned();
        }
        let mut out = "<div class=\"scroll\"><table>\n<thead><tr>".to_owned();
        for (i, head) in self.head.iter().enumerate() {
            let _ = write!(out, "<th{}>{}</th>", self.class(i, 0), escape(head));
        }
        out.push_str("</tr></thead>\n<tbody>\n");
        for row in &self.rows {
            out.push_str("<tr>");
            for (i, cell) in row.iter().enumerate() {
                let _ = write!(out, "<td{}>{}</td>", self.class(i, cell.shade), escape(&cell.text));
            }
            out.push_str("</tr>\n");
        }
        out.push_str("</tbody></table></div>\n");
        out
    }

    fn class(&self, column: usize, shade: u8) -> String {
        match (column < self.words, shade) {
            (true, 0) => String::new(),
            (true, shade) => format!(" class=\"s{shade}\""),
            (false, 0) => " class=\"n\"".to_owned(),
            (false, shade) => format!(" class=\"n s{shade}\""),
        }
    }

    pub(crate) fn markdown(&self) -> String {
        if self.is_empty() {
            return "Not measured in this report.\n".to_owned();
        }
        let line = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
        let mut out = line(self.head.iter().map(|head| plain(head)).collect());
        out += &line((0..self.head.len()).map(|i| if i < self.words { "---" } else { "---:" }.to_owned()).collect());
        for row in &self.rows {
            out += &line(row.iter().map(|cell| plain(&cell.text)).collect());
        }
        out
    }
}

/// Text that ends no cell.
fn plain(text: &str) -> String {
    text.replace('|', "\\|").replace('\n', " ")
}
