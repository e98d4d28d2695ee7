//! A list of any length over as many bindings as the device needs: one binding holds what the device allows, and the
//! accessor that kernels call is written for the number of pages there are.

use std::fmt::Write as _;

use crate::Error;
use crate::context::Context;

/// A list on the device, in pages.
pub(crate) struct Pages {
    pub(crate) buffers: Vec<wgpu::Buffer>,
    shift: u32,
}

impl Pages {
    /// Uploads `bytes`, elements of `stride` bytes (a power of two), in pages of at most the device's binding size.
    pub(crate) fn upload(context: &Context, label: &str, bytes: &[u8], stride: usize) -> Self {
        let shift = (context.max_binding / stride as u64).max(1).ilog2();
        let page = stride << shift;
        let usage = wgpu::BufferUsages::STORAGE;
        let buffers = match bytes.len() {
            // Nothing cannot be bound.
            0 => vec![context.buffer_with(label, &vec![0; stride], usage)],
            _ => bytes.chunks(page).map(|chunk| context.buffer_with(label, chunk, usage)).collect(),
        };
        Self { buffers, shift }
    }

    /// WGSL: the bindings from `first` on, and `fn name(i: u32) -> element`.
    pub(crate) fn accessor(&self, name: &str, element: &str, first: usize) -> String {
        let mut text = String::new();
        for page in 0..self.buffers.len() {
            let _ = writeln!(
                text,
                "@group(0) @binding({}) var<storage, read> {name}_{page}: array<{element}>;",
                first + page
            );
        }
        let _ = writeln!(text, "fn {name}(i: u32) -> {element} {{");
        if self.buffers.len() == 1 {
            let _ = writeln!(text, "    return {name}_0[i];");
        } else {
            let offset = (1_u64 << self.shift) - 1;
            let _ = writeln!(text, "    let offset = i & {offset}u;\n    switch i >> {}u {{", self.shift);
            for page in 1..self.buffers.len() {
                let _ = writeln!(text, "        case {page}u: {{ return {name}_{page}[offset]; }}");
            }
            let _ = writeln!(text, "        default: {{ return {name}_0[offset]; }}\n    }}");
        }
        text.push_str("}\n");
        text
    }
}

/// Whether `bindings` storage buffers fit a kernel.
pub(crate) fn check_bindings(context: &Context, bindings: usize) -> Result<(), Error> {
    let most = context.limits.max_storage_buffers_per_shader_stage as usize;
    if bindings <= most {
        return Ok(());
    }
    let what = format!(
        "it takes {bindings} bindings of {} bytes and a kernel has {most}; use a device with larger bindings or `cpu`",
        context.max_binding
    );
    Err(Error::TooLarge { what })
}
