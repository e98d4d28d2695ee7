//! Which float-control modes the device has: wgpu does not tell, Vulkan does.
#![expect(unsafe_code, reason = "Vulkan's own property query, and nothing else, behind wgpu's handles")]

use crate::spirv::FloatControls;

/// Asks Vulkan; nothing where the adapter is not Vulkan's.
pub(crate) fn query(adapter: &wgpu::Adapter) -> FloatControls {
    // SAFETY: the handles are used only while the adapter is borrowed, and nothing is destroyed through them.
    let Some(adapter) = (unsafe { adapter.as_hal::<wgpu::hal::api::Vulkan>() }) else {
        return FloatControls::default();
    };
    let mut controls = ash::vk::PhysicalDeviceFloatControlsProperties::default();
    let mut properties = ash::vk::PhysicalDeviceProperties2::default().push_next(&mut controls);
    let instance = adapter.shared_instance().raw_instance();
    // SAFETY: the physical device belongs to this instance; wgpu asks for Vulkan 1.1 at least, where the query is core;
    // a driver that does not know the structure leaves it as it is, all false.
    unsafe { instance.get_physical_device_properties2(adapter.raw_physical_device(), &mut properties) };
    FloatControls {
        round_to_nearest_even: controls.shader_rounding_mode_rte_float32 != 0,
        signed_zero_inf_nan_preserve: controls.shader_signed_zero_inf_nan_preserve_float32 != 0,
        denorm_preserve: controls.shader_denorm_preserve_float32 != 0,
    }
}
