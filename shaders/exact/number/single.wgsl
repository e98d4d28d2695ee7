// Numbers of the first stage.
alias N = f32;

// At least x, and near it.
fn above(x: N) -> f32 { return x; }
