//! SPIR-V with exact `f32` rules: what naga writes, plus `NoContraction` on every float operation and the float-control
//! modes that the device has.
//!
//! Without the decoration Vulkan lets a driver rearrange by associativity and distributivity (`a + b - a -> b` is the
//! specification's own example, and Mesa does it) and contract to fused operations.

use crate::Error;

/// The float-control modes a device has for `f32` (Vulkan's `VkPhysicalDeviceFloatControlsProperties`).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct FloatControls {
    pub(crate) round_to_nearest_even: bool,
    pub(crate) signed_zero_inf_nan_preserve: bool,
    pub(crate) denorm_preserve: bool,
}

const HEADER: usize = 5;

// Opcodes (SPIR-V 1.3, section 3.32).
const OP_EXTENSION: u32 = 10;
const OP_EXT_INST: u32 = 12;
const OP_EXECUTION_MODE: u32 = 16;
const OP_CAPABILITY: u32 = 17;
const OP_ENTRY_POINT: u32 = 15;
const OP_TYPE_VOID: u32 = 19;
const OP_TYPE_FORWARD_POINTER: u32 = 39;
const OP_DECORATE: u32 = 71;
const OP_SPEC_CONSTANT_OP: u32 = 52;
const OP_CONSTANT_TRUE: u32 = 41;
const NO_CONTRACTION: u32 = 42;

/// `OpFNegate`, `OpFAdd`, `OpFSub`, `OpFMul`, `OpFDiv`, `OpFRem`, `OpFMod`, `OpVectorTimesScalar` ...
/// `OpOuterProduct`, `OpDot`.
fn is_float_arithmetic(opcode: u32) -> bool {
    matches!(opcode, 127 | 129 | 131 | 133 | 136 | 140..=148)
}

/// Whether an instruction of the header's part of a module comes before annotations end: everything up to the first
/// type or constant.
fn begins_types(opcode: u32) -> bool {
    (OP_TYPE_VOID..=OP_TYPE_FORWARD_POINTER).contains(&opcode)
        || (OP_CONSTANT_TRUE..=OP_SPEC_CONSTANT_OP).contains(&opcode)
}

fn instruction(opcode: u32, operands: &[u32]) -> Vec<u32> {
    let words = u32::try_from(operands.len() + 1).unwrap_or(u32::MAX);
    std::iter::once((words << 16) | opcode).chain(operands.iter().copied()).collect()
}

/// A literal string as words: UTF-8, ended by zeros.
fn literal(text: &str) -> Vec<u32> {
    let mut bytes = text.as_bytes().to_vec();
    bytes.resize(text.len() / 4 * 4 + 4, 0);
    bytes.chunks_exact(4).map(|c| u32::from_le_bytes([c[0], c[1], c[2], c[3]])).collect()
}

/// Each instruction's place, opcode and words.
fn instructions(words: &[u32]) -> impl Iterator<Item = (usize, u32, &[u32])> {
    let mut at = HEADER;
    std::iter::from_fn(move || {
        let word = *words.get(at)?;
        let length = (word >> 16) as usize;
        let found = (at, word & 0xffff, words.get(at..at + length.max(1))?);
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
    spv::write_vec(module, info, &options, None).map_err(|e| Error::Kernel(e.to_string()))
}

fn decorate(words: &[u32], controls: FloatControls) -> Vec<u32> {
    let modes: Vec<(u32, u32)> = [
        // Execution mode and the capability it needs.
        (controls.round_to_nearest_even, (4462, 4467)),
        (controls.signed_zero_inf_nan_preserve, (4461, 4466)),
        (controls.denorm_preserve, (4459, 4464)),
    ]
    .into_iter()
    .filter_map(|(has, mode)| has.then_some(mode))
    .collect();

    let mut capabilities: Vec<u32> = modes.iter().flat_map(|m| instruction(OP_CAPABILITY, &[m.1])).collect();
    if !modes.is_empty() {
        capabilities.extend(instruction(OP_EXTENSION, &literal("SPV_KHR_float_controls")));
    }
    let mut execution_modes = Vec::new();
    let mut decorations = Vec::new();
    // Where the three are put: before the first instruction after the capabilities, after the last entry point or
    // execution mode, before the first type.
    let (mut after_capabilities, mut after_entry_points, mut before_types) = (HEADER, HEADER, None);
    for (at, opcode, words) in instructions(words) {
        match opcode {
            OP_CAPABILITY => after_capabilities = at + words.len(),
            OP_ENTRY_POINT => {
                after_entry_points = at + words.len();
                execution_modes.extend(modes.iter().flat_map(|m| instruction(OP_EXECUTION_MODE, &[words[2], m.0, 32])));
            }
            OP_EXECUTION_MODE => after_entry_points = at + words.len(),
            _ if begins_types(opcode) => before_types = before_types.or(Some(at)),
            // The result's id is the third word, of extended instructions (sqrt, fma, min ...) too; decorating one
            // that yields no float is allowed only for arithmetic, so those are told apart by their set's numbers.
            OP_EXT_INST if is_float_extended(words[4]) => decorations.extend(no_contraction(words[2])),
            _ if is_float_arithmetic(opcode) => decorations.extend(no_contraction(words[2])),
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

/// `GLSL.std.450`: Sqrt, InverseSqrt, Fma. (min, max and abs round nothing.)
fn is_float_extended(number: u32) -> bool {
    matches!(number, 31 | 32 | 50)
}

fn no_contraction(id: u32) -> Vec<u32> {
    instruction(OP_DECORATE, &[id, NO_CONTRACTION])
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
            .filter(|(_, op, words)| is_float_arithmetic(*op) || (*op == OP_EXT_INST && is_float_extended(words[4])))
            .map(|(_, _, words)| words[2])
            .collect();
        let decorated: Vec<u32> = instructions(&after)
            .filter(|(_, op, words)| *op == OP_DECORATE && words[2] == NO_CONTRACTION)
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
        let order: Vec<u32> = instructions(&after).map(|(_, op, _)| op).collect();
        let place = |op: u32| order.iter().position(|&o| o == op).expect("is there");
        let last = |op: u32| order.iter().rposition(|&o| o == op).expect("is there");
        assert!(last(OP_CAPABILITY) < place(OP_EXTENSION) && last(OP_EXTENSION) < place(OP_ENTRY_POINT));
        assert!(last(OP_ENTRY_POINT) < place(OP_EXECUTION_MODE));
        assert_eq!(order.iter().filter(|&&o| o == OP_EXECUTION_MODE).count(), 1 + 3);
        assert_eq!(literal("abc"), [0x0063_6261]);
        assert_eq!(literal("abcd"), [0x6463_6261, 0]);
    }

    /// SPIR-V's own numbers of `spirv::Op`, so that a slip in a constant above shows.
    #[test]
    fn opcodes_are_those_naga_writes() {
        let before = kernel();
        let ops: Vec<u32> = instructions(&before).map(|(_, op, _)| op).collect();
        for op in [OP_CAPABILITY, OP_ENTRY_POINT, OP_EXECUTION_MODE, OP_DECORATE, OP_TYPE_VOID, OP_EXT_INST] {
            assert!(ops.contains(&op), "opcode {op} is not in the module");
        }
        // OpFAdd, OpFSub, OpFMul, OpFDiv, OpFNegate, OpVectorTimesScalar, OpDot.
        for op in [129, 131, 133, 136, 127, 142, 148] {
            assert!(ops.contains(&op) && is_float_arithmetic(op), "opcode {op}");
        }
        for op in [128, 130, 132, 134, 135, 137, 138, 139, 149] {
            assert!(!is_float_arithmetic(op), "opcode {op} is of integers");
        }
    }
}
