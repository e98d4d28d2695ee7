use glam::Vec3;

use crate::{FlatHit, Hit, Kind, MISS, Sphere, Triangle};

/// Triangles over shared vertices.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// The vertices.
    pub vertices: Vec<Vec3>,
    /// Three indices into `vertices` a triangle.
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// The mesh of these vertices, three of which each triangle names.
    #[must_use]
    pub fn new<V: Into<Vec3>>(vertices: impl IntoIterator<Item = V>, triangles: Vec<[u32; 3]>) -> Self {
        Self { vertices: vertices.into_iter().map(Into::into).collect(), triangles }
    }

    /// Triangle `i`, in the file's order.
    ///
    /// # Panics
    /// When `i` or one of the triangle's indices is out of range; no mesh of a [`Scene`] has such.
    #[must_use]
    pub fn triangle(&self, i: usize) -> Triangle {
        let [a, b, c] = self.triangles[i].map(|v| self.vertices[v as usize]);
        Triangle { a, b, c }
    }
}

/// One entry of a scene: its index is the `geometry` of a hit.
#[derive(Clone, Debug, PartialEq)]
pub enum Geometry {
    /// A triangle mesh.
    Mesh(Mesh),
    /// A table of spheres.
    Spheres(Vec<Sphere>),
}

impl Geometry {
    /// What its primitives are.
    #[must_use]
    pub const fn kind(&self) -> Kind {
        match self {
            Self::Mesh(_) => Kind::Triangle,
            Self::Spheres(_) => Kind::Sphere,
        }
    }

    /// How many primitives it holds.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::Mesh(mesh) => mesh.triangles.len(),
            Self::Spheres(spheres) => spheres.len(),
        }
    }

    /// Whether it holds none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The first primitive that is none, and why.
    fn fault(&self) -> Option<(usize, PrimitiveFault)> {
        match self {
            Self::Mesh(mesh) => {
                let fault = |&index: &u32| match mesh.vertices.get(index as usize) {
                    None => Some(PrimitiveFault::NoVertex { index, vertices: mesh.vertices.len() }),
                    Some(vertex) if !vertex.is_finite() => Some(PrimitiveFault::Vertex { index, vertex: *vertex }),
                    Some(_) => None,
                };
                mesh.triangles.iter().enumerate().find_map(|(i, t)| t.iter().find_map(fault).map(|fault| (i, fault)))
            }
            Self::Spheres(spheres) => spheres.iter().enumerate().find_map(|(i, &Sphere { center, radius })| {
                if !center.is_finite() || !radius.is_finite() {
                    Some((i, PrimitiveFault::Sphere { center, radius }))
                } else {
                    (radius < 0.0).then_some((i, PrimitiveFault::Radius { radius }))
                }
            }),
        }
    }
}

/// One primitive of a scene, by value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Primitive {
    /// A triangle.
    Triangle(Triangle),
    /// A sphere.
    Sphere(Sphere),
}

impl Primitive {
    /// What it is.
    #[must_use]
    pub const fn kind(&self) -> Kind {
        match self {
            Self::Triangle(_) => Kind::Triangle,
            Self::Sphere(_) => Kind::Sphere,
        }
    }
}

impl From<Primitive> for Geometry {
    /// The geometry of this one primitive.
    fn from(primitive: Primitive) -> Self {
        match primitive {
            Primitive::Sphere(sphere) => Self::Spheres(vec![sphere]),
            Primitive::Triangle(t) => Self::Mesh(Mesh { vertices: vec![t.a, t.b, t.c], triangles: vec![[0, 1, 2]] }),
        }
    }
}

/// What rays are shot at: geometries, in the order of the file.
///
/// Primitives have one flat numbering, geometry after geometry, which breaks ties: the lowest flat number is the lowest
/// `(geometry, primitive)`. [`locate`](Self::locate) turns it back.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    geometries: Vec<Geometry>,
    numbering: Numbering,
}

impl Scene {
    /// The scene of these geometries.
    ///
    /// # Errors
    /// At the first primitive that is none: a triangle that names a vertex that is not there or not finite, a sphere that is not
    /// finite or has a negative radius. A triangle without area is one, and so is a sphere of radius 0.
    pub fn new(geometries: Vec<Geometry>) -> Result<Self, InvalidScene> {
        for (geometry, all) in geometries.iter().enumerate() {
            if let Some((primitive, fault)) = all.fault() {
                return Err(InvalidScene { geometry, primitive, fault });
            }
        }
        let numbering = Numbering::of(&geometries);
        Ok(Self { geometries, numbering })
    }

    /// The geometries.
    #[must_use]
    pub fn geometries(&self) -> &[Geometry] {
        &self.geometries
    }

    /// How many primitives there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.numbering.len()
    }

    /// Whether there is nothing to hit.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// How many primitives of a kind there are.
    #[must_use]
    pub fn count(&self, kind: Kind) -> usize {
        self.geometries.iter().filter(|geometry| geometry.kind() == kind).map(Geometry::len).sum()
    }

    /// The `(geometry, primitive)` of a flat number.
    ///
    /// # Panics
    /// When `flat` is not below [`len`](Self::len).
    #[must_use]
    pub fn locate(&self, flat: usize) -> (usize, usize) {
        self.numbering.locate(flat)
    }

    /// How its primitives are numbered.
    #[must_use]
    pub const fn numbering(&self) -> &Numbering {
        &self.numbering
    }

    /// A hit by geometry and primitive.
    ///
    /// # Panics
    /// When it names a primitive that is not there.
    #[must_use]
    pub fn hit(&self, flat: FlatHit) -> Hit {
        self.numbering.hit(flat)
    }

    /// A hit by the flat number of its primitive; a miss where it names none that is there.
    #[must_use]
    pub fn flat_hit(&self, hit: &Hit) -> FlatHit {
        self.numbering.flat_hit(hit)
    }

    /// The flat number of primitive 0 of a geometry.
    ///
    /// # Panics
    /// When there is no such geometry.
    #[must_use]
    pub fn start(&self, geometry: usize) -> usize {
        self.numbering.starts[geometry]
    }

    /// The primitive of a flat number.
    ///
    /// # Panics
    /// When `flat` is not below [`len`](Self::len).
    #[must_use]
    pub fn primitive(&self, flat: usize) -> Primitive {
        let (geometry, primitive) = self.locate(flat);
        match &self.geometries[geometry] {
            Geometry::Mesh(mesh) => Primitive::Triangle(mesh.triangle(primitive)),
            Geometry::Spheres(spheres) => Primitive::Sphere(spheres[primitive]),
        }
    }

    /// The smallest box around every primitive, rounded to the nearest; `None` where there is none.
    #[must_use]
    pub fn bounds(&self) -> Option<[Vec3; 2]> {
        let points = |geometry: &Geometry| -> Option<[Vec3; 2]> {
            match geometry {
                Geometry::Mesh(mesh) => (0..mesh.triangles.len())
                    .map(|i| mesh.triangle(i))
                    .map(|t| [t.a.min(t.b).min(t.c), t.a.max(t.b).max(t.c)])
                    .reduce(union),
                Geometry::Spheres(spheres) => {
                    spheres.iter().map(|s| [s.center - s.radius, s.center + s.radius]).reduce(union)
                }
            }
        };
        self.geometries.iter().filter_map(points).reduce(union)
    }
}

fn union(a: [Vec3; 2], b: [Vec3; 2]) -> [Vec3; 2] {
    [a[0].min(b[0]), a[1].max(b[1])]
}

/// Where the flat numbers of a scene's geometries start.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Numbering {
    /// The flat number of each geometry's first primitive, and at the end the number of primitives.
    starts: Vec<usize>,
}

impl Default for Numbering {
    fn default() -> Self {
        Self { starts: vec![0] }
    }
}

impl Numbering {
    fn of(geometries: &[Geometry]) -> Self {
        let ends = geometries.iter().scan(0, |end, geometry| {
            *end += geometry.len();
            Some(*end)
        });
        Self { starts: std::iter::once(0).chain(ends).collect() }
    }

    fn len(&self) -> usize {
        self.starts.last().copied().unwrap_or(0)
    }

    #[inline]
    fn locate(&self, flat: usize) -> (usize, usize) {
        assert!(flat < self.len(), "primitive {flat} of {}", self.len());
        if let [_, _] = self.starts[..] {
            return (0, flat);
        }
        // Empty geometries share a start: the last one that starts at or before `flat` holds it.
        let geometry = self.starts.partition_point(|&start| start <= flat) - 1;
        (geometry, flat - self.starts[geometry])
    }

    /// A hit by geometry and primitive.
    ///
    /// # Panics
    /// When it names a primitive that is not there.
    #[must_use]
    #[inline]
    pub fn hit(&self, FlatHit { t, u, v, primitive }: FlatHit) -> Hit {
        if primitive == MISS {
            return Hit { t, u, v, geometry: MISS, primitive };
        }
        let (geometry, primitive) = self.locate(primitive as usize);
        let number = |i: usize| u32::try_from(i).expect("below a flat number, which is a u32");
        Hit { t, u, v, geometry: number(geometry), primitive: number(primitive) }
    }

    /// A hit by the flat number of its primitive; one of [`MISS`] where it names none that is there.
    #[must_use]
    pub fn flat_hit(&self, hit: &Hit) -> FlatHit {
        let Hit { t, u, v, geometry, primitive } = *hit;
        let range = self.starts.get(geometry as usize..).and_then(|starts| Some((*starts.first()?, *starts.get(1)?)));
        let flat = range.map(|(start, end)| (start + primitive as usize, end)).filter(|(flat, end)| flat < end);
        let primitive = flat.and_then(|(flat, _)| u32::try_from(flat).ok()).unwrap_or(MISS);
        FlatHit { t, u, v, primitive }
    }
}

/// Why geometries are no scene: which primitive is none, and what would be right.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("geometry {geometry}, primitive {primitive}: {fault}")]
pub struct InvalidScene {
    /// The index of the geometry.
    pub geometry: usize,
    /// The index of the primitive in it.
    pub primitive: usize,
    /// What is wrong with it.
    pub fault: PrimitiveFault,
}

/// What can be wrong with a primitive.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PrimitiveFault {
    /// A triangle names a vertex that is not there.
    #[error("there is no vertex {index}; give indices below {vertices}, the number of vertices")]
    NoVertex {
        /// The index that it names.
        index: u32,
        /// How many vertices there are.
        vertices: usize,
    },
    /// A vertex that a triangle names is not finite.
    #[error("vertex {index} is {vertex}; give three finite numbers")]
    Vertex {
        /// The index of the vertex.
        index: u32,
        /// The vertex.
        vertex: Vec3,
    },
    /// A sphere is not finite.
    #[error("the center is {center}, the radius {radius}; give four finite numbers")]
    Sphere {
        /// Its centre.
        center: Vec3,
        /// Its radius.
        radius: f32,
    },
    /// A radius is negative.
    #[error("the radius is {radius}; give zero or more")]
    Radius {
        /// The radius.
        radius: f32,
    },
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spheres(radii: &[f32]) -> Geometry {
        Geometry::Spheres(radii.iter().map(|&radius| Sphere::new([0.0; 3], radius)).collect())
    }

    #[test]
    fn a_primitive_that_is_none_is_named() {
        let vertices = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, f32::NAN, 0.0], [0.0, 1.0, 0.0]];
        let mesh = |triangles: &[[u32; 3]]| Geometry::Mesh(Mesh::new(vertices, triangles.to_vec()));
        let message = |all: Vec<Geometry>| Scene::new(all).map_err(|e| e.to_string());
        let cases = [
            (vec![spheres(&[1.0]), mesh(&[[0, 1, 3], [0, 1, 4]])], "geometry 1, primitive 1: there is no vertex 4; "),
            (vec![mesh(&[[0, 1, 2]])], "geometry 0, primitive 0: vertex 2 is [0, NaN, 0]; "),
            (vec![spheres(&[0.0, -1.0])], "geometry 0, primitive 1: the radius is -1; "),
            (vec![spheres(&[f32::INFINITY])], "geometry 0, primitive 0: the center is [0, 0, 0], the radius inf; "),
        ];
        for (all, start) in cases {
            let error = message(all).err().unwrap_or_default();
            assert!(error.starts_with(start), "{error:?}, not {start:?}");
        }
        // A vertex that nothing names harms nothing; no area and no radius are no faults.
        assert!(Scene::new(vec![mesh(&[[0, 1, 3], [0, 0, 0]]), spheres(&[0.0])]).is_ok());
    }

    #[test]
    fn hits_are_named_both_ways() {
        let all = vec![spheres(&[]), spheres(&[1.0, 2.0]), spheres(&[]), spheres(&[3.0])];
        let scene = Scene::new(all).expect("valid");
        for (flat, place) in [(0, (1, 0)), (1, (1, 1)), (2, (3, 0))] {
            assert_eq!(scene.locate(flat as usize), (place.0 as usize, place.1 as usize));
            let hit = scene.hit(FlatHit { t: 1.0, u: 0.25, v: 0.5, primitive: flat });
            assert_eq!(hit, Hit { t: 1.0, u: 0.25, v: 0.5, geometry: place.0, primitive: place.1 });
            assert_eq!(scene.flat_hit(&hit).primitive, flat);
        }
        assert_eq!((scene.hit(FlatHit::MISS), scene.flat_hit(&Hit::MISS)), (Hit::MISS, FlatHit::MISS));
        for (geometry, primitive) in [(0, 0), (1, 2), (3, 1), (4, 0), (u32::MAX, 0), (1, u32::MAX)] {
            let hit = Hit { geometry, primitive, ..Hit::MISS };
            assert_eq!(scene.flat_hit(&hit).primitive, MISS, "{geometry}, {primitive}");
        }
    }
}
