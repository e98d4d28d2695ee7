use std::fmt::Write as _;
use std::path::PathBuf;

/// Why a device could not answer. Only [`Unsupported`](Self::Unsupported) and [`TooLarge`](Self::TooLarge) speak of a device
/// that is well: it lacks what was asked for, and another device or precision has it. What is said is said whole: an error
/// here has no source that would say it again.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// No adapter is what was asked for.
    #[error("{wanted}; {there}")]
    NoAdapter {
        /// What was asked for.
        wanted: String,
        /// What there is instead.
        there: String,
    },
    /// The device lacks something, such as `f64` or bounds for its arithmetic.
    #[error("{what}")]
    Unsupported {
        /// Who lacks what.
        what: String,
    },
    /// The scene needs more than the device has.
    #[error("the scene does not fit the device: {what}")]
    TooLarge {
        /// What there is too much of, and what would do.
        what: String,
    },
    /// There was no memory left, on the device or for its driver.
    #[error("the device is out of memory: {what}")]
    OutOfMemory {
        /// What it was wanted for.
        what: String,
    },
    /// The device was lost: reset, unplugged, or its driver gave up. It answers no more; one that is opened anew may.
    #[error("the device was lost: {why}")]
    Lost {
        /// In the driver's words.
        why: String,
    },
    /// The driver failed or panicked.
    #[error("the driver failed: {what}")]
    Driver {
        /// In its own words.
        what: String,
    },
    /// A kernel does not parse, validate or translate: a fault of ours.
    #[error("kernel: {fault}")]
    Kernel {
        /// With the file and the line.
        fault: String,
    },
    /// A kernel cannot be written to the folder that `RAYPROOF_DUMP` names.
    #[error("RAYPROOF_DUMP: {}: {why}", path.display())]
    Dump {
        /// The file, or the folder.
        path: PathBuf,
        /// What the system said.
        why: String,
    },
    /// wgpu refused a call: a fault of ours.
    #[error("a call was refused: {what}")]
    Refused {
        /// Which one, and why.
        what: String,
    },
}

impl From<wgpu::Error> for Error {
    fn from(error: wgpu::Error) -> Self {
        // wgpu's own text is a tree of lines: its causes say the same.
        match error {
            wgpu::Error::OutOfMemory { source } => Self::OutOfMemory { what: causes(source.as_ref()) },
            wgpu::Error::Validation { source, .. } => Self::Refused { what: causes(source.as_ref()) },
            wgpu::Error::Internal { source, .. } => Self::Driver { what: causes(source.as_ref()) },
        }
    }
}

impl From<wgpu::RequestDeviceError> for Error {
    fn from(error: wgpu::RequestDeviceError) -> Self {
        use wgpu::wgc::device::DeviceError;
        // wgpu hides the kind, but not its words.
        let text = causes(&error);
        if text == DeviceError::OutOfMemory.to_string() {
            Self::OutOfMemory { what: "it cannot be opened".to_owned() }
        } else if text == DeviceError::Lost.to_string() {
            Self::Lost { why: "while it was opened".to_owned() }
        } else {
            Self::Driver { what: text }
        }
    }
}

impl Error {
    /// What the device-lost callback was told.
    pub(crate) fn of_loss(text: String) -> Self {
        // wgpu gives a device up that ran out of memory.
        if text == wgpu::hal::DeviceError::OutOfMemory.to_string() {
            return Self::OutOfMemory { what: "and was given up".to_owned() };
        }
        Self::Lost { why: if text.is_empty() { "the driver does not say why".to_owned() } else { text } }
    }
}

/// An error and what it came from, on one line, each thing once.
pub(crate) fn causes(error: &dyn std::error::Error) -> String {
    let mut text = error.to_string();
    let mut next = error.source();
    while let Some(cause) = next {
        let said = cause.to_string();
        if !text.ends_with(&said) {
            let _ = write!(text, ": {said}");
        }
        next = cause.source();
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Debug, thiserror::Error)]
    #[error("the call")]
    struct Call(#[source] Cause);

    #[derive(Debug, thiserror::Error)]
    #[error("{0}")]
    struct Cause(#[source] std::fmt::Error);

    fn call() -> Box<Call> {
        Box::new(Call(Cause(std::fmt::Error)))
    }

    #[test]
    fn kinds_are_kept_apart_and_nothing_is_said_twice() {
        let what = format!("the call: {}", std::fmt::Error);
        let description = String::new();
        let kinds = [
            (wgpu::Error::OutOfMemory { source: call() }, Error::OutOfMemory { what: what.clone() }),
            (
                wgpu::Error::Validation { source: call(), description: description.clone() },
                Error::Refused { what: what.clone() },
            ),
            (wgpu::Error::Internal { source: call(), description }, Error::Driver { what }),
        ];
        for (theirs, ours) in kinds {
            assert_eq!(Error::from(theirs), ours);
            assert!(std::error::Error::source(&ours).is_none());
        }
    }

    #[test]
    fn a_device_that_cannot_be_opened_is_lost_or_out_of_memory() {
        use wgpu::wgc::{device::DeviceError, instance::RequestDeviceError};
        let opened = |error| Error::from(wgpu::RequestDeviceError::from(RequestDeviceError::from(error)));
        assert!(matches!(opened(DeviceError::OutOfMemory), Error::OutOfMemory { .. }));
        assert!(matches!(opened(DeviceError::Lost), Error::Lost { .. }));
        let unsupported = RequestDeviceError::UnsupportedFeature(wgpu::Features::SHADER_F64);
        assert!(matches!(Error::from(wgpu::RequestDeviceError::from(unsupported)), Error::Driver { .. }));
    }

    #[test]
    fn a_device_that_was_given_up_for_want_of_memory_is_not_called_lost() {
        assert!(matches!(Error::of_loss("Out of memory".to_owned()), Error::OutOfMemory { .. }));
        assert_eq!(Error::of_loss("unplugged".to_owned()), Error::Lost { why: "unplugged".to_owned() });
    }
}
