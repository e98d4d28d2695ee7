//! Every adapter, what it is, and how far its arithmetic can be trusted.

use crate::Error;
use crate::adapter::{Adapters, driver, kind};
use crate::context::Context;
use crate::fingerprint::Fingerprint;
use crate::route::Route;
use crate::second_stage::Trials;

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
    pub fingerprints: Vec<Result<Fingerprint, Error>>,
    /// What was tried for the numbers that the precision `exact` computes with after its first pass, or why that failed.
    pub trials: Result<Trials, Error>,
}

/// All Vulkan adapters, each opened and its arithmetic measured on every route it has.
///
/// # Errors
/// When the drivers cannot be asked. An adapter that fails is in the list, and the error in its report.
pub fn adapters() -> Result<Vec<AdapterReport>, Error> {
    let adapters = Adapters::list()?;
    Ok((0..adapters.all.len()).map(|index| report(&adapters, index)).collect())
}

fn report(adapters: &Adapters, index: usize) -> AdapterReport {
    let adapter = &adapters.all[index];
    let info = adapter.get_info();
    let (fingerprints, trials) = match Context::open(adapters, adapter) {
        Err(e) => (vec![Err(e.clone())], Err(e)),
        Ok(context) => (
            Route::TAKEN
                .into_iter()
                .filter(|route| context.has(*route))
                .map(|route| Fingerprint::measure(&context, route))
                .collect(),
            Trials::run(&context, context.best_route()),
        ),
    };
    AdapterReport {
        index,
        driver: driver(&info),
        kind: kind(&info),
        pci_bus: info.device_pci_bus_id.clone(),
        name: info.name,
        max_binding: adapter.limits().max_storage_buffer_binding_size,
        fingerprints,
        trials,
    }
}
