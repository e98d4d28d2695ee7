//! What a glTF file says, as far as it is about triangles: JSON, in a file of its own or in the first chunk of a GLB.
//!
//! Read here and not by the gltf crate, which refuses files for faults in what is not read (materials, animation, a texture
//! without an image, a scene without nodes) and whose readers panic where an offset does not fit.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde_json::Value;

use super::lines::without_mark;
use crate::Error;
use crate::quote::quoted;

#[derive(Deserialize, Default)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct Root {
    asset: BTreeMap<String, Value>,
    pub(super) accessors: Vec<Accessor>,
    pub(super) buffer_views: Vec<BufferView>,
    pub(super) buffers: Vec<Buffer>,
    pub(super) meshes: Vec<MeshJson>,
    pub(super) nodes: Vec<Node>,
    pub(super) skins: Vec<Skin>,
    pub(super) scenes: Vec<SceneJson>,
    pub(super) scene: Option<usize>,
    pub(super) extensions_required: Vec<String>,
}

#[derive(Deserialize, Default)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct Accessor {
    pub(super) buffer_view: Option<usize>,
    pub(super) byte_offset: usize,
    pub(super) component_type: u32,
    pub(super) normalized: bool,
    pub(super) count: usize,
    #[serde(rename = "type")]
    pub(super) shape: String,
    pub(super) sparse: Option<Sparse>,
}

#[derive(Deserialize)]
pub(super) struct Sparse {
    pub(super) count: usize,
    pub(super) indices: SparsePart,
    pub(super) values: SparsePart,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct SparsePart {
    pub(super) buffer_view: usize,
    #[serde(default)]
    pub(super) byte_offset: usize,
    #[serde(default)]
    pub(super) component_type: u32,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct BufferView {
    pub(super) buffer: usize,
    #[serde(default)]
    pub(super) byte_offset: usize,
    pub(super) byte_length: usize,
    pub(super) byte_stride: Option<usize>,
    #[serde(default)]
    pub(super) extensions: BTreeMap<String, Value>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Buffer {
    pub(super) uri: Option<String>,
    pub(super) byte_length: usize,
}

#[derive(Deserialize)]
pub(super) struct MeshJson {
    pub(super) primitives: Vec<PrimitiveJson>,
    #[serde(default)]
    pub(super) weights: Vec<f64>,
}

#[derive(Deserialize)]
pub(super) struct PrimitiveJson {
    pub(super) attributes: BTreeMap<String, usize>,
    pub(super) indices: Option<usize>,
    pub(super) mode: Option<u32>,
    #[serde(default)]
    pub(super) targets: Vec<BTreeMap<String, usize>>,
    #[serde(default)]
    pub(super) extensions: BTreeMap<String, Value>,
}

#[derive(Deserialize, Default)]
#[serde(default)]
pub(super) struct Node {
    pub(super) children: Vec<usize>,
    pub(super) mesh: Option<usize>,
    pub(super) skin: Option<usize>,
    pub(super) matrix: Option<[f64; 16]>,
    pub(super) translation: Option<[f64; 3]>,
    pub(super) rotation: Option<[f64; 4]>,
    pub(super) scale: Option<[f64; 3]>,
    pub(super) weights: Option<Vec<f64>>,
    pub(super) extensions: BTreeMap<String, Value>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Skin {
    pub(super) joints: Vec<usize>,
    pub(super) inverse_bind_matrices: Option<usize>,
}

#[derive(Deserialize)]
pub(super) struct SceneJson {
    #[serde(default)]
    pub(super) nodes: Vec<usize>,
}

/// Extensions that move, add or remove triangles, and are not read, with what does without them.
const NOT_READ: [(&str, &str); 4] = [
    (DRACO, "write it without Draco compression"),
    (MESHOPT, "write it without meshopt compression"),
    ("KHR_meshopt_compression", "write it without meshopt compression"),
    ("MSFT_lod", "write one level of detail"),
];
pub(super) const DRACO: &str = "KHR_draco_mesh_compression";
pub(super) const MESHOPT: &str = "EXT_meshopt_compression";

/// What is read of JSON that is no [`Root`], to tell an old file from a broken one.
#[derive(Deserialize)]
struct AssetOnly {
    asset: BTreeMap<String, Value>,
}

/// The JSON, and the binary chunk of a GLB.
pub(super) fn read<'a>(file: &str, bytes: &'a [u8]) -> Result<(Root, Option<&'a [u8]>), Error> {
    let expected = "give a whole glTF 2.0 or GLB file";
    let bad = |what: String| Error::bad(file, "the file", what, expected);
    let (json, binary) = if bytes.starts_with(b"glTF") {
        chunks(bytes).map_err(|what| bad(what.to_owned()))?
    } else {
        (without_mark(bytes), None)
    };
    let current = |asset: &BTreeMap<String, Value>| match asset.get("version") {
        Some(Value::String(version)) if !version.starts_with("2.") => {
            let what = format!("it is glTF {}", quoted(version).trim_matches('`'));
            Err(Error::bad(file, "asset.version", what, "convert it to glTF 2.0"))
        }
        _ => Ok(()),
    };
    let root: Root = serde_json::from_slice(json).map_err(|e| {
        let old = serde_json::from_slice::<AssetOnly>(json).ok().and_then(|only| current(&only.asset).err());
        old.unwrap_or_else(|| bad(format!("its JSON is none that is read: {e}")))
    })?;
    current(&root.asset)?;
    for name in &root.extensions_required {
        if let Some((name, remedy)) = NOT_READ.iter().find(|(known, _)| known == name) {
            return Err(Error::bad(file, "extensionsRequired", format!("{name} is not read"), *remedy));
        }
    }
    Ok((root, binary))
}

/// The chunks of a GLB: JSON first, then maybe the binary one.
fn chunks(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), &'static str> {
    const BROKEN: &str = "the GLB header is broken off or announces less than itself";
    let word = |at: usize| Some(u32::from_le_bytes(bytes.get(at..at + 4)?.try_into().ok()?));
    match word(4) {
        Some(2) => {}
        Some(1) => return Err("it is a GLB of glTF 1.0"),
        _ => return Err(BROKEN),
    }
    let length = word(8).map(|length| length as usize).filter(|&length| length >= 20).ok_or(BROKEN)?;
    let bytes = bytes.get(..length).ok_or("the GLB is broken off: it announces more bytes than there are")?;
    let chunk = |at: usize, kind: &[u8; 4]| {
        let size = u32::from_le_bytes(bytes.get(at..at + 4)?.try_into().ok()?) as usize;
        (bytes.get(at + 4..at + 8)? == kind).then_some(())?;
        bytes.get(at + 8..)?.get(..size)
    };
    let json = chunk(12, b"JSON").ok_or("the GLB has no whole chunk of JSON")?;
    let at = 20 + json.len();
    match bytes.len() {
        end if end < at + 8 => Ok((json, None)),
        _ => match chunk(at, b"BIN\0") {
            Some(binary) => Ok((json, Some(binary))),
            None if bytes.get(at + 4..at + 8) == Some(b"BIN\0") => Err("the GLB's binary chunk is broken off"),
            None => Ok((json, None)),
        },
    }
}
