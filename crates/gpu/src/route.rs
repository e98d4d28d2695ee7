//! How a kernel reaches the driver.

use std::fmt;

/// How a kernel reaches the driver.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Route {
    /// naga's SPIR-V with `NoContraction` and float controls, passed through wgpu.
    ExactSpirv,
    /// That SPIR-V without either, to measure what they cost: the driver may rewrite arithmetic.
    #[cfg(feature = "measure")]
    FreeSpirv,
    /// WGSL as wgpu compiles it: the driver may rewrite arithmetic.
    PlainWgsl,
    /// That WGSL without wgpu's runtime checks, to measure what they cost.
    #[cfg(feature = "measure")]
    UncheckedWgsl,
}

impl Route {
    /// Every route.
    #[cfg(feature = "measure")]
    pub const ALL: [Self; 4] = [Self::ExactSpirv, Self::FreeSpirv, Self::PlainWgsl, Self::UncheckedWgsl];
    /// Those by which answers come.
    pub const TAKEN: [Self; 2] = [Self::ExactSpirv, Self::PlainWgsl];

    /// Whether the device must take SPIR-V as it is.
    pub(crate) const fn is_spirv(self) -> bool {
        match self {
            Self::ExactSpirv => true,
            Self::PlainWgsl => false,
            #[cfg(feature = "measure")]
            Self::FreeSpirv => true,
            #[cfg(feature = "measure")]
            Self::UncheckedWgsl => false,
        }
    }
}

impl fmt::Display for Route {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::ExactSpirv => "SPIR-V with NoContraction",
            Self::PlainWgsl => "plain WGSL",
            #[cfg(feature = "measure")]
            Self::FreeSpirv => "SPIR-V free to contract",
            #[cfg(feature = "measure")]
            Self::UncheckedWgsl => "plain WGSL, unchecked",
        })
    }
}
