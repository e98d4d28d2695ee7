// t, u and v of a triangle's hit.
fn triangle_values(ray: Line, slot: u32) -> Values {
    let triangle = load_triangle(slot);
    let s = sides(ray, triangle);
    let t = plane_t(ray, s, triangle.edge);
    let u = quotient(ray, s, s.u, s.bound);
    let v = quotient(ray, s, s.v, s.bound);
    let r = vec3<f32>(about(t.value), about(u.value), about(v.value));
    let settled = t.clear && rounds_to(r.x, t.value, t.off) && rounds_to(r.y, u.value, u.off)
        && rounds_to(r.z, v.value, v.off);
    return Values(settled, r.x, r.y, r.z);
}

fn triangle_id(slot: u32) -> u32 {
    return triangle_quad(slot * 3u).w;
}
