//! The main job on both engines: a scene of spheres and two meshes, an OBJ and a GLB, and files that are equal to the byte.

use rayproof_oracle::families::meshes::{bumpy_sphere, torus};

use super::Folder;

/// A mesh as OBJ text.
fn obj(mesh: &rayproof::scene::Mesh) -> String {
    let vertices = mesh.vertices.iter().map(|v| format!("v {:?} {:?} {:?}\n", v.x, v.y, v.z));
    let faces = mesh.triangles.iter().map(|[a, b, c]| format!("f {} {} {}\n", a + 1, b + 1, c + 1));
    vertices.chain(faces).collect()
}

/// A mesh as a GLB file, moved, turned and stretched by its nodes.
fn glb(mesh: &rayproof::scene::Mesh) -> Vec<u8> {
    let positions: &[u8] = bytemuck::cast_slice(&mesh.vertices);
    let indices: &[u8] = bytemuck::cast_slice(&mesh.triangles);
    let (first, second) = (positions.len(), indices.len());
    let (vertices, corners) = (mesh.vertices.len(), mesh.triangles.len() * 3);
    let mut json = format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],
        "nodes":[{{"translation":[3,0,0.5],"children":[1]}},
                 {{"mesh":0,"scale":[1,2,1],"rotation":[0,0.38268343,0,0.92387953]}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],
        "buffers":[{{"byteLength":{}}}],
        "bufferViews":[{{"buffer":0,"byteLength":{first}}},{{"buffer":0,"byteOffset":{first},"byteLength":{second}}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":{vertices},"type":"VEC3",
                       "min":[-9,-9,-9],"max":[9,9,9]}},
                     {{"bufferView":1,"componentType":5125,"count":{corners},"type":"SCALAR"}}]}}"#,
        first + second
    )
    .into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut file = b"glTF\x02\0\0\0".to_vec();
    let chunk = |name: &[u8; 4], parts: &[&[u8]]| {
        let length = u32::try_from(parts.iter().map(|p| p.len()).sum::<usize>()).unwrap();
        [&length.to_le_bytes()[..], name, &parts.concat()].concat()
    };
    let chunks = [chunk(b"JSON", &[&json]), chunk(b"BIN\0", &[positions, indices])].concat();
    file.extend(u32::try_from(12 + chunks.len()).unwrap().to_le_bytes());
    file.extend(chunks);
    file
}

const SCENE: &str = r#"
[[geometry]]
mesh = "torus.obj"
[[geometry]]
spheres = [[0.0, 3.0, 0.0, 0.9], [-3.0, 0.0, 0.0, 1.2], [0.0, -1000002.0, 0.0, 1000000.0]]
[[geometry]]
mesh = "ball.glb"
[camera]
eye = [2, 4, 9]
target = [0.5, 0.5, 0]
up = [0, 1, 0]
fov_y = 45
"#;

fn folder() -> Folder {
    let folder = Folder::new();
    folder.write("torus.obj", obj(&torus(24, 12, 0.4)));
    folder.write("ball.glb", glb(&bumpy_sphere(16, 16, 7)));
    folder.write("scene.toml", SCENE);
    folder
}

/// Every query in every precision that answers it.
const QUESTIONS: [(&str, &str); 7] = [
    ("closest", "exact"),
    ("any", "exact"),
    ("count", "exact"),
    ("closest", "fast"),
    ("any", "fast"),
    ("closest", "classic"),
    ("any", "classic"),
];

#[test]
fn device_and_cpu_write_the_same_bytes() {
    let folder = folder();
    folder.run("rays scene.toml -o rays.csv --size 120x90").expect(0, &[]);
    folder.run("rays scene.toml -o rays.npy --kind incoherent --count 150000 --seed 3").expect(0, &[]);
    for rays in ["rays.csv", "rays.npy"] {
        for (query, precision) in QUESTIONS {
            for ending in ["csv", "npy"] {
                let line = |device: &str| {
                    let what = format!("--query {query} --precision {precision} --device {device}");
                    format!("intersect scene.toml {rays} -o {device}.{ending} {what}")
                };
                folder.run(&line("gpu")).expect(0, &["3 spheres", "3 geometries"]);
                folder.run(&line("cpu")).expect(0, &["CPU engine"]);
                let (device, cpu) = (folder.read(&format!("gpu.{ending}")), folder.read(&format!("cpu.{ending}")));
                assert!(device == cpu, "{rays}, {query}, {precision}, {ending}: the files differ");
            }
        }
    }
}

#[test]
fn the_oracle_agrees_with_both() {
    let folder = folder();
    folder.run("rays scene.toml -o rays.npy --kind incoherent --count 20000 --seed 4").expect(0, &[]);
    for device in ["gpu", "cpu"] {
        for query in ["closest", "any", "count"] {
            let line =
                format!("intersect scene.toml rays.npy -o hits.npy --query {query} --device {device} --check 300");
            folder.run(&line).expect(0, &["300 are exact", "0 disagree"]);
        }
    }
}

#[test]
fn the_adapters_and_their_arithmetic_are_listed() {
    let ran = Folder::new().run("devices").expect(0, &[]);
    let listing = String::from_utf8(ran.stdout).unwrap();
    for part in
        ["NoContraction", "error of x + y      survives", "plain WGSL", "fma", "the precision exact: f32, then "]
    {
        assert!(listing.contains(part), "{part} is not in\n{listing}");
    }
}

#[test]
fn kernels_are_written_where_the_environment_says() {
    let folder = folder();
    folder.run("rays scene.toml -o rays.npy --size 8x6").expect(0, &[]);
    let run = |dump: &str| {
        let line = "intersect scene.toml rays.npy -o hits.npy --device gpu";
        let output = folder.command(line).env("RAYPROOF_DUMP", folder.path(dump)).output().unwrap();
        super::Ran::of(line, output)
    };
    run("made/for/it").expect(0, &[]);
    for name in ["first-closest-triangles-spheres-f32", "fingerprint", "trial-pair-of-f32"] {
        let text = folder.read(&format!("made/for/it/{name}.wgsl"));
        assert!(String::from_utf8(text).unwrap().contains("@compute"), "{name}");
        assert_eq!(folder.read(&format!("made/for/it/{name}.spv"))[..4], 0x0723_0203_u32.to_le_bytes(), "{name}");
    }
    run("scene.toml/no").expect(1, &["RAYPROOF_DUMP", "scene.toml/no"]);
}
