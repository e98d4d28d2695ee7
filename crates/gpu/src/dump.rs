//! `RAYPROOF_DUMP=FOLDER`: each kernel as it is compiled, for eyes and for other tools.

use std::fs;
use std::path::{Path, PathBuf};

use crate::Error;
use crate::kernel::{Kernel, Pass, Query, Walk, Width};
use crate::route::Route;

/// Where kernels are to be written, if anywhere.
pub(crate) fn folder() -> Option<PathBuf> {
    std::env::var_os("RAYPROOF_DUMP").filter(|folder| !folder.is_empty()).map(PathBuf::from)
}

/// Writes a kernel's text, and its SPIR-V on the routes where that is ours, over what the folder holds of that name.
pub(crate) fn write(folder: &Path, name: &str, route: Route, text: &str, spirv: Option<&[u32]>) -> Result<(), Error> {
    let name = match route {
        Route::ExactSpirv => name.to_owned(),
        Route::PlainWgsl => format!("{name}-plain"),
        #[cfg(feature = "measure")]
        Route::FreeSpirv => format!("{name}-free"),
        #[cfg(feature = "measure")]
        Route::UncheckedWgsl => format!("{name}-unchecked"),
    };
    let failed = |path: &Path, e: std::io::Error| Error::Dump { path: path.to_owned(), why: e.to_string() };
    fs::create_dir_all(folder).map_err(|e| failed(folder, e))?;
    let put = |ending: &str, bytes: &[u8]| {
        let path = folder.join(format!("{name}.{ending}"));
        fs::write(&path, bytes).map_err(|e| failed(&path, e))
    };
    put("wgsl", text.as_bytes())?;
    spirv.map_or(Ok(()), |words| put("spv", &words.iter().flat_map(|word| word.to_le_bytes()).collect::<Vec<_>>()))
}

/// What a kernel is called: its part, query, contents and numbers, as `first-closest-triangles-f32`.
pub(crate) fn name(kernel: &Kernel) -> String {
    let (part, numbers) = match kernel.pass {
        Pass::Trace(precision) => ("trace", precision.name()),
        Pass::First(width) => ("first", width_name(width)),
        Pass::Second(width) => ("second", width_name(width)),
        Pass::Round(width) => ("round", width_name(width)),
        Pass::RoundRest(width) => ("round-rest", width_name(width)),
    };
    let query = match kernel.query {
        Query::Closest => "closest",
        Query::Any => "any",
        Query::Count => "count",
    };
    let contents = kernel.kinds.iter().map(|kind| format!("{}s", kind.name())).collect::<Vec<_>>().join("-");
    let every = match kernel.walk {
        Walk::Tree => "",
        Walk::Every => "-every",
    };
    format!("{part}-{query}-{contents}-{numbers}{every}")
}

/// What numbers are called in a file's name.
pub(crate) const fn width_name(width: Width) -> &'static str {
    match width {
        Width::Single => "f32",
        Width::SingleByRule => "f32-by-rule",
        Width::Double => "f64",
        Width::PairOfF32 => "pair-of-f32",
        Width::PairOfF64 => "pair-of-f64",
    }
}

#[cfg(test)]
mod tests {
    use rayproof_scene::{Kinds, Precision};

    use super::*;

    #[test]
    fn no_two_kernels_have_one_name() {
        let parts = Pass::all_exact().chain(Precision::ALL.map(Pass::Trace));
        let mut names = Vec::new();
        for pass in parts {
            for query in Query::ALL {
                for kinds in Kinds::all() {
                    for walk in [Walk::Tree, Walk::Every] {
                        names.push(name(&Kernel { pass, query, kinds, walk }));
                    }
                }
            }
        }
        let all = names.len();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), all);
        assert!(names.iter().any(|name| name == "first-closest-triangles-f32"), "{names:?}");
    }
}
