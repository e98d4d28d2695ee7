// Whether each ray hits anything: 1 or 0.
const ANY_HIT: bool = true;

@group(0) @binding(2) var<storage, read_write> hits: array<u32>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn any_hit(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let index = ray_index(group, lane);
    if index >= params.ray_count {
        return;
    }
    hits[index] = select(0u, 1u, trace(rays[index]).primitive != MISS);
}
