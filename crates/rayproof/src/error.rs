use crate::gpu::Error as DeviceError;
use rayproof_scene::RayFault;
use rayproof_tree::TooLarge;

/// Why an intersector could not be made or could not go on.
#[derive(Clone, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The device asked for is not there, lacks something, or failed: the kinds are kept apart.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// A question that only the precision `exact` answers.
    #[error("only the precision exact answers this")]
    NotExact,
    /// A question that only the CPU engine answers.
    #[error("only the CPU engine answers this")]
    OnDevice,
    /// A ray that is none, where such are refused.
    #[error("ray {index}: {fault}{}", others(*more))]
    InvalidRay {
        /// Its number in the batch.
        index: usize,
        /// What is wrong with it.
        fault: RayFault,
        /// How many more there are in the batch.
        more: usize,
    },
    /// More primitives than a tree can number.
    #[error(transparent)]
    TooLarge(#[from] TooLarge),
}

fn others(more: usize) -> String {
    if more == 0 { String::new() } else { format!(" (the first of {} bad rays)", more + 1) }
}
