//! What goes in and comes out, in every format, against answers worked out by hand.

use npyz::NpyFile;

use super::{Folder, HITS, Hit, bytes, csv_hits, npy, npy_data, npy_rays};

#[derive(npyz::Deserialize, Debug, PartialEq)]
struct Row {
    t: f32,
    u: f32,
    v: f32,
    geometry: u32,
    primitive: u32,
}

#[derive(npyz::Deserialize, Debug, PartialEq)]
struct Flag {
    hit: u8,
}

/// The rows of an `.npy` file of hits, by another reader, and the file's dtype.
fn npy_hits(file: &[u8]) -> (String, Vec<Hit>) {
    let file = NpyFile::new(file).unwrap();
    let dtype = file.header().dtype().descr();
    let rows = file.data::<Row>().unwrap().map(|row| row.unwrap());
    (dtype, rows.map(|r| (r.t, r.u, r.v, r.geometry, r.primitive)).collect())
}

#[test]
fn closest_hits_by_hand() {
    let folder = Folder::with_scene();
    for precision in ["fast", "classic"] {
        for output in ["hits.csv", "hits.npy"] {
            let line = format!("intersect scene.toml rays.csv -o {output} --device cpu --precision {precision}");
            folder.run(&line).expect(0, &["CPU", "5", "4 hit"]);
        }
        assert_eq!(csv_hits(&folder.read("hits.csv")), HITS);
        let (dtype, rows) = npy_hits(&folder.read("hits.npy"));
        assert_eq!(dtype, "[('t', '<f4'), ('u', '<f4'), ('v', '<f4'), ('geometry', '<u4'), ('primitive', '<u4'), ]");
        assert_eq!(rows, HITS);
    }
}

#[test]
fn any_hits_by_hand() {
    let folder = Folder::with_scene();
    folder.run("intersect scene.toml rays.csv -o hits.csv --query any --device cpu").expect(0, &["4 hit"]);
    assert_eq!(folder.read("hits.csv"), b"hit\n1\n1\n1\n0\n1\n");
    folder.run("intersect scene.toml rays.csv -o hits.npy --query any --device cpu").expect(0, &[]);
    let file = folder.read("hits.npy");
    let file = NpyFile::new(&file[..]).unwrap();
    assert_eq!(file.header().dtype().descr(), "[('hit', '|u1'), ]");
    let flags: Vec<u8> = file.data::<Flag>().unwrap().map(|row| row.unwrap().hit).collect();
    assert_eq!(flags, [1, 1, 1, 0, 1]);
}

#[test]
fn a_mesh_is_geometry_0_and_ranges_are_kept() {
    let folder = Folder::with_scene();
    let ray = |t_min: f32, t_max: f32| [0.75, 0.25, 1.0, 0.0, 0.0, -1.0, t_min, t_max];
    let inf = f32::INFINITY;
    let rows = [ray(0.0, inf), ray(1.0, 1.0), ray(1.0001, inf), ray(-inf, 0.9999), ray(-inf, inf)];
    folder.write("rays.npy", npy("'<f4'", "(5, 8)", &bytes(rows.as_flattened())));
    folder.run("intersect square.obj rays.npy -o hits.csv --device cpu").expect(0, &[]);
    assert_eq!(csv_hits(&folder.read("hits.csv")), [HITS[0], HITS[0], HITS[3], HITS[3], HITS[0]]);
}

#[test]
fn float64_rays_are_rounded_and_the_summary_says_how_many() {
    let folder = Folder::with_scene();
    let row = [0.75, 0.25, 1.0, 0.0, 1e-60, -1.0 - 1e-12_f64];
    let data: Vec<u8> = row.iter().flat_map(|x| x.to_le_bytes()).collect();
    folder.write("rays.npy", npy("'<f8'", "(1, 6)", &data));
    let ran = folder.run("intersect scene.toml rays.npy -o hits.csv --device cpu --json").expect(0, &["2 values"]);
    assert_eq!(ran.json()["rounded_values"], 2);
    assert_eq!(csv_hits(&folder.read("hits.csv")), HITS[..1]);
}

#[test]
fn empty_is_not_bad() {
    let folder = Folder::with_scene();
    folder.write("none.npy", npy_rays(&[]));
    folder.write("none.csv", "ox,oy,oz,dx,dy,dz\n");
    folder.write("void.toml", "[[geometry]]\nspheres = []\n");
    folder.write("void.obj", "");
    for rays in ["none.npy", "none.csv"] {
        let ran = folder.run(&format!("intersect scene.toml {rays} -o hits.npy --json --check 5 --device cpu"));
        let json = ran.expect(0, &[]).json();
        assert_eq!((&json["rays"], &json["checked"], &json["rays_per_second"]), (&0.into(), &0.into(), &0.0.into()));
        assert_eq!(npy_hits(&folder.read("hits.npy")).1, []);
        folder.run(&format!("intersect scene.toml {rays} -o hits.csv --query any --device cpu")).expect(0, &[]);
        assert_eq!(folder.read("hits.csv"), b"hit\n");
    }
    for scene in ["void.toml", "void.obj"] {
        let note = format!("note    {scene}: the scene holds nothing to hit");
        folder
            .run(&format!("intersect {scene} rays.csv -o hits.csv --check 5 --device cpu"))
            .expect(0, &["0 hit", &note]);
        assert_eq!(csv_hits(&folder.read("hits.csv")), [HITS[3]; 5]);
        folder.run(&format!("render {scene} -o {scene}.png --size 8x8 --device cpu")).expect(0, &[&note]);
        folder.run(&format!("rays {scene} -o r.npy --kind incoherent --count 10")).expect(0, &[&note]);
        folder.run(&format!("rays {scene} -o r.npy --kind diffuse --count 10")).expect(5, &["none of"]);
        folder.run(&format!("rays {scene} -o r.npy --kind diffuse --size 8x8")).expect(0, &[]);
    }
}

#[test]
fn shards_joined_are_the_whole_by_bytes() {
    let folder = Folder::with_scene();
    folder.run("rays scene.toml -o rays.npy --kind incoherent --count 1001 --seed 3").expect(0, &[]);
    folder.run("rays scene.toml -o rays.csv --kind incoherent --count 1001 --seed 3").expect(0, &[]);
    for rays in ["rays.npy", "rays.csv"] {
        folder.run(&format!("intersect scene.toml {rays} -o whole.npy --device cpu")).expect(0, &[]);
        folder.run(&format!("intersect scene.toml {rays} -o whole.csv --device cpu")).expect(0, &[]);
        for n in [1, 2, 7] {
            let (mut binary, mut text) = (Vec::new(), b"t,u,v,geometry,primitive\n".to_vec());
            for i in 0..n {
                let line = format!("intersect scene.toml {rays} --shard {i}/{n} --device cpu --json");
                let json = folder.run(&format!("{line} -o part.npy")).expect(0, &[]).json();
                let part = folder.read("part.npy");
                assert_eq!(json["rays"].as_u64().unwrap() * 20, npy_data(&part).len() as u64);
                assert!(json["rays"].as_u64().unwrap().abs_diff(1001 / n) <= 1);
                binary.extend_from_slice(npy_data(&part));
                folder.run(&format!("{line} -o part.csv")).expect(0, &[]);
                let part = folder.read("part.csv");
                text.extend_from_slice(&part[part.iter().position(|&b| b == b'\n').unwrap() + 1..]);
            }
            assert_eq!(binary, npy_data(&folder.read("whole.npy")), "{rays} in {n}");
            assert_eq!(text, folder.read("whole.csv"), "{rays} in {n}");
        }
    }
}

#[test]
fn more_shards_than_rays_leave_some_empty() {
    let folder = Folder::with_scene();
    let mut joined = Vec::new();
    for i in 0..8 {
        folder.run(&format!("intersect scene.toml rays.csv -o part.csv --shard {i}/8 --device cpu")).expect(0, &[]);
        joined.extend(csv_hits(&folder.read("part.csv")));
    }
    assert_eq!(joined, HITS);
}

#[test]
fn a_bad_ray_is_the_fault_of_its_share_alone() {
    let folder = Folder::with_scene();
    folder.write("bad.csv", "ox,oy,oz,dx,dy,dz\n0,0,5,0,0,-1\n0,0,5,0,0,-1\n\n0,0,5,0,0,0\n0,0,5,0,x,1\n");
    folder.run("intersect scene.toml bad.csv -o part.csv --shard 0/2 --device cpu").expect(0, &[]);
    folder.run("intersect scene.toml bad.csv -o none.csv --shard 1/2 --device cpu").expect(5, &["bad.csv: line 5"]);
    folder.run("intersect scene.toml bad.csv -o none.csv --shard 3/4 --device cpu").expect(5, &["line 6", "dy"]);
    assert!(!folder.path("none.csv").exists());
}
