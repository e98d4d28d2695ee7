//! The device that tests run on. None is a failure, not a reason to skip.

use std::sync::{Arc, OnceLock};

use rayproof_gpu::{Gpu, Selector};

/// The best Vulkan adapter: lavapipe where there is no hardware. Opened once, so that kernels are compiled once.
pub(crate) fn gpu() -> Arc<Gpu> {
    static GPU: OnceLock<Arc<Gpu>> = OnceLock::new();
    let open = || match Gpu::open(&Selector::Best) {
        Ok(gpu) => {
            println!("on {}, {}", gpu.name(), gpu.driver());
            Arc::new(gpu)
        }
        Err(e) => panic!("tests need a Vulkan adapter (Debian: apt-get install mesa-vulkan-drivers): {e}"),
    };
    GPU.get_or_init(open).clone()
}

/// That adapter with bindings of at most `bytes`, so that small scenes take several.
pub(crate) fn gpu_with_small_bindings(bytes: u64) -> Arc<Gpu> {
    let mut gpu = Gpu::open(&Selector::Best).expect("the adapter opened before");
    gpu.limit_binding(bytes);
    Arc::new(gpu)
}
