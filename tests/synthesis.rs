//! Synthesis against analysis: what is found in closed form or by search is followed by the machinery that knows nothing of it.

mod common;

#[path = "synthesis/closed_form.rs"]
mod closed_form;
#[path = "synthesis/drives.rs"]
mod drives;
#[path = "synthesis/motor.rs"]
mod motor;
#[path = "synthesis/search.rs"]
mod search;
