use glam::Vec3;
use rayproof::scene::bvh::{Bvh, Tier};
use rayproof::scene::{Geometry, Hit, Mesh, Ray, Scene, Sphere};
use rayproof_gpu::{Gpu, Selector, Fingerprint, Route};

#[test]
fn smoke() {
    for r in rayproof::adapters() { for f in r.fingerprints { println!("{} {}", r.name, f.unwrap()); } }
    let mut mesh = Mesh::default();
    for y in 0..40 { for x in 0..40 { mesh.vertices.push(Vec3::new(x as f32, y as f32, ((x*7+y*13)%5) as f32 * 0.3)); } }
    for y in 0..39u32 { for x in 0..39u32 { let i=y*40+x; mesh.triangles.push([i,i+1,i+40]); mesh.triangles.push([i+1,i+41,i+40]); } }
    let spheres: Vec<Sphere> = (0..100).map(|i| Sphere{center: Vec3::new((i%10) as f32*4.0, (i/10) as f32 * 4.0, 3.0), radius: 1.0+ (i%3) as f32*0.2}).collect();
    let scenes = [Scene::new(vec![Geometry::Mesh(mesh.clone())]), Scene::new(vec![Geometry::Spheres(spheres.clone())]), Scene::new(vec![Geometry::Mesh(mesh), Geometry::Spheres(spheres)]), Scene::new(vec![])];
    let mut rays = vec![];
    for i in 0..100_000u32 { let a=(i as f32*0.618).fract(); let b=(i as f32*0.414).fract(); rays.push(Ray::new(Vec3::new(20.0,20.0,30.0), Vec3::new(a*40.0-20.0,b*40.0-20.0,-30.0))); }
    for (k,scene) in scenes.iter().enumerate() { for tier in [Tier::Classic, Tier::Fast] {
        let bvh = Bvh::new(scene, tier.scaling()).unwrap();
        let gpu = rayproof_gpu::Engine::new(Gpu::open(&Selector::Best).unwrap(), &bvh, tier).unwrap();
        let cpu = rayproof_cpu::Engine::new(bvh, tier);
        let mut a = vec![Hit::MISS; rays.len()]; let mut b = a.clone();
        cpu.closest(&rays, &mut a); gpu.closest(&rays, &mut b).unwrap();
        let diff = a.iter().zip(&b).filter(|(x,y)| !x.same_bits(y)).count();
        println!("scene {k} {tier:?}: hits {} diff {diff}", a.iter().filter(|h| h.is_hit()).count());
        let mut a = vec![0u8; rays.len()]; let mut b = a.clone();
        cpu.any(&rays, &mut a); gpu.any(&rays, &mut b).unwrap();
        println!("any {} diff {}", a.iter().map(|&x| x as u32).sum::<u32>(), a.iter().zip(&b).filter(|(x,y)| x!=y).count());
    }}
}
