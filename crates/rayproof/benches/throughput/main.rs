//! How fast hits come: `cargo bench -p rayproof --bench throughput [-- FILTER..]`.
//!
//! Scenes times ray kinds times engines, interleaved in rounds so that drift hits all alike; medians with the spread, and
//! each engine's ratio to the peer it is to beat, from the same rounds. Scenes are read from the folder that
//! `RAYPROOF_SCENES` names (bunny.ply, dragon.ply, hall.ply); where one is not there a mesh of about its size is made.
//! A FILTER keeps the rows whose text holds it, for example `bunny`, `primary` or `cpu fast`, and with a `!` before it those
//! whose text does not; a ratio needs both its rows.
#![expect(clippy::print_stdout, reason = "a program that prints a table")]

mod engines;
mod plain;
mod rays;
mod scenes;

use std::time::Instant;

use engines::Contestant;
use rayproof::scene::Undecided;

const ROUNDS: usize = 7;

fn main() -> anyhow::Result<()> {
    let filters: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with('-')).collect();
    let keep = |text: &str| {
        filters.iter().all(|f| f.strip_prefix('!').map_or_else(|| text.contains(f.as_str()), |f| !text.contains(f)))
    };
    println!(
        "{:<8} {:<11} {:<26} {:>9} {:>9} {:>9}  {:>6}",
        "scene", "rays", "engine", "M rays/s", "p5", "p95", "ratio; rays left open by f32, and by double width"
    );
    for (name, scene) in scenes::all()? {
        let mut contestants: Vec<Contestant> = Vec::new();
        for make in engines::ALL {
            if filters.is_empty() || rays::KINDS.iter().any(|kind| keep(&format!("{name} {kind} {}", make.0))) {
                match (make.1)(&scene) {
                    Ok(contestant) => contestants.push(contestant),
                    Err(e) => println!("{name:<8} {:<11} {:<26} not measured: {e}", "", make.0),
                }
            }
        }
        for c in &contestants {
            println!("{name:<8} {:<11} {:<26} ready in {:.3} s ({})", "", c.name, c.seconds, c.detail);
        }
        for kind in rays::KINDS {
            let chosen: Vec<&Contestant> =
                contestants.iter().filter(|c| keep(&format!("{name} {kind} {}", c.name))).collect();
            if chosen.is_empty() {
                continue;
            }
            let rays = rays::make(&scene, name, kind)?;
            measure(name, kind, &rays, &chosen)?;
        }
    }
    Ok(())
}

/// The shares of the rays that the stages of a cascade left open; nothing where there is none.
fn share(open: &Undecided, rays: usize) -> String {
    if *open == Undecided::default() {
        return String::new();
    }
    let of_all = |n: u64| n as f64 / rays as f64;
    format!("; {:.3}% and {:.1e}", 100.0 * of_all(open.first_stage), of_all(open.after_refine))
}

fn measure(scene: &str, kind: &str, rays: &[rayproof::scene::Ray], chosen: &[&Contestant]) -> anyhow::Result<()> {
    let mut rates = vec![Vec::new(); chosen.len()];
    let mut open = vec![Undecided::default(); chosen.len()];
    for round in 0..=ROUNDS {
        for ((contestant, rates), open) in chosen.iter().zip(&mut rates).zip(&mut open) {
            let start = Instant::now();
            *open = (contestant.trace)(rays)?;
            // The first round warms up caches and compiles kernels.
            if round > 0 {
                rates.push(rays.len() as f64 / start.elapsed().as_secs_f64() / 1e6);
            }
        }
    }
    let median = |rates: &[f64], share: f64| {
        let mut sorted = rates.to_vec();
        sorted.sort_by(f64::total_cmp);
        let count = sorted.len();
        let below =
            sorted.iter().enumerate().take_while(|(i, _)| *i as f64 <= (count - 1) as f64 * share + 0.5).count();
        sorted[below - 1]
    };
    for ((contestant, own), open) in chosen.iter().zip(&rates).zip(&open) {
        let peer = chosen.iter().position(|c| Some(c.name) == contestant.peer);
        let ratio = peer.map(|p| {
            let ratios: Vec<f64> = own.iter().zip(&rates[p]).map(|(a, b)| a / b).collect();
            format!("{:.2} of {}", median(&ratios, 0.5), chosen[p].name)
        });
        println!(
            "{scene:<8} {kind:<11} {:<26} {:>9.2} {:>9.2} {:>9.2}  {}{}",
            contestant.name,
            median(own, 0.5),
            median(own, 0.05),
            median(own, 0.95),
            ratio.unwrap_or_default(),
            share(open, rays.len())
        );
    }
    Ok(())
}
