use std::fmt::Arguments;
use std::path::PathBuf;

use glam::{DVec2, DVec3, Vec3};

use super::LoadedScene;
use super::polygon::turn;
use crate::decimal::Number;
use crate::{BadInput, Error, Note, Rounding};
use rayproof_scene::{Camera, Mesh, Scene, Sphere};

/// What reading a scene comes to beside its primitives.
#[derive(Debug, Default)]
pub(super) struct Told {
    /// What is subtracted from every point.
    pub(super) origin: DVec3,
    notes: Vec<Note>,
    rounding: Rounding,
}

impl Told {
    pub(super) fn at(origin: DVec3) -> Self {
        Self { origin, ..Self::default() }
    }

    /// The scene, and what is told of it.
    pub(super) fn of(self, scene: Scene, camera: Option<Camera>, sources: Vec<PathBuf>) -> LoadedScene {
        let Self { origin, notes, rounding } = self;
        LoadedScene { scene, camera, sources, origin: origin.to_array(), notes, rounding }
    }
}

/// One file being read: the first of its wrong places, and how many more there are like it; what is to be told of it.
pub(super) struct Reading<'a> {
    file: &'a str,
    first: Option<Box<BadInput>>,
    told: &'a mut Told,
}

impl<'a> Reading<'a> {
    pub(super) const fn new(file: &'a str, told: &'a mut Told) -> Self {
        Self { file, first: None, told }
    }

    /// Adds a wrong place. After the first, those that expect the same are counted and others are left for later:
    /// the message is about one thing to put right.
    pub(super) fn fault(&mut self, place: Arguments<'_>, what: Arguments<'_>, expected: &str) {
        match &mut self.first {
            None => {
                let (place, what) = (place.to_string(), what.to_string());
                let bad = BadInput { file: self.file.into(), place, what, more: 0, expected: expected.into() };
                self.first = Some(Box::new(bad));
            }
            Some(first) if first.expected == expected => first.more += 1,
            Some(_) => {}
        }
    }

    /// Adds a place where something was left out or taken otherwise; `what` says it of any such place.
    pub(super) fn note(&mut self, place: Arguments<'_>, what: &str) {
        match self.told.notes.iter_mut().find(|note| note.what == what && note.file == self.file) {
            Some(note) => note.more += 1,
            None => {
                let (file, place, what) = (self.file.into(), place.to_string(), what.into());
                self.told.notes.push(Note { file, place, what, more: 0 });
            }
        }
    }

    /// A point, rounded once after the origin is subtracted, and as it was before.
    fn point(&mut self, point: [Number; 3]) -> (Vec3, DVec3) {
        let mut numbers = point;
        for (number, origin) in numbers.iter_mut().zip(self.told.origin.to_array()) {
            *number = number.minus(origin);
            self.told.rounding.count(*number);
        }
        (numbers.map(|number| number.single).into(), numbers.map(|number| number.wide).into())
    }

    /// A sphere; `place` says where one that is bad stands.
    pub(super) fn sphere(&mut self, place: Arguments<'_>, [x, y, z, radius]: [Number; 4]) -> Sphere {
        let (center, _) = self.point([x, y, z]);
        self.told.rounding.count(radius);
        let (c, r) = (center, radius.single);
        if !c.is_finite() || !r.is_finite() {
            let what = format_args!("the sphere ({:?}, {:?}, {:?}, {r:?}) is not finite", c.x, c.y, c.z);
            self.fault(place, what, "give x, y, z and radius as finite numbers within the range of f32");
        } else if r < 0.0 {
            self.fault(place, format_args!("the radius {r:?} is negative"), "give a radius of zero or more");
        }
        Sphere { center, radius: r }
    }

    /// # Errors
    /// When a wrong place was added.
    pub(super) fn end(self) -> Result<(), Error> {
        self.first.map_or(Ok(()), |bad| Err(Error::Bad(bad)))
    }
}

/// The vertices of a mesh, rounded.
#[derive(Default)]
pub(super) struct Vertices {
    rounded: Vec<Vec3>,
    /// As they were before, from the first on that changed: for the area that rounding may take from a triangle.
    exact: Vec<DVec3>,
    /// Those that are not finite, with what their places are told by.
    unfit: Vec<(usize, usize)>,
}

impl Vertices {
    pub(super) fn with_capacity(count: usize) -> Self {
        Self { rounded: Vec::with_capacity(count), ..Self::default() }
    }

    pub(super) const fn len(&self) -> usize {
        self.rounded.len()
    }

    /// Adds a vertex; `number` is for the words that say where it stands.
    pub(super) fn push(&mut self, vertex: [Number; 3], number: usize, reading: &mut Reading<'_>) {
        let (rounded, exact) = reading.point(vertex);
        if !rounded.is_finite() {
            self.unfit.push((self.rounded.len(), number));
        }
        let changed = rounded.as_dvec3() != exact;
        if changed && self.exact.is_empty() {
            self.exact.extend(self.rounded.iter().map(|v| v.as_dvec3()));
        }
        if changed || !self.exact.is_empty() {
            self.exact.push(exact);
        }
        self.rounded.push(rounded);
    }

    pub(super) fn rounded(&self) -> &[Vec3] {
        &self.rounded
    }

    /// The mesh, whose triangles are of these vertices. A vertex that is not finite is bad where a triangle has it; where none
    /// has, it is left out. `place` says by its number where it stands.
    pub(super) fn mesh<P: std::fmt::Display>(
        mut self,
        triangles: Vec<[u32; 3]>,
        place: impl Fn(usize) -> P,
        reading: &mut Reading<'_>,
    ) -> Mesh {
        if !self.unfit.is_empty() {
            let mut used = vec![false; self.rounded.len()];
            triangles.iter().flatten().for_each(|&corner| used[corner as usize] = true);
            for &(i, number) in &self.unfit {
                let v = self.rounded[i];
                let place = place(number);
                if used[i] {
                    let what = format_args!("the vertex ({:?}, {:?}, {:?}) is not finite", v.x, v.y, v.z);
                    reading.fault(format_args!("{place}"), what, "give three finite numbers within the range of f32");
                } else {
                    reading.note(
                        format_args!("{place}"),
                        "a vertex that is not finite, and that no face has, is left out",
                    );
                    // Its number stays taken.
                    self.rounded[i] = Vec3::ZERO;
                }
            }
        }
        if !self.exact.is_empty() {
            let of = |t: &[u32; 3], exact: bool| {
                t.map(|i| if exact { self.exact[i as usize] } else { self.rounded[i as usize].as_dvec3() })
            };
            let flattened = triangles.iter().filter(|t| is_flat(of(t, false)) && !is_flat(of(t, true)));
            reading.told.rounding.flattened_triangles += flattened.count() as u64;
        }
        Mesh { vertices: self.rounded, triangles }
    }
}

/// Whether a triangle has no area: all three of its shadows on the coordinate planes have none, by exact signs.
pub(crate) fn is_flat([a, b, c]: [DVec3; 3]) -> bool {
    let planes: [fn(DVec3) -> DVec2; 3] =
        [|p| DVec2::new(p.x, p.y), |p| DVec2::new(p.y, p.z), |p| DVec2::new(p.z, p.x)];
    planes.into_iter().all(|shadow| {
        let [a, b, c] = [a, b, c].map(shadow);
        turn(a, b, c) == 0.0
    })
}
