// The first pass: every ray, in f32.
@compute @workgroup_size(WORKGROUP_SIZE)
fn first(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let index = ray_index(group, lane);
    if index >= params.ray_count {
        return;
    }
    if !settle(index) {
        leave_open(index);
    }
}
