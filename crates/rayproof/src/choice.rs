use std::fmt;
use std::str::FromStr;

use rayproof_scene::{InvalidRays, Precision};

use crate::gpu::Selector;

/// Which device answers.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum DeviceChoice {
    /// A hardware GPU if there is one, else the CPU engine; never a software adapter.
    #[default]
    Auto,
    /// The CPU engine.
    Cpu,
    /// The best Vulkan adapter, a software one last.
    Gpu,
    /// The adapter of that number in the list of `rayproof::adapters`.
    Index(usize),
    /// The first adapter whose name holds that text, letter case aside.
    Name(String),
    /// The adapter on that PCI bus, as `0000:01:00.0`.
    Pci(String),
}

impl DeviceChoice {
    /// The adapter it stands for; `None` for the CPU engine.
    pub(crate) fn selector(&self) -> Option<Selector> {
        Some(match self {
            Self::Cpu => return None,
            Self::Auto => Selector::Hardware,
            Self::Gpu => Selector::Best,
            Self::Index(index) => Selector::Index(*index),
            Self::Name(name) => Selector::Name(name.clone()),
            Self::Pci(bus) => Selector::Pci(bus.clone()),
        })
    }
}

/// Text that names no device.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("\"{0}\" names no device; give auto, cpu, gpu, index:N, name:TEXT or pci:BUS")]
pub struct NotADevice(String);

impl FromStr for DeviceChoice {
    type Err = NotADevice;

    fn from_str(text: &str) -> Result<Self, NotADevice> {
        let fault = || NotADevice(text.to_owned());
        match text.split_once(':') {
            None => match text {
                "auto" => Ok(Self::Auto),
                "cpu" => Ok(Self::Cpu),
                "gpu" => Ok(Self::Gpu),
                _ => Err(fault()),
            },
            Some((_, "")) => Err(fault()),
            Some(("index", number)) => number.parse().map(Self::Index).map_err(|_| fault()),
            Some(("name", name)) => Ok(Self::Name(name.to_owned())),
            Some(("pci", bus)) => Ok(Self::Pci(bus.to_owned())),
            Some(_) => Err(fault()),
        }
    }
}

impl fmt::Display for DeviceChoice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Auto => f.write_str("auto"),
            Self::Cpu => f.write_str("cpu"),
            Self::Gpu => f.write_str("gpu"),
            Self::Index(index) => write!(f, "index:{index}"),
            Self::Name(name) => write!(f, "name:{name}"),
            Self::Pci(bus) => write!(f, "pci:{bus}"),
        }
    }
}

/// What an [`Intersector`](crate::Intersector) is made for.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// How hits are computed.
    pub precision: Precision,
    /// Which device answers.
    pub device: DeviceChoice,
    /// What becomes of rays that are none (see [`Ray::fault`](rayproof_scene::Ray::fault)).
    pub invalid_rays: InvalidRays,
}

/// The device an [`Intersector`](crate::Intersector) runs on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DeviceInfo {
    /// The adapter's name, or `CPU engine, N threads`.
    pub name: String,
    /// The driver and its version; for the CPU engine its own.
    pub driver: String,
    /// What the user should know about it; empty where nothing.
    pub notes: Vec<String>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn choices_read_back() {
        for text in ["auto", "cpu", "gpu", "index:3", "name:RTX: 4090", "pci:0000:01:00.0"] {
            assert_eq!(text.parse::<DeviceChoice>().map(|choice| choice.to_string()).as_deref(), Ok(text));
        }
        for text in ["", "GPU", "index:", "index:-1", "name:", "cuda:0", "pci:"] {
            assert!(text.parse::<DeviceChoice>().is_err(), "{text}");
        }
    }
}
