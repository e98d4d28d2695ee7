// t, u and v of a triangle's hit.
fn triangle_values(ray: PreparedRay, index: u32) -> Values {
    let triangle = load_triangle(index);
    let s = sides(ray.line, triangle);
    let t = plane_t(ray.line, s, triangle.edge);
    let u = quotient(ray.line, s, s.u, s.bound);
    let v = quotient(ray.line, s, s.v, s.bound);
    let r = vec3<f32>(about(t.value), about(u.value), about(v.value));
    let settled = t.clear && rounds_to(r.x, t.value, t.off) && rounds_to(r.y, u.value, u.off)
        && rounds_to(r.z, v.value, v.off);
    return Values(settled, r.x, r.y, r.z);
}
