// A peer, not ours: the device's own ray query on its own tree, as a user of wgpu writes it. It promises nothing on rounding.
enable wgpu_ray_query;

struct Params {
    ray_count: u32,
    row: u32,
}

struct Ray {
    origin: vec3<f32>,
    t_min: f32,
    direction: vec3<f32>,
    t_max: f32,
}

@group(0) @binding(0) var<uniform> params: Params;
@group(0) @binding(1) var<storage, read> rays: array<Ray>;
@group(0) @binding(2) var<storage, read_write> hits: array<vec4<u32>>;
@group(0) @binding(3) var tree: acceleration_structure;

@compute @workgroup_size(64)
fn query_closest(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let index = (group.y * params.row + group.x) * 64u + lane;
    if index >= params.ray_count {
        return;
    }
    let ray = rays[index];
    var query: ray_query;
    // Not culled, all instances; an infinite end is not allowed.
    rayQueryInitialize(&query, tree, RayDesc(
        0u, 0xffu, ray.t_min, min(ray.t_max, 3.4028234663852886e38), ray.origin, ray.direction));
    while rayQueryProceed(&query) {}
    let found = rayQueryGetCommittedIntersection(&query);
    if found.kind == RAY_QUERY_INTERSECTION_NONE {
        hits[index] = vec4<u32>(0x7f800000u, 0u, 0u, 0xffffffffu);
    } else {
        hits[index] = vec4<u32>(bitcast<vec3<u32>>(vec3<f32>(found.t, found.barycentrics)), found.primitive_index);
    }
}
