//! What the nodes of four and of eight children have in common.

use rayproof_tree::EMPTY;

/// A node as it is walked.
pub(crate) trait Branch: Sized + Send + Sync {
    /// As the tree has it.
    type Packed: Sync;
    const WIDTH: usize;

    fn unpacked(packed: &Self::Packed) -> Self;
    /// The word of child `k`.
    fn child(&self, k: usize) -> u32;
    fn set_child(&mut self, k: usize, word: u32);
    /// The box of child `k`.
    fn child_box(&self, k: usize) -> [[f32; 3]; 2];

    /// The children that there are, by their slots.
    fn slots(&self) -> impl Iterator<Item = usize> {
        (0..Self::WIDTH).filter(|&k| self.child(k) != EMPTY)
    }
}
