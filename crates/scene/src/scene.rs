use glam::Vec3;

use crate::{Kind, Sphere, Triangle};

/// Triangles over shared vertices.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// The vertices.
    pub vertices: Vec<Vec3>,
    /// Three indices into `vertices` a triangle.
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// Triangle `i`, in the file's order.
    ///
    /// # Panics
    /// When `i` or one of the triangle's indices is out of range; loaders reject such files.
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
/// Primitives have one flat numbering, geometry after geometry, which is what a [`Hit`](crate::Hit) holds and what
/// breaks ties: the lowest flat number is the lowest `(geometry, primitive)`. [`locate`](Self::locate) turns it back.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    geometries: Vec<Geometry>,
    /// The flat number of each geometry's first primitive, and at the end the number of primitives.
    starts: Vec<usize>,
}

impl Scene {
    /// The scene of these geometries.
    #[must_use]
    pub fn new(geometries: Vec<Geometry>) -> Self {
        let mut starts = Vec::with_capacity(geometries.len() + 1);
        starts.push(0);
        for geometry in &geometries {
            starts.push(starts[starts.len() - 1] + geometry.len());
        }
        Self { geometries, starts }
    }

    /// The geometries.
    #[must_use]
    pub fn geometries(&self) -> &[Geometry] {
        &self.geometries
    }

    /// How many primitives there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.starts.last().copied().unwrap_or(0)
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
        assert!(flat < self.len(), "primitive {flat} of {}", self.len());
        // Empty geometries share a start: the last one that starts at or before `flat` holds it.
        let geometry = self.starts.partition_point(|&start| start <= flat) - 1;
        (geometry, flat - self.starts[geometry])
    }

    /// The flat number of primitive 0 of a geometry.
    #[must_use]
    pub fn start(&self, geometry: usize) -> usize {
        self.starts[geometry]
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
