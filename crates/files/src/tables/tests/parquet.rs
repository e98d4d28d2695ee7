use std::fs::{self, File};
use std::path::Path;
use std::sync::Arc;

use arrow::array::{Array, ArrayRef, Float32Array, Float64Array, Int32Array, RecordBatch, UInt8Array, UInt32Array};
use glam::Vec3;
use parquet::arrow::ArrowWriter;
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use parquet::file::properties::WriterProperties;

use super::{bad, drain, read_file, some_rays};
use crate::{HitKind, HitWriter, INVALID_RAY, InvalidRays, Kept, KeptColumns, RayReader, RayWriter};
use rayproof_scene::Hit;

const NAMES: [&str; 6] = ["ox", "oy", "oz", "dx", "dy", "dz"];

/// Writes these columns in row groups of two rows.
fn write(path: &Path, columns: Columns) {
    let batch = RecordBatch::try_from_iter(columns).unwrap();
    let properties = WriterProperties::builder().set_max_row_group_row_count(Some(2)).build();
    let mut writer = ArrowWriter::try_new(File::create(path).unwrap(), batch.schema(), Some(properties)).unwrap();
    writer.write(&batch).unwrap();
    writer.close().unwrap();
}

fn f32s(values: &[f32]) -> ArrayRef {
    Arc::new(Float32Array::from(values.to_vec()))
}

/// Columns by name.
type Columns = Vec<(&'static str, ArrayRef)>;

/// Six good columns of three rows.
fn good() -> Columns {
    NAMES.iter().map(|&name| (name, f32s(&[1.0, 2.0, 3.0]))).collect()
}

#[test]
fn columns_of_both_types_are_read_across_row_groups() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("rays.parquet");
    let mut columns = good();
    columns[0].1 = Arc::new(Float64Array::from(vec![0.1, 0.5, 1e-300]));
    columns.reverse();
    write(&path, columns);
    let mut reader = RayReader::open(&path, None, InvalidRays::Error).unwrap();
    let rays = drain(&mut reader, 2).unwrap();
    assert_eq!(
        rays.iter().map(|r| r.origin).collect::<Vec<_>>(),
        [Vec3::new(0.1, 1.0, 1.0), Vec3::new(0.5, 2.0, 2.0), Vec3::new(0.0, 3.0, 3.0)]
    );
    assert_eq!((reader.total(), reader.rounding().values, rays[2].t_max), (Some(3), 2, f32::INFINITY));
}

#[test]
fn columns_that_are_not_of_a_table_of_rays_say_so() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("rays.parquet");
    let ints: ArrayRef = Arc::new(Int32Array::from(vec![1, 2, 3]));
    let case = |change: &dyn Fn(&mut Columns)| {
        let mut columns = good();
        change(&mut columns);
        write(&path, columns);
        bad(read_file(&path)).what
    };
    assert_eq!(case(&|c| c[2].1 = Arc::clone(&ints)), "the column oz is of type Int32");
    assert_eq!(case(&|c| drop(c.remove(5))), "the column dz is missing");
    assert_eq!(case(&|c| c.push(("t_min", f32s(&[0.0; 3])))), "the column t_max is missing");
    let near = "`t_Max_` is not the name of a column, and t_max may be meant";
    assert_eq!(case(&|c| c.push(("t_Max_", f32s(&[0.0; 3])))), near);
    let null: ArrayRef = Arc::new(Float32Array::from(vec![Some(1.0), Some(1.0), None]));
    assert_eq!(case(&|c| c[3].1 = Arc::clone(&null)), "dx is null");
    assert_eq!(bad(read_file(&path)).place, "row 2 (counting from 0)");
}

#[test]
fn other_columns_of_any_type_are_passed_over() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("rays.parquet");
    write(&path, good());
    let plain = read_file(&path).unwrap();
    let mut columns = good();
    columns.insert(2, ("id", Arc::new(Int32Array::from(vec![1, 2, 3]))));
    columns.push(("weight", f32s(&[f32::NAN; 3])));
    write(&path, columns);
    assert_eq!(read_file(&path).unwrap(), plain);
}

#[test]
fn bad_rays_are_named_and_counted() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("rays.parquet");
    let mut columns = good();
    columns[1].1 = f32s(&[1.0, f32::NAN, f32::NAN]);
    write(&path, columns);
    let first = bad(read_file(&path));
    assert_eq!((first.place.as_str(), first.more), ("row 1 (counting from 0)", 1));
    let mut reader = RayReader::open(&path, None, InvalidRays::Miss).unwrap();
    assert_eq!(drain(&mut reader, 5).unwrap()[1..], [INVALID_RAY; 2]);
    assert_eq!(reader.invalid(), 2);
}

#[test]
fn a_file_cut_anywhere_is_bad() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("rays.parquet");
    let mut writer = RayWriter::create(&path, None, true, None).unwrap();
    writer.write(&some_rays(4)).unwrap();
    writer.finish().unwrap();
    let whole = fs::read(&path).unwrap();
    for cut in 0..whole.len() {
        fs::write(&path, &whole[..cut]).unwrap();
        assert_eq!(bad(read_file(&path)).place, "footer", "cut at {cut}");
    }
}

#[test]
fn hits_have_the_columns_of_the_contract() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("hits.parquet");
    let mut writer = HitWriter::create(&path, None, HitKind::Closest, Some(2), &KeptColumns::default()).unwrap();
    writer
        .write_closest(&[Hit { t: 0.1, u: 0.2, v: 0.3, geometry: 1, primitive: 7 }, Hit::MISS], &Kept::default())
        .unwrap();
    writer.finish().unwrap();
    let mut reader = ParquetRecordBatchReaderBuilder::try_new(File::open(&path).unwrap()).unwrap().build().unwrap();
    let batch = reader.next().unwrap().unwrap();
    let schema = batch.schema();
    let names: Vec<&str> = schema.fields().iter().map(|f| f.name().as_str()).collect();
    assert_eq!(names, ["t", "u", "v", "geometry", "primitive"]);
    let floats = |i: usize| batch.column(i).as_any().downcast_ref::<Float32Array>().unwrap().values().to_vec();
    let words = |i: usize| batch.column(i).as_any().downcast_ref::<UInt32Array>().unwrap().values().to_vec();
    assert_eq!([floats(0), floats(1), floats(2)], [vec![0.1, f32::INFINITY], vec![0.2, 0.0], vec![0.3, 0.0]]);
    assert_eq!([words(3), words(4)], [vec![1, u32::MAX], vec![7, u32::MAX]]);

    let mut writer = HitWriter::create(&path, None, HitKind::Any, None, &KeptColumns::default()).unwrap();
    writer.write_any(&[1, 0], &Kept::default()).unwrap();
    writer.finish().unwrap();
    let mut reader = ParquetRecordBatchReaderBuilder::try_new(File::open(&path).unwrap()).unwrap().build().unwrap();
    let batch = reader.next().unwrap().unwrap();
    let hit = batch.column_by_name("hit").unwrap().as_any().downcast_ref::<UInt8Array>().unwrap();
    assert_eq!((hit.values().to_vec(), hit.null_count()), (vec![1, 0], 0));
}
