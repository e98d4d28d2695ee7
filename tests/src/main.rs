//! Where the device, the CPU engine and the oracle meet. One binary; each module asks one question.
#![expect(clippy::print_stdout, reason = "each comparison says how much it compared")]

mod conformance;
mod device;
mod exact;
mod front_door;
mod house;
mod ranges;
mod regression;
mod sample;
mod scenes;
mod shaders;
mod truth;
mod words;
mod worked;
