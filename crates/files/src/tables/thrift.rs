//! A walk over Thrift's compact encoding, in which Parquet writes what it says of itself.
//!
//! The parquet crate reserves room for as many elements as a list says it has, before it looks for them: a file of two thousand
//! bytes asks for gigabytes. This walk goes first, keeps nothing, and ends at a claim that the bytes cannot hold.

/// How deep structures may lie in one another; those of Parquet's footer lie six deep.
const DEEPEST: usize = 32;

/// Goes over one structure; `tell` hears each integer with the numbers of the fields that lead to it (an element of a list has its
/// list's). Returns how many bytes the structure takes.
///
/// `None` where the bytes end within it, claim what they cannot hold, or are no such encoding.
pub(super) fn walk(bytes: &[u8], tell: impl FnMut(&[i16], i64)) -> Option<usize> {
    let mut walk = Walk { rest: bytes, path: Vec::new(), tell };
    walk.structure()?;
    Some(bytes.len() - walk.rest.len())
}

struct Walk<'a, F> {
    rest: &'a [u8],
    path: Vec<i16>,
    tell: F,
}

impl<F: FnMut(&[i16], i64)> Walk<'_, F> {
    fn structure(&mut self) -> Option<()> {
        if self.path.len() >= DEEPEST {
            return None;
        }
        let mut field = 0_i16;
        loop {
            let head = self.byte()?;
            let kind = head & 15;
            if kind == 0 {
                return Some(());
            }
            field = match head >> 4 {
                0 => i16::try_from(self.integer()?).ok()?,
                step => field.checked_add(i16::from(step))?,
            };
            self.path.push(field);
            // A truth is in its kind.
            if kind > 2 {
                self.value(kind)?;
            }
            self.path.pop();
        }
    }

    fn value(&mut self, kind: u8) -> Option<()> {
        match kind {
            1..=3 => self.skip(1),
            4..=6 => {
                let value = self.integer()?;
                (self.tell)(&self.path, value);
                Some(())
            }
            7 => self.skip(8),
            8 => {
                let length = self.length()?;
                self.skip(length)
            }
            9 | 10 => {
                let head = self.byte()?;
                let count = if head >> 4 == 15 { self.length()? } else { usize::from(head >> 4) };
                self.elements(count, &[head & 15])
            }
            11 => match self.length()? {
                0 => Some(()),
                count => {
                    let kinds = self.byte()?;
                    self.elements(count, &[kinds >> 4, kinds & 15])
                }
            },
            12 => self.structure(),
            13 => self.skip(16),
            _ => None,
        }
    }

    /// Elements take a byte each at least.
    fn elements(&mut self, count: usize, kinds: &[u8]) -> Option<()> {
        if count > self.rest.len() {
            return None;
        }
        (0..count).try_for_each(|_| kinds.iter().try_for_each(|&kind| self.value(kind)))
    }

    fn byte(&mut self) -> Option<u8> {
        let (&byte, rest) = self.rest.split_first()?;
        self.rest = rest;
        Some(byte)
    }

    fn skip(&mut self, bytes: usize) -> Option<()> {
        self.rest = self.rest.get(bytes..)?;
        Some(())
    }

    fn length(&mut self) -> Option<usize> {
        self.varint()?.try_into().ok()
    }

    fn integer(&mut self) -> Option<i64> {
        let folded = self.varint()?;
        Some((folded >> 1).cast_signed() ^ -(folded & 1).cast_signed())
    }

    fn varint(&mut self) -> Option<u64> {
        let mut value = 0;
        for shift in (0..64).step_by(7) {
            let byte = self.byte()?;
            value |= u64::from(byte & 127) << shift;
            if byte < 128 {
                return Some(value);
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::walk;

    #[test]
    fn integers_are_told_with_the_fields_that_lead_to_them() {
        // {1: 150, 2: true, 4: [3, -3], 20: {1: "ab", 2: 1.0, 3: {5: {7: i64 2}}}, 21: {}}
        let mut bytes = vec![0x15, 0xac, 0x02, 0x11, 0x29, 0x25, 6, 5, 0x0c, 40, 0x18, 2, b'a', b'b', 0x17];
        bytes.extend(1.0_f64.to_le_bytes());
        bytes.extend([0x1b, 1, 0x5c, 10, 0x76, 4, 0, 0, 0x1c, 0, 0]);
        let mut told = Vec::new();
        assert_eq!(
            walk(&[&bytes[..], b"after"].concat(), |path, value| told.push((path.to_vec(), value))),
            Some(bytes.len())
        );
        let want: [(&[i16], i64); 5] = [(&[1], 150), (&[4], 3), (&[4], -3), (&[20, 3], 5), (&[20, 3, 7], 2)];
        assert_eq!(told, want.map(|(path, value)| (path.to_vec(), value)));
        for end in 0..bytes.len() {
            assert_eq!(walk(&bytes[..end], |_, _| ()), None, "cut to {end}");
        }
    }

    #[test]
    fn claims_beyond_the_bytes_and_endless_depth_end_the_walk() {
        // A list of 2^31 structures, a string of 2^40 bytes, a list of bools.
        assert_eq!(walk(&[0x19, 0xfc, 0xff, 0xff, 0xff, 0xff, 7, 0, 0], |_, _| ()), None);
        assert_eq!(walk(&[0x18, 0x80, 0x80, 0x80, 0x80, 0x80, 0x20, 0], |_, _| ()), None);
        assert_eq!(walk(&[0x19, 0x31, 1, 2, 1, 0], |_, _| ()), Some(6));
        assert_eq!(walk(&[0x1c; 100_000], |_, _| ()), None);
        assert_eq!(walk(&[0x1e, 0], |_, _| ()), None);
    }
}
