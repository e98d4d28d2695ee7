//! The adapters there are, in a fixed order, and what each one is.

use crate::Error;
use crate::fingerprint::{Fingerprint, Route};
use crate::gpu::{Gpu, Selector, instance};
use crate::second_stage::SecondStage;

/// One line of `rayproof devices`.
#[derive(Clone, Debug)]
pub struct AdapterReport {
    /// Its number, for `index:N`.
    pub index: usize,
    /// Its name, for `name:S`.
    pub name: String,
    /// The driver and its version.
    pub driver: String,
    /// `discrete GPU`, `integrated GPU`, `virtual GPU`, `software (CPU)` or `other`.
    pub kind: &'static str,
    /// The PCI bus, for `pci:BUS`; empty where it has none.
    pub pci_bus: String,
    /// The largest storage binding, in bytes.
    pub max_binding: u64,
    /// The arithmetic as kernels run it, and as plain WGSL, or why it could not be measured.
    pub fingerprints: Vec<Result<Fingerprint, String>>,
    /// The numbers that the precision `exact` computes with after its first pass; none where it does not run, or the device failed.
    pub second_stage: Option<SecondStage>,
}

/// All Vulkan adapters, each opened and its arithmetic measured on every route it has.
#[must_use]
pub fn adapters() -> Vec<AdapterReport> {
    let instance = instance();
    let found = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::VULKAN));
    found.iter().enumerate().map(|(index, adapter)| report(index, adapter)).collect()
}

fn report(index: usize, adapter: &wgpu::Adapter) -> AdapterReport {
    let info = adapter.get_info();
    let gpu = Gpu::open(&Selector::Index(index));
    let second_stage = gpu.as_ref().ok().and_then(|gpu| gpu.second_stage().ok().flatten());
    let fingerprints = match gpu {
        Err(e) => vec![Err(e.to_string())],
        Ok(gpu) => Route::TAKEN
            .into_iter()
            .filter(|route| *route != Route::ExactSpirv || gpu.route() == Route::ExactSpirv)
            .map(|route| match gpu.fingerprint() {
                // Opening measured the route that kernels take.
                Some(known) if known.route == route => Ok(*known),
                _ => Fingerprint::measure(&gpu, route).map_err(|e| e.to_string()),
            })
            .collect(),
    };
    AdapterReport {
        index,
        driver: driver(&info),
        kind: kind(&info),
        pci_bus: info.device_pci_bus_id.clone(),
        name: info.name,
        max_binding: adapter.limits().max_storage_buffer_binding_size,
        fingerprints,
        second_stage,
    }
}

/// The driver's name and version.
pub(crate) fn driver(info: &wgpu::AdapterInfo) -> String {
    format!("{} {}", info.driver, info.driver_info).trim().to_owned()
}

fn kind(info: &wgpu::AdapterInfo) -> &'static str {
    match info.device_type {
        wgpu::DeviceType::DiscreteGpu => "discrete GPU",
        wgpu::DeviceType::IntegratedGpu => "integrated GPU",
        wgpu::DeviceType::VirtualGpu => "virtual GPU",
        wgpu::DeviceType::Cpu => "software (CPU)",
        wgpu::DeviceType::Other => "other",
    }
}

/// The adapter that was asked for.
pub(crate) fn choose(infos: &[wgpu::AdapterInfo], selector: &Selector) -> Result<usize, Error> {
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
