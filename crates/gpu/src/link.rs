//! Joining WGSL files: declarations come in any order, so joining is linking.

use std::ops::Range;

use crate::Error;
use crate::error::causes;

/// Files joined to one module, and where each one's lines went.
#[derive(Clone, Debug, Default)]
pub struct Linked {
    source: String,
    parts: Vec<(&'static str, Range<usize>)>,
}

impl Linked {
    /// Adds a file under the path that messages will name.
    pub fn add(&mut self, path: &'static str, source: &str) {
        let first = self.source.lines().count();
        self.source.push_str(source);
        if !source.ends_with('\n') {
            self.source.push('\n');
        }
        self.parts.push((path, first..self.source.lines().count()));
    }

    /// The joined text.
    #[must_use]
    pub fn source(&self) -> &str {
        &self.source
    }

    /// The file and line, both as people count, of a line of the joined text.
    #[must_use]
    pub fn locate(&self, line: usize) -> Option<(&'static str, usize)> {
        let index = line.checked_sub(1)?;
        let (path, lines) = self.parts.iter().find(|(_, lines)| lines.contains(&index))?;
        Some((path, line - lines.start))
    }

    /// Parses and validates the module.
    ///
    /// # Errors
    /// With the file and line of the first fault.
    pub fn validate(&self) -> Result<(naga::Module, naga::valid::ModuleInfo), Error> {
        let module = naga::front::wgsl::parse_str(&self.source)
            .map_err(|e| self.fault(e.message(), e.location(&self.source)))?;
        // Kernels of wider numbers are run only where the device has them.
        let capabilities = naga::valid::Capabilities::FLOAT64;
        let info = naga::valid::Validator::new(naga::valid::ValidationFlags::all(), capabilities)
            .validate(&module)
            .map_err(|e| self.fault(&causes(e.as_inner()), e.location(&self.source)))?;
        Ok((module, info))
    }

    fn fault(&self, message: &str, location: Option<naga::SourceLocation>) -> Error {
        let place = location.and_then(|l| self.locate(l.line_number as usize));
        let fault = match place {
            Some((path, line)) => format!("{path}:{line}: {message}"),
            None => message.to_owned(),
        };
        Error::Kernel { fault }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fault_is_named_by_its_file_and_line() {
        let mut linked = Linked::default();
        linked.add("one.wgsl", "fn one() -> f32 {\n    return 1.0;\n}");
        linked.add("two.wgsl", "fn two() -> f32 {\n    return one() + nothing;\n}\n");
        assert_eq!(linked.locate(1), Some(("one.wgsl", 1)));
        assert_eq!(linked.locate(5), Some(("two.wgsl", 2)));
        assert_eq!(linked.locate(7), None);
        assert_eq!(linked.locate(0), None);
        let message = linked.validate().expect_err("`nothing` is not defined").to_string();
        assert!(message.starts_with("kernel: two.wgsl:2: "), "{message}");
    }
}
