//! What other intersectors lose: rays from inside closed meshes at vertices and edges, and how many hit nothing. Every one
//! of these rays hits in exact arithmetic.
//!
//! ```sh
//! cargo run --release -p rayproof-report --features peers --example peer_leaks -- [VENV] [SCENE..]
//! ```
//!
//! VENV is a folder for the Python packages with Embree (made where it is not there), or `-` for none; scenes are timed.
#![expect(clippy::print_stdout, reason = "an example prints")]

use std::path::{Path, PathBuf};

use glam::{DVec3, Vec3};
use rayproof::scene::{Geometry, Hit, Mesh, Ray};
use rayproof_oracle::families::meshes;
use rayproof_report::peers::{Adaptor, Contestant, absent_python_peers, make_venv, python_peers, rust_peers};

/// Rays at vertices, and as many at edges.
const RAYS: usize = 20_000;

/// splitmix64.
struct Draw(u64);

impl Draw {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform from 0 to 1.
    fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn vector(&mut self) -> DVec3 {
        DVec3::new(self.unit(), self.unit(), self.unit()) * 2.0 - 1.0
    }

    fn index(&mut self, n: usize) -> usize {
        usize::try_from(self.bits() % n as u64).unwrap_or(0)
    }
}

fn peers(mesh: &Mesh, venv: &Result<PathBuf, String>) -> Vec<Contestant> {
    let mut all = rust_peers(mesh);
    all.extend(match venv {
        Ok(venv) => python_peers(mesh, venv),
        Err(why) => absent_python_peers(why),
    });
    all
}

/// Rays from points of a region at vertices and at points of edges.
fn aimed(mesh: &Mesh, origin: impl Fn(&mut Draw) -> Vec3) -> [Vec<Ray>; 2] {
    let mut draw = Draw(7);
    let corner = |draw: &mut Draw| (mesh.triangles[draw.index(mesh.triangles.len())], draw.index(3));
    let at = |i: u32| mesh.vertices[i as usize];
    let mut rays = [Vec::new(), Vec::new()];
    for _ in 0..RAYS {
        let ((triangle, i), from) = (corner(&mut draw), origin(&mut draw));
        rays[0].push(Ray::new(from, at(triangle[i]) - from));
        let ((triangle, i), from) = (corner(&mut draw), origin(&mut draw));
        let (a, b) = (at(triangle[i]).as_dvec3(), at(triangle[(i + 1) % 3]).as_dvec3());
        rays[1].push(Ray::new(from, a.lerp(b, draw.unit()).as_vec3() - from));
    }
    rays
}

/// The share of rays that hit nothing, and of those counted an even number of times.
fn lost(peer: &mut dyn Adaptor, rays: &[Ray]) -> Result<String, String> {
    let mut hits = vec![Hit::MISS; rays.len()];
    peer.closest(rays, &mut hits)?;
    let share = |n: usize| format!("{:6.2} %", 100.0 * n as f64 / rays.len() as f64);
    let missed = share(hits.iter().filter(|hit| !hit.is_hit()).count());
    let mut counts = vec![0; rays.len()];
    match peer.count(rays, &mut counts) {
        None => Ok(missed),
        Some(counted) => {
            counted?;
            let even = counts.iter().filter(|count| *count % 2 == 0).count();
            Ok(format!("{missed} (even: {})", share(even)))
        }
    }
}

fn leaks(name: &str, mesh: &Mesh, venv: &Result<PathBuf, String>, origins: &[(&str, Origin)]) {
    println!("\n{name}: {} triangles, {} open edges", mesh.triangles.len(), meshes::open_edges(mesh));
    for peer in peers(mesh, venv) {
        let mut peer = match peer {
            Ok(peer) => peer,
            Err(absent) => {
                println!("  {absent}");
                continue;
            }
        };
        for (from, origin) in origins {
            let [vertices, edges] = aimed(mesh, origin);
            let shown = |shares: Result<String, String>| shares.unwrap_or_else(|why| why);
            let (v, e) = (shown(lost(peer.as_mut(), &vertices)), shown(lost(peer.as_mut(), &edges)));
            println!("  {:24} from {from:16} vertices {v}, edges {e}", peer.name());
        }
    }
}

type Origin = fn(&mut Draw) -> Vec3;

/// Primary rays of a square picture, and rays between random points of the box.
fn views(mesh: &Mesh) -> [(&'static str, Vec<Ray>); 2] {
    let (low, high) = mesh.vertices.iter().fold((Vec3::MAX, Vec3::MIN), |(l, h), v| (l.min(*v), h.max(*v)));
    let (middle, size, mut draw) = ((low + high) / 2.0, high - low, Draw(3));
    let eye = middle + Vec3::new(0.1, 0.2, 1.4) * size.length();
    let place = |i: u32| i as f32 / 512.0 - 1.0;
    let pixels = (0..1024).flat_map(|y| (0..1024).map(move |x| (x, y)));
    let primary = pixels
        .map(|(x, y)| Ray::new(eye, middle + Vec3::new(place(x), place(y), 0.0) * 0.5 * size.max_element() - eye));
    let incoherent = (0..1 << 20).map(|_| {
        let mut point = || middle + draw.vector().as_vec3() * size * 0.5;
        Ray::new(point(), point() - middle)
    });
    let primary = primary.collect();
    [("primary", primary), ("incoherent", incoherent.collect())]
}

fn speed(path: &str, venv: &Result<PathBuf, String>) -> Result<(), String> {
    let scene = rayproof::scene::load(Path::new(path)).map_err(|error| error.to_string())?.scene;
    let [Geometry::Mesh(mesh)] = scene.geometries() else { return Err(format!("{path}: not one mesh")) };
    println!("\n{path}: {} triangles", mesh.triangles.len());
    for peer in peers(mesh, venv).into_iter().flatten() {
        let mut peer = peer;
        println!("  {} {}, built in {:.3} s: {}", peer.name(), peer.version(), peer.build_seconds(), peer.how());
        for (kind, rays) in views(mesh) {
            let mut hits = vec![Hit::MISS; rays.len()];
            let mut best = f64::INFINITY;
            for _ in 0..4 {
                best = best.min(peer.closest(&rays, &mut hits)?);
            }
            let hit = hits.iter().filter(|hit| hit.is_hit()).count();
            println!("    {kind:10} {:6.2} M rays/s, {hit} of {} hit", rays.len() as f64 / best / 1e6, rays.len());
        }
    }
    Ok(())
}

fn main() -> Result<(), String> {
    let mut arguments = std::env::args().skip(1);
    let venv = match arguments.next().as_deref() {
        None | Some("-") => Err("no folder for a virtual environment was given".to_owned()),
        Some(folder) => make_venv(Path::new(folder), &mut |line| println!("{line}")),
    };
    let near: Origin = |draw| (draw.vector() * 0.1).as_vec3();
    let wide: Origin = |draw| (draw.vector() * 0.5).as_vec3();
    let centre: Origin = |_| Vec3::ZERO;
    let all = [("near the centre", near), ("half the radius", wide), ("the centre", centre)];
    leaks("uv_sphere(518, 259)", &meshes::uv_sphere(518, 259), &venv, &all);
    leaks("icosphere(7)", &meshes::icosphere(7), &venv, &all);
    leaks("bumpy_sphere(367, 367, 1)", &meshes::bumpy_sphere(367, 367, 1), &venv, &all);
    let tube: Origin = |draw| (DVec3::X + draw.vector() * 0.05).as_vec3();
    leaks("torus(366, 366, 0.3)", &meshes::torus(366, 366, 0.3), &venv, &[("inside the tube", tube)]);
    arguments.try_for_each(|scene| speed(&scene, &venv))
}
