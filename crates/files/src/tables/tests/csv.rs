use std::path::Path;

use glam::Vec3;

use super::{bad, bits, drain, read_pipe};
use crate::{Format, INVALID_RAY, InvalidRays, RayReader};
use rayproof_scene::{Ray, RayFault};

const HEADER: &str = "ox,oy,oz,dx,dy,dz,t_min,t_max\n";

fn read(text: &str) -> Result<Vec<Ray>, crate::Error> {
    read_pipe(text.as_bytes(), None)
}

#[test]
fn columns_go_by_name() {
    let rays = read("\u{feff}dz, dy ,dx,\"oz\",oy,ox\r\n1,2,3,4,5, \"6\"\r\n\r\n7,8,9,10,11,12").unwrap();
    assert_eq!(rays[0], Ray::new(Vec3::new(6.0, 5.0, 4.0), Vec3::new(3.0, 2.0, 1.0)));
    assert_eq!(rays[1], Ray::new(Vec3::new(12.0, 11.0, 10.0), Vec3::new(9.0, 8.0, 7.0)));
    assert_eq!(rays.len(), 2);
}

#[test]
fn comments_and_other_columns_are_passed_over() {
    let plain = read("ox,oy,oz,dx,dy,dz\n1,2,3,4,5,6\n7,8,9,1,2,3\n").unwrap();
    for text in [
        "# ox,oy,oz,dx,dy,dz\n1,2,3,4,5,6\n7,8,9,1,2,3\n",
        "# made by hand, in 2026\n\n# Wx, Wy\nOX,oy,oz,dx,dy,dz\n1,2,3,4,5,6\n7,8,9,1,2,3\n",
        "# made by hand\n# ox,oy,oz,dx,dy,dz\n1,2,3,4,5,6\n7,8,9,1,2,3\n",
        "OX,Oy,oz,DX,dy,dz\n# a comment, of all\n1,2,3,4,5,6\n  # 1,1,1,1,1,1\n7,8,9,1,2,3\n#",
        "id,ox,oy,oz,name,dx,dy,dz,w\n1,1,2,3,\"a ray\",4,5,6,x\n2,7,8,9,,1,2,3,nan\n",
    ] {
        assert_eq!(read(text).unwrap(), plain, "{text}");
    }
    assert_eq!(bad(read("ox,oy,oz,dx,dy,dz,w\n# 1\n1,2,3,4,5,6\n")).place, "line 3");
}

#[test]
fn a_comment_that_is_nearly_a_header_is_what_is_told() {
    let bad = bad(read("# mine\n# ox,oy,oz,dx,dy\n1,2,3,4,5,6\n"));
    assert_eq!((bad.place.as_str(), bad.what.as_str()), ("line 2", "the column dz is missing"));
    let bad = super::bad(read("# mine\n\n1,2,3,4,5,6\n"));
    assert_eq!((bad.place.as_str(), bad.what.as_str()), ("line 3", "the column ox is missing"));
}

#[test]
fn a_header_alone_is_no_rays() {
    assert_eq!(read(HEADER).unwrap(), []);
    assert_eq!(read(HEADER.trim_end()).unwrap(), []);
}

#[test]
fn headers_that_do_not_name_the_columns_say_which() {
    for (header, what) in [
        ("", "there is no header, the file is empty"),
        ("\n \n", "there is no header, the file is empty"),
        ("ox,oy,oz,dx,dy", "the column dz is missing"),
        ("ox,oy,oz,dx,dy,dz,t_min", "the column t_max is missing"),
        ("ox,oy,oz,dx,dy,dz,t_max", "the column t_min is missing"),
        ("ox,oy,oz,dx,dy,dz,dz", "the column dz is there twice"),
        ("ox,oy,oz,dx,dy,dz,tmax", "`tmax` is not the name of a column, and t_max may be meant"),
        ("ox,oy,oz,dx,dy,dz,T-Min,t_max", "`T-Min` is not the name of a column, and t_min may be meant"),
        ("1,2,3,4,5,6", "the column ox is missing"),
        ("ox;oy;oz;dx;dy;dz", "the columns are apart by ';': `ox;oy;oz;dx;dy;dz`"),
        ("ox\toy\toz\tdx\tdy\tdz", "the columns are apart by '\\t': `ox\\toy\\toz\\tdx\\tdy\\tdz`"),
    ] {
        let bad = bad(read(header));
        assert_eq!((bad.place.as_str(), bad.what.as_str()), ("line 1", what));
    }
}

#[test]
fn numbers_are_rounded_once() {
    // By way of f64 this is a tie, which goes to 1; it is above the tie, and the nearest f32 is the next one.
    let text = "1.000000059604644775390625000000000001";
    let twice: f64 = text.parse().unwrap();
    let up = 1.0_f32.next_up();
    #[expect(clippy::cast_possible_truncation, reason = "what must not happen")]
    let rounded_twice = twice as f32;
    assert_ne!(rounded_twice, up, "this number would show nothing");
    let rays = read(&format!("{HEADER}{text},-0,1e-45,+1,.5,2.,-Inf,INF\n")).unwrap();
    let expected = Ray {
        origin: Vec3::new(up, -0.0, f32::from_bits(1)),
        t_min: f32::NEG_INFINITY,
        direction: Vec3::new(1.0, 0.5, 2.0),
        t_max: f32::INFINITY,
    };
    assert_eq!(bits(&rays[0]), bits(&expected));
    let same = read(&format!("{HEADER}0x1.000002p+0,-0x0p+0,0x1p-149,+1,0x.8p0,0x1p1,-inf,inf\n")).unwrap();
    assert_eq!(
        bits(&same[0]),
        bits(&Ray { t_min: f32::NEG_INFINITY, direction: Vec3::new(1.0, 0.5, 2.0), ..expected })
    );
}

#[test]
fn malformed_lines_are_named_and_counted() {
    // Empty lines and \r\n must not shift the count.
    let text = format!("{HEADER}\r\n\n0,0,0,1,1,1,0,1\r\n0,0,0,1,1,x,0,1\n0,0,0,1,1,1,0\n0,0,0,1,1,1,0,1\n,,,,,,,\n");
    let first = bad(read(&text));
    assert_eq!((first.place.as_str(), first.more), ("line 5", 2));
    assert_eq!(first.what, "dz is `x`, not a number");
    let short = bad(read(&format!("{HEADER}1,2,3,4,5,6\n")));
    assert_eq!((short.what.as_str(), short.place.as_str()), ("there are 6 values", "line 2"));
    assert_eq!(short.expected, "give 8, as many as the header names");
    let long = bad(read(&format!("{HEADER}1,2,3,4,5,6,7,8,9\n")));
    assert_eq!(long.what, "there are 9 values");
    let endless = bad(read(&format!("{HEADER}{}", "1".repeat(1 << 17))));
    assert_eq!(endless.what, "the line is longer than 65536 bytes");
}

#[test]
fn bad_rays_are_named_by_line_and_counted() {
    let text = format!(
        "{HEADER}0,0,0,1,0,0,0,1\n\n0,0,0,0,-0,0,0,1\n0,0,0,1,0,0,2,1\n0,0,0,1,0,0,nan,1\n0,0,inf,1,0,0,0,1\n\
         0,0,0,1,0,1e40,0,1\n1,0,0,1,0,0,0,1\n"
    );
    let first = bad(read(&text));
    assert_eq!((first.place.as_str(), first.more), ("line 4", 4));
    assert!(first.what.starts_with("the direction is zero: "), "{}", first.what);
    assert_eq!(first.expected, "give it any length but zero");

    let input = Box::new(std::io::Cursor::new(text.into_bytes()));
    let mut reader = RayReader::from_pipe(Path::new("-"), input, Some(Format::Csv), InvalidRays::Miss).unwrap();
    let rays = drain(&mut reader, 2).unwrap();
    assert_eq!(
        rays.iter().map(|r| *r == INVALID_RAY).collect::<Vec<_>>(),
        [false, true, true, true, true, true, false]
    );
    assert_eq!((reader.invalid(), reader.total(), reader.rounding().values), (5, None, 1));
}

#[test]
fn what_comes_first_in_the_file_is_reported() {
    let ray_first = format!("{HEADER}0,0,0,0,0,0,0,1\n0,0,0,1,1,x,0,1\n");
    assert_eq!(bad(read(&ray_first)).place, "line 2");
    let line_first = format!("{HEADER}0,0,0,1,1,x,0,1\n0,0,0,0,0,0,0,1\n");
    assert_eq!(bad(read(&line_first)).what, "dz is `x`, not a number");
}

#[test]
fn an_empty_range_hits_nothing_by_construction() {
    assert_eq!(INVALID_RAY.fault(), Some(RayFault::Range));
    assert!(INVALID_RAY.origin.is_finite() && INVALID_RAY.direction.is_finite());
    assert_ne!(INVALID_RAY.direction, Vec3::ZERO);
}
