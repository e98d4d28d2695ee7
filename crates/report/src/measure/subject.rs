//! What is measured: a precision on a device.

use rayproof::scene::{FlatHit, Ray, Scene, Undecided};
use rayproof::{Device, DeviceError, Error, Intersector, Precision};

use crate::model;

/// A scene ready to be asked about.
pub trait Answers {
    /// The closest hits; how many rays each stage of `exact` left open.
    ///
    /// # Errors
    /// When the device fails.
    fn closest(&self, rays: &[Ray], hits: &mut [FlatHit]) -> Result<Undecided, Error>;
    /// How often each ray crosses the surface, as the precision sees it; `None` where it does not count.
    ///
    /// # Errors
    /// When the device fails.
    fn crossings(&self, rays: &[Ray], counts: &mut [u32]) -> Option<Result<(), Error>>;
    /// Seconds so far by the device's own clock.
    fn kernel_seconds(&self) -> Option<f64>;
    /// Seconds that building the tree took.
    fn build_seconds(&self) -> f64;
}

impl Answers for (Intersector, Precision) {
    fn closest(&self, rays: &[Ray], hits: &mut [FlatHit]) -> Result<Undecided, Error> {
        self.0.closest_flat(rays, hits)
    }

    fn crossings(&self, rays: &[Ray], counts: &mut [u32]) -> Option<Result<(), Error>> {
        let counted = match self.1 {
            Precision::Exact => self.0.count(rays, counts).map(|_| ()),
            _ => self.0.claims(rays, counts),
        };
        if matches!(counted, Err(Error::OnDevice)) { None } else { Some(counted) }
    }

    fn kernel_seconds(&self) -> Option<f64> {
        self.0.kernel_seconds()
    }

    fn build_seconds(&self) -> f64 {
        self.0.build_seconds()
    }
}

/// Which leaves are visited.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Walk {
    /// Those of a tree whose boxes the ray meets.
    Tree,
    /// All.
    Every,
}

/// Makes a scene ready. A test puts a damaged precision here.
pub type Make<'m> = dyn Fn(&Device, &Scene, Precision, Walk) -> Result<Box<dyn Answers>, Error> + 'm;

/// The engines as they are.
///
/// # Errors
/// When the device cannot hold the scene, or fails.
pub fn engines(device: &Device, scene: &Scene, precision: Precision, walk: Walk) -> Result<Box<dyn Answers>, Error> {
    let intersector = Intersector::on(device, scene, precision)?;
    let intersector = if walk == Walk::Every { intersector.without_tree() } else { intersector };
    Ok(Box::new((intersector, precision)))
}

/// A precision on a device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Subject {
    pub(crate) precision: Precision,
    /// Its place among the devices.
    pub(crate) device: usize,
}

impl Subject {
    pub(crate) fn id(self) -> String {
        self.precision.name().to_owned()
    }
}

/// The place of `fast` on the same device; the subject's own where that is not there.
pub(crate) fn fast_of(subjects: &[Subject], subject: Subject) -> usize {
    let place = |wanted: Subject| subjects.iter().position(|s| *s == wanted);
    place(Subject { precision: Precision::Fast, ..subject })
        .or_else(|| place(subject))
        .expect("a subject is one of all")
}

/// Everything that runs in one report.
pub(crate) struct Bench<'m> {
    pub(crate) devices: Vec<Device>,
    pub(crate) subjects: Vec<Subject>,
    make: &'m Make<'m>,
}

impl<'m> Bench<'m> {
    /// The precisions that each device has.
    ///
    /// # Errors
    /// When a device fails; one that lacks the numbers of a precision does not.
    pub(crate) fn new(devices: Vec<Device>, make: &'m Make<'m>) -> Result<Self, Error> {
        let nothing = Scene::new(Vec::new()).expect("nothing is wrong with nothing");
        let mut subjects = Vec::new();
        for (device, open) in devices.iter().enumerate() {
            for precision in Precision::ALL {
                match make(open, &nothing, precision, Walk::Tree) {
                    Ok(_) => subjects.push(Subject { precision, device }),
                    Err(Error::Device(DeviceError::Unsupported { .. })) => {}
                    Err(error) => return Err(error),
                }
            }
        }
        Ok(Self { devices, subjects, make })
    }

    /// The subjects that tell something of scenes with or without spheres: on triangles `textbook` is
    /// `classic`.
    pub(crate) fn subjects_on(&self, spheres: bool) -> Vec<Subject> {
        self.subjects.iter().copied().filter(|s| spheres || s.precision != Precision::Textbook).collect()
    }

    /// A scene ready for a subject.
    pub(crate) fn ready(&self, subject: Subject, scene: &Scene, walk: Walk) -> Result<Box<dyn Answers>, Error> {
        (self.make)(&self.devices[subject.device], scene, subject.precision, walk)
    }

    /// The closest hits of a subject.
    pub(crate) fn closest(&self, subject: Subject, scene: &Scene, rays: &[Ray]) -> Result<Vec<FlatHit>, Error> {
        let mut hits = vec![FlatHit::MISS; rays.len()];
        self.ready(subject, scene, Walk::Tree)?.closest(rays, &mut hits)?;
        Ok(hits)
    }

    /// A precision and its device in words.
    pub(crate) fn name(&self, subject: Subject) -> String {
        format!("{} on {}", subject.precision.name(), self.devices[subject.device].info(subject.precision).name)
    }
}

/// What the precisions are, for readers.
pub(crate) fn precisions() -> Vec<model::Formulas> {
    let words = |precision| match precision {
        Precision::Textbook => ("the schoolbook quadratic, f32", ""),
        Precision::Classic => ("the stable quadratic, f32", "Cramer's rule by the book, f32"),
        Precision::Fast => ("by the foot of the perpendicular, f32", "Cramer's rule on shifted vertices, f32"),
        Precision::Pair => ("as fast, in pairs of f32", "as fast, in pairs of f32"),
        Precision::Double => ("as fast, in f64", "as fast, in f64"),
        Precision::Exact => {
            ("exact: proven in f32, else in wider numbers", "exact: proven in f32, else in wider numbers")
        }
    };
    let formulas = |precision: Precision| {
        let (sphere, triangle) = words(precision);
        model::Formulas { id: precision.name().to_owned(), sphere: sphere.to_owned(), triangle: triangle.to_owned() }
    };
    Precision::ALL.map(formulas).into()
}
