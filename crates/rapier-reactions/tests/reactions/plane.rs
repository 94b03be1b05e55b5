//! Vectors of the plane for closed forms.

/// A vector of the plane.
pub type Pair = [f64; 2];

pub fn add(a: Pair, b: Pair) -> Pair {
    [a[0] + b[0], a[1] + b[1]]
}

pub fn less(a: Pair, b: Pair) -> Pair {
    [a[0] - b[0], a[1] - b[1]]
}

pub fn times(a: Pair, factor: f64) -> Pair {
    a.map(|value| value * factor)
}

pub fn dot(a: Pair, b: Pair) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

pub fn cross(a: Pair, b: Pair) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// `v` turned by `angle` (rad).
pub fn turned(v: Pair, angle: f64) -> Pair {
    let (sin, cos) = angle.sin_cos();
    [cos * v[0] - sin * v[1], sin * v[0] + cos * v[1]]
}

/// The numbers x and y with x a + y b = right.
pub fn solved(a: Pair, b: Pair, right: Pair) -> Pair {
    let determinant = cross(a, b);
    [cross(right, b) / determinant, cross(a, right) / determinant]
}

/// Acceleration of a point of a body that has `omega` and `alpha`. `arm` leads to the point from another point of the
/// body, which has the acceleration `of`.
pub fn carried(of: Pair, arm: Pair, omega: f64, alpha: f64) -> Pair {
    let across = [-arm[1], arm[0]];
    add(of, less(times(across, alpha), times(arm, omega * omega)))
}

/// Whether the errors at the steps h, h / 2 and h / 4 have the order of convergence `order`, or are all below `floor`.
/// For example, a uniform rotation is interpolated exactly and leaves only errors below `floor`.
pub fn converges(errors: [f64; 3], order: f64, floor: f64) -> bool {
    let has_order = errors.windows(2).all(|pair| ((pair[0] / pair[1]).log2() - order).abs() < 0.15);
    has_order || errors.iter().all(|&error| error < floor)
}
