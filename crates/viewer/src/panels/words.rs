//! Numbers as people read them, and lists with their labels before them.

use egui::{ComboBox, Response, Ui};

/// A whole number with its thousands apart.
pub(super) fn grouped(n: usize) -> String {
    let digits = n.to_string();
    let first = digits.len() % 3;
    let groups = digits.as_bytes()[first..].chunks(3).map(String::from_utf8_lossy);
    let head = (first > 0).then(|| digits[..first].into());
    head.into_iter().chain(groups).collect::<Vec<_>>().join(",")
}

/// So many of a thing.
pub(super) fn counted(n: usize, thing: &str) -> String {
    format!("{} {thing}{}", grouped(n), if n == 1 { "" } else { "s" })
}

/// A number of ULP, which may be beyond counting.
pub(super) fn many(ulps: u64) -> String {
    match ulps {
        0..1_000_000 => grouped(usize::try_from(ulps).unwrap_or(usize::MAX)),
        _ => format!("{:.1e}", ulps as f64),
    }
}

/// A coordinate, in few digits whatever its size.
pub(super) fn short(x: f32) -> String {
    if x == 0.0 || (1e-3..1e5).contains(&x.abs()) { format!("{x:.4}") } else { format!("{x:.3e}") }
}

/// A list to choose from, its label before it.
pub(super) fn list(ui: &mut Ui, label: &str, chosen: &str, entries: impl FnOnce(&mut Ui)) -> Response {
    ui.horizontal(|ui| {
        let name = ui.label(label);
        let list = ComboBox::from_id_salt(label).selected_text(chosen).height(400.0);
        list.show_ui(ui, entries).response.labelled_by(name.id)
    })
    .inner
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thousands_stand_apart() {
        let all = [0, 12, 999, 1000, 123_456, 1_234_567].map(grouped);
        assert_eq!(all, ["0", "12", "999", "1,000", "123,456", "1,234,567"]);
        assert_eq!([many(1234), many(2_500_000)], ["1,234", "2.5e6"]);
        assert_eq!([counted(1, "sphere"), counted(0, "sphere")], ["1 sphere", "0 spheres"]);
        assert_eq!([0.0, -2.5, 1e38, 1e-9].map(short), ["0.0000", "-2.5000", "1.000e38", "1.000e-9"]);
    }
}
