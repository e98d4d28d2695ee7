//! The adapters there are, in a fixed order, and the choice of one.

use crate::Error;
use crate::guard::{caught, room_for_a_driver};

/// Which adapter to open.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Selector {
    /// A hardware GPU, a discrete one first; never a software adapter.
    Hardware,
    /// The best there is, a software adapter last.
    Best,
    /// The one of that number in the list.
    Index(usize),
    /// The first whose name holds that text, letter case aside.
    Name(String),
    /// The one on that PCI bus.
    Pci(String),
}

/// The Vulkan adapters of this machine.
pub(crate) struct Adapters {
    pub(crate) instance: wgpu::Instance,
    pub(crate) all: Vec<wgpu::Adapter>,
}

impl Adapters {
    /// Loads the drivers and asks them.
    pub(crate) fn list() -> Result<Self, Error> {
        room_for_a_driver()?;
        caught(|| {
            let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
            descriptor.backends = wgpu::Backends::VULKAN;
            // Validation layers cost what they find; WGPU_VALIDATION and friends still ask for them.
            descriptor.flags = wgpu::InstanceFlags::empty().with_env();
            let instance = wgpu::Instance::new(descriptor);
            let all = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::VULKAN));
            Self { instance, all }
        })
    }

    /// The adapter that was asked for.
    pub(crate) fn choose(&self, selector: &Selector) -> Result<&wgpu::Adapter, Error> {
        let infos: Vec<wgpu::AdapterInfo> = self.all.iter().map(wgpu::Adapter::get_info).collect();
        Ok(&self.all[choose(&infos, selector)?])
    }
}

/// The driver's name and version.
pub(crate) fn driver(info: &wgpu::AdapterInfo) -> String {
    format!("{} {}", info.driver, info.driver_info).trim().to_owned()
}

/// What kind of thing it is, for people.
pub(crate) fn kind(info: &wgpu::AdapterInfo) -> &'static str {
    match info.device_type {
        wgpu::DeviceType::DiscreteGpu => "discrete GPU",
        wgpu::DeviceType::IntegratedGpu => "integrated GPU",
        wgpu::DeviceType::VirtualGpu => "virtual GPU",
        wgpu::DeviceType::Cpu => "software (CPU)",
        wgpu::DeviceType::Other => "other",
    }
}

fn choose(infos: &[wgpu::AdapterInfo], selector: &Selector) -> Result<usize, Error> {
    use wgpu::DeviceType::{Cpu, DiscreteGpu, IntegratedGpu, Other, VirtualGpu};
    let holds = |name: &str, part: &str| name.to_lowercase().contains(&part.to_lowercase());
    let wanted_name = std::env::var("WGPU_ADAPTER_NAME").ok().filter(|name| !name.is_empty());
    let best = |kinds: &[wgpu::DeviceType]| {
        kinds.iter().find_map(|kind| {
            infos.iter().position(|info| {
                info.device_type == *kind && wanted_name.as_ref().is_none_or(|name| holds(&info.name, name))
            })
        })
    };
    let (found, wanted) = match selector {
        Selector::Hardware => {
            (best(&[DiscreteGpu, IntegratedGpu, VirtualGpu, Other]), "no hardware GPU was found".to_owned())
        }
        Selector::Best => {
            (best(&[DiscreteGpu, IntegratedGpu, VirtualGpu, Other, Cpu]), "no Vulkan adapter was found".to_owned())
        }
        Selector::Index(index) => ((*index < infos.len()).then_some(*index), format!("there is no adapter {index}")),
        Selector::Name(name) => {
            (infos.iter().position(|info| holds(&info.name, name)), format!("no adapter's name holds \"{name}\""))
        }
        Selector::Pci(bus) => (
            infos.iter().position(|info| info.device_pci_bus_id.eq_ignore_ascii_case(bus)),
            format!("no adapter is on PCI bus {bus}"),
        ),
    };
    found.ok_or_else(|| Error::NoAdapter { wanted, there: listing(infos) })
}

/// One line an adapter, as people choose them.
fn listing(infos: &[wgpu::AdapterInfo]) -> String {
    if infos.is_empty() {
        return "no Vulkan driver is installed, or it finds no device; `cpu` is always there".to_owned();
    }
    let lines = infos.iter().enumerate().map(|(index, info)| {
        let bus = match info.device_pci_bus_id.as_str() {
            "" => String::new(),
            bus => format!(", pci:{bus}"),
        };
        format!("\n  index:{index}  {} ({}{bus})", info.name, kind(info))
    });
    format!("there are `cpu` and:{}", lines.collect::<String>())
}
