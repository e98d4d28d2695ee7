//! Where the device, the CPU engine and the oracle meet. One binary; each module asks one question.

mod cli;
mod conformance;
mod device;
mod house;
mod sample;
mod scenes;
mod truth;
