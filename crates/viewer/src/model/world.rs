//! A scene that is open, with an engine for each precision that was asked for.

use std::collections::HashMap;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

use glam::{DVec3, Vec3};
use rayproof::files::{LoadedScene, load};
use rayproof::scene::{Camera, Geometry, Scene, Sphere};
use rayproof::{Device, Error, Intersector, Precision};
use rayproof_oracle::families::meshes;

use super::look::{Place, Source};

/// A scene and what answers rays at it.
pub(crate) struct World {
    /// How the user calls it.
    pub(crate) name: String,
    pub(crate) scene: Scene,
    /// Where it is seen from at first.
    pub(crate) camera: Camera,
    device: Device,
    engines: Mutex<HashMap<Source, Arc<Intersector>>>,
}

impl World {
    pub(crate) fn new(name: impl Into<String>, scene: Scene, camera: Option<Camera>, device: Device) -> Self {
        let camera = camera.unwrap_or_else(|| Camera::framing(&scene));
        Self { name: name.into(), scene, camera, device, engines: Mutex::default() }
    }

    /// Reads a mesh or a scene file.
    ///
    /// # Errors
    /// A text for people that says what is wrong with the file.
    pub(crate) fn open(path: &Path, device: Device) -> Result<Self, String> {
        let LoadedScene { scene, camera, .. } = load(path).map_err(|e| e.to_string())?;
        let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
        Ok(Self::new(name, scene, camera, device))
    }

    /// What is shown where nothing was opened: the two primitives.
    pub(crate) fn welcome(device: Device) -> Self {
        let ball = Sphere { center: Vec3::new(-1.2, 0.0, 0.0), radius: 1.0 };
        let mesh = meshes::placed(meshes::icosphere(2), 1.0, DVec3::new(1.2, 0.0, 0.0));
        let scene =
            Scene::new(vec![Geometry::Spheres(vec![ball]), Geometry::Mesh(mesh)]).expect("made of finite numbers");
        Self::new("a sphere and 320 triangles", scene, None, device)
    }

    /// The engine of a precision, made when first asked for.
    ///
    /// # Errors
    /// When the device cannot hold the scene, or fails.
    pub(crate) fn engine(&self, source: Source) -> Result<Arc<Intersector>, Error> {
        let source = if self.device.is_cpu() { Source::cpu(source.precision) } else { source };
        // A panic while another engine was made does not make those that are there any worse.
        let mut engines = self.engines.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(engine) = engines.get(&source) {
            return Ok(engine.clone());
        }
        let shared = engines.values().find_map(|engine| engine.with_precision(source.precision));
        let made = match (source.place, shared) {
            (Place::Cpu, Some(engine)) => engine,
            (Place::Cpu, None) => Intersector::on(&Device::cpu(), &self.scene, source.precision)?,
            (Place::Device, _) => Intersector::on(&self.device, &self.scene, source.precision)?,
        };
        let made = Arc::new(made);
        engines.insert(source, made.clone());
        Ok(made)
    }

    /// The CPU engine of a precision: for single rays, where a device would gain nothing.
    ///
    /// # Errors
    /// When the scene is too large.
    pub(crate) fn on_cpu(&self, precision: Precision) -> Result<Arc<Intersector>, Error> {
        self.engine(Source::cpu(precision))
    }
}
