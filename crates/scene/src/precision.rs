use std::str::FromStr;

/// How hits are computed: what `--precision` takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Precision {
    /// The quadratic as schoolbooks have it, with both its cancellations, in `f32`; triangles as in `Classic`. Here to be seen
    /// failing.
    Textbook,
    /// The two formulas by the book in `f32`: the baseline that the report measures.
    Classic,
    /// `f32`, the best-conditioned single-precision form of each.
    Fast,
    /// The formulas of `Fast` in pairs of `f32`, rounded at the end: for devices without `f64`. No promise.
    Pair,
    /// The formulas of `Fast` in `f64`, rounded at the end. No promise.
    Double,
    /// Exact arithmetic's answer, rounded once: certificates in `f32`, and wider arithmetic for what they leave open.
    #[default]
    Exact,
}

impl Precision {
    /// Every precision, from the plainest to the best.
    pub const ALL: [Self; 6] = [Self::Textbook, Self::Classic, Self::Fast, Self::Pair, Self::Double, Self::Exact];

    /// Its name on the command line and in reports; [`FromStr`] reads it back.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Textbook => "textbook",
            Self::Classic => "classic",
            Self::Fast => "fast",
            Self::Pair => "pair",
            Self::Double => "double",
            Self::Exact => "exact",
        }
    }
}

/// A word that names no precision.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("\"{0}\" names no precision; give textbook, classic, fast, pair, double or exact")]
pub struct NotAPrecision(String);

impl FromStr for Precision {
    type Err = NotAPrecision;

    fn from_str(word: &str) -> Result<Self, NotAPrecision> {
        let named = Self::ALL.into_iter().find(|precision| precision.name() == word);
        named.ok_or_else(|| NotAPrecision(word.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_read_back_and_nothing_else_does() {
        for precision in Precision::ALL {
            assert_eq!(precision.name().parse(), Ok(precision));
        }
        let refused = "Exact".parse::<Precision>().map_err(|e| e.to_string());
        assert!(refused.is_err_and(|message| message.contains("\"Exact\"") && message.contains("or exact")));
    }
}
