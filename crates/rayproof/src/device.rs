use std::sync::Arc;

#[cfg(feature = "gpu")]
use rayproof_gpu::{Fingerprint, Handles};

use crate::gpu::{self, Gpu, Selector, describe};
use crate::intersector::cpu_info;
use crate::{DeviceChoice, DeviceInfo, Error, Precision};

/// A device, open: scenes share it, with the kernels it has compiled.
#[derive(Clone)]
pub struct Device {
    /// None is the CPU engine.
    pub(crate) gpu: Option<Arc<Gpu>>,
    /// Why it is the CPU engine, where something else was sought.
    pub(crate) note: Option<String>,
}

impl Device {
    /// Opens the device that was chosen and measures its arithmetic.
    ///
    /// # Errors
    /// When it is not there, or fails.
    pub fn open(choice: &DeviceChoice) -> Result<Self, Error> {
        let Some(selector) = choice.selector() else { return Ok(Self::cpu()) };
        match Gpu::open(&selector) {
            Ok(gpu) => Ok(Self { gpu: Some(gpu.into()), note: None }),
            Err(gpu::Error::NoAdapter { .. }) if selector == Selector::Hardware => {
                Ok(Self { gpu: None, note: Some("no hardware GPU with a Vulkan driver was found".to_owned()) })
            }
            // What a user asked to be written is no matter of the device.
            #[cfg(feature = "gpu")]
            Err(e @ gpu::Error::Dump { .. }) => Err(e.into()),
            Err(e) if selector == Selector::Hardware => {
                Ok(Self { gpu: None, note: Some(format!("the GPU could not be used: {e}")) })
            }
            Err(e) => Err(e.into()),
        }
    }

    /// The CPU engine, which is always there.
    #[must_use]
    pub const fn cpu() -> Self {
        Self { gpu: None, note: None }
    }

    /// Whether it is the CPU engine.
    #[must_use]
    pub const fn is_cpu(&self) -> bool {
        self.gpu.is_none()
    }

    /// Whether it is a processor that runs kernels, and no GPU.
    #[must_use]
    pub fn is_software(&self) -> bool {
        self.gpu.as_ref().is_some_and(|gpu| gpu.is_software())
    }

    /// The device itself, to be shared with what paints a window; none for the CPU engine.
    #[cfg(feature = "gpu")]
    #[must_use]
    pub fn handles(&self) -> Option<Handles> {
        self.gpu.as_ref().map(|gpu| gpu.handles())
    }

    /// Its arithmetic, as kernels run it; none for the CPU engine.
    #[cfg(feature = "gpu")]
    #[must_use]
    pub fn fingerprint(&self) -> Option<&Fingerprint> {
        self.gpu.as_ref().map(|gpu| gpu.fingerprint())
    }

    /// What it is, for a precision.
    #[must_use]
    pub fn info(&self, precision: Precision) -> DeviceInfo {
        match &self.gpu {
            Some(gpu) => describe(gpu, precision),
            None => cpu_info(self.note.clone()),
        }
    }
}
