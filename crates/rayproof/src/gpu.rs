//! A Vulkan device as the library takes it: where a precision runs on it, and what a user should know of it.

use std::sync::Arc;

pub use rayproof_gpu::Error;
pub(crate) use rayproof_gpu::{Engine, Gpu, Open, Selector};
use rayproof_tree::Bvh;

use crate::{Device, DeviceInfo, Precision};

/// The device, where the precision runs on it with this scene; else why the CPU engine takes its place, if there was one.
pub(crate) fn suited<'d>(
    device: &'d Device,
    bvh: &Bvh,
    precision: Precision,
) -> Result<Result<&'d Arc<Gpu>, Option<String>>, Error> {
    let Some(gpu) = &device.gpu else { return Ok(Err(device.note.clone())) };
    Ok(match (precision, gpu.refuses(precision, bvh)?) {
        // Asked for by name, and nothing else computes so: the engine's error says why.
        (_, None) | (Precision::Double, _) => Ok(gpu),
        (Precision::Exact, Some(why)) => {
            Err(Some(format!("{} is not used: {why}; the answers are as exact", gpu.name())))
        }
        (_, Some(why)) => Err(Some(format!("{} is not used: {why}; the CPU engine answers", gpu.name()))),
    })
}

pub(crate) fn describe(gpu: &Gpu, precision: Precision) -> DeviceInfo {
    let mut notes = Vec::new();
    let fingerprint = gpu.fingerprint();
    if precision != Precision::Exact && !fingerprint.is_ieee() {
        notes.push(format!(
            "this device's f32 arithmetic ({}) is {}: its bits may differ from the CPU's; see `rayproof devices`",
            fingerprint.route,
            fingerprint.arithmetic()
        ));
    }
    if let (Precision::Exact, Ok(Some(second))) = (precision, gpu.second_stage())
        && !(fingerprint.is_ieee() && second.rest.is_some())
    {
        notes.push(format!(
            "this device's f32 arithmetic is {}: exact by f32, then {second}, then the CPU",
            fingerprint.arithmetic()
        ));
    }
    DeviceInfo { name: gpu.name().to_owned(), driver: gpu.driver(), notes }
}
