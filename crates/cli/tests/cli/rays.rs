//! `rayproof rays`: the rays that were asked for, the same on every run.

use super::{Folder, npy_data};

/// The rows of an `.npy` file of rays.
fn rows(file: &[u8]) -> Vec<[f32; 6]> {
    let values: Vec<f32> = npy_data(file).as_chunks::<4>().0.iter().map(|x| f32::from_le_bytes(*x)).collect();
    assert!(values.len().is_multiple_of(6));
    values.as_chunks::<6>().0.to_vec()
}

#[test]
fn as_many_as_asked_and_the_same_in_every_run_and_format() {
    let folder = Folder::with_scene();
    for (options, count) in [
        ("", 1 << 20),
        ("--kind primary --size 31x17", 31 * 17),
        ("--kind incoherent --size 31x17", 31 * 17),
        ("--kind incoherent --count 1000", 1000),
        ("--kind incoherent --count 0", 0),
        ("--kind diffuse --count 1", 1),
        ("--kind diffuse --count 1000", 1000),
        ("--kind diffuse --count 2200000", 2_200_000),
    ] {
        folder.run(&format!("rays scene.toml -o one.npy {options}")).expect(0, &[]);
        let one = folder.read("one.npy");
        assert_eq!(npy_data(&one).len(), count * 24, "{options}");
        folder.run(&format!("rays scene.toml -o two.npy {options}")).expect(0, &[]);
        assert!(one == folder.read("two.npy"), "{options}");
    }
    folder.run("rays scene.toml -o same.csv --kind incoherent --count 1000").expect(0, &[]);
    folder.run("rays scene.toml -o same.npy --kind incoherent --count 1000").expect(0, &[]);
    let text = String::from_utf8(folder.read("same.csv")).unwrap();
    assert!(text.starts_with("ox,oy,oz,dx,dy,dz\n"));
    let values = text.lines().skip(1).flat_map(|line| line.split(',').map(|x| x.parse::<f32>().unwrap()));
    assert_eq!(values.collect::<Vec<_>>(), rows(&folder.read("same.npy")).as_flattened());
}

#[test]
fn the_seed_decides() {
    let folder = Folder::with_scene();
    for kind in ["incoherent", "diffuse"] {
        let make = |seed: &str| {
            folder.run(&format!("rays scene.toml -o rays.npy --kind {kind} --count 500 {seed}")).expect(0, &[]);
            folder.read("rays.npy")
        };
        assert!(make("") == make("--seed 1"));
        assert!(make("--seed 1") != make("--seed 2"));
    }
}

#[test]
fn primary_rays_go_through_the_camera_of_the_scene_file() {
    let folder = Folder::with_scene();
    let camera = "[camera]\neye = [0, 0, 10]\ntarget = [0, 0, 0]\nup = [0, 1, 0]\nfov_y = 90\n";
    folder.write("seen.toml", format!("{}{camera}", super::SCENE));
    folder.run("rays seen.toml -o rays.npy --size 2x2").expect(0, &[]);
    // The pixel centres are at -1/2 and 1/2 on the plane at distance 1; from the top left, row by row.
    let side = (1.0 / 6.0_f32).sqrt();
    let forward = -(2.0 / 3.0_f32).sqrt();
    let want = [(-side, side), (side, side), (-side, -side), (side, -side)];
    for (row, (x, y)) in rows(&folder.read("rays.npy")).into_iter().zip(want) {
        assert_eq!(row[..3], [0.0, 0.0, 10.0]);
        for (got, want) in row[3..].iter().zip([x, y, forward]) {
            assert!((got - want).abs() < f32::EPSILON, "{row:?}");
        }
    }
}

#[test]
fn diffuse_rays_leave_the_surface_and_do_not_meet_it_again_at_once() {
    let folder = Folder::new();
    folder.write("ball.toml", "[[geometry]]\nspheres = [[0.0, 0.0, 0.0, 1.0]]\n");
    folder.run("rays ball.toml -o rays.npy --kind diffuse --count 20000").expect(0, &[]);
    for row in rows(&folder.read("rays.npy")) {
        let distance = row[..3].iter().map(|x| f64::from(*x).powi(2)).sum::<f64>().sqrt();
        assert!(distance > 1.0 && distance < 1.001, "{row:?}");
    }
    // From outside a convex body nothing is met again.
    let ran = folder.run("intersect ball.toml rays.npy -o hits.npy --query any --device cpu --json").expect(0, &[]);
    assert_eq!((&ran.json()["rays"], &ran.json()["hits"]), (&20_000.into(), &0.into()));
}

#[test]
fn a_camera_that_sees_nothing_sends_no_diffuse_rays_and_says_so() {
    let folder = Folder::with_scene();
    let camera = "[camera]\neye = [0, 0, 50]\ntarget = [0, 0, 100]\nup = [0, 1, 0]\nfov_y = 10\n";
    folder.write("blind.toml", format!("{}{camera}", super::SCENE));
    folder.run("rays blind.toml -o rays.npy --kind diffuse --count 10").expect(5, &["blind.toml", "[camera]"]);
    assert!(!folder.path("rays.npy").exists());
}
