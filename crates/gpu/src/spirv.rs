//! SPIR-V with exact `f32` rules: what naga writes, plus `NoContraction` on every float operation and the float-control
//! modes that the device has.
//!
//! Without the decoration Vulkan lets a driver rearrange by associativity and distributivity (`a + b - a -> b` is the
//! specification's own example, and Mesa does it) and contract to fused operations.

use spirv::{Capability, Decoration, ExecutionMode, GlslStd450Op, Op};

use crate::Error;

/// The float-control modes a device has for `f32` (Vulkan's `VkPhysicalDeviceFloatControlsProperties`).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct FloatControls {
    pub(crate) round_to_nearest_even: bool,
    pub(crate) signed_zero_inf_nan_preserve: bool,
    pub(crate) denorm_preserve: bool,
}

/// The words of a module before its first instruction.
const HEADER: usize = 5;

/// Whether an instruction is one of those that round floats.
const fn is_float_arithmetic(op: Op) -> bool {
    matches!(
        op,
        Op::FNegate
            | Op::FAdd
            | Op::FSub
            | Op::FMul
            | Op::FDiv
            | Op::FRem
            | Op::FMod
            | Op::VectorTimesScalar
            | Op::MatrixTimesScalar
            | Op::VectorTimesMatrix
            | Op::MatrixTimesVector
            | Op::MatrixTimesMatrix
            | Op::OuterProduct
            | Op::Dot
    )
}

/// Whether an extended instruction rounds floats. (min, max and abs round nothing.)
fn is_float_extended(number: u32) -> bool {
    use GlslStd450Op::{Fma, InverseSqrt, Sqrt};
    matches!(GlslStd450Op::from_u32(number), Some(Sqrt | InverseSqrt | Fma))
}

/// Whether an instruction is a type or a constant: the first of them ends the annotations.
const fn begins_types(op: Op) -> bool {
    let number = op as u32;
    (Op::TypeVoid as u32 <= number && number <= Op::TypeForwardPointer as u32)
        || (Op::ConstantTrue as u32 <= number && number <= Op::SpecConstantOp as u32)
}

fn instruction(op: Op, operands: &[u32]) -> Vec<u32> {
    let words = u32::try_from(operands.len() + 1).expect("an instruction is short");
    std::iter::once((words << 16) | op as u32).chain(operands.iter().copied()).collect()
}

/// A literal string as words: UTF-8, ended by zeros.
fn literal(text: &str) -> Vec<u32> {
    let mut bytes = text.as_bytes().to_vec();
    bytes.resize(text.len() / 4 * 4 + 4, 0);
    bytes.chunks_exact(4).map(|c| u32::from_le_bytes([c[0], c[1], c[2], c[3]])).collect()
}

/// Each instruction's place, opcode and words.
fn instructions(words: &[u32]) -> impl Iterator<Item = (usize, Op, &[u32])> {
    let mut at = HEADER;
    std::iter::from_fn(move || {
        let word = *words.get(at)?;
        let length = (word >> 16) as usize;
        let op = Op::from_u32(word & 0xffff).expect("naga writes opcodes of the specification");
        let found = (at, op, words.get(at..at + length.max(1))?);
        at += length.max(1);
        Some(found)
    })
}

/// Writes a module and makes its `f32` arithmetic exact.
pub(crate) fn exact(
    module: &naga::Module,
    info: &naga::valid::ModuleInfo,
    controls: FloatControls,
) -> Result<Vec<u32>, Error> {
    Ok(decorate(&write(module, info)?, controls))
}

/// Writes a module as it is: a driver may rearrange its arithmetic.
#[cfg(feature = "measure")]
pub(crate) fn free(module: &naga::Module, info: &naga::valid::ModuleInfo) -> Result<Vec<u32>, Error> {
    write(module, info)
}

/// Naga's SPIR-V. Indices come from trees of our own and are not checked; loops are known to end.
fn write(module: &naga::Module, info: &naga::valid::ModuleInfo) -> Result<Vec<u32>, Error> {
    use naga::back::spv;
    let options = spv::Options {
        lang_version: (1, 3),
        flags: spv::WriterFlags::empty(),
        bounds_check_policies: naga::proc::BoundsCheckPolicies::default(),
        force_loop_bounding: false,
        ..spv::Options::default()
    };
    spv::write_vec(module, info, &options, None).map_err(|e| Error::Kernel { fault: e.to_string() })
}

fn decorate(words: &[u32], controls: FloatControls) -> Vec<u32> {
    let modes: Vec<(ExecutionMode, Capability)> = [
        (controls.round_to_nearest_even, (ExecutionMode::RoundingModeRTE, Capability::RoundingModeRTE)),
        (
            controls.signed_zero_inf_nan_preserve,
            (ExecutionMode::SignedZeroInfNanPreserve, Capability::SignedZeroInfNanPreserve),
        ),
        (controls.denorm_preserve, (ExecutionMode::DenormPreserve, Capability::DenormPreserve)),
    ]
    .into_iter()
    .filter_map(|(has, mode)| has.then_some(mode))
    .collect();

    let mut capabilities: Vec<u32> =
        modes.iter().flat_map(|&(_, capability)| instruction(Op::Capability, &[capability as u32])).collect();
    if !modes.is_empty() {
        capabilities.extend(instruction(Op::Extension, &literal("SPV_KHR_float_controls")));
    }
    let mut execution_modes = Vec::new();
    let mut decorations = Vec::new();
    // Where the three are put: before the first instruction after the capabilities, after the last entry point or
    // execution mode, before the first type.
    let (mut after_capabilities, mut after_entry_points, mut before_types) = (HEADER, HEADER, None);
    for (at, op, words) in instructions(words) {
        match op {
            Op::Capability => after_capabilities = at + words.len(),
            Op::EntryPoint => {
                after_entry_points = at + words.len();
                let of_f32 =
                    |&(mode, _): &(ExecutionMode, _)| instruction(Op::ExecutionMode, &[words[2], mode as u32, 32]);
                execution_modes.extend(modes.iter().flat_map(of_f32));
            }
            Op::ExecutionMode => after_entry_points = at + words.len(),
            _ if begins_types(op) => before_types = before_types.or(Some(at)),
            // The result's id is the third word, of extended instructions (sqrt, fma, min ...) too; decorating one
            // that yields no float is allowed only for arithmetic, so those are told apart by their set's numbers.
            Op::ExtInst if is_float_extended(words[4]) => decorations.extend(no_contraction(words[2])),
            _ if is_float_arithmetic(op) => decorations.extend(no_contraction(words[2])),
            _ => {}
        }
    }
    let before_types = before_types.unwrap_or(words.len());
    let mut out = words[..after_capabilities].to_vec();
    out.extend(capabilities);
    out.extend(&words[after_capabilities..after_entry_points]);
    out.extend(execution_modes);
    out.extend(&words[after_entry_points..before_types]);
    out.extend(decorations);
    out.extend(&words[before_types..]);
    out
}

fn no_contraction(id: u32) -> Vec<u32> {
    instruction(Op::Decorate, &[id, Decoration::NoContraction as u32])
}

#[cfg(test)]
mod tests {
    use super::*;

    const KERNEL: &str = "
        @group(0) @binding(0) var<storage, read_write> x: array<f32>;
        @compute @workgroup_size(1) fn main(@builtin(global_invocation_id) id: vec3<u32>) {
            let v = vec3<f32>(x[0], x[1], x[2]);
            let i = id.x + 3u;
            x[i] = (x[0] + x[1]) * -x[2] / sqrt(x[3]) - dot(v, 2.0 * v) + fma(x[1], x[2], x[3]);
        }";

    fn kernel() -> Vec<u32> {
        let module = naga::front::wgsl::parse_str(KERNEL).expect("parses");
        let info = naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::all())
            .validate(&module)
            .expect("validates");
        write(&module, &info).expect("translates")
    }

    #[test]
    fn every_float_operation_is_decorated_once_and_no_integer_one() {
        let before = kernel();
        let after = decorate(&before, FloatControls::default());
        let float: Vec<u32> = instructions(&before)
            .filter(|(_, op, words)| is_float_arithmetic(*op) || (*op == Op::ExtInst && is_float_extended(words[4])))
            .map(|(_, _, words)| words[2])
            .collect();
        let decorated: Vec<u32> = instructions(&after)
            .filter(|(_, op, words)| *op == Op::Decorate && words[2] == Decoration::NoContraction as u32)
            .map(|(_, _, words)| words[1])
            .collect();
        // +, negate, *, /, sqrt, vector * scalar, dot, -, fma, +
        assert_eq!(float.len(), 10);
        assert_eq!(float, decorated);
        assert_eq!(after.len(), before.len() + 3 * float.len());
    }

    #[test]
    fn float_controls_stand_where_spirv_wants_them() {
        let all =
            FloatControls { round_to_nearest_even: true, signed_zero_inf_nan_preserve: true, denorm_preserve: true };
        let after = decorate(&kernel(), all);
        let order: Vec<Op> = instructions(&after).map(|(_, op, _)| op).collect();
        let place = |op: Op| order.iter().position(|&o| o == op).expect("is there");
        let last = |op: Op| order.iter().rposition(|&o| o == op).expect("is there");
        assert!(last(Op::Capability) < place(Op::Extension) && last(Op::Extension) < place(Op::EntryPoint));
        assert!(last(Op::EntryPoint) < place(Op::ExecutionMode));
        assert_eq!(order.iter().filter(|&&o| o == Op::ExecutionMode).count(), 1 + 3);
        assert_eq!(literal("abc"), [0x0063_6261]);
        assert_eq!(literal("abcd"), [0x6463_6261, 0]);
    }
}
