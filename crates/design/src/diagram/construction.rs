//! Constructions of the graphical methods on paper: pole distances, scale factors and ordinates.
//!
//! The pole P lies at the distance H left of the ordinate axis. A ray from P is parallel to a chord or a tangent with
//! the slope angle psi in the diagram above. The ray cuts off the ordinate H tan(psi) on the axis.
//! On paper, y = s / mu_s and x = t / mu_t. The ordinate is therefore the derivative at the scale
//! mu_v = mu_s / (mu_t H). For the next diagram, mu_a = mu_v / (mu_t H).
//!
//! Integration by rays is the inverse construction. A ray goes from P to the ordinate at the midpoint of a division.
//! The line of the integral over this division is parallel to the ray, so mu_s = mu_v mu_t H.
//! Integration by areas draws an area of H mm^2 as an ordinate of 1 mm, so again mu_s = mu_v mu_t H.

use super::method::Method;
use super::motion::{MethodResult, MotionDiagram};
use drawing::paper::scale::factor;
use linkage::math::KeepNan;
use linkage::math::statistics::ends;

/// Length of the axis of the crank angle (mm).
pub const LONG: f64 = 180.0;
/// Upper limit of the height of a diagram (mm).
pub const HIGH: f64 = 60.0;
/// Pole distances of at least this length (mm) are multiples of this length. Smaller pole distances are whole
/// millimetres.
const POLE: f64 = 5.0;

linkage::words! {
    /// Kind of a construction.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum ConstructionSort: word {
        /// Differentiation by chords.
        Chords = "chords",
        /// Differentiation by tangents.
        Tangents = "tangents",
        /// Integration by rays.
        Integration = "integration",
        /// Integration by areas.
        Areas = "areas",
    }
}

impl ConstructionSort {
    /// The methods of the two steps of the construction.
    pub fn methods(self) -> [Method; 2] {
        match self {
            ConstructionSort::Chords => [Method::ChordVelocity, Method::ChordAcceleration],
            ConstructionSort::Tangents => [Method::TangentVelocity, Method::TangentAcceleration],
            ConstructionSort::Integration => [Method::IntegratedDisplacement, Method::IntegratedVelocity],
            ConstructionSort::Areas => [Method::AreaDisplacement, Method::AreaVelocity],
        }
    }
}

/// One step of a construction: from one diagram to another.
#[derive(Clone, Debug, PartialEq)]
pub struct ConstructionStep {
    /// Method.
    pub method: Method,
    /// Index of the given quantity: 0 displacement, 1 velocity, 2 acceleration.
    pub from: usize,
    /// Scale factors of the given and of the found diagram (SI/mm).
    pub scales: [f64; 2],
    /// Pole distance H (mm). Integration by areas draws an area of H mm^2 as an ordinate of 1 mm.
    pub pole: f64,
    /// Differentiation: ordinates that the rays cut off (mm).
    /// Integration by rays: ordinates of the given diagram, to which the rays go (mm).
    /// Integration by areas: areas of the strips (mm^2).
    pub ordinates: Vec<f64>,
}

/// A construction of one motion diagram.
#[derive(Clone, Debug, PartialEq)]
pub struct Construction {
    /// Kind of the construction.
    pub sort: ConstructionSort,
    /// Scale factor of the time axis (s/mm).
    pub time: f64,
    /// The two steps. For chords and tangents, the second step starts from the diagram that the first step has found.
    pub steps: [ConstructionStep; 2],
}

impl Construction {
    /// Chooses poles and scale factors, so that each diagram fits on paper.
    pub fn of(diagram: &MotionDiagram, sort: ConstructionSort) -> Self {
        let time = (diagram.times[diagram.times.len() - 1] - diagram.times[0]).abs() / LONG;
        let range = |which: usize| {
            let values = diagram.exact[which].iter().copied();
            // A pole lies on the zero line, so the diagram of a derivative contains zero.
            let [low, high] = if which == 0 { ends(values) } else { ends(values.chain([0.0])) };
            high - low
        };
        let natural = [0, 1, 2].map(|which| factor(range(which), HIGH));
        let [first, second] = sort.methods();
        let steps = match sort {
            ConstructionSort::Chords | ConstructionSort::Tangents => {
                let one = step(diagram, first, 0, natural, natural[0], time);
                let two = step(diagram, second, 1, natural, one.scales[1], time);
                [one, two]
            }
            ConstructionSort::Integration | ConstructionSort::Areas => [(first, 1), (second, 2)]
                .map(|(method, from)| step(diagram, method, from, natural, natural[from], time)),
        };
        Construction { sort, time, steps }
    }
}

/// Returns the diagram's result for a method.
pub fn result(diagram: &MotionDiagram, method: Method) -> &MethodResult {
    diagram.found.iter().find(|found| found.method == method).expect("a diagram has all methods")
}

fn step(
    diagram: &MotionDiagram,
    method: Method,
    from: usize,
    natural: [f64; 3],
    given: f64,
    time: f64,
) -> ConstructionStep {
    let to = method.gives();
    let differentiates = to > from;
    let ideal = if differentiates { given / (time * natural[to]) } else { natural[to] / (given * time) };
    // A larger pole distance makes the diagram of a derivative higher, and the diagram of an integral lower.
    // The pole distance is rounded so that the diagram becomes lower.
    let round = |value: f64| if differentiates { value.floor() } else { value.ceil() };
    let pole = if ideal >= POLE { POLE * round(ideal / POLE) } else { round(ideal).larger(1.0) };
    let scale = if differentiates { given / (time * pole) } else { given * time * pole };
    let found = result(diagram, method);
    let rows: Vec<usize> = (0..diagram.times.len()).step_by(diagram.stride).collect();
    let ordinates = match method {
        Method::ChordVelocity | Method::ChordAcceleration | Method::TangentVelocity | Method::TangentAcceleration => {
            found.values.iter().map(|value| value / scale).collect()
        }
        Method::IntegratedDisplacement | Method::IntegratedVelocity => {
            let middles = rows[1..].iter().map(|row| row - diagram.stride / 2);
            middles.map(|row| diagram.exact[from][row] / given).collect()
        }
        Method::AreaDisplacement | Method::AreaVelocity => {
            let heights: Vec<f64> = rows.iter().map(|&row| diagram.exact[from][row] / given).collect();
            let width = LONG / diagram.divisions as f64;
            heights.windows(2).map(|pair| f64::midpoint(pair[0], pair[1]) * width).collect()
        }
    };
    ConstructionStep { method, from, scales: [given, scale], pole, ordinates }
}
