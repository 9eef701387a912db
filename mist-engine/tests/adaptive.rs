//! Adaptive integrals: against another method, and as programs reach them.

#[path = "adaptive/defaults.rs"]
mod defaults;
#[path = "adaptive/plane.rs"]
mod plane;
#[path = "adaptive/programs.rs"]
mod programs;
#[path = "adaptive/random.rs"]
mod random;
#[path = "adaptive/references.rs"]
mod references;
