/// Why a device could not answer.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// No adapter is what was asked for.
    #[error("{wanted}; {there}")]
    NoAdapter {
        /// What was asked for.
        wanted: String,
        /// What there is instead.
        there: String,
    },
    /// The scene needs more than the device has.
    #[error("the scene does not fit the device: {0}")]
    TooLarge(String),
    /// A kernel does not parse, validate or translate: a fault of ours.
    #[error("kernel: {0}")]
    Kernel(String),
    /// The driver reported an error, ran out of memory or was lost.
    #[error("the device failed: {0}")]
    Device(String),
}
