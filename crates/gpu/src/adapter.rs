//! The adapters there are, in a fixed order, and what each one is.

use crate::fingerprint::{Fingerprint, Route};
use crate::gpu::{Gpu, Selector, instance};

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
    let fingerprints = match Gpu::open(&Selector::Index(index)) {
        Err(e) => vec![Err(e.to_string())],
        Ok(gpu) => Route::ALL
            .into_iter()
            .filter(|route| *route != Route::ExactSpirv || gpu.route() == Route::ExactSpirv)
            .map(|route| Fingerprint::measure(&gpu, route).map_err(|e| e.to_string()))
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
    }
}

/// The driver's name and version.
pub(crate) fn driver(info: &wgpu::AdapterInfo) -> String {
    format!("{} {}", info.driver, info.driver_info).trim().to_owned()
}

pub(crate) fn kind(info: &wgpu::AdapterInfo) -> &'static str {
    match info.device_type {
        wgpu::DeviceType::DiscreteGpu => "discrete GPU",
        wgpu::DeviceType::IntegratedGpu => "integrated GPU",
        wgpu::DeviceType::VirtualGpu => "virtual GPU",
        wgpu::DeviceType::Cpu => "software (CPU)",
        wgpu::DeviceType::Other => "other",
    }
}
