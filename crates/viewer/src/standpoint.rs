//! Which scene is shown, and from where.

use std::sync::Arc;

use rayproof::scene::Camera;

use crate::model::navigate;
use crate::model::world::World;

/// Which scene is shown, and from where.
pub(crate) struct Standpoint {
    /// A scene is always there.
    pub(crate) world: Arc<World>,
    pub(crate) camera: Camera,
    /// How far away the camera was moved, in powers of ten of the scene's size.
    pub(crate) decades: f64,
}

impl Standpoint {
    /// Where a scene is seen from at first.
    pub(crate) fn new(world: Arc<World>) -> Self {
        Self { camera: world.camera, world, decades: 0.0 }
    }

    /// Goes back there.
    pub(crate) fn frame(&mut self) {
        self.camera = self.world.camera;
        self.decades = 0.0;
    }

    /// Walks away from the scene, or back to it.
    pub(crate) fn walk_away(&mut self, decades: f64) {
        self.camera = navigate::walk_away(&self.camera, &self.world.scene, decades);
        self.decades = decades;
    }
}
