//! `rayproof devices`: what there is to run on, and how far its arithmetic can be trusted.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use rayproof::scene::Scene;
use rayproof::{AdapterReport, DeviceChoice, DeviceError, DeviceInfo, Fingerprint, Intersector, Options, adapters};
use serde::Serialize;

use crate::args::Devices;
use crate::exit::{Failure, print, print_json};

/// The object that `--json` prints.
#[derive(Serialize)]
struct Listing {
    /// What `--device auto` takes.
    auto: String,
    cpu: Named,
    adapters: Vec<Adapter>,
    /// Why the adapters could not be listed.
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<String>,
}

#[derive(Serialize)]
struct Named {
    name: String,
    driver: String,
}

#[derive(Serialize)]
struct Adapter {
    index: usize,
    name: String,
    driver: String,
    backend: &'static str,
    kind: &'static str,
    pci_bus: Option<String>,
    max_binding_bytes: u64,
    /// The arithmetic, once for every way a kernel can reach the driver; the first is the one that is used.
    fingerprints: Vec<Arithmetic>,
    /// The numbers of the precision `exact`, pass after pass.
    exact: Option<String>,
    /// Wider numbers that it does not compute with, and why.
    not_taken: BTreeMap<String, String>,
}

/// How often each operation was not what IEEE 754 says.
#[derive(Serialize)]
#[serde(untagged)]
enum Arithmetic {
    Measured {
        route: String,
        /// `IEEE`, `IEEE but for subnormals` or `not IEEE`.
        verdict: String,
        ieee: bool,
        error_free_transforms: bool,
        pairs: usize,
        sum_wrong: usize,
        sum_error_wrong: usize,
        product_wrong: usize,
        product_error_wrong: usize,
        contracted: usize,
        quotient_wrong: usize,
        quotient_ulp: u32,
        root_wrong: usize,
        root_ulp: u32,
        fused: usize,
        comparisons_wrong: usize,
        folded: usize,
        subnormals: usize,
        subnormals_wrong: usize,
        subnormal_operands: usize,
        subnormal_operands_wrong: usize,
        subnormal_comparisons_wrong: usize,
        subnormal_bits_wrong: usize,
    },
    Failed {
        error: String,
    },
}

/// Runs the command.
pub(crate) fn run(args: &Devices) -> Result<(), Failure> {
    let (auto, cpu) = (info(DeviceChoice::Auto)?, info(DeviceChoice::Cpu)?);
    let adapters = adapters();
    if !args.json {
        return print(text(&auto, &cpu, &adapters).trim_end());
    }
    let (adapters, error) = match adapters {
        Ok(adapters) => (adapters, None),
        Err(error) => (Vec::new(), Some(error.to_string())),
    };
    let listing = Listing {
        auto: auto.name,
        cpu: Named { name: cpu.name, driver: cpu.driver },
        adapters: adapters.into_iter().map(adapter).collect(),
        error,
    };
    print_json(&listing)
}

/// What a choice comes to.
fn info(device: DeviceChoice) -> Result<DeviceInfo, Failure> {
    let options = Options { device, ..Options::default() };
    Ok(Intersector::new(&Scene::default(), &options)?.device().clone())
}

fn text(auto: &DeviceInfo, cpu: &DeviceInfo, adapters: &Result<Vec<AdapterReport>, DeviceError>) -> String {
    let mut text = format!("auto     {}", auto.name);
    for note in &auto.notes {
        let _ = write!(text, "; {note}");
    }
    let _ = writeln!(text, "\ncpu      {}; {}", cpu.name, cpu.driver);
    let _ = match adapters {
        Ok(adapters) if adapters.is_empty() => {
            writeln!(text, "no Vulkan adapter was found: install a Vulkan driver (Mesa's llvmpipe runs on any CPU)")
        }
        Ok(_) => Ok(()),
        Err(error) => writeln!(text, "the Vulkan adapters cannot be listed: {error}"),
    };
    for a in adapters.iter().flatten() {
        let bus = if a.pci_bus.is_empty() { String::new() } else { format!("; pci:{}", a.pci_bus) };
        let _ = writeln!(text, "index:{}  {}; {}; {}; Vulkan{bus}", a.index, a.name, a.kind, a.driver);
        let _ = writeln!(text, "         largest binding {} MiB", a.max_binding >> 20);
        for fingerprint in &a.fingerprints {
            let lines = match fingerprint {
                Ok(fingerprint) => fingerprint.to_string(),
                Err(error) => format!("its arithmetic could not be measured: {error}"),
            };
            for line in lines.lines() {
                let _ = writeln!(text, "         {line}");
            }
        }
        let _ = writeln!(
            text,
            "         the precision exact: {}",
            exact(a).unwrap_or_else(|| "on the CPU engine".to_owned())
        );
        for (width, why) in not_taken(a) {
            let _ = writeln!(text, "           {:<20}{why}", format!("not {width}"));
        }
    }
    text
}

/// The numbers of the precision `exact`.
fn exact(report: &AdapterReport) -> Option<String> {
    let second = report.trials.as_ref().ok()?.chosen?;
    Some(format!("f32, then {second}"))
}

/// The numbers that it does not compute with, and why.
fn not_taken(report: &AdapterReport) -> Vec<(String, String)> {
    match &report.trials {
        Ok(trials) => {
            let widths = trials.verdicts.iter().map(|(width, _)| *width);
            widths.filter_map(|width| Some((width.to_string(), trials.why_not(width)?))).collect()
        }
        Err(error) => vec![("others".to_owned(), error.to_string())],
    }
}

fn adapter(report: AdapterReport) -> Adapter {
    let (exact, not_taken) = (exact(&report), not_taken(&report));
    let fingerprints = report.fingerprints.into_iter();
    Adapter {
        index: report.index,
        name: report.name,
        driver: report.driver,
        backend: "Vulkan",
        kind: report.kind,
        pci_bus: Some(report.pci_bus).filter(|bus| !bus.is_empty()),
        max_binding_bytes: report.max_binding,
        fingerprints: fingerprints.map(|f| f.map_or_else(failed, arithmetic)).collect(),
        exact,
        not_taken: not_taken.into_iter().collect(),
    }
}

fn failed(error: DeviceError) -> Arithmetic {
    Arithmetic::Failed { error: error.to_string() }
}

fn arithmetic(f: Fingerprint) -> Arithmetic {
    Arithmetic::Measured {
        route: f.route.to_string(),
        verdict: f.arithmetic().to_string(),
        ieee: f.is_ieee(),
        error_free_transforms: f.keeps_errors(),
        pairs: f.pairs,
        sum_wrong: f.sum_wrong,
        sum_error_wrong: f.sum_error_wrong,
        product_wrong: f.product_wrong,
        product_error_wrong: f.product_error_wrong,
        contracted: f.contracted,
        quotient_wrong: f.quotient_wrong,
        quotient_ulp: f.quotient_ulp,
        root_wrong: f.root_wrong,
        root_ulp: f.root_ulp,
        fused: f.fused,
        comparisons_wrong: f.comparisons_wrong,
        folded: f.folded,
        subnormals: f.subnormals,
        subnormals_wrong: f.subnormals_wrong,
        subnormal_operands: f.subnormal_operands,
        subnormal_operands_wrong: f.subnormal_operands_wrong,
        subnormal_comparisons_wrong: f.subnormal_comparisons_wrong,
        subnormal_bits_wrong: f.subnormal_bits_wrong,
    }
}
