// What a kernel is given and gives back. Layouts are compared with the host's by a test, through naga's reflection.

struct Params {
    // How many rays this dispatch answers.
    ray_count: u32,
    // Workgroups in a row of the dispatch: a batch may need more than one dimension can count.
    row: u32,
    // The scene was multiplied by two to this.
    scene_exponent: i32,
    // A power of two that no coordinate of the scaled scene exceeds.
    scene_size: f32,
}

struct Ray {
    origin: vec3<f32>,
    t_min: f32,
    direction: vec3<f32>,
    t_max: f32,
}

struct Hit {
    t: f32,
    u: f32,
    v: f32,
    primitive: u32,
}

// The primitive of a ray that hits nothing.
const MISS: u32 = 0xffffffffu;

@group(0) @binding(0) var<uniform> params: Params;
@group(0) @binding(1) var<storage, read> rays: array<Ray>;
// Binding 2 are the answers, which the query declares; binding 3 is the list of exact/list.wgsl; the scene follows.

const WORKGROUP_SIZE: u32 = 64u;

fn ray_index(group: vec3<u32>, lane: u32) -> u32 {
    return (group.y * params.row + group.x) * WORKGROUP_SIZE + lane;
}
