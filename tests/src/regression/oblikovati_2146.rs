//! Oblikovati, issue 2146: a hairline crack along the diagonal of a square, at (3.375, 3.375, 0). The ray hits, once.

use super::{all_hit_once, recorded};

#[test]
fn there_is_no_crack_at_the_diagonal() {
    for answers in recorded(8, 1) {
        assert!(all_hit_once(&answers), "{:?}", answers.hits);
    }
}
