// The flat number of a triangle: beside its first vertex.
fn triangle_id(index: u32) -> u32 {
    return triangle_quad(index * 3u).w;
}
