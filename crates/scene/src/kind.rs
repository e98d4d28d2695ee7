/// A kind of primitive.
///
/// Whatever depends on the kind of a primitive matches on this, or on [`Primitive`](crate::Primitive) or
/// [`Geometry`](crate::Geometry), without a wildcard: a new kind is added here, and the compiler names the rest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Kind {
    /// A triangle.
    Triangle,
    /// A sphere.
    Sphere,
}

impl Kind {
    /// Every kind; each stands at the place of its number.
    pub const ALL: [Self; 2] = [Self::Triangle, Self::Sphere];

    /// Its name, and that of what kernels know of it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Triangle => "triangle",
            Self::Sphere => "sphere",
        }
    }
}

/// A set of kinds: those of a scene's primitives, say.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Kinds(u8);

impl Kinds {
    /// Every set that is not empty.
    pub fn all() -> impl Iterator<Item = Self> {
        (1..1 << Kind::ALL.len()).map(Self)
    }

    /// Whether it holds a kind.
    #[must_use]
    pub const fn contains(self, kind: Kind) -> bool {
        self.0 >> kind as u8 & 1 == 1
    }

    /// The kinds in it, in their order.
    pub fn iter(self) -> impl Iterator<Item = Kind> {
        Kind::ALL.into_iter().filter(move |&kind| self.contains(kind))
    }

    /// The kind in it where there is but one.
    #[must_use]
    pub fn only(self) -> Option<Kind> {
        self.iter().next().filter(|_| self.0.is_power_of_two())
    }
}

impl FromIterator<Kind> for Kinds {
    fn from_iter<I: IntoIterator<Item = Kind>>(kinds: I) -> Self {
        Self(kinds.into_iter().fold(0, |set, kind| set | 1 << kind as u8))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_stand_at_their_numbers_and_sets_hold_what_was_put_in() {
        for (number, kind) in Kind::ALL.into_iter().enumerate() {
            assert_eq!(kind as usize, number);
            let alone = Kinds::from_iter([kind, kind]);
            assert_eq!((alone.only(), alone.contains(kind)), (Some(kind), true));
            assert!(!Kinds::default().contains(kind));
        }
        assert_eq!(Kinds::from_iter(Kind::ALL).only(), None);
        assert_eq!(Kinds::default().only(), None);
        assert_eq!(Kinds::all().count(), (1 << Kind::ALL.len()) - 1);
        assert!(Kinds::all().all(|kinds| kinds == kinds.iter().collect()));
    }
}
