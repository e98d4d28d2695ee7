// The root of a chord that is hit first in range, of a sphere that is hit: the near one, or the far one where the near one lies
// before the range.
struct Root {
    // Whether the line certainly enters, and it is certain which root it is.
    known: bool,
    is_far: bool,
    t: N,
}

fn root_in_range(ray: PreparedRay, c: Chord) -> Root {
    let near = sub(c.middle, c.half);
    let is_near = !less(sub(near, c.off), n(ray.t_min));
    let is_far = less(add(near, c.off), n(ray.t_min));
    return Root(c.enters && (is_near || is_far), is_far, pick(near, add(c.middle, c.half), is_far));
}
