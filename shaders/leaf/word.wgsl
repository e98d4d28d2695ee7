// What a leaf's word names.

// Bit 30: it holds spheres.
const SPHERES: u32 = 0x40000000u;

fn leaf_first(word: u32) -> u32 {
    return word & 0x0fffffffu;
}

fn leaf_count(word: u32) -> u32 {
    return ((word >> 28u) & 3u) + 1u;
}
