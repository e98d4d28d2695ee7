//! The JSON of a glTF file and the bytes behind its accessors, with every range checked: the gltf crate's own readers
//! panic where an offset, a count or a type does not fit.

use std::path::Path;

use base64::Engine as _;
use base64::alphabet::STANDARD;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use gltf::accessor::{Accessor, DataType, Dimensions};
use gltf::buffer::Source;
use gltf::json::validation::{Error as Fault, Validate};
use gltf::{Document, Gltf};

use crate::{BadInput, Error};

/// Extensions that a file may require without a change to its triangles.
const NO_SURFACE: [&str; 3] = ["\"KHR_materials_", "\"KHR_texture_", "\"KHR_lights_"];

/// The validated document, and the binary chunk of a GLB.
pub(super) fn document(file: &str, bytes: &[u8]) -> Result<(Document, Option<Vec<u8>>), Error> {
    let bad = |what: String| Error::bad(file, "the file", what, "give a whole glTF 2.0 or GLB file");
    // The gltf crate subtracts the header's 12 bytes from the length that a GLB announces.
    if bytes.starts_with(b"glTF") {
        let length = bytes.get(8..12).and_then(|b| b.try_into().ok()).map(u32::from_le_bytes);
        if length.is_none_or(|length| length < 12) {
            return Err(bad("the GLB header is broken off or announces less than itself".into()));
        }
    }
    let Gltf { document, blob } = Gltf::from_slice_without_validation(bytes).map_err(|e| bad(e.to_string()))?;
    let root = document.as_json();
    // The validation itself looks these up.
    let primitives = root.meshes.iter().flat_map(|mesh| &mesh.primitives);
    let accessors = primitives.flat_map(|primitive| primitive.attributes.values());
    if let Some(index) = accessors.map(|index| index.value()).find(|&index| index >= root.accessors.len()) {
        return Err(bad(format!("accessor {index} is out of range")));
    }
    let mut faults = Vec::new();
    root.validate(root, gltf::json::Path::new, &mut |path, fault| faults.push((path().0, fault)));
    faults.retain(|(path, fault)| match fault {
        Fault::Unsupported => !NO_SURFACE.iter().any(|name| path.contains(name)),
        // The bounds of positions, which many exporters leave out, are not used.
        _ => !(path.ends_with(".min") || path.ends_with(".max")),
    });
    match faults.first() {
        Some((path, fault)) => Err(Error::Bad(Box::new(BadInput {
            file: file.into(),
            place: path.clone(),
            what: fault.to_string(),
            more: faults.len() - 1,
            expected: "give valid glTF 2.0 that requires no extension but for materials, textures and lights".into(),
        }))),
        None => Ok((document, blob)),
    }
}

/// The bytes of a data URI: `data:`, a media type that does not matter, `;base64,` and what says it.
fn inline(uri: &str) -> Result<Vec<u8>, String> {
    let data = uri.strip_prefix("data:").ok_or("unsupported URI scheme")?;
    let data = data.split_once(";base64,").map_or(data, |(_, data)| data);
    let padded_or_not = GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent);
    GeneralPurpose::new(&STANDARD, padded_or_not).decode(data).map_err(|e| e.to_string())
}

/// The buffers of a document.
pub(super) struct Data<'a> {
    file: &'a str,
    buffers: Vec<Vec<u8>>,
}

impl<'a> Data<'a> {
    pub(super) fn load(
        path: &Path,
        file: &'a str,
        document: &Document,
        mut blob: Option<Vec<u8>>,
    ) -> Result<Self, Error> {
        let mut data = Self { file, buffers: Vec::new() };
        for buffer in document.buffers() {
            let place = format!("buffer {}", buffer.index());
            let bytes = match buffer.source() {
                Source::Uri(uri) if !uri.contains(':') => {
                    let relative = urlencoding::decode(uri)
                        .map_err(|e| data.bad(&place, format!("`{uri}`: {e}"), "percent-encode the path as UTF-8"))?;
                    super::read(&path.with_file_name("").join(&*relative))?
                }
                source => {
                    let embedded = match source {
                        Source::Uri(uri) => inline(uri),
                        Source::Bin => blob.take().ok_or_else(|| "there is no binary chunk left for it".to_owned()),
                    };
                    let expected = "give a relative path, a base64 data URI or the binary chunk of a GLB";
                    let mut bytes = embedded.map_err(|what| data.bad(&place, what, expected))?;
                    // Chunks are padded to whole words; those of some exporters are not, and announced as if they were.
                    bytes.resize(bytes.len().next_multiple_of(4), 0);
                    bytes
                }
            };
            if bytes.len() < buffer.length() {
                let what = format!("{} bytes are announced and {} are there", buffer.length(), bytes.len());
                return Err(data.bad(&place, what, "give the whole buffer"));
            }
            data.buffers.push(bytes);
        }
        Ok(data)
    }

    pub(super) fn bad(&self, place: &str, what: impl Into<String>, expected: &str) -> Error {
        Error::bad(self.file, place, what, expected)
    }

    pub(super) fn positions(&self, accessor: &Accessor<'_>) -> Result<impl Iterator<Item = [f32; 3]>, Error> {
        if (accessor.dimensions(), accessor.data_type()) != (Dimensions::Vec3, DataType::F32) {
            return Err(self.bad_accessor(accessor, "it is not a VEC3 of FLOAT", "give positions as VEC3 of FLOAT"));
        }
        let slots = self.slots(accessor)?;
        Ok(slots.map(|slot| bytemuck::pod_read_unaligned::<[[u8; 4]; 3]>(slot).map(f32::from_le_bytes)))
    }

    pub(super) fn indices(&self, accessor: &Accessor<'_>) -> Result<impl Iterator<Item = u32>, Error> {
        let unsigned = matches!(accessor.data_type(), DataType::U8 | DataType::U16 | DataType::U32);
        if accessor.dimensions() != Dimensions::Scalar || !unsigned {
            return Err(self.bad_accessor(accessor, "it is not a SCALAR of an unsigned type", "give indices as one"));
        }
        // Little-endian, so the bytes that are not there are zeros at the end.
        let widen = |slot: &[u8]| slot.iter().rev().fold(0, |index, &byte| index << 8 | u32::from(byte));
        Ok(self.slots(accessor)?.map(widen))
    }

    fn bad_accessor(&self, accessor: &Accessor<'_>, what: &str, expected: &str) -> Error {
        self.bad(&format!("accessor {}", accessor.index()), what, expected)
    }

    /// The bytes of each value.
    fn slots(&self, accessor: &Accessor<'_>) -> Result<impl Iterator<Item = &[u8]>, Error> {
        let view = accessor.view().filter(|_| accessor.sparse().is_none());
        let view =
            view.ok_or_else(|| self.bad_accessor(accessor, "it is sparse", "write sparse accessors out in full"))?;
        let (size, count) = (accessor.size(), accessor.count());
        let stride = view.stride().unwrap_or(size);
        let bytes = (|| {
            let bytes = self.buffers.get(view.buffer().index())?.get(view.offset()..)?.get(..view.length())?;
            let last = count.saturating_sub(1).checked_mul(stride)?;
            bytes.get(accessor.offset()..)?.get(..if count == 0 { 0 } else { last.checked_add(size)? })
        })();
        let expected =
            "give an offset, stride and count whose values lie within the buffer view, and a view within the buffer";
        let bytes = bytes.ok_or_else(|| self.bad_accessor(accessor, "it reaches beyond its buffer view", expected))?;
        Ok((0..count).map(move |i| &bytes[i * stride..][..size]))
    }
}
