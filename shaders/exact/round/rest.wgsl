// The fourth pass: the numbers that the third could not round, in wider numbers still.
@compute @workgroup_size(WORKGROUP_SIZE)
fn round_rest(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x < atomicLoad(&list.unrounded) {
        let index = list.rays[params.ray_count + id.x];
        write_hit(index, hits[index].x);
    }
}
