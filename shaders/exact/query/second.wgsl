// The second pass: the rays that the first left open, in wider numbers.
@compute @workgroup_size(WORKGROUP_SIZE)
fn second(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x < atomicLoad(&list.opened) {
        settle(list.rays[id.x]);
    }
}
