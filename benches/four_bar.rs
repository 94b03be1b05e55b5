//! A four-bar written by hand, as in a special-purpose program, for comparison with the general solver.
//! O is the pivot of the crank, A joins crank and coupler, B joins coupler and rocker, C is the pivot of the rocker.

/// Lengths, pivots and masses of one four-bar; SI units, mass centres on the links' centre lines.
#[derive(Clone, Copy)]
pub struct FourBar {
    /// Length of the crank.
    pub crank: f64,
    /// Length of the coupler.
    pub coupler: f64,
    /// Length of the rocker.
    pub rocker: f64,
    /// Pivot of the rocker; the pivot of the crank is the origin.
    pub pivot: [f64; 2],
    /// Masses of crank, coupler, rocker.
    pub mass: [f64; 3],
    /// Moments of inertia about the mass centres.
    pub inertia: [f64; 3],
    /// Distances of the mass centres from O, A, C.
    pub centre: [f64; 3],
    /// Acceleration of gravity, downwards.
    pub gravity: f64,
    /// Moment against the rocker's rotation.
    pub resistance: f64,
}

/// Components of the forces at O, A, B and C, then the balancing moment. Each force acts on the link that the scenario
/// lists second for the joint.
pub type Forces = [f64; 9];

impl FourBar {
    /// Positions alone: vectors OA, AB, CB. The general solver also computes the frame of each link.
    #[inline(never)]
    pub fn positions(&self, angle: f64) -> [f64; 6] {
        let (s, c) = angle.sin_cos();
        let (ax, ay) = (self.crank * c, self.crank * s);
        let (dx, dy) = (self.pivot[0] - ax, self.pivot[1] - ay);
        let d2 = dx * dx + dy * dy;
        let f = 0.5 * (self.coupler * self.coupler - self.rocker * self.rocker + d2) / d2;
        let h = (self.coupler * self.coupler / d2 - f * f).sqrt();
        let (px, py) = (dx * f - dy * h, dy * f + dx * h);
        [ax, ay, px, py, px - dx, py - dy]
    }

    /// Positions, velocities, accelerations, all reactions and the balancing moment at one crank angle (constant
    /// speed).
    #[inline(never)]
    pub fn solve(&self, angle: f64, w1: f64) -> Forces {
        let (s, c) = angle.sin_cos();
        let (ax, ay) = (self.crank * c, self.crank * s);
        let (dx, dy) = (self.pivot[0] - ax, self.pivot[1] - ay);
        let d2 = dx * dx + dy * dy;
        let f = 0.5 * (self.coupler * self.coupler - self.rocker * self.rocker + d2) / d2;
        let h = (self.coupler * self.coupler / d2 - f * f).sqrt();
        let (px, py) = (dx * f - dy * h, dy * f + dx * h);
        let (qx, qy) = (px - dx, py - dy);
        let det = 1.0 / (px * qy - py * qx);
        let (vx, vy) = (-w1 * ay, w1 * ax);
        let w2 = -(vx * qx + vy * qy) * det;
        let w3 = -(vx * px + vy * py) * det;
        let (aax, aay) = (-w1 * w1 * ax, -w1 * w1 * ay);
        let (gx, gy) = (-w3 * w3 * qx - aax + w2 * w2 * px, -w3 * w3 * qy - aay + w2 * w2 * py);
        let e2 = (gx * qx + gy * qy) * det;
        let e3 = (gx * px + gy * py) * det;
        let r = [self.centre[0] / self.crank, self.centre[1] / self.coupler, self.centre[2] / self.rocker];
        let inertial = |k: usize, x: f64, y: f64| (-self.mass[k] * x, -self.mass[k] * (y + self.gravity));
        let (f1x, f1y) = inertial(0, aax * r[0], aay * r[0]);
        let (f2x, f2y) = inertial(1, aax + r[1] * (-e2 * py - w2 * w2 * px), aay + r[1] * (e2 * px - w2 * w2 * py));
        let (f3x, f3y) = inertial(2, r[2] * (-e3 * qy - w3 * w3 * qx), r[2] * (e3 * qx - w3 * w3 * qy));
        let load = if w3 > 0.0 { -self.resistance } else { self.resistance };
        let m2 = (r[1] - 1.0) * (px * f2y - py * f2x) - self.inertia[1] * e2;
        let m3 = (r[2] - 1.0) * (qx * f3y - qy * f3x) - self.inertia[2] * e3 + load;
        let (tx, ty) = (f2x + f3x, f2y + f3y);
        // R is the force of the crank on the coupler at A, and T = f2 + f3. With u = A - B = -p and w = C - B = -q, the
        // moments of coupler and rocker about B give u x R = -m2 and w x R = m3 - w x T.
        let rhs = m3 + (qx * ty - qy * tx);
        let (rax, ray) = ((qx * m2 + px * rhs) * det, (qy * m2 + py * rhs) * det);
        let (rcx, rcy) = (-rax - tx, -ray - ty);
        let (rbx, rby) = (-rax - f2x, -ray - f2y);
        let (rox, roy) = (rax - f1x, ray - f1y);
        let moment = ax * ray - ay * rax - r[0] * (ax * f1y - ay * f1x);
        [rox, roy, rax, ray, -rbx, -rby, rcx, rcy, moment]
    }
}
