//! Every mode draws what it says.

use rayproof::scene::{FlatHit, Ray};
use rayproof::{Device, Precision};
use rayproof_oracle::Oracle;
use rayproof_picture::color::{self, BACKGROUND, Rgb};
use rayproof_picture::shade::{self, Verdict};

use super::*;
use crate::model::look::Source;
use crate::model::paint::{Figures, HIT};

/// The sample, its rays in the picture's order, and a precision's hits.
struct Expected {
    world: crate::model::world::World,
    rays: Vec<Ray>,
}

impl Expected {
    fn new() -> Self {
        let world = crate::model::world::World::open(&sample(), Device::cpu()).unwrap();
        let rays = world.camera.rays(SIZE[0], SIZE[1], 0..SIZE[1]).collect();
        Self { world, rays }
    }

    fn hits(&self, precision: Precision) -> Vec<FlatHit> {
        let mut hits = vec![FlatHit::MISS; self.rays.len()];
        self.world.on_cpu(precision).unwrap().closest_flat(&self.rays, &mut hits).unwrap();
        hits
    }

    /// The oracle's answers.
    fn truth(&self) -> Vec<FlatHit> {
        let oracle = Oracle::new(&self.world.scene);
        oracle.batch(&self.rays, Oracle::hit)
    }

    /// What a mode shows of a precision, from first principles: the answers themselves, coloured.
    fn picture(&self, mode: Mode, precision: Precision) -> Vec<Rgb> {
        let hits = self.hits(precision);
        let each =
            |color: &dyn Fn(usize, &FlatHit) -> Rgb| hits.iter().enumerate().map(|(i, hit)| color(i, hit)).collect();
        match mode {
            Mode::Normal => each(&|i, hit| shade::by_normal(&self.world.scene, &self.rays[i], hit)),
            Mode::Depth => shade::by_depth(&hits.iter().map(|hit| hit.t).collect::<Vec<_>>()).collect(),
            Mode::Primitive => each(&|_, hit| shade::by_primitive(hit)),
            Mode::Uv => each(&|_, hit| shade::by_uv(hit)),
            Mode::Mask => each(&|_, hit| if hit.is_hit() { HIT } else { BACKGROUND }),
            Mode::Error => {
                let truth = self.truth();
                each(&|i, hit| shade::by_error(&truth[i], hit))
            }
            Mode::Verdict => {
                let truth = self.truth();
                each(&|i, hit| Verdict::of(&truth[i], hit).color())
            }
            Mode::Stage => {
                let mut stages = vec![0; self.rays.len()];
                self.world.on_cpu(Precision::Exact).unwrap().deciding_stages(&self.rays, &mut stages).unwrap();
                stages.into_iter().map(shade::by_stage).collect()
            }
            Mode::Difference => {
                let other = self.hits(Precision::Fast);
                each(&|i, hit| shade::by_error(&other[i], hit))
            }
        }
    }
}

#[test]
fn every_mode_draws_what_it_says() {
    let expected = Expected::new();
    let mut viewer = viewer(Some(&sample()), look(Mode::Normal));
    let mut seen = std::collections::HashSet::new();
    for mode in Mode::ALL {
        click(&mut viewer, mode.name());
        for precision in [Precision::Textbook, Precision::Fast, Precision::Exact] {
            if mode == Mode::Stage && precision != Precision::Exact {
                continue;
            }
            viewer.state_mut().settings.look.left = Source::device(precision);
            settle(&mut viewer);
            let (drawn, right) = (pixels(&viewer), expected.picture(mode, precision));
            let different = drawn.iter().zip(&right).filter(|(a, b)| a != b).count();
            assert_eq!((drawn.len(), different), (right.len(), 0), "{mode:?} of {precision:?}");
            seen.insert(drawn);
        }
    }
    // Nothing is shown in place of something else: of the 25 pictures those of the precision exact are as good as equal in
    // most modes, but no two modes are.
    println!("{} different pictures", seen.len());
    assert!(seen.len() >= 15);
}

#[test]
fn precisions_are_chosen_by_their_names() {
    let mut viewer = viewer(Some(&sample()), look(Mode::Error));
    choose(&mut viewer, "precision", "textbook");
    assert_eq!(viewer.state().settings.look.left, Source::device(Precision::Textbook));
    let worst = |viewer: &Harness<'_, App>| match viewer.state().tracer.picture().figures[0].clone() {
        Some(Figures::Errors(errors)) => errors.ulps.unwrap()[2],
        other => panic!("{other:?}"),
    };
    let textbook = worst(&viewer);
    choose(&mut viewer, "precision", "exact");
    println!("worst t of the textbook {textbook} ULP, of exact {}", worst(&viewer));
    assert!(textbook > 1000 && worst(&viewer) == 0);
    // The ground of radius 1e6 is what is lost.
    assert!(pixels(&viewer).iter().all(|&c| c == color::of_ulps(0) || c == BACKGROUND));
}

#[test]
fn the_oracle_judges_every_pixel() {
    let viewer = viewer(Some(&sample()), Look { left: Source::device(Precision::Fast), ..look(Mode::Verdict) });
    let picture = viewer.state().tracer.picture().clone();
    let all = (SIZE[0] * SIZE[1]) as usize;
    assert_eq!((picture.progress.judged, picture.progress.contradicted), (Some([all, all]), 0));
    assert!(viewer.query_by_label_contains("disagree with exact").is_some());
}

#[test]
fn a_split_shows_a_precision_on_each_side() {
    let expected = Expected::new();
    let left = Source::device(Precision::Textbook);
    let mut viewer = viewer(Some(&sample()), Look { left, ..look(Mode::Error) });
    click(&mut viewer, "split the picture");
    choose(&mut viewer, "right of the split", "fast");
    let picture = viewer.state().tracer.picture().clone();
    assert_eq!(picture.sides[0], expected.picture(Mode::Error, Precision::Textbook));
    assert_eq!(picture.sides[1], expected.picture(Mode::Error, Precision::Fast));
    let composed = viewer.state().composed(&picture);
    let width = SIZE[0] as usize;
    let at = width / 2;
    for (row, both) in composed.chunks_exact(width).enumerate() {
        let start = row * width;
        assert_eq!(both[..at], picture.sides[0][start..start + at]);
        assert_eq!(both[at..], picture.sides[1][start + at..start + width]);
    }
    assert_ne!(composed, picture.sides[0]);
}

#[test]
fn a_device_and_the_cpu_do_not_differ() {
    let device = Device::open(&rayproof::DeviceChoice::Gpu).expect("tests need a Vulkan adapter");
    let mut both = look(Mode::Difference);
    (both.left, both.right) = (Source::device(Precision::Fast), Source::cpu(Precision::Fast));
    let start = Start {
        device,
        scene: Some(sample()),
        look: Some(both),
        size: Some(SIZE),
        panel: None,
        script: Script::default(),
    };
    let viewer = viewer_of(start);
    let Some(Figures::Errors(errors)) = viewer.state().tracer.picture().figures[0].clone() else {
        panic!("no figures")
    };
    println!("{errors:?}");
    assert_eq!((errors.wrong(), errors.ulps), (0, Some([0; 3])));
    assert!(errors.verdicts[1] > 1000);
}
