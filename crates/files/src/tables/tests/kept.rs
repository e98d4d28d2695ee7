//! Columns that are passed on to the hits.

use std::fs;
use std::path::Path;

use super::{bad, some_rays};
use crate::{Error, Format, HitKind, HitWriter, InvalidRays, Kept, RayReader};

const CSV: &str = "id,ox,oy,oz,dx,dy,dz,\"a \"\"b\"\"\"\n\
                   7,0,0,0,1,0,0,plain\n\
                   0x8,1,0,0,1,0,0,\"x, \"\"y\"\" #\"\n\
                   9,2,0,0,1,0,0,\n\
                   10,3,0,0,1,0,0, spaced \n";

/// What becomes of a table whose columns are kept, batch by batch.
fn pass_on(from: &Path, to: &Path, names: &[&str], batch: usize) -> Result<(), Error> {
    let mut reader = RayReader::open(from, None, InvalidRays::Error)?;
    let columns = reader.keep(&names.iter().map(|&name| name.to_owned()).collect::<Vec<_>>())?;
    let mut writer = HitWriter::create(to, None, HitKind::Count, None, &columns)?;
    let (mut rays, mut kept, mut counts) = (Vec::new(), Kept::default(), 0..);
    while reader.next_batch(&mut rays, batch)? > 0 {
        reader.take_kept(&mut kept);
        let counts: Vec<u32> = counts.by_ref().take(rays.len()).collect();
        writer.write_count(&counts, &kept)?;
    }
    writer.finish()
}

#[test]
fn text_is_passed_on_as_it_was_in_the_order_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let [rays, hits] = ["rays.csv", "hits.csv"].map(|name| folder.path().join(name));
    fs::write(&rays, CSV).unwrap();
    for batch in 1..6 {
        pass_on(&rays, &hits, &["a \"b\"", "id"], batch).unwrap();
        let want = "count,\"a \"\"b\"\"\",id\n0,plain,7\n1,\"x, \"\"y\"\" #\",0x8\n2,,9\n3, spaced ,10\n";
        assert_eq!(fs::read_to_string(&hits).unwrap(), want, "batches of {batch}");
    }
    // Lines that end as Windows has them, and a part of the table.
    fs::write(&rays, CSV.replace('\n', "\r\n")).unwrap();
    let mut reader = RayReader::open(&rays, None, InvalidRays::Error).unwrap();
    let columns = reader.keep(&["id".into()]).unwrap();
    assert_eq!(reader.passed_over(&columns).unwrap(), "the column `a \"b\"` is passed over");
    reader.select(1..3).unwrap();
    let mut kept = Kept::default();
    assert_eq!(reader.next_batch(&mut Vec::new(), 9).unwrap(), 2);
    reader.take_kept(&mut kept);
    let mut lines = Vec::new();
    let rows = kept.lines().unwrap();
    (0..2).for_each(|row| rows.write(&mut lines, row).unwrap());
    assert_eq!(lines, b",0x8,9");
}

#[test]
fn what_cannot_be_kept_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let [rays, hits, npy] = ["rays.csv", "hits.csv", "hits.npy"].map(|name| folder.path().join(name));
    fs::write(&rays, CSV).unwrap();
    let missing = bad(pass_on(&rays, &hits, &["ID"], 9));
    assert_eq!(missing.what, "there is no column `ID`");
    assert_eq!(missing.expected, "keep some of `id,ox,oy,oz,dx,dy,dz,a \"b\"`");
    assert_eq!(bad(pass_on(&rays, &npy, &["id"], 9)).what, ".npy has no place for them");
    assert_eq!(bad(pass_on(&rays, &hits, &["id", "id"], 9)).what, "there would be two columns `id`");
    fs::write(&rays, CSV.replace("id,", "count,")).unwrap();
    assert_eq!(bad(pass_on(&rays, &hits, &["count"], 9)).what, "there would be two columns `count`");
    let mut writer = crate::RayWriter::create(&npy, Some(Format::Npy), false, None).unwrap();
    writer.write(&some_rays(2)).unwrap();
    writer.finish().unwrap();
    assert_eq!(bad(pass_on(&npy, &hits, &["ox"], 9)).what, ".npy rays have no columns to pass on");
    assert!(!hits.exists());
}

#[test]
#[should_panic(expected = "rows of kept columns")]
fn rows_that_were_not_kept_cannot_be_written() {
    let folder = tempfile::tempdir().unwrap();
    let rays = folder.path().join("rays.csv");
    fs::write(&rays, CSV).unwrap();
    let mut reader = RayReader::open(&rays, None, InvalidRays::Error).unwrap();
    let columns = reader.keep(&["id".into()]).unwrap();
    let mut writer = HitWriter::create(&folder.path().join("hits.csv"), None, HitKind::Any, None, &columns).unwrap();
    let _ = writer.write_any(&[1], &Kept::default());
}

#[cfg(feature = "parquet")]
mod typed {
    use std::fs::File;
    use std::sync::Arc;

    use arrow::array::{Array, ArrayRef, Float32Array, Int64Array, RecordBatch, StringArray};
    use parquet::arrow::ArrowWriter;
    use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
    use parquet::file::properties::WriterProperties;

    use super::*;

    fn read(path: &Path) -> RecordBatch {
        let reader = ParquetRecordBatchReaderBuilder::try_new(File::open(path).unwrap()).unwrap().build().unwrap();
        let batches: Vec<RecordBatch> = reader.map(Result::unwrap).collect();
        arrow::compute::concat_batches(&batches[0].schema(), &batches).unwrap()
    }

    #[test]
    fn columns_keep_their_type_and_their_nulls() {
        let folder = tempfile::tempdir().unwrap();
        let [rays, hits, text] = ["rays.parquet", "hits.parquet", "hits.csv"].map(|name| folder.path().join(name));
        let f32s = |values: [f32; 5]| -> ArrayRef { Arc::new(Float32Array::from(values.to_vec())) };
        let ids: ArrayRef = Arc::new(Int64Array::from(vec![Some(1 << 60), None, Some(-3), Some(4), Some(5)]));
        let names: ArrayRef = Arc::new(StringArray::from(vec!["a", "b,c", "", "d", "\"e\""]));
        let weights = f32s([0.1, 1e30, -0.0, 4.0, 5.0]);
        let batch = RecordBatch::try_from_iter([
            ("name", Arc::clone(&names)),
            ("ox", f32s([0.0, 1.0, 2.0, 3.0, 4.0])),
            ("oy", f32s([0.0; 5])),
            ("id", Arc::clone(&ids)),
            ("oz", f32s([0.0; 5])),
            ("dx", f32s([1.0; 5])),
            ("dy", f32s([0.0; 5])),
            ("dz", f32s([0.0; 5])),
            ("weight", Arc::clone(&weights)),
        ]);
        let properties = WriterProperties::builder().set_max_row_group_row_count(Some(2)).build();
        let batch = batch.unwrap();
        let mut writer = ArrowWriter::try_new(File::create(&rays).unwrap(), batch.schema(), Some(properties)).unwrap();
        writer.write(&batch).unwrap();
        writer.close().unwrap();
        for batch in 1..6 {
            pass_on(&rays, &hits, &["weight", "name", "id"], batch).unwrap();
            let read = read(&hits);
            let columns: Vec<String> = read.schema().fields().iter().map(|field| field.name().clone()).collect();
            assert_eq!(columns, ["count", "weight", "name", "id"]);
            for (i, want) in [&weights, &names, &ids].into_iter().enumerate() {
                assert_eq!(read.column(i + 1).to_data(), want.to_data(), "column {i}, batches of {batch}");
            }
            pass_on(&rays, &text, &["weight", "name", "id"], batch).unwrap();
            let want = "count,weight,name,id\n0,0.1,a,1152921504606846976\n1,1e30,\"b,c\",\n2,-0.0,,-3\n3,4.0,d,4\n4,5.0,\"\"\"e\"\"\",5\n";
            assert_eq!(fs::read_to_string(&text).unwrap(), want);
        }
        // From text, into text.
        fs::write(folder.path().join("rays.csv"), CSV).unwrap();
        pass_on(&folder.path().join("rays.csv"), &hits, &["id"], 3).unwrap();
        let read = read(&hits);
        let ids = read.column(1).as_any().downcast_ref::<StringArray>().unwrap();
        assert_eq!(ids.iter().map(Option::unwrap).collect::<Vec<_>>(), ["7", "0x8", "9", "10"]);
    }
}
