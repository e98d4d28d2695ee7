// What a leaf's word names: primitives of one kind, how many, and the first. What a place names: one primitive.
//
// The host writes how the bits are dealt out (KIND_SHIFT, KIND_MASK, COUNT_SHIFT, INDEX_MASK), a number for each kind that the
// scene holds (TRIANGLE, SPHERE), and the functions that hand on to the one of a kind: `intersect_leaf`, and where hits are
// rounded `values` and `flat_number`. A kernel knows of no kind that its scene does not hold.

fn leaf_kind(word: u32) -> u32 {
    return (word >> KIND_SHIFT) & KIND_MASK;
}

fn leaf_first(word: u32) -> u32 {
    return word & INDEX_MASK;
}

fn leaf_count(word: u32) -> u32 {
    return ((word >> COUNT_SHIFT) & 3u) + 1u;
}

// A primitive's place in the leaves: its kind in the two upper bits, its index in the others.
fn place_of(kind: u32, index: u32) -> u32 {
    return (kind << 30u) | index;
}

fn place_kind(place: u32) -> u32 {
    return place >> 30u;
}

fn place_index(place: u32) -> u32 {
    return place & 0x3fffffffu;
}
