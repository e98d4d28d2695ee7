// The second pass: the rays that the first left open, in wider numbers.
@compute @workgroup_size(WORKGROUP_SIZE)
fn second(
    @builtin(global_invocation_id) id: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let count = atomicLoad(&list.opened);
    for (var i = id.x; i < count; i += groups.x * WORKGROUP_SIZE) {
        settle(list.rays[i]);
    }
}
