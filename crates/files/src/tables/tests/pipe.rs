use std::io::Write;
use std::path::Path;
use std::sync::{Arc, Mutex};

use crate::tables::output::Output;
use crate::tables::table::{Kind, Layout, TableWriter};
use crate::{Format, Kept, KeptColumns};

/// The far end of a pipe.
#[derive(Clone, Default)]
struct Pipe(Arc<Mutex<Vec<u8>>>);

impl Write for Pipe {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.lock().unwrap().write(bytes)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_pipe_gets_the_same_bytes_whether_the_rows_were_announced_or_not() {
    let layout = Layout { columns: vec![("count", Kind::U32)], kept: KeptColumns::default(), matrix: false };
    for format in [Format::Npy, Format::Csv] {
        let written = [None, Some(2)].map(|total: Option<u64>| {
            let pipe = Pipe::default();
            let output = Output::stream(Box::new(pipe.clone()), format == Format::Npy && total.is_none()).unwrap();
            let mut table = TableWriter::new(Path::new("-"), format, layout.clone(), total, output).unwrap();
            table.write(&[1, 0, 0, 0, 2, 0, 0, 0], &Kept::default(), 0).unwrap();
            table.finish().unwrap();
            let bytes = pipe.0.lock().unwrap();
            bytes.clone()
        });
        assert_eq!(written[0], written[1]);
        match format {
            Format::Npy => assert_eq!(npyz::NpyFile::new(&written[0][..]).unwrap().shape(), &[2]),
            _ => assert_eq!(written[0], b"count\n1\n2\n"),
        }
    }
}
