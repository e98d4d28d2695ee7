#![expect(clippy::unwrap_used, reason = "a test")]

use rayproof::scene::{FlatHit, Geometry, Mesh, Ray, Scene};
use rayproof_oracle::Oracle;
use rayproof_oracle::families::meshes::cube;

use rayproof_gpu::Selector;

use super::{Adaptor, Contestant, absent_python_peers, make_venv, python_peers, ray_query_peer, rust_peers};

/// Rays from inside a cube through places where nobody errs, with directions of many lengths.
fn rays() -> Vec<Ray> {
    let place = |i: u32, step: f32| (i as f32 * step).fract() * 1.6 - 0.8;
    let direction =
        |i| glam::Vec3::new(place(i, 0.618), place(i, 0.414), place(i, 0.732)) * f32::from(1 + (i % 7) as u8);
    (1..500).map(|i| Ray::new(glam::Vec3::new(0.1, 0.02, -0.07), direction(i))).collect()
}

fn check(peer: &mut dyn Adaptor, mesh: &Mesh) {
    let scene = Scene::new(vec![Geometry::Mesh(mesh.clone())]).expect("a valid scene");
    let (oracle, rays) = (Oracle::new(&scene), rays());
    let mut hits = vec![FlatHit::MISS; rays.len()];
    let seconds = peer.closest(&rays, &mut hits).unwrap();
    assert!(seconds > 0.0 && peer.build_seconds() > 0.0 && !peer.version().is_empty() && !peer.how().is_empty());
    for (ray, hit) in rays.iter().zip(&hits) {
        let exact = oracle.closest(ray).unwrap().to_hit();
        let near = |a: f32, b: f32| (a - b).abs() <= 1e-4 * b.abs().max(1.0);
        assert_eq!(hit.primitive, exact.primitive, "{}", peer.name());
        assert!(
            near(hit.t, exact.t) && near(hit.u, exact.u) && near(hit.v, exact.v),
            "{}: {hit:?}, {exact:?}",
            peer.name()
        );
    }
    if let Some(counted) = peer.count(&rays, &mut vec![0; rays.len()]) {
        counted.unwrap();
    }
    assert!(peer.closest(&rays, &mut hits[1..]).unwrap_err().contains("room for"));
    peer.closest(&[], &mut []).unwrap();
}

fn check_all(peers: Vec<Contestant>, mesh: &Mesh) {
    for peer in peers {
        check(peer.unwrap().as_mut(), mesh);
    }
}

#[test]
#[cfg(feature = "peers")]
fn peers_in_rust_find_what_is_there() {
    let mesh = cube(3);
    check_all(rust_peers(&mesh), &mesh);
}

#[test]
#[cfg(feature = "peers")]
fn versions_are_those_that_are_built() {
    let lock = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../../Cargo.lock")).unwrap();
    for peer in rust_peers(&cube(1)) {
        let peer = peer.unwrap();
        let package = peer.name().split(' ').next().unwrap();
        let entry = format!("name = \"{package}\"\nversion = \"{}\"\n", peer.version());
        assert!(lock.contains(&entry), "not in Cargo.lock: {entry}");
    }
}

#[test]
#[cfg(feature = "peers")]
fn a_panic_is_a_reason() {
    let mut mesh = cube(1);
    mesh.triangles[3] = [0, 1, 99];
    for peer in rust_peers(&mesh) {
        let absent = peer.err().unwrap();
        assert!(absent.why.contains("99"), "{absent}");
    }
}

#[test]
#[cfg(not(feature = "peers"))]
fn a_build_without_them_says_so() {
    let peers = rust_peers(&cube(1));
    assert!(peers.iter().all(|peer| peer.as_ref().err().unwrap().why.contains("feature")));
}

#[test]
fn without_a_virtual_environment_each_peer_says_why() {
    let absent: Vec<_> = absent_python_peers("no python3").into_iter().map(|peer| peer.err().unwrap()).collect();
    assert_eq!(absent.len(), 3);
    assert!(absent.iter().all(|absent| absent.why == "no python3"));
}

#[cfg(unix)]
mod fake {
    //! Children that are not Python.
    use std::fs;
    use std::os::unix::fs::PermissionsExt;
    use std::path::Path;

    use super::*;

    fn contestants(script: &str) -> Vec<Contestant> {
        let venv = tempfile::tempdir().unwrap();
        fs::create_dir(venv.path().join("bin")).unwrap();
        let python = venv.path().join("bin/python");
        fs::write(&python, format!("#!/bin/sh\n{script}\n")).unwrap();
        fs::set_permissions(&python, fs::Permissions::from_mode(0o755)).unwrap();
        python_peers(&cube(1), venv.path())
    }

    fn why(peer: Contestant) -> String {
        let mut hits = vec![FlatHit::MISS; rays().len()];
        peer.map_or_else(|absent| absent.why, |mut peer| peer.closest(&rays(), &mut hits).unwrap_err())
    }

    // One test: a program that is written while another test starts a child is busy.
    #[test]
    fn whatever_a_child_does_is_a_reason() {
        let nowhere = python_peers(&cube(1), Path::new("/nowhere"));
        assert!(nowhere.into_iter().all(|peer| why(peer).contains("/nowhere")));
        let ready = r#"echo '{"seconds": 1, "version": "1"}'; read request"#;
        for (script, words) in [
            ("echo no such module >&2; exit 3", vec!["exit status: 3", "no such module"]),
            ("echo hello", vec!["hello"]),
            ("kill -11 $$", vec!["signal: 11"]),
            ("exec >&-; exec sleep 60", vec!["signal: 9"]),
            (r#"echo '{"error": "ImportError: libGL"}'"#, vec!["ImportError: libGL"]),
            (&format!("{ready}; echo gone >&2; exit 1"), vec!["exit status: 1", "gone"]),
            (&format!(r#"{ready}; echo '{{"seconds": 1}}'"#), vec!["no answers"]),
            (
                &format!(r#"{ready}; shift 3; : >"$1/answers"; echo '{{"seconds": 1}}'; read end"#),
                vec!["0 bytes of answers"],
            ),
        ] {
            for peer in contestants(script) {
                let why = why(peer);
                assert!(words.iter().all(|word| why.contains(word)), "{script}: {why}");
            }
        }
    }
}

/// Needs the network and a gigabyte, or `RAYPROOF_PEERS_VENV`, a folder with the environment.
#[test]
#[ignore = "installs Python packages"]
fn peers_in_python_find_what_is_there() {
    let fresh = tempfile::tempdir().unwrap();
    let folder = std::env::var_os("RAYPROOF_PEERS_VENV").map_or_else(|| fresh.path().to_owned(), Into::into);
    let venv = make_venv(&folder, &mut |_| ()).unwrap();
    let mesh = cube(3);
    check_all(python_peers(&mesh, &venv), &mesh);
}

/// On whatever adapter there is: one without ray queries says so.
#[test]
fn a_ray_query_answers_or_says_why_not() {
    let mesh = cube(3);
    match ray_query_peer(&mesh, &Selector::Best) {
        Ok(mut peer) => check(peer.as_mut(), &mesh),
        Err(absent) => assert!(
            ["has no ray query", "no Vulkan adapter was found"].iter().any(|why| absent.why.contains(why)),
            "{absent}"
        ),
    }
}
