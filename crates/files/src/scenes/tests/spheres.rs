use proptest::prelude::*;

use super::{config, csv, finite, message, npy, write};
use rayproof_scene::Sphere;

fn sphere([x, y, z, radius]: [f32; 4]) -> Sphere {
    Sphere { center: glam::Vec3::new(x, y, z), radius }
}

fn f4(rows: &[[f32; 4]]) -> Vec<u8> {
    rows.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect()
}

fn f8(rows: &[[f64; 4]]) -> Vec<u8> {
    rows.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect()
}

#[test]
fn doubles_are_rounded_to_the_nearest() {
    let x = 1.0 + f64::from(f32::EPSILON) * 0.75;
    let file = write::npy("<f8", "False", "(2, 4)", &f8(&[[x, 0.1, -0.0, 1e-60], [0.0; 4]]));
    let spheres = npy("f.npy", &file).unwrap();
    assert_eq!(write::row(&spheres[0]), [1.0 + f32::EPSILON, 0.1, 0.0, 0.0]);
}

#[test]
fn an_empty_table_is_a_table() {
    assert_eq!(npy("f.npy", &write::npy("<f4", "False", "(0, 4)", &[])).unwrap(), []);
    assert_eq!(csv("f.csv", b"x,y,z,r\n").unwrap(), []);
    assert_eq!(csv("f.csv", b"x, y, z, r").unwrap(), []);
    for text in [
        "x,y,z,r\n1,2,3,4",
        "# Radius,id,Z,y,X\n# all\n4,7,3,2,1\n",
        "\u{feff}x,y,z,RADIUS,x2\n1,2,3,4,\n#\n",
        "# made by hand\n\n# in 2026\nx,y,z,r\n1,2,3,4\n",
        "# made by hand\n  # x,y,z,r\n1,2,3,4\n",
    ] {
        assert_eq!(csv("f.csv", text.as_bytes()).unwrap(), [sphere([1.0, 2.0, 3.0, 4.0])], "{text}");
    }
}

#[test]
fn bad_rows_are_named() {
    let rows = [[0.0, 0.0, 0.0, 1.0], [0.0, 0.0, 0.0, -0.5], [f32::NAN, 0.0, 0.0, 1.0], [0.0, 0.0, 0.0, -1.0]];
    let table =
        |rows: &[[f32; 4]]| npy("f.npy", &write::npy("<f4", "False", &format!("({}, 4)", rows.len()), &f4(rows)));
    let negative =
        "f.npy: row 1 (counting from 0): the radius -0.5 is negative (the first of 2); give a radius of zero or more";
    assert_eq!(message(table(&rows)), negative);
    let expected = "f.npy: row 0 (counting from 0): the sphere (NaN, 0.0, 0.0, 1.0) is not finite; give x, y, z and radius as \
                    finite numbers within the range of f32";
    assert_eq!(message(table(&rows[2..])), expected);
    let wide = npy("f.npy", &write::npy("<f8", "False", "(1, 4)", &f8(&[[0.0, 1e39, 0.0, 1.0]])));
    let expected = "f.npy: row 0 (counting from 0): the sphere (0.0, inf, 0.0, 1.0) is not finite; give x, y, z and radius as \
                    finite numbers within the range of f32";
    assert_eq!(message(wide), expected);

    let expected = "give a header `x,y,z,r` and four numbers a line";
    for (text, said) in [
        (
            "x,y,z,r\n0,0,0,1\n0,0,0,-1\n0,0,0,-2\n",
            "line 3: the radius -1.0 is negative (the first of 2); give a radius of zero or more".into(),
        ),
        (
            "# mine\n# x,y,z,r\n0,0,0,1\n0,0,0,-1\n",
            "line 4: the radius -1.0 is negative; give a radius of zero or more".into(),
        ),
        ("# mine\nx,y,z\n", format!("line 2: the header is `x,y,z`; {expected}")),
        (
            "x,y,z,r\n0,0,inf,1\n",
            "line 2: the sphere (0.0, 0.0, inf, 1.0) is not finite; give x, y, z and radius as finite numbers \
          within the range of f32"
                .into(),
        ),
        ("x,y,z,r\n0,0,zero,1\n0,,0,1\n", format!("line 2: `zero` is not a number (the first of 2); {expected}")),
        ("x,y,z,r\n0,0,0,1\n0,0,1\n", format!("line 3: there are 3 values; {expected}")),
        ("x,y,z,w\n", format!("line 1: the header is `x,y,z,w`; {expected}")),
        ("x,y,z,r,radius\n", format!("line 1: the header is `x,y,z,r,radius`; {expected}")),
        ("x;y;z;r\n", format!("line 1: the header is `x;y;z;r`; {expected}")),
        ("", format!("line 1: the header is ``; {expected}")),
    ] {
        assert_eq!(message(csv("f.csv", text.as_bytes())), format!("f.csv: {said}"));
    }
}

#[test]
fn bad_arrays_are_named() {
    let data = f4(&[[1.0; 4]; 2]);
    let table = "give an array of shape (N, 4), dtype float32 or float64, little-endian, in C order";
    for (descr, order, shape, said) in [
        ("<f4", "False", "(2, 3)", format!("the header: the shape is (2, 3); {table}")),
        ("<f4", "False", "(8,)", format!("the header: the shape is (8,); {table}")),
        ("<f4", "False", "(1+1, 4)", format!("the header: the shape is (1+1, 4); {table}")),
        ("<f4", "False", "(1, 2, 4)", format!("the header: the shape is (1, 2, 4); {table}")),
        ("<f4", "True", "(2, 4)", format!("the header: the array is in Fortran order; {table}")),
        (">f4", "False", "(2, 4)", format!("the header: the dtype is '>f4'; {table}")),
        ("<i4", "False", "(2, 4)", format!("the header: the dtype is '<i4'; {table}")),
        ("<f2", "False", "(2, 4)", format!("the header: the dtype is '<f2'; {table}")),
        (
            "<f4",
            "False",
            "(3, 4)",
            "row 2 (counting from 0): 3 rows of 16 bytes are announced and 32 bytes follow; give the whole file".into(),
        ),
        (
            "<f4",
            "False",
            "(1000000000000000, 4)",
            "row 2 (counting from 0): 1000000000000000 rows of 16 bytes are announced and 32 bytes follow; give the whole \
             file"
            .into(),
        ),
        (
            "<f4",
            "False",
            "(9999999999999999999, 4)",
            "row 2 (counting from 0): 9999999999999999999 rows of 16 bytes are announced and 32 bytes follow; give the whole \
             file"
            .into(),
        ),
        (
            "<f4",
            "False",
            "(99999999999999999999, 4)",
            format!("the header: the shape is (99999999999999999999, 4); {table}"),
        ),
        (
            "<f4",
            "False",
            &"(".repeat(60_000),
            format!("the header: the header has 60054 bytes, more than 10000; {table}"),
        ),
    ] {
        assert_eq!(message(npy("f.npy", &write::npy(descr, order, shape, &data))), format!("f.npy: {said}"));
    }
    assert_eq!(
        message(npy("f.npy", b"x,y,z,r\n0,0,0,1\n")),
        format!("f.npy: the header: it does not start with the .npy magic number; {table}")
    );
    let huge = [&b"\x93NUMPY\x02\x00"[..], &u32::MAX.to_le_bytes()].concat();
    assert_eq!(
        message(npy("f.npy", &huge)),
        format!("f.npy: the header: the header has 4294967295 bytes, more than 10000; {table}")
    );
}

proptest! {
    #![proptest_config(config(256))]

    #[test]
    fn round_trip(rows in prop::collection::vec((prop::array::uniform3(finite()), finite()), 0..20)) {
        let rows: Vec<_> = rows.iter().map(|&([x, y, z], r)| [x, y, z, r.abs()]).collect();
        let text = rows.iter().map(|[x, y, z, r]| format!("{x},{y},{z},{r}\n")).collect::<String>();
        let shape = format!("({}, 4)", rows.len());
        let wide: Vec<_> = rows.iter().map(|row| row.map(f64::from)).collect();
        let expected: Vec<_> = rows.iter().map(|row| row.map(f32::to_bits)).collect();
        for read in [
            csv("f.csv", format!("x,y,z,r\n{text}").as_bytes()).unwrap(),
            npy("f.npy", &write::npy("<f4", "False", &shape, &f4(&rows))).unwrap(),
            npy("f.npy", &write::npy("<f8", "False", &shape, &f8(&wide))).unwrap(),
        ] {
            prop_assert_eq!(read.iter().map(|s| write::row(s).map(f32::to_bits)).collect::<Vec<_>>(), expected.clone());
        }
        prop_assert_eq!(rows.iter().map(|&row| sphere(row)).map(|s| write::row(&s)).collect::<Vec<_>>(), rows);
    }
}
