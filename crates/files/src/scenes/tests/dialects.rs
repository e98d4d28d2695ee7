//! The same mesh in every dialect that the field writes reads back to the same triangles, bit for bit.

use std::fmt::Write as _;

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use proptest::prelude::*;

use super::{assert_same, config, mesh, parse, unwelded, write};
use rayproof_scene::Mesh;

/// What a writer of files decides, one decision after the other.
struct Whim<'a>(std::iter::Cycle<std::slice::Iter<'a, u8>>);

impl<'a> Whim<'a> {
    fn new(bytes: &'a [u8]) -> Self {
        Self(bytes.iter().cycle())
    }

    fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        from[usize::from(*self.0.next().unwrap()) % from.len()]
    }

    fn maybe(&mut self) -> bool {
        self.pick(&[false, true])
    }
}

fn lines_that_end(text: &str, end: &str, mark: bool) -> Vec<u8> {
    format!("{}{}", if mark { "\u{feff}" } else { "" }, text.replace('\n', end)).into_bytes()
}

fn obj(mesh: &Mesh, whim: &mut Whim<'_>) -> Vec<u8> {
    let mut text = String::new();
    let other = [
        "",
        "# f 1 2 3",
        "mtllib a.mtl",
        "o a thing",
        "g",
        "s off",
        "usemtl b",
        "vn 0 0 1",
        "vt .5 .5",
        "l 1 1",
        "p 1",
    ];
    for v in &mesh.vertices {
        writeln!(text, "{}", whim.pick(&other)).unwrap();
        let (space, more) = (whim.pick(&[" ", "\t", "  "]), whim.pick(&["", " 1.0", " .5 .25 1"]));
        let form = |x: f32| if whim.maybe() { format!("{x:e}") } else { format!("{x}") };
        writeln!(text, "v{space}{}{more}", v.to_array().map(form).join(space)).unwrap();
    }
    let count = i64::try_from(mesh.vertices.len()).unwrap();
    for t in &mesh.triangles {
        writeln!(text, "{}", whim.pick(&other)).unwrap();
        let tail = whim.pick(&["", "/1", "//1", "/1/1", "/-1/-1"]);
        let mut corner = |i: u32| if whim.maybe() { i64::from(i) - count } else { i64::from(i) + 1 };
        let corners = t.map(|i| format!("{}{tail}", corner(i)));
        writeln!(text, "f {}", corners.join(whim.pick(&[" ", "\t", " \\\n "]))).unwrap();
    }
    lines_that_end(&text, whim.pick(&["\n", "\r\n", "\r"]), whim.maybe())
}

fn ply(mesh: &Mesh, whim: &mut Whim<'_>) -> Vec<u8> {
    let format = whim.pick(&["ascii", "binary_little_endian", "binary_big_endian"]);
    let bytes = write::ply(mesh, format, whim.pick(&["float", "double"]));
    let at = bytes.windows(11).position(|w| w == b"end_header\n").unwrap() + 11;
    let header = std::str::from_utf8(&bytes[..at]).unwrap();
    let real = |name: &str| {
        header.replace("float ", name).replace("double ", if name == "float32 " { "float64 " } else { "double " })
    };
    let mut header = real(whim.pick(&["float ", "float32 "]));
    for more in ["comment f 1 2 3", "obj_info a", "comment"] {
        if whim.maybe() {
            header = header.replacen("element face", &format!("{more}\nelement face"), 1);
        }
    }
    let end = whim.pick(&["\n", "\r\n"]);
    let mut file = lines_that_end(&header, end, false);
    match format {
        "ascii" => {
            let payload = std::str::from_utf8(&bytes[at..]).unwrap();
            file.extend(lines_that_end(payload, whim.pick(&[end, "\n\n", " \n\t"]), false));
        }
        _ => file.extend(&bytes[at..]),
    }
    if whim.maybe() && format != "ascii" {
        file.extend(b"more");
    }
    file
}

fn stl(mesh: &Mesh, whim: &mut Whim<'_>) -> Vec<u8> {
    if whim.maybe() {
        let mut bytes = write::stl_binary(mesh, whim.pick(&["", "solid a\0", "COLOR=abcd"]));
        if whim.maybe() && !mesh.triangles.is_empty() {
            bytes.extend(b"\0more");
        }
        return bytes;
    }
    let mut text = write::stl_ascii(mesh);
    if whim.maybe() {
        text = text.replace("vertex", "VERTEX").replace("facet", "Facet").replace("solid", "SOLID");
    }
    if whim.maybe() {
        text = text.replace("loop\n", "loop ").replace("0 0 0\n", "0 0 0 ");
    }
    if whim.maybe() {
        text = text.replacen('\n', "\n# a comment\ncolor 1 0 0\n\n", 1);
    }
    match whim.pick(&[0, 1, 2]) {
        0 => {}
        1 => text.truncate(text.to_lowercase().rfind("endsolid").unwrap()),
        _ => text += "exported by hand\n",
    }
    lines_that_end(&text, whim.pick(&["\n", "\r\n", "\r"]), whim.maybe())
}

/// With its ending.
fn gltf(mesh: &Mesh, whim: &mut Whim<'_>) -> (&'static str, Vec<u8>) {
    let node =
        whim.pick(&["", r#", "name": "a", "extras": {"b": [1]}"#, r#", "rotation": [0, 0, 0, 1], "scale": [1, 1, 1]"#]);
    let root = [
        "",
        r#", "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 99}}}]"#,
        r#", "extensionsUsed": ["KHR_materials_unlit"], "extensionsRequired": ["KHR_materials_unlit"]"#,
        r#", "animations": [{"channels": 1}], "textures": [{}]"#,
    ];
    let (json, bin) = write::gltf(mesh, node, whim.pick(&["", r#", "mode": 4, "material": 7"#]), whim.pick(&root));
    let bytes = |json: &str| lines_that_end(json, "\n", false);
    let uri = match whim.pick(&[0, 1, 2, 3]) {
        0 => return ("glb", write::glb(&json, &bin)),
        1 => format!("data:application/octet-stream;base64,{}", BASE64_STANDARD.encode(&bin)),
        2 => format!("data:application/gltf-buffer;base64,{}", BASE64_STANDARD.encode(&bin).trim_end_matches('=')),
        _ => format!("data:,{}", bin.iter().fold(String::new(), |uri, byte| uri + &format!("%{byte:02X}"))),
    };
    let buffer = format!(r#""buffers": [{{"uri": "{uri}", "#);
    let mut file = if whim.maybe() { "\u{feff}".as_bytes().to_vec() } else { Vec::new() };
    file.extend(bytes(&json.replace(r#""buffers": [{"#, &buffer)));
    ("gltf", file)
}

proptest! {
    #![proptest_config(config(2000))]

    #[test]
    fn every_dialect_reads_back_to_the_same_triangles(mesh in mesh(), whims in prop::collection::vec(any::<u8>(), 1..64)) {
        let mut whim = Whim::new(&whims);
        assert_same(&parse("obj", obj(&mesh, &mut whim)).unwrap(), &mesh);
        assert_same(&parse("ply", ply(&mesh, &mut whim)).unwrap(), &mesh);
        assert_same(&parse("stl", stl(&mesh, &mut whim)).unwrap(), &unwelded(&mesh));
        // Zero may lose its sign among the products of a pose.
        let placed = |mesh: &Mesh| Mesh { vertices: mesh.vertices.iter().map(|&v| v + 0.0).collect(), ..mesh.clone() };
        let (ending, file) = gltf(&mesh, &mut whim);
        assert_same(&placed(&parse(ending, file).unwrap()), &placed(&mesh));
    }
}

#[test]
fn the_seeds_of_the_fuzz_targets_are_read() {
    let seeds = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/seeds");
    let mut read = 0;
    for ending in ["obj", "ply", "stl", "gltf", "glb"] {
        for seed in std::fs::read_dir(seeds.join(ending)).unwrap() {
            let path = seed.unwrap().path();
            assert!(!parse(ending, std::fs::read(&path).unwrap()).unwrap().triangles.is_empty(), "{}", path.display());
            read += 1;
        }
    }
    for format in ["npy", "csv", "parquet"] {
        for seed in std::fs::read_dir(seeds.join(format!("rays_{format}"))).unwrap() {
            let opened = crate::RayReader::open(&seed.unwrap().path(), None, crate::InvalidRays::Miss);
            match opened {
                Ok(mut rays) => assert!(rays.next_batch(&mut Vec::new(), 9).unwrap() > 0),
                Err(error) => assert!(cfg!(not(feature = "parquet")) && format == "parquet", "{error}"),
            }
            read += 1;
        }
    }
    assert_eq!(read, 17);
}
