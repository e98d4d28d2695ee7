// The closest hit of each ray. A miss is t = inf, u = v = 0, all ones.
const ANY_HIT: bool = false;

@group(0) @binding(2) var<storage, read_write> hits: array<vec4<u32>>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn closest(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let index = ray_index(group, lane);
    if index >= params.ray_count {
        return;
    }
    let hit = trace(rays[index]);
    if hit.primitive == MISS {
        // Infinity as its bits: no arithmetic makes it.
        hits[index] = vec4<u32>(0x7f800000u, 0u, 0u, MISS);
    } else {
        hits[index] = vec4<u32>(bitcast<u32>(hit.t), bitcast<u32>(hit.u), bitcast<u32>(hit.v), hit.primitive);
    }
}
