// The third pass: the numbers of every hit.
@compute @workgroup_size(WORKGROUP_SIZE)
fn round_all(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let index = ray_index(group, lane);
    if index >= params.ray_count {
        return;
    }
    let slot = hits[index].w;
    if slot == MISS || slot == OPEN {
        return;
    }
    if !write_hit(index, slot) {
        hits[index] = vec4<u32>(slot, 0u, 0u, OPEN);
        leave_unrounded(index);
    }
}
