//! Files that gzip has packed.

use std::io::Write as _;

use flate2::Compression;
use flate2::write::GzEncoder;

use super::message;
use crate::{Error, InvalidRays, RayReader, load};

fn pack(bytes: &[u8]) -> Vec<u8> {
    let mut packed = GzEncoder::new(Vec::new(), Compression::default());
    packed.write_all(bytes).unwrap();
    packed.finish().unwrap()
}

#[test]
fn what_is_packed_is_what_is_in_it() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    std::fs::write(path("a.obj"), obj).unwrap();
    // In two members, as pigz and cat leave them.
    std::fs::write(path("b.OBJ.gz"), [pack(&obj.as_bytes()[..9]), pack(&obj.as_bytes()[9..])].concat()).unwrap();
    std::fs::write(path("s.csv.gz"), pack(b"x,y,z,r\n1,2,3,4\n")).unwrap();
    std::fs::write(path("s.toml"), "[[geometry]]\nmesh = \"b.OBJ.gz\"\n[[geometry]]\nspheres = \"s.csv.gz\"\n")
        .unwrap();
    let plain = load(&path("a.obj")).unwrap().scene;
    assert_eq!(load(&path("b.OBJ.gz")).unwrap().scene, plain);
    let both = load(&path("s.toml")).unwrap().scene;
    assert_eq!((&both.geometries()[0], both.len()), (&plain.geometries()[0], 2));

    let rays = "ox,oy,oz,dx,dy,dz\n1,2,3,4,5,6\n7,8,9,1,2,3\n";
    std::fs::write(path("r.csv.gz"), pack(rays.as_bytes())).unwrap();
    let mut reader = RayReader::open(&path("r.csv.gz"), None, InvalidRays::Error).unwrap();
    let mut batch = Vec::new();
    assert_eq!((reader.next_batch(&mut batch, 9).unwrap(), batch[1].origin.x), (2, 7.0));
}

#[test]
fn what_does_not_unpack_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.stl.gz");
    let said = || {
        let text = message(load(&path));
        text.split_once("a.stl.gz: ").unwrap().1.to_owned()
    };
    std::fs::write(&path, "solid").unwrap();
    assert!(said().starts_with("the file: it cannot be unpacked: "), "{}", said());
    let whole = pack(&vec![b' '; 1000]);
    std::fs::write(&path, &whole[..whole.len() - 5]).unwrap();
    assert!(said().starts_with("the file: it cannot be unpacked: "), "{}", said());
    std::fs::write(&path, pack(&vec![0; 80 << 20])).unwrap();
    assert_eq!(said(), "the file: it unpacks to more than 64 times its size; give a whole file, packed by gzip");
    assert!(matches!(load(folder.path().join("x.ply.gz").as_path()), Err(Error::Open { .. })));
    std::fs::create_dir(folder.path().join("folder.ply")).unwrap();
    assert!(matches!(load(&folder.path().join("folder.ply")), Err(Error::Open { .. })));
}
