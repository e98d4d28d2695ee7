// The rays that a pass leaves to the next: one list of those the first stage left open, one of those whose numbers the second
// could not round. The host dispatches the next pass by the workgroups that a list takes, in a row: the heights and depths are 1.
struct List {
    opened: atomic<u32>,
    unrounded: atomic<u32>,
    opened_groups: atomic<u32>,
    opened_height: u32,
    opened_depth: u32,
    unrounded_groups: atomic<u32>,
    unrounded_height: u32,
    unrounded_depth: u32,
    // The first list; the second follows at params.ray_count.
    rays: array<u32>,
}

@group(0) @binding(3) var<storage, read_write> list: List;

// In the place of an answer: left open.
const OPEN: u32 = 0xfffffffeu;

fn leave_open(index: u32) {
    let i = atomicAdd(&list.opened, 1u);
    list.rays[i] = index;
    if i % WORKGROUP_SIZE == 0u {
        atomicAdd(&list.opened_groups, 1u);
    }
}

fn leave_unrounded(index: u32) {
    let i = atomicAdd(&list.unrounded, 1u);
    list.rays[params.ray_count + i] = index;
    if i % WORKGROUP_SIZE == 0u {
        atomicAdd(&list.unrounded_groups, 1u);
    }
}
