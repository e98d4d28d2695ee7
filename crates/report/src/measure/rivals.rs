//! Peers in a report: who is there, and why another is not.

use std::path::PathBuf;

use rayproof::scene::{Geometry, Scene};
use rayproof_gpu::Selector;

use crate::model;
use crate::peers::{
    Adaptor, absent_python_peers, absent_ray_query, absent_rust_peers, python_peers, ray_query_peer, rust_peers,
};

/// Which peers are asked for.
#[derive(Clone, Debug)]
pub struct Peers {
    /// The virtual environment with Embree's Python packages, or why there is none.
    pub python: Result<PathBuf, String>,
}

/// What is known of each peer so far.
pub(crate) struct Rivals {
    asked: Option<Peers>,
    pub(crate) known: Vec<model::Peer>,
}

impl Rivals {
    pub(crate) fn new(asked: Option<Peers>) -> Self {
        let mut rivals = Self { asked, known: Vec::new() };
        if rivals.asked.is_none() {
            let why = "not asked for: give --peers";
            let others = absent_rust_peers(why).into_iter().chain(absent_python_peers(why));
            for absent in others.chain([absent_ray_query(why)]) {
                rivals.take(absent);
            }
        }
        rivals
    }

    pub(crate) const fn is_asked(&self) -> bool {
        self.asked.is_some()
    }

    /// The peers that can be asked about a scene: they take one mesh.
    pub(crate) fn on(&mut self, scene: &Scene) -> Vec<Box<dyn Adaptor>> {
        let (Some(peers), [Geometry::Mesh(mesh)]) = (self.asked.clone(), scene.geometries()) else { return Vec::new() };
        let mut all = rust_peers(mesh);
        all.extend(match &peers.python {
            Ok(venv) => python_peers(mesh, venv),
            Err(why) => absent_python_peers(why),
        });
        // On a software adapter it is a peer in name only.
        all.push(ray_query_peer(mesh, &Selector::Hardware));
        all.into_iter().filter_map(|contestant| self.take(contestant)).collect()
    }

    fn take(&mut self, contestant: crate::peers::Contestant) -> Option<Box<dyn Adaptor>> {
        match contestant {
            Ok(peer) => {
                let [name, version, note] = [peer.name(), peer.version(), peer.how()].map(str::to_owned);
                self.know(model::Peer { name, version, note, measured: true });
                Some(peer)
            }
            Err(absent) => {
                self.absent(&absent.name, &absent.why);
                None
            }
        }
    }

    /// A peer that is not there, or fell out.
    pub(crate) fn absent(&mut self, name: &str, why: &str) {
        let (name, note) = (name.to_owned(), why.to_owned());
        self.know(model::Peer { name, version: String::new(), note, measured: false });
    }

    /// Adds a peer; one that failed once is told as such.
    fn know(&mut self, peer: model::Peer) {
        match self.known.iter_mut().find(|known| known.name == peer.name) {
            Some(known) if !peer.measured && known.measured => {
                known.note = format!("{}; failed once: {}", known.note, peer.note)
            }
            Some(_) => {}
            None => self.known.push(peer),
        }
    }
}
