//! Synthesis against analysis: what is found in closed form or by search is followed by the machinery that knows nothing of it.

mod closed_form;
mod drives;
mod motor;
mod search;
