// The fourth pass: the numbers that the third could not round, in wider numbers still.
@compute @workgroup_size(WORKGROUP_SIZE)
fn round_rest(
    @builtin(global_invocation_id) id: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let count = atomicLoad(&list.unrounded);
    for (var i = id.x; i < count; i += groups.x * WORKGROUP_SIZE) {
        let index = list.rays[params.ray_count + i];
        write_hit(index, hits[index].x);
    }
}
