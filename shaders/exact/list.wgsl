// The rays that a pass leaves to the next: one list of those the first stage left open, one of those whose numbers the second
// could not round.
struct List {
    opened: atomic<u32>,
    unrounded: atomic<u32>,
    // The first list; the second follows at params.ray_count.
    rays: array<u32>,
}

@group(0) @binding(3) var<storage, read_write> list: List;

// In the place of an answer: left open.
const OPEN: u32 = 0xfffffffeu;
