// Numbers of the first stage.
alias N = f32;

// The f32 itself.
fn about(x: N) -> f32 { return x; }
// At least x, and near it.
fn above(x: N) -> f32 { return x; }
