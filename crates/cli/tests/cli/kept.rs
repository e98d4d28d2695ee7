//! `--keep`: columns of the rays beside the hits.

use super::Folder;

#[test]
fn columns_of_the_rays_are_passed_on_and_others_are_named() {
    let folder = Folder::new();
    folder.write("one.toml", "[[geometry]]\nspheres = [[0, 0, 0, 1]]\n");
    folder.write("rays.csv", "id,ox,oy,oz,dx,dy,dz,weight\na,0,0,5,0,0,-1,0.5\n\"b,c\",0,9,5,0,0,-1,x\n");
    let run = |more: &str| folder.run(&format!("intersect one.toml rays.csv --query any --device cpu {more}"));
    run("-o hits.csv --keep weight,id").expect(0, &[]);
    assert_eq!(folder.read("hits.csv"), b"hit,weight,id\n1,0.5,a\n0,x,\"b,c\"\n");
    run("-o hits.csv")
        .expect(0, &["note    rays.csv: the columns `id,weight` are passed over; --keep passes columns on"]);
    run("-o hits.csv --keep names").expect(5, &["there is no column `names`"]);
    run("-o hits.npy --keep id").expect(2, &["--keep: .npy has no place for columns of the rays"]);
}
