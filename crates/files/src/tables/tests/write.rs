use std::fs;
use std::path::Path;

use super::{bad, some_rays};
use crate::tables::BLOCK_ROWS;
use crate::{Error, Format, HitKind, HitWriter, Kept, KeptColumns, RayWriter};
use rayproof_scene::Hit;

/// A row of closest hits, as NumPy sees it.
#[derive(npyz::Deserialize, Debug, PartialEq)]
struct Row {
    t: f32,
    u: f32,
    v: f32,
    geometry: u32,
    primitive: u32,
}

fn hits() -> Vec<Hit> {
    let hit = |t, geometry, primitive| Hit { t, u: 0.1, v: 1e-45, geometry, primitive };
    vec![
        hit(1.5, 2, 2),
        Hit::MISS,
        hit(0.0, 0, 0),
        hit(3e38, 3, 0),
        hit(-0.0, 2, 0),
        hit(f32::INFINITY, 0, 1),
        hit(1e-7, 2, 1),
    ]
}

fn rows() -> Vec<Row> {
    let row = |&Hit { t, u, v, geometry, primitive }: &Hit| Row { t, u, v, geometry, primitive };
    hits().iter().map(row).collect()
}

fn write_closest(path: &Path, total: Option<u64>) -> Result<(), Error> {
    let mut writer = HitWriter::create(path, None, HitKind::Closest, total, &KeptColumns::default())?;
    writer.write_closest(&hits()[..3], &Kept::default())?;
    writer.write_closest(&hits()[3..], &Kept::default())?;
    writer.finish()
}

#[test]
fn closest_hits_are_the_structured_array_of_the_contract() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("hits.npy");
    for total in [None, Some(7)] {
        write_closest(&path, total).unwrap();
        let bytes = fs::read(&path).unwrap();
        let npy = npyz::NpyFile::new(&bytes[..]).unwrap();
        let descr = "[('t', '<f4'), ('u', '<f4'), ('v', '<f4'), ('geometry', '<u4'), ('primitive', '<u4'), ]";
        assert_eq!((npy.dtype().descr().as_str(), npy.shape()), (descr, &[7][..]));
        assert_eq!((bytes.len() - 7 * 20) % 64, 0, "the data is aligned");
        assert_eq!(npy.into_vec::<Row>().unwrap(), rows());
    }
    let miss = &rows()[1];
    assert_eq!((miss.t, miss.u, miss.v, miss.geometry), (f32::INFINITY, 0.0, 0.0, 4_294_967_295));
}

#[test]
fn closest_hits_in_csv_read_back_to_the_same_bits() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("hits.csv");
    write_closest(&path, None).unwrap();
    let text = fs::read_to_string(&path).unwrap();
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("t,u,v,geometry,primitive"));
    assert_eq!(text.lines().nth(2), Some("inf,0.0,0.0,4294967295,4294967295"));
    for row in rows() {
        let fields: Vec<&str> = lines.next().unwrap().split(',').collect();
        let floats: Vec<u32> = fields[..3].iter().map(|f| f.parse::<f32>().unwrap().to_bits()).collect();
        assert_eq!(floats, [row.t, row.u, row.v].map(f32::to_bits));
        assert_eq!(fields[3..], [row.geometry.to_string(), row.primitive.to_string()]);
    }
    assert_eq!(lines.next(), None);
}

#[test]
fn any_and_count_have_their_one_column() {
    let directory = tempfile::tempdir().unwrap();
    for (kind, descr, csv) in [
        (HitKind::Any, "[('hit', '|u1'), ]", "hit\n1\n0\n1\n"),
        (HitKind::Count, "[('count', '<u4'), ]", "count\n3\n0\n4294967294\n"),
    ] {
        for ending in ["npy", "csv"] {
            let path = directory.path().join(format!("hits.{ending}"));
            let mut writer = HitWriter::create(&path, None, kind, None, &KeptColumns::default()).unwrap();
            match kind {
                HitKind::Any => writer.write_any(&[1, 0, 1], &Kept::default()).unwrap(),
                _ => writer.write_count(&[3, 0, 4_294_967_294], &Kept::default()).unwrap(),
            }
            writer.finish().unwrap();
        }
        let bytes = fs::read(directory.path().join("hits.npy")).unwrap();
        let npy = npyz::NpyFile::new(&bytes[..]).unwrap();
        assert_eq!((npy.dtype().descr().as_str(), npy.shape()), (descr, &[3][..]));
        let data: &[u8] = if kind == HitKind::Any { &[1, 0, 1] } else { &[3, 0, 0, 0, 0, 0, 0, 0, 254, 255, 255, 255] };
        assert_eq!(&bytes[bytes.len() - data.len()..], data);
        assert_eq!(fs::read_to_string(directory.path().join("hits.csv")).unwrap(), csv);
    }
}

#[test]
fn more_hits_than_a_block_keep_their_order() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("hits.npy");
    let count = 2 * BLOCK_ROWS + 3;
    let mut writer = HitWriter::create(&path, None, HitKind::Closest, None, &KeptColumns::default()).unwrap();
    writer.write_closest(&hits().into_iter().cycle().take(count).collect::<Vec<_>>(), &Kept::default()).unwrap();
    writer.finish().unwrap();
    let npy = npyz::NpyFile::new(std::io::BufReader::new(fs::File::open(&path).unwrap())).unwrap();
    let expected: Vec<Row> = (0..count / 7 + 1).flat_map(|_| rows()).take(count).collect();
    assert!(npy.into_vec::<Row>().unwrap() == expected);

    let counts: Vec<u32> = (0..u32::MAX).step_by(7_001).take(count).collect();
    let mut writer = HitWriter::create(&path, None, HitKind::Count, None, &KeptColumns::default()).unwrap();
    writer.write_count(&counts, &Kept::default()).unwrap();
    writer.finish().unwrap();
    let bytes = fs::read(&path).unwrap();
    let data: Vec<u32> =
        bytes[bytes.len() - 4 * count..].as_chunks().0.iter().map(|b| u32::from_le_bytes(*b)).collect();
    assert!(data == counts);

    let any: Vec<u8> = counts.iter().map(|count| u8::from(count % 3 == 2)).collect();
    let mut writer = HitWriter::create(&path, None, HitKind::Any, None, &KeptColumns::default()).unwrap();
    writer.write_any(&any, &Kept::default()).unwrap();
    writer.finish().unwrap();
    let bytes = fs::read(&path).unwrap();
    assert!(bytes[bytes.len() - count..] == any);
}

#[test]
fn rays_are_a_matrix() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("rays.npy");
    for (with_range, columns) in [(false, 6), (true, 8)] {
        let mut writer = RayWriter::create(&path, None, with_range, None).unwrap();
        writer.write(&some_rays(5)).unwrap();
        writer.finish().unwrap();
        let bytes = fs::read(&path).unwrap();
        let npy = npyz::NpyFile::new(&bytes[..]).unwrap();
        assert_eq!((npy.dtype().descr().as_str(), npy.shape()), ("'<f4'", &[5, columns][..]));
        assert_eq!(npy.into_vec::<f32>().unwrap()[..6], [0.0, 0.1, -2.5, 1.0, 0.0, 0.3]);
    }
}

#[test]
fn an_unfinished_table_leaves_no_file_and_spares_the_older_one() {
    let directory = tempfile::tempdir().unwrap();
    let mut endings = vec!["npy", "csv"];
    if cfg!(feature = "parquet") {
        endings.push("parquet");
    }
    let names = || -> Vec<String> {
        let entries = fs::read_dir(directory.path()).unwrap();
        entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned()).collect()
    };
    for ending in endings {
        let path = directory.path().join(format!("hits.{ending}"));
        let mut writer = HitWriter::create(&path, None, HitKind::Closest, None, &KeptColumns::default()).unwrap();
        writer.write_closest(&hits(), &Kept::default()).unwrap();
        assert!(!path.exists(), "{ending}: not before it is whole");
        let [partial] = &names()[..] else { panic!("one temporary file, not {:?}", names()) };
        assert!(partial.starts_with(&format!(".hits.{ending}.")) && partial.ends_with(".partial"), "{partial}");
        drop(writer);
        assert_eq!(names(), Vec::<String>::new(), "{ending}: nothing is left");

        fs::write(&path, "older").unwrap();
        drop(HitWriter::create(&path, None, HitKind::Any, None, &KeptColumns::default()).unwrap());
        let short = write_closest(&path, Some(8)).unwrap_err().to_string();
        assert!(short.ends_with("7 rows were written of 8 that were announced"), "{short}");
        assert_eq!(fs::read_to_string(&path).unwrap(), "older");
        write_closest(&path, Some(7)).unwrap();
        assert_ne!(fs::read(&path).unwrap(), b"older");
        fs::remove_file(&path).unwrap();
        assert_eq!(names(), Vec::<String>::new());
    }
}

#[cfg(unix)]
#[test]
fn a_finished_file_has_the_permissions_of_any_other_and_keeps_its_links() {
    use std::os::unix::fs::PermissionsExt;
    let directory = tempfile::tempdir().unwrap();
    let mode = |name: &str| fs::metadata(directory.path().join(name)).unwrap().permissions().mode();
    fs::write(directory.path().join("other"), "").unwrap();
    fs::write(directory.path().join("real.npy"), "older").unwrap();
    std::os::unix::fs::symlink("real.npy", directory.path().join("link.npy")).unwrap();
    write_closest(&directory.path().join("link.npy"), None).unwrap();
    assert!(fs::symlink_metadata(directory.path().join("link.npy")).unwrap().is_symlink());
    assert_eq!(mode("real.npy"), mode("other"));
}

#[test]
fn places_that_cannot_be_written_are_errors() {
    let directory = tempfile::tempdir().unwrap();
    let create = |path: &Path, format| HitWriter::create(path, format, HitKind::Any, None, &KeptColumns::default());
    assert!(matches!(create(&directory.path().join("none/hits.npy"), None), Err(Error::Io { .. })));
    assert!(matches!(create(directory.path(), Some(Format::Csv)), Err(Error::Io { .. })));
    assert_eq!(bad(create(Path::new("hits.txt"), None)).what, "the ending .txt is not known");
    #[cfg(not(feature = "parquet"))]
    {
        let bad = bad(create(Path::new("hits.parquet"), None));
        assert_eq!(bad.expected, "build it with `--features parquet`, or give .npy or .csv");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_device_is_an_error_and_stays_a_device() {
    use std::os::unix::fs::FileTypeExt;
    for format in [Format::Npy, Format::Csv] {
        let mut writer =
            HitWriter::create(Path::new("/dev/full"), Some(format), HitKind::Any, Some(3), &KeptColumns::default())
                .unwrap();
        writer.write_any(&[0, 1, 0], &Kept::default()).unwrap();
        assert!(matches!(writer.finish(), Err(Error::Io { .. })));
    }
    assert!(fs::metadata("/dev/full").unwrap().file_type().is_char_device());
}
