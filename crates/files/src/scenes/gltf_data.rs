//! The numbers behind the accessors of a glTF file, with every range checked.

use std::cell::OnceCell;
use std::path::Path;

use base64::Engine as _;
use base64::alphabet::STANDARD;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};

use super::gltf_json::{Accessor, MESHOPT, Root};
use crate::Error;
use crate::quote::quoted;

/// The buffers of a file, read when they are asked for.
pub(super) struct Data<'a> {
    path: &'a Path,
    file: &'a str,
    root: &'a Root,
    binary: Option<&'a [u8]>,
    buffers: Vec<OnceCell<Vec<u8>>>,
}

/// The types of components, by their numbers in OpenGL.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Component {
    const fn of(code: u32) -> Option<Self> {
        Some(match code {
            5120 => Self::I8,
            5121 => Self::U8,
            5122 => Self::I16,
            5123 => Self::U16,
            5125 => Self::U32,
            5126 => Self::F32,
            _ => return None,
        })
    }

    const fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }

    /// A value; where it is `normalized`, integers stand for -1 to 1.
    fn value(self, bytes: &[u8], normalized: bool) -> f64 {
        let word = |n: usize| bytes[..n].iter().rev().fold(0_u32, |word, &byte| word << 8 | u32::from(byte));
        let (value, most) = match self {
            Self::I8 => (f64::from(bytes[0].cast_signed()), 127.0),
            Self::U8 => (f64::from(bytes[0]), 255.0),
            Self::I16 => (f64::from(i16::from_le_bytes([bytes[0], bytes[1]])), 32767.0),
            Self::U16 => (f64::from(word(2)), 65535.0),
            Self::U32 => (f64::from(word(4)), f64::from(u32::MAX)),
            Self::F32 => return f64::from(f32::from_bits(word(4))),
        };
        if normalized { (value / most).max(-1.0) } else { value }
    }
}

impl<'a> Data<'a> {
    pub(super) fn new(path: &'a Path, file: &'a str, root: &'a Root, binary: Option<&'a [u8]>) -> Self {
        Self { path, file, root, binary, buffers: root.buffers.iter().map(|_| OnceCell::new()).collect() }
    }

    pub(super) fn bad(&self, place: impl Into<String>, what: impl Into<String>, expected: &str) -> Error {
        Error::bad(self.file, place, what, expected)
    }

    /// Whether an accessor's numbers are there.
    pub(super) fn has_view(&self, accessor: usize) -> bool {
        self.root
            .accessors
            .get(accessor)
            .is_some_and(|accessor| accessor.buffer_view.is_some() || accessor.sparse.is_some())
    }

    /// One of a list, by a number that the file gives.
    pub(super) fn get<'b, T>(&self, list: &'b [T], name: &str, index: usize) -> Result<&'b T, Error> {
        let out = || self.bad(name, format!("{index} is out of range"), &format!("there are {}", list.len()));
        list.get(index).ok_or_else(out)
    }

    /// The vectors of an accessor; `shape` is VEC3, SCALAR, .. and `N` how many numbers that is.
    pub(super) fn vectors<const N: usize>(&self, index: usize, shape: &str) -> Result<Vec<[f64; N]>, Error> {
        let accessor = self.get(&self.root.accessors, "accessor", index)?;
        let place = format!("accessor {index}");
        let component = Component::of(accessor.component_type).filter(|_| accessor.shape == shape);
        let component = component.ok_or_else(|| {
            let what = format!("it is {} of the component type {}", accessor.shape, accessor.component_type);
            self.bad(&place, what, &format!("give {shape} of a type from 5120 to 5126"))
        })?;
        let size = component.size();
        let vector = |bytes: &[u8]| -> [f64; N] {
            std::array::from_fn(|i| component.value(&bytes[i * size..], accessor.normalized))
        };
        let mut vectors = match accessor.buffer_view {
            Some(view) => {
                let (bytes, stride) = self.rows(&place, view, accessor.byte_offset, accessor.count, N * size)?;
                (0..accessor.count).map(|i| vector(&bytes[i * stride..])).collect()
            }
            None => self.zeros(&place, accessor)?,
        };
        if let Some(sparse) = &accessor.sparse {
            let ty = Component::of(sparse.indices.component_type)
                .filter(|ty| matches!(ty, Component::U8 | Component::U16 | Component::U32));
            let ty =
                ty.ok_or_else(|| self.bad(&place, "its sparse indices are not unsigned", "give indices as one"))?;
            let (indices, index_stride) =
                self.rows(&place, sparse.indices.buffer_view, sparse.indices.byte_offset, sparse.count, ty.size())?;
            let (values, stride) =
                self.rows(&place, sparse.values.buffer_view, sparse.values.byte_offset, sparse.count, N * size)?;
            for i in 0..sparse.count {
                let at = ty.value(&indices[i * index_stride..], false);
                #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "an unsigned integer")]
                let slot = vectors.get_mut(at as usize);
                let out = || self.bad(&place, format!("sparse index {at} is out of range"), "give one below the count");
                *slot.ok_or_else(out)? = vector(&values[i * stride..]);
            }
        }
        Ok(vectors)
    }

    /// What a sparse accessor without a view begins with.
    fn zeros<const N: usize>(&self, place: &str, accessor: &Accessor) -> Result<Vec<[f64; N]>, Error> {
        let sparse = accessor.sparse.as_ref();
        let there: usize = self.root.buffers.iter().map(|buffer| buffer.byte_length).fold(0, usize::saturating_add);
        // A header may claim anything: zeros are believed up to some multiple of what is there.
        match sparse {
            Some(_) if accessor.count <= there.saturating_mul(16) => Ok(vec![[0.0; N]; accessor.count]),
            Some(_) => {
                Err(self.bad(place, format!("it claims {} zeros", accessor.count), "give them in a buffer view"))
            }
            None => Err(self.bad(place, "it has no buffer view", "give its numbers")),
        }
    }

    /// Unsigned integers.
    pub(super) fn indices(&self, index: usize) -> Result<Vec<u32>, Error> {
        let accessor = self.get(&self.root.accessors, "accessor", index)?;
        if !matches!(accessor.component_type, 5121 | 5123 | 5125) || accessor.normalized {
            let what = "it is not a SCALAR of an unsigned type";
            return Err(self.bad(format!("accessor {index}"), what, "give indices as one"));
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "whole numbers in the range of u32"
        )]
        Ok(self.vectors::<1>(index, "SCALAR")?.into_iter().map(|[x]| x as u32).collect())
    }

    /// The bytes from the first of `count` rows on, and from one to the next.
    fn rows(
        &self,
        place: &str,
        view: usize,
        offset: usize,
        count: usize,
        size: usize,
    ) -> Result<(&[u8], usize), Error> {
        let place = || place.to_owned();
        let view = self.get(&self.root.buffer_views, "bufferView", view)?;
        // Where a file that is not compressed stands beside it, that is read.
        let stands_in = self.root.buffers.get(view.buffer).is_some_and(|buffer| buffer.uri.is_some());
        if view.extensions.contains_key(MESHOPT) && !stands_in && (view.buffer, self.binary.is_some()) != (0, true) {
            return Err(self.bad(place(), format!("{MESHOPT} is not read"), "write it without meshopt compression"));
        }
        let buffer = self.buffer(view.buffer)?;
        let stride = view.byte_stride.unwrap_or(size);
        let bytes = (|| {
            let bytes = buffer.get(view.byte_offset..)?.get(..view.byte_length)?;
            // Values that lie within each other would be as many as a file cares to claim.
            (stride >= size).then_some(())?;
            let last = count.saturating_sub(1).checked_mul(stride)?;
            bytes.get(offset..)?.get(..if count == 0 { 0 } else { last.checked_add(size)? })
        })();
        let expected =
            "give an offset, stride and count whose values lie within the buffer view, and a view within the buffer";
        Ok((bytes.ok_or_else(|| self.bad(place(), "it reaches beyond its buffer view", expected))?, stride))
    }

    fn buffer(&self, index: usize) -> Result<&[u8], Error> {
        let cell = self.get(&self.buffers, "buffer", index)?;
        if let Some(bytes) = cell.get() {
            return Ok(bytes);
        }
        let bytes = self.load(index)?;
        Ok(cell.get_or_init(|| bytes))
    }

    fn load(&self, index: usize) -> Result<Vec<u8>, Error> {
        let buffer = &self.root.buffers[index];
        let place = format!("buffer {index}");
        let expected = "give a relative path, a data URI or the binary chunk of a GLB";
        let mut bytes = match &buffer.uri {
            Some(uri) if uri.starts_with("data:") => inline(uri).map_err(|what| self.bad(&place, what, expected))?,
            Some(uri) if !uri.contains(':') => self.beside(&place, uri)?,
            Some(_) => return Err(self.bad(&place, "unsupported URI scheme", expected)),
            None if index == 0 => {
                let missing = || self.bad(&place, "there is no binary chunk for it", expected);
                self.binary.ok_or_else(missing)?.to_vec()
            }
            None => return Err(self.bad(&place, "there is no binary chunk left for it", expected)),
        };
        if buffer.uri.as_ref().is_none_or(|uri| uri.starts_with("data:")) {
            // Chunks are padded to whole words; those of some exporters are not, and announced as if they were.
            bytes.resize(bytes.len().next_multiple_of(4), 0);
        }
        if bytes.len() < buffer.byte_length {
            let what = format!("{} bytes are announced and {} are there", buffer.byte_length, bytes.len());
            return Err(self.bad(&place, what, "give the whole buffer"));
        }
        Ok(bytes)
    }

    /// A file beside this one: no other place, and nothing but a file.
    fn beside(&self, place: &str, uri: &str) -> Result<Vec<u8>, Error> {
        let relative = urlencoding::decode(uri)
            .map_err(|e| self.bad(place, format!("{}: {e}", quoted(uri)), "percent-encode the path as UTF-8"))?;
        let path = Path::new(&*relative);
        if path.has_root() || path.is_absolute() {
            return Err(self.bad(place, "its path is absolute", "give a path relative to this file"));
        }
        super::named(&relative).map_err(|what| self.bad(place, what, "give a path relative to this file"))?;
        let path = self.path.with_file_name("").join(path);
        match std::fs::metadata(&path) {
            Ok(metadata) if !metadata.is_file() => {
                Err(self.bad(place, format!("{} is no regular file", path.display()), "give a file"))
            }
            _ => super::read(&path),
        }
    }
}

/// The bytes of a data URI: `data:`, a media type that does not matter, and either `;base64,` or a comma before what says it.
fn inline(uri: &str) -> Result<Vec<u8>, String> {
    let (head, data) = uri.split_once(',').ok_or("the data URI has no comma")?;
    let data = urlencoding::decode_binary(data.as_bytes());
    if !head.ends_with(";base64") {
        return Ok(data.into_owned());
    }
    let padded_or_not = GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent);
    GeneralPurpose::new(&STANDARD, padded_or_not).decode(&*data).map_err(|e| e.to_string())
}
