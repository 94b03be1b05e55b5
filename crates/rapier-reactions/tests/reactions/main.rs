//! Reactions that Rapier exerts, compared with closed forms.

mod errors;
mod four_bar;
mod pendulum;
mod plane;
mod refusals;
mod rigid;
#[cfg(feature = "f32")]
mod single;
